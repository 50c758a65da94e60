//! The rigid joint is the limit of the stiff one, for every kind of joint, between bodies and to the
//! ground.
//!
//! Where a joint gives `1/(k a)` along every direction that it constrains, the output's compliance is
//!
//! ```text
//! C(k) = C∞ + Wᵀ (k a + S)⁻¹ W,     0 ≤ C(k) − C∞ ≤ Wᵀ a⁻¹ W / k
//! ```
//!
//! with `C∞` that of the rigid joint, `W` the forces along those directions of the rigid joint under
//! unit wrenches on the output, `a` 1 for a force and about a squared thickness for a moment, so that
//! neither hides the other, and `S` the stiffness that the rest of the mechanism has between the
//! joint's two sides (by Castigliano's theorem; S is positive semidefinite). So from 1e6 on the
//! difference is within these bounds, from 1e12 on, where the joint is a thousand times stiffer than
//! all around it, it is `Wᵀ a⁻¹ W / k`, and from where that is below rounding on it stays there.

use hyperstat_assembly::{
    Floor, JointStiffness, LANES, LoadSet, Model, NodeId, Prepared, Solution,
};
use hyperstat_joints::{
    Cylindrical, Dof, DofSet, Fixed, Joint, Planar, Prismatic, Revolute, Screw, Spherical,
    Universal, frame_from_axes, frame_from_axis,
};
use hyperstat_tests::agreement::{compliances_agree, stiffnesses_agree};
use hyperstat_tests::build::{circle, connection, node, steel, weld_to_ground};
use hyperstat_tests::runner::check_all;
use hyperstat_tests::stiffness_difference;
use nalgebra::{DMatrix, Matrix6, Point3, Rotation3, SymmetricEigen, Vector3, Vector6};
use proptest::prelude::*;

/// Random mechanisms of each kind of joint, between bodies and to the ground.
const CASES: u32 = 12;

/// Rounding, relative to √(C_ii C_jj): doubles times the conditioning of members that are 1e4 times
/// stiffer along than across (as in `properties.rs`).
const ROUNDING: f64 = 1e-11;

/// Share of `Wᵀ a⁻¹ W/k` that is left out from k = 1e12 on, S/(k a): the members here are softer than
/// 1e9 N/m and 1e5 N·m/rad.
const LEFT_OUT: f64 = 1e-2;

/// Stiffnesses of the joint [N/m], as powers of ten.
const EXPONENTS: std::ops::RangeInclusive<i32> = 6..=18;
/// From here on the difference is known.
const KNOWN: i32 = 12;

/// A joint between two beams, or a beam and a rigid body, or a beam and the ground; the last body
/// ends in a bushing on the ground, so that whatever the joint leaves free is held.
#[derive(Debug, Clone)]
struct Case {
    /// Where the first body is not the ground: whether it, and whether the second is rigid.
    rigid: [bool; 2],
    /// Whether the joint stands inside the first and the second body, not at an end.
    inside: [bool; 2],
    swapped: bool,
    axes: [[f64; 3]; 2],
    pitch: f64,
    /// Of the free directions those that are locked, and whether these become as stiff.
    locked: u8,
    drives_give: bool,
    /// Decades from a stiffness against forces to those against moments, about x, y and z.
    turning: [f64; 3],
    /// The free directions' own springs [decades].
    springs: Option<f64>,
    /// Points along the way, each from the last.
    steps: [[f64; 3]; 4],
    diameters: [f64; 2],
    elements: usize,
    bushing: f64,
}

