//! The paper's trajectory (Eq. 65, 61 poses): one plan, and a reference solution for every pose.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_assembly::Plan;
use hyperstat_benches::{deltas, loaded_model, trajectory};
use hyperstat_mechanisms::prebuilt::Prebuilt;

fn sweep(c: &mut Criterion) {
    let poses = trajectory();
    for (joints, delta) in deltas() {
        let mut model = loaded_model(&delta, &poses[0]);
        let mut geometry = model.geometry().clone();
        let mut group = c.benchmark_group(format!("sweep/trajectory of the delta, {joints}"));
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(500))
            .measurement_time(Duration::from_secs(2));
        group.bench_function("one plan, made on the way", |b| {
            b.iter(|| {
                let plan = Plan::new(&model).expect("a plan");
                let mut workspace = plan.workspace();
                for pose in &poses {
                    delta
                        .place(pose, &mut geometry)
                        .expect("a pose within reach");
                    let found = plan.sweep(&model, &geometry, &mut workspace);
                    black_box(found.expect("a result"));
                }
            });
        });
        group.bench_function("reference solver", |b| {
            b.iter(|| {
                for pose in &poses {
                    delta
                        .place(pose, &mut geometry)
                        .expect("a pose within reach");
                    model.set_geometry(geometry.clone());
                    black_box(hyperstat_reference::solve(&model).expect("a solution"));
                }
            });
        });
        group.finish();
    }
}

criterion_group!(benches, sweep);
criterion_main!(benches);
