//! Poses: what they place is what the model is built with, and their loops close.

use std::collections::HashMap;

use hyperstat_mechanisms::prebuilt::{Prebuilt, TelescopicLeg, ThreeRps};
use hyperstat_tests::prebuilt::legs::{
    cases, hexapod, leg, linear_delta, three_prs, three_rps, tricept,
};
use hyperstat_tests::prebuilt::{CLOSED, check_loops_close, check_place_is_model, posed, position};
use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;

/// The orientation of the Tricept is that of two turns, about x and then about its own y.
#[test]
fn the_tricept_turns_as_its_middle_leg() {
    let tricept = tricept();
    let model = tricept.model(&[0.0, 0.0, 0.9]).expect("in reach");
    let mut geometry = model.geometry().clone();
    for (about_x, about_y) in [(0.0, 0.0), (0.3, 0.0), (0.0, -0.4), (0.25, 0.35_f64)] {
        let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), about_x)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), about_y);
        let place = turn * Vector3::new(0.0, 0.0, 0.95);
        let whole = tricept
            .place(place.as_slice(), &mut geometry)
            .expect("in reach");
        let found = Rotation3::from_scaled_axis(Vector3::new(whole[3], whole[4], whole[5]));
        assert!((found.matrix() - turn.matrix()).amax() < 1e-15);
    }
}

#[test]
fn links_have_the_lengths_of_their_parameters() {
    let wanted = HashMap::from([
        ("Hexapod", ("cylinder", 0.36)),
        ("LinearDelta", ("rod", 0.45)),
        ("Tricept", ("cylinder", 0.36)),
        ("ThreeRps", ("cylinder", 0.36)),
        ("ThreePrs", ("rod", 0.5)),
    ]);
    let mechanisms: [(&dyn Prebuilt, &[f64]); 5] = [
        (&hexapod(), &[0.1, 0.05, 0.75, 0.2, -0.15, 0.3]),
        (&linear_delta(), &[0.08, -0.05, 0.8]),
        (&tricept(), &[0.25, 0.2, 0.95]),
        (&three_rps(), &[0.7, 0.2, -0.1]),
        (&three_prs(), &[0.9, 0.2, -0.1]),
    ];
    for (mechanism, pose) in mechanisms {
        let model = mechanism.model(pose).expect("in reach");
        let (body, wanted) = wanted[mechanism.kind()];
        let bodies = model.bodies().iter();
        let found: Vec<_> = bodies.filter(|b| b.name.starts_with(body)).collect();
        assert!(found.len() >= 3, "{}", mechanism.kind());
        for body in found {
            let [first, .., last] = body.nodes[..] else {
                panic!("{} has one node", body.name);
            };
            let positions = &model.geometry().positions;
            let length = (positions[last.0] - positions[first.0]).norm();
            assert!((length - wanted).abs() < CLOSED, "{}: {length}", body.name);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn place_is_model((index, pose) in posed(cases)) {
        check_place_is_model(&cases()[index], &pose)?;
    }

    #[test]
    fn loops_close((index, pose) in posed(cases)) {
        check_loops_close(&cases()[index], &pose)?;
    }

    /// 3-RPS and 3-PRS: the corners stay in their planes, for tilts of any size.
    #[test]
    fn corners_stay_in_their_planes(rx in -1.5..1.5, ry in -1.5..1.5) {
        let three_rps = ThreeRps {
            leg: TelescopicLeg { lengths: (0.37, 9.0), ..leg() },
            ..three_rps()
        };
        let model = three_rps.model(&[2.0, rx, ry]).expect("in reach");
        for (number, angle) in [(1, 90.0_f64), (2, 210.0), (3, 330.0)] {
            let (sin, cos) = angle.to_radians().sin_cos();
            let corner = position(&model, "platform", &format!("S{number}"));
            let aside = corner.coords.dot(&Vector3::new(-sin, cos, 0.0));
            prop_assert!(aside.abs() < 1e-15, "S{} is {} aside", number, aside);
        }
    }
}
