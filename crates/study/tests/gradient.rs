//! Derivatives of what is measured in all poses of a job, by values that `solve --why` lists and by lengths
//! and points, against a closed form and against each other.

use std::f64::consts::PI;

use hyperstat_mechanisms::{Disk, batch_from_str};
use hyperstat_study::sweep::Threads;
use hyperstat_study::{
    Gradient, Job, JobMechanism, JobPoses, Measure, MemoryFiles, Quantity, Registry, Selection,
    Study, StudyError, Value,
};

const CANTILEVER: &str = r#"(
    name: "cantilever",
    parameters: { "L": 0.5 },
    points: { "A": (0.0, 0.0, 0.0), "B": ("= L", 0.0, 0.0) },
    sections: { "round": Circle(diameter: 0.02) },
    materials: { "steel": (young: 2e11, poisson: 0.3) },
    bodies: { "bar": Beam(through: ["A", "B"], section: "round", material: "steel") },
    joints: { "wall": (at: "A", between: ("ground", "bar"), kind: Fixed) },
    loads: [(on: ("bar", "B"), force: (0.0, 0.0, -1.0))],
    output: ("bar", "B"),
)"#;

fn job(text: &str) -> Job {
    let files = MemoryFiles::from_iter([("cantilever.ron", text)]);
    let selection = Selection::default();
    let study = Study::open(
        "cantilever.ron".as_ref(),
        &selection,
        &files,
        &Registry::builtin(),
    );
    let mechanism = study.unwrap().mechanism().unwrap().clone();
    // Its own configuration, which follows the length.
    Job::new("cantilever", mechanism, JobPoses::Own, &Registry::builtin()).unwrap()
}

