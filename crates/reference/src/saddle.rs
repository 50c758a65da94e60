//! The equilibrium equations and their refinement.
//!
//! With A the rows of all deformations, springs and conditions and C their flexibilities,
//!
//! ```text
//! Aᵀ λ = f          forces balance the loads
//! A u − C λ = d     deformations follow from the forces (d = 0) or are prescribed
//! ```
//!
//! A rigid condition is `c = 0`, and the stiffest spring is as good. For the factorization alone,
//! the forces of beams are eliminated into a stiffness matrix. Refinement works on the equations
//! above, in whose residuals no stiffness cancels, so that what the factorization loses comes back.

use nalgebra::{DMatrix, DVector, DVectorView, Dyn, LU};

use crate::error::ReferenceError;
use crate::row::Row;

/// Refinement ends here at the latest.
const MAX_STEPS: usize = 12;
/// A relative change below this is rounding.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// A change above this, after the last step, is no solution.
const TRUSTED: f64 = 1e-6;

/// The factored system of some rows.
#[derive(Debug)]
pub(crate) struct Saddle<'a> {
    rows: &'a [Row],
    /// The first rows, whose forces are eliminated.
    eliminated: usize,
    /// Number of displacement coordinates.
    coordinates: usize,
    /// Scaling of unknowns and equations.
    scale: DVector<f64>,
    factors: LU<f64, Dyn, Dyn>,
}

/// Displacements, forces of the rows, and the last change that refinement made.
#[derive(Debug, Clone)]
pub(crate) struct Equilibrium {
    /// u.
    pub displacement: DVector<f64>,
    /// λ by row.
    pub forces: DVector<f64>,
    /// Last change of u over u, by their largest components.
    pub change: f64,
}

impl<'a> Saddle<'a> {
    /// Factors the system of `rows` over `nodes`; the first `eliminated` of them have a
    /// flexibility and are eliminated.
    pub fn new(nodes: usize, rows: &'a [Row], eliminated: usize) -> Self {
        let coordinates = 6 * nodes;
        let order = coordinates + rows.len() - eliminated;
        let mut matrix = DMatrix::zeros(order, order);
        for row in &rows[..eliminated] {
            for (i, a) in &row.terms {
                for (j, b) in &row.terms {
                    let mut block = matrix.fixed_view_mut::<6, 6>(6 * i, 6 * j);
                    block += a * b.transpose() / row.flexibility;
                }
            }
        }
        for (k, row) in rows[eliminated..].iter().enumerate() {
            let place = coordinates + k;
            for (node, a) in &row.terms {
                let mut column = matrix.fixed_view_mut::<6, 1>(6 * node, place);
                column += a;
                let mut across = matrix.fixed_view_mut::<1, 6>(place, 6 * node);
                across += a.transpose();
            }
            matrix[(place, place)] = -row.flexibility;
        }
        let scale = equilibrate(&mut matrix, coordinates);
        Self {
            rows,
            eliminated,
            coordinates,
            scale,
            factors: matrix.lu(),
        }
    }

    /// Solves for loads `f` on the nodes and prescribed values `d` of the rows.
    ///
    /// # Errors
    /// A singular system, or one that refinement cannot settle.
    pub fn solve(
        &self,
        loads: &DVector<f64>,
        prescribed: &DVector<f64>,
    ) -> Result<Equilibrium, ReferenceError> {
        let mut displacement = DVector::zeros(self.coordinates);
        let mut forces = DVector::zeros(self.rows.len());
        let mut moved = Settling::default();
        let mut pressed = Settling::default();
        for _ in 0..MAX_STEPS {
            let (unbalanced, gaps) = self.residual(&displacement, &forces, loads, prescribed);
            let (step, force_step) = self.correction(unbalanced, &gaps)?;
            displacement += &step;
            forces += &force_step;
            moved.take(&step, &displacement, self.rounding(&forces, prescribed));
            pressed.take(&force_step, &forces, 0.0);
            if moved.settled && pressed.settled {
                break;
            }
        }
        if moved.change > TRUSTED {
            return Err(ReferenceError::NotConverged {
                change: moved.change,
            });
        }
        Ok(Equilibrium {
            displacement,
            forces,
            change: moved.change,
        })
    }

    /// Displacements below this are zero: a rounding of what the largest force would give the
    /// softest row; where nothing gives, every displacement is.
    fn rounding(&self, forces: &DVector<f64>, prescribed: &DVector<f64>) -> f64 {
        let softest = self.rows.iter().map(|r| r.flexibility).fold(0.0, f64::max);
        let largest = prescribed.amax().max(softest * forces.amax());
        if largest > 0.0 {
            ROUNDING * largest
        } else {
            f64::INFINITY
        }
    }

