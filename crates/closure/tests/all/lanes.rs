//! Eight targets at a time against one at a time: random loops, overconstrained ones, and neighbours.

use hyperstat_closure::{ClosureError, LANES, Lanes, LoopClosure, Target};
use hyperstat_joints::{Dof, Revolute};
use hyperstat_model::{Geometry, JointId, Model};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;

use crate::loops::{LOOPS, is_fit, loop_of, vectors};
use crate::support::{Builder, drive, geometry};

/// Places (m) and axes in mechanisms of a metre: both ways close loops to 1e-15, of which a configuration
/// makes 3000 times as much before the lanes hand it on as nearly singular.
const SAME: f64 = 1e-11;

/// How far two geometries are apart, positions in metres.
fn apart(one: &Geometry, other: &Geometry) -> f64 {
    let positions = one.positions.iter().zip(&other.positions);
    let positions = positions.map(|(p, q)| (p - q).amax());
    let frames = one.frames.iter().zip(&other.frames);
    let frames = frames.map(|(p, q)| (p.matrix() - q.matrix()).amax());
    positions.chain(frames).fold(0.0, f64::max)
}

fn kind(error: &ClosureError) -> std::mem::Discriminant<ClosureError> {
    std::mem::discriminant(error)
}

type Placed = Vec<(Result<[f64; 6], ClosureError>, Geometry)>;

/// All targets in lanes, and how many of them went one by one.
fn in_lanes(model: &Model, closure: &LoopClosure, targets: &[Target<'_>]) -> (Placed, u64) {
    let mut lanes = Lanes::default();
    let mut placed = Vec::new();
    for targets in targets.chunks(LANES) {
        let mut geometries = vec![model.geometry().clone(); LANES];
        let found = closure.place_lanes(targets, &mut geometries, &mut lanes);
        placed.extend(found.into_iter().flatten().zip(geometries));
    }
    (placed, lanes.one_by_one())
}

/// The five-bar of `examples/five_bar.ron`, its points off by as much as `noise` says.
fn five_bar(noise: impl Fn(usize) -> f64) -> Model {
    let mut b = Builder::new();
    let place =
        |k: usize, x: f64, y: f64| [x + noise(3 * k), y + noise(3 * k + 1), noise(3 * k + 2)];
    let [a1, b1] = [place(0, -0.15, 0.0), place(1, -0.25, 0.2)];
    let [a2, b2, p] = [
        place(2, 0.15, 0.0),
        place(3, 0.25, 0.2),
        place(4, 0.0, 0.42),
    ];
    b.body("crank1", &[("A1", a1), ("B1", b1)]);
    b.body("crank2", &[("A2", a2), ("B2", b2)]);
    b.body("rod1", &[("B1", b1), ("P", p)]);
    b.body("rod2", &[("B2", b2), ("P", p)]);
    let joints = [
        ("A1", ["ground", "crank1"], true),
        ("A2", ["ground", "crank2"], true),
        ("B1", ["crank1", "rod1"], false),
        ("B2", ["crank2", "rod2"], false),
        ("P", ["rod1", "rod2"], false),
    ];
    for (k, (name, bodies, locked)) in joints.into_iter().enumerate() {
        let axis = [noise(15 + 2 * k), noise(16 + 2 * k), 1.0];
        b.joint(name, name, bodies, Revolute, axis, locked);
    }
    b.output("rod1", "P");
    b.0
}

/// Targets over the plane, a good part of them out of reach.
fn over_the_plane(steps: usize) -> Vec<Target<'static>> {
    let at = |k: usize, from: f64, to: f64| from + (to - from) * k as f64 / (steps - 1) as f64;
    let all = (0..steps * steps).map(|k| {
        let (x, y) = (at(k % steps, -0.35, 0.35), at(k / steps, 0.12, 0.52));
        Target::Output([Some(x), Some(y), None, None, None, None])
    });
    all.collect()
}

