//! A prebuilt mechanism of one's own beside the same mechanism written out and moved by loop closure.

use std::path::Path;
use std::process::Command;

use hyperstat_assembly::{Model, solve};
use hyperstat_mechanisms::prebuilt::Prebuilt;
use hyperstat_mechanisms::{
    Disk, Job, JobMechanism, JobPoses, Mechanism, Registry, Target, Value, load_batch,
    load_mechanism,
};
use own_joints::FiveBar;

fn registry() -> Registry {
    let mut registry = Registry::builtin();
    registry.register_prebuilt("FiveBar", FiveBar::PARAMETERS, FiveBar::read);
    registry
}

fn job() -> Job {
    let file = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/own_five_bar.ron"));
    let batch = load_batch(file, &Disk, &registry());
    batch
        .unwrap_or_else(|error| panic!("{error}"))
        .jobs
        .remove(0)
}

/// The mechanism written out, as the examples have it.
fn written() -> Mechanism {
    let file = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../five_bar.ron"));
    load_mechanism(file, &Disk, &Registry::builtin()).expect("the example")
}

fn stiffness(model: &Model) -> Vec<f64> {
    let output = solve(model).expect("a solution").output;
    output.stiffness.expect("a held output").as_slice().to_vec()
}

#[test]
fn it_is_the_mechanism_that_is_written_out() {
    let (job, written) = (job(), written());
    let mut model = job.model().expect("in reach");
    for pose in 0..3 {
        let mut geometry = model.geometry().clone();
        let at = job.place(pose, &mut geometry).expect("in reach");
        let asked = [Some(at[0]), Some(at[1]), None, None, None, None];
        let reached = written.place_at(&Target::Output(asked)).expect("in reach");
        let pairs = geometry.positions.iter().zip(&reached.geometry.positions);
        let off = pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        assert!(off < 1e-12, "pose {pose}: {off:e}");
        model.set_geometry(geometry).expect("its own");
        let mut expected = written.model.clone();
        expected.set_geometry(reached.geometry).expect("its own");
        let (found, expected) = (stiffness(&model), stiffness(&expected));
        let largest = expected.iter().fold(0.0_f64, |most, k| most.max(k.abs()));
        for (found, expected) in found.iter().zip(&expected) {
            assert!(
                (found - expected).abs() < 1e-10 * largest,
                "pose {pose}: {found} {expected}"
            );
        }
    }
    let mut geometry = model.geometry().clone();
    let error = job.place(3, &mut geometry).expect_err("too far");
    assert_eq!(error.status(), "unreachable");
}

/// The drives turn by what loop closure of the mechanism that is written out finds.
#[test]
fn its_drives_turn_as_those_of_the_mechanism_that_is_written_out() {
    let written = written();
    let link =
        |section: &str| format!("(section: {section}, material: (young: 7.0e10, poisson: 0.33))");
    let five_bar = FiveBar {
        base: 0.3,
        crank_length: 0.05_f64.sqrt(),
        rod_length: 0.1109_f64.sqrt(),
        crank: hyperstat_mechanisms::prebuilt::Link {
            section: written.model.segments()[0].section.clone(),
            material: written.model.segments()[0].material.clone(),
        },
        rod: hyperstat_mechanisms::prebuilt::Link {
            section: written.model.segments()[2].section.clone(),
            material: written.model.segments()[2].material.clone(),
        },
        drive_stiffness: Some(2e4),
        elements: 1,
    };
    let (home, there) = ([0.0, 0.42], [0.05, 0.35]);
    let drives = five_bar.drives_between(&home, &there).expect("in reach");
    let asked = [Some(there[0]), Some(there[1]), None, None, None, None];
    let reached = written.place_at(&Target::Output(asked)).expect("in reach");
    assert_eq!(drives.len(), 2);
    let angle = |k: usize, pose: &[f64]| {
        let placed = five_bar.place_at(pose).expect("in reach").geometry;
        let crank = placed.positions[2 * k + 1] - placed.positions[2 * k];
        crank.y.atan2(crank.x)
    };
    for (k, (found, expected)) in drives.iter().zip(&reached.drives).enumerate() {
        assert_eq!(
            (found.joint, found.direction),
            (expected.joint, expected.direction)
        );
        assert!((found.value - expected.value).abs() < 1e-10);
        // As the cranks lie.
        assert!((found.value - (angle(k, &there) - angle(k, &home))).abs() < 1e-10);
    }
    // Made in code by its name, it is the one of the file.
    let parameters: [(&str, Value); 6] = [
        ("base", 0.3.into()),
        ("crank_length", five_bar.crank_length.into()),
        ("rod_length", five_bar.rod_length.into()),
        ("crank", link("Rectangle(width: 0.03, height: 0.03)").into()),
        ("rod", link("Tube(outer: 0.025, inner: 0.021)").into()),
        ("drive_stiffness", 2e4.into()),
    ];
    let mechanism = JobMechanism::prebuilt("FiveBar", parameters);
    let poses = JobPoses::list(&[[0.0, 0.42, 0.0]]);
    let made = Job::new("five-bar", mechanism, poses, &registry()).expect("a job");
    let segments = |job: &Job| format!("{:?}", job.model().expect("in reach").segments());
    assert_eq!(segments(&made), segments(&job()));
}

