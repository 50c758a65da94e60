//! An output that a job names, and a tool: stiffness and displacement there, over prebuilt mechanisms and
//! files, in the lanes and one by one.

use std::path::Path;

use hyperstat_mechanisms::{Disk, MemoryFiles, Registry, Target, batch_from_str, begin};
use hyperstat_study::sweep::{Found, Record, Sweep, Way};
use hyperstat_study::{Job, Question, Study};
use nalgebra::{Matrix6, Rotation3, Vector3};

/// The lanes answer to the numeric pass to 1e-11 of the stiffness's scale.
const SAME: f64 = 1e-10;

fn job(text: &str) -> Job {
    let near = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/a.ron");
    let batch = batch_from_str(text, &near, &Disk, &Registry::builtin()).expect("a batch");
    batch.jobs.into_iter().next().expect("a job")
}

fn prebuilt(kind: &str) -> Job {
    job(&begin(kind).expect("a kind"))
}

fn with(job: &Job, fields: &[(&str, &str)]) -> Job {
    let mut job = job.clone();
    for (field, value) in fields {
        job.set(field, value)
            .unwrap_or_else(|error| panic!("{field}: {error}"));
    }
    job
}

fn rows(job: &Job, way: Way) -> Vec<Record> {
    let sweep = Sweep::new(job, way).expect("a topology");
    sweep.records(0..sweep.len())
}

fn found(record: &Record) -> &Found {
    record.result.as_ref().expect("a result")
}

/// The twist of a point at `arm` from the reference, from that of the reference.
fn shift(arm: &Vector3<f64>) -> Matrix6<f64> {
    let mut shift = Matrix6::identity();
    let skew = arm.cross_matrix();
    shift.fixed_view_mut::<3, 3>(0, 3).copy_from(&-skew);
    shift
}

/// K at the tool is the congruence transform of K at the output, and its displacement d + φ × r, in the axes
/// of the pose.
fn compare(name: &str, plain: &[Record], moved: &[Record], arm: impl Fn(&Record) -> Vector3<f64>) {
    let mut compared = 0;
    for (plain, moved) in plain.iter().zip(moved) {
        assert_eq!(plain.pose, moved.pose, "{name}");
        assert_eq!(plain.status(), moved.status(), "{name}");
        if plain.result.is_err() {
            continue;
        }
        let (at_output, at_tool) = (found(plain), found(moved));
        let to_tool = shift(&arm(plain));
        let back = to_tool.try_inverse().expect("a shift");
        let expected = back.transpose() * at_output.stiffness * back;
        let scale = |k: usize| expected[(k, k)].sqrt();
        for (r, c) in (0..6).flat_map(|r| (0..6).map(move |c| (r, c))) {
            let off = (at_tool.stiffness[(r, c)] - expected[(r, c)]).abs();
            assert!(off <= SAME * scale(r) * scale(c), "{name}: k{r}{c}");
        }
        let expected = to_tool * at_output.displacement;
        let off = (at_tool.displacement - expected).amax();
        assert!(off <= SAME * expected.amax(), "{name}: {off:e}");
        compared += 1;
    }
    assert!(compared > 0, "{name}");
}

const OFFSET: [f64; 3] = [0.02, -0.03, -0.12];

fn turned(record: &Record) -> Rotation3<f64> {
    let [.., x, y, z] = record.pose.map(Option::unwrap_or_default);
    Rotation3::new(Vector3::new(x, y, z))
}

#[test]
fn a_tool_moves_stiffness_and_displacement() {
    for kind in ["Delta", "Hexapod", "ThreePrs", "Exechon", "Tricept"] {
        let plain = prebuilt(kind);
        let tool = with(&plain, &[("tool", "(0.02, -0.03, -0.12)")]);
        for way in [Way::Lanes, Way::OneByOne] {
            let arm = |record: &Record| turned(record) * Vector3::from(OFFSET);
            compare(kind, &rows(&plain, way), &rows(&tool, way), arm);
        }
    }
    let bar = r#"(jobs: [(name: "delta", mechanism: File("delta.ron"),
        poses: Grid(x: (-0.2, 0.1, 3), y: (-0.2, 0.0, 2), z: (0.5, 0.55, 2)))])"#;
    let plain = job(bar);
    let tool = with(&plain, &[("tool", "(0.02, -0.03, -0.12)")]);
    let arm = |record: &Record| turned(record) * Vector3::from(OFFSET);
    compare(
        "a file",
        &rows(&plain, Way::Lanes),
        &rows(&tool, Way::Lanes),
        arm,
    );
}

