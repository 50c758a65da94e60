//! A joint whose stiffness matrix is positive semidefinite: what it resists and what it does not.

use hyperstat_assembly::{Connection, JointStiffness, Model, SolveError, solve};
use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
use hyperstat_joints::{DofSet, Fixed, Joint};
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

/// A mount that gives along one combination of directions alone.
#[derive(Debug, Clone)]
struct Mount(Vector6<f64>);

impl Joint for Mount {
    fn kind(&self) -> &str {
        "Mount"
    }
    fn free(&self) -> DofSet {
        DofSet::EMPTY
    }
    fn compliance(&self) -> Option<Matrix6<f64>> {
        Some(self.0 * self.0.transpose())
    }
    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(self.clone())
    }
}

/// A rod of 0.5 m along x on such a mount, or a rigid bar.
fn mounted(rigid: bool, along: Vector6<f64>) -> Model {
    let mut model = Model::new("mounted");
    let points = [("A", Point3::origin()), ("B", Point3::new(0.5, 0.0, 0.0))];
    if rigid {
        model.add_rigid("rod", &points).expect("a body");
    } else {
        let steel = Material::new(2.1e11, Elasticity::Poisson(0.3), None).expect("a material");
        let shape = SectionShape::Circle { diameter: 0.02 };
        let section = Section::new(shape, None, None).expect("a section");
        model
            .add_beam("rod", &points, &steel, &section, None, 1)
            .expect("a body");
    }
    let joint = Connection {
        name: "mount".into(),
        between: [None, model.node("rod", "A")],
        joint: Box::new(Mount(along)),
        locked: DofSet::EMPTY,
        stiffness: JointStiffness::default(),
    };
    model
        .add_joint(joint, Rotation3::identity())
        .expect("a joint");
    model.set_output(model.node("rod", "B").expect("a node"));
    model
}

#[test]
fn a_singular_compliance_is_absorbed_as_it_is() {
    let along = Vector6::new(1e-4, 2e-4, 0.0, 0.0, 0.0, 3e-3);
    let with = |along| {
        let solution = solve(&mounted(false, along)).expect("a solution");
        solution.output.compliance.expect("a compliance")
    };
    // At the tip the mount's motion is carried along the rod: Δy += φz L.
    let mut tip = along;
    tip[1] += along[5] * 0.5;
    let expected = with(Vector6::zeros()) + tip * tip.transpose();
    assert!((with(along) - expected).amax() < 1e-12 * expected.amax());
}

#[test]
fn a_singular_compliance_between_rigid_bodies_is_refused() {
    let along = Vector6::new(1e-4, 2e-4, 0.0, 0.0, 0.0, 3e-3);
    assert_eq!(
        solve(&mounted(true, along)).map(|_| ()),
        Err(SolveError::SingularCompliance {
            joint: "mount".into()
        })
    );
}
