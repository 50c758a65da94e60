//! Loops of rigid bodies: coordinates that depend on others.
//!
//! A joint that closes a loop of rigid bodies puts conditions on the coordinates of the joints around
//! it. Which of them are met by which coordinates is worked out once, by complete pivoting in the
//! plan's configuration; at every pose the conditions are eliminated in that order. A body then moves
//! along the independent coordinates by its own joints' screws and those of the joints that depend on
//! them. Where a pivot comes near zero, or a condition that was redundant is none, the pose goes one by
//! one.

use hyperstat_model::{Geometry, JointId, Model};
use nalgebra::{DMatrix, Vector3, Vector6};

use super::element::{Moving, Screw};
use super::inputs::{Inputs, Point};
use super::parts::Placed;
use crate::plan::topology::Topology;
use crate::plan::trees::Component;

/// Share of a condition's terms above which an entry is a pivot, at every pose.
pub(crate) const PIVOT: f64 = 1e-3;
/// Share of a condition's terms below which what is left of it is nothing.
pub(crate) const NOTHING: f64 = 1e-12;
/// How much less a coordinate with a spring of its own is wanted as a pivot.
const SPRING: f64 = 1e-2;

/// All loops.
#[derive(Debug, Default)]
pub(crate) struct Loops {
    pub list: Vec<Loop>,
    /// Coordinates that depend on others.
    pub dependent: Vec<usize>,
    /// Screws of all, those that loops put together among them.
    pub screws: usize,
    /// How carriers of loops move.
    carriers: Vec<(usize, Vec<Moving>)>,
}

/// Bodies that loops tie together.
#[derive(Debug)]
pub(crate) struct Loop {
    pub conditions: Vec<Condition>,
    /// Coordinates, those of the joints in the tree.
    pub coordinates: Vec<usize>,
    /// Rows and columns, by steps of the elimination.
    pub pivots: Vec<[usize; 2]>,
    /// Columns of the independent coordinates.
    pub independent: Vec<usize>,
    pub combined: Vec<Combined>,
    /// Point that the screws are taken at.
    pub reference: Point,
}

/// A direction in which a closing joint holds its second body to its first.
#[derive(Debug)]
pub(crate) struct Condition {
    pub point: Point,
    /// Columns of the joint's frame (places in the inputs).
    pub axes: [usize; 3],
    /// What of the relative twist must be none: by axes, of its translation (over a length) and its
    /// rotation.
    pub dual: Vector6<f64>,
    /// Columns, with the sign that their screws count by.
    pub terms: Vec<(usize, f64)>,
}

/// The screw by which an independent coordinate moves a body.
#[derive(Debug, PartialEq)]
pub(crate) struct Combined {
    /// Its place among the screws.
    pub screw: usize,
    /// Column of the coordinate.
    pub column: usize,
    /// Whether its own joint moves the body.
    pub own: bool,
    /// Steps of the elimination whose coordinates move the body.
    pub steps: Vec<usize>,
}

impl Loops {
    /// Those of a topology; `None` where the lanes do not take them: loops through the output's six
    /// coordinates, networks, coordinates with springs that depend on others.
    pub fn new(
        model: &Model,
        geometry: &Geometry,
        topology: &Topology,
        (placed, screws): (&[Option<Placed>], &[Screw]),
        size: f64,
        inputs: &mut Inputs,
    ) -> Option<Self> {
        let mut loops = Self {
            screws: topology.coordinates,
            ..Self::default()
        };
        for component in topology
            .components
            .iter()
            .filter(|c| !c.closings.is_empty())
        {
            let maker = Maker {
                model,
                geometry,
                topology,
                component,
                screws,
                size,
            };
            let own = maker.conditions(placed, inputs)?;
            let own = maker.eliminated(own, inputs)?;
            loops.add(own, topology, component);
        }
        Some(loops)
    }

