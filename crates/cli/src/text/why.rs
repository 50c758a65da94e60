//! What is soft, and why.

use std::fmt::Write as _;

use hyperstat_study::{BudgetReport, MeasuresReport, Sum, Why};

use super::misfits::write_misfit_effects;
use super::parts::section;
use super::sensitivities::write_sensitivities;
use super::table::{Table, left, number};

/// Parts that the text tells; JSON has all.
const TOLD: usize = 15;

/// Width of a bar of 100 %.
const WIDTH: f64 = 40.0;

/// Writes it as tables, the largest first.
pub(super) fn write(why: &Why, text: &mut String) {
    let Some(budget) = &why.budget else {
        section(
            text,
            "What is soft, and why",
            "  The output moves freely: nothing elastic holds it there.\n",
        );
        return;
    };
    write_budget(budget, text);
    if let Some(sensitivities) = &why.sensitivities {
        let (what, _) = budget.quantity();
        write_sensitivities(sensitivities, what, text);
    }
    if let Some(misfits) = &why.misfits {
        write_misfit_effects(misfits, budget.turns(), text);
    }
    if let Some(measures) = &why.measures {
        write_measures(measures, text);
    }
}

fn write_budget(budget: &BudgetReport, text: &mut String) {
    let part = if budget.turns() {
        &budget.along[3..]
    } else {
        &budget.along[..3]
    };
    let part: Vec<_> = part.iter().map(|c| number(*c)).collect();
    let (what, unit) = budget.quantity();
    let about = if budget.turns() { "about" } else { "along" };
    let under = budget.case.as_ref().map_or_else(
        || "The".into(),
        |case| format!("Under the loads of case `{case}` the"),
    );
    let mut body = format!(
        "  {under} output has a {what} of {} {unit} {about} ({}). It comes from\n",
        number(budget.total),
        part.join(", ")
    );
    bars(&mut body, &budget.by_deformation, unit);
    body += "  and, by bodies and joints, from\n";
    bars(&mut body, &budget.by_part, unit);
    section(text, "What is soft, and why", body);
}

/// Sums with their shares as bars.
fn bars(text: &mut String, sums: &[Sum], unit: &str) {
    let told = &sums[..sums.len().min(TOLD)];
    let width = told.iter().map(|sum| sum.name.chars().count()).max();
    let width = width.unwrap_or(0);
    for sum in told {
        let share = sum.share.unwrap_or(0.0);
        let blocks = (share.abs().min(1.0) * WIDTH).round() as usize;
        let bar = if share < 0.0 { "░" } else { "█" }.repeat(blocks);
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{}",
            format!(
                "    {}  {:>6.1} %  {:>12} {unit}  {bar}",
                left(&sum.name, width),
                100.0 * share,
                number(sum.displacement)
            )
            .trim_end()
        );
    }
    if let [_, ..] = sums[told.len()..] {
        let rest: f64 = sums[told.len()..].iter().filter_map(|sum| sum.share).sum();
        let count = sums.len() - told.len();
        let _ = writeln!(text, "    and {count} more, {:.1} % together", 100.0 * rest);
    }
}

fn write_measures(measures: &MeasuresReport, text: &mut String) {
    let mut table = Table::new(1, &["", "value", "x", "y", "z"]);
    let principals = [
        (
            "compliance, pure force [m/N]",
            &measures.translational_compliances,
        ),
        (
            "compliance, pure moment [rad/(N·m)]",
            &measures.rotational_compliances,
        ),
        (
            "stiffness, pure translation [N/m]",
            &measures.translational_stiffnesses,
        ),
        (
            "stiffness, pure rotation [N·m/rad]",
            &measures.rotational_stiffnesses,
        ),
    ];
    for (name, principal) in principals {
        for (value, direction) in principal.values.iter().zip(principal.directions) {
            let row = [*value].into_iter().chain(direction.map(|c| clean(c, 1.0)));
            table.row(&[name], row);
        }
    }
    section(
        text,
        "Stiffness measures: principal values and their directions",
        table,
    );
    let heads = ["λ [N]", "k [N/m]", "pitch [m]"];
    let heads: Vec<_> = heads
        .into_iter()
        .chain(["along x", "y", "z", "at x [m]", "y", "z"])
        .collect();
    let mut table = Table::new(0, &heads);
    for screw in &measures.eigenscrews {
        let first = [screw.eigenvalue, screw.stiffness, screw.pitch];
        let places = screw.direction.map(|c| clean(c, 1.0)).into_iter().chain(
            screw
                .point
                .map(|c| clean(c, measures.characteristic_length)),
        );
        table.row(&[], first.into_iter().chain(places));
    }
    section(text, "Eigenscrews of the stiffness", table);
    let point = |p: [f64; 3]| {
        p.map(|c| number(clean(c, measures.characteristic_length)))
            .join(", ")
    };
    let body = format!(
        "  centre of stiffness   ({}) m\n  centre of compliance  ({}) m\n  \
         condition number      {} with rotations times {} m\n  \
         virtual-work index    {} J for 1 N, {} J for 1 N·m\n",
        point(measures.centre_of_stiffness),
        point(measures.centre_of_compliance),
        number(measures.condition),
        number(measures.characteristic_length),
        number(measures.virtual_work_index.force),
        number(measures.virtual_work_index.moment),
    );
    section(text, "Centres and indices", body);
}

/// What is rounding beside this size, shown as 0.
fn clean(component: f64, size: f64) -> f64 {
    if component.abs() < 1e-12 * size {
        0.0
    } else {
        component
    }
}
