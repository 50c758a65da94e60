//! What the input alone tells: materials, beams and joints that hardly exist.

use hyperstat_assembly::{Body, Connection, JointStiffness, Model};
use hyperstat_elements::{Material, Section, SectionShape};
use hyperstat_joints::Dof;

use super::{number, size};

/// Young's moduli of what exists \[N/m²\]: from the softest silicone to what is stiffer than diamond
/// (1.2e12).
const YOUNG: [f64; 2] = [1e5, 2e12];

/// Young's moduli of metals in N/mm²: read as N/m², only rubber is as soft.
const METAL_IN_MPA: [f64; 2] = [1e5, 4.2e5];

/// Rubber is lighter than this \[kg/m³\], or hardly changes its volume: its Poisson's ratio is above.
const RUBBER: (f64, f64) = (2500.0, 0.45);

/// Shear moduli of what exists, over Young's modulus: from woods and composites across their fibres
/// to lattices made for it.
const SHEAR: [f64; 2] = [1e-3, 10.0];

/// Acceleration above which gravity is that of no planet \[m/s²\].
const GRAVITY: f64 = 100.0;

/// Size above which a mechanism is a bridge \[m\].
const LARGE: f64 = 100.0;

/// Densities of what exists \[kg/m³\]: from light foams to osmium (22 590).
const DENSITY: [f64; 2] = [10.0, 2.3e4];

/// A beam that is this many times thicker than long is none, and was measured in another unit.
const THICK: f64 = 10.0;

/// A leaf flexure may be this many times wider than long, where it is thinner than [`LEAF`] of that.
const WIDE: f64 = 20.0;
const LEAF: f64 = 0.2;

/// A beam that is this many times longer than thick is a wire, and would hang through.
const THIN: f64 = 5000.0;

/// A bearing of a mechanism of 1 m is stiffer than this \[N/m\], and so is a rubber bushing; of a
/// smaller one in proportion.
const BEARING: f64 = 1e3;

/// A bushing that gives by less than this part of the mechanism's size under all its forces is stiff
/// enough for them.
const GIVES: f64 = 0.01;

/// What is found of one kind: the first part, its value, and how many parts more.
struct Doubtful<'m> {
    part: &'m str,
    values: [f64; 2],
    more: usize,
}

impl Doubtful<'_> {
    /// The part in words, with those that it stands for.
    fn parts(&self) -> String {
        match self.more {
            0 => format!("`{}`", self.part),
            more => format!("`{}` (and {more} more)", self.part),
        }
    }
}

/// The first of the parts for which there is a value, and the number of the others.
fn first<'m>(parts: impl Iterator<Item = (&'m str, Option<[f64; 2]>)>) -> Option<Doubtful<'m>> {
    let mut found: Option<Doubtful<'m>> = None;
    for (part, values) in parts {
        let Some(values) = values else { continue };
        match &mut found {
            Some(found) => found.more += 1,
            None => {
                found = Some(Doubtful {
                    part,
                    values,
                    more: 0,
                });
            }
        }
    }
    found
}

/// What is hardly as it was meant in a model, a sentence each.
pub fn of_model(model: &Model) -> Vec<String> {
    let found = [
        young(model),
        shear(model),
        density(model),
        gravity(model),
        large(model),
        thick(model),
        thin(model),
        bearing(model),
    ];
    found.into_iter().flatten().collect()
}

fn young(model: &Model) -> Option<String> {
    let of_body = |body: &Body| {
        let materials = body
            .segments
            .iter()
            .map(|id| &model.segments()[id.0].material);
        let mut outside = materials.filter(|material| !is_real(material));
        outside.next().map(|material| [material.young(), 0.0])
    };
    let found = first(
        model
            .bodies()
            .iter()
            .map(|body| (&*body.name, of_body(body))),
    )?;
    let [young, _] = found.values;
    let what = match young {
        young if young < YOUNG[0] => "softer than rubber",
        young if young > YOUNG[1] => "stiffer than diamond",
        _ => "as soft as rubber, of what is no rubber by its density and Poisson's ratio",
    };
    // What the number would be in another unit; steel is 2.1e11.
    let units = [("GPa", 1e9), ("N/mm² (MPa)", 1e6), ("kPa", 1e3)];
    let meant = likely(young, &units, [1e9, 1.3e12]);
    Some(format!(
        "Young's modulus of {} is {} N/m², {what}{meant}",
        found.parts(),
        number(young)
    ))
}

