//! What every number of the geometry moves: joints at home, and by them the loops at any configuration.

use hyperstat_model::Geometry;
use nalgebra::{DMatrix, DVector, Rotation3, Vector3};

use super::Rounded;
use super::rails::{Bends, Rails};
use crate::closure::LoopClosure;
use crate::equations::System;
use crate::linkage::{Configuration, Posture};
use crate::twist::Twist;

/// Part of a rounding by which a number is changed to see what it moves, and the least change.
const PART: f64 = 0.1;
const LEAST: f64 = 1e-7;

/// What numbers of the geometry move at home, per unit of each.
#[derive(Debug)]
pub(super) struct Effects {
    /// Of every joint, the numbers that move it, with the motion of its frame.
    joints: Vec<Vec<(usize, Twist)>>,
    /// Of the rails' bends, one row each.
    pub bends: DMatrix<f64>,
    /// Bends of the rails as they are.
    pub bent: DVector<f64>,
    count: usize,
}

impl Effects {
    /// By differences of the mechanism's geometry; `None` where a number cannot be changed.
    pub fn of(closure: &LoopClosure, rounded: &Rounded<'_>, rails: &Rails) -> Option<Self> {
        let count = rounded.values.len();
        let home = closure.geometry();
        let bent = rails.bends(home);
        let mut effects = Self {
            joints: vec![Vec::new(); closure.system.linkage.joints.len()],
            bends: DMatrix::zeros(bent.len(), count),
            bent,
            count,
        };
        for k in 0..count {
            let change = (PART * rounded.roundings[k]).max(LEAST);
            let geometry = |sign: f64| {
                let mut values = rounded.values.to_vec();
                values[k] += sign * change;
                Some((rounded.model)(&values)?.geometry().clone())
            };
            let ends = [geometry(-1.0)?, geometry(1.0)?];
            effects.add(closure, k, &ends, 2.0 * change);
            let [before, after] = ends.map(|end| rails.bends(&end));
            effects
                .bends
                .set_column(k, &((after - before) / (2.0 * change)));
        }
        Some(effects)
    }

    /// Adds what number `k` moves, from the geometries on both sides.
    fn add(&mut self, closure: &LoopClosure, k: usize, ends: &[Geometry; 2], change: f64) {
        for (j, joint) in closure.system.linkage.joints.iter().enumerate() {
            let Some(node) = joint.nodes.into_iter().flatten().next() else {
                continue;
            };
            let [before, after] = ends
                .each_ref()
                .map(|end| (end.positions[node.0], end.frames[j]));
            if before == after {
                continue;
            }
            let place = joint.home.translation.vector;
            let turn = turned(&before.1, &after.1) / change;
            let moved = (after.0 - before.0) / change;
            let twist = Twist {
                linear: moved - turn.cross(&place),
                angular: turn,
            };
            self.joints[j].push((k, twist));
        }
    }

    /// Those of the rails that the roundings may have bent.
    pub fn rails(&self, rails: &Rails, rounded: &Rounded<'_>) -> Bends {
        rails.nearly_straight(&self.bends, &self.bent, rounded.roundings)
    }

    /// Derivatives of the loops' misfits by all numbers, at a configuration.
    pub fn on_loops(&self, system: &System, configuration: &Configuration) -> DMatrix<f64> {
        let linkage = &system.linkage;
        let posture = linkage.posture(configuration);
        let mut effect = DMatrix::zeros(system.closing_rows(), self.count);
        let mut row = 0;
        for &closing in &linkage.closings {
            let joint = &linkage.joints[closing];
            let rows = if joint.ball { 3 } else { 6 };
            let [first, second] = joint.bodies;
            for (body, sign) in [(second, 1.0), (first, -1.0)] {
                for (moved, own) in chain(system, body) {
                    self.on_loop(
                        system,
                        &posture,
                        (closing, moved),
                        sign * own,
                        (row, rows),
                        &mut effect,
                    );
                }
            }
            self.on_loop(
                system,
                &posture,
                (closing, closing),
                -1.0,
                (row, rows),
                &mut effect,
            );
            row += rows;
        }
        effect
    }

    /// Adds what the numbers do to one loop by one joint.
    fn on_loop(
        &self,
        system: &System,
        posture: &Posture,
        (closing, moved): (usize, usize),
        sign: f64,
        (row, rows): (usize, usize),
        effect: &mut DMatrix<f64>,
    ) {
        let linkage = &system.linkage;
        let end = &linkage.joints[closing];
        let body = |body: Option<usize>| body.map(|b| posture.bodies[b]).unwrap_or_default();
        let place = (body(end.bodies[1]) * end.home).translation.vector;
        let axes = (body(end.bodies[0]) * end.home)
            .rotation
            .to_rotation_matrix();
        let joint = &linkage.joints[moved];
        let before = body(joint.bodies[0]);
        // Where the loop is closed, both bodies of its last joint agree on it.
        let after = match closing == moved {
            true => body(joint.bodies[1]),
            false => posture.ends[moved] * joint.home.inverse(),
        };
        for (k, twist) in &self.joints[moved] {
            let [before, after] = [before, after].map(|frame| twist.seen_through(&frame));
            let twist = Twist {
                linear: before.linear - after.linear,
                angular: before.angular - after.angular,
            };
            let linear = axes.inverse() * twist.velocity(&place) * (sign / system.size);
            let angular = axes.inverse() * twist.angular * sign;
            for c in 0..3 {
                effect[(row + c, *k)] += linear[c];
                if rows == 6 {
                    effect[(row + 3 + c, *k)] += angular[c];
                }
            }
        }
    }
}

/// The joints of the tree that lead to a body and move it, with the sign of their motions.
fn chain(system: &System, body: Option<usize>) -> Vec<(usize, f64)> {
    let columns = body.map_or(&[][..], |b| &system.linkage.chains[b][..]);
    let mut joints: Vec<(usize, f64)> = (columns.iter())
        .map(|(column, sign)| (system.linkage.columns[*column].joint, *sign))
        .collect();
    joints.dedup_by_key(|(joint, _)| *joint);
    joints
}

/// The rotation vector from one frame to another.
fn turned(from: &Rotation3<f64>, to: &Rotation3<f64>) -> Vector3<f64> {
    // The antisymmetric part: small angles lose no digits in it.
    let turn = (to * from.inverse()).into_inner();
    let difference = turn - turn.transpose();
    Vector3::new(difference[(2, 1)], difference[(0, 2)], difference[(1, 0)]) * 0.5
}
