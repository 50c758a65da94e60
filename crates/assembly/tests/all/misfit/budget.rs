//! Misfits and preloads in the compliance budget and the sensitivities.

use super::*;

/// A platform between drives of a stiffness, the left one and a wall with a misfit, the right one
/// preloaded.
fn strained(stiffness: f64) -> Model {
    let (mut model, [left, right]) = between_drives(stiffness);
    for (joint, misfit) in [(left, 1e-4), (JointId(1), 3e-5)] {
        let set = model.set_misfit(joint, &only(Dof::X, misfit));
        set.expect("a misfit");
    }
    let set = model.set_preload(right, &only(Dof::X, 70.0));
    set.expect("a preload");
    model
}

#[test]
fn the_budget_of_a_displacement_has_the_misfits() {
    let mut model = strained(2e6);
    let load = Load {
        node: model.output().expect("an output"),
        wrench: only(Dof::X, 50.0),
        axes: Axes::Global,
    };
    let loads = LoadSet {
        nodes: vec![load],
        lines: Vec::new(),
    };
    model.set_loads(loads).expect("loads");
    let solution = solve(&model).expect("a solution");
    let prepared = Prepared::new(model.clone());
    let influence = prepared.here().influence().expect("unit states");
    let along = only(Dof::X, 1.0);
    let budget = influence.budget(&solution, &along);
    // The wall and the drive on the left push through one spring each side of the platform.
    let share = budget
        .parts
        .iter()
        .filter(|part| part.deformation == Deformation::Misfit);
    let misfits: f64 = share.map(|part| part.displacement).sum();
    near(misfits, (1e-4 + 3e-5) / 2.0, "misfits");
    assert!(
        budget.rest.abs() < 1e-11 * budget.total.abs(),
        "{}",
        budget.rest
    );
    // Each sensitivity against central differences: 1e-4 of the stiffness, errors of its square.
    for sensitivity in influence.sensitivities(&solution).expect("sensitivities") {
        if let hyperstat_assembly::Parameter::Joint { .. } = sensitivity.parameter {
            let moved = |factor: f64| {
                let mut other = strained(2e6 * factor);
                other.set_loads(model.load_set().clone()).expect("loads");
                solve(&other).expect("a solution").output.displacement[0]
            };
            let step = 1e-4;
            let difference = (moved(1.0 + step) - moved(1.0 - step)) / (2.0 * step);
            let derivative = sensitivity.displacement.expect("a derivative");
            let found = derivative[0] * sensitivity.value;
            assert!((found - difference).abs() < 1e-7 * difference.abs());
        }
    }
}
