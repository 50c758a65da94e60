//! The independent solver.

use hyperstat_model::Model;
use nalgebra::{DVector, Matrix6, Vector6};

use crate::error::ReferenceError;
use crate::independence::RANK_TOLERANCE;
use crate::kinematics::{FreeMotions, Redundancy, mobility};
use crate::row::Row;
use crate::saddle::{Equilibrium, Saddle};
use crate::states::states;
use crate::structure::Structure;

/// What the independent solver finds; global axes, SI units, linear part first.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct ReferenceSolution {
    /// Instantaneous mobility: every body rigid, every direction that is free by its joint's kind,
    /// or by a stiffness of zero, released; idle motions included.
    pub mobility: usize,
    /// Constraints less their rank, every body rigid.
    pub overconstraint: usize,
    /// Number of motions without energy that leave the output where it is, drives locked.
    pub idle_modes: usize,
    /// The output's motions without energy, drives locked: an orthonormal basis.
    pub free_motions: Vec<Vector6<f64>>,
    /// The output's stiffness: the wrench that moves it by a unit of each component
    /// (column by column); `None` where it is held rigidly in some direction.
    pub stiffness: Option<Matrix6<f64>>,
    /// The output's compliance: its displacement under a unit of each component of a wrench;
    /// `None` where it has a free motion.
    pub compliance: Option<Matrix6<f64>>,
    /// The output's displacement under the loads; `None` where it has a free motion.
    pub displacement: Option<Vector6<f64>>,
    /// Displacement of every node under the loads, the body's own, by `NodeId`. Motions without
    /// energy are left out of it (least squares over all nodes, lengths over the size).
    pub displacements: Vec<Vector6<f64>>,
    /// Wrench on the second body of every joint, at the joint, in the joint frame, by `JointId`;
    /// `None` where redundant rigid constraints leave it undetermined.
    pub joint_wrenches: Vec<Option<Vector6<f64>>>,
    /// What the model's cases do, in their order.
    pub cases: Vec<ReferenceState>,
    /// Relative change of the displacements where refinement settled, the worst of all solves:
    /// near 1e-16 where the numbers are as good as doubles are.
    pub last_change: f64,
}

/// What loads that act together do, with the weight and the temperatures that act always.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct ReferenceState {
    /// As [`ReferenceSolution::displacement`].
    pub displacement: Option<Vector6<f64>>,
    /// As [`ReferenceSolution::displacements`].
    pub displacements: Vec<Vector6<f64>>,
    /// As [`ReferenceSolution::joint_wrenches`].
    pub joint_wrenches: Vec<Option<Vector6<f64>>>,
}

