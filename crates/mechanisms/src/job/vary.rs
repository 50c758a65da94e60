//! What varies in a job: paths to values of its mechanism, and the values each of them takes.

use super::subject::Recipe;
use crate::error::{LoadError, Location};
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;
use crate::text::replace::Replacement;
use crate::text::source::Place;
use crate::text::tree::{Node, Steps};
use crate::text::value::Value;
use crate::text::values::Values;
use crate::text::{names, paths};

/// What varies from design to design of a job.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Varied {
    /// Its path in the mechanism as it is written, such as `rod.section.diameter`.
    pub path: String,
    /// Whether all of its values are numbers.
    pub numeric: bool,
    /// The SI unit of its values, where one of them, or what they take the place of, is written with a unit.
    pub unit: Option<String>,
}

/// The designs of a job: all combinations of some values, or the values side by side.
#[derive(Debug)]
pub(crate) struct Variation {
    /// Where the map `vary` stands.
    pub(crate) place: Place,
    /// The tree that it varies: [`Recipe::whole`].
    whole: Node,
    /// The same with the values of expressions that no design changes.
    settled: Node,
    axes: Vec<Axis>,
    /// Whether all axes run together, so that a design has the same place in each.
    zip: bool,
    count: usize,
}

/// One varied value.
#[derive(Debug)]
struct Axis {
    /// Its path in the mechanism.
    path: String,
    /// The ways to it: to all places that the path names as one, in the tree of [`Recipe::whole`].
    places: Vec<Steps>,
    /// Where its values stand.
    place: Place,
    values: AxisValues,
}

#[derive(Debug)]
enum AxisValues {
    Range(Values),
    List(Vec<Node>),
}