/// The same mechanism with a platform that has its point there.
#[test]
fn another_output_is_another_point_of_the_model() {
    let plain = prebuilt("Delta");
    let other = with(&plain, &[("output", "(\"platform\", \"C2\")")]);
    let model = plain.model().expect("a model");
    let place = |point: &str| {
        let node = model.node("platform", point).expect("a point");
        model.geometry().positions[node.0]
    };
    // The platform does not turn.
    let arm = place("C2") - place("P");
    compare(
        "delta",
        &rows(&plain, Way::Lanes),
        &rows(&other, Way::Lanes),
        |_| arm,
    );
    let mut study = Study::of_job(other.clone(), 0, 4).expect("a pose");
    let report = study
        .answer(&Question::default())
        .expect("an answer")
        .report;
    assert_eq!(report.output.node, "platform.C2");
    // An elastic body's point is not carried along with the platform.
    let elbow = with(&plain, &[("output", "(\"elbow1\", \"B1\")")]);
    let records = rows(&elbow, Way::Lanes);
    assert_eq!(records[0].pose, rows(&plain, Way::Lanes)[0].pose);
    let mut study = Study::of_job(elbow, 0, 0).expect("a pose");
    let report = study
        .answer(&Question::default())
        .expect("an answer")
        .report;
    let solved = report.output.stiffness.expect("a stiffness");
    let stiffness = found(&records[0]).stiffness;
    assert!((solved[2][2] / stiffness[(2, 2)] - 1.0).abs() < SAME);
    assert!(
        (stiffness[(2, 2)] / found(&rows(&plain, Way::Lanes)[0]).stiffness[(2, 2)] - 1.0).abs()
            > 1e-3
    );
}

/// A force on the tool is the force and its moment on the output, and both names together are one point.
#[test]
fn loads_stand_on_the_tool_and_on_the_output() {
    let plain = prebuilt("Delta");
    let tool = "(0.0, 0.1, -0.2)";
    let on = |point: &str, moment: &str| {
        format!("[(on: (\"platform\", \"{point}\"), force: (10.0, -20.0, 30.0){moment})]")
    };
    // r × F of (0, 0.1, −0.2) and (10, −20, 30).
    let moved = on("P", ", moment: (-1.0, -2.0, -1.0)");
    let at_tool = with(&plain, &[("tool", tool), ("loads", &on("tool", ""))]);
    let at_output = with(&plain, &[("tool", tool), ("loads", &moved)]);
    for (a, b) in rows(&at_tool, Way::Lanes)
        .iter()
        .zip(&rows(&at_output, Way::Lanes))
    {
        let (a, b) = (found(a).displacement, found(b).displacement);
        assert!((a - b).amax() <= 1e-12 * a.amax());
    }
    // From another point of the platform.
    let both = with(
        &plain,
        &[
            ("output", "(\"platform\", \"C1\")"),
            ("tool", "(0.0, 0.0, -0.1)"),
        ],
    );
    let model = both.model().expect("a model");
    let output = model.output().expect("an output");
    assert_eq!(model.node_name(output), "platform.tool");
    let c1 = model.node("platform", "C1").expect("a point");
    let arm = model.geometry().positions[output.0] - model.geometry().positions[c1.0];
    assert!((arm - Vector3::new(0.0, 0.0, -0.1)).amax() < 1e-15);
}

