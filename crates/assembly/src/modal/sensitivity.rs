//! Derivatives of natural frequencies by every parameter of a model.
//!
//! With φᵀ M φ = 1, ∂ω²/∂p = φᵀ (∂K/∂p − ω² ∂M/∂p) φ (Fox and Kapoor 1968). The first part is work:
//! of the section wrenches on the change of the rigidities r, `∫ Wᵀ (c ∂ ln r/∂p) W dx` with the
//! compliances c = 1/r, and `qᵀ (∂k/∂p) q` of a joint; the second is taken mass by mass. Where masses
//! are exact both are taken along the beams in the motion as it is ([`Vibration`]): how the shapes
//! change has no part in it.
//!
//! Equal frequencies have no vectors of their own: theirs are those along which the parameter
//! splits them. Their derivatives are the eigenvalues of the same expression over all of their
//! vectors, Φᵀ (∂K/∂p − ω² ∂M/∂p) Φ (Ojalvo 1988).

use std::f64::consts::TAU;
use std::ops::Range;

use hyperstat_elements::{BeamLoad, MassShape, Matrix12, RotaryInertia, StraightBeam, Vibration};
use hyperstat_model::{BeamMass, Geometry, NodeId, NodeMass};
use nalgebra::{DMatrix, SVector, SymmetricEigen, Vector6};

use super::system::each_deformation;
use crate::error::SolveError;
use crate::modal::member::Member;
use crate::modal::plan::{ModalPlan, hertz};
use crate::modal::ready::Outcome;
use crate::modal::system::{Mode as Found, equal};
use crate::plan::elements::Source;
use crate::response::parameters::{Parameter, SegmentChange, Varied, line_mass, parameters};

/// Eigenvalues ω² that differ by no more than this part are equal. Vectors are good to some 1e-11
/// over the part by which their eigenvalues differ: beyond it to 1e-5 or better. A symmetric
/// mechanism whose points are written with seven digits has equal eigenvalues to about this part.
const EQUAL: f64 = 1e-6;
/// Modes beyond those wanted that are found at once, to see whether the last one has equals.
const SPARE: usize = 3;

/// How natural frequencies answer to the parameters of a model.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct ModalSensitivities {
    /// Natural frequencies \[Hz\], lowest first: those that are asked for, and those that equal
    /// the last of them.
    pub frequencies: Vec<f64>,
    /// Their places in groups of equal ones, lowest first; most groups have one. Eigenvalues ω²
    /// are equal that differ by less than 10⁻⁶ of them.
    pub groups: Vec<Range<usize>>,
    /// Whether all frequencies below the last one were counted, as [`Modes::complete`] says: else a
    /// group may lack one of its frequencies.
    ///
    /// [`Modes::complete`]: crate::Modes::complete
    pub complete: bool,
    /// What each parameter does, those of bodies first, then of joints, then of masses.
    pub parameters: Vec<FrequencySensitivity>,
}

/// How natural frequencies answer to one parameter.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FrequencySensitivity {
    /// The parameter p.
    pub parameter: Parameter,
    /// Its name, where its values have one ([`Model::name_value`](crate::Model::name_value)).
    pub name: Option<String>,
    /// Its value; 1 for a factor.
    pub value: f64,
    /// ∂f/∂p of every frequency of [`ModalSensitivities::frequencies`] \[Hz over the parameter's
    /// unit\]; in a group of equal ones those of the frequencies that they become, ascending. Zero
    /// of a frequency that is zero.
    pub derivatives: Vec<f64>,
}

impl FrequencySensitivity {
    /// How frequencies answer to what has this name and value.
    pub fn new(
        parameter: Parameter,
        name: impl Into<String>,
        value: f64,
        derivatives: Vec<f64>,
    ) -> Self {
        Self {
            parameter,
            name: Some(name.into()),
            value,
            derivatives,
        }
    }

    /// The relative change of a frequency per relative change of the parameter, p/f ∂f/∂p: 0.5
    /// says that 1 % more of it makes the frequency 0.5 % higher. `None` of a frequency that is
    /// zero.
    ///
    /// # Panics
    /// If `place` is none of [`ModalSensitivities::frequencies`], which are those given.
    pub fn relative(&self, frequencies: &[f64], place: usize) -> Option<f64> {
        let frequency = frequencies[place];
        (frequency > 0.0).then(|| self.derivatives[place] * self.value / frequency)
    }
}

