//! What a job may vary: its mechanism, and what it says beside it of what acts.

use super::subject::{Checked, Recipe};
use crate::error::LoadError;
use crate::file::groups;
use crate::file::loads::{Acting, FIELDS};
use crate::text::fragment::Fragment;
use crate::text::paths;
use crate::text::scope::{Open, PARAMETERS, Scope};
use crate::text::tree::{Content, Node, Steps};

impl Recipe {
    /// One tree of all that may vary: the mechanism as it is written, then the job's own fields, those that
    /// are not given as they are not.
    pub(crate) fn whole(&self) -> Node {
        let fields = self.acting.trees();
        let fields = fields.map(|field| field.unwrap_or_else(|| self.root().with(Content::Other)));
        let parts = std::iter::once(self.root().clone()).chain(fields);
        self.root().with(Content::Tuple(parts.collect()))
    }

    /// The ways in that tree to all places that the path written at `key` names. One that begins with a
    /// field that the job gives is the job's, any other the mechanism's.
    pub(crate) fn places(&self, key: Fragment<'_>) -> Result<Vec<Steps>, LoadError> {
        let fields: Vec<Option<Node>> = self.acting.trees().collect();
        let find = |path: &str| {
            let first = path.split('.').next().unwrap_or(path);
            let field = FIELDS.iter().position(|name| *name == first);
            let (part, steps) = match field.and_then(|k| Some((k, fields[k].as_ref()?))) {
                Some((k, _)) if first.len() == path.len() => (1 + k, Steps::new()),
                Some((k, node)) => (1 + k, paths::find_path(node, key, path, first.len() + 1)?),
                None => (0, paths::find_path(self.root(), key, path, 0)?),
            };
            Ok(std::iter::once(part).chain(steps).collect())
        };
        paths::every(&key.string()?, find, key)
    }

    /// Steps in that tree as steps in the mechanism's; `None` of those to a field of the job.
    pub(crate) fn in_mechanism(steps: &Steps) -> Option<Steps> {
        match steps.split_first() {
            Some((0, rest)) => Some(rest.to_vec()),
            _ => None,
        }
    }

    /// The mechanism of such a tree.
    pub(crate) fn root_of(&self, whole: &Node) -> Node {
        whole.part(0).unwrap_or(self.root()).clone()
    }

    /// Reads and checks such a tree; `settled` is the same with those of its values that are known in the
    /// places of expressions.
    pub(crate) fn read_whole(&self, whole: &Node, settled: &Node) -> Result<Checked, LoadError> {
        let [root, own] = [whole, settled].map(|tree| tree.part(0).unwrap_or(self.root()));
        self.read_under(
            [root, own],
            [&self.acting_of(whole), &self.acting_of(settled)],
        )
    }

    /// What acts, of such a tree.
    fn acting_of(&self, whole: &Node) -> Acting {
        let parts = (0..FIELDS.len()).map(|k| whole.part(1 + k));
        self.acting.with_trees(parts)
    }

    /// Such a tree with the values of those expressions in their places that lean on nothing which stands
    /// at these `places`: what is the same in every design is found once.
    pub(crate) fn settled(&self, whole: &Node, places: &[Steps]) -> Node {
        if !whole.has_expressions() {
            return whole.clone();
        }
        let (open, marked) = Open::mark(whole, places);
        let mut tree = self.settled_under(&marked, &open).unwrap_or(marked);
        for steps in places {
            if let Some(own) = whole.find(steps) {
                tree.replace(steps, own.clone());
            }
        }
        tree
    }

    /// Whether what stands at these `places` is a parameter that nothing of the mechanism leans on, and nothing that
    /// acts on it; then the name of the first field of the job that does, of those which are the same in every
    /// design.
    pub(super) fn idle(
        &self,
        places: &[Steps],
        fields: &[(&'static str, Node)],
    ) -> Option<Option<&'static str>> {
        let of_parameters = |steps: &Steps| {
            let own = Self::in_mechanism(steps)?;
            let names = self.root().field_names().collect::<Vec<_>>();
            (names.get(*own.first()?) == Some(&PARAMETERS)).then_some(())
        };
        if places.iter().any(|steps| of_parameters(steps).is_none()) {
            return None;
        }
        let (open, marked) = Open::mark(&self.whole(), places);
        let root = groups::with_copies(&self.root_of(&marked)).ok()?;
        let scope = Scope::settling(&root, &open).ok()?;
        let own = (root.parts().into_iter()).filter(|(name, _)| name != PARAMETERS);
        let acting = (0..FIELDS.len()).filter_map(|k| marked.part(1 + k));
        if own
            .map(|(_, part)| part)
            .chain(acting)
            .any(|node| scope.is_open(node))
        {
            return None;
        }
        let same = |name: &str| {
            !FIELDS.contains(&name) && !["mechanism", PARAMETERS, "vary"].contains(&name)
        };
        let mut fields = fields
            .iter()
            .filter(|(name, node)| same(name) && scope.is_open(node));
        Some(fields.next().map(|(name, _)| *name))
    }

    fn settled_under(&self, marked: &Node, open: &Open) -> Option<Node> {
        let root = self.root_of(marked);
        let known = groups::with_copies(&root).ok();
        let scope = (known.as_ref()).and_then(|known| Scope::settling(known, open).ok());
        let acting = (0..FIELDS.len()).map(|k| {
            let field = marked.part(1 + k)?;
            let settled = scope.as_ref().and_then(|scope| scope.settled(field));
            Some(settled.unwrap_or_else(|| field.clone()))
        });
        let parts = std::iter::once(groups::settled(&root, open)).chain(acting);
        Some(marked.with(Content::Tuple(parts.collect::<Option<_>>()?)))
    }
}

impl Acting {
    /// What is given of its fields, each taken apart.
    fn trees(&self) -> impl Iterator<Item = Option<Node>> {
        let tree = |(node, name): (&Option<Node>, &str)| {
            let node = node.as_ref()?;
            let apart = matches!(node.content, Content::Other);
            Some(
                match (apart, ["cases", "misfits", "preloads"].contains(&name)) {
                    (false, _) => node.clone(),
                    (true, true) => Node::of_map(Fragment::of_node(node)),
                    (true, false) => Node::of(Fragment::of_node(node)),
                },
            )
        };
        self.fields().map(tree)
    }

    /// The same fields with these values.
    fn with_trees<'n>(&self, values: impl Iterator<Item = Option<&'n Node>>) -> Self {
        self.replaced(values.map(|value| value.cloned()))
    }
}
