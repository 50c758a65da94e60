//! Random beams, frames and joint compliances for proptest.

use hyperstat_elements::subassembly::ElasticJoint;
use hyperstat_elements::{
    Beam, BeamLoad, Elasticity, Material, Section, SectionShape, Taper, TaperedBeam,
    TemperatureChange, element_frame, rotate_matrix6,
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

/// The sections at the two ends of a tapered beam, of every kind.
pub fn section_ends() -> impl Strategy<Value = (Section, Section)> {
    let size = || 0.003..0.1;
    let shear = proptest::option::of(0.4..0.9);
    prop_oneof![
        (size(), size()).prop_map(|(a, b)| (circle(a), circle(b))),
        (size(), size(), 0.0..0.99, 0.0..0.99).prop_map(|(a, b, p, q)| {
            let tube = |outer: f64, part: f64| SectionShape::Tube {
                outer,
                inner: part * outer,
            };
            let section = |shape| Section::new(shape, None, None).unwrap();
            (section(tube(a, p)), section(tube(b, q)))
        }),
        ([size(), size(), size(), size()], shear).prop_map(|([a, b, c, d], shear)| (
            rectangle(a, b, shear),
            rectangle(c, d, shear.map(|s| 0.7 * s))
        )),
        (size(), size(), 0.5..2.0).prop_map(|(a, b, p)| {
            let section = |d: f64, p: f64| {
                let shape = SectionShape::General {
                    area: d * d,
                    iy: d.powi(4) / 12.0,
                    iz: p * d.powi(4) / 10.0,
                    torsion: d.powi(4) / 7.0,
                    y_max: None,
                    z_max: None,
                    torsion_modulus: None,
                };
                Section::new(shape, Some(0.8 * d * d), None).unwrap()
            };
            (section(a, 1.0), section(b, p))
        }),
    ]
}

pub fn circle(diameter: f64) -> Section {
    Section::new(SectionShape::Circle { diameter }, None, None).unwrap()
}

/// A rectangle with effective shear areas of this part of its area along both axes.
pub fn rectangle(width: f64, height: f64, shear: Option<f64>) -> Section {
    let area = shear.map(|ratio| ratio * width * height);
    Section::new(SectionShape::Rectangle { width, height }, area, area).unwrap()
}

/// Tapered beams of steel.
pub fn tapered_beam() -> impl Strategy<Value = TaperedBeam> {
    (section_ends(), 0.05..1.0).prop_map(|((from, to), length)| {
        TaperedBeam::new(&steel(), &Taper::new(from, to).unwrap(), length).unwrap()
    })
}

/// A distributed load of quadratic forces and moments, and a free strain of temperature.
pub fn load() -> impl Strategy<Value = BeamLoad> {
    let change = [-50.0..50.0, -2e3..2e3, -2e3..2e3f64];
    let controls = [displacement(), displacement(), displacement()];
    (controls, change).prop_map(|(controls, [uniform, gradient_y, gradient_z])| {
        let change = TemperatureChange {
            uniform,
            gradient_y,
            gradient_z,
        };
        BeamLoad::quadratic(controls.map(|c| c * 1e3)) + BeamLoad::temperature(1.2e-5, &change)
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
