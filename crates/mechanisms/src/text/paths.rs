//! Paths to values of a mechanism as it is written, such as `sections.rod.diameter`.
//!
//! A path goes from the outside in: names of fields and of entries of maps, and places in tuples
//! and lists, by number from 0. A kind has no step of its own: `rod.section.diameter` is the
//! diameter of `rod: (section: Circle(diameter: 0.014), …)`.

use super::fragment::Fragment;
use crate::error::LoadError;
use crate::text::names;

/// The value of `root` that the path written at `key` leads to.
pub(crate) fn find<'a>(root: Fragment<'a>, key: Fragment<'_>) -> Result<Fragment<'a>, LoadError> {
    let path = key.string()?;
    let (mut value, mut rest) = (root, path.as_str());
    loop {
        let walked = path.len() - rest.len();
        let step = Step {
            key,
            path: &path,
            walked,
        };
        let (inner, length) = step.take(value)?;
        if walked + length == path.len() {
            return Ok(inner);
        }
        value = inner;
        rest = &path[walked + length + 1..];
    }
}

/// All numbers in `root` that a path leads to, each with its path.
pub(crate) fn numbers(root: Fragment<'_>) -> Vec<(String, Fragment<'_>)> {
    let mut found = Vec::new();
    add_numbers(root, "", &mut found);
    found
}

/// What the first value of a tuple may begin with, and no name does.
const UNNAMED: [char; 17] = [
    '0', '1', '2', '3', '4', '5', '6', '7', '8', '9', '-', '+', '.', '"', '(', '[', '{',
];

fn add_numbers<'a>(value: Fragment<'a>, path: &str, found: &mut Vec<(String, Fragment<'a>)>) {
    let inside = contents(value);
    let numbered = |items: Vec<Fragment<'a>>| {
        let items = items.into_iter().enumerate();
        items.map(|(k, item)| (k.to_string(), item)).collect()
    };
    let parts: Result<Vec<(String, Fragment<'a>)>, LoadError> = match inside.text().chars().next() {
        Some('{') => {
            (inside.map()).map(|entries| entries.into_iter().map(|e| (e.name, e.value)).collect())
        }
        Some('[') => inside.list("a list").map(numbered),
        // No name begins so. To find that out from an error costs its place, a look at the whole text.
        Some('(') if inside.text()[1..].trim_start().starts_with(UNNAMED) => {
            inside.tuple("a tuple").map(numbered)
        }
        Some('(') => match inside.named("") {
            Ok(fields) => {
                let pair = |(name, value): (Fragment<'a>, _)| (name.text().to_owned(), value);
                Ok(fields.into_iter().map(pair).collect())
            }
            Err(_) => inside.tuple("a tuple").map(numbered),
        },
        Some('0'..='9' | '-' | '+' | '.') => {
            if value.number().is_ok() {
                found.push((path.into(), value));
            }
            return;
        }
        _ => return,
    };
    let parts: Vec<_> = parts.into_iter().flatten().collect();
    let dotted = parts.iter().any(|(name, _)| name.contains('.'));
    let before = path.len() + usize::from(!path.is_empty());
    for (name, part) in &parts {
        let path = match path {
            "" => name.clone(),
            path => format!("{path}.{name}"),
        };
        let start = found.len();
        add_numbers(*part, &path, found);
        // Where a name goes on as another one does, a path may lead there.
        let longer = |other: &&(String, Fragment<'a>)| {
            let rest = other.0.strip_prefix(name.as_str());
            rest.is_some_and(|rest| rest.starts_with('.'))
        };
        for (other, _) in parts.iter().filter(|_| dotted).filter(longer) {
            let mut place = 0;
            found.retain(|(path, _)| {
                place += 1;
                place <= start || !starts_with(&path[before..], other)
            });
        }
    }
}

/// Whether the first steps of a path are this name.
fn starts_with(path: &str, name: &str) -> bool {
    let rest = path.strip_prefix(name);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// The next step of a path.
struct Step<'k> {
    /// Where the path is written.
    key: Fragment<'k>,
    path: &'k str,
    /// Bytes of the path before this step.
    walked: usize,
}

impl Step<'_> {
    /// Takes the step from `value`: the value it leads to, and how many bytes of the path it is.
    fn take<'a>(&self, value: Fragment<'a>) -> Result<(Fragment<'a>, usize), LoadError> {
        let inside = contents(value);
        let first = inside.text().chars().next();
        match first {
            Some('{') => self.of_map(inside),
            Some('[') => self.of_list(&inside.list("a list")?),
            Some('(') => match inside.named("") {
                Ok(fields) => {
                    let pair = |(name, value): (Fragment<'a>, _)| (name.text().to_owned(), value);
                    self.of_names(fields.into_iter().map(pair).collect())
                }
                Err(_) => self.of_list(&inside.tuple("a tuple")?),
            },
            _ => Err(self
                .error(format!(
                    "{} is a value without parts: there is no `{}` in it",
                    self.from(),
                    self.name()
                ))
                .with_help(match self.walked {
                    0 => "this mechanism has nothing that could vary".into(),
                    walked => format!("vary the whole of it, `{}`", &self.path[..walked - 1]),
                })),
        }
    }

    fn of_map<'a>(&self, map: Fragment<'a>) -> Result<(Fragment<'a>, usize), LoadError> {
        let entries = map.map()?.into_iter();
        self.of_names(entries.map(|entry| (entry.name, entry.value)).collect())
    }

    /// A name may hold dots: the longest that fits is meant.
    fn of_names<'a>(
        &self,
        names: Vec<(String, Fragment<'a>)>,
    ) -> Result<(Fragment<'a>, usize), LoadError> {
        let rest = &self.path[self.walked..];
        let fitting = names.iter().filter(|(name, _)| starts_with(rest, name));
        match fitting.max_by_key(|(name, _)| name.len()) {
            Some((name, value)) => Ok((*value, name.len())),
            None => {
                let known = names.iter().map(|(name, _)| name.as_str());
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

    fn of_list<'a>(&self, items: &[Fragment<'a>]) -> Result<(Fragment<'a>, usize), LoadError> {
        let name = self.name();
        let digits = !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_digit());
        let number = name.parse().ok().filter(|_| digits);
        if let Some(item) = number.and_then(|number: usize| items.get(number)) {
            return Ok((*item, name.len()));
        }
        let error = self.error(format!("{} has no value `{name}`", self.from()));
        Err(error.with_help(match items.len() {
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
            0 => "the mechanism".into(),
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
