//! Beams whose section changes along them: closed forms, prismatic limits, parts and curves.

use crate::support;

use std::f64::consts::PI;

use hyperstat_elements::subassembly::{ChainSegment, chain_flexibility};
use hyperstat_elements::{
    Beam, Elasticity, ElementError, Material, Section, SectionShape, Taper, TaperedBeam,
    rotate_matrix6,
};
use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3, Vector6};
use proptest::prelude::*;

use support::random::{self, circle, rectangle};

const YOUNG: f64 = 2.1e11;
const SHEAR: f64 = 8e10;

fn steel() -> Material {
    Material::new(YOUNG, Elasticity::Shear(SHEAR), None).unwrap()
}

fn beam(from: Section, to: Section, length: f64) -> TaperedBeam {
    TaperedBeam::new(&steel(), &Taper::new(from, to).unwrap(), length).unwrap()
}

fn near(value: f64, expected: f64) {
    let error = (value / expected - 1.0).abs();
    assert!(error < 1e-13, "{value} is {error:e} off {expected}");
}

/// Largest |ΔM_ij| / √(M_ii M_jj).
fn difference(found: &Matrix6<f64>, expected: &Matrix6<f64>) -> f64 {
    let off = |i: usize, j: usize| {
        let scale = (expected[(i, i)] * expected[(j, j)]).sqrt();
        (found[(i, j)] - expected[(i, j)]).abs() / scale
    };
    (0..36).map(|e| off(e / 6, e % 6)).fold(0.0, f64::max)
}

/// A bar whose diameter changes linearly from d1 to d2 = r d1, held at its first end. With
/// I1 = π d1⁴/64 and A1 = π d1²/4 the integrals of x'^k / d⁴ are elementary: u = 4 F L / (π E d1 d2),
/// θ = 32 T L (d1² + d1 d2 + d2²) / (3 π G d1³ d2³), v = F L³ / (3 E I1 r) (at the free end, by a
/// force), slope F L² (2 r + 1) / (6 E I1 r²), by a moment M L (1 + r + r²) / (3 E I1 r³).
#[test]
fn round_bars_with_a_linear_diameter_follow_the_closed_form() {
    for (d1, d2) in [(0.03, 0.02), (0.01, 0.09), (0.05, 0.0004), (0.02, 0.02)] {
        let length = 0.7;
        let c = beam(circle(d1), circle(d2), length).cantilever_compliance();
        let r: f64 = d2 / d1;
        let inertia = PI * d1.powi(4) / 64.0;
        let [a1, a2] = [d1, d2].map(|d: f64| PI * d * d / 4.0);
        near(c[(0, 0)], length / (YOUNG * (a1 * a2).sqrt()));
        let twist = 32.0 * length * (d1 * d1 + d1 * d2 + d2 * d2);
        near(c[(3, 3)], twist / (3.0 * PI * SHEAR * (d1 * d2).powi(3)));
        let force = length.powi(3) / (3.0 * YOUNG * inertia * r);
        let slope = length.powi(2) * (2.0 * r + 1.0) / (6.0 * YOUNG * inertia * r * r);
        let turn = length * (1.0 + r + r * r) / (3.0 * YOUNG * inertia * r.powi(3));
        near(c[(1, 1)], force);
        near(c[(2, 2)], force);
        near(c[(1, 5)], slope);
        near(c[(2, 4)], -slope);
        near(c[(5, 5)], turn);
        near(c[(4, 4)], turn);
    }
}

