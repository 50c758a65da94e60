//! Batch files: jobs, their mechanisms, poses, loads and figures.

use std::path::Path;

use hyperstat_mechanisms::{
    Along, Batch, Disk, Figure, FigurePose, Input, Look, Registry, Scale, Words, batch_from_str,
    load, load_batch, load_mechanism,
};
use nalgebra::Vector6;

fn examples() -> &'static Path {
    Path::new("../../examples")
}

/// A batch whose file stands among the examples.
fn read(text: &str) -> Batch {
    batch_from_str(
        text,
        &examples().join("test.ron"),
        &Disk,
        &Registry::builtin(),
    )
    .unwrap_or_else(|error| panic!("{error}\n{text}"))
}

const DELTA: &str = "Delta(
    base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60, rod_spacing: 0.12,
    arm: (section: Circle(diameter: 0.030), material: (young: 2.1e11, poisson: 0.3)),
    bar: (section: Circle(diameter: 0.020), material: (young: 2.1e11, poisson: 0.3)),
    rod: (section: Circle(diameter: 0.014), material: (young: 2.1e11, poisson: 0.3)),
)";

fn delta(rest: &str) -> Batch {
    read(&format!(
        "(jobs: [(name: \"d\", mechanism: {DELTA}, {rest})])"
    ))
}

#[test]
fn the_paper_s_batch_holds_both_case_studies() {
    let batch = load_batch(&examples().join("paper.ron"), &Disk, &Registry::builtin())
        .unwrap_or_else(|error| panic!("{error}"));
    let jobs: Vec<_> = batch
        .jobs
        .iter()
        .map(|job| (job.name.as_str(), job.len()))
        .collect();
    assert_eq!(
        jobs,
        [
            ("single-freedom-elastic", 1),
            ("single-freedom-rigid", 1),
            ("delta-rigid-trajectory", 61),
            ("delta-elastic-trajectory", 61),
        ]
    );
    let figures = [
        Figure::Trajectory {
            scale: Scale::Auto,
            words: Words::default(),
        },
        Figure::Deformed {
            pose: 0.into(),
            case: None,
            scale: Scale::Auto,
            look: Look::default(),
            words: Words::default(),
        },
    ];
    for job in &batch.jobs[2..] {
        assert_eq!(job.figures, figures);
        let model = job.model().unwrap();
        let load = &model.loads()[0];
        assert_eq!(model.node_name(load.node), "platform.P");
        assert_eq!(load.wrench, Vector6::new(-20.0, 10.0, 100.0, 5.0, 5.0, 8.0));
        let mut geometry = model.geometry().clone();
        for (k, target) in (0..61).map(|k| (k, job.target(k))) {
            let target = target.map(Option::unwrap);
            assert_eq!(job.place(k, &mut geometry).unwrap(), target);
            let at = geometry.positions[model.output().unwrap().0];
            assert!((at.coords - nalgebra::Vector3::from_row_slice(&target[..3])).amax() < 1e-15);
        }
    }
}

/// Eq. 65 of the paper at t = 0, 0.1, …, 6.
#[test]
fn the_trajectory_is_the_paper_s() {
    let batch = load_batch(&examples().join("paper.ron"), &Disk, &Registry::builtin()).unwrap();
    for k in 0..=60 {
        let t = k as f64 / 10.0;
        let (x, z) = if t <= 2.0 {
            (-0.2, 0.45 + 0.05 * t)
        } else if t <= 4.0 {
            (-0.2 + 0.2 * (t - 2.0), 0.55)
        } else {
            (0.2, 0.55 - 0.05 * (t - 4.0))
        };
        let found = Vector6::from(batch.jobs[2].target(k).map(Option::unwrap));
        let wanted = Vector6::new(x, -0.2, z, 0.0, 0.0, 0.0);
        assert!((found - wanted).amax() < 1e-15, "t = {t}");
    }
}

#[test]
fn the_examples_are_read() {
    for name in ["delta.ron", "single_freedom.ron", "portal.ron"] {
        let mechanism = load_mechanism(&examples().join(name), &Disk, &Registry::builtin());
        assert!(mechanism.is_ok(), "{mechanism:?}");
    }
    let input = load(&examples().join("paper.ron"), &Disk, &Registry::builtin()).unwrap();
    assert!(matches!(input, Input::Batch(_)));
    let input = load(&examples().join("delta.ron"), &Disk, &Registry::builtin()).unwrap();
    assert!(matches!(input, Input::Mechanism(_)));
}

