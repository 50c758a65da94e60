//! The method the paper compares with: every joint a spring (Eqs. 48–50, 66), rigid bodies by
//! Lagrange multipliers (Deblaise, Hernot, Maurine, ICRA 2006), in two forms: the springs in the
//! stiffness matrix, or their wrenches as multipliers too.

use hyperstat_joints::Dof;
use hyperstat_model::Model;
use nalgebra::{DMatrix, Matrix6, Vector6};

use crate::error::ReferenceError;
use crate::joint::{JointConditions, is_open};
use crate::structure::Structure;

/// How the springs of the joints come into the equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TraditionalForm {
    /// Their stiffness K_J is added to that of the beams: displacements alone are unknown.
    Penalty,
    /// Their wrenches are unknown too, Lagrange multipliers of `u_1 − u_2 − K_J⁻¹ W_J = 0`, as
    /// Deblaise et al. have it. K_J is inverted on the way: no direction may have the stiffness 0.
    Lagrange,
}

/// Stiffness of the springs that stand for rigid and for free directions of joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TraditionalOptions {
    /// How the springs come into the equations.
    pub form: TraditionalForm,
    /// Of a translation that is rigid [N/m].
    pub joint_stiffness: f64,
    /// Of a rotation that is rigid [N·m/rad].
    pub angular_stiffness: f64,
    /// Of a direction that is free [N·m/rad, N/m]: 0, or 1e-7 as Deblaise et al. took it, because
    /// their form inverts the joints' stiffness.
    pub free_stiffness: f64,
}

/// What the traditional method finds, as accurate as it happens to be.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct TraditionalSolution {
    /// The output's stiffness, global axes, linear part first: the inverse of its compliance.
    pub stiffness: Matrix6<f64>,
    /// The output's displacement under the loads.
    pub displacement: Vector6<f64>,
    /// Number of equations: six for every node, six multipliers for every node of a rigid body but
    /// its first, and in the form of Lagrange six for every joint.
    pub equations: usize,
}

/// Solves a model as the paper says that it used to be done.
///
/// `W_J = K_J (u_1 − u_2)` at every joint (Eq. 66), with K_J diagonal in the joint's directions.
/// A direction that the model makes elastic keeps its own stiffness; one that is rigid or locked
/// gets the stiffness of `options`. The equations, of beams, springs and multipliers, are solved
/// by dense LU with partial pivoting as they stand, neither scaled nor refined.
///
/// # Errors
/// As [`solve`](crate::solve); [`ReferenceError::Loads`] where more acts than global wrenches on
/// nodes; [`ReferenceError::Singular`] where elimination meets a zero pivot or gives numbers that
/// are not finite, and in the form of Lagrange where a direction of a joint has the stiffness 0.
pub fn traditional(
    model: &Model,
    options: &TraditionalOptions,
) -> Result<TraditionalSolution, ReferenceError> {
    if !model.has_plain_loads() {
        return Err(ReferenceError::Loads);
    }
    let structure = Structure::new(model)?;
    let coordinates = 6 * structure.positions.len();
    let multipliers = coordinates + structure.rigid_bodies.len();
    let equations = match options.form {
        TraditionalForm::Penalty => multipliers,
        TraditionalForm::Lagrange => multipliers + 6 * structure.joints.len(),
    };
    let mut matrix = DMatrix::zeros(equations, equations);
    for element in &structure.elements {
        let stiffness = element.stiffness();
        for (r, i) in element.nodes.iter().enumerate() {
            for (c, j) in element.nodes.iter().enumerate() {
                let mut block = matrix.fixed_view_mut::<6, 6>(6 * i, 6 * j);
                block += stiffness.fixed_view::<6, 6>(6 * r, 6 * c);
            }
        }
    }
    for row in structure.flexibles.iter().flat_map(|f| &f.deformations) {
        for (i, a) in &row.terms {
            for (j, b) in &row.terms {
                let mut block = matrix.fixed_view_mut::<6, 6>(6 * i, 6 * j);
                block += a * b.transpose() / row.flexibility;
            }
        }
    }
    for (k, (connection, joint)) in model.joints().iter().zip(&structure.joints).enumerate() {
        let open = |dof: &Dof| is_open(connection, *dof);
        let free: Vec<Dof> = Dof::ALL.into_iter().filter(open).collect();
        let stiffness = spring(joint, &free, options);
        match options.form {
            TraditionalForm::Penalty => add_spring(&mut matrix, joint, &stiffness),
            TraditionalForm::Lagrange => {
                let flexibility = stiffness.try_inverse().ok_or(ReferenceError::Singular)?;
                add_multipliers(&mut matrix, joint, &flexibility, multipliers + 6 * k);
            }
        }
    }
    for (k, row) in structure.rigid_bodies.iter().enumerate() {
        for (node, a) in &row.terms {
            let place = coordinates + k;
            matrix.fixed_view_mut::<6, 1>(6 * node, place).copy_from(a);
            matrix
                .fixed_view_mut::<1, 6>(place, 6 * node)
                .copy_from(&a.transpose());
        }
    }

    let output = 6 * structure.output;
    let mut columns = DMatrix::zeros(equations, 7);
    for component in 0..6 {
        columns[(output + component, component)] = 1.0;
    }
    for load in model.loads() {
        let mut block = columns.fixed_view_mut::<6, 1>(6 * load.node.0, 6);
        block += load.wrench;
    }
    if !matrix.lu().solve_mut(&mut columns) || !columns.iter().all(|x| x.is_finite()) {
        return Err(ReferenceError::Singular);
    }
    let compliance = columns.fixed_view::<6, 6>(output, 0).into_owned();
    Ok(TraditionalSolution {
        stiffness: compliance.try_inverse().ok_or(ReferenceError::Singular)?,
        displacement: columns.fixed_view::<6, 1>(output, 6).into_owned(),
        equations,
    })
}