/// A wedge of constant width whose height falls linearly from h1 at the wall to h2 = s h1, loaded
/// at the thin end. With t the height over h1, the distance from the thin end is (t − s) L / (1 − s)
/// and dx = L dt / (1 − s): ∫ (t − s)² t⁻³ dt, ∫ (t − s)² t⁻¹ dt and ∫ t⁻¹ dt from s to 1 give the
/// deflections along the height and the width, and the stretch.
#[test]
fn a_wedge_follows_the_closed_form() {
    let (width, h1, s, length) = (0.04_f64, 0.05_f64, 0.1_f64, 0.6_f64);
    let wedge = beam(
        rectangle(width, h1, None),
        rectangle(width, s * h1, None),
        length,
    );
    let c = wedge.cantilever_compliance();
    // Distance from the thin end: (t − s) L / (1 − s); dx = L dt / (1 − s).
    let inertia = width * h1.powi(3) / 12.0;
    let squares = (1.0 / s).ln() - 2.0 * s * (1.0 / s - 1.0) + s * s * (s.powi(-2) - 1.0) / 2.0;
    let scale = length / ((1.0 - s) * YOUNG * inertia);
    near(c[(2, 2)], scale * squares * (length / (1.0 - s)).powi(2));
    let axial = length * (1.0 / s).ln() / (YOUNG * width * h1 * (1.0 - s));
    near(c[(0, 0)], axial);
    // Bending in the other plane and shear: 1/I and 1/A both fall as 1/t.
    let i_z = h1 * width.powi(3) / 12.0;
    let squares = (1.0 - s * s) / 2.0 - 2.0 * s * (1.0 - s) + s * s * (1.0 / s).ln();
    let in_y = length.powi(3) * squares / ((1.0 - s).powi(3) * YOUNG * i_z);
    near(c[(1, 1)], in_y);
    let sheared = beam(
        rectangle(width, h1, Some(5.0 / 6.0)),
        rectangle(width, s * h1, Some(5.0 / 6.0)),
        length,
    );
    let shear = axial * YOUNG * 1.2 / SHEAR;
    near(sheared.cantilever_compliance()[(1, 1)], in_y + shear);
}

proptest! {
    #[test]
    fn no_change_of_section_is_a_prismatic_beam((section, _) in random::section_ends(), length in 0.01..5.0) {
        let prismatic = Beam::new(&steel(), &section, length).unwrap();
        let tapered = beam(section.clone(), section, length);
        let (c, k) = (tapered.cantilever_compliance(), tapered.cantilever_stiffness());
        prop_assert!(difference(&c, &prismatic.cantilever_compliance()) < 1e-14);
        prop_assert!(difference(&k, &prismatic.cantilever_stiffness()) < 1e-13);
        let u1 = Vector6::new(0.1, -0.3, 0.2, 0.4, -0.1, 0.6);
        let u2 = Vector6::new(-0.2, 0.5, 0.1, -0.3, 0.2, 0.1);
        for xi in [0.0, 0.3, 0.9, 1.0] {
            let found = tapered.displacement(xi, &u1, &u2);
            let expected = prismatic.displacement(xi, &u1, &u2);
            prop_assert!((found - expected).amax() < 1e-12 * (1.0 + 1.0 / length), "{found}");
        }
    }

    /// The chain of its two parts is the beam, whatever the place where it is cut: two different
    /// sums of intervals.
    #[test]
    fn two_parts_make_the_whole((from, to) in random::section_ends(), cut in 0.05..0.95, length in 0.05..3.0) {
        let whole = beam(from.clone(), to.clone(), length);
        let taper = Taper::new(from, to).unwrap();
        let part = |a: f64, b: f64| {
            let part = TaperedBeam::new(&steel(), &taper.part(a, b), (b - a) * length).unwrap();
            ChainSegment { compliance: part.cantilever_compliance(), span: part.span() }
        };
        let mut chain = vec![0.0; 144];
        chain_flexibility(&[part(0.0, cut), part(cut, 1.0)], &mut chain);
        let end = Matrix6::from_fn(|r, c| chain[12 * (c + 6) + r + 6]);
        let c = whole.cantilever_compliance();
        let error = difference(&end, &c);
        prop_assert!(error < 1e-13, "{error:e}");
    }

    #[test]
    fn stiffness_inverts_the_compliance((from, to) in random::section_ends(), length in 0.05..3.0) {
        let beam = beam(from, to, length);
        let (c, k) = (beam.cantilever_compliance(), beam.cantilever_stiffness());
        let scale = c.diagonal().map(f64::sqrt);
        let product = k * c;
        for e in 0..36 {
            let (i, j) = (e / 6, e % 6);
            let error = (product[(i, j)] - f64::from(u8::from(i == j))) * scale[i] / scale[j];
            // The condition of a plane grows as its elastic centre nears an end.
            prop_assert!(error.abs() < 1e-10, "{i} {j}: {error:e}");
        }
    }

    /// Turned about z, the beam from its other end has the compliance that equilibrium gives it.
    #[test]
    fn reversed_beam_is_the_same_beam((from, to) in random::section_ends(), length in 0.05..3.0) {
        let there = beam(from.clone(), to.clone(), length);
        let back = there.reversed();
        let anew = beam(to, from, length);
        prop_assert!(difference(&back.cantilever_stiffness(), &anew.cantilever_stiffness()) < 1e-11);
        let carry = hyperstat_elements::transport(&Vector3::new(length, 0.0, 0.0));
        let at_first = carry.transpose() * there.cantilever_stiffness() * carry;
        let half_turn = Rotation3::from_matrix_unchecked(Matrix3::from_diagonal(
            &Vector3::new(-1.0, -1.0, 1.0),
        ));
        let expected = rotate_matrix6(&at_first, &half_turn);
        let k = back.cantilever_stiffness();
        // Moments carried over the length cancel where the stiff end is the far one.
        let reach = carry.transpose().abs() * there.cantilever_stiffness().abs() * carry.abs();
        prop_assert!((k - expected).abs().component_div(&reach.add_scalar(1e-300)).max() < 1e-12);
    }

    /// The elastic curve: its ends are the nodes, its slopes and strains those of the sections.
    #[test]
    fn elastic_curve_and_strains_agree((from, to) in random::section_ends(), xi in 0.02..0.98) {
        let length = 0.4;
        let beam = beam(from, to, length);
        let wrench = Vector6::new(300.0, -20.0, 35.0, 4.0, 3.0, -7.0);
        let u2 = beam.cantilever_compliance() * wrench;
        let u1 = Vector6::zeros();
        let scale = u2.amax();
        prop_assert!(beam.displacement(0.0, &u1, &u2).amax() == 0.0);
        prop_assert!((beam.displacement(1.0, &u1, &u2) - u2).amax() < 1e-11 * scale);
        let [_, end] = beam.end_wrenches(&u1, &u2);
        prop_assert!((end - wrench).amax() < 1e-9 * wrench.amax());
        let h = 1e-5;
        let slope = (beam.displacement(xi + h, &u1, &u2) - beam.displacement(xi - h, &u1, &u2))
            / (2.0 * h * length);
        let u = beam.displacement(xi, &u1, &u2);
        let strain = beam.strain(xi, &u1, &u2);
        let found = [
            strain.axial,
            strain.shear_y + u[5],
            strain.shear_z - u[4],
            strain.twist,
            strain.curvature_y,
            strain.curvature_z,
        ];
        let largest = slope.amax();
        for (found, expected) in found.into_iter().zip(slope.iter()) {
            prop_assert!((found - expected).abs() < 1e-5 * largest, "{found} {expected}");
        }
    }
}

