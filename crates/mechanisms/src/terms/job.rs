//! A batch file.

use super::Type::{
    Any, Anything, Count, Kinds as OneKind, List, Map, Mechanism, Number, Numbers, Record as Of,
    Text, Truth, Tuple, Word,
};
use super::acting::{LOAD, MASS};
use super::bodies::TABLE;
use super::figures::FIGURE;
use super::joints::{MISFIT, PRELOAD};
use super::mechanism::PARAMETERS;
use super::parts::{NODE, vector};
use super::{Field, Kinds, NO_END, Record, Type, kind, needed, of_value, optional};

pub(crate) const BATCH: Record = Record::new(
    "batch",
    "A batch of jobs",
    &[needed("jobs", List(&Of(&JOB)), "at least one"), PARAMETERS],
);

pub(crate) const JOB: Record = Record::new(
    "job",
    "A mechanism in one or many poses",
    &[
        needed(
            "name",
            Text,
            "names its files: letters, digits, `_`, `-`, `.`",
        ),
        needed("mechanism", Mechanism, "a file, or a prebuilt mechanism"),
        PARAMETERS,
        optional(
            "poses",
            OneKind(&POSES),
            "poses of the output, or values of drives",
        ),
        optional("loads", List(&Of(&LOAD)), "in place of the file's"),
        optional("cases", Map(&List(&Of(&LOAD))), "in place of the file's"),
        optional("gravity", vector("m/s²"), "in place of the file's"),
        optional("masses", List(&Of(&MASS)), "in place of the file's"),
        optional(
            "misfits",
            Map(&Of(&MISFIT)),
            "misfits by the joint's name, in place of the file's",
        ),
        optional(
            "preloads",
            Map(&Of(&PRELOAD)),
            "preloads by the joint's name, in place of the file's",
        ),
        optional(
            "output",
            NODE,
            "body and point, in place of the mechanism's own",
        ),
        optional(
            "tool",
            vector("m"),
            "a point fixed in the output's body, from the output in home axes: the new output",
        ),
        optional("figures", List(&OneKind(&FIGURE)), "figures to draw"),
        optional(
            "vary",
            Map(&Any(&[List(&Anything), OneKind(&RANGE)])),
            "values by path: many designs",
        ),
        optional("zip", Truth, "whether varied values run side by side"),
        optional(
            "modes",
            Any(&[FREQUENCIES, Of(&MODES)]),
            "natural frequencies at every pose",
        ),
        optional(
            "columns",
            List(&OneKind(&COLUMN)),
            "more columns of the table",
        ),
    ],
);

const FREQUENCIES: Type = Count(1, 1000);

/// An axis of a grid.
const AXIS: Type = Tuple(&[Number("m, rad"), Number("m, rad"), Count(1, NO_END)]);
const GRID: &[Field] = &[
    optional("x", AXIS, "first, last, count"),
    optional("y", AXIS, "first, last, count"),
    optional("z", AXIS, "first, last, count"),
    optional("rx", AXIS, "first, last, count"),
    optional("ry", AXIS, "first, last, count"),
    optional("rz", AXIS, "first, last, count"),
];

/// The poses of a job.
pub(crate) const POSES: Kinds = Kinds {
    name: "poses",
    kinds: &[
        of_value("Csv", "a file with columns x,y,z[,rx,ry,rz]", Text),
        of_value(
            "List",
            "poses of 3 or 6 numbers",
            List(&Any(&[Numbers(3, "m"), Numbers(6, "m, rad")])),
        ),
        kind("Grid", "all combinations of evenly spaced values", GRID),
        of_value(
            "Drives",
            "a file with columns joint.direction",
            OneKind(&TABLE),
        ),
    ],
};

/// Columns on request.
pub(crate) const COLUMN: Kinds = Kinds {
    name: "columns",
    kinds: &[
        kind("Drives", "positions of the drives", &[]),
        kind("DriveForces", "forces and moments of the drives", &[]),
        of_value("Wrench", "the wrench in a joint, by its name", Text),
        kind("Stress", "the largest stress, and where", &[]),
        kind("Utilisation", "the largest utilisation, and where", &[]),
        kind("Mass", "mass of what moves", &[]),
        kind("Measures", "every measure", &[]),
        kind("Frequencies", "natural frequencies", &[COUNT]),
        kind("Budget", "shares in the deflection", &[]),
    ],
};
const COUNT: Field = optional("count", FREQUENCIES, "how many");

/// Evenly spaced values.
pub(crate) const RANGE: Kinds = Kinds {
    name: "range",
    kinds: &[of_value(
        "Range",
        "first, last, count",
        Tuple(&[Number("SI"), Number("SI"), Count(1, NO_END)]),
    )],
};

pub(crate) const MODES: Record = Record::new(
    "modes",
    "Natural frequencies",
    &[
        needed("count", FREQUENCIES, "number of frequencies"),
        optional(
            "mass",
            Word(&["Exact", "Consistent", "Lumped"]),
            "masses of beams",
        ),
        optional("shape", Word(&["Cubic", "Exact"]), "of consistent masses"),
        optional(
            "rotary_inertia",
            Truth,
            "whether sections have inertia in bending",
        ),
    ],
);
