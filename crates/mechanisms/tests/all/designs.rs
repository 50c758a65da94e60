//! Many designs of one job: each is the mechanism with the varied values written out by hand.

use std::path::Path;

use hyperstat_mechanisms::{Batch, Disk, Job, LoadError, Registry, Value, batch_from_str};

const DELTA: &str = "Delta(
    base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60, rod_spacing: 0.12,
    arm: (section: Circle(diameter: 0.030), material: (young: 2.1e11, poisson: 0.3)),
    bar: (section: Circle(diameter: 0.020), material: (young: 2.1e11, poisson: 0.3)),
    rod: (section: Circle(diameter: 0.014), material: (young: 2.1e11, poisson: 0.3)),
    joint_stiffness: (x: 1e8, y: 1e8, z: 1e8),
    elements: 1,
), poses: List([(0, 0, 0.5), (0.1, -0.1, 0.55)]), loads: [(on: (\"platform\", \"P\"), force: (1, 2, 3))]";

const PORTAL: &str = "File(\"portal.ron\")";

/// The only job of a batch whose file stands among the examples.
fn job(mechanism: &str, rest: &str) -> Job {
    try_job(mechanism, rest).unwrap_or_else(|error| panic!("{error}\n{rest}"))
}

fn try_job(mechanism: &str, rest: &str) -> Result<Job, LoadError> {
    let text = format!("(jobs: [(name: \"d\", mechanism: {mechanism}, {rest})])");
    read(&text).map(|mut batch| batch.jobs.remove(0))
}

fn read(text: &str) -> Result<Batch, LoadError> {
    let path = Path::new("../../examples/designs_test.ron");
    batch_from_str(text, path, &Disk, &Registry::builtin())
}

fn replaced(text: &str, old: &str, new: &str) -> String {
    assert_eq!(text.matches(old).count(), 1, "{old}");
    text.replace(old, new)
}

/// Everything about a design: its model and where its poses bring it.
fn whole(job: &Job, design: usize) -> String {
    let design = job.design(design).unwrap();
    let model = design.model().unwrap();
    let mut text = format!(
        "{:?} {:?} {:?} {:?} {:?} {:?}",
        model.bodies(),
        model.nodes(),
        model.segments(),
        model.joints(),
        model.loads(),
        model.output(),
    );
    for pose in 0..design.len() {
        let mut geometry = model.geometry().clone();
        let placed = design.place(pose, &mut geometry);
        text += &format!("\n{placed:?} {geometry:?} {:?}", job.target(pose));
    }
    text
}

fn numbers(job: &Job, design: usize) -> Vec<f64> {
    let design = job.design(design).unwrap();
    let number = |value: &Value| match value {
        Value::Number(number) => *number,
        Value::Text(text) => panic!("{text} is not a number"),
    };
    design.values().iter().map(number).collect()
}

#[test]
fn a_job_without_variation_has_one_design() {
    let job = job(DELTA, "");
    assert_eq!((job.designs(), job.varied().len()), (1, 0));
    let design = job.design(0).unwrap();
    assert_eq!((design.number(), design.len()), (0, 2));
    assert!(design.values().is_empty());
}

/// The first path runs fastest, as the first coordinate of a grid.
#[test]
fn all_combinations_of_parameters_of_a_prebuilt() {
    let job = job(
        DELTA,
        r#"vary: {
            "rod.section.diameter": [0.012, 0.014],
            "joint_stiffness.x": Range(1e7, 3e7, 3),
            "elements": Range(1, 2, 2),
        }"#,
    );
    assert_eq!(job.designs(), 12);
    let paths = ["rod.section.diameter", "joint_stiffness.x", "elements"];
    assert!(job.varied().iter().map(|varied| &varied.path).eq(paths));
    assert!(job.varied().iter().all(|varied| varied.numeric));
    let mut design = 0;
    for elements in [1, 2] {
        for stiffness in [1e7, 2e7, 3e7] {
            for diameter in [0.012, 0.014] {
                let wanted = [diameter, stiffness, f64::from(elements)];
                assert_eq!(numbers(&job, design), wanted);
                let text = replaced(DELTA, "diameter: 0.014", &format!("diameter: {diameter}"));
                let text = replaced(&text, "(x: 1e8", &format!("(x: {stiffness:?}"));
                let text = replaced(&text, "elements: 1", &format!("elements: {elements}"));
                let by_hand = self::job(&text, "");
                assert!(whole(&job, design) == whole(&by_hand, 0), "design {design}");
                design += 1;
            }
        }
    }
    assert_ne!(whole(&job, 0), whole(&job, 1));
}

#[test]
fn values_side_by_side() {
    let job = job(
        DELTA,
        r#"vary: {
            "arm_length": Range(0.28, 0.32, 3),
            "arm.material.young": [2.1e11, 7e10, 1.1e11],
        }, zip: true"#,
    );
    assert_eq!(job.designs(), 3);
    let pairs = [(0.28, 2.1e11), (0.30, 7e10), (0.32, 1.1e11)];
    for (design, (length, young)) in pairs.into_iter().enumerate() {
        let found = numbers(&job, design);
        assert!((found[0] - length).abs() < 1e-15 && found[1] == young);
        let text = replaced(
            DELTA,
            "arm_length: 0.30",
            &format!("arm_length: {:?}", found[0]),
        );
        let old = "diameter: 0.030), material: (young: 2.1e11";
        let text = replaced(
            &text,
            old,
            &format!("diameter: 0.030), material: (young: {young:?}"),
        );
        assert!(
            whole(&job, design) == whole(&self::job(&text, ""), 0),
            "design {design}"
        );
    }
}

#[test]
fn values_of_a_file_by_path() {
    let file = std::fs::read_to_string("../../examples/portal.ron").unwrap();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let cases = [
        (
            "sections.rod.diameter",
            "0.016",
            "Circle(diameter: 0.014)",
            "Circle(diameter: 0.016)",
        ),
        (
            "sections.rod",
            "Tube(outer: 0.02, inner: 0.01)",
            "Circle(diameter: 0.014)",
            "Tube(outer: 0.02, inner: 0.01)",
        ),
        (
            "materials.steel.young",
            "7e10",
            "young: 2.1e11",
            "young: 7e10",
        ),
        ("points.B.1", "0.25", "(0.0, 0.3, 0.2)", "(0.0, 0.25, 0.2)"),
        (
            "points.B",
            "(0.1, 0.25, 0.2)",
            "(0.0, 0.3, 0.2)",
            "(0.1, 0.25, 0.2)",
        ),
        (
            "bodies.arm.through.1",
            "\"C\"",
            "through: [\"A\", \"B\"]",
            "through: [\"A\", \"C\"]",
        ),
        ("joints.wrist.stiffness.y", "2e6", "y: 1e8", "y: 2e6"),
        (
            "joints.wrist.stiffness",
            "(u: 3e3)",
            "(x: 1e8, y: 1e8, z: 1e8)",
            "(u: 3e3)",
        ),
        (
            "joints.shoulder.kind.axis.2",
            "0.5",
            "axis: (1.0, 0.0, 0.0)",
            "axis: (1.0, 0.0, 0.5)",
        ),
        (
            "joints.shoulder.kind",
            "Spherical",
            "Revolute(axis: (1.0, 0.0, 0.0))",
            "Spherical",
        ),
        (
            "joints.shoulder.locked",
            "[v]",
            "locked: true",
            "locked: [v]",
        ),
        (
            "loads.0.force.2",
            "-70.0",
            "(0.0, 0.0, -50.0)",
            "(0.0, 0.0, -70.0)",
        ),
        (
            "output.1",
            "\"B\"",
            "output: (\"platform\", \"C\")",
            "output: (\"platform\", \"B\")",
        ),
    ];
    for (path, value, old, new) in cases {
        // What a changed name breaks elsewhere is changed with it.
        let point = path == "bodies.arm.through.1";
        let more = if point {
            ", \"joints.wrist.at\": [\"C\"]"
        } else {
            ""
        };
        let job = job(PORTAL, &format!("vary: {{ \"{path}\": [{value}]{more} }}"));
        let mut text = replaced(&file, old, new);
        if point {
            text = replaced(&text, "at: \"B\"", "at: \"C\"");
        }
        let by_hand = folder.join(format!("{path}.ron"));
        std::fs::write(&by_hand, text).unwrap();
        let path = by_hand.canonicalize().unwrap();
        let by_hand = self::job(&format!("File({path:?})"), "");
        assert!(whole(&job, 0) == whole(&by_hand, 0), "{path:?}");
    }
}

#[test]
fn a_name_may_hold_dots() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let path = folder.join("dots.ron");
    std::fs::write(
        &path,
        r#"(name: "dots", materials: { "a": (young: 1e11, poisson: 0.3), "a.young": (young: 2e11, poisson: 0.3) },
            sections: { "s": Circle(diameter: 0.01) }, points: { "P": (0, 0, 0), "Q": (1, 0, 0) },
            bodies: { "b": Beam(through: ["P", "Q"], section: "s", material: "a.young") },
            joints: { "w": (at: "P", between: ("ground", "b"), kind: Fixed) }, output: ("b", "Q"))"#,
    )
    .unwrap();
    let path = path.canonicalize().unwrap();
    let job = job(
        &format!("File({path:?})"),
        r#"vary: { "materials.a.young.young": [3e11], "bodies.b.material": ["a.young", "a"] }"#,
    );
    let young = |design: usize| {
        let model = job.design(design).unwrap().model().unwrap();
        model.segments()[0].material.young()
    };
    assert_eq!([young(0), young(1)], [3e11, 1e11]);
}

