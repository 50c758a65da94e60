//! A plan for other designs of the same mechanism gives what a plan of their own gives, to the bit.

use hyperstat_assembly::{JointStiffness, Model, Plan, PoseResult};
use hyperstat_tests::gripper::gripper;
use hyperstat_tests::lattice::{jointed_lattice, lattice};
use hyperstat_tests::{moved, rebuilt};
use nalgebra::{Rotation3, Vector3};

fn swept(plan: &Plan, model: &Model) -> PoseResult {
    let mut lanes = plan.lanes(model);
    let mut filled = [false; hyperstat_assembly::LANES];
    filled[0] = true;
    let [result, ..] = plan.sweep_lanes(model, &mut lanes, filled);
    result.expect("a filled pose").expect("a result")
}

fn same(first: &Plan, model: &Model) {
    let own = Plan::new(model).expect("a plan");
    let shared = first.for_design(model).expect("a plan");
    assert_eq!(shared.unknowns(), own.unknowns());
    assert_eq!(swept(&shared, model), swept(&own, model));
    let results = [&shared, &own].map(|plan| plan.solve(model).expect("a solution"));
    let [shared, own] = &results;
    assert_eq!(shared.displacements, own.displacements);
    assert_eq!(shared.joint_wrenches, own.joint_wrenches);
    assert_eq!(shared.output.compliance, own.output.compliance);
}

#[test]
fn a_design_s_results_do_not_depend_on_the_plan_s_origin() {
    let turn = Rotation3::from_euler_angles(0.3, -0.2, 0.5);
    for model in [lattice(3, 2, 4), jointed_lattice(2, 2, 3), gripper(4)] {
        let plan = Plan::new(&model).expect("a plan");
        same(&plan, &moved(&model, &turn, &Vector3::new(0.1, 0.2, 0.3)));
    }
}

#[test]
fn a_joint_in_another_role_gets_a_plan_of_its_own() {
    let model = jointed_lattice(2, 2, 3);
    let plan = Plan::new(&model).expect("a plan");
    // Soft bushings are not absorbed: they get coordinates of their own; stiff ones are.
    for stiffness in [1e-3, 3e7] {
        let changed = rebuilt(&model, |_, joint| {
            let mut joint = joint.clone();
            if joint.name.ends_with("bushing") {
                joint.stiffness = JointStiffness::Directions([Some(stiffness); 6]);
            }
            joint
        });
        same(&plan, &changed);
        let unknowns = plan.for_design(&changed).expect("a plan").unknowns();
        assert_eq!(unknowns > plan.unknowns(), stiffness < 1.0);
    }
}

#[test]
fn another_topology_gets_a_plan_of_its_own() {
    let plan = Plan::new(&gripper(4)).expect("a plan");
    same(&plan, &gripper(5));
    same(&plan, &lattice(3, 2, 4));
}
