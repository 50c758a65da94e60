//! Misfits and preloads of joints: those that act, and what a misfit of each joint would do.

use std::fmt::Write as _;

use hyperstat_joints::Dof;
use hyperstat_study::{Entries, JointReport, MisfitEffectReport};

use super::parts::{heads, section};
use super::table::{Table, number};

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
        let given = joints.iter();
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
