//! Networks of rigid bars on hinges with springs: closed chains, ladders and plane grids. `solve` with
//! everything it reports, and one pose of a sweep. Some hundred bars; with `HYPERSTAT_BENCH_LARGE=1`
//! thousands. The exponents by which time grows with the bars are printed at the end.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_assembly::Prepared;
use hyperstat_tests::networks::{Hinge, Sketch};

/// A family by its name, its sizes (the last two are large), and the network of a size.
type Family = (&'static str, [usize; 4], fn(usize) -> Sketch);

const FAMILIES: [Family; 4] = [
    ("chain", [100, 300, 1000, 5000], |n| Sketch::chain(n, 0.5)),
    ("closed chain", [100, 300, 1000, 5000], |n| {
        Sketch::ring(n, 0.5)
    }),
    ("ladder", [33, 100, 333, 1667], |n| Sketch::grid(n, 1)),
    ("grid", [7, 12, 22, 50], |n| Sketch::grid(n, n)),
];

fn sizes(c: &mut Criterion) {
    let large = std::env::var_os("HYPERSTAT_BENCH_LARGE").is_some();
    let mut group = c.benchmark_group("networks");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_secs(1));
    let mut exponents = Vec::new();
    for (family, sizes, sketch) in FAMILIES {
        let mut times: Vec<[f64; 3]> = Vec::new();
        let count = if large { sizes.len() } else { 2 };
        for size in sizes.into_iter().take(count) {
            let sketch = sketch(size);
            let bars = sketch.bars.len();
            let model = sketch.model(Hinge::Elastic(1e4));
            let mut solves = Vec::new();
            group.bench_function(format!("{family}, {bars} bars"), |b| {
                b.iter(|| solves.push(timed(|| hyperstat_assembly::solve(black_box(&model)))));
            });
            let prepared = Prepared::new(model.clone());
            let mut workspace = prepared.workspace().expect("a plan");
            let mut poses = Vec::new();
            group.bench_function(format!("{family}, {bars} bars, a pose"), |b| {
                b.iter(|| {
                    let pose = || prepared.sweep(model.geometry(), &mut workspace);
                    poses.push(timed(pose));
                });
            });
            times.push([bars as f64, median(solves), median(poses)]);
        }
        if let [first, .., last] = times[..] {
            let exponent = |k: usize| (last[k] / first[k]).ln() / (last[0] / first[0]).ln();
            exponents.push((family, first[0], last[0], exponent(1), exponent(2)));
        }
    }
    group.finish();
    for (family, first, last, solve, pose) in exponents {
        println!("{family}, {first} to {last} bars: solve n^{solve:.2}, a pose n^{pose:.2}");
    }
}

/// Seconds that something takes, which must not fail.
fn timed<T, E: std::fmt::Display>(run: impl FnOnce() -> Result<T, E>) -> f64 {
    let start = Instant::now();
    if let Err(error) = black_box(run()) {
        panic!("{error}");
    }
    start.elapsed().as_secs_f64()
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(f64::NAN)
}

criterion_group!(benches, sizes);
criterion_main!(benches);
