//! Runs in parts, and runs that are killed: what the binary leaves, and what it says.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::support::{Bench, delta_batch};

/// Poses of the delta in several chunks, of which some are out of reach.
const MAP: &str = "Grid(x: (-0.45, 0.45, 41), y: (-0.4, 0.4, 11), z: (0.45, 0.55, 2))";
const ROWS: usize = 41 * 11 * 2;

/// More of a job with all kinds of results.
const REST: &str = r#"figures: [Trajectory(scale: Auto), Deformed(pose: 20, scale: Auto), Map(value: "k33", plane: z(0.45))],"#;

/// All files below a folder, by their names, but those of `parts`.
fn results(bench: &Bench, folder: &str) -> BTreeMap<String, Vec<u8>> {
    let names = bench
        .names(folder)
        .into_iter()
        .filter(|name| name != "parts");
    let read = |name: String| {
        let content = fs::read(bench.path(folder).join(&name)).unwrap();
        (name, content)
    };
    names.map(read).collect()
}

/// Names of all files below a folder.
fn all_names(folder: &Path) -> Vec<String> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        match entry.path().is_dir() {
            true => names.extend(all_names(&entry.path())),
            false => names.push(entry.file_name().into_string().unwrap()),
        }
    }
    names
}

#[test]
fn shards_merge_to_the_files_of_the_undivided_run() {
    let bench = Bench::new("parts-merge");
    bench.file("map.ron", &delta_batch("map", MAP, REST));
    for format in ["csv", "parquet"] {
        let run = |out: &str, more: &[&str]| {
            let arguments = [
                &[
                    "run",
                    "map.ron",
                    "--out",
                    out,
                    "--format",
                    format,
                    "--summary",
                ],
                more,
            ];
            bench.hyperstat(&arguments.concat()).ends_with(1)
        };
        let whole = format!("whole-{format}");
        let undivided = run(&whole, &[]);
        let out = format!("parts-{format}");
        for shard in ["2/3", "0/3", "0/3"] {
            let told = run(&out, &["--shard", shard, "--threads", "1"]);
            assert!(told.out().contains("map: rows "), "{}", told.out());
        }
        // The middle is missing.
        let missing = bench.hyperstat(&["merge", &out]).ends_with(2);
        assert_eq!(missing.out(), "--shard 1/3\n");
        missing.says(&["rows are missing", "then merge again"]);
        let told = run(&out, &["--shard", "1/3", "--secure", "0"]);
        assert!(told.out().contains("map: rows "), "{}", told.out());
        // Where the batch is not.
        bench.file("elsewhere", "");
        let merged = bench.hyperstat(&["merge", &out]).ends_with(1);
        assert_eq!(merged.out().replace(&out, &whole), undivided.out());
        assert_eq!(results(&bench, &out), results(&bench, &whole));
    }
    let dataset = bench
        .hyperstat(&["merge", "parts-csv", "--dataset"])
        .ends_with(2);
    dataset.says(&["those of parts-csv are CSV", "leave `--dataset` out"]);
    fs::remove_file(bench.path("parts-parquet/map-summary.json")).unwrap();
    let dataset = bench
        .hyperstat(&["merge", "parts-parquet", "--dataset"])
        .ends_with(1);
    assert!(
        dataset.out().contains("parts-parquet/parts/map\n"),
        "{}",
        dataset.out()
    );
    assert_eq!(
        bench.read("parts-parquet/map-summary.json"),
        bench.read("whole-parquet/map-summary.json")
    );
}

