//! What is said of outputs that are held, free, or neither; and of bodies that nothing holds.

use hyperstat_assembly::{
    Connection, JointStiffness, Model, Prepared, SolveError, Warning, analyse, solve,
};
use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
use hyperstat_joints::{DofSet, Fixed, Joint, Planar, Revolute, Spherical, frame_from_axis};
use nalgebra::{Point3, Rotation3, Vector3, Vector6};

fn steel() -> Material {
    Material::new(2.1e11, Elasticity::Poisson(0.3), None).expect("a material")
}

fn rod() -> Section {
    Section::new(SectionShape::Circle { diameter: 0.02 }, None, None).expect("a section")
}

fn connection(name: &str, joint: Box<dyn Joint>) -> Connection {
    Connection {
        name: name.into(),
        between: [None, None],
        joint,
        locked: DofSet::EMPTY,
        stiffness: JointStiffness::default(),
    }
}

/// A bar from the origin along x, rigid or not, with a revolute joint about z to the ground.
fn pendulum(rigid: bool, locked: bool, stiffness: Option<f64>) -> Model {
    let mut model = Model::new("pendulum");
    let points = [("O", Point3::origin()), ("T", Point3::new(0.4, 0.0, 0.0))];
    if rigid {
        model.add_rigid("bar", &points).expect("a body");
    } else {
        model
            .add_beam("bar", &points, &steel(), &rod(), None, 1)
            .expect("a body");
    }
    let joint = Connection {
        between: [None, model.node("bar", "O")],
        locked: if locked {
            Revolute.free()
        } else {
            DofSet::EMPTY
        },
        stiffness: JointStiffness::Directions([None, None, None, None, stiffness, None]),
        ..connection("pivot", Box::new(Revolute))
    };
    let frame = frame_from_axis(Some(&Vector3::z()), None).expect("an axis");
    model.add_joint(joint, frame).expect("a joint");
    model.set_output(model.node("bar", "T").expect("a node"));
    model
}

#[test]
fn a_rigidly_held_output_has_a_compliance_but_no_stiffness() {
    let solution = solve(&pendulum(true, true, None)).expect("a solution");
    assert_eq!(solution.unknowns, 0);
    assert!(solution.output.stiffness.is_none());
    assert_eq!(solution.output.rigid_directions.len(), 6);
    assert_eq!(solution.output.compliance.expect("zero").amax(), 0.0);
    assert!(solution.output.free_motions.is_empty());
}

#[test]
fn an_output_on_a_spring_is_rigid_in_five_directions() {
    let mut model = pendulum(true, true, Some(2000.0));
    let tip = model.output().expect("an output");
    model
        .add_load(tip, Vector6::new(0.0, 5.0, 0.0, 0.0, 0.0, 0.0))
        .expect("a load");
    let solution = solve(&model).expect("a solution");
    assert!(solution.output.stiffness.is_none());
    assert_eq!(solution.output.rigid_directions.len(), 5);
    // 5 N at 0.4 m turn 2000 N·m/rad by 1e-3 rad.
    let c = solution.output.compliance.expect("a compliance");
    assert!((c[(5, 5)] - 1.0 / 2000.0).abs() < 1e-18);
    let u = solution.output.displacement;
    assert!((u - Vector6::new(0.0, 4e-4, 0.0, 0.0, 0.0, 1e-3)).amax() < 1e-17);
    let wrench = solution.joint_wrenches[0].expect("determined");
    // On the second body, joint frame: y along the axis carries the moment about it.
    assert!(
        (wrench[4] + 2.0).abs() < 1e-13 && (wrench.fixed_rows::<3>(0).norm() - 5.0).abs() < 1e-13
    );
}

#[test]
fn a_rigid_pendulum_is_rigid_and_free() {
    let solution = solve(&pendulum(true, false, None)).expect("a solution");
    assert!(solution.output.stiffness.is_none() && solution.output.compliance.is_none());
    assert_eq!(solution.output.rigid_directions.len(), 5);
    assert_eq!(solution.output.free_motions.len(), 1);
    assert_eq!(
        (
            solution.mobility,
            solution.overconstraint,
            solution.idle.len()
        ),
        (1, 0, 0)
    );
}

