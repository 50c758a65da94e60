//! Poses side by side in SIMD lanes give what they give one by one, over all prebuilt mechanisms
//! and random poses, whatever stands in the lanes beside them.

use hyperstat_assembly::{Geometry, LANES, Lanes, Model, NodeId, PoseResult, Prepared, SolveError};
use hyperstat_mechanisms::prebuilt::{Delta, Elbow, Prebuilt, RodEnds, SingleFreedom};
use hyperstat_tests::prebuilt::{BEARINGS, Case, legs, links, loaded};
use hyperstat_tests::{stiffness_difference, vector_differences};
use nalgebra::{Point3, Vector3, Vector6};

/// Lanes against one by one: relative to √(K_ii K_jj), and to the largest translation and rotation.
const AGREEMENT: f64 = 1e-11;

/// Poses of a mechanism.
const POSES: usize = 240;

type Result = std::result::Result<PoseResult, SolveError>;

/// Random numbers, the same in every run (xorshift64).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new() -> Self {
        Self(0x9e37_79b9_7f4a_7c15)
    }

    /// Between −1 and 1.
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn geometry(&mut self, case: &Case, like: &Geometry) -> Geometry {
        let mut geometry = like.clone();
        let pose = case.pose(&std::array::from_fn(|_| self.unit()));
        let placed = case.mechanism.place(&pose, &mut geometry);
        placed.unwrap_or_else(|error| panic!("{}: {error}", case.what(&pose)));
        geometry
    }
}

fn delta(delta: Delta) -> Case {
    Case {
        mechanism: Box::new(delta),
        poses: vec![vec![0.0, 0.0, 0.5]],
        middle: vec![0.0, 0.0, 0.5],
        span: vec![0.2, 0.2, 0.1],
        counts: [0; 3],
    }
}

/// All prebuilt mechanisms: with rigid and elastic joints and drives, ball-jointed rods, links of
/// several elements.
pub(crate) fn cases() -> Vec<Case> {
    let mut cases = legs::cases();
    cases.extend(links::cases());
    cases.extend([
        delta(Delta::paper()),
        delta(Delta {
            joint_stiffness: BEARINGS,
            drive_stiffness: Some(1e5),
            elbow: Elbow::In,
            ..Delta::paper()
        }),
        delta(Delta {
            rod_ends: RodEnds::Spherical,
            ..Delta::paper()
        }),
        delta(Delta {
            rod_ends: RodEnds::Spherical,
            joint_stiffness: BEARINGS,
            drive_stiffness: Some(1e5),
            elements: 3,
            ..Delta::paper()
        }),
    ]);
    cases.push(Case {
        mechanism: Box::new(SingleFreedom::paper()),
        poses: vec![Vec::new()],
        middle: Vec::new(),
        span: Vec::new(),
        counts: [0; 3],
    });
    cases
}

/// The mechanism in its first pose, loaded on its output; `everywhere` also by a force on every
/// third node.
pub(crate) fn model(case: &Case, everywhere: bool) -> Model {
    let mut model = loaded(&*case.mechanism, &case.poses[0]);
    if everywhere {
        for node in (0..model.nodes().len()).step_by(3) {
            let size = 10.0 + node as f64;
            let force = Vector6::new(size, -7.0, 0.5 * size, 0.0, 0.0, 0.0);
            model.add_load(NodeId(node), force).expect("a finite load");
        }
    }
    model
}

/// The poses of a batch in their lanes; `None` leaves what stands there.
fn fill(lanes: &mut Lanes, poses: &[Option<&Geometry>; LANES]) -> [bool; LANES] {
    for (lane, pose) in poses.iter().enumerate() {
        if let Some(pose) = pose {
            lanes.geometry_mut(lane).clone_from(pose);
        }
    }
    poses.map(|pose| pose.is_some())
}

/// A pose by itself in the first lane of fresh ones.
fn alone(prepared: &Prepared, pose: &Geometry) -> Result {
    let mut lanes = prepared.lanes().expect("a plan");
    let mut poses = [None; LANES];
    poses[0] = Some(pose);
    let filled = fill(&mut lanes, &poses);
    let [found, rest @ ..] = prepared.sweep_lanes(&mut lanes, filled);
    assert!(
        rest.iter().all(Option::is_none),
        "lanes that are not filled"
    );
    found.expect("the lane is filled")
}

