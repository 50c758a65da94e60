//! Mobility, motions without energy and redundant conditions, from the joints' conditions alone.
//!
//! Nodes that cannot move relative to each other make a piece with one twist; translations are
//! divided by the mechanism's size, so that all numbers are angles.

use std::collections::HashMap;

use hyperstat_joints::Dof;
use hyperstat_model::{BodyKind, Model};
use nalgebra::{DVector, Vector3, Vector6};

use crate::independence::{Independence, RANK_TOLERANCE};
use crate::joint::{Hold, JointConditions, is_released};
use crate::row::Row;
use crate::structure::{Structure, carried};

/// A partition of the nodes into pieces that move as one.
#[derive(Debug)]
pub(crate) struct Pieces {
    /// Piece of each node.
    of_node: Vec<usize>,
    /// From the piece's reference node to the node, over the size.
    arms: Vec<Vector3<f64>>,
    /// Number of pieces.
    count: usize,
    size: f64,
}

impl Pieces {
    /// Every body rigid.
    pub fn bodies(model: &Model, structure: &Structure) -> Self {
        Self::joined(
            structure,
            node_pairs(model, |_| true).chain(beams(structure)),
        )
    }

    /// Rigid and flexible bodies, and others as far as beams connect their nodes: what stays rigid
    /// when nothing takes up energy.
    pub fn undeformed(model: &Model, structure: &Structure) -> Self {
        let whole = node_pairs(model, |kind| kind != BodyKind::Elastic);
        Self::joined(structure, whole.chain(beams(structure)))
    }

    /// Rigid bodies, and every other node by itself.
    pub fn rigid_bodies(model: &Model, structure: &Structure) -> Self {
        Self::joined(structure, node_pairs(model, |kind| kind == BodyKind::Rigid))
    }

    fn joined(structure: &Structure, pairs: impl Iterator<Item = [usize; 2]>) -> Self {
        let positions = &structure.positions;
        let mut parent: Vec<usize> = (0..positions.len()).collect();
        for pair in pairs {
            let [a, b] = pair.map(|node| root(&parent, node));
            parent[a.max(b)] = a.min(b);
        }
        let mut numbers = HashMap::new();
        let (mut of_node, mut arms) = (Vec::new(), Vec::new());
        for (node, position) in positions.iter().enumerate() {
            let reference = root(&parent, node);
            let next = numbers.len();
            of_node.push(*numbers.entry(reference).or_insert(next));
            arms.push((position - positions[reference]) / structure.size);
        }
        Self {
            of_node,
            arms,
            count: numbers.len(),
            size: structure.size,
        }
    }

    /// A row's coefficients on the pieces' twists.
    fn coefficients(&self, row: &Row) -> DVector<f64> {
        let mut out = DVector::zeros(6 * self.count);
        for (node, a) in &row.terms {
            let mut scaled = *a;
            scaled.fixed_rows_mut::<3>(0).scale_mut(self.size);
            let mut block = out.fixed_rows_mut::<6>(6 * self.of_node[*node]);
            block += carried(&self.arms[*node], &scaled);
        }
        out
    }

    fn sort(&self, rows: &[Row]) -> Independence {
        let rows: Vec<_> = rows.iter().map(|row| self.coefficients(row)).collect();
        Independence::of(&rows, 6 * self.count)
    }

    /// Displacement of a node, its translation over the size, in a motion of the pieces.
    pub fn at_node(&self, motion: &DVector<f64>, node: usize) -> Vector6<f64> {
        let mut twist: Vector6<f64> = motion.fixed_rows::<6>(6 * self.of_node[node]).into();
        let turn: Vector3<f64> = twist.fixed_rows::<3>(3).into();
        let mut linear = twist.fixed_rows_mut::<3>(0);
        linear += turn.cross(&self.arms[node]);
        twist
    }

    /// The condition that a displacement has no part in `motion`, over all nodes.
    pub fn held(&self, motion: &DVector<f64>) -> Row {
        let term = |node| {
            let mut a = self.at_node(motion, node);
            a.fixed_rows_mut::<3>(0).unscale_mut(self.size);
            (node, a)
        };
        Row::rigid((0..self.of_node.len()).map(term).collect())
    }
}

fn root(parent: &[usize], mut node: usize) -> usize {
    while parent[node] != node {
        node = parent[node];
    }
    node
}

fn node_pairs(
    model: &Model,
    chosen: impl Fn(BodyKind) -> bool,
) -> impl Iterator<Item = [usize; 2]> {
    let bodies = model.bodies().iter().filter(move |body| chosen(body.kind));
    bodies.flat_map(|body| body.nodes.windows(2).map(|pair| [pair[0].0, pair[1].0]))
}

fn beams(structure: &Structure) -> impl Iterator<Item = [usize; 2]> {
    structure.elements.iter().map(|element| element.nodes)
}

