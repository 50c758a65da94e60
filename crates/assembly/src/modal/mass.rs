//! Mass over the independent displacement coordinates: M = Σ Hᵀ m H over beams and masses of
//! nodes, with the same mappings H as the stiffness, and what couples beams' inner shapes to them.

use hyperstat_elements::{Matrix12, rotate_matrix12, rotate_vector6};
use hyperstat_model::{BodyId, Geometry, Model, NodeId, SegmentId};
use nalgebra::{Vector3, Vector6};

use crate::error::SolveError;
use crate::modal::member::Members;
use crate::plan::Plan;
use crate::plan::blocks::{dot, multiply, read, shift};
use crate::plan::elements::Source;
use crate::plan::sparse::Pattern;
use crate::plan::workspace::Workspace;
use crate::posture::Posture;
use crate::room;
use crate::room::MOST_NUMBERS;

/// Which coordinates masses go to, worked out once a topology: all of them, the output's too.
#[derive(Debug)]
pub(super) struct MassPlan {
    /// Pattern of stiffness and mass.
    pub pattern: Pattern,
    /// Places of every element's lower triangle, element by element.
    stiffness_places: Vec<usize>,
    /// Nodes and coordinates of every mass.
    holders: Vec<Holder>,
}

/// What has a mass: a segment, or a node.
#[derive(Debug)]
struct Holder {
    body: BodyId,
    /// Coordinates, ascending.
    columns: Vec<usize>,
    /// Nodes, each with the places in `columns` of its carrier's columns.
    nodes: Vec<(NodeId, Vec<usize>)>,
    places: Vec<usize>,
}

/// All masses in one configuration.
pub(super) struct Masses {
    elements: Vec<MassElement>,
    /// Their sum \[kg\].
    pub total: f64,
    /// Number of coordinates with those of the inner shapes, which follow the others.
    pub size: usize,
}

/// A mass in one configuration: its nodes' displacements H U, the mass matrix over them, and what it
/// has between them.
struct MassElement {
    rows: usize,
    operator: Vec<f64>,
    mass: Vec<f64>,
    inner: Inner,
}

impl Masses {
    /// Amounts of a segment's inner shapes in a vector.
    pub fn amounts<'a>(&self, segment: usize, x: &'a [f64]) -> &'a [f64] {
        let inner = &self.elements[segment].inner;
        &x[inner.start..][..inner.squares.len()]
    }
}

/// The inner shapes of a segment in one configuration, of unit mass.
#[derive(Default)]
pub(super) struct Inner {
    /// Coordinate of the first.
    pub start: usize,
    /// ω² of each, the segment's ends held.
    pub squares: Vec<f64>,
    /// Mass between each and the segment's coordinates, shape by shape.
    pub couplings: Vec<f64>,
    /// The same as forces at both nodes, global axes.
    forces: Vec<f64>,
}

impl Inner {
    /// ω² of every shape, and the mass between it and the segment's coordinates, so many.
    pub fn each(&self, coordinates: usize) -> impl Iterator<Item = (f64, &[f64])> {
        let couplings = move |k: usize| &self.couplings[k * coordinates..(k + 1) * coordinates];
        let shapes = self.squares.iter().enumerate();
        shapes.map(move |(k, square)| (*square, couplings(k)))
    }
}

/// What asks for too much room where masses depend on many coordinates.
const COUPLINGS: &str = "its masses at the ends of chains of rigid bodies";

impl MassPlan {
    /// Of a divided model: a mass a segment, then those of the nodes.
    pub fn new(plan: &Plan, model: &Model) -> Result<Self, SolveError> {
        let subassemblies = plan.elements.iter().filter_map(|element| {
            let Source::Subassembly(k) = element.source else {
                return None;
            };
            let (id, _) = *plan.topology.subassemblies[k].segments.first()?;
            let body = model.segments()[id.0].body;
            Some((body, element.columns.clone(), element.nodes.clone()))
        });
        let nodes = model.masses().iter().map(|mass| {
            let body = model.nodes()[mass.node.0].body;
            let columns = plan.columns[plan.topology.carrier_of[mass.node.0]].clone();
            let mut ascending = columns.clone();
            ascending.sort_unstable();
            let place = |c: &usize| ascending.partition_point(|other| other < c);
            let places = columns.iter().map(place).collect();
            (body, ascending, vec![(mass.node, places)])
        });
        let mut holders: Vec<Holder> = subassemblies
            .chain(nodes)
            .map(|(body, columns, nodes)| Holder {
                body,
                columns,
                nodes,
                places: Vec::new(),
            })
            .collect();
        let elements = plan.elements.iter().map(|e| &e.columns[..]);
        let groups = elements
            .clone()
            .chain(holders.iter().map(|h| &h.columns[..]));
        let unknowns = plan.unknowns;
        let couplings = groups.clone().map(|group| group.len() * group.len());
        room::check(COUPLINGS, room::sum(couplings), MOST_NUMBERS)?;
        let pattern = Pattern::new(unknowns, groups, None)?;
        let stiffness_places = elements.flat_map(|c| places(&pattern, c)).collect();
        for holder in &mut holders {
            holder.places = places(&pattern, &holder.columns).collect();
        }
        Ok(Self {
            pattern,
            stiffness_places,
            holders,
        })
    }

