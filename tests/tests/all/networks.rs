//! Networks of rigid bars on rigid and elastic joints: counts in closed form, closed forms of long
//! chains, agreement with the independent solver, and what is refused.

use hyperstat_assembly::{Model, Prepared, SolveError, analyse, solve};
use hyperstat_tests::agreement::agrees_with_reference;
use hyperstat_tests::networks::{Hinge, Sketch};
use nalgebra::Vector3;
use proptest::prelude::*;

const SPRING: f64 = 1e4;

fn assert_counts(model: &Model, mobility: usize, overconstraint: usize) {
    let counts = analyse(model).expect("counts");
    assert_eq!(
        (counts.mobility, counts.overconstraint),
        (mobility, overconstraint)
    );
    assert_eq!(counts.doubtful, None);
}

/// Two coordinates a point in the plane, less three of the bar on the ground, less one a bar; out of
/// the plane every loop repeats three conditions.
fn assert_plane_counts(sketch: &Sketch) {
    let freedoms = 2 * sketch.points.len() - 3 - sketch.bars.len();
    let hinged = sketch.model(Hinge::Elastic(SPRING));
    assert_counts(&hinged, freedoms, 3 * sketch.loops());
    let welded = sketch.model(Hinge::Weld);
    assert_counts(&welded, 0, 6 * sketch.loops());
}

#[test]
fn counts_are_those_of_closed_forms() {
    for count in [12, 90, 3000] {
        let ring = Sketch::ring(count, 0.5);
        assert_counts(&ring.model(Hinge::Elastic(SPRING)), count - 3, 3);
        assert_plane_counts(&ring);
    }
    for [columns, rows] in [[8, 1], [700, 1], [12, 9], [30, 30]] {
        assert_plane_counts(&Sketch::grid(columns, rows));
    }
    // In space on ball joints: three coordinates a point, six of the bar on the ground less its turn
    // about itself, less one a bar; and every other bar turns about itself.
    for sketch in [Sketch::ring(1000, 0.5), Sketch::grid(20, 20)] {
        let sketch = sketch.warped(0.3);
        assert_counts(
            &sketch.model(Hinge::Ball(SPRING)),
            3 * sketch.points.len() - 6,
            0,
        );
    }
}

/// Every spring turns by the moment about it over its stiffness.
#[test]
fn a_long_chain_bends_as_its_springs_turn() {
    for [count, rise] in [[30.0, 0.5], [3000.0, 0.5], [3000.0, 0.0]] {
        let sketch = Sketch::chain(count as usize, rise);
        let model = sketch.model(Hinge::Elastic(SPRING));
        let middle = sketch.bars.len() / 2;
        let tip = sketch.points[middle + 1];
        let load = model.loads()[0].wrench;
        let (force, moment) = (load.fixed_rows::<3>(0), load.fixed_rows::<3>(3));
        let mut moved = Vector3::zeros();
        let mut turned = 0.0;
        for point in &sketch.points[1..=middle] {
            let arm = tip - point;
            let turn = (arm.cross(&force) + moment).z / SPRING;
            moved += Vector3::z().cross(&arm) * turn;
            turned += turn;
        }
        let solution = solve(&model).expect("a solution");
        let found = solution.output.displacement;
        let near = |found: f64, expected: f64, scale: f64| {
            assert!(
                (found - expected).abs() <= 1e-11 * scale,
                "{found:e} instead of {expected:e}"
            );
        };
        for k in 0..3 {
            near(found[k], moved[k], moved.norm());
        }
        near(found[5], turned, turned.abs());
        // Nothing but the load goes through the hinges: its moment about each.
        let first = solution.joint_wrenches[0].expect("a wrench");
        near(first.fixed_rows::<3>(0).norm(), force.norm(), force.norm());
    }
}

/// A pose of a sweep gives what a solve gives, in another configuration too.
#[test]
fn a_pose_of_a_sweep_is_a_solve() {
    for sketch in [Sketch::ring(400, 0.5), Sketch::grid(14, 14)] {
        let prepared = Prepared::new(sketch.model(Hinge::Elastic(SPRING)));
        let mut workspace = prepared.workspace().expect("a plan");
        let mut moved = prepared.model().geometry().clone();
        for position in &mut moved.positions {
            let [x, y] = [position.x, position.y];
            position.x += 0.05 * (3.0 * y).sin();
            position.y += 0.05 * (2.0 * x).cos();
        }
        for geometry in [prepared.model().geometry(), &moved] {
            let swept = prepared.sweep(geometry, &mut workspace).expect("a pose");
            let solved = prepared.at(geometry).expect("a geometry");
            let solved = solved.solve().expect("a solution");
            let own = swept.displacement.expect("a displacement");
            let other = solved.output.displacement;
            assert!((own - other).norm() <= 1e-9 * other.norm(), "{own} {other}");
        }
    }
}

/// A bar of a polygon of very many sides is nearly in line with the next: how far the one moves along
/// itself depends on how all others turn.
#[test]
fn what_couples_all_bodies_is_refused() {
    let error = solve(&Sketch::ring(12_000, 0.0).model(Hinge::Elastic(SPRING)));
    let Err(SolveError::TooLarge { numbers, limit, .. }) = error else {
        panic!("{error:?}");
    };
    assert!(numbers > limit);
}

fn sketches() -> impl Strategy<Value = Sketch> {
    let kinds = (0..4_usize, 0..40_usize, 0.0..0.7);
    kinds.prop_map(|(kind, more, offset)| match kind {
        0 => Sketch::ring(4 + more, offset),
        1 => Sketch::chain(2 + more, offset),
        2 => Sketch::grid(1 + more / 3, 1),
        _ => Sketch::grid(1 + more / 10, 1 + more % 4),
    })
}

fn hinges() -> impl Strategy<Value = Hinge> {
    prop_oneof![
        Just(Hinge::Free),
        Just(Hinge::Locked),
        (1e2..1e6).prop_map(Hinge::Elastic),
        Just(Hinge::Weld),
        (1e2..1e6).prop_map(Hinge::Ball),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn networks_agree_with_the_independent_solver(
        sketch in sketches(),
        hinge in hinges(),
        height in prop_oneof![Just(0.0), 0.1..0.5],
    ) {
        agrees_with_reference(&sketch.warped(height).model(hinge))?;
    }
}
