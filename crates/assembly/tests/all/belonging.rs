//! What must belong together is one object or an error: the nodes of a joint, ids, geometries, plans
//! and buffers of another model.

use hyperstat_assembly::{
    Axes, BodyId, Connection, Geometry, JointId, JointStiffness, LANES, LineLoad, Load, LoadCase,
    LoadSet, ModalOptions, ModalPlan, Model, ModelError, NodeId, Prepared, SegmentId, SolveError,
    analyse, modes, section_wrench, segment_displacement, solve,
};
use hyperstat_elements::{Elasticity, Material, RigidMass, Section, SectionShape};
use hyperstat_joints::{DofSet, Fixed, Joint};
use nalgebra::{Point3, Rotation3, Vector3, Vector6};

/// A bar of `length` from the origin along x, welded to the ground, and a rigid plate on its end; the
/// plate's node lies `apart` from the bar's end, along y.
fn bar_and_plate(length: f64, apart: f64) -> Model {
    let mut model = Model::new("bar and plate");
    let steel = Material::new(2.1e11, Elasticity::Poisson(0.3), Some(7850.0)).expect("steel");
    let rod = Section::new(SectionShape::Circle { diameter: 0.02 }, None, None).expect("a rod");
    let (a, b) = (Point3::origin(), Point3::new(length, 0.0, 0.0));
    model
        .add_beam("bar", &[("A", a), ("B", b)], &steel, &rod, None, 1)
        .expect("a bar");
    let on_plate = Point3::new(length, apart, 0.0);
    let tip = Point3::new(length, 0.0, 0.3);
    model
        .add_rigid("plate", &[("P", on_plate), ("T", tip)])
        .expect("a plate");
    let weld = |name: &str, between| Connection {
        name: name.into(),
        between,
        joint: Box::new(Fixed) as Box<dyn Joint>,
        locked: DofSet::EMPTY,
        stiffness: JointStiffness::default(),
    };
    let [foot, end, plate] =
        [("bar", "A"), ("bar", "B"), ("plate", "P")].map(|(body, at)| model.node(body, at));
    let joints = [("foot", [None, foot]), ("head", [end, plate])];
    for (name, between) in joints {
        let frame = Rotation3::identity();
        model
            .add_joint(weld(name, between), frame)
            .expect("a joint");
    }
    let tip = model.node("plate", "T").expect("a node");
    model.set_output(tip);
    let force = Vector6::new(0.0, 100.0, 0.0, 0.0, 0.0, 0.0);
    model.add_load(tip, force).expect("a load");
    model
}

#[test]
fn a_joint_of_two_points_that_are_not_one_is_refused() {
    solve(&bar_and_plate(0.5, 0.0)).expect("a solution");
    // Six typed digits.
    solve(&bar_and_plate(0.5, 1e-7)).expect("a solution");
    let model = bar_and_plate(0.5, 1.0);
    let expected = SolveError::Model(ModelError::Apart {
        joint: "head".into(),
        first: "bar.B".into(),
        second: "plate.P".into(),
        distance: 1.0,
    });
    assert_eq!(solve(&model).expect_err("a lever"), expected);
    let modal = ModalPlan::new(&model, &ModalOptions::lowest(1));
    assert_eq!(modal.expect_err("a lever"), expected);
    for apart in [1e-3, 1e-4, f64::MIN_POSITIVE] {
        let model = bar_and_plate(0.5, apart);
        assert_eq!(solve(&model).is_err(), apart > 1e-5, "{apart}");
    }
}