/// Single poses, designs and drives of a mechanism with a tool.
#[test]
fn a_tool_goes_along_everywhere() {
    let mut job = with(
        &prebuilt("Hexapod"),
        &[
            ("tool", "(0.0, 0.0, -0.12)"),
            ("columns", "[Drives, DriveForces]"),
            ("vary", "{ \"drive_stiffness\": [4e7, 5e7] }"),
        ],
    );
    let records = rows(&job, Way::Lanes);
    assert_eq!(records.len(), 4);
    assert!(records.iter().all(|record| record.status() == "ok"));
    assert!(found(&records[0]).stiffness[(2, 2)] < found(&records[2]).stiffness[(2, 2)]);
    assert!(
        found(&records[1]).further[..6]
            .iter()
            .all(|cell| cell.number().is_some_and(|n| n.abs() > 1e-4))
    );
    job.set("vary", "").expect("one design");
    let mut poser = Study::of_job(job.clone(), 0, 0)
        .and_then(|study| study.poser())
        .expect("a pose");
    let single = poser
        .at(&Target::Output(job.target(1)))
        .result
        .expect("a result");
    let row = rows(&job, Way::Lanes).remove(1).result.expect("a result");
    assert_eq!(single.stiffness, row.stiffness);
    assert_eq!(single.further, row.further);
}

#[test]
fn what_is_wrong_with_an_output_or_a_tool_is_told() {
    let plain = prebuilt("Delta");
    let refused = |fields: &[(&str, &str)]| {
        let mut job = plain.clone();
        let mut last = None;
        for (field, value) in fields {
            last = job.set(field, value).err();
        }
        let error = last.expect("an error");
        format!("{error}; {}", error.help().unwrap_or_default())
    };
    for (fields, told) in [
        (
            &[("output", "(\"platform\", \"C9\")")][..],
            "output:1:14: body `platform` does not run through point `C9`",
        ),
        (
            &[("output", "(\"platfrom\", \"C1\")")],
            "did you mean `platform`?",
        ),
        (
            &[("tool", "(0.1, 0.2)")],
            "expected three numbers `(x, y, z)`",
        ),
        (&[("tool", "(0, 0, \"3 kg\")")], "tool:1:8:"),
        (
            &[("output", "(\"arm1\", \"B1\")"), ("tool", "(0, 0, 1)")],
            "a tool is fixed in the body that the poses are of; name a point of `platform` as the output",
        ),
    ] {
        let found = refused(fields);
        assert!(found.contains(told), "{fields:?}: {found}");
    }
}

/// A point on a ram that a job names stays where it is on the ram, as one that the file names does: poses of
/// the drives, which both have alike.
#[test]
fn an_output_that_a_job_names_is_that_of_a_file_that_names_it() {
    let text = include_str!("../../../examples/exechon.ron");
    let own = "output: (\"platform\", \"P\")";
    assert!(text.contains(own));
    let named = text.replace(own, "output: (\"ram1\", \"M1\")");
    let drives = "D1.y,D2.y,D3.y\n0.05,0.06,0.04\n-0.03,0.0,0.02\n";
    let files =
        MemoryFiles::from_iter([("own.ron", text), ("named.ron", &named), ("d.csv", drives)]);
    let job = |file: &str, more: &str| {
        let text = format!(
            r#"(jobs: [(name: "e", mechanism: File("{file}"), poses: Drives(Csv("d.csv")), {more})])"#
        );
        let batch = batch_from_str(&text, Path::new("a.ron"), &files, &Registry::builtin());
        batch.expect("a batch").jobs.remove(0)
    };
    let by_job = rows(&job("own.ron", r#"output: ("ram1", "M1")"#), Way::Lanes);
    let by_file = rows(&job("named.ron", ""), Way::Lanes);
    for (one, other) in by_job.iter().zip(&by_file) {
        let [one, other] = [found(one).stiffness, found(other).stiffness];
        let scale = |k: usize| other[(k, k)].sqrt();
        for (r, c) in (0..6).flat_map(|r| (0..6).map(move |c| (r, c))) {
            let off = (one[(r, c)] - other[(r, c)]).abs();
            assert!(off <= SAME * scale(r) * scale(c), "k{r}{c}: {one} {other}");
        }
    }
}
