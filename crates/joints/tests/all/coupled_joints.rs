//! Joints whose motions are not along single axes of their frame.

use hyperstat_joints::testing::{assert_conforms, frames};
use hyperstat_joints::{Dof, DofSet, Joint, JointError, Mapping, Revolute, Screw};
use nalgebra::{Matrix6, Rotation3, Vector3, Vector6};

/// A joint that is its basis.
#[derive(Debug, Clone)]
struct Coupled {
    free: DofSet,
    basis: Matrix6<f64>,
}

impl Joint for Coupled {
    fn kind(&self) -> &str {
        "Coupled"
    }

    fn free(&self) -> DofSet {
        self.free
    }

    fn basis(&self) -> Matrix6<f64> {
        self.basis
    }

    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(self.clone())
    }
}

fn coupled(entries: &[(usize, usize, f64)]) -> Coupled {
    let mut basis = Matrix6::identity();
    for &(row, column, entry) in entries {
        basis[(row, column)] = entry;
    }
    Coupled {
        free: DofSet::ALL,
        basis,
    }
}

/// Two screws of different pitch on one axis: their difference is a pure translation, so one
/// rotation and one translation are independent, as in a cylindrical joint.
#[test]
fn two_pitches_make_a_cylindrical_joint() {
    let mut joint = coupled(&[(1, 4, 0.01), (1, 1, 0.002), (4, 1, 1.0)]);
    joint.free = DofSet::new(&[Dof::Y, Dof::V]);
    assert_conforms(&joint);
    for frame in frames() {
        let mapping = joint.mapping(&frame, joint.free).unwrap();
        let cylindrical = Mapping::of(&Matrix6::identity(), &frame, joint.free).unwrap();
        assert_eq!(mapping.idcs(), cylindrical.idcs());
        assert!((mapping.matrix() - cylindrical.matrix()).amax() < 1e-14);
    }
}

/// A screw stated by its travel, one unit of which turns it by 1/p.
#[test]
fn a_screw_stated_by_its_travel_is_the_same_screw() {
    let joint = coupled(&[(4, 1, 1.0 / 0.002)]);
    assert_conforms(&joint);
    let screw = Screw::new(0.002).unwrap();
    for frame in frames() {
        let by_travel = joint.mapping(&frame, DofSet::new(&[Dof::Y])).unwrap();
        let by_angle = screw.mapping(&frame, screw.free()).unwrap();
        assert_eq!(by_travel.idcs(), by_angle.idcs());
        assert!((by_travel.matrix() - by_angle.matrix()).amax() < 1e-15);
    }
}

/// Three rotations about skew axes: the rotations are those of a spherical joint, each with a
/// travel of its own.
#[test]
fn three_skew_axes() {
    assert_conforms(&coupled(&[
        (1, 3, 0.05),
        (2, 4, -0.02),
        (0, 5, 0.3),
        (4, 3, 0.4),
    ]));
}

/// A twist basis at a point away from the axes, as a product of rotations leaves it: the noise
/// where zeros are meant makes no rotation of a translation.
#[test]
fn noise_in_a_translation_is_not_a_rotation() {
    let joint = coupled(&[(3, 1, 6e-17), (5, 1, -3e-17), (0, 4, 0.1)]);
    let mapping = joint
        .mapping(&Rotation3::identity(), DofSet::new(&[Dof::Y]))
        .unwrap();
    assert_eq!(mapping.idcs(), DofSet::new(&[Dof::Y]));
    assert_conforms(&joint);
}

#[test]
fn motions_that_depend_on_each_other_are_an_error() {
    let joint = coupled(&[(4, 5, 1.0), (5, 5, 0.0)]);
    let frame = Rotation3::identity();
    let error = joint.mapping(&frame, DofSet::ALL).unwrap_err();
    assert_eq!(error, JointError::DependentMotions { direction: Dof::W });
    assert!(joint.mapping(&frame, Revolute.free()).is_ok());
    let all_zero = Mapping::of(&Matrix6::zeros(), &frame, Revolute.free()).unwrap_err();
    assert_eq!(all_zero, JointError::DependentMotions { direction: Dof::V });
}

#[test]
fn what_is_not_finite_is_an_error() {
    let nan = Rotation3::from_matrix_unchecked(nalgebra::Matrix3::repeat(f64::NAN));
    let error = Revolute.mapping(&nan, Revolute.free()).unwrap_err();
    assert!(matches!(error, JointError::NotFinite { what } if what.contains("frame")));
    let joint = coupled(&[(0, 0, f64::INFINITY)]);
    let error = joint
        .mapping(&Rotation3::identity(), DofSet::EMPTY)
        .unwrap_err();
    assert!(matches!(error, JointError::NotFinite { what } if what.contains("basis")));
}

/// All directions moving: body i is free of body j, and N is its six IDCs alone.
#[test]
fn a_joint_without_a_constraint_is_no_tie() {
    for frame in frames() {
        let mapping = Revolute.mapping(&frame, DofSet::ALL).unwrap();
        assert_eq!(mapping.idcs(), DofSet::ALL);
        assert_eq!(mapping.n_j(), &Matrix6::zeros());
        for (k, column) in mapping.n_i().iter().enumerate() {
            assert_eq!(column, &Vector6::ith(k, 1.0));
        }
    }
}

/// The constrained wrenches of the joint do no work on its motions: `Nᵀ` of a wrench on body i
/// and its reaction on body j vanishes exactly where the wrench is one of constraint.
#[test]
fn a_constraint_wrench_does_no_work() {
    let screw = Screw::new(0.3).unwrap();
    for frame in frames() {
        let mapping = screw.mapping(&frame, screw.free()).unwrap();
        // A thrust F y and the torque −p F y that holds it.
        let y = frame * Vector3::y();
        let mut wrench = Vector6::zeros();
        wrench.fixed_rows_mut::<3>(0).copy_from(&y);
        wrench.fixed_rows_mut::<3>(3).copy_from(&(-0.3 * y));
        assert!(mapping.column(0).dot(&wrench).abs() < 1e-15);
        assert!((mapping.n_j().transpose() * wrench - wrench).amax() < 1e-15);
    }
}
