//! Jobs and mechanisms that a program makes: they are those of the same batch file.

use std::path::Path;

use hyperstat_joints::Dof;
use hyperstat_mechanisms::{
    Disk, Drive, Job, JobLoad, JobMechanism, JobPoses, LoadError, Mechanism, PoseError, Registry,
    Target, Value, batch_from_str, load_mechanism, mechanism_from_str,
};
use hyperstat_model::JointId;

const PARAMETERS: [(&str, &str); 9] = [
    ("base_radius", "0.25"),
    ("platform_radius", "0.06"),
    ("arm_length", "0.30"),
    ("rod_length", "0.60"),
    ("rod_spacing", "0.12"),
    (
        "arm",
        "(section: Circle(diameter: 0.030), material: (young: 2.1e11, poisson: 0.3))",
    ),
    (
        "bar",
        "(section: Circle(diameter: 0.020), material: (young: 2.1e11, poisson: 0.3))",
    ),
    (
        "rod",
        "(section: Circle(diameter: 0.014), material: (young: 2.1e11, poisson: 0.3))",
    ),
    ("joint_stiffness", "(x: 1e8, y: 1e8, z: 1e8)"),
];

fn delta() -> JobMechanism {
    JobMechanism::prebuilt("Delta", PARAMETERS)
}

/// The same job as a batch file has it.
fn of_file(mechanism: &str, rest: &str) -> Job {
    let text = format!("(jobs: [(name: \"j\", mechanism: {mechanism}, {rest})])");
    let path = Path::new("../../examples/batch.ron");
    let batch = batch_from_str(&text, path, &Disk, &Registry::builtin());
    batch
        .unwrap_or_else(|error| panic!("{error}"))
        .jobs
        .remove(0)
}

fn delta_of_file(rest: &str) -> Job {
    let parameters = PARAMETERS.map(|(name, value)| format!("{name}: {value}"));
    of_file(&format!("Delta({})", parameters.join(", ")), rest)
}

fn portal() -> Mechanism {
    load_mechanism(
        Path::new("../../examples/portal.ron"),
        &Disk,
        &Registry::builtin(),
    )
    .unwrap()
}

fn five_bar() -> Mechanism {
    load_mechanism(
        Path::new("../../examples/five_bar.ron"),
        &Disk,
        &Registry::builtin(),
    )
    .unwrap()
}

/// Everything about a job's designs.
fn whole(job: &Job) -> String {
    let mut text = format!("{} {:?} {:?}", job.name, job.cases(), job.commanded());
    for number in 0..job.designs() {
        text += &format!("\n{:?}", job.values(number));
        let design = match job.design(number) {
            Ok(design) => design,
            Err(error) => {
                text += &error.message();
                continue;
            }
        };
        let mut model = design.model().unwrap();
        job.name_values(&design, &mut model);
        text += &format!(
            "\n{:?} {:?} {:?} {:?} {:?} {:?}",
            model.segments(),
            model.joints(),
            model.loads(),
            model.cases(),
            model.gravity(),
            model.masses(),
        );
        for (place, _) in model.values() {
            text += &format!("\n{:?}", model.value_name(place));
        }
        for pose in 0..job.len() {
            let mut geometry = model.geometry().clone();
            let placed = design.place(pose, &mut geometry);
            text += &format!("\n{placed:?} {geometry:?} {:?}", job.target(pose));
        }
    }
    text
}

#[track_caller]
fn same(made: &Job, of_file: &Job) {
    let (made, of_file) = (whole(made), whole(of_file));
    assert!(made == of_file, "{made}\n\n{of_file}");
}

fn load(body: &str, point: &str, force: [f64; 3]) -> JobLoad {
    JobLoad {
        on: (body.into(), point.into()),
        force,
        moment: [0.5, 0.0, 0.0],
    }
}

