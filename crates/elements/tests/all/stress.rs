//! Stresses along loaded beams, their largest values and where they are.

use crate::support;

use std::f64::consts::PI;

use hyperstat_elements::stress::{BeamStress, stress_along, stress_parts};
use hyperstat_elements::{
    BeamLoad, LineMass, Section, SectionShape, StraightBeam, Taper, TaperedBeam,
};
use nalgebra::{Vector3, Vector6};
use proptest::prelude::*;

use support::random::{self, circle, rectangle, steel};

fn near(value: f64, expected: f64) {
    let error = (value / expected - 1.0).abs();
    assert!(error < 1e-12, "{value} is {error:e} off {expected}");
}

/// Roark, Table 8.1, case 2e: a simply supported beam under q has M = q L²/8 at the middle; a pull
/// and a torque along it make von Mises' stress there.
#[test]
fn simply_supported_beam_is_stressed_most_in_the_middle() {
    let (width, height, l, q, pull, torque) = (0.02, 0.05, 1.4, 700.0, 3e4, 45.0);
    let section = rectangle(width, height, None);
    let load = BeamLoad::uniform(Vector6::new(0.0, 0.0, -q, 0.0, 0.0, 0.0));
    let end = Vector6::new(pull, 0.0, q * l / 2.0, torque, 0.0, 0.0);
    let found = stress_along(&Taper::constant(section.clone()), l, &end, &load).unwrap();
    let bending = q * l * l / 8.0 * 6.0 / (width * height * height);
    near(found.bending.value, bending);
    near(found.normal.value, bending + pull / (width * height));
    near(found.axial.value, pull / (width * height));
    near(
        found.torsional.value,
        torque / section.torsion_modulus().unwrap(),
    );
    near(
        found.transverse.unwrap().value,
        1.5 * q * l / 2.0 / (width * height),
    );
    for peak in [found.bending, found.normal, found.von_mises] {
        assert!((peak.xi - 0.5).abs() < 1e-5, "{peak:?}");
    }
    let mises = found
        .normal
        .value
        .hypot(3f64.sqrt() * found.torsional.value);
    near(found.von_mises.value, mises);
    let yielding = steel().with_yield_strength(3.55e8).unwrap();
    near(
        found.utilisation(&yielding).unwrap(),
        found.von_mises_bound.unwrap().value / 3.55e8,
    );
    assert_eq!(found.utilisation(&steel()), None);
}

/// Roark, Table 8.1, case 2c of a propped cantilever: M = −q L²/8 at the wall and 9 q L²/128 at
/// 5/8 L from it, reaction 3 q L/8: the wall governs, in either direction.
#[test]
fn propped_cantilever_is_stressed_most_at_the_wall() {
    let section = circle(0.03);
    let (l, q) = (0.9, 250.0);
    let taper = Taper::constant(section.clone());
    let beam = hyperstat_elements::Beam::new(&steel(), &section, l).unwrap();
    let load = BeamLoad::uniform(Vector6::new(0.0, q, 0.0, 0.0, 0.0, 0.0));
    // Node 2 rests on a support that lets it turn: its end moment is zero.
    let held = beam.cantilever_stiffness();
    let free = beam.free_end(&load);
    let reaction = -free[1] / beam.cantilever_compliance()[(1, 1)];
    near(reaction, -3.0 * q * l / 8.0);
    let u2 = Vector6::ith(5, free[5] + beam.cantilever_compliance()[(5, 1)] * reaction);
    let [_, end] = beam.loaded_end_wrenches(&Vector6::zeros(), &u2, &load);
    assert!(end[5].abs() < 1e-9 * held[(5, 5)] * u2[5].abs());
    let found = stress_along(&taper, l, &Vector6::ith(1, reaction), &load).unwrap();
    assert_eq!(found.bending.xi, 0.0);
    near(
        found.bending.value,
        q * l * l / 8.0 * 32.0 / (PI * 0.03f64.powi(3)),
    );
    let field = beam.loaded_section_wrench(0.625, &end, &load)[5];
    assert!(
        (field / (-9.0 * q * l * l / 128.0) - 1.0).abs() < 1e-9,
        "{field}"
    );
}

/// A round console whose diameter grows linearly from the loaded end is stressed most where it is
/// half as thick again as there.
#[test]
fn tapered_console() {
    let taper = Taper::new(circle(0.05), circle(0.02)).unwrap();
    let end = Vector6::new(0.0, 400.0, 0.0, 0.0, 0.0, 0.0);
    let found = stress_along(&taper, 0.9, &end, &BeamLoad::none()).unwrap();
    assert!((found.normal.xi - 2.0 / 3.0).abs() < 1e-6, "{found:?}");
    near(
        found.normal.value,
        32.0 * 400.0 * 0.3 / (PI * 0.03f64.powi(3)),
    );
}

