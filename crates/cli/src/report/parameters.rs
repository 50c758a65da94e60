//! What a parameter of a mechanism is called.

use hyperstat_assembly::{BodyId, JointId, Model, Parameter};
use hyperstat_joints::Dof;

use crate::case::Case;

/// Names that are listed one by one.
const FEW: usize = 3;

/// The name of a parameter: the one that its values have; its path in the mechanism file, as `vary`
/// takes it, where the mechanism is one of a file with a table that holds it; else the bodies or
/// joints that have it.
pub(super) fn name(case: &Case, named: Option<&str>, parameter: &Parameter) -> String {
    let model = &case.model;
    if let Some(name) = named {
        return name.into();
    }
    match parameter {
        Parameter::Section {
            section,
            second,
            dimension,
            bodies,
        } => {
            let named = case.mechanism().into_iter().flat_map(|m| m.sections());
            let names: Vec<_> = named
                .filter_map(|(name, ends)| {
                    let path = format!("sections.{name}");
                    let tapers = ends[0] != ends[1];
                    match (tapers, second) {
                        (false, false) if ends[0] == *section => Some(path),
                        (true, false) if ends[0] == *section => Some(path + ".from"),
                        (true, true) if ends[1] == *section => Some(path + ".to"),
                        _ => None,
                    }
                })
                .collect();
            let end = if *second { "second end of " } else { "" };
            of(names, dimension, || {
                format!("{end}{}", body_names(model, bodies))
            })
        }
        Parameter::Material {
            material,
            constant,
            bodies,
        } => {
            let named = case.mechanism().into_iter().flat_map(|m| m.materials());
            let names = named
                .filter(|(_, own)| own.constants() == material.constants())
                .map(|(name, _)| format!("materials.{name}"))
                .collect();
            of(names, constant, || body_names(model, bodies))
        }
        Parameter::Joint { direction, joints } => {
            let of = joint_names(model, joints);
            match (direction.map(letter), joints.as_slice()) {
                (Some(direction), [one]) if case.mechanism().is_some() => {
                    let joint = &model.joints()[one.0].name;
                    format!("joints.{joint}.stiffness.{direction}")
                }
                (Some(direction), _) => format!("stiffness {direction} of {of}"),
                // A full matrix, or the compliance of the joint's own kind.
                (None, _) => format!("stiffness of {of}"),
            }
        }
        Parameter::Mass { mass, inertia } => {
            let node = || model.node_name(model.masses()[*mass].node);
            match (case.is_file(), inertia) {
                (true, false) => format!("masses.{mass}.mass"),
                (_, false) => format!("mass on {}", node()),
                (_, true) => format!("inertia on {}", node()),
            }
        }
    }
}

/// `path.what` where the tables have one or more paths, else `what of …`.
fn of(paths: Vec<String>, what: &str, owners: impl Fn() -> String) -> String {
    match paths.as_slice() {
        [] => format!("{what} of {}", owners()),
        paths => {
            let paths: Vec<_> = paths.iter().map(|path| format!("{path}.{what}")).collect();
            paths.join(" = ")
        }
    }
}

fn body_names(model: &Model, bodies: &[BodyId]) -> String {
    let names: Vec<_> = bodies
        .iter()
        .map(|b| model.bodies()[b.0].name.as_str())
        .collect();
    short(&names)
}

fn joint_names(model: &Model, joints: &[JointId]) -> String {
    let names: Vec<_> = joints
        .iter()
        .map(|j| model.joints()[j.0].name.as_str())
        .collect();
    short(&names)
}

/// A few names, or of many what they are without the numbers at their ends: `roda*, rodb* (6)`.
fn short(names: &[&str]) -> String {
    if names.len() <= FEW {
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
fn letter(dof: Dof) -> &'static str {
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
        assert_eq!(short(&["arm1", "arm2", "arm3"]), "arm1, arm2, arm3");
        let rods = ["roda1", "rodb1", "roda2", "rodb2", "bar"];
        assert_eq!(short(&rods), "roda*, rodb*, bar (5)");
    }
}
