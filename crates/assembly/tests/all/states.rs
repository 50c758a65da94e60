//! States: cases and superposition, weight, distributed loads, temperature, loads that turn with a
//! body, against closed forms of the strength of materials and against each other.

use std::f64::consts::FRAC_PI_2;

use hyperstat_assembly::{
    Axes, Connection, JointId, JointStiffness, LineLoad, Load, LoadCase, LoadSet, Model,
    ModelError, NodeId, Prepared, SegmentId, Solution, SolveError, solve,
};
use hyperstat_elements::{Elasticity, Material, RigidMass, Section, SectionShape};
use hyperstat_joints::{DofSet, Fixed, Prismatic, Revolute};
use nalgebra::{Point3, Rotation3, Vector3, Vector6};

use crate::parts::flat;

const YOUNG: f64 = 2.1e11;
const DENSITY: f64 = 7850.0;
const EXPANSION: f64 = 1.2e-5;
const LENGTH: f64 = 0.8;

fn steel() -> Material {
    Material::new(YOUNG, Elasticity::Poisson(0.3), Some(DENSITY))
        .and_then(|steel| steel.with_expansion(EXPANSION))
        .expect("a material")
}

fn joint(model: &mut Model, name: &str, between: [Option<NodeId>; 2], stiffness: JointStiffness) {
    let connection = Connection {
        name: name.into(),
        between,
        joint: Box::new(Fixed),
        locked: DofSet::EMPTY,
        stiffness,
    };
    model
        .add_joint(connection, Rotation3::identity())
        .expect("a joint");
}

/// A beam from A over M to B along a slanted line, of which the points are given in this order.
fn beam(order: [&str; 3]) -> Model {
    let mut model = Model::new("beam");
    let direction = Vector3::new(0.6, 0.8, 0.0) * LENGTH;
    let at = |name: &str| match name {
        "A" => Point3::origin(),
        "M" => Point3::from(direction * 0.4),
        _ => Point3::from(direction),
    };
    let points = order.map(|name| (name, at(name)));
    model
        .add_beam("beam", &points, &steel(), &flat(), None, 1)
        .expect("a body");
    model.set_output(node(&model, "B"));
    model
}

fn node(model: &Model, point: &str) -> NodeId {
    model.node("beam", point).expect("a node")
}

fn clamp(model: &mut Model, point: &str) {
    let between = [None, Some(node(model, point))];
    joint(model, point, between, JointStiffness::default());
}

fn along(direction: usize, value: f64) -> Vector6<f64> {
    let mut v = Vector6::zeros();
    v[direction] = value;
    v
}

fn near(found: f64, expected: f64, what: &str) {
    let difference = (found - expected).abs();
    assert!(
        difference <= 1e-11 * expected.abs(),
        "{what}: {found:e} instead of {expected:e}"
    );
}

#[test]
fn a_cantilever_sags_by_w_l4_over_8_e_i_under_its_own_weight() {
    let second_moment = 0.02 * 0.03_f64.powi(3) / 12.0;
    let weight = DENSITY * 0.02 * 0.03 * 9.81;
    for order in [["A", "M", "B"], ["B", "M", "A"]] {
        let mut model = beam(order);
        clamp(&mut model, "A");
        model
            .set_gravity(Vector3::new(0.0, 0.0, -9.81))
            .expect("gravity");
        let solution = solve(&model).expect("a solution");
        let sag = -weight * LENGTH.powi(4) / (8.0 * YOUNG * second_moment);
        near(solution.output.displacement[2], sag, "sag");
        let reaction = solution.joint_wrenches[0].expect("determined");
        near(reaction[2], weight * LENGTH, "reaction");
        let moment = weight * LENGTH * LENGTH / 2.0;
        near(reaction.fixed_rows::<3>(3).norm(), moment, "moment");
        // The curve between the nodes: w x² (6 L² − 4 L x + x²) / 24 E I.
        let middle = solution
            .inner_displacements(&model, SegmentId(0))
            .expect("a curve");
        assert!(middle.is_empty());
        for (k, segment) in solution.segments.iter().enumerate() {
            let ends = model.segments()[k].ends;
            let carried = segment.load.resultant(segment.length);
            let sum: Vector3<f64> = (segment.ends[0] + segment.ends[1] + carried)
                .fixed_rows::<3>(0)
                .into();
            assert!(
                sum.norm() < 1e-10 * weight,
                "segment {k} between {ends:?}: {sum}"
            );
        }
        let at = LENGTH * 0.4;
        let expected = weight * at * at * (6.0 * LENGTH * LENGTH - 4.0 * LENGTH * at + at * at)
            / (24.0 * YOUNG * second_moment);
        let found = solution.displacements[node(&model, "M").0][2];
        near(found, -expected, "deflection of M");
    }
}

