//! Values in the place of others of a tree, and what is wrong where the whole then makes no mechanism.

use super::source::Place;
use super::tree::{Node, Steps};
use super::value::Value;
use crate::error::{LoadError, Location};

/// A value in the place of another.
#[derive(Debug, Clone)]
pub(crate) struct Replacement<'v> {
    pub(crate) path: &'v str,
    /// The ways to the places that it has.
    pub(crate) places: &'v [Steps],
    pub(crate) value: Node,
}

/// A tree with other values in some places.
#[derive(Debug)]
pub(crate) struct Changed<'v> {
    pub(crate) root: &'v Node,
    pub(crate) values: Vec<Replacement<'v>>,
    /// Where the values stand together.
    pub(crate) whole: Place,
}

impl Changed<'_> {
    /// The tree.
    pub(crate) fn tree(&self) -> Node {
        self.tree_with(|_| true)
    }

    /// The tree with those of the values, by their number, that are `taken`.
    fn tree_with(&self, taken: impl Fn(usize) -> bool) -> Node {
        let mut tree = self.root.clone();
        for (_, own) in self.values.iter().enumerate().filter(|(k, _)| taken(*k)) {
            for steps in own.places {
                tree.replace(steps, own.value.clone());
            }
        }
        tree
    }

    /// The error of reading the tree, told at the value that is to blame: the one at which it stands,
    /// which `holds` tells; else one that is wrong among the values as they are written; else all of
    /// them. `who`, if it is not empty, begins the message.
    pub(crate) fn refused(
        &self,
        error: LoadError,
        who: &str,
        holds: impl Fn(&Location) -> bool,
        reads: impl Fn(&Node) -> bool,
    ) -> LoadError {
        let LoadError::At {
            location,
            message,
            help,
            unreadable,
            json,
        } = error
        else {
            return error;
        };
        let after = |separator: &str| match who {
            "" => String::new(),
            who => format!("{who}{separator}"),
        };
        if holds(&location) {
            return LoadError::At {
                location,
                message: format!("{}{message}", after(": ")),
                help,
                unreadable,
                json,
            };
        }
        let alone = |k: &usize| !reads(&self.tree_with(|other| other == *k));
        let blamed = (0..self.values.len()).find(alone);
        let place = blamed.map_or_else(|| self.whole.clone(), |k| self.values[k].value.place());
        let values = self.values.iter().enumerate();
        let values = values.filter(|(k, _)| blamed.is_none_or(|blamed| blamed == *k));
        let words = values.map(|(_, own)| format!("`{}` = {}", own.path, Value::of(&own.value)));
        let words = words.collect::<Vec<_>>().join(", ");
        LoadError::At {
            message: format!("{}{words}: {message} ({location})", after(", ")),
            location: Box::new(place.location()),
            help,
            unreadable,
            json,
        }
    }
}
