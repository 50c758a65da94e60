//! Lattices: small ones against the independent solver, large ones against closed forms,
//! equilibrium and reciprocity.

use hyperstat_assembly::{JointId, Model, NodeId, Solution, analyse, redundant_constraints, solve};
use hyperstat_joints::rigid_motion;
use hyperstat_tests::agreement::agrees_with_reference;
use hyperstat_tests::build::{circle, node, steel};
use hyperstat_tests::gripper::gripper;
use hyperstat_tests::lattice::{PITCH, jointed_lattice, lattice};
use hyperstat_tests::turned;
use nalgebra::Vector6;

#[test]
fn small_lattices_agree_with_the_independent_solver() {
    for model in [lattice(3, 2, 4), jointed_lattice(2, 2, 3), gripper(3)] {
        let agree = agrees_with_reference(&model).expect("the same results");
        assert!(agree, "{} does not count", model.name);
    }
}

#[test]
fn a_lattice_s_unknowns_and_redundant_welds_are_counted() {
    let model = lattice(4, 3, 5);
    let solution = solve(&model).expect("a solution");
    assert_eq!(solution.unknowns, 6 * 4 * 3 * 4);
    assert_eq!(solution.mobility, 0);
    // One body on twelve welds, of which one holds it.
    assert_eq!(solution.overconstraint, 6 * 11);
    assert_eq!(redundant_constraints(&model).len(), 6 * 11);
}

/// The wrench of all joints to the ground and of all loads, about the origin.
fn imbalance(model: &Model, solution: &Solution) -> (Vector6<f64>, Vector6<f64>) {
    let geometry = model.geometry();
    let at_origin = |node: NodeId, wrench: &Vector6<f64>| {
        rigid_motion(&geometry.positions[node.0].coords).transpose() * wrench
    };
    let mut loads = Vector6::zeros();
    for load in model.loads() {
        loads += at_origin(load.node, &load.wrench);
    }
    let mut sum = loads;
    for (k, joint) in model.joints().iter().enumerate() {
        if let [None, Some(node)] = joint.between {
            let wrench = solution.joint_wrenches[k].expect("a wrench");
            sum += at_origin(node, &turned(&geometry.frames[k], &wrench));
        }
    }
    (sum, loads)
}

#[test]
fn large_lattices_are_in_equilibrium() {
    for model in [lattice(6, 6, 40), jointed_lattice(3, 3, 30), gripper(60)] {
        let solution = solve(&model).expect("a solution");
        assert!(solution.warnings.is_empty(), "{:?}", solution.warnings);
        assert!(solution.idle.is_empty());
        let (sum, loads) = imbalance(&model, &solution);
        let share = sum.amax() / loads.amax();
        assert!(share < 1e-10, "{}: {share}", model.name);
    }
}

/// A column of four struts side by side, pulled evenly at all of its length: nothing bends.
#[test]
fn a_long_column_stretches_as_its_struts_do() {
    let layers = 400;
    let mut model = lattice(2, 2, layers);
    model.clear_loads();
    let force = 250.0;
    let tops = ["0_0", "1_0", "0_1", "1_1"].map(|at| format!("{at}_{}", layers - 1));
    for top in &tops {
        let top = node(&model, "lattice", top);
        let pull = Vector6::new(0.0, 0.0, force, 0.0, 0.0, 0.0);
        model.add_load(top, pull).expect("a load");
    }
    let solution = solve(&model).expect("a solution");
    let rigidity = steel().young() * circle(0.01).area();
    let whole = force * (layers - 1) as f64 * PITCH / rigidity;
    for (n, displacement) in solution.displacements.iter().enumerate() {
        let height = model.geometry().positions[n].z;
        let expected = Vector6::new(0.0, 0.0, force * height / rigidity, 0.0, 0.0, 0.0);
        let difference = (displacement - expected).amax() / whole;
        assert!(difference < 1e-11, "node {n}: {difference}");
    }
}

/// Betti: what a load at A moves at B, the same load at B moves at A.
#[test]
fn displacements_of_a_large_jointed_lattice_are_reciprocal() {
    let mut model = jointed_lattice(3, 4, 12);
    let [a, b] = [("hub_0_3_11", "0_3_11"), ("hub_2_1_6", "2_1_6")]
        .map(|(body, point)| node(&model, body, point));
    let wrenches = [
        Vector6::new(1.0, -2.0, 3.0, 0.1, 0.2, -0.3),
        Vector6::new(-4.0, 1.0, 2.0, -0.2, 0.1, 0.4),
    ];
    let mut work = Vec::new();
    for (k, (loaded, other)) in [(a, b), (b, a)].into_iter().enumerate() {
        model.clear_loads();
        model.add_load(loaded, wrenches[k]).expect("a load");
        let solution = solve(&model).expect("a solution");
        work.push(solution.displacements[other.0].dot(&wrenches[1 - k]));
    }
    let difference = (work[0] / work[1] - 1.0).abs();
    assert!(difference < 1e-9, "{difference}");
}

/// A hinge leaves one direction of five constraints' strut free: all counts are known.
#[test]
fn a_jointed_lattice_is_rigid_and_redundant_by_nine_a_node() {
    let model = jointed_lattice(4, 4, 4);
    let kinematics = analyse(&model).expect("a small model");
    let constraints: usize = (model.joints().iter())
        .map(|joint| 6 - joint.joint.free().len())
        .sum();
    assert_eq!(kinematics.mobility, 0);
    assert_eq!(
        kinematics.overconstraint,
        constraints - 6 * model.bodies().len()
    );
    assert!(kinematics.motions.is_empty() && kinematics.doubtful.is_none());
    let redundant = redundant_constraints(&model);
    assert_eq!(redundant.len(), kinematics.overconstraint);
    for redundancy in &redundant {
        assert!(redundancy.directions.len() > 1);
        assert!(
            redundancy
                .directions
                .iter()
                .all(|(JointId(k), ..)| *k < model.joints().len())
        );
    }
}