#[test]
fn inner_nodes_lie_on_the_loaded_curve() {
    let mut model = Model::new("beam");
    let points = [
        ("A", Point3::origin()),
        ("B", Point3::new(LENGTH, 0.0, 0.0)),
    ];
    model
        .add_beam("beam", &points, &steel(), &flat(), None, 4)
        .expect("a body");
    clamp(&mut model, "A");
    clamp(&mut model, "B");
    model.set_output(node(&model, "B"));
    let load = -500.0;
    let set = LoadSet {
        nodes: Vec::new(),
        lines: vec![LineLoad {
            segment: SegmentId(0),
            ends: [along(2, load); 2],
            axes: Axes::Global,
        }],
    };
    model.set_loads(set).expect("loads");
    let solution = solve(&model).expect("a solution");
    let second_moment = 0.02 * 0.03_f64.powi(3) / 12.0;
    let inner = solution
        .inner_displacements(&model, SegmentId(0))
        .expect("a curve");
    for (k, found) in inner.iter().enumerate() {
        let x = LENGTH * (k + 1) as f64 / 4.0;
        let expected = load * (x * (LENGTH - x)).powi(2) / (24.0 * YOUNG * second_moment);
        near(found[2], expected, "between two clamps");
    }
}

#[test]
fn a_heated_bar_between_walls_pushes_with_e_a_alpha_t() {
    for order in [["A", "M", "B"], ["B", "M", "A"]] {
        let mut model = beam(order);
        clamp(&mut model, "A");
        clamp(&mut model, "B");
        let body = model.body("beam").expect("the body");
        model.set_temperature(body, 30.0).expect("a temperature");
        let solution = solve(&model).expect("a solution");
        let push = YOUNG * 0.02 * 0.03 * EXPANSION * 30.0;
        let wrench = solution.joint_wrenches[0].expect("determined");
        near(wrench[0], push * 0.6, "the wall at A, x");
        near(wrench[1], push * 0.8, "the wall at A, y");
    }
    let mut free = beam(["A", "M", "B"]);
    clamp(&mut free, "A");
    let body = free.body("beam").expect("the body");
    free.set_temperature(body, 30.0).expect("a temperature");
    let moved = solve(&free).expect("a solution").output.displacement;
    near(moved[0], EXPANSION * 30.0 * LENGTH * 0.6, "growth");
    let rigid = {
        let mut model = Model::new("rigid");
        let body = model
            .add_rigid("beam", &[("A", Point3::origin())])
            .expect("a body");
        model.set_temperature(body, 1.0)
    };
    assert!(matches!(rigid, Err(ModelError::NotOfBeams { .. })));
}

/// A bent beam on elastic joints, absorbed at both ends and in the middle, that carries everything.
fn loaded() -> Model {
    let mut model = Model::new("loaded");
    let points = [
        ("B", Point3::new(0.5, 0.2, 0.1)),
        ("M", Point3::new(0.3, 0.1, 0.4)),
        ("A", Point3::origin()),
    ];
    model
        .add_beam("beam", &points, &steel(), &flat(), None, 1)
        .expect("a body");
    let tip = [("B", points[0].1), ("T", Point3::new(0.6, 0.3, 0.2))];
    model.add_rigid("tool", &tip).expect("a body");
    let springs =
        |k: f64| JointStiffness::Directions([1.0, 2.0, 3.0, 0.01, 0.02, 0.03].map(|s| Some(s * k)));
    let (a, b) = (node(&model, "A"), node(&model, "B"));
    let held = model.node("tool", "B");
    joint(&mut model, "foot", [None, Some(a)], springs(1e6));
    joint(&mut model, "wrist", [Some(b), held], springs(2e6));
    model.set_output(model.node("tool", "T").expect("a node"));
    model
}

