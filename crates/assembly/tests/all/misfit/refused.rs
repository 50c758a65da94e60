//! Misfits and preloads that are refused.

use super::*;

#[test]
fn misfits_and_preloads_have_their_directions() {
    let (mut model, hinge, _) = hinged();
    let refused = model
        .set_misfit(hinge, &only(Dof::V, 1e-3))
        .expect_err("free");
    assert!(matches!(
        refused,
        ModelError::FreeMisfit {
            direction: Dof::V,
            ..
        }
    ));
    let refused = model
        .set_preload(hinge, &only(Dof::Z, 1.0))
        .expect_err("rigid");
    assert!(matches!(
        refused,
        ModelError::RigidPreload {
            direction: Dof::Z,
            ..
        }
    ));
    for wrong in [f64::NAN, f64::INFINITY] {
        let values = only(Dof::X, wrong);
        assert!(model.set_misfit(hinge, &values).is_err());
        assert!(model.set_preload(hinge, &values).is_err());
    }
    assert!(model.misfits().is_empty());
    assert_eq!(model.misfit(hinge), None);
}

#[test]
fn a_preload_on_a_motion_that_nothing_resists_is_refused() {
    let mut model = Model::new("spinner");
    let points = [("A", Point3::origin()), ("B", Point3::new(0.0, 0.1, 0.0))];
    model.add_rigid("wheel", &points).expect("a body");
    let a = model.node("wheel", "A");
    let rigid = JointStiffness::default();
    let axle = add(
        &mut model,
        "axle",
        [None, a],
        Revolute,
        rigid,
        Rotation3::identity(),
    );
    model.set_output(a.expect("a node"));
    model
        .set_preload(axle, &only(Dof::V, 1.0))
        .expect("a preload");
    let refused = solve(&model).expect_err("it spins");
    assert_eq!(
        refused.to_string(),
        "the preload of joint `axle` works on a motion that nothing resists: `wheel` turns about \
         its own axis (0, 1, 0)"
    );
    let wheel = model.body("wheel").expect("a body");
    assert!(matches!(refused, SolveError::PreloadOnFreeMotion { body, .. } if body == wheel));

    // A load that does more work is the one to blame.
    let load = Load {
        node: model.node("wheel", "B").expect("a node"),
        wrench: only(Dof::V, 5.0),
        axes: Axes::Global,
    };
    let nodes = vec![load];
    let lines = Vec::new();
    model.set_loads(LoadSet { nodes, lines }).expect("loads");
    let refused = solve(&model).expect_err("it spins");
    assert!(matches!(
        refused,
        SolveError::LoadOnFreeMotion { load: Some(0), .. }
    ));
}
