//! A mechanism that is written and read again is the same mechanism.

use std::path::{Path, PathBuf};

use hyperstat_assembly::{BodyKind, Model, Solution, solve};
use hyperstat_joints::{Dof, DofSet, Joint};
use hyperstat_mechanisms::{
    Disk, Input, Orientation, ParsedJoint, Registry, WriteError, load, mechanism_from_str, write,
};
use nalgebra::{Matrix6, Vector6};

/// What the last digits of a joint's axes may change.
const LAST_DIGITS: f64 = 1e-12;

/// Mechanism and batch files of the workspace.
fn files() -> Vec<PathBuf> {
    let folders = ["../../tests/reference", "../../examples"];
    let entries = folders
        .iter()
        .flat_map(|f| Path::new(f).read_dir().unwrap());
    let mut files: Vec<_> = entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "ron"))
        .collect();
    files.sort();
    files
}

/// The models of a file: its own, or those of its jobs in their first poses.
fn models(path: &Path) -> Vec<Model> {
    match load(path, &Disk, &Registry::builtin()).unwrap() {
        Input::Mechanism(mechanism) => vec![mechanism.model],
        Input::Batch(batch) => batch.jobs.iter().map(|job| job.model().unwrap()).collect(),
    }
}

fn read(text: &str) -> Model {
    mechanism_from_str(text, Path::new("written.ron"), &Disk, &Registry::builtin())
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
        .model
}

/// Largest |ΔK_ij| / √(K_ii K_jj).
fn difference(found: &Matrix6<f64>, expected: &Matrix6<f64>) -> f64 {
    let mut largest = 0.0_f64;
    for (r, c) in (0..36).map(|entry| (entry / 6, entry % 6)) {
        let scale = (expected[(r, r)] * expected[(c, c)]).sqrt();
        largest = largest.max((found[(r, c)] - expected[(r, c)]).abs() / scale);
    }
    largest
}

/// Largest difference over the largest entry.
fn change(found: &[Vector6<f64>], expected: &[Vector6<f64>]) -> f64 {
    let scale = expected.iter().fold(0.0_f64, |m, u| m.max(u.amax()));
    let pairs = found.iter().zip(expected);
    pairs.fold(0.0_f64, |m, (a, b)| m.max((a - b).amax())) / scale
}

#[test]
fn every_file_of_the_workspace_comes_back() {
    let mut count = 0;
    for path in files() {
        for model in models(&path) {
            let name = format!("{} of {}", model.name, path.display());
            let written = write(&model, &Registry::builtin());
            if let Some(body) = model.bodies().iter().find(|b| b.kind == BodyKind::Flexible) {
                let body = body.name.clone();
                assert_eq!(written, Err(WriteError::Flexible { body }));
                continue;
            }
            let text = written.expect(&name);
            let again = read(&text);
            let (found, expected): (Solution, Solution) =
                (solve(&again).unwrap(), solve(&model).unwrap());
            assert_eq!(again.name, model.name);
            assert_eq!(found.unknowns, expected.unknowns, "{name}");
            assert_eq!(found.mobility, expected.mobility, "{name}");
            assert_eq!(found.overconstraint, expected.overconstraint, "{name}");
            for (found, expected) in again.joints().iter().zip(model.joints()) {
                assert_eq!(found.name, expected.name);
                assert_eq!(found.locked, expected.locked, "{name}");
                assert_eq!(found.stiffness, expected.stiffness, "{name}");
                assert_eq!(found.joint.basis(), expected.joint.basis(), "{name}");
            }
            let stiffness = [found.output.stiffness, expected.output.stiffness];
            let [Some(k), Some(wanted)] = stiffness else {
                panic!("{name} has no stiffness");
            };
            let off = difference(&k, &wanted);
            assert!(off < LAST_DIGITS, "K_o of {name} is off by {off:e}");
            if expected.idle.is_empty() && !model.loads().is_empty() {
                let off = change(&found.displacements, &expected.displacements);
                assert!(off < LAST_DIGITS, "displacements of {name}: {off:e}");
            }
            count += 1;
        }
    }
    assert!(count >= 16, "only {count} mechanisms");
}