/// Whether something has such a Young's modulus.
fn is_real(material: &Material) -> bool {
    let young = material.young();
    let poisson = young / (2.0 * material.shear()) - 1.0;
    let light = material.density().is_some_and(|density| density < RUBBER.0);
    let metal = (METAL_IN_MPA[0]..=METAL_IN_MPA[1]).contains(&young);
    (YOUNG[0]..=YOUNG[1]).contains(&young) && (!metal || light || poisson > RUBBER.1)
}

/// Shear moduli that do not go with Young's modulus, where that is one.
fn shear(model: &Model) -> Option<String> {
    let of_body = |body: &Body| {
        let materials = body
            .segments
            .iter()
            .map(|id| &model.segments()[id.0].material);
        let mut outside = materials.filter(|material| {
            let ratio = material.shear() / material.young();
            is_real(material) && !(SHEAR[0]..=SHEAR[1]).contains(&ratio)
        });
        outside
            .next()
            .map(|material| [material.shear(), material.young()])
    };
    let found = first(
        model
            .bodies()
            .iter()
            .map(|body| (&*body.name, of_body(body))),
    )?;
    let [shear, young] = found.values;
    let units = [("GPa", 1e9), ("N/mm² (MPa)", 1e6), ("kPa", 1e3)];
    let meant = likely(shear, &units, [0.02 * young, young]);
    Some(format!(
        "the shear modulus of {} is {} N/m² at a Young's modulus of {} N/m²; it is mostly a third \
         of that{meant}",
        found.parts(),
        number(shear),
        number(young)
    ))
}

/// Gravity of no planet.
fn gravity(model: &Model) -> Option<String> {
    let size = model.gravity().norm();
    let units = [("mm/s²", 1e-3), ("cm/s²", 1e-2)];
    let meant = likely(size, &units, [1.0, 30.0]);
    (size > GRAVITY).then(|| {
        format!(
            "gravity is {} m/s²; on the earth it is 9.81{meant}",
            number(size)
        )
    })
}

/// Mechanisms of the size of bridges.
fn large(model: &Model) -> Option<String> {
    let size = size(model);
    let units = [("mm", 1e-3), ("µm", 1e-6)];
    let meant = likely(size, &units, [1e-3, 20.0]);
    (size > LARGE).then(|| format!("the mechanism is {} m across{meant}", number(size)))
}

fn density(model: &Model) -> Option<String> {
    let of_body = |body: &Body| {
        let segments = body.segments.iter().map(|id| &model.segments()[id.0]);
        let mut outside = segments
            .filter_map(|segment| segment.material.density())
            // Zero is said to be: without mass.
            .filter(|&density| density != 0.0 && !(DENSITY[0]..=DENSITY[1]).contains(&density));
        outside.next().map(|density| [density, 0.0])
    };
    let found = first(
        model
            .bodies()
            .iter()
            .map(|body| (&*body.name, of_body(body))),
    )?;
    let [density, _] = found.values;
    let what = match density < DENSITY[0] {
        true => "lighter than any solid",
        false => "heavier than any solid",
    };
    let units = [
        ("g/cm³ (t/m³)", 1e3),
        ("kg/mm³", 1e9),
        ("t/mm³", 1e12),
        ("g/m³", 1e-3),
    ];
    let meant = likely(density, &units, [100.0, DENSITY[1]]);
    Some(format!(
        "the density of {} is {} kg/m³, {what}{meant}",
        found.parts(),
        number(density)
    ))
}

/// The unit in which a number would be one of a `range` in SI units, as a question.
fn likely(value: f64, units: &[(&str, f64)], range: [f64; 2]) -> String {
    let unit = units.iter().find(|(_, factor)| {
        let value = value * factor;
        (range[0]..=range[1]).contains(&value)
    });
    unit.map_or_else(String::new, |(unit, factor)| {
        format!(
            ": was it meant in {unit}? Then it is {} here",
            number(value * factor)
        )
    })
}

/// Beams that are thicker than long, by far.
fn thick(model: &Model) -> Option<String> {
    let of_body = |body: &Body| {
        let segments = body.segments.iter().map(|id| &model.segments()[id.0]);
        let length: f64 = lengths(model, body).sum();
        let thickness = segments
            .flat_map(|segment| {
                std::iter::once(&segment.section)
                    .chain(segment.taper.as_ref().map(|taper| &taper.to))
            })
            .map(sides)
            .filter(|[thin, wide]| match *thin < LEAF * length {
                true => *wide > WIDE * length,
                false => *wide > THICK * length,
            })
            .map(|[_, wide]| wide)
            .fold(0.0, f64::max);
        (thickness > 0.0 && length > 0.0).then_some([thickness, length])
    };
    let found = first(
        model
            .bodies()
            .iter()
            .map(|body| (&*body.name, of_body(body))),
    )?;
    let [thickness, length] = found.values;
    let meant = match length > thickness * 1e-3 * 0.2 {
        true => ": was the section meant in mm?",
        false => "",
    };
    Some(format!(
        "the section of {} is {} m across, and the beam {} m long{meant}",
        found.parts(),
        number(thickness),
        number(length)
    ))
}