/// A load of every sort.
fn loads(model: &Model) -> [LoadSet; 3] {
    let tool = model.output().expect("an output");
    let wrench = Vector6::new(3.0, -20.0, 7.0, 0.5, 0.2, -1.0);
    let line = LineLoad {
        segment: SegmentId(0),
        ends: [
            Vector6::new(10.0, 40.0, -5.0, 0.1, 0.0, 2.0),
            Vector6::new(0.0, 80.0, 25.0, 0.0, 1.0, 0.0),
        ],
        axes: Axes::Global,
    };
    [
        LoadSet::on(tool, wrench),
        LoadSet::on(node(model, "B"), wrench * 2.0),
        LoadSet {
            nodes: Vec::new(),
            lines: vec![line],
        },
    ]
}

fn sum<'s>(states: impl Iterator<Item = &'s Vector6<f64>>) -> Vector6<f64> {
    states.sum()
}

#[test]
fn states_superpose_and_respond_takes_each_alone() {
    let mut model = loaded();
    let sets = loads(&model);
    let together = LoadSet {
        nodes: sets.iter().flat_map(|s| s.nodes.clone()).collect(),
        lines: sets.iter().flat_map(|s| s.lines.clone()).collect(),
    };
    let gravity = Vector3::new(1.0, -2.0, -9.81);
    let weight_alone = {
        let mut heavy = loaded();
        heavy.set_gravity(gravity).expect("gravity");
        solve(&heavy).expect("a solution")
    };
    model.set_loads(together).expect("loads");
    for (k, loads) in sets.iter().enumerate() {
        let (name, loads) = (format!("case {k}"), loads.clone());
        model.add_case(LoadCase { name, loads }).expect("a case");
    }
    model.set_gravity(gravity).expect("gravity");
    let prepared = Prepared::new(model.clone());
    let alone = prepared.here().respond(&sets).expect("responses");
    let all = prepared.here().solve().expect("a solution");
    assert_eq!(all.cases.len(), 3);
    let size = all.output.displacement.amax();
    let summed = sum(alone.iter().map(|s| &s.output)) + weight_alone.output.displacement;
    assert!((summed - all.output.displacement).amax() < 1e-12 * size);
    for (state, case) in alone.iter().zip(&all.cases) {
        // Weight acts in every case.
        let expected = state.output + weight_alone.output.displacement;
        assert!((case.state.output - expected).amax() < 1e-12 * size);
    }
    for (k, wrench) in all.joint_wrenches.iter().enumerate() {
        let parts = alone
            .iter()
            .map(|s| s.joint_wrenches[k].as_ref().expect("one"));
        let weight = weight_alone.joint_wrenches[k].expect("one");
        let wrench = wrench.expect("one");
        let difference = (sum(parts) + weight - wrench).amax();
        assert!(
            difference < 1e-11 * wrench.amax(),
            "joint {k}: {difference:e}"
        );
    }
    for (n, displacement) in all.displacements.iter().enumerate() {
        let parts = alone.iter().map(|s| &s.displacements[n]);
        let difference = sum(parts) + weight_alone.displacements[n] - displacement;
        assert!(difference.amax() < 1e-12 * size, "node {n}");
    }
    // The sweep finds the same.
    let found = prepared.sweep(model.geometry(), &mut prepared.workspace().expect("a plan"));
    let found = found.expect("a result");
    assert_eq!(found.cases.len(), 3);
    for (found, case) in found.cases.iter().zip(&all.cases) {
        assert!((found - case.state.output).amax() < 1e-10 * size);
    }
}

/// What the foot must carry of a wrench per length: a sum over many short pieces of the segments.
fn foot_reaction(model: &Model, solution: &Solution) -> Vector6<f64> {
    let mut reaction = Vector6::<f64>::zeros();
    let mut take = |at: Point3<f64>, force: Vector3<f64>, moment: Vector3<f64>| {
        let moment = moment + at.coords.cross(&force);
        reaction += Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
    };
    let positions = &model.geometry().positions;
    for (segment, forces) in model.segments().iter().zip(&solution.segments) {
        let [a, b] = segment.ends.map(|n| positions[n.0]);
        let pieces = 4000;
        for k in 0..pieces {
            let xi = (k as f64 + 0.5) / pieces as f64;
            let wrench = forces.load.intensity(xi) * (forces.length / pieces as f64);
            let force = forces.frame * Vector3::new(wrench[0], wrench[1], wrench[2]);
            let moment = forces.frame * Vector3::new(wrench[3], wrench[4], wrench[5]);
            take(a.lerp(&b, xi), force, moment);
        }
    }
    -reaction
}

