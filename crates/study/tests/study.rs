//! The library as its users see it: files from memory, values by path, parts of sweeps, tables and
//! figures without a disk.

use std::path::Path;

use hyperstat_study::figure::{self, Choice, Drawing, Map};
use hyperstat_study::sweep::{Columns, Record, Statistics, Summary, Sweep, Threads, Way, measure};
use hyperstat_study::table::{TableFormat, TableReader, TableWriter, render};
use hyperstat_study::{
    Along, Asked, Job, JobMechanism, JobPoses, MemoryFiles, Question, Registry, Selection, Study,
    StudyError, Value,
};

const CANTILEVER: &str = r#"(
    name: "cantilever",
    materials: { "steel": (young: 2.1e11, poisson: 0.3) },
    sections: { "rod": Circle(diameter: 0.02) },
    points: { "A": (0.0, 0.0, 0.0), "B": (1.0, 0.0, 0.0) },
    bodies: { "beam": Beam(through: ["A", "B"], section: "rod", material: "steel") },
    joints: { "wall": (at: "A", between: ("ground", "beam"), kind: Fixed) },
    loads: [(on: ("beam", "B"), force: (0.0, 0.0, -100.0))],
    output: ("beam", "B"),
)"#;

fn study(name: &str, text: &str, selection: &Selection) -> Result<Study, StudyError> {
    let files = MemoryFiles::from_iter([(name, text)]);
    Study::open(Path::new(name), selection, &files, &Registry::builtin())
}

/// Sag of a cantilever of this diameter under 100 N at 1 m: F L³ / 3 E I.
fn sag(diameter: f64) -> f64 {
    let second_moment = std::f64::consts::PI * diameter.powi(4) / 64.0;
    -100.0 / (3.0 * 2.1e11 * second_moment)
}

fn close(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-12 * expected.abs(),
        "{found} {expected}"
    );
}

#[test]
fn a_file_from_memory_is_solved_and_its_values_changed_by_path() {
    let mut cantilever = study("a.ron", CANTILEVER, &Selection::default()).unwrap();
    let answer = cantilever.answer(&Question::default()).unwrap();
    close(answer.report.output.displacement[2], sag(0.02));
    let beam = answer.report.displacements.get("beam.B").unwrap();
    assert_eq!(*beam, answer.report.output.displacement);
    let mut thicker = cantilever
        .with_values(&[("sections.rod.diameter", 0.03)])
        .unwrap();
    let answer = thicker.answer(&Question::default()).unwrap();
    close(answer.report.output.displacement[2], sag(0.03));
    let error = cantilever
        .with_values(&[("sections.rod.outer", 0.03)])
        .unwrap_err();
    assert_eq!(error.code(), "input");
    assert!(error.help().is_some(), "{error}");
}

#[test]
fn errors_have_a_place_a_help_and_a_code() {
    let wrong = CANTILEVER.replace("material: \"steel\"", "material: \"steal\"");
    let error = study("a.ron", &wrong, &Selection::default()).unwrap_err();
    assert_eq!(
        (error.code(), &*error.to_string()),
        ("input", "unknown material `steal`")
    );
    assert_eq!(error.help().as_deref(), Some("did you mean `steel`?"));
    let location = error.location().unwrap();
    assert_eq!((location.line, location.column), (6, 75));
    let pose = Selection {
        pose: Some(1),
        ..Selection::default()
    };
    let error = study("a.ron", CANTILEVER, &pose).unwrap_err();
    assert_eq!(error.code(), "no-batch");
    assert!(!error.to_string().contains("--") && !error.help().unwrap().contains("--"));
    let hinged = CANTILEVER.replace("Fixed", "Revolute(axis: (0.0, 1.0, 0.0))");
    let error = study("a.ron", &hinged, &Selection::default()).unwrap();
    let (report, error) = (error.check(), error.solve().unwrap_err());
    assert_eq!(error.code(), "unrestrained");
    assert!(!report.0.solvable && report.1.is_some());
}

