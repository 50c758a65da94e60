//! Files in JSON: the same as in RON, by the same reader.

use std::path::{Path, PathBuf};

use hyperstat_mechanisms::{
    Batch, Disk, Input, Job, JobMechanism, JobPoses, LoadError, Mechanism, Registry, Value,
    WriteError, load_str, mechanism_from_str, to_json, write, write_json,
};
use hyperstat_model::Model;

use crate::fuzzing::{self, seeds};

/// Mechanism and batch files of the workspace, those that are wrong too.
fn files() -> Vec<(PathBuf, String)> {
    let files = seeds(Path::new("../.."), "ron");
    assert!(files.len() > 300);
    files
}

fn read(text: &str, path: &Path) -> Result<Input, LoadError> {
    load_str(text, path, &Disk, &Registry::builtin())
}

/// The same file in JSON, by its name beside the RON file.
fn json(text: &str, path: &Path) -> Option<(String, PathBuf)> {
    let json = to_json(text, path).ok()?;
    Some((json, path.with_extension("json")))
}

fn mechanism(text: &str) -> Mechanism {
    let path = Path::new("f.json");
    mechanism_from_str(text, path, &Disk, &Registry::builtin())
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Asserts that two models are the same to the last bit.
fn assert_same(found: &Model, expected: &Model, what: &str) {
    let registry = Registry::builtin();
    match (write(found, &registry), write(expected, &registry)) {
        (Ok(found), Ok(expected)) => assert_eq!(found, expected, "{what}"),
        (Err(WriteError::Flexible { .. }), Err(WriteError::Flexible { .. })) => {}
        other => panic!("{what}: {other:?}"),
    }
    let [one, other] = [found, expected].map(Model::geometry);
    assert_eq!(one.positions, other.positions, "{what}");
    assert_eq!(one.frames, other.frames, "{what}");
    assert_eq!(one.y_axes, other.y_axes, "{what}");
}

/// Asserts that two jobs are the same in every design and, as far as they go, in every pose.
fn assert_same_job(found: &Job, expected: &Job) {
    let what = &expected.name;
    assert_eq!(found.name, expected.name);
    assert_eq!(found.figures, expected.figures, "{what}");
    assert_eq!(found.cases(), expected.cases(), "{what}");
    assert_eq!(found.modes, expected.modes, "{what}");
    assert_eq!(found.varied(), expected.varied(), "{what}");
    assert_eq!(found.commanded(), expected.commanded(), "{what}");
    assert_eq!(found.drives(), expected.drives(), "{what}");
    assert_eq!(
        (found.len(), found.designs(), found.first_design()),
        (expected.len(), expected.designs(), expected.first_design()),
    );
    for design in 0..expected.designs().min(20) {
        match (found.design(design), expected.design(design)) {
            (Ok(found), Ok(expected)) => {
                let [found, expected] = [found, expected].map(|own| own.model().unwrap());
                assert_same(&found, &expected, what);
            }
            (Err(_), Err(_)) => {}
            other => panic!("{what}, design {design}: {other:?}"),
        }
    }
}

#[test]
fn every_file_is_the_same_in_json() {
    let (mut mechanisms, mut jobs) = (0, 0);
    for (path, text) in files() {
        let Ok(expected) = read(&text, &path) else {
            continue;
        };
        let (json, named) = json(&text, &path).unwrap();
        let found = read(&json, &named).unwrap_or_else(|error| panic!("{error}\n{json}"));
        match (found, expected) {
            (Input::Mechanism(found), Input::Mechanism(expected)) => {
                assert_same(&found.model, &expected.model, &expected.model.name);
                mechanisms += 1;
            }
            (Input::Batch(Batch { jobs: found, .. }), Input::Batch(Batch { jobs: all, .. })) => {
                assert_eq!(found.len(), all.len());
                for (found, expected) in found.iter().zip(&all) {
                    assert_same_job(found, expected);
                    jobs += 1;
                }
            }
            other => panic!("{}: {other:?}", path.display()),
        }
    }
    assert!(mechanisms > 30 && jobs > 20, "{mechanisms} {jobs}");
}

/// Files with mistakes that JSON does not know: it has no tuples, and words in quotes.
const NOTATION: [&str; 4] = [
    "mechanism_point_as_list",
    "slip_no_quotes",
    "slip_pose_decimal_commas",
    "slip_single_quotes_of_one_letter",
];

/// What a message says, without the notation.
fn words(error: &LoadError) -> String {
    let message = error.message();
    let message = message
        .split("found `")
        .next()
        .unwrap_or_default()
        .to_owned();
    let message = message
        .replace("in parentheses", "")
        .replace("in braces", "");
    message.chars().filter(|c| c.is_alphanumeric()).collect()
}

#[test]
fn every_mistake_is_told_in_json_too() {
    let (mut same, mut others) = (0, Vec::new());
    for (path, text) in files() {
        let Some((json, named)) = json(&text, &path) else {
            continue;
        };
        let (Err(expected), found) = (read(&text, &path), read(&json, &named)) else {
            continue;
        };
        let stem = path.file_stem().unwrap().to_str().unwrap();
        let Err(found) = found else {
            assert!(NOTATION.contains(&stem), "{stem} is taken:\n{json}");
            continue;
        };
        assert!(found.location().is_some_and(|at| at.line > 0));
        match words(&found) == words(&expected) {
            true => same += 1,
            false => others.push(format!("{expected}\n    {found}")),
        }
    }
    // A name given twice is one mistake fewer in what was turned into JSON, and a number that JSON cannot
    // have is a word.
    assert!(
        others.len() < 30 && same > 200,
        "{same} the same, {} others:\n{}",
        others.len(),
        others.join("\n")
    );
}

#[test]
fn what_is_exported_comes_back_from_both_forms_alike() {
    let registry = Registry::builtin();
    let mut count = 0;
    for (path, text) in files() {
        let models: Vec<Model> = match read(&text, &path) {
            Ok(Input::Mechanism(mechanism)) => vec![mechanism.model],
            Ok(Input::Batch(batch)) => batch.jobs.iter().flat_map(|job| job.model()).collect(),
            Err(_) => continue,
        };
        for model in models {
            let (Ok(ron), Ok(json)) = (write(&model, &registry), write_json(&model, &registry))
            else {
                continue;
            };
            let [of_ron, of_json] = [ron, json].map(|text| mechanism(&text).model);
            assert_same(&of_json, &of_ron, &model.name);
            assert_eq!(of_json.loads(), model.loads());
            assert_eq!(of_json.geometry().positions, of_ron.geometry().positions);
            count += 1;
        }
    }
    assert!(count > 50, "{count}");
}

#[test]
fn every_seed_is_answered_in_json() {
    for (path, text) in files() {
        if let Some((json, named)) = json(&text, &path) {
            fuzzing::answer(&json, &named);
        }
    }
}

const ARM: &str = r#"{
    "$schema": "hyperstat.schema.json",
    "name": "arm",
    "materials": { "steel": { "young": 2.1e11, "poisson": 0.3 } },
    "sections": { "rod": { "Circle": { "diameter": 0.02 } } },
    "points": { "A": [0, 0, 0], "\u0042": [0.5, 0, 0] },
    "bodies": { "arm": { "Beam": { "through": ["A", "B"], "section": "rod", "material": "steel" } } },
    "joints": {
        "base": {
            "at": "A", "between": ["ground", "arm"], "kind": { "Fixed": null },
            "stiffness": { "Matrix": [
                [1e7, 0, 0, 0, 0, 0], [0, 1e7, 0, 0, 0, 0], [0, 0, 1e7, 0, 0, 0],
                [0, 0, 0, 1e4, 0, 0], [0, 0, 0, 0, 1e4, 0], [0, 0, 0, 0, 0, 1e4]
            ] }
        }
    },
    "loads": [{ "on": ["arm", "B"], "force": [0, 0, -1] }],
    "output": ["arm", "B"]
}"#;

