//! One copy of a group: its names, and its points and directions where the copy lies.

use hyperstat_elements::element_frame;
use nalgebra::{Matrix3, Vector3};

use super::joint;
use super::placement::Placement;
use super::renamed::Names;
pub(super) use super::renamed::Naming;
use crate::error::LoadError;
use crate::terms::bodies::FASTENING;
use crate::text::dimension::Dimension;
use crate::text::fragment::Fragment;
use crate::text::tree::{Named, Node};

/// A copy of a group.
#[derive(Debug)]
pub(super) struct Copy<'g> {
    group: &'g Node,
    /// The mechanism that it is a part of.
    root: &'g Node,
    placement: &'g Placement,
    names: Names<'g>,
}

/// Fields of a load that are forces.
const FORCES: [(&str, Dimension); 4] = [
    ("force", Dimension::FORCE),
    ("per_length", Dimension::STIFFNESS),
    ("from", Dimension::STIFFNESS),
    ("to", Dimension::STIFFNESS),
];
/// Fields of a load that are moments.
const MOMENTS: [(&str, Dimension); 2] = [
    ("moment", Dimension::MOMENT),
    ("moment_per_length", Dimension::FORCE),
];

/// What the numbers of a direction are.
pub(super) const DIRECTION: (&str, Dimension) = ("a part of a direction", Dimension::NUMBER);

impl<'g> Copy<'g> {
    /// The copy with these names.
    pub(super) fn new(
        group: &'g Node,
        root: &'g Node,
        placement: &'g Placement,
        naming: Naming<'g>,
    ) -> Self {
        let names = Names::of(group, naming);
        Self {
            group,
            root,
            placement,
            names,
        }
    }

    fn entries(
        &self,
        part: &str,
        mut make: impl FnMut(&Node) -> Result<Node, LoadError>,
    ) -> Result<Vec<Named>, LoadError> {
        let entries = self.group.get(part).map_or(&[][..], Node::entries).iter();
        let made = entries.map(|own| Ok(own.with(&self.names.own(own.name()), make(own.value())?)));
        made.collect()
    }

    /// The copy's points.
    pub(super) fn points(&self) -> Result<Vec<Named>, LoadError> {
        self.entries("points", |point| match self.placement {
            here if *here == Placement::HERE => Ok(point.clone()),
            placement => vector(point, ("a coordinate", Dimension::LENGTH), |p| {
                placement.point(p)
            }),
        })
    }

    /// The copy's bodies.
    pub(super) fn bodies(&self) -> Result<Vec<Named>, LoadError> {
        self.entries("bodies", |body| {
            let mut made = body.clone();
            for field in ["through", "points"] {
                if let Some(list) = body.get(field) {
                    made = made.with_field(field, self.names.points(list));
                }
            }
            if let Some(list) = body.get("members") {
                let given = body.get("y_axis").is_some();
                let member = |member: &Node| self.member(member, given);
                made = made.with_field("members", list.map_items(member));
            }
            if let Some(axis) = body.get("y_axis") {
                return Ok(made.with_field("y_axis", self.directions(axis)?));
            }
            match (body.kind(), body.get("through")) {
                (Some("Beam"), Some(list)) => Ok(self.with_default(made, list, body)),
                (Some("Flexible"), _) if !self.placement.keeps_axes() => {
                    let at = body.get("stiffness").unwrap_or(body);
                    let error = "a copy of a flexible body cannot be turned: its stiffness is in global axes";
                    Err((Fragment::of_node(at).error(error))
                        .with_help("move it only, or write each body with a table of its own"))
                }
                _ => Ok(made),
            }
        })
    }

    /// A member of a frame; `given`: the frame has a direction of its members' y axes.
    fn member(&self, member: &Node, given: bool) -> Node {
        let Some(list) = member.get("through") else {
            let list = self.names.points(member);
            if given || self.placement.keeps_axes() {
                return list;
            }
            let fields = member.fields_in_place(vec![("through", list)]);
            return self.with_default(fields, member, member);
        };
        let made = self.fastened(member.with_field("through", self.names.points(list)));
        match member.get("y_axis") {
            // What cannot be read is told where it is read.
            Some(axis) => made.with_field("y_axis", self.directions(axis).unwrap_or(axis.clone())),
            None if given => made,
            None => self.with_default(made, list, member),
        }
    }

    /// A member whose ends are fastened at the copy's points; what cannot be read is told where it is read.
    fn fastened(&self, mut made: Node) -> Node {
        for field in FASTENING {
            let Some(map) = made.get(field).cloned() else {
                continue;
            };
            let entries = map.entries().iter().map(|own| {
                let turned = (field == "offset")
                    .then(|| self.direction(own.value()).ok())
                    .flatten();
                let value = turned.unwrap_or_else(|| own.value().clone());
                own.with(&self.names.point_name(own.name()), value)
            });
            let entries = entries.collect();
            made = made.with_field(field, map.map_in_place(entries));
        }
        made
    }

    /// A beam through the points of `list` whose y axes are those that it has without being told,
    /// as the copy turns them.
    fn with_default(&self, made: Node, list: &Node, written: &Node) -> Node {
        if self.placement.keeps_axes() {
            return made;
        }
        let axis = |ends: &[Node]| {
            let [from, to] = [self.end(&ends[0], written)?, self.end(&ends[1], written)?];
            let frame = element_frame(&(to - from), None).ok()?;
            let y = frame.matrix().column(1).into_owned();
            Some(list.numbers_in_place(self.placement.direction(&y).as_slice()))
        };
        // Points that are not there, and beams without a length, are told where they are read.
        match list.items().windows(2).map(axis).collect() {
            Some(axes) => made.with_field("y_axis", list.list_in_place(axes)),
            None => made,
        }
    }

