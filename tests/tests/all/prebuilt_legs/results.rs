//! Counts and numbers.

use hyperstat_assembly::{Model, solve};
use hyperstat_mechanisms::prebuilt::{Hexapod, LinearDelta, Rails};
use hyperstat_tests::prebuilt::legs::{EDGE, cases, cubic, hexapod, linear_delta, tricept};
use hyperstat_tests::prebuilt::{
    assert_counts, assert_solved_as_by_reference, loaded, position, solved,
};
use hyperstat_tests::{reference_text, stiffness, stiffness_difference, turned_matrix};
use nalgebra::{Matrix3, Matrix6, Point3, Rotation3, Vector3, Vector6};

#[test]
fn mobility_and_over_constraint_are_those_of_the_literature() {
    cases().iter().for_each(assert_counts);
}

#[test]
fn stiffness_and_displacement_are_the_independent_solver_s() {
    cases().iter().for_each(assert_solved_as_by_reference);
}

/// The Tricept in the 60-digit results of `tests/reference`: there leg 1 stands over +x, and the
/// middle leg's first axis along y.
#[test]
fn the_tricept_is_that_of_the_reference_results() {
    let quarter = Rotation3::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
    let place = quarter * Point3::new(0.1, 0.05, 0.9);
    let found = stiffness(&solved(&tricept(), place.coords.as_slice()));

    let text = reference_text("tricept.json");
    let reference: serde_json::Value = serde_json::from_str(&text).expect("valid JSON");
    let rows = &reference["output_stiffness"];
    let expected = Matrix6::from_fn(|r, c| rows[r][c].as_f64().expect("a number"));
    let difference = stiffness_difference(&found, &turned_matrix(&quarter, &expected));
    assert!(difference < 1e-12, "{difference:e}");
}

/// The legs of a hexapod as unit wrenches, with their lengths (m).
fn leg_wrenches(model: &Model) -> [(Vector6<f64>, f64); 6] {
    let centre = position(model, "platform", "P");
    std::array::from_fn(|index| {
        let number = index + 1;
        let base = position(model, &format!("cylinder{number}"), &format!("B{number}"));
        let top = position(model, "platform", &format!("S{number}"));
        let along = (top - base).normalize();
        let moment = (top - centre).cross(&along);
        let wrench = [along.as_slice(), moment.as_slice()].concat();
        (Vector6::from_column_slice(&wrench), (top - base).norm())
    })
}

/// K = Σ k w wᵀ with a leg's wrench w and its cylinder, drive and piston in series.
#[test]
fn hexapods_are_their_legs_axial_stiffnesses() {
    let drive = 1e7;
    let elastic = Hexapod {
        drive_stiffness: Some(drive),
        ..hexapod()
    };
    for (hexapod, drive_compliance, pose) in [
        (hexapod(), 0.0, [0.1, 0.05, 0.75, 0.2, -0.15, 0.3]),
        (elastic, 1.0 / drive, [-0.08, 0.1, 0.9, -0.3, 0.1, -0.2]),
        (cubic(), 0.0, [0.03, -0.02, 0.36, 0.1, -0.1, 0.15]),
    ] {
        let [cylinder, piston] = [&hexapod.leg.cylinder, &hexapod.leg.piston]
            .map(|link| link.section.area() * link.material.young());
        let inside = hexapod.leg.cylinder_length;
        let model = loaded(&hexapod, &pose);
        let mut expected = Matrix6::zeros();
        for (wrench, length) in leg_wrenches(&model) {
            let compliance = inside / cylinder + (length - inside) / piston + drive_compliance;
            expected += wrench * wrench.transpose() / compliance;
        }
        let found = stiffness(&solve(&model).expect("a solution"));
        let difference = stiffness_difference(&found, &expected);
        assert!(difference < 1e-11, "{pose:?}: {difference:e}");
    }
}

/// Geng and Haynes (1994): neighbouring legs are normal to each other, so that the platform is
/// equally stiff along all directions.
#[test]
fn the_cubic_hexapod_is_isotropic_at_home() {
    let model = loaded(&cubic(), &[0.0, 0.0, EDGE / 3.0_f64.sqrt(), 0.0, 0.0, 0.0]);
    let legs = leg_wrenches(&model);
    for (wrench, length) in &legs {
        assert!((length - EDGE).abs() < 1e-15);
        let along = wrench.fixed_rows::<3>(0);
        let normal =
            |(other, _): &&(Vector6<f64>, f64)| along.dot(&other.fixed_rows::<3>(0)).abs() < 1e-15;
        assert_eq!(legs.iter().filter(normal).count(), 4);
    }
    let found = stiffness(&solve(&model).expect("a solution"));
    let linear = found.fixed_view::<3, 3>(0, 0).into_owned();
    let level = linear.trace() / 3.0;
    assert!(
        (linear / level - Matrix3::identity()).amax() < 1e-12,
        "{linear}"
    );
}

/// Drives much softer than all else give K = k Σ j jᵀ along x, y and z, with the travel j · dp of
/// a carriage for a step dp of the platform: rods r keep their length, r · (dp − d travel) = 0.
#[test]
fn soft_drives_of_the_linear_delta_follow_its_rods() {
    const DRIVE: f64 = 10.0;
    for tilt in [0.0, 0.6] {
        let delta = LinearDelta {
            drive_stiffness: Some(DRIVE),
            rails: Rails {
                tilt,
                ..linear_delta().rails
            },
            ..linear_delta()
        };
        let model = loaded(&delta, &[0.08, -0.05, 0.7]);
        let mut expected = Matrix3::zeros();
        for (index, angle) in [90.0_f64, 210.0, 330.0].into_iter().enumerate() {
            let number = index + 1;
            let (sin, cos) = angle.to_radians().sin_cos();
            let inward = -Vector3::new(cos, sin, 0.0);
            let rail = Vector3::z() * tilt.cos() + inward * tilt.sin();
            let rod = format!("roda{number}");
            let rod = position(&model, &rod, &format!("Ca{number}"))
                - position(&model, &rod, &format!("Aa{number}"));
            let travel = rod / rod.dot(&rail);
            expected += travel * travel.transpose();
        }
        let solution = solve(&model).expect("a solution");
        let compliance = solution.output.compliance.expect("no free motion");
        let linear = compliance.fixed_view::<3, 3>(0, 0) * DRIVE;
        let product = linear * expected;
        assert!((product - Matrix3::identity()).amax() < 1e-3, "{product}");
    }
}