fn assert_agree(what: &str, found: &Result, expected: &Result) {
    let (found, expected) = match (found, expected) {
        (Ok(found), Ok(expected)) => (found, expected),
        (Err(found), Err(expected)) => {
            assert_eq!(found.to_string(), expected.to_string(), "{what}");
            return;
        }
        _ => panic!("{what}: {found:?} instead of {expected:?}"),
    };
    match (&found.stiffness, &expected.stiffness) {
        (Some(found), Some(expected)) => {
            let difference = stiffness_difference(found, expected);
            assert!(difference <= AGREEMENT, "{what}: K_o {difference:e}");
        }
        (found, expected) => assert_eq!(found, expected, "{what}"),
    }
    match (&found.displacement, &expected.displacement) {
        (Some(found), Some(expected)) => {
            let difference = vector_differences([(found, expected)], [0.0; 2]);
            assert!(
                difference.iter().all(|d| *d <= AGREEMENT),
                "{what}: displacement {difference:?}"
            );
        }
        (found, expected) => assert_eq!(found, expected, "{what}"),
    }
}

/// All bits of a result.
fn bits(result: &Result) -> Vec<u64> {
    let Ok(result) = result else {
        return Vec::new();
    };
    let stiffness = result.stiffness.iter().flat_map(|k| k.iter());
    let displacement = result.displacement.iter().flat_map(|u| u.iter());
    stiffness.chain(displacement).map(|x| x.to_bits()).collect()
}

/// Poses that were compared, and those of them that the lanes handed on.
fn check(case: &Case, everywhere: bool) -> [u64; 2] {
    let what = case.what(&case.poses[0]);
    let model = model(case, everywhere);
    let prepared = Prepared::new(model.clone());
    let (mut lanes, mut workspace) = (
        prepared.lanes().expect("a plan"),
        prepared.workspace().expect("a plan"),
    );
    let mut random = Random::new();
    let mut compared = 0;
    for batch in 0..POSES / LANES {
        let poses: [_; LANES] = std::array::from_fn(|_| random.geometry(case, model.geometry()));
        // Some batches are full, others hold any number of poses in any lanes.
        let lane_is_filled = |_| batch % 2 == 0 || random.unit() < 0.3;
        let filled: [bool; LANES] = std::array::from_fn(lane_is_filled);
        let chosen = std::array::from_fn(|k| filled[k].then_some(&poses[k]));
        let filled = fill(&mut lanes, &chosen);
        let found = prepared.sweep_lanes(&mut lanes, filled);
        for (lane, found) in found.iter().enumerate() {
            assert_eq!(found.is_some(), filled[lane], "{what}, lane {lane}");
            let Some(found) = found else { continue };
            let expected = prepared.sweep(&poses[lane], &mut workspace);
            assert!(expected.is_ok(), "{what}: {expected:?}");
            assert_agree(
                &format!("{what}, batch {batch}, lane {lane}"),
                found,
                &expected,
            );
            compared += 1;
        }
    }
    assert!(compared > POSES / 2, "{what}: {compared}");
    assert!(lanes.is_parallel(), "{what} does not go through the lanes");
    println!(
        "{what}: {compared} compared, {} of them one by one",
        lanes.one_by_one()
    );
    [compared as u64, lanes.one_by_one()]
}

/// Compares all cases. Poses that the lanes hand on prove nothing: they must be few.
fn check_all(everywhere: bool) {
    let counts = cases()
        .iter()
        .map(|case| check(case, everywhere))
        .collect::<Vec<_>>();
    let sum = |k: usize| counts.iter().map(|c| c[k]).sum::<u64>();
    let (compared, handed_on) = (sum(0), sum(1));
    assert!(
        5 * handed_on < compared,
        "{handed_on} of {compared} one by one"
    );
}

#[test]
fn lanes_find_what_a_sweep_finds() {
    check_all(false);
}

#[test]
fn lanes_find_what_a_sweep_finds_with_loads_on_inner_nodes() {
    check_all(true);
}

/// A moment on each node in turn: on a rod between ball joints it turns the rod about itself, and
/// the lanes must refuse it as the one-by-one path does.
#[test]
fn moments_on_idle_motions_are_refused_as_in_a_sweep() {
    let mut refused = 0;
    for case in cases() {
        let what = case.what(&case.poses[0]);
        let unloaded = loaded(&*case.mechanism, &case.poses[0]);
        for node in 0..unloaded.nodes().len() {
            let mut model = unloaded.clone();
            let moment = Vector6::new(0.0, 0.0, 0.0, 2.0, -3.0, 1.0);
            model.add_load(NodeId(node), moment).expect("a finite load");
            let prepared = Prepared::new(model.clone());
            let mut random = Random::new();
            let pose = random.geometry(&case, model.geometry());
            let found = alone(&prepared, &pose);
            let expected = prepared.sweep(&pose, &mut prepared.workspace().expect("a plan"));
            refused += usize::from(expected.is_err());
            assert_agree(&format!("{what}, node {node}"), &found, &expected);
        }
    }
    assert!(refused > 10, "{refused}");
}

