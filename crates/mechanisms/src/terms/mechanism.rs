//! A mechanism file.

use super::Type::{Kinds as OneKind, List, Map, Record as Of, Text};
use super::acting::{LOAD, MASS};
use super::bodies::BODY;
use super::joints::JOINT;
use super::parts::{MATERIAL, NODE, PROFILE, vector};
use super::{Record, needed, optional};

pub(crate) const MECHANISM: Record = Record::new(
    "mechanism",
    "A mechanism: bodies that meet at joints",
    &[
        needed("name", Text, "its name, for reports"),
        optional("materials", Map(&Of(&MATERIAL)), "materials by name"),
        optional("sections", Map(&OneKind(&PROFILE)), "sections by name"),
        needed("points", Map(&vector("m")), "places by name"),
        needed(
            "bodies",
            Map(&OneKind(&BODY)),
            "bodies by name; `ground` is the fixed one",
        ),
        needed("joints", Map(&Of(&JOINT)), "joints by name"),
        optional("loads", List(&Of(&LOAD)), "loads of the base state"),
        optional(
            "cases",
            Map(&List(&Of(&LOAD))),
            "complete lists of loads by name, each solved by itself",
        ),
        optional("gravity", vector("m/s²"), "acceleration of gravity"),
        optional("masses", List(&Of(&MASS)), "masses on points of bodies"),
        needed("output", NODE, "body and point whose stiffness is reported"),
    ],
);
