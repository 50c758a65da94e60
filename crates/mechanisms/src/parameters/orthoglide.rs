//! The Orthoglide in a batch file.

use crate::error::LoadError;
use crate::parameters::{
    DRIVE_FORCE, ELEMENTS, JOINT_STIFFNESS, Kind, drive_stiffness, elements, joint_stiffness, link,
    refused,
};
use crate::prebuilt::Orthoglide;
use crate::terms::Type::{Number, Record as Of};
use crate::terms::needed;
use crate::terms::parts::LINK;
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const KIND: Kind = Kind {
    name: "Orthoglide",
    fields: &[
        needed(
            "platform_radius",
            Number("m"),
            "from P to each C_i, against the limb's axis",
        ),
        needed("rod_length", Number("m"), "of the parallelogram's rods"),
        needed(
            "rod_spacing",
            Number("m"),
            "distance of the two rods of a limb",
        ),
        needed("bar", Of(&LINK), "both cross links"),
        needed("rod", Of(&LINK), "what the rods are made of"),
        JOINT_STIFFNESS,
        DRIVE_FORCE,
        ELEMENTS,
    ],
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