/// The same in a sweep, where a pose may bring them apart, in lanes and one by one.
#[test]
fn a_pose_that_takes_a_joint_apart_is_refused() {
    let model = bar_and_plate(0.5, 0.0);
    let prepared = Prepared::new(model.clone());
    let mut parted = model.geometry().clone();
    parted.positions[model.node("plate", "P").expect("a node").0].y += 0.1;
    let is_apart = |error: SolveError| {
        assert!(
            matches!(error, SolveError::Model(ModelError::Apart { .. })),
            "{error}"
        );
    };
    let one = prepared.sweep(&parted, &mut prepared.workspace().expect("a plan"));
    is_apart(one.expect_err("apart"));
    let mut lanes = prepared.lanes().expect("a plan");
    assert!(lanes.is_parallel());
    lanes.geometry_mut(2).clone_from(&parted);
    let found = prepared.sweep_lanes(&mut lanes, [true; LANES]);
    for (pose, found) in found.into_iter().enumerate() {
        match (pose, found.expect("a result")) {
            (2, found) => is_apart(found.expect_err("apart")),
            (_, found) => assert!(found.is_ok()),
        }
    }
    let mut single = prepared.single().expect("a plan");
    assert!(single.is_parallel());
    single.geometry_mut().clone_from(&parted);
    is_apart(prepared.sweep_single(&mut single).expect_err("apart"));
    let modal = ModalPlan::new(&model, &ModalOptions::lowest(1)).expect("a plan");
    is_apart(modal.frequencies(&parted).expect_err("apart"));
    is_apart(prepared.at(&parted).expect_err("apart"));
    let mut moved = prepared.model().clone();
    moved.set_geometry(parted).expect("of its size");
    is_apart(Prepared::new(moved).here().solve().expect_err("apart"));
}

#[test]
fn ids_of_another_model_are_refused() {
    let foreign = |what: &'static str, index: usize, count: usize| ModelError::ForeignId {
        what,
        index,
        count,
    };
    let (node, segment) = (foreign("node", 99, 4), foreign("segment", 99, 1));
    let (body, joint) = (foreign("body", 99, 2), foreign("joint", 99, 2));
    let mut model = bar_and_plate(0.5, 0.0);
    let force = Vector6::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    assert_eq!(model.add_load(NodeId(99), force), Err(node.clone()));
    let on_node = LoadSet::on(NodeId(99), force);
    assert_eq!(model.set_loads(on_node.clone()), Err(node.clone()));
    let case = LoadCase {
        name: "case".into(),
        loads: on_node.clone(),
    };
    assert_eq!(model.add_case(case), Err(node.clone()));
    let line = LineLoad {
        segment: SegmentId(99),
        ends: [force; 2],
        axes: Axes::Global,
    };
    let along = LoadSet {
        lines: vec![line],
        ..LoadSet::default()
    };
    assert_eq!(model.set_loads(along), Err(segment));
    let turning = LoadSet {
        nodes: vec![Load {
            node: NodeId(0),
            wrench: force,
            axes: Axes::Body {
                body: BodyId(99),
                home: Rotation3::identity(),
            },
        }],
        ..LoadSet::default()
    };
    assert_eq!(model.set_loads(turning), Err(body.clone()));
    assert_eq!(model.set_temperature(BodyId(99), 1.0), Err(body));
    assert_eq!(model.set_misfit(JointId(99), &force), Err(joint.clone()));
    assert_eq!(model.set_preload(JointId(99), &force), Err(joint));
    let connection = Connection {
        name: "foreign".into(),
        between: [None, Some(NodeId(99))],
        joint: Box::new(Fixed),
        locked: DofSet::EMPTY,
        stiffness: JointStiffness::default(),
    };
    let added = model.add_joint(connection, Rotation3::identity());
    assert_eq!(added, Err(node.clone()));
    let prepared = Prepared::new(model.clone());
    let respond = prepared.here().respond(&[on_node]);
    assert_eq!(
        respond.expect_err("foreign"),
        SolveError::Model(node.clone())
    );
    // What is only looked up is not there.
    assert_eq!(model.node_of(BodyId(99), "A"), None);
    assert_eq!(model.body_frame(BodyId(99)), None);
    assert_eq!(model.misfit(JointId(99)), None);
    assert_eq!(model.node_name(NodeId(99)), "node 99");
    solve(&model).expect("as it was");

    let mut heavy = model.clone();
    heavy.add_mass(NodeId(99), RigidMass::point(1.0).expect("a mass"));
    assert_eq!(
        solve(&heavy).expect_err("foreign"),
        SolveError::Model(node.clone())
    );
    let geometry = heavy.geometry().clone();
    assert_eq!(heavy.set_geometry(geometry), Err(node.clone()));
    let mut elsewhere = model.clone();
    elsewhere.set_output(NodeId(99));
    let expected = SolveError::Model(node);
    assert_eq!(solve(&elsewhere).expect_err("foreign"), expected);
    let modal = ModalPlan::new(&elsewhere, &ModalOptions::lowest(1));
    assert_eq!(modal.expect_err("foreign"), expected);
    analyse(&elsewhere).expect("counts do not ask for the output");
}

