//! Parts that several of the prebuilt mechanisms of a batch file have: telescopic legs, rails,
//! the joints of legs and rods.

use crate::error::LoadError;
use crate::parameters::{link, optional, pair, refused};
use crate::prebuilt::{CarriageSide, FootJoint, Rails, TelescopicLeg};
use crate::terms::Type::{Number, Numbers, Record as Of, Word};
use crate::terms::parts::LINK;
use crate::terms::{Field, Record, needed, optional as may};
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

pub(super) const LEG_FIELD: Field = needed("leg", Of(&LEG), "the telescopic legs");

const LEG: Record = Record::new(
    "leg",
    "A telescopic leg, with its drive between cylinder and piston",
    &[
        needed("cylinder", Of(&LINK), "what it is made of"),
        needed("piston", Of(&LINK), "what it is made of"),
        needed(
            "cylinder_length",
            Number("m"),
            "from the base joint to the drive",
        ),
        needed(
            "lengths",
            Numbers(2, "m"),
            "of the whole leg: shortest and longest",
        ),
    ],
);

pub(super) const RAILS_FIELD: Field = needed("rails", Of(&RAILS), "on which the carriages slide");

const RAILS: Record = Record::new(
    "rails",
    "Rails on which carriages slide",
    &[
        needed("radius", Number("m"), "from z to the rails' feet, at z = 0"),
        may("tilt", Number("rad"), "by how much they lean inward"),
        needed("travel", Number("m"), "of a carriage from its rail's foot"),
        may(
            "carriage",
            Word(&["Near", "Far"]),
            "which of the two places on its rail a carriage takes",
        ),
    ],
);

/// The field `leg`.
pub(super) fn telescopic_leg(fields: &Fields<'_>) -> Result<TelescopicLeg, LoadError> {
    let fields = Fields::read(fields.required("leg")?, "`leg`", &LEG.names())?;
    let leg = TelescopicLeg {
        cylinder: link(&fields, "cylinder")?,
        piston: link(&fields, "piston")?,
        cylinder_length: fields.number("cylinder_length")?,
        lengths: pair(
            &fields,
            "lengths",
            "two lengths, `(shortest, longest)`",
            |value| value.quantity("`lengths`", Dimension::LENGTH),
        )?,
    };
    leg.check().map_err(|error| refused(&fields, &error))?;
    Ok(leg)
}

/// The field `rails`.
pub(super) fn rails(fields: &Fields<'_>) -> Result<Rails, LoadError> {
    let fields = Fields::read(fields.required("rails")?, "`rails`", &RAILS.names())?;
    let rails = Rails {
        radius: fields.number("radius")?,
        tilt: fields.optional_number("tilt")?.unwrap_or_default(),
        travel: fields.number("travel")?,
        carriage: optional(&fields, "carriage", |value| {
            value.parse::<CarriageSide>("`Near` or `Far`")
        })?,
    };
    rails.check().map_err(|error| refused(&fields, &error))?;
    Ok(rails)
}

/// The kind of the joints by which legs or rods stand.
pub(super) fn foot_joint(fields: &Fields<'_>, name: &str) -> Result<FootJoint, LoadError> {
    optional(fields, name, |value| {
        value.parse("`Universal` or `Spherical`")
    })
}
