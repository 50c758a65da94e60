//! The part of a report about one mechanism in one configuration.

use std::path::Path;

use hyperstat_mechanisms::{Look, Noted};
use maud::{Markup, html};

use super::parts::{DISPLACEMENT, Row, WRENCH, figure, list, matrix, sixes, table};
use crate::answer::{BodyReport, BudgetReport, SensitivityReport, SolveReport, Sum};
use crate::ask::{Focus, Question};
use crate::entries::Entries;
use crate::error::StudyError;
use crate::figure;
use crate::figure::Drawing;
use crate::measures::{MEASURES, Pose};
use crate::number::number;
use crate::study::Study;

/// Parameters that are told of, those that change most.
const PARAMETERS: usize = 20;

pub(super) fn section(study: &mut Study, focus: &Focus) -> Result<Markup, StudyError> {
    let options = study.modes_in(focus);
    let answered = study.answer(&Question {
        modes: options.as_ref().map(|options| options.count),
        why: Some(focus.asked.clone()),
        ..Question::default()
    })?;
    if let Some(error) = study.free_output(&answered.solution) {
        return Err(error);
    }
    let report = &answered.report;
    let case = focus.asked.case.as_deref();
    let loaded = study.under(&answered.solution, case)?.output.displacement;
    let under = case.map_or_else(String::new, |case| format!(", case {case}"));
    let state = case.and_then(|case| report.cases.get(case));
    let bodies = state.map_or(&report.bodies, |state| &state.bodies);
    let joints = state.map_or(&report.joints, |state| &state.joints);
    let output = &answered.solution.output;
    let pose = output.stiffness.as_ref().map(Pose::new);
    let measure = |of: &crate::measures::Measure| {
        let value = pose.as_ref()?.measure(of.rule, &loaded)?;
        let unit = [of.unit];
        let words = [of.name, of.words]
            .into_iter()
            .chain(unit)
            .map(String::from);
        Some(Row {
            words: words.collect(),
            numbers: vec![Some(value)],
            ..Row::default()
        })
    };
    let measures: Vec<Row> = MEASURES.iter().filter_map(measure).collect();
    let (drawn, bars, modes) = drawings(study, focus, report);
    Ok(html! {
        (drawn)
        (counts(report))
        @if !report.warnings.is_empty() {
            h3.warning { "Warnings" }
            ul.warning { @for warning in &report.warnings { li { (warning) } } }
        }
        (list("Idle motions", &report.idle_motions))
        h3 { "Displacement of the output " (report.output.node) }
        (displacements(report))
        @if let Some(stiffness) = &report.output.stiffness {
            h3 { "Stiffness of the output [N/m, N/rad; N, N·m/rad]" }
            (matrix(["Fx", "Fy", "Fz", "Mx", "My", "Mz"], ["Δx", "Δy", "Δz", "φx", "φy", "φz"], stiffness))
        }
        @if !measures.is_empty() {
            h3 { "Measures" (under) }
            (table(&["", "what it is", "unit", "value"], &measures))
        }
        @if let Some(budget) = report.why.as_ref().and_then(|why| why.budget.as_ref()) {
            h3 { "What is soft" (under) }
            (bars)
            (sums("by deformation", budget, &budget.by_deformation))
            (sums("by body or joint", budget, &budget.by_part))
        }
        @if let Some(sensitivities) = report.why.as_ref().and_then(|why| why.sensitivities.as_ref()) {
            (sensitive(sensitivities))
        }
        @if let Some(found) = &report.modes {
            h3 { "Natural frequencies" }
            p { "Mass of all that has one: " (number(found.mass)) " kg." }
            @let rows: Vec<Row> = found.modes.iter().enumerate()
                .map(|(k, mode)| Row::new((k + 1).to_string(), [mode.frequency])).collect();
            (table(&["mode", "f [Hz]"], &rows))
            (modes)
        }
        (worst_points(bodies, &under))
        h3 { "Wrenches in the joints" (under) }
        p { "On the second body of the joint, at the joint, in the joint's frame." }
        @let joints = joints.iter().map(|(name, joint)| (name.to_string(), joint.wrench.as_ref()));
        (sixes("joint", WRENCH, joints))
        (list("Joints whose wrenches redundant rigid constraints leave undetermined", &report.undetermined))
    })
}

