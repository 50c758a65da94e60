//! The parts of a scene that stay as they are while the mechanism moves.

use hyperstat_assembly::{BodyKind, Model, NodeId};
use hyperstat_joints::DofSet;
use serde::Serialize;

use super::section::{SceneSection, sections};

/// A point of a body.
#[derive(Debug, Serialize)]
pub struct SceneNode {
    /// Its name, `body.point`.
    pub name: String,
    /// Its body.
    pub body: usize,
    /// Name of the point.
    pub point: String,
}

/// A body.
#[derive(Debug, Serialize)]
pub struct SceneBody {
    /// Its name.
    pub name: String,
    /// `beam`, `rigid` or `flexible`.
    pub kind: &'static str,
    /// Its nodes.
    pub nodes: Vec<usize>,
    /// Its segments; none where it is not made of beams.
    pub segments: Vec<usize>,
}

/// A beam.
#[derive(Debug, Serialize)]
pub struct SceneSegment {
    /// Its body.
    pub body: usize,
    /// Names of the points at its ends.
    pub points: [String; 2],
    /// Its nodes.
    pub ends: [usize; 2],
    /// First vertex of its curve, and how many there are.
    pub vertices: [usize; 2],
    /// Section at its first node.
    pub from: SceneSection,
    /// Section at its second node.
    pub to: SceneSection,
    /// Its length \[m\].
    pub length: f64,
}

/// A joint.
#[derive(Debug, Serialize)]
pub struct SceneJoint {
    /// Its name.
    pub name: String,
    /// Its kind, such as `Revolute`.
    pub kind: String,
    /// Its bodies; `None` is the ground.
    pub bodies: [Option<usize>; 2],
    /// Its nodes.
    pub nodes: [Option<usize>; 2],
    /// The node that it stands at.
    pub at: Option<usize>,
    /// Directions that are free by its kind.
    pub free: Vec<&'static str>,
    /// Directions that are held as drives.
    pub locked: Vec<&'static str>,
    /// Directions that a spring holds.
    pub elastic: Vec<&'static str>,
}

/// A load on a node.
#[derive(Debug, Serialize)]
pub struct SceneLoad {
    /// The case that it is of; `None`: of none.
    pub case: Option<String>,
    /// The node.
    pub node: usize,
}

/// A load along a segment.
#[derive(Debug, Serialize)]
pub struct SceneLineLoad {
    /// The case that it is of; `None`: of none.
    pub case: Option<String>,
    /// The segment.
    pub segment: usize,
}

/// A mass on a node.
#[derive(Debug, Serialize)]
pub struct SceneMass {
    /// The node.
    pub node: usize,
    /// \[kg\]
    pub mass: f64,
}

pub(super) fn nodes(model: &Model) -> Vec<SceneNode> {
    let nodes = model.nodes().iter().enumerate();
    nodes
        .map(|(k, node)| SceneNode {
            name: model.node_name(NodeId(k)),
            body: node.body.0,
            point: node.point.clone(),
        })
        .collect()
}

pub(super) fn bodies(model: &Model) -> Vec<SceneBody> {
    let bodies = model.bodies().iter();
    bodies
        .map(|body| SceneBody {
            name: body.name.clone(),
            kind: match body.kind {
                BodyKind::Elastic => "beam",
                BodyKind::Rigid => "rigid",
                BodyKind::Flexible => "flexible",
            },
            nodes: body.nodes.iter().map(|node| node.0).collect(),
            segments: body.segments.iter().map(|segment| segment.0).collect(),
        })
        .collect()
}

pub(super) fn segments(model: &Model, pieces: impl Fn(usize) -> usize) -> Vec<SceneSegment> {
    let mut first = model.nodes().len();
    let segments = model.segments().iter().enumerate();
    segments
        .map(|(k, segment)| {
            let count = pieces(k) + 1;
            let vertices = [first, count];
            first += count;
            let [start, end] = segment.ends.map(|node| model.geometry().positions[node.0]);
            let [from, to] = sections(segment);
            SceneSegment {
                body: segment.body.0,
                points: segment.ends.map(|node| model.nodes()[node.0].point.clone()),
                ends: segment.ends.map(|node| node.0),
                vertices,
                from,
                to,
                length: (end - start).norm(),
            }
        })
        .collect()
}

pub(super) fn joints(model: &Model) -> Vec<SceneJoint> {
    let names = |set: DofSet| set.iter().map(|dof| dof.name()).collect();
    let joints = model.joints().iter();
    joints
        .map(|joint| {
            let nodes = joint.between;
            SceneJoint {
                name: joint.name.clone(),
                kind: joint.joint.kind().into(),
                bodies: nodes.map(|node| Some(model.nodes()[node?.0].body.0)),
                nodes: nodes.map(|node| Some(node?.0)),
                at: nodes.iter().flatten().next().map(|node| node.0),
                free: names(joint.joint.free()),
                locked: names(joint.locked),
                elastic: names(joint.elastic()),
            }
        })
        .collect()
}

pub(super) fn loads(model: &Model) -> Vec<SceneLoad> {
    let sets = super::numbers::sets(model);
    let of_set = |(case, set): (Option<&str>, &hyperstat_assembly::LoadSet)| {
        let nodes: Vec<SceneLoad> = (set.nodes.iter())
            .map(|load| SceneLoad {
                case: case.map(Into::into),
                node: load.node.0,
            })
            .collect();
        nodes
    };
    sets.flat_map(of_set).collect()
}

pub(super) fn lines(model: &Model) -> Vec<SceneLineLoad> {
    let sets = super::numbers::sets(model);
    let of_set = |(case, set): (Option<&str>, &hyperstat_assembly::LoadSet)| {
        let lines: Vec<SceneLineLoad> = (set.lines.iter())
            .map(|load| SceneLineLoad {
                case: case.map(Into::into),
                segment: load.segment.0,
            })
            .collect();
        lines
    };
    sets.flat_map(of_set).collect()
}

pub(super) fn masses(model: &Model) -> Vec<SceneMass> {
    let masses = model.masses().iter();
    masses
        .map(|own| SceneMass {
            node: own.node.0,
            mass: own.mass.mass(),
        })
        .collect()
}
