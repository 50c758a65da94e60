//! Beams along which joints slide: they have to be straight for a joint to slide on them.

use hyperstat_model::{Geometry, NodeId};
use nalgebra::{DMatrix, DVector};

use crate::closure::LoopClosure;
use crate::twist::Twist;

/// Roundings of all numbers at their worst, and a little.
const WORST: f64 = 0.6;
/// Sine of an angle that is none.
const STRAIGHT: f64 = 1e-12;

/// A span of a beam that may lie along the travel of a joint at its end.
#[derive(Debug)]
struct Rail {
    joint: usize,
    /// The travel, in the joint's frame.
    travel: Twist,
    ends: [NodeId; 2],
}

/// All of a mechanism.
#[derive(Debug)]
pub(super) struct Rails(Vec<Rail>);

/// Conditions on the geometry: rails that are to be straight.
#[derive(Debug)]
pub(super) struct Bends {
    /// Their rows among those of all rails.
    rows: Vec<usize>,
}

impl Rails {
    pub fn of(closure: &LoopClosure) -> Self {
        let mut rails = Vec::new();
        for (k, joint) in closure.system.linkage.joints.iter().enumerate() {
            let mut travels = joint.factors.iter().map(|(_, twist)| twist);
            let mut travels = travels.by_ref().filter(|twist| twist.is_translation());
            let (Some(travel), None) = (travels.next(), travels.next()) else {
                continue;
            };
            for node in joint.nodes.into_iter().flatten() {
                let others = closure.parts.along(node).iter();
                rails.extend(others.map(|other| Rail {
                    joint: k,
                    travel: *travel,
                    ends: [*other, node],
                }));
            }
        }
        Self(rails)
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Travel × span of every rail, three rows each: sines of the angles between them.
    pub fn bends(&self, geometry: &Geometry) -> DVector<f64> {
        let mut bends = DVector::zeros(3 * self.0.len());
        for (k, rail) in self.0.iter().enumerate() {
            let [from, to] = rail.ends.map(|node| geometry.positions[node.0]);
            let travel = (geometry.frames[rail.joint] * rail.travel.linear).normalize();
            let bend = travel.cross(&(to - from).normalize());
            bends.fixed_rows_mut::<3>(3 * k).copy_from(&bend);
        }
        bends
    }

    /// The rails that roundings may have bent: the others are no rails.
    pub fn nearly_straight(
        &self,
        by_number: &DMatrix<f64>,
        bends: &DVector<f64>,
        roundings: &[f64],
    ) -> Bends {
        let may_be = |row: usize| {
            let each = by_number.row(row);
            let each = each.iter().zip(roundings).map(|(d, h)| d.abs() * h);
            bends[row].abs() <= WORST * each.sum::<f64>() + STRAIGHT
        };
        let rails = 0..self.0.len();
        let straight = rails.filter(|k| (3 * k..3 * k + 3).all(may_be));
        Bends {
            rows: straight.flat_map(|k| 3 * k..3 * k + 3).collect(),
        }
    }
}

impl Bends {
    /// Whether all are straight.
    pub fn none(&self, bends: &DVector<f64>) -> bool {
        self.largest(bends) <= STRAIGHT
    }

    /// The largest of them.
    pub fn largest(&self, bends: &DVector<f64>) -> f64 {
        let own = self.rows.iter().map(|row| bends[*row].abs());
        own.fold(0.0, f64::max)
    }

    /// The rows of these among those of all rails.
    pub fn of(&self, bends: &DVector<f64>) -> DVector<f64> {
        bends.select_rows(&self.rows)
    }

    /// The same of derivatives.
    pub fn rows_of(&self, by_number: &DMatrix<f64>) -> DMatrix<f64> {
        by_number.select_rows(&self.rows)
    }
}