impl ModalPlan {
    /// Derivatives of the natural frequencies in a configuration of the model by every parameter
    /// that stiffness or mass depends on. Loads, and the stress that they make, have no part in
    /// frequencies.
    ///
    /// # Errors
    /// As [`ModalPlan::modes`].
    pub fn sensitivities(&self, geometry: &Geometry) -> Result<ModalSensitivities, SolveError> {
        let wanted = self.options.count;
        let mut asked = wanted + SPARE;
        loop {
            let found = self.find(geometry, asked, true, |outcome| {
                let mut groups = equal(&outcome.modes, EQUAL);
                let last = groups.last().map_or(0, |group| group.start);
                if outcome.modes.len() >= asked && last < wanted {
                    return None; // more may be equal to the last that is wanted
                }
                groups.retain(|group| group.start < wanted);
                Some(self.derivatives(&outcome, groups))
            })?;
            match found {
                Some(found) => return found,
                None => asked *= 2,
            }
        }
    }

    fn derivatives(
        &self,
        outcome: &Outcome<'_>,
        groups: Vec<Range<usize>>,
    ) -> Result<ModalSensitivities, SolveError> {
        let count = groups.last().map_or(0, |group| group.end);
        let modes = &outcome.modes[..count];
        let shapes = modes.iter().map(|m| self.shape(outcome, m));
        let shapes: Vec<Shape> = shapes.collect::<Result<_, _>>()?;
        let frequencies: Vec<f64> = modes.iter().map(|mode| hertz(mode.eigenvalue)).collect();
        let sizes = outcome.ready.members.parts.iter();
        let firsts = sizes.scan(0, |next, elements| {
            *next += elements;
            Some(*next - elements)
        });
        let divided = Divided {
            firsts: firsts.collect(),
            masses: outcome.ready.divided.masses_at(&outcome.geometry),
        };
        let mut found = Vec::new();
        for varied in parameters(&self.model)? {
            if matches!(&varied.parameter, Parameter::Material { constant, .. } if *constant == "expansion")
            {
                continue;
            }
            let mut sums = Sums {
                shapes: &shapes,
                groups: &groups,
                matrices: groups
                    .iter()
                    .map(|g| DMatrix::zeros(g.len(), g.len()))
                    .collect(),
            };
            self.add(outcome, &divided, &varied, &mut sums)?;
            let eigenvalues = sums.matrices.into_iter().flat_map(ascending);
            let derivative = |(eigenvalue, frequency): (f64, &f64)| match *frequency {
                0.0 => 0.0,
                frequency => eigenvalue / (2.0 * TAU * TAU * frequency),
            };
            found.push(FrequencySensitivity {
                parameter: varied.parameter,
                name: varied.name,
                value: varied.value,
                derivatives: eigenvalues.zip(&frequencies).map(derivative).collect(),
            });
        }
        Ok(ModalSensitivities {
            frequencies,
            groups,
            complete: outcome.complete,
            parameters: found,
        })
    }

    /// What the modes do to segments, joints and masses.
    fn shape(&self, outcome: &Outcome<'_>, found: &Found) -> Result<Shape, SolveError> {
        let (ready, workspace) = (outcome.ready, &outcome.workspace);
        let plan = &ready.plan;
        let segments = ready.divided.segments();
        let mut shape = Shape {
            eigenvalue: found.eigenvalue,
            wrenches: vec![Vector6::zeros(); segments.len()],
            ends: Vec::with_capacity(segments.len()),
            vibrations: Vec::new(),
            nodes: Vec::new(),
            joints: vec![[Vector6::zeros(); 2]; self.model.joints().len()],
        };
        each_deformation(
            plan,
            workspace,
            &found.vector,
            |element, _, moved, force| {
                match element.source {
                    Source::Subassembly(k) => {
                        // No joint is absorbed: a segment is a subassembly.
                        if let [(segment, _)] = plan.topology.subassemblies[k].segments[..] {
                            shape.wrenches[segment.0].copy_from_slice(force);
                        }
                    }
                    Source::Spring(joint) => {
                        let springs = plan.topology.joints[joint.0].springs;
                        for (row, dof) in springs.iter().enumerate() {
                            let [own_force, own_moved] = &mut shape.joints[joint.0];
                            (own_force[dof.index()], own_moved[dof.index()]) =
                                (force[row], moved[row]);
                        }
                    }
                }
            },
        );
        let nodes = (0..ready.divided.nodes().len()).map(NodeId);
        shape.nodes = nodes
            .map(|node| outcome.displacement(node, found))
            .collect();
        let curves = outcome.curves(found);
        for (part, segment) in curves.iter().flat_map(|curve| &curve.0).zip(segments) {
            if self.options.mass == BeamMass::Exact {
                let (line, rotary) = (line_mass(segment, 1.0)?, self.options.rotary_inertia);
                let (beam, inner) = (part.member.beam.straight(), &part.member.inner);
                let (ends, amounts) = (&part.ends, &part.amounts);
                let vibration = Vibration::new(&line, beam, rotary, inner, ends, amounts);
                shape.vibrations.push(vibration);
            }
            shape.ends.push(part.ends);
        }
        Ok(shape)
    }

