//! The linear delta in a batch file.

use super::legs::{RAILS_FIELD, foot_joint, rails};
use crate::error::LoadError;
use crate::parameters::{
    DRIVE_FORCE, ELEMENTS, JOINT_STIFFNESS, Kind, drive_stiffness, elements, joint_stiffness, link,
    refused,
};
use crate::prebuilt::LinearDelta;
use crate::terms::Type::{Number, Record as Of, Word};
use crate::terms::parts::LINK;
use crate::terms::{needed, optional};
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const KIND: Kind = Kind {
    name: "LinearDelta",
    fields: &[
        RAILS_FIELD,
        needed("platform_radius", Number("m"), "from P to each C_i"),
        needed("rod_length", Number("m"), "of the rods"),
        needed(
            "rod_spacing",
            Number("m"),
            "distance of the two rods of a limb",
        ),
        optional(
            "carriage_joints",
            Word(&["Universal", "Spherical"]),
            "of the rods, at the carriages",
        ),
        needed("rod", Of(&LINK), "what the rods are made of"),
        JOINT_STIFFNESS,
        DRIVE_FORCE,
        ELEMENTS,
    ],
    read: |fields| Ok(Box::new(read(fields)?)),
};

fn read(fields: &Fields<'_>) -> Result<LinearDelta, LoadError> {
    let mechanism = LinearDelta {
        rails: rails(fields)?,
        platform_radius: fields.number("platform_radius")?,
        rod_length: fields.number("rod_length")?,
        rod_spacing: fields.number("rod_spacing")?,
        carriage_joints: foot_joint(fields, "carriage_joints")?,
        rod: link(fields, "rod")?,
        joint_stiffness: joint_stiffness(fields)?,
        drive_stiffness: drive_stiffness(fields, &[Dimension::STIFFNESS])?,
        elements: elements(fields)?,
    };
    mechanism.check().map_err(|error| refused(fields, &error))?;
    Ok(mechanism)
}
