//! Redundant constraints: which directions of which joints say the same thing more than once.

use hyperstat_joints::Dof;

use crate::elimination::{Elimination, RANK_TOLERANCE};
use crate::kinematics::{Jacobian, echelon};
use crate::model::{JointId, Model};

/// Constraints of which one is too many: every body rigid, drives released.
///
/// Any one of `directions` can be freed without giving the mechanism a motion; it takes this
/// redundancy away. Forces along them balance each other without a load: they are what a
/// misfit would cause.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Redundancy {
    /// The directions that take part, by joint, in the order of the model's joints, each with its
    /// share of the balanced forces (forces times the mechanism's size, moments; largest 1).
    pub directions: Vec<(JointId, Dof, f64)>,
}

impl Redundancy {
    /// The directions by name, such as `A1.x`.
    pub fn names(&self, model: &Model) -> Vec<String> {
        let name = |(joint, dof, _): &(JointId, Dof, f64)| {
            format!("{}.{dof}", model.joints()[joint.0].name)
        };
        self.directions.iter().map(name).collect()
    }
}

/// The redundant constraints of a model as it stands: as many as its degree of over-constraint
/// ([`Kinematics::overconstraint`](crate::Kinematics::overconstraint)), each with as few
/// directions as elimination finds.
pub fn redundant_constraints(model: &Model) -> Vec<Redundancy> {
    let constraints = Jacobian::released(model, model.geometry());
    // Forces that balance: λᵀ J = 0.
    let balanced = Elimination::new(constraints.dense().transpose(), 0).null_space();
    echelon(balanced)
        .iter()
        .map(|shares| Redundancy {
            directions: constraints
                .directions
                .iter()
                .zip(shares.iter())
                .filter(|(_, share)| share.abs() > RANK_TOLERANCE)
                .map(|(&(joint, dof), &share)| (joint, dof, share))
                .collect(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use hyperstat_joints::{DofSet, Revolute, frame_from_axis};
    use nalgebra::{DMatrix, Point3, Vector3};

    use super::*;
    use crate::kinematics::analyse;
    use crate::model::{Connection, JointStiffness};

    /// A parallelogram in the x-y plane: three rigid bars and the ground, four hinges about z.
    fn parallelogram() -> Model {
        let mut model = Model::new("parallelogram");
        let at = |name| match name {
            "A" => Point3::new(0.0, 0.0, 0.0),
            "B" => Point3::new(0.0, 1.0, 0.0),
            "C" => Point3::new(2.0, 1.0, 0.0),
            _ => Point3::new(2.0, 0.0, 0.0),
        };
        for (body, [p, q]) in [
            ("left", ["A", "B"]),
            ("top", ["B", "C"]),
            ("right", ["C", "D"]),
        ] {
            model.add_rigid(body, &[(p, at(p)), (q, at(q))]).unwrap();
        }
        let joints = [
            ("a", None, model.node("left", "A")),
            ("b", model.node("left", "B"), model.node("top", "B")),
            ("c", model.node("top", "C"), model.node("right", "C")),
            ("d", model.node("right", "D"), None),
        ];
        for (name, first, second) in joints {
            let connection = Connection {
                name: name.into(),
                between: [first, second],
                joint: Box::new(Revolute),
                locked: DofSet::EMPTY,
                stiffness: JointStiffness::default(),
            };
            let frame = frame_from_axis(Some(&Vector3::z()), Some(&Vector3::x())).unwrap();
            model.add_joint(connection, frame).unwrap();
        }
        model
    }

    #[test]
    fn a_plane_loop_is_redundant_out_of_its_plane_only() {
        let model = parallelogram();
        let redundant = redundant_constraints(&model);
        assert_eq!(redundant.len(), analyse(&model).overconstraint);
        assert_eq!(redundant.len(), 3);
        // y of a joint's frame is z here, u and w tilt out of the plane.
        let mut taking_part: Vec<String> = redundant.iter().flat_map(|r| r.names(&model)).collect();
        taking_part.sort();
        taking_part.dedup();
        let expected =
            ["a", "b", "c", "d"].map(|joint| ["u", "w", "y"].map(|d| format!("{joint}.{d}")));
        assert_eq!(taking_part, expected.concat());
    }

    #[test]
    fn freeing_any_direction_of_a_redundancy_takes_it_away_and_frees_nothing() {
        let model = parallelogram();
        let whole = Jacobian::released(&model, model.geometry());
        let rank = whole.eliminated().rank();
        for redundancy in redundant_constraints(&model) {
            assert!(redundancy.directions.iter().any(|d| d.2.abs() == 1.0));
            for &(joint, dof, _) in &redundancy.directions {
                let row = whole.directions.iter().position(|d| *d == (joint, dof));
                let left = whole.dense().remove_row(row.unwrap());
                assert_eq!(Elimination::new(left, 0).rank(), rank);
            }
        }
    }

    #[test]
    fn the_motion_of_a_loop_names_the_hinges_that_could_be_driven() {
        let model = parallelogram();
        let [motion] = &analyse(&model).motions[..] else {
            panic!("one motion");
        };
        let hinges = [0, 1, 2, 3].map(|joint| (JointId(joint), Dof::V));
        assert_eq!(motion.free_directions(&model), hinges);
    }

    #[test]
    fn the_shares_balance() {
        let model = parallelogram();
        let constraints = Jacobian::released(&model, model.geometry());
        for redundancy in redundant_constraints(&model) {
            let mut shares = DMatrix::zeros(1, constraints.directions.len());
            for (joint, dof, share) in redundancy.directions {
                let row = constraints
                    .directions
                    .iter()
                    .position(|d| *d == (joint, dof));
                shares[row.unwrap()] = share;
            }
            assert!((shares * constraints.dense()).amax() < 1e-14);
        }
    }
}
