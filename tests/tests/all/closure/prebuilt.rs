//! Every prebuilt mechanism, written out as a file at its home pose and moved by loop closure,
//! against its own inverse kinematics.

use std::path::Path;

use hyperstat_assembly::{Geometry, Model, Prepared};
use hyperstat_closure::{Configuration, LoopClosure, Target};
use hyperstat_elements::element_frame;
use hyperstat_mechanisms::{Disk, Registry, mechanism_from_str, write};
use hyperstat_tests::stiffness_difference;
use nalgebra::{Matrix6, UnitQuaternion, Vector3};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

use super::mechanisms::{Case, cases};

/// Of positions (m) and directions; files and closed forms are good to rounding.
const PLACE: f64 = 1e-10;
/// Of K_o, over √(K_ii K_jj).
const STIFFNESS: f64 = 1e-8;

/// The mechanism at home, through the text of a mechanism file.
pub fn file(case: &Case) -> Model {
    let model = case.mechanism.model(&case.home).expect("home is in reach");
    let registry = Registry::builtin();
    let text = write(&model, &registry).expect("a mechanism file");
    let mechanism = mechanism_from_str(&text, Path::new("home.ron"), &Disk, &registry)
        .expect("the same mechanism");
    mechanism.model
}

/// What the file is asked for at a pose of the prebuilt: the coordinates it takes, rotations from
/// the file's configuration.
pub fn asked(case: &Case, pose: &[f64]) -> [Option<f64>; 6] {
    asked_from(case, &case.home, pose)
}

/// The same of a file that stands in the pose `from`.
pub fn asked_from(case: &Case, from: &[f64], pose: &[f64]) -> [Option<f64>; 6] {
    let whole = |pose: &[f64]| {
        let mut whole = [0.0; 6];
        for (coordinate, value) in case.mechanism.coordinates().iter().zip(pose) {
            whole[coordinate.index()] = *value;
        }
        whole
    };
    let turn =
        |pose: [f64; 6]| UnitQuaternion::from_scaled_axis(Vector3::from_column_slice(&pose[3..]));
    let relative = (turn(whole(pose)) / turn(whole(from))).scaled_axis();
    let mut asked = [None; 6];
    for coordinate in case.mechanism.coordinates() {
        let k = coordinate.index();
        asked[k] = Some(if k < 3 {
            whole(pose)[k]
        } else {
            relative[k - 3]
        });
    }
    asked
}

fn stiffness(prepared: &Prepared, geometry: &Geometry) -> Matrix6<f64> {
    let mut workspace = prepared.workspace().expect("a plan");
    let result = prepared.sweep(geometry, &mut workspace);
    result
        .expect("a solution")
        .stiffness
        .expect("held, not rigidly")
}

/// Largest differences of positions, of directions of sections and of joints' axes.
fn differences(case: &Case, model: &Model, found: &Geometry, wanted: &Geometry) -> [f64; 3] {
    let mut largest = [0.0_f64; 3];
    for (node, (p, q)) in found.positions.iter().zip(&wanted.positions).enumerate() {
        let point = &model.nodes()[node].point;
        if !case.moved.is_some_and(|moved| point.starts_with(moved)) {
            largest[0] = largest[0].max((p - q).norm());
        }
    }
    for (k, segment) in model.segments().iter().enumerate() {
        let frame = |g: &Geometry| {
            let [a, b] = segment.ends.map(|n| g.positions[n.0]);
            element_frame(&(b - a), g.y_axes[k].as_ref()).expect("a frame")
        };
        let [one, other] = [found, wanted].map(|g| frame(g).matrix().column(1).into_owned());
        if !case.idle {
            largest[1] = largest[1].max((one - other).norm().min((one + other).norm()));
        }
    }
    for (k, joint) in model.joints().iter().enumerate() {
        let columns: &[usize] = match joint.joint.kind() {
            "Spherical" | "Fixed" => &[],
            "Universal" => &[0, 1],
            _ => &[1],
        };
        for column in columns {
            let axis = |g: &Geometry| g.frames[k].matrix().column(*column).into_owned();
            let (one, other) = (axis(found), axis(wanted));
            largest[2] = largest[2].max((one - other).norm().min((one + other).norm()));
        }
    }
    largest
}