impl Variation {
    /// Reads the fields `vary` and `zip` of a job of this recipe, which has so many `poses` and whose fields are
    /// written so.
    pub(crate) fn read(
        fields: &Fields<'_>,
        recipe: &Recipe,
        written: &[(&'static str, Node)],
        poses: usize,
    ) -> Result<Option<Self>, LoadError> {
        let zip = fields.get("zip");
        let Some(map) = fields.get("vary") else {
            return match zip {
                None => Ok(None),
                Some(zip) => Err(zip
                    .error("`zip` without `vary`")
                    .with_help("give `vary: { \"path\": [value, …] }`, or leave `zip` out")),
            };
        };
        let zip = zip.map_or(Ok(false), |zip| zip.parse("`true` or `false`"))?;
        let mut axes = Vec::<Axis>::new();
        let whole = recipe.whole();
        for entry in map.map()? {
            let places = recipe.places(entry.key)?;
            if let Some(field) = replacing(fields, &entry.name) {
                return Err(entry
                    .key
                    .error(format!(
                        "the job's own `{field}` replaces `{}` of the file: varying it would change nothing",
                        entry.name
                    ))
                    .with_help(format!("leave `{field}` out of the job, or vary another value")));
            }
            let overlaps = |axis: &&Axis| paths::any_overlap(&axis.places, &places);
            if let Some(other) = axes.iter().find(overlaps) {
                return Err(paths::overlapping(&other.path, entry.key));
            }
            if let Some(used) = recipe.idle(&places, written) {
                return Err(idle(entry.key, &entry.name, used));
            }
            let values = AxisValues::read(entry.value)?;
            for known in places.iter().filter_map(|steps| whole.find(steps)) {
                values.check(entry.value, Fragment::of_node(known), &entry.name)?;
            }
            axes.push(Axis {
                values,
                path: entry.name,
                place: entry.value.place(),
                places,
            });
        }
        if axes.is_empty() {
            return Err(map
                .error("`vary` names nothing")
                .with_help("give `vary: { \"path\": [value, …] }`, or leave it out"));
        }
        let count = if zip {
            Some(same_length(&axes)?)
        } else {
            let mut counts = axes.iter().map(|axis| axis.values.len());
            counts.try_fold(1_usize, usize::checked_mul)
        };
        let Some(count) = count.filter(|count| count.checked_mul(poses).is_some()) else {
            return Err(map
                .error("more designs and poses than can be counted")
                .with_help("give fewer values, or `zip: true` to take them side by side"));
        };
        let places = axes.iter().flat_map(|axis| axis.places.iter().cloned());
        Ok(Some(Self {
            place: map.place(),
            settled: recipe.settled(&whole, &places.collect::<Vec<_>>()),
            whole,
            axes,
            zip,
            count,
        }))
    }

    /// Number of designs, at least 1.
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// The tree that it varies.
    pub(crate) fn whole(&self) -> &Node {
        &self.whole
    }

    /// The same tree with the values of expressions that no design changes.
    pub(crate) fn settled(&self) -> &Node {
        &self.settled
    }

    /// What varies, in the order of the file.
    pub(crate) fn varied(&self) -> Vec<Varied> {
        let number = |value: &Node| matches!(Value::of(value), Value::Number(_));
        let varied = |axis: &Axis| Varied {
            path: axis.path.clone(),
            numeric: match &axis.values {
                AxisValues::Range(_) => true,
                AxisValues::List(values) => values.iter().all(number),
            },
            unit: self.measures(axis).map(Dimension::unit),
        };
        self.axes.iter().map(varied).collect()
    }

    /// What the values of an axis measure, where they, or what they take the place of, say so.
    fn measures(&self, axis: &Axis) -> Option<Dimension> {
        let of = |node: &Node| Fragment::of_node(node).measured(None).ok()?.1;
        let given = match &axis.values {
            AxisValues::Range(values) => values.dimension(),
            AxisValues::List(values) => values.iter().find_map(of),
        };
        let mut known = axis.places.iter().filter_map(|way| self.whole.find(way));
        given.or_else(|| known.find_map(of))
    }

    /// The ways to the values of every path, in the tree of [`Recipe::whole`].
    pub(crate) fn places(&self) -> impl Iterator<Item = &Steps> {
        self.axes.iter().flat_map(|axis| &axis.places)
    }

    /// The values of design `k`, from 0: the first path runs fastest.
    pub(crate) fn design(&self, k: usize) -> Vec<Replacement<'_>> {
        let mut rest = k;
        let mut values = Vec::with_capacity(self.axes.len());
        for axis in &self.axes {
            let count = axis.values.len();
            values.push(Replacement {
                path: &axis.path,
                places: &axis.places,
                value: axis.value(rest % count),
            });
            if !self.zip {
                rest /= count;
            }
        }
        values
    }

    /// Whether a location is inside of the map `vary`.
    pub(crate) fn holds(&self, location: &Location) -> bool {
        let Place { source, span } = &self.place;
        let offset = source.offset(location.line, location.column);
        location.path == self.place.location().path && span.contains(&offset)
    }

    /// Designs among which every value of every path is found, `most` of a path at most, or all
    /// designs where they are no more.
    pub(crate) fn samples(&self, most: usize) -> Vec<usize> {
        if self.count <= most {
            return (0..self.count).collect();
        }
        let mut samples = Vec::new();
        let mut stride = 1;
        for axis in &self.axes {
            let count = axis.values.len();
            let taken = count.min(most);
            // Evenly spread, from the first to the last.
            let last = (taken - 1).max(1);
            samples.extend(
                (0..taken)
                    .map(|k| stride * ((count - 1) as u128 * k as u128 / last as u128) as usize),
            );
            if self.zip {
                break;
            }
            stride *= count;
        }
        samples
    }
}

/// The error of a parameter that no design depends on; `used` is a field of the job that does.
fn idle(key: Fragment<'_>, name: &str, used: Option<&str>) -> LoadError {
    let message = match used {
        Some(field) => {
            format!("only `{field}` depends on `{name}`, and is the same in every design")
        }
        None => format!("nothing depends on `{name}`: all designs would be the same"),
    };
    key.error(message).with_help(match used {
        Some("poses") => "give all poses in one job, or a job for each value",
        Some(_) => "give a job for each value",
        None => "use it in an expression, or leave it out",
    })
}

/// The number of values that all have.
fn same_length(axes: &[Axis]) -> Result<usize, LoadError> {
    let count = axes[0].values.len();
    match axes.iter().find(|axis| axis.values.len() != count) {
        None => Ok(count),
        Some(other) => {
            let message = format!(
                "`{}` has {count} values and `{}` has {}",
                axes[0].path,
                other.path,
                other.values.len()
            );
            Err(other
                .place
                .error(message)
                .with_help("with `zip: true` all have the same number of values"))
        }
    }
}

impl Axis {
    /// Value number `k`, from 0.
    fn value(&self, k: usize) -> Node {
        match &self.values {
            AxisValues::List(values) => values[k].clone(),
            AxisValues::Range(values) => {
                Node::number(values.get(k), values.dimension(), self.place.clone())
            }
        }
    }
}

/// The field of the job that is taken in place of what stands at a path of its mechanism file.
fn replacing(fields: &Fields<'_>, path: &str) -> Option<&'static str> {
    let mut parts = path.split('.');
    let field = match (parts.next()?, parts.nth(1)) {
        ("joints", Some("misfit")) => "misfits",
        ("joints", Some("preload")) => "preloads",
        _ => return None,
    };
    fields.get(field).map(|_| field)
}

impl AxisValues {
    fn read(fragment: Fragment<'_>) -> Result<Self, LoadError> {
        let expected = "values, `Range(first, last, count)` or a list `[value, …]`";
        if fragment.is_list() {
            let items = fragment.list(expected)?;
            if items.is_empty() {
                return Err(fragment
                    .error("the list of values is empty")
                    .with_help("give at least one value"));
            }
            return Ok(Self::List(items.into_iter().map(Node::of).collect()));
        }
        match fragment.variant(expected)? {
            (kind, Some(arguments)) if kind.text() == "Range" => {
                Values::read(arguments, "three values, `Range(first, last, count)`", None)
                    .map(Self::Range)
            }
            (kind, Some(_)) => Err(kind
                .error(format!("unknown kind of values `{}`", kind.text()))
                .with_help(names::help(kind.text(), "kinds of values", ["Range"]))),
            _ => Err(fragment.expected(expected)),
        }
    }

    /// Refuses values, read from `given`, that measure something else than what they take the place of.
    fn check(&self, given: Fragment<'_>, known: Fragment<'_>, path: &str) -> Result<(), LoadError> {
        let what = format!("`{path}`");
        match self {
            Self::List(values) => {
                let mut values = values.iter().map(Fragment::of_node);
                values.try_for_each(|value| value.in_place_of(known, &what))
            }
            Self::Range(values) => match (values.dimension(), known.measured(None)) {
                (Some(other), Ok((_, Some(wanted)))) if other != wanted => {
                    Err(given.of_dimension(&what, wanted, other))
                }
                _ => Ok(()),
            },
        }
    }

    /// How many, at least 1.
    fn len(&self) -> usize {
        match self {
            Self::Range(values) => values.len(),
            Self::List(values) => values.len(),
        }
    }
}
