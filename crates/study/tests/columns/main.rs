//! Columns on request: each number of a row is what `solve` says of that pose, for every kind of column,
//! over prebuilt mechanisms and files, in every case.

mod tables;

use std::collections::BTreeMap;
use std::path::Path;

use hyperstat_assembly::Model;
use hyperstat_mechanisms::prebuilt::{Delta, Prebuilt};
use hyperstat_mechanisms::{LoopClosure, MemoryFiles, Registry, Target, batch_from_str, begin};
use hyperstat_study::figure;
use hyperstat_study::sweep::{
    Cell, Chunk, Columns, Record, Statistics, Sweep, Threads, Way, measure,
};
use hyperstat_study::table::{self, TableFormat, TableReader, TableWriter};
use hyperstat_study::{Along, Asked, Job, Question, Study};
use parquet::file::reader::{FileReader, SerializedFileReader};
use serde_json::Value;

/// What is equal to rounding, relative to the largest of its kind: the lanes answer to a full solution to
/// 1e-11 of the stiffness's scale, and what is found from the stiffness loses its condition in digits.
const SAME: f64 = 1e-9;

const FIVE_BAR: &str = r#"(jobs: [(name: "bar", mechanism: File("five_bar.ron"),
    poses: Grid(x: (-0.1, 0.1, 2), y: (0.3, 0.4, 2)))])"#;

const DRIVES: &str = "A1.v,A2.v\n0,0\n0.1236,0.0147\n-0.2,0.15\n";

/// The first job of a batch that stands beside a five-bar with masses and yield strengths.
fn job(text: &str) -> Job {
    let bar = include_str!("../../../../examples/five_bar.ron");
    let bar = bar.replace(
        "poisson: 0.33",
        "poisson: 0.33, density: 2700.0, yield: 2.5e8",
    );
    let files = MemoryFiles::from_iter([("five_bar.ron", &*bar), ("drives.csv", DRIVES)]);
    let batch = batch_from_str(text, Path::new("a.ron"), &files, &Registry::builtin());
    batch
        .expect("a batch")
        .jobs
        .into_iter()
        .next()
        .expect("a job")
}

/// The prebuilt mechanism of this kind, whose material yields.
fn prebuilt(kind: &str) -> Job {
    let text = begin(kind).expect("a kind");
    job(&text
        .replace("poisson: 0.3,", "yield: 3.5e8, poisson: 0.3,")
        .replace("poisson: 0.33,", "yield: 2e8, poisson: 0.33,"))
}

fn output(model: &Model) -> (String, String) {
    let node = &model.nodes()[model.output().expect("an output").0];
    (model.bodies()[node.body.0].name.clone(), node.point.clone())
}

/// Adds two cases of loads on the output.
fn loaded(mut job: Job) -> Job {
    let (body, point) = output(&job.model().expect("a model"));
    let on = format!("on: ({body:?}, {point:?})");
    let cases = format!(
        "{{ \"push\": [({on}, force: (30.0, -20.0, 50.0))], \"turn\": [({on}, moment: (3.0, 2.0, -4.0))] }}"
    );
    job.set("cases", &cases).expect("cases");
    job
}

/// Names and cells of what a job finds further, of all rows.
fn found(job: &Job) -> (Vec<String>, Vec<Record>) {
    let names = Columns::of(job).further;
    let sweep = Sweep::new(job, Way::Lanes).expect("a topology");
    let records = sweep.records(0..sweep.len());
    (names, records)
}

fn cells(names: &[String], record: &Record) -> BTreeMap<String, Cell> {
    let found = record.result.as_ref().expect("a result");
    assert_eq!(found.further.len(), names.len());
    names
        .iter()
        .cloned()
        .zip(found.further.iter().cloned())
        .collect()
}

/// What `solve --why` says of a pose, as JSON; of a case where one is named.
fn solved(job: &Job, pose: usize, modes: usize, case: Option<&str>) -> Value {
    let mut study = Study::of_job(job.clone(), 0, pose).expect("a pose");
    let why = Some(Asked {
        case: case.map(Into::into),
        along: Along::Displacement,
    });
    let question = Question {
        why,
        modes: (modes > 0).then_some(modes),
        ..Question::default()
    };
    let answer = study.answer(&question).expect("an answer");
    serde_json::to_value(answer.report).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// What is told of the state of a case, or of the loads.
fn state<'v>(solved: &'v Value, case: Option<&str>) -> &'v Value {
    match case {
        Some(case) => &solved["cases"][case],
        None => solved,
    }
}

