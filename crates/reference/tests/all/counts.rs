//! Mobility, idle motions, undetermined wrenches, rigid outputs and errors.

use crate::common;

use common::{JointSpec, assert_close, circle, node, point, steel, stiffness_error};
use hyperstat_joints::{Cylindrical, DofSet, Fixed, Joint, Revolute, Screw, Spherical};
use hyperstat_model::Model;
use hyperstat_reference::{
    ReferenceError, TraditionalForm, TraditionalOptions, solve, traditional,
};
use nalgebra::{Matrix6, Rotation3, Vector6};

/// Two beams from walls, with a rod between ball joints at their tips; the output is a tip.
fn rod_between_balls() -> Model {
    let mut model = Model::new("rod");
    let (a, b) = (point(0.0, 0.0, 0.0), point(0.4, 0.1, 0.0));
    let (c, d) = (point(0.5, 0.3, 0.2), point(0.9, 0.3, 0.3));
    model
        .add_beam(
            "left",
            &[("A", a), ("B", b)],
            &steel(),
            &circle(0.02),
            None,
            1,
        )
        .unwrap();
    model
        .add_beam(
            "rod",
            &[("B", b), ("C", c)],
            &steel(),
            &circle(0.01),
            None,
            2,
        )
        .unwrap();
    model
        .add_beam(
            "right",
            &[("C", c), ("D", d)],
            &steel(),
            &circle(0.02),
            None,
            1,
        )
        .unwrap();
    JointSpec::new("a", "A", ["ground", "left"], Fixed).add(&mut model);
    JointSpec::new("b", "B", ["left", "rod"], Spherical).add(&mut model);
    JointSpec::new("c", "C", ["rod", "right"], Spherical).add(&mut model);
    JointSpec::new("d", "D", ["right", "ground"], Fixed).add(&mut model);
    model.set_output(node(&model, "left", "B"));
    model
}

#[test]
fn a_rod_between_ball_joints_spins_idly() {
    let mut model = rod_between_balls();
    let load = Vector6::new(30.0, -20.0, 10.0, 1.0, 2.0, 3.0);
    model.add_load(node(&model, "left", "B"), load).unwrap();
    let solution = solve(&model).unwrap();
    assert_eq!((solution.idle_modes, solution.free_motions.len()), (1, 0));
    assert_eq!((solution.mobility, solution.overconstraint), (1, 1));
    // The rod does not turn about itself: its spin is left out.
    let axis = point(0.5, 0.3, 0.2) - point(0.4, 0.1, 0.0);
    let (b, c) = (node(&model, "rod", "B"), node(&model, "rod", "C"));
    let turn = |k: usize| solution.displacements[k].fixed_rows::<3>(3).dot(&axis);
    assert!((turn(b.0) + turn(c.0)).abs() < 1e-12 * load.norm());
    let walls = solution.joint_wrenches[0].unwrap() - solution.joint_wrenches[3].unwrap();
    let forces = walls.fixed_rows::<3>(0) + load.fixed_rows::<3>(0);
    assert!(forces.norm() < 1e-12 * load.norm());
}

#[test]
fn a_load_on_an_idle_motion_names_the_body() {
    let mut model = rod_between_balls();
    let at = node(&model, "rod", "C");
    model
        .add_load(at, Vector6::new(0.0, 0.0, 0.0, 1.0, 0.0, 0.0))
        .unwrap();
    let body = "rod".into();
    assert_eq!(
        solve(&model).unwrap_err(),
        ReferenceError::Unrestrained { body }
    );
}

