//! The Exechon in a batch file.

use crate::error::LoadError;
use crate::parameters::{Kind, drive_stiffness, elements, joint_stiffness, link, refused};
use crate::prebuilt::Exechon;
use crate::terms::prebuilts;
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const KIND: Kind = Kind {
    name: "Exechon",
    fields: prebuilts::EXECHON,
    read: |fields| Ok(Box::new(read(fields)?)),
};

fn read(fields: &Fields<'_>) -> Result<Exechon, LoadError> {
    let mechanism = Exechon {
        base_width: fields.number("base_width")?,
        base_depth: fields.number("base_depth")?,
        platform_width: fields.number("platform_width")?,
        platform_depth: fields.number("platform_depth")?,
        housing: link(fields, "housing")?,
        ram: link(fields, "ram")?,
        joint_stiffness: joint_stiffness(fields)?,
        drive_stiffness: drive_stiffness(fields, &[Dimension::STIFFNESS])?,
        elements: elements(fields)?,
    };
    mechanism.check().map_err(|error| refused(fields, &error))?;
    Ok(mechanism)
}