#[test]
fn values_are_named_by_the_same_paths() {
    let arm = mechanism(ARM);
    let area = |arm: &Mechanism| arm.model.segments()[0].section.area();
    let thicker = arm.with_values(&[("sections.rod.diameter", 0.04)]).unwrap();
    assert_eq!(area(&thicker), 4.0 * area(&arm));
    let far = arm.with_values(&[("points.B.0", 1.0)]).unwrap();
    assert_eq!(far.model.geometry().positions[1].x, 1.0);
    let soft = arm
        .with_values(&[("joints.base.stiffness.0.2.2", 5.0)])
        .unwrap();
    assert_ne!(
        soft.model.joints()[0].stiffness,
        arm.model.joints()[0].stiffness
    );

    // Other kinds and names, as RON or as JSON.
    for tube in [
        "Tube(outer: 0.02, inner: 0.01)",
        r#"{"Tube": {"outer": 0.02, "inner": 0.01}}"#,
    ] {
        let hollow = arm.with_values(&[("sections.rod", tube)]).unwrap();
        assert!(area(&hollow) < area(&arm), "{tube}");
    }
    for body in ["arm", "\"arm\""] {
        arm.with_values(&[("output.0", body)]).unwrap();
    }
    let free = Value::Text("Spherical".into());
    let ball = arm.with_values(&[("joints.base.kind", free)]).unwrap();
    assert_eq!(ball.model.joints()[0].joint.kind(), "Spherical");
    let error = arm.with_values(&[("sections.rod.Circle.diameter", 1.0)]);
    let error = error.unwrap_err().to_string();
    assert!(error.contains("has no `Circle`"), "{error}");
    let mut model = arm.model.clone();
    arm.name_values(&mut model);
    let job = Job::new("j", arm, JobPoses::Own, &Registry::builtin());
    let mut job = job.unwrap();
    job.set_vary(
        &[("sections.rod.diameter", vec![0.02.into(), 0.03.into()])],
        false,
    )
    .unwrap();
    job.set("gravity", "(0.0, 0.0, -9.81)").unwrap_err(); // no density
    job.set("loads", "[(on: (\"arm\", \"B\"), force: (1.0, 0.0, 0.0))]")
        .unwrap();
    job.set("loads", r#"[{"on": ["arm", "B"], "force": [1, 0, 0]}]"#)
        .unwrap();
    assert_eq!(job.designs(), 2);
}

#[test]
fn json_names_ron_and_the_other_way_round() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("json-names-ron");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("arm.json"), ARM).unwrap();
    let ron = write(&mechanism(ARM).model, &Registry::builtin()).unwrap();
    std::fs::write(folder.join("arm.ron"), ron).unwrap();
    let vary = [
        r#"vary: { "sections.rod.diameter": Range(0.01, 0.03, 3), "joints.base.kind": [Fixed] }"#,
        r#""vary": { "sections.arm.diameter": { "Range": [0.01, 0.03, 3] }, "joints.base.kind": ["Fixed"] }"#,
    ];
    let [in_ron, in_json] = vary;
    let ron = format!(r#"(jobs: [(name: "a", mechanism: File("arm.json"), {in_ron})])"#);
    let json =
        format!(r#"{{"jobs": [{{"name": "a", "mechanism": {{"File": "arm.ron"}}, {in_json}}}]}}"#);
    for (text, name) in [(ron, "batch.ron"), (json, "batch.json")] {
        let Ok(Input::Batch(batch)) = read(&text, &folder.join(name)) else {
            panic!(
                "{:?}",
                read(&text, &folder.join(name)).err().map(|e| e.to_string())
            );
        };
        assert_eq!(batch.jobs[0].designs(), 3, "{name}");
        let thick = batch.jobs[0].design(2).unwrap().model().unwrap();
        let area = std::f64::consts::PI * 0.03 * 0.03 / 4.0;
        assert!(
            (thick.segments()[0].section.area() - area).abs() < 1e-15,
            "{name}"
        );
    }
}

#[test]
fn a_program_gives_parameters_as_before() {
    let material = Value::Text("(young: 2.1e11, poisson: 0.3)".into());
    let sections = Value::Text("(Circle(diameter: 0.02), Circle(diameter: 0.02))".into());
    let own = JobMechanism::prebuilt(
        "SingleFreedom",
        [
            ("lengths", Value::Text("(0.4, 0.3)".into())),
            ("sections", sections),
            ("material", material),
            ("joint_stiffness", Value::Text("(Rigid, 2e7)".into())),
        ],
    );
    Job::new("j", own, JobPoses::Own, &Registry::builtin()).unwrap();
}
