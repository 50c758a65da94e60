//! Memory does not grow with the number of poses. A test binary of its own, so that the peak of
//! this process is the peak of the runs.

use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::ExitCode;

use hyperstat_mechanisms::Registry;

/// A map of the delta with `layers` of 100 × 100 poses, about a half of them out of reach.
fn batch(layers: usize) -> String {
    let steel = "material: (young: 2.1e11, poisson: 0.3)";
    format!(
        r#"(jobs: [(
            name: "map",
            mechanism: Delta(
                base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60,
                rod_spacing: 0.12,
                arm: (section: Circle(diameter: 0.030), {steel}),
                bar: (section: Circle(diameter: 0.020), {steel}),
                rod: (section: Circle(diameter: 0.014), {steel}),
            ),
            poses: Grid(x: (-0.9, 0.9, 100), y: (-0.9, 0.9, 100), z: (0.4, 0.6, {layers})),
        )])"#
    )
}

/// Peak of this process's memory so far [bytes], where the system tells it.
fn peak() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kilobytes)
}

#[test]
fn a_long_run_takes_no_more_memory_than_a_short_one() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("memory");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let run = |layers: usize, format: &str| {
        let file = folder.join("map.ron");
        fs::write(&file, batch(layers)).unwrap();
        let mut args: Vec<OsString> = vec!["hyperstat".into(), "run".into(), file.into()];
        args.extend(["--out".into(), folder.clone().into()]);
        args.extend(["--threads", "2", "--format", format].map(OsString::from));
        // Some poses have no result.
        assert_eq!(
            hyperstat_cli::run(args, &Registry::builtin()),
            ExitCode::from(1)
        );
        let table = folder.join(format!("map.{format}"));
        let size = fs::metadata(&table).unwrap().len();
        fs::remove_file(table).unwrap();
        size
    };
    // What is compressed takes more rows to be as large.
    for (format, layers) in [("csv", 22), ("parquet", 50)] {
        let short = run(8, format);
        let before = peak();
        let long = run(layers, format);
        let after = peak();
        assert!(long > 2 * short, "{format}: {short} B, {long} B");
        let (Some(before), Some(after)) = (before, after) else {
            println!("{format}: this system does not tell the peak of a process's memory");
            continue;
        };
        println!(
            "{format}: {before} B, then {after} B for {} B more",
            long - short
        );
        assert!(after < 200_000_000, "{format}: {after} B");
        // Far less than what the longer run has written more.
        let grown = after - before;
        assert!(grown < 4_000_000, "{format}: {grown} B");
        assert!(long - short > 3 * 4_000_000, "{format}");
    }
    fs::remove_dir_all(folder).unwrap();
}
