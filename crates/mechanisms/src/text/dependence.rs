//! What in a mechanism depends on its parameters, and how much.

use super::expression::{Dual, Operand};
use super::scope::{Scope, parameters};
use super::tree::Node;

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
