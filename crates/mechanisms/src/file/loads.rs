//! What acts on a mechanism, in its file or in a job: loads, cases, gravity and masses; in a job
//! misfits and preloads of joints, too.

use hyperstat_elements::RigidMass;
use hyperstat_model::{
    Axes, BodyId, BodyKind, LineLoad, Load, LoadCase, LoadSet, Model, NodeId, SegmentId,
};
use nalgebra::{Matrix3, Vector3, Vector6};

use super::home::{Home, NO_HOME};
use crate::error::LoadError;
use crate::file::{groups, joints, nodes};
use crate::terms::acting::{ALONG, LOAD, MASS};
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;
use crate::text::quantities;
use crate::text::scope::Scope;
use crate::text::source::Place;
use crate::text::tree::Node;

/// The fields of a job that say what acts, and where the output is. Those of a file that say what acts are
/// the first four: what its joints have stands with each of them.
pub(crate) const FIELDS: [&str; 8] = [
    "loads", "cases", "gravity", "masses", "misfits", "preloads", "output", "tool",
];

/// What stands in those fields, each if it is given.
#[derive(Debug, Clone)]
pub(crate) struct Acting([Option<Node>; 8]);

impl Acting {
    /// Finds the fields.
    pub(crate) fn find(fields: &Fields<'_>) -> Self {
        Self(FIELDS.map(|name| fields.get(name).map(Scope::written)))
    }

    /// The same with the values of its expressions, whose names are those of a mechanism.
    pub(crate) fn in_scope(&self, mechanism: &Node) -> Result<Self, LoadError> {
        if !self.given().any(|(_, node)| node.has_expressions()) {
            return Ok(self.clone());
        }
        let known = groups::with_copies(mechanism)?;
        let scope = Scope::new(&known)?;
        Ok(Self(self.0.each_ref().map(|field| {
            field.as_ref().map(|field| scope.valued(field))
        })))
    }

    /// All fields, with their names.
    pub(crate) fn fields(&self) -> impl Iterator<Item = (&Option<Node>, &'static str)> {
        self.0.iter().zip(FIELDS)
    }

    /// The same with other values of what is given.
    pub(crate) fn replaced(&self, values: impl Iterator<Item = Option<Node>>) -> Self {
        let mut replaced = self.clone();
        for (own, value) in replaced.0.iter_mut().zip(values) {
            if own.is_some() && value.is_some() {
                *own = value;
            }
        }
        replaced
    }

    /// What is given, by its field.
    pub(crate) fn given(&self) -> impl Iterator<Item = (&'static str, &Node)> {
        let given = FIELDS.iter().zip(&self.0);
        given.filter_map(|(name, node)| Some((*name, node.as_ref()?)))
    }

    /// Names of the cases that are given; none where they are not.
    pub(crate) fn cases(&self) -> Result<Option<Vec<String>>, LoadError> {
        let Some(cases) = &self.0[1] else {
            return Ok(None);
        };
        let entries = Fragment::of_node(cases).map()?;
        Ok(Some(entries.into_iter().map(|entry| entry.name).collect()))
    }

    /// The output that is named in place of the mechanism's own.
    pub(crate) fn output(&self) -> Option<Fragment<'_>> {
        self.0[6].as_ref().map(Fragment::of_node)
    }

    /// The tool, from the output.
    pub(crate) fn tool(&self) -> Option<Fragment<'_>> {
        self.0[7].as_ref().map(Fragment::of_node)
    }

    /// Whether nothing is given.
    pub(crate) fn is_empty(&self) -> bool {
        self.0.iter().all(Option::is_none)
    }

    /// Whether masses are given.
    pub(crate) fn has_masses(&self) -> bool {
        self.0[3].is_some()
    }

    /// Reads the fields that are given, each in place of what the model has; see [`read`].
    pub(crate) fn read(
        &self,
        model: &mut Model,
        home: &Home,
    ) -> Result<Option<Vec<Place>>, LoadError> {
        read(|k| self.0[k].as_ref().map(Fragment::of_node), model, home)
    }
}

/// Reads what is given of [`FIELDS`], by number, each in place of what the model has. Returns
/// where each load on a node stands, where loads are given.
pub(crate) fn read<'a>(
    field: impl Fn(usize) -> Option<Fragment<'a>>,
    model: &mut Model,
    home: &Home,
) -> Result<Option<Vec<Place>>, LoadError> {
    let refused = |at: Fragment<'_>, error: hyperstat_model::ModelError| {
        let mut refused = at.error(error.to_string());
        if matches!(error, hyperstat_model::ModelError::NoDensity { .. }) {
            refused = refused.with_help("give its material a `density`, in kg/m³");
        }
        refused
    };
    if let Some(list) = field(3) {
        model.clear_masses();
        for mass in list.list("a list of masses, `[(on: …, mass: …)]`")? {
            read_mass(mass, model, home)?;
        }
    }
    if let Some(misfits) = field(4) {
        joints::replace(misfits, joints::MISFIT, model, Model::set_misfit)?;
    }
    if let Some(preloads) = field(5) {
        joints::replace(preloads, joints::PRELOAD, model, Model::set_preload)?;
    }
    if let Some(gravity) = field(2) {
        let set = model.set_gravity(gravity.acting_vector("`gravity`", Dimension::ACCELERATION)?);
        set.map_err(|error| refused(gravity, error))?;
    }
    if let Some(cases) = field(1) {
        model.clear_cases();
        for entry in cases.map()? {
            check_case_name(&entry.name, entry.key)?;
            let (loads, _) = read_set(entry.value, model, home)?;
            let name = entry.name;
            let added = model.add_case(LoadCase { name, loads });
            added.map_err(|error| refused(entry.value, error))?;
        }
    }
    let Some(list) = field(0) else {
        return Ok(None);
    };
    let (loads, places) = read_set(list, model, home)?;
    let set = model.set_loads(loads);
    set.map_err(|error| refused(list, error))?;
    Ok(Some(places))
}

