//! Stiffnesses formed in the lanes against the scalar subassembly elements, pose by pose.

use hyperstat_elements::{
    Beam, Elasticity, Material, Section, SectionShape, rotate_matrix6, rotate_matrix12,
};
use hyperstat_joints::{DofSet, Fixed};
use nalgebra::{DMatrix, Matrix6, Point3, Rotation3, Vector3, Vector6};
use pulp::{Arch, Simd, WithSimd};

use super::blocks::place;
use super::buffers::Numbers;
use super::form::held;
use super::program::{Element, Program};
use crate::cluster::cluster_frame;
use crate::model::{Connection, Geometry, JointStiffness, Member, Model};
use crate::numeric::evaluate;
use crate::plan::{Plan, Source};

fn section(width: f64, height: f64, sheared: bool) -> Section {
    let area = sheared.then_some(width * height / 1.2);
    let shape = SectionShape::Rectangle { width, height };
    Section::new(shape, area, area).expect("a section")
}

/// A run of a prismatic segment and one that tapers towards its start, a tapered rod, and a body
/// given by its stiffness, with joints between them that differ in every direction.
fn mechanism() -> Model {
    let steel = Material::new(2.1e11, Elasticity::Poisson(0.3), None).expect("steel");
    let a = ("A", Point3::new(0.0, 0.0, 0.0));
    let b = ("B", Point3::new(0.3, 0.05, 0.1));
    let c = ("C", Point3::new(0.5, 0.2, 0.1));
    let d = ("D", Point3::new(0.2, 0.5, 0.4));
    let f = ("F", Point3::new(0.8, 0.1, -0.1));
    let member = |ends, from, taper, y_axis| Member {
        ends,
        material: steel.clone(),
        section: from,
        taper,
        y_axis,
        elements: 1,
    };
    let mut model = Model::new("formed");
    let arm = [
        member([0, 1], section(0.02, 0.03, true), None, None),
        member(
            [2, 1],
            section(0.02, 0.03, true),
            Some(section(0.03, 0.05, true)),
            Some(Vector3::new(0.1, 0.2, 1.0)),
        ),
    ];
    model.add_elastic("arm", &[a, b, c], &arm).expect("an arm");
    let taper = Some(section(0.01, 0.02, false));
    let rod = [member([0, 1], section(0.02, 0.01, false), taper, None)];
    model.add_elastic("rod", &[b, d], &rod).expect("a rod");
    // Nothing is absorbed into a rigid body.
    model.add_rigid("hub", &[b]).expect("a hub");
    model.add_rigid("platform", &[c]).expect("a platform");
    let span = f.1 - c.1;
    let frame = hyperstat_elements::element_frame(&span, None).expect("a frame");
    let beam = Beam::new(&steel, &section(0.03, 0.02, false), span.norm()).expect("a beam");
    let given = rotate_matrix12(&beam.stiffness(), &frame);
    let given = DMatrix::from_column_slice(12, 12, given.as_slice());
    model
        .add_flexible("given", &[c, f], &given)
        .expect("a body");
    let joints = [
        ("ground", "arm", "A"),
        ("hub", "arm", "B"),
        ("hub", "rod", "B"),
        ("arm", "platform", "C"),
        ("rod", "ground", "D"),
        ("platform", "given", "C"),
        ("given", "ground", "F"),
    ];
    for (k, (from, to, point)) in joints.into_iter().enumerate() {
        let scale = 1.0 + k as f64;
        let stiffness = [1e7, 4e6, 3e8, 2e3, 8e4, 1e5].map(|s| Some(s * scale));
        let connection = Connection {
            name: format!("joint-{k}"),
            between: [model.node(from, point), model.node(to, point)],
            joint: Box::new(Fixed),
            locked: DofSet::EMPTY,
            stiffness: JointStiffness::Directions(stiffness),
        };
        let frame = Rotation3::from_euler_angles(0.3 * scale, 0.2, -0.4 * scale);
        model.add_joint(connection, frame).expect("a joint");
    }
    model.set_output(model.node("platform", "C").expect("the platform"));
    model
}

