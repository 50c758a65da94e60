//! The Tricept in a batch file.

use super::legs::telescopic_leg;
use crate::error::LoadError;
use crate::parameters::{Kind, drive_stiffness, elements, joint_stiffness, link, refused};
use crate::prebuilt::Tricept;
use crate::terms::prebuilts;
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const KIND: Kind = Kind {
    name: "Tricept",
    fields: prebuilts::TRICEPT,
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
