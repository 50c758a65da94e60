//! What is soft, and why: the compliance budget, the stiffness measures, and what more of every
//! parameter would change (`solve --why`).

use std::fmt::Write as _;

use hyperstat_assembly::measures::Measures;
use hyperstat_assembly::{
    Budget, Configuration, Deformation, Influence, Model, Part, PartSource, Sensitivity, Solution,
    SolveError,
};
use hyperstat_mechanisms::Along;
use nalgebra::{Matrix6, Vector6};
use serde::{Deserialize, Serialize};

use super::misfits::{MisfitEffectReport, misfit_effects, write_misfit_effects};
use super::sensitivities::SensitivityReport;
use super::table::left;
use super::{Table, number, numbers, section};
use crate::case::Case;

/// Parts that the text tells; JSON has all.
const TOLD: usize = 15;
/// Width of a bar of 100 %.
const WIDTH: f64 = 40.0;

/// Field names are those of the JSON output; each is `null` where the output moves freely.
#[derive(Debug, Serialize)]
pub(crate) struct Why {
    budget: Option<BudgetReport>,
    measures: Option<MeasuresReport>,
    sensitivities: Option<Vec<SensitivityReport>>,
    misfits: Option<Vec<MisfitEffectReport>>,
}

/// What is asked about.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Asked<'a> {
    /// Name of the case whose solution it is; `None`: of the loads of no case.
    pub(crate) case: Option<&'a str>,
    pub(crate) along: Along,
}

/// Where the displacement of the output, or its compliance, comes from.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct BudgetReport {
    /// `displacement` under the loads, or `compliance` where there is none.
    pub(crate) of: String,
    /// The case under whose loads, where it is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) case: Option<String>,
    /// The unit wrench along which.
    pub(crate) along: [f64; 6],
    pub(crate) total: f64,
    pub(crate) parts: Vec<PartReport>,
    pub(crate) by_deformation: Vec<Sum>,
    pub(crate) by_part: Vec<Sum>,
    pub(crate) rest: f64,
}

/// What a body or a joint gives by one kind of deformation.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct PartReport {
    #[serde(skip_serializing_if = "Option::is_none")]
    body: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    joint: Option<String>,
    deformation: String,
    displacement: f64,
    share: Option<f64>,
}

/// A sum of parts.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Sum {
    pub(crate) name: String,
    pub(crate) displacement: f64,
    pub(crate) share: Option<f64>,
}

#[derive(Debug, Serialize)]
struct MeasuresReport {
    translational_compliances: PrincipalReport,
    rotational_compliances: PrincipalReport,
    translational_stiffnesses: PrincipalReport,
    rotational_stiffnesses: PrincipalReport,
    characteristic_length: f64,
    condition: f64,
    eigenscrews: Vec<ScrewReport>,
    centre_of_stiffness: [f64; 3],
    centre_of_compliance: [f64; 3],
    virtual_work_index: VirtualWork,
}

#[derive(Debug, Serialize)]
struct PrincipalReport {
    values: [f64; 3],
    directions: [[f64; 3]; 3],
}

#[derive(Debug, Serialize)]
struct ScrewReport {
    eigenvalue: f64,
    stiffness: f64,
    pitch: f64,
    direction: [f64; 3],
    point: [f64; 3],
}

#[derive(Debug, Serialize)]
struct VirtualWork {
    force: f64,
    moment: f64,
}

/// The budget of the output of a solved mechanism; `None` where it moves freely.
pub(crate) fn budget(
    here: &Configuration<'_>,
    solution: &Solution,
    asked: Asked<'_>,
) -> Result<Option<BudgetReport>, SolveError> {
    let question = Question::new(here.model(), solution, asked);
    let answer = |question: Question<'_>| Ok(question.budget(&here.influence()?));
    question.map(answer).transpose()
}

/// What is asked about: an output that is held, and a direction.
struct Question<'a> {
    model: &'a Model,
    case: Option<&'a str>,
    solution: &'a Solution,
    compliance: &'a Matrix6<f64>,
    measures: Option<Measures>,
    /// Whether the loads move the output.
    moved: bool,
    direction: Vector6<f64>,
}

impl<'a> Question<'a> {
    fn new(model: &'a Model, solution: &'a Solution, asked: Asked<'a>) -> Option<Self> {
        let output = &solution.output;
        let compliance = output.compliance.as_ref()?;
        let reference = model
            .output()
            .map(|node| model.geometry().positions[node.0]);
        let measures = output.stiffness.as_ref().zip(reference);
        let measures = measures.and_then(|(k, at)| Measures::new(k, compliance, &at, None));
        let moved = Budget::direction_of(&output.displacement);
        let direction = match asked.along {
            Along::Wrench(wrench) => Vector6::from(wrench),
            Along::Displacement => moved.unwrap_or_else(|| {
                // Without loads: where a force moves the output most.
                let softest = measures
                    .as_ref()
                    .map(|m| m.translational_compliances.directions[2]);
                softest.map_or(Vector6::ith(2, 1.0), |e| {
                    Vector6::new(e[0], e[1], e[2], 0.0, 0.0, 0.0)
                })
            }),
        };
        Some(Self {
            model,
            case: asked.case,
            solution,
            compliance,
            measures,
            moved: moved.is_some(),
            direction,
        })
    }

