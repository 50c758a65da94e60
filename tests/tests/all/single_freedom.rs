//! Case study 1 against its closed form (Eqs. 53–55): springs and beams in line.

use hyperstat_assembly::solve;
use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
use hyperstat_mechanisms::prebuilt::{Prebuilt, SingleFreedom};
use hyperstat_tests::stiffness;
use proptest::prelude::*;
use std::f64::consts::PI;

const YOUNG: f64 = 2.1e11;

fn structure(
    lengths: (f64, f64),
    diameters: (f64, f64),
    joint_stiffness: (Option<f64>, Option<f64>),
) -> SingleFreedom {
    let circle = |diameter| Section::new(SectionShape::Circle { diameter }, None, None);
    SingleFreedom {
        lengths,
        sections: (
            circle(diameters.0).expect("a section"),
            circle(diameters.1).expect("a section"),
        ),
        material: Material::new(YOUNG, Elasticity::Poisson(0.3), None).expect("a material"),
        joint_stiffness,
    }
}

/// k = k₁ k_J1 / (k₁ + k_J1) + k₂ k_J2 / (k₂ + k_J2), with a rigid joint's share k₁ alone.
fn closed_form(
    lengths: (f64, f64),
    diameters: (f64, f64),
    joint_stiffness: (Option<f64>, Option<f64>),
) -> f64 {
    let arm = |length: f64, diameter: f64, joint: Option<f64>| {
        let beam = YOUNG * PI * diameter * diameter / 4.0 / length;
        joint.map_or(beam, |joint| 1.0 / (1.0 / beam + 1.0 / joint))
    };
    arm(lengths.0, diameters.0, joint_stiffness.0) + arm(lengths.1, diameters.1, joint_stiffness.1)
}

fn check(
    lengths: (f64, f64),
    diameters: (f64, f64),
    joint_stiffness: (Option<f64>, Option<f64>),
) -> f64 {
    let model = structure(lengths, diameters, joint_stiffness)
        .model(&[])
        .expect("a model");
    let k = stiffness(&solve(&model).expect("a solution"))[(0, 0)];
    let expected = closed_form(lengths, diameters, joint_stiffness);
    (k - expected).abs() / expected
}

#[test]
fn joints_from_soft_to_hard_and_rigid() {
    let (lengths, diameters) = ((0.4, 0.3), (0.02, 0.025));
    for exponent in 0..=18 {
        let k = 10.0_f64.powi(exponent);
        let difference = check(lengths, diameters, (Some(k), Some(3.0 * k)));
        assert!(difference < 1e-13, "k = 1e{exponent}: {difference:e}");
    }
    assert!(check(lengths, diameters, (None, None)) < 1e-14);
    assert!(check(lengths, diameters, (Some(2e7), None)) < 1e-14);
}

proptest! {
    #[test]
    fn any_size(
        lengths in (0.01..10.0, 0.01..10.0),
        diameters in (0.001..0.2, 0.001..0.2),
        k1 in proptest::option::of(0.0..18.0),
        k2 in proptest::option::of(0.0..18.0),
    ) {
        let joints = (k1.map(|e: f64| 10.0_f64.powf(e)), k2.map(|e: f64| 10.0_f64.powf(e)));
        prop_assert!(check(lengths, diameters, joints) < 1e-12);
    }
}
