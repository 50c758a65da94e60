//! Members of a frame that are released, sprung or offset at their ends, as frame programs have them.
//!
//! Such a member is a beam of its own, and what fastens it a joint at its end, along the member's own axes: free in
//! the released directions, elastic in the sprung ones, else rigid. An offset is a rigid body between the frame's
//! point and the member's end. What no member holds without a joint is a rigid body of one point.

use std::collections::HashMap;

use hyperstat_elements::element_frame;
use hyperstat_joints::{Dof, DofSet, Fixed};
use hyperstat_model::{BodyId, Connection, JointStiffness, Member, Model, NodeId};
use nalgebra::{Point3, Rotation3, Vector3};

use super::joints;
use super::through::Through;
use super::value_names::Given;
use crate::error::LoadError;
use crate::terms::bodies::FASTENING;
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;
use crate::text::names;

/// How an end of a member is fastened.
#[derive(Debug, Clone, Default)]
struct End {
    /// Along the member's own axes: `None` is rigid, 0 released.
    stiffness: [Option<f64>; 6],
    offset: Option<Vector3<f64>>,
}

impl End {
    fn has_joint(&self) -> bool {
        self.offset.is_some() || self.stiffness.iter().any(Option::is_some)
    }
}

/// How both ends of a member are fastened.
#[derive(Debug, Clone, Default)]
pub(crate) struct Ends([End; 2]);

impl Ends {
    /// Reads the fields of a member through these points; `None` where it has none of them.
    pub(crate) fn read(
        fields: &Fields<'_>,
        what: &str,
        through: Fragment<'_>,
        points: &[Through<'_>],
    ) -> Result<Option<Self>, LoadError> {
        let given = FASTENING.iter().find_map(|name| fields.get(name));
        let Some(given) = given else {
            return Ok(None);
        };
        let [first, second] = points else {
            return Err(through
                .error(format!(
                    "{what} has fastened ends and runs through {} points",
                    points.len()
                ))
                .with_help("such a member runs between two points: write its pieces as members"));
        };
        let mut ends = Self::default();
        for field in FASTENING {
            let Some(map) = fields.get(field) else {
                continue;
            };
            for entry in map.map()? {
                let place = [first, second]
                    .iter()
                    .position(|point| point.name == entry.name);
                let Some(place) = place else {
                    let known = [first, second].map(|point| &*point.name);
                    let error = entry
                        .key
                        .error(format!("`{}` is no end of {what}", entry.name));
                    return Err(error.with_help(names::help(&entry.name, "ends", known)));
                };
                ends.0[place].add(field, entry.value)?;
            }
        }
        if ends.0.iter().all(|end| !end.has_joint()) {
            return Err(given
                .error(format!("{what} is fastened in no way"))
                .with_help("name an end and directions, such as `releases: { \"A\": [v, w] }`"));
        }
        Ok(Some(ends))
    }
}

impl End {
    fn add(&mut self, field: &str, value: Fragment<'_>) -> Result<(), LoadError> {
        let twice = |dof: Dof, at: Fragment<'_>| {
            at.error(format!("`{dof}` is fastened twice at this end"))
                .with_help("a direction is either released or sprung")
        };
        match field {
            "releases" => {
                for item in value.list("a list of directions, such as `[v, w]`")? {
                    let dof = item.word().parse::<Dof>();
                    let dof = dof.map_err(|error| item.error(error.to_string()))?;
                    if self.stiffness[dof.index()].replace(0.0).is_some() {
                        return Err(twice(dof, item));
                    }
                }
            }
            "springs" => {
                let springs = joints::directions(value)?;
                for (dof, spring) in Dof::ALL.into_iter().zip(springs) {
                    let Some(spring) = spring else { continue };
                    if self.stiffness[dof.index()].replace(spring).is_some() {
                        return Err(twice(dof, value));
                    }
                }
            }
            _ => self.offset = Some(value.vector("`offset`", Dimension::LENGTH)?),
        }
        Ok(())
    }
}

/// A member with ends that are fastened.
#[derive(Debug)]
pub(crate) struct Fastened<'a> {
    pub(crate) points: [Through<'a>; 2],
    pub(crate) member: Member,
    pub(crate) given: Given,
    pub(crate) ends: Ends,
    /// Where it is written.
    pub(crate) at: Fragment<'a>,
}

impl Fastened<'_> {
    fn name(&self) -> String {
        let [a, b] = &self.points;
        format!("{}-{}", a.name, b.name)
    }

    /// Where its ends are, offsets counted.
    fn ends(&self) -> [Point3<f64>; 2] {
        [0, 1].map(|k| self.points[k].position + self.ends.0[k].offset.unwrap_or_default())
    }
}

/// Members that are welded to each other.
#[derive(Debug)]
pub(crate) struct Welded<'a> {
    pub(crate) points: Vec<Through<'a>>,
    pub(crate) members: Vec<Member>,
    pub(crate) given: Vec<Given>,
}

