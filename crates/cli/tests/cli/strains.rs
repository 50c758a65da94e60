//! Strains at worst points (Eq. 46), nodal forces in global axes and joint frames (the paper's §2.3),
//! against closed forms and equilibrium.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};
use serde_json::Value;

use crate::support::{Bench, CANTILEVER, assert_near, delta_batch, numbers};

const EXACT: f64 = 1e-12;

/// The bar of the help: 20 mm, 0.5 m along x, 100 N down and 10 N·m about x at its end; cold, and 20 K
/// warmer, which only makes it longer.
#[test]
fn the_strains_of_a_cantilever_are_the_textbook_s() {
    let bench = Bench::new("strains-cantilever");
    let warm = CANTILEVER
        .replace("poisson: 0.3", "poisson: 0.3, expansion: 1.2e-5")
        .replace(
            "material: \"steel\")",
            "material: \"steel\", temperature: 20.0)",
        );
    assert!(warm.contains("temperature"));
    let (force, torque, length, radius) = (100.0, 10.0, 0.5, 0.01_f64);
    let (young, shear) = (2.1e11, 2.1e11 / 2.6);
    let inertia = PI * radius.powi(4) / 4.0;
    let curvature = force * length / (young * inertia);
    let twist = torque / (shear * 2.0 * inertia);
    for (text, heat) in [(CANTILEVER, 0.0), (&*warm, 1.2e-5 * 20.0)] {
        bench.file("bar.ron", text);
        let outcome = bench.hyperstat(&["solve", "bar.ron", "--format", "json"]);
        let report = outcome.ends_with(0).json();
        let worst = &report["bodies"]["bar"]["worst"];
        assert_eq!(worst["at"], 0.0);
        let strain = &worst["strain"];
        let normal = strain["normal"].as_f64().unwrap();
        assert_near(normal, curvature * radius + heat, EXACT, curvature * radius);
        let found = strain["shear"].as_f64().unwrap();
        assert_near(found, twist * radius, EXACT, twist * radius);
        // The load bends the bar down: the rotation about y grows towards the tip.
        let section = [heat, 0.0, 0.0, twist, curvature, 0.0];
        for (found, expected) in numbers(&strain["section"]).into_iter().zip(section) {
            assert_near(found, expected, EXACT, curvature);
        }
        let text = bench.hyperstat(&["solve", "bar.ron"]).ends_with(0);
        let row = text
            .out()
            .lines()
            .find(|line| line.starts_with("  bar   A-B"));
        let row: Vec<_> = row.unwrap().split_whitespace().collect();
        let [.., printed, sheared] = &*row else {
            panic!("{row:?}");
        };
        assert_near(printed.parse().unwrap(), normal, 1e-5, normal);
        assert_near(
            sheared.parse().unwrap(),
            twist * radius,
            1e-5,
            twist * radius,
        );
    }
}

/// Force and moment of a wrench.
fn parts(wrench: &Value) -> [Vector3<f64>; 2] {
    let wrench = numbers(wrench);
    [
        Vector3::from_column_slice(&wrench[..3]),
        Vector3::from_column_slice(&wrench[3..]),
    ]
}

/// The place of a joint, and its frame as columns.
fn frame(joint: &Value) -> (Vector3<f64>, Matrix3<f64>) {
    let frame = &joint["frame"];
    let axes: Vec<_> = (frame["axes"].as_array().unwrap().iter())
        .map(|axis| Vector3::from_vec(numbers(axis)))
        .collect();
    let origin = Vector3::from_vec(numbers(&frame["origin"]));
    (origin, Matrix3::from_columns(&axes))
}

#[test]
fn frames_and_global_forces_are_in_equilibrium() {
    let bench = Bench::new("strains-equilibrium");
    let place = [-0.05, 0.11, 0.5];
    let poses = format!("List([({}, {}, {})])", place[0], place[1], place[2]);
    bench.file("delta.ron", &delta_batch("delta", &poses, ""));
    let outcome = bench.hyperstat(&["solve", "delta.ron", "--format", "json"]);
    let report = outcome.ends_with(0).json();

    // The ground's three joints hold the load: forces, and moments about the origin.
    let load = [
        Vector3::new(-20.0, 10.0, 100.0),
        Vector3::new(5.0, 5.0, 8.0),
    ];
    let mut force = load[0];
    let mut moment = load[1] + Vector3::from(place).cross(&load[0]);
    for (limb, angle) in [(1, 90_f64), (2, 210.0), (3, 330.0)] {
        let name = format!("A{limb}");
        let (origin, axes) = frame(&report["joints"][&name]);
        // On the base's circle, its y the axis of the arm, its x outward.
        let (sin, cos) = angle.to_radians().sin_cos();
        assert!((origin - Vector3::new(cos, sin, 0.0) * 0.25).norm() < EXACT);
        assert!((axes.column(0) - Vector3::new(cos, sin, 0.0)).norm() < EXACT);
        assert!((axes.column(1) - Vector3::new(sin, -cos, 0.0)).norm() < EXACT);
        assert!((axes * axes.transpose() - Matrix3::identity()).norm() < EXACT);
        let [f, m] = parts(&report["joints"][&name]["wrench"]).map(|part| axes * part);
        force += f;
        moment += m + origin.cross(&f);
        // Nothing else acts on the arm's first node.
        let segments = report["segments"].as_array().unwrap();
        let arm = segments
            .iter()
            .find(|segment| segment["body"] == *format!("arm{limb}"))
            .unwrap();
        let [found, turning] = parts(&arm["end_forces_global"][0]);
        assert!((found - f).norm() < 1e-10 * 100.0, "{found} {f}");
        assert!((turning - m).norm() < 1e-10 * 100.0, "{turning} {m}");
    }
    assert!(force.norm() < 1e-10 * 100.0, "{force}");
    assert!(moment.norm() < 1e-10 * 100.0, "{moment}");

    // Every segment by itself, about its first node.
    for segment in report["segments"].as_array().unwrap() {
        let along = Vector3::from_vec(numbers(&segment["axes"][0]));
        let arm = along * segment["length"].as_f64().unwrap();
        let [[f1, m1], [f2, m2]] = [0, 1].map(|end| parts(&segment["end_forces_global"][end]));
        assert!((f1 + f2).norm() < 1e-10 * 100.0);
        assert!((m1 + m2 + arm.cross(&f2)).norm() < 1e-10 * 100.0);
    }
}
