//! Bodies made of beams: one beam, or a frame of several.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use hyperstat_elements::{Beam, ElementError, Material, Section, TaperedBeam, element_frame};
use hyperstat_model::{BodyId, Member, Model, ModelError, Tapering};
use nalgebra::Vector3;

use super::materials::Profile;
use super::releases::{self, Ends, Fastened, Welded};
use super::through::{Tables, Through, elements, listed, pairs, through};
use super::value_names::Given;
use crate::error::LoadError;
use crate::terms::bodies::MEMBER;
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;

/// Reads `Beam(through: […], section: …, material: …)`.
pub(crate) fn beam(
    name: &str,
    fields: &Fields<'_>,
    tables: &Tables,
    model: &mut Model,
    given: &mut Vec<Given>,
) -> Result<BodyId, LoadError> {
    let list = fields.required("through")?;
    let points = through(fields, list, tables)?;
    let places: Vec<usize> = (0..points.len()).collect();
    let run = Run {
        what: format!("beam `{name}`"),
        list,
        points: &points,
        places: &places,
    };
    let members = run.members(&|field| fields.get(field), fields, tables, given)?;
    model
        .add_elastic(name, &pairs(&points), &members)
        .map_err(|error| list.error(error.to_string()))
}

/// Reads `Frame(members: […], section: …, material: …)`.
pub(crate) fn frame(
    name: &str,
    fields: &Fields<'_>,
    tables: &Tables,
    model: &mut Model,
    given: &mut Vec<Given>,
) -> Result<BodyId, LoadError> {
    let list = fields.required("members")?;
    let mut points = Vec::<Through>::new();
    let mut place_of = HashMap::new();
    let mut members = Vec::new();
    let mut of_members = Vec::new();
    let mut fastened = Vec::new();
    let mut taken = HashSet::new();
    let expected = "a list of members, each a list of points or `(through: […], …)`";
    for (k, member) in list.list(expected)?.into_iter().enumerate() {
        let what = format!("member {} of frame `{name}`", k + 1);
        let (own, through) = if member.has_fields() {
            let own = Fields::read(member, &what, &MEMBER.names())?;
            let through = own.required("through")?;
            (own, through)
        } else if member.is_list() {
            (Fields::none(member, &what), member)
        } else {
            return Err(member.expected("a member, a list of points or `(through: […], …)`"));
        };
        let field = |field: &str| own.get(field).or_else(|| fields.get(field));
        let listed = listed(through, tables)?;
        if let Some(ends) = Ends::read(&own, &what, through, &listed)? {
            let run = Run {
                what,
                list: through,
                points: &listed,
                places: &[0, 1],
            };
            let mut of_member = Vec::new();
            let found = run.members(&field, fields, tables, &mut of_member)?;
            for (member, given) in found.into_iter().zip(of_member) {
                fastened.push(Fastened {
                    points: [listed[0].clone(), listed[1].clone()],
                    member,
                    given,
                    ends: ends.clone(),
                    at: through,
                });
            }
            continue;
        }
        let mut places = Vec::new();
        for point in listed {
            let next = points.len();
            let place = *place_of.entry(point.name.clone()).or_insert(next);
            places.push(place);
            if place == next {
                points.push(point.clone());
            }
            if let [.., a, b] = places[..]
                && a != b
                && !taken.insert((a.min(b), a.max(b)))
            {
                let (a, b) = (&points[a].name, &points[b].name);
                return Err(point
                    .at
                    .error(format!("{what} is the second between `{a}` and `{b}`"))
                    .with_help("leave one of the two out, or give one beam the section of both"));
            }
        }
        let run = Run {
            what,
            list: through,
            points: &points,
            places: &places,
        };
        members.extend(run.members(&field, fields, tables, &mut of_members)?);
    }
    if !fastened.is_empty() {
        let welded = Welded {
            points,
            members,
            given: of_members,
        };
        return releases::add(name, welded, fastened, list, model, given);
    }
    given.extend(of_members);
    if members.is_empty() {
        return Err(list
            .error(format!("frame `{name}` has no members"))
            .with_help("add a member, such as `[\"A\", \"B\"]`"));
    }
    model
        .add_elastic(name, &pairs(&points), &members)
        .map_err(|error| match &error {
            ModelError::Loose { point, .. } => {
                let loose = points.iter().find(|other| other.name == *point);
                loose
                    .map_or(list, |loose| loose.at)
                    .error(format!(
                        "no member of frame `{name}` connects point `{point}` with point `{}`",
                        points[0].name
                    ))
                    .with_help("add a member between the two parts, or make each a body of its own")
            }
            _ => list.error(error.to_string()),
        })
}

/// A section's name, the section, and its change along a segment.
type Sections = (Arc<str>, Section, Option<Tapering>);

/// The direction of a y axis, and where it is given.
type YAxis<'a> = (Option<Vector3<f64>>, Option<Fragment<'a>>);

/// A chain of segments through some points of a body.
struct Run<'r, 'a> {
    /// What it is, in words.
    what: String,
    /// The list of points in the file.
    list: Fragment<'a>,
    points: &'r [Through<'a>],
    /// Places of the points it runs through, in `points`.
    places: &'r [usize],
}