fn near(what: &str, found: &Cell, expected: f64, scale: f64) {
    let found = found.number().unwrap_or_else(|| panic!("{what} is empty"));
    assert!(
        (found - expected).abs() <= SAME * scale.max(expected.abs()),
        "{what}: {found:e}, not {expected:e}"
    );
}

const CASES: [(Option<&str>, &str); 3] =
    [(None, ""), (Some("push"), "push."), (Some("turn"), "turn.")];

/// Wrenches of joints and forces of drives.
fn compare_forces(job: &Job, pose: usize, solved: &Value, cells: &BTreeMap<String, Cell>) {
    let model = job.model().expect("a model");
    for (case, prefix) in CASES {
        let joints = state(solved, case)["joints"].as_object().expect("joints");
        let wrenches = joints
            .values()
            .filter_map(|joint| joint["wrench"].as_array());
        let scale = wrenches
            .flatten()
            .fold(0.0_f64, |most, n| most.max(number(n).abs()));
        assert!(scale > 0.0);
        for joint in model.joints() {
            for (k, part) in ["fx", "fy", "fz", "mx", "my", "mz"].iter().enumerate() {
                let name = format!("{prefix}{}.{part}", joint.name);
                let wrench = &joints[&joint.name]["wrench"];
                match wrench.is_null() {
                    true => assert_eq!(cells[&name], Cell::Empty, "{name}"),
                    false => near(
                        &format!("{pose} {name}"),
                        &cells[&name],
                        number(&wrench[k]),
                        scale,
                    ),
                }
            }
        }
        for (joint, dof) in model.drives() {
            let name = &model.joints()[joint.0].name;
            // The built-in drives are along plain axes.
            let expected = number(&joints[name]["wrench"][dof.index()]);
            let column = format!("{prefix}{name}.{dof}.force");
            near(
                &format!("{pose} {column}"),
                &cells[&column],
                expected,
                scale,
            );
        }
    }
}

/// The largest stress and utilisation, and where.
fn compare_stresses(solved: &Value, cells: &BTreeMap<String, Cell>) {
    for (case, prefix) in CASES {
        let state = state(solved, case);
        let segments = state["segments"].as_array().expect("segments");
        let stress = |segment: &Value| segment["stress"]["von_mises"].as_f64().unwrap_or(0.0);
        let most = segments.iter().map(stress).fold(0.0, f64::max);
        near(
            &format!("{prefix}stress"),
            &cells[&format!("{prefix}stress")],
            most,
            0.0,
        );
        let at = &cells[&format!("{prefix}stress_at")];
        let there = segments.iter().find(|segment| {
            let [from, to] = [0, 1].map(|k| segment["points"][k].as_str().unwrap());
            at.text()
                == Some(&*format!(
                    "{}.{from}-{to}",
                    segment["body"].as_str().unwrap()
                ))
        });
        assert!((stress(there.expect("the segment")) - most).abs() <= SAME * most);
        let bodies = state["bodies"].as_object().expect("bodies");
        let worst = bodies
            .values()
            .filter_map(|body| body["worst"]["utilisation"].as_f64());
        let most = worst.fold(0.0, f64::max);
        let name = format!("{prefix}utilisation");
        near(&name, &cells[&name], most, 0.0);
        let place = cells[&format!("{name}_place")].number().expect("a place");
        assert!((0.0..=1.0).contains(&place));
    }
}

/// Measures that the report has, too.
fn compare_measures(solved: &Value, cells: &BTreeMap<String, Cell>) {
    let measures = &solved["measures"];
    let compliance = |k: usize| number(&solved["output"]["compliance"][k][k]);
    let principal = |name: &str, k: usize| number(&measures[name]["values"][k]);
    let expected = [
        ("compliance_x", compliance(0)),
        ("compliance_z", compliance(2)),
        ("pure_moment_stiffness_y", 1.0 / compliance(4)),
        ("softest_force", principal("translational_compliances", 2)),
        ("softest_moment", principal("rotational_compliances", 2)),
        (
            "pure_force_stiffness_min",
            1.0 / principal("translational_compliances", 2),
        ),
        (
            "pure_force_stiffness_max",
            1.0 / principal("translational_compliances", 0),
        ),
        (
            "pure_moment_stiffness_max",
            1.0 / principal("rotational_compliances", 0),
        ),
        (
            "pure_translation_stiffness_min",
            principal("translational_stiffnesses", 0),
        ),
        (
            "pure_translation_stiffness_max",
            principal("translational_stiffnesses", 2),
        ),
        (
            "pure_rotation_stiffness_min",
            principal("rotational_stiffnesses", 0),
        ),
        (
            "virtual_work_index",
            number(&measures["virtual_work_index"]["force"]),
        ),
    ];
    for (name, expected) in expected {
        near(name, &cells[name], expected, 0.0);
    }
    for (case, prefix) in CASES {
        let moved = &state(solved, case)["output"]["displacement"];
        for (name, first) in [("deflection", 0), ("rotation", 3)] {
            let length = (first..first + 3).fold(0.0_f64, |sum, k| sum.hypot(number(&moved[k])));
            let name = format!("{prefix}{name}");
            near(&name, &cells[&name], length, 0.0);
        }
    }
}