#[test]
fn geometries_of_another_model_are_refused() {
    let mut model = bar_and_plate(0.5, 0.0);
    let prepared = Prepared::new(model.clone());
    let whole = model.geometry().clone();
    let changes: [fn(&mut Geometry); 5] = [
        |g| {
            g.positions.pop();
        },
        |g| g.positions.push(Point3::origin()),
        |g| g.y_axes.push(Some(Vector3::y())),
        |g| g.frames.clear(),
        |g| g.rotations.push(Rotation3::identity()),
    ];
    for change in changes {
        let mut foreign = whole.clone();
        change(&mut foreign);
        let is_foreign = |error: SolveError| {
            let foreign = matches!(error, SolveError::Model(ModelError::ForeignGeometry { .. }));
            assert!(foreign, "{error}");
        };
        let set = model.set_geometry(foreign.clone());
        is_foreign(set.expect_err("foreign").into());
        assert_eq!(*model.geometry(), whole);
        let swept = prepared.sweep(&foreign, &mut prepared.workspace().expect("a plan"));
        is_foreign(swept.expect_err("foreign"));
        let mut lanes = prepared.lanes().expect("a plan");
        lanes.geometry_mut(LANES - 1).clone_from(&foreign);
        let found = prepared.sweep_lanes(&mut lanes, [true; LANES]);
        for (pose, found) in found.into_iter().enumerate() {
            match found.expect("a result") {
                Err(error) if pose == LANES - 1 => is_foreign(error),
                found => assert!(found.is_ok() && pose < LANES - 1),
            }
        }
        let mut single = prepared.single().expect("a plan");
        single.geometry_mut().clone_from(&foreign);
        is_foreign(prepared.sweep_single(&mut single).expect_err("foreign"));
        is_foreign(prepared.at(&foreign).expect_err("foreign"));
        let modal = ModalPlan::new(&model, &ModalOptions::lowest(1)).expect("a plan");
        is_foreign(modal.frequencies(&foreign).expect_err("foreign"));
    }
}

/// Whatever a design shares with the first, its answers are its own.
#[test]
fn designs_have_their_own_answers() {
    let model = bar_and_plate(0.5, 0.0);
    let prepared = Prepared::new(model.clone());
    let mut welded = model.clone();
    let third = Connection {
        name: "third".into(),
        between: [None, welded.node("plate", "T")],
        joint: Box::new(Fixed),
        locked: DofSet::EMPTY,
        stiffness: JointStiffness::default(),
    };
    welded
        .add_joint(third, Rotation3::identity())
        .expect("a joint");
    let mut elsewhere = model.clone();
    elsewhere.set_output(model.node("bar", "B").expect("a node"));
    // Of the same bodies, joints and output; of other joints; of another output.
    for other in [bar_and_plate(0.7, 0.0), welded, elsewhere] {
        let expected = solve(&other).expect("a solution");
        let geometry = other.geometry().clone();
        let design = prepared.for_design(other).expect("a plan");
        let found = design.here().solve().expect("a solution");
        assert_eq!(found.output.displacement, expected.output.displacement);
        assert_eq!(found.unknowns, expected.unknowns);
        let mut workspace = design.workspace().expect("a plan");
        let swept = design.sweep(&geometry, &mut workspace).expect("a result");
        let swept = swept.displacement.expect("a held output");
        let difference = (swept - expected.output.displacement).amax();
        assert!(difference <= 1e-11 * swept.amax());
    }
}