#[test]
fn a_file_s_job_has_its_configuration_and_loads() {
    let batch = read(r#"(jobs: [(name: "own", mechanism: File("portal.ron"))])"#);
    let job = &batch.jobs[0];
    assert_eq!(job.len(), 1);
    let own = load_mechanism(&examples().join("portal.ron"), &Disk, &Registry::builtin()).unwrap();
    let model = job.model().unwrap();
    assert_eq!(model.loads(), own.model.loads());
    let mut geometry = model.geometry().clone();
    geometry.positions[0].x = 9.0;
    assert_eq!(
        job.place(0, &mut geometry).unwrap(),
        [0.1, 0.5, 0.2, 0.0, 0.0, 0.0]
    );
    assert_eq!(&geometry, own.model.geometry());
    let place = job.mechanism().unwrap().locate_load(0);
    assert_eq!(place.path, examples().join("portal.ron"));
}

#[test]
fn a_job_s_loads_replace_the_file_s() {
    let batch = read(
        r#"(jobs: [
            (name: "other", mechanism: File("portal.ron"), loads: [(on: ("platform", "B"), moment: (0, 0, 2))]),
            (name: "none", mechanism: File("portal.ron"), loads: []),
        ])"#,
    );
    let model = batch.jobs[0].model().unwrap();
    assert_eq!(model.loads().len(), 1);
    assert_eq!(model.node_name(model.loads()[0].node), "platform.B");
    assert_eq!(
        model.loads()[0].wrench,
        Vector6::new(0.0, 0.0, 0.0, 0.0, 0.0, 2.0)
    );
    let place = batch.jobs[0].mechanism().unwrap().locate_load(0);
    assert_eq!((place.path, place.line), (examples().join("test.ron"), 2));
    assert!(batch.jobs[1].model().unwrap().loads().is_empty());
    let at = batch.jobs[1].location();
    assert_eq!((at.line, at.column, at.width), (3, 20, 6));
}

#[test]
fn poses_out_of_reach_are_errors_of_their_own() {
    let batch = delta(
        r#"poses: List([(0, 0, 5.0), (0.1, 0.0, 0.5, 0.0, 0.0, 0.0)]),
           loads: [(on: ("platform", "P"), force: (1, 0, 0))]"#,
    );
    let job = &batch.jobs[0];
    let model = job.model().unwrap();
    assert_eq!(model.loads().len(), 1);
    let mut geometry = model.geometry().clone();
    assert!(job.place(0, &mut geometry).is_err());
    assert_eq!(&geometry, model.geometry());
    assert_eq!(job.target(0), [0.0, 0.0, 5.0, 0.0, 0.0, 0.0].map(Some));
    assert_eq!(
        job.place(1, &mut geometry).unwrap(),
        [0.1, 0.0, 0.5, 0.0, 0.0, 0.0]
    );
}

#[test]
fn a_job_without_a_pose_in_reach_has_a_model_with_its_loads() {
    let out_of_reach = [
        "List([(0, 0, 5.0)])",
        "Grid(x: (3, 5, 1000), y: (3, 5, 1000), z: (0, 1, 1000))",
    ];
    for poses in out_of_reach {
        let batch = delta(&format!(
            r#"poses: {poses}, loads: [(on: ("platform", "P"), force: (1, 0, 0))]"#
        ));
        let job = &batch.jobs[0];
        let model = job.model().unwrap();
        assert_eq!(model.node_name(model.loads()[0].node), "platform.P");
        let mut geometry = model.geometry().clone();
        for pose in [0, job.len() - 1] {
            assert!(job.place(pose, &mut geometry).is_err());
        }
        assert_eq!(&geometry, model.geometry());
    }
}

/// A grid whose first pose in reach comes late is found.
#[test]
fn a_mechanism_is_built_in_a_late_pose() {
    let batch = delta("poses: Grid(x: (0, 0, 1), y: (0, 0, 1), z: (-5, 0.5, 100000))");
    let job = &batch.jobs[0];
    let mut geometry = job.model().unwrap().geometry().clone();
    assert!(job.place(0, &mut geometry).is_err());
    assert!(job.place(job.len() - 1, &mut geometry).is_ok());
}

#[test]
fn a_grid_is_not_written_out() {
    let batch =
        delta("poses: Grid(x: (-0.2, 0.2, 41), y: (-0.1, 0.1, 21), z: (0.45, 0.55, 1000000))");
    let job = &batch.jobs[0];
    assert_eq!(job.len(), 41 * 21 * 1_000_000);
    assert_eq!(job.target(0)[..3], [-0.2, -0.1, 0.45].map(Some));
    assert_eq!(job.target(40)[..2], [0.2, -0.1].map(Some));
    assert_eq!(job.target(41)[0], Some(-0.2));
    assert_eq!(job.target(job.len() - 1)[..3], [0.2, 0.1, 0.55].map(Some));
}

