//! One walk over a mechanism's parts, which both builds its model and brings a geometry to a
//! pose: a mechanism names its parts once, so the two cannot differ.

use std::{fmt, slice};

use hyperstat_joints::{Dof, DofSet, Joint};
use hyperstat_model::{
    Connection, Geometry, JointId, JointStiffness, Model, ModelError, NodeId, SegmentId, ValuePlace,
};
use nalgebra::{Point3, Rotation3, Vector3};

use crate::prebuilt::{Link, PoseError, check_numbering};

/// Name of a body, point or joint: a word and, where it belongs to a limb, the limb's number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Name(pub(super) &'static str, pub(super) Option<usize>);

impl Name {
    /// A name of limb `index`, counted from 0; the name's number counts from 1.
    #[inline]
    pub(super) const fn limb(word: &'static str, index: usize) -> Self {
        Self(word, Some(index + 1))
    }

    /// A name that belongs to no limb.
    #[inline]
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

/// The body whose first point is the output.
pub(super) const PLATFORM: Name = Name::alone("platform");

/// Stiffness of a joint that is rigid in all directions in which it holds.
pub(super) const RIGID: [Option<f64>; 6] = [None; 6];

/// A named point (m).
pub(super) type NamedPoint = (Name, Point3<f64>);

/// A beam through points, of one section and material.
pub(super) struct BeamPart<'a, const N: usize> {
    pub(super) name: Name,
    pub(super) points: [NamedPoint; N],
    /// Its section and material, and the parameter that they are.
    pub(super) link: (&'static str, &'a Link),
    /// Direction of local y, not along any of its segments.
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
    pub(super) joint: &'static dyn Joint,
    /// Columns are the frame's x, y and z.
    pub(super) frame: Rotation3<f64>,
    /// What the joint does in its free directions.
    free: Free,
    /// In the directions that the joint constrains, as in [`JointStiffness::Directions`]; what is
    /// given for the others is left out.
    pub(super) stiffness: &'a [Option<f64>; 6],
}

impl<'a> JointPart<'a> {
    /// A passive joint, named as its point.
    #[inline]
    pub(super) fn passive(
        joint: &'static dyn Joint,
        name: Name,
        between: [Option<Name>; 2],
        frame: Rotation3<f64>,
        stiffness: &'a [Option<f64>; 6],
    ) -> Self {
        Self {
            name,
            at: name,
            between,
            joint,
            frame,
            free: Free::Passive,
            stiffness,
        }
    }

    /// The joint as a drive of this stiffness (N/m, N·m/rad).
    #[inline]
    pub(super) fn driven(self, stiffness: Option<f64>) -> Self {
        Self {
            free: Free::Drive(stiffness),
            ..self
        }
    }

    /// Its stiffness in every direction.
    fn elasticity(&self) -> [Option<f64>; 6] {
        let free = self.joint.free();
        Dof::ALL.map(|d| match (free.contains(d), self.free) {
            (false, _) => self.stiffness[d.index()],
            (true, Free::Drive(stiffness)) => stiffness,
            (true, Free::Passive) => None,
        })
    }

    /// The joint at a point of another name.
    #[inline]
    pub(super) fn at(self, at: Name) -> Self {
        Self { at, ..self }
    }
}

/// What a joint does in its free directions.
#[derive(Debug, Clone, Copy)]
enum Free {
    /// It moves freely.
    Passive,
    /// A drive: it is locked, rigidly or elastically (N/m, N·m/rad).
    Drive(Option<f64>),
}