/// As thin as a double's last digit, a tube may be no section at all between its ends.
#[test]
fn the_thinnest_tubes_are_solved_or_refused() {
    let tube = |outer: f64, inner: f64| {
        Section::new(SectionShape::Tube { outer, inner }, None, None).unwrap()
    };
    let thin = tube(0.03, 0.03f64.next_down());
    for to in [tube(0.05, 0.05f64.next_down()), tube(0.02, 0.01)] {
        let taper = Taper::new(thin.clone(), to).unwrap();
        if let Ok(beam) = TaperedBeam::new(&steel(), &taper, 0.5) {
            assert!(beam.cantilever_stiffness().iter().all(|k| k.is_finite()));
        }
    }
}

#[test]
fn sections_that_no_taper_joins_are_refused() {
    let tube = SectionShape::Tube {
        outer: 0.03,
        inner: 0.02,
    };
    let tube = Section::new(tube, None, None).unwrap();
    let kinds = Taper::new(circle(0.02), tube).unwrap_err();
    assert!(
        matches!(
            kinds,
            ElementError::DifferentKinds {
                from: "circle",
                to: "tube"
            }
        ),
        "{kinds}"
    );
    let one = rectangle(0.02, 0.03, None);
    let shear = Taper::new(one, rectangle(0.02, 0.03, Some(0.8))).unwrap_err();
    assert!(matches!(shear, ElementError::OneEnd { field: "shear_y" }));
}
