//! The lanes against the one-by-one path, wherever their estimate lets them answer, on random
//! mechanisms: a platform on limbs of beams, with joints of every kind, elastic, locked or free.

use hyperstat_elements::{Elasticity, Material, RigidMass, Section, SectionShape};
use hyperstat_joints::{
    Cylindrical, Dof, DofSet, Fixed, Joint, Planar, Prismatic, Revolute, Screw, Spherical,
    Universal, frame_from_axes, frame_from_axis,
};
use hyperstat_model::{
    Axes, BodyId, Connection, Directions, Geometry, JointId, JointStiffness, LANES, LineLoad, Load,
    LoadCase, LoadSet, Member, Model, NodeId, SegmentId, Tapering, characteristic_length,
};
use nalgebra::{DMatrix, Matrix6, Point3, Rotation3, Vector3, Vector6};

use super::pass::{ERROR, displacement, displacement_error};
use crate::answer::forces::Forces;
use crate::answer::pose_result::PoseResult;
use crate::lanes::{Beside, Lanes};
use crate::plan::Plan;
use crate::prepared::Prepared;

/// Mechanisms.
const CASES: usize = 300;
/// Lanes against one by one: relative to √(K_ii K_jj); of a displacement with its components times
/// √K_ii, so that translations and rotations can be compared, to the largest one.
const AGREEMENT: f64 = 1e-11;
/// Forces of the lanes against those of the numeric pass: over the largest of their state.
const FORCES_AGREE: f64 = 1e-10;

/// Random numbers, the same in every run (xorshift64).
struct Random(u64);

impl Random {
    /// Between 0 and 1.
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    fn vector(&mut self, size: f64) -> Vector3<f64> {
        [0; 3].map(|_| self.between(-size, size)).into()
    }

    fn turn(&mut self, size: f64) -> Rotation3<f64> {
        let [x, y, z] = self.vector(size).into();
        Rotation3::from_euler_angles(x, y, z)
    }

    fn section(&mut self, round: bool) -> Section {
        let size = self.between(0.01, 0.05);
        let shape = if round {
            SectionShape::Circle { diameter: size }
        } else {
            let height = size * self.between(0.5, 2.0);
            SectionShape::Rectangle {
                width: size,
                height,
            }
        };
        Section::new(shape, None, None).expect("a section")
    }

    fn joint(&mut self) -> (Box<dyn Joint>, DofSet, JointStiffness) {
        let joint: Box<dyn Joint> = match self.below(12) {
            0 => Box::new(Revolute),
            1 => Box::new(Prismatic),
            2 => Box::new(Cylindrical),
            3 | 4 => Box::new(Universal),
            5 | 6 => Box::new(Spherical),
            7 => Box::new(Screw::new(self.between(-0.05, 0.05)).expect("a pitch")),
            8 => Box::new(Planar),
            _ => Box::new(Fixed),
        };
        let locked = if self.unit() < 0.6 {
            joint.free()
        } else {
            DofSet::EMPTY
        };
        if self.unit() < 0.15 {
            // A bushing with all directions coupled.
            let size = Vector6::new(1e4, 1e4, 1e4, 1e2, 1e2, 1e2);
            let rows = Matrix6::from_fn(|i, _| size[i] * self.between(-1.0, 1.0));
            let matrix = rows * rows.transpose() + Matrix6::from_diagonal(&size.map(|s| s * s));
            return (joint, locked, JointStiffness::Matrix(matrix));
        }
        let mut stiffness = [None; 6];
        if self.unit() < 0.5 {
            for (d, stiffness) in stiffness.iter_mut().enumerate() {
                let least = if d < 3 { 6.0 } else { 2.5 };
                if self.unit() < 0.7 {
                    *stiffness = Some(10.0_f64.powf(self.between(least, least + 3.0)));
                }
            }
        }
        (joint, locked, JointStiffness::Directions(stiffness))
    }
}

/// Adds a joint between two nodes at one point, or a node and the ground.
fn join(model: &mut Model, random: &mut Random, between: [&str; 2], point: &str) -> Option<()> {
    let (joint, locked, stiffness) = random.joint();
    let frame = frame_from_axes(&random.vector(1.0), &random.vector(1.0)).ok()?;
    let connection = Connection {
        name: format!("j{}", model.joints().len()),
        between: between.map(|body| model.node(body, point)),
        joint,
        locked,
        stiffness,
    };
    model.add_joint(connection, frame).ok()?;
    Some(())
}