    /// Takes in a loop, with the screws of its bodies.
    fn add(&mut self, mut own: Loop, topology: &Topology, component: &Component) {
        let dependent = own
            .pivots
            .iter()
            .map(|[_, column]| own.coordinates[*column]);
        self.dependent.extend(dependent);
        for tie in &component.ties {
            let on_way = &topology.carriers[tie.child].coordinates;
            let steps = own.pivots.iter().enumerate();
            let steps = steps.filter(|(_, [_, c])| on_way.contains(&own.coordinates[*c]));
            let steps: Vec<usize> = steps.map(|(step, _)| step).collect();
            let mut moving = Vec::new();
            for &column in &own.independent {
                let coordinate = own.coordinates[column];
                let is_own = on_way.contains(&coordinate);
                if steps.is_empty() {
                    moving.extend(is_own.then_some(Moving {
                        coordinate,
                        screw: coordinate,
                    }));
                    continue;
                }
                let is_like =
                    |c: &&Combined| c.column == column && c.own == is_own && c.steps == steps;
                let known = own.combined.iter().find(is_like).map(|c| c.screw);
                let screw = known.unwrap_or_else(|| {
                    self.screws += 1;
                    own.combined.push(Combined {
                        screw: self.screws - 1,
                        column,
                        own: is_own,
                        steps: steps.clone(),
                    });
                    self.screws - 1
                });
                moving.push(Moving { coordinate, screw });
            }
            self.carriers.push((tie.child, moving));
        }
        if let Some(root) = component.root {
            self.carriers.push((root, Vec::new()));
        }
        self.list.push(own);
    }

    /// How a carrier of a loop moves, but for its root.
    pub fn of_carrier(&self, carrier: usize) -> Option<&[Moving]> {
        let own = self.carriers.iter().find(|(own, _)| *own == carrier);
        own.map(|(_, moving)| moving.as_slice())
    }

    /// Entries of the largest matrix of conditions, and conditions of the loop that has most.
    pub fn room(&self) -> [usize; 2] {
        let entries = self
            .list
            .iter()
            .map(|l| l.conditions.len() * l.coordinates.len());
        let rows = self.list.iter().map(|l| l.conditions.len());
        [entries.max().unwrap_or(0), rows.max().unwrap_or(0)]
    }
}

/// What a loop is made from.
struct Maker<'a> {
    model: &'a Model,
    geometry: &'a Geometry,
    topology: &'a Topology,
    component: &'a Component,
    screws: &'a [Screw],
    size: f64,
}