#[test]
fn a_prebuilt_job_is_that_of_its_file() {
    let poses = JobPoses::list(&[[0.0, 0.0, 0.5], [0.1, -0.1, 0.55], [0.0, 0.0, 5.0]]);
    let mut job = Job::new("j", delta(), poses, &Registry::builtin()).unwrap();
    let poses = "poses: List([(0.0, 0.0, 0.5), (0.1, -0.1, 0.55), (0.0, 0.0, 5.0)])";
    same(&job, &delta_of_file(poses));
    job.set_loads(&[load("platform", "P", [1.0, 2.0, -1e-7])])
        .unwrap();
    job.set_cases(&[
        ("push", vec![load("arm1", "B1", [0.1, 0.0, 0.0])]),
        ("none", vec![]),
    ])
    .unwrap();
    let acting = r#"loads: [(on: ("platform", "P"), force: (1, 2, -1e-7), moment: (0.5, 0, 0))],
        cases: { "push": [(on: ("arm1", "B1"), force: (0.1, 0, 0), moment: (0.5, 0, 0))], "none": [] }"#;
    same(&job, &delta_of_file(&format!("{poses}, {acting}")));
    let diameters: Vec<Value> = vec![0.012.into(), (-0.1).into(), 0.014.into()];
    let elements: Vec<Value> = vec![1.0.into(), 2.0.into()];
    job.set_vary(
        &[
            ("rod.section.diameter", diameters),
            ("arm.material.young", elements),
        ],
        false,
    )
    .unwrap();
    let vary =
        r#"vary: { "rod.section.diameter": [0.012, -0.1, 0.014], "arm.material.young": [1, 2] }"#;
    same(&job, &delta_of_file(&format!("{poses}, {acting}, {vary}")));
    job.set_vary(&[], false).unwrap();
    job.set("cases", "").unwrap();
    job.set("gravity", "(0, 0, 0)").unwrap();
    let acting = r#"loads: [(on: ("platform", "P"), force: (1, 2, -1e-7), moment: (0.5, 0, 0))]"#;
    same(&job, &delta_of_file(&format!("{poses}, {acting}")));
}

#[test]
fn columns_in_any_order_and_grids() {
    let registry = Registry::builtin();
    let table = JobPoses::Table {
        columns: ["z", "x", "y"].map(String::from).to_vec(),
        rows: vec![0.5, 0.1, -0.1, 0.55, 0.0, 0.2],
    };
    let made = Job::new("j", delta(), table, &registry).unwrap();
    same(
        &made,
        &delta_of_file("poses: List([(0.1, -0.1, 0.5), (0.0, 0.2, 0.55)])"),
    );
    let grid = "Grid(x: (-0.1, 0.1, 3), y: (0.0, 0.0, 1), z: (0.5, 0.6, 2))";
    let made = Job::new("j", delta(), JobPoses::Written(grid.into()), &registry).unwrap();
    same(&made, &delta_of_file(&format!("poses: {grid}")));
}

