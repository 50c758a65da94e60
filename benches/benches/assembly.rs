//! The delta's plan, worked out once a topology, and the numeric pass that it serves.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_assembly::Plan;
use hyperstat_benches::{POSE, deltas, loaded_model};

fn assembly(c: &mut Criterion) {
    for (joints, delta) in deltas() {
        let model = loaded_model(&delta, &POSE);
        let plan = Plan::new(&model).expect("a plan");
        let mut workspace = plan.workspace();
        let mut group = c.benchmark_group(format!("assembly/delta, {joints}"));
        group.bench_function("plan", |b| {
            b.iter(|| Plan::new(black_box(&model)));
        });
        group.bench_function("numeric pass of a pose", |b| {
            b.iter(|| plan.sweep(&model, black_box(model.geometry()), &mut workspace));
        });
        group.finish();
    }
}

criterion_group!(benches, assembly);
criterion_main!(benches);
