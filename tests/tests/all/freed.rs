//! A direction that a stiffness of zero frees is free in every count: a `Fixed` with zeros along the
//! free directions of another kind counts as that kind, in assembly, closure and the reference.

use hyperstat_assembly::{
    Connection, JointStiffness, Model, analyse, redundant_constraints, solve,
};
use hyperstat_closure::LoopClosure;
use hyperstat_joints::{
    Cylindrical, DofSet, Fixed, Joint, Planar, Prismatic, Revolute, Spherical, Universal,
    frame_from_axis,
};
use hyperstat_tests::build::node;
use nalgebra::{Matrix6, Point3, Vector3};

/// A closed loop of three rigid bars and the ground, its joints about or along z.
fn loop_of_three(joint: &dyn Fn(&str) -> Connection) -> Model {
    let points = [
        ("A", Point3::new(0.0, 0.0, 0.0)),
        ("B", Point3::new(0.1, 0.4, 0.0)),
        ("C", Point3::new(0.5, 0.45, 0.1)),
        ("D", Point3::new(0.6, 0.0, 0.0)),
    ];
    let mut model = Model::new("loop");
    for (k, name) in ["crank", "coupler", "rocker"].iter().enumerate() {
        model.add_rigid(name, &points[k..k + 2]).expect("a body");
    }
    let ends = [
        ("A", None, Some("crank")),
        ("B", Some("crank"), Some("coupler")),
        ("C", Some("coupler"), Some("rocker")),
        ("D", Some("rocker"), None),
    ];
    for (at, first, second) in ends {
        let on = |body: Option<&str>| body.map(|body| node(&model, body, at));
        let connection = Connection {
            between: [on(first), on(second)],
            ..joint(at)
        };
        let frame = frame_from_axis(Some(&Vector3::z()), None).expect("an axis");
        model.add_joint(connection, frame).expect("a joint");
    }
    model.set_output(node(&model, "coupler", "C"));
    model
}

fn connection(name: &str, joint: Box<dyn Joint>, stiffness: JointStiffness) -> Connection {
    Connection {
        name: name.into(),
        between: [None, None],
        joint,
        locked: DofSet::EMPTY,
        stiffness,
    }
}

/// Zero along `free`, nothing said of the others.
fn zeros(free: DofSet) -> JointStiffness {
    let mut given = [None; 6];
    for dof in free.iter() {
        given[dof.index()] = Some(0.0);
    }
    JointStiffness::Directions(given)
}

/// Mobility, over-constraint and the redundant constraints by name; the output's mobility.
fn counts(model: &Model) -> (usize, usize, Vec<Vec<String>>, usize, usize) {
    let found = analyse(model).expect("a small model");
    let reference = hyperstat_reference::solve(model).expect("a solution");
    assert_eq!(
        (found.mobility, found.overconstraint),
        (reference.mobility, reference.overconstraint)
    );
    let redundant = redundant_constraints(model);
    let names = redundant.iter().map(|group| group.names(model)).collect();
    let closure = LoopClosure::new(model).expect("a linkage");
    (
        found.mobility,
        found.overconstraint,
        names,
        found.motions.len(),
        closure.output_mobility(),
    )
}

fn assert_counts_as(kind: impl Joint + Clone + 'static) {
    let free = kind.free();
    let name = kind.kind().to_string();
    let built_in =
        loop_of_three(&|at| connection(at, Box::new(kind.clone()), JointStiffness::default()));
    let freed = loop_of_three(&|at| connection(at, Box::new(Fixed), zeros(free)));
    assert_eq!(counts(&freed), counts(&built_in), "{name}");
    // Of a full matrix, zeros on the diagonal free; what is left is elastic, a constraint as well.
    let mut matrix = Matrix6::identity() * 1e6;
    for dof in free.iter() {
        matrix[(dof.index(), dof.index())] = 0.0;
    }
    let full = loop_of_three(&|at| connection(at, Box::new(Fixed), JointStiffness::Matrix(matrix)));
    assert_eq!(counts(&full), counts(&built_in), "{name} by a matrix");
}

#[test]
fn a_fixed_joint_with_zeros_counts_as_the_kind_with_these_freedoms() {
    assert_counts_as(Revolute);
    assert_counts_as(Prismatic);
    assert_counts_as(Cylindrical);
    assert_counts_as(Universal);
    assert_counts_as(Spherical);
    assert_counts_as(Planar);
}

/// Four parallel hinges: a plane four-bar linkage, mobility 1 and over-constraint 3.
#[test]
fn four_hinges_freed_by_zeros_are_a_four_bar_linkage() {
    let v = Revolute.free();
    let model = loop_of_three(&|at| connection(at, Box::new(Fixed), zeros(v)));
    let (mobility, overconstraint, redundant, ..) = counts(&model);
    assert_eq!((mobility, overconstraint, redundant.len()), (1, 3, 3));
    let solution = solve(&model).expect("a solution");
    assert_eq!((solution.mobility, solution.overconstraint), (1, 3));
}

/// Zero on a locked direction leaves it locked: it is free by kind, and held.
#[test]
fn zero_on_a_locked_direction_leaves_it_locked() {
    let v = Revolute.free();
    let locked = |stiffness: JointStiffness| {
        loop_of_three(&|at| Connection {
            locked: v,
            ..connection(at, Box::new(Revolute), stiffness.clone())
        })
    };
    let plain = locked(JointStiffness::default());
    let zero = locked(zeros(v));
    assert_eq!(counts(&zero), counts(&plain));
    let (mobility, _, _, motions, _) = counts(&zero);
    assert_eq!((mobility, motions), (1, 0));
    // Of a joint that is not free there by kind, it is a constraint as before.
    let held = loop_of_three(&|at| Connection {
        locked: v,
        ..connection(at, Box::new(Fixed), zeros(v))
    });
    let welded = loop_of_three(&|at| connection(at, Box::new(Fixed), JointStiffness::default()));
    assert_eq!(counts(&held), counts(&welded));
}