/// Refuses a name that could not stand in `case.dx`.
fn check_case_name(name: &str, key: Fragment<'_>) -> Result<(), LoadError> {
    if name.is_empty() || name.contains('.') {
        return Err(key
            .error(format!("`{name}` cannot be the name of a case"))
            .with_help("a name holds no `.` and is not empty: results are named `case.dx`"));
    }
    Ok(())
}

fn read_mass(fragment: Fragment<'_>, model: &mut Model, home: &Home) -> Result<(), LoadError> {
    let fields = Fields::read(fragment, "a mass", &MASS.names())?;
    let node = nodes::on(model, fields.required("on")?, "a mass")?;
    let mass = fields.required("mass")?.acting("`mass`", Dimension::MASS)?;
    let made = match fields.get("inertia") {
        None => RigidMass::point(mass),
        Some(given) => {
            let expected = "3 moments of inertia, `(Jxx, Jyy, Jzz)`, or 6 entries of the matrix, \
                            `(Jxx, Jyy, Jzz, Jxy, Jxz, Jyz)`";
            let numbers: Result<Vec<f64>, _> = given
                .tuple(expected)?
                .into_iter()
                .map(|part| part.acting("`inertia`", Dimension::INERTIA))
                .collect();
            let numbers = numbers?;
            if let Ok(moments) = <[f64; 3]>::try_from(&*numbers) {
                RigidMass::with_moments(mass, moments)
            } else if let Ok(entries) = <[f64; 6]>::try_from(&*numbers) {
                RigidMass::with_inertia(mass, entries)
            } else {
                return Err(given.expected(expected));
            }
        }
    };
    let made = made.map_err(|error| fields.element_error(&error))?;
    let body = model.nodes()[node.0].body;
    let made = match home.turn(model, body) {
        Some(turn) => made.turned(&turn),
        // The same in every orientation.
        None if *made.inertia() == Matrix3::from_diagonal_element(made.inertia()[0]) => made,
        None => {
            let name = &model.bodies()[body.0].name;
            return Err(fields
                .error("inertia", format!("body `{name}` has no home orientation"))
                .with_help(format!(
                    "{NO_HOME}; an inertia that is the same about all axes, `(J, J, J)`, needs none"
                )));
        }
    };
    model.add_mass(node, made);
    Ok(())
}

/// Reads a list of loads, and where each load on a node stands.
fn read_set(
    list: Fragment<'_>,
    model: &Model,
    home: &Home,
) -> Result<(LoadSet, Vec<Place>), LoadError> {
    let mut set = LoadSet::default();
    let mut places = Vec::new();
    for load in list.list("a list of loads, `[(on: …, force: …)]`")? {
        let fields = Fields::read(load, "a load", &LOAD.names())?;
        let on = fields.required("on")?;
        if ALONG.iter().any(|name| fields.get(name).is_some()) {
            if let Some(point) = fields.get("force").or(fields.get("moment")) {
                return Err(point
                    .error("a load is either on a point or along a beam")
                    .with_help("make it two loads of the list"));
            }
            read_along(&fields, on, model, home, &mut set)?;
            continue;
        }
        let node = nodes::on(model, on, "a load")?;
        let body = model.nodes()[node.0].body;
        set.nodes.push(Load {
            node,
            wrench: wrench(&fields, "force", "moment")?,
            axes: axes(&fields, body, model, home)?,
        });
        places.push(load.place());
    }
    Ok((set, places))
}

/// The vector of a field of a load.
fn vector(name: &str, given: Fragment<'_>) -> Result<Vector3<f64>, LoadError> {
    let dimension = quantities::of(name).unwrap_or(Dimension::NUMBER);
    given.acting_vector(&format!("`{name}`"), dimension)
}

/// A force and a moment, each zero where it is not given.
fn wrench(fields: &Fields<'_>, force: &str, moment: &str) -> Result<Vector6<f64>, LoadError> {
    let part = |name: &str| {
        let given = fields.get(name);
        given.map_or(Ok(Vector3::zeros()), |given| vector(name, given))
    };
    let (f, m) = (part(force)?, part(moment)?);
    Ok(Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z))
}

