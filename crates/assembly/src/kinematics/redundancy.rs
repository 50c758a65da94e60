//! Redundant constraints: which directions of which joints say the same thing more than once.

use hyperstat_joints::Dof;
use hyperstat_model::{JointId, Model};

use super::jacobian::{Eliminated, Jacobian};
use crate::rank::dense::{Elimination, RANK_TOLERANCE};
use crate::rank::echelon::echelon;
use crate::rank::sparse::SparseElimination;

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

/// Most redundancies of a large mechanism that are found one by one: more than are read.
const MOST: usize = 1000;

/// The redundant constraints, which elimination left out, each with as few directions as it finds. Of
/// a large mechanism, the first 1000.
pub(crate) fn redundancies(constraints: &Jacobian, eliminated: &Eliminated) -> Vec<Redundancy> {
    // Forces that balance: λᵀ J = 0.
    if let Eliminated::Sparse(eliminated) = eliminated {
        return sparsely_redundant(constraints, eliminated, MOST);
    }
    let balanced = Elimination::new(constraints.dense().transpose(), 0).null_space();
    let balanced = echelon(balanced);
    let shares = balanced.iter().map(|v| v.iter().copied().enumerate());
    shares.map(|v| redundancy(constraints, v)).collect()
}

/// The first `most` redundancies by elimination of sparse rows.
fn sparsely_redundant(
    constraints: &Jacobian,
    eliminated: &SparseElimination,
    most: usize,
) -> Vec<Redundancy> {
    let rows = eliminated.redundant.iter().take(most);
    rows.map(|row| {
        let mut shares = eliminated.dependence(*row);
        let largest = shares.iter().fold(0.0_f64, |l, (_, v)| l.max(v.abs()));
        for (_, share) in &mut shares {
            *share /= largest;
        }
        redundancy(constraints, shares)
    })
    .collect()
}

/// The redundancy of balanced forces, by rows of the constraints.
fn redundancy(
    constraints: &Jacobian,
    shares: impl IntoIterator<Item = (usize, f64)>,
) -> Redundancy {
    let shares = shares.into_iter();
    let shares = shares.filter(|(_, share)| share.abs() > RANK_TOLERANCE);
    let named = shares.map(|(row, share)| {
        let (joint, dof) = constraints.directions[row];
        (joint, dof, share)
    });
    Redundancy {
        directions: named.collect(),
    }
}

#[cfg(test)]
mod tests {
    use hyperstat_joints::{DofSet, Revolute, frame_from_axis};
    use nalgebra::{DMatrix, Point3, Vector3};

    use super::*;
    use crate::error::SolveError;
    use crate::kinematics::Kinematics;
    use crate::kinematics::diagnosis::Diagnosis;
    use crate::posture::Posture;
    use hyperstat_model::{Connection, JointStiffness};

    /// A parallelogram in the x-y plane: three rigid bars and the ground, four hinges about z.
    fn parallelogram() -> Model {
        let mut model = Model::new("parallelogram");
        add_parallelogram(&mut model, "");
        model
    }

    /// Adds one whose names end in `suffix`.
    fn add_parallelogram(model: &mut Model, suffix: &str) {
        let named = |name: &str| format!("{name}{suffix}");
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
            let points = [(p, at(p)), (q, at(q))];
            model.add_rigid(&named(body), &points).unwrap();
        }
        let node = |body, point| model.node(&named(body), point);
        let joints = [
            ("a", None, node("left", "A")),
            ("b", node("left", "B"), node("top", "B")),
            ("c", node("top", "C"), node("right", "C")),
            ("d", node("right", "D"), None),
        ];
        for (name, first, second) in joints {
            let connection = Connection {
                name: named(name),
                between: [first, second],
                joint: Box::new(Revolute),
                locked: DofSet::EMPTY,
                stiffness: JointStiffness::default(),
            };
            let frame = frame_from_axis(Some(&Vector3::z()), Some(&Vector3::x())).unwrap();
            model.add_joint(connection, frame).unwrap();
        }
    }

    fn at(model: &Model) -> Posture<'_> {
        Posture::new(model, model.geometry())
    }

    fn redundant_constraints(model: &Model) -> Vec<Redundancy> {
        Diagnosis::default().redundancies(&at(model))
    }

    fn analyse(model: &Model) -> Result<Kinematics, SolveError> {
        Diagnosis::default().kinematics(&at(model)).cloned()
    }

    #[test]
    fn a_plane_loop_is_redundant_out_of_its_plane_only() {
        let model = parallelogram();
        let redundant = redundant_constraints(&model);
        assert_eq!(
            redundant.len(),
            analyse(&model).expect("a small model").overconstraint
        );
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
        let whole = Jacobian::released(&at(&model));
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
        let [motion] = &analyse(&model).expect("a small model").motions[..] else {
            panic!("one motion");
        };
        let hinges = [0, 1, 2, 3].map(|joint| (JointId(joint), Dof::V));
        assert_eq!(motion.free_directions(&model), hinges);
    }

    #[test]
    fn the_shares_balance() {
        for count in [1, 20] {
            let mut model = Model::new("parallelograms");
            for k in 0..count {
                add_parallelogram(&mut model, &format!("-{k}"));
            }
            let constraints = Jacobian::released(&at(&model));
            assert_eq!(constraints.is_large(), count > 1);
            let redundant = redundant_constraints(&model);
            assert_eq!(redundant.len(), 3 * count);
            for redundancy in redundant {
                let mut shares = DMatrix::zeros(1, constraints.directions.len());
                for (joint, dof, share) in redundancy.directions {
                    let row = constraints
                        .directions
                        .iter()
                        .position(|d| *d == (joint, dof));
                    shares[row.unwrap()] = share;
                }
                assert_eq!(shares.amax(), 1.0);
                assert!((shares * constraints.dense()).amax() < 1e-14);
            }
        }
    }
}