fn delta() -> Job {
    let link = |diameter: f64| -> Value {
        let material = "(young: 2.1e11, poisson: 0.3)";
        format!("(section: Circle(diameter: {diameter:?}), material: {material})").into()
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
    let poses = JobPoses::list(&[[0.0, 0.0, 0.5], [0.1, -0.05, 0.52], [3.0, 0.0, 0.5]]);
    Job::new("delta", delta, poses, &Registry::builtin()).unwrap()
}

fn found(job: &Job, quantity: &str, paths: &[&str]) -> (Vec<f64>, Vec<f64>) {
    let paths: Vec<String> = paths.iter().map(|&path| path.into()).collect();
    let quantity = Quantity::named(quantity).unwrap();
    let gradient = Gradient::new(job, quantity, &paths, None).unwrap();
    gradient
        .of(0..job.len(), &Threads::new(1).unwrap())
        .unwrap()
}

/// k22 = 12 E I / L³ of a bar along x.
#[test]
fn a_cantilever_answers_to_its_length_as_its_formula() {
    let job = job(CANTILEVER);
    let (value, slopes) = found(&job, "k22", &["L", "sections.round.diameter", "points.A.1"]);
    let (young, d, length) = (2e11, 0.02_f64, 0.5_f64);
    let k = 12.0 * young * PI * d.powi(4) / 64.0 / length.powi(3);
    assert!((value[0] / k - 1.0).abs() < 1e-12, "{value:?}");
    assert!(
        (slopes[0] / (-3.0 * k / length) - 1.0).abs() < 1e-8,
        "{slopes:?}"
    );
    assert!((slopes[1] / (4.0 * k / d) - 1.0).abs() < 1e-8, "{slopes:?}");
    // Moved across, its length changes in the second order.
    assert!(slopes[2].abs() < 1e-8 * k / length, "{slopes:?}");
}

/// With all lengths and the diameters larger by a factor, all stiffnesses of translations are: the derivatives
/// by all of them add up (Euler's theorem; Young's modulus stays).
#[test]
fn derivatives_by_all_lengths_add_up_to_the_scale() {
    let job = delta();
    let values = [
        ("base_radius", 0.25),
        ("platform_radius", 0.06),
        ("arm_length", 0.30),
        ("rod_length", 0.60),
        ("rod_spacing", 0.12),
        ("arm.section.diameter", 0.030),
        ("bar.section.diameter", 0.020),
        ("rod.section.diameter", 0.014),
    ];
    let paths = values.map(|(path, _)| path);
    let (k, slopes) = found(&job, "k33", &paths);
    assert!(k[2].is_nan() && slopes[2 * paths.len()..].iter().all(|slope| slope.is_nan()));
    // Where the platform stands over the same angles: in the first pose by z alone.
    let along = {
        let step = 1e-4;
        let at = |z: f64| {
            let mut moved = job.clone();
            moved.set_poses(JobPoses::list(&[[0.0, 0.0, z]])).unwrap();
            found(&moved, "k33", &[]).0[0]
        };
        let central = |h: f64| (at(0.5 + h) - at(0.5 - h)) / (2.0 * h);
        (4.0 * central(step) - central(2.0 * step)) / 3.0
    };
    let sum: f64 = values
        .iter()
        .zip(&slopes)
        .map(|((_, value), slope)| value * slope)
        .sum();
    let sum = sum + 0.5 * along;
    assert!((sum / k[0] - 1.0).abs() < 1e-7, "{} {}", sum, k[0]);
}

#[test]
fn a_path_that_leads_to_no_number_is_told() {
    let job = delta();
    let quantity = Quantity::named("k33").unwrap();
    for path in ["rod_lenght", "rod.section", "rod"] {
        let made = Gradient::new(&job, quantity, &[path.into()], None);
        assert!(
            matches!(made, Err(StudyError::NoDerivative { .. })),
            "{path}: {made:?}"
        );
    }
}

/// Mechanisms with elastic joints, tapered arms, misfits, preloads and cases: what lanes find beside the
/// quantity is what the whole solution of each pose gives, by every parameter that they are asked for.
#[test]
fn lanes_find_what_whole_solutions_find() {
    let quantities: Vec<&str> = (Measure::all().iter().map(|own| own.name))
        .chain(["k11", "k15", "k24", "k66", "dx", "drz"])
        .collect();
    let threads = Threads::new(1).unwrap();
    let tapered = CANTILEVER
        .replace("Circle(diameter: 0.02)", "Tapered(from: Circle(diameter: 0.03), to: Circle(diameter: 0.01))")
        .replace("kind: Fixed)", "kind: Fixed, stiffness: (x: 1e7, y: 2e7, z: 3e7, u: 1e4, v: 2e4, w: 3e4))")
        .replace("loads:", "cases: { \"push\": [(on: (\"bar\", \"B\"), force: (1.0, 2.0, 3.0), moment: (1.0, 0.0, 2.0))] },\n    loads:");
    let jobs = batch(LANES).into_iter().chain([job(&tapered)]);
    for (number, job) in jobs.enumerate() {
        let job = &job;
        for case in [None, Some("push")] {
            let mut study = Study::of_job(job.clone(), 0, 0).unwrap();
            let known = study.sensitivities(case).unwrap();
            let paths: Vec<String> = (known.iter().filter(|own| !own.by_differences))
                .filter_map(|own| own.path.clone().or_else(|| Some(own.parameter.clone())))
                .filter(|path| !path.contains(' '))
                .collect();
            assert!(paths.len() > 3, "{paths:?}");
            for name in &quantities {
                // What a straight bar does not have.
                if number == 3 && ["k15", "k24", "dx", "drz"].contains(name) {
                    continue;
                }
                let quantity = Quantity::named(name).unwrap();
                let gradient = Gradient::new(job, quantity, &paths, case).unwrap();
                assert_eq!(gradient.beside(), paths.len(), "{number} {paths:?}");
                let (values, slopes) = gradient.of(0..job.len(), &threads).unwrap();
                assert_eq!(gradient.one_by_one(), 0, "{number} {name}");
                for (pose, value) in values.iter().enumerate() {
                    let mut study = Study::of_job(job.clone(), 0, pose).unwrap();
                    let (expected, own) = study.value_and_gradient(quantity, &paths, case).unwrap();
                    assert!((value / expected - 1.0).abs() < 1e-9, "{number} {name}");
                    // Relative change per relative change of each parameter, by the largest of them.
                    let relative = |slope: f64, path: usize| slope * number_at(job, &paths[path]);
                    let expected: Vec<f64> = own
                        .iter()
                        .enumerate()
                        .map(|(k, s)| relative(*s, k))
                        .collect();
                    let largest = expected
                        .iter()
                        .fold(0.0_f64, |most, own| most.max(own.abs()));
                    for (path, expected) in expected.iter().enumerate() {
                        let found = relative(slopes[pose * paths.len() + path], path);
                        assert!(
                            (found - expected).abs() <= 1e-9 * largest,
                            "{number} {name} {case:?} {pose} {}: {found} {expected}",
                            paths[path]
                        );
                    }
                }
            }
        }
    }
}

/// `--why` lists lengths as the poses of a job have them, and the coordinates of a file.
#[test]
fn lengths_are_among_what_is_listed() {
    let job = delta();
    let mut study = Study::of_job(job.clone(), 0, 1).unwrap();
    let listed = study.sensitivities(None).unwrap();
    let lengths = [
        "base_radius",
        "platform_radius",
        "arm_length",
        "rod_length",
        "rod_spacing",
    ];
    let (_, slopes) = found(&job, "k33", &lengths);
    for (k, path) in lengths.iter().enumerate() {
        let own = listed.iter().find(|own| own.parameter == *path).unwrap();
        assert!(own.by_differences);
        let (listed, slope) = (own.stiffness.unwrap()[2][2], slopes[lengths.len() + k]);
        assert!(
            (listed / slope - 1.0).abs() < 1e-8,
            "{path}: {listed} {slope}"
        );
    }
    // w = F L³ / (3 E I), by the place of the end and by that of the wall.
    let files = MemoryFiles::from_iter([("cantilever.ron", CANTILEVER)]);
    let registry = Registry::builtin();
    let selection = Selection::default();
    let path = "cantilever.ron".as_ref();
    let mut study = Study::open(path, &selection, &files, &registry).unwrap();
    let listed = study.sensitivities(None).unwrap();
    let slope = |name: &str| {
        let own = listed.iter().find(|own| own.parameter == name).unwrap();
        own.displacement.unwrap()[2]
    };
    let per_length = -3.0 * 0.5_f64.powi(2) / (3.0 * 2e11 * PI * 0.02_f64.powi(4) / 64.0);
    for (name, expected) in [("points.A.0", -per_length), ("parameters.L", per_length)] {
        assert!((slope(name) / expected - 1.0).abs() < 1e-8, "{name}");
    }
}

/// A plate on three copied legs, the second of which has one stiffness and one mass of its own: a path
/// stands for all values that `vary` reaches by it.
#[test]
fn a_path_of_copies_stands_for_all_that_it_reaches() {
    let text = r#"(
        name: "plate",
        parameters: { "ku": 2e5 },
        points: { "P": (0.0, 0.0, 0.5) },
        sections: { "round": Circle(diameter: 0.02) },
        materials: { "steel": (young: 2e11, poisson: 0.3, density: 7800.0) },
        groups: { "leg": (
            points: { "A": (0.4, 0.0, 0.0), "B": (0.2, 0.0, 0.5) },
            bodies: { "leg": Beam(through: ["A", "B"], section: "round", material: "steel") },
            joints: {
                "foot": (at: "A", between: ("ground", "leg"), kind: Fixed, stiffness: (x: 1e7, y: 3e7, z: 2e7, u: "= ku", v: "= ku", w: 4e5)),
                "top": (at: "B", between: ("leg", "plate"), kind: Fixed),
            },
            masses: [(on: ("leg", "B"), mass: 3.0, inertia: (0.1, 0.2, 0.3))],
        ) },
        copies: { "leg": (places: Turned(axis: (0.0, 0.0, 1.0), count: 3), overrides: { "2": {
            "joints.foot.stiffness.y": 1e7, "masses.0.inertia": (0.2, 0.2, 0.2),
        } }) },
        bodies: { "plate": Rigid(points: ["B1", "B2", "B3", "P"]) },
        gravity: (3.0, 1.0, -9.81),
        loads: [(on: ("plate", "P"), force: (100.0, 50.0, 0.0), moment: (0.0, 0.0, 9.0))],
        output: ("plate", "P"),
    )"#;
    let job = job(text);
    let mut study = Study::of_job(job.clone(), 0, 0).unwrap();
    let listed = study.sensitivities(None).unwrap();
    let mut seen = Vec::new();
    for own in listed.iter().filter(|own| !own.by_differences) {
        let Ok(value) = job.number_at(0, &own.parameter) else {
            continue;
        };
        seen.push(own.parameter.as_str());
        // By one value more and one less.
        let at = |value: f64| {
            let changed = job.with_values(0, &[(own.parameter.as_str(), Value::Number(value))]);
            let study = Study::of_job(changed.unwrap(), 0, 0).unwrap();
            study.solve().unwrap().output.displacement
        };
        let step = 1e-3 * value;
        let central = |h: f64| (at(value + h) - at(value - h)) / (2.0 * h);
        let expected = (central(step) * 4.0 - central(2.0 * step)) / 3.0;
        for (k, slope) in own.displacement.unwrap().iter().enumerate() {
            let off = (slope - expected[k]).abs();
            assert!(
                off < 1e-8 * expected.amax(),
                "{} {k}: {slope} {}",
                own.parameter,
                expected[k]
            );
        }
    }
    for path in [
        "parameters.ku",
        "groups.leg.joints.foot.stiffness.w",
        "groups.leg.joints.foot.stiffness.y",
        "copies.leg.overrides.2.joints.foot.stiffness.y",
    ] {
        assert!(seen.contains(&path), "{path}: {seen:?}");
    }
}

