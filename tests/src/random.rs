//! Random mechanisms of any topology: trees and loops of beams and rigid bodies, several joints at a
//! node, every kind, elastic, locked or free.

use hyperstat_assembly::{Connection, JointStiffness, Model, NodeId};
use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
use hyperstat_joints::{
    Cylindrical, Dof, DofSet, Fixed, Joint, Planar, Prismatic, Revolute, Screw, Spherical,
    Universal, frame_from_axes, frame_from_axis,
};
use nalgebra::{Matrix6, Point3, Rotation3, Vector3, Vector6};
use proptest::prelude::*;

use crate::runner::check_all;

/// What a random mechanism is made from.
#[derive(Debug, Clone)]
struct Recipe {
    points: Vec<[f64; 3]>,
    /// Rigid or not, and points by index.
    bodies: Vec<(bool, Vec<usize>)>,
    joints: Vec<JointRecipe>,
    loads: Vec<(usize, [f64; 6])>,
}

#[derive(Debug, Clone)]
struct JointRecipe {
    kind: usize,
    /// Which pair of nodes at one point, or which node with the ground.
    place: usize,
    grounded: bool,
    swapped: bool,
    axis: [f64; 3],
    second_axis: [f64; 3],
    locked: u8,
    /// Per direction: none, or a stiffness exponent between 0 and 1.
    stiffness: [Option<f64>; 6],
    matrix: bool,
}

fn direction() -> impl Strategy<Value = [f64; 3]> {
    prop_oneof![
        Just([1.0, 0.0, 0.0]),
        Just([0.0, 1.0, 0.0]),
        Just([0.0, 0.0, 1.0]),
        [-1.0..1.0, -1.0..1.0, 0.1..1.0],
    ]
}

fn joint() -> impl Strategy<Value = JointRecipe> {
    let elastic = proptest::option::weighted(0.35, 0.0..1.0);
    let springs = prop_oneof![
        2 => Just([None; 6]).boxed(),
        1 => proptest::array::uniform6(elastic).boxed(),
    ];
    (
        (
            0usize..8,
            any::<usize>(),
            proptest::bool::weighted(0.3),
            any::<bool>(),
        ),
        (direction(), direction()),
        (
            prop_oneof![2 => Just(0u8), 1 => any::<u8>()],
            springs,
            proptest::bool::weighted(0.1),
        ),
    )
        .prop_map(
            |((kind, place, grounded, swapped), (axis, second_axis), rest)| JointRecipe {
                kind,
                place,
                grounded,
                swapped,
                axis,
                second_axis,
                locked: rest.0,
                stiffness: rest.1,
                matrix: rest.2,
            },
        )
}

/// Recipes of mechanisms of any topology.
fn recipes() -> impl Strategy<Value = Recipe> {
    let coordinate = || prop_oneof![-1.0..1.0, Just(0.0), Just(0.5)];
    let point = [coordinate(), coordinate(), coordinate()];
    let body = (any::<bool>(), proptest::collection::vec(0usize..6, 1..5));
    let wrench = proptest::array::uniform6(-10.0..10.0);
    (
        proptest::collection::vec(point, 6),
        proptest::collection::vec(body, 1..7),
        proptest::collection::vec(joint(), 1..14),
        proptest::collection::vec((any::<usize>(), wrench), 1..4),
    )
        .prop_map(|(points, bodies, joints, loads)| Recipe {
            points,
            bodies,
            joints,
            loads,
        })
}

fn kind(recipe: &JointRecipe) -> Option<(Box<dyn Joint>, Rotation3<f64>)> {
    let axis = Vector3::from(recipe.axis);
    let about = frame_from_axis(Some(&axis), None).ok()?;
    let joint: Box<dyn Joint> = match recipe.kind {
        0 => Box::new(Fixed),
        1 => Box::new(Revolute),
        2 => Box::new(Prismatic),
        3 => Box::new(Cylindrical),
        4 => Box::new(Screw::new(0.05).ok()?),
        5 => {
            let frame = frame_from_axes(&axis, &Vector3::from(recipe.second_axis)).ok()?;
            return Some((Box::new(Universal), frame));
        }
        6 => Box::new(Spherical),
        _ => Box::new(Planar),
    };
    Some((joint, about))
}

