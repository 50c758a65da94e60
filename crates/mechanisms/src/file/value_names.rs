//! Which values of a model stand where in its text, as `vary` takes them.
//!
//! Of a mechanism file it is known from reading it; a prebuilt mechanism says it of itself
//! ([`Prebuilt::origins`](crate::prebuilt::Prebuilt::origins)).

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use hyperstat_joints::Dof;
use hyperstat_model::{JointId, JointStiffness, Model, SegmentId, ValuePlace};

use super::groups::Copies;
use crate::text::paths;
use crate::text::tree::{Node, Number, Steps};

/// What a segment of a mechanism file is given by: names of the tables' entries.
#[derive(Debug, Clone)]
pub(crate) struct Given {
    pub(crate) section: Arc<str>,
    pub(crate) material: Arc<str>,
}

/// Names values of a file's model by their paths in `root`, in which some values are `varied`. `given` says what its
/// segments are given by, `copies` what is copied, `masses` whether its masses are the file's. Stiffnesses that several
/// joints have alike are left without names: they are one parameter.
pub(crate) fn of_file(
    root: &Node,
    varied: &[Steps],
    (given, copies): (&[Given], &Copies),
    masses: bool,
    model: &mut Model,
) {
    let numbers = numbers(root, varied);
    let paths: HashSet<String> = numbers
        .into_iter()
        .map(|number| paths::as_mounted(number.path))
        .collect();
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
    let path = |model: &Model, joint: JointId, direction: Dof| {
        copies.stiffness(&model.joints()[joint.0].name, letter(direction))
    };
    let directions = |joint| Dof::ALL.map(|direction| (joint, direction));
    let all = (0..model.joints().len()).map(JointId).flat_map(directions);
    let mut written = HashMap::<_, HashSet<Option<String>>>::new();
    for (joint, direction) in all.clone() {
        let key = (alike(model, joint), direction);
        let path = path(model, joint, direction);
        written.entry(key).or_default().insert(path);
    }
    let is_single = |model: &Model, joint, direction| {
        let all = written.get(&(alike(model, joint), direction));
        all.is_some_and(|all| all.len() == 1)
    };
    // A name is that of all values at its path, or of none.
    let shared: HashSet<String> = (all)
        .filter(|(joint, direction)| !is_single(model, *joint, *direction))
        .filter_map(|(joint, direction)| path(model, joint, direction))
        .collect();
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
                let path = path(model, joint, direction);
                path.filter(|path| !shared.contains(path))
            }
            ValuePlace::Mass { mass } => copies.mass(mass),
        };
        if let Some(path) = path.filter(|path| paths.contains(path)) {
            model.name_value(place, path);
        }
    }
}

/// The path of one stiffness of joints, of which these are the paths of each one's, which copies of a joint share;
/// `None` where they are not several, and of a name that no group of a path can hold.
pub(crate) fn together(
    joints: impl Iterator<Item = Option<String>>,
    direction: Dof,
) -> Option<String> {
    let end = format!(".stiffness.{}", letter(direction));
    let mut paths: Vec<String> = Vec::new();
    for path in joints {
        let path = path?.strip_suffix(&end)?.to_owned();
        if path.contains(['{', '|', '}']) || path.trim() != path {
            return None;
        }
        if !paths.contains(&path) {
            paths.push(path);
        }
    }
    if paths.len() < 2 {
        return None;
    }
    let own = |prefix: &str| paths.iter().all(|path| path.starts_with(prefix));
    // Names may hold dots: what is before them is the same for all, or is named with them.
    let before = if own("joints.") { "joints." } else { "" };
    let names: Vec<&str> = paths.iter().map(|path| &path[before.len()..]).collect();
    let names = names.join("|");
    Some(format!("{before}{{{names}}}{end}"))
}

/// The letter of a direction in files.
pub(crate) fn letter(direction: Dof) -> &'static str {
    ["x", "y", "z", "u", "v", "w"][direction.index()]
}

/// The numbers of a tree that `vary` takes, beside what is `varied` already: of that the numbers, but
/// nothing inside of what varies as a whole.
pub(crate) fn numbers(root: &Node, varied: &[Steps]) -> Vec<Number> {
    let inside = |number: &Number| {
        let longer = |steps: &&Steps| number.steps.len() > steps.len();
        let mut around = varied.iter().filter(longer);
        around.any(|steps| number.steps.starts_with(steps))
    };
    let mut numbers = root.numbers();
    numbers.retain(|number| !inside(number));
    numbers
}
