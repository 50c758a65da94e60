//! Prebuilt mechanisms of a batch file: their parameters.

use hyperstat_elements::{Material, Section};

use crate::error::LoadError;
use crate::fields::Fields;
use crate::fragment::Fragment;
use crate::prebuilt::{Delta, Elbow, Link, ParameterError, Prebuilt, RodEnds, SingleFreedom};
use crate::{bodies, joints, materials};

/// Names of the prebuilt mechanisms.
pub(crate) const KINDS: [&str; 2] = ["Delta", "SingleFreedom"];

/// Reads the parameters of the prebuilt mechanism `kind`, one of [`KINDS`]; `whole` is the
/// mechanism, `arguments` what stands in its parentheses.
pub(crate) fn read(
    kind: &str,
    whole: Fragment<'_>,
    arguments: Option<Fragment<'_>>,
) -> Result<Box<dyn Prebuilt>, LoadError> {
    let known: &[&str] = match kind {
        "Delta" => &[
            "base_radius",
            "platform_radius",
            "arm_length",
            "rod_length",
            "rod_spacing",
            "elbow",
            "rod_ends",
            "arm",
            "bar",
            "rod",
            "joint_stiffness",
            "drive_stiffness",
            "elements",
        ],
        _ => &["lengths", "sections", "material", "joint_stiffness"],
    };
    let owner = format!("`{kind}`");
    let fields = match arguments {
        Some(given) => Fields::read(given, owner, known, &[])?.within(whole),
        None => Fields::none(whole, owner),
    };
    match kind {
        "Delta" => Ok(Box::new(delta(&fields)?)),
        _ => Ok(Box::new(single_freedom(&fields)?)),
    }
}

fn delta(fields: &Fields<'_>) -> Result<Delta, LoadError> {
    let delta = Delta {
        base_radius: fields.number("base_radius")?,
        platform_radius: fields.number("platform_radius")?,
        arm_length: fields.number("arm_length")?,
        rod_length: fields.number("rod_length")?,
        rod_spacing: fields.number("rod_spacing")?,
        elbow: optional(fields, "elbow", |value| {
            value.parse::<Elbow>("`Out` or `In`")
        })?,
        rod_ends: optional(fields, "rod_ends", |value| {
            value.parse::<RodEnds>("`Revolute` or `Spherical`")
        })?,
        arm: link(fields, "arm")?,
        bar: link(fields, "bar")?,
        rod: link(fields, "rod")?,
        joint_stiffness: optional(fields, "joint_stiffness", joints::directions)?,
        drive_stiffness: optional(fields, "drive_stiffness", |k| joints::spring(k).map(Some))?,
        elements: fields.get("elements").map_or(Ok(1), bodies::elements)?,
    };
    delta.check().map_err(|error| refused(fields, &error))?;
    Ok(delta)
}

fn single_freedom(fields: &Fields<'_>) -> Result<SingleFreedom, LoadError> {
    let structure = SingleFreedom {
        lengths: pair(fields, "lengths", "two lengths", Fragment::number)?,
        sections: pair(fields, "sections", "two sections", section)?,
        material: material(fields.required("material")?)?,
        joint_stiffness: pair(
            fields,
            "joint_stiffness",
            "two stiffnesses along x, each a number or `Rigid`",
            |value| match value.text() {
                "Rigid" => Ok(None),
                _ => joints::spring(value).map(Some),
            },
        )?,
    };
    structure.check().map_err(|error| refused(fields, &error))?;
    Ok(structure)
}

fn refused(fields: &Fields<'_>, error: &ParameterError) -> LoadError {
    let refusal = fields.error(error.field, error.to_string());
    match &error.help {
        Some(help) => refusal.with_help(help),
        None => refusal,
    }
}

fn optional<'a, T: Default>(
    fields: &Fields<'a>,
    name: &str,
    read: impl Fn(Fragment<'a>) -> Result<T, LoadError>,
) -> Result<T, LoadError> {
    fields.get(name).map_or_else(|| Ok(T::default()), read)
}

fn pair<'a, T>(
    fields: &Fields<'a>,
    name: &str,
    expected: &str,
    read: impl Fn(Fragment<'a>) -> Result<T, LoadError>,
) -> Result<(T, T), LoadError> {
    let [first, second] = fields.required(name)?.array(expected)?;
    Ok((read(first)?, read(second)?))
}

fn section(fragment: Fragment<'_>) -> Result<Section, LoadError> {
    materials::section(fragment, "the section")
}

fn material(fragment: Fragment<'_>) -> Result<Material, LoadError> {
    materials::material(fragment, "the material")
}

fn link(fields: &Fields<'_>, name: &str) -> Result<Link, LoadError> {
    let owner = format!("`{name}`");
    let link = Fields::read(fields.required(name)?, owner, &["section", "material"], &[])?;
    Ok(Link {
        section: section(link.required("section")?)?,
        material: material(link.required("material")?)?,
    })
}