#[test]
fn values_are_numbers_or_text() {
    let job = job(
        PORTAL,
        r#"vary: {
            "sections.rod": [Tube(outer: 0.02, /* thin */ inner: 0.018)],
            "bodies.arm.material": ["steel"],
            "points.C.0": [1e-1],
        }"#,
    );
    let numeric: Vec<_> = job.varied().iter().map(|varied| varied.numeric).collect();
    assert_eq!(numeric, [false, false, true]);
    let wanted = [
        Value::Text("Tube(outer: 0.02, /* thin */ inner: 0.018)".into()),
        Value::Text("steel".into()),
        Value::Number(0.1),
    ];
    let design = job.design(0).unwrap();
    assert_eq!(design.values(), wanted);
    assert_eq!(design.values()[2].to_string(), "0.1");
}

/// What the varied values make of the loads' names is checked in every design.
#[test]
fn a_job_s_loads_are_on_every_design() {
    let job = job(
        PORTAL,
        r#"vary: { "sections.rod.diameter": [0.01, 0.02] }, loads: [(on: ("arm", "B"), force: (7, 0, 0))]"#,
    );
    for design in 0..2 {
        let design = job.design(design).unwrap();
        let model = design.model().unwrap();
        assert_eq!(model.loads().len(), 1);
        assert_eq!(model.node_name(model.loads()[0].node), "arm.B");
        let at = design.mechanism().unwrap().locate_load(0);
        assert!(at.path.ends_with("designs_test.ron"));
    }
}

