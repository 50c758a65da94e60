//! What acts: cases, gravity, masses, temperatures, loads along beams, as files and jobs give them.

use std::path::Path;

use hyperstat_assembly::{Axes, Model, solve};
use hyperstat_mechanisms::{Disk, Registry, batch_from_str, mechanism_from_str, write};
use nalgebra::{Vector3, Vector6};

const FILE: &str = r#"(
    name: "crane",
    materials: { "steel": (young: 2.1e11, poisson: 0.3, density: 7850.0, expansion: 1.2e-5, yield: 3.5e8) },
    sections: { "rod": Circle(diameter: 0.03) },
    points: { "A": (0.0, 0.0, 0.0), "B": (0.5, 0.0, 0.2), "C": (0.9, 0.3, 0.2) },
    bodies: {
        "arm": Beam(through: ["A", "B", "C"], section: "rod", material: "steel", temperature: 15.0),
        "hook": Rigid(points: ["C"]),
    },
    joints: {
        "foot": (at: "A", between: ("ground", "arm"), kind: Fixed),
        "wrist": (at: "C", between: ("arm", "hook"), kind: Fixed),
    },
    loads: [
        (on: ("hook", "C"), force: (0.0, 0.0, -50.0)),
        (on: "arm", per_length: (0.0, -4.0, 0.0), moment_per_length: (0.5, 0.0, 0.0)),
        (on: ("arm", "C", "B"), from: (0.0, 0.0, -8.0), to: (0.0, 0.0, -2.0)),
    ],
    cases: {
        "lifting": [(on: ("arm", "B"), force: (0.0, 3.0, -9.0), frame: Body)],
        "idle": [],
    },
    gravity: (0.0, 0.0, -9.81),
    masses: [(on: ("hook", "C"), mass: 2.0, inertia: (0.1, 0.2, 0.25))],
    output: ("hook", "C"),
)"#;

fn model(text: &str) -> Model {
    mechanism_from_str(text, Path::new("crane.ron"), &Disk, &Registry::builtin())
        .unwrap_or_else(|error| panic!("{error}"))
        .model
}

#[test]
fn a_file_says_what_acts() {
    let model = model(FILE);
    assert_eq!(*model.gravity(), Vector3::new(0.0, 0.0, -9.81));
    let [mass] = model.masses() else {
        panic!("one mass")
    };
    assert_eq!(
        (model.node_name(mass.node).as_str(), mass.mass.mass()),
        ("hook.C", 2.0)
    );
    assert_eq!(model.bodies()[0].temperature, 15.0);
    let material = &model.segments()[0].material;
    assert_eq!(material.expansion(), Some(1.2e-5));
    assert_eq!(material.yield_strength(), Some(3.5e8));
    let names: Vec<_> = model.cases().iter().map(|case| &*case.name).collect();
    assert_eq!(names, ["lifting", "idle"]);
    let [load] = &*model.cases()[0].loads.nodes else {
        panic!("one load")
    };
    assert!(matches!(load.axes, Axes::Body { .. }));
    let lines = &model.load_set().lines;
    assert_eq!(lines.len(), 3);
    assert_eq!(
        lines[0].ends,
        [Vector6::new(0.0, -4.0, 0.0, 0.5, 0.0, 0.0); 2]
    );
    // Named from C to B: the segment runs from B to C.
    assert_eq!(lines[2].segment.0, 1);
    assert_eq!(lines[2].ends.map(|end| end[2]), [-2.0, -8.0]);
}

#[test]
fn what_acts_is_written_and_read_again() {
    let first = model(FILE);
    let text = write(&first, &Registry::builtin()).expect("a file");
    let again = model(&text);
    assert_eq!(again.cases().len(), 2);
    assert_eq!(again.masses(), first.masses());
    let (first, again) = (solve(&first).unwrap(), solve(&again).unwrap());
    let difference = (first.output.displacement - again.output.displacement).amax();
    assert!(difference < 1e-13 * first.output.displacement.amax());
    for (a, b) in first.cases.iter().zip(&again.cases) {
        let difference = (a.state.output - b.state.output).amax();
        assert!(difference < 1e-13 * a.state.output.amax(), "{}", a.name);
    }
}

#[test]
fn a_job_replaces_what_it_gives() {
    let text = r#"(jobs: [(
        name: "turned",
        mechanism: Delta(
            base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60,
            rod_spacing: 0.12,
            arm: (section: Circle(diameter: 0.030), material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),
            bar: (section: Circle(diameter: 0.020), material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),
            rod: (section: Circle(diameter: 0.014), material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),
        ),
        poses: List([(0.0, 0.0, 0.5)]),
        cases: { "push": [(on: ("platform", "P"), force: (0.0, 0.0, -10.0), frame: Output)] },
        gravity: (0.0, 0.0, -9.81),
        masses: [(on: ("platform", "P"), mass: 1.0)],
    )])"#;
    let batch = batch_from_str(text, Path::new("."), &Disk, &Registry::builtin());
    let batch = batch.unwrap_or_else(|error| panic!("{error}"));
    let job = &batch.jobs[0];
    assert_eq!(job.cases(), ["push"]);
    let model = job.model().unwrap();
    assert_eq!(model.masses().len(), 1);
    // The drives of the delta carry its whole weight.
    let solution = solve(&model).unwrap();
    let mut carried = Vector3::zeros();
    for (k, joint) in model.joints().iter().enumerate() {
        if joint.between[0].is_none() {
            let wrench = solution.joint_wrenches[k].expect("determined");
            let force = Vector3::new(wrench[0], wrench[1], wrench[2]);
            carried += model.geometry().frames[k] * force;
        }
    }
    let positions = &model.geometry().positions;
    let beams = model.segments().iter().map(|segment| {
        let [a, b] = segment.ends.map(|node| positions[node.0]);
        let density = segment.material.density().unwrap();
        (b - a).norm() * segment.section.area() * density
    });
    let weight = (beams.sum::<f64>() + 1.0) * 9.81;
    let expected = Vector3::new(0.0, 0.0, weight);
    assert!(
        (carried - expected).norm() < 1e-9 * weight,
        "{carried} {expected}"
    );
}

#[test]
fn misfits_and_preloads_are_read_and_written() {
    let wrist = r#""wrist": (at: "C", between: ("arm", "hook"), kind: Fixed"#;
    let text = FILE.replace(
        wrist,
        &format!("{wrist}, stiffness: (z: 2e6), misfit: (x: 1e-4, w: -2e-3), preload: (z: 30.0)"),
    );
    let first = model(&text);
    let [entry] = first.misfits() else {
        panic!("one joint with a misfit")
    };
    assert_eq!(first.joints()[entry.joint.0].name, "wrist");
    assert_eq!(entry.misfit, Vector6::new(1e-4, 0.0, 0.0, 0.0, 0.0, -2e-3));
    assert_eq!(entry.preload, Vector6::new(0.0, 0.0, 30.0, 0.0, 0.0, 0.0));
    let written = write(&first, &Registry::builtin()).expect("a file");
    assert_eq!(model(&written).misfits(), first.misfits());
    // Nothing is written of joints that have none.
    assert_eq!(written.matches("misfit").count(), 1);
    let none = write(&model(FILE), &Registry::builtin()).expect("a file");
    assert!(!none.contains("misfit") && !none.contains("preload"));
}
