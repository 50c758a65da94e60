//! The spherical 3-RRR in a batch file.

use crate::error::LoadError;
use crate::parameters::{
    Kind, drive_stiffness, elbow_side, elements, joint_stiffness, link, refused,
};
use crate::prebuilt::SphericalThreeRrr;
use crate::terms::prebuilts;
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const KIND: Kind = Kind {
    name: "SphericalThreeRrr",
    fields: prebuilts::SPHERICAL_THREE_RRR,
    read: |fields| Ok(Box::new(read(fields)?)),
};

fn read(fields: &Fields<'_>) -> Result<SphericalThreeRrr, LoadError> {
    let mechanism = SphericalThreeRrr {
        radius: fields.number("radius")?,
        base_angle: fields.number("base_angle")?,
        platform_angle: fields.number("platform_angle")?,
        proximal_angle: fields.number("proximal_angle")?,
        distal_angle: fields.number("distal_angle")?,
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
