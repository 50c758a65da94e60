//! Values in the place of others of a tree, and what is wrong where the whole then makes no mechanism.

use std::fmt;

use super::source::Place;
use super::tree::{Node, Steps};
use crate::error::{LoadError, Location};

/// A value in the place of another.
#[derive(Debug, Clone)]
pub(crate) struct Replacement<'v> {
    pub(crate) path: &'v str,
    pub(crate) steps: &'v Steps,
    pub(crate) value: Node,
}

/// A tree with those of some values, by their number, that are `taken`.
pub(crate) fn tree_with(
    root: &Node,
    values: &[Replacement<'_>],
    taken: impl Fn(usize) -> bool,
) -> Node {
    let mut tree = root.clone();
    for (_, own) in values.iter().enumerate().filter(|(k, _)| taken(*k)) {
        tree.replace(own.steps, own.value.clone());
    }
    tree
}

/// The error of a tree in which values stand in, told at the value that is to blame: the one at which it
/// stands, which `holds` tells; else one that is wrong among the values as they are written; else all of
/// them, at `whole`. `who` begins the message.
pub(crate) fn refused(
    error: LoadError,
    who: &str,
    root: &Node,
    values: &[Replacement<'_>],
    whole: &Place,
    holds: impl Fn(&Location) -> bool,
    reads: impl Fn(&Node) -> bool,
    shown: impl Fn(&Node) -> String,
) -> LoadError {
    let LoadError::At {
        location,
        message,
        help,
        unreadable,
    } = error
    else {
        return error;
    };
    let joined = |parts: fmt::Arguments<'_>, separator: &str| match who {
        "" => parts.to_string(),
        who => format!("{who}{separator}{parts}"),
    };
    if holds(&location) {
        return LoadError::At {
            location,
            message: joined(format_args!("{message}"), ": "),
            help,
            unreadable,
        };
    }
    let alone = |k: &usize| !reads(&tree_with(root, values, |other| other == *k));
    let blamed = (0..values.len()).find(alone);
    let place = blamed.map_or_else(|| whole.clone(), |k| values[k].value.place());
    let values = values.iter().enumerate();
    let values = values.filter(|(k, _)| blamed.is_none_or(|blamed| blamed == *k));
    let words = values.map(|(_, own)| format!("`{}` = {}", own.path, shown(&own.value)));
    let words = words.collect::<Vec<_>>().join(", ");
    LoadError::At {
        message: joined(format_args!("{words}: {message} ({location})"), ", "),
        location: Box::new(place.location()),
        help,
        unreadable,
    }
}
