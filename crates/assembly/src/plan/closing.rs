//! The conditions that closing joints put on a component's coordinates, and their solutions.
//!
//! A tree has few coordinates, and its conditions are eliminated with complete pivoting. A network
//! has six a body, and every joint's conditions are on two bodies: they are eliminated by sparse
//! rows, which leave each body few coordinates of its neighbourhood. Lengths are over the
//! mechanism's size in a tree, over the mean arm from body to joint in a network, so that a cell is
//! judged by its own size.

use std::collections::HashMap;

use hyperstat_model::condition_rows;
use nalgebra::{DMatrix, DVector, Vector6};

use super::blocks::{read, shift};
use super::coordinates::TreeBlocks;
use super::topology::Topology;
use super::trees::Component;
use crate::error::SolveError;
use crate::posture::Posture;
use crate::rank::dense::Elimination;
use crate::rank::dissection::{Graph, levels};
use crate::rank::sparse::{SparseElimination, SparseVector};
use crate::rank::substitution::SparseMap;

/// What asks for too much room where the coordinates of a network reach far.
pub(crate) const NETWORK: &str =
    "its network of rigid bodies, whose motions are of very many bodies each,";

/// Which of a component's coordinates are to become dependent before others.
#[derive(Debug)]
pub(crate) struct Order {
    /// The first so many become dependent only where nothing else can: the output's six, or none.
    pub spared: usize,
    /// Of a network, the levels of its coordinates: those of bodies that cuts through it leave
    /// together come first, then those of bodies along the cuts, the spared ones last.
    levels: Vec<usize>,
}

impl Order {
    /// The order of a component; `spared`: it has the output, whose coordinates are its first.
    pub fn new(component: &Component, topology: &Topology, at: &Posture<'_>, spared: bool) -> Self {
        let spared = if spared { 6 } else { 0 };
        let mut place = HashMap::new();
        let mut places = Vec::with_capacity(component.network.len());
        for (k, &carrier) in component.network.iter().enumerate() {
            place.insert(carrier, k);
            let reference = topology.carriers[carrier].reference;
            places.push(at.geometry.positions[reference.0]);
        }
        let mut graph: Graph = vec![Vec::new(); places.len()];
        let joints = component.closings.iter().filter(|_| component.is_network());
        for joint in joints {
            let ends = at.model.joints()[joint.0].between;
            let ends = ends.map(|node| node.map(|node| place[&topology.carrier_of[node.0]]));
            if let [Some(a), Some(b)] = ends
                && a != b
                && !graph[a].contains(&b)
            {
                graph[a].push(b);
                graph[b].push(a);
            }
        }
        let levels = levels(&graph, &places);
        let last = levels.iter().copied().max().unwrap_or(0) + 1;
        let mut levels: Vec<usize> = levels.iter().flat_map(|level| [*level; 6]).collect();
        levels
            .iter_mut()
            .take(spared)
            .for_each(|level| *level = last);
        Self { spared, levels }
    }
}

/// Conditions on a component's scaled coordinates, a row a rigid or absorbed direction of a
/// closing joint.
pub(crate) struct Conditions<'a> {
    component: &'a Component,
    tree: &'a TreeBlocks,
    rows: Vec<SparseVector>,
    /// What lengths are divided by (m).
    pub length: f64,
}

impl<'a> Conditions<'a> {
    /// Those of a component in a configuration, whose `tree` is evaluated.
    pub fn new(
        component: &'a Component,
        tree: &'a TreeBlocks,
        topology: &Topology,
        at: &Posture<'_>,
    ) -> Self {
        let length = if component.is_network() {
            at.arm_length()
        } else {
            at.size
        };
        let mut conditions = Self {
            component,
            tree,
            rows: Vec::new(),
            length,
        };
        for joint in &component.closings {
            let entry = &at.model.joints()[joint.0];
            let local = at.direction_map(*joint);
            let rigid = topology.joints[joint.0].moving.complement();
            for condition in condition_rows(&local, rigid, length) {
                let mut row = SparseVector::new();
                for (node, sign) in entry.between.iter().zip([1.0, -1.0]) {
                    let Some(node) = node else { continue };
                    let carrier = topology.carrier_of[node.0];
                    let entry = &topology.carriers[carrier];
                    let shift = shift(at.geometry, entry.reference, *node);
                    for (k, &coordinate) in entry.coordinates.iter().enumerate() {
                        let u = shift * read(&tree.values, tree.starts[carrier] + 6 * k);
                        let own = coordinate - component.coordinates.start;
                        let part = (condition * over(length, u))[0];
                        row.push((own, sign * part * conditions.scale(own)));
                    }
                }
                conditions.rows.push(merged(row));
            }
        }
        conditions
    }

    /// The length that one of the component's coordinates is divided by: that of lengths for a
    /// translation.
    fn scale(&self, own: usize) -> f64 {
        let coordinate = self.component.coordinates.start + own;
        if self.tree.identities[coordinate].1.index() < 3 {
            self.length
        } else {
            1.0
        }
    }

