//! What in a mechanism depends on its parameters, and how much.

use super::expression::{Dual, Operand};
use super::paths;
use super::scope::{PARAMETERS, Scope, parameters};
use super::tree::{Content, Node};

/// A parameter of a mechanism, and the values that its expressions give.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Dependence {
    /// Its path, as `vary` takes it: `parameters.R`.
    pub path: String,
    /// Its value, SI.
    pub value: f64,
    /// The numbers that change with it, by their paths as `vary` names them, each with its derivative by
    /// the parameter, in SI units; not finite where there is none. What a job has of its own has the path
    /// that it would have in the file.
    pub slopes: Vec<(String, f64)>,
}

/// All parameters of a mechanism that are numbers; `beside` it are values of a job by their fields.
pub(crate) fn dependences(root: &Node, beside: &[(&str, &Node)]) -> Vec<Dependence> {
    let of = |name: &str| {
        let scope = Scope::varied(root, name).ok()?;
        let Ok(Operand::Number(Dual { value, .. })) = scope.parameter(name) else {
            return None;
        };
        let mut slopes = Vec::new();
        scope.each_slope(root, "", &mut slopes);
        for (field, node) in beside {
            scope.each_slope(node, field, &mut slopes);
        }
        Some(Dependence {
            path: format!("parameters.{name}"),
            value,
            slopes,
        })
    };
    parameters(root).filter_map(of).collect()
}

/// Parts of a mechanism as it is written that say nothing of where it stands and how long it is.
const ELSEWHERE: [&str; 18] = [
    PARAMETERS,
    "materials",
    "material",
    "sections",
    "section",
    "stiffness",
    "compliance",
    "joint_compliance",
    "loads",
    "cases",
    "gravity",
    "masses",
    "mass",
    "misfits",
    "preloads",
    "temperature",
    "elements",
    "include",
];

/// The numbers of a mechanism that say where its parts stand and how long they are, such as `arm_length`,
/// `points.A.0` and `joints.A.kind.axis.2`, by their paths as `vary` names them, SI; those that stand there as
/// numbers, not as expressions.
pub(crate) fn placing(root: &Node) -> Vec<(String, f64)> {
    let mut found = Vec::new();
    each_number(root, "", &mut found);
    found
}

fn each_number(node: &Node, path: &str, found: &mut Vec<(String, f64)>) {
    if let Content::Number(value) | Content::Measured(value, _) = node.content {
        found.push((paths::as_mounted(path.into()), value));
        return;
    }
    for (name, part) in node.parts() {
        // A copy's own values have paths for names.
        let mut steps = name.split('.');
        if steps.any(|step| ELSEWHERE.contains(&step) || step.ends_with("_stiffness")) {
            continue;
        }
        let path = match path {
            "" => name,
            path => format!("{path}.{name}"),
        };
        each_number(part, &path, found);
    }
}
