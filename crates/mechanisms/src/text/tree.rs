//! A mechanism's text, taken apart once: every value with its parts and the place it comes from.
//!
//! Reading, `vary`, values from code and the names of parameters all use the same tree. A design is the
//! tree with other values at some places: what is not on the way to them is shared, and no text is read
//! again. What a tree does not know of a value, because it is no value of that form, is asked of the
//! value's text, so that mistakes are told as they are without a tree.
//!
//! Expressions stand in it as they are written; [`Scope`](super::scope::Scope) makes a tree of it in which
//! their values stand in their places.

use std::ops::Range;
use std::sync::Arc;

use super::dimension::Dimension;
use super::expression::Expression;
use super::fragment::Fragment;
use super::json;
use super::source::{Place, Source};
use super::units;
use crate::error::LoadError;

/// A value and its parts. A copy shares the parts.
#[derive(Debug, Clone)]
pub(crate) struct Node {
    pub(super) source: Arc<Source>,
    pub(super) span: Range<usize>,
    pub(crate) content: Content,
}

/// What a value is made of.
#[derive(Debug, Clone)]
pub(crate) enum Content {
    /// A finite number.
    Number(f64),
    /// A number of this dimension.
    Measured(f64, Dimension),
    /// A text, without its quotes.
    Text(Arc<str>),
    /// A text that begins with `=`.
    Expression(Arc<Expression>),
    /// What is wrong with an expression that stands here.
    Failed(Arc<LoadError>),
    Tuple(Arc<[Node]>),
    List(Arc<[Node]>),
    Map(Arc<[Named]>),
    Fields(Arc<[Named]>),
    /// A kind, by its place, and its arguments.
    Kind(Range<usize>, Option<Arc<Node>>),
    /// Anything else, mistakes too.
    Other,
}

/// An entry of a map, or a field.
#[derive(Debug, Clone)]
pub(crate) struct Named {
    /// The name, without quotes.
    pub(crate) name: Arc<str>,
    /// Where it stands.
    pub(crate) source: Arc<Source>,
    pub(crate) at: Range<usize>,
    pub(crate) value: Node,
}

/// Way to a value from the outside in: at every step the place among the parts, from 0.
pub(crate) type Steps = Vec<usize>;

/// Deepest part that is taken apart: deeper than what ron reads.
const DEEPEST: usize = 256;

/// Fields that hold names: their objects are told from fields and kinds by this alone in JSON.
pub(crate) const MAPS: [&str; 18] = [
    "parameters",
    "groups",
    "copies",
    "mechanisms",
    "releases",
    "springs",
    "offset",
    "overrides",
    "materials",
    "sections",
    "points",
    "bodies",
    "joints",
    "cases",
    "misfits",
    "preloads",
    "vary",
    "labels",
];

impl Node {
    /// The tree of a value of a file.
    pub(crate) fn of(value: Fragment<'_>) -> Self {
        match value.is_json() {
            true => Self::of_json(value, false, 0),
            false => Self::at_depth(value, 0),
        }
    }

    /// The tree of names with values, which JSON does not tell from fields.
    pub(crate) fn of_map(value: Fragment<'_>) -> Self {
        match value.is_json() {
            true => Self::of_json(value, true, 0),
            false => Self::of(value),
        }
    }

    /// The tree of what stands at a place.
    pub(crate) fn at(place: &Place) -> Self {
        Self::of(Fragment::at(place))
    }

    /// A number that is asked for at `origin` without standing there, such as one of a range: of this
    /// dimension, if any.
    pub(crate) fn number(number: f64, dimension: Option<Dimension>, origin: Place) -> Self {
        let text = written(number);
        Self {
            span: 0..text.len(),
            content: match (number.is_finite(), dimension) {
                (true, None) => Content::Number(number),
                (true, Some(dimension)) => Content::Measured(number, dimension),
                (false, _) => Content::Other,
            },
            source: Source::made(text, origin),
        }
    }

