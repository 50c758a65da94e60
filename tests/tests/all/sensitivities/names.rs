//! Parameters of prebuilt mechanisms by their paths: the derivative by a path is what changing the
//! value at that path does.

use std::path::Path;

use hyperstat_assembly::{ModalOptions, ModalPlan, Model, Prepared, Sensitivity, solve};
use hyperstat_mechanisms::{Batch, Disk, Registry, batch_from_str};

fn batch(text: &str) -> Batch {
    let read = batch_from_str(text, Path::new("batch.ron"), &Disk, &Registry::builtin());
    read.unwrap_or_else(|error| panic!("{error}"))
}

/// The model of a job's design at its last pose, its values named.
fn model(text: &str, job: &str, design: usize) -> Model {
    let jobs = batch(text).jobs;
    let job = jobs.iter().find(|own| own.name == job).expect("a job");
    let design = job.design(design).expect("a design");
    let mut model = design.model().expect("a pose");
    let mut geometry = model.geometry().clone();
    design.place(job.len() - 1, &mut geometry).expect("a pose");
    model
        .set_geometry(geometry)
        .expect("a geometry of this model");
    job.name_values(&design, &mut model);
    model
}

fn sensitivities(model: &Model) -> Vec<Sensitivity> {
    let solution = solve(model).expect("a solution");
    let prepared = Prepared::new(model.clone());
    let influence = prepared.here().influence().expect("a held output");
    influence.sensitivities(&solution).expect("derivatives")
}

/// Compares every derivative of a job's deflection with differences of its designs.
fn compare(text: &str, job: &str) -> Vec<String> {
    let own = model(text, job, 0);
    let size = solve(&own).expect("a solution").output.displacement;
    let mut names = Vec::new();
    for sensitivity in sensitivities(&own) {
        let name = sensitivity.name.unwrap_or_else(|| {
            panic!("{job}: no name for {:?}", sensitivity.parameter);
        });
        let named = format!("name: \"{job}\",");
        let designs = [-1e-4, 1e-4].map(|part| sensitivity.value * (1.0 + part));
        let vary = format!("{named} vary: {{ \"{name}\": {designs:?} }},");
        let varied = text.replace(&named, &vary);
        let [low, high] = [0, 1].map(|design| {
            let solution = solve(&model(&varied, job, design)).expect("a solution");
            solution.output.displacement
        });
        let slope = (high - low) / 2e-4;
        let found = sensitivity.displacement.expect("a derivative") * sensitivity.value;
        for part in [0, 3] {
            let off = (found - slope).fixed_rows::<3>(part).amax();
            // Differences are good to the third derivatives times 1e-8 / 6.
            let size = size.fixed_rows::<3>(part).amax();
            assert!(off < 1e-6 * size, "{job}: {name}: {found} {slope}");
        }
        names.push(name);
    }
    names
}

#[test]
fn every_prebuilt_mechanism() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let text = std::fs::read_to_string(folder.join("prebuilt.ron")).expect("the example");
    let jobs: Vec<String> = batch(&text).jobs.into_iter().map(|job| job.name).collect();
    assert!(jobs.len() >= 11);
    for job in jobs {
        let names = compare(&text, &job);
        assert!(names.len() >= 3, "{job}: {names:?}");
    }
}

const DELTA: &str = r#"(jobs: [(
    name: "delta",
    mechanism: Delta(
        base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60, rod_spacing: 0.12,
        arm: (section: Circle(diameter: 0.030), material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),
        bar: (section: Circle(diameter: 0.016), material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),
        rod: (section: Circle(diameter: 0.016), material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),
        joint_stiffness: (x: 1e8, y: 1e8, z: 1e8, u: 1e5, w: 1e5),
        drive_stiffness: 1e5,
    ),
    poses: List([(0.1, -0.1, 0.5)]),
    gravity: (0.0, 0.0, -9.81),
    loads: [(on: ("platform", "P"), force: (-20.0, 10.0, 100.0))],
)])"#;

/// Values that are equal but written apart are parameters apart; a value of many joints is one.
#[test]
fn parameters_of_a_delta() {
    let names = compare(DELTA, "delta");
    let expected = [
        "arm.section.diameter",
        "bar.section.diameter",
        "rod.section.diameter",
        "arm.material.young",
        "arm.material.poisson",
        "arm.material.density",
        "bar.material.young",
        "bar.material.poisson",
        "bar.material.density",
        "rod.material.young",
        "rod.material.poisson",
        "rod.material.density",
        "joint_stiffness.x",
        "joint_stiffness.y",
        "joint_stiffness.z",
        "joint_stiffness.u",
        "joint_stiffness.w",
        "drive_stiffness",
    ];
    let sorted = |names: &mut Vec<String>| names.sort();
    let (mut names, mut expected) = (names, expected.map(String::from).to_vec());
    sorted(&mut names);
    sorted(&mut expected);
    assert_eq!(names, expected);
    let plan = ModalPlan::new(&model(DELTA, "delta", 0), &ModalOptions::lowest(1)).expect("a plan");
    let geometry = model(DELTA, "delta", 0).geometry().clone();
    let frequencies = plan
        .sensitivities(&geometry)
        .expect("derivatives")
        .parameters;
    let mut names: Vec<String> = frequencies.into_iter().filter_map(|s| s.name).collect();
    sorted(&mut names);
    assert_eq!(names, expected);
}

/// What varies as a whole has no paths inside; a number that varies has its own, of every design.
#[test]
fn parameters_of_designs() {
    let vary = "vary: { \"arm.section\": [Circle(diameter: 0.03), Tube(outer: 0.04, inner: 0.03)], \
                \"rod.section.diameter\": [0.016, 0.018] },";
    let text = DELTA.replace("poses:", &format!("{vary} poses:"));
    let names = |design: usize| {
        let found = sensitivities(&model(&text, "delta", design));
        let named = found
            .into_iter()
            .map(|s| (s.name.unwrap_or_default(), s.value));
        named.collect::<Vec<_>>()
    };
    let last = names(3);
    assert!(
        last.contains(&("rod.section.diameter".into(), 0.018)),
        "{last:?}"
    );
    assert!(
        last.contains(&("bar.section.diameter".into(), 0.016)),
        "{last:?}"
    );
    let arms = last
        .iter()
        .filter(|(name, _)| name.starts_with("arm.section"));
    assert_eq!(arms.count(), 0);
    // They are there all the same, without a name.
    assert!(last.contains(&(String::new(), 0.04)), "{last:?}");
}

/// Values of 0 are told apart as others are.
#[test]
fn values_of_zero_have_names_of_their_own() {
    let text = DELTA
        .replace(
            "arm: (section: Circle(diameter: 0.030)",
            "arm: (section: Tube(outer: 0.030, inner: 0.0)",
        )
        .replace(
            "rod: (section: Circle(diameter: 0.016)",
            "rod: (section: Tube(outer: 0.016, inner: 0.0)",
        );
    let found = sensitivities(&model(&text, "delta", 0));
    for name in ["arm.section.inner", "rod.section.inner"] {
        let mut own = found.iter().filter(|s| s.name.as_deref() == Some(name));
        assert_eq!(own.next().expect(name).value, 0.0);
        assert!(own.next().is_none(), "{name} twice");
    }
}
