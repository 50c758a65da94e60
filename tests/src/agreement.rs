//! Agreement of two solutions of one mechanism, with what each number is measured by.

use hyperstat_assembly::{Floor, Model, Solution, SolveError, Warning, solve};
use nalgebra::{Matrix6, Vector6};
use proptest::prelude::*;

use crate::vector_differences;

/// Where nothing acts, everything is zero.
const NOTHING: f64 = 1e-300;

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
    let floor = &ours.floor;
    stiffnesses_agree(
        ours.output.stiffness.as_ref(),
        theirs.stiffness.as_ref(),
        floor,
    )?;
    compliances_agree(
        ours.output.compliance.as_ref(),
        theirs.compliance.as_ref(),
        floor,
    )?;
    let held = ours.idle.is_empty() && ours.output.free_motions.is_empty();
    if held {
        displacements_agree(ours.displacements.iter().zip(&theirs.displacements), floor)?;
    }
    wrenches_agree(
        ours.joint_wrenches.iter().zip(&theirs.joint_wrenches),
        floor,
    )?;
    prop_assert_eq!(ours.cases.len(), theirs.cases.len());
    for (ours, theirs) in ours.cases.iter().zip(&theirs.cases) {
        let floor = &ours.state.floor;
        if held {
            let pairs = ours.state.displacements.iter().zip(&theirs.displacements);
            displacements_agree(pairs, floor)?;
        }
        let pairs = ours.state.joint_wrenches.iter().zip(&theirs.joint_wrenches);
        wrenches_agree(pairs, floor)?;
    }
    Ok(true)
}

/// Whether the counts may be those of a neighbouring geometry.
pub fn nearly_singular(solution: &Solution) -> bool {
    let near = |w: &Warning| matches!(w, Warning::NearSingular { .. });
    solution.warnings.iter().any(near)
}

/// Output stiffness, by its diagonal.
///
/// # Errors
/// What differs.
pub fn stiffnesses_agree(
    found: Option<&Matrix6<f64>>,
    expected: Option<&Matrix6<f64>>,
    floor: &Floor,
) -> Result<(), TestCaseError> {
    let Some((found, expected)) = both("stiffness", found, expected)? else {
        return Ok(());
    };
    matrices_agree("K_o", found, expected, floor.stiffness_scales(expected))
}

/// Output compliance, by its diagonal.
///
/// # Errors
/// What differs.
pub fn compliances_agree(
    found: Option<&Matrix6<f64>>,
    expected: Option<&Matrix6<f64>>,
    floor: &Floor,
) -> Result<(), TestCaseError> {
    let Some((found, expected)) = both("compliance", found, expected)? else {
        return Ok(());
    };
    matrices_agree("C_o", found, expected, floor.compliance_scales(expected))
}

fn matrices_agree(
    name: &str,
    found: &Matrix6<f64>,
    expected: &Matrix6<f64>,
    scales: [f64; 6],
) -> Result<(), TestCaseError> {
    let off = |r: usize, c: usize| {
        (found[(r, c)] - expected[(r, c)]).abs() / (scales[r] * scales[c]).sqrt()
    };
    let largest = (0..36).map(|k| off(k / 6, k % 6)).fold(0.0, f64::max);
    prop_assert!(largest < 1e-8, "{name} {largest:e}");
    Ok(())
}

/// Displacements found and expected, by the largest of their kind, or by what acts where all are
/// smaller.
///
/// # Errors
/// What differs.
pub fn displacements_agree<'a>(
    pairs: impl IntoIterator<Item = (&'a Vector6<f64>, &'a Vector6<f64>)>,
    floor: &Floor,
) -> Result<(), TestCaseError> {
    let least = floor.least_displacement().max(NOTHING);
    let [linear, angular] = vector_differences(pairs, [least, least / floor.size]);
    prop_assert!(
        linear < 1e-8 && angular < 1e-8,
        "u {:e} {:e}",
        linear,
        angular
    );
    Ok(())
}

/// Wrenches found and expected, by the largest of their kind, or by what acts where all are
/// smaller; the same ones are undetermined.
///
/// # Errors
/// What differs.
pub fn wrenches_agree<'a>(
    pairs: impl IntoIterator<Item = (&'a Option<Vector6<f64>>, &'a Option<Vector6<f64>>)>,
    floor: &Floor,
) -> Result<(), TestCaseError> {
    let mut determined = Vec::new();
    for (k, (found, expected)) in pairs.into_iter().enumerate() {
        let name = format!("wrench of joint {k}");
        determined.extend(both(&name, found.as_ref(), expected.as_ref())?);
    }
    let least = floor.least_force().max(NOTHING);
    let [forces, moments] = vector_differences(determined, [least, least * floor.size]);
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