/// A rigid plate on three collinear hinges along one line: what each carries is not determined,
/// what the beam behind it carries is.
#[test]
fn wrenches_in_a_rigid_loop_are_undetermined() {
    let mut model = Model::new("hinges");
    let at = |x: f64| point(x, 0.0, 0.0);
    model
        .add_rigid("wall", &[("P", at(0.1)), ("Q", at(0.4)), ("W", at(0.2))])
        .unwrap();
    model
        .add_rigid(
            "door",
            &[("P", at(0.1)), ("Q", at(0.4)), ("T", point(0.2, 0.3, 0.0))],
        )
        .unwrap();
    let beam = [("G", point(0.2, 0.0, -0.5)), ("W", at(0.2))];
    model
        .add_beam("post", &beam, &steel(), &circle(0.03), None, 1)
        .unwrap();
    JointSpec::new("ground", "G", ["ground", "post"], Fixed).add(&mut model);
    JointSpec::new("weld", "W", ["post", "wall"], Fixed).add(&mut model);
    let along_x = Rotation3::from_euler_angles(0.0, 0.0, -std::f64::consts::FRAC_PI_2);
    for name in ["P", "Q"] {
        let hinge = JointSpec::new(name, name, ["wall", "door"], Revolute);
        hinge.frame(along_x).locked().add(&mut model);
    }
    model.set_output(node(&model, "door", "T"));
    let load = Vector6::new(1.0, 2.0, 3.0, 0.4, 0.5, 0.6);
    model.add_load(node(&model, "door", "T"), load).unwrap();
    let solution = solve(&model).unwrap();
    let determined: Vec<bool> = solution
        .joint_wrenches
        .iter()
        .map(Option::is_some)
        .collect();
    assert_eq!(determined, [true, true, false, false]);
    assert_eq!((solution.mobility, solution.overconstraint), (1, 5));
    let post = solution.joint_wrenches[0].unwrap();
    let arm = point(0.2, 0.3, 0.0) - point(0.2, 0.0, -0.5);
    let (force, moment) = (load.fixed_rows::<3>(0), load.fixed_rows::<3>(3));
    let carried = moment + arm.cross(&force.into_owned());
    let mut expected = -load;
    expected.fixed_rows_mut::<3>(3).copy_from(&-carried);
    assert_close(&post, &expected, 1e-13);
}

#[test]
fn an_output_held_rigidly_has_only_a_compliance() {
    let mut model = Model::new("slider");
    model
        .add_rigid("slider", &[("O", point(0.0, 0.0, 0.0))])
        .unwrap();
    JointSpec::new("guide", "O", ["ground", "slider"], Cylindrical)
        .springs(&[(1, 4e5), (4, 50.0)])
        .add(&mut model);
    model.set_output(node(&model, "slider", "O"));
    let solution = solve(&model).unwrap();
    assert_eq!(solution.stiffness, None);
    let mut expected = Matrix6::zeros();
    expected[(1, 1)] = 1.0 / 4e5;
    expected[(4, 4)] = 1.0 / 50.0;
    assert!((solution.compliance.unwrap() - expected).amax() < 1e-15 / 50.0);
    assert_eq!((solution.mobility, solution.overconstraint), (2, 0));
}

/// A spring on a screw's v resists turn and travel together; y is the way off the helix.
#[test]
fn a_screw_with_a_spring() {
    let (pitch, spring, guide) = (0.01, 200.0, 5e6);
    let mut model = Model::new("screw");
    model
        .add_rigid("nut", &[("O", point(0.0, 0.0, 0.0))])
        .unwrap();
    JointSpec::new("thread", "O", ["nut", "ground"], Screw::new(pitch).unwrap())
        .springs(&[(1, guide), (4, spring)])
        .add(&mut model);
    model.set_output(node(&model, "nut", "O"));
    let load = Vector6::new(0.0, 60.0, 0.0, 0.0, 2.0, 0.0);
    model.add_load(node(&model, "nut", "O"), load).unwrap();
    let solution = solve(&model).unwrap();
    // Work of the load on v: M + p F; on y: F.
    let turn = (2.0 + pitch * 60.0) / spring;
    let travel = pitch * turn + 60.0 / guide;
    let expected = Vector6::new(0.0, travel, 0.0, 0.0, turn, 0.0);
    assert_close(&solution.displacement.unwrap(), &expected, 1e-14);
    assert_close(&solution.joint_wrenches[0].unwrap(), &load, 1e-14);
}

