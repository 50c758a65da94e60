//! What a parameter can reach, by names alone: of what only copies of groups know.

use std::collections::HashSet;

use super::{Expression, Scope};
use crate::text::tree::Node;

impl Scope<'_> {
    /// Whether the varied parameter can change what an expression gives: it stands in it, or in what its
    /// names stand for. A name that is none here is of a copy: anything in the groups may stand for it.
    pub(super) fn can_reach(&self, expression: &Expression) -> bool {
        let mut seen: HashSet<&str> = HashSet::new();
        let mut left: Vec<&str> = expression.names().collect();
        let mut in_groups = Some(());
        while let Some(name) = left.pop() {
            if self.varied.as_deref() == Some(name) {
                return true;
            }
            if !seen.insert(name) {
                continue;
            }
            let own = self.parameters.get(name).or(self.points().get(name));
            match own {
                Some(node) => add_names(node, &mut left),
                None if in_groups.take().is_some() => {
                    let fields = self.root.fields().iter();
                    let groups = fields.filter(|own| ["groups", "copies"].contains(&&*own.name));
                    groups.for_each(|own| add_names(&own.value, &mut left));
                }
                None => {}
            }
        }
        false
    }
}

/// Adds the names that stand in the expressions of a value.
fn add_names<'n>(node: &'n Node, names: &mut Vec<&'n str>) {
    node.expressions(&mut |expression| names.extend(expression.names()));
}
