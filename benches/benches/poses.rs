//! One pose to the output's stiffness and its displacement under load, inverse kinematics
//! included: eight poses in SIMD lanes, a single pose as a program asks for it, one by one with a
//! sparse factorization, and by the traditional dense program. Times are of one pose on one core.

use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_assembly::LANES;
use hyperstat_benches::{Sweep, mechanism};

fn poses(c: &mut Criterion) {
    for name in ["delta-rigid", "delta-elastic", "hexapod", "tripteron"] {
        let job = mechanism(name);
        let mut sweep = Sweep::new(&job);
        let mut group = c.benchmark_group(format!("poses/{name}"));
        group
            .sample_size(20)
            .warm_up_time(Duration::from_millis(500))
            .measurement_time(Duration::from_secs(2));
        group.bench_function("lanes", |b| {
            b.iter_custom(|poses| sweep.time(poses, Sweep::in_lanes));
        });
        group.bench_function("lanes, inverse kinematics alone", |b| {
            b.iter_custom(|poses| sweep.time(poses, Sweep::place_lanes));
        });
        group.bench_function("one pose from a program", |b| {
            b.iter_custom(|poses| {
                sweep.time(poses, |sweep, first| {
                    (first..first + LANES).for_each(|pose| sweep.from_program(pose));
                })
            });
        });
        group.bench_function("one by one", |b| {
            b.iter_custom(|poses| {
                sweep.time(poses, |sweep, first| {
                    (first..first + LANES).for_each(|pose| sweep.one_by_one(pose));
                })
            });
        });
        group.sample_size(10);
        group.bench_function("dense, Lagrange multipliers", |b| {
            b.iter_custom(|poses| {
                sweep.time(poses, |sweep, first| {
                    (first..first + LANES).for_each(|pose| sweep.dense(pose));
                })
            });
        });
        group.finish();
    }
}

criterion_group!(benches, poses);
criterion_main!(benches);
