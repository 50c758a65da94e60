//! Compliance budgets and sensitivities: closed forms, the independent solver, and differences.

use std::path::Path;

use hyperstat_assembly::{
    Budget, Deformation, JointStiffness, Model, Parameter, PartSource, Prepared, solve,
};
use hyperstat_elements::{Section, SectionShape};
use hyperstat_joints::{DofSet, Revolute};
use hyperstat_mechanisms::{Disk, Registry, mechanism_from_str};
use hyperstat_tests::{build, reference_folder, reference_text};
use nalgebra::{Matrix6, Point3, Rotation3, Vector6};

/// Reference mechanisms whose output has a stiffness.
const MECHANISMS: [&str; 10] = [
    "delta_elastic_joints",
    "delta_rigid_joints",
    "delta_ball_jointed_rods",
    "every_joint",
    "flexible_parallelogram",
    "hexapod_elastic_drives",
    "rigid_bodies_on_bushings",
    "single_freedom_elastic",
    "three_rps",
    "tricept",
];

fn read(text: &str) -> Model {
    mechanism_from_str(text, &reference_folder(), &Disk, &Registry::builtin())
        .expect("a valid file")
        .model
}

fn model(name: &str) -> Model {
    read(&reference_text(&format!("{name}.ron")))
}

/// Displacement and stiffness of the output by the independent solver.
fn reference(model: &Model) -> (Vector6<f64>, Matrix6<f64>) {
    let found = hyperstat_reference::solve(model).expect("a solution");
    let displacement = found.displacement.expect("a held output");
    (displacement, found.stiffness.expect("a stiffness"))
}

/// Every displacement of the output is the sum of its parts.
#[test]
fn shares_add_up_on_every_reference_mechanism() {
    for name in MECHANISMS {
        let model = model(name);
        let solution = solve(&model).expect("a solution");
        let prepared = Prepared::new(model.clone());
        let influence = prepared.here().influence().expect("a held output");
        for component in 0..6 {
            let budget = influence.budget(&solution, &Vector6::ith(component, 1.0));
            let size: f64 = budget.parts.iter().map(|p| p.displacement.abs()).sum();
            assert!(
                budget.rest.abs() <= 1e-10 * size,
                "{name}: {component}: {:e} of {size:e}",
                budget.rest
            );
            let shares: f64 = budget.parts.iter().filter_map(|p| p.share).sum();
            if budget.total.abs() > 1e-6 * size {
                assert!((shares - 1.0).abs() < 1e-4, "{name}: {shares}");
            }
        }
    }
}