impl<'a> Run<'_, 'a> {
    /// Its segments; `get` finds a field's value, `owner` has the fields that must be there. Adds to
    /// `given` what each is given by.
    fn members(
        &self,
        get: &dyn Fn(&str) -> Option<Fragment<'a>>,
        owner: &Fields<'a>,
        tables: &Tables,
        given: &mut Vec<Given>,
    ) -> Result<Vec<Member>, LoadError> {
        if self.places.len() < 2 {
            return Err(self
                .list
                .error(format!("{} runs through fewer than two points", self.what))
                .with_help("a beam has two ends; use `Rigid` for a body of one point"));
        }
        let required = |name: &str| match get(name) {
            Some(given) => Ok(given),
            None => owner.required(name),
        };
        let sections = self.sections(required("section")?, tables)?;
        let of_material = required("material")?;
        let material = tables.materials.find(of_material)?;
        let material_name: Arc<str> = of_material.string()?.into();
        let y_axis = get("y_axis");
        let y_axes = self.y_axes(y_axis)?;
        let elements = get("elements").map_or(Ok(1), elements)?;
        let mut members = Vec::new();
        let ends = self.places.windows(2).zip(y_axes);
        for ((ends, (y_axis, at)), (name, section, taper)) in ends.zip(sections) {
            let member = Member {
                ends: [ends[0], ends[1]],
                material: material.clone(),
                section,
                taper,
                y_axis,
                elements,
            };
            let [from, to] = member.ends.map(|place| &self.points[place]);
            let span = to.position - from.position;
            check(&member, &span, material).map_err(|error| self.error(&error, [from, to], at))?;
            members.push(member);
            given.push(Given {
                section: name,
                material: Arc::clone(&material_name),
            });
        }
        Ok(members)
    }

    /// The section of every segment, by its name in the table, and its change: one section all
    /// along, a taper along the whole run, or a list of a section for each segment.
    fn sections(&self, given: Fragment<'a>, tables: &Tables) -> Result<Vec<Sections>, LoadError> {
        let lengths = self.lengths();
        let named = |name: Fragment<'_>| -> Result<(Arc<str>, &Profile), LoadError> {
            Ok((name.string()?.into(), tables.sections.find(name)?))
        };
        if !given.is_list() {
            let (name, profile) = named(given)?;
            let whole: f64 = lengths.iter().sum();
            let mut passed = 0.0;
            let parts = lengths.iter().enumerate().map(|(k, length)| {
                let first = passed / whole;
                passed += length;
                let last = k + 1 == lengths.len();
                let last = if last { 1.0 } else { passed / whole };
                let (section, taper) = profile.part([first, last]);
                (Arc::clone(&name), section, taper)
            });
            return Ok(parts.collect());
        }
        let names = given.list("a section, or a list of one for each segment")?;
        if names.len() != lengths.len() {
            return Err(given
                .error(format!(
                    "{} has {} segments, its list of sections has {}",
                    self.what,
                    lengths.len(),
                    names.len()
                ))
                .with_help(
                    "list one section for each segment between two points, or name one for all",
                ));
        }
        let whole = |name: Fragment<'_>| {
            let (name, profile) = named(name)?;
            let (section, taper) = profile.part([0.0, 1.0]);
            Ok((name, section, taper))
        };
        names.into_iter().map(whole).collect()
    }

    /// The direction of every segment's y axis, if it is given, and where: one for all, or a list of one
    /// for each.
    fn y_axes(&self, given: Option<Fragment<'a>>) -> Result<Vec<YAxis<'a>>, LoadError> {
        let count = self.places.len() - 1;
        let Some(given) = given else {
            return Ok(vec![(None, None); count]);
        };
        let one = |own: Fragment<'a>| Ok((Some(own.direction()?), Some(own)));
        if !given.is_list_of_tuples() {
            return Ok(vec![one(given)?; count]);
        }
        let list = given.list("a direction, or a list of one for each segment")?;
        if list.len() != count {
            let message = format!(
                "{} has {count} segments, its list of y axes has {}",
                self.what,
                list.len()
            );
            let help =
                "list one direction for each segment between two points, or give one for all";
            return Err(given.error(message).with_help(help));
        }
        list.into_iter().map(one).collect()
    }

    /// Length of every segment \[m\].
    fn lengths(&self) -> Vec<f64> {
        let position = |place: usize| self.points[place].position;
        let ends = self.places.windows(2);
        ends.map(|w| (position(w[1]) - position(w[0])).norm())
            .collect()
    }

    /// The error of a segment, where the file makes it.
    fn error(
        &self,
        error: &ElementError,
        [from, to]: [&Through<'a>; 2],
        y_axis: Option<Fragment<'a>>,
    ) -> LoadError {
        let segment = format!("{} between `{}` and `{}`", self.what, from.name, to.name);
        match error {
            ElementError::NoLength { .. } => to
                .at
                .error(format!(
                    "{} has no length between `{}` and `{}`",
                    self.what, from.name, to.name
                ))
                .with_help("give the two points different places, or leave one out"),
            ElementError::AlongBeam { .. } => y_axis
                .unwrap_or(self.list)
                .error(format!("`y_axis` lies along {segment}"))
                .with_help("give a direction across the beam, or leave `y_axis` out"),
            ElementError::OutOfRange {
                field: "length",
                value,
                ..
            } => to
                .at
                .error(format!(
                    "{segment}: an element of {value:?} m has a stiffness beyond double precision"
                ))
                .with_help(
                    "look at the points, the section and the material: lengths are in m, `young` \
                     is in N/m²",
                ),
            other => to.at.error(format!("{segment}: {other}")),
        }
    }
}

/// Looks whether the frame and the stiffness of a segment's elements can be formed.
fn check(member: &Member, span: &Vector3<f64>, material: &Material) -> Result<(), ElementError> {
    element_frame(span, member.y_axis.as_ref())?;
    let length = span.norm();
    match member.change_of_section()? {
        None => {
            Beam::new(material, &member.section, length / member.elements as f64)?;
        }
        Some(taper) => {
            TaperedBeam::new(material, &taper, length)?;
        }
    }
    Ok(())
}