    /// Assembled stiffness `Σ Dᵀ k D`.
    pub fn stiffness(&self, plan: &Plan, workspace: &Workspace) -> Vec<f64> {
        let mut values = vec![0.0; self.pattern.len()];
        let mut scratch = Vec::new();
        let mut rest = &self.stiffness_places[..];
        for element in &plan.elements {
            let (rows, count) = (element.rows, element.columns.len());
            let start = element.operator_start;
            let operator = &workspace.operators[start..start + rows * count];
            let start = element.stiffness_start;
            let matrix = &workspace.stiffnesses[start..start + rows * rows];
            let (own, others) = rest.split_at(count * (count + 1) / 2);
            rest = others;
            add(&mut values, own, rows, operator, matrix, &mut scratch);
        }
        values
    }

    /// Assembled mass.
    pub fn mass(&self, masses: &Masses) -> Vec<f64> {
        let mut values = vec![0.0; self.pattern.len()];
        let mut scratch = Vec::new();
        for (holder, element) in self.holders.iter().zip(&masses.elements) {
            let (rows, operator) = (element.rows, &element.operator);
            add(
                &mut values,
                &holder.places,
                rows,
                operator,
                &element.mass,
                &mut scratch,
            );
        }
        values
    }

    /// The masses in a configuration of the divided model, whose segments are these members.
    pub fn elements(
        &self,
        plan: &Plan,
        at: &Posture<'_>,
        workspace: &Workspace,
        members: &Members,
    ) -> Result<Masses, SolveError> {
        let (mut total, mut inner) = (0.0, plan.unknowns);
        let mut elements = Vec::with_capacity(self.holders.len());
        let mut holders = self.holders.iter();
        for (k, (member, holder)) in members.all.iter().zip(&mut holders).enumerate() {
            let frame = at.segment_frame(SegmentId(k))?;
            let operator = operator(plan, at.geometry, workspace, holder);
            let mut forces = Vec::with_capacity(12 * member.inner.squares().len());
            for coupling in member.inner.couplings() {
                for node in [0, 6] {
                    let own = coupling.fixed_rows::<6>(node).into_owned();
                    forces.extend(rotate_vector6(&own, &frame).iter());
                }
            }
            let couplings = forces.chunks_exact(12).flat_map(|force| {
                let columns = operator.chunks_exact(12);
                columns.map(|column| dot(column, force)).collect::<Vec<_>>()
            });
            total += total_of(&member.mass);
            elements.push(MassElement {
                rows: 12,
                mass: rotate_matrix12(&member.mass, &frame).as_slice().to_vec(),
                inner: Inner {
                    start: inner,
                    squares: member.inner.squares().to_vec(),
                    couplings: couplings.collect(),
                    forces,
                },
                operator,
            });
            inner += member.inner.squares().len();
        }
        for (mass, holder) in at.model.masses_at(at.geometry).iter().zip(holders) {
            total += mass.mass.mass();
            let about = mass.mass.about(&Vector3::zeros());
            elements.push(MassElement {
                rows: 6 * holder.nodes.len(),
                operator: operator(plan, at.geometry, workspace, holder),
                mass: about.as_slice().to_vec(),
                inner: Inner::default(),
            });
        }
        Ok(Masses {
            elements,
            total,
            size: inner,
        })
    }

