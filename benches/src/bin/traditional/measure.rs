//! What is measured: the error and the time of every method at every joint stiffness.

use std::time::{Duration, Instant};

use hyperstat_assembly::{Connection, JointStiffness, Model, Prepared};
use hyperstat_benches::POSE;
use hyperstat_mechanisms::prebuilt::{Delta, Prebuilt, SingleFreedom};
use hyperstat_reference::{ReferenceError, TraditionalForm, TraditionalOptions, traditional};
use hyperstat_tests::{rebuilt, stiffness, stiffness_difference};
use nalgebra::Matrix6;

/// Exponents of the joint stiffness: 10³ … 10¹⁸ N/m and N·m/rad.
const EXPONENTS: std::ops::RangeInclusive<i32> = 3..=18;

/// Stiffness that Deblaise et al. gave to free rotations \[N·m/rad\].
const FREE_STIFFNESS: f64 = 1e-7;

/// Every time is the shortest of so many runs.
const RUNS: usize = 50;

/// A case study at all joint stiffnesses.
pub struct Case {
    pub name: &'static str,
    /// Equations of the traditional method: displacements of all nodes, and multipliers of rigid
    /// bodies.
    pub equations: usize,
    /// Equations of its form with multipliers for the joints too.
    pub lagrange_equations: usize,
    /// Independent coordinates of this method.
    pub unknowns: usize,
    pub rows: Vec<Row>,
}

/// All methods at one joint stiffness.
pub struct Row {
    /// 10 to this power is the joints' stiffness.
    pub exponent: i32,
    /// Free directions with the stiffness 0.
    pub traditional: Option<Errors>,
    /// Free directions with 1e-7 N·m/rad; the same as above where no direction is free.
    pub traditional_not_free: Option<Errors>,
    pub traditional_time: Duration,
    /// The joints' wrenches as multipliers, K_J inverted; free directions with 1e-7 N·m/rad.
    pub lagrange: Option<Errors>,
    pub lagrange_time: Duration,
    /// This method, against the same springs.
    pub ours: f64,
    /// [`hyperstat_assembly::solve`].
    pub solve_time: Duration,
    /// [`Prepared::sweep`] with a plan that is there already.
    pub pose_time: Duration,
}

/// Relative errors of the output's stiffness.
#[derive(Clone, Copy)]
pub struct Errors {
    /// Against the exact stiffness with the same springs: what is lost in rounding.
    pub same_springs: f64,
    /// Against the exact stiffness with rigid joints: what springs in place of rigid joints cost.
    pub rigid_joints: f64,
}

/// Case study 1, every joint a spring, those at A and D too. Exact is its closed form: beams and
/// springs in line (Eqs. 53–55).
pub fn single_freedom() -> Case {
    let structure = SingleFreedom::paper();
    let model = structure.model(&[]).expect("the paper's structure");
    let young = structure.material.young();
    let beams = [
        young * structure.sections.0.area() / structure.lengths.0,
        young * structure.sections.1.area() / structure.lengths.1,
    ];
    let closed_form = |joint: f64| {
        let arm = |beam: f64| 1.0 / (1.0 / beam + 2.0 / joint);
        Matrix6::identity() * (arm(beams[0]) + arm(beams[1]))
    };
    let springs = |k: f64| {
        rebuilt(&model, |_, joint| Connection {
            stiffness: JointStiffness::Directions([Some(k), None, None, None, None, None]),
            ..joint.clone()
        })
    };
    let along_x = |found: &Matrix6<f64>, exact: &Matrix6<f64>| {
        (found[(0, 0)] - exact[(0, 0)]).abs() / exact[(0, 0)]
    };
    case(
        "Case study 1: one degree of freedom",
        springs,
        |k, _| closed_form(k),
        closed_form(f64::INFINITY),
        along_x,
    )
}

/// Case study 2, the delta at one pose, every joint a spring, the drives too. Exact is the dense
/// reference solver, which keeps its digits at every stiffness.
pub fn delta() -> Case {
    let springs = |k: f64| {
        let delta = Delta {
            joint_stiffness: [Some(k), Some(k), Some(k), Some(k), None, Some(k)],
            drive_stiffness: Some(k),
            ..Delta::paper()
        };
        delta.model(&POSE).expect("a pose within reach")
    };
    let rigid = Delta::paper().model(&POSE).expect("a pose within reach");
    case(
        "Case study 2: the delta",
        springs,
        |_, model| reference(model),
        reference(&rigid),
        stiffness_difference,
    )
}

fn reference(model: &Model) -> Matrix6<f64> {
    let solution = hyperstat_reference::solve(model).expect("a mechanism that is held");
    solution.stiffness.expect("an output that can move")
}

/// Measures a case study: its model with springs, the exact output stiffness for them and for
/// rigid joints, and how two output stiffnesses are compared.
fn case(
    name: &'static str,
    springs: impl Fn(f64) -> Model,
    exact: impl Fn(f64, &Model) -> Matrix6<f64>,
    rigid_joints: Matrix6<f64>,
    difference: impl Fn(&Matrix6<f64>, &Matrix6<f64>) -> f64,
) -> Case {
    let mut unknowns = 0;
    let mut equations = [0; 2];
    let rows = EXPONENTS.map(|exponent| {
        let k = 10.0_f64.powi(exponent);
        let model = springs(k);
        let same_springs = exact(k, &model);
        let by_springs = |form: TraditionalForm, free_stiffness: f64| {
            let options = TraditionalOptions {
                form,
                joint_stiffness: k,
                angular_stiffness: k,
                free_stiffness,
            };
            traditional(&model, &options)
        };
        let mut errors = |form, free_stiffness: f64| match by_springs(form, free_stiffness) {
            Ok(found) => {
                equations[form as usize] = found.equations;
                Some(Errors {
                    same_springs: difference(&found.stiffness, &same_springs),
                    rigid_joints: difference(&found.stiffness, &rigid_joints),
                })
            }
            Err(ReferenceError::Singular) => None,
            Err(error) => panic!("{name}, 1e{exponent}: {error}"),
        };
        let solution = hyperstat_assembly::solve(&model).expect("a mechanism that is held");
        unknowns = solution.unknowns;
        let prepared = Prepared::new(model.clone());
        let mut workspace = prepared.workspace().expect("a plan");
        Row {
            exponent,
            traditional: errors(TraditionalForm::Penalty, 0.0),
            traditional_not_free: errors(TraditionalForm::Penalty, FREE_STIFFNESS),
            traditional_time: shortest(|| by_springs(TraditionalForm::Penalty, 0.0)),
            lagrange: errors(TraditionalForm::Lagrange, FREE_STIFFNESS),
            lagrange_time: shortest(|| by_springs(TraditionalForm::Lagrange, FREE_STIFFNESS)),
            ours: difference(&stiffness(&solution), &same_springs),
            solve_time: shortest(|| hyperstat_assembly::solve(&model)),
            pose_time: shortest(|| prepared.sweep(model.geometry(), &mut workspace)),
        }
    });
    Case {
        name,
        rows: rows.collect(),
        equations: equations[TraditionalForm::Penalty as usize],
        lagrange_equations: equations[TraditionalForm::Lagrange as usize],
        unknowns,
    }
}

/// The shortest time of several runs.
fn shortest<T>(mut run: impl FnMut() -> T) -> Duration {
    let times = (0..RUNS).map(|_| {
        let start = Instant::now();
        std::hint::black_box(run());
        start.elapsed()
    });
    times.min().unwrap_or_default()
}