fn cases() -> impl Strategy<Value = Case> {
    let direction = || {
        prop_oneof![
            Just([1.0, 0.0, 0.0]),
            Just([0.0, 1.0, 0.0]),
            Just([0.0, 0.0, 1.0]),
            [-1.0..1.0, -1.0..1.0, 0.1..1.0],
        ]
    };
    let bodies = prop_oneof![
        2 => Just([false, false]),
        1 => Just([true, false]),
        1 => Just([false, true]),
    ];
    let step = || [0.05..0.3, -0.2..0.2, -0.2..0.2];
    let joint = (any::<bool>(), [direction(), direction()], -0.02..0.02);
    let free = (
        prop_oneof![Just(0_u8), any::<u8>()],
        any::<bool>(),
        [-4.0..-2.0, -4.0..-2.0, -4.0..-2.0],
        proptest::option::of(3.0..6.0),
    );
    let links = (
        [step(), step(), step(), step()],
        [0.01..0.03, 0.01..0.03],
        1_usize..4,
        5.0..7.0,
    );
    (bodies, any::<[bool; 2]>(), joint, free, links).prop_map(
        |(
            rigid,
            inside,
            (swapped, axes, pitch),
            (locked, drives_give, turning, springs),
            links,
        )| Case {
            rigid,
            inside,
            swapped,
            axes,
            pitch,
            locked,
            drives_give,
            turning,
            springs,
            steps: links.0,
            diameters: links.1,
            elements: links.2,
            bushing: links.3,
        },
    )
}

/// The kinds of joints, by number.
fn joint(kind: usize, case: &Case) -> Option<(Box<dyn Joint>, Rotation3<f64>)> {
    let [first, second] = case.axes.map(Vector3::from);
    let frame = match kind {
        5 => frame_from_axes(&first, &second),
        _ => frame_from_axis(Some(&first), None),
    };
    let joint: Box<dyn Joint> = match kind {
        0 => Box::new(Fixed),
        1 => Box::new(Revolute),
        2 => Box::new(Prismatic),
        3 => Box::new(Cylindrical),
        4 => Box::new(Screw::new(case.pitch).ok()?),
        5 => Box::new(Universal),
        6 => Box::new(Spherical),
        _ => Box::new(Planar),
    };
    Some((joint, frame.ok()?))
}

/// The directions that become stiff.
fn constrained(joint: &dyn Joint, case: &Case) -> DofSet {
    let held = joint.free().complement();
    match case.drives_give {
        true => held.union(locked(joint, case)),
        false => held,
    }
}

fn locked(joint: &dyn Joint, case: &Case) -> DofSet {
    let chosen = |d: &Dof| case.locked & (1 << d.index()) != 0;
    joint.free().iter().filter(chosen).collect()
}

/// The factor a of a direction.
fn share(case: &Case, dof: Dof) -> f64 {
    let turning = dof.index().checked_sub(3);
    turning.map_or(1.0, |about| 10.0_f64.powf(case.turning[about]))
}