/// A platform on two to four limbs of up to three beams each; points are numbered.
fn mechanism(random: &mut Random) -> Option<Model> {
    let mut model = Model::new("random");
    let steel = Material::new(2e11, Elasticity::Poisson(0.3), Some(7.8e3)).ok()?;
    let steel = steel.with_expansion(1.2e-5).ok()?;
    let limbs = 2 + random.below(3);
    let names: Vec<String> = (0..40).map(|k| format!("p{k}")).collect();
    let above = Point3::new(0.0, 0.0, 0.8);
    let tops: Vec<_> = (0..limbs)
        .map(|k| (names[k].as_str(), above + random.vector(0.3)))
        .collect();
    model.add_rigid("platform", &tops).ok()?;
    let mut next = limbs;
    for limb in 0..limbs {
        let (mut before, mut at) = ("platform".to_string(), tops[limb]);
        let bodies = 1 + random.below(3);
        for body in 0..bodies {
            let name = format!("b{limb}-{body}");
            let mut points = vec![at];
            for _ in 0..1 + random.below(2) {
                let step = random.vector(0.3) - Vector3::z() * 0.2;
                let (_, from) = points[points.len() - 1];
                points.push((names[next].as_str(), from + step));
                next += 1;
            }
            if points.windows(2).any(|w| (w[1].1 - w[0].1).norm() < 0.1) {
                return None;
            }
            let round = random.unit() < 0.5;
            let members: Vec<_> = (1..points.len())
                .map(|k| Member {
                    ends: if random.unit() < 0.5 {
                        [k - 1, k]
                    } else {
                        [k, k - 1]
                    },
                    material: steel.clone(),
                    section: random.section(round),
                    taper: (random.unit() < 0.3).then(|| Tapering::whole(random.section(round))),
                    y_axis: None,
                    elements: 1,
                })
                .collect();
            model.add_elastic(&name, &points, &members).ok()?;
            join(&mut model, random, [&before, &name], at.0)?;
            (before, at) = (name, points[points.len() - 1]);
        }
        join(&mut model, random, [&before, "ground"], at.0)?;
    }
    let nodes = model.nodes().len();
    model.set_output(NodeId(0));
    for _ in 0..1 + random.below(2) {
        let (force, moment) = (random.vector(100.0), random.vector(10.0));
        let node = NodeId(random.below(nodes));
        let wrench = Vector6::from_fn(|k, _| if k < 3 { force[k] } else { moment[k - 3] });
        model.add_load(node, wrench).ok()?;
    }
    Some(model)
}

/// Another configuration: every other one turned as a whole, the others with all points and joint
/// frames moved, a little or much. What is joined stays joined.
fn pose(model: &Model, random: &mut Random, k: usize) -> Geometry {
    let mut geometry = model.geometry().clone();
    if k.is_multiple_of(2) {
        let (turn, step) = (random.turn(3.0), random.vector(1.0));
        for point in &mut geometry.positions {
            *point = turn * *point + step;
        }
        for frame in &mut geometry.frames {
            *frame = turn * *frame;
        }
        return geometry;
    }
    let size = if k % 4 == 1 { 0.03 } else { 1e-3 };
    let steps: Vec<_> = (0..40).map(|_| random.vector(size)).collect();
    for (node, point) in model.nodes().iter().zip(&mut geometry.positions) {
        let number: usize = node.point[1..].parse().expect("a number");
        *point += steps[number];
    }
    for frame in &mut geometry.frames {
        *frame = random.turn(3.0 * size) * *frame;
    }
    geometry
}

/// The error of a pose's stiffness and displacement.
fn errors(stiffness: &Matrix6<f64>, displacement: &Vector6<f64>, one: &PoseResult) -> [f64; 2] {
    let (Some(k), Some(u)) = (one.stiffness, one.displacement) else {
        return [f64::INFINITY; 2];
    };
    let scale = Matrix6::from_fn(|i, j| (k[(i, i)] * k[(j, j)]).sqrt());
    let stiffness = (stiffness - k).component_div(&scale).amax();
    let weights = k.diagonal().map(f64::sqrt);
    let weighed = |u: Vector6<f64>| u.component_mul(&weights).amax();
    let (size, error) = (weighed(u), weighed(displacement - u));
    [stiffness, if size > 0.0 { error / size } else { error }]
}