    /// Adds what a parameter does to stiffness and mass.
    fn add(
        &self,
        outcome: &Outcome<'_>,
        divided: &Divided,
        varied: &Varied,
        sums: &mut Sums<'_>,
    ) -> Result<(), SolveError> {
        for (id, change) in &varied.segments {
            let members = &outcome.ready.members;
            let count = members.parts[id.0];
            let mut whole = None;
            for k in 0..count {
                let own = divided.firsts[id.0] + k;
                let part = ElementShape {
                    own,
                    member: &members.all[own],
                    change,
                    place: k,
                    count,
                };
                if self.options.mass == BeamMass::Exact {
                    let density = self.model.segments()[id.0].material.density();
                    part.add_vibration(density.unwrap_or(0.0), sums);
                    continue;
                }
                // Equal parts of a segment that does not change have equal masses.
                let mass = match (&whole, change) {
                    (Some(mass), SegmentChange::Section(_) | SegmentChange::Density) => *mass,
                    _ => self.mass_change(outcome, &part)?,
                };
                whole = (self.model.segments()[id.0].taper.is_none()).then_some(mass);
                self.add_part(&part, mass.as_ref(), sums);
            }
        }
        match &varied.parameter {
            Parameter::Joint { direction, joints } => sums.add(|a, b| {
                let work = joints.iter().map(|joint| {
                    let ([_, q], [force, own]) = (&a.joints[joint.0], &b.joints[joint.0]);
                    match direction {
                        Some(dof) => q[dof.index()] * own[dof.index()],
                        None => q.dot(force),
                    }
                });
                work.sum()
            }),
            Parameter::Mass { mass, inertia } => {
                let own = &divided.masses[*mass];
                sums.add(|a, b| {
                    let [a_node, b_node] = [a, b].map(|shape| shape.nodes[own.node.0]);
                    let start = if *inertia { 3 } else { 0 };
                    let [u, v] = [a_node, b_node].map(|u| u.fixed_rows::<3>(start).into_owned());
                    let energy = match inertia {
                        true => u.dot(&(own.mass.inertia() * v)),
                        false => u.dot(&v),
                    };
                    -mean(a, b) * energy
                });
            }
            _ => {}
        }
        Ok(())
    }

    fn add_part(&self, part: &ElementShape<'_>, mass: Option<&Matrix12>, sums: &mut Sums<'_>) {
        let place = part.own;
        let elastic = !matches!(part.change, SegmentChange::Density);
        let local = |shape: &Shape| {
            let [first, second] = &shape.ends[place];
            SVector::<f64, 12>::from_fn(|row, _| if row < 6 { first[row] } else { second[row - 6] })
        };
        let weight = |xi| part.change.rigidities(part.along(xi));
        sums.add(|a, b| {
            let mut sum = 0.0;
            if elastic {
                let none = BeamLoad::none();
                let beam = part.member.beam.straight();
                let (own, other) = (&a.wrenches[place], &b.wrenches[place]);
                sum += beam.elastic_work(own, &none, other, &weight).sum();
            }
            if let Some(mass) = mass {
                sum -= mean(a, b) * local(a).dot(&(mass * local(b)));
            }
            sum
        });
    }

