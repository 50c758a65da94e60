//! What joints and segments carry, and budgets, as the lanes find them: those of a full solution of each
//! pose, over all prebuilt mechanisms.

use std::path::Path;

use hyperstat_assembly::{
    Beside, Budget, Carried, Forces, Geometry, LANES, Lanes, LoadSet, Model, Part, Prepared,
    SegmentForces,
};
use hyperstat_mechanisms::{Disk, MemoryFiles, Registry, load_batch, mechanism_from_str};
use hyperstat_tests::acted::acted_on;
use hyperstat_tests::prebuilt::Case;
use nalgebra::Vector6;

use crate::lanes_agree::{Random, cases, model};

/// Lanes against full solutions: beside the largest force of a state, moments over the size.
const FORCES: f64 = 1e-10;
/// Parts of a budget, beside the whole.
const SHARES: f64 = 1e-9;

/// Poses of a mechanism.
const POSES: usize = 24;

type Wrenches = [Option<Vector6<f64>>];

/// All wrenches, moments over a size.
fn wrenches(joints: &Wrenches, segments: &[SegmentForces], size: f64) -> Vec<Option<Vector6<f64>>> {
    let scale = Vector6::from_fn(|k, _| if k < 3 { 1.0 } else { 1.0 / size });
    let ends = segments.iter().flat_map(|s| s.ends).map(Some);
    let all = joints.iter().copied().chain(ends);
    all.map(|w| w.map(|w| w.component_mul(&scale))).collect()
}

/// What they differ by, beside the largest.
fn apart(found: &[Option<Vector6<f64>>], expected: &[Option<Vector6<f64>>]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let largest = expected.iter().flatten().map(|w| w.amax());
    let largest = largest.fold(f64::MIN_POSITIVE, f64::max);
    let differences = found.iter().zip(expected).map(|pair| match pair {
        (Some(found), Some(expected)) => (found - expected).amax(),
        (None, None) => 0.0,
        _ => f64::INFINITY,
    });
    differences.fold(0.0, f64::max) / largest
}

/// What budgets differ by, part by part, beside the whole.
fn budgets_apart(found: &Budget, expected: &Budget) -> f64 {
    let whole = expected.total.abs();
    let part_of = |own: &Budget, like: &Part| {
        let same =
            |part: &&Part| part.source == like.source && part.deformation == like.deformation;
        let part = own.parts.iter().find(same);
        part.map_or(0.0, |part| part.displacement)
    };
    let parts = expected.parts.iter().chain(&found.parts);
    let differences = parts.map(|part| (part_of(found, part) - part_of(expected, part)).abs());
    let total = (found.total - expected.total).abs();
    differences.fold(total, f64::max) / whole
}

fn check_pose(what: &str, prepared: &Prepared, geometry: &Geometry, found: &[Forces]) -> f64 {
    let here = prepared.at(geometry).expect("a geometry of it");
    let solution = here.solve().expect("a solution");
    let size = solution.floor.size;
    let cases = solution.cases.iter().map(|case| &case.state);
    let cases = cases.map(|state| (&*state.joint_wrenches, &*state.segments));
    let own = (&*solution.joint_wrenches, &*solution.segments);
    let expected: Vec<_> = std::iter::once(own).chain(cases).collect();
    assert_eq!(found.len(), expected.len(), "{what}");
    let differences = found
        .iter()
        .zip(expected)
        .map(|(found, (joints, segments))| {
            for (found, expected) in found.segments.iter().zip(segments) {
                assert_eq!(found.load, expected.load, "{what}");
            }
            let found = wrenches(&found.joint_wrenches, &found.segments, size);
            apart(&found, &wrenches(joints, segments, size))
        });
    differences.fold(0.0, f64::max)
}