/// A delta over a line of poses, some of them out of reach, with two designs.
fn job() -> Job {
    let link = |diameter: f64| {
        let material = "(young: 2.1e11, poisson: 0.3)";
        Value::Text(format!(
            "(section: Circle(diameter: {diameter:?}), material: {material})"
        ))
    };
    let delta = JobMechanism::prebuilt(
        "Delta",
        [
            ("base_radius", 0.25.into()),
            ("platform_radius", 0.06.into()),
            ("arm_length", 0.30.into()),
            ("rod_length", 0.60.into()),
            ("rod_spacing", 0.12.into()),
            ("arm", link(0.030)),
            ("bar", link(0.020)),
            ("rod", link(0.014)),
        ],
    );
    let mut poses = Vec::new();
    for x in 0..40 {
        for y in 0..12 {
            poses.push([0.03 * f64::from(x) - 0.2, 0.02 * f64::from(y), 0.5]);
        }
    }
    let poses = JobPoses::list(&poses);
    let mut job = Job::new("line", delta, poses, &Registry::builtin()).unwrap();
    let vary = [("rod.section.diameter", vec![0.012.into(), 0.014.into()])];
    job.set_vary(&vary, false).unwrap();
    job
}

fn same(a: &Record, b: &Record) {
    assert_eq!((a.pose, a.status()), (b.pose, b.status()));
    if let (Ok(a), Ok(b)) = (&a.result, &b.result) {
        assert_eq!((a.stiffness, a.displacement), (b.stiffness, b.displacement));
    }
}

#[test]
fn any_range_of_rows_is_a_part_of_the_whole() {
    let job = job();
    let sweep = Sweep::new(&job, Way::Lanes).unwrap();
    let threads = Threads::new(2).unwrap();
    let part = |rows: std::ops::Range<usize>| {
        let mut records = Vec::new();
        let mut summary = Summary::new(&job, rows.start);
        let mut statistics = Statistics::default();
        let taken = sweep.run(
            &threads,
            rows,
            |_| {},
            |chunk| -> Result<(), ()> {
                summary.add(&chunk.records);
                for (row, record) in chunk.rows.clone().zip(&chunk.records) {
                    if let Some(values) = measure(record) {
                        statistics.add(row, &record.pose, &values);
                    }
                }
                records.append(&mut chunk.records);
                Ok(())
            },
        );
        taken.unwrap();
        (records, summary, statistics)
    };
    let (all, whole, statistics) = part(0..sweep.len());
    assert_eq!(all.len(), 2 * 480);
    assert!(!whole.is_complete() && all.iter().any(|record| record.result.is_ok()));
    let mut merged = Summary::new(&job, 0);
    let mut merged_statistics = Statistics::default();
    for rows in [0..3, 3..500, 500..960] {
        let (records, summary, of_part) = part(rows.clone());
        records
            .iter()
            .zip(&all[rows.clone()])
            .for_each(|(a, b)| same(a, b));
        let alone = sweep.records(rows);
        alone.iter().zip(&records).for_each(|(a, b)| same(a, b));
        merged.merge(&summary);
        merged_statistics.merge(&of_part);
    }
    assert_eq!(format!("{merged:?}"), format!("{whole:?}"));
    let json = |found: &Statistics| serde_json::to_value(found.report().unwrap()).unwrap();
    let (merged, whole) = (json(&merged_statistics), json(&statistics));
    for (part, whole) in merged
        .as_array()
        .unwrap()
        .iter()
        .zip(whole.as_array().unwrap())
    {
        for exact in ["poses", "min", "max", "percentiles"] {
            assert_eq!(part[exact], whole[exact]);
        }
        // A sum in another order.
        close(
            part["mean"].as_f64().unwrap(),
            whole["mean"].as_f64().unwrap(),
        );
    }
}

#[test]
fn what_takes_the_chunks_stops_a_sweep() {
    let job = job();
    let sweep = Sweep::new(&job, Way::Lanes).unwrap();
    let mut seen = 0;
    let threads = Threads::new(2).unwrap();
    let stopped = sweep.run(
        &threads,
        0..sweep.len(),
        |_| {},
        |chunk| {
            seen += chunk.records.len();
            Err("enough")
        },
    );
    assert_eq!(stopped, Err("enough"));
    assert!(seen < sweep.len());
}

