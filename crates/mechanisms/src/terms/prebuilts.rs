//! The parameters of the built-in prebuilt mechanisms.

use super::Type::{Any, Kinds, Number, Numbers, Record as Of, Tuple, Word};
use super::parts::{self, LINK, MATERIAL, SECTION, STIFFNESSES};
use super::{Field, Record, Type, needed, optional as may};

const JOINT_STIFFNESS: Field = may(
    "joint_stiffness",
    Of(&STIFFNESSES),
    "of every passive joint, in its frame; left out: rigid",
);
/// The stiffness of drives that slide, and of those that turn.
const DRIVE_FORCE: Field = may("drive_stiffness", Number("N/m"), DRIVES);
const DRIVE_TORQUE: Field = may("drive_stiffness", Number("N·m/rad"), DRIVES);
const DRIVES: &str = "of the drives; left out: rigid";
const ELEMENTS: Field = may(
    "elements",
    parts::ELEMENTS,
    "of every segment; changes no result",
);

/// A stiffness, or none.
const SPRING: Type = Any(&[Number("N/m"), Word(&["Rigid"])]);

const LEG_FIELD: Field = needed("leg", Of(&LEG), "the telescopic legs");

pub(crate) const LEG: Record = Record::new(
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

const RAILS_FIELD: Field = needed("rails", Of(&RAILS), "on which the carriages slide");

pub(crate) const RAILS: Record = Record::new(
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

pub(crate) const DELTA: &[Field] = &[
    needed(
        "base_radius",
        Number("m"),
        "from the base's centre to each A_i",
    ),
    needed(
        "platform_radius",
        Number("m"),
        "from the platform's centre to each C_i",
    ),
    needed("arm_length", Number("m"), "A_i B_i"),
    needed("rod_length", Number("m"), "of the parallelogram's rods"),
    needed(
        "rod_spacing",
        Number("m"),
        "distance of the two rods of a limb",
    ),
    may(
        "elbow",
        Word(&["Out", "In"]),
        "the elbow farther along the limb's outward direction, or the other",
    ),
    may(
        "rod_ends",
        Word(&["Revolute", "Spherical"]),
        "the joints of the rods",
    ),
    needed("arm", Of(&LINK), "the arms"),
    needed("bar", Of(&LINK), "both cross links of a limb"),
    needed("rod", Of(&LINK), "the rods"),
    JOINT_STIFFNESS,
    DRIVE_TORQUE,
    ELEMENTS,
];

pub(crate) const SINGLE_FREEDOM: &[Field] = &[
    needed("lengths", Numbers(2, "m"), "of AB and CD"),
    needed(
        "sections",
        Tuple(&[Kinds(&SECTION), Kinds(&SECTION)]),
        "of AB and CD",
    ),
    needed("material", Of(&MATERIAL), "of both"),
    needed(
        "joint_stiffness",
        Tuple(&[SPRING, SPRING]),
        "along x at B and at C; 0 is free",
    ),
];

pub(crate) const EXECHON: &[Field] = &[
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
];

pub(crate) const HEXAPOD: &[Field] = &[
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
    may(
        "base_joints",
        Word(&["Universal", "Spherical"]),
        "with which the legs stand",
    ),
    LEG_FIELD,
    JOINT_STIFFNESS,
    DRIVE_FORCE,
    ELEMENTS,
];

pub(crate) const CUBIC_HEXAPOD: &[Field] = &[
    needed(
        "edge",
        Number("m"),
        "of the cube: length of the legs at home",
    ),
    LEG_FIELD,
    JOINT_STIFFNESS,
    DRIVE_FORCE,
    ELEMENTS,
];

pub(crate) const LINEAR_DELTA: &[Field] = &[
    RAILS_FIELD,
    needed("platform_radius", Number("m"), "from P to each C_i"),
    needed("rod_length", Number("m"), "of the rods"),
    needed(
        "rod_spacing",
        Number("m"),
        "distance of the two rods of a limb",
    ),
    may(
        "carriage_joints",
        Word(&["Universal", "Spherical"]),
        "of the rods, at the carriages",
    ),
    needed("rod", Of(&LINK), "what the rods are made of"),
    JOINT_STIFFNESS,
    DRIVE_FORCE,
    ELEMENTS,
];

pub(crate) const ORTHOGLIDE: &[Field] = &[
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
];

pub(crate) const PLANAR_THREE_RRR: &[Field] = &[
    needed("base_radius", Number("m"), "from z to each A_i"),
    needed("platform_radius", Number("m"), "from P to each C_i"),
    needed("proximal_length", Number("m"), "A_i B_i"),
    needed("distal_length", Number("m"), "B_i C_i"),
    may(
        "elbow",
        Word(&["Left", "Right"]),
        "to which side the elbows are, seen along the limb",
    ),
    needed("proximal", Of(&LINK), "the links at the base"),
    needed("distal", Of(&LINK), "the links at the platform"),
    JOINT_STIFFNESS,
    DRIVE_TORQUE,
    ELEMENTS,
];

pub(crate) const SPHERICAL_THREE_RRR: &[Field] = &[
    needed("radius", Number("m"), "of all joints from O"),
    needed("base_angle", Number("rad"), "of the axes of A_i from -z"),
    needed(
        "platform_angle",
        Number("rad"),
        "of the axes of C_i from z, at home",
    ),
    needed(
        "proximal_angle",
        Number("rad"),
        "between the axes of A_i and B_i",
    ),
    needed(
        "distal_angle",
        Number("rad"),
        "between the axes of B_i and C_i",
    ),
    may(
        "elbow",
        Word(&["Left", "Right"]),
        "to which side the elbows are, seen from outside",
    ),
    needed("proximal", Of(&LINK), "the links at the base"),
    needed("distal", Of(&LINK), "the links at the platform"),
    JOINT_STIFFNESS,
    DRIVE_TORQUE,
    ELEMENTS,
];

pub(crate) const THREE_PRS: &[Field] = &[
    RAILS_FIELD,
    needed("platform_radius", Number("m"), "from P to each S_i"),
    needed("rod_length", Number("m"), "A_i S_i"),
    needed("rod", Of(&LINK), "what the rods are made of"),
    JOINT_STIFFNESS,
    DRIVE_FORCE,
    ELEMENTS,
];

pub(crate) const THREE_RPS: &[Field] = &[
    needed("base_radius", Number("m"), "from z to each B_i"),
    needed("platform_radius", Number("m"), "from P to each S_i"),
    LEG_FIELD,
    JOINT_STIFFNESS,
    DRIVE_FORCE,
    ELEMENTS,
];

pub(crate) const TRICEPT: &[Field] = &[
    needed("base_radius", Number("m"), "from O to each B_i"),
    needed("platform_radius", Number("m"), "from P to each S_i"),
    LEG_FIELD,
    needed("tube", Of(&LINK), "the middle leg's half at the base"),
    needed("spline", Of(&LINK), "the middle leg's half at the platform"),
    needed("tube_length", Number("m"), "O M; P is farther from O"),
    JOINT_STIFFNESS,
    DRIVE_FORCE,
    ELEMENTS,
];

pub(crate) const TRIPTERON: &[Field] = &[
    needed(
        "rail",
        Numbers(2, "m"),
        "place of a limb's rail in the plane normal to it",
    ),
    needed(
        "platform_radius",
        Number("m"),
        "from P to each C_i, against the limb's axis",
    ),
    needed("proximal_length", Number("m"), "A_i B_i"),
    needed("distal_length", Number("m"), "B_i C_i"),
    may(
        "elbow",
        Word(&["Left", "Right"]),
        "to which side the elbows are, seen along the limb",
    ),
    needed("proximal", Of(&LINK), "the links at the rail"),
    needed("distal", Of(&LINK), "the links at the platform"),
    JOINT_STIFFNESS,
    DRIVE_FORCE,
    ELEMENTS,
];

/// Of all of them.
pub(crate) const ALL: [&[Field]; 13] = [
    DELTA,
    SINGLE_FREEDOM,
    EXECHON,
    HEXAPOD,
    CUBIC_HEXAPOD,
    LINEAR_DELTA,
    ORTHOGLIDE,
    PLANAR_THREE_RRR,
    SPHERICAL_THREE_RRR,
    THREE_PRS,
    THREE_RPS,
    TRICEPT,
    TRIPTERON,
];