#[test]
fn numbers_and_names_are_written_as_they_are() {
    let text = r#"(
        name: "quoted \"name\" of a\nmachine",
        materials: { "m": (young: 0.1, shear: 0.30000000000000004, density: 1e-300) },
        sections: {
            "any": General(area: 4e-4, iy: 1e-8, iz: 2e-8, torsion: 2.5e-8, y_max: 0.01,
                z_max: 0.02, torsion_modulus: 1e-6, shear_y: 3e-4, shear_z: 2e-4),
        },
        points: { "A": (0.1, -0.0, 1e-17), "B\\": (123456.7, 1e22, -3.5) },
        bodies: {
            "é": Beam(through: ["A", "B\\"], section: "any", material: "m",
                y_axis: (0.0, 0.3, 1.0), elements: 7),
        },
        joints: { "j": (at: "A", between: ("é", "ground"), kind: Cylindrical(axis: (0.0, 0.0, 2.0)),
            locked: [y], stiffness: (x: 0.0, v: 1.5e7)) },
        loads: [(on: ("é", "B\\"), force: (0.1, 0.2, 0.3), moment: (1e-30, 0.0, -7.0))],
        output: ("é", "B\\"),
    )"#;
    let model = read(text);
    let again = read(&write(&model, &Registry::builtin()).unwrap());
    assert_eq!(again.name, model.name);
    assert_eq!(again.segments()[0].section, model.segments()[0].section);
    assert_eq!(again.segments()[0].material, model.segments()[0].material);
    assert_eq!(again.segments()[0].elements, 7);
    assert_eq!(again.geometry().positions, model.geometry().positions);
    assert_eq!(again.geometry().y_axes, model.geometry().y_axes);
    assert_eq!(again.loads(), model.loads());
    assert_eq!(again.joints()[0].locked, DofSet::new(&[Dof::Y]));
    assert_eq!(again.joints()[0].stiffness, model.joints()[0].stiffness);
}

#[test]
fn frames_tapers_and_sections_by_segment_come_back() {
    let text = r#"(
        name: "bodies",
        materials: { "m": (young: 2e11, poisson: 0.3), "n": (young: 7e10, poisson: 0.33) },
        sections: {
            "a": Circle(diameter: 0.02), "b": Tube(outer: 0.03, inner: 0.02),
            "t": Tapered(from: Rectangle(width: 0.02, height: 0.04),
                to: Rectangle(width: 0.01, height: 0.02)),
        },
        points: {
            "A": (0.0, 0.0, 0.0), "B": (0.3, 0.1, 0.0), "C": (0.5, 0.0, 0.2), "D": (0.2, 0.4, 0.1),
        },
        bodies: {
            "steps": Beam(through: ["A", "B", "C"], section: ["a", "b"], material: "m"),
            "taper": Beam(through: ["A", "B", "D"], section: "t", material: "m", elements: 2),
            "cone": Beam(through: ["A", "C"], section: "t", material: "m"),
            "frame": Frame(
                members: [["C", "D"], (through: ["D", "A", "C"], section: "t", material: "n"),
                    (through: ["B", "C"], y_axis: (0.0, 0.0, 1.0), elements: 3)],
                section: "a", material: "m",
            ),
        },
        joints: {
            "1": (at: "A", between: ("ground", "steps"), kind: Fixed),
            "2": (at: "B", between: ("taper", "steps"), kind: Fixed),
            "3": (at: "C", between: ("cone", "steps"), kind: Fixed),
            "4": (at: "A", between: ("taper", "cone"), kind: Spherical),
            "5": (at: "D", between: ("frame", "taper"), kind: Fixed),
        },
        loads: [(on: ("frame", "B"), force: (1.0, 2.0, 3.0), moment: (4.0, 5.0, 6.0))],
        output: ("frame", "B"),
    )"#;
    let model = read(text);
    let again = read(&write(&model, &Registry::builtin()).unwrap());
    assert_eq!(again.segments().len(), model.segments().len());
    for (found, expected) in again.segments().iter().zip(model.segments()) {
        assert_eq!(found.ends, expected.ends);
        assert_eq!(found.material, expected.material);
        assert_eq!(found.elements, expected.elements);
    }
    assert_eq!(again.geometry().y_axes, model.geometry().y_axes);
    let (found, expected) = (solve(&again).unwrap(), solve(&model).unwrap());
    let stiffness = |solution: &Solution| solution.output.stiffness.unwrap();
    assert!(difference(&stiffness(&found), &stiffness(&expected)) < LAST_DIGITS);
    assert!(change(&found.displacements, &expected.displacements) < LAST_DIGITS);
}