/// Shares of bodies and joints, and of ways to deform.
fn compare_budgets(job: &Job, pose: usize, cells: &BTreeMap<String, Cell>) {
    for (case, prefix) in CASES {
        let solved = solved(job, pose, 0, case);
        let budget = &solved["budget"];
        assert_eq!(budget["case"].as_str(), case);
        let start = format!("{prefix}budget.");
        let mut sums: BTreeMap<String, f64> = cells
            .keys()
            .filter(|name| name.starts_with(&start))
            .map(|name| (name.clone(), 0.0))
            .collect();
        for part in budget["parts"].as_array().expect("parts") {
            let owner = match (part["body"].as_str(), part["joint"].as_str()) {
                (Some(body), _) => format!("{start}body {body}"),
                (_, joint) => format!("{start}joint {}", joint.expect("a joint")),
            };
            let kind = format!("{start}{}", part["deformation"].as_str().expect("a kind"));
            for name in [owner, kind] {
                *sums.get_mut(&name).expect("a column") += number(&part["share"]);
            }
        }
        for (name, expected) in sums {
            near(&format!("{pose} {name}"), &cells[&name], expected, 1.0);
        }
    }
}

fn check(name: &str, job: Job) {
    let mut job = loaded(job);
    let model = job.model().expect("a model");
    let wrenches = model
        .joints()
        .iter()
        .map(|joint| format!("Wrench({:?})", joint.name));
    let wrenches: Vec<String> = wrenches.collect();
    let columns = format!(
        "[DriveForces, {}, Stress, Utilisation, Mass, Measures, Frequencies(count: 3), Budget]",
        wrenches.join(", ")
    );
    job.set("columns", &columns)
        .unwrap_or_else(|error| panic!("{name}: {error}"));
    let (names, records) = found(&job);
    let ok: Vec<usize> = (0..records.len())
        .filter(|k| records[*k].result.is_ok())
        .collect();
    assert!(!ok.is_empty(), "{name}");
    let some = [ok[0], ok[ok.len() / 2], ok[ok.len() - 1]];
    for pose in some {
        let cells = cells(&names, &records[pose]);
        let solved = solved(&job, pose, 3, None);
        compare_forces(&job, pose, &solved, &cells);
        compare_stresses(&solved, &cells);
        compare_measures(&solved, &cells);
        compare_budgets(&job, pose, &cells);
        near("mass", &cells["mass"], number(&solved["mass"]), 0.0);
        for (k, mode) in solved["modes"]
            .as_array()
            .expect("modes")
            .iter()
            .enumerate()
        {
            let name = format!("f{}", k + 1);
            near(&name, &cells[&name], number(&mode["frequency"]), 0.0);
        }
    }
}

#[test]
fn columns_of_prebuilt_mechanisms_are_what_solve_says() {
    for kind in ["Delta", "Hexapod", "ThreePrs", "Tripteron", "Exechon"] {
        check(kind, prebuilt(kind));
    }
}

#[test]
fn columns_of_a_file_are_what_solve_says() {
    let mut job = job(FIVE_BAR);
    job.set("gravity", "(0.0, 0.0, -9.81)").expect("a density");
    check("five-bar", job);
}

