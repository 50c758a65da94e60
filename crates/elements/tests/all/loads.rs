//! Distributed loads and temperature on beams: closed forms, statics, energy and division.

use crate::support;

use hyperstat_elements::{
    Beam, BeamLoad, LineMass, Section, SectionShape, StraightBeam, Taper, TaperedBeam,
    TemperatureChange, transport,
};
use nalgebra::{Matrix6, Vector3, Vector6};
use proptest::prelude::*;

use support::random::{self, circle, rectangle, steel};

const YOUNG: f64 = 2.1e11;
const SHEAR: f64 = 2.1e11 / 2.6;
const GRAVITY: f64 = 9.81;

fn near(value: f64, expected: f64) {
    let error = (value / expected - 1.0).abs();
    assert!(error < 1e-13, "{value} is {error:e} off {expected}");
}

fn close(found: &Vector6<f64>, expected: &Vector6<f64>) {
    let error = (found - expected).amax();
    assert!(error < 1e-13 * expected.amax(), "{found} {expected}");
}

/// A rectangle of steel, 0.02 × 0.05 m, 0.8 m long.
fn bar(shear: Option<f64>) -> (Section, Beam) {
    let section = rectangle(0.02, 0.05, shear);
    let beam = Beam::new(&steel(), &section, 0.8).unwrap();
    (section, beam)
}

fn along_y(intensity: f64) -> Vector6<f64> {
    Vector6::ith(1, intensity)
}

fn along_z(intensity: f64) -> Vector6<f64> {
    Vector6::ith(2, intensity)
}

/// Roark, Table 8.1, cases 2a (distributed load, left end free, right end fixed) and 3a (distributed
/// moment by equivalence with a tip load): cantilevers under uniform and triangular loads.
#[test]
fn cantilevers_of_roark() {
    let (section, beam) = bar(None);
    let (q, l) = (350.0_f64, 0.8_f64);
    let (in_y, in_z) = (YOUNG * section.iz(), YOUNG * section.iy());
    // (load, w E I / q L⁴, θ E I / q L³)
    let zero = Vector6::zeros();
    for (first, second, deflection, slope) in [
        (1.0, 1.0, 1.0 / 8.0, 1.0 / 6.0),
        (1.0, 0.0, 1.0 / 30.0, 1.0 / 24.0),
        (0.0, 1.0, 11.0 / 120.0, 1.0 / 8.0),
    ] {
        let end = beam.free_end(&BeamLoad::linear(along_y(q * first), along_y(q * second)));
        let w = q * l.powi(4) * deflection / in_y;
        close(
            &end,
            &Vector6::new(0.0, w, 0.0, 0.0, 0.0, q * l.powi(3) * slope / in_y),
        );
        let end = beam.free_end(&BeamLoad::linear(along_z(q * first), along_z(q * second)));
        let w = q * l.powi(4) * deflection / in_z;
        close(
            &end,
            &Vector6::new(0.0, 0.0, w, 0.0, -q * l.powi(3) * slope / in_z, 0.0),
        );
    }
    // A moment m per length: θ = m L²/2EI, w = m L³/3EI, the shear force stays zero.
    let load = BeamLoad::uniform(Vector6::new(0.0, 0.0, 0.0, 0.0, 0.0, q));
    let end = beam.free_end(&load);
    close(
        &end,
        &Vector6::new(
            0.0,
            q * l.powi(3) / (3.0 * in_y),
            0.0,
            0.0,
            0.0,
            q * l * l / (2.0 * in_y),
        ),
    );
    assert_eq!(beam.loaded_section_wrench(0.25, &zero, &load)[1], 0.0);
    near(
        beam.loaded_section_wrench(0.25, &zero, &load)[5],
        0.75 * l * q,
    );
    // Pull and torque along the beam: n L²/2EA, t L²/2GJ.
    let load = BeamLoad::uniform(Vector6::new(q, 0.0, 0.0, q, 0.0, 0.0));
    let end = beam.free_end(&load);
    near(end[0], q * l * l / (2.0 * YOUNG * section.area()));
    near(end[3], q * l * l / (2.0 * SHEAR * section.torsion()));
}

