//! The lanes against the one-by-one path on a small mechanism, at every width of register, and the
//! kernel against a dense factorization.

use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
use hyperstat_joints::{Dof, DofSet, Fixed, Revolute, Spherical, frame_from_axis};
use hyperstat_model::{Connection, Geometry, JointStiffness, LANES, LoadCase, LoadSet, Model};
use nalgebra::{DMatrix, Point3, Rotation3, Vector3, Vector6};
use pulp::{Arch, Simd, WithSimd};

use super::Beside;
use super::pass::factor::{Matrix, eliminate};
use crate::answer::pose_result::PoseResult;
use crate::plan::Plan;

/// Two legs of flat bars, hinged to a platform, on elastic feet.
fn portal() -> Model {
    let steel = Material::new(2.1e11, Elasticity::Poisson(0.3), None).expect("steel");
    let flat = SectionShape::Rectangle {
        width: 0.01,
        height: 0.03,
    };
    let flat = Section::new(flat, None, None).expect("a flat bar");
    let mut model = Model::new("portal");
    let legs = [("left", 0.0), ("right", 0.5)];
    let tops = legs.map(|(_, x)| Point3::new(x, 0.02, 0.4));
    for ((name, x), top) in legs.iter().zip(tops) {
        let points = [("foot", Point3::new(*x, 0.0, 0.0)), ("top", top)];
        model
            .add_beam(name, &points, &steel, &flat, None, 1)
            .expect("a leg");
    }
    let points = [
        ("centre", Point3::new(0.25, 0.1, 0.45)),
        ("left", tops[0]),
        ("right", tops[1]),
    ];
    model.add_rigid("platform", &points).expect("a platform");
    for (name, _) in legs {
        let mut stiffness = [None; 6];
        stiffness[Dof::X.index()] = Some(1e7);
        stiffness[Dof::U.index()] = Some(1e4);
        let foot = Connection {
            name: format!("{name}-foot"),
            between: [None, model.node(name, "foot")],
            joint: Box::new(Fixed),
            locked: DofSet::EMPTY,
            stiffness: JointStiffness::Directions(stiffness),
        };
        model
            .add_joint(foot, Rotation3::identity())
            .expect("a foot");
        let hinge = Connection {
            name: format!("{name}-hinge"),
            between: [model.node(name, "top"), model.node("platform", name)],
            joint: Box::new(Revolute),
            locked: DofSet::EMPTY,
            stiffness: JointStiffness::default(),
        };
        let axis = frame_from_axis(Some(&Vector3::new(0.3, 1.0, 0.1)), None).expect("an axis");
        model.add_joint(hinge, axis).expect("a hinge");
    }
    let centre = model.node("platform", "centre").expect("the centre");
    let top = model.node("left", "top").expect("a top");
    model.set_output(centre);
    let load = |k: f64| Vector6::new(k, -2.0 * k, 3.0, 0.1, 0.2, -k);
    model.add_load(centre, load(5.0)).expect("a load");
    model.add_load(top, load(-2.0)).expect("a load");
    model
}

/// Poses of it: turned as a whole, and with sections turned about their bars.
fn poses(model: &Model) -> Vec<Geometry> {
    let turned = |k: usize| {
        let t = k as f64;
        let rotation = Rotation3::from_euler_angles(0.2 * t, -0.1 * t, 0.05 * t);
        let mut geometry = model.geometry().clone();
        for point in &mut geometry.positions {
            *point = rotation * *point;
        }
        for frame in &mut geometry.frames {
            *frame = rotation * *frame;
        }
        if k % 2 == 1 {
            geometry.y_axes[0] = Some(Vector3::new(t, 1.0, 0.3));
        }
        geometry
    };
    (0..LANES).map(turned).collect()
}

fn archs() -> Vec<Arch> {
    let mut archs = vec![Arch::Scalar, Arch::new()];
    #[cfg(target_arch = "x86_64")]
    archs.extend(pulp::x86::V3::try_new().map(Arch::V3));
    archs
}

fn assert_agree(lanes: &PoseResult, one: &PoseResult) {
    let (Some(k), Some(expected)) = (lanes.stiffness, one.stiffness) else {
        panic!("no stiffness");
    };
    for i in 0..6 {
        for j in 0..6 {
            let scale = (expected[(i, i)] * expected[(j, j)]).sqrt();
            assert!(
                (k[(i, j)] - expected[(i, j)]).abs() <= 1e-11 * scale,
                "K {i} {j}"
            );
        }
    }
    let (Some(u), Some(expected)) = (lanes.displacement, one.displacement) else {
        panic!("no displacement");
    };
    for part in [0, 3] {
        let (u, expected) = (u.fixed_rows::<3>(part), expected.fixed_rows::<3>(part));
        assert!(
            (u - expected).amax() <= 1e-11 * expected.amax(),
            "displacement {part}"
        );
    }
}