    /// A value that is not taken apart: all is asked of its text.
    pub(crate) fn whole(value: Fragment<'_>) -> Self {
        Self {
            source: Arc::clone(value.source()),
            span: value.span(),
            content: Content::Other,
        }
    }

    /// The same place with another content.
    pub(crate) fn with(&self, content: Content) -> Self {
        Self {
            source: Arc::clone(&self.source),
            span: self.span.clone(),
            content,
        }
    }

    /// The fields of a struct, or of the arguments of a kind.
    pub(super) fn fields(&self) -> &[Named] {
        match &self.content {
            Content::Fields(named) => named,
            Content::Kind(_, Some(inner)) => inner.fields(),
            _ => &[],
        }
    }

    /// Names of the fields of a struct, or of the arguments of a kind.
    pub(crate) fn field_names(&self) -> impl Iterator<Item = &str> {
        self.fields().iter().map(|own| &*own.name)
    }

    /// Names of the entries of a map.
    pub(crate) fn entry_names(&self) -> impl Iterator<Item = &str> {
        let named: &[Named] = match &self.content {
            Content::Map(named) => named,
            _ => &[],
        };
        named.iter().map(|own| &*own.name)
    }

    /// Whether there are expressions in it.
    pub(crate) fn has_expressions(&self) -> bool {
        match &self.content {
            Content::Expression(_) => true,
            Content::Tuple(items) | Content::List(items) => items.iter().any(Self::has_expressions),
            Content::Map(named) | Content::Fields(named) => {
                named.iter().any(|own| own.value.has_expressions())
            }
            Content::Kind(_, Some(inner)) => inner.has_expressions(),
            _ => false,
        }
    }

    /// Puts the entries of a map into the map that stands in this field, each in the place of the one of
    /// its name; a field that there is not is made.
    pub(super) fn put_into(&mut self, field: &str, map: &Self) {
        let named = match &mut self.content {
            Content::Fields(named) => named,
            Content::Kind(_, Some(inner)) => return Arc::make_mut(inner).put_into(field, map),
            _ => return,
        };
        let own = named.iter().position(|own| &*own.name == field);
        let Some(own) = own.and_then(|k| Arc::make_mut(named).get_mut(k)) else {
            let made = Named {
                name: field.into(),
                source: Arc::clone(&map.source),
                at: 0..0,
                value: map.clone(),
            };
            *named = named.iter().cloned().chain([made]).collect();
            return;
        };
        let (Content::Map(old), Content::Map(new)) = (&own.value.content, &map.content) else {
            return;
        };
        let mut entries = old.to_vec();
        for entry in new.iter() {
            match entries.iter_mut().find(|old| old.name == entry.name) {
                Some(old) => old.value = entry.value.clone(),
                None => entries.push(entry.clone()),
            }
        }
        own.value.content = Content::Map(entries.into());
    }

    /// Calls `take` for every expression in it.
    pub(crate) fn expressions<'n>(&'n self, take: &mut dyn FnMut(&'n Expression)) {
        match &self.content {
            Content::Expression(expression) => take(expression),
            Content::Tuple(items) | Content::List(items) => {
                items.iter().for_each(|item| item.expressions(take));
            }
            Content::Map(named) | Content::Fields(named) => {
                named.iter().for_each(|own| own.value.expressions(take));
            }
            Content::Kind(_, Some(inner)) => inner.expressions(take),
            _ => {}
        }
    }

    /// Takes the field of this name away from the arguments of a kind.
    pub(super) fn drop_of_kind(&mut self, name: &str) {
        if let Content::Kind(_, Some(inner)) = &mut self.content
            && let Content::Fields(named) = &mut Arc::make_mut(inner).content
        {
            *named = named
                .iter()
                .filter(|own| &*own.name != name)
                .cloned()
                .collect();
        }
    }

    /// The number that stands here, SI; of an expression not even that there is one is known.
    pub(crate) fn as_number(&self) -> Option<f64> {
        match &self.content {
            Content::Number(number) | Content::Measured(number, _) => Some(*number),
            Content::Text(text) => units::read(text, None).ok().map(|found| found.value),
            _ => None,
        }
    }