/// A cone that hangs by its base under its own weight, σ = γ (y − y2³/y²)/3 with y from the apex:
/// largest at the base.
#[test]
fn hanging_cone() {
    let (d1, d2, l, density) = (0.06_f64, 0.02_f64, 2.0_f64, 2700.0);
    let taper = Taper::new(circle(d1), circle(d2)).unwrap();
    let weight = LineMass::new(density, taper.clone())
        .unwrap()
        .weight(&Vector3::new(9.81, 0.0, 0.0));
    let found = stress_along(&taper, l, &Vector6::zeros(), &weight).unwrap();
    let apex = l / (d1 - d2);
    let (y1, y2) = (d1 * apex, d2 * apex);
    near(
        found.axial.value,
        density * 9.81 / 3.0 * (y1 - y2.powi(3) / (y1 * y1)),
    );
    assert_eq!((found.axial.xi, found.bending.value), (0.0, 0.0));
}

#[test]
fn general_sections_need_their_outline() {
    let general = |y_max: Option<f64>| {
        let shape = SectionShape::General {
            area: 4e-4,
            iy: 1e-8,
            iz: 2e-8,
            torsion: 2.5e-8,
            y_max,
            z_max: Some(0.01),
            torsion_modulus: Some(1e-6),
        };
        Taper::constant(Section::new(shape, None, None).unwrap())
    };
    let load = BeamLoad::uniform(Vector6::repeat(3.0));
    let end = Vector6::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
    assert!(stress_along(&general(None), 1.0, &end, &load).is_none());
    let found = stress_along(&general(Some(0.02)), 1.0, &end, &load).unwrap();
    assert!(found.transverse.is_none() && found.von_mises_bound.is_none());
    let yielding = steel().with_yield_strength(1e8).unwrap();
    assert_eq!(
        found.utilisation(&yielding),
        Some(found.von_mises.value / 1e8)
    );
}

/// The found maxima against a scan: never below it, attained where they say, and no more above it
/// than a scan misses.
fn scanned(
    taper: &Taper,
    length: f64,
    end: &Vector6<f64>,
    load: &BeamLoad,
    found: &BeamStress,
) -> Result<(), TestCaseError> {
    let beam = TaperedBeam::new(&steel(), taper, length).unwrap();
    let at = |xi: f64| {
        let wrench = beam.loaded_section_wrench(xi, end, load);
        let parts = stress_parts(&taper.at(xi), &wrench).unwrap();
        [
            parts.bending,
            parts.normal,
            parts.torsional,
            parts.von_mises,
        ]
    };
    let mut largest = [0.0_f64; 4];
    for k in 0..=1500 {
        for (largest, value) in largest.iter_mut().zip(at(f64::from(k) / 1500.0)) {
            *largest = largest.max(value);
        }
    }
    let peaks = [
        found.bending,
        found.normal,
        found.torsional,
        found.von_mises,
    ];
    for (which, (peak, largest)) in peaks.into_iter().zip(largest).enumerate() {
        prop_assert!(
            peak.value >= largest * (1.0 - 1e-9),
            "{which}: {peak:?} {largest}"
        );
        prop_assert!(
            peak.value <= largest * (1.0 + 1e-3),
            "{which}: {peak:?} {largest}"
        );
        let there = at(peak.xi)[which];
        prop_assert!(
            (there / peak.value - 1.0).abs() < 1e-9,
            "{which}: {peak:?} {there}"
        );
    }
    Ok(())
}

fn round_or_flat() -> impl Strategy<Value = (Section, Section)> {
    prop_oneof![
        (0.01..0.1, 0.01..0.1).prop_map(|(a, b)| (circle(a), circle(b))),
        [0.01..0.1, 0.01..0.1, 0.01..0.1, 0.01..0.1f64]
            .prop_map(|[a, b, c, d]| (rectangle(a, b, None), rectangle(c, d, None))),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn peaks_of_prismatic_beams(
        (section, _) in round_or_flat(),
        end in random::displacement(),
        load in random::load(),
        length in 0.1..2.0,
    ) {
        let taper = Taper::constant(section);
        let end = end * 500.0;
        let found = stress_along(&taper, length, &end, &load).unwrap();
        scanned(&taper, length, &end, &load, &found)?;
    }

    #[test]
    fn peaks_of_tapered_beams(
        (from, to) in round_or_flat(),
        end in random::displacement(),
        load in random::load(),
        length in 0.1..2.0,
    ) {
        let taper = Taper::new(from, to).unwrap();
        let end = end * 500.0;
        let found = stress_along(&taper, length, &end, &load).unwrap();
        scanned(&taper, length, &end, &load, &found)?;
    }
}