/// Who changes the model has it made ready anew: what was made for it before serves no longer.
#[test]
fn buffers_do_not_outlive_a_change_of_the_model() {
    let mut prepared = Prepared::new(bar_and_plate(0.5, 0.0));
    let sag = |prepared: &Prepared| prepared.here().solve().map(|s| s.output.displacement[1]);
    assert!(sag(&prepared).expect("a solution") > 0.0);
    let mut workspace = prepared.workspace().expect("a plan");
    let mut lanes = prepared.lanes().expect("a plan");
    let mut single = prepared.single().expect("a plan");
    prepared.model_mut().clear_loads();
    assert_eq!(sag(&prepared).expect("a solution"), 0.0);
    let swept = prepared.sweep(prepared.model().geometry(), &mut workspace);
    assert_eq!(swept.expect_err("of before"), SolveError::ForeignWorkspace);
    let swept = prepared.sweep_single(&mut single);
    assert_eq!(swept.expect_err("of before"), SolveError::ForeignWorkspace);
    let found = prepared.sweep_lanes(&mut lanes, [true; LANES]);
    let found = found.map(|found| found.expect("a result").expect_err("of before"));
    assert_eq!(found, [const { SolveError::ForeignWorkspace }; LANES]);
}

/// Segments and bodies of another model are none of a solution's.
#[test]
fn results_are_asked_of_their_own_model() {
    let model = bar_and_plate(0.5, 0.0);
    let solution = solve(&model).expect("a solution");
    let far = SegmentId(99);
    assert!(solution.inner_displacements(&model, SegmentId(0)).is_ok());
    solution
        .inner_displacements(&model, far)
        .expect_err("foreign");
    assert!(solution.worst_point(&model, BodyId(0)).is_some());
    assert!(solution.worst_point(&model, BodyId(99)).is_none());
    let forces = &solution.segments[0];
    assert!(section_wrench(&model, far, forces, 0.5).is_none());
    let curve = |displacements, segment| {
        let geometry = model.geometry();
        segment_displacement(&model, geometry, displacements, segment, None, 0.5)
    };
    assert!(curve(&solution.displacements, SegmentId(0)).is_ok());
    curve(&solution.displacements, far).expect_err("foreign");
    curve(&solution.displacements[1..], SegmentId(0)).expect_err("too few");
    let modes = modes(&model, &ModalOptions::lowest(1)).expect("a mode");
    let mode = &modes.modes[0];
    assert!(mode.segment_displacement(&model, SegmentId(0), 0.5).is_ok());
    mode.segment_displacement(&model, far, 0.5)
        .expect_err("foreign");
}

#[test]
fn buffers_serve_the_mechanism_that_made_them() {
    let model = bar_and_plate(0.5, 0.0);
    let [prepared, other] = [(); 2].map(|()| Prepared::new(model.clone()));
    let swept = prepared.sweep(model.geometry(), &mut other.workspace().expect("a plan"));
    assert_eq!(swept.expect_err("foreign"), SolveError::ForeignWorkspace);
    let swept = prepared.sweep_single(&mut other.single().expect("a plan"));
    assert_eq!(swept.expect_err("foreign"), SolveError::ForeignWorkspace);
    let mut lanes = other.lanes().expect("a plan");
    let found = prepared.sweep_lanes(&mut lanes, [true; LANES]);
    let found = found.map(|found| found.expect("a result").expect_err("foreign"));
    assert_eq!(found, [const { SolveError::ForeignWorkspace }; LANES]);
}
