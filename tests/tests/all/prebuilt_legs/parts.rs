//! Parts of the models: which joints are drives, and what is made of what.

use hyperstat_assembly::{JointStiffness, Model};
use hyperstat_joints::Dof;
use hyperstat_mechanisms::prebuilt::{
    Hexapod, LinearDelta, Link, Prebuilt, TelescopicLeg, ThreePrs, ThreeRps, Tricept,
};
use hyperstat_tests::prebuilt::legs::{hexapod, leg, linear_delta, three_prs, three_rps, tricept};
use hyperstat_tests::prebuilt::{BEARINGS, flat, round, tube};

const DRIVE: Option<f64> = Some(4e7);

/// Joints of a model by kind, of which the locked ones are drives: all of the stiffness that they
/// take of [`BEARINGS`] and [`DRIVE`].
fn joints(model: &Model) -> Vec<(&str, usize)> {
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for joint in model.joints() {
        let kind = joint.joint.kind();
        let locked = !joint.locked.is_empty();
        let [x, y, z, u, _, w] = BEARINGS;
        let expected = match (kind, locked) {
            ("Prismatic", true) => [None, DRIVE, None, None, None, None],
            ("Universal", false) => [x, y, z, None, None, w],
            ("Revolute", false) => [x, y, z, u, None, w],
            ("Spherical", false) => [x, y, z, None, None, None],
            ("Prismatic" | "Fixed", false) => [None; 6],
            other => panic!("{}: {other:?}", joint.name),
        };
        if locked {
            assert_eq!(
                joint.locked,
                [Dof::Y].into_iter().collect(),
                "{}",
                joint.name
            );
        }
        let expected = JointStiffness::Directions(expected);
        assert_eq!(joint.stiffness, expected, "{}", joint.name);
        let word = if locked { "drive" } else { kind };
        match counts.iter_mut().find(|(kind, _)| *kind == word) {
            Some((_, count)) => *count += 1,
            None => counts.push((word, 1)),
        }
    }
    counts.sort_unstable();
    counts
}

/// Asserts that all bodies whose names start with a word are made of its link, of 2 elements.
fn assert_made_of(model: &Model, links: &[(&str, &Link)]) {
    for segment in model.segments() {
        let name = &model.bodies()[segment.body.0].name;
        let link = links.iter().find(|(word, _)| name.starts_with(word));
        let (_, link) = link.unwrap_or_else(|| panic!("{name}"));
        assert_eq!(segment.section, link.section, "{name}");
        assert_eq!(segment.material, link.material, "{name}");
        assert_eq!(segment.elements, 2, "{name}");
    }
}

#[test]
fn joints_and_links_are_as_the_parameters_say() {
    let (joint_stiffness, drive_stiffness, elements) = (BEARINGS, DRIVE, 2);
    let TelescopicLeg {
        cylinder, piston, ..
    } = leg();
    let (outer, inner, rod) = (tube(0.08, 0.06), round(0.055), flat(0.03, 0.02));
    let legs = [("cylinder", &cylinder), ("piston", &piston)];
    let middle = [("tube", &outer), ("spline", &inner), legs[0], legs[1]];
    let hexapod = Hexapod {
        joint_stiffness,
        drive_stiffness,
        elements,
        ..hexapod()
    };
    let linear_delta = LinearDelta {
        rod: rod.clone(),
        joint_stiffness,
        drive_stiffness,
        elements,
        ..linear_delta()
    };
    let tricept = Tricept {
        leg: leg(),
        tube: outer.clone(),
        spline: inner.clone(),
        joint_stiffness,
        drive_stiffness,
        elements,
        ..tricept()
    };
    let three_rps = ThreeRps {
        joint_stiffness,
        drive_stiffness,
        elements,
        ..three_rps()
    };
    let three_prs = ThreePrs {
        rod: rod.clone(),
        joint_stiffness,
        drive_stiffness,
        elements,
        ..three_prs()
    };
    type Row<'a> = (
        &'a dyn Prebuilt,
        &'a [f64],
        &'a [(&'a str, &'a Link)],
        &'a [(&'a str, usize)],
    );
    let rods = [("rod", &rod)];
    let cases: [Row<'_>; 5] = [
        (
            &hexapod,
            &[0.0, 0.0, 0.8, 0.0, 0.0, 0.0],
            &legs,
            &[("Spherical", 6), ("Universal", 6), ("drive", 6)],
        ),
        (
            &linear_delta,
            &[0.0, 0.0, 0.7],
            &rods,
            &[("Spherical", 6), ("Universal", 6), ("drive", 3)],
        ),
        (
            &tricept,
            &[0.0, 0.1, 0.9],
            &middle,
            &[
                ("Fixed", 1),
                ("Prismatic", 1),
                ("Spherical", 3),
                ("Universal", 4),
                ("drive", 3),
            ],
        ),
        (
            &three_rps,
            &[0.7, 0.1, 0.0],
            &legs,
            &[("Revolute", 3), ("Spherical", 3), ("drive", 3)],
        ),
        (
            &three_prs,
            &[0.9, 0.1, 0.0],
            &rods,
            &[("Revolute", 3), ("Spherical", 3), ("drive", 3)],
        ),
    ];
    for (mechanism, pose, links, counts) in cases {
        let model = mechanism.model(pose).expect("in reach");
        assert_eq!(joints(&model), counts, "{}", mechanism.kind());
        assert_made_of(&model, links);
    }
}
