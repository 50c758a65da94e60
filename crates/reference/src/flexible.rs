//! A flexible body by its deformations: the rows of a triangular factor of its stiffness.
//!
//! The stiffness given for a flexible body is rounded; what it means is its rows and columns of all
//! nodes but the first, with those of the first following from equilibrium.

use hyperstat_model::{Flexible, Model};
use nalgebra::{Cholesky, DMatrix, Rotation3, Vector3, Vector6};

use crate::beam::join;
use crate::row::Row;
use crate::structure::carried;

/// A flexible body.
#[derive(Debug)]
pub(crate) struct FlexibleElement {
    /// Deformations of unit stiffness, so that the strain energy is `½ Σ (aᵀu)²`.
    pub deformations: Vec<Row>,
}

impl FlexibleElement {
    /// Reads a body of a model; `None` where its stiffness, held at its first node, is not positive
    /// definite.
    pub fn new(model: &Model, flexible: &Flexible) -> Option<Self> {
        let body = &model.bodies()[flexible.body.0];
        let geometry = model.geometry();
        let rotation = geometry.rotations[body.flexible?.0];
        let (first, others) = body.nodes.split_first()?;
        let rows = 6 * others.len();
        let stiffness = flexible.element.stiffness();
        let factor = Cholesky::new(stiffness.view((6, 6), (rows, rows)).into_owned())?.l();
        let deformation = |column: usize| {
            let mut terms = Vec::with_capacity(body.nodes.len());
            let mut at_first = Vector6::zeros();
            for (k, node) in others.iter().enumerate() {
                let own = global(&rotation, &factor, 6 * k, column);
                let arm = geometry.positions[node.0] - geometry.positions[first.0];
                at_first -= carried(&arm, &own);
                terms.push((node.0, own));
            }
            terms.push((first.0, at_first));
            Row {
                terms,
                flexibility: 1.0,
            }
        };
        Some(Self {
            deformations: (0..rows).map(deformation).collect(),
        })
    }
}

/// Six rows of a column of `matrix`, as a vector in the body's axes, in global axes.
fn global(
    rotation: &Rotation3<f64>,
    matrix: &DMatrix<f64>,
    row: usize,
    column: usize,
) -> Vector6<f64> {
    let part = |start: usize| -> Vector3<f64> {
        rotation * matrix.fixed_view::<3, 1>(start, column).into_owned()
    };
    join(&part(row), &part(row + 3))
}
