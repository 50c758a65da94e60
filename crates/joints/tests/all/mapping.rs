//! The checked constructor of a mapping, and its forms.

use hyperstat_joints::{Cylindrical, Dof, DofSet, Fixed, Joint, JointError, Mapping};
use nalgebra::{Matrix6, Rotation3, Vector6};

/// A hinge about z.
fn parts() -> (DofSet, Vector6<f64>, Matrix6<f64>) {
    let mut n_j = Matrix6::identity();
    n_j[(5, 5)] = 0.0;
    (DofSet::new(&[Dof::W]), Vector6::ith(5, 1.0), n_j)
}

#[test]
fn right_parts_are_taken_as_they_are() {
    let (idcs, column, n_j) = parts();
    let mapping = Mapping::new(idcs, &[column], n_j).unwrap();
    assert_eq!((mapping.idcs(), mapping.len()), (idcs, 1));
    assert_eq!(mapping.n_i(), [column]);
    assert_eq!(mapping.n_j(), &n_j);
}

#[test]
fn as_many_columns_as_idcs() {
    let (idcs, column, n_j) = parts();
    for columns in [vec![], vec![column; 2], vec![column; 7]] {
        let error = Mapping::new(idcs, &columns, n_j).unwrap_err();
        let columns = columns.len();
        assert_eq!(error, JointError::ColumnCount { idcs: 1, columns });
    }
}

#[test]
fn entries_must_be_finite() {
    let (idcs, mut column, mut n_j) = parts();
    n_j[(0, 1)] = f64::INFINITY;
    let error = Mapping::new(idcs, &[column], n_j).unwrap_err();
    assert!(matches!(error, JointError::NotFinite { .. }));
    column[0] = f64::NAN;
    let error = Mapping::new(idcs, &[column], parts().2).unwrap_err();
    assert!(matches!(error, JointError::NotFinite { .. }));
}

#[test]
fn the_row_at_an_idc_must_be_the_identitys() {
    let (idcs, column, n_j) = parts();
    let wrong = JointError::NotIdentity { idc: Dof::W };
    assert_eq!(Mapping::new(idcs, &[column * 0.5], n_j), Err(wrong.clone()));
    assert_eq!(
        Mapping::new(idcs, &[column], Matrix6::identity()),
        Err(wrong)
    );
}

#[test]
fn rounding_in_the_row_at_an_idc_is_cleaned() {
    let (idcs, mut column, mut n_j) = parts();
    column[5] += 1e-15;
    n_j[(5, 2)] = -1e-16;
    let mapping = Mapping::new(idcs, &[column], n_j).unwrap();
    assert_eq!(mapping.matrix().row(5).iter().sum::<f64>(), 1.0);
    assert_eq!(mapping.column(0)[5], 1.0);
}

#[test]
fn body_to_body_has_six_columns_more_than_body_to_ground() {
    let frame = Rotation3::from_euler_angles(0.3, -0.4, 1.2);
    let mapping = Cylindrical.mapping(&frame, Cylindrical.free()).unwrap();
    let n = mapping.matrix();
    assert_eq!(n.shape(), (6, 8));
    assert_eq!(n.columns(0, 2), mapping.ground_matrix());
    assert_eq!(n.columns(2, 6), *mapping.n_j());
    assert_eq!(mapping.ground_matrix().column(1), *mapping.column(1));
}

#[test]
fn a_weld_has_no_idc_of_its_own() {
    let mapping = Fixed
        .mapping(&Rotation3::identity(), DofSet::EMPTY)
        .unwrap();
    assert!(mapping.is_empty());
    assert_eq!(mapping.ground_matrix().shape(), (6, 0));
    assert_eq!(mapping.matrix(), Matrix6::identity());
}