/// A bar with shear areas on a driven hinge with an elastic bearing: every part of its tip's
/// displacement in closed form.
#[test]
fn parts_of_a_bar_on_an_elastic_hinge() {
    let (length, force, torque) = (0.4, 50.0, 3.0);
    let (drive, bearing) = (2e4, 3e6);
    let section = Section::new(
        SectionShape::Circle { diameter: 0.02 },
        Some(2.5e-4),
        Some(2.5e-4),
    )
    .expect("a section");
    let steel = build::steel();
    let mut model = Model::new("bar");
    let points = [
        ("O", Point3::origin()),
        ("T", Point3::new(length, 0.0, 0.0)),
    ];
    model
        .add_beam("bar", &points, &steel, &section, None, 1)
        .expect("a body");
    let stiffness = [None, Some(bearing), None, None, Some(drive), None];
    let joint = hyperstat_assembly::Connection {
        name: "hinge".into(),
        between: [None, model.node("bar", "O")],
        joint: Box::new(Revolute),
        locked: DofSet::EMPTY,
        stiffness: JointStiffness::Directions(stiffness),
    };
    // Axis y: the bar swings along z; its bearing gives along y.
    model
        .add_joint(joint, Rotation3::identity())
        .expect("a joint");
    let tip = model.node("bar", "T").expect("a node");
    model.set_output(tip);
    let load = Vector6::new(200.0, 30.0, force, torque, 0.0, 0.0);
    model.add_load(tip, load).expect("a load");
    let solution = solve(&model).expect("a solution");
    let prepared = Prepared::new(model.clone());
    let influence = prepared.here().influence().expect("a held output");
    let part = |along: usize, deformation: Deformation| {
        let budget = influence.budget(&solution, &Vector6::ith(along, 1.0));
        let parts = budget.parts.iter();
        parts
            .filter(|p| p.deformation == deformation)
            .map(|p| p.displacement)
            .sum::<f64>()
    };
    let (young, shear) = (steel.young(), steel.shear());
    let bending = |force: f64| force * length.powi(3) / (3.0 * young * section.iy());
    let expected = [
        (2, Deformation::Bending, bending(force)),
        (2, Deformation::Shear, force * length / (shear * 2.5e-4)),
        (2, Deformation::Drive, force * length * length / drive),
        (2, Deformation::Bearing, 0.0),
        (1, Deformation::Bending, bending(30.0)),
        (1, Deformation::Bearing, 30.0 / bearing),
        (1, Deformation::Drive, 0.0),
        (
            0,
            Deformation::Tension,
            200.0 * length / (young * section.area()),
        ),
        (
            3,
            Deformation::Torsion,
            torque * length / (shear * section.torsion()),
        ),
    ];
    for (along, deformation, expected) in expected {
        let found = part(along, deformation);
        assert!(
            (found - expected).abs() <= 1e-12 * expected.abs(),
            "{along} {deformation:?}: {found} {expected}"
        );
    }
    let direction = Budget::direction_of(&solution.output.displacement).expect("it moves");
    let along = influence.budget(&solution, &direction);
    let moved = solution.output.displacement.fixed_rows::<3>(0).norm();
    assert!((along.total / moved - 1.0).abs() < 1e-14);
    assert_eq!(along.by_source().len(), 2);
    assert!(along.parts[0].displacement >= along.parts[1].displacement);
}

/// u = Σ parts, and a body's parts go with the inverse of its modulus: the share of a body is
/// −E/u ∂u/∂E with its Poisson's ratio as it is, and so is a joint's with its stiffness. By
/// differences of the independent solver.
#[test]
fn shares_of_the_delta_agree_with_the_independent_solver() {
    let text = reference_text("delta_elastic_joints.ron");
    let steel = "\"steel\": (young: 210000000000.0, poisson: 0.3, density: 7850.0),";
    assert!(text.contains(steel));
    let model = read(&text);
    let solution = solve(&model).expect("a solution");
    let prepared = Prepared::new(model.clone());
    let influence = prepared.here().influence().expect("a held output");
    let along = Budget::direction_of(&solution.output.displacement).expect("it moves");
    let budget = influence.budget(&solution, &along);
    for body in ["arm1", "wrist3", "roda2"] {
        let id = model.body(body).expect("a body");
        let parts = budget
            .parts
            .iter()
            .filter(|p| p.source == PartSource::Body(id));
        let share: f64 = parts.filter_map(|p| p.share).sum();
        let change = |factor: f64| {
            let young = 2.1e11 * factor;
            let own = format!("\"own\": (young: {young:?}, poisson: 0.3),\n{steel}");
            let changed: Vec<String> = text
                .replace(steel, &own)
                .lines()
                .map(|line| {
                    let is_it = line.trim_start().starts_with(&format!("\"{body}\": Beam"));
                    if is_it {
                        line.replace("\"steel\"", "\"own\"")
                    } else {
                        line.into()
                    }
                })
                .collect();
            reference(&read(&changed.join("\n"))).0.dot(&along)
        };
        let slope = (change(1.0 + 1e-4) - change(1.0 - 1e-4)) / 2e-4;
        let expected = -slope / budget.total;
        assert!(
            (share - expected).abs() < 1e-7,
            "{body}: {share} {expected}"
        );
        assert!(share.abs() > 1e-3, "{body}: {share}");
    }
}

