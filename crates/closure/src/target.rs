//! What a mechanism is asked to do.

use hyperstat_joints::Dof;
use hyperstat_model::JointId;

/// A place for the output, or values for the drives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target<'a> {
    /// Coordinates of the output: its position x y z (m) and rotation vector rx ry rz (rad) from
    /// home, in global axes. `None` is not asked: it follows from the mechanism, or stays as at
    /// home where the mechanism leaves it open. All free directions are released, the drives'
    /// too.
    Output([Option<f64>; 6]),
    /// Values of drives relative to home: of the second body of the joint relative to the first,
    /// along the direction in the joint's frame (m or rad, any number of turns). Locked
    /// directions that are not named stay at home; all others are released.
    Drives(&'a [Drive]),
}

/// A value for a drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drive {
    /// The joint.
    pub joint: JointId,
    /// Its direction: one that is free by the joint's kind, and locked or elastic.
    pub direction: Dof,
    /// Value relative to home (m or rad).
    pub value: f64,
}
