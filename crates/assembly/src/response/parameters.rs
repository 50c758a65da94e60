//! The parameters of a model, and what each of them changes.

use hyperstat_elements::{BeamLoad, LineMass, Material, Section, Taper, TemperatureChange};
use hyperstat_joints::Dof;
use hyperstat_model::{
    BodyId, Directions, JointId, JointStiffness, Model, Segment, SegmentId, Tapering, ValuePlace,
};
use nalgebra::{Vector3, Vector6};

use crate::error::SolveError;

/// A parameter. Equal sections, materials and elastic joints count as one: it changes all of them,
/// unless their values have different names ([`Model::name_value`]).
#[derive(Debug, Clone, PartialEq)]
pub enum Parameter {
    /// A dimension of a section.
    Section {
        /// The section.
        section: Section,
        /// Whether it is the one that the change of segments that taper ends with.
        second: bool,
        /// Name of the dimension, as in files.
        dimension: &'static str,
        /// Bodies that have the section.
        bodies: Vec<BodyId>,
    },
    /// A constant of a material.
    Material {
        /// The material.
        material: Material,
        /// Name of the constant, as in files; the others stay as they are.
        constant: &'static str,
        /// Bodies that are of the material.
        bodies: Vec<BodyId>,
    },
    /// A stiffness of joints.
    Joint {
        /// The direction; `None`: a factor on the whole of a stiffness matrix.
        direction: Option<Dof>,
        /// Joints of one kind with the same stiffness.
        joints: Vec<JointId>,
    },
    /// A mass of a node.
    Mass {
        /// Its place among [`Model::masses`].
        mass: usize,
        /// Whether it is a factor on its inertia; else it is its mass \[kg\], without that.
        inertia: bool,
    },
}

impl Parameter {
    /// Whether stiffness depends on it.
    pub(crate) fn is_elastic(&self) -> bool {
        match self {
            Self::Mass { .. } => false,
            Self::Material { constant, .. } => !matches!(*constant, "density" | "expansion"),
            _ => true,
        }
    }
}

/// A parameter with its value, and the segments that it changes.
#[derive(Debug)]
pub(crate) struct Varied {
    pub parameter: Parameter,
    /// Name of its value, where it has one.
    pub name: Option<String>,
    /// 1 for a factor.
    pub value: f64,
    pub segments: Vec<(SegmentId, SegmentChange)>,
}

/// How a segment changes with a parameter p.
#[derive(Debug)]
pub(crate) enum SegmentChange {
    /// By a dimension of its section: ∂ ln (A, A_y, A_z, J, I_y, I_z)/∂p.
    Section(Vector6<f64>),
    /// By a dimension at one end of a taper, of which the segment has a part.
    Taper {
        whole: Box<Taper>,
        tapering: Box<Tapering>,
        second: bool,
        dimension: &'static str,
    },
    /// By an elastic constant: ∂ ln (E, G, G, G, E, E)/∂p.
    Elastic(Vector6<f64>),
    /// By its density.
    Density,
    /// By its coefficient of expansion.
    Expansion,
}

impl SegmentChange {
    /// ∂ ln (EA, GA_y, GA_z, GJ, EI_y, EI_z)/∂p at `xi` along the segment.
    pub fn rigidities(&self, xi: f64) -> Vector6<f64> {
        match self {
            Self::Elastic(change) => *change,
            _ => self.sections(xi),
        }
    }

    /// ∂ ln (A, A_y, A_z, J, I_y, I_z)/∂p at `xi` along the segment.
    pub fn sections(&self, xi: f64) -> Vector6<f64> {
        match self {
            Self::Section(change) => *change,
            Self::Taper {
                whole,
                tapering,
                second,
                dimension,
            } => whole.logarithmic_derivative(*second, dimension, tapering.along(xi)),
            Self::Elastic(_) | Self::Density | Self::Expansion => Vector6::zeros(),
        }
    }

