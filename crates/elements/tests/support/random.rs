//! Random beams, frames and joint compliances for proptest.

use hyperstat_elements::subassembly::ElasticJoint;
use hyperstat_elements::{
    Beam, Elasticity, Material, Section, SectionShape, element_frame, rotate_matrix6,
};
use nalgebra::{Matrix6, Rotation3, Vector3, Vector6};
use proptest::prelude::*;

pub fn steel() -> Material {
    Material::new(2.1e11, Elasticity::Poisson(0.3), Some(7850.0)).unwrap()
}

pub fn direction() -> impl Strategy<Value = Vector3<f64>> {
    [-1.0..1.0, -1.0..1.0, -1.0..1.0f64]
        .prop_map(Vector3::from)
        .prop_filter("a direction", |v| v.norm() > 0.1)
}

pub fn rotation() -> impl Strategy<Value = Rotation3<f64>> {
    (direction(), 0.0..3.2).prop_map(|(axis, angle)| Rotation3::new(axis.normalize() * angle))
}

pub fn displacement() -> impl Strategy<Value = Vector6<f64>> {
    [
        -1.0..1.0,
        -1.0..1.0,
        -1.0..1.0,
        -1.0..1.0,
        -1.0..1.0,
        -1.0..1.0f64,
    ]
    .prop_map(Vector6::from)
}

fn shear_area() -> impl Strategy<Value = Option<f64>> {
    proptest::option::of(1e-5..1e-3)
}

/// Beams of every shape, Euler–Bernoulli and Timoshenko.
pub fn beam() -> impl Strategy<Value = Beam> {
    let shape = prop_oneof![
        (0.005..0.05).prop_map(|diameter| SectionShape::Circle { diameter }),
        (0.01..0.05, 0.0..0.95).prop_map(|(outer, part)| SectionShape::Tube {
            outer,
            inner: outer * part
        }),
        (0.005..0.05, 0.005..0.05)
            .prop_map(|(width, height)| SectionShape::Rectangle { width, height }),
        (1e-5..1e-3, 1e-9..1e-7, 1e-9..1e-7, 1e-9..1e-7).prop_map(|(area, iy, iz, torsion)| {
            SectionShape::General {
                area,
                iy,
                iz,
                torsion,
                y_max: None,
                z_max: None,
                torsion_modulus: None,
            }
        }),
    ];
    (shape, shear_area(), shear_area(), 0.05..1.0).prop_map(|(shape, y, z, length)| {
        Beam::new(&steel(), &Section::new(shape, y, z).unwrap(), length).unwrap()
    })
}

/// A beam of a chain and its direction.
#[derive(Debug, Clone)]
pub struct Link {
    pub beam: Beam,
    pub frame: Rotation3<f64>,
}

impl Link {
    pub fn span(&self) -> Vector3<f64> {
        self.frame * self.beam.span()
    }

    pub fn compliance(&self) -> Matrix6<f64> {
        let turned = rotate_matrix6(&self.beam.cantilever_compliance(), &self.frame);
        (turned + turned.transpose()) * 0.5
    }

    pub fn stiffness(&self) -> Matrix6<f64> {
        let turned = rotate_matrix6(&self.beam.cantilever_stiffness(), &self.frame);
        (turned + turned.transpose()) * 0.5
    }
}

/// Chains of one to three links in any directions.
pub fn chain() -> impl Strategy<Value = Vec<Link>> {
    let link = (beam(), direction()).prop_map(|(beam, along)| Link {
        beam,
        frame: element_frame(&along, None).unwrap(),
    });
    proptest::collection::vec(link, 1..4)
}

/// An elastic joint, turned or not: some directions rigid, the others with a stiffness between
/// 10^`softest` and 1e12 N/m, a hundredth of that in N·m/rad.
pub fn joint(softest: f64, turned: bool) -> impl Strategy<Value = ElasticJoint> {
    let exponents = proptest::array::uniform6(proptest::option::of(softest..12.0));
    (exponents, rotation()).prop_map(move |(exponents, frame)| {
        let compliance = |d: usize| {
            let unit: f64 = if d < 3 { 1.0 } else { 1e2 };
            exponents[d].map_or(0.0, |e: f64| unit / 10f64.powf(e))
        };
        ElasticJoint {
            compliance: Matrix6::from_diagonal(&Vector6::from_fn(|d, _| compliance(d))),
            frame: if turned { frame } else { Rotation3::identity() },
        }
    })
}

/// A chain and one elastic joint for each of its nodes.
pub fn jointed_chain(
    softest: f64,
    turned: bool,
) -> impl Strategy<Value = (Vec<Link>, Vec<ElasticJoint>)> {
    chain().prop_flat_map(move |links| {
        let joints = proptest::collection::vec(joint(softest, turned), links.len() + 1);
        (Just(links), joints)
    })
}