    /// What is between the nodes: each element's inner shapes, with its coordinates and the places of
    /// their products in the matrices.
    pub fn inner<'a>(
        &'a self,
        masses: &'a Masses,
    ) -> impl Iterator<Item = (&'a Inner, &'a [usize], &'a [usize])> {
        let holders = self.holders.iter().zip(&masses.elements);
        let all = holders.map(|(holder, e)| (&e.inner, &holder.columns[..], &holder.places[..]));
        all.filter(|(inner, ..)| !inner.squares.is_empty())
    }

    /// Displacement of a node under a vector.
    pub fn displacement(
        &self,
        plan: &Plan,
        workspace: &Workspace,
        geometry: &Geometry,
        node: NodeId,
        x: &[f64],
    ) -> Vector6<f64> {
        let carrier = plan.topology.carrier_of[node.0];
        let block = plan.block(workspace, carrier);
        let columns = plan.columns[carrier].iter().enumerate();
        let at_reference: Vector6<f64> = columns.map(|(k, c)| read(block, 6 * k) * x[*c]).sum();
        shift(geometry, plan.topology.carriers[carrier].reference, node) * at_reference
    }

    /// Of a vector of unit modal mass: its participation in a translation of everything along x,
    /// y and z \[√kg\], and twice the kinetic energy of every body at ω = 1.
    pub fn shares(&self, masses: &Masses, bodies: usize, x: &[f64]) -> (Vector3<f64>, Vec<f64>) {
        let mut participation = Vector3::zeros();
        let mut energies = vec![0.0; bodies];
        for (holder, element) in self.holders.iter().zip(&masses.elements) {
            let mut moved = vec![0.0; element.rows];
            let columns = element.operator.chunks_exact(element.rows);
            for (c, column) in holder.columns.iter().zip(columns) {
                crate::plan::blocks::subtract(&mut moved, -x[*c], column);
            }
            let mut force = vec![0.0; element.rows];
            multiply(&element.mass, &moved, element.rows, &mut force);
            energies[holder.body.0] += dot(&moved, &force);
            let inner = &element.inner;
            let amounts = &x[inner.start..][..inner.squares.len()];
            for (amount, coupled) in amounts.iter().zip(inner.forces.chunks_exact(element.rows)) {
                energies[holder.body.0] += amount * (2.0 * dot(coupled, &moved) + amount);
                crate::plan::blocks::subtract(&mut force, -amount, coupled);
            }
            for at_node in force.chunks_exact(6) {
                participation += Vector3::from_column_slice(&at_node[..3]);
            }
        }
        (participation, energies)
    }
}

/// Places of all pairs (row ≥ column) of some coordinates, by rows.
fn places<'a>(pattern: &'a Pattern, columns: &'a [usize]) -> impl Iterator<Item = usize> + 'a {
    let rows = columns.iter().enumerate();
    rows.flat_map(move |(b, &row)| columns[..=b].iter().map(move |c| pattern.place(row, *c)))
}

/// Adds `Dᵀ m D` to assembled values.
fn add(
    values: &mut [f64],
    places: &[usize],
    rows: usize,
    operator: &[f64],
    matrix: &[f64],
    scratch: &mut Vec<f64>,
) {
    scratch.clear();
    scratch.resize(operator.len(), 0.0);
    multiply(matrix, operator, rows, scratch);
    let mut places = places.iter();
    for (b, product) in scratch.chunks_exact(rows).enumerate() {
        let columns = operator.chunks_exact(rows).take(b + 1);
        for (column, place) in columns.zip(&mut places) {
            values[*place] += dot(column, product);
        }
    }
}

/// H: displacements of the nodes of a mass by its coordinates.
fn operator(plan: &Plan, geometry: &Geometry, workspace: &Workspace, holder: &Holder) -> Vec<f64> {
    let rows = 6 * holder.nodes.len();
    let mut values = vec![0.0; rows * holder.columns.len()];
    for (r, (node, places)) in holder.nodes.iter().enumerate() {
        let carrier = plan.topology.carrier_of[node.0];
        let to_node = shift(geometry, plan.topology.carriers[carrier].reference, *node);
        let block = plan.block(workspace, carrier);
        for (k, place) in places.iter().enumerate() {
            let column = to_node * read(block, 6 * k);
            let start = rows * place + 6 * r;
            let own = values[start..start + 6].iter_mut();
            own.zip(column.iter())
                .for_each(|(own, value)| *own += value);
        }
    }
    values
}

/// Mass of a segment by its matrix: that of a translation.
fn total_of(mass: &Matrix12) -> f64 {
    mass[(0, 0)] + mass[(0, 6)] + mass[(6, 0)] + mass[(6, 6)]
}
