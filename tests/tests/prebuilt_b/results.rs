//! Counts and numbers.

use hyperstat_assembly::solve;
use hyperstat_mechanisms::prebuilt::{Orthoglide, Prebuilt, Tripteron};
use hyperstat_tests::{stiffness, stiffness_difference, vector_differences};
use nalgebra::Matrix3;

use crate::FLOOR;
use crate::mechanisms::{cases, loaded, orthoglide, tripteron};

/// Between the two solvers, both of which refine.
const AGREEMENT: f64 = 1e-9;

#[test]
fn mobility_and_over_constraint_are_those_of_the_literature() {
    for case in cases() {
        for pose in &case.poses {
            let what = format!("{} {pose:?}", case.mechanism.kind());
            let solution = solve(&loaded(&*case.mechanism, pose)).expect(&what);
            let counts = [solution.mobility, solution.overconstraint];
            assert_eq!(counts, case.counts, "{what}");
            assert!(solution.idle.is_empty(), "{what}");
            assert!(
                solution.warnings.is_empty(),
                "{what}: {:?}",
                solution.warnings
            );
        }
    }
}

#[test]
fn stiffness_and_displacement_are_the_independent_solver_s() {
    for case in cases() {
        for pose in &case.poses {
            let what = format!("{} {pose:?}", case.mechanism.kind());
            let model = loaded(&*case.mechanism, pose);
            let found = solve(&model).expect(&what);
            let expected = hyperstat_reference::solve(&model).expect(&what);
            let wanted = expected.stiffness.expect(&what);
            let difference = stiffness_difference(&stiffness(&found), &wanted);
            assert!(difference <= AGREEMENT, "{what}: K_o {difference:e}");
            let nodes = found.displacements.iter().zip(&expected.displacements);
            let difference = vector_differences(nodes, FLOOR);
            assert!(
                difference.iter().all(|d| *d <= AGREEMENT),
                "{what}: displacements {difference:?}"
            );
            let output = expected.displacement.expect(&what);
            let difference = vector_differences([(&found.output.displacement, &output)], FLOOR);
            assert!(
                difference.iter().all(|d| *d <= AGREEMENT),
                "{what}: output {difference:?}"
            );
        }
    }
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