/// Solves a model with every node's six displacements as unknowns and every condition as an
/// equation.
///
/// # Errors
/// [`ReferenceError`]: no output, too large a model, a segment, joint or load that cannot be
/// formed, loads of a state that work on a free motion, a system that is too near to singular.
pub fn solve(model: &Model) -> Result<ReferenceSolution, ReferenceError> {
    let structure = Structure::new(model)?;
    let (mobility, overconstraint) = mobility(model, &structure);
    let motions = FreeMotions::of(model, &structure);
    let states = states(model, &structure)?;
    for state in &states {
        if let Some(driven) = motions.driven(&structure, &state.loads) {
            return Err(unrestrained(model, &motions, &driven));
        }
    }
    let redundancy = Redundancy::of(model, &structure);
    let rows = Rows::of(&structure, &redundancy);
    let free_motions = motions.of_output(&structure);
    let held = |basis: &[DVector<f64>]| -> Vec<Row> {
        basis
            .iter()
            .map(|motion| motions.pieces.held(motion))
            .collect()
    };

    let loaded = rows.with(held(&motions.all));
    let system = Saddle::new(structure.positions.len(), &loaded, rows.elements);
    let at_rest = DVector::zeros(loaded.len());
    let no_load = DVector::zeros(6 * structure.positions.len());
    let misfits = rows.misfits(&structure, &redundancy, loaded.len());
    let mut last_change = 0.0_f64;
    let mut found = Vec::with_capacity(states.len());
    for state in &states {
        let mut deformations = misfits.clone();
        let mut own = deformations.rows_mut(0, state.deformations.len());
        own += &state.deformations;
        let under_load = system.solve(&(&state.loads + &structure.preloads), &deformations)?;
        if !model.misfits().is_empty()
            && let Some(joint) = unmet(&structure, &redundancy, &under_load.displacement)
        {
            let joint = model.joints()[joint].name.clone();
            return Err(ReferenceError::Misfit { joint });
        }
        last_change = last_change.max(under_load.change);
        let at = |node| node_displacement(&under_load, node);
        found.push(ReferenceState {
            displacement: (free_motions.is_empty()).then(|| at(structure.output)),
            displacements: (0..model.nodes().len()).map(at).collect(),
            joint_wrenches: rows.joint_wrenches(&structure, &redundancy, &under_load.forces),
        });
    }
    // The first state is the model's own.
    let base = found.remove(0);
    let mut output_columns = |solve: &dyn Fn(usize) -> Result<UnitColumn, ReferenceError>| {
        let mut matrix = Matrix6::zeros();
        for component in 0..6 {
            let column = solve(component)?;
            matrix.set_column(component, &column.values);
            last_change = last_change.max(column.change);
        }
        Ok::<_, ReferenceError>(matrix)
    };

    let compliance = if free_motions.is_empty() {
        Some(output_columns(&|component| {
            let mut load = no_load.clone();
            load[6 * structure.output + component] = 1.0;
            let found = system.solve(&load, &at_rest)?;
            Ok(UnitColumn::displacement(&found, structure.output))
        })?)
    } else {
        None
    };
    let stiffness = if redundancy.output_moves {
        let mut moved = rows.with(held(&motions.idle));
        let first = moved.len();
        moved.extend(structure.output_rows());
        let system = Saddle::new(structure.positions.len(), &moved, rows.elements);
        Some(output_columns(&|component| {
            let mut prescribed = DVector::zeros(moved.len());
            prescribed[first + component] = 1.0;
            let found = system.solve(&no_load, &prescribed)?;
            Ok(UnitColumn::reaction(&found, first))
        })?)
    } else {
        None
    };

    Ok(ReferenceSolution {
        mobility,
        overconstraint,
        idle_modes: motions.idle.len(),
        displacement: base.displacement,
        free_motions,
        stiffness,
        compliance,
        displacements: base.displacements,
        joint_wrenches: base.joint_wrenches,
        cases: found,
        last_change,
    })
}

/// A joint with a condition that was left out as one that follows from others, and is not met: by
/// more of the largest displacement (lengths over the size) than tells such conditions.
fn unmet(
    structure: &Structure,
    redundancy: &Redundancy,
    displacement: &DVector<f64>,
) -> Option<usize> {
    let lengths = [structure.size, 1.0];
    let scaled = |k: usize| displacement[k] / lengths[k % 6 / 3];
    let largest = (0..displacement.len()).fold(0.0_f64, |largest, k| largest.max(scaled(k).abs()));
    let joints = structure.joints.iter().zip(&redundancy.dropped);
    let open = |(joint, dropped): (&crate::joint::JointConditions, &Vec<bool>)| {
        let left_out = joint
            .holds
            .iter()
            .zip(dropped)
            .filter(|(_, dropped)| **dropped);
        left_out.fold(0.0_f64, |open, (hold, _)| {
            let row = joint.row(&hold.combination, 0.0);
            let gap = row.apply(&displacement.as_view()) - joint.at_rest(&hold.combination);
            let terms = row.terms.iter().flat_map(|(_, a)| a.iter().enumerate());
            let length = terms
                .map(|(k, a)| (a * lengths[k / 3]).powi(2))
                .sum::<f64>();
            open.max(gap.abs() / length.sqrt())
        })
    };
    joints
        .map(open)
        .position(|open| open > RANK_TOLERANCE * largest)
}

