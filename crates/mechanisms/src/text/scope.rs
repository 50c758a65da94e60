//! What names stand for in the expressions of a mechanism: its parameters and its points.
//!
//! The tree of a file keeps expressions as they are written, so that another value of a parameter
//! reaches whatever depends on it. What is read is a tree in which their values stand in their places.

mod reach;
mod settling;

use std::cell::{OnceCell, RefCell};
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use super::copied::Copied;
use super::dimension::Dimension;
use super::expression::{self, CONSTANTS, Dual, Expression, Failure, Operand};
use super::fragment::Fragment;
use super::source::Place;
use super::tree::{Content, Named, Node};
use crate::error::LoadError;
use crate::text::names;
pub(crate) use settling::Open;
use settling::Settling;

/// Name of the field that holds the parameters.
pub(crate) const PARAMETERS: &str = "parameters";

/// Name of the field that holds what is mounted, whose values have names of their own.
pub(crate) const MECHANISMS: &str = "mechanisms";

/// Name of the field that holds the tree of what is mounted, in its entry.
pub(crate) const TREE: &str = "mechanism";

/// Parameters and points that lean on each other, one behind the other, at the most.
const LONGEST: usize = 100;

/// The parameters and points of a mechanism.
#[derive(Debug)]
pub(crate) struct Scope<'t> {
    parameters: HashMap<&'t str, &'t Node>,
    /// In the order of the file.
    order: &'t [Named],
    root: &'t Node,
    points: OnceCell<HashMap<&'t str, &'t Node>>,
    /// The parameter whose derivatives are found.
    varied: Option<String>,
    /// What of it stays as it is written.
    settling: Option<Settling>,
    known: RefCell<HashMap<Key<'t>, Result<Operand, Arc<LoadError>>>>,
    /// What is being found, from the outside in.
    asked: RefCell<Vec<Key<'t>>>,
}