    fn at_depth(value: Fragment<'_>, depth: usize) -> Self {
        let part = |part: Fragment<'_>| Self::at_depth(part, depth + 1);
        let parts = |parts: Vec<Fragment<'_>>| parts.into_iter().map(part).collect();
        let content = match value.text().chars().next() {
            _ if depth > DEEPEST => None,
            Some('{') => value.map().ok().map(|entries| {
                let named = entries.into_iter().map(|entry| Named {
                    name: entry.name.into(),
                    source: Arc::clone(entry.key.source()),
                    at: entry.key.span(),
                    value: part(entry.value),
                });
                Content::Map(named.collect())
            }),
            Some('[') => value.list("").ok().map(|items| Content::List(parts(items))),
            // What a large file has most of is tuples, and the place of a mistake takes long to find.
            Some('(') => match value.pieces() {
                Some(fields) => {
                    let named = fields.into_iter().map(|(name, value)| Named {
                        name: name.text().into(),
                        source: Arc::clone(name.source()),
                        at: name.span(),
                        value: part(value),
                    });
                    Some(Content::Fields(named.collect()))
                }
                None => (value.tuple("").ok()).map(|items| Content::Tuple(parts(items))),
            },
            Some('"') if Expression::begins(value.text()) => {
                let expression = Expression::read(value.text());
                Some(Content::Expression(Arc::new(expression)))
            }
            Some('"') => value.string().ok().map(|text| Content::Text(text.into())),
            Some(first) if first.is_alphabetic() || first == '_' => {
                let kind = value.variant("").ok();
                kind.map(|(kind, inner)| Content::Kind(kind.span(), inner.map(part).map(Arc::new)))
            }
            _ => value.plain_number().ok().map(Content::Number),
        };
        Self {
            source: Arc::clone(value.source()),
            span: value.span(),
            content: content.unwrap_or(Content::Other),
        }
    }

    /// The tree of a JSON value; `map` says that names stand in it, not fields.
    fn of_json(value: Fragment<'_>, map: bool, depth: usize) -> Self {
        let part = |part: Fragment<'_>| Self::of_json(part, false, depth + 1);
        let content = match value.text().chars().next() {
            _ if depth > DEEPEST => None,
            Some('{') if map => value.map().ok().map(|entries| {
                let named = entries.into_iter().map(|entry| Named {
                    name: entry.name.into(),
                    source: Arc::clone(entry.key.source()),
                    at: entry.key.span(),
                    value: part(entry.value),
                });
                Content::Map(named.collect())
            }),
            Some('{') => Self::fields_or_kind(value, depth),
            Some('[') => (value.list("").ok())
                .map(|items| Content::List(items.into_iter().map(part).collect())),
            Some('"') => value.string().ok().map(|text| {
                // Without escapes its places are those of the file.
                let plain = format!("\"{text}\"");
                match Expression::begins(&plain) {
                    true => Content::Expression(Arc::new(Expression::read(&plain))),
                    false => Content::Text(text.into()),
                }
            }),
            _ => value.plain_number().ok().map(Content::Number),
        };
        Self {
            source: Arc::clone(value.source()),
            span: value.span(),
            content: content.unwrap_or(Content::Other),
        }
    }

    /// A JSON object that is no map.
    fn fields_or_kind(value: Fragment<'_>, depth: usize) -> Option<Content> {
        let pieces = value.pieces()?;
        let part = |part: Fragment<'_>, map| Self::of_json(part, map, depth + 1);
        if let ([(kind, inner)], true) = (
            &pieces[..],
            json::is_kind(pieces.iter().map(|(name, _)| name.text())),
        ) {
            let node = part(*inner, false);
            // In the place of the parentheses that a kind's one argument has in RON.
            let inner = match (&node.content, inner.text()) {
                (_, "null") => None,
                (Content::Fields(_) | Content::Kind(..), _) => Some(node),
                _ => Some(Self {
                    source: Arc::clone(&node.source),
                    span: node.span.clone(),
                    content: Content::Tuple([node].into()),
                }),
            };
            return Some(Content::Kind(kind.span(), inner.map(Arc::new)));
        }
        let named = pieces.into_iter().map(|(name, value)| Named {
            name: name.text().into(),
            source: Arc::clone(name.source()),
            at: name.span(),
            value: part(value, MAPS.contains(&name.text())),
        });
        Some(Content::Fields(named.collect()))
    }

