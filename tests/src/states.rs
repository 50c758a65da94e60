//! Random loads and states for any mechanism: weight, masses, temperatures, loads along beams and
//! in axes that turn, cases; and other sections and elements for its beams.

use hyperstat_assembly::{
    Axes, BodyId, BodyKind, LineLoad, Load, LoadCase, LoadSet, Member, Model, NodeId, SegmentId,
    Tapering,
};
use hyperstat_elements::{Elasticity, Material, RigidMass, Section, SectionShape};
use nalgebra::{Rotation3, Vector3, Vector6};
use proptest::prelude::*;

use crate::rebuilt_with;

/// What acts, with places by index, taken around where a mechanism has fewer.
#[derive(Debug, Clone)]
pub struct Acting {
    gravity: [f64; 3],
    temperatures: Vec<f64>,
    masses: Vec<(usize, f64)>,
    loads: Loads,
    cases: Vec<Loads>,
}

#[derive(Debug, Clone)]
struct Loads {
    nodes: Vec<(usize, [f64; 6], Turned)>,
    lines: Vec<(usize, [[f64; 6]; 2], Turned)>,
}

/// The body whose axes they are, and how these are turned from the global ones; none: global.
type Turned = Option<(usize, [f64; 3])>;

/// Other sections and elements for beams, by index.
#[derive(Debug, Clone)]
pub struct Beams {
    /// Scale of the section at the second node.
    tapers: Vec<Option<f64>>,
    elements: Vec<usize>,
}

/// Loads and states of every sort.
pub fn acting() -> impl Strategy<Value = Acting> {
    let gravity = prop_oneof![
        1 => Just([0.0; 3]),
        2 => proptest::array::uniform3(-10.0..10.0),
    ];
    let temperature = prop_oneof![Just(0.0), -50.0..50.0];
    (
        gravity,
        proptest::collection::vec(temperature, 1..5),
        proptest::collection::vec((any::<usize>(), 0.0..5.0), 0..3),
        loads(),
        proptest::collection::vec(loads(), 0..3),
    )
        .prop_map(|(gravity, temperatures, masses, loads, cases)| Acting {
            gravity,
            temperatures,
            masses,
            loads,
            cases,
        })
}

fn loads() -> impl Strategy<Value = Loads> {
    let turned = || {
        let turn = (any::<usize>(), proptest::array::uniform3(-2.0..2.0));
        proptest::option::weighted(0.3, turn)
    };
    let wrench = || proptest::array::uniform6(-50.0..50.0);
    let ends = proptest::array::uniform2(wrench());
    let nodes = proptest::collection::vec((any::<usize>(), wrench(), turned()), 0..3);
    let lines = proptest::collection::vec((any::<usize>(), ends, turned()), 0..3);
    (nodes, lines).prop_map(|(nodes, lines)| Loads { nodes, lines })
}

/// Other beams.
pub fn beams() -> impl Strategy<Value = Beams> {
    let taper = proptest::option::weighted(0.4, 0.6..1.5);
    (
        proptest::collection::vec(taper, 1..6),
        proptest::collection::vec(1usize..4, 1..6),
    )
        .prop_map(|(tapers, elements)| Beams { tapers, elements })
}

impl Acting {
    /// Puts all of it on a mechanism in place of what acts there.
    ///
    /// # Panics
    /// Where beams have no density or no coefficient of expansion.
    pub fn put_on(&self, model: &mut Model) {
        let set = self.loads.set(model);
        model.set_loads(set).expect("loads");
        model.clear_cases();
        for (k, case) in self.cases.iter().enumerate() {
            let loads = case.set(model);
            let name = format!("case {k}");
            model.add_case(LoadCase { name, loads }).expect("a case");
        }
        model.clear_masses();
        for (node, mass) in &self.masses {
            let node = NodeId(node % model.nodes().len());
            model.add_mass(node, RigidMass::point(*mass).expect("a mass"));
        }
        model.set_gravity(self.gravity.into()).expect("gravity");
        let elastic = |k: &usize| model.bodies()[*k].kind == BodyKind::Elastic;
        let elastic: Vec<usize> = (0..model.bodies().len()).filter(elastic).collect();
        for body in elastic {
            let change = self.temperatures[body % self.temperatures.len()];
            let set = model.set_temperature(BodyId(body), change);
            set.expect("a temperature");
        }
    }
}

impl Loads {
    fn set(&self, model: &Model) -> LoadSet {
        let nodes = self.nodes.iter().map(|(node, wrench, turned)| Load {
            node: NodeId(node % model.nodes().len()),
            wrench: Vector6::from_column_slice(wrench),
            axes: axes(model, turned),
        });
        let segments = model.segments().len();
        let lines = self.lines.iter().filter(|_| segments > 0);
        let lines = lines.map(|(segment, ends, turned)| LineLoad {
            segment: SegmentId(segment % segments),
            ends: ends.map(|end| Vector6::from_column_slice(&end)),
            axes: axes(model, turned),
        });
        LoadSet {
            nodes: nodes.collect(),
            lines: lines.collect(),
        }
    }
}

fn axes(model: &Model, turned: &Turned) -> Axes {
    let body = turned.map(|(body, turn)| (BodyId(body % model.bodies().len()), turn));
    let framed = body.and_then(|(body, turn)| Some((body, turn, model.body_frame(body)?)));
    match framed {
        Some((body, turn, now)) => Axes::Body {
            body,
            home: Rotation3::from_scaled_axis(Vector3::from(turn)).inverse() * now,
        },
        None => Axes::Global,
    }
}

impl Beams {
    /// A mechanism with these beams, of materials with density and expansion.
    ///
    /// # Panics
    /// Where the mechanism cannot be built.
    pub fn instead_of(&self, model: &Model) -> Model {
        let member = |k: usize, member: Member| {
            let old = &member.material;
            let density = old.density().unwrap_or(2700.0);
            let shear = Elasticity::Shear(old.shear());
            let material = Material::new(old.young(), shear, Some(density))
                .and_then(|material| material.with_expansion(1.2e-5))
                .expect("a material");
            let scale = self.tapers[k % self.tapers.len()];
            Member {
                material,
                taper: scale
                    .and_then(|scale| scaled(&member.section, scale))
                    .map(Tapering::whole),
                elements: self.elements[k % self.elements.len()],
                ..member
            }
        };
        rebuilt_with(model, |_, joint| joint.clone(), member)
    }
}

/// A section of the same shape, of another size; `None` for general ones.
fn scaled(section: &Section, scale: f64) -> Option<Section> {
    let shape = match *section.shape() {
        SectionShape::Circle { diameter } => SectionShape::Circle {
            diameter: scale * diameter,
        },
        SectionShape::Tube { outer, inner } => SectionShape::Tube {
            outer: scale * outer,
            inner: scale * inner,
        },
        // One side alone: where it was a square, it is none any more.
        SectionShape::Rectangle { width, height } => SectionShape::Rectangle {
            width,
            height: scale * height,
        },
        _ => return None,
    };
    let area = |own: Option<f64>| own.map(|own| own * scale);
    Section::new(shape, area(section.shear_y()), area(section.shear_z())).ok()
}