/// Poses of it in which every element has another shape: the k-th is k steps away.
fn pose(model: &Model, k: usize) -> Geometry {
    let t = 0.1 * k as f64;
    let mut geometry = model.geometry().clone();
    let turn = Rotation3::from_euler_angles(0.3 * t, -0.5 * t, 0.7 * t);
    let from = model.geometry();
    for (node, position) in model.nodes().iter().zip(&mut geometry.positions) {
        let seed = f64::from(node.point.as_bytes()[0] - b'A');
        *position += Vector3::new(seed.sin(), seed.cos(), (2.0 * seed).sin()) * 0.3 * t;
    }
    // The body given by its stiffness turns as it is.
    let ends = ["C", "F"].map(|p| model.node("given", p).expect("a node").0);
    let arm = turn * (from.positions[ends[1]] - from.positions[ends[0]]);
    let f = geometry.positions[ends[0]] + arm;
    for (node, position) in model.nodes().iter().zip(&mut geometry.positions) {
        if node.point == "F" {
            *position = f;
        }
    }
    geometry.rotations[0] = turn;
    for (joint, frame) in geometry.frames.iter_mut().enumerate() {
        *frame = Rotation3::from_euler_angles(t, t * joint as f64, -0.5 * t) * *frame;
    }
    geometry
}

/// Blocks of all held elements of a program at some poses, one a lane.
struct FormAll<'a> {
    program: &'a Program,
    poses: &'a [Geometry],
}

impl WithSimd for FormAll<'_> {
    /// By elements and lanes.
    type Output = Vec<Vec<Vec<f64>>>;

    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let width = S::F64_LANES;
        let numbers = |n: usize| Numbers::from_iter(64, std::iter::repeat_n(0.0, n * width));
        let mut inputs = numbers(3 * self.program.inputs.len());
        for lane in 0..width {
            let pose = &self.poses[lane % self.poses.len()];
            self.program.inputs.read(pose, &mut inputs, width, lane);
        }
        let mut all = Vec::new();
        for element in self.program.elements.iter().filter_map(Element::held) {
            let nodes = element.points.len();
            let count = 36 * nodes * (nodes + 1) / 2;
            let mut blocks = numbers(count.max(108));
            let mut formed = numbers(count.max(108));
            let mut work = numbers(element.form.workspace(nodes - 1));
            held(
                simd,
                element,
                S::as_simd_f64s(&inputs).0,
                S::as_mut_simd_f64s(&mut blocks).0,
                S::as_mut_simd_f64s(&mut formed).0,
                S::as_mut_simd_f64s(&mut work).0,
            );
            let of = |lane: usize| (0..count).map(|k| blocks[k * width + lane]).collect();
            all.push((0..width).map(of).collect());
        }
        all
    }
}

/// Stiffnesses of all clusters with their first nodes held, in global axes.
fn scalar(plan: &Plan, model: &Model, pose: &Geometry) -> Vec<DMatrix<f64>> {
    let mut workspace = plan.workspace();
    assert!(evaluate(plan, model, pose, &[], &mut workspace).is_ok());
    let mut all = Vec::new();
    for element in &plan.elements {
        let Source::Cluster(k) = element.source else {
            continue;
        };
        let frame = cluster_frame(&plan.topology.clusters[k], pose).expect("a frame");
        let rows = element.rows;
        let at = &workspace.stiffnesses[element.stiffness_start..][..rows * rows];
        let mut stiffness = DMatrix::from_column_slice(rows, rows, at);
        for i in (0..rows).step_by(6) {
            for j in (0..rows).step_by(6) {
                let block: Matrix6<f64> = stiffness.fixed_view::<6, 6>(i, j).into_owned();
                let turned = rotate_matrix6(&block, &frame);
                stiffness.fixed_view_mut::<6, 6>(i, j).copy_from(&turned);
            }
        }
        all.push(stiffness);
    }
    all
}

