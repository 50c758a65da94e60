//! Natural frequencies and modes: K φ = ω² M φ over the independent displacement coordinates.
//!
//! No joint is absorbed, so that every node with a mass has its displacement, and every segment has
//! inner shapes beside its static ones, as many as its length of wave at the highest frequency asks
//! for ([`InnerShapes`](hyperstat_elements::InnerShapes)); or, for consistent and lumped masses, the
//! inner nodes of its elements. Loops are closed by the same elimination as in statics: rigid joints
//! and bodies are exact, and no mass or stiffness is invented for them.

mod lanczos;
mod mass;
mod member;
mod mode;
mod plan;
mod quick;
mod ready;
mod sensitivity;
mod shape;
mod system;

pub use mode::{Counted, Mode, Modes};
pub use plan::ModalPlan;
pub use sensitivity::{FrequencySensitivity, ModalSensitivities};