#[test]
fn a_design_out_of_reach_leaves_the_others_as_they_are() {
    let job = job(DELTA, r#"vary: { "rod_length": [0.6, 0.1, 0.61] }"#);
    let design = job.design(1).unwrap();
    let model = design.model().unwrap();
    assert_eq!(model.loads().len(), 1);
    let mut geometry = model.geometry().clone();
    assert!(design.place(0, &mut geometry).is_err());
    for design in [0, 2] {
        let design = job.design(design).unwrap();
        let mut geometry = design.model().unwrap().geometry().clone();
        assert!(design.place(0, &mut geometry).is_ok());
    }
}

/// A design that cannot be leaves the job and its other designs as they are; its mistake is told when
/// it is made.
#[test]
fn a_design_that_cannot_be_is_told_when_it_is_made() {
    let tube = "Tube(outer: 0.02, inner: 0.01)";
    let mechanism = replaced(DELTA, "Circle(diameter: 0.014)", tube);
    let vary = |outer: &str, inner: &str| {
        let paths = ["outer", "inner"].map(|name| format!("\"rod.section.{name}\""));
        try_job(
            &mechanism,
            &format!("vary: {{ {}: {outer}, {}: {inner} }}", paths[0], paths[1]),
        )
    };
    let job = vary("[0.009, 0.02, -0.02]", "[0.01, 0.02]").unwrap();
    assert_eq!((job.designs(), job.first_design()), (6, 1));
    let mistake = |design: usize| job.design(design).map(|_| ()).map_err(|e| e.message());
    assert_eq!(mistake(1), Ok(()));
    for (design, message) in [
        // Of two values that are both right alone, the one at which the mistake shows is to blame.
        (0, "design 0: `inner` of the section cannot be 0.01"),
        (2, "design 2: `outer` of the section cannot be -0.02"),
        (3, "design 3: `inner` of the section cannot be 0.02"),
        (4, "design 4: `inner` of the section cannot be 0.02"),
    ] {
        let found = mistake(design).unwrap_err();
        assert!(found.starts_with(message), "{found}");
    }
    assert_eq!(job.values(2), [Value::Number(-0.02), Value::Number(0.01)]);
    // Poses, model and mechanism of the job are those of the design that can be.
    let section = |job: &Job| {
        job.model()
            .unwrap()
            .segments()
            .last()
            .unwrap()
            .section
            .clone()
    };
    let alone = try_job(&mechanism, "").unwrap();
    assert_eq!(section(&job), section(&alone));
    let error = vary("[0.009, 0.005]", "[0.01, 0.02]").unwrap_err();
    assert!(error.message().starts_with("design 0: "), "{error}");
}

/// What is no value of its kind is told before the job runs; of a million designs every value is tried,
/// in the company of the first values.
#[test]
fn more_designs_than_are_checked() {
    let vary = |rods: &str| {
        let mechanism = replaced(
            DELTA,
            "Circle(diameter: 0.014)",
            "Tube(outer: 0.02, inner: 0.01)",
        );
        let rest = format!(
            r#"vary: {{
                "rod.section.inner": Range(0.01, 0.018, 1000),
                "rod.section.outer": {rods},
                "arm_length": Range(0.28, 0.32, 1000),
            }}"#
        );
        try_job(&mechanism, &rest)
    };
    let error = vary("[0.02, Rigid]").unwrap_err();
    assert_eq!(error.location().unwrap().line, 10);
    assert!(error.message().starts_with("design 1000: "), "{error}");

    let job = vary("[0.02, 0.012]").unwrap();
    assert_eq!((job.designs(), job.first_design()), (2_000_000, 0));
    assert_eq!(numbers(&job, 1_999_000), [0.01, 0.012, 0.32]);
    assert!(job.design(1_999_000).is_ok());
    let error = job.design(1_999_999).unwrap_err();
    assert!(
        error.message().starts_with("design 1999999: `inner` of"),
        "{error}"
    );
}

