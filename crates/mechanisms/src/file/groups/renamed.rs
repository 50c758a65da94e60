//! Names of a group in its copies.

use std::collections::HashSet;

use crate::terms::bodies::GROUND;
use crate::text::tree::{Named, Node};

/// What is put before and behind names.
#[derive(Debug, Clone, Copy)]
pub(super) struct Naming<'g> {
    pub(super) before: &'g str,
    pub(super) after: &'g str,
}

/// The names of a group's points and bodies, and how they are called in a copy. What has names before its own has a
/// ground of its own.
#[derive(Debug)]
pub(super) struct Names<'g> {
    points: HashSet<&'g str>,
    bodies: HashSet<&'g str>,
    naming: Naming<'g>,
}

impl<'g> Names<'g> {
    pub(super) fn of(group: &'g Node, naming: Naming<'g>) -> Self {
        let names = |part: &str| -> HashSet<&'g str> {
            let entries = group.get(part).map_or(&[][..], Node::entries);
            entries.iter().map(Named::name).collect()
        };
        let mut bodies: HashSet<_> = names("bodies");
        if !naming.before.is_empty() {
            bodies.insert(GROUND);
        }
        Self {
            points: names("points"),
            bodies,
            naming,
        }
    }

    /// The name of something of the group in this copy.
    pub(super) fn own(&self, name: &str) -> String {
        let Naming { before, after } = self.naming;
        format!("{before}{name}{after}")
    }

    /// A point's name where one stands; one that is not the group's stays.
    pub(super) fn point(&self, node: &Node) -> Node {
        self.named(node, &self.points)
    }

    /// A point's name; one that is not the group's stays.
    pub(super) fn point_name(&self, name: &str) -> String {
        match self.points.contains(name) {
            true => self.own(name),
            false => name.into(),
        }
    }

    /// A body's name where one stands.
    fn body(&self, node: &Node) -> Node {
        self.named(node, &self.bodies)
    }

    fn named(&self, node: &Node, of_group: &HashSet<&str>) -> Node {
        match node.as_text() {
            Some(text) if of_group.contains(text) => node.text_in_place(&self.own(text)),
            _ => node.clone(),
        }
    }

    /// Names of points in a list.
    pub(super) fn points(&self, list: &Node) -> Node {
        self.each(list, &mut |_, item| self.point(item))
    }

    /// Names of bodies in a tuple.
    pub(super) fn bodies(&self, list: &Node) -> Node {
        self.each(list, &mut |_, item| self.body(item))
    }

    /// What a load or a mass is on: a body, or a body and points of it.
    pub(super) fn on(&self, node: &Node) -> Node {
        if node.as_text().is_some() {
            return self.body(node);
        }
        self.each(node, &mut |k, item| match k {
            0 => self.body(item),
            _ => self.point(item),
        })
    }

    fn each(&self, list: &Node, item: &mut dyn FnMut(usize, &Node) -> Node) -> Node {
        let mut place = 0;
        list.map_items(|own| {
            place += 1;
            item(place - 1, own)
        })
    }
}