#[test]
fn jobs_of_a_loaded_mechanism_are_those_of_its_file() {
    let registry = Registry::builtin();
    let mut made = Job::new("j", portal(), JobPoses::Own, &registry).unwrap();
    same(&made, &of_file("File(\"portal.ron\")", ""));
    let bodies: Vec<Value> = vec!["steel".into()];
    made.set_vary(
        &[
            ("sections.rod.diameter", vec![0.01.into(), 0.02.into()]),
            ("bodies.arm.material", bodies),
        ],
        false,
    )
    .unwrap();
    let vary =
        r#"vary: { "sections.rod.diameter": [0.01, 0.02], "bodies.arm.material": ["steel"] }"#;
    same(&made, &of_file("File(\"portal.ron\")", vary));

    let poses = JobPoses::Table {
        columns: vec!["x".into(), "y".into()],
        rows: vec![0.0, 0.3, 0.05, 0.35, 9.0, 9.0],
    };
    let made = Job::new("j", five_bar(), poses, &registry).unwrap();
    let table = "poses: List([(0.0, 0.3, 0.0), (0.05, 0.35, 0.0), (9.0, 9.0, 0.0)])";
    let file = of_file("File(\"five_bar.ron\")", table);
    let place = |job: &Job, pose: usize| {
        let mut geometry = job.model().unwrap().geometry().clone();
        let placed = job.place(pose, &mut geometry);
        placed
            .map(|pose| (pose, geometry))
            .map_err(|error| error.status())
    };
    for pose in 0..2 {
        let (made, file) = (place(&made, pose).unwrap(), place(&file, pose).unwrap());
        let pairs = made.1.positions.iter().zip(&file.1.positions);
        assert!(pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max) < 1e-12);
    }
    assert_eq!(place(&made, 2).unwrap_err(), "unreachable");

    let drives = JobPoses::Table {
        columns: vec!["A1.v".into(), "A2.v".into()],
        rows: vec![0.0, 0.0, 0.1, -0.05],
    };
    let made = Job::new("j", five_bar(), drives, &registry).unwrap();
    assert_eq!(made.drives(), ["A1.v", "A2.v"]);
    assert_eq!(made.drive_values(1), [0.1, -0.05]);
}

#[track_caller]
fn refused<T>(made: Result<T, LoadError>, place: &str, message: &str, help: &str) {
    let error = made.map(|_| ()).expect_err(message);
    assert_eq!(error.to_string(), format!("{place}: {message}"));
    assert_eq!(error.help(), Some(help));
}

#[test]
fn mistakes_name_the_argument() {
    let registry = Registry::builtin();
    let at = |poses: &[[f64; 6]]| Job::new("j", delta(), JobPoses::list(poses), &registry);
    let mut pose = [0.0, 0.0, 0.5, 0.0, 0.0, 0.0];
    pose[4] = 0.1;
    refused(
        at(&[[0.0, 0.0, 0.5, 0.0, 0.0, 0.0], pose]),
        "poses.1.ry",
        "`Delta` cannot follow this coordinate",
        "a pose of it is `(x, y, z, 0, 0, 0)`",
    );
    pose[4] = f64::NAN;
    refused(
        at(&[pose]),
        "poses.0.ry",
        "`NaN` is not a finite number",
        "give a number such as 0.25 or 2.1e11",
    );
    refused(
        at(&[]),
        "poses",
        "the list of poses is empty",
        "give at least one pose",
    );
    let columns = |columns: &[&str], rows: Vec<f64>| {
        let columns = columns.iter().map(|name| (*name).into()).collect();
        Job::new("j", delta(), JobPoses::Table { columns, rows }, &registry)
    };
    let known = "the columns are x,y,z or x,y,z,rx,ry,rz";
    refused(
        columns(&["x", "y"], vec![0.0; 2]),
        "poses",
        "the column `z` is missing",
        known,
    );
    refused(
        columns(&["x", "x"], vec![0.0; 2]),
        "poses.x",
        "the column `x` is given twice",
        known,
    );
    refused(
        columns(&["x", "y", "z"], vec![0.0; 4]),
        "poses",
        "4 numbers are no rows of 3 columns",
        "give a number for every column of every pose",
    );
    refused(
        Job::new("j", delta(), JobPoses::Own, &registry),
        "mechanism",
        "`Delta` needs `poses`",
        "add `poses: List([(x, y, z)])`, `Csv(\"file.csv\")` or `Grid(…)`",
    );
    let list = || JobPoses::list(&[[0.0, 0.0, 0.5]]);
    let dleta = JobMechanism::prebuilt("Dleta", PARAMETERS);
    refused(
        Job::new("j", dleta, list(), &registry),
        "mechanism",
        "unknown mechanism `Dleta`",
        "did you mean `Delta`?",
    );
    let mut parameters = PARAMETERS.map(|(name, value)| (name, Value::from(value)));
    parameters[2].1 = Value::Number(-0.3);
    refused(
        Job::new(
            "j",
            JobMechanism::prebuilt("Delta", parameters.clone()),
            list(),
            &registry,
        ),
        "mechanism.arm_length",
        "`arm_length`: -0.3 m is not a length above zero",
        "give a finite length in metres, such as 0.3",
    );
    parameters[2] = ("arm_lenght", Value::Number(0.3));
    refused(
        Job::new(
            "j",
            JobMechanism::prebuilt("Delta", parameters),
            list(),
            &registry,
        ),
        "mechanism:4:5",
        "unknown field `arm_lenght` of `Delta`",
        "did you mean `arm_length`?",
    );
    assert!(Job::new("a/b", delta(), list(), &registry).is_err());
    let mut job = Job::new("j", delta(), list(), &registry).unwrap();
    let before = whole(&job);
    refused(
        job.set_loads(&[load("platfrom", "P", [0.0; 3])]),
        "loads:1:8",
        "unknown body `platfrom`",
        "did you mean `platform`?",
    );
    refused(
        job.set_vary(
            &[("rod_length", vec![0.6.into(), f64::INFINITY.into()])],
            false,
        ),
        "vary:1:23",
        "design 1: `inf` is not a finite number",
        "give a number such as 0.25 or 2.1e11",
    );
    refused(
        job.set("load", "[]"),
        "field",
        "unknown field `load` of a job",
        "did you mean `loads`?",
    );
    assert!(whole(&job) == before);
}