#[test]
fn tables_and_figures_need_no_disk() {
    let job = job();
    let sweep = Sweep::new(&job, Way::Lanes).unwrap();
    let threads = Threads::new(1).unwrap();
    let table = |format: TableFormat| {
        let mut table = TableWriter::new(Vec::new(), format, &Columns::of(&job)).unwrap();
        let take = |chunk: &mut _| table.append(chunk);
        let written = sweep.run(
            &threads,
            0..sweep.len(),
            |chunk| render(format, chunk),
            take,
        );
        written.unwrap();
        let name = format!("line.{}", format.extension());
        TableReader::of(Path::new(&name), table.finish().unwrap()).unwrap()
    };
    let (csv, parquet) = (table(TableFormat::Csv), table(TableFormat::Parquet));
    assert_eq!(csv.names(), parquet.names());
    let k33 = csv.find("k33").unwrap();
    assert_eq!(csv.read(&[k33]).unwrap(), parquet.read(&[k33]).unwrap());
    let map = Map {
        value: "k33".into(),
        plane: Vec::new(),
        planes: Vec::new(),
        axes: None,
        asked: None,
        limits: None,
        scale: Default::default(),
        choice: Choice {
            design: Some(1),
            pose: None,
        },
        title: None,
        marks: Vec::new(),
        labels: Default::default(),
    };
    let svg = |table: &TableReader| Drawing::Map(figure::map(table, &map).unwrap()).svg();
    assert_eq!(svg(&csv).unwrap(), svg(&parquet).unwrap());
}

#[test]
fn a_pose_of_a_job_takes_other_values_too() {
    let text = r#"(jobs: [(
        name: "line",
        mechanism: Delta(
            base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60,
            rod_spacing: 0.12,
            arm: (section: Circle(diameter: 0.030), material: (young: 2.1e11, poisson: 0.3)),
            bar: (section: Circle(diameter: 0.020), material: (young: 2.1e11, poisson: 0.3)),
            rod: (section: Circle(diameter: 0.014), material: (young: 2.1e11, poisson: 0.3)),
        ),
        poses: List([(0.0, 0.0, 0.5), (0.1, 0.0, 0.5)]),
        vary: { "arm.section.diameter": [0.03, 0.04] },
    )])"#;
    let second = Selection {
        design: Some(1),
        pose: Some(1),
        ..Selection::default()
    };
    let written = text.replace("diameter: 0.014", "diameter: 0.02");
    let stiffness = |study: &Study| study.solve().unwrap().output.stiffness.unwrap();
    let changed = study("b.ron", text, &second).unwrap();
    let changed = changed
        .with_values(&[("rod.section.diameter", 0.02)])
        .unwrap();
    let expected = study("b.ron", &written, &second).unwrap();
    assert_eq!(stiffness(&changed), stiffness(&expected));
    // It is called what it was.
    assert_eq!(
        (changed.job(), changed.design()),
        (Some(("line", 1)), Some(1))
    );
    assert!(changed.mechanism().is_none());
}

#[test]
fn a_sweep_on_a_thread_of_its_own_pool_ends() {
    let job = job();
    let sweep = Sweep::new(&job, Way::Lanes).unwrap();
    for count in [1, 2] {
        let threads = Threads::new(count).unwrap();
        let seen = threads.install(|| {
            let mut seen = 0;
            let take = |chunk: &mut hyperstat_study::sweep::Chunk| -> Result<(), ()> {
                seen += chunk.records.len();
                Ok(())
            };
            sweep.run(&threads, 0..sweep.len(), |_| {}, take).unwrap();
            seen
        });
        assert_eq!(seen, sweep.len());
    }
}

