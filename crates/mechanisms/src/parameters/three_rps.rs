//! The 3-RPS in a batch file.

use super::legs::telescopic_leg;
use crate::error::LoadError;
use crate::parameters::{Kind, drive_stiffness, elements, joint_stiffness, refused};
use crate::prebuilt::ThreeRps;
use crate::terms::prebuilts;
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const KIND: Kind = Kind {
    name: "ThreeRps",
    fields: prebuilts::THREE_RPS,
    read: |fields| Ok(Box::new(read(fields)?)),
};

fn read(fields: &Fields<'_>) -> Result<ThreeRps, LoadError> {
    let mechanism = ThreeRps {
        base_radius: fields.number("base_radius")?,
        platform_radius: fields.number("platform_radius")?,
        leg: telescopic_leg(fields)?,
        joint_stiffness: joint_stiffness(fields)?,
        drive_stiffness: drive_stiffness(fields, &[Dimension::STIFFNESS])?,
        elements: elements(fields)?,
    };
    mechanism.check().map_err(|error| refused(fields, &error))?;
    Ok(mechanism)
}