fn node_displacement(found: &Equilibrium, node: usize) -> Vector6<f64> {
    found.displacement.fixed_rows::<6>(6 * node).into()
}

fn unrestrained(model: &Model, motions: &FreeMotions, driven: &DVector<f64>) -> ReferenceError {
    let travel = |node: usize| motions.pieces.at_node(driven, node).norm();
    let farthest = (0..model.nodes().len()).max_by(|a, b| travel(*a).total_cmp(&travel(*b)));
    let body = farthest.map(|node| &model.bodies()[model.nodes()[node].body.0]);
    ReferenceError::Unrestrained {
        body: body.map_or_else(String::new, |body| body.name.clone()),
    }
}

/// One column of the output's stiffness or compliance.
struct UnitColumn {
    values: Vector6<f64>,
    change: f64,
}

impl UnitColumn {
    fn displacement(found: &Equilibrium, output: usize) -> Self {
        Self {
            values: node_displacement(found, output),
            change: found.change,
        }
    }

    /// The wrench that moves the output: opposite to the forces of the six rows from `first` on,
    /// which balance the mechanism's.
    fn reaction(found: &Equilibrium, first: usize) -> Self {
        Self {
            values: -Vector6::from(found.forces.fixed_rows::<6>(first)),
            change: found.change,
        }
    }
}

/// All rows of a structure, without those that follow from others: first the elements', then the
/// rigid bodies', then the joints'.
struct Rows {
    rows: Vec<Row>,
    /// Number of the elements' rows.
    elements: usize,
    /// Number of the elements' and rigid bodies' rows.
    before_joints: usize,
}

impl Rows {
    fn of(structure: &Structure, redundancy: &Redundancy) -> Self {
        let mut rows = structure.deformations();
        let elements = rows.len();
        rows.extend(structure.rigid_bodies.iter().cloned());
        let before_joints = rows.len();
        for (joint, dropped) in structure.joints.iter().zip(&redundancy.dropped) {
            let kept = joint
                .holds
                .iter()
                .zip(dropped)
                .filter(|(_, dropped)| !**dropped);
            rows.extend(kept.map(|(hold, _)| joint.row(&hold.combination, hold.flexibility)));
        }
        Self {
            rows,
            elements,
            before_joints,
        }
    }

    fn with(&self, more: Vec<Row>) -> Vec<Row> {
        self.rows.iter().cloned().chain(more).collect()
    }

    /// What all rows are when they bear nothing, the first of `count` being these.
    fn misfits(
        &self,
        structure: &Structure,
        redundancy: &Redundancy,
        count: usize,
    ) -> DVector<f64> {
        let mut at_rest = DVector::zeros(count);
        let mut next = self.before_joints;
        for (joint, dropped) in structure.joints.iter().zip(&redundancy.dropped) {
            for (hold, _) in joint
                .holds
                .iter()
                .zip(dropped)
                .filter(|(_, dropped)| !**dropped)
            {
                at_rest[next] = joint.at_rest(&hold.combination);
                next += 1;
            }
        }
        at_rest
    }

    fn joint_wrenches(
        &self,
        structure: &Structure,
        redundancy: &Redundancy,
        forces: &DVector<f64>,
    ) -> Vec<Option<Vector6<f64>>> {
        let mut next = self.before_joints;
        let mut wrenches = Vec::with_capacity(structure.joints.len());
        for (j, joint) in structure.joints.iter().enumerate() {
            let along: Vec<f64> = (redundancy.dropped[j].iter())
                .map(|dropped| {
                    if *dropped {
                        return 0.0;
                    }
                    next += 1;
                    forces[next - 1]
                })
                .collect();
            wrenches.push((!redundancy.undetermined[j]).then(|| joint.wrench(along)));
        }
        wrenches
    }
}
