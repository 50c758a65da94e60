//! One walk over a mechanism's parts, which both builds its model and brings a geometry to a
//! pose: a mechanism names its parts once, so the two cannot differ.

use std::fmt;

use hyperstat_assembly::{Connection, Geometry, JointStiffness, Model, ModelError, NodeId};
use hyperstat_elements::element_frame;
use hyperstat_joints::{Dof, DofSet, Joint};
use nalgebra::{Point3, Rotation3, Vector3};

use super::{Link, PoseError, check_numbering};

/// Name of a body, point or joint: a word and, where it belongs to a limb, the limb's number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Name(pub(super) &'static str, pub(super) Option<usize>);

impl Name {
    /// A name of limb `index`, counted from 0; the name's number counts from 1.
    pub(super) const fn limb(word: &'static str, index: usize) -> Self {
        Self(word, Some(index + 1))
    }

    /// A name that belongs to no limb.
    pub(super) const fn alone(word: &'static str) -> Self {
        Self(word, None)
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)?;
        self.1.map_or(Ok(()), |number| write!(f, "{number}"))
    }
}

/// A named point (m).
pub(super) type NamedPoint = (Name, Point3<f64>);

/// A beam through points, of one section and material.
pub(super) struct BeamPart<'a> {
    pub(super) name: Name,
    pub(super) points: &'a [NamedPoint],
    pub(super) link: &'a Link,
    /// Direction of local y.
    pub(super) y_axis: Vector3<f64>,
    /// Elements a segment is divided into.
    pub(super) elements: usize,
}

/// A joint at a point that both its bodies have.
pub(super) struct JointPart<'a> {
    pub(super) name: Name,
    pub(super) at: Name,
    /// First and second body; `None` is the ground.
    pub(super) between: [Option<Name>; 2],
    pub(super) joint: &'a dyn Joint,
    /// Columns are the frame's x, y and z.
    pub(super) frame: Rotation3<f64>,
    /// A drive: its free directions are held.
    pub(super) locked: bool,
    /// As in [`JointStiffness::Directions`].
    pub(super) stiffness: [Option<f64>; 6],
}

