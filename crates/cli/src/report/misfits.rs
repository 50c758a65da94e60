//! Misfits and preloads of joints: those that act, and what a misfit of each joint would do.

use std::fmt::Write as _;

use hyperstat_assembly::{Influence, MisfitEffect, larger_first};
use hyperstat_joints::Dof;
use nalgebra::Vector6;
use serde::Serialize;

use super::joints::JointReport;
use super::{Entries, Table, heads, number, section};
use crate::case::Case;

/// Effects on lengths, and on angles, that the text tells; JSON has all.
const TOLD: usize = 15;

/// Writes the misfits and preloads that joints have.
pub(super) fn write_misfits(joints: &Entries<JointReport>, text: &mut String) {
    type Of = fn(&JointReport) -> Option<[f64; 6]>;
    let kinds: [(&str, Of); 2] = [
        (
            "Misfits that act, second body from the first, in the joint frame [m, rad]",
            |joint| joint.misfit,
        ),
        (
            "Preloads that act, on the second body, in the joint frame [N, N·m]",
            |joint| joint.preload,
        ),
    ];
    for (title, of) in kinds {
        let given = joints.0.iter();
        let mut given = given
            .filter_map(|(name, joint)| Some((name, of(joint)?)))
            .peekable();
        if given.peek().is_none() {
            continue;
        }
        let mut table = Table::new(1, &heads(&["joint"], Dof::ALL.map(Dof::name)));
        for (name, values) in given {
            table.row(&[name], values);
        }
        section(text, title, table);
    }
}

/// What a misfit along one direction of a joint does.
#[derive(Debug, Serialize)]
pub(super) struct MisfitEffectReport {
    joint: String,
    direction: &'static str,
    #[serde(skip)]
    is_angle: bool,
    /// Displacement of the output along the budget's wrench per unit of the misfit; `null` where
    /// it is not determined.
    per_unit: Option<f64>,
}

/// What a unit misfit along each direction of each joint does, lengths first, the largest of each
/// first.
pub(super) fn misfit_effects(
    case: &Case,
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
        joint: case.model().joints()[effect.joint.0].name.clone(),
        direction: effect.direction.name(),
        is_angle: effect.direction.is_rotation(),
        per_unit: effect.per_unit,
    };
    effects.into_iter().map(report).collect()
}

/// Writes the effects that are not rounding beside the largest; `turns`: on a rotation.
pub(super) fn write_misfit_effects(found: &[MisfitEffectReport], turns: bool, text: &mut String) {
    let mut body = String::new();
    for (of_angles, of) in [(false, "m"), (true, "rad")] {
        let kind = found.iter().filter(|m| m.is_angle == of_angles);
        let told: Vec<_> = (kind.filter_map(|m| Some((m, m.per_unit?))))
            .take(TOLD)
            .collect();
        let largest = told.first().map_or(0.0, |(_, effect)| effect.abs());
        let result = if turns { "rad" } else { "m" };
        for (misfit, effect) in told {
            if effect.abs() > 1e-9 * largest {
                let name = format!("{}.{}", misfit.joint, misfit.direction);
                let effect = number(effect);
                let _ = writeln!(body, "  {name:<16}  {effect:>12} {result}/{of}");
            }
        }
    }
    if found.iter().any(|m| m.per_unit.is_none()) {
        body += "  Redundant rigid constraints leave that of the other joints open.\n";
    }
    section(text, "What a misfit of a joint does, along the same", body);
}