/// A bushing whose elasticity is its own.
#[derive(Debug, Clone)]
struct Rubber(Matrix6<f64>);

impl Joint for Rubber {
    fn kind(&self) -> &str {
        "Rubber"
    }
    fn free(&self) -> DofSet {
        DofSet::EMPTY
    }
    fn compliance(&self) -> Option<Matrix6<f64>> {
        Some(self.0)
    }
    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(self.clone())
    }
}

fn coupled_stiffness() -> Matrix6<f64> {
    let scale = Vector6::new(1e3, 2e3, 1e3, 30.0, 40.0, 20.0);
    Matrix6::from_fn(|r, c| {
        let share = if r == c {
            1.0
        } else {
            0.9_f64.powi((r as i32 - c as i32).abs()) * 0.4
        };
        share * scale[r] * scale[c]
    })
}

/// The same elasticity as a full stiffness in the file, as the joint's own compliance, and as a
/// spring element of the traditional method, which adds 6×6 blocks.
#[test]
fn a_full_stiffness_and_a_joint_of_its_own_compliance() {
    let stiffness = coupled_stiffness();
    let frame = Rotation3::from_euler_angles(0.4, 1.1, -0.6);
    let build = |joint: JointSpec| {
        let mut model = Model::new("rubber");
        let beam = [("A", point(0.0, 0.0, 0.0)), ("B", point(0.2, 0.3, 0.1))];
        model
            .add_beam("beam", &beam, &steel(), &circle(0.02), None, 2)
            .unwrap();
        joint.frame(frame).add(&mut model);
        model.set_output(node(&model, "beam", "B"));
        model
    };
    let full = JointSpec::new("foot", "A", ["ground", "beam"], Fixed).matrix(stiffness);
    let full = build(full);
    let own = Rubber(stiffness.try_inverse().unwrap());
    let own = build(JointSpec::new("foot", "A", ["ground", "beam"], own));
    let found = solve(&full).unwrap().stiffness.unwrap();
    let options = TraditionalOptions {
        form: TraditionalForm::Penalty,
        joint_stiffness: 1e12,
        angular_stiffness: 1e9,
        free_stiffness: 0.0,
    };
    let added = traditional(&full, &options).unwrap().stiffness;
    assert!(stiffness_error(&found, &added) < 1e-9);
    let same = solve(&own).unwrap().stiffness.unwrap();
    assert!(stiffness_error(&found, &same) < 1e-12);
}

/// A compliance that is singular leaves its null direction rigid.
#[test]
fn a_compliance_of_rank_one_is_rigid_otherwise() {
    let along = Vector6::new(1e-4, 2e-4, 0.0, 0.0, 0.0, 0.0);
    let mut model = Model::new("rubber");
    model
        .add_rigid("block", &[("O", point(0.0, 0.0, 0.0))])
        .unwrap();
    let own = Rubber(along * along.transpose());
    JointSpec::new("foot", "O", ["ground", "block"], own).add(&mut model);
    model.set_output(node(&model, "block", "O"));
    let solution = solve(&model).unwrap();
    assert_eq!(solution.stiffness, None);
    let compliance = solution.compliance.unwrap();
    assert!((compliance - along * along.transpose()).amax() < 1e-20);
}

/// Zero frees a constrained direction, and leaves a locked one locked.
#[test]
fn zero_stiffness() {
    let slider =
        |locked: bool| {
            let mut model = Model::new("zero");
            model
                .add_rigid("block", &[("O", point(0.0, 0.0, 0.0))])
                .unwrap();
            let mut joint = JointSpec::new("foot", "O", ["ground", "block"], Cylindrical)
                .springs(&[(0, 0.0), (1, 0.0), (4, 0.0)]);
            joint.locked = locked;
            joint.add(&mut model);
            model.set_output(node(&model, "block", "O"));
            solve(&model).unwrap().free_motions.len()
        };
    assert_eq!(slider(true), 1);
    assert_eq!(slider(false), 3);
}

