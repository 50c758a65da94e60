//! What a job's columns on request cost: rows of the delta with rigid joints, one core, as records of a
//! sweep, beside the same rows without.

use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_mechanisms::{Disk, Job, Registry, batch_from_str};
use hyperstat_study::sweep::{Sweep, Way};

/// The jobs of `mechanisms.ron`, the first of which is taken.
const MECHANISMS: &str = include_str!("../mechanisms.ron");

const COLUMNS: [(&str, &str); 10] = [
    ("none", ""),
    ("Measures", "Measures"),
    ("Mass", "Mass"),
    ("Drives", "Drives"),
    ("DriveForces", "DriveForces"),
    ("Wrench of a joint", "Wrench(\"A1\")"),
    ("Stress", "Stress"),
    ("Budget", "Budget"),
    ("Frequencies", "Frequencies(count: 3)"),
    (
        "all but frequencies",
        "Drives, DriveForces, Wrench(\"A1\"), Stress, Mass, Measures, Budget",
    ),
];

/// The first mechanism with these columns.
fn job(columns: &str) -> Job {
    let asked = format!("name: \"delta-rigid\", columns: [{columns}],");
    let text = MECHANISMS.replacen("name: \"delta-rigid\",", &asked, 1);
    let batch = batch_from_str(
        &text,
        "mechanisms.ron".as_ref(),
        &Disk,
        &Registry::builtin(),
    );
    let mut jobs = batch.unwrap_or_else(|error| panic!("{error}")).jobs;
    jobs.swap_remove(0)
}

/// Time of so many rows, of all poses over and over, by either way.
fn time(job: &Job, way: Way, rows: u64) -> Duration {
    let sweep = Sweep::new(job, way).unwrap_or_else(|error| panic!("{error}"));
    let start = Instant::now();
    let mut left = rows as usize;
    while left > 0 {
        let now = left.min(sweep.len());
        let records = sweep.records(0..now);
        assert!(records.iter().all(|record| record.result.is_ok()));
        left -= now;
    }
    start.elapsed()
}

fn columns(c: &mut Criterion) {
    for (what, way) in [("lanes", Way::Lanes), ("one by one", Way::OneByOne)] {
        let mut group = c.benchmark_group(format!("columns/{what}"));
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(300))
            .measurement_time(Duration::from_secs(1));
        for (name, asked) in COLUMNS {
            let job = job(asked);
            group.bench_function(name, |b| b.iter_custom(|rows| time(&job, way, rows)));
        }
        group.finish();
    }
}

criterion_group!(benches, columns);
criterion_main!(benches);
