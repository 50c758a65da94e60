//! Derivatives of natural frequencies.

use hyperstat_assembly::{BeamMass, ModalOptions, ModalPlan, ModalSensitivities, Model, Parameter};
use hyperstat_elements::{MassShape, RotaryInertia};
use hyperstat_mechanisms::{Disk, Registry, batch_from_str};
use hyperstat_tests::reference_text;

use super::{console, label, larger, near, read, slope, value};

fn sensitivities(model: &Model, options: &ModalOptions) -> ModalSensitivities {
    let plan = ModalPlan::new(model, options).expect("a plan");
    plan.sensitivities(model.geometry()).expect("derivatives")
}

/// Relative derivatives of a frequency by a parameter.
fn relative(found: &ModalSensitivities, name: &str, place: usize) -> f64 {
    let parameters = &found.parameters;
    let parameter = parameters.iter().find(|s| label(&s.parameter) == name);
    let parameter = parameter.unwrap_or_else(|| panic!("no {name}"));
    parameter.relative(&found.frequencies, place).unwrap()
}

/// Bernoulli's beam: bending goes with √(EI/ρA), hence with d √(E/ρ), in two planes at once;
/// tension with √(E/ρ), torsion with √(G/ρ). Whatever the number of elements: all of these are
/// factors on whole matrices.
#[test]
fn frequencies_of_a_round_console() {
    for (elements, mass) in [
        (1, BeamMass::Consistent),
        (4, BeamMass::Consistent),
        (4, BeamMass::Lumped),
        (1, BeamMass::Exact),
    ] {
        let model = read(&console("Circle(diameter: 0.02)", elements, ""));
        let options = ModalOptions {
            mass,
            ..ModalOptions::lowest(12)
        };
        let found = sensitivities(&model, &options);
        let (mut bent, mut other) = (0, 0);
        for group in &found.groups {
            for place in group.clone() {
                near(relative(&found, "density", place), -0.5, "density");
                near(relative(&found, "young", place), 0.5, "young");
                near(
                    relative(&found, "diameter", place),
                    f64::from(group.len() == 2),
                    "diameter",
                );
                // ν/G ∂G/∂ν / 2 where it twists.
                let poisson = relative(&found, "poisson", place);
                let twists = group.len() == 1 && poisson < -1e-9;
                near(poisson, if twists { -0.15 / 1.3 } else { 0.0 }, "poisson");
                bent += usize::from(group.len() == 2);
                other += usize::from(group.len() != 2);
            }
        }
        assert!(bent >= 4 && other + bent >= 6, "{bent} {other}");
    }
}

/// A mass at the tip, its inertia left out, of a beam without mass: ω² = 3EI/(m L³).
#[test]
fn frequency_of_a_mass_on_a_light_console() {
    let text = console(
        "Circle(diameter: 0.02)",
        1,
        "masses: [(on: (\"bar\", \"B\"), mass: 2.0)],",
    );
    let model = read(&text.replace("density: 7850.0", "density: 0.0"));
    let found = sensitivities(&model, &ModalOptions::lowest(1));
    // Both planes are found, though one is asked for.
    assert_eq!(found.frequencies.len(), 2);
    let inertia = std::f64::consts::PI * 0.02_f64.powi(4) / 64.0;
    let expected = (3.0 * 2.1e11 * inertia / (2.0 * 0.125)).sqrt() / std::f64::consts::TAU;
    for place in [0, 1] {
        near(found.frequencies[place] / expected, 1.0, "frequency");
        near(relative(&found, "mass", place), -0.5, "mass");
        near(relative(&found, "diameter", place), 2.0, "diameter");
    }
}

/// A mechanism, its parameters as they are written with their names, and how masses are made.
struct Sample {
    name: &'static str,
    text: String,
    parameters: Vec<(&'static str, &'static str)>,
    options: ModalOptions,
}

