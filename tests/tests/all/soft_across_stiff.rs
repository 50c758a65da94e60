//! Soft directions across stiff ones: displacements of nodes other than the output, and joint
//! wrenches, keep their digits, and what is stated of them is not less than their error.

use hyperstat_assembly::{Model, Solution, Warning, solve};
use hyperstat_elements::rotate_vector6;
use hyperstat_mechanisms::{Input, Registry};
use hyperstat_tests::build::node;
use hyperstat_tests::extended;
use hyperstat_tests::vector_differences;

fn model(text: &str) -> Model {
    let input = hyperstat_mechanisms::load_str(
        text,
        "block.ron".as_ref(),
        &hyperstat_mechanisms::Disk,
        &Registry::builtin(),
    );
    match input {
        Ok(Input::Mechanism(mechanism)) => mechanism.model,
        Ok(_) => panic!("a batch"),
        Err(error) => panic!("{error}"),
    }
}

fn stated(found: &Solution) -> f64 {
    let lost = found.warnings.iter().find_map(|warning| match warning {
        Warning::LostDigits { error } => Some(*error),
        _ => None,
    });
    lost.unwrap_or(1e-10)
}

/// Two beams and a screw with a soft drive; b.B is inside its joint where a.B is the output.
fn screw(pitch: f64, output: &str) -> Model {
    model(&format!(
        r#"(
    name: "s",
    materials: {{"m": (young: 2.1e11, poisson: 0.3)}},
    sections: {{"s": Circle(diameter: 0.03)}},
    points: {{"A": (0, 0, 0), "B": (0.3, 0.1, 0.4), "C": (0.5, 0.2, 0.1)}},
    bodies: {{
        "a": Beam(through: ["A", "B"], section: "s", material: "m"),
        "b": Beam(through: ["B", "C"], section: "s", material: "m"),
    }},
    joints: {{
        "g": (at: "A", between: ("ground", "a"), kind: Fixed),
        "j": (at: "B", between: ("a", "b"), kind: Screw(axis: (1, 2, 3), pitch: {pitch:?}), stiffness: (v: 10.0)),
        "h": (at: "C", between: ("ground", "b"), kind: Spherical),
    }},
    loads: [(on: ("b", "B"), force: (1, 2, 3))],
    output: ("{output}", "B"),
)"#
    ))
}

#[test]
fn a_screw_of_great_pitch_on_a_soft_drive() {
    for pitch in [1.0, 10.0, 100.0] {
        for output in ["a", "b"] {
            let model = screw(pitch, output);
            let found = solve(&model).expect("a solution");
            let exact = extended::solve(&model).expect("32 digits");
            let pairs = found.displacements.iter().zip(&exact.displacements);
            let [linear, angular] = vector_differences(pairs, [0.0; 2]);
            let error = linear.max(angular);
            let stated = stated(&found);
            assert!(
                error < stated,
                "pitch {pitch}, {output}: {error:e}, said {stated:e}"
            );
            // Off by 1e-3 at 10, 19 times at 100 before segments said where the node is.
            assert!(error < 1e-5, "pitch {pitch}, {output}: {error:e}");
        }
    }
    // By the independent solver.
    let model = screw(10.0, "a");
    let found = solve(&model).expect("a solution");
    let z = found.displacements[node(&model, "b", "B").0].z;
    assert!((z - 1.96896e-5).abs() < 5e-11, "{z:e}");
}

/// Nothing but two joints acts on the body b: its bushing gives back what the other one gives.
#[test]
fn a_bushing_with_one_direction_far_stiffer_balances() {
    let model = model(
        r#"(
    name: "m",
    materials: {"m": (young: 2.1e11, poisson: 0.3)},
    sections: {"s": Circle(diameter: 2e-5)},
    points: {"A": (0.0, 0.0, 0.0), "B": (1e-3, 0.0, 0.0)},
    bodies: {"a": Beam(through: ["A", "B"], section: "s", material: "m"), "b": Rigid(points: ["B"])},
    joints: {
        "j0": (at: "A", between: ("ground", "a"), kind: Fixed),
        "j2": (at: "B", between: ("a", "b"), kind: Fixed, misfit: (y: 1e-4, z: 2e-4)),
        "x": (at: "B", between: ("b", "ground"), kind: Fixed(axis: (0.337, -0.536, -0.126)),
              stiffness: (x: 2e3, y: 1e17, z: 2e3, u: 1e3, v: 1e3, w: 1e3)),
    },
    loads: [],
    output: ("a", "B"),
)"#,
    );
    let found = solve(&model).expect("a solution");
    let frames = &model.geometry().frames;
    let [given, taken] = [1, 2].map(|joint: usize| {
        let wrench = found.joint_wrenches[joint].expect("a wrench");
        rotate_vector6(&wrench, &frames[joint])
    });
    // On the second bodies, b and the ground.
    let apart = (given - taken).fixed_rows::<3>(0).amax();
    let moments = (given - taken).fixed_rows::<3>(3).amax();
    assert!(
        apart < 1e-9 * given.fixed_rows::<3>(0).amax(),
        "{given} {taken}"
    );
    assert!(
        moments < 1e-6 * given.fixed_rows::<3>(3).amax(),
        "{given} {taken}"
    );
}
