//! The parameters of a job: they take the place of those of its mechanism, and its expressions use them.

use std::collections::HashSet;

use super::subject::Recipe;
use crate::error::LoadError;
use crate::file::groups;
use crate::file::loads::Acting;
use crate::text::dependence::{self, Dependence};
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;
use crate::text::names;
use crate::text::scope::{self, PARAMETERS, Scope};
use crate::text::tree::Node;

impl Recipe {
    /// The same mechanism with what these fields say of parameters and of what acts.
    pub(crate) fn with_fields(&self, fields: &Fields<'_>) -> Result<Self, LoadError> {
        let given = fields.get(PARAMETERS).map(Node::of_map);
        let mut root = self.own.clone();
        for parameters in self.shared.iter().chain(&given) {
            scope::put(&mut root, parameters)?;
        }
        Ok(Self {
            root,
            given,
            acting: Acting::find(fields),
            ..self.clone()
        })
    }

    /// Refuses a parameter of the job that takes the place of no other, and that neither the mechanism
    /// nor the job's `fields` use.
    pub(crate) fn check_parameters(&self, fields: &[(&str, Node)]) -> Result<(), LoadError> {
        let Some(given) = &self.given else {
            return Ok(());
        };
        let mut known = scope::parameters(&self.own).collect::<Vec<_>>();
        known.extend(self.shared.iter().flat_map(Node::entry_names));
        let mut used = HashSet::new();
        for node in fields.iter().map(|(_, node)| node).chain([&self.root]) {
            node.expressions(&mut |expression| used.extend(expression.names()));
        }
        for entry in Fragment::of_node(given).map()? {
            let name = entry.name.as_str();
            if !known.contains(&name) && !used.contains(name) {
                let error = entry
                    .key
                    .error(format!("nothing uses the parameter `{name}`"));
                return Err(error.with_help(names::help(name, "parameters", known)));
            }
        }
        Ok(())
    }

    /// Fields of the job with the values of their expressions; `None` where they have none.
    pub(crate) fn valued<'f>(
        &self,
        fields: &[(&'f str, Node)],
    ) -> Result<Option<Vec<(&'f str, Node)>>, LoadError> {
        let others = |name: &str| !["mechanism", PARAMETERS].contains(&name);
        let expressions = |(name, node): &(&str, Node)| others(name) && node.has_expressions();
        if !fields.iter().any(expressions) {
            return Ok(None);
        }
        let known = groups::with_copies(&self.root)?;
        let scope = Scope::new(&known)?;
        let valued = |(name, node): &(&'f str, Node)| match others(name) {
            true => (*name, scope.valued(node)),
            false => (*name, node.clone()),
        };
        Ok(Some(fields.iter().map(valued).collect()))
    }

    /// The parameters of the mechanism, written so, and what depends on each.
    pub(crate) fn dependences(&self, root: &Node) -> Vec<Dependence> {
        let beside: Vec<_> = self.acting.given().collect();
        dependence::dependences(root, &beside)
    }
}
