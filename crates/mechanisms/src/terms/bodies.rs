//! Bodies of a mechanism file.

use super::Type::{Any, Kinds as OneKind, List, Map, Number, Record as Of, Text, Word};
use super::joints::DIRECTIONS;
use super::parts::{DIRECTION, ELEMENTS, STIFFNESSES, vector};
use super::{Field, Kinds, Record, Type, kind, needed, of_value, optional};

/// The name of the fixed body.
pub(crate) const GROUND: &str = "ground";
/// The fields of a member that say how its ends are fastened.
pub(crate) const FASTENING: [&str; 3] = ["releases", "springs", "offset"];

/// A section for all, or one for each segment.
const SECTIONS: Type = Any(&[Text, List(&Text)]);

const NAMED_SECTION: &str = "a section's name, or a list of one for each segment";
const Y_AXIS: Field = optional(
    "y_axis",
    Any(&[DIRECTION, List(&DIRECTION)]),
    "direction of local y, made normal to each segment, or a list of one for each",
);
const DIVIDED: Field = optional("elements", ELEMENTS, "elements of every segment");
const TEMPERATURE: Field = optional("temperature", Number("K"), "change of its temperature");

/// Files that hold a table.
pub(crate) const TABLE: Kinds = Kinds {
    name: "table",
    kinds: &[of_value("Csv", "a file of comma-separated numbers", Text)],
};

/// A member of a frame that is more than a list of points.
pub(crate) const MEMBER: Record = Record::new(
    "member",
    "A beam of a frame; what it does not give, it takes from the frame",
    &[
        needed("through", List(&Text), "names of points"),
        optional("section", SECTIONS, NAMED_SECTION),
        optional("material", Text, "a material's name"),
        Y_AXIS,
        DIVIDED,
        optional(
            "releases",
            Map(&List(&Word(&DIRECTIONS))),
            "directions that an end does not carry, by its point, along the member's own axes",
        ),
        optional(
            "springs",
            Map(&Of(&STIFFNESSES)),
            "springs between an end and the frame, by its point, along the member's own axes",
        ),
        optional(
            "offset",
            Map(&vector("m")),
            "from a point to the member's end, by the point: a rigid arm, global axes",
        ),
    ],
);

pub(crate) const BODY: Kinds = Kinds {
    name: "body",
    kinds: &[
        kind(
            "Beam",
            "a straight or bent chain of elastic beams",
            &[
                needed("through", List(&Text), "names of two or more points"),
                needed("section", SECTIONS, NAMED_SECTION),
                needed("material", Text, "a material's name"),
                Y_AXIS,
                DIVIDED,
                TEMPERATURE,
            ],
        ),
        kind(
            "Rigid",
            "one rigid body",
            &[
                needed("points", List(&Text), "names of its points"),
                TEMPERATURE,
            ],
        ),
        kind(
            "Frame",
            "beams that are welded at the points they share",
            &[
                needed(
                    "members",
                    List(&Any(&[List(&Text), Of(&MEMBER)])),
                    "lists of points, or beams with fields of their own",
                ),
                optional("section", SECTIONS, "of members that do not give their own"),
                optional("material", Text, "of members that do not give their own"),
                Y_AXIS,
                DIVIDED,
                TEMPERATURE,
            ],
        ),
        kind(
            "Flexible",
            "an elastic body by its stiffness over its points",
            &[
                needed("points", List(&Text), "names of its points"),
                needed(
                    "stiffness",
                    OneKind(&TABLE),
                    "six rows and columns a point, of the free body",
                ),
                TEMPERATURE,
            ],
        ),
    ],
};
