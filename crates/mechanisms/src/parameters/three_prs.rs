//! The 3-PRS in a batch file.

use super::legs::{RAILS_FIELD, rails};
use crate::error::LoadError;
use crate::parameters::{
    DRIVE_FORCE, ELEMENTS, JOINT_STIFFNESS, Kind, drive_stiffness, elements, joint_stiffness, link,
    refused,
};
use crate::prebuilt::ThreePrs;
use crate::terms::Type::{Number, Record as Of};
use crate::terms::needed;
use crate::terms::parts::LINK;
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const KIND: Kind = Kind {
    name: "ThreePrs",
    fields: &[
        RAILS_FIELD,
        needed("platform_radius", Number("m"), "from P to each S_i"),
        needed("rod_length", Number("m"), "A_i S_i"),
        needed("rod", Of(&LINK), "what the rods are made of"),
        JOINT_STIFFNESS,
        DRIVE_FORCE,
        ELEMENTS,
    ],
    read: |fields| Ok(Box::new(read(fields)?)),
};

fn read(fields: &Fields<'_>) -> Result<ThreePrs, LoadError> {
    let mechanism = ThreePrs {
        rails: rails(fields)?,
        platform_radius: fields.number("platform_radius")?,
        rod_length: fields.number("rod_length")?,
        rod: link(fields, "rod")?,
        joint_stiffness: joint_stiffness(fields)?,
        drive_stiffness: drive_stiffness(fields, &[Dimension::STIFFNESS])?,
        elements: elements(fields)?,
    };
    mechanism.check().map_err(|error| refused(fields, &error))?;
    Ok(mechanism)
}