#[test]
fn tables_are_whole_whether_rendered_before_or_not() {
    let job = job();
    let sweep = Sweep::new(&job, Way::Lanes).unwrap();
    let threads = Threads::new(2).unwrap();
    let table = |before: bool| {
        let columns = Columns::of(&job);
        let mut table = TableWriter::new(Vec::new(), TableFormat::Csv, &columns).unwrap();
        let rendered = |chunk: &mut hyperstat_study::sweep::Chunk| {
            if before {
                render(TableFormat::Csv, chunk);
            }
        };
        let take = |chunk: &mut _| table.append(chunk);
        sweep.run(&threads, 0..sweep.len(), rendered, take).unwrap();
        table.finish().unwrap()
    };
    assert!(table(true) == table(false));
}

#[test]
fn a_trajectory_takes_any_rows_and_is_of_the_first_design() {
    let mut job = job();
    job.set("figures", "[Trajectory()]").unwrap();
    let records = Sweep::new(&job, Way::Lanes).unwrap().records(0..960);
    let mut trajectory = figure::Trajectory::wanted_by(&job).unwrap();
    trajectory.add(0, &records[..100]);
    trajectory.add(100, &records[100..]);
    let table = || Err(hyperstat_study::PlotError::AllHeld);
    let drawn = figure::draw(&job, 0, Some(&trajectory), table).unwrap();
    assert!(matches!(drawn, Drawing::Trajectory(figure) if figure.commanded.len() < 481));
    assert!(figure::draw(&job, 1, None, table).is_err());
}

#[test]
fn spoilt_tables_are_errors() {
    let job = job();
    let sweep = Sweep::new(&job, Way::Lanes).unwrap();
    let mut table = TableWriter::new(Vec::new(), TableFormat::Parquet, &Columns::of(&job)).unwrap();
    let take = |chunk: &mut _| table.append(chunk);
    sweep
        .run(&Threads::new(1).unwrap(), 0..300, |_| {}, take)
        .unwrap();
    let whole = table.finish().unwrap();
    let mut spoilt = 0;
    for k in 0..300_usize {
        let mut bytes = whole.clone();
        let at = (k * 7919) % bytes.len();
        bytes[at] ^= 1 << (k % 8);
        let read = TableReader::of(Path::new("a.parquet"), bytes);
        let read = read.and_then(|table| table.read(&(0..table.names().len()).collect::<Vec<_>>()));
        spoilt += usize::from(read.is_err());
    }
    assert!(spoilt > 0);
    let whole = TableReader::of(Path::new("a.parquet"), whole).unwrap();
    assert!(whole.read(&[10_000]).is_err());
}

/// A cantilever of length L, diameter 2 r² and density ρ, under F.
const BY_PARAMETERS: &str = r#"(
    name: "cantilever",
    parameters: { "L": "1000 mm", "r": 0.1, "F": 100, "E": "210 GPa", "unused": 1, "d": "= 2 * r^2" },
    materials: { "steel": (young: "= E", poisson: 0.3, density: 7850.0) },
    sections: { "rod": Circle(diameter: "= d") },
    points: { "A": (0.0, 0.0, 0.0), "B": ("= L", 0.0, 0.0) },
    bodies: { "beam": Beam(through: ["A", "B"], section: "rod", material: "steel") },
    joints: { "wall": (at: "A", between: ("ground", "beam"), kind: Fixed) },
    loads: [(on: ("beam", "B"), force: (0.0, 0.0, "= -F"))],
    output: ("beam", "B"),
)"#;

