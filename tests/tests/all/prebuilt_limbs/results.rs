//! Counts and numbers.

use hyperstat_assembly::solve;
use hyperstat_mechanisms::prebuilt::{Orthoglide, Prebuilt, Tripteron};
use hyperstat_tests::prebuilt::links::{cases, orthoglide, tripteron};
use hyperstat_tests::prebuilt::{assert_counts, assert_solved_as_by_reference, loaded};
use nalgebra::Matrix3;

#[test]
fn mobility_and_over_constraint_are_those_of_the_literature() {
    cases().iter().for_each(assert_counts);
}

#[test]
fn stiffness_and_displacement_are_the_independent_solver_s() {
    cases().iter().for_each(assert_solved_as_by_reference);
}

/// Elastic drives much softer than all else give the platform their own stiffness where each
/// moves one coordinate: everywhere in the Tripteron, at the origin in the Orthoglide.
#[test]
fn drives_that_move_one_coordinate_each_are_its_stiffness() {
    const DRIVE: f64 = 10.0;
    let tripteron = Tripteron {
        drive_stiffness: Some(DRIVE),
        ..tripteron()
    };
    let orthoglide = Orthoglide {
        drive_stiffness: Some(DRIVE),
        ..orthoglide()
    };
    let cases: [(&dyn Prebuilt, [f64; 3]); 3] = [
        (&tripteron, [0.0, 0.0, 0.0]),
        (&tripteron, [0.06, -0.04, 0.08]),
        (&orthoglide, [0.0, 0.0, 0.0]),
    ];
    for (mechanism, pose) in cases {
        let solution = solve(&loaded(mechanism, &pose)).expect("a solution");
        let compliance = solution.output.compliance.expect("no free motion");
        let linear = compliance.fixed_view::<3, 3>(0, 0) * DRIVE;
        let difference = (linear - Matrix3::identity()).amax();
        assert!(difference < 1e-3, "{} {pose:?}: {linear}", mechanism.kind());
    }
}
