//! The planar 3-RRR in a batch file.

use crate::error::LoadError;
use crate::parameters::{
    DRIVE_TORQUE, ELEMENTS, JOINT_STIFFNESS, Kind, drive_stiffness, elbow_side, elements,
    joint_stiffness, link, refused,
};
use crate::prebuilt::PlanarThreeRrr;
use crate::terms::Type::{Number, Record as Of, Word};
use crate::terms::parts::LINK;
use crate::terms::{needed, optional};
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const KIND: Kind = Kind {
    name: "PlanarThreeRrr",
    fields: &[
        needed("base_radius", Number("m"), "from z to each A_i"),
        needed("platform_radius", Number("m"), "from P to each C_i"),
        needed("proximal_length", Number("m"), "A_i B_i"),
        needed("distal_length", Number("m"), "B_i C_i"),
        optional(
            "elbow",
            Word(&["Left", "Right"]),
            "to which side the elbows are, seen along the limb",
        ),
        needed("proximal", Of(&LINK), "the links at the base"),
        needed("distal", Of(&LINK), "the links at the platform"),
        JOINT_STIFFNESS,
        DRIVE_TORQUE,
        ELEMENTS,
    ],
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
