//! What joints and segments carry, and budgets, as the lanes find them: those of a full solution of each
//! pose, over all prebuilt mechanisms.

use hyperstat_assembly::{
    Beside, Budget, Carried, Forces, Geometry, LANES, Model, Prepared, SegmentForces,
};
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
    let part_of = |own: &Budget, like: &hyperstat_assembly::Part| {
        let same = |part: &&hyperstat_assembly::Part| {
            part.source == like.source && part.deformation == like.deformation
        };
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

/// Poses whose forces went one by one.
fn check(case: &Case, model: Model) -> u64 {
    let what = case.what(&case.poses[0]);
    let prepared = Prepared::new(model);
    let mut lanes = prepared.lanes_beside(Beside::Budgets).expect("a plan");
    let mut random = Random::new();
    let (mut most, mut most_shares) = (0.0_f64, 0.0_f64);
    let mut without = 0;
    for _ in 0..POSES / LANES {
        let poses: [_; LANES] =
            std::array::from_fn(|_| random.geometry(case, prepared.model().geometry()));
        lanes.geometries_mut().clone_from(&poses);
        let found = prepared.sweep_lanes(&mut lanes, [true; LANES]);
        for (lane, found) in found.into_iter().enumerate() {
            let found = found.expect("a filled lane").expect("a result");
            let budgets = prepared.budgets(&mut lanes, lane, &found).expect("budgets");
            let here = prepared.at(&poses[lane]).expect("a geometry of it");
            let Some(Carried {
                forces, budgets, ..
            }) = budgets
            else {
                without += 1;
                let forces = prepared.forces(&mut lanes, lane).expect("forces");
                most = most.max(check_pose(&what, &prepared, &poses[lane], &forces));
                continue;
            };
            most = most.max(check_pose(&what, &prepared, &poses[lane], &forces));
            let solution = here.solve().expect("a solution");
            let influence = here.influence().expect("an influence");
            let names = prepared.model().cases().iter().map(|case| &*case.name);
            let states = names.map(|name| solution.of_case(name).expect("a case"));
            let states = std::iter::once(solution.clone()).chain(states);
            for (state, budget) in states.zip(&budgets) {
                let expected = influence.budget(&state, &budget.along);
                most_shares = most_shares.max(budgets_apart(budget, &expected));
            }
        }
    }
    println!("{what}: forces {most:.1e}, shares {most_shares:.1e}, {without} one by one");
    assert!(most <= FORCES, "{what}: forces {most:e}");
    assert!(most_shares <= SHARES, "{what}: shares {most_shares:e}");
    without
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
