//! Paths to values of a mechanism as it is written, such as `sections.rod.diameter`.
//!
//! A path goes from the outside in: names of fields and of entries of maps, and places in tuples
//! and lists, by number from 0. A kind has no step of its own: `rod.section.diameter` is the
//! diameter of `rod: (section: Circle(diameter: 0.014), …)`. A parameter may be named alone: `R` is
//! `parameters.R`, unless the mechanism has a field of that name.

use super::copied::Copied;
use super::fragment::{Fragment, Parts};
use super::scope::{MECHANISMS, PARAMETERS, TREE};
use super::tree::{Node, Steps, starts_with};
use crate::error::LoadError;
use crate::text::names;

/// The steps to the value of `root`, in words `whole`, that the path written at `key` leads to.
pub(crate) fn find(root: &Node, key: Fragment<'_>, whole: &str) -> Result<Steps, LoadError> {
    find_in(root, (key, whole), &key.string()?, 0)
}

/// The steps to the values that a path written at `key` leads to, which may name several parts as one:
/// `joints.{A1|A2|A3}.stiffness.u`.
pub(crate) fn find_all(root: &Node, key: Fragment<'_>) -> Result<Vec<Steps>, LoadError> {
    every(&key.string()?, |path| find_path(root, key, path, 0), key)
}

/// What `find` finds for every path that a group stands for, each of them once.
pub(crate) fn every(
    path: &str,
    find: impl Fn(&str) -> Result<Steps, LoadError>,
    key: Fragment<'_>,
) -> Result<Vec<Steps>, LoadError> {
    let paths = expanded(path);
    let found = paths.iter().map(|path| find(path));
    let found = found.collect::<Result<Vec<Steps>, _>>()?;
    for (k, steps) in found.iter().enumerate() {
        if let Some(other) = found[..k].iter().position(|own| overlap(own, steps)) {
            let error = key.error(format!("`{}` and `{}` overlap", paths[other], paths[k]));
            return Err(error.with_help("name every part of a group once"));
        }
    }
    Ok(found)
}

/// The paths that one with groups stands for, `a.{b|c}.d`; one without them for itself.
fn expanded(path: &str) -> Vec<String> {
    let group = path.split_once('{').and_then(|(before, rest)| {
        let (names, after) = rest.split_once('}')?;
        names.contains('|').then_some((before, names, after))
    });
    let Some((before, names, after)) = group else {
        return vec![path.into()];
    };
    let whole = |name: &str| expanded(&format!("{before}{}{after}", name.trim()));
    names.split('|').flat_map(whole).collect()
}

/// The steps to the value of `root` that a path leads to from its byte `start` on.
pub(crate) fn find_path(
    root: &Node,
    key: Fragment<'_>,
    path: &str,
    start: usize,
) -> Result<Steps, LoadError> {
    find_in(root, (key, "the mechanism"), path, start)
}

