//! Which masses natural frequencies are asked with.

use hyperstat_elements::{MassShape, RotaryInertia};

/// What modes are asked for, and what has which mass.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalOptions {
    /// Number of modes, lowest first; fewer are found where there are no more.
    pub count: usize,
    /// Exact, consistent or lumped masses of beams.
    pub mass: BeamMass,
    /// Shapes that consistent masses are made with.
    pub shape: MassShape,
    /// Whether turning sections of beams have inertia in bending, in exact and consistent masses.
    pub rotary_inertia: RotaryInertia,
}

impl ModalOptions {
    /// The lowest `count` modes with exact masses, without rotary inertia of bending: those of
    /// Bernoulli's beams themselves, and of Timoshenko's where there are shear areas.
    pub fn lowest(count: usize) -> Self {
        Self {
            count,
            mass: BeamMass::Exact,
            shape: MassShape::Cubic,
            rotary_inertia: RotaryInertia::Left,
        }
    }

    /// The same with consistent masses of cubic shapes, on the elements that the segments have: what
    /// most frame programs do.
    pub fn consistent(count: usize) -> Self {
        Self {
            mass: BeamMass::Consistent,
            ..Self::lowest(count)
        }
    }

    /// The same with lumped masses.
    pub fn lumped(count: usize) -> Self {
        Self {
            mass: BeamMass::Lumped,
            ..Self::lowest(count)
        }
    }
}

/// How the masses of beams are put on the nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BeamMass {
    /// Spread along the beam, which moves as it does at the mode's own frequency: no result depends
    /// on the number of elements.
    #[default]
    Exact,
    /// Spread along the beam and moved by its static shape between the nodes of its elements.
    Consistent,
    /// Half of every element's mass at each of its ends, in translation only.
    Lumped,
}
