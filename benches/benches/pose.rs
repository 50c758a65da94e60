//! The delta at one pose: by a plan that is there already, from scratch, by the reference solver,
//! and by the traditional method.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_assembly::Plan;
use hyperstat_benches::{POSE, deltas, loaded_model};
use hyperstat_mechanisms::prebuilt::Prebuilt;
use hyperstat_reference::{TraditionalOptions, traditional};

/// Springs for what is rigid or free, as good as they get on the delta.
const SPRINGS: TraditionalOptions = TraditionalOptions {
    joint_stiffness: 1e13,
    angular_stiffness: 1e13,
    free_stiffness: 1e-7,
};

fn pose(c: &mut Criterion) {
    for (joints, delta) in deltas() {
        let model = loaded_model(&delta, &POSE);
        let plan = Plan::new(&model).expect("a plan");
        let mut workspace = plan.workspace();
        let mut geometry = model.geometry().clone();
        let mut group = c.benchmark_group(format!("pose/delta, {joints}"));
        group
            .sample_size(20)
            .measurement_time(Duration::from_secs(2));
        group.bench_function("a pose of a sweep, with inverse kinematics", |b| {
            b.iter(|| {
                delta
                    .place(black_box(&POSE), &mut geometry)
                    .expect("a pose within reach");
                plan.sweep(&model, &geometry, &mut workspace)
            });
        });
        group.bench_function("solve, with plan, diagnosis and all wrenches", |b| {
            b.iter(|| hyperstat_assembly::solve(black_box(&model)));
        });
        group.sample_size(10);
        group.bench_function("reference solver", |b| {
            b.iter(|| hyperstat_reference::solve(black_box(&model)));
        });
        group.bench_function("traditional method", |b| {
            b.iter(|| traditional(black_box(&model), &SPRINGS));
        });
        group.finish();
    }
}

criterion_group!(benches, pose);
criterion_main!(benches);