/// The curve of Roark, Table 8.1, case 2a, uniform load: q x² (6L² − 4 L x + x²) / 24 EI, and the
/// shear deflection q x (L − x/2) / κGA of Timoshenko's beam.
#[test]
fn curve_of_a_uniformly_loaded_cantilever() {
    for shear in [None, Some(5.0 / 6.0)] {
        let (section, beam) = bar(shear);
        let (q, l) = (-900.0, 0.8);
        let load = BeamLoad::uniform(along_z(q));
        for xi in [0.0, 0.1, 0.5, 0.9, 1.0] {
            let x = xi * l;
            let bending =
                q * x * x * (6.0 * l * l - 4.0 * l * x + x * x) / (24.0 * YOUNG * section.iy());
            let sheared = section
                .shear_z()
                .map_or(0.0, |area| q * x * (l - x / 2.0) / (SHEAR * area));
            let found = beam.free_displacement(xi, &load)[2];
            assert!(
                (found - bending - sheared).abs() <= 1e-13 * (bending + sheared).abs(),
                "{xi}"
            );
        }
    }
}

/// Roark, Table 8.1, cases 2d and 2e: both ends fixed, reactions and end moments; the middle of the
/// uniformly loaded beam deflects by q L⁴/384 EI + q L²/8 κGA.
#[test]
fn fixed_ends_of_roark() {
    let (section, beam) = bar(None);
    let (q, l) = (120.0, 0.8);
    let [first, second] = beam.fixed_end_wrenches(&BeamLoad::uniform(along_y(q)));
    let (force, moment) = (-q * l / 2.0, q * l * l / 12.0);
    close(&first, &Vector6::new(0.0, force, 0.0, 0.0, 0.0, -moment));
    close(&second, &Vector6::new(0.0, force, 0.0, 0.0, 0.0, moment));
    // Triangular, zero at node 1.
    let load = BeamLoad::linear(Vector6::zeros(), along_z(q));
    let [first, second] = beam.fixed_end_wrenches(&load);
    close(
        &first,
        &Vector6::new(0.0, 0.0, -3.0 * q * l / 20.0, 0.0, q * l * l / 30.0, 0.0),
    );
    close(
        &second,
        &Vector6::new(0.0, 0.0, -7.0 * q * l / 20.0, 0.0, -q * l * l / 20.0, 0.0),
    );

    let zero = Vector6::zeros();
    let (sheared_section, sheared) = bar(Some(0.8));
    let load = BeamLoad::uniform(along_y(q));
    let bending = q * l.powi(4) / (384.0 * YOUNG * section.iz());
    near(
        beam.loaded_displacement(0.5, &zero, &zero, &load)[1],
        bending,
    );
    let shear = q * l * l / (8.0 * SHEAR * sheared_section.shear_y().unwrap());
    near(
        sheared.loaded_displacement(0.5, &zero, &zero, &load)[1],
        bending + shear,
    );
}

/// Roark, Table 8.1, case 2e, simply supported: 5 q L⁴/384 EI at the middle, moment q L²/8.
#[test]
fn simply_supported_beam_of_roark() {
    let (section, beam) = bar(None);
    let (q, l) = (-75.0, 0.8_f64);
    let ei = YOUNG * section.iy();
    let load = BeamLoad::uniform(along_z(q));
    // Slopes of ±q L³/24 EI, no end moments.
    let slope = q * l.powi(3) / (24.0 * ei);
    let u1 = Vector6::ith(4, -slope);
    let u2 = Vector6::ith(4, slope);
    let [first, second] = beam.loaded_end_wrenches(&u1, &u2, &load);
    assert!(first[4].abs() < 1e-11 && second[4].abs() < 1e-11);
    near(first[2], -q * l / 2.0);
    near(
        beam.loaded_displacement(0.5, &u1, &u2, &load)[2],
        5.0 * q * l.powi(4) / (384.0 * ei),
    );
    let middle = beam.loaded_section_wrench(0.5, &second, &load);
    // Pushed down, the lower side is in tension: M about y is negative there.
    near(middle[4], q * l * l / 8.0);
}