/// The lanes' estimates of these errors.
fn estimates(lanes: &Lanes, lane: usize) -> [f64; 2] {
    let engine = lanes.engine.as_ref().expect("lanes");
    let at = |k: usize| engine.buffers.result(k, lane);
    assert!(at(displacement(0)).is_finite());
    [at(ERROR), at(displacement_error(0))]
}

#[test]
fn wherever_the_lanes_answer_random_mechanisms_agree() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let (mut taken, mut poses, mut handed_on, mut wrong) = (0, 0, 0, Vec::new());
    let (mut largest, mut most) = ([0.0_f64; 2], [0.0_f64; 2]);
    for case in 0..CASES {
        let Some(model) = mechanism(&mut random) else {
            continue;
        };
        let Ok(plan) = Plan::new(&model) else {
            continue;
        };
        let (mut lanes, mut workspace) = (plan.lanes(&model, Beside::Nothing), plan.workspace());
        let Some(engine) = &lanes.engine else {
            continue;
        };
        // As many as go through the lanes together: their estimates stand until the next ones.
        let width = engine.buffers.width;
        taken += 1;
        for first in (0..LANES).step_by(width) {
            let chosen: Vec<_> = (first..first + width)
                .map(|k| pose(&model, &mut random, k))
                .collect();
            for (lane, pose) in chosen.iter().enumerate() {
                lanes.geometry_mut(lane).clone_from(pose);
            }
            let filled = std::array::from_fn(|lane| lane < width);
            let results = plan.sweep_lanes(&model, &mut lanes, filled);
            for (lane, pose) in chosen.iter().enumerate() {
                poses += 1;
                let engine = lanes.engine.as_ref().expect("lanes");
                if engine.result(lane).is_none() {
                    handed_on += 1;
                    continue;
                }
                let Some(Ok(found)) = &results[lane] else {
                    panic!("{case}: {:?}", results[lane]);
                };
                let one = plan.sweep(&model, pose, &mut workspace);
                let (Ok(one), Some(k), Some(u)) = (one, found.stiffness, found.displacement) else {
                    wrong.push(format!("{case}, {lane}: no result one by one"));
                    continue;
                };
                let errors = errors(&k, &u, &one);
                let estimates = estimates(&lanes, lane);
                for (c, (error, estimate)) in errors.into_iter().zip(estimates).enumerate() {
                    largest[c] = largest[c].max(error);
                    most[c] = most[c].max(error / estimate.max(f64::EPSILON));
                    if error.is_nan() || error > AGREEMENT {
                        wrong.push(format!(
                            "{case}, {lane}: {c} {error:e}, estimated {estimate:e}"
                        ));
                    }
                }
            }
        }
    }
    println!(
        "{taken} mechanisms, {poses} poses, {handed_on} handed on, errors {most:?} of estimates"
    );
    assert!(wrong.is_empty(), "{}\n{}", wrong.len(), wrong.join("\n"));
    assert!(taken > CASES / 3, "only {taken} mechanisms");
    // Poses that are handed on prove nothing.
    let answered = poses - handed_on;
    assert!(
        answered > CASES,
        "only {answered} of {poses} poses answered"
    );
}

/// Six numbers of either sign, of these sizes.
fn six(random: &mut Random, linear: f64, angular: f64) -> Vector6<f64> {
    let (a, b) = (random.vector(linear), random.vector(angular));
    Vector6::from_fn(|k, _| if k < 3 { a[k] } else { b[k - 3] })
}

/// Axes of a load: global ones, or some body's.
fn axes(random: &mut Random, model: &Model) -> Axes {
    let body = BodyId(random.below(model.bodies().len()));
    match model.body_frame(body) {
        Some(_) if random.unit() < 0.5 => Axes::Body {
            body,
            home: random.turn(2.0),
        },
        _ => Axes::Global,
    }
}

