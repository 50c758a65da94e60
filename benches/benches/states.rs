//! One pose under each kind of what acts, beside the same pose under a force alone: all of them in the
//! lanes, one core, inverse kinematics included.

use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_benches::{Sweep, mechanism, mechanisms};
use hyperstat_tests::acted::acted_on;

fn states(c: &mut Criterion) {
    for name in ["delta-rigid", "delta-elastic"] {
        let job = mechanism(name);
        let model = job.model().expect("a pose within reach");
        let mut group = c.benchmark_group(format!("states/{name}"));
        group
            .sample_size(20)
            .warm_up_time(Duration::from_millis(300))
            .measurement_time(Duration::from_secs(1));
        for (what, model) in acted_on(&model) {
            let mut sweep = Sweep::of(&job, model);
            group.bench_function(what, |b| {
                b.iter_custom(|poses| sweep.time(poses, Sweep::in_lanes));
            });
        }
        group.finish();
    }
    println!("handed on to the one-by-one path, of the poses of all prebuilt mechanisms:");
    let mut counts: Vec<(&str, u64, usize)> = Vec::new();
    for job in mechanisms() {
        let model = job.model().expect("a pose within reach");
        for (what, model) in acted_on(&model) {
            let handed_on = Sweep::of(&job, model).handed_on();
            match counts.iter_mut().find(|own| own.0 == what) {
                Some(own) => (own.1, own.2) = (own.1 + handed_on, own.2 + job.len()),
                None => counts.push((what, handed_on, job.len())),
            }
        }
    }
    for (what, handed_on, all) in counts {
        println!("{what}: {handed_on} of {all}");
    }
}

criterion_group!(benches, states);
criterion_main!(benches);