/// The sag is F L³ / 3 E I with I ∝ d⁴ ∝ r⁸, the lowest frequency ∝ d/L² √(E/ρ).
#[test]
fn parameters_have_derivatives_through_the_expressions() {
    let mut cantilever = study("a.ron", BY_PARAMETERS, &Selection::default()).unwrap();
    let question = Question {
        why: Some(Asked {
            case: None,
            along: Along::Displacement,
        }),
        modes: Some(1),
        ..Question::default()
    };
    let answer = cantilever.answer(&question).unwrap();
    close(answer.report.output.displacement[2], sag(0.02));
    let report = serde_json::to_value(&answer.report).unwrap();
    let of = |list: &serde_json::Value, name: &str| {
        let mut found = list.as_array().unwrap().iter();
        let found = found.find(|own| own["parameter"] == format!("parameters.{name}"));
        let found = found.unwrap_or_else(|| panic!("no {name}")).clone();
        let relative = match &found["relative"] {
            serde_json::Value::Array(all) => all[0].clone(),
            one => one.clone(),
        };
        (relative.as_f64().unwrap(), found["by_differences"] == true)
    };
    let near = |(found, by_differences): (f64, bool), expected: f64, differences: bool| {
        // Central differences with a step of 1e-4 of the value.
        let precision = if differences { 1e-6 } else { 1e-10 };
        assert!((found - expected).abs() <= precision, "{found} {expected}");
        assert_eq!(by_differences, differences, "{expected}");
    };
    let sags = &report["sensitivities"];
    near(of(sags, "r"), -8.0, false);
    near(of(sags, "d"), -4.0, false);
    near(of(sags, "E"), -1.0, false);
    near(of(sags, "L"), 3.0, true);
    near(of(sags, "F"), 1.0, true);
    near(of(sags, "unused"), 0.0, false);
    let frequencies = &report["frequency_sensitivities"][0]["sensitivities"];
    near(of(frequencies, "r"), 2.0, false);
    near(of(frequencies, "E"), 0.5, false);
    near(of(frequencies, "L"), -2.0, true);
    // Values that have no name beside a parameter are as before.
    let rod = sags.as_array().unwrap().iter();
    let rod = rod.filter(|own| own["parameter"] == "sections.rod.diameter");
    assert_eq!(rod.count(), 1);
}

/// Two posts of a group, and a point that stands between them.
const BETWEEN_COPIES: &str = r#"(
    name: "posts",
    parameters: { "d": 0.02, "h": 0.5 },
    materials: { "steel": (young: 2.1e11, poisson: 0.3) },
    sections: { "rod": Circle(diameter: "= d") },
    groups: { "post": (
        points: { "F": (0.0, 0.2, 0.0), "H": (0.0, 0.2, "= h") },
        bodies: { "post": Beam(through: ["F", "H"], section: "rod", material: "steel") },
        joints: {
            "wall": (at: "F", between: ("ground", "post"), kind: Fixed),
            "top": (at: "H", between: ("post", "plate"), kind: Fixed),
        },
    ) },
    copies: { "post": Turned(axis: (0.0, 0.0, 1.0), count: 2) },
    points: { "M": "= midpoint(H1, H2)" },
    bodies: { "plate": Rigid(points: ["H1", "H2", "M"]) },
    joints: {},
    loads: [(on: ("plate", "M"), force: (10.0, 0.0, 0.0))],
    output: ("plate", "M"),
)"#;

/// A point that uses points of copies leans on what these lean on, and on nothing else: the deflection is
/// ∝ 1/d⁴, by the chain rule, and ∝ h³, by differences.
#[test]
fn points_of_copies_lean_on_their_own_parameters_alone() {
    let mut posts = study("a.ron", BETWEEN_COPIES, &Selection::default()).unwrap();
    let question = Question {
        why: Some(Asked {
            case: None,
            along: Along::Displacement,
        }),
        ..Question::default()
    };
    let answer = posts.answer(&question).unwrap();
    let report = serde_json::to_value(&answer.report).unwrap();
    let all = report["sensitivities"].as_array().unwrap();
    for (name, expected, differences) in [("d", -4.0, false), ("h", 3.0, true)] {
        let own = all.iter();
        let mut own = own.filter(|own| own["parameter"] == format!("parameters.{name}"));
        let own = own.next().unwrap_or_else(|| panic!("no {name}"));
        let relative = own["relative"].as_f64().unwrap();
        let precision = if differences { 1e-6 } else { 1e-10 };
        assert!(
            (relative - expected).abs() < precision,
            "{name}: {relative}"
        );
        assert_eq!(own["by_differences"] == true, differences, "{name}");
    }
}
