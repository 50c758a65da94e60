//! Mass over the independent displacement coordinates: M = Σ Hᵀ m H over beams and masses of
//! nodes, with the same mappings H as the stiffness.

use hyperstat_elements::rotate_matrix12;
use hyperstat_model::{
    BeamMass, BodyId, Geometry, ModalOptions, Model, NodeId, SegmentId, segment_beam,
};
use nalgebra::{Vector3, Vector6};

use crate::error::SolveError;
use crate::plan::Plan;
use crate::plan::blocks::{dot, multiply, read, shift};
use crate::plan::elements::Source;
use crate::plan::sparse::Pattern;
use crate::plan::workspace::Workspace;
use crate::response::parameters::line_mass;
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
}

/// A mass in one configuration: its nodes' displacements H U, and the mass matrix over them.
struct MassElement {
    rows: usize,
    operator: Vec<f64>,
    mass: Vec<f64>,
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

    /// The masses in a configuration of the divided model, whose segments stand in groups of
    /// `parts`.
    pub fn elements(
        &self,
        plan: &Plan,
        model: &Model,
        geometry: &Geometry,
        workspace: &Workspace,
        parts: impl Iterator<Item = usize>,
        options: &ModalOptions,
    ) -> Result<Masses, SolveError> {
        let mut masses: Vec<Vec<f64>> = Vec::with_capacity(self.holders.len());
        for count in parts {
            let first = masses.len();
            for k in first..first + count {
                // Equal parts of a segment that does not change have equal masses.
                let mass = match model.segments()[k].taper {
                    None if k > first => masses[first].clone(),
                    _ => segment_mass(model, geometry, SegmentId(k), options)?,
                };
                masses.push(mass);
            }
        }
        let mut total: f64 = masses.iter().map(|mass| total_of(mass)).sum();
        for mass in model.masses_at(geometry) {
            total += mass.mass.mass();
            let about = mass.mass.about(&Vector3::zeros());
            masses.push(about.as_slice().to_vec());
        }
        let elements = self
            .holders
            .iter()
            .zip(masses)
            .map(|(holder, mass)| MassElement {
                rows: 6 * holder.nodes.len(),
                operator: operator(plan, geometry, workspace, holder),
                mass,
            });
        Ok(Masses {
            elements: elements.collect(),
            total,
        })
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

/// Mass matrix of a segment over its two nodes, global axes.
fn segment_mass(
    model: &Model,
    geometry: &Geometry,
    id: SegmentId,
    options: &ModalOptions,
) -> Result<Vec<f64>, SolveError> {
    let segment = &model.segments()[id.0];
    let (beam, frame, span) = segment_beam(model, geometry, id)?;
    let density = segment.material.density();
    let density = density.ok_or_else(|| SolveError::NoDensity {
        body: model.bodies()[segment.body.0].name.clone(),
    })?;
    let line = line_mass(segment, density)?;
    let (shape, rotary) = (options.shape, options.rotary_inertia);
    let mass = match options.mass {
        BeamMass::Lumped => line.lumped(span.norm()),
        BeamMass::Consistent => line.consistent(beam.straight(), shape, rotary),
    };
    Ok(rotate_matrix12(&mass, &frame).as_slice().to_vec())
}

/// Mass of a segment by its matrix: that of a translation.
fn total_of(mass: &[f64]) -> f64 {
    let entry = |r: usize, c: usize| mass[12 * c + r];
    entry(0, 0) + entry(0, 6) + entry(6, 0) + entry(6, 6)
}
