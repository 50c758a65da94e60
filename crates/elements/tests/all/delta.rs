//! Natural frequencies of a delta robot, assembled here joint by joint from the crate's element
//! matrices: every body's joint node follows the node of the body before it, by the motions of the
//! joint between them.
//!
//! The delta: base radius 0.25 m, platform radius 0.06, arms 0.30, rods 0.60, rods 0.12 apart;
//! circles of 30 mm (arms), 20 mm (cross links) and 14 mm (rods); E = 2.1e11, ν = 0.3, ρ = 7850;
//! drives locked, platform at (0, 0, 0.5) with 1 kg and 1e-3 kg m² about each axis. The figures
//! are those on which OpenSees and an independent null-space program agree.

use crate::support;

use std::f64::consts::TAU;

use hyperstat_elements::{
    Beam, LineMass, MassShape, Matrix12, RigidMass, RotaryInertia, Taper, element_frame,
    rotate_matrix12, transport,
};
use nalgebra::{DMatrix, Matrix6, Rotation3, SVector, Vector3, Vector6};

use support::random::{circle, steel};

const ELEMENTS: usize = 8;

/// Displacement of a node: unknowns and what one of each moves the node by.
type Node = Vec<(usize, Vector6<f64>)>;

/// How a revolute joint is modelled.
#[derive(Clone, Copy, PartialEq)]
enum Joints {
    Rigid,
    /// 1e8 N/m along all axes, 1e5 N m/rad across the axis.
    Elastic,
}

#[derive(Clone, Copy, PartialEq)]
enum Mass {
    Consistent,
    Lumped,
}

struct Delta {
    joints: Joints,
    mass: Mass,
    unknowns: usize,
    springs: Vec<(usize, f64)>,
    elements: Vec<([Node; 2], Matrix12, Matrix12)>,
}

impl Delta {
    fn unknown(&mut self) -> usize {
        self.unknowns += 1;
        self.unknowns - 1
    }

    fn free_node(&mut self) -> Node {
        (0..6)
            .map(|d| (self.unknown(), Vector6::ith(d, 1.0)))
            .collect()
    }

    /// The node beyond a revolute joint about this axis.
    fn jointed(&mut self, before: &Node, axis: &Vector3<f64>, locked: bool) -> Node {
        let turn = |about: Vector3<f64>| Vector6::new(0.0, 0.0, 0.0, about.x, about.y, about.z);
        let mut node = before.clone();
        if !locked {
            node.push((self.unknown(), turn(*axis)));
        }
        if self.joints == Joints::Elastic {
            let across = axis
                .cross(&axis.map(|c| if c.abs() < 0.5 { 1.0 } else { 0.0 }))
                .normalize();
            let translations = (0..3).map(|d| (Vector6::ith(d, 1.0), 1e8));
            let turns = [across, axis.cross(&across)].map(|about| (turn(about), 1e5));
            for (motion, stiffness) in translations.chain(turns) {
                let unknown = self.unknown();
                node.push((unknown, motion));
                self.springs.push((unknown, stiffness));
            }
        }
        node
    }

    /// A beam of round section from one node to another.
    fn beam(&mut self, diameter: f64, nodes: [&Node; 2], span: Vector3<f64>) {
        let part = span / ELEMENTS as f64;
        let section = circle(diameter);
        let beam = Beam::new(&steel(), &section, part.norm()).unwrap();
        let line = LineMass::new(7850.0, Taper::constant(section)).unwrap();
        let mass = match self.mass {
            Mass::Consistent => line.consistent(&beam, MassShape::Cubic, RotaryInertia::Left),
            Mass::Lumped => line.lumped(part.norm()),
        };
        let frame = element_frame(&part, None).unwrap();
        let (stiffness, mass) = (
            rotate_matrix12(&beam.stiffness(), &frame),
            rotate_matrix12(&mass, &frame),
        );
        let mut first = nodes[0].clone();
        for k in 1..=ELEMENTS {
            let second = if k < ELEMENTS {
                self.free_node()
            } else {
                nodes[1].clone()
            };
            self.elements
                .push(([first, second.clone()], stiffness, mass));
            first = second;
        }
    }

    fn limb(&mut self, platform: &Node, centre: &Vector3<f64>, turn: &Rotation3<f64>) {
        let (a, c) = (
            turn * Vector3::new(0.0, 0.25, 0.0),
            centre + turn * Vector3::new(0.0, 0.06, 0.0),
        );
        let (x, out) = (turn * Vector3::x(), turn * Vector3::y());
        // B: 0.3 from A and 0.6 from C, farther out of the two.
        let span = c - a;
        let along = (0.3 * 0.3 - 0.6 * 0.6 + span.norm_squared()) / (2.0 * span.norm());
        let aside = (0.3 * 0.3 - along * along).sqrt();
        let across = x.cross(&span).normalize();
        let across = if across.dot(&out) > 0.0 {
            across
        } else {
            -across
        };
        let b = a + span.normalize() * along + across * aside;
        let (rod, half) = (c - b, x * 0.06);
        let across = rod.cross(&x).normalize();

        let arm_start = self.jointed(&Vec::new(), &x, true);
        let arm_end = self.free_node();
        self.beam(0.030, [&arm_start, &arm_end], b - a);
        let elbow = self.jointed(&arm_end, &x, false);
        let at_platform: Node = platform
            .iter()
            .map(|(unknown, motion)| (*unknown, transport(&(c - centre)) * motion))
            .collect();
        let wrist = self.jointed(&at_platform, &x, false);
        for side in [-half, half] {
            let elbow_end = self.free_node();
            self.beam(0.020, [&elbow, &elbow_end], side);
            let rod_start = self.jointed(&elbow_end, &across, false);
            let rod_end = self.free_node();
            self.beam(0.014, [&rod_start, &rod_end], rod);
            let wrist_end = self.jointed(&rod_end, &across, false);
            self.beam(0.020, [&wrist, &wrist_end], side);
        }
    }

