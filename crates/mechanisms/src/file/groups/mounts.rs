//! Mechanisms that a mechanism mounts: `mechanisms: { "head": (file: "tricept.ron", at: (…), on: ("frame", "top")) }`.
//!
//! A mounted mechanism becomes a part of the one that mounts it: its names begin with its own and a dot,
//! `head.rod1`, its ground is one rigid body, `head.ground`, which is welded to the node that it stands on. What acts on
//! it and its output stay in its file; its masses come along.

use std::collections::HashSet;
use std::path::PathBuf;

use nalgebra::{Rotation3, Vector3};

use super::copy::{Copy, Naming};
use super::placement::Placement;
use super::{Copies, PARTS, Parts, Written};
use crate::error::LoadError;
use crate::file::include;
use crate::file::through::check_name;
use crate::terms::bodies::GROUND;
use crate::terms::mechanism::MOUNT;
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;
use crate::text::fragment::{Entry, Fragment};
use crate::text::named::{mechanism_in, read_named};
use crate::text::scope::{MECHANISMS, Scope, TREE};
use crate::text::source::{Place, Source};
use crate::text::tree::{Named, Node};

/// The mechanism with the trees of those that it mounts in their entries; `open` are the files that are being read.
pub(crate) fn read(root: Node, open: &mut Vec<PathBuf>) -> Result<Node, LoadError> {
    let Some(mounts) = root.get(MECHANISMS) else {
        return Ok(root);
    };
    let mut made = Vec::new();
    for (entry, own) in Fragment::of_node(mounts)
        .map()?
        .iter()
        .zip(mounts.entries())
    {
        check_name(entry, "mounted mechanism")?;
        let fields = fields(entry)?;
        let file = fields.required("file")?;
        let source = read_named(file)?;
        let value = mechanism_in(&source)?;
        let path = value.place().location().path;
        if open.contains(&path) {
            return Err(file
                .error(format!("{} mounts itself", path.display()))
                .with_help("a mechanism cannot be a part of its own"));
        }
        open.push(path);
        let tree = include::read(value, open)?;
        open.pop();
        made.push(own.with(own.name(), own.value().with_field(TREE, tree)));
    }
    let mounts = mounts.map_in_place(made);
    Ok(root.with_field(MECHANISMS, mounts))
}

fn fields<'a>(entry: &Entry<'a>) -> Result<Fields<'a>, LoadError> {
    let owner = format!("mounted mechanism `{}`", entry.name);
    Fields::read(entry.value, owner, &MOUNT.names())
}

/// Adds the parts of what is mounted to those of the mechanism.
pub(super) fn write_out(written: &mut Written) -> Result<(), LoadError> {
    let root = written.root.clone();
    let Some(mounts) = root.get(MECHANISMS) else {
        return Ok(());
    };
    let mut parts = PARTS.map(|part| Parts::of(root.get(part)));
    let mut tables = ["materials", "sections"]
        .map(|table| root.get(table).map_or(&[][..], Node::entries).to_vec());
    let mut output = None;
    // Where each stands is said in the words of the one that mounts it.
    let scope = Scope::lazy(&root)?;
    for (entry, node) in Fragment::of_node(mounts)
        .map()?
        .iter()
        .zip(mounts.entries())
    {
        let tree = node.value().get(TREE).unwrap_or(&root);
        let said = scope.valued(&node.value().without_field(TREE));
        let mount = Mount {
            name: node.name(),
            said: &said,
            tree: super::write_out(tree)?,
        };
        mount.add(&mut parts, &mut tables, &mut written.copies)?;
        if let Some(own) = said.get("output") {
            let own_output = mount.node(own);
            let texts = |node: &Node| {
                node.items()
                    .iter()
                    .map(|own| own.as_text().map(String::from))
                    .collect::<Vec<_>>()
            };
            let other = output.as_ref().or(root.get("output"));
            if other.is_some_and(|other| texts(other) != texts(&own_output)) {
                return Err(Fragment::of_node(own)
                    .error(format!(
                        "the output of mounted mechanism `{}` is a second one",
                        entry.name
                    ))
                    .with_help("a mechanism has one output: leave one of the two out"));
            }
            output = Some(own_output);
        }
    }
    let mut tree = root.without_field(MECHANISMS);
    for (name, part) in PARTS.into_iter().zip(parts) {
        if !part.is_empty() {
            let place = root.get(name).unwrap_or(mounts);
            tree = tree.with_field(name, part.into_node(place));
        }
    }
    for (name, entries) in ["materials", "sections"].into_iter().zip(tables) {
        if !entries.is_empty() {
            let place = root.get(name).unwrap_or(mounts);
            tree = tree.with_field(name, place.map_in_place(entries));
        }
    }
    if let Some(output) = output {
        tree = tree.with_field("output", output);
    }
    written.root = tree;
    Ok(())
}

/// A mechanism that is mounted.
struct Mount<'m> {
    name: &'m str,
    /// What its entry says beside its tree.
    said: &'m Node,
    tree: Written,
}

