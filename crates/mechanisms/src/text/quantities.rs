//! What the numbers of the fields measure: the one table of it, in the order of the book.
//!
//! A name means the same wherever it stands. Numbers by direction, whose names are those of the
//! directions, have tables of their own.

use super::dimension::Dimension;

/// Fields that hold numbers, or pairs or vectors of them, with what these measure.
pub(crate) const FIELDS: [(&str, Dimension); 61] = [
    // Materials.
    ("young", Dimension::PRESSURE),
    ("poisson", Dimension::NUMBER),
    ("shear", Dimension::PRESSURE),
    ("density", Dimension::DENSITY),
    ("expansion", Dimension::EXPANSION),
    ("yield", Dimension::PRESSURE),
    // Sections.
    ("diameter", Dimension::LENGTH),
    ("outer", Dimension::LENGTH),
    ("inner", Dimension::LENGTH),
    ("width", Dimension::LENGTH),
    ("height", Dimension::LENGTH),
    ("area", Dimension::AREA),
    ("iy", Dimension::AREA_MOMENT),
    ("iz", Dimension::AREA_MOMENT),
    ("torsion", Dimension::AREA_MOMENT),
    ("shear_y", Dimension::AREA),
    ("shear_z", Dimension::AREA),
    ("y_max", Dimension::LENGTH),
    ("z_max", Dimension::LENGTH),
    ("torsion_modulus", Dimension::VOLUME),
    // Points, axes and bodies.
    ("points", Dimension::LENGTH),
    ("y_axis", Dimension::NUMBER),
    ("x_axis", Dimension::NUMBER),
    ("axis", Dimension::NUMBER),
    ("axes", Dimension::NUMBER),
    ("normal", Dimension::NUMBER),
    ("elements", Dimension::NUMBER),
    ("temperature", Dimension::TEMPERATURE),
    // Joints.
    ("pitch", Dimension::PITCH),
    // What acts.
    ("force", Dimension::FORCE),
    ("moment", Dimension::MOMENT),
    ("per_length", Dimension::STIFFNESS),
    ("moment_per_length", Dimension::FORCE),
    ("from", Dimension::STIFFNESS),
    ("to", Dimension::STIFFNESS),
    ("gravity", Dimension::ACCELERATION),
    ("mass", Dimension::MASS),
    ("inertia", Dimension::INERTIA),
    // Prebuilt mechanisms.
    ("base_radius", Dimension::LENGTH),
    ("platform_radius", Dimension::LENGTH),
    ("radius", Dimension::LENGTH),
    ("arm_length", Dimension::LENGTH),
    ("rod_length", Dimension::LENGTH),
    ("rod_spacing", Dimension::LENGTH),
    ("lengths", Dimension::LENGTH),
    ("cylinder_length", Dimension::LENGTH),
    ("tube_length", Dimension::LENGTH),
    ("proximal_length", Dimension::LENGTH),
    ("distal_length", Dimension::LENGTH),
    ("rail", Dimension::LENGTH),
    ("travel", Dimension::LENGTH),
    ("edge", Dimension::LENGTH),
    ("base_width", Dimension::LENGTH),
    ("base_depth", Dimension::LENGTH),
    ("platform_width", Dimension::LENGTH),
    ("platform_depth", Dimension::LENGTH),
    ("base_angle", Dimension::ANGLE),
    ("platform_angle", Dimension::ANGLE),
    ("proximal_angle", Dimension::ANGLE),
    ("distal_angle", Dimension::ANGLE),
    ("tilt", Dimension::ANGLE),
];

/// What a number of a field measures; `None` of a name that is not in the table.
pub(crate) fn of(field: &str) -> Option<Dimension> {
    let found = FIELDS.iter().find(|(name, _)| *name == field);
    found.map(|(_, dimension)| *dimension)
}

/// Stiffnesses along x y z and about u v w.
pub(crate) const STIFFNESS: [Dimension; 6] =
    by_direction(Dimension::STIFFNESS, Dimension::ROTATIONAL_STIFFNESS);

/// Misfits, and poses x y z rx ry rz.
pub(crate) const DISPLACEMENT: [Dimension; 6] = by_direction(Dimension::LENGTH, Dimension::ANGLE);

/// Preloads.
pub(crate) const WRENCH: [Dimension; 6] = by_direction(Dimension::FORCE, Dimension::MOMENT);

/// What three translations and three rotations have.
const fn by_direction(along: Dimension, about: Dimension) -> [Dimension; 6] {
    [along, along, along, about, about, about]
}
