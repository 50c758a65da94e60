//! Agreement of two solutions of one mechanism, with what each number is measured by.

use hyperstat_assembly::{Model, Solution, SolveError, Warning, solve};
use nalgebra::{Matrix6, Vector6};
use proptest::prelude::*;

use crate::{stiffness_difference, vector_differences};

/// What 10 N give the stiffest part of a mechanism here [m, rad].
const ROUNDING_FLOOR: f64 = 1e-9;

/// Compares a mechanism with the independent solver; `Ok(true)` where both solved it.
///
/// # Errors
/// What differs.
pub fn agrees_with_reference(model: &Model) -> Result<bool, TestCaseError> {
    let ours = solve(model);
    let theirs = hyperstat_reference::solve(model);
    let (ours, theirs) = match (ours, theirs) {
        (Ok(ours), Ok(theirs)) => (ours, theirs),
        (Err(_), Err(_)) => return Ok(false),
        (Err(SolveError::Unheld { .. }), Ok(_)) => return Ok(false),
        (Err(e), Ok(_)) => return Err(TestCaseError::fail(format!("only we refuse: {e}"))),
        (Ok(_), Err(e)) => return Err(TestCaseError::fail(format!("only they refuse: {e}"))),
    };
    // Geometry between singular and not: counts may differ with good reason.
    if nearly_singular(&ours) {
        return Ok(false);
    }
    prop_assert_eq!(ours.mobility, theirs.mobility);
    prop_assert_eq!(ours.overconstraint, theirs.overconstraint);
    prop_assert_eq!(ours.idle.len(), theirs.idle_modes);
    prop_assert_eq!(ours.output.free_motions.len(), theirs.free_motions.len());
    stiffnesses_agree(ours.output.stiffness.as_ref(), theirs.stiffness.as_ref())?;
    compliances_agree(ours.output.compliance.as_ref(), theirs.compliance.as_ref())?;
    let floor = displacement_floor(model);
    let held = ours.idle.is_empty() && ours.output.free_motions.is_empty();
    if held {
        displacements_agree(ours.displacements.iter().zip(&theirs.displacements), floor)?;
    }
    wrenches_agree(ours.joint_wrenches.iter().zip(&theirs.joint_wrenches))?;
    prop_assert_eq!(ours.cases.len(), theirs.cases.len());
    for (ours, theirs) in ours.cases.iter().zip(&theirs.cases) {
        if held {
            let pairs = ours.state.displacements.iter().zip(&theirs.displacements);
            displacements_agree(pairs, floor)?;
        }
        wrenches_agree(ours.state.joint_wrenches.iter().zip(&theirs.joint_wrenches))?;
    }
    Ok(true)
}

/// Whether the counts may be those of a neighbouring geometry.
pub fn nearly_singular(solution: &Solution) -> bool {
    let near = |w: &Warning| matches!(w, Warning::NearSingular { .. });
    solution.warnings.iter().any(near)
}

/// Output stiffness, by its diagonal; below 1e3 N/m and 1e2 N·m/rad it is soft for its size.
///
/// # Errors
/// What differs.
pub fn stiffnesses_agree(
    found: Option<&Matrix6<f64>>,
    expected: Option<&Matrix6<f64>>,
) -> Result<(), TestCaseError> {
    let Some((found, expected)) = both("stiffness", found, expected)? else {
        return Ok(());
    };
    let mut floor = *expected;
    for k in 0..6 {
        floor[(k, k)] = floor[(k, k)].max(if k < 3 { 1e3 } else { 1e2 });
    }
    let difference = stiffness_difference(&(found - expected + floor), &floor);
    prop_assert!(difference < 1e-8, "K_o {:e}", difference);
    Ok(())
}

/// Output compliance, by its diagonal.
///
/// # Errors
/// What differs.
pub fn compliances_agree(
    found: Option<&Matrix6<f64>>,
    expected: Option<&Matrix6<f64>>,
) -> Result<(), TestCaseError> {
    let Some((found, expected)) = both("compliance", found, expected)? else {
        return Ok(());
    };
    let level = |k: usize| expected[(k, k)].max(1e-12);
    let off = |r: usize, c: usize| {
        (found[(r, c)] - expected[(r, c)]).abs() / (level(r) * level(c)).sqrt()
    };
    let largest = (0..36).map(|k| off(k / 6, k % 6)).fold(0.0, f64::max);
    prop_assert!(largest < 1e-8, "C_o {:e}", largest);
    Ok(())
}

/// Displacements [m, rad] below this are zero to rounding: what heat gives a metre of a beam that
/// nothing holds, and what 10 N give the stiffest part of the mechanisms here.
pub fn displacement_floor(model: &Model) -> f64 {
    let strains = model.segments().iter().map(|segment| {
        let change = model.bodies()[segment.body.0].temperature;
        (segment.material.expansion().unwrap_or(0.0) * change).abs()
    });
    strains.fold(ROUNDING_FLOOR, f64::max)
}

/// Displacements found and expected, by the largest of their kind, or by `floor` where all are
/// smaller ([`displacement_floor`]).
///
/// # Errors
/// What differs.
pub fn displacements_agree<'a>(
    pairs: impl IntoIterator<Item = (&'a Vector6<f64>, &'a Vector6<f64>)>,
    floor: f64,
) -> Result<(), TestCaseError> {
    let [linear, angular] = vector_differences(pairs, [floor; 2]);
    prop_assert!(
        linear < 1e-8 && angular < 1e-8,
        "u {:e} {:e}",
        linear,
        angular
    );
    Ok(())
}

/// Wrenches found and expected, by the largest of their kind; the same ones are undetermined.
///
/// # Errors
/// What differs.
pub fn wrenches_agree<'a>(
    pairs: impl IntoIterator<Item = (&'a Option<Vector6<f64>>, &'a Option<Vector6<f64>>)>,
) -> Result<(), TestCaseError> {
    let mut determined = Vec::new();
    for (k, (found, expected)) in pairs.into_iter().enumerate() {
        let name = format!("wrench of joint {k}");
        determined.extend(both(&name, found.as_ref(), expected.as_ref())?);
    }
    let [forces, moments] = vector_differences(determined, [1.0, 1.0]);
    prop_assert!(
        forces < 1e-7 && moments < 1e-7,
        "wrenches {:e} {:e}",
        forces,
        moments
    );
    Ok(())
}

/// Both or none of a quantity that may not exist.
fn both<'a, T: std::fmt::Debug>(
    what: &str,
    found: Option<&'a T>,
    expected: Option<&'a T>,
) -> Result<Option<(&'a T, &'a T)>, TestCaseError> {
    match (found, expected) {
        (Some(found), Some(expected)) => Ok(Some((found, expected))),
        (None, None) => Ok(None),
        _ => Err(TestCaseError::fail(format!(
            "{what}: {found:?} instead of {expected:?}"
        ))),
    }
}