    /// Derivative of what acts along the segment, element frame: of its weight under this
    /// acceleration (element frame), and of the free strain by this change of temperature \[K\].
    ///
    /// # Errors
    /// A section that cannot be formed, which no segment of a model has.
    pub fn load(
        &self,
        segment: &Segment,
        gravity: &Vector3<f64>,
        temperature: f64,
    ) -> Result<Option<BeamLoad>, SolveError> {
        if let Self::Expansion = self {
            let uniform = temperature;
            let change = TemperatureChange {
                uniform,
                ..TemperatureChange::default()
            };
            let loaded = temperature != 0.0;
            return Ok(loaded.then(|| BeamLoad::temperature(1.0, &change)));
        }
        if matches!(self, Self::Elastic(_)) || *gravity == Vector3::zeros() {
            return Ok(None);
        }
        let density = match self {
            Self::Density => 1.0,
            _ => segment.material.density().unwrap_or(0.0),
        };
        let mass = line_mass(segment, density)?;
        Ok(Some(match self {
            Self::Density => mass.weight(gravity),
            _ => mass.weight_derivative(gravity, &|xi| self.sections(xi)),
        }))
    }
}

/// The mass along a segment, were it of this density \[kg/m³\].
pub(crate) fn line_mass(segment: &Segment, density: f64) -> Result<LineMass, SolveError> {
    Ok(LineMass::new(density, segment.sections_along()?)?)
}

/// All parameters of a model, in the order of its segments, joints and masses.
///
/// # Errors
/// A section that cannot taper as it says, which no segment of a model has.
pub(crate) fn parameters(model: &Model) -> Result<Vec<Varied>, SolveError> {
    let mut found = Vec::new();
    of_sections(model, &mut found)?;
    of_materials(model, &mut found);
    of_joints(model, &mut found);
    for (mass, own) in model.masses().iter().enumerate() {
        let turns = own.mass.inertia().amax() > 0.0;
        let values = [(false, Some(own.mass.mass())), (true, turns.then_some(1.0))];
        for (inertia, value) in values {
            let name = model.value_name(ValuePlace::Mass { mass });
            let name = name.filter(|_| !inertia).map(Into::into);
            found.extend(value.map(|value| Varied {
                parameter: Parameter::Mass { mass, inertia },
                name,
                value,
                segments: Vec::new(),
            }));
        }
    }
    // What is not all of the values of a name does not have it.
    let names: Vec<_> = found.iter().map(|varied| varied.name.clone()).collect();
    for varied in &mut found {
        let same = || names.iter().filter(|name| **name == varied.name);
        if varied.name.is_some() && same().count() > 1 {
            varied.name = None;
        }
    }
    Ok(found)
}

fn of_sections(model: &Model, found: &mut Vec<Varied>) -> Result<(), SolveError> {
    let segments = model.segments();
    for second in [false, true] {
        let section = |k: usize| {
            if second {
                segments[k].taper.as_ref().map(|tapering| &tapering.to)
            } else {
                Some(&segments[k].section)
            }
        };
        // A section of a segment that tapers is another parameter than the same one all along.
        let key = |k: usize| section(k).map(|s| (s, segments[k].taper.is_some()));
        for group in groups(segments.len(), |a, b| key(a) == key(b)) {
            let Some(own) = section(group[0]) else {
                continue;
            };
            for (dimension, value) in own.dimensions() {
                let change = |k: &usize| -> Result<_, SolveError> {
                    let segment = &segments[*k];
                    let Some(tapering) = &segment.taper else {
                        let change = own.logarithmic_derivative(dimension);
                        return Ok((SegmentId(*k), SegmentChange::Section(change)));
                    };
                    // Its parts in several segments are one parameter.
                    let whole = Taper::new(segment.section.clone(), tapering.to.clone())?;
                    let change = SegmentChange::Taper {
                        whole: Box::new(whole),
                        tapering: Box::new(tapering.clone()),
                        second,
                        dimension,
                    };
                    Ok((SegmentId(*k), change))
                };
                let place = |k: usize| ValuePlace::Dimension {
                    segment: SegmentId(k),
                    second,
                    dimension,
                };
                for (name, part) in by_name(model, &group, place) {
                    found.push(Varied {
                        parameter: Parameter::Section {
                            section: own.clone(),
                            second,
                            dimension,
                            bodies: bodies(model, &part),
                        },
                        name,
                        value,
                        segments: part.iter().map(change).collect::<Result<_, _>>()?,
                    });
                }
            }
        }
    }
    Ok(())
}