#[test]
fn every_register_gives_what_the_one_by_one_path_gives() {
    let model = portal();
    let plan = Plan::new(&model).expect("a plan");
    let mut workspace = plan.workspace();
    let poses = poses(&model);
    for arch in archs() {
        let mut lanes = plan.lanes_on(&model, arch, Beside::Forces);
        assert!(lanes.is_parallel());
        for (lane, pose) in poses.iter().enumerate() {
            lanes.geometry_mut(lane).clone_from(pose);
        }
        let results = plan.sweep_lanes(&model, &mut lanes, [true; LANES]);
        for (result, pose) in results.iter().zip(&poses) {
            let Some(Ok(result)) = result else {
                panic!("no result");
            };
            let one = plan.sweep(&model, pose, &mut workspace).expect("a result");
            assert_agree(result, &one);
        }
        assert_eq!(lanes.one_by_one(), 0);
    }
}

/// Asked for, every pose goes through the numeric pass: what [`Plan::sweep`] gives to the last bit.
#[test]
fn one_by_one_is_the_numeric_pass_itself() {
    let model = portal();
    let plan = Plan::new(&model).expect("a plan");
    let mut workspace = plan.workspace();
    let poses = poses(&model);
    let mut lanes = plan.lanes_one_by_one(&model);
    assert!(!lanes.is_parallel());
    for (lane, pose) in poses.iter().enumerate() {
        lanes.geometry_mut(lane).clone_from(pose);
    }
    let results = plan.sweep_lanes(&model, &mut lanes, [true; LANES]);
    for (result, pose) in results.into_iter().zip(&poses) {
        assert_eq!(result, Some(plan.sweep(&model, pose, &mut workspace)));
    }
    assert_eq!(lanes.one_by_one(), LANES as u64);
}

/// A bar between two ball joints on the ground, with nothing else: it has no part in the output,
/// and a moment about it is refused as in a sweep.
#[test]
fn a_bar_that_only_the_ground_holds_is_left_out() {
    for (moment, is_parallel) in [
        (None, true),
        (Some([0.0, 1.0]), false),
        (Some([1.0, 0.0]), false),
    ] {
        let mut model = portal();
        let points = [
            ("from", Point3::new(2.0, 0.0, 0.0)),
            ("to", Point3::new(2.4, 0.0, 0.0)),
        ];
        let steel = Material::new(2.1e11, Elasticity::Poisson(0.3), None).expect("steel");
        let round = SectionShape::Circle { diameter: 0.02 };
        let round = Section::new(round, None, None).expect("a round bar");
        model
            .add_beam("bar", &points, &steel, &round, None, 1)
            .expect("a bar");
        for (name, _) in points {
            let ball = Connection {
                name: format!("{name}-ball"),
                between: [None, model.node("bar", name)],
                joint: Box::new(Spherical),
                locked: DofSet::EMPTY,
                stiffness: JointStiffness::default(),
            };
            model
                .add_joint(ball, Rotation3::identity())
                .expect("a ball");
        }
        if let Some([about, across]) = moment {
            let wrench = Vector6::new(0.0, 0.0, 0.0, about, across, 0.0);
            let node = model.node("bar", "to").expect("an end");
            model.add_load(node, wrench).expect("a load");
        }
        let plan = Plan::new(&model).expect("a plan");
        let mut lanes = plan.lanes(&model, Beside::Nothing);
        assert_eq!(lanes.is_parallel(), is_parallel, "{moment:?}");
        let results = plan.sweep_lanes(&model, &mut lanes, [true; LANES]);
        let expected = plan.sweep(&model, model.geometry(), &mut plan.workspace());
        for found in results {
            match (found.expect("a filled lane"), &expected) {
                (Ok(found), Ok(one)) => assert_agree(&found, one),
                (Err(found), Err(one)) => assert_eq!(found.to_string(), one.to_string()),
                (found, one) => panic!("{found:?}, not {one:?}"),
            }
        }
    }
}

