//! The whole of `hyperstat run`, from the batch file to the results on the disk: poses of the
//! delta with rigid joints, as CSV and as Parquet, with one thread and with two; and designs of it,
//! one pose each.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;
use std::{env, fs, process};

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use hyperstat_mechanisms::Registry;

/// Poses of the batch: 40 by 40 by this many.
const LAYERS: u64 = 13;

/// Designs of a batch that varies them.
const DESIGNS: u64 = 2_000;

fn map() -> String {
    let poses = format!("Grid(x: (-0.2, 0.2, 40), y: (-0.2, 0.2, 40), z: (0.45, 0.55, {LAYERS}))");
    batch(&format!("poses: {poses}"))
}

fn designs() -> String {
    let vary = format!(r#""rod.section.diameter": Range(0.010, 0.020, {DESIGNS})"#);
    batch(&format!(
        "poses: List([(0.0, 0.0, 0.5)]), vary: {{ {vary} }}"
    ))
}

fn batch(poses: &str) -> String {
    format!(
        r#"(
    jobs: [(
        name: "map",
        mechanism: Delta(
            base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60, rod_spacing: 0.12,
            arm: (section: Circle(diameter: 0.030), material: (young: 2.1e11, poisson: 0.3)),
            bar: (section: Circle(diameter: 0.020), material: (young: 2.1e11, poisson: 0.3)),
            rod: (section: Circle(diameter: 0.014), material: (young: 2.1e11, poisson: 0.3)),
        ),
        {poses},
        loads: [(on: ("platform", "P"), force: (-20.0, 10.0, 100.0), moment: (5.0, 5.0, 8.0))],
    )],
)"#
    )
}

fn hyperstat(file: &Path, options: &[&str]) -> ExitCode {
    let mut args: Vec<OsString> = vec!["hyperstat".into(), "run".into(), file.into()];
    args.push("--out".into());
    args.push(file.with_file_name("out").into());
    args.extend(options.iter().map(OsString::from));
    hyperstat_cli::run(args, &Registry::builtin())
}

fn run(c: &mut Criterion) {
    let folder: PathBuf = env::temp_dir().join(format!("hyperstat-bench-{}", process::id()));
    fs::create_dir_all(&folder).expect("a folder for temporary files");
    let file = folder.join("batch.ron");
    fs::write(&file, map()).expect("a temporary file");
    let mut group = c.benchmark_group("run");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(2))
        .throughput(Throughput::Elements(40 * 40 * LAYERS));
    for format in ["csv", "parquet"] {
        for threads in ["1", "2"] {
            group.bench_function(format!("{format}, threads: {threads}"), |b| {
                let options = ["--format", format, "--threads", threads];
                b.iter(|| assert_eq!(hyperstat(&file, &options), ExitCode::SUCCESS));
            });
        }
    }
    fs::write(&file, designs()).expect("a temporary file");
    group.throughput(Throughput::Elements(DESIGNS));
    for threads in ["1", "2"] {
        group.bench_function(format!("{DESIGNS} designs, threads: {threads}"), |b| {
            b.iter(|| assert_eq!(hyperstat(&file, &["--threads", threads]), ExitCode::SUCCESS));
        });
    }
    group.finish();
    fs::remove_dir_all(&folder).expect("the temporary folder goes");
}

criterion_group!(benches, run);
criterion_main!(benches);