fn of_materials(model: &Model, found: &mut Vec<Varied>) {
    let segments = model.segments();
    let same = |a: usize, b: usize| {
        let [a, b] = [a, b].map(|k| &segments[k].material);
        a.constants() == b.constants()
    };
    for group in groups(segments.len(), same) {
        let material = &segments[group[0]].material;
        for (constant, value) in material.constants() {
            let change = || match constant {
                "density" => SegmentChange::Density,
                "expansion" => SegmentChange::Expansion,
                _ => SegmentChange::Elastic(material.logarithmic_derivative(constant)),
            };
            let place = |k: usize| ValuePlace::Constant {
                segment: SegmentId(k),
                constant,
            };
            for (name, part) in by_name(model, &group, place) {
                found.push(Varied {
                    parameter: Parameter::Material {
                        material: material.clone(),
                        constant,
                        bodies: bodies(model, &part),
                    },
                    name,
                    value,
                    segments: part.iter().map(|k| (SegmentId(*k), change())).collect(),
                });
            }
        }
    }
}

fn of_joints(model: &Model, found: &mut Vec<Varied>) {
    let joints = model.joints();
    let elastic: Vec<_> = joints.iter().map(|j| Directions::of(j).elastic).collect();
    let same = |a: usize, b: usize| {
        joints[a].stiffness == joints[b].stiffness
            && joints[a].joint.kind() == joints[b].joint.kind()
            && joints[a].joint.basis() == joints[b].joint.basis()
            && joints[a].joint.compliance() == joints[b].joint.compliance()
            && elastic[a] == elastic[b]
    };
    for group in groups(joints.len(), same) {
        let given = match &joints[group[0]].stiffness {
            JointStiffness::Directions(values) => *values,
            JointStiffness::Matrix(_) => [None; 6],
        };
        let elastic = elastic[group[0]];
        if elastic.is_empty() {
            continue;
        }
        let parameters: Vec<_> = match given.iter().any(Option::is_some) {
            true => (elastic.iter())
                .filter_map(|dof| Some((Some(dof), given[dof.index()]?)))
                .collect(),
            false => vec![(None, 1.0)],
        };
        for (direction, value) in parameters {
            let parts = match direction {
                None => vec![(None, group.clone())],
                Some(direction) => by_name(model, &group, |k| ValuePlace::Stiffness {
                    joint: JointId(k),
                    direction,
                }),
            };
            for (name, part) in parts {
                add_joints(found, name, direction, value, &part);
            }
        }
    }
}

/// Adds a stiffness of joints: to that of others, of another kind, where it has the same name.
fn add_joints(
    found: &mut Vec<Varied>,
    name: Option<String>,
    direction: Option<Dof>,
    value: f64,
    joints: &[usize],
) {
    let joints: Vec<_> = joints.iter().map(|k| JointId(*k)).collect();
    let same = found.iter_mut().find_map(|other| {
        let named = name.is_some() && other.name == name;
        match &mut other.parameter {
            Parameter::Joint {
                direction: own,
                joints,
            } if named && *own == direction => Some(joints),
            _ => None,
        }
    });
    match same {
        Some(others) => {
            others.extend(joints);
            others.sort_unstable();
        }
        None => found.push(Varied {
            parameter: Parameter::Joint { direction, joints },
            name,
            value,
            segments: Vec::new(),
        }),
    }
}

/// Parts of a group whose values have the same name, or none.
fn by_name(
    model: &Model,
    group: &[usize],
    place: impl Fn(usize) -> ValuePlace,
) -> Vec<(Option<String>, Vec<usize>)> {
    let name = |k: usize| model.value_name(place(group[k]));
    let parts = groups(group.len(), |a, b| name(a) == name(b)).into_iter();
    parts
        .map(|part| {
            let own = name(part[0]).map(Into::into);
            (own, part.iter().map(|k| group[*k]).collect())
        })
        .collect()
}

/// Bodies that these segments are of.
fn bodies(model: &Model, segments: &[usize]) -> Vec<BodyId> {
    let mut bodies: Vec<_> = (segments.iter())
        .map(|k| model.segments()[*k].body)
        .collect();
    bodies.dedup();
    bodies
}

/// The numbers below `count` in groups of those that are the same, in the order of their firsts.
fn groups(count: usize, same: impl Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for k in 0..count {
        match groups.iter_mut().find(|group| same(group[0], k)) {
            Some(group) => group.push(k),
            None => groups.push(vec![k]),
        }
    }
    groups
}
