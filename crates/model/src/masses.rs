//! Which masses natural frequencies are asked with.

use hyperstat_elements::{MassShape, RotaryInertia};

/// What modes are asked for, and what has which mass.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalOptions {
    /// Number of modes, lowest first; fewer are found where there are no more.
    pub count: usize,
    /// Consistent or lumped masses of beams.
    pub mass: BeamMass,
    /// Shapes that consistent masses are made with.
    pub shape: MassShape,
    /// Whether turning sections of beams have inertia in bending, in consistent masses.
    pub rotary_inertia: RotaryInertia,
}

impl ModalOptions {
    /// The lowest `count` modes with consistent masses of cubic shapes, without rotary inertia of
    /// bending: Bernoulli's beam, and what most frame programs do.
    pub fn lowest(count: usize) -> Self {
        Self {
            count,
            mass: BeamMass::Consistent,
            shape: MassShape::Cubic,
            rotary_inertia: RotaryInertia::Left,
        }
    }
}

/// How the masses of beams are put on the nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BeamMass {
    /// Spread along the beam and moved by its shape.
    #[default]
    Consistent,
    /// Half of every element's mass at each of its ends, in translation only.
    Lumped,
}
