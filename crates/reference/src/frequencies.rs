//! Natural frequencies in the null space of all conditions, dense: every node has coordinates and
//! mass of its own, and what conditions leave is found by orthogonalization.

use hyperstat_model::{Model, Segment};
use nalgebra::{DMatrix, DVector, Matrix6, SMatrix};

use crate::beam::{Element, ElementStiffness};
use crate::error::ReferenceError;
use crate::independence::Independence;
use crate::row::Row;
use crate::structure::Structure;

/// Added to the stiffness times the mass, so that motions without energy have a finite inverse
/// [rad²/s²]; taken off again.
const SHIFT: f64 = 1e3;
/// An eigenvalue of stiffness and mass together, on a unit diagonal, that is zero: what moves so
/// has neither.
const NOTHING: f64 = 1e-13;
/// A share of the largest inverse eigenvalue, or of that of the shift, that is zero: what moves so
/// has no mass.
const MASSLESS: f64 = 1e-13;

/// The squares ω² [rad²/s²] of all finite natural angular frequencies of a model, lowest first;
/// zero to rounding for every motion without energy that has mass. Consistent masses of cubic
/// shapes without rotary inertia of bending (Przemieniecki, *Theory of Matrix Structural
/// Analysis*, §11), or `lumped` ones; with the masses of nodes. `None`: a beam that tapers or has
/// no density.
///
/// # Errors
/// As [`solve`](crate::solve).
pub fn natural_frequencies(
    model: &Model,
    lumped: bool,
) -> Result<Option<Vec<f64>>, ReferenceError> {
    let structure = Structure::new(model)?;
    let count = 6 * structure.positions.len();
    let mut mass = DMatrix::zeros(count, count);
    let segments = model.segments().iter();
    let divided = segments.flat_map(|s| std::iter::repeat_n(s, s.elements.max(1)));
    for (element, segment) in structure.elements.iter().zip(divided) {
        let Some(of_element) = element_mass(element, segment, lumped) else {
            return Ok(None);
        };
        for (r, i) in element.nodes.iter().enumerate() {
            for (c, j) in element.nodes.iter().enumerate() {
                let mut block = mass.fixed_view_mut::<6, 6>(6 * i, 6 * j);
                block += of_element.fixed_view::<6, 6>(6 * r, 6 * c);
            }
        }
    }
    for entry in model.masses() {
        let mut own = Matrix6::from_diagonal_element(entry.mass.mass());
        let inertia = entry.mass.inertia();
        own.fixed_view_mut::<3, 3>(3, 3).copy_from(inertia);
        let node = 6 * entry.node.0;
        let mut block = mass.fixed_view_mut::<6, 6>(node, node);
        block += own;
    }
    let joints = structure.joints.iter();
    let holds = joints.flat_map(|joint| {
        let holds = joint.holds.iter();
        holds.map(|hold| joint.row(&hold.combination, hold.flexibility))
    });
    let rows = structure.deformations().into_iter().chain(holds);
    let rows = rows.chain(structure.rigid_bodies.iter().cloned());
    let (conditions, springs): (Vec<Row>, Vec<Row>) = rows.partition(|r| r.flexibility == 0.0);

    // Rotations, and translations over the size, so that all coordinates are alike.
    let unit = |k: usize| if k % 6 < 3 { structure.size } else { 1.0 };
    let dense = |row: &Row| {
        let mut full = DVector::zeros(count);
        row.add_forces(1.0, &mut full.rows_mut(0, count));
        DVector::from_fn(count, |k, _| full[k] * unit(k))
    };
    let conditions: Vec<DVector<f64>> = conditions.iter().map(dense).collect();
    let free = Independence::of(&conditions, count).null_space();
    if free.is_empty() {
        return Ok(Some(Vec::new()));
    }
    let free = DMatrix::from_columns(&free);
    let units = DVector::from_fn(count, |k, _| unit(k));
    let scaled = DMatrix::from_fn(count, count, |r, c| mass[(r, c)] * units[r] * units[c]);
    let mass = free.tr_mul(&(scaled * &free));
    let mut stiffness = DMatrix::zeros(free.ncols(), free.ncols());
    for row in &springs {
        let along = free.tr_mul(&dense(row));
        stiffness.ger(1.0 / row.flexibility, &along, &along, 1.0);
    }
    Ok(Some(eigenvalues(&stiffness, &mass)))
}

