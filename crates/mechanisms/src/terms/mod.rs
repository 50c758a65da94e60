//! What may stand in a file: fields, kinds and words, each with one line that says what it is.
//!
//! The one table of them. Readers take from it which fields they know, the JSON Schema and new files
//! are made from it, and the book's tables are held to it by a test.

pub(crate) mod acting;
pub(crate) mod bodies;
pub(crate) mod figures;
pub(crate) mod job;
pub(crate) mod joints;
pub(crate) mod mechanism;
pub(crate) mod parts;
pub(crate) mod prebuilts;

/// What stands at a place.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Type {
    /// A finite number in this unit; `-` has none.
    Number(&'static str),
    /// A whole number from one to the other.
    Count(u64, u64),
    /// `true` or `false`.
    Truth,
    /// A text in quotes.
    Text,
    /// One of some words.
    Word(&'static [&'static str]),
    /// So many numbers in this unit, as a tuple.
    Numbers(usize, &'static str),
    /// A tuple of these.
    Tuple(&'static [Type]),
    List(&'static Type),
    /// Names with values.
    Map(&'static Type),
    Record(&'static Record),
    Kinds(&'static Kinds),
    /// Whatever of these fits.
    Any(&'static [Type]),
    /// A registered kind of joint.
    Joint,
    /// A mechanism of a job: a file, or a registered kind of prebuilt one.
    Mechanism,
    /// Anything at all.
    Anything,
}

/// A field.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Field {
    pub(crate) name: &'static str,
    pub(crate) of: Type,
    pub(crate) required: bool,
    pub(crate) about: &'static str,
}

/// A field that must be given.
pub(crate) const fn needed(name: &'static str, of: Type, about: &'static str) -> Field {
    Field {
        name,
        of,
        required: true,
        about,
    }
}

/// A field that may be left out.
pub(crate) const fn optional(name: &'static str, of: Type, about: &'static str) -> Field {
    Field {
        required: false,
        ..needed(name, of, about)
    }
}

/// Fields that stand together: `(name: value, …)`.
#[derive(Debug)]
pub(crate) struct Record {
    /// Its name in the schema.
    pub(crate) name: &'static str,
    pub(crate) about: &'static str,
    pub(crate) fields: &'static [Field],
    /// Fields of which exactly one is given; none are named where there is no such choice.
    pub(crate) one_of: &'static [&'static str],
    /// Fields of which at least one is given; none are named where there is no such need.
    pub(crate) any_of: &'static [&'static str],
}

impl Record {
    /// Fields without a choice among them.
    pub(crate) const fn new(
        name: &'static str,
        about: &'static str,
        fields: &'static [Field],
    ) -> Self {
        Self {
            name,
            about,
            fields,
            one_of: &[],
            any_of: &[],
        }
    }

    /// Names of the fields.
    pub(crate) fn names(&self) -> Vec<&'static str> {
        names(self.fields)
    }
}

/// Names of some fields.
pub(crate) fn names(fields: &[Field]) -> Vec<&'static str> {
    fields.iter().map(|field| field.name).collect()
}

/// Kinds of which one stands somewhere: `Kind(…)`.
#[derive(Debug)]
pub(crate) struct Kinds {
    /// Their name in the schema.
    pub(crate) name: &'static str,
    pub(crate) kinds: &'static [Kind],
}

/// A kind.
#[derive(Debug)]
pub(crate) struct Kind {
    pub(crate) name: &'static str,
    pub(crate) about: &'static str,
    pub(crate) arguments: Arguments,
}

/// What stands in the parentheses of a kind.
#[derive(Debug)]
pub(crate) enum Arguments {
    Fields(&'static [Field]),
    /// One value, or a tuple.
    Value(Type),
}

impl Kinds {
    /// Names of the kinds.
    pub(crate) fn names(&self) -> Vec<&'static str> {
        self.kinds.iter().map(|kind| kind.name).collect()
    }

    /// Names of the fields of a kind; `None` where there is no such kind.
    pub(crate) fn fields(&self, kind: &str) -> Option<Vec<&'static str>> {
        let kind = self.kinds.iter().find(|own| own.name == kind)?;
        match kind.arguments {
            Arguments::Fields(fields) => Some(names(fields)),
            Arguments::Value(_) => None,
        }
    }
}

/// A kind with fields.
pub(crate) const fn kind(
    name: &'static str,
    about: &'static str,
    fields: &'static [Field],
) -> Kind {
    Kind {
        name,
        about,
        arguments: Arguments::Fields(fields),
    }
}

/// A kind of one value.
pub(crate) const fn of_value(name: &'static str, about: &'static str, value: Type) -> Kind {
    Kind {
        name,
        about,
        arguments: Arguments::Value(value),
    }
}

/// Whole numbers have no end here.
pub(crate) const NO_END: u64 = u64::MAX;
