//! Newton's method for conditions that may be redundant, on coordinates that may be idle.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use crate::equations::{Equations, Goal, System};
use crate::linkage::Configuration;

/// Loops and targets count as met where no more than this is left: coordinates in files are typed
/// to six digits or more, and redundant conditions then contradict each other by as much.
pub(crate) const CLOSED: f64 = 1e-6;
/// A step so small that the next one would be rounding.
const SETTLED: f64 = 1e-9;
/// Steps of one solution at most.
const STEPS: usize = 25;
/// Halvings of one step at most.
const HALVINGS: usize = 6;
/// Singular values below this are zero where ranks are counted.
pub(crate) const RANK_TOLERANCE: f64 = 1e-6;

/// A configuration that Newton's method came to.
#[derive(Debug, Clone)]
pub(crate) struct Solved {
    pub configuration: Configuration,
    /// The first step: the prediction of the way along the tangent.
    pub first: DVector<f64>,
    /// All steps together.
    pub moved: DVector<f64>,
    /// Jacobian where it began, and where it ended.
    pub jacobians: [DMatrix<f64>; 2],
}

/// Where Newton's method ended, met or not.
#[derive(Debug, Clone)]
pub(crate) struct Descent {
    pub solved: Solved,
    /// Whether the steps had become rounding.
    pub settled: bool,
    /// Largest misfit that is left.
    pub misfit: f64,
}

impl System {
    /// The configuration near `from` that meets the goal, if Newton's method comes to it.
    pub fn newton(&self, from: &Configuration, goal: &Goal) -> Option<Solved> {
        let descent = self.descend(from, goal)?;
        let met = descent.settled && descent.misfit <= CLOSED;
        met.then_some(descent.solved)
    }

    /// Gauss–Newton steps from a configuration, each of the least length, halved until the
    /// misfit decreases.
    pub fn descend(&self, from: &Configuration, goal: &Goal) -> Option<Descent> {
        let mut configuration = from.clone();
        let mut equations = self.equations(&configuration, goal);
        let start = equations.jacobian.clone();
        let mut moved = DVector::zeros(self.linkage.columns.len());
        let mut first: Option<DVector<f64>> = None;
        let mut settled = false;
        for _ in 0..STEPS {
            let step = least_step(&equations)?;
            first.get_or_insert_with(|| step.clone());
            let Some((next, share)) = self.decrease(&configuration, goal, &equations, &step) else {
                break;
            };
            moved += &step * share;
            configuration = next;
            equations = self.equations(&configuration, goal);
            settled = step.norm() <= SETTLED;
            if settled {
                break;
            }
        }
        Some(Descent {
            solved: Solved {
                configuration,
                first: first?,
                moved,
                jacobians: [start, equations.jacobian],
            },
            settled,
            misfit: equations.misfit.amax(),
        })
    }

    /// The configuration after as much of a step as decreases the misfit, and that share of it.
    fn decrease(
        &self,
        from: &Configuration,
        goal: &Goal,
        equations: &Equations,
        step: &DVector<f64>,
    ) -> Option<(Configuration, f64)> {
        let now = equations.misfit.norm();
        let predicted = (&equations.misfit + &equations.jacobian * step).norm();
        let mut share = 1.0;
        for _ in 0..=HALVINGS {
            let next = self.linkage.advanced(from, &(step * share));
            let then = self.misfit(&next, goal).norm();
            // A thousandth of what the tangent promises; rounding is no increase.
            if then <= now - 1e-3 * share * (now - predicted) + 1e-12 {
                return Some((next, share));
            }
            share *= 0.5;
        }
        None
    }
}

/// The step of least length, of those that lessen the misfit most: of (JᵀJ + λ²) δ = −Jᵀ r, by QR
/// of J and λ. λ decreases with the misfit, so that convergence stays quadratic, however many
/// conditions are redundant and coordinates idle (Yamashita and Fukushima 2001).
pub(crate) fn least_step(equations: &Equations) -> Option<DVector<f64>> {
    let Equations { misfit, jacobian } = equations;
    let (rows, columns) = jacobian.shape();
    if columns == 0 {
        return Some(DVector::zeros(0));
    }
    let damping = (1e-3 * misfit.norm()).max(1e-8);
    let mut both = DMatrix::zeros(rows + columns, columns);
    both.rows_mut(0, rows).copy_from(jacobian);
    for k in 0..columns {
        both[(rows + k, k)] = damping;
    }
    let mut right = DVector::zeros(rows + columns);
    right.rows_mut(0, rows).copy_from(&-misfit);
    let factor = both.qr();
    factor.q_tr_mul(&mut right);
    let triangle = factor.unpack_r();
    let right = right.rows(0, columns).into_owned();
    triangle.solve_upper_triangular(&right)
}

/// How the Jacobian at the end of a step stands to that at its start: the determinant of what
/// becomes of every motion, 1 where nothing has changed, 0 where a singular configuration is met
/// and negative beyond it. Redundant rows and idle columns count as unchanged.
pub(crate) fn orientation([start, end]: &[DMatrix<f64>; 2]) -> f64 {
    const NOTHING: f64 = 1e-10;
    let columns = start.ncols();
    let unit = DMatrix::identity(columns, columns) * NOTHING;
    let before = start.tr_mul(start) + &unit;
    let after = start.tr_mul(end) + &unit;
    let change = before.cholesky().map(|factor| factor.solve(&after));
    change.map_or(0.0, |change| change.determinant())
}

/// A basis of the motions that break no row, orthonormal.
pub(crate) fn null_space(jacobian: &DMatrix<f64>) -> DMatrix<f64> {
    if jacobian.ncols() == 0 {
        // Nothing moves, and there is no decomposition of nothing.
        return DMatrix::zeros(0, 0);
    }
    let eigen = SymmetricEigen::new(jacobian.tr_mul(jacobian));
    let free: Vec<usize> = (0..jacobian.ncols())
        .filter(|k| eigen.eigenvalues[*k] <= RANK_TOLERANCE * RANK_TOLERANCE)
        .collect();
    eigen.eigenvectors.select_columns(&free)
}

/// Number of singular values above `tolerance`.
pub(crate) fn rank(jacobian: &DMatrix<f64>, tolerance: f64) -> usize {
    if jacobian.ncols() == 0 {
        return 0;
    }
    let squares = jacobian.tr_mul(jacobian).symmetric_eigenvalues();
    let above = squares.iter().filter(|v| **v > tolerance * tolerance);
    above.count()
}