fn number_at(job: &Job, path: &str) -> f64 {
    job.number_at(0, path).unwrap()
}

fn batch(text: &str) -> Vec<Job> {
    batch_from_str(text, "batch.ron".as_ref(), &Disk, &Registry::builtin())
        .unwrap()
        .jobs
}

const LANES: &str = r#"(
    jobs: [
        (
            name: "delta",
            mechanism: Delta(
                base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60, rod_spacing: 0.12,
                arm: (section: Tube(outer: 0.04, inner: 0.03), material: (young: 7e10, poisson: 0.33)),
                bar: (section: Rectangle(width: 0.02, height: 0.03), material: (young: 7e10, poisson: 0.33)),
                rod: (section: Circle(diameter: 0.014), material: (young: 2.1e11, shear: 8e10)),
                joint_stiffness: (x: 1e8, y: 1e8, z: 1e8, u: 1e5, w: 1e5),
            ),
            loads: [(on: ("platform", "P"), force: (30.0, -20.0, -100.0), moment: (2.0, 1.0, -3.0))],
            cases: { "push": [(on: ("platform", "P"), force: (0.0, 100.0, 0.0))] },
            misfits: { "Ba1": (x: 1e-4) },
            preloads: { "Bb2": (x: 40.0) },
            poses: List([(0.0, 0.0, 0.5), (0.1, -0.05, 0.52)]),
        ),
        (
            name: "hexapod",
            mechanism: Hexapod(
                base_radius: 0.5, base_angle: 0.125, platform_radius: 0.3, platform_angle: 0.9,
                leg: (
                    cylinder: (section: Tube(outer: 0.06, inner: 0.045), material: (young: 2.1e11, poisson: 0.3)),
                    piston: (section: Circle(diameter: 0.04), material: (young: 2.0e11, poisson: 0.3)),
                    cylinder_length: 0.45, lengths: (0.55, 1.0),
                ),
                drive_stiffness: 5e7,
            ),
            poses: List([(0.05, 0.0, 0.8, 0.1, 0.0, 0.0), (0.0, -0.02, 0.75, 0.0, 0.1, 0.2)]),
            loads: [(on: ("platform", "P"), force: (-20.0, 10.0, 100.0), moment: (5.0, 5.0, 8.0))],
            cases: { "push": [(on: ("platform", "P"), force: (0.0, 100.0, 0.0))] },
        ),
        (
            name: "three-prs",
            mechanism: ThreePrs(
                rails: (radius: 0.4, tilt: 0.0, travel: 0.8, carriage: Near), platform_radius: 0.25, rod_length: 0.5,
                rod: (section: Rectangle(width: 0.06, height: 0.04), material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),
                joint_stiffness: (x: 3e8, y: 3e8, z: 3e8, u: 5e5, w: 5e5),
                drive_stiffness: 5e7,
            ),
            poses: Grid(z: (0.9, 0.9, 1), rx: (0.1, 0.1, 1), ry: (-0.2, 0.2, 2)),
            gravity: (0.5, 0.0, -9.81),
            masses: [(on: ("platform", "P"), mass: 12.0)],
            loads: [(on: ("platform", "P"), force: (-20.0, 10.0, 100.0), moment: (5.0, 5.0, 8.0))],
            cases: { "push": [(on: ("platform", "P"), force: (0.0, 100.0, 0.0))] },
        ),
    ],
)"#;