/// What has one value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Key<'t> {
    Parameter(&'t str),
    Point(&'t str),
    Coordinate(&'t str, usize),
}

type Failed = Failure<Arc<LoadError>>;

impl<'t> Scope<'t> {
    /// The names of a mechanism, all of whose parameters have values.
    ///
    /// # Errors
    /// A name that cannot be one, a parameter without a value.
    pub(crate) fn new(root: &'t Node) -> Result<Self, LoadError> {
        let scope = Self::unchecked(root, None)?;
        for own in scope.order {
            let value = scope.value(Key::Parameter(&own.name));
            value.map_err(|error| error.again())?;
        }
        Ok(scope)
    }

    /// The same; what is wrong with a parameter is told where it is used.
    ///
    /// # Errors
    /// A name that cannot be one.
    pub(crate) fn lazy(root: &'t Node) -> Result<Self, LoadError> {
        Self::unchecked(root, None)
    }

    /// The same, with the derivatives of all values by a parameter.
    ///
    /// # Errors
    /// As [`Scope::new`], but for values.
    pub(super) fn varied(root: &'t Node, parameter: &str) -> Result<Self, LoadError> {
        Self::unchecked(root, Some(parameter))
    }

    /// The value of a parameter that there is.
    pub(super) fn parameter(&self, name: &str) -> Result<Operand, Arc<LoadError>> {
        match self.parameters.get_key_value(name) {
            Some((&name, _)) => self.value(Key::Parameter(name)),
            None => Ok(Operand::Number(Dual::constant(0.0))),
        }
    }

    /// Adds the paths of all values that change with the varied parameter, with their derivatives.
    pub(super) fn each_slope(&self, node: &Node, path: &str, found: &mut Vec<(String, f64)>) {
        if let Content::Expression(expression) = &node.content {
            let slope = match self.evaluated(expression, node) {
                Ok(Operand::Number(number)) => number.slope,
                Ok(Operand::Point(point)) => {
                    let mut slopes = point.iter().map(|c| c.slope);
                    slopes.find(|slope| *slope != 0.0).unwrap_or(0.0)
                }
                // Of what only a copy of a group knows.
                Err(_) if self.can_reach(expression) => f64::NAN,
                Err(_) => 0.0,
            };
            if slope != 0.0 {
                found.push((path.into(), slope));
            }
            return;
        }
        for (name, part) in node.parts() {
            let path = match path {
                "" if [PARAMETERS, MECHANISMS].contains(&&*name) => continue,
                "" => name,
                path => format!("{path}.{name}"),
            };
            self.each_slope(part, &path, found);
        }
    }

    fn unchecked(root: &'t Node, varied: Option<&str>) -> Result<Self, LoadError> {
        let field = root.fields().iter().find(|own| &*own.name == PARAMETERS);
        let order = match field.map(|own| &own.value) {
            None => &[][..],
            Some(map) => match &map.content {
                Content::Map(named) => named.as_ref(),
                _ => {
                    // What is wrong with it as a map.
                    Fragment::of_node(map).map()?;
                    &[]
                }
            },
        };
        let scope = Self {
            parameters: order.iter().map(|own| (&*own.name, &own.value)).collect(),
            order,
            root,
            points: OnceCell::new(),
            varied: varied.map(Into::into),
            settling: None,
            known: RefCell::default(),
            asked: RefCell::default(),
        };
        for own in order {
            scope.check_name(own)?;
        }
        Ok(scope)
    }

    /// The mechanism with the values of its expressions in their places, without its parameters where it
    /// is of a kind.
    ///
    /// # Errors
    /// As [`Scope::new`].
    pub(crate) fn tree(root: &Node) -> Result<Node, LoadError> {
        let has_parameters = root.fields().iter().any(|own| &*own.name == PARAMETERS);
        if !has_parameters && !root.has_expressions() {
            return Ok(root.clone());
        }
        let scope = Scope::new(root)?;
        let mut tree = scope.valued(root);
        tree.drop_of_kind(PARAMETERS);
        Ok(tree)
    }

    /// A value as it stands in a file; one without expressions is not taken apart.
    pub(crate) fn written(value: Fragment<'_>) -> Node {
        match value.text().contains("\"=") {
            true => Node::of(value),
            false => Node::whole(value),
        }
    }

    /// A value with those of its expressions in their places; what is wrong with one stands in its place.
    pub(crate) fn valued(&self, node: &Node) -> Node {
        self.changed(node).unwrap_or_else(|| node.clone())
    }

    /// `None`: nothing in it is an expression.
    fn changed(&self, node: &Node) -> Option<Node> {
        let content = match &node.content {
            Content::Expression(expression) => self.content(expression, node)?,
            Content::Tuple(items) => Content::Tuple(self.all(items)?),
            Content::List(items) => Content::List(self.all(items)?),
            Content::Map(named) => Content::Map(self.all_named(named, false)?),
            Content::Fields(named) => {
                let outermost = std::ptr::eq(named.as_ref(), self.root.fields());
                Content::Fields(self.all_named(named, outermost)?)
            }
            Content::Kind(kind, Some(inner)) => {
                Content::Kind(kind.clone(), Some(Arc::new(self.changed(inner)?)))
            }
            _ => return None,
        };
        Some(node.with(content))
    }

    /// What is before the first change, and where nothing changes, is not looked at twice.
    fn all(&self, items: &[Node]) -> Option<Arc<[Node]>> {
        let mut new = items.iter().map(|item| self.changed(item)).enumerate();
        let (first, changed) = new.find_map(|(k, item)| Some((k, item?)))?;
        let rest = new.map(|(k, item)| item.unwrap_or_else(|| items[k].clone()));
        let before = items[..first].iter().cloned();
        Some(before.chain([changed]).chain(rest).collect())
    }

    /// The parameters themselves, among the outermost fields, stay as they are; and while it is settled
    /// what has names of its own.
    fn all_named(&self, named: &[Named], outermost: bool) -> Option<Arc<[Named]>> {
        let kept = |own: &Named| outermost && self.keeps(&own.name);
        let with = |own: &Named, value: Node| Named {
            value,
            ..own.clone()
        };
        let mut new = (named.iter())
            .map(|own| match kept(own) {
                true => None,
                false => self.changed(&own.value),
            })
            .enumerate();
        let (first, changed) = new.find_map(|(k, value)| Some((k, value?)))?;
        let rest = new.map(|(k, value)| match value {
            Some(value) => with(&named[k], value),
            None => named[k].clone(),
        });
        let before = named[..first].iter().cloned();
        let changed = with(&named[first], changed);
        Some(before.chain([changed]).chain(rest).collect())
    }

    /// What stands in the place of an expression; `None`: itself.
    fn content(&self, expression: &Expression, node: &Node) -> Option<Content> {
        let found = self.evaluated(expression, node);
        if self.stays(&found) {
            return None;
        }
        Some(match found {
            Ok(Operand::Number(number)) => Content::Number(number.value),
            Ok(Operand::Point(point)) => {
                let part = |c: Dual| node.with(Content::Number(c.value));
                Content::Tuple(point.map(part).into())
            }
            Err(error) => Content::Failed(error),
        })
    }

    fn evaluated(&self, expression: &Expression, node: &Node) -> Result<Operand, Arc<LoadError>> {
        let value =
            expression.value(&mut |name, coordinate, at| self.named(name, coordinate, at, node));
        value.map_err(|failure| match failure {
            Failure::Elsewhere(error) => error,
            Failure::Here(mistake) => {
                let error = place(node, &mistake.at).error(mistake.message);
                let error = match mistake.of_values {
                    true => error,
                    false => error.unreadable(),
                };
                Arc::new(error.with_help(mistake.help))
            }
        })
    }

    /// What a name in an expression stands for: a parameter, a constant or a point, or a coordinate of it.
    fn named(
        &self,
        name: &str,
        coordinate: Option<usize>,
        at: &Range<usize>,
        node: &Node,
    ) -> Result<Operand, Failed> {
        let told = |error: LoadError| Failure::Elsewhere(Arc::new(error.unreadable()));
        let key = if let Some((&name, _)) = self.parameters.get_key_value(name) {
            Key::Parameter(name)
        } else if let Some((_, value)) = CONSTANTS.iter().find(|(own, _)| *own == name) {
            return Ok(Operand::Number(Dual::constant(*value)));
        } else if let Some((&name, _)) = self.points().get_key_value(name) {
            coordinate.map_or(Key::Point(name), |k| Key::Coordinate(name, k))
        } else if let Some(copied) = Copied::find(self.root, "points", name) {
            let group = copied.group;
            let error = place(node, at).error(format!(
                "`{name}` is a point of a copy of group `{group}`: what groups lean on cannot lean on copies"
            ));
            let help = "let it lean on the group's own points, or on other parameters";
            return Err(told(error.with_help(help)));
        } else {
            let error = place(node, at).error(format!("unknown name `{name}`"));
            return Err(told(error.with_help(self.help(name))));
        };
        let around = self.asked.borrow().iter().position(|asked| *asked == key);
        if let Some(first) = around {
            let asked = self.asked.borrow();
            let way = asked[first..].iter().chain([&key]).map(Key::name);
            let way = way.collect::<Vec<_>>().join(" → ");
            let message = format!("{} depends on itself: {way}", key.name());
            let help = "give one of them a number";
            return Err(told(place(node, at).error(message).with_help(help)));
        }
        if self.asked.borrow().len() >= LONGEST {
            let message = format!("more than {LONGEST} values lean on each other here");
            let help = "write some of them as numbers";
            return Err(told(place(node, at).error(message).with_help(help)));
        }
        let value = self.value(key).map_err(Failure::Elsewhere)?;
        match (value, coordinate, key) {
            (Operand::Point(point), Some(k), Key::Parameter(_)) => Ok(Operand::Number(point[k])),
            (Operand::Number(_), Some(_), Key::Parameter(_)) => {
                let error = place(node, at).error(format!("`{name}` is a number"));
                Err(told(error.with_help("points have coordinates")))
            }
            (value, ..) => Ok(value),
        }
    }

    /// A value, found once.
    fn value(&self, key: Key<'t>) -> Result<Operand, Arc<LoadError>> {
        if let Some(known) = self.known.borrow().get(&key) {
            return known.clone();
        }
        self.asked.borrow_mut().push(key);
        let mut found = self.found(key);
        self.asked.borrow_mut().pop();
        if let (Key::Parameter(name), Ok(Operand::Number(number))) = (key, &mut found)
            && self.varied.as_deref() == Some(name)
        {
            number.slope = 1.0;
        }
        self.known.borrow_mut().insert(key, found.clone());
        found
    }

    fn found(&self, key: Key<'t>) -> Result<Operand, Arc<LoadError>> {
        match key {
            Key::Parameter(name) => self.operand(self.parameters[name]),
            Key::Coordinate(name, k) => {
                let point = self.points()[name];
                match &point.content {
                    // In JSON a tuple is a list.
                    Content::Tuple(parts) | Content::List(parts) if parts.len() == 3 => {
                        self.operand(&parts[k])
                    }
                    Content::Expression(_) => match self.operand(point)? {
                        Operand::Point(point) => Ok(Operand::Number(point[k])),
                        Operand::Number(_) => Err(no_point(point)),
                    },
                    Content::Failed(error) => Err(Arc::clone(error)),
                    _ => Err(no_point(point)),
                }
            }
            Key::Point(name) => {
                let mut coordinates = [Dual::constant(0.0); 3];
                for (k, coordinate) in coordinates.iter_mut().enumerate() {
                    match self.value(Key::Coordinate(name, k))? {
                        Operand::Number(number) => *coordinate = number,
                        Operand::Point(_) => return Err(no_point(self.points()[name])),
                    }
                }
                Ok(Operand::Point(coordinates))
            }
        }
    }

    /// The value of a part of the file.
    fn operand(&self, node: &Node) -> Result<Operand, Arc<LoadError>> {
        match &node.content {
            Content::Expression(expression) => return self.evaluated(expression, node),
            Content::Failed(error) => return Err(Arc::clone(error)),
            _ => {}
        }
        let number = Fragment::of_node(node).number();
        number
            .map(|number| Operand::Number(Dual::constant(number)))
            .map_err(Arc::new)
    }

    fn points(&self) -> &HashMap<&'t str, &'t Node> {
        self.points.get_or_init(|| {
            let fields = self.root.fields();
            let points = fields.iter().find(|own| &*own.name == "points");
            match points.map(|own| &own.value.content) {
                Some(Content::Map(named)) => {
                    named.iter().map(|own| (&*own.name, &own.value)).collect()
                }
                _ => HashMap::new(),
            }
        })
    }

    /// Refuses a name that no expression could have, or that stands for something else.
    fn check_name(&self, own: &Named) -> Result<(), LoadError> {
        let name = &*own.name;
        let (message, help) = if !expression::is_name(name) {
            let message = format!("`{name}` cannot be the name of a parameter");
            (
                message,
                "a name is of letters, digits and `_`, and begins with no digit",
            )
        } else if CONSTANTS.iter().any(|(constant, _)| *constant == name) {
            (
                format!("`{name}` is a constant"),
                "give the parameter another name",
            )
        } else if expression::functions().any(|function| function == name) {
            (
                format!("`{name}` is a function"),
                "give the parameter another name",
            )
        } else if self.points().contains_key(name) {
            let message = format!("a point has the name `{name}`, too");
            (
                message,
                "give the parameter another name: expressions know points by theirs",
            )
        } else {
            return Ok(());
        };
        let map = self.map();
        // One that a job has put there stands elsewhere.
        let place = match Arc::ptr_eq(map.source(), own.value.source()) {
            false => own.value.place(),
            true => Place {
                source: Arc::clone(map.source()),
                span: own.at.clone(),
            },
        };
        Err(place.error(message).unreadable().with_help(help))
    }

    /// The map of the parameters; the whole where there is none.
    fn map(&self) -> &Node {
        let field = self
            .root
            .fields()
            .iter()
            .find(|own| &*own.name == PARAMETERS);
        field.map_or(self.root, |own| &own.value)
    }

    /// What would be right instead of an unknown name.
    fn help(&self, name: &str) -> String {
        let constants = CONSTANTS.iter().map(|(name, _)| *name);
        let parameters = self.order.iter().map(|own| &*own.name);
        let mut points: Vec<&str> = self.points().keys().copied().collect();
        points.sort_unstable();
        let known = parameters.chain(points).chain(constants);
        if expression::functions().any(|function| function == name) {
            return format!("`{name}` is a function: write `{name}(…)`");
        }
        names::help(name, "parameters, points and constants", known)
    }
}

impl Key<'_> {
    fn name(&self) -> String {
        match self {
            Self::Parameter(name) | Self::Point(name) => format!("`{name}`"),
            Self::Coordinate(name, k) => format!("`{name}.{}`", ["x", "y", "z"][*k]),
        }
    }
}

/// Names of the parameters of a mechanism, in the order of the file.
pub(crate) fn parameters(root: &Node) -> impl Iterator<Item = &str> {
    let field = root.fields().iter().find(|own| &*own.name == PARAMETERS);
    field.into_iter().flat_map(|own| own.value.entry_names())
}

/// Puts parameters into a mechanism, in the place of those of the same names.
///
/// # Errors
/// They are no map, or have names that cannot be.
pub(crate) fn put(mechanism: &mut Node, parameters: &Node) -> Result<(), LoadError> {
    let known = mechanism.get(PARAMETERS);
    for entry in Fragment::of_node(parameters).map()? {
        if let Some(known) = known.and_then(|known| known.get(&entry.name)) {
            let what = format!("the parameter `{}`", entry.name);
            entry.value.in_place_of(Fragment::of_node(known), &what)?;
        }
    }
    mechanism.put_into(PARAMETERS, parameters);
    Ok(())
}

/// The place of some bytes of a value's text.
fn place(node: &Node, at: &Range<usize>) -> Place {
    let Place { source, span } = node.place();
    let end = span.end;
    let [start, last] = [at.start, at.end].map(|k| (span.start + k).min(end));
    Place {
        source,
        span: start..last,
    }
}

/// The error of a point whose coordinates an expression asks for.
fn no_point(point: &Node) -> Arc<LoadError> {
    let read = Fragment::of_node(point).vector("a coordinate", Dimension::LENGTH);
    let error = read.err().unwrap_or_else(|| {
        let error = point.place().error("a point is wanted here");
        error.with_help("such as `= midpoint(A, B)`")
    });
    Arc::new(error.unreadable())
}
