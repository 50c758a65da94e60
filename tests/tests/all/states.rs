//! Weight, masses, temperatures, loads along beams and in axes that turn, and cases, on random
//! mechanisms and on those of the reference files, against the independent solver; a sweep against
//! `solve`; and budgets of what gives.

use std::mem::discriminant;

use hyperstat_assembly::{Model, Prepared, solve};
use hyperstat_mechanisms::{Disk, Registry, mechanism_from_str};
use hyperstat_tests::agreement::{
    agrees_with_reference, displacements_agree, nearly_singular, stiffnesses_agree,
};
use hyperstat_tests::random::check_random_mechanisms;
use hyperstat_tests::runner::check_all;
use hyperstat_tests::states::{acting, beams};
use hyperstat_tests::{moved, reference_folder, reference_text};
use nalgebra::{Rotation3, Vector3, Vector6};
use proptest::prelude::*;

/// Reference mechanisms that are held in every state: no body moves idly.
const MECHANISMS: [&str; 12] = [
    "delta_elastic_joints",
    "delta_rigid_joints",
    "delta_refined",
    "every_joint",
    "flexible_parallelogram",
    "hexapod_elastic_drives",
    "hexapod_locked",
    "rigid_bodies_on_bushings",
    "rigid_parallelogram",
    "single_freedom_elastic",
    "three_rps",
    "tricept",
];

fn mechanism(name: &str) -> Model {
    let text = reference_text(&format!("{name}.ron"));
    mechanism_from_str(&text, &reference_folder(), &Disk, &Registry::builtin())
        .expect("a valid file")
        .model
}

#[test]
fn states_of_random_mechanisms_agree_with_the_independent_solver() {
    check_random_mechanisms((acting(), beams()), |model, (acting, beams)| {
        let mut model = beams.instead_of(model);
        acting.put_on(&mut model);
        agrees_with_reference(&model)
    });
}

/// Twenty states of each.
#[test]
fn states_of_the_reference_mechanisms_agree_with_the_independent_solver() {
    for name in MECHANISMS {
        let plain = mechanism(name);
        let cases = 20;
        let counted = check_all(cases, (acting(), beams()), |(acting, beams)| {
            let mut model = beams.instead_of(&plain);
            acting.put_on(&mut model);
            agrees_with_reference(&model)
        });
        assert_eq!(counted, cases, "{name}");
    }
}

/// The mechanism is built and planned in one place, and solved where it is turned and moved as a
/// whole: weight stays, what turns with bodies turns.
#[test]
fn a_sweep_finds_what_solve_finds_in_every_state() {
    let turn = proptest::array::uniform3(-2.0..2.0);
    let extra = (acting(), beams(), turn);
    check_random_mechanisms(extra, |model, (acting, beams, turn)| {
        let mut model = beams.instead_of(model);
        acting.put_on(&mut model);
        let prepared = Prepared::new(model.clone());
        if prepared.unknowns().is_err() {
            return Ok(false);
        }
        let rotation = Rotation3::from_scaled_axis(Vector3::from(turn));
        let pose = moved(&model, &rotation, &Vector3::new(0.3, -0.2, 0.5));
        let pose = pose.geometry().clone();
        let mut there = model.clone();
        there
            .set_geometry(pose.clone())
            .expect("a geometry of this model");
        let found = prepared.sweep(&pose, &mut prepared.workspace().expect("a plan"));
        let (found, expected) = match (found, solve(&there)) {
            (Ok(found), Ok(expected)) => (found, expected),
            (Err(found), Err(expected)) => {
                // In words they may differ: by where the mechanism lies.
                prop_assert_eq!(discriminant(&found), discriminant(&expected));
                return Ok(false);
            }
            (found, expected) => {
                let both = format!("{found:?} {expected:?}");
                return Err(TestCaseError::fail(both));
            }
        };
        if nearly_singular(&expected) {
            return Ok(false);
        }
        let stiffness = expected.output.stiffness.as_ref();
        stiffnesses_agree(found.stiffness.as_ref(), stiffness, &expected.floor)?;
        let held = expected.output.free_motions.is_empty();
        prop_assert_eq!(found.displacement.is_some(), held);
        if !held {
            prop_assert!(found.cases.is_empty());
            return Ok(false);
        }
        let own = found
            .displacement
            .iter()
            .zip([&expected.output.displacement]);
        displacements_agree(own, &expected.floor)?;
        prop_assert_eq!(found.cases.len(), expected.cases.len());
        for (found, expected) in found.cases.iter().zip(&expected.cases) {
            let state = &expected.state;
            displacements_agree([(found, &state.output)], &state.floor)?;
        }
        agrees_with_reference(&there)
    });
}

/// Every displacement of the output is the sum of what its parts give, under weight, heat and loads
/// along beams too.
#[test]
fn shares_add_up_in_every_state() {
    for name in MECHANISMS {
        let plain = mechanism(name);
        if solve(&plain)
            .expect("a solution")
            .output
            .stiffness
            .is_none()
        {
            continue;
        }
        let counted = check_all(5, (acting(), beams()), |(acting, beams)| {
            let mut model = beams.instead_of(&plain);
            acting.put_on(&mut model);
            let solution = solve(&model).expect("a solution");
            let prepared = Prepared::new(model.clone());
            let influence = prepared.here().influence().expect("a held output");
            for component in 0..6 {
                let budget = influence.budget(&solution, &Vector6::ith(component, 1.0));
                let moved = solution.output.displacement[component];
                let parts = budget.parts.iter();
                let sum: f64 = parts.clone().map(|part| part.displacement).sum();
                let size: f64 = parts.map(|part| part.displacement.abs()).sum();
                // As without weight and heat: integrals and recovery to some 1e-12 each.
                prop_assert!(
                    (sum - moved).abs() <= 1e-10 * size,
                    "{}: {:e} of {:e}",
                    component,
                    sum - moved,
                    size
                );
            }
            Ok(true)
        });
        assert_eq!(counted, 5, "{name}");
    }
}
