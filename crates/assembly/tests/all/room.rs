//! Models that would not fit into memory are refused before anything is made for them, and the limit
//! is told.

use hyperstat_assembly::{Connection, JointStiffness, Model, SolveError, analyse, solve};
use hyperstat_joints::{DofSet, Fixed, Joint, Revolute, frame_from_axis};
use nalgebra::{Point3, Rotation3, Vector3, Vector6};

fn name(x: usize, y: usize) -> String {
    format!("{x}_{y}")
}

/// A plane grid of rigid squares, each joined to its neighbours by hinges about z; the first is welded
/// to the ground, and the last has the output and a force.
fn grid(columns: usize, rows: usize) -> Model {
    let mut model = Model::new("grid");
    let z = frame_from_axis(Some(&Vector3::z()), None).expect("an axis");
    for x in 0..columns {
        for y in 0..rows {
            let at = |dx: f64, dy: f64| Point3::new(x as f64 + dx, y as f64 + dy, 0.0);
            let points = [
                ("W", at(-0.5, 0.0)),
                ("E", at(0.5, 0.0)),
                ("S", at(0.0, -0.5)),
                ("N", at(0.0, 0.5)),
            ];
            model.add_rigid(&name(x, y), &points).expect("a square");
            let before = [
                (x > 0).then(|| (name(x.wrapping_sub(1), y), "E", "W")),
                (y > 0).then(|| (name(x, y.wrapping_sub(1)), "N", "S")),
            ];
            for (other, from, to) in before.into_iter().flatten() {
                let joint = Connection {
                    name: format!("{to}{}", name(x, y)),
                    between: [model.node(&other, from), model.node(&name(x, y), to)],
                    joint: Box::new(Revolute) as Box<dyn Joint>,
                    locked: DofSet::EMPTY,
                    stiffness: JointStiffness::default(),
                };
                model.add_joint(joint, z).expect("a hinge");
            }
        }
    }
    weld(&mut model, "0_0", "W");
    let last = model
        .node(&name(columns - 1, rows - 1), "N")
        .expect("a node");
    model.set_output(last);
    model
}

fn weld(model: &mut Model, body: &str, at: &str) {
    let joint = Connection {
        name: "ground".into(),
        between: [None, model.node(body, at)],
        joint: Box::new(Fixed),
        locked: DofSet::EMPTY,
        stiffness: JointStiffness::default(),
    };
    model
        .add_joint(joint, Rotation3::identity())
        .expect("a weld");
}

/// Rigid bodies one after another, on hinges about z, locked or not.
fn chain(count: usize, locked: bool) -> Model {
    let mut model = Model::new("chain");
    let z = frame_from_axis(Some(&Vector3::z()), None).expect("an axis");
    for k in 0..count {
        let points = [
            ("A", Point3::new(k as f64, 0.0, 0.0)),
            ("B", Point3::new(k as f64 + 1.0, 0.0, 0.0)),
        ];
        let body = format!("b{k}");
        model.add_rigid(&body, &points).expect("a body");
        let before = (k > 0).then(|| model.node(&format!("b{}", k - 1), "B"));
        let joint = Connection {
            name: format!("j{k}"),
            between: [before.flatten(), model.node(&body, "A")],
            joint: Box::new(Revolute) as Box<dyn Joint>,
            locked: if locked {
                Revolute.free()
            } else {
                DofSet::EMPTY
            },
            stiffness: JointStiffness::default(),
        };
        model.add_joint(joint, z).expect("a hinge");
    }
    let last = format!("b{}", count - 1);
    model.set_output(model.node(&last, "B").expect("a node"));
    model
}

fn is_too_large(error: &SolveError) {
    let SolveError::TooLarge { numbers, limit, .. } = error else {
        panic!("{error}");
    };
    assert!(numbers > limit);
    let message = error.to_string();
    assert!(
        message.contains("too large") && message.contains(&limit.to_string()),
        "{message}"
    );
}

#[test]
fn a_grid_of_1500_rigid_bodies_is_solved() {
    let model = grid(50, 30);
    let counts = analyse(&model).expect("sparse");
    let hinges = 49 * 30 + 50 * 29;
    // Four squares around a hole turn two and two alike, so all of one colour of a chessboard do, and
    // those of the welded one's colour not at all: one motion.
    assert_eq!(counts.mobility, 1);
    assert_eq!(counts.overconstraint, 5 * hinges + 6 + 1 - 6 * 1500);
    solve(&model).expect("a solution");
}

/// 2 × 2 squares on four hinges in a loop are a four-bar linkage: mobility 1.
#[test]
fn a_small_grid_is_solved() {
    let model = grid(2, 2);
    let counts = analyse(&model).expect("small");
    assert_eq!((counts.mobility, counts.overconstraint), (1, 3));
    solve(&model).expect("a solution");
    // Grübler: 12 hinges and a weld have 66 conditions, 9 bodies 54 coordinates.
    let counts = analyse(&grid(3, 3)).expect("small");
    assert_eq!(counts.overconstraint - counts.mobility, 66 - 54);
}

#[test]
fn long_chains_of_rigid_bodies_are_solved() {
    for long in [300, 1 << 12] {
        let solution = solve(&chain(long, true)).expect("a solution");
        assert_eq!((solution.mobility, solution.overconstraint), (long, 0));
    }
    // A motion a hinge.
    let free = analyse(&chain(1 << 10, false)).expect("few entries");
    assert_eq!((free.mobility, free.motions.len()), (1 << 10, 1 << 10));
    let solution = solve(&chain(1 << 11, false)).expect("a solution");
    assert_eq!(solution.mobility, 1 << 11);
    assert!(!solution.output.free_motions.is_empty());
}

/// Displacements and forces of every case are held.
#[test]
fn cases_are_refused_where_their_results_do_not_fit() {
    let mut model = chain(300, true);
    let tip = model.output().expect("an output");
    for k in 0..1 << 16 {
        let force = Vector6::new(0.0, 1.0, 0.0, 0.0, 0.0, 0.0);
        let loads = hyperstat_assembly::LoadSet::on(tip, force);
        let name = format!("c{k}");
        let case = hyperstat_assembly::LoadCase { name, loads };
        model.add_case(case).expect("a case");
    }
    is_too_large(&solve(&model).expect_err("too large"));
}