/// Mobility and over-constraint: every body rigid, every direction that is free by its joint's
/// kind or by a stiffness of zero released, every other one a constraint.
pub(crate) fn mobility(model: &Model, structure: &Structure) -> (usize, usize) {
    let mut rows = Vec::new();
    for (connection, joint) in model.joints().iter().zip(&structure.joints) {
        let held = Dof::ALL.into_iter();
        let held = held.filter(|dof| !is_released(connection, *dof));
        rows.extend(held.map(|dof| joint.row(&unit(dof), 0.0)));
    }
    let pieces = Pieces::bodies(model, structure);
    let rank = pieces.sort(&rows).rank();
    (6 * pieces.count - rank, rows.len() - rank)
}

fn unit(dof: Dof) -> Vector6<f64> {
    Vector6::ith(dof.index(), 1.0)
}

/// Motions that take no energy: drives locked, springs at rest.
#[derive(Debug)]
pub(crate) struct FreeMotions {
    /// The pieces that move.
    pub pieces: Pieces,
    /// Orthonormal basis of all of them.
    pub all: Vec<DVector<f64>>,
    /// Orthonormal basis of those that leave the output where it is.
    pub idle: Vec<DVector<f64>>,
}

impl FreeMotions {
    /// Finds them.
    pub fn of(model: &Model, structure: &Structure) -> Self {
        let pieces = Pieces::undeformed(model, structure);
        let mut rows = Vec::new();
        for joint in &structure.joints {
            let row = |hold: &Hold| joint.row(&hold.combination, hold.flexibility);
            rows.extend(joint.holds.iter().map(row));
        }
        let all = pieces.sort(&rows).null_space();
        rows.extend(structure.output_rows());
        let idle = pieces.sort(&rows).null_space();
        Self { pieces, all, idle }
    }

    /// Orthonormal basis of the output's motions among them [m, rad].
    pub fn of_output(&self, structure: &Structure) -> Vec<Vector6<f64>> {
        let scaled = |motion| self.pieces.at_node(motion, structure.output);
        let moved: Vec<_> = (self.all.iter().map(scaled))
            .filter(|twist| twist.norm() > RANK_TOLERANCE)
            .map(|mut twist| {
                twist.fixed_rows_mut::<3>(0).scale_mut(structure.size);
                DVector::from_column_slice(twist.as_slice())
            })
            .collect();
        let sorted = Independence::of(&moved, 6);
        let count = self.all.len() - self.idle.len();
        let basis = sorted.basis().iter().take(count);
        basis
            .map(|twist| Vector6::from_column_slice(twist.as_slice()))
            .collect()
    }

    /// The motion that loads on nodes drive, where they work on one that nothing resists.
    pub fn driven(&self, structure: &Structure, loads: &DVector<f64>) -> Option<DVector<f64>> {
        let mut size = 0.0;
        let mut driven = DVector::zeros(6 * self.pieces.count);
        for node in 0..structure.positions.len() {
            let mut wrench: Vector6<f64> = loads.fixed_rows::<6>(6 * node).into();
            wrench.fixed_rows_mut::<3>(0).scale_mut(structure.size);
            size += wrench.norm_squared();
            for motion in &self.all {
                let work = self.pieces.at_node(motion, node).dot(&wrench);
                driven.axpy(work, motion, 1.0);
            }
        }
        (driven.norm() > RANK_TOLERANCE * size.sqrt()).then_some(driven)
    }
}

/// What the rigid conditions of the joints leave undetermined among themselves.
#[derive(Debug)]
pub(crate) struct Redundancy {
    /// By joint and hold: left out, because it follows from the others.
    pub dropped: Vec<Vec<bool>>,
    /// By joint: its wrench is not determined.
    pub undetermined: Vec<bool>,
    /// Whether the output can move in all six directions.
    pub output_moves: bool,
}

impl Redundancy {
    /// Finds it.
    pub fn of(model: &Model, structure: &Structure) -> Self {
        let pieces = Pieces::rigid_bodies(model, structure);
        let (mut rows, mut places) = (Vec::new(), Vec::new());
        for (j, joint) in structure.joints.iter().enumerate() {
            for (h, hold) in joint.holds.iter().enumerate() {
                if hold.flexibility == 0.0 {
                    rows.push(joint.row(&hold.combination, 0.0));
                    places.push((j, h));
                }
            }
        }
        let sorted = pieces.sort(&rows);
        let holds = |joint: &JointConditions| vec![false; joint.holds.len()];
        let mut dropped: Vec<_> = structure.joints.iter().map(holds).collect();
        for &row in &sorted.dependent {
            let (j, h) = places[row];
            dropped[j][h] = true;
        }
        let mut undetermined = vec![false; structure.joints.len()];
        for row in sorted.redundant() {
            undetermined[places[row].0] = true;
        }
        rows.extend(structure.output_rows());
        Self {
            dropped,
            undetermined,
            output_moves: pieces.sort(&rows).rank() == sorted.rank() + 6,
        }
    }
}
