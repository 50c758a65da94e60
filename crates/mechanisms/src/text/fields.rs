//! The named fields of a struct in a file.

use hyperstat_elements::ElementError;

use super::fragment::{Fragment, first_at};
use super::scope::Scope;
use super::tree::Node;
use crate::error::LoadError;
use crate::text::{names, quantities};

/// The field of a JSON file that names its schema.
pub(crate) const SCHEMA: &str = "$schema";

/// The fields of `(name: value, …)`: each known, and none given twice.
#[derive(Debug)]
pub(crate) struct Fields<'a> {
    /// What has the fields, in words.
    owner: String,
    /// What errors about the fields together point at.
    whole: Fragment<'a>,
    values: Vec<(&'a str, Fragment<'a>)>,
}

impl<'a> Fields<'a> {
    /// Reads a struct with some of the `known` fields; `owner` says what the struct is, such as
    /// "material `steel`".
    pub(crate) fn read(
        fragment: Fragment<'a>,
        owner: impl Into<String>,
        known: &[&str],
    ) -> Result<Self, LoadError> {
        let mut fields = Self::none(fragment, owner);
        let expected = match known {
            [] => "`()`".into(),
            [first, ..] => format!("fields in parentheses, `({first}: …)`"),
        };
        let mut names = Vec::<Fragment>::new();
        for (name, value) in fragment.named(&expected)? {
            let owner = &fields.owner;
            // It is the editor's.
            if name.text() == SCHEMA && fragment.is_json() {
                continue;
            }
            if !known.contains(&name.text()) {
                return Err(name
                    .error(format!("unknown field `{}` of {owner}", name.text()))
                    .unreadable()
                    .with_help(names::help(name.text(), "fields", known.iter().copied())));
            }
            if let Some(first) = names.iter().find(|other| other.text() == name.text()) {
                return Err(name
                    .error(format!(
                        "the field `{}` of {owner} is given twice",
                        name.text()
                    ))
                    .with_help(first_at(*first)));
            }
            names.push(name);
            fields.values.push((name.text(), value));
        }
        Ok(fields)
    }

    /// No fields at all; errors point at `whole`.
    pub(crate) fn none(whole: Fragment<'a>, owner: impl Into<String>) -> Self {
        Self {
            owner: owner.into(),
            whole,
            values: Vec::new(),
        }
    }

    /// Fields that are known; errors about all of them point at `whole`.
    pub(crate) fn of(
        whole: Fragment<'a>,
        owner: impl Into<String>,
        values: Vec<(&'a str, Fragment<'a>)>,
    ) -> Self {
        Self {
            values,
            ..Self::none(whole, owner)
        }
    }

    /// What has the fields, in words.
    pub(crate) fn owner(&self) -> &str {
        &self.owner
    }

    /// The same fields, with errors about all of them pointing at `whole`.
    pub(crate) fn within(self, whole: Fragment<'a>) -> Self {
        Self { whole, ..self }
    }

    /// The value of a field, if it is given.
    pub(crate) fn get(&self, name: &str) -> Option<Fragment<'a>> {
        let of_name = |(field, value): &(&str, _)| (*field == name).then_some(*value);
        self.values.iter().find_map(of_name)
    }

    /// The fields that are given, of those that are `known`, as they are written.
    pub(crate) fn written(&self, known: &[&'static str]) -> Vec<(&'static str, Node)> {
        let written = |name: &&'static str| Some((*name, Scope::written(self.get(name)?)));
        known.iter().filter_map(written).collect()
    }

    /// What errors about the fields together point at.
    pub(crate) fn whole(&self) -> Fragment<'a> {
        self.whole
    }

    /// The value of a field that must be given.
    pub(crate) fn required(&self, name: &str) -> Result<Fragment<'a>, LoadError> {
        self.get(name).ok_or_else(|| {
            self.whole
                .error(format!("{} has no `{name}`", self.owner))
                .unreadable()
                .with_help(format!("add the field `{name}: …`"))
        })
    }

    /// A finite number, SI, that must be given, of the [dimension](quantities::of) of its field.
    pub(crate) fn number(&self, name: &str) -> Result<f64, LoadError> {
        measured(name, self.required(name)?)
    }

    /// The same of a number that may be left out.
    pub(crate) fn optional_number(&self, name: &str) -> Result<Option<f64>, LoadError> {
        let given = self.get(name);
        given.map(|value| measured(name, value)).transpose()
    }

    /// An error at a field's value, or at the whole where the field is not given.
    pub(crate) fn error(&self, name: &str, message: impl Into<String>) -> LoadError {
        self.get(name).unwrap_or(self.whole).error(message)
    }

    /// An error of a material or section at the field that it names.
    pub(crate) fn element_error(&self, error: &ElementError) -> LoadError {
        match error {
            ElementError::OutOfRange {
                field,
                value,
                wanted,
            } => {
                let message = match self.get(field) {
                    Some(given) => {
                        format!("`{field}` of {} cannot be {}", self.owner, given.shown())
                    }
                    None => format!("`{field}` of {} comes out as {value:?}", self.owner),
                };
                let help = format!("it must be {wanted}");
                self.error(field, message).with_help(help)
            }
            other => self.whole.error(format!("{}: {other}", self.owner)),
        }
    }
}

/// The number of a field, of the field's dimension; any that has none.
fn measured(name: &str, value: Fragment<'_>) -> Result<f64, LoadError> {
    match quantities::of(name) {
        Some(dimension) => value.quantity(&format!("`{name}`"), dimension),
        None => value.number(),
    }
}