fn loads(random: &mut Random, model: &Model) -> LoadSet {
    let mut set = LoadSet::default();
    for _ in 0..random.below(3) {
        set.nodes.push(Load {
            node: NodeId(random.below(model.nodes().len())),
            wrench: six(random, 100.0, 10.0),
            axes: axes(random, model),
        });
    }
    for _ in 0..random.below(3) {
        set.lines.push(LineLoad {
            segment: SegmentId(random.below(model.segments().len())),
            ends: [six(random, 200.0, 20.0), six(random, 200.0, 20.0)],
            axes: axes(random, model),
        });
    }
    set
}

/// A body of finite elements between some points, by a random stiffness.
fn flexible(random: &mut Random, points: &[Point3<f64>]) -> DMatrix<f64> {
    let rows = 6 * (points.len() - 1);
    let own = |k: usize| if k % 6 < 3 { 1e3 } else { 1e2 };
    let half = DMatrix::from_fn(rows, rows, |i, j| {
        let diagonal = if i == j { 2.0 } else { 0.0 };
        own(i) * (diagonal + random.between(-0.3, 0.3))
    });
    let held = &half * half.transpose();
    let mut deformation = DMatrix::zeros(rows, rows + 6);
    for (k, point) in points[1..].iter().enumerate() {
        let arm = point - points[0];
        let carry = hyperstat_elements::transport(&arm);
        deformation.view_mut((6 * k, 0), (6, 6)).copy_from(&-carry);
        deformation
            .view_mut((6 * k, 6 * k + 6), (6, 6))
            .fill_diagonal(1.0);
    }
    deformation.transpose() * held * deformation
}

/// A four-bar of rigid bodies on the ground, whose coupler a beam joins to the platform.
fn add_four_bar(model: &mut Model, random: &mut Random, steel: &Material) -> Option<()> {
    let axis = random.vector(1.0).try_normalize(0.1)?;
    let x = axis.cross(&random.vector(1.0)).try_normalize(0.1)?;
    let y = axis.cross(&x);
    let a = Point3::new(0.0, 0.0, -0.3) + random.vector(0.2);
    let b = a + x * random.between(-0.1, 0.2) + y * 0.25;
    let (c, d) = (a + x * 0.3, b + x * random.between(0.2, 0.4));
    let e = b + random.vector(0.3);
    let top = Point3::from(model.geometry().positions[0].coords);
    model.add_rigid("crank", &[("p30", a), ("p31", b)]).ok()?;
    model.add_rigid("rocker", &[("p32", c), ("p33", d)]).ok()?;
    let points = [("p31", b), ("p33", d), ("p34", e)];
    model.add_rigid("coupler", &points).ok()?;
    if (top - e).norm() < 0.1 {
        return None;
    }
    let section = random.section(true);
    let points = [("p34", e), ("p0", top)];
    model
        .add_beam("link", &points, steel, &section, None, 1)
        .ok()?;
    let frame = frame_from_axis(Some(&axis), None).ok()?;
    let pairs = [
        ([None, Some("crank")], "p30"),
        ([Some("crank"), Some("coupler")], "p31"),
        ([None, Some("rocker")], "p32"),
        ([Some("rocker"), Some("coupler")], "p33"),
    ];
    for (k, (between, point)) in pairs.into_iter().enumerate() {
        let mut stiffness = [None; 6];
        if k == 0 && random.unit() < 0.5 {
            stiffness[Dof::W.index()] = Some(1e3);
        }
        let connection = Connection {
            name: format!("hinge {k}"),
            between: between.map(|body| model.node(body?, point)),
            joint: Box::new(Revolute),
            locked: DofSet::EMPTY,
            stiffness: JointStiffness::Directions(stiffness),
        };
        model.add_joint(connection, frame).ok()?;
    }
    join(model, random, ["coupler", "link"], "p34")?;
    join(model, random, ["link", "platform"], "p0")
}