#[test]
fn a_kind_without_a_writer_is_named() {
    #[derive(Debug, Clone)]
    struct Slotted;
    impl Joint for Slotted {
        fn kind(&self) -> &str {
            "Slotted"
        }
        fn free(&self) -> DofSet {
            DofSet::new(&[Dof::U, Dof::V])
        }
        fn clone_box(&self) -> Box<dyn Joint> {
            Box::new(self.clone())
        }
    }
    let text = r#"(
        name: "one", points: { "A": (0.0, 0.0, 0.0) }, bodies: { "b": Rigid(points: ["A"]) },
        joints: { "slot": (at: "A", between: ("ground", "b"), kind: Slotted, locked: true) },
        output: ("b", "A"),
    )"#;
    let mut registry = Registry::builtin();
    registry.register("Slotted", &[], |_| {
        Ok(ParsedJoint {
            joint: Box::new(Slotted),
            orientation: Orientation::Global,
        })
    });
    let path = Path::new("slotted.ron");
    let model = mechanism_from_str(text, path, &Disk, &registry)
        .unwrap()
        .model;
    let error = write(&model, &registry).unwrap_err();
    let expected = WriteError::UnknownKind {
        joint: "slot".into(),
        kind: "Slotted".into(),
    };
    assert_eq!(error, expected);

    registry.register_writer("Slotted", |_, _| Vec::new());
    let written = write(&model, &registry).unwrap();
    let again = mechanism_from_str(&written, path, &Disk, &registry)
        .unwrap()
        .model;
    assert_eq!(again.joints()[0].joint.kind(), "Slotted");
}

#[test]
fn what_a_file_cannot_say_is_refused() {
    let mut model = Model::new("no output");
    model
        .add_rigid("b", &[("A", nalgebra::Point3::origin())])
        .unwrap();
    let written = |model: &Model| write(model, &Registry::builtin()).unwrap_err();
    assert_eq!(written(&model), WriteError::NoOutput);
    let body = model.add_rigid("c", &[("A", nalgebra::Point3::new(1.0, 0.0, 0.0))]);
    model.set_output(model.bodies()[body.unwrap().0].nodes[0]);
    let expected = WriteError::TwoPlaces {
        point: "A".into(),
        body: "c".into(),
    };
    assert_eq!(written(&model), expected);
}

/// Loads that turn with a body are written so, with the vectors as they were stated.
#[test]
fn loads_that_turn_come_back_turning() {
    let text = r#"(
        name: "turning",
        materials: { "steel": (young: 2.1e11, poisson: 0.3) }, sections: { "rod": Circle(diameter: 0.02) },
        points: { "A": (0.0, 0.0, 0.0), "B": (0.3, 0.1, 0.5), "P": (0.35, 0.2, 0.6) },
        bodies: {
            "arm": Beam(through: ["A", "B"], section: "rod", material: "steel"),
            "tool": Rigid(points: ["B", "P"]),
        },
        joints: {
            "A": (at: "A", between: ("ground", "arm"), kind: Revolute(axis: (0.0, 1.0, 0.0)), locked: true),
            "B": (at: "B", between: ("arm", "tool"), kind: Universal(axes: ((1.0, 0.0, 0.0), (0.0, 1.0, 0.2))), locked: true),
        },
        loads: [
            (on: ("arm", "B"), force: (10.0, 20.0, 0.3), frame: Body),
            (on: ("arm", "B"), force: (7.0, 0.1, 0.0), frame: Output),
            (on: ("arm", "A", "B"), from: (0.1, 0.2, 0.3), to: (3.0, 2.0, 1.0), frame: Body),
            (on: ("tool", "P"), force: (1.0, 2.0, 3.0)),
        ],
        output: ("tool", "P"),
    )"#;
    let model = read(text);
    let written = write(&model, &Registry::builtin()).unwrap();
    for said in [
        "force: (10.0, 20.0, 0.3), moment: (0.0, 0.0, 0.0), frame: Body",
        "force: (7.0, 0.1, 0.0), moment: (0.0, 0.0, 0.0), frame: Output",
        "to: (3.0, 2.0, 1.0), frame: Body",
        "force: (1.0, 2.0, 3.0), moment: (0.0, 0.0, 0.0))",
    ] {
        assert!(written.contains(said), "{said} is not in {written}");
    }
    assert_eq!(read(&written).load_set(), model.load_set());
}