/// Beams that are far too slender.
fn thin(model: &Model) -> Option<String> {
    let of_body = |body: &Body| {
        let segments = body.segments.iter().map(|id| &model.segments()[id.0]);
        let mut segments = segments.zip(lengths(model, body));
        segments.find_map(|(segment, length)| {
            let thickness = sides(&segment.section)[0];
            (length > THIN * thickness).then_some([length, thickness])
        })
    };
    let found = first(
        model
            .bodies()
            .iter()
            .map(|body| (&*body.name, of_body(body))),
    )?;
    let [length, thickness] = found.values;
    let meant = match length > 20.0 {
        true => "are the points in mm?",
        false => "a beam as slender as a wire hangs through and buckles",
    };
    Some(format!(
        "a segment of {} is {} m long and {} m thick: {meant}",
        found.parts(),
        number(length),
        number(thickness)
    ))
}

/// Lengths of a body's segments.
fn lengths<'m>(model: &'m Model, body: &'m Body) -> impl Iterator<Item = f64> + 'm {
    let positions = &model.geometry().positions;
    let segments = body.segments.iter().map(|id| &model.segments()[id.0]);
    segments.map(move |segment| {
        let [first, second] = segment.ends.map(|node| positions[node.0]);
        (second - first).norm()
    })
}

/// The shorter and the longer side of a section, or of the rectangle that bends like it.
fn sides(section: &Section) -> [f64; 2] {
    match *section.shape() {
        SectionShape::Circle { diameter } => [diameter; 2],
        SectionShape::Tube { outer, .. } => [outer; 2],
        SectionShape::Rectangle { width, height } => [width.min(height), width.max(height)],
        SectionShape::General { area, iy, iz, .. } => {
            let side = |moment: f64| (12.0 * moment / area).sqrt();
            [side(iy.min(iz)), side(iy.max(iz))]
        }
    }
}

/// Bearings that are softer than any: translations that the joint's kind holds. What frees some of
/// them is a spring, and may be as soft as it likes.
fn bearing(model: &Model) -> Option<String> {
    let size = size(model);
    let nodes = &model.load_set().nodes;
    let forces: f64 = nodes
        .iter()
        .map(|load| load.wrench.fixed_rows::<3>(0).norm())
        .sum();
    let plain = model.has_plain_loads() && model.cases().is_empty() && forces > 0.0;
    let soft = |stiffness: f64| {
        // Other loads than forces may be larger.
        let held = plain && forces < GIVES * size * stiffness;
        let scale = if size > 0.0 { size.min(1.0) } else { 1.0 };
        stiffness < BEARING * scale && !held
    };
    let of_joint = |joint: &Connection| {
        let free = joint.joint.free();
        let held = [Dof::X, Dof::Y, Dof::Z].map(|dof| (!free.contains(dof)).then(|| dof.index()));
        let held: Vec<usize> = held.into_iter().flatten().collect();
        let stiffness = |k: usize| match &joint.stiffness {
            JointStiffness::Directions(given) => given[k],
            JointStiffness::Matrix(matrix) => Some(matrix[(k, k)]),
        };
        let of_kind: Vec<f64> = held.iter().filter_map(|&k| stiffness(k)).collect();
        let constrained = Dof::ALL.into_iter().filter(|dof| !free.contains(*dof));
        let spring = constrained
            .map(|dof| stiffness(dof.index()))
            .any(|k| k == Some(0.0));
        let softest = of_kind.into_iter().fold(f64::INFINITY, f64::min);
        (!spring && soft(softest)).then_some([softest, 0.0])
    };
    let found = first(
        model
            .joints()
            .iter()
            .map(|joint| (&*joint.name, of_joint(joint))),
    )?;
    let [stiffness, _] = found.values;
    let units = [("N/µm", 1e6), ("N/mm", 1e3)];
    let meant = likely(stiffness, &units, [1e5, 1e10]);
    Some(format!(
        "the stiffness of {} in a direction that its kind holds is {} N/m, softer than a bearing or a \
         rubber bushing{meant}",
        found.parts(),
        number(stiffness)
    ))
}