#[test]
fn figures_have_defaults() {
    let batch = delta(
        "poses: List([(0, 0, 0.5), (0, 0, 0.6)]), figures: [Trajectory, Deformed(pose: 1, scale: 50)]",
    );
    let wanted = [
        Figure::Trajectory {
            scale: Scale::Auto,
            words: Words::default(),
        },
        Figure::Deformed {
            pose: 1.into(),
            case: None,
            scale: Scale::Factor(50.0),
            look: Look::default(),
            words: Words::default(),
        },
    ];
    assert_eq!(batch.jobs[0].figures, wanted);
}

#[test]
fn figures_of_cases_modes_and_budgets() {
    let cases = "cases: { \"push\": [(on: (\"platform\", \"P\"), force: (1, 0, 0))] }";
    let batch = delta(&format!(
        "poses: List([(0, 0, 0.5), (0, 0, 0.6)]), {cases}, figures: [
            Deformed(case: \"push\"), Mode, Mode(number: 3, pose: 1, scale: 0.5), Budget,
            Budget(along: rx, pose: 1), Budget(along: (0, 3, -4)), Budget(case: \"push\"),
        ]"
    ));
    let mode = |number, pose: usize, scale| Figure::Mode {
        number,
        pose: pose.into(),
        scale,
        look: Look::default(),
        words: Words::default(),
    };
    let budget = |along, pose: usize| Figure::Budget {
        along,
        pose: pose.into(),
        case: None,
        title: None,
    };
    let wanted = [
        Figure::Deformed {
            pose: 0.into(),
            case: Some("push".into()),
            scale: Scale::Auto,
            look: Look::default(),
            words: Words::default(),
        },
        mode(1, 0, Scale::Auto),
        mode(3, 1, Scale::Factor(0.5)),
        budget(Along::Displacement, 0),
        budget(Along::Wrench([0.0, 0.0, 0.0, 1.0, 0.0, 0.0]), 1),
        budget(Along::Wrench([0.0, 0.6, -0.8, 0.0, 0.0, 0.0]), 0),
        Figure::Budget {
            along: Along::Displacement,
            pose: 0.into(),
            case: Some("push".into()),
            title: None,
        },
    ];
    assert_eq!(batch.jobs[0].figures, wanted);
}

#[test]
fn figures_of_poses_by_their_coordinates() {
    let figures = |pose: &str| {
        delta(&format!(
            "poses: List([(0, 0, 0.5), (0, 0, 0.6)]), figures: [Budget(pose: {pose})]"
        ))
    };
    let wanted = |at: &[(&str, f64)]| {
        let at = at.iter().map(|(name, value)| ((*name).into(), *value));
        vec![Figure::Budget {
            along: Along::Displacement,
            pose: FigurePose::At(at.collect()),
            case: None,
            title: None,
        }]
    };
    let found = figures("(x: 0, z: \"600 mm\")");
    assert_eq!(found.jobs[0].figures, wanted(&[("x", 0.0), ("z", 0.6)]));
    let found = figures("{ \"A1.v\": 0.25 }");
    assert_eq!(found.jobs[0].figures, wanted(&[("A1.v", 0.25)]));
}

/// What is said of a number of frequencies is what may stand there.
#[test]
fn counts_of_frequencies_are_told_what_they_may_be() {
    let refused = |rest: &str| {
        let text = format!(
            "(jobs: [(name: \"d\", mechanism: {DELTA}, poses: List([(0, 0, 0.5)]), {rest})])"
        );
        let path = Path::new("batch.ron");
        let error = batch_from_str(&text, path, &Disk, &Registry::builtin()).unwrap_err();
        format!("{error} {}", error.help().unwrap_or_default())
    };
    let column = refused("columns: [Frequencies(count: 0)]");
    assert!(column.contains("from 1 to 1000"), "{column}");
    assert!(!column.contains("mass: Lumped"), "{column}");
    let modes = refused("modes: 0");
    assert!(modes.contains("or `(count: 6, mass: Lumped)`"), "{modes}");
}

/// Zero on a direction that is free anyway is the same as nothing.
#[test]
fn a_delta_takes_no_stiffness_about_its_axes() {
    let job = |stiffness: &str| {
        let mechanism = DELTA.replace(
            "base_radius",
            &format!("joint_stiffness: {stiffness}, base_radius"),
        );
        let text =
            format!("(jobs: [(name: \"d\", mechanism: {mechanism}, poses: List([(0, 0, 0.5)]))])");
        read(&text).jobs[0].model().unwrap()
    };
    let [zero, none] = ["(x: 1e8, v: 0)", "(x: 1e8)"].map(job);
    let stiffness = |model: &hyperstat_model::Model| {
        let joints = model.joints().iter();
        joints
            .map(|joint| joint.stiffness.clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(
        format!("{:?}", stiffness(&zero)),
        format!("{:?}", stiffness(&none))
    );
}
