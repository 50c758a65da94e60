//! Designs that share a first one's plan have the results of a plan of their own, to the bit.

use hyperstat_assembly::{JointStiffness, Model, PoseResult, Prepared};
use hyperstat_tests::gripper::gripper;
use hyperstat_tests::lattice::{jointed_lattice, lattice};
use hyperstat_tests::{moved, rebuilt};
use nalgebra::{Rotation3, Vector3};

fn swept(prepared: &Prepared) -> PoseResult {
    let mut lanes = prepared.lanes().expect("a plan");
    let mut filled = [false; hyperstat_assembly::LANES];
    filled[0] = true;
    let [result, ..] = prepared.sweep_lanes(&mut lanes, filled);
    result.expect("a filled pose").expect("a result")
}

fn same(first: &Prepared, model: &Model) {
    let own = Prepared::new(model.clone());
    let shared = first.for_design(model.clone()).expect("a plan");
    assert_eq!(shared.unknowns(), own.unknowns());
    assert_eq!(swept(&shared), swept(&own));
    let results = [&shared, &own].map(|prepared| prepared.here().solve().expect("a solution"));
    let [shared, own] = &results;
    assert_eq!(shared.displacements, own.displacements);
    assert_eq!(shared.joint_wrenches, own.joint_wrenches);
    assert_eq!(shared.output.compliance, own.output.compliance);
}

#[test]
fn a_design_s_results_do_not_depend_on_the_plan_s_origin() {
    let turn = Rotation3::from_euler_angles(0.3, -0.2, 0.5);
    for model in [lattice(3, 2, 4), jointed_lattice(2, 2, 3), gripper(4)] {
        let prepared = Prepared::new(model.clone());
        same(
            &prepared,
            &moved(&model, &turn, &Vector3::new(0.1, 0.2, 0.3)),
        );
    }
}

#[test]
fn a_joint_in_another_role_gets_a_plan_of_its_own() {
    let model = jointed_lattice(2, 2, 3);
    let prepared = Prepared::new(model.clone());
    // Soft bushings are not absorbed: they get coordinates of their own; stiff ones are.
    for stiffness in [1e-3, 3e7] {
        let changed = rebuilt(&model, |_, joint| {
            let mut joint = joint.clone();
            if joint.name.ends_with("bushing") {
                joint.stiffness = JointStiffness::Directions([Some(stiffness); 6]);
            }
            joint
        });
        same(&prepared, &changed);
        let [own, first] = [&prepared.for_design(changed).expect("a plan"), &prepared]
            .map(|prepared| prepared.unknowns().expect("a plan"));
        assert_eq!(own > first, stiffness < 1.0);
    }
}

#[test]
fn another_topology_gets_a_plan_of_its_own() {
    let prepared = Prepared::new(gripper(4));
    same(&prepared, &gripper(5));
    same(&prepared, &lattice(3, 2, 4));
}