/// Timoshenko's cantilever under q: bending moves the tip by q L⁴/8EI, shear by q L²/2κGA.
#[test]
fn shares_of_a_cantilever() {
    let (section, beam) = bar(Some(0.8));
    let (q, l) = (40.0, 0.8_f64);
    let load = BeamLoad::uniform(along_z(q));
    let shares = beam.virtual_work(&Vector6::zeros(), &load, &along_z(1.0));
    near(shares[4], q * l.powi(4) / (8.0 * YOUNG * section.iy()));
    near(
        shares[2],
        q * l * l / (2.0 * SHEAR * section.shear_z().unwrap()),
    );
    assert_eq!(shares.iter().filter(|share| **share != 0.0).count(), 2);
}

/// A conical bar hanging by its thick end. With y from the apex (y1 at the wall, y2 at the free
/// end) N = γ A (y³ − y2³)/3y², so u = γ/3E [(y1² − y2²)/2 + y2³ (1/y1 − 1/y2)].
#[test]
fn conical_bar_under_its_own_weight() {
    for (d1, d2) in [(0.05, 0.02), (0.03, 0.0003), (0.01, 0.08)] {
        let (length, density) = (1.2_f64, 7850.0);
        let taper = Taper::new(circle(d1), circle(d2)).unwrap();
        let beam = TaperedBeam::new(&steel(), &taper, length).unwrap();
        let weight = LineMass::new(density, taper)
            .unwrap()
            .weight(&Vector3::new(GRAVITY, 0.0, 0.0));
        let apex = length / (d1 - d2);
        let (y1, y2) = (d1 * apex, d2 * apex);
        let gamma = density * GRAVITY;
        let expected = gamma / (3.0 * YOUNG)
            * ((y1 * y1 - y2 * y2) / 2.0 + y2.powi(3) * (1.0 / y1 - 1.0 / y2));
        let found = beam.free_end(&weight)[0];
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    }
}

/// A wedge of constant width under its own weight. With t the height over h1, from s to 1, and
/// Λ = L/(1 − s): M = γ b h1 Λ² (t³/6 − t s²/2 + s³/3), so the tip deflects by γ b h1 Λ⁴/EI1 times
/// (1 − s)²/12 − s²/2 (ln 1/s − 1 + s) + s² (1 − s)²/6.
#[test]
fn wedge_under_its_own_weight() {
    let (width, h1, s, length, density) = (0.04_f64, 0.05_f64, 0.1_f64, 0.6_f64, 2700.0);
    let taper = Taper::new(rectangle(width, h1, None), rectangle(width, s * h1, None)).unwrap();
    let beam = TaperedBeam::new(&steel(), &taper, length).unwrap();
    let mass = LineMass::new(density, taper).unwrap();
    near(
        mass.total(length),
        density * width * h1 * length * (1.0 + s) / 2.0,
    );
    let found = beam.free_end(&mass.weight(&Vector3::new(0.0, 0.0, -GRAVITY)))[2];
    let load = density * GRAVITY * width * h1 * (length / (1.0 - s)).powi(4);
    let part = (1.0 - s).powi(2) / 12.0 - s * s / 2.0 * ((1.0 / s).ln() - 1.0 + s)
        + (s * (1.0 - s)).powi(2) / 6.0;
    near(found, -load * part / (YOUNG * width * h1.powi(3) / 12.0));
}