/// A random mechanism with all that can act on it.
fn acted_on(random: &mut Random) -> Option<Model> {
    let mut model = mechanism(random)?;
    if random.unit() < 0.3 {
        let steel = Material::new(2e11, Elasticity::Poisson(0.3), Some(7.8e3)).ok()?;
        add_four_bar(&mut model, random, &steel.with_expansion(1.2e-5).ok()?)?;
    }
    if random.unit() < 0.3 {
        // Two feet of a body of finite elements, between the ground and the platform.
        let points = [0.0, 0.4].map(|x| Point3::new(x, 0.0, 0.5) + random.vector(0.2));
        let points: Vec<_> = [("q0", Point3::from(model.geometry().positions[0].coords))]
            .into_iter()
            .chain(["q1", "q2"].into_iter().zip(points))
            .collect();
        let places: Vec<_> = points.iter().map(|(_, at)| *at).collect();
        let stiffness = flexible(random, &places);
        model.add_flexible("flexible", &points, &stiffness).ok()?;
        let between = [Some(NodeId(0)), model.node("flexible", "q0")];
        let ends = [
            [model.node("flexible", "q1"), None],
            [None, model.node("flexible", "q2")],
        ];
        for between in std::iter::once(between).chain(ends) {
            let (joint, locked, stiffness) = random.joint();
            let frame = frame_from_axes(&random.vector(1.0), &random.vector(1.0)).ok()?;
            let name = format!("j{}", model.joints().len());
            let connection = Connection {
                name,
                between,
                joint,
                locked,
                stiffness,
            };
            model.add_joint(connection, frame).ok()?;
        }
    }
    if random.unit() < 0.5 {
        model.set_gravity(random.vector(10.0)).ok()?;
        let mass = RigidMass::point(random.between(0.1, 3.0)).ok()?;
        model.add_mass(NodeId(random.below(model.nodes().len())), mass);
    }
    for body in 0..model.bodies().len() {
        if random.unit() < 0.2 {
            let change = random.between(-30.0, 30.0);
            // Only bodies of beams have one.
            let _ = model.set_temperature(BodyId(body), change);
        }
    }
    if random.unit() < 0.7 {
        for joint in 0..model.joints().len() {
            let directions = Directions::of(&model.joints()[joint]);
            let mut misfit = six(random, 1e-4, 1e-3);
            let mut preload = six(random, 100.0, 10.0);
            for k in 0..6 {
                let own = Dof::ALL[k];
                if directions.free.contains(own) {
                    misfit[k] = 0.0;
                }
                if directions.rigid.contains(own) || random.unit() < 0.5 {
                    preload[k] = 0.0;
                }
            }
            if random.unit() < 0.4 {
                model.set_misfit(JointId(joint), &misfit).ok()?;
            }
            if random.unit() < 0.3 {
                model.set_preload(JointId(joint), &preload).ok()?;
            }
        }
    }
    if random.unit() < 0.5 {
        let set = loads(random, &model);
        model.set_loads(set).ok()?;
    }
    for case in 0..random.below(4) {
        let name = format!("case {case}");
        let loads = loads(random, &model);
        model.add_case(LoadCase { name, loads }).ok()?;
    }
    Some(model)
}

/// What forces differ by, over the largest of their state, moments over the mechanism's size.
fn apart(found: &[Forces], expected: &[Forces], model: &Model, geometry: &Geometry) -> f64 {
    let size = characteristic_length(geometry);
    let over_size =
        |w: &Vector6<f64>| Vector6::from_fn(|k, _| if k < 3 { w[k] } else { w[k] / size });
    let all = |forces: &Forces| -> Vec<Vector6<f64>> {
        let ends = forces.segments.iter().flat_map(|s| &s.ends);
        let joints = forces.joint_wrenches.iter().flatten();
        ends.chain(joints).map(over_size).collect()
    };
    assert_eq!(found.len(), expected.len());
    let mut most = 0.0_f64;
    for (found, expected) in found.iter().zip(expected) {
        let known = |w: &Option<Vector6<f64>>| w.is_some();
        assert!(expected.joint_wrenches.iter().all(known), "{}", model.name);
        for (found, expected) in found.segments.iter().zip(&expected.segments) {
            assert_eq!(found.load, expected.load);
            let turned = found.frame.matrix() - expected.frame.matrix();
            assert!(turned.amax() < 1e-15, "{turned}");
        }
        let (found, expected) = (all(found), all(expected));
        assert_eq!(found.len(), expected.len());
        let largest = expected.iter().fold(0.0_f64, |most, w| most.max(w.amax()));
        let differences = found.iter().zip(&expected).map(|(a, b)| (a - b).amax());
        let error = differences.fold(0.0_f64, f64::max);
        most = most.max(if largest > 0.0 {
            error / largest
        } else {
            error
        });
    }
    most
}