/// A file of the reference with a mass on the platform.
fn with_mass(file: &str, body: &str, point: &str) -> String {
    let masses = format!(
        "masses: [(on: (\"{body}\", \"{point}\"), mass: 1.5, inertia: (2e-3, 3e-3, 4e-3))],\n    output:"
    );
    reference_text(file).replace("output:", &masses)
}

fn samples() -> Vec<Sample> {
    let timoshenko = ModalOptions {
        shape: MassShape::Exact,
        rotary_inertia: RotaryInertia::Included,
        ..ModalOptions::consistent(6)
    };
    let exact = ModalOptions {
        rotary_inertia: RotaryInertia::Included,
        ..ModalOptions::lowest(6)
    };
    let cubic = ModalOptions {
        shape: MassShape::Cubic,
        ..timoshenko.clone()
    };
    let lumped = ModalOptions::lumped(6);
    let stubby = console(
        "Tapered(from: Tube(outer: 0.08, inner: 0.02, shear_y: 0.0025, shear_z: 0.002), \
         to: Tube(outer: 0.05, inner: 0.01, shear_y: 0.0012, shear_z: 0.001))",
        3,
        "",
    );
    let of_stubby = vec![
        ("outer", "outer: 0.08"),
        ("outer to", "outer: 0.05"),
        ("inner", "inner: 0.02"),
        ("inner to", "inner: 0.01"),
        ("shear_y", "shear_y: 0.0025"),
        ("shear_z to", "shear_z: 0.001"),
        ("young", "young: 210000000000.0"),
        ("poisson", "poisson: 0.3"),
        ("density", "density: 7850.0"),
    ];
    let of_delta = vec![
        ("diameter", "\"arm\": Circle(diameter: 0.03"),
        ("diameter", "\"bar\": Circle(diameter: 0.02"),
        ("diameter", "\"rod\": Circle(diameter: 0.014"),
        ("young", "young: 210000000000.0"),
        ("poisson", "poisson: 0.3"),
        ("density", "density: 7850.0"),
        ("mass", "mass: 1.5"),
    ];
    let elastic = [
        ("x", "x: 100000000.0"),
        ("u", "u: 100000.0"),
        ("w", "w: 100000.0"),
    ];
    vec![
        Sample {
            name: "stubby console",
            text: stubby.clone(),
            parameters: of_stubby.clone(),
            options: timoshenko.clone(),
        },
        Sample {
            name: "stubby console, exact",
            text: stubby.clone(),
            parameters: of_stubby.clone(),
            options: exact.clone(),
        },
        Sample {
            name: "stubby console, cubic shapes",
            text: stubby.clone(),
            parameters: of_stubby.clone(),
            options: cubic,
        },
        Sample {
            name: "stubby console in three segments",
            text: (stubby.replace(
                "points: {",
                "points: {\"M\": (0.1, 0.0, 0.0), \"N\": (0.35, 0.0, 0.0), ",
            ))
            .replace("[\"A\", \"B\"]", "[\"A\", \"M\", \"N\", \"B\"]"),
            parameters: of_stubby,
            options: timoshenko.clone(),
        },
        Sample {
            name: "flat console, lumped",
            text: console("Rectangle(width: 0.02, height: 0.03)", 5, ""),
            parameters: vec![("width", "width: 0.02"), ("height", "height: 0.03")],
            options: lumped.clone(),
        },
        Sample {
            name: "delta with rigid joints",
            text: with_mass("delta_rigid_joints.ron", "platform", "P"),
            parameters: of_delta.clone(),
            options: ModalOptions::lowest(6),
        },
        Sample {
            name: "delta with elastic joints",
            text: with_mass("delta_elastic_joints.ron", "platform", "P"),
            parameters: of_delta.iter().chain(&elastic).copied().collect(),
            options: ModalOptions::lowest(6),
        },
        Sample {
            name: "delta with elastic joints, consistent",
            text: with_mass("delta_elastic_joints.ron", "platform", "P"),
            parameters: of_delta.iter().chain(&elastic).copied().collect(),
            options: ModalOptions::consistent(6),
        },
        Sample {
            name: "delta with elastic joints, lumped",
            text: with_mass("delta_elastic_joints.ron", "platform", "P"),
            parameters: of_delta.iter().chain(&elastic).copied().collect(),
            options: lumped,
        },
        Sample {
            name: "delta with elastic joints, thick",
            text: with_mass("delta_elastic_joints.ron", "platform", "P").replace(
                "Circle(diameter: 0.014)",
                "Circle(diameter: 0.014, shear_y: 0.0001, shear_z: 0.0001)",
            ),
            parameters: of_delta.clone(),
            options: timoshenko,
        },
        Sample {
            name: "delta with elastic joints, thick, exact",
            text: with_mass("delta_elastic_joints.ron", "platform", "P").replace(
                "Circle(diameter: 0.014)",
                "Circle(diameter: 0.014, shear_y: 0.0001, shear_z: 0.0001)",
            ),
            parameters: of_delta,
            options: exact,
        },
        Sample {
            name: "hexapod",
            text: with_mass("hexapod_elastic_drives.ron", "platform", "P"),
            parameters: vec![("young", "young: 210000000000.0"), ("mass", "mass: 1.5")],
            options: ModalOptions::lowest(6),
        },
        Sample {
            name: "every joint",
            text: with_mass("every_joint.ron", "top", "T"),
            parameters: vec![
                ("width", "width: 0.02"),
                ("height", "height: 0.035"),
                ("density", "density: 7850.0"),
                ("v", "v: 20000.0"),
                ("u", "u: 50000.0"),
                ("y", "y: 1000000.0"),
            ],
            options: ModalOptions::lowest(6),
        },
    ]
}