/// A run of several jobs, killed again and again at any instant, ends with the files of one that was not.
#[cfg(unix)]
#[test]
fn a_run_that_is_killed_goes_on_to_the_same_bytes() {
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};

    let bench = Bench::new("parts-killed");
    let count = std::env::var("HYPERSTAT_KILLS")
        .ok()
        .and_then(|count| count.parse().ok());
    let count: u32 = count.unwrap_or(20);
    let second = r#"        (
            name: "second",
            mechanism: File("bar.ron"),
        ),
    ],"#;
    bench.file("bar.ron", crate::support::CANTILEVER);
    let batch = delta_batch("map", MAP, "").replace("    ],\n)", &format!("{second}\n)"));
    assert!(batch.contains("second"));
    bench.file("map.ron", &batch);
    let arguments = |format: &'static str, out: &'static str| {
        [
            "run",
            "map.ron",
            "--out",
            out,
            "--format",
            format,
            "--summary",
            "--secure",
            "0.01",
        ]
    };
    let mut expected = BTreeMap::new();
    let mut lasts = Duration::ZERO;
    for format in ["csv", "parquet"] {
        let began = Instant::now();
        bench.hyperstat(&arguments(format, format)).ends_with(1);
        lasts = lasts.max(began.elapsed());
        expected.insert(format, results(&bench, format));
    }
    let mut state = std::time::SystemTime::now()
        .elapsed()
        .map_or(1, |_| u64::from(std::process::id()))
        | 1;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state as f64 / u64::MAX as f64
    };
    let mut going_on = 0;
    for kill in 0..count {
        let format = if kill % 2 == 0 { "csv" } else { "parquet" };
        let signal = ["KILL", "TERM", "INT"][kill as usize % 3];
        if kill % 4 < 2 {
            // Else it goes on in what the last one left of the same form, or begins where that was complete.
            let _ = fs::remove_dir_all(bench.path("out"));
        }
        let child = Command::new(env!("CARGO_BIN_EXE_hyperstat"))
            .args(arguments(format, "out"))
            .current_dir(bench.path("."))
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        std::thread::sleep(lasts.mul_f64(random()));
        let killed = Command::new("kill")
            .args(["-s", signal, &child.id().to_string()])
            .status();
        assert!(killed.is_ok());
        let ended = child.wait_with_output().unwrap();
        let told = String::from_utf8_lossy(&ended.stderr).into_owned();
        match (signal, ended.status.code()) {
            // It was done before the signal came, or had not begun to hear it.
            (_, Some(1)) | (_, None) => {}
            ("TERM" | "INT", Some(130)) => {
                assert!(
                    told.contains("interrupted: ") && told.contains("the same command"),
                    "{told}"
                );
                let counts = told.split("interrupted: ").nth(1).unwrap();
                let counts = counts.split(" rows are done").next().unwrap();
                let (done, all) = counts.split_once(" of ").unwrap();
                let [done, all] = [done, all].map(|count| count.parse::<usize>().unwrap());
                assert!(done < all && all == ROWS + 1, "{told}");
                let left = all_names(&bench.path("out"));
                assert!(left.iter().all(|name| !name.ends_with(".part")), "{left:?}");
            }
            // What another form left is told, and never mixed.
            (_, Some(2)) if told.contains("parts of another run") => {}
            other => panic!("{other:?}: {told}"),
        }
        let mut again = bench.hyperstat(&arguments(format, "out"));
        if again.status() == 2 {
            again.says(&["parts of another run", "--fresh"]);
            let fresh = [&arguments(format, "out")[..], &["--fresh"]].concat();
            again = bench.hyperstat(&fresh);
        }
        let again = again.ends_with(1);
        going_on += u32::from(again.err().contains("computed before"));
        let found = results(&bench, "out");
        for (name, content) in &expected[format] {
            assert!(found.get(name) == Some(content), "{signal}, {name}");
        }
        let left = all_names(&bench.path("out"));
        assert!(left.iter().all(|name| !name.ends_with(".part")), "{left:?}");
    }
    assert!(going_on > 0);
}