#[test]
fn wherever_the_lanes_answer_all_that_acts_agrees() {
    let cases = std::env::var("HYPERSTAT_RANDOM").ok();
    let cases = cases.and_then(|count| count.parse().ok()).unwrap_or(CASES);
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    let (mut taken, mut poses, mut handed_on, mut states) = (0, 0, 0, 0);
    let (mut largest, mut wrong) = (0.0_f64, Vec::new());
    let (mut recovered, mut largest_force) = (0, 0.0_f64);
    for case in 0..cases {
        let Some(model) = acted_on(&mut random) else {
            continue;
        };
        let Ok(plan) = Plan::new(&model) else {
            continue;
        };
        let (mut lanes, mut workspace) = (plan.lanes(&model, Beside::Forces), plan.workspace());
        let prepared = Prepared::new(model.clone());
        if lanes.engine.is_none() {
            continue;
        }
        taken += 1;
        let chosen: Vec<_> = (0..LANES).map(|k| pose(&model, &mut random, k)).collect();
        for (lane, pose) in chosen.iter().enumerate() {
            lanes.geometry_mut(lane).clone_from(pose);
        }
        let before = lanes.one_by_one();
        let results = plan.sweep_lanes(&model, &mut lanes, [true; LANES]);
        poses += LANES;
        handed_on += (lanes.one_by_one() - before) as usize;
        for (lane, pose) in chosen.iter().enumerate() {
            if let Some(found) = lanes.beyond[lane].take().map(|own| own.forces) {
                let one = match plan.forces(&model, pose, &mut workspace) {
                    Ok(None) => prepared.at(pose).and_then(|here| here.forces()).map(Some),
                    one => one,
                };
                let error = match one {
                    Ok(Some(one)) => apart(&found, &one, &model, pose),
                    _ => f64::NAN,
                };
                recovered += 1;
                largest_force = largest_force.max(error);
                if error.is_nan() || error > FORCES_AGREE {
                    wrong.push(format!("{case}, {lane}: forces {error:e}"));
                }
            }
            let one = plan.sweep(&model, pose, &mut workspace);
            match (&results[lane], &one) {
                (Some(Ok(found)), Ok(one)) => {
                    let (Some(k), Some(u)) = (found.stiffness, found.displacement) else {
                        continue;
                    };
                    let both = std::iter::once((u, one.displacement));
                    let others = found
                        .cases
                        .iter()
                        .copied()
                        .zip(one.cases.iter().copied().map(Some));
                    assert_eq!(found.cases.len(), model.cases().len());
                    for (state, (u, expected)) in both.chain(others).enumerate() {
                        let own = PoseResult {
                            displacement: expected,
                            ..one.clone()
                        };
                        let [_, error] = errors(&k, &u, &own);
                        states += 1;
                        largest = largest.max(error);
                        if error.is_nan() || error > AGREEMENT {
                            wrong.push(format!("{case}, {lane}, state {state}: {error:e}"));
                        }
                    }
                }
                (Some(Err(_)), Err(_)) => {}
                (_, Err(error)) => wrong.push(format!("{case}, {lane}: no result: {error}")),
                _ => wrong.push(format!("{case}, {lane}: a result only one by one")),
            }
        }
    }
    println!(
        "{taken} mechanisms, {poses} poses, {states} states, {handed_on} handed on, error {largest:e}; \
         forces of {recovered} poses, error {largest_force:e}"
    );
    assert!(wrong.is_empty(), "{}\n{}", wrong.len(), wrong.join("\n"));
    assert!(taken > cases / 3, "only {taken} mechanisms");
    assert!(poses > 2 * handed_on, "{handed_on} of {poses} handed on");
    // Two thirds have no flexible bodies, loops of rigid bodies or singular stiffnesses.
    assert!(
        3 * recovered > poses - handed_on,
        "forces of {recovered} poses"
    );
}
