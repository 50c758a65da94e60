//! The Orthoglide in a batch file.

use crate::error::LoadError;
use crate::parameters::{Kind, drive_stiffness, elements, joint_stiffness, link, refused};
use crate::prebuilt::Orthoglide;
use crate::terms::prebuilts;
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const KIND: Kind = Kind {
    name: "Orthoglide",
    fields: prebuilts::ORTHOGLIDE,
    read: |fields| Ok(Box::new(read(fields)?)),
};

fn read(fields: &Fields<'_>) -> Result<Orthoglide, LoadError> {
    let mechanism = Orthoglide {
        platform_radius: fields.number("platform_radius")?,
        rod_length: fields.number("rod_length")?,
        rod_spacing: fields.number("rod_spacing")?,
        bar: link(fields, "bar")?,
        rod: link(fields, "rod")?,
        joint_stiffness: joint_stiffness(fields)?,
        drive_stiffness: drive_stiffness(fields, &[Dimension::STIFFNESS])?,
        elements: elements(fields)?,
    };
    mechanism.check().map_err(|error| refused(fields, &error))?;
    Ok(mechanism)
}
