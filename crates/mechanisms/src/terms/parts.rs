//! Materials, sections and other parts that stand in many places.

use super::Type::{self, Count, Kinds as OneKind, Number, Record as Of};
use super::{Field, Kinds, Record, kind, needed, optional};

/// A vector in this unit.
pub(crate) const fn vector(unit: &'static str) -> Type {
    Type::Numbers(3, unit)
}

/// A body and a point of it.
pub(crate) const NODE: Type = Type::Tuple(&[Type::Text, Type::Text]);

/// A direction of any length but zero.
pub(crate) const DIRECTION: Type = vector("-");

pub(crate) const MATERIAL: Record = Record {
    name: "material",
    about: "A material; exactly one of `poisson` and `shear`",
    fields: &[
        needed("young", Number("Pa"), "Young's modulus E"),
        optional(
            "poisson",
            Number("-"),
            "Poisson's ratio, above -1, at most 0.5",
        ),
        optional("shear", Number("Pa"), "the shear modulus G itself"),
        optional(
            "density",
            Number("kg/m³"),
            "needed for gravity and natural frequencies",
        ),
        optional(
            "expansion",
            Number("1/K"),
            "coefficient of linear thermal expansion",
        ),
        optional("yield", Number("Pa"), "yield strength, for utilisations"),
    ],
    one_of: &["poisson", "shear"],
    any_of: &[],
};

const SHEAR_Y: Field = optional(
    "shear_y",
    Number("m²"),
    "effective shear area along local y",
);
const SHEAR_Z: Field = optional(
    "shear_z",
    Number("m²"),
    "effective shear area along local z",
);

const CIRCLE: &[Field] = &[
    needed("diameter", Number("m"), "outer diameter"),
    SHEAR_Y,
    SHEAR_Z,
];

const TUBE: &[Field] = &[
    needed("outer", Number("m"), "outer diameter"),
    needed("inner", Number("m"), "inner diameter, below the outer one"),
    SHEAR_Y,
    SHEAR_Z,
];

const RECTANGLE: &[Field] = &[
    needed("width", Number("m"), "along local y"),
    needed("height", Number("m"), "along local z"),
    SHEAR_Y,
    SHEAR_Z,
];

const GENERAL: &[Field] = &[
    needed("area", Number("m²"), "cross-section"),
    needed("iy", Number("m⁴"), "second moment about local y"),
    needed("iz", Number("m⁴"), "second moment about local z"),
    needed("torsion", Number("m⁴"), "torsion constant"),
    SHEAR_Y,
    SHEAR_Z,
    optional(
        "y_max",
        Number("m"),
        "largest distance along local y, for stresses",
    ),
    optional(
        "z_max",
        Number("m"),
        "largest distance along local z, for stresses",
    ),
    optional(
        "torsion_modulus",
        Number("m³"),
        "torque over shear stress, for stresses",
    ),
];

/// Sections that do not change along a beam.
pub(crate) const SECTION: Kinds = Kinds {
    name: "section",
    kinds: &[
        kind("Circle", "a solid round section", CIRCLE),
        kind("Tube", "a hollow round section", TUBE),
        kind("Rectangle", "a solid rectangle", RECTANGLE),
        kind("General", "any section, by its properties", GENERAL),
    ],
};

/// What the table of sections holds.
pub(crate) const PROFILE: Kinds = Kinds {
    name: "profile",
    kinds: &[
        kind("Circle", "a solid round section", CIRCLE),
        kind("Tube", "a hollow round section", TUBE),
        kind("Rectangle", "a solid rectangle", RECTANGLE),
        kind("General", "any section, by its properties", GENERAL),
        kind(
            "Tapered",
            "a section that changes along what it is used for",
            &[
                needed("from", OneKind(&SECTION), "the section at the first point"),
                needed(
                    "to",
                    OneKind(&SECTION),
                    "the section at the last point, of the same kind",
                ),
            ],
        ),
    ],
};

/// A section and a material.
pub(crate) const LINK: Record = Record::new(
    "link",
    "What a link is made of",
    &[
        needed("section", OneKind(&SECTION), "its section"),
        needed("material", Of(&MATERIAL), "its material"),
    ],
);

/// A number of elements.
pub(crate) const ELEMENTS: Type = Count(1, 1_000_000);

/// Stiffnesses by direction, in the joint frame.
pub(crate) const STIFFNESSES: Record = Record::new(
    "stiffnesses",
    "Stiffnesses by direction of the joint frame; 0 frees a direction",
    &[
        optional("x", Number("N/m"), "along x"),
        optional("y", Number("N/m"), "along y"),
        optional("z", Number("N/m"), "along z"),
        optional("u", Number("N·m/rad"), "about x"),
        optional("v", Number("N·m/rad"), "about y"),
        optional("w", Number("N·m/rad"), "about z"),
    ],
);
