//! The planar 3-RRR in a batch file.

use crate::error::LoadError;
use crate::parameters::{
    Kind, drive_stiffness, elbow_side, elements, joint_stiffness, link, refused,
};
use crate::prebuilt::PlanarThreeRrr;
use crate::terms::prebuilts;
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const KIND: Kind = Kind {
    name: "PlanarThreeRrr",
    fields: prebuilts::PLANAR_THREE_RRR,
    read: |fields| Ok(Box::new(read(fields)?)),
};

fn read(fields: &Fields<'_>) -> Result<PlanarThreeRrr, LoadError> {
    let mechanism = PlanarThreeRrr {
        base_radius: fields.number("base_radius")?,
        platform_radius: fields.number("platform_radius")?,
        proximal_length: fields.number("proximal_length")?,
        distal_length: fields.number("distal_length")?,
        elbow: elbow_side(fields)?,
        proximal: link(fields, "proximal")?,
        distal: link(fields, "distal")?,
        joint_stiffness: joint_stiffness(fields)?,
        drive_stiffness: drive_stiffness(fields, &[Dimension::ROTATIONAL_STIFFNESS])?,
        elements: elements(fields)?,
    };
    mechanism.check().map_err(|error| refused(fields, &error))?;
    Ok(mechanism)
}