#[test]
fn designs_are_not_kept() {
    let job = job(
        DELTA,
        r#"vary: { "arm_length": Range(0.2, 0.4, 1000000), "rod_length": Range(0.5, 0.7, 1000000000) }"#,
    );
    assert_eq!(job.designs(), 1_000_000_000_000_000);
    assert_eq!(numbers(&job, job.designs() - 1), [0.4, 0.7]);
}

/// What a job says beside its mechanism varies, too: as if it were written there.
#[test]
fn loads_masses_misfits_and_tools_of_a_job_vary() {
    let rest = "masses: [(on: (\"platform\", \"P\"), mass: 2.0)], gravity: (0, 0, -9.81),
        misfits: { \"Ba1\": (x: 1e-4) }, cases: { \"push\": [(on: (\"platform\", \"P\"), force: (5, 0, 0))] },
        tool: (0, 0, -0.1)";
    let delta = DELTA.replace("poisson: 0.3", "poisson: 0.3, density: 7850");
    for (path, old, new) in [
        ("loads.0.force.2", "force: (1, 2, 3)", "force: (1, 2, 7)"),
        ("masses.0.mass", "mass: 2.0", "mass: 7"),
        ("misfits.Ba1.x", "x: 1e-4", "x: 7"),
        (
            "cases.push.0.force.0",
            "force: (5, 0, 0)",
            "force: (7, 0, 0)",
        ),
        ("gravity.2", "gravity: (0, 0, -9.81)", "gravity: (0, 0, 7)"),
        ("tool.2", "tool: (0, 0, -0.1)", "tool: (0, 0, 7)"),
    ] {
        let all = format!("{delta}, {rest}");
        let varied = job(&all, &format!("vary: {{ \"{path}\": [5, 7] }}"));
        assert_eq!((varied.designs(), numbers(&varied, 1)), (2, vec![7.0]));
        let by_hand = job(&replaced(&all, old, new), "");
        assert_eq!(whole(&varied, 1), whole(&by_hand, 0), "{path}");
        let acting = |job: &Job, design: usize| {
            let model = job.design(design).unwrap().model().unwrap();
            let found = (
                model.cases(),
                model.masses(),
                model.misfits(),
                model.gravity(),
            );
            format!("{found:?}")
        };
        assert_eq!(acting(&varied, 1), acting(&by_hand, 0), "{path}");
        assert_ne!(
            (whole(&varied, 0), acting(&varied, 0)),
            (whole(&varied, 1), acting(&varied, 1)),
            "{path}"
        );
    }
    // The job's own loads are meant, not those of its file.
    let loads = "loads: [(on: (\"platform\", \"C\"), force: (0, 0, -1))]";
    let varied = job(
        PORTAL,
        &format!("{loads}, vary: {{ \"loads.0.force.2\": [-2, -3] }}"),
    );
    let by_hand = job(PORTAL, &loads.replace("-1", "-3"));
    assert_eq!(whole(&varied, 1), whole(&by_hand, 0));
}

/// Several joints as one path have one value and one column.
#[test]
fn a_group_of_parts_varies_as_one() {
    let bar = "File(\"five_bar.ron\")";
    let rest = "vary: { \"bodies.{rod1|rod2}.section\": [\"crank\", \"rod\"] }";
    let varied = job(bar, rest);
    assert_eq!(varied.varied()[0].path, "bodies.{rod1|rod2}.section");
    let apart = "zip: true, vary: { \"bodies.rod1.section\": [\"crank\", \"rod\"],
        \"bodies.rod2.section\": [\"crank\", \"rod\"] }";
    let apart = job(bar, apart);
    for design in 0..2 {
        assert_eq!(whole(&varied, design), whole(&apart, design));
        assert_eq!(varied.values(design).len(), 1);
    }
    assert_ne!(whole(&varied, 0), whole(&varied, 1));
    for (path, told) in [
        ("bodies.{rod1|rod3}.section", "`bodies` has no `rod3`"),
        (
            "bodies.{rod1|rod1}.section",
            "`bodies.rod1.section` and `bodies.rod1.section` overlap",
        ),
        ("bodies.{rod1}.section", "`bodies` has no `{rod1}`"),
    ] {
        let error = try_job(bar, &format!("vary: {{ \"{path}\": [\"rod\"] }}")).unwrap_err();
        assert!(error.to_string().contains(told), "{error}");
    }
}
