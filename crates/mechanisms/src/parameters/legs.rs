//! Parts that several of the prebuilt mechanisms of a batch file have: telescopic legs, rails,
//! the joints of legs and rods.

use crate::error::LoadError;
use crate::parameters::{link, optional, pair, refused};
use crate::prebuilt::{CarriageSide, FootJoint, Rails, TelescopicLeg};
use crate::terms::prebuilts::{LEG, RAILS};
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;

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
