//! Shared parts of the tests: reference results, models made from models, measures of agreement.

pub mod acted;
pub mod agreement;
pub mod build;
pub mod extended;
pub mod gripper;
pub mod lattice;
pub mod networks;
pub mod prebuilt;
pub mod random;
pub mod runner;
pub mod sketches;
pub mod states;

use std::path::{Path, PathBuf};

use hyperstat_assembly::{BodyKind, Connection, Geometry, Member, Model, Solution};
use nalgebra::{Matrix6, Point3, Rotation3, Vector3, Vector6};

/// Folder of the reference mechanisms and results (see its README).
pub fn reference_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("reference")
}

/// Text of a reference file.
///
/// # Panics
/// Where the file cannot be read.
pub fn reference_text(file: &str) -> String {
    let path = reference_folder().join(file);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Largest |ΔK_ij| / √(K_ii K_jj).
pub fn stiffness_difference(found: &Matrix6<f64>, expected: &Matrix6<f64>) -> f64 {
    let mut largest = 0.0_f64;
    for r in 0..6 {
        for c in 0..6 {
            let scale = (expected[(r, r)] * expected[(c, c)]).sqrt();
            largest = largest.max((found[(r, c)] - expected[(r, c)]).abs() / scale);
        }
    }
    largest
}

/// Largest difference of translations or forces (first) and of rotations or moments (second),
/// each relative to the largest expected of its kind; a kind whose expected values are all below
/// `floor` is compared with `floor`.
pub fn vector_differences<'a>(
    pairs: impl IntoIterator<Item = (&'a Vector6<f64>, &'a Vector6<f64>)>,
    floor: [f64; 2],
) -> [f64; 2] {
    let (mut largest, mut scale) = ([0.0_f64; 2], floor);
    for (found, expected) in pairs {
        for k in 0..6 {
            largest[k / 3] = largest[k / 3].max((found[k] - expected[k]).abs());
            scale[k / 3] = scale[k / 3].max(expected[k].abs());
        }
    }
    [largest[0] / scale[0], largest[1] / scale[1]]
}

/// The output stiffness of a solution that has one.
///
/// # Panics
/// Where it has none.
pub fn stiffness(solution: &Solution) -> Matrix6<f64> {
    solution
        .output
        .stiffness
        .expect("the output has a stiffness")
}

/// A model made anew from another: every joint through `joint`, the configuration as it is.
///
/// # Panics
/// Where the new model cannot be built.
pub fn rebuilt(model: &Model, joint: impl Fn(usize, &Connection) -> Connection) -> Model {
    rebuilt_with(model, joint, |_, member| member)
}

/// The same with every segment through `member`.
///
/// # Panics
/// Where the new model cannot be built.
pub fn rebuilt_with(
    model: &Model,
    joint: impl Fn(usize, &Connection) -> Connection,
    member: impl Fn(usize, Member) -> Member,
) -> Model {
    let mut new = Model::new(model.name.clone());
    let geometry = model.geometry();
    for body in model.bodies() {
        let points: Vec<(&str, Point3<f64>)> = body
            .nodes
            .iter()
            .map(|n| (model.nodes()[n.0].point.as_str(), geometry.positions[n.0]))
            .collect();
        match body.kind {
            BodyKind::Rigid => new.add_rigid(&body.name, &points).expect("a rigid body"),
            BodyKind::Flexible => {
                let flexible = body.flexible.expect("its stiffness");
                let home = geometry.rotations[flexible.0].inverse();
                let points: Vec<_> = points.iter().map(|(name, p)| (*name, home * p)).collect();
                let stiffness = model.flexibles()[flexible.0].element.stiffness();
                new.add_flexible(&body.name, &points, stiffness)
                    .expect("a flexible body")
            }
            BodyKind::Elastic => {
                let place = |node| {
                    body.nodes
                        .iter()
                        .position(|n| *n == node)
                        .expect("own node")
                };
                let members: Vec<Member> = body
                    .segments
                    .iter()
                    .map(|s| {
                        let segment = &model.segments()[s.0];
                        let same = Member {
                            ends: segment.ends.map(place),
                            material: segment.material.clone(),
                            section: segment.section.clone(),
                            taper: segment.taper.clone(),
                            y_axis: geometry.y_axes[s.0],
                            elements: segment.elements,
                        };
                        member(s.0, same)
                    })
                    .collect();
                new.add_elastic(&body.name, &points, &members)
                    .expect("an elastic body")
            }
        };
    }
    for (k, entry) in model.joints().iter().enumerate() {
        new.add_joint(joint(k, entry), geometry.frames[k])
            .expect("a joint");
    }
    for load in model.loads() {
        new.add_load(load.node, load.wrench).expect("a load");
    }
    for entry in model.misfits() {
        new.set_misfit(entry.joint, &entry.misfit)
            .expect("a misfit");
        new.set_preload(entry.joint, &entry.preload)
            .expect("a preload");
    }
    if let Some(output) = model.output() {
        new.set_output(output);
    }
    new.set_geometry(geometry.clone())
        .expect("a geometry of this model");
    new
}

/// The whole mechanism turned by `rotation` about the origin, then moved by `translation`.
///
/// # Panics
/// Never for a model that could be built.
pub fn moved(model: &Model, rotation: &Rotation3<f64>, translation: &Vector3<f64>) -> Model {
    let old = model.geometry();
    let mut new = model.clone();
    new.set_geometry(Geometry {
        positions: old
            .positions
            .iter()
            .map(|p| rotation * p + translation)
            .collect(),
        y_axes: old.y_axes.iter().map(|y| y.map(|y| rotation * y)).collect(),
        frames: old.frames.iter().map(|f| rotation * f).collect(),
        rotations: old.rotations.iter().map(|r| rotation * r).collect(),
    })
    .expect("a geometry of this model");
    new.clear_loads();
    for load in model.loads() {
        let wrench = turned(rotation, &load.wrench);
        new.add_load(load.node, wrench).expect("a finite load");
    }
    new
}

/// A wrench or twist in turned axes.
pub fn turned(rotation: &Rotation3<f64>, v: &Vector6<f64>) -> Vector6<f64> {
    let linear = rotation * Vector3::new(v[0], v[1], v[2]);
    let angular = rotation * Vector3::new(v[3], v[4], v[5]);
    Vector6::new(
        linear[0], linear[1], linear[2], angular[0], angular[1], angular[2],
    )
}

/// A 6×6 matrix in turned axes.
pub fn turned_matrix(rotation: &Rotation3<f64>, k: &Matrix6<f64>) -> Matrix6<f64> {
    let mut t = Matrix6::zeros();
    t.fixed_view_mut::<3, 3>(0, 0).copy_from(rotation.matrix());
    t.fixed_view_mut::<3, 3>(3, 3).copy_from(rotation.matrix());
    t * k * t.transpose()
}