#[test]
fn the_foot_carries_what_is_distributed() {
    let mut model = loaded();
    let [_, _, lines] = loads(&model);
    model.set_loads(lines).expect("loads");
    model
        .set_gravity(Vector3::new(1.0, -2.0, -9.81))
        .expect("gravity");
    let solution = solve(&model).expect("a solution");
    let found = solution.joint_wrenches[0].expect("determined");
    let expected = foot_reaction(&model, &solution);
    assert!(
        (found - expected).amax() < 1e-6 * expected.amax(),
        "{found} {expected}"
    );
}

#[test]
fn a_mass_weighs_where_it_is() {
    let mut model = loaded();
    let tool = model.output().expect("an output");
    let mass = RigidMass::point(2.5).expect("a mass");
    model.add_mass(tool, mass);
    let plain = solve(&model).expect("a solution").output.displacement;
    assert_eq!(plain.amax(), 0.0);
    let g = Vector3::new(0.0, 0.0, -9.81);
    model.set_gravity(g).expect("gravity");
    let heavy = solve(&model).expect("a solution");
    let mut pulled = loaded();
    pulled.set_gravity(g).expect("gravity");
    pulled
        .add_load(tool, along(2, -9.81 * 2.5))
        .expect("a load");
    let expected = solve(&pulled).expect("a solution").output.displacement;
    assert!((heavy.output.displacement - expected).amax() < 1e-14 * expected.amax());
}

#[test]
fn a_load_turns_with_its_body() {
    let mut model = loaded();
    let body = model.body("beam").expect("the body");
    let home = model.body_frame(body).expect("three points not in a line");
    let tool = model.output().expect("an output");
    let wrench = Vector6::new(3.0, -20.0, 7.0, 0.5, 0.2, -1.0);
    let load = Load {
        node: tool,
        wrench,
        axes: Axes::Body { body, home },
    };
    let set = LoadSet {
        nodes: vec![load],
        lines: Vec::new(),
    };
    model.set_loads(set).expect("loads");
    let before = solve(&model).expect("a solution").output.displacement;
    // The whole mechanism turned: everything turns with it.
    let turn = Rotation3::from_axis_angle(&Vector3::y_axis(), FRAC_PI_2)
        * Rotation3::from_axis_angle(&Vector3::z_axis(), 0.3);
    let mut geometry = model.geometry().clone();
    for position in &mut geometry.positions {
        *position = turn * *position;
    }
    for frame in &mut geometry.frames {
        *frame = turn * *frame;
    }
    for (k, y) in geometry.y_axes.iter_mut().enumerate() {
        let ends = model.segments()[k].ends;
        let [a, b] = ends.map(|n| model.geometry().positions[n.0]);
        let frame = hyperstat_elements::element_frame(&(b - a), None).expect("a frame");
        *y = Some(turn * frame.matrix().column(1));
    }
    model
        .set_geometry(geometry)
        .expect("a geometry of this model");
    let after = solve(&model).expect("a solution").output.displacement;
    let turned = hyperstat_elements::rotate_vector6(&before, &turn);
    assert!((after - turned).amax() < 1e-11 * before.amax());
}

/// Poses say how every section lies, also of beams whose local y was not given, and a carriage's
/// point stays with the rail: neither turns the body.
#[test]
fn what_is_not_fixed_in_a_body_does_not_turn_it() {
    let mut model = beam(["A", "M", "B"]);
    let beam = model.body("beam").expect("the body");
    let rail = [("A", Point3::origin()), ("C", Point3::new(0.0, 0.3, 0.1))];
    let carriage = model.add_rigid("carriage", &rail).expect("a body");
    let hinge = |name: &str, between, joint| Connection {
        name: name.into(),
        between,
        joint,
        locked: DofSet::EMPTY,
        stiffness: JointStiffness::default(),
    };
    let foot = [None, Some(node(&model, "B"))];
    let slide = [Some(node(&model, "A")), model.node("carriage", "A")];
    for connection in [
        hinge("foot", foot, Box::new(Revolute)),
        hinge("slide", slide, Box::new(Prismatic)),
    ] {
        model
            .add_joint(connection, Rotation3::identity())
            .expect("a joint");
    }
    let home = [beam, carriage].map(|body| model.body_frame(body).expect("a frame"));
    let mut geometry = model.geometry().clone();
    geometry.y_axes.fill(Some(Vector3::z()));
    geometry.positions[slide[1].expect("a node").0] += Vector3::new(0.0, 0.2, 0.0);
    model
        .set_geometry(geometry)
        .expect("a geometry of this model");
    let now = [beam, carriage].map(|body| model.body_frame(body).expect("a frame"));
    assert_eq!(now, home);
}

