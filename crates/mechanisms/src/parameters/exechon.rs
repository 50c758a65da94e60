//! The Exechon in a batch file.

use crate::error::LoadError;
use crate::parameters::{
    DRIVE_FORCE, ELEMENTS, JOINT_STIFFNESS, Kind, drive_stiffness, elements, joint_stiffness, link,
    refused,
};
use crate::prebuilt::Exechon;
use crate::terms::Type::{Number, Record as Of};
use crate::terms::needed;
use crate::terms::parts::LINK;
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const KIND: Kind = Kind {
    name: "Exechon",
    fields: &[
        needed("base_width", Number("m"), "A_1 A_2"),
        needed("base_depth", Number("m"), "of A_3 from the line A_1 A_2"),
        needed("platform_width", Number("m"), "B_1 B_2"),
        needed(
            "platform_depth",
            Number("m"),
            "of B_3 from the line B_1 B_2",
        ),
        needed("housing", Of(&LINK), "a leg's half at the base"),
        needed("ram", Of(&LINK), "a leg's half at the platform"),
        JOINT_STIFFNESS,
        DRIVE_FORCE,
        ELEMENTS,
    ],
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
