//! The reference mechanisms through the real loader, against results true to every printed digit.

use hyperstat_assembly::{Solution, solve};
use hyperstat_mechanisms::{Disk, Mechanism, Registry, load_mechanism};
use hyperstat_tests::{
    reference_folder, reference_text, stiffness, stiffness_difference, vector_differences,
};
use nalgebra::{Matrix6, Vector6};
use serde_json::Value;

/// Agreement after the refinement step that every solve takes.
const REFINED: f64 = 1e-12;

fn vector(value: &Value) -> Vector6<f64> {
    Vector6::from_fn(|k, _| value[k].as_f64().expect("a number"))
}

fn load(name: &str) -> (Mechanism, Value) {
    let path = reference_folder().join(format!("{name}.ron"));
    let mechanism = load_mechanism(&path, &Disk, &Registry::builtin()).expect("a valid file");
    let expected = reference_text(&format!("{name}.json"));
    (
        mechanism,
        serde_json::from_str(&expected).expect("valid JSON"),
    )
}

/// Compares everything that the reference gives; returns the solution for more.
fn compare(name: &str, unknowns: usize) -> Solution {
    let (mechanism, expected) = load(name);
    let model = &mechanism.model;
    let solution = solve(model).expect("a solution");

    let rows = &expected["output_stiffness"];
    let k = Matrix6::from_fn(|r, c| rows[r][c].as_f64().expect("a number"));
    let difference = stiffness_difference(&stiffness(&solution), &k);
    assert!(
        difference < REFINED,
        "{name}: K_o differs by {difference:e}"
    );

    assert_eq!(solution.unknowns, unknowns, "{name}: unknowns");
    assert!(solution.unknowns as u64 <= expected["unknowns"].as_u64().expect("a count"));
    for (field, found) in [
        ("mobility", solution.mobility),
        ("overconstraint", solution.overconstraint),
        ("idle_modes", solution.idle.len()),
    ] {
        assert_eq!(
            Some(found as u64),
            expected[field].as_u64(),
            "{name}: {field}"
        );
    }
    assert!(
        solution.warnings.is_empty(),
        "{name}: {:?}",
        solution.warnings
    );

    let idle: Vec<_> = solution
        .idle
        .iter()
        .flat_map(|m| &m.twists)
        .map(|t| t.0)
        .collect();
    let given = expected["displacements"]
        .as_object()
        .expect("displacements");
    let pairs: Vec<_> = given
        .iter()
        .map(|(node, value)| {
            let (body, point) = node.split_once('.').expect("body.point");
            (
                model.node(body, point).expect("a known node"),
                vector(value),
            )
        })
        .filter(|(node, _)| !idle.contains(&model.nodes()[node.0].body))
        .collect();
    assert!(pairs.len() > 3, "{name}: nothing compared");
    let [linear, angular] = vector_differences(
        pairs.iter().map(|(n, u)| (&solution.displacements[n.0], u)),
        [1e-15, 1e-15],
    );
    assert!(
        linear < REFINED && angular < REFINED,
        "{name}: {linear:e} {angular:e}"
    );

    if let Some(given) = expected["joint_wrenches"].as_object() {
        assert_eq!(given.len(), model.joints().len());
        let pairs: Vec<_> = given
            .iter()
            .map(|(joint, value)| {
                let k = model
                    .joints()
                    .iter()
                    .position(|j| j.name == *joint)
                    .expect("a joint");
                let found = solution.joint_wrenches[k].expect("a determined wrench");
                (found, vector(value))
            })
            .collect();
        // Moments are forces times lengths: a mechanism without moments has them to rounding.
        let force = pairs
            .iter()
            .map(|(_, w)| w.fixed_rows::<3>(0).amax())
            .fold(0.0, f64::max);
        let [forces, moments] =
            vector_differences(pairs.iter().map(|(f, e)| (f, e)), [1e-9, 1e-3 * force]);
        assert!(
            forces < REFINED && moments < REFINED,
            "{name}: {forces:e} {moments:e}"
        );
    }
    solution
}

#[test]
fn delta_with_rigid_joints() {
    compare("delta_rigid_joints", 114);
}

#[test]
fn delta_with_elastic_joints() {
    compare("delta_elastic_joints", 114);
}

#[test]
fn delta_with_refined_links() {
    compare("delta_refined", 114);
}

#[test]
fn delta_with_ball_jointed_rods() {
    let solution = compare("delta_ball_jointed_rods", 138);
    let single = solution.idle.iter().all(|m| m.twists.len() == 1);
    assert!(
        single,
        "every idle motion is one body's: {:?}",
        solution.idle
    );
}

#[test]
fn single_freedom_with_elastic_joints() {
    compare("single_freedom_elastic", 6);
}

#[test]
fn single_freedom_with_rigid_joints() {
    compare("single_freedom_rigid", 6);
}

#[test]
fn every_joint_in_one_chain() {
    compare("every_joint", 37);
}

#[test]
fn flexible_parallelogram() {
    compare("flexible_parallelogram", 19);
}

#[test]
fn hexapod_with_elastic_drives() {
    compare("hexapod_elastic_drives", 72);
}

#[test]
fn hexapod_with_locked_drives() {
    compare("hexapod_locked", 72);
}

#[test]
fn rigid_bodies_on_bushings() {
    compare("rigid_bodies_on_bushings", 6);
}

#[test]
fn three_rps() {
    compare("three_rps", 36);
}

#[test]
fn tricept() {
    compare("tricept", 48);
}

/// A loop of rigid bodies: redundant constraints are dropped, and the wrenches that they leave
/// undetermined are none, not one of many.
#[test]
fn rigid_parallelogram() {
    let solution = compare("rigid_parallelogram", 10);
    let (mechanism, _) = load("rigid_parallelogram");
    let names: Vec<_> = solution
        .undetermined()
        .iter()
        .map(|j| mechanism.model.joints()[j.0].name.clone())
        .collect();
    assert_eq!(names, ["a", "b", "d", "c"]);
}