/// The largest differences of forces and of shares at the poses that stand in the lanes, and how many of
/// them went one by one.
fn check_poses(
    what: &str,
    prepared: &Prepared,
    lanes: &mut Lanes,
    poses: &[Geometry; LANES],
) -> [f64; 3] {
    let (mut most, mut most_shares, mut without) = (0.0_f64, 0.0_f64, 0.0);
    let found = prepared.sweep_lanes(lanes, [true; LANES]);
    for (lane, found) in found.into_iter().enumerate() {
        let found = found.expect("a filled lane").expect("a result");
        let budgets = prepared.budgets(lanes, lane, &found).expect("budgets");
        let here = prepared.at(&poses[lane]).expect("a geometry of it");
        let Some(Carried {
            forces, budgets, ..
        }) = budgets
        else {
            without += 1.0;
            let forces = prepared.forces(lanes, lane).expect("forces");
            most = most.max(check_pose(what, prepared, &poses[lane], &forces));
            continue;
        };
        most = most.max(check_pose(what, prepared, &poses[lane], &forces));
        let solution = here.solve().expect("a solution");
        let influence = here.influence().expect("an influence");
        let names = prepared.model().cases().iter().map(|case| &*case.name);
        let states = names.map(|name| solution.of_case(name).expect("a case"));
        let states = std::iter::once(solution.clone()).chain(states);
        for (state, budget) in states.zip(&budgets) {
            // Where nothing moves the output, of the compliance along the softest force.
            let Some(along) = Budget::direction_of(&state.output.displacement) else {
                continue;
            };
            let apart = (along - budget.along).amax();
            assert!(apart < 1e-8, "{what}: along {along} and {}", budget.along);
            let expected = influence.budget(&state, &along);
            most_shares = most_shares.max(budgets_apart(budget, &expected));
        }
    }
    [most, most_shares, without]
}

/// Poses whose forces went one by one.
fn check(case: &Case, model: Model) -> u64 {
    let what = case.what(&case.poses[0]);
    let prepared = Prepared::new(model);
    let mut lanes = prepared.lanes_beside(Beside::Budgets).expect("a plan");
    let mut random = Random::new();
    let (mut most, mut most_shares, mut without) = (0.0_f64, 0.0_f64, 0.0);
    for _ in 0..POSES / LANES {
        let poses: [_; LANES] =
            std::array::from_fn(|_| random.geometry(case, prepared.model().geometry()));
        lanes.geometries_mut().clone_from(&poses);
        let [forces, shares, own] = check_poses(&what, &prepared, &mut lanes, &poses);
        (most, most_shares) = (most.max(forces), most_shares.max(shares));
        without += own;
    }
    println!("{what}: forces {most:.1e}, shares {most_shares:.1e}, {without} one by one");
    assert!(most <= FORCES, "{what}: forces {most:e}");
    assert!(most_shares <= SHARES, "{what}: shares {most_shares:e}");
    without as u64
}

/// Loads, weight, heat, misfits, preloads and cases, on the prebuilt mechanisms of the benches.
#[test]
fn forces_and_budgets_under_all_that_acts_are_those_of_full_solutions() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../benches/mechanisms.ron");
    let batch = load_batch(&path, &Disk, &Registry::builtin()).expect("a batch");
    let (mut without, mut poses) = (0, 0);
    for job in &batch.jobs {
        let model = job.model().expect("a pose within reach");
        for (what, model) in acted_on(&model) {
            let what = format!("{}, {what}", job.name);
            let prepared = Prepared::new(model);
            let mut lanes = prepared.lanes_beside(Beside::Budgets).expect("a plan");
            for lane in 0..LANES {
                let placed = job.place(lane * 7 % job.len(), lanes.geometry_mut(lane));
                placed.expect("a pose within reach");
            }
            let geometries = lanes.geometries_mut().clone();
            let [forces, shares, own] = check_poses(&what, &prepared, &mut lanes, &geometries);
            assert!(forces <= FORCES, "{what}: forces {forces:e}");
            assert!(shares <= SHARES, "{what}: shares {shares:e}");
            without += own as usize;
            poses += LANES;
        }
    }
    println!("{without} of {poses} poses one by one");
    assert!(
        without * 50 < poses,
        "{without} of {poses} poses one by one"
    );
}