/// Points moved a little, all nodes of a point together: what was idle in the plan's configuration
/// may be held now.
#[test]
fn idle_motions_that_are_none_any_more_are_not_left_out() {
    for case in cases() {
        let what = case.what(&case.poses[0]);
        let model = model(&case, false);
        let prepared = Prepared::new(model.clone());
        let mut random = Random::new();
        for size in [1e-3, 1e-6] {
            let mut pose = random.geometry(&case, model.geometry());
            let old = pose.positions.clone();
            for (k, point) in old.iter().enumerate() {
                let first = old.iter().position(|p| (p - point).norm() < 1e-9);
                let first = first.unwrap_or(k);
                pose.positions[k] = if first < k {
                    pose.positions[first]
                } else {
                    point + Vector3::new(random.unit(), random.unit(), random.unit()) * size
                };
            }
            let found = alone(&prepared, &pose);
            let expected = prepared.sweep(&pose, &mut prepared.workspace().expect("a plan"));
            assert_agree(&format!("{what}, {size}"), &found, &expected);
        }
    }
}

/// Neighbours: other poses, none, the same pose, and geometries that are none: all nodes at one
/// point, positions that are not numbers or enormous.
#[test]
fn a_pose_does_not_depend_on_its_neighbours() {
    for case in cases() {
        let what = case.what(&case.poses[0]);
        let model = model(&case, true);
        let prepared = Prepared::new(model.clone());
        let mut random = Random::new();
        let poses: [_; LANES] = std::array::from_fn(|_| random.geometry(&case, model.geometry()));
        let expected = poses.each_ref().map(|pose| bits(&alone(&prepared, pose)));
        assert!(expected.iter().all(|bits| !bits.is_empty()), "{what}");
        let spoilt = [0.0, f64::NAN, 1e300].map(|value| {
            let mut geometry = model.geometry().clone();
            geometry.positions.fill(Point3::new(value, value, value));
            geometry
        });

        let mut lanes = prepared.lanes().expect("a plan");
        for turn in 0..2 * LANES {
            let spoil = turn >= LANES;
            let number = |lane: usize| (lane + turn) % LANES;
            let chosen = std::array::from_fn(|lane| match (spoil, number(lane)) {
                (true, k @ 0..3) => Some(&spoilt[k]),
                (true, 3) => None,
                (_, k) => Some(&poses[k]),
            });
            let filled = fill(&mut lanes, &chosen);
            let found = prepared.sweep_lanes(&mut lanes, filled);
            for (lane, found) in found.iter().enumerate() {
                if spoil && number(lane) <= 3 {
                    continue;
                }
                let found = found.as_ref().expect("the lane is filled");
                assert_eq!(
                    bits(found),
                    expected[number(lane)],
                    "{what}, turn {turn}, lane {lane}"
                );
            }
        }
    }
}

/// A pose that cannot be placed leaves its lane empty, and the others as they are.
#[test]
fn poses_out_of_reach_leave_the_others_as_they_are() {
    let delta = Delta::paper();
    let model = loaded(&delta, &[0.0, 0.0, 0.5]);
    let prepared = Prepared::new(model.clone());
    let mut lanes = prepared.lanes().expect("a plan");
    let heights: [f64; LANES] = std::array::from_fn(|k| 0.45 + 0.1 * k as f64);
    let filled = std::array::from_fn(|lane| {
        let placed = delta.place(&[0.0, 0.05, heights[lane]], lanes.geometry_mut(lane));
        placed.is_ok()
    });
    assert_eq!(
        filled.iter().filter(|filled| **filled).count(),
        5,
        "{filled:?}"
    );
    let found = prepared.sweep_lanes(&mut lanes, filled);
    for (lane, found) in found.iter().enumerate() {
        assert_eq!(found.is_some(), filled[lane]);
        let Some(found) = found else { continue };
        let pose = delta.model(&[0.0, 0.05, heights[lane]]).expect("in reach");
        let expected = alone(&prepared, pose.geometry());
        assert_eq!(bits(found), bits(&expected), "lane {lane}");
    }
}