    fn budget(&self, influence: &Influence<'_>) -> BudgetReport {
        let (of, budget) = if self.moved {
            let budget = influence.budget(self.solution, &self.direction);
            ("displacement", budget)
        } else {
            let budget = influence.compliance_budget(self.compliance, &self.direction);
            ("compliance", budget)
        };
        BudgetReport {
            case: self.case.map(Into::into),
            ..BudgetReport::new(self.model, of, &budget)
        }
    }

    /// Relative change of what is asked about per relative change of a parameter.
    fn relative(&self, sensitivity: &Sensitivity) -> Option<f64> {
        let displacement = &self.solution.output.displacement;
        match self.moved {
            true => sensitivity.relative(displacement, &self.direction),
            false => sensitivity.relative_compliance(self.compliance, &self.direction),
        }
    }
}

impl Why {
    /// Finds out why the output of a solved mechanism gives along a direction.
    pub(crate) fn new(
        case: &Case,
        solution: &Solution,
        asked: Asked<'_>,
    ) -> Result<Self, SolveError> {
        let Some(question) = Question::new(case.model(), solution, asked) else {
            return Ok(Self {
                budget: None,
                measures: None,
                sensitivities: None,
                misfits: None,
            });
        };
        let influence = case.here().influence()?;
        let relative = |s: &Sensitivity| question.relative(s);
        let sensitivities = SensitivityReport::all(case, &influence, solution, relative)?;
        Ok(Self {
            budget: Some(question.budget(&influence)),
            measures: question.measures.as_ref().map(MeasuresReport::new),
            sensitivities: Some(sensitivities),
            misfits: Some(misfit_effects(case, &influence, &question.direction)),
        })
    }

    /// What the user should know about it.
    pub(super) fn remarks(&self) -> Vec<String> {
        let sensitivities = self.sensitivities.iter().flatten();
        sensitivities
            .filter_map(SensitivityReport::remark)
            .collect()
    }

    /// Writes it as tables, the largest first.
    pub(super) fn write(&self, text: &mut String) {
        let Some(budget) = &self.budget else {
            section(
                text,
                "What is soft, and why",
                "  The output moves freely: nothing elastic holds it there.\n",
            );
            return;
        };
        budget.write(text);
        if let Some(sensitivities) = &self.sensitivities {
            let (what, _) = budget.quantity();
            SensitivityReport::write(sensitivities, what, text);
        }
        if let Some(misfits) = &self.misfits {
            write_misfit_effects(misfits, budget.turns(), text);
        }
        if let Some(measures) = &self.measures {
            measures.write(text);
        }
    }
}

impl BudgetReport {
    fn new(model: &Model, of: &str, budget: &Budget) -> Self {
        let name = |source: PartSource| match source {
            PartSource::Body(id) => (Some(model.bodies()[id.0].name.clone()), None),
            PartSource::Joint(id) => (None, Some(model.joints()[id.0].name.clone())),
        };
        let part = |part: &Part| {
            let (body, joint) = name(part.source);
            PartReport {
                body,
                joint,
                deformation: word(part.deformation).into(),
                displacement: part.displacement,
                share: part.share,
            }
        };
        let sum = |name: String, displacement: f64| Sum {
            name,
            displacement,
            share: (budget.total != 0.0).then(|| displacement / budget.total),
        };
        let by_part = budget
            .by_source()
            .into_iter()
            .map(|(source, displacement)| {
                let (body, joint) = name(source);
                let joint = joint.map(|joint| format!("joint {joint}"));
                sum(body.or(joint).unwrap_or_default(), displacement)
            });
        let by_deformation = budget.by_deformation().into_iter();
        Self {
            of: of.into(),
            case: None,
            along: numbers(&budget.along),
            total: budget.total,
            parts: budget.parts.iter().map(part).collect(),
            by_deformation: by_deformation
                .map(|(deformation, displacement)| sum(word(deformation).into(), displacement))
                .collect(),
            by_part: by_part.collect(),
            rest: budget.rest,
        }
    }

    /// Whether it is a rotation that is asked about.
    pub(crate) fn turns(&self) -> bool {
        self.along[..3].iter().all(|c| *c == 0.0)
    }

