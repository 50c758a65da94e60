//! Which values of a model stand where in its text, as `vary` takes them.
//!
//! Of a mechanism file it is known from reading it; of a prebuilt mechanism it is found by changing
//! one number of the text at a time.

use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::sync::Arc;

use hyperstat_joints::Dof;
use hyperstat_model::{JointId, JointStiffness, Model, SegmentId, ValuePlace};

use crate::text::fragment::Fragment;
use crate::text::paths;
use crate::text::source::Place;

/// Part by which a number is made larger: any that does not vanish does, since values are looked
/// for that are the number itself, before and after.
pub(crate) const PART: f64 = 1.0 / 1024.0;

/// What a segment of a mechanism file is given by: names of the tables' entries.
#[derive(Debug, Clone)]
pub(crate) struct Given {
    pub(crate) section: Arc<str>,
    pub(crate) material: Arc<str>,
}

/// Parts of a text, with what stands in for them.
pub(crate) type Replaced = [(Range<usize>, Place)];

/// Names values of a file's model by their paths in `root`, its text. `given` says what its
/// segments are given by, `masses` whether its masses are the file's. Stiffnesses that several
/// joints have alike are left without names: they are one parameter.
pub(crate) fn of_file(
    root: Fragment<'_>,
    replaced: &Replaced,
    given: &[Given],
    masses: bool,
    model: &mut Model,
) {
    let numbers = numbers(root, replaced);
    let paths: HashSet<String> = numbers.into_iter().map(|number| number.path).collect();
    let alike = |model: &Model, joint: JointId| {
        let joint = &model.joints()[joint.0];
        match &joint.stiffness {
            JointStiffness::Directions(given) => Some((
                joint.joint.kind().to_owned(),
                given.map(|k| k.map(f64::to_bits)),
            )),
            JointStiffness::Matrix(_) => None,
        }
    };
    let mut counts = HashMap::new();
    for joint in (0..model.joints().len()).map(JointId) {
        *counts.entry(alike(model, joint)).or_insert(0) += 1;
    }
    let values = model.values().into_iter().map(|(place, _)| place);
    let masses = (0..model.masses().len()).filter(|_| masses);
    let places = values.chain(masses.map(|mass| ValuePlace::Mass { mass }));
    for place in places.collect::<Vec<_>>() {
        let path = match place {
            ValuePlace::Dimension {
                segment: SegmentId(segment),
                second,
                dimension,
            } => {
                let end = match (&model.segments()[segment].taper, second) {
                    (None, _) => "",
                    (Some(_), false) => "from.",
                    (Some(_), true) => "to.",
                };
                let own = given.get(segment);
                own.map(|own| format!("sections.{}.{end}{dimension}", own.section))
            }
            ValuePlace::Constant {
                segment: SegmentId(segment),
                constant,
            } => {
                let own = given.get(segment);
                own.map(|own| format!("materials.{}.{constant}", own.material))
            }
            ValuePlace::Stiffness { joint, direction } => {
                let name = &model.joints()[joint.0].name;
                let single = counts.get(&alike(model, joint)) == Some(&1);
                single.then(|| format!("joints.{name}.stiffness.{}", letter(direction)))
            }
            ValuePlace::Mass { mass } => Some(format!("masses.{mass}.mass")),
        };
        if let Some(path) = path.filter(|path| paths.contains(path)) {
            model.name_value(place, path);
        }
    }
}

/// The letter of a direction in files.
fn letter(direction: Dof) -> &'static str {
    ["x", "y", "z", "u", "v", "w"][direction.index()]
}

/// A number that `vary` takes.
pub(crate) struct Number<'a> {
    pub(crate) path: String,
    /// As it is written in the text.
    pub(crate) written: Fragment<'a>,
    /// Its value, or that of what stands in for it.
    pub(crate) value: f64,
}

/// The numbers of a text that `vary` takes, beside what it has taken already.
pub(crate) fn numbers<'a>(root: Fragment<'a>, replaced: &Replaced) -> Vec<Number<'a>> {
    let number = |(path, written): (String, Fragment<'a>)| {
        let span = written.span();
        let instead = replaced.iter().find(|(at, _)| *at == span);
        let overlaps = |at: &Range<usize>| at.start < span.end && span.start < at.end;
        if instead.is_none() && replaced.iter().any(|(at, _)| overlaps(at)) {
            return None; // a part of something that varies as a whole
        }
        let value = instead.map_or(written, |(_, place)| Fragment::at(place));
        let value = value.number().ok()?;
        Some(Number {
            path,
            written,
            value,
        })
    };
    paths::numbers(root)
        .into_iter()
        .filter_map(number)
        .collect()
}