fn find_in(
    root: &Node,
    (key, whole): (Fragment<'_>, &str),
    path: &str,
    start: usize,
) -> Result<Steps, LoadError> {
    let parameters = Parameters::of(root);
    if let Some(steps) = parameters.named(path) {
        return Ok(steps);
    }
    if let Some(inside) = mounted(root, &path[start..]) {
        return walk(root, &parameters, (key, whole), &inside, 0);
    }
    let way = walk(root, &parameters, (key, whole), path, start);
    way.map_err(|error| match of_copy(root, &path[start..]) {
        Some(help) => error.with_help(help),
        None => error,
    })
}

fn walk(
    root: &Node,
    parameters: &Parameters<'_>,
    (key, whole): (Fragment<'_>, &str),
    path: &str,
    start: usize,
) -> Result<Steps, LoadError> {
    let (mut value, mut rest) = (root, &path[start..]);
    let mut steps = Steps::new();
    loop {
        let walked = path.len() - rest.len();
        let step = Step {
            key,
            whole,
            path,
            walked,
            parameters: &parameters.names,
        };
        let (place, length) = step.take(Fragment::of_node(value))?;
        steps.push(place);
        if walked + length == path.len() {
            return Ok(steps);
        }
        value = value.part(place).ok_or_else(|| step.without_parts())?;
        rest = &path[walked + length + 1..];
    }
}

/// The way to what is mounted, whose path is `joints.head.slide1` where it stands at
/// `mechanisms.head.mechanism.joints.slide1`; `None` of any other path.
fn mounted(root: &Node, path: &str) -> Option<String> {
    let (section, rest) = path.split_once('.')?;
    let mounts = root.get(MECHANISMS)?;
    let own = |name: &&str| root.get(section).is_some_and(|map| map.get(name).is_some());
    let name = mounts
        .entry_names()
        .find(|name| starts_with(rest, name) && rest.len() > name.len() && !own(name))?;
    let tree = mounts.get(name)?.get(TREE)?;
    let inside = format!("{section}.{}", &rest[name.len() + 1..]);
    let inside = mounted(tree, &inside).unwrap_or(inside);
    Some(format!("{MECHANISMS}.{name}.{TREE}.{inside}"))
}

/// The path of what stands at this one, where it is mounted.
pub(crate) fn as_mounted(path: String) -> String {
    let inside = |path: &str| {
        let rest = path.strip_prefix(MECHANISMS)?.strip_prefix('.')?;
        let (name, rest) = rest.split_once('.')?;
        let inside = rest.strip_prefix(TREE)?.strip_prefix('.')?;
        let inside = as_mounted(inside.to_owned());
        let (section, rest) = inside.split_once('.')?;
        Some(format!("{section}.{name}.{rest}"))
    };
    inside(&path).unwrap_or(path)
}

/// What to write in place of a path that begins with the name of a copy's part, such as `joints.slide1`;
/// `None` of any other.
fn of_copy(root: &Node, path: &str) -> Option<String> {
    let (section, rest) = path.split_once('.')?;
    let name = rest.split('.').next()?;
    if (root.get(section)).is_some_and(|map| map.get(name).is_some()) {
        return None;
    }
    let Copied {
        group,
        part,
        ending,
    } = Copied::find(root, section, name)?;
    let value = format!("{section}.{part}{}", &rest[name.len()..]);
    Some(format!(
        "`{name}` is a copy: `groups.{group}.{value}` is the value of all copies; one that `overrides` gives to this \
         copy alone is `copies.{group}.overrides.{ending}.{value}`"
    ))
}

/// The parameters of a mechanism, which a path may name alone.
struct Parameters<'r> {
    names: Vec<&'r str>,
    /// Place of their map among the fields.
    place: usize,
    fields: Vec<&'r str>,
}

impl<'r> Parameters<'r> {
    fn of(root: &'r Node) -> Self {
        let fields: Vec<&str> = root.field_names().collect();
        let place = fields.iter().position(|name| *name == PARAMETERS);
        let map = place.and_then(|place| root.part(place));
        Self {
            names: map.map_or_else(Vec::new, |map| map.entry_names().collect()),
            place: place.unwrap_or(0),
            fields,
        }
    }

    /// The steps to the parameter of this name, where no field has it.
    fn named(&self, path: &str) -> Option<Steps> {
        let place = self.names.iter().position(|name| *name == path)?;
        let is_field = self.fields.contains(&path);
        (!is_field).then(|| vec![self.place, place])
    }
}

/// Whether of two values one is a part of the other, or they are the same.
pub(crate) fn overlap(one: &[usize], other: &[usize]) -> bool {
    one.starts_with(other) || other.starts_with(one)
}

/// Whether any of some values is a part of one of others, or the same.
pub(crate) fn any_overlap(some: &[Steps], others: &[Steps]) -> bool {
    some.iter()
        .any(|one| others.iter().any(|other| overlap(one, other)))
}

/// The error of a path, written at `key`, that leads to a part of what `other` leads to, or around it.
pub(crate) fn overlapping(other: &str, key: Fragment<'_>) -> LoadError {
    let path = key.string().unwrap_or_default();
    key.error(format!("`{other}` and `{path}` overlap"))
        .with_help("one is a part of the other: vary the whole or its parts")
}

/// The next step of a path.
struct Step<'k> {
    /// Where the path is written.
    key: Fragment<'k>,
    /// What all paths begin in, in words.
    whole: &'k str,
    path: &'k str,
    /// Bytes of the path before this step.
    walked: usize,
    /// Names of the mechanism's parameters.
    parameters: &'k [&'k str],
}