/// The same text with the values written by hand is the same mechanism.
#[test]
fn values_by_path_are_those_written_by_hand() {
    let text = std::fs::read_to_string("../../examples/portal.ron").unwrap();
    let path = Path::new("../../examples/portal.ron");
    let registry = Registry::builtin();
    let by_hand = |pairs: &[(&str, &str)]| {
        let mut text = text.clone();
        for (old, new) in pairs {
            assert_eq!(text.matches(old).count(), 1);
            text = text.replace(old, new);
        }
        mechanism_from_str(&text, path, &Disk, &registry).unwrap()
    };
    let parts = |mechanism: &Mechanism| {
        let model = &mechanism.model;
        format!(
            "{:?} {:?} {:?}",
            model.segments(),
            model.joints(),
            model.geometry()
        )
    };
    let thicker = portal()
        .with_values(&[("sections.rod.diameter", 0.02), ("points.B.1", 0.25)])
        .unwrap();
    let expected = by_hand(&[
        ("diameter: 0.014", "diameter: 0.02"),
        ("0.3, 0.2", "0.25, 0.2"),
    ]);
    assert_eq!(parts(&thicker), parts(&expected));
    // Of what stands there now: a part of what was put there whole.
    let tube = "Tube(outer: 0.03, inner: 0.01)";
    let tube = thicker.with_values(&[("sections.rod", tube)]).unwrap();
    let tube = tube.with_values(&[("sections.rod.inner", 0.02)]).unwrap();
    let expected = by_hand(&[
        ("Circle(diameter: 0.014)", "Tube(outer: 0.03, inner: 0.02)"),
        ("0.3, 0.2", "0.25, 0.2"),
    ]);
    assert_eq!(parts(&tube), parts(&expected));
    let mut model = tube.model.clone();
    tube.name_values(&mut model);
    let names = model
        .values()
        .into_iter()
        .filter_map(|(place, _)| model.value_name(place));
    assert!(names.into_iter().any(|name| name == "sections.rod.inner"));
    // The name of a material needs no quotes.
    assert!(
        portal()
            .with_values(&[("bodies.arm.material", "steel")])
            .is_ok()
    );
}