impl Maker<'_> {
    /// The conditions, before any is eliminated.
    fn conditions(&self, placed: &[Option<Placed>], inputs: &mut Inputs) -> Option<Loop> {
        let ties = self.component.ties.iter();
        let coordinates: Vec<usize> = ties.clone().flat_map(|t| t.coordinates.clone()).collect();
        let first = ties.clone().next()?.child;
        let reference = inputs.point(placed[first].as_ref()?.reference);
        let mut conditions = Vec::new();
        for joint in &self.component.closings {
            self.conditions_of(*joint, &coordinates, &mut conditions, inputs)?;
        }
        Some(Loop {
            conditions,
            coordinates,
            pivots: Vec::new(),
            independent: Vec::new(),
            combined: Vec::new(),
            reference,
        })
    }

    fn conditions_of(
        &self,
        joint: JointId,
        coordinates: &[usize],
        conditions: &mut Vec<Condition>,
        inputs: &mut Inputs,
    ) -> Option<()> {
        let entry = &self.model.joints()[joint.0];
        let way = |side: usize| -> &[usize] {
            let node = entry.between[side];
            let carrier = node.map(|node| self.topology.carrier_of[node.0]);
            carrier.map_or(&[], |carrier| &self.topology.carriers[carrier].coordinates)
        };
        let (from, to) = (way(0), way(1));
        // Of a root's own six, both bodies have the same: to the ground they would be conditions.
        let has_root = self.component.root.is_some();
        if has_root && entry.between.iter().any(Option::is_none) {
            return None;
        }
        let terms = coordinates.iter().enumerate().filter_map(|(column, c)| {
            let sign = f64::from(u8::from(to.contains(c))) - f64::from(u8::from(from.contains(c)));
            (sign != 0.0).then_some((column, sign))
        });
        let terms: Vec<(usize, f64)> = terms.collect();
        let inverse = entry.joint.basis().try_inverse()?;
        let node = entry.between.iter().flatten().next()?;
        let rigid = self.topology.joints[joint.0].moving.complement();
        for dof in rigid.iter() {
            let mut dual = inverse.row(dof.index()).transpose();
            // Lengths over the mechanism's size: rotations of a screw joint's row count as lengths.
            let unit = if dof.index() < 3 { self.size } else { 1.0 };
            dual /= unit;
            conditions.push(Condition {
                point: inputs.point(*node),
                axes: [0, 1, 2].map(|c| inputs.frame_column(joint, c)),
                dual,
                terms: terms.clone(),
            });
        }
        Some(())
    }

    /// Chooses the order of elimination; `None` where it is not clear in the plan's configuration.
    fn eliminated(&self, mut own: Loop, inputs: &Inputs) -> Option<Loop> {
        let at = |place: usize| inputs.at(self.geometry, place);
        let (rows, columns) = (own.conditions.len(), own.coordinates.len());
        let mut matrix = DMatrix::zeros(rows, columns);
        let mut scales = vec![0.0_f64; rows];
        let reference = at(own.reference);
        for (row, condition) in own.conditions.iter().enumerate() {
            let part = |first: usize| -> Vector3<f64> {
                (0..3)
                    .map(|k| at(condition.axes[k]) * condition.dual[first + k])
                    .sum()
            };
            let force = part(0);
            let moment = part(3) + (at(condition.point) - reference).cross(&force);
            for (column, sign) in &condition.terms {
                let coordinate = own.coordinates[*column];
                let screw = self.screws.iter().find(|s| s.coordinate == coordinate)?;
                let twist = screw.motion.twist(at, &reference, 1.0);
                let (v, w) = (twist.fixed_rows::<3>(0), twist.fixed_rows::<3>(3));
                matrix[(row, *column)] = sign * (force.dot(&v) + moment.dot(&w));
                scales[row] += force.norm_squared() * v.norm_squared()
                    + moment.norm_squared() * w.norm_squared();
            }
        }
        let has_spring = |column: usize| {
            let coordinate = own.coordinates[column];
            let mut ties = self.component.ties.iter();
            let tie = ties.find(|t| t.coordinates.contains(&coordinate))?;
            let moving = self.topology.joints[tie.joint.0].moving;
            let dof = moving.iter().nth(coordinate - tie.coordinates.start)?;
            Some(self.topology.joints[tie.joint.0].springs.contains(dof))
        };
        let springs: Option<Vec<bool>> = (0..columns).map(has_spring).collect();
        let springs = springs?;
        let mut free_rows: Vec<usize> = (0..rows).filter(|r| scales[*r] > 0.0).collect();
        let mut free_columns: Vec<usize> = (0..columns).collect();
        loop {
            let mut best = (0.0, 0.0, 0, 0);
            for &row in &free_rows {
                for &column in &free_columns {
                    let share = matrix[(row, column)].abs() / scales[row].sqrt();
                    let wanted = if springs[column] {
                        share * SPRING
                    } else {
                        share
                    };
                    if wanted > best.0 {
                        best = (wanted, share, row, column);
                    }
                }
            }
            let (_, share, row, column) = best;
            if share <= NOTHING {
                break;
            }
            // Neither a pivot nor nothing; a spring on what depends on others.
            if share <= 10.0 * PIVOT || springs[column] {
                return None;
            }
            for other in (0..rows).filter(|other| *other != row) {
                let factor = matrix[(other, column)] / matrix[(row, column)];
                for c in 0..columns {
                    let own = matrix[(row, c)];
                    matrix[(other, c)] -= factor * own;
                }
            }
            free_rows.retain(|r| *r != row);
            free_columns.retain(|c| *c != column);
            own.pivots.push([row, column]);
        }
        own.independent = free_columns;
        Some(own)
    }
}