    pub(crate) fn source(&self) -> &Arc<Source> {
        &self.source
    }

    pub(crate) fn text(&self) -> &str {
        self.source.text().get(self.span.clone()).unwrap_or("")
    }

    pub(crate) fn place(&self) -> Place {
        Place {
            source: Arc::clone(&self.source),
            span: self.span.clone(),
        }
    }

    /// Part `k` of what stands in the parentheses of a kind, or of the value itself.
    pub(crate) fn part(&self, k: usize) -> Option<&Self> {
        match &self.content {
            Content::Tuple(items) | Content::List(items) => items.get(k),
            Content::Map(named) | Content::Fields(named) => named.get(k).map(|own| &own.value),
            Content::Kind(_, Some(inner)) => inner.part(k),
            _ => None,
        }
    }

    /// The parts of it, each with the step of a path that leads there.
    pub(crate) fn parts(&self) -> Vec<(String, &Self)> {
        match &self.content {
            Content::Tuple(items) | Content::List(items) => {
                let items = items.iter().enumerate();
                items.map(|(k, item)| (k.to_string(), item)).collect()
            }
            Content::Map(named) | Content::Fields(named) => {
                let named = named.iter();
                named
                    .map(|own| (own.name.to_string(), &own.value))
                    .collect()
            }
            Content::Kind(_, Some(inner)) => inner.parts(),
            _ => Vec::new(),
        }
    }

    /// The value that some steps lead to.
    pub(crate) fn find(&self, steps: &[usize]) -> Option<&Self> {
        steps.iter().try_fold(self, |node, &k| node.part(k))
    }

    /// Puts a value in the place of the one that some steps lead to.
    pub(crate) fn replace(&mut self, steps: &[usize], value: Self) {
        let Some((&first, rest)) = steps.split_first() else {
            *self = value;
            return;
        };
        let part = match &mut self.content {
            Content::Tuple(items) | Content::List(items) => Arc::make_mut(items).get_mut(first),
            Content::Map(named) | Content::Fields(named) => {
                let own = Arc::make_mut(named).get_mut(first);
                own.map(|own| &mut own.value)
            }
            Content::Kind(_, Some(inner)) => return Arc::make_mut(inner).replace(steps, value),
            _ => None,
        };
        if let Some(part) = part {
            part.replace(rest, value);
        }
    }

    /// All finite numbers in it that a path leads to, each with its path and its steps; expressions, too.
    pub(crate) fn numbers(&self) -> Vec<Number> {
        let mut found = Vec::new();
        self.add_numbers("", &mut Vec::new(), &mut found);
        found
    }

    fn add_numbers(&self, path: &str, steps: &mut Steps, found: &mut Vec<Number>) {
        match &self.content {
            Content::Number(_)
            | Content::Measured(..)
            | Content::Text(_)
            | Content::Expression(_) => {
                let value = self.as_number();
                if value.is_some() || matches!(self.content, Content::Expression(_)) {
                    found.push(Number {
                        path: path.into(),
                        steps: steps.clone(),
                        value,
                    });
                }
                return;
            }
            _ => {}
        }
        let parts = self.parts();
        let dotted = parts.iter().any(|(name, _)| name.contains('.'));
        let before = path.len() + usize::from(!path.is_empty());
        for (k, (name, part)) in parts.iter().enumerate() {
            let path = match path {
                "" => name.clone(),
                path => format!("{path}.{name}"),
            };
            let start = found.len();
            steps.push(k);
            part.add_numbers(&path, steps, found);
            steps.pop();
            // Where a name goes on as another one does, a path may lead there.
            let longer = |other: &&(String, &Self)| {
                let rest = other.0.strip_prefix(name.as_str());
                rest.is_some_and(|rest| rest.starts_with('.'))
            };
            for (other, _) in parts.iter().filter(|_| dotted).filter(longer) {
                let mut place = 0;
                found.retain(|number| {
                    place += 1;
                    place <= start || !starts_with(&number.path[before..], other)
                });
            }
        }
    }
}