/// Frequencies of a whole model, as many as there are in `like`.
fn frequencies<const N: usize>(model: &Model, options: &ModalOptions) -> [f64; N] {
    let options = ModalOptions {
        count: N,
        ..options.clone()
    };
    let plan = ModalPlan::new(model, &options).expect("a plan");
    let found = plan.frequencies(model.geometry()).expect("frequencies");
    found.try_into().expect("as many as are asked for")
}

#[test]
fn frequencies_by_differences() {
    let mut effective = 0;
    for sample in samples() {
        let model = read(&sample.text);
        let found = sensitivities(&model, &sample.options);
        assert!(
            found.groups.iter().all(|group| group.len() == 1),
            "{}",
            sample.name
        );
        for (name, written) in &sample.parameters {
            let expected = slope(|part| {
                frequencies::<6>(&larger(&sample.text, written, part), &sample.options)
            });
            let mine = found.parameters.iter();
            let mine: Vec<_> = mine
                .filter(|s| label(&s.parameter) == *name && s.value == value(written))
                .collect();
            assert!(!mine.is_empty(), "{}: {name}", sample.name);
            for (place, expected) in expected.iter().enumerate() {
                let derivative: f64 = mine.iter().map(|s| s.derivatives[place] * s.value).sum();
                // Frequencies are good to some 1e-12, so that these differences are to 1e-8.
                let off = (derivative - expected).abs() / found.frequencies[place];
                assert!(
                    off < 5e-8,
                    "{}: {written}: {place}: {derivative} {expected}",
                    sample.name
                );
                effective += usize::from(expected.abs() > 1e-3 * found.frequencies[place]);
            }
        }
    }
    assert!(effective > 150, "only {effective}");
}

/// A factor on all stiffness makes every frequency grow with its root, one on all mass shrink.
#[test]
fn frequencies_by_all_stiffness_and_by_all_mass() {
    for sample in samples() {
        let found = sensitivities(&read(&sample.text), &sample.options);
        for place in 0..found.frequencies.len() {
            let sum = |of: &dyn Fn(&str) -> bool| -> f64 {
                let mine = found.parameters.iter().filter(|s| of(&label(&s.parameter)));
                mine.map(|s| s.relative(&found.frequencies, place).unwrap())
                    .sum()
            };
            let stiffness =
                sum(&|name| ["young", "x", "y", "z", "u", "v", "w", "stiffness"].contains(&name));
            let mass = sum(&|name| ["density", "mass", "inertia"].contains(&name));
            near(stiffness, 0.5, sample.name);
            near(mass, -0.5, sample.name);
        }
    }
}