    /// What the whole is, with its unit.
    pub(crate) fn quantity(&self) -> (&'static str, &'static str) {
        match (&*self.of, self.turns()) {
            ("compliance", false) => ("compliance", "m/N"),
            ("compliance", true) => ("compliance", "rad/(N·m)"),
            (_, false) => ("deflection", "m"),
            (_, true) => ("rotation", "rad"),
        }
    }

    fn write(&self, text: &mut String) {
        let part = if self.turns() {
            &self.along[3..]
        } else {
            &self.along[..3]
        };
        let part: Vec<_> = part.iter().map(|c| number(*c)).collect();
        let (what, unit) = self.quantity();
        let about = if self.turns() { "about" } else { "along" };
        let under = self.case.as_ref().map_or_else(
            || "The".into(),
            |case| format!("Under the loads of case `{case}` the"),
        );
        let mut body = format!(
            "  {under} output has a {what} of {} {unit} {about} ({}). It comes from\n",
            number(self.total),
            part.join(", ")
        );
        bars(&mut body, &self.by_deformation, unit);
        body += "  and, by bodies and joints, from\n";
        bars(&mut body, &self.by_part, unit);
        section(text, "What is soft, and why", body);
    }
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

impl MeasuresReport {
    fn new(measures: &Measures) -> Self {
        let principal = |p: &hyperstat_assembly::measures::Principal| PrincipalReport {
            values: p.values,
            directions: p.directions.map(Into::into),
        };
        Self {
            translational_compliances: principal(&measures.translational_compliances),
            rotational_compliances: principal(&measures.rotational_compliances),
            translational_stiffnesses: principal(&measures.translational_stiffnesses),
            rotational_stiffnesses: principal(&measures.rotational_stiffnesses),
            characteristic_length: measures.characteristic_length,
            condition: measures.condition,
            eigenscrews: (measures.eigenscrews.iter())
                .map(|screw| ScrewReport {
                    eigenvalue: screw.eigenvalue,
                    stiffness: screw.stiffness,
                    pitch: screw.pitch,
                    direction: screw.direction.into(),
                    point: screw.point.into(),
                })
                .collect(),
            centre_of_stiffness: measures.centre_of_stiffness.into(),
            centre_of_compliance: measures.centre_of_compliance.into(),
            virtual_work_index: VirtualWork {
                force: measures.force_work,
                moment: measures.moment_work,
            },
        }
    }

    fn write(&self, text: &mut String) {
        let mut table = Table::new(1, &["", "value", "x", "y", "z"]);
        let principals = [
            (
                "compliance, pure force [m/N]",
                &self.translational_compliances,
            ),
            (
                "compliance, pure moment [rad/(N·m)]",
                &self.rotational_compliances,
            ),
            (
                "stiffness, pure translation [N/m]",
                &self.translational_stiffnesses,
            ),
            (
                "stiffness, pure rotation [N·m/rad]",
                &self.rotational_stiffnesses,
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
        for screw in &self.eigenscrews {
            let first = [screw.eigenvalue, screw.stiffness, screw.pitch];
            let places = screw
                .direction
                .map(|c| clean(c, 1.0))
                .into_iter()
                .chain(screw.point.map(|c| clean(c, self.characteristic_length)));
            table.row(&[], first.into_iter().chain(places));
        }
        section(text, "Eigenscrews of the stiffness", table);
        let point = |p: [f64; 3]| {
            p.map(|c| number(clean(c, self.characteristic_length)))
                .join(", ")
        };
        let body = format!(
            "  centre of stiffness   ({}) m\n  centre of compliance  ({}) m\n  \
             condition number      {} with rotations times {} m\n  \
             virtual-work index    {} J for 1 N, {} J for 1 N·m\n",
            point(self.centre_of_stiffness),
            point(self.centre_of_compliance),
            number(self.condition),
            number(self.characteristic_length),
            number(self.virtual_work_index.force),
            number(self.virtual_work_index.moment),
        );
        section(text, "Centres and indices", body);
    }
}

/// What is rounding beside this size, shown as 0.
fn clean(component: f64, size: f64) -> f64 {
    if component.abs() < 1e-12 * size {
        0.0
    } else {
        component
    }
}

/// A way to deform, in a word.
fn word(deformation: Deformation) -> &'static str {
    match deformation {
        Deformation::Bending => "bending",
        Deformation::Shear => "shear",
        Deformation::Torsion => "torsion",
        Deformation::Tension => "tension",
        Deformation::FreeStrain => "free strain",
        Deformation::Flexible => "flexible body",
        Deformation::Bearing => "joint bearing",
        Deformation::Drive => "drive",
        Deformation::Misfit => "misfit",
        _ => "other",
    }
}