/// A number in a tree.
#[derive(Debug)]
pub(crate) struct Number {
    pub(crate) path: String,
    pub(crate) steps: Steps,
    /// `None` of an expression.
    pub(crate) value: Option<f64>,
}

/// Whether the first steps of a path are this name.
pub(super) fn starts_with(path: &str, name: &str) -> bool {
    let rest = path.strip_prefix(name);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// The shortest number that reads back to the same double; whole ones as what counts is written.
pub(crate) fn written(number: f64) -> String {
    /// Whole numbers up to here are written without a point.
    const LARGEST: f64 = 1e15;
    if number.fract() == 0.0 && number.abs() < LARGEST {
        format!("{number:.0}")
    } else {
        format!("{number:?}")
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::text::files::MemoryFiles;
    use crate::text::paths;

    fn tree(text: &str) -> Node {
        let source = Source::new(Path::new("f.ron"), text, &MemoryFiles::new());
        Node::of(Fragment::of_file(&source).unwrap())
    }

    fn steps(tree: &Node, path: &str) -> Steps {
        let source = Source::argument("path", format!("{path:?}"), None);
        paths::find(tree, Fragment::at(&Place::whole(&source)), "the tree").unwrap()
    }

    const TEXT: &str = r#"(
        name: "five", // no number
        sections: { "rod": Circle(diameter: 0.02), "a": General(area: 1e-4), "a.area": (area: 3) },
        points: { "A": (0.0, -1, 2.5) }, list: [1, (x: 2), [3, Kind(4)]], count: 7, flag: true,
    )"#;

    #[test]
    fn every_number_has_its_path_and_every_path_its_number() {
        let tree = tree(TEXT);
        let found = tree.numbers();
        let listed: Vec<_> = (found.iter())
            .map(|n| (n.path.as_str(), n.value.unwrap()))
            .collect();
        // No path leads to the area of `a`: `sections.a.area` is another section.
        let expected = [
            ("sections.rod.diameter", 0.02),
            ("sections.a.area.area", 3.0),
            ("points.A.0", 0.0),
            ("points.A.1", -1.0),
            ("points.A.2", 2.5),
            ("list.0", 1.0),
            ("list.1.x", 2.0),
            ("list.2.0", 3.0),
            ("list.2.1.0", 4.0),
            ("count", 7.0),
        ];
        assert_eq!(listed, expected);
        for number in found {
            assert_eq!(steps(&tree, &number.path), number.steps, "{}", number.path);
            let value = Fragment::of_node(tree.find(&number.steps).unwrap());
            assert_eq!(value.number().ok(), number.value);
        }
    }

    #[test]
    fn what_is_not_on_the_way_to_a_value_is_shared() {
        let whole = tree(TEXT);
        let mut changed = whole.clone();
        let origin = whole.place();
        let way = steps(&whole, "sections.rod.diameter");
        changed.replace(&way, Node::number(0.03, None, origin));
        let number = |tree: &Node| Fragment::of_node(tree.find(&way).unwrap()).number();
        assert_eq!(
            (number(&whole).unwrap(), number(&changed).unwrap()),
            (0.02, 0.03)
        );
        let parts = |tree: &Node, path: &str| match &tree.find(&steps(tree, path)).unwrap().content
        {
            Content::List(items) | Content::Tuple(items) => Arc::as_ptr(items).cast::<()>(),
            Content::Map(named) | Content::Fields(named) => Arc::as_ptr(named).cast::<()>(),
            other => panic!("{other:?}"),
        };
        for path in ["points", "list", "sections.a.area"] {
            assert_eq!(parts(&whole, path), parts(&changed, path), "{path}");
        }
        assert_ne!(parts(&whole, "sections"), parts(&changed, "sections"));
    }
}