/// Heated, a free bar grows by α ΔT L and, by a gradient, bends to a circle of curvature α dT/dz;
/// held at both ends it carries −E A α ΔT and the moment E I α dT/dz (Roark, §16.6).
#[test]
fn heated_bars() {
    let (section, beam) = bar(Some(0.8));
    let (alpha, l) = (1.2e-5, 0.8);
    let change = TemperatureChange {
        uniform: 40.0,
        gradient_y: 300.0,
        gradient_z: -500.0,
    };
    let load = BeamLoad::temperature(alpha, &change);
    let (about_y, about_z) = (alpha * -500.0, -alpha * 300.0);
    let end = Vector6::new(
        alpha * 40.0 * l,
        about_z * l * l / 2.0,
        -about_y * l * l / 2.0,
        0.0,
        about_y * l,
        about_z * l,
    );
    close(&beam.free_end(&load), &end);
    // The hot side is the longer one: with the hot side up (z) the free end goes down.
    let hot_above = TemperatureChange {
        gradient_z: 100.0,
        ..Default::default()
    };
    assert!(beam.free_end(&BeamLoad::temperature(alpha, &hot_above))[2] < 0.0);
    assert_eq!(load.resultant(l), Vector6::zeros());
    let [first, second] = beam.fixed_end_wrenches(&load);
    let held = Vector6::new(
        -YOUNG * section.area() * alpha * 40.0,
        0.0,
        0.0,
        0.0,
        -YOUNG * section.iy() * about_y,
        -YOUNG * section.iz() * about_z,
    );
    assert!((second - held).amax() < 1e-11 * held.amax(), "{second}");
    assert!((first + held).amax() < 1e-11 * held.amax(), "{first}");
    let strain = beam.loaded_strain(0.3, &Vector6::zeros(), &load);
    assert_eq!((strain.axial, strain.curvature_y), (alpha * 40.0, about_y));
}

/// The weight of every kind of taper follows its area everywhere.
#[test]
fn weight_follows_the_area() {
    let tube = |outer: f64, inner: f64| {
        Section::new(SectionShape::Tube { outer, inner }, None, None).unwrap()
    };
    let general = |area: f64| {
        let shape = SectionShape::General {
            area,
            iy: 1e-8,
            iz: 1e-8,
            torsion: 1e-8,
            y_max: None,
            z_max: None,
            torsion_modulus: None,
        };
        Section::new(shape, None, None).unwrap()
    };
    for (from, to) in [
        (circle(0.03), circle(0.07)),
        (tube(0.05, 0.02), tube(0.02, 0.0199)),
        (rectangle(0.01, 0.09, None), rectangle(0.08, 0.02, None)),
        (general(1e-3), general(2e-5)),
    ] {
        let taper = Taper::new(from, to).unwrap();
        let weight = LineMass::new(1000.0, taper.clone())
            .unwrap()
            .weight(&Vector3::y());
        for xi in [0.0, 0.17, 0.5, 0.83, 1.0] {
            near(weight.intensity(xi)[1], 1000.0 * taper.at(xi).area());
        }
    }
}

/// ∫ f over 0 to 1 by Simpson's rule on `count` intervals.
fn simpson(count: usize, f: impl Fn(f64) -> Vector6<f64>) -> Vector6<f64> {
    let step = 1.0 / count as f64;
    (0..count)
        .map(|k| {
            let (a, b) = (k as f64 * step, (k + 1) as f64 * step);
            (f(a) + f((a + b) / 2.0) * 4.0 + f(b)) * (step / 6.0)
        })
        .sum()
}

