//! Hand-built models for the tests of this crate.

use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
use hyperstat_joints::{DofSet, Joint};
use hyperstat_model::{Connection, JointStiffness, Model, NodeId};
use nalgebra::{Matrix6, Point3, Rotation3, Vector6};

/// E = 210 GPa, ν = 0.3.
pub fn steel() -> Material {
    Material::new(2.1e11, Elasticity::Poisson(0.3), Some(7850.0)).unwrap()
}

pub fn circle(diameter: f64) -> Section {
    Section::new(SectionShape::Circle { diameter }, None, None).unwrap()
}

pub fn point(x: f64, y: f64, z: f64) -> Point3<f64> {
    Point3::new(x, y, z)
}

pub fn node(model: &Model, body: &str, at: &str) -> NodeId {
    model.node(body, at).unwrap()
}

/// A joint between two bodies (or `"ground"`) at a point, its frame global unless turned.
pub struct JointSpec {
    pub name: &'static str,
    pub at: &'static str,
    pub between: [&'static str; 2],
    pub joint: Box<dyn Joint>,
    pub frame: Rotation3<f64>,
    pub locked: bool,
    pub stiffness: JointStiffness,
}

impl JointSpec {
    pub fn new(
        name: &'static str,
        at: &'static str,
        between: [&'static str; 2],
        joint: impl Joint + 'static,
    ) -> Self {
        Self {
            name,
            at,
            between,
            joint: Box::new(joint),
            frame: Rotation3::identity(),
            locked: false,
            stiffness: JointStiffness::default(),
        }
    }

    pub fn frame(self, frame: Rotation3<f64>) -> Self {
        Self { frame, ..self }
    }

    pub fn locked(self) -> Self {
        Self {
            locked: true,
            ..self
        }
    }

    /// Stiffness of some directions, by index.
    pub fn springs(self, values: &[(usize, f64)]) -> Self {
        let mut directions = [None; 6];
        for &(direction, stiffness) in values {
            directions[direction] = Some(stiffness);
        }
        Self {
            stiffness: JointStiffness::Directions(directions),
            ..self
        }
    }

    pub fn matrix(self, stiffness: Matrix6<f64>) -> Self {
        Self {
            stiffness: JointStiffness::Matrix(stiffness),
            ..self
        }
    }

    pub fn add(self, model: &mut Model) {
        let end = |body: &str| (body != "ground").then(|| node(model, body, self.at));
        let connection = Connection {
            name: self.name.into(),
            between: self.between.map(end),
            locked: if self.locked {
                self.joint.free()
            } else {
                DofSet::EMPTY
            },
            joint: self.joint,
            stiffness: self.stiffness,
        };
        model.add_joint(connection, self.frame).unwrap();
    }
}

/// Largest |ΔK_ij| / √(K_ii K_jj).
pub fn stiffness_error(found: &Matrix6<f64>, expected: &Matrix6<f64>) -> f64 {
    let error = Matrix6::from_fn(|r, c| {
        (found[(r, c)] - expected[(r, c)]) / (expected[(r, r)] * expected[(c, c)]).sqrt()
    });
    error.amax()
}

/// Asserts that all components agree to `tolerance` of the largest of their kind (the first
/// three and the last three apart).
#[track_caller]
pub fn assert_close(found: &Vector6<f64>, expected: &Vector6<f64>, tolerance: f64) {
    for kind in [0, 3] {
        let (found, expected) = (found.fixed_rows::<3>(kind), expected.fixed_rows::<3>(kind));
        let error = (found - expected).amax();
        assert!(
            error <= tolerance * expected.amax(),
            "{found} is not {expected}"
        );
    }
}
