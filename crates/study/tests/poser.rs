//! Single poses from a program: the numbers of the sweep, whatever was asked before.

use std::path::Path;

use hyperstat_study::sweep::{Cell, Poser, Record, Sweep, Way};
use hyperstat_study::{Disk, Input, Job, Registry, Selection, Study, Target};

/// The jobs of a batch file of `examples`.
fn jobs(name: &str) -> Vec<Job> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let loaded = hyperstat_mechanisms::load(&folder.join(name), &Disk, &Registry::builtin());
    match loaded.unwrap() {
        Input::Batch(batch) => batch.jobs,
        Input::Mechanism(_) => panic!("{name} is no batch"),
    }
}

fn poser(job: &Job) -> Poser {
    Study::of_job(job.clone(), 0, 0).unwrap().poser().unwrap()
}

/// All that a record says, to the last bit.
fn bits(record: &Record) -> (String, Vec<u64>) {
    let pose = record.pose.iter().flatten().copied();
    let mut numbers: Vec<f64> = pose.collect();
    if let Ok(found) = &record.result {
        numbers.extend(found.stiffness.iter().chain(found.displacement.iter()));
        numbers.extend(found.further.iter().filter_map(Cell::number));
    }
    let bits = numbers.into_iter().map(f64::to_bits).collect();
    (record.status().into(), bits)
}

#[test]
fn single_poses_of_prebuilt_mechanisms_are_the_sweeps() {
    let mut kinds = 0;
    for name in ["prebuilt.ron", "paper.ron"] {
        for job in jobs(name) {
            let mut poser = poser(&job);
            let rows = Sweep::new(&job, Way::Lanes).unwrap().records(0..job.len());
            // From the last to the first: the order has no part in it.
            for (pose, row) in rows.iter().enumerate().rev() {
                let single = poser.at(&Target::Output(job.target(pose)));
                assert_eq!(bits(&single), bits(row), "{} {pose}", job.name);
            }
            kinds += 1;
        }
    }
    assert!(kinds >= 12, "{kinds}");
}

#[test]
fn single_poses_of_a_file_are_the_sweeps_by_output_and_by_drives() {
    for job in jobs("five_bar_sweep.ron") {
        let mut poser = poser(&job);
        let rows = Sweep::new(&job, Way::Lanes).unwrap().records(0..job.len());
        for (pose, row) in rows.iter().enumerate().rev().step_by(3) {
            let named = job.drives().iter().zip(job.drive_values(pose));
            let drives = named.map(|(name, value)| poser.drive(name, *value).unwrap());
            let drives: Vec<_> = drives.collect();
            let target = match drives.is_empty() {
                true => Target::Output(job.target(pose)),
                false => Target::Drives(&drives),
            };
            assert_eq!(
                bits(&poser.at(&target)),
                bits(row),
                "{} {row:?} {pose}",
                job.name
            );
        }
        assert!(poser.drive("A1.v", 0.1).is_some());
        for name in ["A1", "A1.q", "A9.v"] {
            assert!(poser.drive(name, 0.1).is_none(), "{name}");
        }
    }
}

/// A mechanism file without any poses moves, too; at home it is the file's own solution.
#[test]
fn a_mechanism_file_is_brought_to_poses() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/five_bar.ron");
    let (files, registry) = (&Disk, Registry::builtin());
    let study = Study::open(&file, &Selection::default(), files, &registry).unwrap();
    let mut poser = study.poser().unwrap();
    let asked = |x, y| Target::Output([Some(x), Some(y), None, None, None, None]);
    let home = poser.at(&asked(0.0, 0.42)).result.unwrap();
    let solved = study.solve().unwrap().output;
    let difference = (home.displacement - solved.displacement).amax();
    assert!(
        difference <= 1e-10 * solved.displacement.amax(),
        "{difference}"
    );
    let far = poser.at(&asked(3.0, 0.0));
    assert_eq!(far.status(), "unreachable");
    let again = poser.at(&asked(0.0, 0.42)).result.unwrap();
    assert_eq!(again.displacement, home.displacement);
}

#[test]
fn a_prebuilt_mechanism_is_asked_for_what_it_takes() {
    let job = jobs("paper.ron").remove(2);
    let mut poser = poser(&job);
    let asked = |pose: [f64; 6], count: usize| {
        let mut asked = [None; 6];
        for k in 0..count {
            asked[k] = Some(pose[k]);
        }
        Target::Output(asked)
    };
    let pose = [-0.2, -0.2, 0.5, 0.0, 0.0, 0.0];
    let three = poser.at(&asked(pose, 3));
    assert_eq!(three.status(), "ok");
    assert_eq!(bits(&three), bits(&poser.at(&asked(pose, 6))));
    let words = |record: Record| record.result.unwrap_err().in_words();
    let few = words(poser.at(&asked(pose, 2)));
    assert_eq!(few, "`Delta` takes 3 pose coordinates, 2 are given");
    let turned = words(poser.at(&asked([0.0, 0.0, 0.5, 0.0, 0.1, 0.0], 6)));
    assert_eq!(turned, "out of reach: `Delta` cannot follow ry");
    let far = poser.at(&asked([0.0, 0.0, 5.0, 0.0, 0.0, 0.0], 3));
    assert_eq!(
        (far.status(), far.pose[2]),
        ("unreachable", Some(5.0)),
        "{far:?}"
    );
    let nan = poser.at(&asked([0.0, f64::NAN, 0.5, 0.0, 0.0, 0.0], 3));
    assert_eq!((nan.status(), nan.pose[1]), ("failed", None));
    let drives = words(poser.at(&Target::Drives(&[])));
    assert_eq!(
        drives,
        "`Delta` takes poses of its output, no values of drives"
    );
    // The measures of what is found, by their definitions.
    let found = three.result.unwrap();
    let compliance = found.compliance().unwrap();
    let unit = (found.stiffness * compliance - nalgebra::Matrix6::identity()).amax();
    assert!(unit < 1e-9, "{unit}");
    assert_eq!(found.measure("compliance_z"), Some(compliance[(2, 2)]));
    let length = found.displacement.fixed_rows::<3>(0).norm();
    assert_eq!(found.measure("deflection"), Some(length));
    assert_eq!(found.measure("beauty"), None);
}
