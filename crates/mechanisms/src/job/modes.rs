//! The natural frequencies that a job asks for.

use hyperstat_elements::{MassShape, RotaryInertia};
use hyperstat_model::{BeamMass, ModalOptions};

use crate::error::LoadError;
use crate::terms::job::MODES;
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;
use crate::text::names;

/// Frequencies of a job at the most.
pub(crate) const MOST: usize = 1000;

/// Reads `6` or `(count: 6, mass: Lumped)`.
pub(crate) fn read(fragment: Fragment<'_>) -> Result<ModalOptions, LoadError> {
    if !fragment.has_fields() {
        let expected =
            "a number of natural frequencies from 1 to 1000, or `(count: 6, mass: Lumped)`";
        return count(fragment, expected).map(ModalOptions::lowest);
    }
    let fields = Fields::read(fragment, "`modes`", &MODES.names())?;
    let mut options = ModalOptions::lowest(count(fields.required("count")?, COUNT)?);
    if let Some(mass) = fields.get("mass") {
        options.mass = match word(mass, "kinds of mass", ["Exact", "Consistent", "Lumped"])? {
            "Lumped" => BeamMass::Lumped,
            "Consistent" => BeamMass::Consistent,
            _ => BeamMass::Exact,
        };
    }
    if let Some(shape) = fields.get("shape") {
        options.shape = match word(shape, "shapes", ["Cubic", "Exact"])? {
            "Exact" => MassShape::Exact,
            _ => MassShape::Cubic,
        };
    }
    if let Some(rotary) = fields.get("rotary_inertia") {
        options.rotary_inertia = match rotary.parse("`true` or `false`")? {
            true => RotaryInertia::Included,
            false => RotaryInertia::Left,
        };
    }
    let (masses, refused, help): (_, &[&str], _) = match options.mass {
        BeamMass::Exact => ("exact", &["shape"], "give `mass: Consistent`"),
        BeamMass::Consistent => return Ok(options),
        BeamMass::Lumped => ("lumped", &["shape", "rotary_inertia"], "`mass: Lumped`"),
    };
    for name in refused {
        if let Some(at) = fields.get(name) {
            let error = at.error(format!("{masses} masses have no `{name}`"));
            return Err(error.with_help(format!("leave `{name}` out, or {help}")));
        }
    }
    Ok(options)
}

/// What a number of modes is.
pub(super) const COUNT: &str = "a number of natural frequencies from 1 to 1000";

/// Reads a number of modes, where `expected` is.
pub(super) fn count(fragment: Fragment<'_>, expected: &str) -> Result<usize, LoadError> {
    match fragment.count::<usize>(expected)? {
        count if (1..=MOST).contains(&count) => Ok(count),
        _ => Err(fragment.expected(expected)),
    }
}

/// One of these words.
fn word<const N: usize>(
    fragment: Fragment<'_>,
    kinds: &str,
    known: [&'static str; N],
) -> Result<&'static str, LoadError> {
    let found = known.into_iter().find(|word| *word == fragment.word());
    found.ok_or_else(|| {
        fragment
            .error(format!("unknown `{}`", fragment.word()))
            .with_help(names::help(fragment.word(), kinds, known))
    })
}
