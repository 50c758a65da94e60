//! Figures of a job.

use super::Type::{
    Any, Count, Kinds as OneKind, List, Map, Number, Numbers, Record as Of, Text, Truth, Tuple,
    Word,
};
use super::{Field, Kinds, NO_END, Record, Type, kind, needed, of_value, optional};

const SCALE: Field = optional(
    "scale",
    Any(&[Word(&["Auto"]), Number("-")]),
    "magnification",
);
const POSE: Field = optional(
    "pose",
    Any(&[Count(0, NO_END), Of(&AT), Map(&Number("m, rad"))]),
    "number of the pose, from 0, or coordinates that it alone has; of drives by their names",
);

/// Coordinates of a pose.
const AT: Record = Record::new(
    "pose_at",
    "Coordinates of a pose",
    &[
        optional("x", Number("m"), "x of the output"),
        optional("y", Number("m"), "y of the output"),
        optional("z", Number("m"), "z of the output"),
        optional("rx", Number("rad"), "rotation vector along x"),
        optional("ry", Number("rad"), "rotation vector along y"),
        optional("rz", Number("rad"), "rotation vector along z"),
    ],
);
const CASE: Field = optional("case", Text, "name of the case");
const VIEW: Field = optional(
    "view",
    Any(&[Text, Numbers(2, "deg")]),
    "`front`, `right`, `top`, `iso`, or azimuth and elevation of the eye",
);
const SHOW: Field = optional(
    "show",
    List(&Text),
    "what stands beside the mechanism: `names`, `loads`, `masses`, `frames`; `pose` in the caption",
);
const TITLE: Field = optional("title", Text, "title of the figure");
const LABELS: Field = optional(
    "labels",
    Map(&Text),
    "what quantities and coordinates are called in the figure",
);
const ALONG: Type = Any(&[
    Word(&["displacement", "x", "y", "z", "rx", "ry", "rz"]),
    Numbers(3, "-"),
]);

/// A coordinate that is held.
const COORDINATE: Kinds = Kinds {
    name: "plane",
    kinds: &[
        of_value("x", "x is held", Number("m")),
        of_value("y", "y is held", Number("m")),
        of_value("z", "z is held", Number("m")),
        of_value("rx", "rx is held", Number("rad")),
        of_value("ry", "ry is held", Number("rad")),
        of_value("rz", "rz is held", Number("rad")),
    ],
};
const PLANE: Type = Any(&[OneKind(&COORDINATE), Tuple(&[Text, Number("m, rad")])]);

pub(crate) const FIGURE: Kinds = Kinds {
    name: "figure",
    kinds: &[
        kind(
            "Trajectory",
            "the deflected trajectory over the commanded one",
            &[SCALE, TITLE, LABELS],
        ),
        kind(
            "Deformed",
            "the deformed mechanism over the undeformed one",
            &[POSE, CASE, SCALE, VIEW, SHOW, TITLE, LABELS],
        ),
        kind(
            "Mode",
            "a natural mode over the mechanism at rest",
            &[
                optional("number", Count(1, 1000), "which mode, from 1, lowest first"),
                POSE,
                SCALE,
                VIEW,
                SHOW,
                TITLE,
                LABELS,
            ],
        ),
        kind(
            "Budget",
            "shares of bodies, joints and deformations in the deflection",
            &[
                optional("along", ALONG, "the direction that the output gives along"),
                POSE,
                CASE,
                TITLE,
            ],
        ),
        kind(
            "Map",
            "a quantity over a plane of the poses",
            &[
                needed("value", Text, "the quantity"),
                optional(
                    "plane",
                    Any(&[PLANE, List(&PLANE)]),
                    "coordinates that are held",
                ),
                optional(
                    "planes",
                    List(&PLANE),
                    "planes of different axes side by side; each holds one coordinate",
                ),
                optional(
                    "axes",
                    Tuple(&[Text, Text]),
                    "the coordinates to the right and up",
                ),
                optional(
                    "limits",
                    Numbers(2, "SI"),
                    "values where the colours begin and end",
                ),
                optional(
                    "scale",
                    Word(&["Auto", "Linear", "Log"]),
                    "how the colours go with the values",
                ),
                optional(
                    "mark",
                    List(&Text),
                    "what is marked where it stands: `least`, `most`",
                ),
                optional(
                    "beside",
                    Count(0, NO_END),
                    "another design of the job, in the same colours",
                ),
                optional(
                    "ratio",
                    Truth,
                    "whether in place of both the ratio of that design to the first is drawn",
                ),
                TITLE,
                LABELS,
            ],
        ),
    ],
};
