//! Bodies and nodes of a model, by the names that a file gives them.

use hyperstat_model::{BodyId, Model, NodeId};

use crate::error::LoadError;
use crate::terms::bodies::GROUND;
use crate::text::fragment::Fragment;
use crate::text::names;

/// The body of a name in a file; not the ground.
pub(crate) fn body(model: &Model, name: Fragment<'_>) -> Result<BodyId, LoadError> {
    named(model, name, None)
}

/// The body of a name in a file, where the ground, which is none, could stand too.
pub(crate) fn body_or_ground(model: &Model, name: Fragment<'_>) -> Result<BodyId, LoadError> {
    named(model, name, Some(GROUND))
}

fn named(model: &Model, name: Fragment<'_>, other: Option<&str>) -> Result<BodyId, LoadError> {
    let text = name.string()?;
    model.body(&text).ok_or_else(|| {
        let error = name.error(format!("unknown body `{text}`")).unreadable();
        if other.is_some() && FIXED.contains(&text.to_lowercase().as_str()) {
            return error.with_help(format!("the fixed body is `{GROUND}`"));
        }
        let known = model.bodies().iter().map(|body| body.name.as_str());
        let other = other.filter(|_| !model.bodies().is_empty());
        error.with_help(names::help(&text, "bodies", known.chain(other)))
    })
}

/// What other programs call the ground.
const FIXED: [&str; 6] = [GROUND, "gnd", "world", "earth", "base", "fixed"];

/// The node of `body` at the point `name`, which stands at `at` in the file.
pub(crate) fn node(
    model: &Model,
    body: BodyId,
    at: Fragment<'_>,
    name: &str,
) -> Result<NodeId, LoadError> {
    model.node_of(body, name).ok_or_else(|| {
        let body = &model.bodies()[body.0];
        let point = |node: &NodeId| model.nodes()[node.0].point.as_str();
        let points: Vec<&str> = body.nodes.iter().map(point).collect();
        at.error(format!(
            "body `{}` does not run through point `{name}`",
            body.name
        ))
        .with_help(names::help(
            name,
            &format!("points of `{}`", body.name),
            points,
        ))
    })
}

/// The node that a pair `("body", "point")` names; `what` says what stands there.
pub(crate) fn on(model: &Model, pair: Fragment<'_>, what: &str) -> Result<NodeId, LoadError> {
    let [body, point] = pair.array("a body and a point of it, `(\"body\", \"point\")`")?;
    let name = body.string()?;
    if name.eq_ignore_ascii_case(GROUND) && model.body(&name).is_none() {
        return Err(body
            .error(format!(
                "{what} cannot be on the ground, which does not move"
            ))
            .with_help("name a body of the file"));
    }
    let body = self::body(model, body)?;
    node(model, body, point, &point.string()?)
}
