//! Building blocks of stiffness models: materials, sections, beams and subassembly elements.
//!
#![doc = include_str!("../README.md")]
//!
//! # Conventions
//!
//! SI units. A displacement lists translations before rotations (Δx Δy Δz φx φy φz), a wrench
//! its force before its moment (Fx Fy Fz Mx My Mz). The element frame has x along the beam from
//! node 1 to node 2, y and z along the section's axes. Equation numbers are those of the paper
//! on elastostatic stiffness models of over-constrained parallel manipulators that this
//! workspace implements, as corrected in its book.

mod beam;
mod bernstein;
mod error;
mod flexible;
mod frame;
mod inner;
mod load;
mod load_flexibility;
mod mass;
mod material;
mod quadrature;
mod rigid_mass;
mod sampled;
mod section;
mod sensitivity;
mod straight;
pub mod stress;
pub mod subassembly;
mod taper;
mod tapered_beam;
mod vibration;

pub use beam::{Beam, SectionStrain};
pub use error::ElementError;
pub use flexible::FlexibleBody;
pub use frame::Matrix12;
pub use frame::{element_frame, rotate_matrix6, rotate_matrix12, rotate_vector6, transport};
pub use inner::InnerShapes;
pub use load::{BeamLoad, TemperatureChange};
pub use load_flexibility::{LoadFlexibility, PlaneLoadFlexibility};
pub use mass::{Along, LineMass, MassShape, RotaryInertia};
pub use material::{Elasticity, Material};
pub use rigid_mass::RigidMass;
pub use sampled::SampledStates;
pub use section::{Section, SectionShape};
pub use straight::StraightBeam;
pub use taper::Taper;
pub use tapered_beam::{PlaneFlexibility, TaperedBeam};
pub use vibration::Vibration;
