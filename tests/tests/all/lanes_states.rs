//! The lanes under each kind of what acts, against the one-by-one path, on the prebuilt mechanisms of
//! the benches: they answer nearly all poses themselves, and say the same.

use std::path::Path;

use hyperstat_assembly::{LANES, PoseResult, Prepared};
use hyperstat_mechanisms::{Disk, Registry, load_batch};
use hyperstat_tests::acted::acted_on;
use hyperstat_tests::stiffness_difference;
use nalgebra::Vector6;

/// Of the largest component of a displacement, components measured by their stiffness.
const AGREEMENT: f64 = 1e-11;

fn displacements(result: &PoseResult) -> Vec<Vector6<f64>> {
    let own = result.displacement.into_iter();
    own.chain(result.cases.iter().copied()).collect()
}

#[test]
fn prebuilt_mechanisms_under_all_that_acts() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../benches/mechanisms.ron");
    let batch = load_batch(&path, &Disk, &Registry::builtin()).expect("a batch");
    let (mut poses, mut handed_on, mut kinds) = (0, 0, 0);
    for job in &batch.jobs {
        let model = job.model().expect("a pose within reach");
        for (what, model) in acted_on(&model) {
            kinds += 1;
            let prepared = Prepared::new(model);
            let mut lanes = prepared.lanes().expect("a plan");
            let mut workspace = prepared.workspace().expect("a plan");
            for first in (0..job.len()).step_by(LANES) {
                for lane in 0..LANES {
                    let placed = job.place(first + lane, lanes.geometry_mut(lane));
                    placed.expect("a pose within reach");
                }
                let found = prepared.sweep_lanes(&mut lanes, [true; LANES]);
                poses += LANES;
                // Not all of them one by one: that takes long.
                for (lane, found) in found.into_iter().enumerate().step_by(3) {
                    let found = found.expect("a filled lane");
                    let found = found.unwrap_or_else(|e| panic!("{}, {what}: {e}", job.name));
                    let geometry = lanes.geometry_mut(lane).clone();
                    let expected = prepared.sweep(&geometry, &mut workspace);
                    let expected = expected.expect("a result");
                    let (Some(k), Some(own)) = (found.stiffness, expected.stiffness) else {
                        panic!("{}, {what}: no stiffness", job.name);
                    };
                    let error = stiffness_difference(&k, &own);
                    assert!(error <= AGREEMENT, "{}, {what}: K {error:e}", job.name);
                    let weights = own.diagonal().map(f64::sqrt);
                    let (found, expected) = (displacements(&found), displacements(&expected));
                    assert_eq!(found.len(), expected.len());
                    for (u, own) in found.iter().zip(&expected) {
                        let size = own.component_mul(&weights).amax();
                        let error = (u - own).component_mul(&weights).amax() / size;
                        assert!(error <= AGREEMENT, "{}, {what}: u {error:e}", job.name);
                    }
                }
            }
            handed_on += lanes.one_by_one();
        }
    }
    println!("{kinds} kinds, {poses} poses, {handed_on} handed on");
    assert!(kinds > 100, "{kinds} mechanisms under what acts");
    assert!(
        1000 * handed_on <= poses as u64,
        "{handed_on} of {poses} handed on"
    );
}
