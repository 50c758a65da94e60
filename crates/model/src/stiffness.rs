//! What a joint's stiffness may be.

use nalgebra::Matrix6;

use crate::parts::JointStiffness;

/// A stiffness by directions or a matrix.
pub fn check_stiffness(stiffness: &JointStiffness) -> Result<(), &'static str> {
    match stiffness {
        JointStiffness::Directions(values) => {
            if values
                .iter()
                .flatten()
                .any(|k| !(k.is_finite() && *k >= 0.0))
            {
                return Err("a stiffness is a finite number, zero or more");
            }
        }
        JointStiffness::Matrix(k) => check_semidefinite(k)?,
    }
    Ok(())
}

/// A stiffness or compliance matrix: finite, symmetric, positive semidefinite (to 1e-9).
pub(crate) fn check_semidefinite(matrix: &Matrix6<f64>) -> Result<(), &'static str> {
    if !matrix.iter().all(|v| v.is_finite()) {
        return Err("the stiffness matrix holds a number that is not finite");
    }
    let scale = |r: usize, c: usize| (matrix[(r, r)].abs() * matrix[(c, c)].abs()).sqrt();
    let places = (0..6).flat_map(|r| (0..6).map(move |c| (r, c)));
    for (r, c) in places.clone() {
        if (matrix[(r, c)] - matrix[(c, r)]).abs() > 1e-9 * scale(r, c) {
            return Err("the stiffness matrix is not symmetric");
        }
    }
    let coupled_to_nothing = places
        .into_iter()
        .any(|(r, c)| scale(r, c) == 0.0 && matrix[(r, c)] != 0.0);
    let negative = matrix.diagonal().iter().any(|v| *v < 0.0);
    let unit = Matrix6::from_fn(|r, c| {
        let s = scale(r, c);
        if s > 0.0 { matrix[(r, c)] / s } else { 0.0 }
    });
    if coupled_to_nothing || negative || unit.symmetric_eigenvalues().min() < -1e-9 {
        return Err("the stiffness matrix is not positive semidefinite");
    }
    Ok(())
}