/// Derivatives by the parameters of two mechanisms against central differences of the
/// independent solver: of the displacement and of the output's stiffness.
#[test]
fn sensitivities_agree_with_differences_of_the_independent_solver() {
    let cases = [
        (
            "delta_elastic_joints",
            reference_text("delta_elastic_joints.ron"),
            vec![
                ("diameter", "\"arm\": Circle(diameter: 0.03)"),
                ("diameter", "\"bar\": Circle(diameter: 0.02)"),
                ("diameter", "\"rod\": Circle(diameter: 0.014)"),
                ("young", "young: 210000000000.0"),
                ("poisson", "poisson: 0.3,"),
                ("X", "x: 100000000.0"),
                ("U", "u: 100000.0"),
                ("W", "w: 100000.0"),
            ],
        ),
        (
            "every_joint",
            reference_text("every_joint.ron"),
            vec![
                ("width", "width: 0.02"),
                ("height", "height: 0.035"),
                ("young", "young: 210000000000.0"),
                ("X", "x: 100000000.0"),
                ("W", "w: 100000.0"),
                ("U", "u: 50000.0"),
                ("Y", "y: 1000000.0"),
            ],
        ),
    ];
    let mut effective = 0;
    for (name, text, parameters) in cases {
        let model = read(&text);
        let solution = solve(&model).expect("a solution");
        let prepared = Prepared::new(model.clone());
        let influence = prepared.here().influence().expect("a held output");
        let sensitivities = influence.sensitivities(&solution).expect("derivatives");
        for (parameter, written) in parameters {
            assert!(text.contains(written), "{name}: {written}");
            let digits: String = written
                .chars()
                .rev()
                .skip_while(|c| !c.is_ascii_digit())
                .take_while(|c| c.is_ascii_digit() || *c == '.')
                .collect();
            let value: f64 = digits.chars().rev().collect::<String>().parse().unwrap();
            let written_value = digits.chars().rev().collect::<String>();
            let changed = |factor: f64| {
                let new = format!("{:?}", value * factor);
                let changed = written.replace(&written_value, &new);
                reference(&read(&text.replace(written, &changed)))
            };
            // Differences at two steps, without what both have of the third derivative.
            let slope_at = |step: f64| {
                let (high, low) = (changed(1.0 + step), changed(1.0 - step));
                (
                    (high.0 - low.0) / (2.0 * step),
                    (high.1 - low.1) / (2.0 * step),
                )
            };
            let (near, far) = (slope_at(2e-4), slope_at(4e-4));
            let slope = (near.0 * 4.0 - far.0) / 3.0;
            let stiffness_slope = (near.1 * 4.0 - far.1) / 3.0;
            let named = sensitivities.iter().filter(|s| match &s.parameter {
                Parameter::Section { dimension, .. } => *dimension == parameter,
                Parameter::Material { constant, .. } => *constant == parameter,
                Parameter::Joint { direction, .. } => {
                    direction.is_some_and(|d| format!("{d:?}") == parameter)
                }
                Parameter::Mass { .. } => false,
            });
            let mine: Vec<_> = named.filter(|s| s.value == value).collect();
            assert!(!mine.is_empty(), "{name}: {parameter} at {value}");
            let found: Vector6<f64> = mine.iter().map(|s| s.displacement.unwrap() * value).sum();
            let size = solution.output.displacement.amax();
            let off = (found - slope).amax();
            assert!(off < 1e-8 * size, "{name}: {written}: {found} {slope}");
            effective += usize::from(slope.amax() > 1e-6 * size);
            let k = solution.output.stiffness.expect("a stiffness");
            let found: Matrix6<f64> = mine.iter().map(|s| s.stiffness.unwrap() * value).sum();
            for r in 0..6 {
                for c in 0..6 {
                    let scale = (k[(r, r)] * k[(c, c)]).sqrt();
                    let off = (found[(r, c)] - stiffness_slope[(r, c)]).abs();
                    assert!(
                        off < 1e-7 * scale,
                        "{name}: {written}: {r}{c} {off:e} {scale:e}"
                    );
                }
            }
        }
    }
    assert!(
        effective >= 12,
        "only {effective} of the parameters do anything"
    );
}