    /// Where a member ends at a point; in the group, not in its copy.
    fn end(&self, name: &Node, member: &Node) -> Option<Vector3<f64>> {
        let offset = member
            .get("offset")
            .and_then(|map| map.get(name.as_text()?));
        let offset = match offset {
            Some(offset) => Fragment::of_node(offset)
                .vector("", Dimension::LENGTH)
                .ok()?,
            None => Vector3::zeros(),
        };
        Some(self.position(name)? + offset)
    }

    /// Where a point lies of which the name is written; in the group, not in its copy.
    fn position(&self, name: &Node) -> Option<Vector3<f64>> {
        let find = |node: &Node| {
            let point = node.get("points")?.get(name.as_text()?)?;
            Fragment::of_node(point).vector("", Dimension::LENGTH).ok()
        };
        find(self.group).or_else(|| find(self.root))
    }

    /// The copy's joints; `each` gets the names of a joint in the group and in the copy.
    pub(super) fn joints(&self, mut each: impl FnMut(&str, &str)) -> Result<Vec<Named>, LoadError> {
        let entries = self.entries("joints", |joint| {
            let mut made = joint.clone();
            if let Some(at) = joint.get("at") {
                made = made.with_field("at", self.names.point(at));
            }
            if let Some(between) = joint.get("between") {
                made = made.with_field("between", self.names.bodies(between));
            }
            match self.placement.keeps_axes() {
                true => Ok(made),
                false => joint::turned(&made, self.placement),
            }
        })?;
        let names = self.group.get("joints").map_or(&[][..], Node::entries);
        for (joint, made) in names.iter().zip(&entries) {
            each(joint.name(), made.name());
        }
        Ok(entries)
    }

    /// The copy's loads.
    pub(super) fn loads(&self) -> Result<Vec<Node>, LoadError> {
        let load = |load: &Node| {
            let mut made = load.clone();
            if let Some(on) = load.get("on") {
                made = made.with_field("on", self.names.on(on));
            }
            if self.placement.keeps_axes() {
                return Ok(made);
            }
            for (field, dimension) in FORCES {
                if let Some(force) = load.get(field) {
                    let what = (&*format!("`{field}`"), dimension);
                    let force = vector(force, what, |f| self.placement.direction(f))?;
                    made = made.with_field(field, force);
                }
            }
            for (field, dimension) in MOMENTS {
                if let Some(moment) = load.get(field) {
                    let what = (&*format!("`{field}`"), dimension);
                    let moment = vector(moment, what, |m| self.placement.moment(m))?;
                    made = made.with_field(field, moment);
                }
            }
            Ok(made)
        };
        self.items("loads").iter().map(load).collect()
    }

    /// The copy's masses.
    pub(super) fn masses(&self) -> Result<Vec<Node>, LoadError> {
        let mass = |mass: &Node| {
            let mut made = mass.clone();
            if let Some(on) = mass.get("on") {
                made = made.with_field("on", self.names.on(on));
            }
            match mass.get("inertia") {
                Some(inertia) if !self.placement.keeps_axes() => {
                    Ok(made.with_field("inertia", self.inertia(inertia)?))
                }
                _ => Ok(made),
            }
        };
        self.items("masses").iter().map(mass).collect()
    }

    fn items(&self, part: &str) -> &'g [Node] {
        self.group.get(part).map_or(&[][..], Node::items)
    }

    /// A direction, as the copy turns it.
    fn direction(&self, node: &Node) -> Result<Node, LoadError> {
        if self.placement.keeps_axes() {
            return Ok(node.clone());
        }
        vector(node, DIRECTION, |v| self.placement.direction(v))
    }

    /// A direction, or a list of one for each segment, as the copy turns them.
    fn directions(&self, node: &Node) -> Result<Node, LoadError> {
        let is_list = node
            .items()
            .first()
            .is_some_and(|own| !own.items().is_empty());
        if !is_list {
            return self.direction(node);
        }
        let turned = node.items().iter().map(|own| self.direction(own));
        Ok(node.list_in_place(turned.collect::<Result<_, _>>()?))
    }

    /// An inertia, `(Jxx, Jyy, Jzz)` or six entries, as the copy turns it.
    fn inertia(&self, node: &Node) -> Result<Node, LoadError> {
        let numbers = node.items().iter();
        let numbers: Vec<f64> = (numbers
            .map(|own| Fragment::of_node(own).acting("`inertia`", Dimension::INERTIA)))
        .collect::<Result<_, _>>()?;
        let (xy, xz, yz) = match numbers[..] {
            [_, _, _] => (0.0, 0.0, 0.0),
            [_, _, _, xy, xz, yz] => (xy, xz, yz),
            // That is told where masses are read.
            _ => return Ok(node.clone()),
        };
        let (xx, yy, zz) = (numbers[0], numbers[1], numbers[2]);
        let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let turned = self.placement.inertia(&inertia);
        let entries = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
        Ok(node.numbers_in_place(&entries.map(|at| turned[at])))
    }
}

/// Three numbers, `what` of this dimension, with others in their places.
pub(super) fn vector(
    node: &Node,
    (what, dimension): (&str, Dimension),
    make: impl FnOnce(&Vector3<f64>) -> Vector3<f64>,
) -> Result<Node, LoadError> {
    let given = Fragment::of_node(node).vector(what, dimension)?;
    Ok(node.numbers_in_place(make(&given).as_slice()))
}
