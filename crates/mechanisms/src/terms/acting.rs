//! What acts on a mechanism.

use super::Type::{Any, Number, Numbers, Text, Tuple, Word};
use super::parts::{NODE, vector};
use super::{Record, needed, optional};

/// Fields of a load along a beam.
pub(crate) const ALONG: [&str; 4] = ["per_length", "moment_per_length", "from", "to"];

pub(crate) const LOAD: Record = Record::new(
    "load",
    "A load on a point of a body, or along a beam",
    &[
        needed(
            "on",
            Any(&[Text, NODE, Tuple(&[Text, Text, Text])]),
            "body and point; of a load along beams the body, or body and two neighbouring points",
        ),
        optional("force", vector("N"), "force on the point"),
        optional("moment", vector("N·m"), "moment on the point"),
        optional("per_length", vector("N/m"), "force per length of the beam"),
        optional(
            "moment_per_length",
            vector("N·m/m"),
            "moment per length of the beam",
        ),
        optional("from", vector("N/m"), "force per length at the first point"),
        optional("to", vector("N/m"), "force per length at the second point"),
        optional(
            "frame",
            Word(&["Global", "Body", "Output"]),
            "the body with which it turns",
        ),
    ],
);

pub(crate) const MASS: Record = Record::new(
    "mass",
    "A rigid mass on a point of a body, its centre",
    &[
        needed("on", NODE, "body and point"),
        needed("mass", Number("kg"), "how much"),
        optional(
            "inertia",
            Any(&[Numbers(3, "kg·m²"), Numbers(6, "kg·m²")]),
            "moments of inertia, or Jxx Jyy Jzz Jxy Jxz Jyz",
        ),
    ],
);