    fn matrices(&self, platform: &Matrix6<f64>) -> [DMatrix<f64>; 2] {
        let mut k = DMatrix::zeros(self.unknowns, self.unknowns);
        let mut m = k.clone();
        for (nodes, stiffness, mass) in &self.elements {
            let columns: Vec<(usize, SVector<f64, 12>)> = nodes
                .iter()
                .enumerate()
                .flat_map(|(end, node)| {
                    node.iter().map(move |(unknown, motion)| {
                        let mut column = SVector::<f64, 12>::zeros();
                        column.fixed_rows_mut::<6>(6 * end).copy_from(motion);
                        (*unknown, column)
                    })
                })
                .collect();
            for (i, a) in &columns {
                let (force, momentum) = (stiffness * a, mass * a);
                for (j, b) in &columns {
                    k[(*j, *i)] += b.dot(&force);
                    m[(*j, *i)] += b.dot(&momentum);
                }
            }
        }
        for (unknown, stiffness) in &self.springs {
            k[(*unknown, *unknown)] += stiffness;
        }
        // The platform's node came first.
        let mut own = m.view_mut((0, 0), (6, 6));
        own += platform;
        [k, m]
    }
}

/// The lowest six frequencies \[Hz\], by subspace iteration with K⁻¹ M.
fn frequencies(joints: Joints, mass: Mass) -> [f64; 6] {
    let mut delta = Delta {
        joints,
        mass,
        unknowns: 0,
        springs: Vec::new(),
        elements: Vec::new(),
    };
    let platform = delta.free_node();
    let centre = Vector3::new(0.0, 0.0, 0.5);
    for limb in 0..3 {
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), f64::from(limb) * TAU / 3.0);
        delta.limb(&platform, &centre, &turn);
    }
    let own = RigidMass::with_moments(1.0, [1e-3; 3]).unwrap();
    let [k, m] = delta.matrices(&own.about(&Vector3::zeros()));
    let factor = k
        .clone()
        .cholesky()
        .expect("locked drives leave no motion free");
    let mut x = DMatrix::from_fn(k.nrows(), 16, |r, c| ((r * 37 + c * 101) % 17) as f64 - 8.0);
    let mut lowest = [0.0; 6];
    for _ in 0..60 {
        x = factor.solve(&(&m * &x));
        // Ritz values: largest xᵀ M x of vectors with xᵀ K x = 1.
        let l = (x.transpose() * &k * &x).cholesky().unwrap().unpack();
        let reduced = x.transpose() * &m * &x;
        let half = l.solve_lower_triangular(&reduced).unwrap();
        let whole = l.solve_lower_triangular(&half.transpose()).unwrap();
        let eigen = ((&whole + whole.transpose()) * 0.5).symmetric_eigen();
        x *= l
            .transpose()
            .solve_upper_triangular(&eigen.eigenvectors)
            .unwrap();
        let mut found: Vec<f64> = eigen
            .eigenvalues
            .iter()
            .map(|v| (1.0 / v).sqrt() / TAU)
            .collect();
        found.sort_by(f64::total_cmp);
        let next: [f64; 6] = std::array::from_fn(|n| found[n]);
        let change = next
            .iter()
            .zip(lowest)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        lowest = next;
        if change < 1e-9 {
            break;
        }
    }
    lowest
}

fn agree(found: [f64; 6], expected: [f64; 6]) {
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() <= 6e-6, "{found} {expected}");
    }
}

#[test]
fn rigid_joints_consistent_mass() {
    let expected = [60.93600, 60.93600, 64.73482, 73.04502, 77.29717, 77.29717];
    agree(frequencies(Joints::Rigid, Mass::Consistent), expected);
}

#[test]
fn rigid_joints_lumped_mass() {
    let expected = [60.99230, 60.99230, 64.84352, 73.14589, 77.36782, 77.36782];
    agree(frequencies(Joints::Rigid, Mass::Lumped), expected);
}

#[test]
fn elastic_joints_consistent_mass() {
    let expected = [57.76133, 57.76133, 64.24403, 67.81478, 75.92299, 75.92299];
    agree(frequencies(Joints::Elastic, Mass::Consistent), expected);
}
