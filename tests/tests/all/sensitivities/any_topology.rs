//! Random mechanisms: what a factor on all stiffness, or on all mass, does.

use hyperstat_assembly::{
    BeamMass, BodyKind, ModalOptions, ModalPlan, Model, Prepared, SolveError, analyse,
};
use hyperstat_elements::RigidMass;
use hyperstat_tests::random::check_random_mechanisms;
use nalgebra::{Vector3, Vector6};
use proptest::prelude::*;

use super::label;

const STIFFNESS: [&str; 8] = ["young", "x", "y", "z", "u", "v", "w", "stiffness"];
const MASS: [&str; 3] = ["density", "mass", "inertia"];

/// With masses on the rigid bodies.
fn heavy(model: &Model) -> Model {
    let mut model = model.clone();
    for (k, body) in model.bodies().to_vec().iter().enumerate() {
        if body.kind == BodyKind::Rigid {
            let inertia = [0.02, 0.03, 0.04, 0.005, -0.003, 0.004];
            let mass = RigidMass::with_inertia(1.0 + k as f64, inertia).unwrap();
            model.add_mass(body.nodes[body.nodes.len() - 1], mass);
        }
    }
    model
}

/// Frequencies grow with the root of all stiffness and shrink with that of all mass. These are the
/// modes' own energies once more, by sums over parameters: equal to rounding.
#[test]
fn frequencies_of_any_topology() {
    check_random_mechanisms(any::<bool>(), |model, lump| {
        let model = heavy(model);
        if analyse(&model).expect("a small model").doubtful.is_some() {
            return Ok(false);
        }
        let mut options = ModalOptions::lowest(4);
        if lump {
            options.mass = BeamMass::Lumped;
        }
        let found = ModalPlan::new(&model, &options);
        let found = match found.and_then(|plan| plan.sensitivities(model.geometry())) {
            Ok(found) => found,
            Err(SolveError::NoMass | SolveError::Unheld { .. }) => return Ok(false),
            Err(error) => return Err(TestCaseError::fail(error.to_string())),
        };
        for group in &found.groups {
            for (names, expected) in [(&STIFFNESS[..], 0.5), (&MASS[..], -0.5)] {
                let own = found.parameters.iter();
                let own = own.filter(|s| names.contains(&label(&s.parameter).as_str()));
                let relative = own.flat_map(|s| {
                    let places = group.clone();
                    places.filter_map(|place| s.relative(&found.frequencies, place))
                });
                let sum: f64 = relative.sum();
                let mean = sum / group.len() as f64;
                let free = found.frequencies[group.start] == 0.0;
                let expected = if free { 0.0 } else { expected };
                prop_assert!((mean - expected).abs() < 1e-7, "{names:?}: {mean}");
            }
        }
        Ok(true)
    });
}

/// Under weight alone a deflection goes with the inverse of all stiffness, and with all mass.
#[test]
fn weight_on_any_topology() {
    check_random_mechanisms(Just(()), |model, ()| {
        let mut model = heavy(model);
        if analyse(&model).expect("a small model").doubtful.is_some() {
            return Ok(false);
        }
        model.clear_loads();
        let gravity = Vector3::new(1.0, -2.0, -9.0);
        model.set_gravity(gravity).expect("densities");
        // Weight may work on what moves freely, and the output may.
        let prepared = Prepared::new(model.clone());
        let here = prepared.here();
        let (Ok(solution), Ok(influence)) = (here.solve(), here.influence()) else {
            return Ok(false);
        };
        let found = influence.sensitivities(&solution).expect("derivatives");
        if found.iter().any(|s| s.displacement.is_none()) {
            return Ok(false);
        }
        let displacement = solution.output.displacement;
        // Where it is zero it is so to rounding of the displacements of all nodes, under the weight
        // and under the weight on the output.
        let largest = |most: f64, u: &Vector6<f64>| most.max(u.amax());
        let sag = solution.displacements.iter().fold(0.0, largest);
        let mass: f64 = model.masses().iter().map(|own| own.mass.mass()).sum();
        let compliance = solution.output.compliance.expect("a held output");
        let rounding = 1e-12 * (sag + mass * gravity.norm() * compliance.amax());
        for (names, expected) in [(&STIFFNESS[..], -1.0), (&MASS[..], 1.0)] {
            let own = found.iter();
            let own = own.filter(|s| names.contains(&label(&s.parameter).as_str()));
            let parts = own.map(|s| s.displacement.unwrap_or_default() * s.value);
            let (sum, size) = parts.fold((Vector6::zeros(), 0.0_f64), |(sum, size), part| {
                (sum + part, size.max(part.amax()))
            });
            let off = (sum - displacement * expected).amax();
            prop_assert!(
                off <= 1e-7 * size + rounding,
                "{names:?}: {off:e} of {size:e}"
            );
        }
        Ok(true)
    });
}