#[test]
fn what_is_wrong_with_values_is_told_as_vary_tells_it() {
    refused(
        portal().with_values(&[("sectoins.rod.diameter", 0.02)]),
        "sectoins.rod.diameter:1:2",
        "the mechanism has no `sectoins`",
        "did you mean `sections`?",
    );
    refused(
        portal().with_values(&[("sections.rod.diameter", -0.02)]),
        "sections.rod.diameter",
        "`diameter` of section `rod` cannot be -0.02",
        "it must be a finite number above zero",
    );
    refused(
        portal().with_values(&[("points.B", "(0, 0, 0)"), ("points.B.1", "0.1")]),
        "points.B.1",
        "`points.B` and `points.B.1` overlap",
        "one is a part of the other: vary the whole or its parts",
    );
    refused(
        portal().with_values(&[("bodies.arm.material", "stel")]),
        "bodies.arm.material",
        "unknown material `stel`",
        "did you mean `steel`?",
    );
}

/// Where the mistake stands elsewhere, the value that makes it is told, in the words of a design.
#[test]
fn a_mistake_elsewhere_is_told_at_the_value() {
    let (path, value) = ("points.A", "(0.0, 0.3, 0.2)");
    let error = portal().with_values(&[(path, value)]).unwrap_err();
    assert_eq!(error.location().unwrap().to_string(), path);
    let vary = format!("vary: {{ \"{path}\": [{value}] }}");
    let text = format!("(jobs: [(name: \"j\", mechanism: File(\"portal.ron\"), {vary})])");
    let batch = Path::new("../../examples/batch.ron");
    let design = batch_from_str(&text, batch, &Disk, &Registry::builtin()).unwrap_err();
    assert_eq!(design.message(), format!("design 0, {}", error.message()));
    assert!(
        error
            .message()
            .starts_with("`points.A` = (0.0, 0.3, 0.2): "),
        "{error}"
    );
}

/// By closure as by the job of the file, and back.
#[test]
fn a_mechanism_at_a_target() {
    let five_bar = five_bar();
    let job = of_file(
        "File(\"five_bar.ron\")",
        "poses: Grid(x: (0.05, 0.05, 1), y: (0.35, 0.35, 1))",
    );
    let mut geometry = five_bar.model.geometry().clone();
    let pose = job.place(0, &mut geometry).unwrap();
    let asked = [Some(0.05), Some(0.35), None, None, None, None];
    let reached = five_bar.place_at(&Target::Output(asked)).unwrap();
    assert_eq!(reached.geometry, geometry);
    let off = reached.pose.iter().zip(pose).map(|(a, b)| (a - b).abs());
    assert!(off.fold(0.0, f64::max) < 1e-12);
    assert_eq!(reached.drives.len(), 2);
    let back = five_bar.place_at(&Target::Drives(&reached.drives)).unwrap();
    let pairs = back.geometry.positions.iter().zip(&geometry.positions);
    assert!(pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max) < 1e-12);
    let far = [Some(5.0), Some(5.0), None, None, None, None];
    let error = five_bar.place_at(&Target::Output(far)).unwrap_err();
    assert_eq!(error.status(), "unreachable");
    let drive = |value| Drive {
        joint: JointId(0),
        direction: Dof::V,
        value,
    };
    let error = five_bar
        .place_at(&Target::Drives(&[drive(f64::NAN)]))
        .unwrap_err();
    assert!(matches!(error, PoseError::Closure(_)));
}

#[test]
fn a_varied_text_is_one_value() {
    let poses = JobPoses::list(&[[0.0, 0.0, 0.5]]);
    let mut job = Job::new("j", delta(), poses, &Registry::builtin()).unwrap();
    for text in [
        "0.01, 0.02",
        "",
        "0.1], \"arm_length\": [0.3",
        "0.01 /* a */, 0.02",
    ] {
        let vary = [("rod.section.diameter", vec![text.into(), 0.03.into()])];
        assert!(job.set_vary(&vary, false).is_err(), "{text}");
        assert_eq!(job.designs(), 1, "{text}");
    }
}