/// Bennett's linkage, which moves by its dimensions alone, with its first joint at `angle`.
fn bennett(angle: f64) -> Model {
    let twists = [0.6_f64, 1.1];
    let lengths = [0.3, 0.3 * twists[1].sin() / twists[0].sin()];
    let [sum, difference] = [twists[1] + twists[0], twists[1] - twists[0]];
    let other = 2.0 * ((0.5 * sum).sin() / (0.5 * difference).sin() / (0.5 * angle).tan()).atan();
    let mut frame = Isometry3::identity();
    let mut frames = Vec::new();
    for (k, turn) in [angle, other, -angle, -other].into_iter().enumerate() {
        frames.push(frame);
        let along =
            |axis: &Vector3<f64>, angle: f64| UnitQuaternion::from_scaled_axis(axis * angle);
        frame = frame
            * along(&Vector3::z(), turn)
            * Translation3::new(lengths[k % 2], 0.0, 0.0)
            * along(&Vector3::x(), twists[k % 2]);
    }
    assert!(frame.translation.vector.norm() < 1e-14, "it closes");
    let mut b = Builder::new();
    let place = |k: usize| -> [f64; 3] { frames[k % 4].translation.vector.into() };
    let names = ["j0", "j1", "j2", "j3"];
    for k in 0..3 {
        let off = |d: usize| std::array::from_fn(|c| place(k)[c] + if c == d { 0.1 } else { 0.0 });
        let points = [
            (names[k], place(k)),
            (names[k + 1], place(k + 1)),
            ("x", off(0)),
            ("y", off(1)),
        ];
        b.body(["b0", "b1", "b2"][k], &points);
    }
    let bodies = [
        ["ground", "b0"],
        ["b0", "b1"],
        ["b1", "b2"],
        ["b2", "ground"],
    ];
    for (k, bodies) in bodies.into_iter().enumerate() {
        let axis = (frames[k].rotation * Vector3::z()).into();
        b.joint(names[k], names[k], bodies, Revolute, axis, k == 0);
    }
    b.output("b1", "x");
    b.0
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_loops_are_placed_as_one_by_one(
        kinds in 0..LOOPS.len(),
        places in vectors(7),
        axes in vectors(7),
        angles in proptest::array::uniform8(-1.5..1.5_f64),
    ) {
        prop_assume!(is_fit(&places, &axes));
        let model = loop_of(LOOPS[kinds].as_bytes(), &places, &axes);
        let closure = LoopClosure::new(&model).expect("a linkage");
        let drives = angles.map(|angle| [drive(JointId(0), Dof::V, angle)]);
        let targets = drives.each_ref().map(|drives| Target::Drives(drives));
        let (placed, _) = in_lanes(&model, &closure, &targets);
        for ((found, at), target) in placed.iter().zip(&targets) {
            match (found, closure.place_at(target)) {
                (Ok(_), Ok(wanted)) => {
                    let off = apart(at, &wanted.geometry);
                    prop_assert!(off <= SAME, "{} {target:?}: {off:e}", LOOPS[kinds]);
                }
                (Err(found), Err(wanted)) => prop_assert_eq!(kind(found), kind(&wanted)),
                (found, wanted) => prop_assert!(false, "{} {:?}: {:?}, {:?}", LOOPS[kinds], target, found, wanted),
            }
        }
    }
}

#[test]
fn the_plane_of_a_five_bar_is_placed_as_one_by_one() {
    let model = five_bar(|_| 0.0);
    let closure = LoopClosure::new(&model).expect("a linkage");
    let targets = over_the_plane(24);
    let (placed, one_by_one) = in_lanes(&model, &closure, &targets);
    let mut missed = 0;
    for ((found, at), target) in placed.iter().zip(&targets) {
        match (found, closure.place_at(target)) {
            (Ok(_), Ok(wanted)) => assert!(apart(at, &wanted.geometry) <= 1e-12, "{target:?}"),
            (Err(found), Err(wanted)) => {
                assert_eq!(kind(found), kind(&wanted));
                assert_eq!(at, model.geometry());
                missed += 1;
            }
            (found, wanted) => panic!("{target:?}: {found:?}, {wanted:?}"),
        }
    }
    assert!(missed > targets.len() / 6, "{missed} out of reach");
    // By the way go those alone that a branch ends before.
    let handed_on = one_by_one as usize;
    assert!(
        handed_on <= targets.len() / 50,
        "{handed_on} of {}",
        targets.len()
    );
}

