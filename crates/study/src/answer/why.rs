//! What is soft, and why: the compliance budget, the stiffness measures, and what more of every
//! parameter would change (`solve --why`).

use hyperstat_assembly::measures::Measures;
use hyperstat_assembly::{
    Budget, Configuration, Deformation, Influence, Model, Part, PartSource, Sensitivity, Solution,
    SolveError,
};
use hyperstat_mechanisms::Along;
use nalgebra::{Matrix6, Vector6};
use serde::{Deserialize, Serialize};

use super::misfits::{MisfitEffectReport, misfit_effects};
use super::numbers;
use super::sensitivities::SensitivityReport;
use crate::schema::DEFORMATIONS;
use crate::study::Study;

/// What is soft, and why. Field names are those of the JSON output; each is `null` where the output moves freely.
#[derive(Debug, Serialize)]
pub struct Why {
    /// Where the deflection comes from.
    pub budget: Option<BudgetReport>,
    /// Measures of the stiffness.
    pub measures: Option<MeasuresReport>,
    /// What 1 % more of every parameter changes, the largest first.
    pub sensitivities: Option<Vec<SensitivityReport>>,
    /// What a misfit of every joint would do.
    pub misfits: Option<Vec<MisfitEffectReport>>,
}

/// What is asked about.
#[derive(Debug, Clone)]
pub struct Asked {
    /// Name of the case whose solution it is; `None`: of the loads of no case.
    pub case: Option<String>,
    /// The direction that the output gives along.
    pub along: Along,
}

/// Where the displacement of the output, or its compliance, comes from.
#[derive(Debug, Serialize, Deserialize)]
pub struct BudgetReport {
    /// `displacement` under the loads, or `compliance` where there is none.
    pub of: String,
    /// The case under whose loads, where it is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub case: Option<String>,
    /// The unit wrench along which.
    pub along: [f64; 6],
    /// The whole \[m, rad; m/N, rad/(N·m)\].
    pub total: f64,
    /// What every body and joint gives by every kind of deformation.
    pub parts: Vec<PartReport>,
    /// The same by kinds of deformation.
    pub by_deformation: Vec<Sum>,
    /// The same by bodies and joints.
    pub by_part: Vec<Sum>,
    /// What no elastic part gives: misfits of rigid directions.
    pub rest: f64,
}

/// What a body or a joint gives by one kind of deformation.
#[derive(Debug, Serialize, Deserialize)]
pub struct PartReport {
    /// The body, where it is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// The joint, where it is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// The kind of deformation, in a word.
    pub deformation: String,
    /// What it gives, in the unit of the total.
    pub displacement: f64,
    /// Of the total; none of nothing.
    pub share: Option<f64>,
}

/// A sum of parts.
#[derive(Debug, Serialize, Deserialize)]
pub struct Sum {
    /// Of what.
    pub name: String,
    /// In the unit of the total.
    pub displacement: f64,
    /// Of the total; none of nothing.
    pub share: Option<f64>,
}

/// Measures of the stiffness of the output.
#[derive(Debug, Serialize)]
pub struct MeasuresReport {
    /// Principal compliances against a pure force \[m/N\].
    pub translational_compliances: PrincipalReport,
    /// Principal compliances against a pure moment \[rad/(N·m)\].
    pub rotational_compliances: PrincipalReport,
    /// Principal stiffnesses against a pure translation \[N/m\].
    pub translational_stiffnesses: PrincipalReport,
    /// Principal stiffnesses against a pure rotation \[N·m/rad\].
    pub rotational_stiffnesses: PrincipalReport,
    /// Length that rotations are taken times \[m\].
    pub characteristic_length: f64,
    /// Condition number of the stiffness so scaled.
    pub condition: f64,
    /// Eigenscrews of the stiffness.
    pub eigenscrews: Vec<ScrewReport>,
    /// \[m\], global.
    pub centre_of_stiffness: [f64; 3],
    /// \[m\], global.
    pub centre_of_compliance: [f64; 3],
    /// Virtual-work indices.
    pub virtual_work_index: VirtualWork,
}

/// Principal values and their directions.
#[derive(Debug, Serialize)]
pub struct PrincipalReport {
    /// Ascending.
    pub values: [f64; 3],
    /// Unit vectors, global.
    pub directions: [[f64; 3]; 3],
}

/// An eigenscrew of the stiffness.
#[derive(Debug, Serialize)]
pub struct ScrewReport {
    /// \[N\]
    pub eigenvalue: f64,
    /// Along its axis \[N/m\].
    pub stiffness: f64,
    /// \[m\]
    pub pitch: f64,
    /// Of its axis, global.
    pub direction: [f64; 3],
    /// On its axis \[m\], global.
    pub point: [f64; 3],
}