#[test]
fn models_that_cannot_be_solved() {
    let mut model = Model::new("empty");
    assert_eq!(solve(&model).unwrap_err(), ReferenceError::NoOutput);
    let beam = [("A", point(0.0, 0.0, 0.0)), ("B", point(0.2, 0.3, 0.1))];
    model
        .add_beam("beam", &beam, &steel(), &circle(0.02), None, 1_000_000)
        .unwrap();
    model.set_output(node(&model, "beam", "B"));
    let limit = 4800;
    let coordinates = 6 * 1_000_001;
    let expected = ReferenceError::TooLarge { coordinates, limit };
    assert_eq!(solve(&model).unwrap_err(), expected);

    let mut model = rod_between_balls();
    let mut geometry = model.geometry().clone();
    let (b, c) = (node(&model, "rod", "B"), node(&model, "rod", "C"));
    // All that meets at B moves to C: the rod has no length.
    let [from, to] = [b, c].map(|node| geometry.positions[node.0]);
    for position in geometry.positions.iter_mut().filter(|p| **p == from) {
        *position = to;
    }
    model
        .set_geometry(geometry)
        .expect("a geometry of this model");
    let body = "rod".into();
    let expected = ReferenceError::Segment { body, segment: 0 };
    assert_eq!(solve(&model).unwrap_err(), expected);
}

/// A body that nothing holds moves in six ways and has no stiffness there.
#[test]
fn a_body_in_mid_air() {
    let mut model = Model::new("mid-air");
    let beam = [("A", point(0.0, 0.0, 0.0)), ("B", point(0.2, 0.3, 0.1))];
    model
        .add_beam("beam", &beam, &steel(), &circle(0.02), None, 1)
        .unwrap();
    model.set_output(node(&model, "beam", "B"));
    let solution = solve(&model).unwrap();
    assert_eq!((solution.mobility, solution.free_motions.len()), (6, 6));
    assert!(solution.stiffness.unwrap().amax() < 1e-6);
    assert_eq!(solution.compliance, None);
}

/// What does not belong together, and what is too large, is refused.
#[test]
fn models_that_are_not_one_whole_are_refused() {
    let mut model = rod_between_balls();
    model.set_output(hyperstat_model::NodeId(99));
    let error = solve(&model).unwrap_err();
    assert!(matches!(error, ReferenceError::Model(_)), "{error}");
    let options = TraditionalOptions {
        joint_stiffness: 1e12,
        angular_stiffness: 1e9,
        free_stiffness: 0.0,
        form: TraditionalForm::Penalty,
    };
    let error = traditional(&model, &options).unwrap_err();
    assert!(matches!(error, ReferenceError::Model(_)), "{error}");

    let mut model = rod_between_balls();
    let mut geometry = model.geometry().clone();
    geometry.positions[node(&model, "rod", "B").0].z += 0.1;
    model.set_geometry(geometry).unwrap();
    let error = solve(&model).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("joint `b` joins `left.B` and `rod.B`"),
        "{error}"
    );

    let mut model = rod_between_balls();
    let [first, second] = ["left", "rod"].map(|body| node(&model, body, "B"));
    for k in 0..2000 {
        let weld = hyperstat_model::Connection {
            name: format!("more {k}"),
            between: [Some(first), Some(second)],
            joint: Box::new(Fixed),
            locked: DofSet::EMPTY,
            stiffness: hyperstat_model::JointStiffness::default(),
        };
        model.add_joint(weld, Rotation3::identity()).unwrap();
    }
    let error = solve(&model).unwrap_err();
    assert!(error.to_string().contains("at most 9600"), "{error}");
}
