//! What single poses allocate: nothing.

use std::hint::black_box;
use std::path::Path;

use allocation_counter::measure;
use hyperstat_study::{Disk, Input, Registry, Study, Target};

#[test]
fn single_poses_of_prebuilt_mechanisms_allocate_nothing() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let batch = examples.join("prebuilt.ron");
    let loaded = hyperstat_mechanisms::load(&batch, &Disk, &Registry::builtin()).unwrap();
    let Input::Batch(batch) = loaded else {
        panic!("no batch");
    };
    let mut counted = 0;
    for job in batch.jobs {
        let targets: Vec<_> = (0..job.len())
            .map(|pose| Target::Output(job.target(pose)))
            .collect();
        let study = Study::of_job(job.clone(), 0, 0).unwrap();
        let mut poser = study.poser().unwrap();
        // The counter counts: what a program keeps is allocated somewhere.
        assert!(measure(|| drop(black_box(study.poser()))).count_total > 0);
        let found = measure(|| {
            for target in &targets {
                let found = poser.at(target).result.expect("a pose within reach");
                black_box(found.compliance().expect("a held output"));
                black_box(found.measure("softest_force"));
            }
        });
        assert_eq!(found.count_total, 0, "{}: {found:?}", job.name);
        counted += targets.len();
    }
    assert!(counted > 20, "{counted}");
}