/// Virtual-work indices.
#[derive(Debug, Serialize)]
pub struct VirtualWork {
    /// Of unit forces \[J\].
    pub force: f64,
    /// Of unit moments \[J\].
    pub moment: f64,
}

/// The budget of the output of a solved mechanism; `None` where it moves freely.
pub fn budget(
    here: &Configuration<'_>,
    solution: &Solution,
    asked: &Asked,
) -> Result<Option<BudgetReport>, SolveError> {
    let inquiry = Inquiry::new(here.model(), solution, asked);
    let answer = |inquiry: Inquiry<'_>| Ok(inquiry.budget(&here.influence()?));
    inquiry.map(answer).transpose()
}

/// The same with the measures of the stiffness.
pub fn budget_and_measures(
    here: &Configuration<'_>,
    solution: &Solution,
    asked: &Asked,
) -> Result<(Option<BudgetReport>, Option<MeasuresReport>), SolveError> {
    let Some(inquiry) = Inquiry::new(here.model(), solution, asked) else {
        return Ok((None, None));
    };
    let measures = inquiry.measures.as_ref().map(MeasuresReport::new);
    Ok((Some(inquiry.budget(&here.influence()?)), measures))
}

/// The budget of a solution, of the model that the influence is of, in the way that its output moves, or the
/// softest one; `None` where it moves freely.
pub(crate) fn shares(
    model: &Model,
    influence: &Influence<'_>,
    solution: &Solution,
) -> Option<Budget> {
    let asked = Asked {
        case: None,
        along: Along::Displacement,
    };
    let inquiry = Inquiry::new(model, solution, &asked)?;
    Some(inquiry.found(influence).1)
}

/// What is asked about: an output that is held, and a direction.
pub struct Inquiry<'a> {
    pub model: &'a Model,
    pub case: Option<&'a str>,
    pub solution: &'a Solution,
    pub compliance: &'a Matrix6<f64>,
    pub measures: Option<Measures>,
    /// Whether the loads move the output.
    pub moved: bool,
    pub direction: Vector6<f64>,
}

impl<'a> Inquiry<'a> {
    fn new(model: &'a Model, solution: &'a Solution, asked: &'a Asked) -> Option<Self> {
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
            case: asked.case.as_deref(),
            solution,
            compliance,
            measures,
            moved: moved.is_some(),
            direction,
        })
    }

    /// What it is of, in a word, and the budget itself.
    fn found(&self, influence: &Influence<'_>) -> (&'static str, Budget) {
        if self.moved {
            (
                "displacement",
                influence.budget(self.solution, &self.direction),
            )
        } else {
            let budget = influence.compliance_budget(self.compliance, &self.direction);
            ("compliance", budget)
        }
    }

    fn budget(&self, influence: &Influence<'_>) -> BudgetReport {
        let (of, budget) = self.found(influence);
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
    pub fn new(study: &Study, solution: &Solution, asked: &Asked) -> Result<Self, SolveError> {
        let Some(inquiry) = Inquiry::new(study.model(), solution, asked) else {
            return Ok(Self {
                budget: None,
                measures: None,
                sensitivities: None,
                misfits: None,
            });
        };
        let here = study.here();
        let influence = here.influence()?;
        let relative = |s: &Sensitivity| inquiry.relative(s);
        let by = (asked.case.as_deref(), true);
        let sensitivities = SensitivityReport::all(study, &influence, solution, by, relative)?;
        Ok(Self {
            budget: Some(inquiry.budget(&influence)),
            measures: inquiry.measures.as_ref().map(MeasuresReport::new),
            sensitivities: Some(sensitivities),
            misfits: Some(misfit_effects(study, &influence, &inquiry.direction)),
        })
    }

    /// What the user should know about it.
    pub(super) fn remarks(&self) -> Vec<String> {
        let sensitivities = self.sensitivities.iter().flatten();
        sensitivities
            .filter_map(SensitivityReport::remark)
            .collect()
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
    pub fn turns(&self) -> bool {
        self.along[..3].iter().all(|c| *c == 0.0)
    }

    /// What the whole is, with its unit.
    pub fn quantity(&self) -> (&'static str, &'static str) {
        match (&*self.of, self.turns()) {
            ("compliance", false) => ("compliance", "m/N"),
            ("compliance", true) => ("compliance", "rad/(N·m)"),
            (_, false) => ("deflection", "m"),
            (_, true) => ("rotation", "rad"),
        }
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
}

/// A way to deform, in a word.
fn word(deformation: Deformation) -> &'static str {
    let mut known = DEFORMATIONS.iter();
    known
        .find(|(own, _)| *own == deformation)
        .map_or("other", |(_, word)| *word)
}