/// The mechanism with the joint `k` stiff, or rigid; the joint under test is its first.
fn model(kind: usize, grounded: bool, case: &Case, k: Option<f64>) -> Option<Model> {
    let mut model = Model::new("limit");
    let mut at = Point3::new(0.1, -0.2, 0.3);
    let mut points = vec![at];
    for step in case.steps {
        at += Vector3::from(step);
        points.push(at);
    }
    // A – J … B on the first body, J … C – D on the second; J is their common point.
    let joint_at = points[2];
    let mut add = |name: &str, rigid: bool, points: &[(&str, Point3<f64>)], diameter: f64| {
        let section = circle(diameter);
        match rigid {
            true => model.add_rigid(name, points).map(drop),
            false => model
                .add_beam(name, points, &steel(), &section, None, case.elements)
                .map(drop),
        }
    };
    if !grounded {
        let mut way = vec![("A", points[0]), ("J", joint_at)];
        if case.inside[0] {
            way.push(("B", joint_at + Vector3::new(0.1, 0.1, 0.05)));
        }
        add("first", case.rigid[0], &way, case.diameters[0]).ok()?;
    }
    let mut way = vec![("J", joint_at), ("C", points[3]), ("D", points[4])];
    if case.inside[1] {
        way.insert(0, ("E", points[1]));
    }
    let rigid = case.rigid[1] && !grounded;
    add("second", rigid, &way, case.diameters[1]).ok()?;

    let (kind, frame) = joint(kind, case)?;
    let (locked, stiff) = (
        locked(kind.as_ref(), case),
        constrained(kind.as_ref(), case),
    );
    let values = Dof::ALL.map(|d| {
        let spring = || case.springs.map(|e| 10.0_f64.powf(e));
        match (stiff.contains(d), kind.free().contains(d)) {
            (true, _) => k.map(|k| k * share(case, d)),
            (false, true) if !locked.contains(d) => spring(),
            _ => None,
        }
    });
    let first = (!grounded).then(|| node(&model, "first", "J"));
    let mut between = [first, Some(node(&model, "second", "J"))];
    if case.swapped {
        between.swap(0, 1);
    }
    let mut under_test = connection("under test", between, Fixed);
    under_test.joint = kind;
    under_test.locked = locked;
    under_test.stiffness = JointStiffness::Directions(values);
    model.add_joint(under_test, frame).ok()?;
    if !grounded {
        weld_to_ground(&mut model, "first", "A");
    }
    let mut bushing = connection("bushing", [None, Some(node(&model, "second", "D"))], Fixed);
    let [soft, turning] = [case.bushing, case.bushing - 2.0].map(|e| 10.0_f64.powf(e));
    bushing.stiffness =
        JointStiffness::Directions([soft, soft, soft, turning, turning, turning].map(Some));
    model.add_joint(bushing, Rotation3::identity()).ok()?;
    model.set_output(node(&model, "second", "C"));
    Some(model)
}

/// Forces of the rigid joint along the directions that become stiff, over √a, by columns under the
/// unit wrenches on the output.
fn forces(model: &Model, case: &Case, stiff: DofSet, output: NodeId) -> DMatrix<f64> {
    let basis = model.joints()[0].joint.basis();
    let units = [0, 1, 2, 3, 4, 5].map(|k| LoadSet::on(output, Vector6::ith(k, 1.0)));
    let prepared = Prepared::new(model.clone());
    let states = prepared.here().respond(&units).expect("solved");
    let mut forces = DMatrix::zeros(stiff.len(), 6);
    for (column, state) in states.iter().enumerate() {
        let wrench = state.joint_wrenches[0].expect("determined");
        let along = basis.transpose() * wrench;
        for (row, dof) in stiff.iter().enumerate() {
            forces[(row, column)] = along[dof.index()] / share(case, dof).sqrt();
        }
    }
    forces
}

fn solved(model: &Model) -> Result<(Solution, Matrix6<f64>, Matrix6<f64>), TestCaseError> {
    let solution = hyperstat_assembly::solve(model);
    let solution = solution.map_err(|error| TestCaseError::fail(error.to_string()))?;
    let (Some(stiffness), Some(compliance)) =
        (solution.output.stiffness, solution.output.compliance)
    else {
        return Err(TestCaseError::fail("an output that is held and can move"));
    };
    Ok((solution, stiffness, compliance))
}

/// The sweep's two ways through give the same stiffness.
fn swept(model: &Model, stiffness: &Matrix6<f64>) -> Result<(), TestCaseError> {
    let prepared = Prepared::new(model.clone());
    let planned = prepared.unknowns();
    planned.map_err(|error| TestCaseError::fail(error.to_string()))?;
    let one = prepared.sweep(model.geometry(), &mut prepared.workspace().expect("a plan"));
    let mut filled = [false; LANES];
    filled[0] = true;
    let lane = prepared.sweep_lanes(&mut prepared.lanes().expect("a plan"), filled)[0].take();
    for (way, found) in [("one by one", Some(one)), ("lanes", lane)] {
        let Some(found) = found else { continue };
        let found = found.map_err(|error| TestCaseError::fail(error.to_string()))?;
        let difference = stiffness_difference(&found.stiffness.expect("a stiffness"), stiffness);
        prop_assert!(difference < ROUNDING, "swept, {way}: {difference:e}");
    }
    Ok(())
}