    fn residual(
        &self,
        displacement: &DVector<f64>,
        forces: &DVector<f64>,
        loads: &DVector<f64>,
        prescribed: &DVector<f64>,
    ) -> (DVector<f64>, DVector<f64>) {
        let mut unbalanced = loads.clone();
        let mut gaps = prescribed.clone();
        for (k, row) in self.rows.iter().enumerate() {
            row.add_forces(-forces[k], &mut unbalanced.as_view_mut());
            gaps[k] -= row.apply(&displacement.as_view()) - row.flexibility * forces[k];
        }
        (unbalanced, gaps)
    }

    /// Solves with the factors: `(unbalanced, gaps)` to changes of displacements and forces.
    fn correction(
        &self,
        mut unbalanced: DVector<f64>,
        gaps: &DVector<f64>,
    ) -> Result<(DVector<f64>, DVector<f64>), ReferenceError> {
        let (links, others) = self.rows.split_at(self.eliminated);
        for (k, row) in links.iter().enumerate() {
            row.add_forces(gaps[k] / row.flexibility, &mut unbalanced.as_view_mut());
        }
        let mut unknowns = DVector::zeros(self.scale.len());
        unknowns
            .rows_mut(0, self.coordinates)
            .copy_from(&unbalanced);
        let tail = gaps.rows(self.eliminated, others.len());
        unknowns
            .rows_mut(self.coordinates, others.len())
            .copy_from(&tail);
        unknowns.component_mul_assign(&self.scale);
        let solved = self.factors.solve_mut(&mut unknowns);
        unknowns.component_mul_assign(&self.scale);
        if !solved || !unknowns.iter().all(|x| x.is_finite()) {
            return Err(ReferenceError::Singular);
        }
        let step: DVectorView<f64> = unknowns.rows(0, self.coordinates);
        let mut forces = DVector::zeros(self.rows.len());
        for (k, row) in links.iter().enumerate() {
            forces[k] = (row.apply(&step) - gaps[k]) / row.flexibility;
        }
        let multipliers = unknowns.rows(self.coordinates, others.len());
        forces
            .rows_mut(self.eliminated, others.len())
            .copy_from(&multipliers);
        Ok((step.into_owned(), forces))
    }
}

/// How far refinement has come with one kind of unknown.
#[derive(Debug)]
struct Settling {
    /// Smallest relative change of any step.
    change: f64,
    /// Whether that is rounding, or the last step was no longer much smaller.
    settled: bool,
}

impl Default for Settling {
    fn default() -> Self {
        Self {
            change: f64::INFINITY,
            settled: false,
        }
    }
}

impl Settling {
    /// Takes in a step; a `whole` up to `rounding` is zero.
    fn take(&mut self, step: &DVector<f64>, whole: &DVector<f64>, rounding: f64) {
        let size = whole.amax();
        let change = if size > rounding {
            step.amax() / size
        } else {
            0.0
        };
        self.settled = change <= ROUNDING || change > 0.5 * self.change;
        self.change = self.change.min(change);
    }
}

/// Scales the matrix, of `coordinates` displacements and then forces, to largest entries near one
/// in every row (Ruiz), by powers of two; returns the factors of rows and columns.
///
/// Before that, unit forces are chosen so that the beams' stiffness and the flexibility of springs
/// that are stiffer lie equally far below the conditions' coefficients, and neither drowns.
fn equilibrate(matrix: &mut DMatrix<f64>, coordinates: usize) -> DVector<f64> {
    let order = matrix.nrows();
    let diagonal = matrix.diagonal();
    let (stiffness, flexibility) = diagonal.as_slice().split_at(coordinates);
    let stiffest = stiffness.iter().copied().fold(0.0, f64::max);
    let springs = flexibility.iter().map(|c| -c).filter(|c| *c > 0.0);
    let stiffest_spring = springs.fold(f64::INFINITY, f64::min);
    let unit_force = if stiffest > 0.0 {
        (stiffest_spring / stiffest).sqrt().min(1.0 / stiffest)
    } else {
        1.0
    };
    let mut scale = DVector::from_element(order, 1.0);
    let mut factor = DVector::from_fn(order, |k, _| {
        let power = if k < coordinates { 0.5 } else { -0.5 };
        (power * unit_force.log2()).round().exp2()
    });
    for _ in 0..7 {
        for c in 0..order {
            let mut column = matrix.column_mut(c);
            column.component_mul_assign(&factor);
            column *= factor[c];
        }
        scale.component_mul_assign(&factor);
        factor = DVector::from_fn(order, |k, _| {
            let most = matrix.column(k).amax();
            if most > 0.0 {
                (-0.5 * most.log2()).round().exp2()
            } else {
                1.0
            }
        });
    }
    scale
}