/// The mechanism of a recipe; `None` where the recipe makes none.
fn mechanism(recipe: &Recipe) -> Option<Model> {
    let mut model = Model::new("random");
    let material = Material::new(2e11, Elasticity::Poisson(0.3), Some(7850.0)).ok()?;
    let material = material.with_expansion(1.2e-5).ok()?;
    let shape = SectionShape::Rectangle {
        width: 0.03,
        height: 0.05,
    };
    let section = Section::new(shape, Some(8e-4), None).ok()?;
    for (k, (rigid, through)) in recipe.bodies.iter().enumerate() {
        let mut through = through.clone();
        let mut seen = Vec::new();
        through.retain(|p| {
            !seen.contains(p) && {
                seen.push(*p);
                true
            }
        });
        let names: Vec<String> = through.iter().map(|p| format!("p{p}")).collect();
        let points: Vec<(&str, Point3<f64>)> = through
            .iter()
            .zip(&names)
            .map(|(p, name)| (name.as_str(), Point3::from(recipe.points[*p])))
            .collect();
        let name = format!("b{k}");
        if *rigid {
            model.add_rigid(&name, &points).ok()?;
        } else {
            if points.windows(2).any(|w| (w[1].1 - w[0].1).norm() < 0.05) {
                return None;
            }
            model
                .add_beam(&name, &points, &material, &section, None, 1)
                .ok()?;
        }
    }
    let nodes = model.nodes();
    let mut pairs: Vec<[Option<NodeId>; 2]> = Vec::new();
    for a in 0..nodes.len() {
        for b in 0..a {
            if nodes[a].point == nodes[b].point {
                pairs.push([Some(NodeId(b)), Some(NodeId(a))]);
            }
        }
    }
    let count = nodes.len();
    for (k, joint) in recipe.joints.iter().enumerate() {
        let (kind, frame) = kind(joint)?;
        let mut between = if joint.grounded || pairs.is_empty() {
            [None, Some(NodeId(joint.place % count))]
        } else {
            pairs[joint.place % pairs.len()]
        };
        if joint.swapped {
            between.swap(0, 1);
        }
        let bits = |d: &Dof| joint.locked & (1 << d.index()) != 0;
        let locked: DofSet = kind.free().iter().filter(bits).collect();
        let scale = |d: usize| if d < 3 { 8.0 } else { 5.0 };
        let values: [Option<f64>; 6] = std::array::from_fn(|d| {
            joint.stiffness[d].map(|e| 10.0_f64.powf(scale(d) - 2.0 + 3.0 * e))
        });
        let stiffness = if joint.matrix {
            // Some coupling, positive definite.
            let k = |d: usize| values[d].unwrap_or(10.0_f64.powf(scale(d)));
            JointStiffness::Matrix(Matrix6::from_fn(|r, c| {
                let s = (k(r) * k(c)).sqrt();
                if r == c { s } else { 0.1 * s }
            }))
        } else {
            JointStiffness::Directions(values)
        };
        let connection = Connection {
            name: format!("j{k}"),
            between,
            joint: kind,
            locked,
            stiffness,
        };
        model.add_joint(connection, frame).ok()?;
    }
    for (node, wrench) in &recipe.loads {
        let wrench = Vector6::from_column_slice(wrench);
        model.add_load(NodeId(node % count), wrench).ok()?;
    }
    model.set_output(NodeId(0));
    Some(model)
}

/// Runs `check` over random mechanisms, each with a value of `extra`: 300 of them, or as many as
/// the environment's `HYPERSTAT_RANDOM_CASES` says. `check` tells whether the case counts.
///
/// # Panics
/// With the smallest mechanism that `check` found an error in; where fewer than a tenth count.
pub fn check_random_mechanisms<T: std::fmt::Debug>(
    extra: impl Strategy<Value = T>,
    check: impl Fn(&Model, T) -> Result<bool, TestCaseError>,
) {
    let cases = std::env::var("HYPERSTAT_RANDOM_CASES")
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(300);
    let counted = check_all(
        cases,
        (recipes(), extra),
        |(recipe, extra)| match mechanism(&recipe) {
            Some(model) => check(&model, extra),
            None => Err(TestCaseError::reject("no mechanism")),
        },
    );
    assert!(counted > cases / 10, "only {counted} of {cases} count");
}
