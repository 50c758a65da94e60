//! What the numbers of fields measure: by the units that the table of terms tells of them.
//!
//! A name means the same wherever it stands. Numbers by direction, whose names are those of the
//! directions, are told by the records that they stand in.

use std::collections::HashMap;
use std::sync::LazyLock;

use hyperstat_joints::Dof;

use super::dimension::Dimension;
use crate::terms::acting::{LOAD, MASS};
use crate::terms::bodies::BODY;
use crate::terms::joints::{JOINT, KINDS, MISFIT, PRELOAD};
use crate::terms::mechanism::MECHANISM;
use crate::terms::parts::{MATERIAL, PROFILE, STIFFNESSES};
use crate::terms::{Arguments, Field, Kinds, Record, Type, prebuilts};

/// The dimensions of fields of parts, joints, loads and prebuilt mechanisms.
static FIELDS: LazyLock<HashMap<&str, Dimension>> = LazyLock::new(|| {
    let mut found = Found::default();
    found.own(MECHANISM.fields);
    for record in [&MATERIAL, &JOINT, &LOAD, &MASS] {
        found.fields(record.fields);
    }
    for kinds in [&PROFILE, &BODY] {
        found.kinds(kinds);
    }
    let joints = KINDS.map(|kind| kind.fields).into_iter();
    joints
        .chain(prebuilts::ALL)
        .for_each(|fields| found.fields(fields));
    let known = found.0.into_iter();
    known.filter_map(|(name, of)| Some((name, of?))).collect()
});

/// What a number of a field measures; `None` of a name of which that is not known, or not one thing.
pub(crate) fn of(field: &str) -> Option<Dimension> {
    FIELDS.get(field).copied()
}

/// Maps of a file in which names stand that are no fields.
const NAMED: [&str; 6] = [
    "points",
    "materials",
    "sections",
    "bodies",
    "joints",
    "cases",
];

/// The SI unit of the value at a path, such as `sections.rod.diameter` or `joints.A.stiffness.u`; empty of
/// a pure number, and where it is not known.
pub fn unit_of(path: &str) -> String {
    let steps: Vec<&str> = path.split('.').collect();
    let mut found = None;
    for (k, step) in steps.iter().enumerate() {
        let is_name = k > 0 && NAMED.contains(&steps[k - 1]);
        if is_name || *step == "parameters" {
            continue;
        }
        let by_direction = || {
            let direction: Dof = step.parse().ok()?;
            (k > 0 && steps[k - 1].ends_with("stiffness")).then(|| stiffness()[direction.index()])
        };
        found = by_direction().or_else(|| of(step)).or(found);
    }
    found.map_or_else(String::new, Dimension::unit)
}

/// Stiffnesses along x y z and about u v w.
pub(crate) fn stiffness() -> [Dimension; 6] {
    static OWN: LazyLock<[Dimension; 6]> = LazyLock::new(|| by_direction(&STIFFNESSES));
    *OWN
}

/// Misfits, and poses x y z rx ry rz.
pub(crate) fn displacement() -> [Dimension; 6] {
    static OWN: LazyLock<[Dimension; 6]> = LazyLock::new(|| by_direction(&MISFIT));
    *OWN
}

/// Preloads.
pub(crate) fn wrench() -> [Dimension; 6] {
    static OWN: LazyLock<[Dimension; 6]> = LazyLock::new(|| by_direction(&PRELOAD));
    *OWN
}

/// What the fields of a record of six directions measure.
fn by_direction(record: &Record) -> [Dimension; 6] {
    std::array::from_fn(|k| {
        let own = record.fields.get(k).and_then(|field| dimension(field.of));
        own.unwrap_or(Dimension::NUMBER)
    })
}

/// What is found so far; `None` of a name that measures several things.
#[derive(Default)]
struct Found(HashMap<&'static str, Option<Dimension>>);

impl Found {
    /// The fields themselves.
    fn own(&mut self, fields: &[Field]) {
        for field in fields {
            let Some(own) = dimension(field.of) else {
                continue;
            };
            let known = self.0.entry(field.name).or_insert(Some(own));
            *known = known.filter(|known| *known == own);
        }
    }

    /// These and all that stands in them.
    fn fields(&mut self, fields: &[Field]) {
        self.own(fields);
        fields.iter().for_each(|field| self.inside(field.of));
    }

    fn kinds(&mut self, kinds: &Kinds) {
        for kind in kinds.kinds {
            match kind.arguments {
                Arguments::Fields(fields) => self.fields(fields),
                Arguments::Value(value) => self.inside(value),
            }
        }
    }

    fn inside(&mut self, of: Type) {
        match of {
            Type::Record(record) => self.fields(record.fields),
            Type::Kinds(kinds) => self.kinds(kinds),
            Type::List(inner) | Type::Map(inner) => self.inside(*inner),
            Type::Tuple(items) | Type::Any(items) => {
                items.iter().for_each(|item| self.inside(*item));
            }
            _ => {}
        }
    }
}

/// What the numbers of a value measure, whichever of its forms it has.
fn dimension(of: Type) -> Option<Dimension> {
    match of {
        Type::Number(unit) | Type::Numbers(_, unit) => Dimension::of_unit(unit),
        Type::Count(..) => Some(Dimension::NUMBER),
        Type::List(inner) | Type::Map(inner) => dimension(*inner),
        Type::Tuple(items) | Type::Any(items) => {
            let mut all = items.iter().map(|item| dimension(*item));
            let first = all.next()??;
            all.all(|own| own == Some(first)).then_some(first)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_measure_what_the_terms_say() {
        for (name, wanted) in [
            ("young", Some(Dimension::PRESSURE)),
            ("torsion_modulus", Some(Dimension::VOLUME)),
            ("points", Some(Dimension::LENGTH)),
            ("axes", Some(Dimension::NUMBER)),
            ("elements", Some(Dimension::NUMBER)),
            ("temperature", Some(Dimension::TEMPERATURE)),
            ("pitch", Some(Dimension::PITCH)),
            ("moment_per_length", Some(Dimension::FORCE)),
            ("from", Some(Dimension::STIFFNESS)),
            ("gravity", Some(Dimension::ACCELERATION)),
            ("inertia", Some(Dimension::INERTIA)),
            ("cylinder_length", Some(Dimension::LENGTH)),
            ("tilt", Some(Dimension::ANGLE)),
            // Of a slide and of a crank; by direction; numbers or words; other things.
            ("drive_stiffness", None),
            ("x", None),
            ("joint_stiffness", None),
            ("through", None),
            ("parameters", None),
        ] {
            assert_eq!(of(name), wanted, "{name}");
        }
        let [along, .., about] = stiffness();
        let expected = (Dimension::STIFFNESS, Dimension::ROTATIONAL_STIFFNESS);
        assert_eq!((along, about), expected);
        assert_eq!(displacement()[2..4], [Dimension::LENGTH, Dimension::ANGLE]);
        assert_eq!(wrench()[2..4], [Dimension::FORCE, Dimension::MOMENT]);
    }
}
