//! The delta with every segment divided into n elements, displacements of all inner nodes
//! included: dividing changes no answer, and work grows with n only as far as nodes are reported.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_assembly::{Model, SegmentId, solve};
use hyperstat_benches::POSE;
use hyperstat_mechanisms::prebuilt::{Delta, Prebuilt};

/// Everything that a solve reports, and the displacements of all inner nodes.
fn solve_all_nodes(model: &Model) {
    let solution = solve(model).expect("a solution");
    for segment in 0..model.segments().len() {
        let inner = solution.inner_displacements(model, SegmentId(segment));
        black_box(inner.expect("displacements"));
    }
}

fn refinement(c: &mut Criterion) {
    let mut group = c.benchmark_group("refinement");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1));
    for elements in [1, 10, 100, 1_000, 10_000, 100_000] {
        let delta = Delta {
            elements,
            ..Delta::paper()
        };
        let model = delta.model(&POSE).expect("a pose within reach");
        group.bench_function(format!("n = {elements}, solve"), |b| {
            b.iter(|| solve(black_box(&model)));
        });
        group.bench_function(format!("n = {elements}, solve with all nodes"), |b| {
            b.iter(|| solve_all_nodes(black_box(&model)));
        });
    }
    group.finish();
}

criterion_group!(benches, refinement);
criterion_main!(benches);