/// Reads a load along a body, or along its segment between two points.
fn read_along(
    fields: &Fields<'_>,
    on: Fragment<'_>,
    model: &Model,
    home: &Home,
    set: &mut LoadSet,
) -> Result<(), LoadError> {
    let expected = "a body of beams, `\"body\"`, or two neighbouring points of one, \
                    `(\"body\", \"A\", \"B\")`";
    let (name, points) = if on.is_tuple() {
        let [body, first, second] = on.array(expected)?;
        (body, Some([first, second]))
    } else {
        (on, None)
    };
    let body = nodes::body(model, name)?;
    let entry = &model.bodies()[body.0];
    if entry.kind != BodyKind::Elastic && model.parts_of(body).is_empty() {
        return Err(name
            .error(format!("body `{}` is not made of beams", entry.name))
            .with_help(
                "a load along a body needs a `Beam` or a `Frame`; give a `force` on a point",
            ));
    }
    let uniform = fields.get("per_length").or(fields.get("moment_per_length"));
    let linear = fields.get("from").or(fields.get("to"));
    let ends = match (uniform, linear) {
        (Some(_), Some(linear)) => {
            return Err(linear
                .error("a load is either the same all along or runs `from` one value `to` another")
                .with_help("make it two loads of the list"));
        }
        (Some(_), None) => [wrench(fields, "per_length", "moment_per_length")?; 2],
        (None, _) => {
            if points.is_none() {
                return Err(on
                    .error("a load that changes along a beam needs the two points it runs between")
                    .with_help("write `on: (\"body\", \"A\", \"B\")`"));
            }
            let end = |name: &str| -> Result<Vector6<f64>, LoadError> {
                let force = vector(name, fields.required(name)?)?;
                Ok(Vector6::new(force.x, force.y, force.z, 0.0, 0.0, 0.0))
            };
            [end("from")?, end("to")?]
        }
    };
    let axes = axes(fields, body, model, home)?;
    let parts = model.parts_of(body).iter();
    let parts = parts.flat_map(|part| &model.bodies()[part.0].segments);
    let segments: Vec<SegmentId> = entry.segments.iter().chain(parts).copied().collect();
    let Some([first, second]) = points else {
        let lines = segments.iter().map(|&segment| LineLoad {
            segment,
            ends,
            axes,
        });
        set.lines.extend(lines);
        return Ok(());
    };
    for point in [first, second] {
        nodes::node(model, body, point, &point.string()?)?;
    }
    let wanted = [first.string()?, second.string()?];
    let between = |id: SegmentId| model.segments()[id.0].ends;
    // The end of a member that is offset is called as the point that it belongs to, behind the member.
    let is = |node: NodeId, name: &str| {
        let own = &model.nodes()[node.0].point;
        let rest = own.strip_prefix(&*entry.name);
        own == name || rest.is_some_and(|rest| rest.ends_with(&format!(" {name}")))
    };
    let runs = |[a, b]: [NodeId; 2], [from, to]: [&str; 2]| is(a, from) && is(b, to);
    let along = |id: SegmentId| runs(between(id), [&wanted[0], &wanted[1]]);
    let of = |id: &&SegmentId| along(**id) || runs(between(**id), [&wanted[1], &wanted[0]]);
    let Some(&segment) = segments.iter().find(of) else {
        let [from, to] = &wanted;
        return Err(second
            .error(format!(
                "no segment of body `{}` runs between `{from}` and `{to}`",
                entry.name
            ))
            .with_help("name two neighbouring points, or the body alone for all its segments"));
    };
    let ends = if along(segment) {
        ends
    } else {
        [ends[1], ends[0]]
    };
    set.lines.push(LineLoad {
        segment,
        ends,
        axes,
    });
    Ok(())
}

/// Reads `frame`: `Global`, `Body` or `Output`.
fn axes(fields: &Fields<'_>, body: BodyId, model: &Model, home: &Home) -> Result<Axes, LoadError> {
    let Some(frame) = fields.get("frame") else {
        return Ok(Axes::Global);
    };
    let output = model.output().map(|node| model.nodes()[node.0].body);
    let body = match (frame.word(), output) {
        ("Global", _) => return Ok(Axes::Global),
        ("Body", _) => body,
        ("Output", Some(output)) => output,
        _ => return Err(frame.expected("`Global`, `Body` or `Output`")),
    };
    let name = &model.bodies()[body.0].name;
    let now = model.body_frame(body).ok_or_else(|| {
        frame
            .error(format!("how body `{name}` is turned is not known"))
            .with_help(
                "its points and the axes of its joints lie along one line: give it a point beside \
                 that line, or a beam a `y_axis`",
            )
    })?;
    let turn = home.turn(model, body).ok_or_else(|| {
        frame
            .error(format!("body `{name}` has no home orientation"))
            .with_help(NO_HOME)
    })?;
    let home = turn.inverse() * now;
    Ok(Axes::Body { body, home })
}
