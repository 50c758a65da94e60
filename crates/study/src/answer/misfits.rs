//! What a misfit of each joint would do.

use hyperstat_assembly::{Influence, MisfitEffect, larger_first};
use nalgebra::Vector6;
use serde::Serialize;

use crate::study::Study;

/// What a misfit along one direction of a joint does.
#[derive(Debug, Serialize)]
pub struct MisfitEffectReport {
    /// Name of the joint.
    pub joint: String,
    /// Its direction: `x` to `w`.
    pub direction: &'static str,
    /// Whether the misfit is an angle \[rad\], not a length \[m\].
    #[serde(skip)]
    pub is_angle: bool,
    /// Displacement of the output along the budget's wrench per unit of the misfit; `null` where
    /// it is not determined.
    pub per_unit: Option<f64>,
}

/// What a unit misfit along each direction of each joint does, lengths first, the largest of each
/// first.
pub(super) fn misfit_effects(
    study: &Study,
    influence: &Influence<'_>,
    along: &Vector6<f64>,
) -> Vec<MisfitEffectReport> {
    let mut effects = influence.misfit_effects(along);
    let key = |e: &MisfitEffect| (e.direction.is_rotation(), e.per_unit.unwrap_or(0.0).abs());
    effects.sort_by(|a, b| {
        let ((a_turns, a_size), (b_turns, b_size)) = (key(a), key(b));
        a_turns.cmp(&b_turns).then(larger_first(a_size, b_size))
    });
    let report = |effect: MisfitEffect| MisfitEffectReport {
        joint: study.model().joints()[effect.joint.0].name.clone(),
        direction: effect.direction.name(),
        is_angle: effect.direction.is_rotation(),
        per_unit: effect.per_unit,
    };
    effects.into_iter().map(report).collect()
}