/// The mechanism as it deforms, its budget, its modes; what cannot be drawn is left out.
fn drawings(study: &Study, focus: &Focus, report: &SolveReport) -> (Markup, Markup, Markup) {
    let look = || figure::Look {
        look: Look {
            shown: vec![Noted::Names, Noted::Loads],
            ..Look::default()
        },
        ..figure::Look::default()
    };
    let path = Path::new(&report.name);
    let case = focus.asked.case.as_deref();
    let draw = |drawn: Result<Drawing, StudyError>| drawn.ok().map(|drawing| figure(&drawing));
    let deformed = draw(study.deformed(case, false, look()));
    let budget = draw(study.budget_figure(path, &focus.asked, None));
    let count = report.modes.as_ref().map_or(0, |found| found.modes.len());
    let modes = (1..=count).filter_map(|number| draw(study.mode(path, number, look())));
    let modes: Vec<Markup> = modes.collect();
    (
        deformed.unwrap_or_default(),
        budget.unwrap_or_default(),
        html! { @for mode in modes { (mode) } },
    )
}

fn counts(report: &SolveReport) -> Markup {
    let counts = [
        ("mobility", report.mobility),
        ("over-constraint", report.overconstraint),
        ("unknowns", report.unknowns),
        ("idle motions", report.idle_modes),
    ];
    html! {
        p { @for (k, (name, count)) in counts.iter().enumerate() { @if k > 0 { ", " } (name) " " (count) } "." }
    }
}

/// Of every case, where there are some.
fn displacements(report: &SolveReport) -> Markup {
    let base = std::iter::once(("", &report.output.displacement));
    let cases = report
        .cases
        .iter()
        .map(|(name, case)| (name, &case.output.displacement));
    let rows = base.chain(cases);
    let first = if report.cases.is_empty() { "" } else { "case" };
    sixes(
        first,
        DISPLACEMENT,
        rows.map(|(name, row)| (name.to_string(), Some(row))),
    )
}

fn sums(by: &str, budget: &BudgetReport, sums: &[Sum]) -> Markup {
    let (what, unit) = budget.quantity();
    let value = format!("{what} [{unit}]");
    let row = |sum: &Sum| Row {
        words: vec![sum.name.clone()],
        numbers: vec![Some(sum.displacement), sum.share.map(|share| 100.0 * share)],
        ..Row::default()
    };
    let rows: Vec<Row> = sums.iter().map(row).collect();
    table(&[by, &value, "share [%]"], &rows)
}

fn sensitive(sensitivities: &[SensitivityReport]) -> Markup {
    let told = &sensitivities[..sensitivities.len().min(PARAMETERS)];
    let row = |of: &SensitivityReport| Row {
        words: vec![match of.by_differences {
            true => format!("{} (by differences)", of.parameter),
            false => of.parameter.clone(),
        }],
        numbers: vec![Some(of.value), of.relative],
        ..Row::default()
    };
    let rows: Vec<Row> = told.iter().map(row).collect();
    html! {
        @if !rows.is_empty() {
            h3 { "What more of every parameter would change" }
            (table(&["parameter", "value (SI)", "% per % of it"], &rows))
            @if sensitivities.len() > told.len() {
                p { "And " (sensitivities.len() - told.len()) " that change less." }
            }
        }
    }
}

fn worst_points(bodies: &Entries<BodyReport>, under: &str) -> Markup {
    let rows = bodies.iter().filter_map(|(name, body)| {
        let worst = body.worst.as_ref()?;
        let [from, to] = &worst.segment;
        Some(Row {
            words: vec![name.into(), format!("{from}–{to}")],
            numbers: [worst.at, worst.normal, worst.shear, worst.von_mises]
                .map(Some)
                .into_iter()
                .chain([worst.utilisation])
                .collect(),
            ..Row::default()
        })
    });
    let rows: Vec<Row> = rows.collect();
    let heads = [
        "body",
        "segment",
        "at",
        "normal [Pa]",
        "shear [Pa]",
        "von Mises [Pa]",
        "utilisation",
    ];
    html! {
        @if !rows.is_empty() {
            h3 { "Worst points" (under) }
            (table(&heads, &rows))
        }
    }
}
