//! The kinds of joints and of prebuilt mechanisms that a file may name.

use std::fmt;
use std::sync::Arc;

use hyperstat_joints::Joint;
use nalgebra::{Rotation3, Vector3};
use serde::de::DeserializeOwned;

use crate::error::LoadError;
use crate::prebuilt::Prebuilt;
use crate::terms::{self, Field};
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;
use crate::text::names;

/// The kinds of joints and of prebuilt mechanisms that a file may name, each with its reader.
#[derive(Clone, Default)]
pub struct Registry {
    kinds: Vec<Kind>,
    prebuilts: Vec<PrebuiltKind>,
}

type Reader = dyn Fn(&Arguments<'_>) -> Result<ParsedJoint, LoadError> + Send + Sync;
type Writer = dyn Fn(&dyn Joint, &Rotation3<f64>) -> Vec<(&'static str, Argument)> + Send + Sync;

type Builder = dyn Fn(&Arguments<'_>) -> Result<Box<dyn Prebuilt>, LoadError> + Send + Sync;

/// A kind of prebuilt mechanism.
#[derive(Clone)]
pub(crate) struct PrebuiltKind {
    name: String,
    parameters: Known,
    reader: Arc<Builder>,
}

#[derive(Clone)]
struct Kind {
    name: String,
    arguments: Known,
    reader: Arc<Reader>,
    writer: Option<Arc<Writer>>,
}

/// What is known of the fields of a kind.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Known {
    /// Their names.
    Names(&'static [&'static str]),
    /// All that the table of terms says.
    Fields(&'static [Field]),
}

impl Known {
    /// Their names.
    pub(crate) fn names(self) -> Vec<&'static str> {
        match self {
            Self::Names(names) => names.to_vec(),
            Self::Fields(fields) => terms::names(fields),
        }
    }
}

impl Registry {
    /// No kinds at all.
    pub fn empty() -> Self {
        Self::default()
    }

    /// Adds a joint kind, or replaces the one of this name. A file may give the named
    /// `arguments` and no others; `reader` makes the joint from those it gives.
    pub fn register(
        &mut self,
        name: &str,
        arguments: &'static [&'static str],
        reader: impl Fn(&Arguments<'_>) -> Result<ParsedJoint, LoadError> + Send + Sync + 'static,
    ) {
        self.add(name, Known::Names(arguments), reader);
    }

    /// The same of a kind whose arguments are known.
    pub(crate) fn add(
        &mut self,
        name: &str,
        arguments: Known,
        reader: impl Fn(&Arguments<'_>) -> Result<ParsedJoint, LoadError> + Send + Sync + 'static,
    ) {
        self.kinds.retain(|kind| kind.name != name);
        self.kinds.push(Kind {
            name: name.into(),
            arguments,
            reader: Arc::new(reader),
            writer: None,
        });
    }

    /// Says how joints of the kind `name` are written into a file: `writer` gets the joint and its
    /// frame (columns x, y, z in global axes) and gives the arguments that the kind's reader makes
    /// them from. Beside an argument that is one direction, the axis, the frame's x is written as
    /// the joint's `x_axis`. Only [`write`](crate::write()) needs it. Without a kind of this name
    /// it does nothing.
    pub fn register_writer(
        &mut self,
        name: &str,
        writer: impl Fn(&dyn Joint, &Rotation3<f64>) -> Vec<(&'static str, Argument)>
        + Send
        + Sync
        + 'static,
    ) {
        if let Some(kind) = self.kinds.iter_mut().find(|kind| kind.name == name) {
            kind.writer = Some(Arc::new(writer));
        }
    }

    /// Adds a kind of prebuilt mechanism, or replaces the one of this name: a job then names it as
    /// `name(parameter: …)`. A file may give the named `parameters` and no others; `reader` makes the
    /// mechanism from those it gives.
    pub fn register_prebuilt(
        &mut self,
        name: &str,
        parameters: &'static [&'static str],
        reader: impl Fn(&Arguments<'_>) -> Result<Box<dyn Prebuilt>, LoadError> + Send + Sync + 'static,
    ) {
        self.add_prebuilt(name, Known::Names(parameters), reader);
    }

    /// The same of a kind whose parameters are known.
    pub(crate) fn add_prebuilt(
        &mut self,
        name: &str,
        parameters: Known,
        reader: impl Fn(&Arguments<'_>) -> Result<Box<dyn Prebuilt>, LoadError> + Send + Sync + 'static,
    ) {
        self.prebuilts.retain(|kind| kind.name != name);
        self.prebuilts.push(PrebuiltKind {
            name: name.into(),
            parameters,
            reader: Arc::new(reader),
        });
    }

    /// Names of all kinds of prebuilt mechanisms.
    pub fn prebuilts(&self) -> impl Iterator<Item = &str> {
        self.prebuilts.iter().map(|kind| kind.name.as_str())
    }

    /// The kind of prebuilt mechanism of this name.
    pub(crate) fn prebuilt(&self, name: &str) -> Option<&PrebuiltKind> {
        self.prebuilts.iter().find(|kind| kind.name == name)
    }

    /// The arguments of a joint as a file gives them; `None` where its kind has no writer.
    pub(crate) fn arguments(
        &self,
        joint: &dyn Joint,
        frame: &Rotation3<f64>,
    ) -> Option<Vec<(&'static str, Argument)>> {
        let kind = self.kinds.iter().find(|kind| kind.name == joint.kind())?;
        kind.writer.as_ref().map(|writer| writer(joint, frame))
    }

    /// All kinds of joints, and what is known of their arguments.
    pub(crate) fn known_kinds(&self) -> impl Iterator<Item = (&str, Known)> {
        let kinds = self.kinds.iter();
        kinds.map(|kind| (kind.name.as_str(), kind.arguments))
    }

    /// All kinds of prebuilt mechanisms, and what is known of their parameters.
    pub(crate) fn known_prebuilts(&self) -> impl Iterator<Item = (&str, Known)> {
        let kinds = self.prebuilts.iter();
        kinds.map(|kind| (kind.name.as_str(), kind.parameters))
    }

    /// Names of all kinds of joints.
    pub fn kinds(&self) -> impl Iterator<Item = &str> {
        self.kinds.iter().map(|kind| kind.name.as_str())
    }

    /// Reads `Kind`, `Kind()` or `Kind(argument: …)`.
    pub(crate) fn read(&self, fragment: Fragment<'_>) -> Result<ParsedJoint, LoadError> {
        let (name, arguments) = fragment.variant("a joint kind, such as `Spherical`")?;
        let Some(kind) = self.kinds.iter().find(|kind| kind.name == name.text()) else {
            return Err(name
                .error(format!("unknown joint kind `{}`", name.text()))
                .unreadable()
                .with_help(names::help(name.text(), "kinds", self.kinds())));
        };
        let owner = format!("`{}`", kind.name);
        let fields = match arguments {
            None => Fields::none(fragment, owner),
            Some(given) => {
                check_x_axis(given, kind)?;
                Fields::read(given, owner, &kind.arguments.names())?.within(fragment)
            }
        };
        (kind.reader)(&Arguments { fields })
    }
}

/// Refuses an `x_axis` among the arguments of a kind that knows none: it belongs to the joint.
fn check_x_axis(given: Fragment<'_>, kind: &Kind) -> Result<(), LoadError> {
    let fields = given.named("arguments in parentheses")?;
    match fields.iter().find(|(name, _)| name.text() == "x_axis") {
        Some((name, _)) if !kind.arguments.names().contains(&"x_axis") => Err(name
            .error("`x_axis` is a field of the joint, not of its kind")
            .with_help(format!("write `kind: {}(…), x_axis: (…)`", kind.name))),
        _ => Ok(()),
    }
}

impl PrebuiltKind {
    /// Reads a mechanism of this kind: `Kind`, `Kind()` or `Kind(parameter: …)`.
    pub(crate) fn read(&self, whole: Fragment<'_>) -> Result<Box<dyn Prebuilt>, LoadError> {
        let (_, arguments) = whole.variant("a prebuilt mechanism")?;
        let owner = format!("`{}`", self.name);
        let fields = match arguments {
            Some(given) => Fields::read(given, owner, &self.parameters.names())?.within(whole),
            None => Fields::none(whole, owner),
        };
        (self.reader)(&Arguments { fields })
    }
}

impl fmt::Debug for PrebuiltKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)
    }
}

impl fmt::Debug for Registry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list()
            .entries(self.kinds())
            .entries(self.prebuilts())
            .finish()
    }
}