fn check(
    case: &Case,
    closure: &LoopClosure,
    from: &Configuration,
    model: &Model,
    prepared: &Prepared,
    pose: &[f64],
) -> Result<Option<Configuration>, TestCaseError> {
    let mut wanted = model.geometry().clone();
    let Ok(whole) = case.mechanism.place(pose, &mut wanted) else {
        return Ok(None);
    };
    let what = format!("{} {pose:?}", case.mechanism.kind());
    let reached = closure.reach(from, &Target::Output(asked(case, pose)));
    let reached = reached.map_err(|error| TestCaseError::fail(format!("{what}: {error}")))?;
    let mut found = model.geometry().clone();
    closure
        .write(&reached, &mut found)
        .expect("nothing slides across");
    let differences = differences(case, model, &found, &wanted);
    prop_assert!(
        differences.iter().all(|d| *d <= PLACE),
        "{what}: {differences:?}"
    );
    prop_assert!(
        closure.misfit(&reached).expect("its own") <= 1e-12,
        "{what}: {:e}",
        closure.misfit(&reached).expect("its own")
    );
    let pose_found = closure.pose(&reached).expect("its own");
    for k in 0..3 {
        prop_assert!(
            (pose_found[k] - whole[k]).abs() <= PLACE,
            "{what}: {pose_found:?}, not {whole:?}"
        );
    }
    let [found, wanted] = [found, wanted].map(|geometry| stiffness(prepared, &geometry));
    let difference = stiffness_difference(&found, &wanted);
    prop_assert!(difference <= STIFFNESS, "{what}: K_o {difference:e}");
    Ok(Some(reached))
}

/// From home, and from there on to a second pose.
#[test]
fn files_reach_the_poses_of_the_closed_forms() {
    for case in cases() {
        let model = file(&case);
        let closure = LoopClosure::new(&model).expect("a linkage");
        let prepared = Prepared::new(model.clone());
        let mut reached = 0;
        let count = case.home.len();
        let units = proptest::collection::vec(-1.0..1.0_f64, 2 * count);
        let mut runner = TestRunner::new(Config {
            cases: 24,
            failure_persistence: None,
            ..Config::default()
        });
        let counter = std::cell::Cell::new(0);
        runner
            .run(&units, |units| {
                let mut from = closure.home();
                for units in units.chunks(count) {
                    let offsets = units.iter().zip(&case.spans);
                    let pose: Vec<f64> = case
                        .home
                        .iter()
                        .zip(offsets)
                        .map(|(c, (u, s))| c + s * u)
                        .collect();
                    if let Some(next) = check(&case, &closure, &from, &model, &prepared, &pose)? {
                        from = next;
                        counter.set(counter.get() + 1);
                    }
                }
                Ok(())
            })
            .unwrap_or_else(|error| panic!("{error}"));
        reached += counter.get();
        println!("{}: {reached}", case.mechanism.kind());
        assert!(
            reached >= 24,
            "{}: only {reached} poses",
            case.mechanism.kind()
        );
    }
}

/// Poses hardly away from home, and one at which the first leg of the Exechon is as long as at home
/// but for 2 µm: joints slide by as little as that too.
#[test]
fn small_travels_are_made_too() {
    for case in cases() {
        let model = file(&case);
        let closure = LoopClosure::new(&model).expect("a linkage");
        let prepared = Prepared::new(model.clone());
        let near = [1e-5, 1e-6, -1e-7].into_iter().flat_map(|step| {
            let moved = |k: usize| {
                let mut pose = case.home.clone();
                pose[k] += step;
                pose
            };
            (0..case.home.len()).map(moved).collect::<Vec<_>>()
        });
        let mut poses: Vec<Vec<f64>> = near.collect();
        if case.mechanism.kind() == "Exechon" {
            let pose = [
                -0.038181258981022065,
                0.08136676672740732,
                0.9147306271913795,
            ];
            poses.push(pose.into());
        }
        for pose in poses {
            let reached = check(&case, &closure, &closure.home(), &model, &prepared, &pose);
            let reached = reached.unwrap_or_else(|error| panic!("{error}"));
            assert!(reached.is_some(), "{pose:?} is in reach");
        }
    }
}
