//! One row of the equilibrium matrix: a deformation, a spring's stretch or a condition.

use nalgebra::{DVectorView, DVectorViewMut, Vector6};

/// A linear form `a` of the displacements with its flexibility: `aᵀ u = c λ`.
///
/// λ is the force that works on `aᵀ u`. A beam's deformation and a spring have `c > 0`; a rigid
/// condition has `c = 0`, and λ is then its Lagrange multiplier.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    /// Coefficients by node; global axes, linear part first.
    pub terms: Vec<(usize, Vector6<f64>)>,
    /// Flexibility c.
    pub flexibility: f64,
}

impl Row {
    /// A rigid condition.
    pub fn rigid(terms: Vec<(usize, Vector6<f64>)>) -> Self {
        Self {
            terms,
            flexibility: 0.0,
        }
    }

    /// `aᵀ u`.
    pub fn apply(&self, displacement: &DVectorView<f64>) -> f64 {
        let dot =
            |(node, a): &(usize, Vector6<f64>)| a.dot(&displacement.fixed_rows::<6>(6 * node));
        self.terms.iter().map(dot).sum()
    }

    /// Adds `a λ` to nodal forces.
    pub fn add_forces(&self, force: f64, to: &mut DVectorViewMut<f64>) {
        for (node, a) in &self.terms {
            let mut block = to.fixed_rows_mut::<6>(6 * node);
            block += a * force;
        }
    }
}