#[test]
fn a_spoilt_pose_leaves_the_others_as_they_are() {
    let model = portal();
    let plan = Plan::new(&model).expect("a plan");
    let poses = poses(&model);
    let mut lanes = plan.lanes(&model, Beside::Nothing);
    for (lane, pose) in poses.iter().enumerate() {
        lanes.geometry_mut(lane).clone_from(pose);
    }
    let before = plan.sweep_lanes(&model, &mut lanes, [true; LANES]);
    lanes.geometry_mut(3).positions[0].x = f64::NAN;
    let after = plan.sweep_lanes(&model, &mut lanes, [true; LANES]);
    for (lane, (before, after)) in before.iter().zip(&after).enumerate() {
        if lane == 3 {
            assert!(matches!(after, Some(Err(_))));
        } else {
            assert_eq!(before, after, "lane {lane}");
        }
    }
    lanes.geometry_mut(3).clone_from(&poses[3]);
    assert_eq!(plan.sweep_lanes(&model, &mut lanes, [true; LANES]), before);
}

/// Eliminates the first pivots of one matrix in every lane.
struct Eliminate {
    matrix: DMatrix<f64>,
    pivots: usize,
}

impl WithSimd for Eliminate {
    type Output = DMatrix<f64>;

    fn with_simd<S: Simd>(self, simd: S) -> DMatrix<f64> {
        let size = self.matrix.nrows();
        let left = size - self.pivots;
        let zero = simd.splat_f64s(0.0);
        let mut entries: Vec<S::f64s> = self.matrix.iter().map(|v| simd.splat_f64s(*v)).collect();
        let mut errors = vec![zero; size];
        let mut panel = vec![zero; size * (self.pivots + 1)];
        let mut rest = vec![zero; left * left];
        let mut matrix = Matrix::<S> {
            entries: &mut entries,
            size,
            errors: &mut errors,
            rows: 0,
            load_errors: &mut [],
        };
        eliminate(simd, &mut matrix, self.pivots, 0, &mut panel, &mut rest);
        DMatrix::from_fn(left, left, |r, c| {
            simd.reduce_max_f64s(rest[c.min(r) * left + c.max(r)])
        })
    }
}

#[test]
fn elimination_leaves_the_schur_complement() {
    for (size, pivots) in [(7, 1), (13, 6), (20, 8), (19, 19), (6, 0), (5, 3)] {
        let root = DMatrix::from_fn(size, size, |r, c| ((3 * r + 7 * c) % 11) as f64 / 11.0);
        let matrix = &root * root.transpose() + DMatrix::identity(size, size);
        let left = size - pivots;
        let inner = matrix.view((0, 0), (pivots, pivots)).into_owned();
        let coupling = matrix.view((0, pivots), (pivots, left)).into_owned();
        let mut expected = matrix.view((pivots, pivots), (left, left)).into_owned();
        if pivots > 0 {
            let solved = inner
                .cholesky()
                .expect("positive definite")
                .solve(&coupling);
            expected -= coupling.transpose() * solved;
        }
        for arch in archs() {
            let matrix = matrix.clone();
            let found = arch.dispatch(Eliminate { matrix, pivots });
            assert!((&found - &expected).abs().sum() < 1e-11, "{size} {pivots}");
        }
    }
}

/// A front has room for so many columns of what acts; a job with more goes one by one.
#[test]
fn very_many_cases_within_the_mechanism_go_one_by_one() {
    for (cases, is_parallel) in [(99, true), (101, false)] {
        let mut model = portal();
        let top = model.node("left", "top").expect("a top");
        for case in 0..cases {
            let wrench = Vector6::new(1.0, f64::from(case), 0.0, 0.0, 0.0, 0.0);
            let (name, loads) = (format!("case {case}"), LoadSet::on(top, wrench));
            model.add_case(LoadCase { name, loads }).expect("a case");
        }
        let plan = Plan::new(&model).expect("a plan");
        let mut lanes = plan.lanes(&model, Beside::Nothing);
        assert_eq!(lanes.is_parallel(), is_parallel, "{cases}");
        let [found, ..] = plan.sweep_lanes(&model, &mut lanes, [true; LANES]);
        let found = found.expect("a filled lane").expect("a result");
        let one = plan.sweep(&model, model.geometry(), &mut plan.workspace());
        let one = one.expect("a result");
        assert_eq!(found.cases.len(), cases as usize);
        for (found, expected) in found.cases.iter().zip(&one.cases) {
            assert!((found - expected).amax() <= 1e-11 * expected.amax());
        }
    }
}
