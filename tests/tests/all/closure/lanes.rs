//! Eight targets at a time against one at a time: the same statuses, and the same places to rounding.

use hyperstat_assembly::{Geometry, Model};
use hyperstat_closure::{ClosureError, LANES, Lanes, LoopClosure, Target};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

use super::mechanisms::cases;
use super::prebuilt::{asked, file};

/// Places over the mechanism's size, and axes, around home: loops of unrounded coordinates are closed to
/// 1e-15, of which a regular configuration makes a hundred times as much.
const SAME: f64 = 1e-12;
/// The same far from home, where configurations may be nearly singular: 3000 times as much before the lanes
/// hand them on.
const FAR: f64 = 1e-11;

/// How far two geometries are apart, positions over `size`.
fn apart(one: &Geometry, other: &Geometry, size: f64) -> f64 {
    let positions = one.positions.iter().zip(&other.positions);
    let positions = positions.map(|(p, q)| (p - q).amax() / size);
    let axes = one.y_axes.iter().zip(&other.y_axes);
    let axes = axes.map(|(p, q)| match (p, q) {
        (Some(p), Some(q)) => (p - q).amax(),
        (None, None) => 0.0,
        _ => f64::INFINITY,
    });
    let frames = |one: &[nalgebra::Rotation3<f64>], other: &[nalgebra::Rotation3<f64>]| {
        let pairs = one.iter().zip(other);
        pairs
            .map(|(p, q)| (p.matrix() - q.matrix()).amax())
            .fold(0.0, f64::max)
    };
    let frames = frames(&one.frames, &other.frames).max(frames(&one.rotations, &other.rotations));
    positions.chain(axes).fold(frames, f64::max)
}

/// The diagonal of the box around all nodes (m).
fn extent(model: &Model) -> f64 {
    let places = model.geometry().positions.iter().map(|p| p.coords);
    let first = model.geometry().positions[0].coords;
    let (low, high) = places.fold((first, first), |(low, high), p| (low.inf(&p), high.sup(&p)));
    (high - low).norm()
}

/// The outcome in a word.
fn status<T>(result: &Result<T, ClosureError>) -> &'static str {
    match result {
        Ok(_) => "ok",
        Err(ClosureError::Unreachable { .. }) => "unreachable",
        Err(ClosureError::CannotFollow { .. }) => "cannot follow",
        Err(ClosureError::Singular { .. }) => "singular",
        Err(ClosureError::Branch { .. }) => "branch",
        Err(_) => "failed",
    }
}

/// What was seen of some targets.
#[derive(Default)]
struct Seen {
    reached: usize,
    missed: usize,
    one_by_one: u64,
    apart: f64,
}

/// Places all targets in lanes and one by one.
fn compare(model: &Model, targets: &[Target<'_>], same: f64) -> Seen {
    let closure = LoopClosure::new(model).expect("a linkage");
    let size = extent(model);
    let mut lanes = Lanes::default();
    let mut seen = Seen::default();
    for targets in targets.chunks(LANES) {
        let mut geometries = vec![model.geometry().clone(); LANES];
        let found = closure.place_lanes(targets, &mut geometries, &mut lanes);
        for (lane, target) in targets.iter().enumerate() {
            let found = found[lane].as_ref().expect("a target");
            let wanted = closure.place_at(target);
            assert_eq!(status(found), status(&wanted), "{target:?}: {found:?}");
            match (found, wanted) {
                (Ok(pose), Ok(wanted)) => {
                    let off = apart(&geometries[lane], &wanted.geometry, size);
                    assert!(off <= same, "{target:?}: {off:e}");
                    for (k, (own, wanted)) in pose.iter().zip(&wanted.pose).enumerate() {
                        let unit = if k < 3 { size } else { 1.0 };
                        assert!((own - wanted).abs() <= same * unit);
                    }
                    seen.apart = seen.apart.max(off);
                    seen.reached += 1;
                }
                _ => {
                    assert_eq!(&geometries[lane], model.geometry());
                    seen.missed += 1;
                }
            }
        }
    }
    seen.one_by_one = lanes.one_by_one();
    seen
}

/// Number of random targets of each mechanism; more of them by hand: `HYPERSTAT_CLOSURE_POSES`.
fn count() -> usize {
    let given = std::env::var("HYPERSTAT_CLOSURE_POSES").ok();
    given.and_then(|n| n.parse().ok()).unwrap_or(64)
}

#[test]
fn prebuilts_as_files_are_placed_as_one_by_one() {
    for case in cases() {
        let model = file(&case);
        let coordinates = case.home.len();
        let units = proptest::collection::vec(-1.0..1.0_f64, coordinates);
        let mut runner = TestRunner::deterministic();
        let mut pose = |wide: f64| {
            let units = units.new_tree(&mut runner).expect("numbers").current();
            let offsets = units.iter().zip(&case.spans);
            let offsets = offsets.map(|(unit, span)| wide * unit * span);
            let pose: Vec<f64> = case.home.iter().zip(offsets).map(|(h, o)| h + o).collect();
            Target::Output(asked(&case, &pose))
        };
        let near: Vec<_> = (0..count()).map(|_| pose(1.0)).collect();
        let wide: Vec<_> = (0..count() / 4).map(|_| pose(3.0)).collect();
        let near = compare(&model, &near, SAME);
        let wide = compare(&model, &wide, FAR);
        for (how, seen) in [("near", near), ("three times as far", wide)] {
            let Seen {
                reached,
                missed,
                one_by_one,
                apart,
            } = seen;
            let kind = case.mechanism.kind();
            println!(
                "{kind}, {how}: {reached} reached, {missed} not, {one_by_one} one by one, {apart:e} apart"
            );
            assert!(reached > 0 || how != "near", "{kind}");
        }
    }
}
