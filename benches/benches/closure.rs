//! One pose of a mechanism of a file: placed by loop closure, eight together and one by one, and placed and solved
//! in lanes, beside the prebuilt mechanism in the same poses.

use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_assembly::{LANES, Lanes, Prepared};
use hyperstat_mechanisms::{Design, Disk, Job, Placing, Registry, load_batch};
use hyperstat_study::sweep::placing;

/// A job with one thread's buffers.
struct Poses<'a> {
    job: &'a Job,
    design: Design,
    prepared: Prepared,
    lanes: Lanes,
    placing: Placing,
}

impl<'a> Poses<'a> {
    fn new(job: &'a Job) -> Self {
        let prepared = Prepared::new(job.model().expect("a pose within reach"));
        Self {
            job,
            design: job.design(0).expect("a design"),
            lanes: prepared.lanes().expect("a plan"),
            prepared,
            placing: placing(),
        }
    }

    /// Places eight poses, and says which are reached.
    fn place(&mut self, first: usize) -> [bool; LANES] {
        let geometries = self.lanes.geometries_mut();
        let poses = first..first + LANES;
        let placed = self
            .design
            .place_lanes(poses, geometries, &mut self.placing);
        placed.map(|placed| matches!(black_box(placed), Some(Ok(_))))
    }

    fn place_and_solve(&mut self, first: usize) {
        let filled = self.place(first);
        black_box(self.prepared.sweep_lanes(&mut self.lanes, filled));
    }

    fn place_one_by_one(&mut self, first: usize) {
        for lane in 0..LANES {
            let geometry = self.lanes.geometry_mut(lane);
            let _ = black_box(self.design.place(first + lane, geometry));
        }
    }

    /// Time of so many poses; the job's come in turn.
    fn time(&mut self, poses: u64, mut work: impl FnMut(&mut Self, usize)) -> Duration {
        let groups = poses.div_ceil(LANES as u64);
        let own = self.job.len() / LANES;
        let start = Instant::now();
        for group in 0..groups {
            // Strides, so that a few groups are from all over the job.
            work(self, (group as usize * 37 % own) * LANES);
        }
        let solved = groups * LANES as u64;
        start.elapsed().mul_f64(poses as f64 / solved as f64)
    }
}

fn closure(c: &mut Criterion) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("closure.ron");
    let batch =
        load_batch(&path, &Disk, &Registry::builtin()).unwrap_or_else(|error| panic!("{error}"));
    for job in &batch.jobs {
        let mut poses = Poses::new(job);
        let all = (0..job.len()).step_by(LANES);
        let reached: usize = all
            .map(|first| poses.place(first).iter().filter(|r| **r).count())
            .sum();
        let (missed, one_by_one) = (job.len() - reached, poses.placing.one_by_one());
        let name = &job.name;
        println!(
            "{name}: {} poses, {missed} out of reach, {one_by_one} one by one",
            job.len()
        );
        let mut group = c.benchmark_group(format!("closure/{name}"));
        group
            .sample_size(20)
            .warm_up_time(Duration::from_millis(300))
            .measurement_time(Duration::from_secs(1));
        group.bench_function("placed and solved in lanes", |b| {
            b.iter_custom(|n| poses.time(n, Poses::place_and_solve));
        });
        group.bench_function("placed in lanes", |b| {
            b.iter_custom(|n| {
                poses.time(n, |poses, first| {
                    poses.place(first);
                })
            });
        });
        group.bench_function("placed one by one", |b| {
            b.iter_custom(|n| poses.time(n, Poses::place_one_by_one));
        });
        group.finish();
    }
}

criterion_group!(benches, closure);
criterion_main!(benches);
