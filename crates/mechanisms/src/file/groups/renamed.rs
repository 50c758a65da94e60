//! Names of a group in its copies.

use std::collections::HashSet;

use crate::text::tree::{Named, Node};

/// The names of a group's points and bodies, and what is put behind them in a copy.
#[derive(Debug)]
pub(super) struct Names<'g> {
    points: HashSet<&'g str>,
    bodies: HashSet<&'g str>,
    ending: &'g str,
}

impl<'g> Names<'g> {
    pub(super) fn of(group: &'g Node, ending: &'g str) -> Self {
        let names = |part: &str| {
            let entries = group.get(part).map_or(&[][..], Node::entries);
            entries.iter().map(Named::name).collect()
        };
        Self {
            points: names("points"),
            bodies: names("bodies"),
            ending,
        }
    }

    /// The name of something of the group in this copy.
    pub(super) fn own(&self, name: &str) -> String {
        format!("{name}{}", self.ending)
    }

    /// A point's name where one stands; one that is not the group's stays.
    pub(super) fn point(&self, node: &Node) -> Node {
        self.named(node, &self.points)
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