#[test]
fn a_job_s_mechanism_is_not_taken_for_that_of_its_file() {
    let file = "File(\"portal.ron\")";
    let loads = "loads: [(on: (\"beam\", \"T\"), force: (0.0, 0.0, -1.0))]";
    let try_load = |rest: &str| {
        let text = format!("(jobs: [(name: \"j\", mechanism: {file}, {rest})])");
        let path = Path::new("../../examples/batch.ron");
        batch_from_str(&text, path, &Disk, &Registry::builtin())
    };
    let own = portal();
    let (body, point) = {
        let output = own.model.output().unwrap();
        let name = own.model.node_name(output);
        let (body, point) = name.split_once('.').unwrap();
        (body.to_string(), point.to_string())
    };
    let loads = loads
        .replace("beam", &body)
        .replace("\"T\"", &format!("{point:?}"));
    let job = try_load(&loads).unwrap().jobs.remove(0);
    let mechanism = job.mechanism().unwrap().clone();
    let made = Job::new("n", mechanism, JobPoses::Own, &Registry::builtin());
    assert!(made.unwrap_err().help().is_some());
}

#[test]
fn a_mechanism_as_it_is_written_takes_poses_later() {
    let registry = Registry::builtin();
    let link = |json: bool| match json {
        true => {
            r#"{"section": {"Circle": {"diameter": 0.02}}, "material": {"young": 2.1e11, "poisson": 0.3}}"#
        }
        false => "(section: Circle(diameter: 0.02), material: (young: 2.1e11, poisson: 0.3))",
    };
    let json = format!(
        r#"{{"Delta": {{"base_radius": 0.25, "platform_radius": 0.06, "arm_length": 0.3, "rod_length": 0.6,
            "rod_spacing": 0.12, "arm": {link}, "bar": {link}, "rod": {link}}}}}"#,
        link = link(true)
    );
    let ron = format!(
        "Delta(base_radius: 0.25, platform_radius: 0.06, arm_length: 0.3, rod_length: 0.6, \
         rod_spacing: 0.12, arm: {link}, bar: {link}, rod: {link})",
        link = link(false)
    );
    let poses = || JobPoses::list(&[[0.0, 0.0, 0.5], [0.1, -0.1, 0.52]]);
    let mut placed = Vec::new();
    for text in [json, ron] {
        let written = JobMechanism::Written(text);
        let mut job = Job::new("later", written, JobPoses::Later, &registry).unwrap();
        job.set_json(
            "loads",
            r#"[{"on": ["platform", "P"], "force": [0, 0, -50]}]"#,
        )
        .unwrap();
        let error = job.set_json("loads", r#"[{"on": ["platform", "P"], "force": [0, 0]}]"#);
        assert!(error.unwrap_err().to_string().starts_with("loads:1:"));
        job.set_poses(poses()).unwrap();
        assert_eq!(job.len(), 2);
        let error = job
            .set_poses(JobPoses::list(&[[0.0, f64::NAN, 0.5]]))
            .unwrap_err();
        assert!(error.to_string().starts_with("poses.0.y: "), "{error}");
        assert_eq!(job.len(), 2);
        let model = job.model().unwrap();
        assert_eq!(model.loads().len(), 1);
        placed.push(model.geometry().positions.clone());
        let thicker = job
            .with_values(0, &[("rod.section.diameter", 0.03)])
            .unwrap();
        assert_eq!((thicker.len(), thicker.designs()), (2, 1));
    }
    assert_eq!(placed[0], placed[1]);
    let unknown = JobMechanism::Written("Dleta()".into());
    let error = Job::new("later", unknown, JobPoses::Later, &registry).unwrap_err();
    assert_eq!(
        error.to_string(),
        "mechanism:1:1: unknown mechanism `Dleta`"
    );
    assert_eq!(error.help(), Some("did you mean `Delta`?"));
}
