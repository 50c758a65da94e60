//! Three natural frequencies of a pose of the delta, of one and of eight elements a link, beside the
//! plain pose: its stiffness and its displacement under load. Times are of one pose on one core,
//! inverse kinematics included.

use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_assembly::{BeamMass, ModalOptions, Prepared};
use hyperstat_benches::Sweep;
use hyperstat_mechanisms::{Disk, Job, Registry, batch_from_str};

/// The paper's delta with a platform of 1 kg, in 64 poses.
fn delta(elements: usize) -> Job {
    let part = |name: &str, diameter: f64| {
        format!(
            "{name}: (section: Circle(diameter: {diameter:?}), \
             material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),"
        )
    };
    let text = format!(
        "(jobs: [(name: \"delta\", mechanism: Delta(
            base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60,
            rod_spacing: 0.12, elements: {elements}, {} {} {}),
            poses: Grid(x: (-0.2, 0.2, 4), y: (-0.2, 0.2, 4), z: (0.45, 0.55, 4)),
            masses: [(on: (\"platform\", \"P\"), mass: 1.0, inertia: (1e-3, 1e-3, 1e-3))],
            loads: [(on: (\"platform\", \"P\"), force: (-20.0, 10.0, 100.0), moment: (5.0, 5.0, 8.0))],
        )])",
        part("arm", 0.030),
        part("bar", 0.020),
        part("rod", 0.014),
    );
    let batch = batch_from_str(&text, Path::new("delta.ron"), &Disk, &Registry::builtin());
    let mut jobs = batch.expect("a valid file").jobs;
    jobs.remove(0)
}

fn modes(c: &mut Criterion) {
    for elements in [1, 8] {
        let job = delta(elements);
        let model = job.model().expect("a pose within reach");
        let prepared = Prepared::new(model.clone());
        let mut group = c.benchmark_group(format!("modes/delta, elements {elements}"));
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(500))
            .measurement_time(Duration::from_secs(2));
        for mass in [BeamMass::Exact, BeamMass::Consistent] {
            let options = ModalOptions {
                mass,
                ..ModalOptions::lowest(3)
            };
            let plan = prepared.modal(&options).expect("a plan");
            let mut geometry = model.geometry().clone();
            group.bench_function(format!("three frequencies, {mass:?} mass"), |b| {
                b.iter_custom(|poses| {
                    let start = Instant::now();
                    for pose in 0..poses {
                        let placed = job.place(pose as usize % job.len(), &mut geometry);
                        black_box(placed.expect("a pose within reach"));
                        let found = plan.frequencies(&geometry);
                        black_box(found.expect("frequencies"));
                    }
                    start.elapsed()
                });
            });
        }
        let mut sweep = Sweep::new(&job);
        group.bench_function("plain pose, lanes", |b| {
            b.iter_custom(|poses| sweep.time(poses, Sweep::in_lanes));
        });
        group.finish();
    }
}

criterion_group!(benches, modes);
criterion_main!(benches);