#[test]
fn what_cannot_be_is_refused() {
    let light = Material::new(YOUNG, Elasticity::Poisson(0.3), None).expect("a material");
    let mut model = Model::new("light");
    let points = [("A", Point3::origin()), ("B", Point3::new(1.0, 0.0, 0.0))];
    model
        .add_beam("beam", &points, &light, &flat(), None, 1)
        .expect("a body");
    let refused = model.set_gravity(Vector3::z());
    assert!(matches!(refused, Err(ModelError::NoDensity { body }) if body == "beam"));
    assert!(model.set_gravity(Vector3::zeros()).is_ok());
    let body = model.body("beam").expect("the body");
    let refused = model.set_temperature(body, 1.0);
    assert!(matches!(refused, Err(ModelError::NoExpansion { .. })));
    // Two points and no axis: nobody knows how it is turned about their line.
    assert!(model.body_frame(body).is_none());
    clamp(&mut model, "A");
    model.set_output(node(&model, "B"));
    let load = Load {
        node: node(&model, "B"),
        wrench: along(1, 1.0),
        axes: Axes::Body {
            body,
            home: Rotation3::identity(),
        },
    };
    let set = LoadSet {
        nodes: vec![load],
        lines: Vec::new(),
    };
    model.set_loads(set).expect("loads");
    assert!(matches!(solve(&model), Err(SolveError::NoBodyFrame(error)) if error.body == "beam"));
    let case = |name: &str| LoadCase {
        name: name.into(),
        loads: LoadSet::default(),
    };
    model.add_case(case("cut")).expect("a case");
    assert!(matches!(
        model.add_case(case("cut")),
        Err(ModelError::RepeatedName { .. })
    ));
}

#[test]
fn a_weight_on_a_free_motion_is_refused_at_its_body() {
    let mut model = beam(["A", "M", "B"]);
    let connection = Connection {
        name: "hinge".into(),
        between: [None, Some(node(&model, "A"))],
        joint: Box::new(Revolute),
        locked: DofSet::EMPTY,
        stiffness: JointStiffness::default(),
    };
    let id = model.add_joint(connection, Rotation3::identity());
    assert_eq!(id.expect("a joint"), JointId(0));
    model
        .set_gravity(Vector3::new(0.0, 0.0, -9.81))
        .expect("gravity");
    let expected = model.body("beam").expect("the body");
    match solve(&model) {
        Err(SolveError::LoadOnFreeMotion {
            body, load: None, ..
        }) => assert_eq!(body, expected),
        other => panic!("{other:?}"),
    }
}

/// A beam that comes after gravity is not weightless in silence.
#[test]
fn a_beam_without_density_has_no_weight_and_is_refused() {
    let mut model = beam(["A", "M", "B"]);
    clamp(&mut model, "A");
    let gravity = Vector3::new(0.0, 0.0, -9.81);
    model.set_gravity(gravity).expect("gravity");
    let light = Material::new(YOUNG, Elasticity::Poisson(0.3), None).expect("a material");
    let shape = SectionShape::Circle { diameter: 0.02 };
    let section = Section::new(shape, None, None).expect("a section");
    let points = [("C", Point3::origin()), ("D", Point3::new(0.0, 1.0, 0.0))];
    let added = model.add_beam("late", &points, &light, &section, None, 1);
    added.expect("a beam");
    let foot = model.node("late", "C");
    joint(&mut model, "late", [None, foot], JointStiffness::default());
    let error = solve(&model).expect_err("no density");
    assert_eq!(
        error.to_string(),
        "the material of body `late` has no density, which its weight and natural frequencies need"
    );
}
