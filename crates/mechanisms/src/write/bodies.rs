//! Bodies, their materials and sections.

use std::fmt::Write as _;

use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
use hyperstat_model::{Body, BodyKind, Model, SegmentId};
use nalgebra::Vector3;

use super::error::WriteError;
use super::numbers::{fields, number, vector};

/// Materials and sections, each once.
#[derive(Default)]
pub(super) struct Shared {
    materials: Named<Material>,
    /// Sections at the first end and, where they taper, at the second.
    sections: Named<(Section, Option<Section>)>,
}

impl Shared {
    /// Names and values of the materials.
    pub(super) fn materials(&self) -> Vec<(&str, String)> {
        self.materials.named(material)
    }

    /// Names and values of the sections.
    pub(super) fn sections(&self) -> Vec<(&str, String)> {
        self.sections.named(profile)
    }
}

/// Values with names: that of the first body that has the value, with a number where it has more.
struct Named<T>(Vec<(String, T)>);

impl<T> Default for Named<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T: PartialEq + Clone> Named<T> {
    /// The name of a value that `body` has.
    fn name(&mut self, value: &T, body: &str) -> String {
        if let Some((name, _)) = self.0.iter().find(|(_, known)| known == value) {
            return name.clone();
        }
        let taken = |name: &str| self.0.iter().any(|(other, _)| other == name);
        let numbered = (2..).map(|number| format!("{body}-{number}"));
        let mut names = std::iter::once(body.to_owned()).chain(numbered);
        let name = names.find(|name| !taken(name)).unwrap_or_default();
        self.0.push((name.clone(), value.clone()));
        name
    }

    fn named(&self, write: impl Fn(&T) -> String) -> Vec<(&str, String)> {
        let written = self.0.iter().map(|(name, value)| (&**name, write(value)));
        written.collect()
    }
}

/// Writes a body.
///
/// # Errors
/// A body that no mechanism file describes.
pub(super) fn body(model: &Model, body: &Body, parts: &mut Shared) -> Result<String, WriteError> {
    let names: Vec<_> = (body.nodes.iter())
        .map(|node| format!("{:?}", model.nodes()[node.0].point))
        .collect();
    let names = names.join(", ");
    if body.kind == BodyKind::Rigid {
        return Ok(format!("Rigid(points: [{names}])"));
    }
    if body.kind == BodyKind::Flexible {
        return Err(WriteError::Flexible {
            body: body.name.clone(),
        });
    }
    let temperature = match body.temperature {
        0.0 => String::new(),
        change => format!(", temperature: {}", number(change)),
    };
    let members: Vec<_> = (body.segments.iter())
        .map(|id| member(model, *id, &body.name, parts))
        .collect();
    let is_chain = body.segments.len() + 1 == body.nodes.len()
        && body
            .segments
            .iter()
            .enumerate()
            .all(|(k, id)| model.segments()[id.0].ends == [body.nodes[k], body.nodes[k + 1]]);
    if is_chain && members.windows(2).all(|pair| pair[0].goes_with(&pair[1])) {
        let mut sections: Vec<_> = members.iter().map(|member| &*member.section).collect();
        // A taper named once would run along the whole beam.
        let is_one = body.segments.len() == 1
            || (members.windows(2)).all(|pair| pair[0].section == pair[1].section)
                && model.segments()[body.segments[0].0].taper.is_none();
        let section = if is_one {
            sections.swap_remove(0).to_owned()
        } else {
            format!("[{}]", sections.join(", "))
        };
        let rest = members[0].rest();
        return Ok(format!(
            "Beam(through: [{names}], section: {section}, {rest}{temperature})"
        ));
    }
    let members: Vec<_> = (members.iter())
        .map(|member| {
            let Member {
                ends: [first, second],
                section,
                ..
            } = member;
            let rest = member.rest();
            format!("(through: [{first:?}, {second:?}], section: {section}, {rest})")
        })
        .collect();
    let members = members.join(", ");
    Ok(format!("Frame(members: [{members}]{temperature})"))
}