#[test]
fn a_linkage_of_special_dimensions_is_placed_as_one_by_one() {
    let model = bennett(1.0);
    let closure = LoopClosure::new(&model).expect("a linkage");
    let drives: Vec<_> = (0..64)
        .map(|k| [drive(JointId(0), Dof::V, -0.7 + 0.03 * f64::from(k))])
        .collect();
    let targets: Vec<_> = drives.iter().map(|drives| Target::Drives(drives)).collect();
    let (placed, one_by_one) = in_lanes(&model, &closure, &targets);
    assert_eq!(one_by_one, 0);
    for (((found, at), target), drives) in placed.iter().zip(&targets).zip(&drives) {
        found.as_ref().expect("a linkage that moves");
        let wanted = closure.place_at(target).expect("a linkage that moves");
        assert!(apart(at, &wanted.geometry) <= 1e-12);
        // And as it is built there.
        let built = bennett(1.0 + drives[0].value);
        for name in ["j1", "j2"] {
            let place = |model: &Model, at: &Geometry| {
                at.positions[model.node("b1", name).expect("a node").0]
            };
            let off = (place(&model, at) - place(&built, built.geometry())).norm();
            assert!(off <= 1e-12, "{name}: {off:e}");
        }
    }
}

/// Redundant rows that contradict each other end at the same least squares.
#[test]
fn contradictions_are_shared_out_as_one_by_one() {
    // Digits of no special kind, up to 1e-8.
    let noise = |k: usize| 1e-8 * (12.9898 * (k as f64 + 1.0)).sin();
    let model = five_bar(noise);
    let closure = LoopClosure::new(&model).expect("a linkage");
    let targets: Vec<_> = over_the_plane(12);
    let (placed, _) = in_lanes(&model, &closure, &targets);
    let mut largest = 0.0_f64;
    for ((found, at), target) in placed.iter().zip(&targets) {
        let reached = closure.reach(&closure.home(), target);
        assert_eq!(found.is_ok(), reached.is_ok(), "{target:?}");
        let Ok(reached) = reached else { continue };
        let misfit = closure.misfit(&reached).expect("its own");
        let off = apart(at, &geometry(&model, &closure, &reached));
        assert!(
            off <= 10.0 * misfit + 1e-12,
            "{target:?}: {off:e}, {misfit:e}"
        );
        largest = largest.max(misfit);
    }
    assert!(largest > 1e-10, "no contradiction: {largest:e}");
}

/// What is found at a target is the same to the bit whoever stands beside it, and in which lane.
#[test]
fn lanes_do_not_see_each_other() {
    let model = five_bar(|_| 0.0);
    let closure = LoopClosure::new(&model).expect("a linkage");
    let targets = over_the_plane(9);
    let (placed, _) = in_lanes(&model, &closure, &targets);
    let backwards: Vec<_> = targets.iter().rev().copied().collect();
    let (reversed, _) = in_lanes(&model, &closure, &backwards);
    let shifted: Vec<_> = targets[3..].to_vec();
    let (shifted, _) = in_lanes(&model, &closure, &shifted);
    for (k, (found, at)) in placed.iter().enumerate() {
        let (alone, _) = in_lanes(&model, &closure, &targets[k..=k]);
        let others = [Some(&alone[0]), reversed.iter().rev().nth(k)];
        let third = k.checked_sub(3).and_then(|k| shifted.get(k));
        for other in others.into_iter().chain([third]).flatten() {
            assert_eq!((found, at), (&other.0, &other.1), "{k}");
        }
    }
}
