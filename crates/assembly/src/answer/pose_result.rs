//! What a sweep finds at a pose.

use nalgebra::{Matrix6, Vector6};

/// What a sweep finds at a pose.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct PoseResult {
    /// Output stiffness K_o; `None` where the output is held rigidly in some direction.
    pub stiffness: Option<Matrix6<f64>>,
    /// Displacement of the output under the loads; `None` where the output moves freely.
    pub displacement: Option<Vector6<f64>>,
    /// The same in each of the model's cases, in their order; none where the output moves freely.
    pub cases: Vec<Vector6<f64>>,
}

impl PoseResult {
    pub(crate) fn is_finite(&self) -> bool {
        let displacements = self.displacement.iter().chain(&self.cases);
        let numbers = self.stiffness.iter().flatten();
        let mut numbers = numbers.chain(displacements.flatten());
        numbers.all(|number| number.is_finite())
    }
}