/// Work of the fixed-end wrenches on displacements of the nodes is, by Betti, minus the work of
/// the load on the unloaded beam's curve: the wrenches are minus ∫ Nᵀ p dx, here by Simpson.
fn betti(beam: &impl StraightBeam, load: &BeamLoad) {
    let l = beam.length();
    let free = load.free_strain();
    let strains = Vector6::new(
        free.axial,
        free.shear_y,
        free.shear_z,
        free.twist,
        free.curvature_y,
        free.curvature_z,
    );
    let carry = |xi: f64| transport(&(beam.span() * (1.0 - xi)));
    let stiffness = beam.cantilever_stiffness();
    // Work of the forces on the shapes, and of the shapes' section wrenches on free strains.
    let work = simpson(400, |t| {
        // Closer places towards both ends, where a beam may be thin.
        let (xi, slope) = (t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t));
        let forces = beam.shape(xi).transpose() * load.intensity(xi);
        (forces + stiffness * (carry(xi) * strains)) * (slope * l)
    });
    let [_, second] = beam.fixed_end_wrenches(load);
    let expected = -work;
    // Forces and moments in units of the beam's own length and diagonal.
    let scale = beam.cantilever_stiffness().diagonal().map(f64::sqrt);
    let error = (second - expected).component_div(&scale).amax();
    let size = expected.component_div(&scale).amax();
    assert!(error < 1e-7 * size, "{second} {expected}");
}

