//! Joints of one's own, a cross-spring flexure and an offset universal joint, and a prebuilt mechanism of
//! one's own, a five-bar: registered by name.
//!
#![doc = include_str!("../README.md")]

mod cross_spring;
mod five_bar;
mod offset_universal;

pub use cross_spring::{Blades, CrossSpring};
pub use five_bar::FiveBar;
pub use offset_universal::OffsetUniversal;