#[test]
fn a_finished_run_says_so() {
    let bench = Bench::new("parts-finished");
    bench.file("map.ron", &delta_batch("map", MAP, ""));
    let run =
        |more: &[&str]| bench.hyperstat(&[&["run", "map.ron", "--out", "out"], more].concat());
    let first = run(&[]).ends_with(1);
    assert_eq!(first.err(), "");
    let again = run(&[]).ends_with(1);
    again.says(&["note: all rows of `map` were computed before", "--fresh"]);
    assert_eq!(again.out(), first.out());
    // On other threads it is the same run; with a summary it is another one.
    run(&["--threads", "1"])
        .ends_with(1)
        .says(&["were computed before"]);
    let other = run(&["--summary"]).ends_with(1);
    other.says(&[
        "the table of another run of `map`, which is replaced: it was without `--summary`",
    ]);
    assert_eq!(bench.results("out"), ["map-summary.json", "map.csv"]);
    let fresh = run(&["--fresh"]).ends_with(1);
    assert!(!fresh.err().contains("before"), "{}", fresh.err());
    // What is not as it was left is computed again.
    let table = bench.read("out/map.csv");
    bench.file("out/map.csv", &table.replacen('1', "2", 1));
    run(&[])
        .ends_with(1)
        .says(&["out/map.csv: it is not what was written", "computed again"]);
    assert_eq!(bench.read("out/map.csv"), table);
    run(&[]).ends_with(1).says(&["were computed before"]);
    // A shard is done where it is done.
    run(&["--shard", "1/4"]).ends_with(1);
    run(&["--shard", "1/4"])
        .ends_with(1)
        .says(&["all rows of `map` were computed before"]);
}

/// What is noted of a finished run is of the table that is there, and nothing else stays.
#[test]
fn notes_of_tables_that_were_replaced_go() {
    let bench = Bench::new("parts-notes");
    let run = |batch: &str| {
        bench
            .hyperstat(&["run", batch, "--out", "out"])
            .ends_with(1)
    };
    let origins = || {
        let mut names = bench.names("out/parts");
        names.retain(|name| name.ends_with(".json"));
        names.len()
    };
    let (long, short) = (
        MAP,
        "Grid(x: (-0.45, 0.45, 21), y: (-0.4, 0.4, 11), z: (0.45, 0.55, 2))",
    );
    for poses in [long, short, long] {
        bench.file("map.ron", &delta_batch("map", poses, ""));
        run("map.ron");
        let again = run("map.ron");
        again.says(&["all rows of `map` were computed before"]);
        assert!(!again.err().contains("replaced"), "{}", again.err());
        assert_eq!((bench.names("out/parts/map").len(), origins()), (1, 1));
    }
    // Batches beside one another, each with a table of its own.
    bench.file("other.ron", &delta_batch("other", short, ""));
    run("other.ron");
    for (batch, told) in [("map.ron", "`map`"), ("other.ron", "`other`")] {
        run(batch).says(&[&format!("all rows of {told} were computed before")]);
    }
    assert_eq!(origins(), 2);
    // Shards of a third one come together beside them.
    bench.file("map.ron", &delta_batch("third", short, ""));
    for shard in ["0/2", "1/2"] {
        let arguments = ["run", "map.ron", "--out", "out", "--shard", shard];
        bench.hyperstat(&arguments).ends_with(1);
    }
    bench.hyperstat(&["merge", "out"]).ends_with(1);
    assert_eq!(bench.results("out"), ["map.csv", "other.csv", "third.csv"]);
}

