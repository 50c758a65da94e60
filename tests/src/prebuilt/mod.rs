//! The prebuilt mechanisms under test, and what holds for all of them.

mod checks;
mod files;
pub mod legs;
pub mod links;

use hyperstat_assembly::{Model, Solution, solve};
use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
use hyperstat_mechanisms::prebuilt::{Link, Prebuilt};
use nalgebra::{Point3, Vector6};
use proptest::prelude::*;

pub use checks::{
    assert_counts, assert_refused, assert_solved_as_by_reference, check_loops_close,
    check_place_is_model,
};
pub use files::{assert_batch_reads, assert_book_is_read, assert_example_is_prebuilt};

/// Loops close to rounding.
pub const CLOSED: f64 = 1e-12;

/// Displacements (m, rad) below this are zero to rounding under the loads here.
const FLOOR: [f64; 2] = [1e-9; 2];

/// Elastic joints, each direction with another stiffness.
pub const BEARINGS: [Option<f64>; 6] =
    [Some(1e8), Some(2e8), Some(3e8), Some(1e5), None, Some(2e5)];

/// A mechanism with some of its poses and the counts that the literature gives it.
pub struct Case {
    /// The mechanism.
    pub mechanism: Box<dyn Prebuilt>,
    /// Some poses in its reach.
    pub poses: Vec<Vec<f64>>,
    /// A pose about which all others are in reach, coordinate by coordinate as far as `span`.
    pub middle: Vec<f64>,
    /// See `middle`.
    pub span: Vec<f64>,
    /// Mobility, degree of over-constraint and idle motions.
    pub counts: [usize; 3],
}

impl Case {
    /// The pose at these places between −1 and 1 of the ranges in reach.
    pub fn pose(&self, unit: &[f64; 6]) -> Vec<f64> {
        let ranges = self.middle.iter().zip(&self.span);
        let places = ranges.zip(unit);
        places.map(|((c, s), u)| c + s * u).collect()
    }

    /// What and where, for messages.
    pub fn what(&self, pose: &[f64]) -> String {
        format!("{} {pose:?}", self.mechanism.kind())
    }
}

/// The number of one of `cases` and a pose in its reach.
pub fn posed(cases: fn() -> Vec<Case>) -> impl Strategy<Value = (usize, Vec<f64>)> {
    (0..cases().len(), prop::array::uniform6(-1.0..1.0_f64))
        .prop_map(move |(index, unit)| (index, cases()[index].pose(&unit)))
}

fn link(shape: SectionShape) -> Link {
    Link {
        section: Section::new(shape, None, None).expect("a valid section"),
        material: Material::new(2.1e11, Elasticity::Poisson(0.3), None).expect("steel"),
    }
}

/// A round link of steel.
///
/// # Panics
/// Where the diameter (m) is out of its range.
pub fn round(diameter: f64) -> Link {
    link(SectionShape::Circle { diameter })
}

/// A tube of steel.
///
/// # Panics
/// Where a diameter (m) is out of its range.
pub fn tube(outer: f64, inner: f64) -> Link {
    link(SectionShape::Tube { outer, inner })
}

/// A section that is not alike in all directions, so that a wrong local y shows.
///
/// # Panics
/// Where a size (m) is out of its range.
pub fn flat(width: f64, height: f64) -> Link {
    link(SectionShape::Rectangle { width, height })
}

/// The mechanism in a pose, with a load on its output.
///
/// # Panics
/// Where the pose is out of reach.
pub fn loaded(mechanism: &dyn Prebuilt, pose: &[f64]) -> Model {
    let mut model = mechanism
        .model(pose)
        .unwrap_or_else(|error| panic!("{} {pose:?}: {error}", mechanism.kind()));
    let output = model.output().expect("an output");
    let wrench = Vector6::new(-20.0, 10.0, 100.0, 5.0, 5.0, 8.0);
    model.add_load(output, wrench).expect("a finite load");
    model
}

/// The solution of [`loaded`].
///
/// # Panics
/// Where there is none.
pub fn solved(mechanism: &dyn Prebuilt, pose: &[f64]) -> Solution {
    let model = loaded(mechanism, pose);
    solve(&model).unwrap_or_else(|error| panic!("{} {pose:?}: {error}", mechanism.kind()))
}

/// Position of a point of a body (m).
///
/// # Panics
/// Where there is no such point.
pub fn position(model: &Model, body: &str, point: &str) -> Point3<f64> {
    let node = crate::build::node(model, body, point);
    model.geometry().positions[node.0]
}
