//! A joint whose stiffness matrix is positive semidefinite: what it resists and what it does not.

use hyperstat_assembly::{Connection, JointStiffness, Model, SolveError, solve};
use hyperstat_joints::{DofSet, Fixed};
use nalgebra::{Matrix6, Point3, Rotation3, Vector6};

/// A rigid body on a spring of (1, 2, 0) ⊗ (1, 2, 0) 1e6 N/m and 1e6 in the other directions.
fn stone() -> Model {
    let mut k = Matrix6::identity() * 1e6;
    k[(0, 1)] = 2e6;
    k[(1, 0)] = 2e6;
    k[(1, 1)] = 4e6;
    let mut model = Model::new("stone");
    model
        .add_rigid("stone", &[("S", Point3::new(0.1, 0.2, 0.3))])
        .expect("a body");
    let node = model.node("stone", "S").expect("a node");
    let joint = Connection {
        name: "spring".into(),
        between: [None, Some(node)],
        joint: Box::new(Fixed),
        locked: DofSet::EMPTY,
        stiffness: JointStiffness::Matrix(k),
    };
    model
        .add_joint(joint, Rotation3::identity())
        .expect("a joint");
    model.set_output(node);
    model
}

#[test]
fn the_null_direction_is_the_free_motion() {
    let solution = solve(&stone()).expect("a solution");
    let [free] = solution.output.free_motions[..] else {
        panic!("{:?}", solution.output.free_motions)
    };
    assert!((free[0] / free[1] + 2.0).abs() < 1e-12, "{free}");
    assert!(free.fixed_rows::<4>(2).amax() < 1e-12);
}

#[test]
fn loads_across_it_are_resisted() {
    let mut model = stone();
    let node = model.output().expect("an output");
    let load = Vector6::new(1.0, 2.0, 0.0, 0.0, 0.0, 0.0);
    model.add_load(node, load).expect("finite");
    let u = solve(&model).expect("a solution").output.displacement;
    // 1e6 (1, 2) (1, 2)·u = (1, 2): (1, 2)·u = 1e-6.
    assert!((u[0] + 2.0 * u[1] - 1e-6).abs() < 1e-18, "{u}");
}

#[test]
fn loads_along_it_are_refused() {
    let mut model = stone();
    let node = model.output().expect("an output");
    let load = Vector6::new(1.0, 1.0, 0.0, 0.0, 0.0, 0.0);
    model.add_load(node, load).expect("finite");
    let result = solve(&model).map(|_| ());
    assert!(
        matches!(result, Err(SolveError::LoadOnFreeMotion { .. })),
        "{result:?}"
    );
}
