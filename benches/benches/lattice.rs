//! Lattices of welded beams: cubes, whose factors fill in as everything in space does, and towers,
//! which grow along one axis as mechanisms do; and a gripper of two elastic fingers with driven
//! carriages and a rigid plate. Some thousand unknowns; with `HYPERSTAT_BENCH_LARGE=1` up to 1e5.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_assembly::{Model, Prepared, Sensitivity};
use hyperstat_tests::gripper::gripper;
use hyperstat_tests::lattice::lattice;

/// Nodes along x, y and z; the last two of each family are large.
const FAMILIES: [(&str, [[usize; 3]; 4]); 2] = [
    ("cube", [[5, 5, 5], [7, 7, 7], [12, 12, 12], [26, 26, 26]]),
    ("tower", [[5, 5, 5], [5, 5, 14], [5, 5, 68], [5, 5, 668]]),
];

/// Layers of the gripper's fingers; the last two are large.
const GRIPPERS: [usize; 4] = [8, 18, 55, 523];

fn sizes(c: &mut Criterion) {
    let large = std::env::var_os("HYPERSTAT_BENCH_LARGE").is_some();
    let mut group = c.benchmark_group("lattice");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_secs(1));
    for (family, sizes) in FAMILIES {
        let count = if large { sizes.len() } else { 2 };
        for [nx, ny, nz] in sizes.into_iter().take(count) {
            let model = lattice(nx, ny, nz);
            let unknowns = 6 * nx * ny * (nz - 1);
            group.bench_function(format!("{family}, {unknowns} unknowns"), |b| {
                b.iter(|| hyperstat_assembly::solve(black_box(&model)));
            });
            // What `solve --why` adds: by the same plan, diagnosis and factorization.
            group.bench_function(format!("{family}, {unknowns} unknowns, and why"), |b| {
                b.iter(|| why(black_box(&model)));
            });
        }
    }
    let count = if large { GRIPPERS.len() } else { 2 };
    for layers in GRIPPERS.into_iter().take(count) {
        let model = gripper(layers);
        let unknowns = Prepared::new(model.clone()).unknowns().expect("a plan");
        group.bench_function(format!("gripper, {unknowns} unknowns"), |b| {
            b.iter(|| hyperstat_assembly::solve(black_box(&model)));
        });
    }
    group.finish();
}

/// A solve and the sensitivities of its deflection.
fn why(model: &Model) -> Vec<Sensitivity> {
    let prepared = Prepared::new(model.clone());
    let here = prepared.here();
    let solution = here.solve().expect("a solution");
    let influence = here.influence().expect("a held output");
    influence.sensitivities(&solution).expect("derivatives")
}

criterion_group!(benches, sizes);
criterion_main!(benches);
