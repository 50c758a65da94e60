//! Stiffness measures: what a 6×6 stiffness says in numbers that can be compared.
//!
//! Everything here is a function of the matrices alone. With K = \[\[A, B\], \[Bᵀ, D\]\] and its
//! inverse C = \[\[E, F\], \[Fᵀ, G\]\], linear part first:
//!
//! * a **pure force** leaves the output free to turn: u = E f. A **pure moment** leaves it free to
//!   move: φ = G m. The eigenvalues of E and G are the principal compliances.
//! * a **pure translation** is one with the rotations blocked: f = A u. A **pure rotation** about the
//!   output has the translations blocked: m = D φ. The eigenvalues of A and D are the principal
//!   stiffnesses.
//!
//! They are not each other's inverses: E⁻¹ = A − B D⁻¹ Bᵀ. A and G are the same at every point of
//! the output body, D and E are of the reference point.

#[cfg(test)]
mod tests;

use nalgebra::{Cholesky, Matrix3, Matrix6, Point3, Vector3, Vector6};

/// Principal values of a symmetric 3×3 matrix, the smallest first, with their directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Principal {
    /// The values, ascending.
    pub values: [f64; 3],
    /// Unit vectors along which they are; of equal values any orthogonal ones.
    pub directions: [Vector3<f64>; 3],
}

/// A screw spring of the eigenscrew decomposition.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eigenscrew {
    /// Eigenvalue λ = 2 h k \[N\]: a twist about the screw gives λ times the wrench along it.
    pub eigenvalue: f64,
    /// Stiffness k of the spring along the screw \[N/m\].
    pub stiffness: f64,
    /// Pitch h \[m\]: the moment over the force of the spring's wrench.
    pub pitch: f64,
    /// Direction of the screw's axis, a unit vector.
    pub direction: Vector3<f64>,
    /// The point of the axis nearest to the reference point.
    pub point: Point3<f64>,
}

impl Eigenscrew {
    /// The unit wrench along the screw (1 N; moment about `reference`).
    pub fn unit_wrench(&self, reference: &Point3<f64>) -> Vector6<f64> {
        let moment = (self.point - reference).cross(&self.direction) + self.direction * self.pitch;
        join(&self.direction, &moment)
    }
}

/// Measures of a stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct Measures {
    /// Compliances under a pure force, the output free to turn \[m/N\].
    pub translational_compliances: Principal,
    /// Compliances under a pure moment, the output free to move \[rad/(N·m)\].
    pub rotational_compliances: Principal,
    /// Stiffnesses against a pure translation, rotations blocked \[N/m\].
    pub translational_stiffnesses: Principal,
    /// Stiffnesses against a pure rotation about the reference point, translations blocked
    /// \[N·m/rad\].
    pub rotational_stiffnesses: Principal,
    /// The length that rotations were multiplied with for the condition number \[m\].
    pub characteristic_length: f64,
    /// Largest over smallest eigenvalue of the stiffness with rotations as displacements at the
    /// characteristic length.
    pub condition: f64,
    /// Eigenscrews of the stiffness, by eigenvalue, the largest first: three of positive and three
    /// of negative pitch.
    pub eigenscrews: Vec<Eigenscrew>,
    /// The point at which the coupling block B is symmetric (Lončarić's centre of stiffness).
    pub centre_of_stiffness: Point3<f64>,
    /// The point at which the coupling block F of the compliance is symmetric.
    pub centre_of_compliance: Point3<f64>,
    /// Virtual-work index of forces: the work of a unit force on the displacement along it, the mean
    /// over all its directions, tr E / 3 \[m/N\].
    pub force_work: f64,
    /// The same of a unit moment, tr G / 3 \[rad/(N·m)\].
    pub moment_work: f64,
}

impl Measures {
    /// Measures of a stiffness (global axes, at `reference`, linear part first) and its inverse.
    ///
    /// `characteristic_length`: for the condition number \[m\]; `None` takes
    /// [`natural_length`], at which the mean compliance is the same in translation and rotation.
    ///
    /// The eigenscrews are those of Patterson and Lipkin (Structure of robot compliance, J. Mech.
    /// Design 115, 1993): K T = λ Δ T, with Δ the interchange of the two parts; the centres are
    /// Lončarić's (Normal forms of stiffness and compliance matrices, IEEE J. Robotics and
    /// Automation 3, 1987) and those of Ciblak and Lipkin (Centers of stiffness, compliance, and
    /// elasticity, ASME DETC 1994).
    ///
    /// `None` where a matrix is not positive definite, or a length not positive and finite.
    pub fn new(
        stiffness: &Matrix6<f64>,
        compliance: &Matrix6<f64>,
        reference: &Point3<f64>,
        characteristic_length: Option<f64>,
    ) -> Option<Self> {
        let length = characteristic_length.unwrap_or_else(|| natural_length(compliance));
        if !(length.is_finite() && length > 0.0) {
            return None;
        }
        let [translational_stiffnesses, rotational_stiffnesses] =
            [0, 3].map(|k| principal(&block(stiffness, k, k)));
        let [translational_compliances, rotational_compliances] =
            [0, 3].map(|k| principal(&block(compliance, k, k)));
        let scale = |k: usize| if k < 3 { 1.0 } else { 1.0 / length };
        let scaled = Matrix6::from_fn(|r, c| stiffness[(r, c)] * scale(r) * scale(c));
        let eigenvalues = scaled.symmetric_eigenvalues();
        let (low, high) = (eigenvalues.min(), eigenvalues.max());
        if !(low > 0.0 && high.is_finite()) {
            return None;
        }
        let centre = |own: &Matrix3<f64>, skew: &Matrix3<f64>| -> Option<Point3<f64>> {
            let sum = Matrix3::identity() * own.trace() - own;
            Some(reference + Cholesky::new(sum)?.solve(&axial(skew)))
        };
        let coupling = block(stiffness, 0, 3);
        let give = block(compliance, 0, 3);
        Some(Self {
            translational_compliances,
            rotational_compliances,
            translational_stiffnesses,
            rotational_stiffnesses,
            characteristic_length: length,
            condition: high / low,
            eigenscrews: eigenscrews(stiffness, reference, length)?,
            centre_of_stiffness: centre(
                &block(stiffness, 0, 0),
                &(coupling.transpose() - coupling),
            )?,
            centre_of_compliance: centre(&block(compliance, 3, 3), &(give - give.transpose()))?,
            force_work: block(compliance, 0, 0).trace() / 3.0,
            moment_work: block(compliance, 3, 3).trace() / 3.0,
        })
    }
}