/// λ of K φ = λ M φ, finite ones, lowest first; both may be singular.
fn eigenvalues(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>) -> Vec<f64> {
    let sum = stiffness + mass * SHIFT;
    let whole = sum.diagonal().amax();
    let scale = sum.diagonal().map(|d| d.max(NOTHING * whole).sqrt());
    if whole <= 0.0 {
        return Vec::new();
    }
    let unit = |m: &DMatrix<f64>| {
        DMatrix::from_fn(m.nrows(), m.ncols(), |r, c| {
            m[(r, c)] / (scale[r] * scale[c])
        })
    };
    let both = unit(&sum).symmetric_eigen();
    let kept: Vec<DVector<f64>> = (both.eigenvalues.iter().zip(both.eigenvectors.column_iter()))
        .filter(|(value, _)| **value > NOTHING)
        .map(|(value, vector)| vector / value.sqrt())
        .collect();
    if kept.is_empty() {
        return Vec::new();
    }
    let kept = DMatrix::from_columns(&kept);
    let inverse = kept.tr_mul(&(unit(mass) * &kept)).symmetric_eigenvalues();
    let largest = inverse.amax().max(1.0 / SHIFT);
    let finite = inverse.iter().filter(|mu| **mu > MASSLESS * largest);
    let mut found: Vec<f64> = finite.map(|mu| 1.0 / mu - SHIFT).collect();
    found.sort_by(f64::total_cmp);
    found
}

/// Mass of an element over both its nodes, global axes.
fn element_mass(element: &Element, segment: &Segment, lumped: bool) -> Option<ElementStiffness> {
    let density = segment.material.density()?;
    if segment.taper.is_some() {
        return None;
    }
    let (section, l) = (&segment.section, element.length);
    let whole = density * section.area() * l;
    let mut mass = ElementStiffness::zeros();
    if lumped {
        for k in (0..3).chain(6..9) {
            mass[(k, k)] = whole / 2.0;
        }
        return Some(mass);
    }
    let polar = density * (section.iy() + section.iz()) * l;
    for (k, amount) in [(0, whole), (3, polar)] {
        for (r, c, share) in [
            (k, k, 2.0),
            (k + 6, k + 6, 2.0),
            (k, k + 6, 1.0),
            (k + 6, k, 1.0),
        ] {
            mass[(r, c)] = amount * share / 6.0;
        }
    }
    // Deflection and rotation at each node; a rotation about y is the other way round.
    for (places, sign) in [([1, 5, 7, 11], 1.0), ([2, 4, 8, 10], -1.0)] {
        let s = sign * l;
        let bending = [
            [156.0, 22.0 * s, 54.0, -13.0 * s],
            [22.0 * s, 4.0 * l * l, 13.0 * s, -3.0 * l * l],
            [54.0, 13.0 * s, 156.0, -22.0 * s],
            [-13.0 * s, -3.0 * l * l, -22.0 * s, 4.0 * l * l],
        ];
        for (r, row) in places.iter().zip(bending) {
            for (c, share) in places.iter().zip(row) {
                mass[(*r, *c)] = whole * share / 420.0;
            }
        }
    }
    let mut turn = SMatrix::<f64, 12, 12>::zeros();
    for k in 0..4 {
        turn.fixed_view_mut::<3, 3>(3 * k, 3 * k)
            .copy_from(&element.frame);
    }
    Some(turn * mass * turn.transpose())
}