#[test]
fn parts_of_another_run_are_told() {
    let bench = Bench::new("parts-other");
    bench.file("map.ron", &delta_batch("map", MAP, ""));
    let run =
        |more: &[&str]| bench.hyperstat(&[&["run", "map.ron", "--out", "out"], more].concat());
    run(&["--shard", "0/2"]).ends_with(1);
    bench.file("map.ron", &delta_batch("map", MAP, "modes: 1,"));
    let refused = run(&["--shard", "1/2"]).ends_with(2);
    refused.says(&[
        "error: out: parts/map has parts of another run: map.ron was another then",
        "write to another folder, or give `--fresh`",
    ]);
    run(&["--shard", "1/2", "--fresh"]).ends_with(1);
    let mixed = bench.hyperstat(&["merge", "out"]).ends_with(2);
    mixed.says(&["are parts of different runs: map.ron was another then"]);
    run(&["--shard", "0/2", "--fresh"]).ends_with(1);
    bench.hyperstat(&["merge", "out"]).ends_with(1);
    let nothing = bench.hyperstat(&["merge", "none"]).ends_with(2);
    nothing.says(&["none: there are no parts of a run", "--shard 0/4"]);
    assert!(!bench.path("none").exists());
}

#[test]
fn a_job_may_be_called_as_files_of_parts_are() {
    let bench = Bench::new("parts-names");
    for name in ["_run-1", "parts", "_000000000000-000000000902.json"] {
        bench.file("map.ron", &delta_batch(name, MAP, ""));
        bench
            .hyperstat(&["run", "map.ron", "--out", "whole"])
            .ends_with(1);
        let _ = fs::remove_dir_all(bench.path("out"));
        for shard in ["0/2", "1/2"] {
            bench
                .hyperstat(&["run", "map.ron", "--out", "out", "--shard", shard])
                .ends_with(1);
        }
        bench.hyperstat(&["merge", "out"]).ends_with(1);
        let table = format!("{name}.csv");
        let tables = ["out", "whole"].map(|folder| fs::read(bench.path(folder).join(&table)));
        assert_eq!(tables[0].as_ref().unwrap(), tables[1].as_ref().unwrap());
        bench
            .hyperstat(&["run", "map.ron", "--out", "pieces", "--secure", "0"])
            .ends_with(1);
    }
}

/// A part that is done writes again what was read for it, where that is lost.
#[test]
fn what_was_read_is_written_again() {
    let bench = Bench::new("parts-origin");
    bench.file("map.ron", &delta_batch("map", MAP, ""));
    let run = || {
        bench
            .hyperstat(&["run", "map.ron", "--out", "out", "--shard", "0/1"])
            .ends_with(1)
    };
    run();
    for name in bench.names("out/parts") {
        if name.ends_with(".json") {
            fs::write(bench.path("out/parts").join(name), "{}").unwrap();
        }
    }
    let lost = bench.hyperstat(&["merge", "out"]).ends_with(2);
    lost.says(&[
        "cannot be used",
        "with the files and options of one of the parts",
    ]);
    run().says(&["all rows of `map` were computed before"]);
    bench.hyperstat(&["merge", "out"]).ends_with(1);
}

#[test]
fn mistakes_are_told_with_what_would_be_right() {
    let bench = Bench::new("parts-mistakes");
    bench.file("map.ron", &delta_batch("map", MAP, ""));
    let last =
        format!("there is no row {ROWS}: `map`, the longest job, has {ROWS}, counted from 0");
    for (arguments, told) in [
        (
            &["--shard", "5/4"][..],
            "shards are counted from 0: the last of 4 is `3/4`",
        ),
        (
            &["--shard", "4/4"],
            "shards are counted from 0: the last of 4 is `3/4`",
        ),
        (
            &["--shard", "0/0"],
            "a run has at least one shard: `0/1` is all of it",
        ),
        (
            &["--shard", "-1/4"],
            "give a shard and their number, such as `0/4`",
        ),
        (
            &["--shard", "third"],
            "give a shard and their number, such as `0/4`",
        ),
        (&["--shard", "auto"], "SLURM_ARRAY_TASK_ID is not set"),
        (&["--shard", "0/2", "--rows", "0..5"], "cannot be used with"),
        (
            &["--rows", "5"],
            "give the first row and that after the last, such as `0..1000`",
        ),
        (
            &["--rows", "5..5"],
            "there is no row in it: `5..6` is row 5 alone",
        ),
        (
            &["--rows", "9..5"],
            "it ends before it begins: did you mean `5..9`?",
        ),
        (&["--rows", "900..903"], &last),
        (&["--rows", "5..903"], "give `--rows 5..902`"),
        (&["--rows", "2000..2001"], "choose from `--rows 0..902`"),
        (
            &["--secure", "-1"],
            "give a number of seconds that is not negative",
        ),
        (
            &["--secure", "soon"],
            "give a number of seconds that is not negative",
        ),
    ] {
        let all = [&["run", "map.ron", "--out", "out"], arguments].concat();
        bench.hyperstat(&all).ends_with(2).says(&[told]);
        assert!(!bench.path("out").exists(), "{arguments:?}");
    }
    // More shards than rows: some have none.
    let none = bench
        .hyperstat(&["run", "map.ron", "--out", "out", "--shard", "0/5000"])
        .ends_with(0);
    assert_eq!(
        none.out(),
        format!("map: none of its {ROWS} rows, all solved\n")
    );
}

