//! Prebuilt mechanisms of a batch file: their parameters.

mod arguments;
mod exechon;
mod hexapod;
mod legs;
mod linear_delta;
mod orthoglide;
mod planar_three_rrr;
mod spherical_three_rrr;
mod three_prs;
mod three_rps;
mod tricept;
mod tripteron;

use hyperstat_elements::{Material, Section};
use hyperstat_joints::Dof;

use crate::error::LoadError;
use crate::file::registry::{Known, Registry};
use crate::file::{joints, materials, through};
use crate::prebuilt::{
    Delta, Elbow, ElbowSide, Link, ParameterError, Prebuilt, RodEnds, SingleFreedom,
};
use crate::terms::parts::LINK;
use crate::terms::{Field, prebuilts};
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;

/// A kind of prebuilt mechanism.
struct Kind {
    /// Its name.
    name: &'static str,
    /// Its parameters.
    fields: &'static [Field],
    read: fn(&Fields<'_>) -> Result<Box<dyn Prebuilt>, LoadError>,
}

/// The prebuilt mechanisms.
const KINDS: &[Kind] = &[
    Kind {
        name: "Delta",
        fields: prebuilts::DELTA,
        read: |fields| Ok(Box::new(delta(fields)?)),
    },
    Kind {
        name: "SingleFreedom",
        fields: prebuilts::SINGLE_FREEDOM,
        read: |fields| Ok(Box::new(single_freedom(fields)?)),
    },
    exechon::KIND,
    hexapod::KIND,
    hexapod::CUBIC,
    linear_delta::KIND,
    orthoglide::KIND,
    planar_three_rrr::KIND,
    spherical_three_rrr::KIND,
    three_prs::KIND,
    three_rps::KIND,
    tricept::KIND,
    tripteron::KIND,
];

/// Registers the prebuilt mechanisms.
pub(crate) fn register(registry: &mut Registry) {
    for kind in KINDS {
        registry.add_prebuilt(kind.name, Known::Fields(kind.fields), |arguments| {
            (kind.read)(arguments.fields())
        });
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
        joint_stiffness: joint_stiffness(fields)?,
        drive_stiffness: drive_stiffness(fields, &[Dimension::ROTATIONAL_STIFFNESS])?,
        elements: elements(fields)?,
    };
    delta.check().map_err(|error| refused(fields, &error))?;
    Ok(delta)
}

fn single_freedom(fields: &Fields<'_>) -> Result<SingleFreedom, LoadError> {
    let structure = SingleFreedom {
        lengths: pair(fields, "lengths", "two lengths", |value| {
            value.quantity("`lengths`", Dimension::LENGTH)
        })?,
        sections: pair(fields, "sections", "two sections", section)?,
        material: material(fields.required("material")?)?,
        joint_stiffness: pair(
            fields,
            "joint_stiffness",
            "two stiffnesses along x, each a number or `Rigid`",
            |value| match value.word() {
                "Rigid" => Ok(None),
                _ => joints::spring(value, "`joint_stiffness`", &[Dimension::STIFFNESS]).map(Some),
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

fn elbow_side(fields: &Fields<'_>) -> Result<ElbowSide, LoadError> {
    optional(fields, "elbow", |value| value.parse("`Left` or `Right`"))
}

/// Reads the stiffness of passive joints, all of them free about v: zero there is the same as
/// nothing.
fn joint_stiffness(fields: &Fields<'_>) -> Result<[Option<f64>; 6], LoadError> {
    let mut stiffness = optional(fields, "joint_stiffness", joints::directions)?;
    let about_axis = &mut stiffness[Dof::V.index()];
    *about_axis = about_axis.filter(|&k| k != 0.0);
    Ok(stiffness)
}

/// Reads the stiffness of drives, of one of these dimensions.
fn drive_stiffness(fields: &Fields<'_>, of: &[Dimension]) -> Result<Option<f64>, LoadError> {
    optional(fields, "drive_stiffness", |k| {
        joints::spring(k, "`drive_stiffness`", of).map(Some)
    })
}

fn elements(fields: &Fields<'_>) -> Result<usize, LoadError> {
    fields.get("elements").map_or(Ok(1), through::elements)
}

fn section(fragment: Fragment<'_>) -> Result<Section, LoadError> {
    materials::section(fragment, "the section")
}

fn material(fragment: Fragment<'_>) -> Result<Material, LoadError> {
    materials::material(fragment, "the material")
}

fn link(fields: &Fields<'_>, name: &str) -> Result<Link, LoadError> {
    let owner = format!("`{name}`");
    let link = Fields::read(fields.required(name)?, owner, &LINK.names())?;
    Ok(Link {
        section: section(link.required("section")?)?,
        material: material(link.required("material")?)?,
    })
}