impl Step<'_> {
    /// Takes the step from `value`: the place of the part it leads to, and how many bytes of the path
    /// it is.
    fn take(&self, value: Fragment<'_>) -> Result<(usize, usize), LoadError> {
        match value.parts() {
            Some(Parts::Named(names)) => return self.of_names(&names),
            Some(Parts::Listed(count)) => return self.of_list(count),
            None => {}
        }
        let inside = contents(value);
        let first = inside.text().chars().next();
        match first {
            Some('{') => {
                let entries = inside.map()?.into_iter();
                self.of_names(&entries.map(|entry| entry.name).collect::<Vec<_>>())
            }
            Some('[') => self.of_list(inside.list("a list")?.len()),
            Some('(') => match inside.named("") {
                Ok(fields) => {
                    let names = fields.into_iter().map(|(name, _)| name.text().to_owned());
                    self.of_names(&names.collect::<Vec<_>>())
                }
                Err(_) => self.of_list(inside.tuple("a tuple")?.len()),
            },
            _ => Err(self.without_parts()),
        }
    }

    /// The error of a step into a value that has no parts.
    fn without_parts(&self) -> LoadError {
        self.error(format!(
            "{} is a value without parts: there is no `{}` in it",
            self.from(),
            self.name()
        ))
        .with_help(match self.walked {
            0 => {
                let whole = self.whole.replacen("the ", "this ", 1);
                format!("{whole} has nothing that could vary")
            }
            walked => format!("vary the whole of it, `{}`", &self.path[..walked - 1]),
        })
    }

    /// A name may hold dots: the longest that fits is meant.
    fn of_names(&self, names: &[String]) -> Result<(usize, usize), LoadError> {
        let rest = &self.path[self.walked..];
        let fitting = names.iter().enumerate();
        let fitting = fitting.filter(|(_, name)| starts_with(rest, name));
        match fitting.max_by_key(|(_, name)| name.len()) {
            Some((place, name)) => Ok((place, name.len())),
            None => {
                let parameters = self.parameters.iter().filter(|_| self.walked == 0);
                let known = names.iter().map(String::as_str).chain(parameters.copied());
                let what = "values written there";
                let mut help = names::help(self.name(), what, known);
                if help.starts_with("the") {
                    help += "; what is left out must be written before it can vary";
                }
                let message = format!("{} has no `{}`", self.from(), self.name());
                Err(self.error(message).with_help(help))
            }
        }
    }

    fn of_list(&self, count: usize) -> Result<(usize, usize), LoadError> {
        let name = self.name();
        let digits = !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_digit());
        let number = name.parse().ok().filter(|_| digits);
        if let Some(number) = number.filter(|number| *number < count) {
            return Ok((number, name.len()));
        }
        let error = self.error(format!("{} has no value `{name}`", self.from()));
        Err(error.with_help(match count {
            0 => "it has no values".into(),
            1 => "its only value is `0`".into(),
            count => format!("its values are `0` to `{}`", count - 1),
        }))
    }

    /// This step of the path, up to the next dot.
    fn name(&self) -> &str {
        let rest = &self.path[self.walked..];
        rest.split('.').next().unwrap_or(rest)
    }

    /// In words, what the step goes from.
    fn from(&self) -> String {
        match self.walked {
            0 => self.whole.into(),
            walked => format!("`{}`", &self.path[..walked - 1]),
        }
    }

    /// An error that points at this step, where the path is written as it is.
    fn error(&self, message: String) -> LoadError {
        let start = 1 + self.walked;
        let plain = self.key.text().get(1..self.key.text().len() - 1) == Some(self.path);
        let step = self.key.text().get(start..start + self.name().len());
        match step {
            Some(step) if plain && !step.is_empty() => self.key.part(step).error(message),
            _ => self.key.error(message),
        }
    }
}

/// What stands in the parentheses of a kind; the value itself where it is of no kind or has none.
fn contents(value: Fragment<'_>) -> Fragment<'_> {
    match value.text().chars().next() {
        Some('(' | '[' | '{' | '"') | None => value,
        _ => match value.variant("") {
            Ok((_, Some(arguments))) => arguments,
            _ => value,
        },
    }
}
