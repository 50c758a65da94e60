//! Jobs of a batch that move a mechanism of a file: the book's five-bar against two circles, and
//! poses that do not depend on the order in which they are asked for.

use std::path::{Path, PathBuf};

use hyperstat_assembly::Geometry;
use hyperstat_mechanisms::{Batch, Disk, Job, PoseError, Registry, load_batch};
use nalgebra::{Point3, Vector3};

const CRANK: f64 = 0.05; // its square
const PLACE: f64 = 1e-12;

fn batch() -> Batch {
    let path: PathBuf =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/five_bar_sweep.ron");
    load_batch(&path, &Disk, &Registry::builtin()).expect("the book's batch")
}

fn point(job: &Job, geometry: &Geometry, body: &str, point: &str) -> Point3<f64> {
    let model = job.model().expect("the file's model");
    geometry.positions[model.node(body, point).expect("a node").0]
}

/// Where the tips of two rods of one length, from two points of the plane, meet in front of them.
fn meeting(p: Point3<f64>, q: Point3<f64>, square: f64) -> Option<Point3<f64>> {
    let middle = nalgebra::center(&p, &q);
    let half = (q - p) * 0.5;
    let height = square - half.norm_squared();
    let across = Vector3::z().cross(&half).normalize();
    (height > 0.0).then(|| middle + across * height.sqrt())
}

const ROD: f64 = 0.25 * 0.25 + 0.22 * 0.22; // its square

#[test]
fn a_map_reaches_what_two_circles_reach() {
    let batch = batch();
    let job = &batch.jobs[0];
    assert_eq!(job.len(), 91);
    let mut reached = 0;
    for pose in 0..job.len() {
        let mut geometry = job.model().expect("a model").geometry().clone();
        let [x, y] = [0, 1].map(|k| job.target(pose)[k].expect("a coordinate that is asked"));
        // Each side is two links: a crank and a rod, from its foot to the tool.
        let tool = Point3::new(x, y, 0.0);
        let longest = CRANK.sqrt() + ROD.sqrt();
        let shortest = ROD.sqrt() - CRANK.sqrt();
        let reach = [-0.15, 0.15].map(|foot| {
            let distance = (tool - Point3::new(foot, 0.0, 0.0)).norm();
            (shortest..longest).contains(&distance)
        });
        match job.place(pose, &mut geometry) {
            Ok(found) => {
                assert_eq!(reach, [true; 2], "{x} {y}");
                assert_eq!(found[..2], [x, y]);
                assert!(found[2].abs() < PLACE && found[3].abs() < PLACE && found[4].abs() < PLACE);
                reached += 1;
                for k in ["1", "2"] {
                    let [crank, rod] = ["crank", "rod"].map(|body| format!("{body}{k}"));
                    let b = point(job, &geometry, &crank, &format!("B{k}"));
                    let foot = point(job, &geometry, &crank, &format!("A{k}"));
                    assert!(((b - foot).norm_squared() - CRANK).abs() < PLACE);
                    assert!((b - point(job, &geometry, &rod, &format!("B{k}"))).norm() < PLACE);
                    assert!(((b - tool).norm_squared() - ROD).abs() < PLACE, "{x} {y}");
                    // The elbow stays on its outer side.
                    let side = (b - foot).cross(&(tool - foot)).z;
                    assert!(if k == "1" { side < 0.0 } else { side > 0.0 }, "{x} {y}");
                }
            }
            Err(error) => {
                assert!(
                    matches!(error, PoseError::Unreachable { .. }),
                    "{x} {y}: {error}"
                );
                assert_ne!(reach, [true; 2], "{x} {y}: {error}");
            }
        }
    }
    assert!(reached > 60, "{reached}");
}

#[test]
fn drives_move_the_tool_as_two_circles_say() {
    let batch = batch();
    let job = &batch.jobs[1];
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/five_bar_drives.csv");
    let table = std::fs::read_to_string(path).expect("the drives");
    let rows: Vec<[f64; 2]> = (table.lines().skip(1))
        .map(|line| {
            let (one, other) = line.split_once(',').expect("two columns");
            [one, other].map(|cell| cell.parse().expect("a number"))
        })
        .collect();
    assert_eq!(rows.len(), job.len());
    let model = job.model().expect("a model");
    for (pose, angles) in rows.into_iter().enumerate() {
        let mut geometry = model.geometry().clone();
        let found = job.place(pose, &mut geometry).expect("in reach");
        let home = [(-0.15, -0.1), (0.15, 0.1)];
        let mut tips = [Point3::origin(); 2];
        for (tip, ((foot, lean), angle)) in tips.iter_mut().zip(home.into_iter().zip(angles)) {
            let turn = nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
            *tip = Point3::new(foot, 0.0, 0.0) + turn * Vector3::new(lean, 0.2, 0.0);
        }
        let tool = meeting(tips[0], tips[1], ROD).expect("the rods meet");
        let off = (Point3::new(found[0], found[1], found[2]) - tool).norm();
        assert!(off < PLACE, "{pose}: {off:e}");
    }
}

/// To the last bit: from a new batch, backwards, and one pose alone.
#[test]
fn poses_do_not_depend_on_those_before_them() {
    let (forwards, backwards) = (batch(), batch());
    for (one, other) in forwards.jobs.iter().zip(&backwards.jobs) {
        let home = one.model().expect("a model").geometry().clone();
        let place = |job: &Job, pose| {
            let mut geometry = home.clone();
            (job.place(pose, &mut geometry), geometry)
        };
        let there: Vec<_> = (0..one.len()).map(|pose| place(one, pose)).collect();
        let back: Vec<_> = (0..one.len())
            .rev()
            .map(|pose| place(other, pose))
            .collect();
        for (pose, (there, back)) in there.iter().zip(back.iter().rev()).enumerate() {
            assert_eq!(there, back, "{pose}");
        }
        let alone = &batch().jobs[usize::from(one.name != "five-bar-map")];
        assert_eq!(place(alone, one.len() - 1), there[one.len() - 1]);
    }
}