/// u(1) of the whole from its two parts: the first carries the load of the second.
fn parts_agree(
    beam: &impl StraightBeam,
    parts: [&dyn StraightBeam; 2],
    compliance: &Matrix6<f64>,
    load: &BeamLoad,
    cut: f64,
) -> Result<(), TestCaseError> {
    let [first, second] = parts;
    let (before, after) = (load.part(0.0, cut), load.part(cut, 1.0));
    let across = after.resultant(second.length());
    let joint = first.free_end(&before) + compliance * across;
    let end = transport(&second.span()) * joint + second.free_end(&after);
    let scale = |v: Vector6<f64>| {
        v.component_div(
            &first
                .section_compliance_at(0.5)
                .map(|c| if c > 0.0 { c.sqrt() } else { 1.0 }),
        )
    };
    let whole = beam.free_end(load);
    let curve = beam.free_displacement(cut, load);
    prop_assert!(
        scale(joint - curve).amax() <= 1e-11 * scale(whole).amax(),
        "{joint} {curve}"
    );
    prop_assert!(
        scale(end - whole).amax() <= 1e-11 * scale(whole).amax(),
        "{end} {whole}"
    );
    let wrench = beam.loaded_section_wrench(cut, &Vector6::zeros(), load);
    let size = load.resultant(beam.length()).amax().max(1.0);
    prop_assert!((wrench - across).amax() < 1e-12 * size, "{wrench} {across}");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn reactions_balance_the_load(beam in random::beam(), load in random::load()) {
        let [first, second] = beam.fixed_end_wrenches(&load);
        let carry = transport(&beam.span()).transpose();
        let rest = first + carry * second + load.resultant(beam.length());
        prop_assert!(rest.amax() <= 1e-13 * (first.amax() + second.amax()), "{rest}");
        // The resultant is the integral of the load's wrench about node 1.
        let sum = simpson(1, |xi| {
            transport(&(beam.span() * xi)).transpose() * load.intensity(xi) * beam.length()
        });
        let resultant = load.resultant(beam.length());
        prop_assert!((sum - resultant).amax() < 1e-12 * (1.0 + sum.amax()), "{sum} {resultant}");
    }

    #[test]
    fn work_is_reciprocal(beam in random::beam(), load in random::load()) {
        betti(&beam, &load);
    }

    #[test]
    fn work_is_reciprocal_in_tapers(beam in random::tapered_beam(), load in random::load()) {
        betti(&beam, &load);
    }

    #[test]
    fn a_cut_changes_nothing(beam in random::beam(), load in random::load(), cut in 0.1..0.9) {
        let part = |fraction: f64| beam.with_length(beam.length() * fraction).unwrap();
        let (first, second) = (part(cut), part(1.0 - cut));
        parts_agree(&beam, [&first, &second], &first.cantilever_compliance(), &load, cut)?;
    }

    #[test]
    fn a_cut_changes_nothing_in_tapers(
        beam in random::tapered_beam(),
        load in random::load(),
        cut in 0.1..0.9,
    ) {
        let part = |a: f64, b: f64| {
            let taper = beam.taper().part(a, b);
            TaperedBeam::new(&steel(), &taper, beam.length() * (b - a)).unwrap()
        };
        let (first, second) = (part(0.0, cut), part(cut, 1.0));
        parts_agree(&beam, [&first, &second], &first.cantilever_compliance(), &load, cut)?;
    }

    /// The loaded curve: through its nodes, with the strains of its section wrenches.
    #[test]
    fn loaded_curves_and_strains_agree(
        beam in random::beam(),
        load in random::load(),
        u1 in random::displacement(),
        u2 in random::displacement(),
        xi in 0.25..0.75,
    ) {
        let (u1, u2) = (u1 * 1e-3, u2 * 1e-3);
        let at = |xi: f64| beam.loaded_displacement(xi, &u1, &u2, &load);
        let size = at(0.5).amax() + at(0.25).amax() + 1e-3;
        prop_assert!((at(0.0) - u1).amax() <= 1e-12 * size);
        prop_assert!((at(1.0) - u2).amax() <= 1e-12 * size);
        let [_, end] = beam.loaded_end_wrenches(&u1, &u2, &load);
        let strain = beam.loaded_strain(xi, &end, &load);
        // Differences of eighth order, exact up to the sixth power that the curve has.
        let weights = [0.8, -0.2, 4.0 / 105.0, -1.0 / 280.0];
        let step = 0.05;
        let slope: Vector6<f64> = weights.iter().enumerate().map(|(k, weight)| {
            let away = step * (k + 1) as f64;
            (at(xi + away) - at(xi - away)) * (weight / (step * beam.length()))
        }).sum();
        let here = at(xi);
        let pairs = [
            (strain.axial, slope[0]),
            (strain.shear_y, slope[1] - here[5]),
            (strain.shear_z, slope[2] + here[4]),
            (strain.twist, slope[3]),
            (strain.curvature_y, slope[4]),
            (strain.curvature_z, slope[5]),
        ];
        for (exact, difference) in pairs {
            prop_assert!((exact - difference).abs() < 1e-10 * size / beam.length(), "{pairs:?}");
        }
    }

    /// Principle of virtual work: of a unit load at node 2 the shares add to the displacement there.
    #[test]
    fn virtual_work_is_the_displacement(
        beam in random::tapered_beam(),
        end in random::displacement(),
        load in random::load(),
    ) {
        let end = end * 100.0;
        let moved = beam.cantilever_compliance() * end + beam.free_end(&load);
        for d in 0..6 {
            let shares = beam.virtual_work(&end, &load, &Vector6::ith(d, 1.0));
            let size = shares.abs().sum();
            prop_assert!((shares.sum() - moved[d]).abs() <= 1e-11 * size, "{d}: {shares} {moved}");
        }
    }

    #[test]
    fn loads_superpose(
        beam in random::tapered_beam(),
        a in random::load(),
        b in random::load(),
        xi in 0.0..=1.0,
    ) {
        let sum = beam.free_displacement(xi, &(a + b * -2.0));
        let apart = beam.free_displacement(xi, &a) - beam.free_displacement(xi, &b) * 2.0;
        let size = beam.free_displacement(xi, &a).abs() + beam.free_displacement(xi, &b).abs();
        prop_assert!((sum - apart).amax() <= 1e-11 * size.amax());
    }

    /// A taper without change is the prismatic beam.
    #[test]
    fn no_change_of_section_changes_nothing(
        (section, _) in random::section_ends(),
        load in random::load(),
        xi in 0.0..=1.0,
        length in 0.05..1.0,
    ) {
        let prismatic = Beam::new(&steel(), &section, length).unwrap();
        let tapered = TaperedBeam::new(&steel(), &Taper::constant(section), length).unwrap();
        let (found, expected) = (tapered.free_displacement(xi, &load), prismatic.free_displacement(xi, &load));
        prop_assert!((found - expected).amax() <= 1e-13 * expected.amax());
    }
}