/// What it says of its values, by the paths that the file has.
#[test]
fn its_values_have_the_names_of_its_parameters() {
    let job = job();
    let design = job.design(0).expect("a design");
    let mut model = design.model().expect("in reach");
    job.name_values(&design, &mut model);
    let mut names: Vec<&str> = (model.values().into_iter())
        .filter_map(|(place, _)| model.value_name(place))
        .collect();
    names.sort_unstable();
    names.dedup();
    let expected = [
        "crank.material.poisson",
        "crank.material.young",
        "crank.section.height",
        "crank.section.width",
        "drive_stiffness",
        "rod.material.poisson",
        "rod.material.young",
        "rod.section.inner",
        "rod.section.outer",
    ];
    assert_eq!(names, expected);
}

#[test]
fn the_binary_runs_it_and_tells_mistakes() {
    let text = include_str!("../own_five_bar.ron");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let run = |name: &str, text: &str| {
        let file = folder.join(format!("{name}.ron"));
        std::fs::write(&file, text).expect("a file");
        let out = folder.join(name);
        let output = Command::new(env!("CARGO_BIN_EXE_own-joints"))
            .args([
                "run".as_ref(),
                file.as_os_str(),
                "--out".as_ref(),
                out.as_os_str(),
            ])
            .output()
            .expect("the binary");
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code(), error, out)
    };
    // One pose is out of reach.
    let (code, error, out) = run("five-bar-run", text);
    assert_eq!(code, Some(1), "{error}");
    let table = std::fs::read_to_string(out.join("five-bar.csv")).expect("a table");
    let status = |line: &str| line.split(',').nth(7).map(str::to_owned);
    let statuses: Vec<_> = table.lines().skip(1).filter_map(status).collect();
    assert_eq!(statuses, ["ok", "ok", "ok", "unreachable"]);
    for (k, (right, wrong, message)) in [
        ("FiveBar(", "FivBar(", "did you mean `FiveBar`?"),
        ("base:", "bas:", "did you mean `base`?"),
        (
            "base: 0.3",
            "base: -0.3",
            "`base`: -0.3 m is not a length above zero",
        ),
        (
            "Rectangle(width",
            "Rectangle(widht",
            "did you mean `width`?",
        ),
        (
            "(0.05, 0.35, 0.0)",
            "(0.05, 0.35, 0.1)",
            "a pose of it is `(x, y, 0, 0, 0, 0)`",
        ),
    ]
    .into_iter()
    .enumerate()
    {
        assert_eq!(text.matches(right).count(), 1, "{right}");
        let (code, error, _) = run(&format!("five-bar-{k}"), &text.replace(right, wrong));
        assert_eq!(code, Some(2), "{error}");
        assert!(error.contains(message), "no `{message}` in\n{error}");
    }
}
