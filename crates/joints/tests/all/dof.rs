//! Directions and sets of them.

use hyperstat_joints::{Dof, DofSet, JointError};

#[test]
fn directions_are_in_the_order_of_a_displacement() {
    for (k, dof) in Dof::ALL.into_iter().enumerate() {
        assert_eq!(dof.index(), k);
        assert_eq!(dof.is_rotation(), k >= 3);
        assert_eq!(dof.to_string().parse(), Ok(dof));
    }
    assert_eq!(Dof::ALL.map(Dof::name).concat(), "xyzuvw");
    assert_eq!(format!("[{:>3}]", Dof::V), "[  v]");
}

#[test]
fn another_name_is_an_error_that_lists_the_right_ones() {
    let error = "Y".parse::<Dof>().unwrap_err();
    assert_eq!(error, JointError::UnknownDirection { text: "Y".into() });
    let message = error.to_string();
    assert!(
        message.contains("`Y`") && message.contains("x, y, z, u, v, w"),
        "{message}"
    );
}

#[test]
fn sets_behave_as_sets() {
    const HINGE: DofSet = DofSet::new(&[Dof::V]);
    let mut set: DofSet = [Dof::W, Dof::Y, Dof::W].into_iter().collect();
    assert_eq!(set, DofSet::new(&[Dof::Y, Dof::W]));
    assert_eq!(set.iter().collect::<Vec<_>>(), [Dof::Y, Dof::W]);
    assert_eq!(
        (set.len(), set.is_empty(), set.bits()),
        (2, false, 0b10_0010)
    );
    assert!(set.contains(Dof::W) && !set.contains(Dof::V));

    assert_eq!(set.union(HINGE).len(), 3);
    assert_eq!(set.intersection(HINGE), DofSet::EMPTY);
    assert_eq!(
        set.difference(DofSet::new(&[Dof::Y])),
        DofSet::new(&[Dof::W])
    );
    assert_eq!(set.complement().union(set), DofSet::ALL);
    assert_eq!(set.complement().intersection(set), DofSet::EMPTY);

    set.insert(Dof::V);
    set.remove(Dof::W);
    set.remove(Dof::X);
    assert_eq!(set.to_string(), "y v");
    assert_eq!(format!("{set:?}"), "{Y, V}");
    assert_eq!(DofSet::EMPTY.to_string(), "–");
    assert_eq!(DofSet::default(), DofSet::EMPTY);
}
