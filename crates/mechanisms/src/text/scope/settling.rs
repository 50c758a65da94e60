//! Expressions that stay the same from design to design, whose values are found once.

use std::cell::Cell;
use std::sync::Arc;

use super::{MECHANISMS, Operand, PARAMETERS, Scope};
use crate::error::LoadError;
use crate::text::tree::{Content, Node, Steps};

/// What varies, as it stands in a tree that is settled.
#[derive(Debug, Clone)]
pub(crate) struct Open(Arc<LoadError>);

/// A scope that leaves alone what leans on what varies.
#[derive(Debug)]
pub(super) struct Settling {
    open: Open,
    /// Whether something has no value for another reason.
    lost: Cell<bool>,
}

impl Open {
    /// A tree in which these places are open.
    pub(crate) fn mark(tree: &Node, places: &[Steps]) -> (Self, Node) {
        let open = Self(Arc::new(tree.place().error("varies")));
        let mut marked = tree.clone();
        for steps in places {
            if let Some(own) = tree.find(steps) {
                marked.replace(steps, own.with(Content::Failed(Arc::clone(&open.0))));
            }
        }
        (open, marked)
    }
}

impl<'t> Scope<'t> {
    /// The names of a mechanism in which something is open.
    ///
    /// # Errors
    /// A name that cannot be one.
    pub(crate) fn settling(root: &'t Node, open: &Open) -> Result<Self, LoadError> {
        let mut scope = Self::unchecked(root, None)?;
        scope.settling = Some(Settling {
            open: open.clone(),
            lost: Cell::new(false),
        });
        Ok(scope)
    }

    /// A value with those of its expressions that lean on nothing open; `None` where one has no value for
    /// another reason, which is told where it is read.
    pub(crate) fn settled(&self, node: &Node) -> Option<Node> {
        let tree = self.valued(node);
        let lost = |settling: &Settling| settling.lost.get();
        (!self.settling.as_ref().is_some_and(lost)).then_some(tree)
    }

    /// Whether something in a value leans on something open.
    pub(crate) fn is_open(&self, node: &Node) -> bool {
        match &node.content {
            Content::Expression(expression) => self.leans(&self.evaluated(expression, node)),
            Content::Failed(error) => self.leans(&Err(Arc::clone(error))),
            _ => node.parts().into_iter().any(|(_, part)| self.is_open(part)),
        }
    }

    fn leans(&self, found: &Result<Operand, Arc<LoadError>>) -> bool {
        match (&self.settling, found) {
            (Some(settling), Err(error)) => Arc::ptr_eq(error, &settling.open.0),
            _ => false,
        }
    }

    /// Whether a field of the mechanism stays as it is written.
    pub(super) fn keeps(&self, field: &str) -> bool {
        [PARAMETERS, MECHANISMS].contains(&field)
            || (self.settling.is_some() && ["groups", "copies"].contains(&field))
    }

    /// Whether an expression that gives this stays as it is written.
    pub(super) fn stays(&self, found: &Result<Operand, Arc<LoadError>>) -> bool {
        let (Some(settling), Err(_)) = (&self.settling, found) else {
            return false;
        };
        if !self.leans(found) {
            settling.lost.set(true);
        }
        true
    }
}