fn largest(matrix: &Matrix6<f64>) -> f64 {
    SymmetricEigen::new(*matrix).eigenvalues.amax()
}

fn least(matrix: &Matrix6<f64>) -> f64 {
    SymmetricEigen::new(*matrix).eigenvalues.min()
}

fn tends_to_rigid(kind: usize, grounded: bool, case: &Case) -> Result<bool, TestCaseError> {
    let Some(rigid) = model(kind, grounded, case, None) else {
        return Ok(false);
    };
    let stiff = constrained(rigid.joints()[0].joint.as_ref(), case);
    let output = rigid.output().expect("an output");
    let (_, limit_k, limit_c) = solved(&rigid)?;
    swept(&rigid, &limit_k)?;
    let theirs = hyperstat_reference::solve(&rigid);
    let theirs = theirs.map_err(|error| TestCaseError::fail(error.to_string()))?;
    let floor = Floor::of(&rigid).map_err(|error| TestCaseError::fail(error.to_string()))?;
    compliances_agree(Some(&limit_c), theirs.compliance.as_ref(), &floor)?;
    stiffnesses_agree(Some(&limit_k), theirs.stiffness.as_ref(), &floor)?;

    let forces = forces(&rigid, case, stiff, output);
    let give = forces.transpose() * &forces;
    let give = Matrix6::from_fn(|r, c| give[(r, c)]);
    let scale_c = limit_c.diagonal().map(f64::sqrt);
    let scale_k = limit_k.diagonal().map(f64::sqrt);
    let unit =
        |m: Matrix6<f64>, s: &Vector6<f64>| Matrix6::from_fn(|r, c| m[(r, c)] / (s[r] * s[c]));
    for exponent in EXPONENTS {
        let k = 10.0_f64.powi(exponent);
        let Some(model) = model(kind, grounded, case, Some(k)) else {
            return Err(TestCaseError::fail("only the rigid joint was taken"));
        };
        let (solution, stiffness, compliance) = solved(&model)?;
        prop_assert!(
            solution.warnings.is_empty(),
            "1e{exponent}: {:?}",
            solution.warnings
        );
        swept(&model, &stiffness)?;
        let difference = unit(compliance - limit_c, &scale_c);
        let most = unit(give / k, &scale_c);
        let rest = most - difference;
        let rounding = ROUNDING * (1.0 + largest(&difference));
        prop_assert!(
            least(&difference) > -rounding,
            "1e{exponent}: {:e}",
            least(&difference)
        );
        prop_assert!(
            least(&rest) > -rounding,
            "1e{exponent}: over by {:e}",
            -least(&rest)
        );
        if exponent < KNOWN {
            continue;
        }
        let (off, of) = (largest(&rest), largest(&most));
        prop_assert!(
            off < LEFT_OUT * of + rounding,
            "1e{exponent}: C {off:e} of {of:e}"
        );
        let softer = unit(limit_k * (give / k) * limit_k, &scale_k);
        let off = unit(limit_k - stiffness, &scale_k) - softer;
        let (off, of) = (largest(&off), largest(&softer));
        prop_assert!(
            off < LEFT_OUT * of + rounding,
            "1e{exponent}: K {off:e} of {of:e}"
        );
    }
    Ok(true)
}

fn every_kind(grounded: bool) {
    for kind in 0..8 {
        let checked = check_all(CASES, cases(), |case| tends_to_rigid(kind, grounded, &case));
        assert!(checked > CASES / 2, "kind {kind}: {checked} cases");
    }
}

#[test]
fn stiff_joints_between_bodies_tend_to_rigid_ones() {
    every_kind(false);
}

#[test]
fn stiff_joints_to_the_ground_tend_to_rigid_ones() {
    every_kind(true);
}
