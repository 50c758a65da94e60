//! One pose of every prebuilt mechanism in the lanes, its number of unknowns in its name: work should grow with
//! the unknowns.

use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_benches::{Sweep, mechanisms};

fn prebuilts(c: &mut Criterion) {
    let mut group = c.benchmark_group("prebuilts");
    group
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1));
    for job in mechanisms() {
        let mut sweep = Sweep::new(&job);
        let handed_on = sweep.handed_on();
        println!(
            "{}: {handed_on} of {} poses one by one",
            job.name,
            job.len()
        );
        let name = format!("{}, {} unknowns", job.name, sweep.unknowns());
        group.bench_function(name, |b| {
            b.iter_custom(|poses| sweep.time(poses, Sweep::in_lanes));
        });
    }
    group.finish();
}

criterion_group!(benches, prebuilts);
criterion_main!(benches);