    /// Derivative of the mass matrix of a part of a segment, element frame; `None`: there is none.
    fn mass_change(
        &self,
        outcome: &Outcome<'_>,
        part: &ElementShape<'_>,
    ) -> Result<Option<Matrix12>, SolveError> {
        let options = &self.options;
        let segment = &outcome.ready.divided.segments()[part.own];
        let beam: &dyn StraightBeam = part.member.beam.straight();
        let density = segment.material.density().unwrap_or(0.0);
        let lumped = options.mass == BeamMass::Lumped;
        let (shape, rotary) = (options.shape, options.rotary_inertia);
        let fixed = (MassShape::Cubic, RotaryInertia::Left);
        let sections = |xi| part.change.sections(part.along(xi));
        let rigidities = |xi| part.change.rigidities(part.along(xi));
        Ok(match part.change {
            SegmentChange::Expansion => None,
            SegmentChange::Density => {
                let unit = line_mass(segment, 1.0)?;
                Some(match lumped {
                    true => unit.lumped(beam.length()),
                    false => unit.consistent(beam, shape, rotary),
                })
            }
            // Elastic constants only change the beam's own shapes.
            SegmentChange::Elastic(_) if lumped || (shape, rotary) == fixed => None,
            _ => {
                let line = line_mass(segment, density)?;
                Some(match lumped {
                    true => line.lumped_derivative(beam.length(), &sections),
                    false => {
                        line.consistent_derivative(beam, shape, rotary, &sections, &rigidities)
                    }
                })
            }
        })
    }
}

/// The divided model beside the model.
struct Divided {
    /// First part of every segment.
    firsts: Vec<usize>,
    /// Masses of nodes, in this configuration.
    masses: Vec<NodeMass>,
}

/// A part of a segment of the model, one of the divided model.
struct ElementShape<'a> {
    /// Its number among all.
    own: usize,
    member: &'a Member,
    change: &'a SegmentChange,
    /// Number of the part, from 0, of how many.
    place: usize,
    count: usize,
}

impl ElementShape<'_> {
    /// Place along the whole segment.
    fn along(&self, xi: f64) -> f64 {
        (self.place as f64 + xi) / self.count as f64
    }

    /// Adds what the change does to the part in its motion.
    fn add_vibration(&self, density: f64, sums: &mut Sums<'_>) {
        let rigidities = |xi| self.change.rigidities(self.along(xi));
        let sections = |xi| self.change.sections(self.along(xi));
        sums.add(|a, b| {
            let [own, other] = [a, b].map(|shape| &shape.vibrations[self.own]);
            let mass = match self.change {
                SegmentChange::Density => own.mass_work(other, &|_| Vector6::repeat(1.0)),
                SegmentChange::Elastic(_) | SegmentChange::Expansion => 0.0,
                _ => density * own.mass_work(other, &sections),
            };
            let elastic = match self.change {
                SegmentChange::Density | SegmentChange::Expansion => 0.0,
                _ => own.elastic_work(other, &rigidities),
            };
            elastic - mean(a, b) * mass
        });
    }
}

/// What a mode of unit modal mass does.
struct Shape {
    eigenvalue: f64,
    /// Wrench on every part of a segment at its second node, element frame.
    wrenches: Vec<Vector6<f64>>,
    /// Displacements of its nodes, element frame.
    ends: Vec<[Vector6<f64>; 2]>,
    /// Its motion along it, where masses are exact.
    vibrations: Vec<Vibration>,
    /// Displacement of every node, global axes.
    nodes: Vec<Vector6<f64>>,
    /// Force and deflection along every joint's elastic directions.
    joints: Vec<[Vector6<f64>; 2]>,
}

/// ∂K/∂p − ω² ∂M/∂p over the modes of every group.
struct Sums<'a> {
    shapes: &'a [Shape],
    groups: &'a [Range<usize>],
    matrices: Vec<DMatrix<f64>>,
}

impl Sums<'_> {
    /// Adds a symmetric expression of two modes.
    fn add(&mut self, of: impl Fn(&Shape, &Shape) -> f64) {
        for (group, matrix) in self.groups.iter().zip(&mut self.matrices) {
            let shapes = &self.shapes[group.clone()];
            for (r, first) in shapes.iter().enumerate() {
                for (c, second) in shapes.iter().enumerate().take(r + 1) {
                    let entry = of(first, second);
                    matrix[(r, c)] += entry;
                    if r != c {
                        matrix[(c, r)] += entry;
                    }
                }
            }
        }
    }
}

/// ω² of two modes of a group.
fn mean(a: &Shape, b: &Shape) -> f64 {
    (a.eigenvalue + b.eigenvalue) / 2.0
}

/// Eigenvalues of a symmetric matrix, ascending.
fn ascending(matrix: DMatrix<f64>) -> Vec<f64> {
    let mut values: Vec<f64> = SymmetricEigen::new(matrix)
        .eigenvalues
        .iter()
        .copied()
        .collect();
    values.sort_by(f64::total_cmp);
    values
}
