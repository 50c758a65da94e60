//! The Tricept in a batch file.

use super::legs::{LEG_FIELD, telescopic_leg};
use crate::error::LoadError;
use crate::parameters::{
    DRIVE_FORCE, ELEMENTS, JOINT_STIFFNESS, Kind, drive_stiffness, elements, joint_stiffness, link,
    refused,
};
use crate::prebuilt::Tricept;
use crate::terms::Type::{Number, Record as Of};
use crate::terms::needed;
use crate::terms::parts::LINK;
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const KIND: Kind = Kind {
    name: "Tricept",
    fields: &[
        needed("base_radius", Number("m"), "from O to each B_i"),
        needed("platform_radius", Number("m"), "from P to each S_i"),
        LEG_FIELD,
        needed("tube", Of(&LINK), "the middle leg's half at the base"),
        needed("spline", Of(&LINK), "the middle leg's half at the platform"),
        needed("tube_length", Number("m"), "O M; P is farther from O"),
        JOINT_STIFFNESS,
        DRIVE_FORCE,
        ELEMENTS,
    ],
    read: |fields| Ok(Box::new(read(fields)?)),
};

fn read(fields: &Fields<'_>) -> Result<Tricept, LoadError> {
    let mechanism = Tricept {
        base_radius: fields.number("base_radius")?,
        platform_radius: fields.number("platform_radius")?,
        leg: telescopic_leg(fields)?,
        tube: link(fields, "tube")?,
        spline: link(fields, "spline")?,
        tube_length: fields.number("tube_length")?,
        joint_stiffness: joint_stiffness(fields)?,
        drive_stiffness: drive_stiffness(fields, &[Dimension::STIFFNESS])?,
        elements: elements(fields)?,
    };
    mechanism.check().map_err(|error| refused(fields, &error))?;
    Ok(mechanism)
}
