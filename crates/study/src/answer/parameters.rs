//! What the parameters of a mechanism are called.

use std::collections::HashMap;

use hyperstat_assembly::{BodyId, JointId, Model, Parameter};
use hyperstat_joints::Dof;

use crate::study::Study;

/// Names that are listed one by one.
const FEW: usize = 3;

/// Names of a model's parameters, each once: the name that its values have, which is the path that
/// `vary` takes; else in words, by the bodies or joints that have it.
pub(super) fn names<'a>(
    model: &Model,
    parameters: impl Iterator<Item = (Option<&'a str>, &'a Parameter)>,
) -> Vec<String> {
    let parameters: Vec<_> = parameters.collect();
    let name = |(named, parameter): &(Option<&str>, &Parameter), few: usize| match named {
        Some(name) => (*name).to_owned(),
        None => in_words(model, parameter, few),
    };
    let mut names: Vec<String> = parameters.iter().map(|p| name(p, FEW)).collect();
    // Shortened lists may be the same; equal parts of one body are numbered.
    let counts = counted(&names);
    for (own, parameter) in names.iter_mut().zip(&parameters) {
        if counts[own.as_str()] > 1 {
            *own = name(parameter, usize::MAX);
        }
    }
    let counts = counted(&names);
    let mut told: HashMap<String, usize> = HashMap::new();
    for own in &mut names {
        let count = counts[own.as_str()];
        if count > 1 {
            let place = told.entry(own.clone()).or_insert(0);
            *place += 1;
            *own += &format!(" ({place} of {count})");
        }
    }
    names
}

/// The path that `vary` takes for a stiffness that is told in words; none of anything else.
pub(super) fn path(study: &Study, name: Option<&str>, parameter: &Parameter) -> Option<String> {
    match (name, parameter) {
        (
            None,
            Parameter::Joint {
                direction: Some(direction),
                joints,
            },
        ) => study.file()?.stiffness_path(joints, *direction),
        _ => None,
    }
}

fn counted(names: &[String]) -> HashMap<String, usize> {
    let mut counts = HashMap::new();
    for name in names {
        *counts.entry(name.clone()).or_insert(0) += 1;
    }
    counts
}

/// A parameter in words; more than `few` names are shortened.
fn in_words(model: &Model, parameter: &Parameter, few: usize) -> String {
    match parameter {
        Parameter::Section {
            section,
            second,
            dimension,
            bodies,
        } => {
            let segments = bodies.iter().flat_map(|b| &model.bodies()[b.0].segments);
            let mut segments = segments.map(|s| &model.segments()[s.0]);
            let end = match second {
                true => "second end of ",
                false if segments.any(|s| s.section == *section && s.taper.is_some()) => {
                    "first end of "
                }
                false => "",
            };
            format!("{dimension} of {end}{}", body_names(model, bodies, few))
        }
        Parameter::Material {
            constant, bodies, ..
        } => format!("{constant} of {}", body_names(model, bodies, few)),
        Parameter::Joint { direction, joints } => {
            let joints = joint_names(model, joints, few);
            match direction {
                Some(direction) => format!("stiffness {} of {joints}", letter(*direction)),
                None => format!("stiffness of {joints}"),
            }
        }
        Parameter::Mass { mass, inertia } => {
            let what = if *inertia { "inertia" } else { "mass" };
            let node = model.masses()[*mass].node;
            format!("{what} on {}", model.node_name(node))
        }
    }
}

fn body_names(model: &Model, bodies: &[BodyId], few: usize) -> String {
    let names: Vec<_> = bodies
        .iter()
        .map(|b| model.bodies()[b.0].name.as_str())
        .collect();
    short(&names, few)
}

fn joint_names(model: &Model, joints: &[JointId], few: usize) -> String {
    let names: Vec<_> = joints
        .iter()
        .map(|j| model.joints()[j.0].name.as_str())
        .collect();
    short(&names, few)
}

/// No more than `few` names, or what they are without the numbers at their ends:
/// `roda*, rodb* (6)`.
fn short(names: &[&str], few: usize) -> String {
    if names.len() <= few {
        return names.join(", ");
    }
    let mut stems: Vec<String> = Vec::new();
    for name in names {
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
        let stem = if stem.len() < name.len() {
            format!("{stem}*")
        } else {
            (*name).into()
        };
        if !stems.contains(&stem) {
            stems.push(stem);
        }
    }
    let left = stems.len().saturating_sub(2 * FEW + 2);
    let more = if left > 0 { ", …" } else { "" };
    stems.truncate(2 * FEW + 2);
    format!("{}{more} ({})", stems.join(", "), names.len())
}

/// The letter of a direction, as in files.
pub(super) fn letter(dof: Dof) -> &'static str {
    match dof {
        Dof::X => "x",
        Dof::Y => "y",
        Dof::Z => "z",
        Dof::U => "u",
        Dof::V => "v",
        Dof::W => "w",
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn many_names_are_told_by_their_stems() {
        assert_eq!(short(&["arm1", "arm2", "arm3"], 3), "arm1, arm2, arm3");
        let rods = ["roda1", "rodb1", "roda2", "rodb2", "bar"];
        assert_eq!(short(&rods, 3), "roda*, rodb*, bar (5)");
    }
}