/// The delta in the middle, where its frequencies are equal in pairs, with a mass on each elbow. By
/// what changes all limbs alike, pairs stay pairs; a single elbow's mass parts them.
#[test]
fn equal_frequencies_part() {
    let mass =
        |limb: usize, mass: f64| format!("(on: (\"elbow{limb}\", \"B{limb}\"), mass: {mass:?})");
    let text = |first: f64, diameter: f64| {
        let material = "(young: 2.1e11, poisson: 0.3, density: 7850.0)";
        let part = |d: f64| format!("(section: Circle(diameter: {d:?}), material: {material})");
        format!(
            "(jobs: [(name: \"delta\", poses: List([(0.0, 0.0, 0.5)]), mechanism: Delta(
                base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60,
                rod_spacing: 0.12, elements: 2, arm: {}, bar: {}, rod: {},
                joint_stiffness: (x: 1e8, y: 1e8, z: 1e8, u: 1e5, w: 1e5)),
                masses: [{}, {}, {}, (on: (\"platform\", \"P\"), mass: 1.0, inertia: (1e-3, 1e-3, 1e-3))])])",
            part(diameter), part(0.02), part(0.014), mass(1, first), mass(2, 0.3), mass(3, 0.3)
        )
    };
    let model = |first: f64, diameter: f64| {
        let path = std::path::Path::new("delta.ron");
        let batch = batch_from_str(&text(first, diameter), path, &Disk, &Registry::builtin());
        batch.expect("a valid file").jobs[0]
            .model()
            .expect("a pose")
    };
    let options = ModalOptions::lowest(6);
    let found = sensitivities(&model(0.3, 0.03), &options);
    let places: Vec<_> = found.groups.iter().map(|group| group.len()).collect();
    assert!(
        places.iter().filter(|count| **count == 2).count() >= 2,
        "{places:?}"
    );
    let arm = found
        .parameters
        .iter()
        .find(|s| label(&s.parameter) == "diameter" && s.value == 0.03);
    let arm = arm.expect("the arm");
    let mut masses = (found.parameters.iter()).filter(|s| label(&s.parameter) == "mass");
    let mass = masses.next().expect("a mass");
    let first: &dyn Fn(f64) -> Model = &|part| model(0.3 * (1.0 + part), 0.03);
    let thick: &dyn Fn(f64) -> Model = &|part| model(0.3, 0.03 * (1.0 + part));
    let both = [(mass, first), (arm, thick)];
    for (group, (parameter, at)) in (found.groups.iter()).flat_map(|g| both.map(|b| (g.clone(), b)))
    {
        // What was the lowest of a group on one side of the point is the highest on the other.
        let turned = |part: f64| -> [f64; 6] {
            let mut found = frequencies::<6>(&at(part), &options);
            if part < 0.0 && group.end <= 6 {
                found[group.clone()].reverse();
            }
            found
        };
        let expected = slope(turned);
        for place in group.clone().take_while(|place| *place < 6) {
            let derivative = parameter.derivatives[place] * parameter.value;
            let off = (derivative - expected[place]).abs() / found.frequencies[place];
            assert!(
                off < 5e-8,
                "{group:?} {place}: {derivative} {}",
                expected[place]
            );
        }
        if group.len() == 2 {
            let [low, high] = [group.start, group.start + 1].map(|k| parameter.derivatives[k]);
            let apart = (high - low) / low.abs().max(high.abs());
            match parameter.parameter {
                Parameter::Mass { .. } => assert!(apart > 0.1, "{low} {high}"),
                _ => assert!(apart < 1e-6, "{low} {high}"),
            }
        }
    }
}
