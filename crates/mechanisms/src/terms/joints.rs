//! Joints of a mechanism file, and the built-in kinds of them.

use super::Type::{
    Any, Joint, Kinds as OneKind, List, Number, Numbers, Record as Of, Text, Truth, Tuple, Word,
};
use super::parts::{DIRECTION, STIFFNESSES};
use super::{Field, Kinds, Record, Type, needed, of_value, optional};

pub(super) const DIRECTIONS: [&str; 6] = ["x", "y", "z", "u", "v", "w"];

const ROW: Type = Numbers(6, "N, m, rad");

/// A full matrix over x y z u v w.
const MATRIX: Kinds = Kinds {
    name: "stiffness_matrix",
    kinds: &[of_value(
        "Matrix",
        "six rows of six numbers, symmetric, positive semidefinite",
        Any(&[Tuple(&[ROW; 6]), Numbers(36, "N, m, rad")]),
    )],
};

/// What the second body stands off by.
pub(crate) const MISFIT: Record = Record::new(
    "misfit",
    "What the second body stands off from the first, in the joint frame",
    &[
        optional("x", Number("m"), "along x"),
        optional("y", Number("m"), "along y"),
        optional("z", Number("m"), "along z"),
        optional("u", Number("rad"), "about x"),
        optional("v", Number("rad"), "about y"),
        optional("w", Number("rad"), "about z"),
    ],
);

/// What presses the bodies on each other.
pub(crate) const PRELOAD: Record = Record::new(
    "preload",
    "What acts on the second body, and its opposite on the first, in the joint frame",
    &[
        optional("x", Number("N"), "along x"),
        optional("y", Number("N"), "along y"),
        optional("z", Number("N"), "along z"),
        optional("u", Number("N·m"), "about x"),
        optional("v", Number("N·m"), "about y"),
        optional("w", Number("N·m"), "about z"),
    ],
);

pub(crate) const JOINT: Record = Record::new(
    "joint",
    "A joint between two bodies",
    &[
        needed("at", Text, "name of a point that both bodies have"),
        needed(
            "between",
            Tuple(&[Text, Text]),
            "two bodies; either may be `ground`",
        ),
        needed("kind", Joint, "which motions it leaves free"),
        optional("x_axis", DIRECTION, "direction of the joint frame's x"),
        optional(
            "locked",
            Any(&[Truth, List(&Word(&DIRECTIONS))]),
            "whether all free directions are held, or which",
        ),
        optional(
            "stiffness",
            Any(&[Of(&STIFFNESSES), OneKind(&MATRIX)]),
            "elastic directions",
        ),
        optional(
            "misfit",
            Of(&MISFIT),
            "what the second body stands off from the first",
        ),
        optional(
            "preload",
            Of(&PRELOAD),
            "what presses the bodies on each other",
        ),
    ],
);

/// A built-in kind of joint.
pub(crate) struct JointKind {
    pub(crate) name: &'static str,
    pub(crate) about: &'static str,
    pub(crate) fields: &'static [Field],
}

const MAY_HAVE_AXIS: &[Field] = &[optional("axis", DIRECTION, "y of the joint frame")];
const AXIS: Field = needed("axis", DIRECTION, "the joint's axis, y of its frame");
const AXES: Type = Tuple(&[DIRECTION, DIRECTION]);

/// The built-in kinds, in the order of the registry.
pub(crate) const KINDS: [JointKind; 8] = [
    joint(
        "Fixed",
        "a weld, or with `stiffness` a bushing",
        MAY_HAVE_AXIS,
    ),
    joint("Revolute", "turns about its axis", &[AXIS]),
    joint("Prismatic", "slides along its axis", &[AXIS]),
    joint(
        "Cylindrical",
        "turns about its axis and slides along it",
        &[AXIS],
    ),
    joint(
        "Screw",
        "turns about its axis and advances along it",
        &[
            AXIS,
            needed("pitch", Number("m/rad"), "advance a radian, right-handed"),
        ],
    ),
    joint(
        "Universal",
        "turns about two axes",
        &[needed(
            "axes",
            AXES,
            "the axis fixed in the first body, and that in the second",
        )],
    ),
    joint("Spherical", "turns about its point", MAY_HAVE_AXIS),
    joint(
        "Planar",
        "slides in a plane and turns about its normal",
        &[needed(
            "normal",
            DIRECTION,
            "the plane's normal, y of the joint frame",
        )],
    ),
];

const fn joint(name: &'static str, about: &'static str, fields: &'static [Field]) -> JointKind {
    JointKind {
        name,
        about,
        fields,
    }
}

/// The fields of a built-in kind.
pub(crate) fn of_kind(name: &str) -> &'static [Field] {
    const ALL: &[JointKind] = &KINDS;
    let kind = ALL.iter().find(|kind| kind.name == name);
    kind.map_or(&[], |kind| kind.fields)
}
