//! The hexapod in a batch file, and the cubic one.

use super::legs::{LEG_FIELD, foot_joint, telescopic_leg};
use crate::error::LoadError;
use crate::parameters::{
    DRIVE_FORCE, ELEMENTS, JOINT_STIFFNESS, Kind, drive_stiffness, elements, joint_stiffness,
    refused,
};
use crate::prebuilt::Hexapod;
use crate::terms::Type::{Number, Word};
use crate::terms::{needed, optional};
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const KIND: Kind = Kind {
    name: "Hexapod",
    fields: &[
        needed("base_radius", Number("m"), "from the origin to each B_i"),
        needed(
            "base_angle",
            Number("rad"),
            "half the angle between the joints of a pair, 0 to π/3",
        ),
        needed("platform_radius", Number("m"), "from P to each S_i"),
        needed(
            "platform_angle",
            Number("rad"),
            "half the angle between the joints of a pair, 0 to π/3",
        ),
        optional(
            "base_joints",
            Word(&["Universal", "Spherical"]),
            "with which the legs stand",
        ),
        LEG_FIELD,
        JOINT_STIFFNESS,
        DRIVE_FORCE,
        ELEMENTS,
    ],
    read: |fields| Ok(Box::new(read(fields)?)),
};

pub(super) const CUBIC: Kind = Kind {
    name: "CubicHexapod",
    fields: &[
        needed(
            "edge",
            Number("m"),
            "of the cube: length of the legs at home",
        ),
        LEG_FIELD,
        JOINT_STIFFNESS,
        DRIVE_FORCE,
        ELEMENTS,
    ],
    read: |fields| Ok(Box::new(read_cubic(fields)?)),
};

fn read(fields: &Fields<'_>) -> Result<Hexapod, LoadError> {
    let mechanism = Hexapod {
        base_radius: fields.number("base_radius")?,
        base_angle: fields.number("base_angle")?,
        platform_radius: fields.number("platform_radius")?,
        platform_angle: fields.number("platform_angle")?,
        base_joints: foot_joint(fields, "base_joints")?,
        leg: telescopic_leg(fields)?,
        joint_stiffness: joint_stiffness(fields)?,
        drive_stiffness: drive_stiffness(fields, &[Dimension::STIFFNESS])?,
        elements: elements(fields)?,
    };
    mechanism.check().map_err(|error| refused(fields, &error))?;
    Ok(mechanism)
}

fn read_cubic(fields: &Fields<'_>) -> Result<Hexapod, LoadError> {
    let edge = fields.number("edge")?;
    let cubic = Hexapod::cubic(edge, telescopic_leg(fields)?);
    let mechanism = Hexapod {
        joint_stiffness: joint_stiffness(fields)?,
        drive_stiffness: drive_stiffness(fields, &[Dimension::STIFFNESS])?,
        elements: elements(fields)?,
        ..cubic.map_err(|error| refused(fields, &error))?
    };
    mechanism.check().map_err(|error| refused(fields, &error))?;
    Ok(mechanism)
}
