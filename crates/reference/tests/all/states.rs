//! Weight, loads along beams, temperature and cases against closed forms of the strength of
//! materials.

use std::f64::consts::PI;

use hyperstat_elements::{Elasticity, Material, RigidMass, Section, SectionShape};
use hyperstat_joints::{Fixed, Spherical};
use hyperstat_model::{Axes, LineLoad, Load, LoadCase, LoadSet, Model, SegmentId};
use hyperstat_reference::{ReferenceError, ReferenceSolution, solve};
use nalgebra::{Rotation3, Vector3, Vector6};

use crate::common::{JointSpec, assert_close, circle, node, point};

const YOUNG: f64 = 2.1e11;
const SHEAR: f64 = 2.1e11 / 2.6;
const DENSITY: f64 = 7850.0;
const EXPANSION: f64 = 1.2e-5;
const LENGTH: f64 = 0.7;
const GRAVITY: f64 = 9.81;
/// Rounding of some hundred operations.
const ROUNDING: f64 = 1e-12;

fn steel() -> Material {
    Material::new(YOUNG, Elasticity::Poisson(0.3), Some(DENSITY))
        .and_then(|steel| steel.with_expansion(EXPANSION))
        .unwrap()
}

/// A beam along x, from one section to another, with a weld to the ground at each of `held`.
fn beam(sections: [&Section; 2], elements: usize, held: &[&'static str]) -> Model {
    let mut model = Model::new("beam");
    let points = [("A", point(0.0, 0.0, 0.0)), ("B", point(LENGTH, 0.0, 0.0))];
    let [section, taper] = sections;
    let member = hyperstat_model::Member {
        ends: [0, 1],
        material: steel(),
        section: section.clone(),
        taper: (section != taper).then(|| hyperstat_model::Tapering::whole(taper.clone())),
        y_axis: None,
        elements,
    };
    model.add_elastic("beam", &points, &[member]).unwrap();
    for at in held {
        JointSpec::new(at, at, ["ground", "beam"], Fixed).add(&mut model);
    }
    model.set_output(node(&model, "beam", "B"));
    model
}

fn line(ends: [Vector6<f64>; 2]) -> LoadSet {
    LoadSet {
        nodes: Vec::new(),
        lines: vec![LineLoad {
            segment: SegmentId(0),
            ends,
            axes: Axes::Global,
        }],
    }
}

fn sideways(z: f64) -> Vector6<f64> {
    Vector6::new(0.0, 0.0, z, 0.0, 0.0, 0.0)
}

fn wrench(solution: &ReferenceSolution, joint: usize) -> Vector6<f64> {
    solution.joint_wrenches[joint].unwrap()
}

/// Euler–Bernoulli, clamped at both ends: q L/2 and q L²/12 of a uniform load; 3 q L/20, q L²/30
/// and 7 q L/20, q L²/20 of one that grows from nothing to q (Roark, table 8.1).
#[test]
fn fixed_end_forces() {
    let rod = circle(0.02);
    let q = -300.0;
    let uniform = (q * LENGTH / 2.0, q * LENGTH * LENGTH / 12.0);
    let near = (3.0 * q * LENGTH / 20.0, q * LENGTH * LENGTH / 30.0);
    let far = (7.0 * q * LENGTH / 20.0, q * LENGTH * LENGTH / 20.0);
    for elements in [1, 3] {
        for (ends, [first, second]) in [([q, q], [uniform; 2]), ([0.0, q], [near, far])] {
            let mut model = beam([&rod, &rod], elements, &["A", "B"]);
            model.set_loads(line(ends.map(sideways))).unwrap();
            let solution = solve(&model).unwrap();
            // A load along −z turns the beam at its first end about +y; the walls hold against it.
            let expected = Vector6::new(0.0, 0.0, -first.0, 0.0, first.1, 0.0);
            assert_close(&wrench(&solution, 0), &expected, ROUNDING);
            let expected = Vector6::new(0.0, 0.0, -second.0, 0.0, -second.1, 0.0);
            assert_close(&wrench(&solution, 1), &expected, ROUNDING);
        }
    }
}

/// Moments per length: τ L²/2GJ at the free end under a twisting one; m L³/3EI and m L²/2EI under
/// one that bends.
#[test]
fn moments_along_a_cantilever() {
    let rod = circle(0.02);
    let i = PI * 0.02_f64.powi(4) / 64.0;
    let (twisting, bending) = (3.0, 5.0);
    let along = Vector6::new(0.0, 0.0, 0.0, twisting, 0.0, bending);
    let mut model = beam([&rod, &rod], 2, &["A"]);
    model.set_loads(line([along; 2])).unwrap();
    let expected = Vector6::new(
        0.0,
        bending * LENGTH.powi(3) / (3.0 * YOUNG * i),
        0.0,
        twisting * LENGTH * LENGTH / (2.0 * SHEAR * 2.0 * i),
        0.0,
        bending * LENGTH * LENGTH / (2.0 * YOUNG * i),
    );
    assert_close(
        &solve(&model).unwrap().displacement.unwrap(),
        &expected,
        ROUNDING,
    );
}

/// w L⁴/8EI + w L²/2κGA and w L³/6EI.
#[test]
fn a_cantilever_with_shear_sags_under_its_weight() {
    let (width, height, shear_area) = (0.02, 0.03, 4e-4);
    let shape = SectionShape::Rectangle { width, height };
    let flat = Section::new(shape, None, Some(shear_area)).unwrap();
    let weight = DENSITY * width * height * GRAVITY;
    let stiffness = YOUNG * width * height.powi(3) / 12.0;
    for elements in [1, 4] {
        let mut model = beam([&flat, &flat], elements, &["A"]);
        model.set_gravity(Vector3::new(0.0, 0.0, -GRAVITY)).unwrap();
        let solution = solve(&model).unwrap();
        let sag = weight * LENGTH.powi(4) / (8.0 * stiffness)
            + weight * LENGTH.powi(2) / (2.0 * SHEAR * shear_area);
        let turn = weight * LENGTH.powi(3) / (6.0 * stiffness);
        let expected = Vector6::new(0.0, 0.0, -sag, 0.0, turn, 0.0);
        assert_close(&solution.displacement.unwrap(), &expected, ROUNDING);
        let carried = weight * LENGTH;
        let expected = Vector6::new(0.0, 0.0, carried, 0.0, -carried * LENGTH / 2.0, 0.0);
        assert_close(&wrench(&solution, 0), &expected, ROUNDING);
    }
}

/// The frustum of a cone, clamped at one end and standing out or hanging down. With y from its
/// apex, area c y² and second moment k y⁴, by hand: N(y) = ρ g c (y³ − b³)/3 and
/// M(y) = ρ g c (y⁴/12 − y b³/3 + b⁴/4), b at the free end.
#[test]
fn a_cone_under_its_weight() {
    let (thick, thin) = (0.05, 0.02);
    let slope = (thick - thin) / LENGTH;
    let (a, b) = (thick / slope, thin / slope);
    let (c, k) = (PI / 4.0 * slope.powi(2), PI / 64.0 * slope.powi(4));
    let heavy = DENSITY * GRAVITY;
    let stretch = heavy / (3.0 * YOUNG) * ((a * a - b * b) / 2.0 + b.powi(3) * (1.0 / a - 1.0 / b));
    let integral = |y: f64| {
        (y - b).powi(2) / 24.0 - b.powi(3) / 3.0 * (b / (2.0 * y * y) - 1.0 / y)
            + b.powi(4) / 4.0 * (b / (3.0 * y.powi(3)) - 1.0 / (2.0 * y * y))
    };
    let sag = heavy * c / (YOUNG * k) * (integral(a) - integral(b));
    let weight = heavy * c * (a.powi(3) - b.powi(3)) / 3.0;
    for elements in [1, 3] {
        let mut model = beam([&circle(thick), &circle(thin)], elements, &["A"]);
        model.set_gravity(Vector3::new(0.0, 0.0, -GRAVITY)).unwrap();
        let solution = solve(&model).unwrap();
        let found = solution.displacement.unwrap();
        assert!((found.z / -sag - 1.0).abs() < ROUNDING, "{} {sag}", found.z);
        assert!((wrench(&solution, 0).z / weight - 1.0).abs() < ROUNDING);
        model.set_gravity(Vector3::new(GRAVITY, 0.0, 0.0)).unwrap();
        let found = solve(&model).unwrap().displacement.unwrap();
        assert!(
            (found.x / stretch - 1.0).abs() < ROUNDING,
            "{} {stretch}",
            found.x
        );
    }
}

/// E A α ΔT between walls, and of a cone with A the product of its end diameters times π/4;
/// α ΔT L where nothing holds.
#[test]
fn heat() {
    let change = 30.0;
    let (thick, thin) = (0.05, 0.02);
    for (second, area) in [
        (thick, PI / 4.0 * thick * thick),
        (thin, PI / 4.0 * thick * thin),
    ] {
        let heated = |held: &[&'static str]| {
            let mut model = beam([&circle(thick), &circle(second)], 2, held);
            let body = model.body("beam").unwrap();
            model.set_temperature(body, change).unwrap();
            solve(&model).unwrap()
        };
        let push = Vector6::ith(0, YOUNG * area * EXPANSION * change);
        let solution = heated(&["A", "B"]);
        assert_close(&wrench(&solution, 0), &push, ROUNDING);
        assert_close(&wrench(&solution, 1), &-push, ROUNDING);
        let grown = Vector6::ith(0, EXPANSION * change * LENGTH);
        assert_close(&heated(&["A"]).displacement.unwrap(), &grown, ROUNDING);
    }
}

/// A load in axes that have turned by a quarter about x, their y the global z: F L³/3EI.
#[test]
fn a_load_turns_with_a_body() {
    let rod = circle(0.02);
    let stiffness = YOUNG * PI * 0.02_f64.powi(4) / 64.0;
    let mut model = beam([&rod, &rod], 1, &["A"]);
    let points = [
        ("B", point(LENGTH, 0.0, 0.0)),
        ("C", point(LENGTH, 0.1, 0.0)),
        ("D", point(LENGTH, 0.0, 0.1)),
    ];
    let plate = model.add_rigid("plate", &points).unwrap();
    JointSpec::new("weld", "B", ["beam", "plate"], Fixed).add(&mut model);
    let quarter = Rotation3::from_axis_angle(&Vector3::x_axis(), PI / 2.0);
    let along_y = |body, home| LoadSet {
        nodes: vec![Load {
            node: node(&model, "beam", "B"),
            wrench: Vector6::new(0.0, -70.0, 0.0, 0.0, 0.0, 0.0),
            axes: Axes::Body { body, home },
        }],
        lines: Vec::new(),
    };
    let now = model.body_frame(plate).unwrap();
    let turned = along_y(plate, quarter.inverse() * now);
    // Two points: nothing says how the beam is turned about their line.
    let unknown = along_y(model.body("beam").unwrap(), Rotation3::identity());
    model.set_loads(turned).unwrap();
    let found = solve(&model).unwrap().displacement.unwrap();
    let expected = -70.0 * LENGTH.powi(3) / (3.0 * stiffness);
    assert!((found.z / expected - 1.0).abs() < ROUNDING, "{found}");
    model.set_loads(unknown).unwrap();
    let error = solve(&model).unwrap_err();
    let body = "beam".into();
    assert_eq!(error, ReferenceError::NoBodyFrame { body });
}

/// A case is its loads with the weight, that of masses too, and the temperatures of the model,
/// without the model's own loads: F L³/3EI and w L⁴/8EI.
#[test]
fn cases_take_what_always_acts() {
    let rod = circle(0.02);
    let stiffness = YOUNG * PI * 0.02_f64.powi(4) / 64.0;
    let mut model = beam([&rod, &rod], 1, &["A"]);
    let (tip, body) = (node(&model, "beam", "B"), model.body("beam").unwrap());
    model
        .add_rigid("load", &[("B", point(LENGTH, 0.0, 0.0))])
        .unwrap();
    JointSpec::new("hook", "B", ["beam", "load"], Fixed).add(&mut model);
    let mass = RigidMass::point(2.0).unwrap();
    model.add_mass(node(&model, "load", "B"), mass);
    model.set_gravity(Vector3::new(0.0, 0.0, -GRAVITY)).unwrap();
    model.set_temperature(body, 10.0).unwrap();
    model.add_load(tip, sideways(-500.0)).unwrap();
    for (name, loads) in [
        ("rest", LoadSet::default()),
        ("push", LoadSet::on(tip, sideways(-90.0))),
    ] {
        let name = name.into();
        model.add_case(LoadCase { name, loads }).unwrap();
    }
    let deflection = |force: f64| force * LENGTH.powi(3) / (3.0 * stiffness);
    let solution = solve(&model).unwrap();
    let weight = DENSITY * PI / 4.0 * 0.02_f64.powi(2) * GRAVITY;
    let own = -weight * LENGTH.powi(4) / (8.0 * stiffness) + deflection(-2.0 * GRAVITY);
    let states = [(None, 500.0), (Some(0), 0.0), (Some(1), 90.0)];
    for (case, force) in states {
        let case = case.map(|k: usize| &solution.cases[k]);
        let displacement = case
            .map_or(solution.displacement, |c| c.displacement)
            .unwrap();
        let expected = own + deflection(-force);
        assert!(
            (displacement.z / expected - 1.0).abs() < ROUNDING,
            "{displacement}"
        );
        assert!((displacement.x / (EXPANSION * 10.0 * LENGTH) - 1.0).abs() < ROUNDING);
        let wrenches = case.map_or(&solution.joint_wrenches, |c| &c.joint_wrenches);
        let hook = wrenches[1].unwrap();
        assert!((hook.z / (2.0 * GRAVITY) - 1.0).abs() < ROUNDING, "{hook}");
    }
}

#[test]
fn weight_on_a_free_motion_and_a_beam_without_density_are_refused() {
    let rod = circle(0.02);
    let mut model = beam([&rod, &rod], 1, &[]);
    JointSpec::new("ball", "A", ["ground", "beam"], Spherical).add(&mut model);
    assert!(solve(&model).is_ok());
    model.set_gravity(Vector3::new(0.0, 0.0, -GRAVITY)).unwrap();
    let error = solve(&model).unwrap_err();
    assert_eq!(
        error,
        ReferenceError::Unrestrained {
            body: "beam".into()
        }
    );
    model.set_gravity(Vector3::zeros()).unwrap();
    let push = LoadSet::on(node(&model, "beam", "B"), sideways(1.0));
    let name = "push".into();
    model.add_case(LoadCase { name, loads: push }).unwrap();
    let error = solve(&model).unwrap_err();
    assert_eq!(
        error,
        ReferenceError::Unrestrained {
            body: "beam".into()
        }
    );

    let mut model = beam([&rod, &rod], 1, &["A"]);
    model.set_gravity(Vector3::z()).unwrap();
    let light = Material::new(YOUNG, Elasticity::Poisson(0.3), None).unwrap();
    let points = [("C", point(0.0, 1.0, 0.0)), ("D", point(0.0, 2.0, 0.0))];
    model
        .add_beam("late", &points, &light, &rod, None, 1)
        .unwrap();
    let error = solve(&model).unwrap_err();
    assert_eq!(
        error,
        ReferenceError::NoDensity {
            body: "late".into()
        }
    );
}