#[test]
fn an_elastic_pendulum_has_a_semidefinite_stiffness() {
    let solution = solve(&pendulum(false, false, None)).expect("a solution");
    let k = solution.output.stiffness.expect("a stiffness");
    assert!(solution.output.compliance.is_none());
    let free = solution.output.free_motions[0];
    assert!((free[1] / free[5] - 0.4).abs() < 1e-12, "{free}");
    assert!((k * free).amax() < 1e-9 * k.amax(), "{}", k * free);
    // Across the other directions it is the cantilever.
    let inertia = std::f64::consts::PI * 0.02_f64.powi(4) / 64.0;
    let expected = 12.0 * 2.1e11 * inertia / 0.4_f64.powi(3);
    assert!((k[(2, 2)] / expected - 1.0).abs() < 1e-12);
}

#[test]
fn a_load_on_a_free_motion_is_refused_and_named() {
    let mut model = pendulum(false, false, None);
    let tip = model.output().expect("an output");
    model
        .add_load(tip, Vector6::new(0.0, 5.0, 0.0, 0.0, 0.0, 0.0))
        .expect("a load");
    match solve(&model) {
        Err(SolveError::LoadOnFreeMotion {
            node,
            load: Some(0),
            motion,
            ..
        }) => {
            assert_eq!(node, "bar.T");
            assert_eq!(motion, "`bar` turns about (0, 0, 1) through O");
        }
        other => panic!("{other:?}"),
    }
    // Of another configuration, the points are those of that one.
    let mut reversed = Model::new("reversed");
    let points = [("T", Point3::new(0.4, 0.0, 0.0)), ("O", Point3::origin())];
    reversed.add_rigid("bar", &points).expect("a body");
    let joint = Connection {
        between: [None, reversed.node("bar", "O")],
        ..connection("pivot", Box::new(Revolute))
    };
    let frame = frame_from_axis(Some(&Vector3::z()), None).expect("an axis");
    reversed.add_joint(joint, frame).expect("a joint");
    let tip = reversed.node("bar", "T").expect("a node");
    reversed.set_output(tip);
    let load = Vector6::new(5.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    reversed.add_load(tip, load).expect("a load");
    let mut geometry = reversed.geometry().clone();
    geometry.positions[tip.0] = Point3::new(0.0, 0.4, 0.0);
    let prepared = Prepared::new(reversed.clone());
    match prepared.sweep(&geometry, &mut prepared.workspace().expect("a plan")) {
        Err(SolveError::LoadOnFreeMotion { motion, .. }) => {
            assert_eq!(motion, "`bar` turns about (0, 0, -1) through O");
        }
        other => panic!("{other:?}"),
    }
    // Along the bar it works on nothing.
    let mut model = pendulum(false, false, None);
    let tip = model.output().expect("an output");
    model
        .add_load(tip, Vector6::new(7.0, 0.0, 3.0, 0.0, 0.0, 0.0))
        .expect("a load");
    let u = solve(&model).expect("a solution").output.displacement;
    let area = std::f64::consts::PI * 1e-4;
    assert!((u[0] - 7.0 * 0.4 / (2.1e11 * area)).abs() < 1e-18, "{u}");
}

#[test]
fn a_body_that_nothing_holds_is_named() {
    let mut model = pendulum(false, true, None);
    model
        .add_rigid("stone", &[("S", Point3::new(1.0, 1.0, 1.0))])
        .expect("a body");
    assert_eq!(
        solve(&model).map(|_| ()),
        Err(SolveError::Unheld {
            bodies: vec!["stone".into()]
        })
    );
}

#[test]
fn an_output_that_nothing_holds_has_no_stiffness_at_all() {
    let mut model = Model::new("stone");
    model
        .add_rigid("stone", &[("S", Point3::new(1.0, 1.0, 1.0))])
        .expect("a body");
    model.set_output(model.node("stone", "S").expect("a node"));
    let solution = solve(&model).expect("a solution");
    assert_eq!(solution.output.stiffness.expect("zero").amax(), 0.0);
    assert_eq!(solution.output.free_motions.len(), 6);
    assert_eq!(solution.output.displacement, Vector6::zeros());
}

#[test]
fn a_model_without_output_is_refused() {
    let mut model = Model::new("stone");
    model
        .add_rigid("stone", &[("S", Point3::origin())])
        .expect("a body");
    assert_eq!(solve(&model).map(|_| ()), Err(SolveError::NoOutput));
}

/// A rod between two ball joints spins about its own axis; the output does not notice.
#[test]
fn an_idle_rod_is_named_and_left_at_rest() {
    let mut model = pendulum(false, true, None);
    let points = [
        ("T", Point3::new(0.4, 0.0, 0.0)),
        ("G", Point3::new(0.4, 0.3, 0.4)),
    ];
    model
        .add_beam("stay", &points, &steel(), &rod(), None, 1)
        .expect("a body");
    for (name, between) in [
        ("upper", [model.node("stay", "T"), model.node("bar", "T")]),
        ("lower", [None, model.node("stay", "G")]),
    ] {
        let joint = Connection {
            between,
            ..connection(name, Box::new(Spherical))
        };
        model
            .add_joint(joint, Rotation3::identity())
            .expect("a joint");
    }
    let tip = model.output().expect("an output");
    model
        .add_load(tip, Vector6::new(0.0, 50.0, 10.0, 0.0, 0.0, 1.0))
        .expect("a load");
    let solution = solve(&model).expect("a solution");
    assert_eq!(solution.idle.len(), 1);
    let words = solution.idle[0].describe(&model);
    assert_eq!(words, "`stay` spins about its own axis (0, 0.6, 0.8)");
    let node = model.node("stay", "G").expect("a node");
    let spin = solution.displacements[node.0]
        .fixed_rows::<3>(3)
        .dot(&Vector3::new(0.0, 0.6, 0.8));
    assert!(spin.abs() < 1e-9, "{spin:e}");
    // The stay carries tension only.
    let ends = &solution.segments[1].ends;
    assert!(ends[1].fixed_rows::<5>(1).amax() < 1e-12 * ends[1][0].abs());
}

#[test]
fn counts_of_a_model_need_no_output() {
    let mut model = Model::new("two bars");
    for name in ["a", "b"] {
        model
            .add_rigid(name, &[("O", Point3::origin())])
            .expect("a body");
    }
    let (a, b) = (model.node("a", "O"), model.node("b", "O"));
    let weld = Connection {
        between: [None, a],
        ..connection("weld", Box::new(Fixed))
    };
    let ball = Connection {
        between: [a, b],
        ..connection("ball", Box::new(Spherical))
    };
    let again = Connection {
        between: [b, a],
        ..connection("again", Box::new(Spherical))
    };
    for joint in [weld, ball, again] {
        model
            .add_joint(joint, Rotation3::identity())
            .expect("a joint");
    }
    let kinematics = analyse(&model).expect("a small model");
    assert_eq!((kinematics.mobility, kinematics.overconstraint), (3, 3));
    assert_eq!(kinematics.motions.len(), 3);
}

/// A slider between two stops that are nearly parallel to its guide: nearly free along it.
#[test]
fn a_nearly_singular_mechanism_is_solved_with_a_warning_that_names_the_motion() {
    let mut model = pendulum(false, true, None);
    model
        .add_rigid("slider", &[("S", Point3::new(0.2, 0.1, 0.0))])
        .expect("a body");
    let slider = model.node("slider", "S");
    for (name, normal) in [
        ("guide", Vector3::new(0.0, 1.0, 0.0)),
        ("stop", Vector3::new(1e-5, 1.0, 0.0)),
        ("floor", Vector3::new(0.0, 0.0, 1.0)),
    ] {
        let joint = Connection {
            between: [None, slider],
            ..connection(name, Box::new(Planar))
        };
        let frame = frame_from_axis(Some(&normal), None).expect("an axis");
        model.add_joint(joint, frame).expect("a joint");
    }
    let solution = solve(&model).expect("a solution");
    let [Warning::NearSingular { value, motion }] = &solution.warnings[..] else {
        panic!("{:?}", solution.warnings)
    };
    assert!((1e-7..1e-4).contains(value), "{value:e}");
    assert_eq!(motion.as_deref(), Some("`slider` moves along (1, 0, 0)"));
}