/// Where the parts of a mechanism go, in the order of its model.
pub(super) trait Parts {
    /// An elastic body.
    fn beam<const N: usize>(&mut self, beam: BeamPart<'_, N>);
    /// A rigid body.
    fn rigid<const N: usize>(&mut self, name: Name, points: [NamedPoint; N]);
    /// A joint.
    fn joint(&mut self, joint: JointPart<'_>);
}

/// A mechanism at a pose that it can take.
pub(super) trait Configuration {
    /// Hands over all parts; which they are does not depend on the pose.
    fn walk(&self, parts: &mut impl Parts);

    /// The whole pose x y z (m) rx ry rz (rad) of the output.
    fn pose(&self) -> [f64; 6];
}

/// The model of a configuration; its output is the first point of [`PLATFORM`].
pub(super) fn model(name: &str, configuration: &impl Configuration) -> Result<Model, PoseError> {
    let mut builder = Builder(Ok(Model::new(name)));
    configuration.walk(&mut builder);
    let mut model = builder.0?;
    if let Some(body) = model.body(PLATFORM.0) {
        let node = model.bodies()[body.0].nodes[0];
        model.set_output(node);
    }
    Ok(model)
}

/// Writes a configuration into `geometry` and returns its whole pose; changes nothing where it
/// fails.
#[inline]
pub(super) fn place(
    geometry: &mut Geometry,
    configuration: &impl Configuration,
) -> Result<[f64; 6], PoseError> {
    let mut counts = Counts::default();
    configuration.walk(&mut counts);
    check_numbering(geometry, [counts.nodes, counts.segments, counts.joints])?;
    configuration.walk(&mut Writer {
        positions: geometry.positions.iter_mut(),
        y_axes: geometry.y_axes.iter_mut(),
        frames: geometry.frames.iter_mut(),
    });
    Ok(configuration.pose())
}

/// The model so far, or why a part could not be added.
struct Builder(Result<Model, ModelError>);

impl Builder {
    fn add<T>(&mut self, add: impl FnOnce(&mut Model) -> Result<T, ModelError>) {
        if let Ok(model) = &mut self.0
            && let Err(error) = add(model)
        {
            self.0 = Err(error);
        }
    }
}

impl Parts for Builder {
    fn beam<const N: usize>(&mut self, beam: BeamPart<'_, N>) {
        let points = named(&beam.points);
        let (_, link) = beam.link;
        self.add(|model| {
            model.add_beam(
                &beam.name.to_string(),
                &borrowed(&points),
                &link.material,
                &link.section,
                Some(beam.y_axis),
                beam.elements,
            )
        });
    }

    fn rigid<const N: usize>(&mut self, name: Name, points: [NamedPoint; N]) {
        let points = named(&points);
        self.add(|model| model.add_rigid(&name.to_string(), &borrowed(&points)));
    }

    fn joint(&mut self, part: JointPart<'_>) {
        let locked = match part.free {
            Free::Passive => DofSet::EMPTY,
            Free::Drive(_) => part.joint.free(),
        };
        let stiffness = part.elasticity();
        let point = part.at.to_string();
        self.add(|model| {
            let node = |body: Option<Name>| -> Option<NodeId> {
                let node = model.node(&body?.to_string(), &point);
                debug_assert!(node.is_some(), "{} has no point {point}", part.name);
                node
            };
            let connection = Connection {
                name: part.name.to_string(),
                between: part.between.map(node),
                joint: part.joint.clone_box(),
                locked,
                stiffness: JointStiffness::Directions(stiffness),
            };
            model.add_joint(connection, part.frame)
        });
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

/// Which parameter every value of a configuration's model comes from: links are named by their beams,
/// stiffnesses are `joint_stiffness` and `drive_stiffness`.
pub(super) fn origins(configuration: &impl Configuration) -> Vec<(ValuePlace, String)> {
    let mut origins = Origins::default();
    configuration.walk(&mut origins);
    origins.found
}

/// Notes where values come from.
#[derive(Default)]
struct Origins {
    segments: usize,
    joints: usize,
    found: Vec<(ValuePlace, String)>,
}

impl Parts for Origins {
    fn beam<const N: usize>(&mut self, beam: BeamPart<'_, N>) {
        for _ in 1..N {
            let segment = SegmentId(self.segments);
            self.segments += 1;
            self.found
                .extend(link_origins(segment, beam.link.0, beam.link.1));
        }
    }

    fn rigid<const N: usize>(&mut self, _: Name, _: [NamedPoint; N]) {}

    fn joint(&mut self, part: JointPart<'_>) {
        let joint = JointId(self.joints);
        self.joints += 1;
        let free = part.joint.free();
        for (direction, stiffness) in Dof::ALL.into_iter().zip(part.elasticity()) {
            let name = match (free.contains(direction), stiffness) {
                (_, None) => continue,
                (true, _) => "drive_stiffness".into(),
                (false, _) => format!("joint_stiffness.{direction}"),
            };
            self.found
                .push((ValuePlace::Stiffness { joint, direction }, name));
        }
    }
}

/// Where the values of a segment come from whose link is the parameter `path`.
fn link_origins(segment: SegmentId, path: &str, link: &Link) -> Vec<(ValuePlace, String)> {
    let dimensions = link.section.dimensions().into_iter().map(|(dimension, _)| {
        let place = ValuePlace::Dimension {
            segment,
            second: false,
            dimension,
        };
        (place, format!("{path}.section.{dimension}"))
    });
    let constants = link.material.constants().into_iter().map(|(constant, _)| {
        let place = ValuePlace::Constant { segment, constant };
        (place, format!("{path}.material.{constant}"))
    });
    dimensions.chain(constants).collect()
}

/// Counts the parts.
#[derive(Debug, Default)]
struct Counts {
    nodes: usize,
    segments: usize,
    joints: usize,
}

impl Parts for Counts {
    #[inline]
    fn beam<const N: usize>(&mut self, _: BeamPart<'_, N>) {
        self.nodes += N;
        self.segments += N - 1;
    }

    #[inline]
    fn rigid<const N: usize>(&mut self, _: Name, _: [NamedPoint; N]) {
        self.nodes += N;
    }

    #[inline]
    fn joint(&mut self, _: JointPart<'_>) {
        self.joints += 1;
    }
}

/// Writes the parts into the places of a geometry that has as many.
struct Writer<'g> {
    positions: slice::IterMut<'g, Point3<f64>>,
    y_axes: slice::IterMut<'g, Option<Vector3<f64>>>,
    frames: slice::IterMut<'g, Rotation3<f64>>,
}

impl Parts for Writer<'_> {
    #[inline]
    fn beam<const N: usize>(&mut self, beam: BeamPart<'_, N>) {
        for place in self.y_axes.by_ref().take(N - 1) {
            *place = Some(beam.y_axis);
        }
        self.rigid(beam.name, beam.points);
    }

    #[inline]
    fn rigid<const N: usize>(&mut self, _: Name, points: [NamedPoint; N]) {
        for ((_, at), place) in points.into_iter().zip(&mut self.positions) {
            *place = at;
        }
    }

    #[inline]
    fn joint(&mut self, joint: JointPart<'_>) {
        if let Some(place) = self.frames.next() {
            *place = joint.frame;
        }
    }
}