#[test]
fn a_task_of_a_job_array_has_its_shard() {
    let bench = Bench::new("parts-slurm");
    bench.file("map.ron", &delta_batch("map", MAP, ""));
    let task = |id: &str| {
        std::process::Command::new(env!("CARGO_BIN_EXE_hyperstat"))
            .args(["run", "map.ron", "--out", "out", "--shard", "auto"])
            .envs([
                ("SLURM_ARRAY_TASK_ID", id),
                ("SLURM_ARRAY_TASK_MIN", "1"),
                ("SLURM_ARRAY_TASK_MAX", "5"),
                ("SLURM_ARRAY_TASK_STEP", "2"),
                ("SLURM_ARRAY_TASK_COUNT", "3"),
            ])
            .current_dir(bench.path("."))
            .output()
            .unwrap()
    };
    for id in ["1", "3", "5"] {
        assert!(task(id).status.code().is_some_and(|code| code < 2));
    }
    let wrong = task("4");
    assert_eq!(wrong.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&wrong.stderr).contains("such as `--array=0-9`"));
    bench.hyperstat(&["merge", "out"]).ends_with(1);
    bench
        .hyperstat(&["run", "map.ron", "--out", "whole"])
        .ends_with(1);
    assert_eq!(results(&bench, "out"), results(&bench, "whole"));
}

#[test]
fn a_dry_run_writes_nothing() {
    let bench = Bench::new("parts-dry");
    let vary = r#"vary: { "rod.section.diameter": [0.014, 0.016] },"#;
    bench.file("map.ron", &delta_batch("map", MAP, vary));
    let dry = bench
        .hyperstat(&["run", "map.ron", "--out", "out", "--dry-run"])
        .ends_with(0);
    for part in [
        "map: 2 designs of 902 poses, 1804 rows, about ",
        " a row (measured on 1804)",
        "rows   1804\n",
        "time   about ",
        "size   up to about 1.3 MB\n",
        "shards none needed: it takes less than ten minutes\n",
    ] {
        assert!(dry.out().contains(part), "no `{part}` in\n{}", dry.out());
    }
    let part = [
        "run",
        "map.ron",
        "--out",
        "out",
        "--dry-run",
        "--shard",
        "0/2",
    ];
    let part = bench.hyperstat(&part).ends_with(0);
    assert!(
        part.out().contains(" rows of 1804, about "),
        "{}",
        part.out()
    );
    // Of very many rows it is what one wants to know.
    let many = "Grid(x: (-0.1, 0.1, 2001), y: (-0.1, 0.1, 2001), z: (0.4, 0.5, 1001))";
    bench.file("many.ron", &delta_batch("many", many, ""));
    let dry = bench
        .hyperstat(&["run", "many.ron", "--out", "out", "--dry-run"])
        .ends_with(0);
    assert!(
        dry.out().contains("of about ten minutes each, `--shard 0/"),
        "{}",
        dry.out()
    );
    assert!(!bench.path("out").exists());
}