/// The arguments of a kind of joint or prebuilt mechanism as a file gives them, such as
/// `(axis: (0.0, 0.0, 1.0), pitch: 0.005)`. Every error points at the value it is about.
#[derive(Debug)]
pub struct Arguments<'a> {
    fields: Fields<'a>,
}

impl<'a> Arguments<'a> {
    pub(crate) fn fields(&self) -> &Fields<'a> {
        &self.fields
    }

    /// Whether an argument is given.
    pub fn has(&self, name: &str) -> bool {
        self.fields.get(name).is_some()
    }

    /// A number that must be given, SI, with any unit or none.
    ///
    /// # Errors
    /// It is missing, not a number or not finite.
    pub fn number(&self, name: &str) -> Result<f64, LoadError> {
        self.fields.required(name)?.number()
    }

    /// A number that must be given, SI, with a unit of this dimension or none.
    ///
    /// # Errors
    /// It is missing, not a number or not finite, or measures something else.
    pub fn quantity(&self, name: &str, dimension: Dimension) -> Result<f64, LoadError> {
        let value = self.fields.required(name)?;
        value.quantity(&format!("`{name}`"), dimension)
    }

    /// A vector `(x, y, z)` that must be given.
    ///
    /// # Errors
    /// It is missing, not three finite numbers, or zero.
    pub fn direction(&self, name: &str) -> Result<Vector3<f64>, LoadError> {
        self.fields.required(name)?.direction()
    }

    /// Two vectors `((x, y, z), (x, y, z))` that must be given.
    ///
    /// # Errors
    /// As [`Arguments::direction`].
    pub fn two_directions(&self, name: &str) -> Result<[Vector3<f64>; 2], LoadError> {
        let pair = self.fields.required(name)?;
        let [a, b] = pair.array("two vectors `((x, y, z), (x, y, z))`")?;
        Ok([a.direction()?, b.direction()?])
    }

    /// Any other type, if it is given; `expected` says in words what it is ("a list of
    /// numbers"). Floating-point numbers may come out as NaN or infinite.
    ///
    /// # Errors
    /// It is something else.
    pub fn read<T: DeserializeOwned>(
        &self,
        name: &str,
        expected: &str,
    ) -> Result<Option<T>, LoadError> {
        let value = self.fields.get(name);
        value.map(|value| value.parse(expected)).transpose()
    }

    /// An error at an argument, or at the whole kind where it is not given.
    pub fn error(&self, name: &str, message: impl Into<String>) -> LoadError {
        self.fields.error(name, message)
    }
}

/// An argument of a joint kind as a writer gives it; directions are in global axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Argument {
    /// A number.
    Number(f64),
    /// A direction.
    Direction(Vector3<f64>),
    /// Two directions.
    TwoDirections([Vector3<f64>; 2]),
}

/// A joint as a reader returns it.
#[derive(Debug, Clone)]
pub struct ParsedJoint {
    /// The joint.
    pub joint: Box<dyn Joint>,
    /// How its frame is oriented.
    pub orientation: Orientation,
}

/// How the frame of a joint is oriented; directions are in global axes and of any length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Orientation {
    /// The frame is the global one.
    Global,
    /// y is this axis; x is the joint's `x_axis` in the file made normal to it, or the default.
    Axis(Vector3<f64>),
    /// x is the first, y the second made normal to the first.
    Axes(Vector3<f64>, Vector3<f64>),
}
