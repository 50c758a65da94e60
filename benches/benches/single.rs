//! One configuration of the delta from scratch: its plan, and everything that `hyperstat solve`
//! reports, beside the reference solver, which finds the same.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_assembly::Prepared;
use hyperstat_benches::mechanism;

fn single(c: &mut Criterion) {
    for name in ["delta-rigid", "delta-elastic"] {
        let model = mechanism(name).model().expect("a pose within reach");
        let mut group = c.benchmark_group(format!("single/{name}"));
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(500))
            .measurement_time(Duration::from_secs(2));
        group.bench_function("plan", |b| {
            b.iter(|| Prepared::new(black_box(&model).clone()).unknowns())
        });
        group.bench_function("solve, with diagnosis and all wrenches", |b| {
            b.iter(|| hyperstat_assembly::solve(black_box(&model)));
        });
        group.bench_function("reference solver", |b| {
            b.iter(|| hyperstat_reference::solve(black_box(&model)));
        });
        group.finish();
    }
}

criterion_group!(benches, single);
criterion_main!(benches);
