//! Beams whose section changes, in the model and in mechanism files.

use std::path::Path;

use hyperstat_assembly::{JointStiffness, Member, Model, Tapering, solve};
use hyperstat_elements::{Section, SectionShape};
use hyperstat_joints::Universal;
use hyperstat_mechanisms::{Disk, Registry, mechanism_from_str};
use hyperstat_tests::agreement::agrees_with_reference;
use hyperstat_tests::build::{circle, connection, member, node, steel, weld_to_ground};
use hyperstat_tests::{stiffness, stiffness_difference};
use nalgebra::{Point3, Rotation3, Vector6};

const LOAD: [f64; 6] = [120.0, -80.0, 200.0, 4.0, -7.0, 11.0];

fn rectangle(width: f64, height: f64) -> Section {
    let shape = SectionShape::Rectangle { width, height };
    Section::new(shape, Some(0.8 * width * height), None).expect("a section")
}

/// A round bar whose diameter changes linearly: u = F L / (E √(A1 A2)), v = F L³ / (3 E I1) · d1/d2.
#[test]
fn a_tapered_console_follows_its_closed_form() {
    let (d1, d2, length) = (0.04, 0.025, 0.8);
    for reversed in [false, true] {
        let mut model = Model::new("console");
        let points = [
            ("wall", Point3::origin()),
            ("tip", Point3::new(length, 0.0, 0.0)),
        ];
        let (ends, from, to) = if reversed {
            ([1, 0], d2, d1)
        } else {
            ([0, 1], d1, d2)
        };
        let tapered = Member {
            taper: Some(Tapering::whole(circle(to))),
            ..member(ends, &steel(), &circle(from))
        };
        model
            .add_elastic("bar", &points, &[tapered])
            .expect("a bar");
        weld_to_ground(&mut model, "bar", "wall");
        let tip = node(&model, "bar", "tip");
        model.set_output(tip);
        model
            .add_load(tip, Vector6::new(1e3, 0.0, -1e3, 0.0, 0.0, 0.0))
            .expect("a load");
        let u = solve(&model).expect("a solution").output.displacement;
        let young = steel().young();
        let inertia = std::f64::consts::PI * f64::powi(d1, 4) / 64.0;
        let [a1, a2] = [d1, d2].map(|d| circle(d).area());
        let stretch = 1e3 * length / (young * (a1 * a2).sqrt());
        let bending = -1e3 * length.powi(3) / (3.0 * young * inertia * (d2 / d1));
        assert!((u[0] / stretch - 1.0).abs() < 1e-12, "{}", u[0] / stretch);
        assert!((u[2] / bending - 1.0).abs() < 1e-12, "{}", u[2] / bending);
    }
}

/// Elastic joints in the middle of a run that is run through backwards, tapered segments in it.
#[test]
fn absorbed_joints_inside_tapered_runs_agree_with_the_independent_solver() {
    let mut model = Model::new("run");
    let points = [
        ("a", Point3::new(0.0, 0.0, 0.0)),
        ("b", Point3::new(0.4, 0.1, 0.0)),
        ("c", Point3::new(0.7, 0.0, 0.2)),
        ("d", Point3::new(1.1, 0.1, 0.1)),
    ];
    let mut members: Vec<Member> = [[1, 0], [1, 2], [3, 2]]
        .map(|ends| member(ends, &steel(), &rectangle(0.02, 0.05)))
        .into();
    for tapered in &mut members {
        tapered.taper = Some(Tapering::whole(rectangle(0.06, 0.03)));
    }
    model.add_elastic("run", &points, &members).expect("a body");
    model
        .add_rigid("plate", &[("b", points[1].1), ("c", points[2].1)])
        .expect("a plate");
    weld_to_ground(&mut model, "run", "a");
    for point in ["b", "c"] {
        let between = ["run", "plate"].map(|body| Some(node(&model, body, point)));
        let mut joint = connection(point, between, Universal);
        joint.stiffness = JointStiffness::Directions([
            Some(3e7),
            Some(1e7),
            Some(2e8),
            None,
            Some(1e4),
            Some(2e5),
        ]);
        model
            .add_joint(joint, Rotation3::from_euler_angles(0.3, 0.2, 0.1))
            .expect("a joint");
    }
    for (body, point) in [("run", "b"), ("run", "d"), ("plate", "c")] {
        let on = node(&model, body, point);
        model.add_load(on, LOAD.into()).expect("a load");
    }
    model.set_output(node(&model, "run", "d"));
    assert!(agrees_with_reference(&model).expect("agreement"));
}

/// A taper named for a whole beam runs along all of it, a list has a section for each segment, and
/// a frame's member is read like a beam.
#[test]
fn tapers_and_sections_are_read_along_a_beam() {
    let solution = |bodies: &str| {
        let text = r#"(
            name: "console",
            materials: { "steel": (young: 2.1e11, poisson: 0.3) },
            sections: {
                "whole": Tapered(from: Circle(diameter: 0.05), to: Circle(diameter: 0.02)),
                "first": Tapered(from: Circle(diameter: 0.05), to: Circle(diameter: 0.04)),
                "second": Tapered(from: Circle(diameter: 0.04), to: Circle(diameter: 0.02)),
            },
            points: { "A": (0, 0, 0), "B": (0, 0.2, 0), "C": (0, 0.6, 0) },
            bodies: { "arm": BODY },
            joints: { "wall": (at: "A", between: ("ground", "arm"), kind: Fixed) },
            loads: [(on: ("arm", "C"), force: (100, 200, 300), moment: (1, 2, 3))],
            output: ("arm", "C"),
        )"#;
        let text = text.replace("BODY", bodies);
        let mechanism =
            mechanism_from_str(&text, Path::new("console.ron"), &Disk, &Registry::builtin());
        let mechanism = mechanism.unwrap_or_else(|error| panic!("{error}"));
        solve(&mechanism.model).expect("a solution")
    };
    let expected = solution(
        r#"Beam(through: ["A", "B", "C"], section: ["first", "second"], material: "steel")"#,
    );
    for body in [
        r#"Beam(through: ["A", "B", "C"], section: "whole", material: "steel")"#,
        r#"Frame(members: [["A", "B", "C"]], section: "whole", material: "steel")"#,
        r#"Frame(members: [["A", "B"], (through: ["B", "C"], section: "second")],
            section: "first", material: "steel")"#,
    ] {
        let found = solution(body);
        let difference = stiffness_difference(&stiffness(&found), &stiffness(&expected));
        assert!(difference < 1e-11, "{body}: K_o {difference:e}");
        let [u, expected] = [&found, &expected].map(|s| s.output.displacement);
        let off = (u - expected).amax();
        assert!(off < 1e-11 * expected.amax(), "{body}: u {off:e}");
    }
}
