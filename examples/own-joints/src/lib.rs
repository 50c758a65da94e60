//! Joints of one's own: a cross-spring flexure and an offset universal joint, registered by name.
//!
#![doc = include_str!("../README.md")]

mod cross_spring;
mod offset_universal;

pub use cross_spring::{Blades, CrossSpring};
pub use offset_universal::OffsetUniversal;