impl<'a> Welded<'a> {
    /// Those that hang together, in the order of their first points.
    fn parts(self) -> Vec<Self> {
        let mut part_of: Vec<usize> = (0..self.points.len()).collect();
        for member in &self.members {
            let [a, b] = member.ends.map(|place| part_of[place]);
            let (first, other) = (a.min(b), a.max(b));
            part_of
                .iter_mut()
                .filter(|part| **part == other)
                .for_each(|part| *part = first);
        }
        let mut parts: Vec<Self> = Vec::new();
        let mut number: HashMap<usize, usize> = HashMap::new();
        let mut place = vec![0; self.points.len()];
        for (k, point) in self.points.into_iter().enumerate() {
            let part = *number.entry(part_of[k]).or_insert_with(|| {
                parts.push(Self {
                    points: Vec::new(),
                    members: Vec::new(),
                    given: Vec::new(),
                });
                parts.len() - 1
            });
            place[k] = parts[part].points.len();
            parts[part].points.push(point);
        }
        for (member, given) in self.members.into_iter().zip(self.given) {
            let part = &mut parts[number[&part_of[member.ends[0]]]];
            part.members.push(Member {
                ends: member.ends.map(|end| place[end]),
                ..member
            });
            part.given.push(given);
        }
        parts
    }
}

/// Adds a frame with such members to the model; returns the first of its bodies, which knows the points of all.
pub(crate) fn add(
    name: &str,
    welded: Welded<'_>,
    fastened: Vec<Fastened<'_>>,
    list: Fragment<'_>,
    model: &mut Model,
    given: &mut Vec<Given>,
) -> Result<BodyId, LoadError> {
    let refused = |error: hyperstat_model::ModelError| list.error(error.to_string());
    let mut frame = Bodies {
        name,
        all: Vec::new(),
        holds: HashMap::new(),
    };
    for part in welded.parts() {
        let own = frame.next(&part.points[0].name);
        let points = super::through::pairs(&part.points);
        let body = model
            .add_elastic(&own, &points, &part.members)
            .map_err(refused)?;
        given.extend(part.given);
        frame.add(model, body);
    }
    for own in &fastened {
        for (point, end) in own.points.iter().zip(&own.ends.0) {
            let touches = |other: &Fastened<'_>| other.points.iter().any(|p| p.name == point.name);
            let alone = fastened.iter().filter(|other| touches(other)).count() == 1;
            if frame.holds.contains_key(&point.name) || alone && !end.has_joint() {
                continue;
            }
            let body = frame.next(&point.name);
            let body = model
                .add_rigid(&body, &[(&point.name, point.position)])
                .map_err(refused)?;
            frame.add(model, body);
        }
    }
    for own in &fastened {
        own.add(&mut frame, model)
            .map_err(|error| own.at.error(error.to_string()))?;
        given.push(own.given.clone());
    }
    let first = frame.all[0];
    model.know_as(first, frame.all.split_off(1));
    Ok(first)
}

/// The bodies of one frame.
struct Bodies<'n> {
    name: &'n str,
    all: Vec<BodyId>,
    /// What holds a point, by its name.
    holds: HashMap<String, NodeId>,
}

impl Bodies<'_> {
    /// What the next body is called: the first as the frame.
    fn next(&self, part: &str) -> String {
        match self.all.is_empty() {
            true => self.name.into(),
            false => format!("{} {part}", self.name),
        }
    }

    fn add(&mut self, model: &Model, body: BodyId) {
        self.all.push(body);
        for &node in &model.bodies()[body.0].nodes {
            let point = model.nodes()[node.0].point.clone();
            self.holds.entry(point).or_insert(node);
        }
    }
}

impl Fastened<'_> {
    /// Adds the member, what is between its ends and the frame, and the joints.
    fn add(
        &self,
        frame: &mut Bodies<'_>,
        model: &mut Model,
    ) -> Result<(), hyperstat_model::ModelError> {
        let ends = self.ends();
        let whole = self.name();
        let points = [0, 1].map(|k| match self.ends.0[k].offset {
            None => self.points[k].name.clone(),
            Some(_) => format!("{} {whole} {}", frame.name, self.points[k].name),
        });
        let own = frame.next(&whole);
        let named = [(&*points[0], ends[0]), (&*points[1], ends[1])];
        let body = model.add_elastic(&own, &named, std::slice::from_ref(&self.member))?;
        let nodes = [
            model.bodies()[body.0].nodes[0],
            model.bodies()[body.0].nodes[1],
        ];
        let axes = element_frame(&(ends[1] - ends[0]), self.member.y_axis.as_ref());
        let axes = axes.unwrap_or_else(|_| Rotation3::identity());
        for (k, end) in self.ends.0.iter().enumerate() {
            let point = &self.points[k];
            let Some(&held) = frame.holds.get(&point.name) else {
                continue;
            };
            let joint = format!("{} {whole} at {}", frame.name, point.name);
            let mut from = held;
            if end.offset.is_some() {
                let name = format!("{} {whole} offset at {}", frame.name, point.name);
                let arm = model.add_rigid(
                    &name,
                    &[(&point.name, point.position), (&points[k], ends[k])],
                )?;
                let [near, far] = [0, 1].map(|k| model.bodies()[arm.0].nodes[k]);
                let weld = connection(name, [held, near], [None; 6]);
                model.add_joint(weld, Rotation3::identity())?;
                frame.all.push(arm);
                from = far;
            }
            model.add_joint(connection(joint, [from, nodes[k]], end.stiffness), axes)?;
        }
        frame.add(model, body);
        Ok(())
    }
}

fn connection(name: String, nodes: [NodeId; 2], stiffness: [Option<f64>; 6]) -> Connection {
    Connection {
        name,
        between: nodes.map(Some),
        joint: Box::new(Fixed),
        locked: DofSet::EMPTY,
        stiffness: JointStiffness::Directions(stiffness),
    }
}
