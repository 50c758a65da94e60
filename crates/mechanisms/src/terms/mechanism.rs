//! A mechanism file.

use super::Type::{
    Any, Anything, Count, Kinds as OneKind, List, Map, Number, Record as Of, Text, Tuple,
};
use super::acting::{LOAD, MASS};
use super::bodies::BODY;
use super::joints::JOINT;
use super::parts::{DIRECTION, MATERIAL, NODE, PROFILE, vector};
use super::{Field, Kinds, Record, Type, kind, needed, optional};

pub(crate) const MECHANISM: Record = Record {
    name: "mechanism",
    about: "A mechanism: bodies that meet at joints",
    one_of: &[],
    any_of: &["output", "mechanisms"],
    fields: &[
        needed("name", Text, "its name, for reports"),
        PARAMETERS,
        optional("materials", Map(&Of(&MATERIAL)), "materials by name"),
        optional("sections", Map(&OneKind(&PROFILE)), "sections by name"),
        optional("points", POINTS, "places by name"),
        optional(
            "bodies",
            BODIES,
            "bodies by name; `ground` is the fixed one",
        ),
        optional("joints", JOINTS, "joints by name"),
        optional("loads", List(&Of(&LOAD)), "loads of the base state"),
        optional(
            "cases",
            Map(&List(&Of(&LOAD))),
            "complete lists of loads by name, each solved by itself",
        ),
        optional("gravity", vector("m/s²"), "acceleration of gravity"),
        optional("masses", List(&Of(&MASS)), "masses on points of bodies"),
        optional(
            "output",
            NODE,
            "body and point whose stiffness is reported, unless a mounted mechanism has it",
        ),
        optional(
            "groups",
            Map(&Of(&GROUP)),
            "parts that are written once, by name",
        ),
        optional(
            "copies",
            Map(&COPIES),
            "where copies of groups stand, by the group's name",
        ),
        optional(
            "mechanisms",
            Map(&Of(&MOUNT)),
            "mechanisms of other files that are parts of it, by name",
        ),
        optional(
            "include",
            List(&Text),
            "files of the same folder with materials, sections and groups",
        ),
    ],
};

/// Numbers with names.
pub(crate) const PARAMETERS: Field = optional(
    "parameters",
    Map(&Number("SI")),
    "numbers by name, for expressions",
);
const POINTS: Type = Map(&vector("m"));
const BODIES: Type = Map(&OneKind(&BODY));
const JOINTS: Type = Map(&Of(&JOINT));

/// A mechanism of another file that is a part of this one.
pub(crate) const MOUNT: Record = Record::new(
    "mount",
    "A mechanism of another file, a part of this one",
    &[
        needed("file", Text, "the file, relative to this one"),
        optional(
            "at",
            Any(&[
                vector("m"),
                Tuple(&[
                    Number("m"),
                    Number("m"),
                    Number("m"),
                    Number("rad"),
                    Number("rad"),
                    Number("rad"),
                ]),
            ]),
            "where its origin stands, and how it is turned (a rotation vector)",
        ),
        needed("on", NODE, "body and point to which its ground is welded"),
        optional(
            "output",
            NODE,
            "body and point of it that are the output of all",
        ),
    ],
);

/// A part of a mechanism that is written once and copied.
pub(crate) const GROUP: Record = Record::new(
    "group",
    "A part of a mechanism that is written once",
    &[
        optional("points", POINTS, "places by name"),
        optional("bodies", BODIES, "bodies by name"),
        optional("joints", JOINTS, "joints by name"),
        optional("loads", List(&Of(&LOAD)), "loads on each copy"),
        optional("masses", List(&Of(&MASS)), "masses on each copy"),
    ],
);

/// Where copies stand: one way of placing them, or several one after the other.
const PLACES: Type = Any(&[OneKind(&PLACING), List(&OneKind(&PLACING))]);
const COPIES: Type = Any(&[OneKind(&PLACING), List(&OneKind(&PLACING)), Of(&COPIED)]);

/// Copies of a group, with what is said of single ones.
pub(crate) const COPIED: Record = Record::new(
    "copies",
    "Copies of a group",
    &[
        needed("places", PLACES, "where they stand"),
        optional("names", List(&Text), "what is put behind the names of each"),
        optional(
            "overrides",
            Map(&Map(&Anything)),
            "other values of single copies, by path in the group",
        ),
    ],
);

const THROUGH: Field = optional(
    "through",
    vector("m"),
    "a point of the axis or plane, else the origin",
);

/// Ways of placing copies.
pub(crate) const PLACING: Kinds = Kinds {
    name: "placing",
    kinds: &[
        kind(
            "Turned",
            "turned about an axis, all round or step by step",
            &[
                needed("axis", DIRECTION, "the axis"),
                THROUGH,
                optional("count", Count(1, MOST_COPIES), "number of copies"),
                optional("step", Number("rad"), "from one to the next"),
                optional("angles", List(&Number("rad")), "of each"),
            ],
        ),
        kind(
            "Moved",
            "moved step by step, or each by its own vector",
            &[
                needed(
                    "by",
                    Any(&[vector("m"), List(&vector("m"))]),
                    "the step, or each vector",
                ),
                optional("count", Count(1, MOST_COPIES), "number of copies"),
            ],
        ),
        kind(
            "Mirrored",
            "as it is written, and its mirror image",
            &[needed("normal", DIRECTION, "of the plane"), THROUGH],
        ),
    ],
};

/// Most copies of a group.
pub(crate) const MOST_COPIES: u64 = 10_000;

/// A file that is included.
pub(crate) const INCLUDED: Record = Record::new(
    "included",
    "Tables for mechanisms that include the file",
    &[
        optional("include", List(&Text), "files whose tables are taken, too"),
        PARAMETERS,
        optional("materials", Map(&Of(&MATERIAL)), "materials by name"),
        optional("sections", Map(&OneKind(&PROFILE)), "sections by name"),
        optional(
            "groups",
            Map(&Of(&GROUP)),
            "parts that are written once, by name",
        ),
    ],
);