/// The displacement along a unit wrench per size of that wrench, eᵀ C e: for a force \[m/N\], for a
/// moment \[rad/(N·m)\].
pub fn compliance_along(compliance: &Matrix6<f64>, wrench: &Vector6<f64>) -> f64 {
    (compliance * wrench).dot(wrench)
}

/// The length \[m\] at which the mean compliances in translation and in rotation are the same,
/// √(tr E / tr G) with the blocks of the compliance. It depends on the reference point.
pub fn natural_length(compliance: &Matrix6<f64>) -> f64 {
    (block(compliance, 0, 0).trace() / block(compliance, 3, 3).trace()).sqrt()
}

/// The 3×3 block from this row and column on.
fn block(matrix: &Matrix6<f64>, row: usize, column: usize) -> Matrix3<f64> {
    matrix.fixed_view::<3, 3>(row, column).into_owned()
}

fn join(linear: &Vector3<f64>, angular: &Vector3<f64>) -> Vector6<f64> {
    Vector6::from_fn(|k, _| if k < 3 { linear[k] } else { angular[k - 3] })
}

/// The vector v with `skew` = \[v ×\].
fn axial(skew: &Matrix3<f64>) -> Vector3<f64> {
    Vector3::new(skew[(2, 1)], skew[(0, 2)], skew[(1, 0)])
}

/// The unit force along the translation of a displacement, or the unit moment along its rotation where it does
/// not translate; `None` for no displacement.
pub(crate) fn direction_of(displacement: &Vector6<f64>) -> Option<Vector6<f64>> {
    for start in [0, 3] {
        let part: Vector3<f64> = displacement.fixed_rows::<3>(start).into_owned();
        let size = part.norm();
        if size > 0.0 {
            let mut along = Vector6::zeros();
            along.fixed_rows_mut::<3>(start).copy_from(&(part / size));
            return Some(along);
        }
    }
    None
}

/// Principal values of a symmetric matrix.
pub fn principal(matrix: &Matrix3<f64>) -> Principal {
    let eigen = matrix.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    Principal {
        values: order.map(|k| eigen.eigenvalues[k]),
        directions: order.map(|k| towards_positive(&eigen.eigenvectors.column(k).into_owned())),
    }
}

/// A vector or its opposite: the one whose largest component is positive.
fn towards_positive(vector: &Vector3<f64>) -> Vector3<f64> {
    vector * vector[vector.iamax()].signum()
}

/// K T = λ Δ T. With K = L Lᵀ and T = L⁻ᵀ y it is the symmetric problem Lᵀ Δ L y = λ y; rotations
/// are taken times `length`, so that both parts are of one size.
fn eigenscrews(
    stiffness: &Matrix6<f64>,
    reference: &Point3<f64>,
    length: f64,
) -> Option<Vec<Eigenscrew>> {
    let scale = |k: usize| if k < 3 { 1.0 } else { 1.0 / length };
    let scaled = Matrix6::from_fn(|r, c| stiffness[(r, c)] * scale(r) * scale(c));
    let lower = Cholesky::new(scaled)?.l();
    let interchanged = Matrix6::from_fn(|r, c| lower[((r + 3) % 6, c)]);
    let product = lower.transpose() * interchanged;
    let eigen = ((product + product.transpose()) * 0.5).symmetric_eigen();
    let mut order = [0, 1, 2, 3, 4, 5];
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    let screw = |k: usize| {
        // K T = L y, the wrench along the screw.
        let wrench = lower * eigen.eigenvectors.column(k);
        let force = Vector3::new(wrench[0], wrench[1], wrench[2]);
        let moment = Vector3::new(wrench[3], wrench[4], wrench[5]) * length;
        let size = force.norm_squared();
        let eigenvalue = eigen.eigenvalues[k] * length;
        let pitch = force.dot(&moment) / size;
        Eigenscrew {
            eigenvalue,
            // y has length 1, so K = Σ (L y)(L y)ᵀ: a spring of stiffness |f|².
            stiffness: size,
            pitch,
            direction: towards_positive(&(force / size.sqrt())),
            point: reference + force.cross(&moment) / size,
        }
    };
    Some(order.into_iter().map(screw).collect())
}
