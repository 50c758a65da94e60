//! Files that name a mechanism or write it out.

use std::path::Path;

use hyperstat_assembly::{Model, solve};
use hyperstat_mechanisms::prebuilt::Prebuilt;
use hyperstat_mechanisms::{Batch, Disk, Registry, batch_from_str, load_batch, load_mechanism};

use super::FLOOR;
use crate::{stiffness, stiffness_difference, vector_differences};

/// A batch of one job, of this mechanism in one pose.
fn batch(mechanism: &str, pose: &str) -> Batch {
    let text = format!("(jobs: [(name: \"j\", mechanism: {mechanism}, poses: List([{pose}]))])");
    let batch = batch_from_str(&text, Path::new("j.ron"), &Disk, &Registry::builtin());
    batch.unwrap_or_else(|error| panic!("{error}"))
}

/// Asserts that a batch file that names a mechanism by `text` and gives it the pose `pose_text`
/// has this mechanism in this pose.
///
/// # Panics
/// Where it has not.
pub fn assert_batch_reads(text: &str, pose_text: &str, mechanism: &dyn Prebuilt, pose: &[f64]) {
    let found = batch(text, pose_text).jobs[0].model().expect("in reach");
    let expected = mechanism.model(pose).expect("in reach");
    let parts = |model: &Model| {
        let geometry = model.geometry();
        let parts = format!("{:?} {:?}", model.bodies(), model.nodes());
        let links = format!("{:?} {:?}", model.segments(), model.joints());
        format!(
            "{} {parts} {links} {:?} {geometry:?}",
            model.name,
            model.output()
        )
    };
    assert_eq!(parts(&found), parts(&expected));
}

/// Asserts that the example `name` that is written out is the job of this name of
/// `prebuilt.ron`, at pose 1.
///
/// # Panics
/// Where it is not.
pub fn assert_example_is_prebuilt(name: &str) {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let registry = Registry::builtin();
    let batch = load_batch(&examples.join("prebuilt.ron"), &Disk, &registry);
    let batch = batch.unwrap_or_else(|error| panic!("{error}"));
    let job = batch.jobs.iter().find(|job| job.name == name);
    let job = job.expect("the job");
    let mut model = job.model().expect("in reach");
    let mut geometry = model.geometry().clone();
    job.place(1, &mut geometry).expect("in reach");
    model
        .set_geometry(geometry)
        .expect("a geometry of this model");
    let expected = solve(&model).expect("a solution");

    let file = examples.join(name.replace('-', "_")).with_extension("ron");
    let written = load_mechanism(&file, &Disk, &registry).unwrap_or_else(|error| panic!("{error}"));
    let found = solve(&written.model).expect("a solution");
    let difference = stiffness_difference(&stiffness(&found), &stiffness(&expected));
    assert!(difference < 1e-12, "{name}: K_o {difference:e}");
    let output = (&found.output.displacement, &expected.output.displacement);
    let difference = vector_differences([output], FLOOR);
    assert!(
        difference.iter().all(|d| *d < 1e-12),
        "{name}: output {difference:?}"
    );
    if !found.idle.is_empty() {
        // Displacements of spinning legs and rods are defined only up to the spin.
        return;
    }
    let nodes = found.displacements.iter().zip(&expected.displacements);
    let difference = vector_differences(nodes, FLOOR);
    assert!(
        difference.iter().all(|d| *d < 1e-12),
        "{name}: {difference:?}"
    );
}

/// Asserts that what the book says of a mechanism is read as the mechanism of a job.
///
/// # Panics
/// Where it is not.
pub fn assert_book_is_read(kind: &str, pose: &str) {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/src/prebuilt.md");
    let page = std::fs::read_to_string(page).expect("the page");
    let blocks = page.split("```ron,fragment\n").skip(1);
    let mut blocks = blocks.filter_map(|rest| rest.split("```").next());
    let block = blocks.find(|block| block.starts_with(kind));
    batch(
        block.unwrap_or_else(|| panic!("the page has no {kind}")),
        pose,
    );
}