/// A segment's parts in a file.
struct Member<'a> {
    /// Names of its points.
    ends: [&'a str; 2],
    /// Name of its section, quoted.
    section: String,
    /// Name of its material, quoted.
    material: String,
    y_axis: Option<Vector3<f64>>,
    elements: usize,
}

/// Directions of one copy's members that differ by no more than this are one, turned.
const SAME_DIRECTION: f64 = 1e-14;

impl Member<'_> {
    /// Whether both have the same other fields.
    fn goes_with(&self, other: &Self) -> bool {
        let same = match (self.y_axis, other.y_axis) {
            (Some(own), Some(other)) => (own - other).amax() <= SAME_DIRECTION,
            (own, other) => own == other,
        };
        same && self.material == other.material && self.elements == other.elements
    }

    /// Its fields beside ends and section.
    fn rest(&self) -> String {
        let mut rest = format!("material: {}", self.material);
        if let Some(y_axis) = &self.y_axis {
            let _ = write!(rest, ", y_axis: {}", vector(y_axis));
        }
        if self.elements != 1 {
            let _ = write!(rest, ", elements: {}", self.elements);
        }
        rest
    }
}

fn member<'a>(model: &'a Model, id: SegmentId, body: &str, parts: &mut Shared) -> Member<'a> {
    let segment = &model.segments()[id.0];
    // A segment's own part of a change of section; a model has none that cannot be formed.
    let profile = match segment.change_of_section() {
        Ok(Some(taper)) => (taper.from().clone(), Some(taper.to().clone())),
        _ => (segment.section.clone(), None),
    };
    let material = parts.materials.name(&segment.material, body);
    Member {
        ends: segment.ends.map(|node| &*model.nodes()[node.0].point),
        section: format!("{:?}", parts.sections.name(&profile, body)),
        material: format!("{material:?}"),
        y_axis: model.geometry().y_axes[id.0],
        elements: segment.elements,
    }
}

/// A material, as it was given.
fn material(material: &Material) -> String {
    let second = match material.elasticity() {
        Elasticity::Poisson(poisson) => format!("poisson: {}", number(poisson)),
        Elasticity::Shear(shear) => format!("shear: {}", number(shear)),
    };
    let more = [
        ("density", material.density()),
        ("expansion", material.expansion()),
        ("yield", material.yield_strength()),
    ];
    let more = more
        .into_iter()
        .filter_map(|(name, value)| Some((name, value?)));
    let young = number(material.young());
    fields(vec![format!("young: {young}"), second], more)
}

fn profile((from, to): &(Section, Option<Section>)) -> String {
    match to {
        None => section(from),
        Some(to) => format!("Tapered(from: {}, to: {})", section(from), section(to)),
    }
}

fn section(section: &Section) -> String {
    let mut given = Vec::new();
    let mut optional = vec![
        ("shear_y", section.shear_y()),
        ("shear_z", section.shear_z()),
    ];
    let kind = match *section.shape() {
        SectionShape::Circle { diameter } => {
            given.push(("diameter", diameter));
            "Circle"
        }
        SectionShape::Tube { outer, inner } => {
            given.extend([("outer", outer), ("inner", inner)]);
            "Tube"
        }
        SectionShape::Rectangle { width, height } => {
            given.extend([("width", width), ("height", height)]);
            "Rectangle"
        }
        SectionShape::General {
            area,
            iy,
            iz,
            torsion,
            y_max,
            z_max,
            torsion_modulus,
        } => {
            given.extend([("area", area), ("iy", iy), ("iz", iz), ("torsion", torsion)]);
            let stress = [
                ("y_max", y_max),
                ("z_max", z_max),
                ("torsion_modulus", torsion_modulus),
            ];
            optional.extend(stress);
            "General"
        }
    };
    given.extend(
        optional
            .into_iter()
            .filter_map(|(name, value)| Some((name, value?))),
    );
    format!("{kind}{}", fields(Vec::new(), given))
}