/// What a uniform change of all stiffness does: by Euler's theorem, the relative sensitivities to
/// every modulus and joint stiffness add to −1.
#[test]
fn sensitivities_to_all_stiffness_add_to_minus_one() {
    for name in MECHANISMS {
        if name == "flexible_parallelogram" {
            continue; // its stiffness is a file of numbers
        }
        let model = model(name);
        let solution = solve(&model).expect("a solution");
        let prepared = Prepared::new(model.clone());
        let influence = prepared.here().influence().expect("a held output");
        let sensitivities = influence.sensitivities(&solution).expect("derivatives");
        let sum: Vector6<f64> = (sensitivities.iter())
            .filter(|s| match &s.parameter {
                Parameter::Material { constant, .. } => matches!(*constant, "young" | "shear"),
                Parameter::Joint { .. } => true,
                _ => false,
            })
            .map(|s| s.displacement.unwrap() * s.value)
            .sum();
        let off = (sum + solution.output.displacement).amax();
        let size = solution.output.displacement.amax();
        assert!(off < 1e-9 * size, "{name}: {off:e} of {size:e}");
    }
}

/// A tapered console: differences of the independent solver by both ends' diameters.
#[test]
fn sensitivities_of_a_tapered_console() {
    let text = |first: f64, second: f64| {
        format!(
            "(name: \"console\", materials: {{\"s\": (young: 2.1e11, poisson: 0.3)}},
              sections: {{\"t\": Tapered(from: Tube(outer: {first:?}, inner: 0.02, shear_y: 3e-4),
                                         to: Tube(outer: {second:?}, inner: 0.01, shear_y: 2e-4))}},
              points: {{\"A\": (0.0, 0.0, 0.0), \"B\": (0.3, 0.4, 0.2)}},
              bodies: {{\"c\": Beam(through: [\"A\", \"B\"], section: \"t\", material: \"s\")}},
              joints: {{\"w\": (at: \"A\", between: (\"ground\", \"c\"), kind: Fixed)}},
              loads: [(on: (\"c\", \"B\"), force: (30.0, -20.0, 50.0), moment: (1.0, 2.0, -3.0))],
              output: (\"c\", \"B\"))"
        )
    };
    let read = |text: &str| {
        mechanism_from_str(text, Path::new("."), &Disk, &Registry::builtin())
            .expect("a valid file")
            .model
    };
    let model = read(&text(0.04, 0.03));
    let solution = solve(&model).expect("a solution");
    let prepared = Prepared::new(model.clone());
    let influence = prepared.here().influence().expect("a held output");
    let sensitivities = influence.sensitivities(&solution).expect("derivatives");
    for at_second in [false, true] {
        let value = if at_second { 0.03 } else { 0.04 };
        let changed = |factor: f64| match at_second {
            false => reference(&read(&text(0.04 * factor, 0.03))).0,
            true => reference(&read(&text(0.04, 0.03 * factor))).0,
        };
        let slope = (changed(1.0 + 1e-4) - changed(1.0 - 1e-4)) / 2e-4;
        let found = sensitivities.iter().find(|s| {
            matches!(&s.parameter, Parameter::Section { second, dimension, .. }
                if *second == at_second && *dimension == "outer")
        });
        let found = found.expect("a parameter").displacement.unwrap() * value;
        let off = (found - slope).amax();
        assert!(off < 1e-6 * slope.amax(), "{found} {slope}");
    }
}
