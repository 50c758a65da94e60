//! Joints of a mechanism file.

use std::str::FromStr;

use hyperstat_joints::{Dof, DofSet, Joint, frame_from_axes, frame_from_axis};
use hyperstat_model::{Connection, JointId, JointStiffness, Model, ModelError, NodeId};
use nalgebra::{Matrix6, Rotation3, Vector6};

use super::registry::{Orientation, ParsedJoint, Registry};
use super::through::check_name;
use crate::error::LoadError;
use crate::file::nodes;
use crate::terms::bodies::GROUND;
use crate::terms::joints::JOINT;
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;
use crate::text::fragment::{Entry, Fragment};
use crate::text::{names, quantities};

/// Entries of a stiffness matrix that differ by less count as equal, relative to the square root
/// of the two diagonal entries in their row and column.
const SYMMETRY: f64 = 1e-9;

/// Numbers by direction: what they are, in words, and what each measures.
pub(crate) type Directed = (&'static str, fn() -> [Dimension; 6]);

pub(crate) const MISFIT: Directed = ("the misfit", quantities::displacement);
pub(crate) const PRELOAD: Directed = ("the preload", quantities::wrench);

/// Adds the joint of `entry` to the model; `at` finds a point's name in the file.
pub(crate) fn read(
    entry: &Entry<'_>,
    at: impl Fn(Fragment<'_>) -> Result<String, LoadError>,
    registry: &Registry,
    model: &mut Model,
) -> Result<JointId, LoadError> {
    check_name(entry, "joint")?;
    let owner = format!("joint `{}`", entry.name);
    let fields = Fields::read(entry.value, owner, &JOINT.names())?;

    let point = fields.required("at")?;
    let point_name = at(point)?;
    let pair = fields.required("between")?;
    let [first, second] = pair.array("two bodies, such as `(\"ground\", \"arm\")`")?;
    if first.string()? == second.string()? {
        return Err(second
            .error(format!("{} joins a body to itself", fields.owner()))
            .with_help("name two different bodies"));
    }
    let between = [
        side(model, first, point, &point_name)?,
        side(model, second, point, &point_name)?,
    ];

    let kind = fields.required("kind")?;
    let parsed = registry.read(kind)?;
    let frame = frame(&parsed, kind, fields.get("x_axis"))?;
    let locked = match fields.get("locked") {
        Some(value) => locked(value, parsed.joint.as_ref())?,
        None => DofSet::EMPTY,
    };
    let stiffness = match fields.get("stiffness") {
        Some(value) => stiffness(value)?,
        None => JointStiffness::default(),
    };
    let connection = Connection {
        name: entry.name.clone(),
        between,
        joint: parsed.joint,
        locked,
        stiffness,
    };
    let joint = model
        .add_joint(connection, frame)
        .map_err(|error| refused(&error, &fields))?;
    if let Some(value) = fields.get("misfit") {
        set(value, MISFIT, |misfit| model.set_misfit(joint, misfit))?;
    }
    if let Some(value) = fields.get("preload") {
        set(value, PRELOAD, |preload| model.set_preload(joint, preload))?;
    }
    Ok(joint)
}

/// Reads `{ "joint": (x: …) }`, numbers by direction that each joint gets by `set`, in place of what
/// the model's joints have.
pub(crate) fn replace(
    map: Fragment<'_>,
    owner: Directed,
    model: &mut Model,
    set: fn(&mut Model, JointId, &Vector6<f64>) -> Result<(), ModelError>,
) -> Result<(), LoadError> {
    for entry in model.misfits().to_vec() {
        let none = set(model, entry.joint, &Vector6::zeros());
        none.map_err(|error| map.error(error.to_string()))?;
    }
    for entry in map.map()? {
        let mut joints = model.joints().iter();
        let Some(place) = joints.position(|joint| joint.name == entry.name) else {
            let known = model.joints().iter().map(|joint| joint.name.as_str());
            return Err(entry
                .key
                .error(format!("unknown joint `{}`", entry.name))
                .with_help(names::help(&entry.name, "joints", known)));
        };
        self::set(entry.value, owner, |values| {
            set(model, JointId(place), values)
        })?;
    }
    Ok(())
}

/// Reads numbers by direction and gives them to the model; what it refuses of them, it refuses for
/// one direction.
fn set(
    fragment: Fragment<'_>,
    (owner, of): Directed,
    set: impl FnOnce(&Vector6<f64>) -> Result<(), ModelError>,
) -> Result<(), LoadError> {
    let fields = Fields::read(fragment, owner, &Dof::ALL.map(Dof::name))?;
    let mut values = Vector6::zeros();
    for dof in Dof::ALL {
        if let Some(value) = fields.get(dof.name()) {
            values[dof.index()] = value.acting(&format!("`{dof}`"), of()[dof.index()])?;
        }
    }
    set(&values).map_err(|error| {
        let at = |dof: &Dof| fields.get(dof.name()).unwrap_or(fragment);
        match &error {
            ModelError::FreeMisfit { direction, .. } => {
                at(direction).error(error.to_string()).with_help(format!(
                    "leave it out, or hold the joint there: `locked`, or a `stiffness` along \
                     {direction}"
                ))
            }
            ModelError::RigidPreload { direction, .. } => {
                at(direction).error(error.to_string()).with_help(format!(
                    "give a `misfit` instead, or a `stiffness` along {direction} for it to press on"
                ))
            }
            _ => fragment.error(error.to_string()),
        }
    })
}

/// The model's refusal of a joint, which after all checks is one of its stiffness.
fn refused(error: &ModelError, fields: &Fields<'_>) -> LoadError {
    fields
        .error("stiffness", error.to_string())
        .with_help("the energy of a spring is never negative: look at the signs of its entries")
}

/// The node at which a body of `between` meets the joint; `None` is the ground.
fn side(
    model: &Model,
    body: Fragment<'_>,
    point: Fragment<'_>,
    point_name: &str,
) -> Result<Option<NodeId>, LoadError> {
    if body.string()? == GROUND {
        return Ok(None);
    }
    let body = nodes::body_or_ground(model, body)?;
    nodes::node(model, body, point, point_name).map(Some)
}

fn frame(
    parsed: &ParsedJoint,
    kind: Fragment<'_>,
    x_axis: Option<Fragment<'_>>,
) -> Result<Rotation3<f64>, LoadError> {
    let direction = x_axis.map(Fragment::direction).transpose()?;
    let at = x_axis.unwrap_or(kind);
    let help = match parsed.orientation {
        Orientation::Global => "leave `x_axis` out, or give the kind an `axis`",
        Orientation::Axis(_) => "give a direction across the axis, or leave `x_axis` out",
        Orientation::Axes(..) => "leave `x_axis` out: x is the first of the two axes",
    };
    let frame = match parsed.orientation {
        Orientation::Global => frame_from_axis(None, direction.as_ref()),
        Orientation::Axis(axis) => frame_from_axis(Some(&axis), direction.as_ref()),
        Orientation::Axes(..) if x_axis.is_some() => {
            return Err(at
                .error("the frame follows from `axes` already")
                .with_help(help));
        }
        Orientation::Axes(a, b) => frame_from_axes(&a, &b),
    };
    frame.map_err(|error| at.error(error.to_string()).with_help(help))
}

/// Reads `true`, `false` or a list of free directions.
fn locked(fragment: Fragment<'_>, joint: &dyn Joint) -> Result<DofSet, LoadError> {
    if !fragment.is_list() {
        let all = fragment.parse::<bool>("`true`, `false` or a list such as `[y]`")?;
        return Ok(if all { joint.free() } else { DofSet::EMPTY });
    }
    let mut locked = DofSet::EMPTY;
    for item in fragment.list("a list of directions, such as `[y]`")? {
        let dof = Dof::from_str(item.word()).map_err(|error| item.error(error.to_string()))?;
        if !joint.free().contains(dof) {
            let free = joint.free();
            return Err(item
                .error(format!("`{dof}` is not free in `{}`", joint.kind()))
                .with_help(if free.is_empty() {
                    "no direction of it is: leave `locked` out".into()
                } else {
                    format!("its free directions are {free}")
                }));
        }
        if locked.contains(dof) {
            return Err(item
                .error(format!("`{dof}` is listed twice"))
                .with_help("name every direction once"));
        }
        locked.insert(dof);
    }
    Ok(locked)
}

/// Reads `(x: …, …)` or `Matrix([…])`.
fn stiffness(fragment: Fragment<'_>) -> Result<JointStiffness, LoadError> {
    if fragment.has_fields() {
        return directions(fragment).map(JointStiffness::Directions);
    }
    let expected = "a stiffness, `(x: 1e8, …)` or `Matrix([…])`";
    match fragment.variant(expected)? {
        (kind, Some(arguments)) if kind.text() == "Matrix" => {
            let [rows] = arguments.array("one list, `Matrix([…])`")?;
            matrix(rows).map(JointStiffness::Matrix)
        }
        _ => Err(fragment.expected(expected)),
    }
}

/// Reads stiffnesses by direction: `(x: 1e8, v: 1e5)`.
pub(crate) fn directions(fragment: Fragment<'_>) -> Result<[Option<f64>; 6], LoadError> {
    let known = Dof::ALL.map(Dof::name);
    let fields = Fields::read(fragment, "the stiffness", &known)?;
    let mut values = [None; 6];
    for ((value, name), dimension) in values.iter_mut().zip(known).zip(quantities::stiffness()) {
        let read = |given| spring(given, &format!("`{name}`"), &[dimension]);
        *value = fields.get(name).map(read).transpose()?;
    }
    Ok(values)
}

/// Reads one stiffness, zero or more, of one of these dimensions; `what` it is, in words.
pub(crate) fn spring(
    fragment: Fragment<'_>,
    what: &str,
    of: &[Dimension],
) -> Result<f64, LoadError> {
    let rigid = "a stiffness is finite, zero or more; leave it out for a rigid direction";
    let value = entry(fragment, what, of).map_err(|error| match fragment.text() {
        "inf" => error.with_help(rigid),
        _ => error,
    })?;
    if value < 0.0 {
        return Err(fragment
            .error(format!("a stiffness cannot be {}", fragment.shown()))
            .with_help(rigid));
    }
    Ok(value)
}

/// Reads a number of one of these dimensions, of which there is one at least.
fn entry(fragment: Fragment<'_>, what: &str, of: &[Dimension]) -> Result<f64, LoadError> {
    let (value, dimension) = fragment.measured(of.first().copied())?;
    match (dimension, of.first()) {
        (Some(other), Some(first)) if !of.contains(&other) => {
            Err(fragment.of_dimension(what, *first, other))
        }
        _ => Ok(value),
    }
}

/// What an entry of a stiffness matrix measures: between a force and a rotation N/rad, which is the same
/// as N between a moment and a translation.
fn of_entry(row: usize, column: usize) -> &'static [Dimension] {
    match (row / 3, column / 3) {
        (0, 0) => &[Dimension::STIFFNESS],
        (1, 1) => &[Dimension::ROTATIONAL_STIFFNESS],
        _ => &[Dimension::COUPLING, Dimension::FORCE],
    }
}

/// Reads six rows of six numbers, or 36 numbers row by row.
fn matrix(fragment: Fragment<'_>) -> Result<Matrix6<f64>, LoadError> {
    let expected = "six rows of six numbers, `[[…], […], […], […], […], […]]`";
    let rows = fragment.list(expected)?;
    let mut entries = Vec::with_capacity(36);
    for row in &rows {
        if row.is_list() {
            entries.extend(row.list(expected)?);
        } else if row.is_tuple() {
            entries.extend(row.tuple(expected)?);
        } else {
            entries.push(*row);
        }
    }
    if entries.len() != 36 || !(rows.len() == 6 || rows.len() == 36) {
        return Err(fragment.expected(expected));
    }
    let mut matrix = Matrix6::zeros();
    for (k, entry) in entries.iter().enumerate() {
        let (row, column) = (k / 6, k % 6);
        matrix[(row, column)] = self::entry(*entry, "this entry", of_entry(row, column))?;
    }
    check_entries(&matrix, &entries)?;
    Ok(matrix)
}

/// Refuses a matrix with a negative entry on its diagonal, or whose entries above and below it
/// differ by more than rounding.
fn check_entries(matrix: &Matrix6<f64>, entries: &[Fragment<'_>]) -> Result<(), LoadError> {
    for (k, entry) in entries.iter().enumerate() {
        let (row, column) = (k / 6, k % 6);
        if row == column {
            spring(*entry, "this entry", of_entry(row, column))?;
        }
        let (below, above) = (matrix[(row, column)], matrix[(column, row)]);
        let scale = (matrix[(row, row)] * matrix[(column, column)]).sqrt();
        if row > column && (below - above).abs() > SYMMETRY * scale {
            let (row, column) = (row + 1, column + 1);
            return Err(entry
                .error(format!(
                    "row {row}, column {column} differs from row {column}, column {row}"
                ))
                .with_help("a stiffness matrix is symmetric"));
        }
    }
    Ok(())
}