impl Mount<'_> {
    fn own(&self, name: &str) -> String {
        format!("{}.{name}", self.name)
    }

    fn add(
        &self,
        parts: &mut [Parts; 5],
        tables: &mut [Vec<Named>; 2],
        copies: &mut Copies,
    ) -> Result<(), LoadError> {
        let root = &self.tree.root;
        let placement = placement(self.said.get("at"))?;
        let naming = Naming {
            before: &format!("{}.", self.name),
            after: "",
        };
        let copy = Copy::new(root, root, &placement, naming);
        let joints = copy.joints(|_, _| {})?;
        let flange = self.flange(&joints)?;
        copies.mount(
            &self.tree.copies,
            self.name,
            parts[4].len(),
            root.get("masses"),
        );
        parts[0].put(copy.points()?);
        let bodies = copy.bodies()?.into_iter();
        parts[1].put(bodies.map(|own| own.with(own.name(), self.body(own.value()))));
        parts[1].put([flange.0]);
        parts[2].put(joints);
        parts[2].put([flange.1]);
        parts[4].items.extend(copy.masses()?);
        for (table, name) in tables.iter_mut().zip(["materials", "sections"]) {
            let entries = root.get(name).map_or(&[][..], Node::entries).iter();
            table.extend(entries.map(|own| own.with(&self.own(own.name()), own.value().clone())));
        }
        Ok(())
    }

    /// The ground as a rigid body of the points that its joints are at, and the weld that holds it.
    fn flange(&self, joints: &[Named]) -> Result<(Named, Named), LoadError> {
        let on = match self.said.get("on") {
            Some(on) => on,
            // What must be there is told as it is of any fields.
            None => {
                let owner = format!("mounted mechanism `{}`", self.name);
                let fields = Fields::read(Fragment::of_node(self.said), owner, &MOUNT.names())?;
                fields.required("on")?;
                self.said
            }
        };
        let [body, point] = Fragment::of_node(on)
            .array("a body and one of its points, such as `(\"frame\", \"top\")`")?;
        let (body, point) = (body.string()?, point.string()?);
        let ground = self.own(GROUND);
        let mut points = vec![point.clone()];
        let mut seen = HashSet::new();
        for joint in joints {
            let between = joint.value().get("between").map_or(&[][..], Node::items);
            let grounded = between.iter().any(|own| own.as_text() == Some(&ground));
            let at = joint.value().get("at").and_then(Node::as_text);
            if let Some(at) = at.filter(|at| grounded && seen.insert(at.to_string())) {
                points.push(at.to_owned());
            }
        }
        let made = |name: String, text: String| {
            let source = Source::made(text, on.place());
            let node = Node::at(&Place::whole(&source));
            let Place { source, span } = on.place();
            Named {
                name: name.into(),
                source,
                at: span,
                value: node,
            }
        };
        let body_text = format!("Rigid(points: {points:?})");
        let weld = format!("(at: {point:?}, between: ({body:?}, {ground:?}), kind: Fixed)");
        Ok((made(ground, body_text), made(self.own("on"), weld)))
    }

    /// A body whose materials and sections are those of the mounted mechanism.
    fn body(&self, body: &Node) -> Node {
        let text = |node: &Node| match node.as_text() {
            Some(name) => node.text_in_place(&self.own(name)),
            None => node.clone(),
        };
        let mut made = body.clone();
        if let Some(members) = body.get("members") {
            made = made.with_field("members", members.map_items(|member| self.body(member)));
        }
        for field in ["section", "material"] {
            if let Some(own) = body.get(field) {
                let own = match own.items() {
                    [] => text(own),
                    _ => own.map_items(text),
                };
                made = made.with_field(field, own);
            }
        }
        made
    }

    /// A body and a point of the mounted mechanism, by the names that they have where it is mounted.
    fn node(&self, node: &Node) -> Node {
        node.map_items(|own| match own.as_text() {
            Some(name) => own.text_in_place(&self.own(name)),
            None => own.clone(),
        })
    }
}

/// Reads where a mechanism stands: three coordinates, or three and a rotation vector.
fn placement(at: Option<&Node>) -> Result<Placement, LoadError> {
    let Some(at) = at else {
        return Ok(Placement::HERE);
    };
    let at = Fragment::of_node(at);
    let expected = "a place `(x, y, z)`, or a place and a rotation vector `(x, y, z, rx, ry, rz)`";
    let numbers = at.tuple(expected)?;
    let dimensions = [Dimension::LENGTH, Dimension::ANGLE];
    let mut read = Vec::with_capacity(6);
    for (k, own) in numbers.iter().enumerate() {
        read.push(own.quantity("a coordinate", dimensions[(k / 3).min(1)])?);
    }
    let rotation = match read[..] {
        [_, _, _] => Vector3::zeros(),
        [_, _, _, rx, ry, rz] => Vector3::new(rx, ry, rz),
        _ => return Err(at.expected(expected)),
    };
    let shift = Vector3::new(read[0], read[1], read[2]);
    Ok(Placement::moved(
        Rotation3::from_scaled_axis(rotation),
        shift,
    ))
}
