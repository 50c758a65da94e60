//! Wrenches balance at every node of the delta, absorbed joints included; and a cantilever
//! against the strength of materials.

use std::f64::consts::PI;

use hyperstat_assembly::{BodyKind, Connection, JointStiffness, Model, NodeId, Solution, solve};
use hyperstat_elements::stress::section_stress;
use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
use hyperstat_joints::{DofSet, Fixed};
use hyperstat_mechanisms::prebuilt::{Delta, Prebuilt};
use hyperstat_tests::turned;
use nalgebra::{Point3, Rotation3, Vector3, Vector6};

/// The wrench that everything around a node puts on it: what segments, joints and loads give.
fn unbalanced(model: &Model, solution: &Solution, node: NodeId) -> (Vector6<f64>, f64) {
    let mut sum = Vector6::zeros();
    let mut scale = 0.0_f64;
    let mut add = |w: Vector6<f64>| {
        sum += w;
        scale = scale.max(w.amax());
    };
    for (segment, forces) in model.segments().iter().zip(&solution.segments) {
        for (end, wrench) in segment.ends.iter().zip(&forces.ends) {
            if *end == node {
                add(-turned(&forces.frame, wrench));
            }
        }
    }
    for (k, joint) in model.joints().iter().enumerate() {
        let wrench = solution.joint_wrenches[k].expect("a determined wrench");
        let wrench = turned(&model.geometry().frames[k], &wrench);
        if joint.between[1] == Some(node) {
            add(wrench);
        }
        if joint.between[0] == Some(node) {
            add(-wrench);
        }
    }
    for load in model.loads() {
        if load.node == node {
            add(load.wrench);
        }
    }
    (sum, scale)
}

fn balances(delta: &Delta) {
    let mut model = delta.model(&[-0.12, 0.07, 0.5]).expect("a reachable pose");
    let on = [
        (
            "platform",
            "P",
            Vector6::new(-20.0, 10.0, 100.0, 5.0, 5.0, 8.0),
        ),
        ("wrist2", "C2", Vector6::new(0.0, 30.0, 0.0, 0.5, 0.0, 0.0)),
        ("roda1", "Ba1", Vector6::new(4.0, 3.0, -9.0, 0.0, 0.1, 0.0)),
        ("arm3", "A3", Vector6::new(7.0, 0.0, 1.0, 0.0, 0.0, 0.3)),
    ];
    for (body, point, wrench) in on {
        let node = model.node(body, point).expect("a node");
        model.add_load(node, wrench).expect("finite");
    }
    let solution = solve(&model).expect("a solution");
    let geometry = model.geometry();
    for body in model.bodies() {
        match body.kind {
            BodyKind::Rigid => {
                let mut whole = Vector6::zeros();
                for node in &body.nodes {
                    let (w, _) = unbalanced(&model, &solution, *node);
                    let arm = geometry.positions[node.0] - geometry.positions[body.nodes[0].0];
                    let force = Vector3::new(w[0], w[1], w[2]);
                    let moment = Vector3::new(w[3], w[4], w[5]) + arm.cross(&force);
                    whole += Vector6::new(
                        force[0], force[1], force[2], moment[0], moment[1], moment[2],
                    );
                }
                assert!(whole.amax() < 1e-10, "{}: {whole}", body.name);
            }
            _ => {
                for node in &body.nodes {
                    let (sum, scale) = unbalanced(&model, &solution, *node);
                    assert!(scale > 0.0);
                    let name = model.node_name(*node);
                    assert!(sum.amax() < 1e-12 * scale.max(100.0), "{name}: {sum}");
                }
            }
        }
    }
}

#[test]
fn delta_with_rigid_joints_balances_at_every_node() {
    balances(&Delta::paper());
}

#[test]
fn delta_with_elastic_joints_balances_at_every_node() {
    balances(&Delta {
        joint_stiffness: [Some(1e8), Some(2e8), Some(5e7), Some(1e5), None, Some(3e4)],
        drive_stiffness: Some(1e5),
        ..Delta::paper()
    });
}

/// σ = F L c / I, τ = T r / J, w = F L³ / 3EI, θ = F L² / 2EI, φ = T L / GJ.
#[test]
fn cantilever_with_tip_force_and_torque() {
    let (length, diameter, young, poisson) = (0.7, 0.024, 2.1e11, 0.3);
    let (force, torque) = (150.0, 12.0);
    let rotation = Rotation3::from_euler_angles(0.3, -0.8, 1.1);
    let tip = Point3::from(rotation * Vector3::new(length, 0.0, 0.0));

    let mut model = Model::new("cantilever");
    let material = Material::new(young, Elasticity::Poisson(poisson), None).expect("a material");
    let section = Section::new(SectionShape::Circle { diameter }, None, None).expect("a section");
    let points = [("root", Point3::origin()), ("tip", tip)];
    let y_axis = Some(rotation * Vector3::y());
    model
        .add_beam("beam", &points, &material, &section, y_axis, 3)
        .expect("a beam");
    let root = model.node("beam", "root").expect("a node");
    let tip = model.node("beam", "tip").expect("a node");
    let wall = Connection {
        name: "wall".into(),
        between: [None, Some(root)],
        joint: Box::new(Fixed),
        locked: DofSet::EMPTY,
        stiffness: JointStiffness::default(),
    };
    model
        .add_joint(wall, Rotation3::identity())
        .expect("a joint");
    let load = turned(&rotation, &Vector6::new(0.0, force, 0.0, torque, 0.0, 0.0));
    model.add_load(tip, load).expect("finite");
    model.set_output(tip);
    let solution = solve(&model).expect("a solution");

    let inertia = PI * diameter.powi(4) / 64.0;
    let shear = young / (2.0 * (1.0 + poisson));
    let u = turned(&rotation.inverse(), &solution.output.displacement);
    let expected = Vector6::new(
        0.0,
        force * length.powi(3) / (3.0 * young * inertia),
        0.0,
        torque * length / (shear * 2.0 * inertia),
        0.0,
        force * length.powi(2) / (2.0 * young * inertia),
    );
    assert!((u - expected).amax() < 1e-14, "{u}");

    let stress = section_stress(&section, &-solution.segments[0].ends[0]).expect("a circle");
    let bending = force * length * diameter / 2.0 / inertia;
    let torsion = torque * diameter / 2.0 / (2.0 * inertia);
    assert!(
        (stress.normal - bending).abs() < 1e-12 * bending,
        "{stress:?}"
    );
    assert!(
        (stress.shear - torsion).abs() < 1e-12 * torsion,
        "{stress:?}"
    );
}
