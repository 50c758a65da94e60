//! The spherical 3-RRR in a batch file.

use crate::error::LoadError;
use crate::parameters::{
    DRIVE_TORQUE, ELEMENTS, JOINT_STIFFNESS, Kind, drive_stiffness, elbow_side, elements,
    joint_stiffness, link, refused,
};
use crate::prebuilt::SphericalThreeRrr;
use crate::terms::Type::{Number, Record as Of, Word};
use crate::terms::parts::LINK;
use crate::terms::{needed, optional};
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const KIND: Kind = Kind {
    name: "SphericalThreeRrr",
    fields: &[
        needed("radius", Number("m"), "of all joints from O"),
        needed("base_angle", Number("rad"), "of the axes of A_i from -z"),
        needed(
            "platform_angle",
            Number("rad"),
            "of the axes of C_i from z, at home",
        ),
        needed(
            "proximal_angle",
            Number("rad"),
            "between the axes of A_i and B_i",
        ),
        needed(
            "distal_angle",
            Number("rad"),
            "between the axes of B_i and C_i",
        ),
        optional(
            "elbow",
            Word(&["Left", "Right"]),
            "to which side the elbows are, seen from outside",
        ),
        needed("proximal", Of(&LINK), "the links at the base"),
        needed("distal", Of(&LINK), "the links at the platform"),
        JOINT_STIFFNESS,
        DRIVE_TORQUE,
        ELEMENTS,
    ],
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