/// What closes the loops of a file, or inverse kinematics and loop closure together, say of the drives.
#[test]
fn positions_of_drives_are_those_of_loop_closure() {
    let mut delta = prebuilt("Delta");
    delta.set("columns", "[Drives]").expect("drives");
    let (names, records) = found(&delta);
    assert_eq!(
        names,
        ["A1.v", "A2.v", "A3.v"].map(|drive| format!("{drive}.position"))
    );
    let mechanism = Delta::paper();
    let pose = |k: usize| delta.target(k).map(Option::unwrap_or_default);
    for k in [0, 5, 17] {
        let cells = cells(&names, &records[k]);
        let drives = mechanism
            .drives_between(&pose(0)[..3], &pose(k)[..3])
            .expect("a way");
        for (name, drive) in names.iter().zip(drives) {
            let value = cells[name].number().expect("a value");
            assert!(
                (value - drive.value).abs() < 1e-9,
                "{name}: {value} {}",
                drive.value
            );
            assert!(k == 0 || value.abs() > 1e-3);
        }
    }
    every_prebuilt_has_its_drives();
    let mut bar = job(FIVE_BAR);
    bar.set("columns", "[Drives]").expect("drives");
    let (names, records) = found(&bar);
    let model = bar.model().expect("a model");
    let closure = LoopClosure::new(&model).expect("loops");
    for (k, record) in records.iter().enumerate() {
        let cells = cells(&names, record);
        let reached = closure
            .place_at(&Target::Output(bar.target(k)))
            .expect("a pose");
        for (name, drive) in names.iter().zip(reached.drives) {
            let value = cells[name].number().expect("a value");
            assert!((value - drive.value).abs() < 1e-9, "{name}");
        }
    }
    // Those that are commanded are found again, in the order of the model.
    let by_drives = FIVE_BAR.replace(
        "Grid(x: (-0.1, 0.1, 2), y: (0.3, 0.4, 2))",
        "Drives(Csv(\"drives.csv\"))",
    );
    let mut driven = job(&by_drives);
    driven.set("columns", "[Drives]").expect("drives");
    let (names, records) = found(&driven);
    for (k, record) in records.iter().enumerate() {
        let cells = cells(&names, record);
        let commanded = driven.drives().iter().zip(driven.drive_values(k));
        for (drive, value) in commanded {
            let found = cells[&format!("{drive}.position")]
                .number()
                .expect("a value");
            assert!((found - value).abs() < 1e-12, "{drive}: {found} {value}");
        }
    }
}

/// In every pose that is reached, and not zero in one that is not the first: slides too, which stand
/// elsewhere on their legs in every pose.
fn every_prebuilt_has_its_drives() {
    for kind in hyperstat_study::files::beginnings() {
        if ["mechanism", "single-freedom"].contains(&&*kind) {
            continue;
        }
        let mut prebuilt = prebuilt(&kind);
        prebuilt.set("columns", "[Drives]").expect("drives");
        let (names, records) = found(&prebuilt);
        assert!(!names.is_empty(), "{kind}");
        let mut largest = 0.0_f64;
        for record in records.iter().filter(|record| record.result.is_ok()) {
            let cells = cells(&names, record);
            for name in &names {
                let value = cells[name].number();
                largest = largest.max(value.unwrap_or_else(|| panic!("{kind}: no {name}")).abs());
            }
        }
        assert!(largest > 1e-3, "{kind}: {largest}");
    }
}

/// Grids that begin in a corner from which no way leads to some of their poses.
const FAR: [(&str, &str); 3] = [
    (
        "exechon",
        "Grid(x: (-0.6, 0.6, 5), y: (-0.6, 0.6, 5), z: (0.7, 1.1, 3))",
    ),
    (
        "linear-delta",
        "Grid(x: (-0.2, 0.2, 3), y: (-0.2, 0.2, 3), z: (0.7, 0.7, 1))",
    ),
    (
        "three-rps",
        "Grid(z: (0.7, 0.7, 1), rx: (-0.9, 0.9, 7), ry: (0.0, 0.0, 1))",
    ),
];

#[test]
fn every_reached_pose_has_its_drives() {
    for (kind, grid) in FAR {
        let text = begin(kind).expect("a kind");
        let at = text.find("poses: ").expect("poses");
        let end = at + text[at..].find('\n').expect("a line");
        let text = format!("{}poses: {grid},{}", &text[..at], &text[end..]);
        let mut job = job(&text);
        job.set("columns", "[Drives]").expect("drives");
        let (names, records) = found(&job);
        let reached: Vec<_> = (records.iter())
            .filter(|record| record.result.is_ok())
            .collect();
        assert!(reached.len() > 4, "{kind}: {}", reached.len());
        for record in reached {
            for name in &names {
                let value = cells(&names, record)[name].number();
                assert!(value.is_some(), "{kind} {:?}: no {name}", record.pose);
            }
        }
    }
}

/// All kinds, one job: what a program that asks for one pose gets is the row, to the bit.
#[test]
fn a_single_pose_is_the_row() {
    let mut job = loaded(prebuilt("Delta"));
    job.set("columns", "[Drives, DriveForces, Stress, Mass, Measures]")
        .expect("columns");
    let (_, records) = found(&job);
    let mut poser = Study::of_job(job.clone(), 0, 0)
        .and_then(|study| study.poser())
        .expect("a pose");
    for k in [3, 11] {
        let single = poser
            .at(&Target::Output(job.target(k)))
            .result
            .expect("a result");
        let row = records[k].result.as_ref().expect("a result");
        assert_eq!(single.further, row.further);
    }
}