/// What moves the output by a moment alone has rounding for a translation: no way to move.
#[test]
fn a_budget_under_a_moment_alone_is_of_the_rotation() {
    let case = &cases()[0];
    let mut model = model(case, false);
    let output = model.output().expect("an output");
    model
        .set_loads(LoadSet::on(output, Vector6::ith(5, 10.0)))
        .expect("a load");
    check(case, model);
}

/// A joint whose stiffness has no inverse, rigid along one direction: it goes one by one.
#[test]
fn a_joint_of_singular_stiffness_has_its_budget_one_by_one() {
    let text = r#"(
        name: "bush",
        sections: { "arm": Circle(diameter: 0.02), "stay": Circle(diameter: 0.01) },
        materials: { "steel": (young: 2.1e11, poisson: 0.3) },
        points: { "A": (0.0, 0.0, 0.0), "B": (0.5, 0.0, 0.0), "C": (0.6, 0.1, 0.0) },
        bodies: {
            "arm": Beam(through: ["A", "B"], section: "arm", material: "steel"),
            "plate": Rigid(points: ["B", "C"]),
            "stay": Beam(through: ["A", "C"], section: "stay", material: "steel"),
        },
        joints: {
            "wall": (at: "A", between: ("ground", "arm"), kind: Fixed),
            "foot": (at: "A", between: ("ground", "stay"), kind: Fixed),
            "tip": (at: "C", between: ("stay", "plate"), kind: Fixed),
            "bush": (at: "B", between: ("arm", "plate"), kind: Revolute(axis: (0.0, 0.0, 1.0)), locked: true,
                stiffness: Matrix([
                    [1e7, 1e7, 0.0, 0.0, 0.0, 0.0], [1e7, 1e7, 0.0, 0.0, 0.0, 0.0],
                    [0.0, 0.0, 1e7, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1e4, 0.0, 0.0],
                    [0.0, 0.0, 0.0, 0.0, 1e4, 0.0], [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
                ])),
        },
        loads: [(on: ("plate", "C"), force: (3.0, -2.0, -50.0))],
        output: ("plate", "C"),
    )"#;
    let files = MemoryFiles::new();
    let loaded = mechanism_from_str(text, "bush.ron".as_ref(), &files, &Registry::builtin());
    let model = loaded.unwrap_or_else(|error| panic!("{error}")).model;
    let prepared = Prepared::new(model);
    let mut lanes = prepared.lanes_beside(Beside::Budgets).expect("a plan");
    let geometries = lanes.geometries_mut().clone();
    let [forces, _, without] = check_poses("bush", &prepared, &mut lanes, &geometries);
    assert!(forces <= FORCES, "{forces:e}");
    assert_eq!(without as usize, LANES);
}

/// What was found for another model, or another mechanism's lanes, is no answer.
#[test]
fn forces_of_another_model_are_refused() {
    let case = &cases()[0];
    let mut prepared = Prepared::new(model(case, false));
    let mut lanes = prepared.lanes_beside(Beside::Budgets).expect("a plan");
    let found = prepared.sweep_lanes(&mut lanes, [true; LANES]);
    let found = found[0].clone().expect("a filled lane").expect("a result");
    let output = prepared.model().output().expect("an output");
    let load = LoadSet::on(output, Vector6::ith(0, 7.0));
    prepared.model_mut().set_loads(load).expect("a load");
    assert!(prepared.forces(&mut lanes, 0).is_err());
    assert!(prepared.budgets(&mut lanes, 1, &found).is_err());
}

#[test]
fn forces_and_budgets_of_all_prebuilt_mechanisms_are_those_of_full_solutions() {
    let mut without = 0;
    let all = cases();
    for case in &all {
        without += check(case, model(case, false)) + check(case, model(case, true));
    }
    let poses = 2 * all.len() * POSES;
    println!("{without} of {poses} poses one by one");
    assert!(
        without as usize * 10 < poses,
        "{without} of {poses} poses one by one"
    );
}