/// Where the parts of a mechanism go, in the order of its model.
pub(super) trait Parts {
    /// An elastic body.
    fn beam(&mut self, beam: &BeamPart<'_>) -> Result<(), PoseError>;
    /// A rigid body.
    fn rigid(&mut self, name: Name, points: &[NamedPoint]) -> Result<(), PoseError>;
    /// A joint.
    fn joint(&mut self, joint: &JointPart<'_>) -> Result<(), PoseError>;
}

/// The model made by `walk`; its output is the first point of the body `output`.
pub(super) fn model(
    name: &str,
    output: Name,
    walk: impl Fn(&mut dyn Parts) -> Result<(), PoseError>,
) -> Result<Model, PoseError> {
    let mut model = Model::new(name);
    walk(&mut model)?;
    if let Some(body) = model.body(&output.to_string()) {
        let node = model.bodies()[body.0].nodes[0];
        model.set_output(node);
    }
    Ok(model)
}

/// Writes what `walk` gives into `geometry`; changes nothing where it fails.
pub(super) fn place(
    geometry: &mut Geometry,
    walk: impl Fn(&mut dyn Parts) -> Result<(), PoseError>,
) -> Result<(), PoseError> {
    let mut counts = Counts::default();
    walk(&mut counts)?;
    check_numbering(geometry, [counts.nodes, counts.segments, counts.joints])?;
    walk(&mut Writer {
        geometry,
        next: Counts::default(),
    })
}

impl Parts for Model {
    fn beam(&mut self, beam: &BeamPart<'_>) -> Result<(), PoseError> {
        let points = named(beam.points);
        self.add_beam(
            &beam.name.to_string(),
            &borrowed(&points),
            &beam.link.material,
            &beam.link.section,
            Some(beam.y_axis),
            beam.elements,
        )?;
        Ok(())
    }

    fn rigid(&mut self, name: Name, points: &[NamedPoint]) -> Result<(), PoseError> {
        let points = named(points);
        self.add_rigid(&name.to_string(), &borrowed(&points))?;
        Ok(())
    }

    fn joint(&mut self, part: &JointPart<'_>) -> Result<(), PoseError> {
        let point = part.at.to_string();
        let node = |body: Option<Name>| -> Option<NodeId> {
            let node = self.node(&body?.to_string(), &point);
            debug_assert!(node.is_some(), "{} has no point {point}", part.name);
            node
        };
        let connection = Connection {
            name: part.name.to_string(),
            between: part.between.map(node),
            joint: part.joint.clone_box(),
            locked: if part.locked {
                part.joint.free()
            } else {
                DofSet::EMPTY
            },
            stiffness: JointStiffness::Directions(part.stiffness),
        };
        self.add_joint(connection, part.frame)?;
        Ok(())
    }
}

fn named(points: &[NamedPoint]) -> Vec<(String, Point3<f64>)> {
    let name = |(name, at): &NamedPoint| (name.to_string(), *at);
    points.iter().map(name).collect()
}

fn borrowed(points: &[(String, Point3<f64>)]) -> Vec<(&str, Point3<f64>)> {
    points
        .iter()
        .map(|(name, at)| (name.as_str(), *at))
        .collect()
}

/// Counts the parts, and refuses those that a model would refuse.
#[derive(Debug, Default)]
struct Counts {
    nodes: usize,
    segments: usize,
    joints: usize,
}

impl Parts for Counts {
    fn beam(&mut self, beam: &BeamPart<'_>) -> Result<(), PoseError> {
        for (segment, ends) in beam.points.windows(2).enumerate() {
            element_frame(&(ends[1].1 - ends[0].1), Some(&beam.y_axis)).map_err(|source| {
                ModelError::Segment {
                    body: beam.name.to_string(),
                    segment,
                    source,
                }
            })?;
            self.segments += 1;
        }
        self.nodes += beam.points.len();
        Ok(())
    }

    fn rigid(&mut self, _: Name, points: &[NamedPoint]) -> Result<(), PoseError> {
        self.nodes += points.len();
        Ok(())
    }

    fn joint(&mut self, _: &JointPart<'_>) -> Result<(), PoseError> {
        self.joints += 1;
        Ok(())
    }
}

/// Writes the parts into a geometry whose numbers of parts were checked.
struct Writer<'g> {
    geometry: &'g mut Geometry,
    next: Counts,
}

impl Writer<'_> {
    fn positions(&mut self, points: &[NamedPoint]) {
        for (_, at) in points {
            self.geometry.positions[self.next.nodes] = *at;
            self.next.nodes += 1;
        }
    }
}

impl Parts for Writer<'_> {
    fn beam(&mut self, beam: &BeamPart<'_>) -> Result<(), PoseError> {
        self.positions(beam.points);
        for _ in 1..beam.points.len() {
            self.geometry.y_axes[self.next.segments] = Some(beam.y_axis);
            self.next.segments += 1;
        }
        Ok(())
    }

    fn rigid(&mut self, _: Name, points: &[NamedPoint]) -> Result<(), PoseError> {
        self.positions(points);
        Ok(())
    }

    fn joint(&mut self, joint: &JointPart<'_>) -> Result<(), PoseError> {
        self.geometry.frames[self.next.joints] = joint.frame;
        self.next.joints += 1;
        Ok(())
    }
}

/// Stiffness of a joint from that of all: only the directions that the joint constrains.
pub(super) fn constrained_stiffness(
    joint: &dyn Joint,
    stiffness: [Option<f64>; 6],
) -> [Option<f64>; 6] {
    let free = joint.free();
    Dof::ALL.map(|d| stiffness[d.index()].filter(|_| !free.contains(d)))
}

/// Stiffness of a revolute joint from that of all, with `axis` about its axis (N·m/rad).
pub(super) fn revolute_stiffness(
    mut stiffness: [Option<f64>; 6],
    axis: Option<f64>,
) -> [Option<f64>; 6] {
    stiffness[Dof::V.index()] = axis;
    stiffness
}

/// Stiffness of a rigid guide, with `axis` along it (N/m).
pub(super) fn prismatic_stiffness(axis: Option<f64>) -> [Option<f64>; 6] {
    let mut stiffness = [None; 6];
    stiffness[Dof::Y.index()] = axis;
    stiffness
}