/// K_J over the joint's coordinates.
fn spring(joint: &JointConditions, free: &[Dof], options: &TraditionalOptions) -> Matrix6<f64> {
    let mut stiffness = Matrix6::zeros();
    for hold in &joint.holds {
        let k = if hold.flexibility > 0.0 {
            1.0 / hold.flexibility
        } else if hold.combination.fixed_rows::<3>(0).amax() > 0.0 {
            options.joint_stiffness
        } else {
            options.angular_stiffness
        };
        stiffness += hold.combination * hold.combination.transpose() * k;
    }
    for dof in free {
        let place = (dof.index(), dof.index());
        if stiffness[place] == 0.0 {
            stiffness[place] = options.free_stiffness;
        }
    }
    stiffness
}

fn add_spring(matrix: &mut DMatrix<f64>, joint: &JointConditions, stiffness: &Matrix6<f64>) {
    let global = joint.global_stiffness(stiffness);
    let between = joint.between();
    for (r, row) in between.iter().enumerate() {
        for (c, column) in between.iter().enumerate() {
            if let (Some(i), Some(j)) = (row, column) {
                let sign = if r == c { 1.0 } else { -1.0 };
                let mut block = matrix.fixed_view_mut::<6, 6>(6 * i, 6 * j);
                block += global * sign;
            }
        }
    }
}

/// Adds the equations `u_1 − u_2 − K_J⁻¹ W_J = 0` of a joint, and its wrench to the equilibrium of
/// its nodes; both over its coordinates, from `place` on.
fn add_multipliers(
    matrix: &mut DMatrix<f64>,
    joint: &JointConditions,
    flexibility: &Matrix6<f64>,
    place: usize,
) {
    for (row, unit) in Matrix6::identity().column_iter().enumerate() {
        let row = place + row;
        for (node, a) in joint.row(&unit.into_owned(), 0.0).terms {
            let mut column = matrix.fixed_view_mut::<6, 1>(6 * node, row);
            column += a;
            let mut across = matrix.fixed_view_mut::<1, 6>(row, 6 * node);
            across += a.transpose();
        }
    }
    let mut block = matrix.fixed_view_mut::<6, 6>(place, place);
    block -= flexibility;
}