    /// Number of coordinates.
    fn count(&self) -> usize {
        self.component.coordinates.len()
    }

    fn dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.rows.len(), self.count());
        for (r, row) in self.rows.iter().enumerate() {
            for (c, value) in row {
                dense[(r, *c)] = *value;
            }
        }
        dense
    }

    /// All coordinates by independent ones, chosen in an order.
    ///
    /// # Errors
    /// A network whose coordinates depend on too many others.
    pub fn solved(self, order: &Order) -> Result<Closing, SolveError> {
        let scales: Vec<f64> = (0..self.count()).map(|own| self.scale(own)).collect();
        if !self.component.is_network() {
            let mut solved = Elimination::new(self.dense(), order.spared);
            for (place, &own) in solved.independent.iter().enumerate() {
                for (c, scale) in scales.iter().enumerate() {
                    solved.map[(c, place)] *= scale / scales[own];
                }
            }
            return Ok(Closing::Tree(solved));
        }
        let solved = SparseElimination::by_levels(self.rows, order.levels.clone());
        let doubtful = solved.doubtful;
        let mut map = solved.map(NETWORK)?;
        for (row, scale) in map.rows.iter_mut().zip(&scales) {
            for (place, weight) in row {
                *weight *= scale / scales[map.independent[*place]];
            }
        }
        Ok(Closing::Network { map, doubtful })
    }

    /// Coordinates that meet the conditions with a right side, the independent ones zero, and the
    /// largest condition that they leave open over the largest scaled coordinate or `largest`.
    pub fn met(self, right_side: &[f64], order: &Order, largest: f64) -> (Vec<f64>, f64) {
        let mut particular = vec![0.0; self.count()];
        let mut left = right_side.to_vec();
        let sparse = self
            .component
            .is_network()
            .then(|| SparseElimination::by_levels(self.rows.clone(), order.levels.clone()));
        for _ in 0..2 {
            let step = match &sparse {
                Some(solved) => solved.particular(&left),
                None => {
                    let right_side = DVector::from_column_slice(&left);
                    let solved =
                        Elimination::with_right_side(self.dense(), right_side, order.spared);
                    solved.particular.as_slice().to_vec()
                }
            };
            for (value, step) in particular.iter_mut().zip(step) {
                *value += step;
            }
            for ((left, asked), row) in left.iter_mut().zip(right_side).zip(&self.rows) {
                let met: f64 = row.iter().map(|(c, v)| v * particular[*c]).sum();
                *left = asked - met;
            }
        }
        let most = |values: &[f64]| values.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        let open = most(&left);
        let largest = largest.max(most(&particular));
        for (own, value) in particular.iter_mut().enumerate() {
            *value *= self.scale(own);
        }
        (particular, if open > 0.0 { open / largest } else { 0.0 })
    }
}

/// A component's coordinates by independent ones of them.
#[derive(Debug)]
pub(crate) enum Closing {
    /// Of a tree.
    Tree(Elimination),
    /// Of a network.
    Network {
        map: SparseMap,
        /// A pivot between zero and not zero.
        doubtful: Option<f64>,
    },
}

impl Closing {
    /// The independent coordinates, by their places in the component, ascending.
    pub fn independent(&self) -> &[usize] {
        match self {
            Self::Tree(solved) => &solved.independent,
            Self::Network { map, .. } => &map.independent,
        }
    }

    /// A pivot between zero and not zero.
    pub fn doubtful(&self) -> Option<f64> {
        match self {
            Self::Tree(solved) => solved.doubtful,
            Self::Network { doubtful, .. } => *doubtful,
        }
    }

    /// The weights of a coordinate by the places of the independent ones: all of a tree, those of a
    /// network that are not zero.
    pub fn weights(&self, own: usize) -> impl Iterator<Item = (usize, f64)> {
        let (tree, network) = match self {
            Self::Tree(solved) => (Some(solved.map.row(own)), &[][..]),
            Self::Network { map, .. } => (None, &map.rows[own][..]),
        };
        let tree = tree.into_iter().flat_map(|row| {
            let places = 0..row.len();
            places.map(move |place| (place, row[place]))
        });
        tree.chain(network.iter().copied())
    }
}

/// A displacement with its translations over a length.
pub(crate) fn over(length: f64, mut u: Vector6<f64>) -> Vector6<f64> {
    for k in 0..3 {
        u[k] /= length;
    }
    u
}

/// Entries by ascending columns, those of a column added, zeros left out.
fn merged(mut entries: SparseVector) -> SparseVector {
    entries.sort_by_key(|(column, _)| *column);
    let mut row = SparseVector::with_capacity(entries.len());
    for (column, value) in entries {
        match row.last_mut() {
            Some((last, sum)) if *last == column => *sum += value,
            _ => row.push((column, value)),
        }
    }
    row.retain(|(_, value)| *value != 0.0);
    row
}
