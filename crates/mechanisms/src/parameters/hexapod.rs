//! The hexapod in a batch file, and the cubic one.

use super::legs::{foot_joint, telescopic_leg};
use crate::error::LoadError;
use crate::parameters::{Kind, drive_stiffness, elements, joint_stiffness, refused};
use crate::prebuilt::Hexapod;
use crate::terms::prebuilts;
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const KIND: Kind = Kind {
    name: "Hexapod",
    fields: prebuilts::HEXAPOD,
    read: |fields| Ok(Box::new(read(fields)?)),
};

pub(super) const CUBIC: Kind = Kind {
    name: "CubicHexapod",
    fields: prebuilts::CUBIC_HEXAPOD,
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