#[test]
fn elements_formed_in_the_lanes_are_the_scalar_ones() {
    let model = mechanism();
    let plan = Plan::new(&model).expect("a plan");
    let program = Program::new(&plan, &model, model.geometry()).expect("a program");
    // The plan's own configuration, which is not formed anew, stands among the others.
    let poses: Vec<Geometry> = [1, 0, 2, 5, 8, 0, 3, 4].map(|k| pose(&model, k)).into();
    let expected: Vec<_> = poses.iter().map(|p| scalar(&plan, &model, p)).collect();
    let mut runs = 0;
    for arch in [Arch::Scalar, Arch::new()] {
        let program = &program;
        let found = arch.dispatch(FormAll {
            program,
            poses: &poses,
        });
        assert_eq!(found.len(), 3, "a run of two segments, a rod, a given body");
        for (element, by_lane) in found.iter().enumerate() {
            for (lane, blocks) in by_lane.iter().enumerate() {
                let expected = &expected[lane][element];
                let size = |i: usize| expected[(i, i)].sqrt();
                for s in 0..expected.nrows() / 6 {
                    for r in 0..=s {
                        for i in 0..6 {
                            for j in 0..6 {
                                let (row, column) = (6 * r + i, 6 * s + j);
                                let found = blocks[place(r + 1, s + 1) + 6 * i + j];
                                let error = (found - expected[(row, column)]).abs();
                                let error = error / (size(row) * size(column));
                                assert!(
                                    error < 1e-13,
                                    "{element} {lane} {row} {column}: {error:e}"
                                );
                                runs += 1;
                            }
                        }
                    }
                }
            }
        }
    }
    assert!(runs > 0);
}

#[test]
fn the_first_node_follows_by_equilibrium() {
    let model = mechanism();
    let plan = Plan::new(&model).expect("a plan");
    let program = Program::new(&plan, &model, model.geometry()).expect("a program");
    let at = pose(&model, 3);
    let found = Arch::Scalar.dispatch(FormAll {
        program: &program,
        poses: std::slice::from_ref(&at),
    });
    // A rigid motion of the tapered rod strains nothing.
    let rod = plan.topology.clusters.iter().position(|c| {
        let node = &model.nodes()[c.nodes[0].0];
        model.bodies()[node.body.0].name == "rod"
    });
    let rod = rod.expect("the rod");
    let [b, d] = [0, 1].map(|k| at.positions[plan.topology.clusters[rod].nodes[k].0]);
    let first = Vector6::new(1.0, -2.0, 0.5, 0.3, 0.2, -0.7);
    let turn = first.fixed_rows::<3>(3).into_owned();
    let mut second = first;
    let moved = first.fixed_rows::<3>(0) + turn.cross(&(d - b));
    second.fixed_rows_mut::<3>(0).copy_from(&moved);
    let element = plan
        .elements
        .iter()
        .position(|e| e.source == Source::Cluster(rod));
    let blocks = &found[element.expect("its element")][0];
    for (r, s) in [(0, 0), (0, 1), (1, 1)] {
        assert!(blocks[place(r, s)..][..36].iter().all(|v| v.is_finite()));
    }
    for i in 0..6 {
        let row = |at: usize, u: &Vector6<f64>| {
            (0..6).map(|j| blocks[at + 6 * i + j] * u[j]).sum::<f64>()
        };
        let force = row(place(0, 0), &first) + row(place(0, 1), &second);
        let size = (0..6)
            .map(|j| (blocks[place(0, 0) + 6 * i + j] * first[j]).abs())
            .sum::<f64>();
        assert!(force.abs() < 1e-13 * size, "row {i}: {force:e} of {size:e}");
    }
}
