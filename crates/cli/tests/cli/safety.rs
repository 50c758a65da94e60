//! What is read stays as it is, what is no file is no trap, and nothing steers a terminal.

use std::fs;

use crate::support::{BATCH, Bench, CANTILEVER, delta_batch};

/// Poses that the delta takes, as a table.
const POSES: &str = "x,y,z\n0.0,0.0,0.45\n0.05,0.0,0.5\n";

/// A job that reads its poses from a table of its own name, for `--out .`.
fn overwriting(bench: &Bench) {
    bench.file("path.ron", &delta_batch("path", "Csv(\"path.csv\")", ""));
    bench.file("path.csv", POSES);
}

#[test]
fn a_table_of_poses_is_not_replaced_by_its_results() {
    let bench = Bench::new("safety-poses");
    overwriting(&bench);
    for out in [".", "./", "../safety-poses"] {
        let outcome = bench
            .hyperstat(&["run", "path.ron", "--out", out])
            .ends_with(2);
        outcome.says(&["path.csv would be overwritten", "it was read", "help: "]);
    }
    assert_eq!(bench.read("path.csv"), POSES);
    assert_eq!(bench.names("."), ["path.csv", "path.ron"]);
    // As a table of another form it is another file.
    bench
        .hyperstat(&["run", "path.ron", "--out", ".", "--format", "parquet"])
        .ends_with(0);
    assert_eq!(bench.read("path.csv"), POSES);
}

#[test]
fn a_table_of_a_flexible_body_and_one_of_drives_are_not_replaced() {
    let bench = Bench::new("safety-tables");
    let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
    for name in ["flexible_link", "five_bar"] {
        let text = fs::read_to_string(format!("{examples}/{name}.ron")).unwrap();
        bench.file(&format!("{name}.ron"), &text);
    }
    for name in ["flexible_link.csv", "five_bar_drives.csv"] {
        bench.file(
            name,
            &fs::read_to_string(format!("{examples}/{name}")).unwrap(),
        );
    }
    let jobs = [
        ("flexible_link", r#"mechanism: File("flexible_link.ron")"#),
        (
            "five_bar_drives",
            r#"mechanism: File("five_bar.ron"), poses: Drives(Csv("five_bar_drives.csv"))"#,
        ),
    ];
    for (job, mechanism) in jobs {
        bench.file(
            "batch.ron",
            &format!("(jobs: [(name: \"{job}\", {mechanism})])"),
        );
        let outcome = bench
            .hyperstat(&["run", "batch.ron", "--out", "."])
            .ends_with(2);
        outcome.says(&[&format!("{job}.csv would be overwritten")]);
        bench
            .hyperstat(&["run", "batch.ron", "--out", "out"])
            .ends_with(0);
    }
}

#[cfg(unix)]
#[test]
fn a_file_that_was_read_is_known_by_its_other_names() {
    use std::os::unix::fs::symlink;

    let bench = Bench::new("safety-names");
    overwriting(&bench);
    for (folder, soft) in [("soft", true), ("hard", false)] {
        fs::create_dir(bench.path(folder)).unwrap();
        let name = bench.path(&format!("{folder}/path.csv"));
        match soft {
            true => symlink("../path.csv", name).unwrap(),
            false => fs::hard_link(bench.path("path.csv"), name).unwrap(),
        }
        let outcome = bench.hyperstat(&["run", "path.ron", "--out", folder]);
        let name = format!("{folder}/path.csv would be overwritten: it was read as path.csv");
        outcome.ends_with(2).says(&[&name]);
        assert_eq!(bench.read("path.csv"), POSES);
    }
    // What `--summary` writes and figures are outputs as well.
    let figure = "figures: [Deformed(pose: 0, scale: Auto)],";
    bench.file(
        "figure.ron",
        &delta_batch("path", "Csv(\"path.csv\")", figure),
    );
    for name in ["path-deformed.png", "path-summary.json"] {
        let folder = format!("of-{name}");
        fs::create_dir(bench.path(&folder)).unwrap();
        symlink("../path.csv", bench.path(&format!("{folder}/{name}"))).unwrap();
        let outcome = bench.hyperstat(&["run", "figure.ron", "--out", &folder, "--summary"]);
        outcome
            .ends_with(2)
            .says(&[&format!("{folder}/{name} would be overwritten")]);
        assert_eq!(bench.names(&folder), [name]);
    }
}

#[test]
fn no_command_writes_what_it_reads() {
    let bench = Bench::new("safety-commands");
    bench.file("bar.ron", CANTILEVER);
    for arguments in [
        ["solve", "bar.ron", "--vtu", "bar.ron"],
        ["solve", "./bar.ron", "--vtu", "../safety-commands/bar.ron"],
        ["export", "bar.ron", "--out", "bar.ron"],
    ] {
        let outcome = bench.hyperstat(&arguments).ends_with(2);
        outcome.says(&["would be overwritten", "bar.ron"]);
        assert_eq!(outcome.out(), "", "nothing is computed");
    }
    assert_eq!(bench.read("bar.ron"), CANTILEVER);
    // A mechanism file may have any name.
    bench.file("bar.svg", CANTILEVER);
    let outcome = bench.hyperstat(&["plot", "bar.svg", "--deformed", "--out", "bar"]);
    outcome.ends_with(2).says(&["bar.svg would be overwritten"]);
    assert_eq!(bench.read("bar.svg"), CANTILEVER);
}

#[cfg(unix)]
#[test]
fn a_plot_does_not_replace_its_table() {
    use std::os::unix::fs::symlink;

    let bench = Bench::new("safety-plot");
    bench.file(
        "delta.ron",
        &delta_batch("delta", "List([(0.0, 0.0, 0.45), (0.1, 0.0, 0.45)])", ""),
    );
    bench
        .hyperstat(&["run", "delta.ron", "--out", "."])
        .ends_with(0);
    let table = bench.read("delta.csv");
    symlink("delta.csv", bench.path("delta-dx.png")).unwrap();
    let outcome = bench
        .hyperstat(&["plot", "delta.csv", "--lines", "dx"])
        .ends_with(2);
    outcome.says(&["delta-dx.png would be overwritten: it was read as delta.csv"]);
    let json = bench.hyperstat(&["solve", "delta.ron", "--why", "--format", "json"]);
    bench.file("why.json", json.ends_with(0).out());
    let kept = bench.read("why.json");
    fs::hard_link(bench.path("why.json"), bench.path("b.svg")).unwrap();
    let outcome = bench.hyperstat(&["plot", "why.json", "--budget", "--out", "b"]);
    outcome.ends_with(2).says(&["b.svg would be overwritten"]);
    assert_eq!(
        (bench.read("delta.csv"), bench.read("why.json")),
        (table, kept)
    );
}

#[cfg(unix)]
#[test]
fn links_stay_and_what_they_lead_to_is_replaced() {
    use std::os::unix::fs::symlink;

    let bench = Bench::new("safety-links");
    bench.file("bar.ron", CANTILEVER);
    bench.file("old.ron", "old");
    fs::create_dir(bench.path("below")).unwrap();
    symlink("old.ron", bench.path("link.ron")).unwrap();
    symlink("../link.ron", bench.path("below/twice.ron")).unwrap();
    symlink("new.ron", bench.path("below/none.ron")).unwrap();
    for (link, file) in [
        ("link.ron", "old.ron"),
        ("below/twice.ron", "old.ron"),
        ("below/none.ron", "below/new.ron"),
    ] {
        bench.file("old.ron", "old");
        bench
            .hyperstat(&["export", "bar.ron", "--out", link])
            .ends_with(0);
        assert!(bench.path(link).is_symlink(), "{link}");
        assert!(!bench.path(file).is_symlink());
        assert!(bench.read(file).contains("Beam"), "{link}");
    }
    symlink("ring.ron", bench.path("ring.ron")).unwrap();
    let outcome = bench.hyperstat(&["export", "bar.ron", "--out", "ring.ron"]);
    outcome.ends_with(3).says(&["cannot write ring.ron"]);
    assert!(bench.names(".").iter().all(|name| !name.ends_with(".part")));
}

#[cfg(unix)]
#[test]
fn pipes_and_standard_output_are_written_to_as_they_are() {
    use std::os::unix::fs::FileTypeExt;
    use std::process::Command;

    let bench = Bench::new("safety-pipes");
    bench.file("bar.ron", CANTILEVER);
    let wanted = bench.hyperstat(&["export", "bar.ron"]).ends_with(0);
    let outcome = bench.hyperstat(&["export", "bar.ron", "--out", "/dev/stdout"]);
    assert_eq!(outcome.ends_with(0).out(), wanted.out());
    // A file behind it is not replaced, and what is in it stays.
    let file = bench.path("out.ron");
    fs::write(&file, "// before\n").unwrap();
    let appended = fs::OpenOptions::new().append(true).open(&file).unwrap();
    bench
        .hyperstat_into(&["export", "bar.ron", "--out", "/dev/stdout"], appended)
        .ends_with(0);
    assert_eq!(
        bench.read("out.ron"),
        format!("// before\n{}", wanted.out())
    );

    let made = Command::new("mkfifo").arg(bench.path("pipe")).status();
    if !made.is_ok_and(|status| status.success()) {
        return;
    }
    let pipe = bench.path("pipe");
    let reader = std::thread::spawn(move || fs::read_to_string(pipe).unwrap());
    bench
        .hyperstat(&["export", "bar.ron", "--out", "pipe"])
        .ends_with(0);
    assert_eq!(reader.join().unwrap(), wanted.out());
    let kind = fs::symlink_metadata(bench.path("pipe"))
        .unwrap()
        .file_type();
    assert!(kind.is_fifo());

    // A whole table, too; it cannot be read again for the job's map, which is said.
    fs::create_dir(bench.path("out")).unwrap();
    fs::rename(bench.path("pipe"), bench.path("out/delta.csv")).unwrap();
    let poses = "Grid(x: (0.0, 0.1, 2), y: (0.0, 0.1, 2), z: (0.45, 0.45, 1))";
    let map = "figures: [Map(value: \"k33\", plane: z(0.45))],";
    bench.file("delta.ron", &delta_batch("delta", poses, map));
    let pipe = bench.path("out/delta.csv");
    let reader = std::thread::spawn(move || fs::read_to_string(pipe).unwrap());
    let outcome = bench
        .hyperstat(&["run", "delta.ron", "--out", "out"])
        .ends_with(0);
    assert_eq!(reader.join().unwrap().lines().count(), 5);
    assert!(
        outcome.out().contains("no delta-map: "),
        "{}",
        outcome.out()
    );
}

#[cfg(unix)]
#[test]
fn only_regular_files_are_read() {
    use std::process::Command;

    let bench = Bench::new("safety-read");
    bench.file(
        "zero.ron",
        r#"(jobs: [(name: "a", mechanism: File("/dev/zero"))])"#,
    );
    bench.file("table.ron", &delta_batch("a", "Csv(\"/dev/zero\")", ""));
    bench.file("folder.ron", &delta_batch("a", "Csv(\".\")", ""));
    let mut given = vec![
        ("zero.ron", "no regular file"),
        ("table.ron", "no regular file"),
        ("folder.ron", "is a directory"),
        ("/dev/zero", "no regular file"),
    ];
    let made = Command::new("mkfifo").arg(bench.path("pipe")).status();
    if made.is_ok_and(|status| status.success()) {
        bench.file("pipe.ron", &delta_batch("a", "Csv(\"pipe\")", ""));
        given.extend([("pipe.ron", "no regular file"), ("pipe", "no regular file")]);
        fs::rename(bench.path("pipe"), bench.path("pipe.csv")).unwrap();
        let outcome = bench.hyperstat(&["plot", "pipe.csv", "--lines", "dx"]);
        outcome.ends_with(2).says(&["pipe.csv", "no regular file"]);
        fs::rename(bench.path("pipe.csv"), bench.path("pipe")).unwrap();
    }
    for (file, says) in given {
        bench.hyperstat(&["check", file]).ends_with(2).says(&[says]);
    }
    // A file without end, or nearly.
    let large = fs::File::create(bench.path("large.csv")).unwrap();
    large.set_len((1 << 30) + 1).unwrap();
    bench.file("large.ron", &delta_batch("a", "Csv(\"large.csv\")", ""));
    for file in ["large.ron", "large.csv"] {
        let outcome = bench.hyperstat(&["solve", file]).ends_with(2);
        outcome.says(&["large.csv", "larger than 1 GiB"]);
    }
    drop(large);
    fs::remove_file(bench.path("large.csv")).unwrap();
}

#[test]
fn nothing_is_shown_of_a_file_from_elsewhere_that_is_not_understood() {
    let bench = Bench::new("safety-elsewhere");
    const SECRET: &str = "root:$6$salt$hash:19000:0:99999:7:::\nx,y,z\n";
    fs::create_dir_all(bench.path("batches/below")).unwrap();
    let flexible = r#"(jobs: [(name: "a", mechanism: File("link.ron"))])"#;
    let link = r#"(
        name: "link", points: { "A": (0.0, 0.0, 0.0), "B": (0.5, 0.0, 0.0) },
        bodies: { "link": Flexible(points: ["A", "B"], stiffness: Csv("../secret.csv")) },
        joints: { "a": (at: "A", between: ("ground", "link"), kind: Fixed) },
        output: ("link", "B"),
    )"#;
    bench.file("batches/link.ron", link);
    let batches = [
        ("poses.ron", delta_batch("a", "Csv(\"../secret.csv\")", "")),
        (
            "file.ron",
            r#"(jobs: [(name: "a", mechanism: File("../secret.csv"))])"#.into(),
        ),
        ("flexible.ron", flexible.into()),
    ];
    let secrets = [
        SECRET,
        "{\"token\": \"$6$salt$hash\"}",
        "($6$salt$hash)",
        "'$6$salt$hash'",
        "(a: 5hash)",
        "\"hash\"",
        "\u{1b}$6$salt$hash",
    ];
    for (name, batch) in batches {
        bench.file(&format!("batches/{name}"), &batch);
        for secret in secrets {
            bench.file("secret.csv", secret);
            for format in ["text", "json"] {
                let arguments = ["check", &format!("batches/{name}"), "--format", format];
                let outcome = bench.hyperstat(&arguments).ends_with(2);
                outcome.says(&["secret.csv:1:", "not understood", "not shown"]);
                for text in [outcome.out(), outcome.err()] {
                    assert!(!text.contains("hash"), "{name}:\n{text}");
                }
            }
        }
    }
    // What is a table of poses is shown where it is wrong, as is what lies beside or below the batch.
    bench.file("secret.csv", "x,y,z\n0.0,0.0,o.45\n");
    let outcome = bench
        .hyperstat(&["check", "batches/poses.ron"])
        .ends_with(2);
    outcome.says(&["secret.csv:2:9", "`o.45`", "0.0,0.0,o.45"]);
    bench.file("batches/below/own.csv", "here: mine\n");
    bench.file(
        "batches/own.ron",
        &delta_batch("a", "Csv(\"below/own.csv\")", ""),
    );
    let outcome = bench.hyperstat(&["check", "batches/own.ron"]).ends_with(2);
    outcome.says(&["here: mine"]);
}

#[test]
fn cells_of_text_are_no_formulas() {
    let bench = Bench::new("safety-formulas");
    let names = ["=1+1", "-push", "+pull", "@a", "plain"];
    let case =
        |name: &&str| format!("\"{name}\": [(on: (\"bar\", \"B\"), force: (0.0, 0.0, 1.0))]");
    let cases: Vec<_> = names.iter().map(case).collect();
    let materials = "materials: { \"@steel\": (young: 2.1e11, poisson: 0.3), ";
    let text = CANTILEVER.replace("materials: { ", materials);
    assert_ne!(text, CANTILEVER);
    bench.file("bar.ron", &text);
    bench.file(
        "batch.ron",
        &format!(
            "(jobs: [(name: \"bar\", mechanism: File(\"bar.ron\"), cases: {{ {} }}, \
             vary: {{ \"bodies.bar.material\": [\"steel\", \"@steel\"] }})])",
            cases.join(", ")
        ),
    );
    bench
        .hyperstat(&["run", "batch.ron", "--out", "."])
        .ends_with(0);
    let table = bench.read("bar.csv");
    for name in [
        "\"'=1+1.dx\"",
        "\"'-push.dx\"",
        "\"'+pull.dx\"",
        "\"'@a.dx\"",
        ",plain.dx,",
    ] {
        assert!(
            table.lines().next().unwrap().contains(name),
            "no {name} in {table}"
        );
    }
    let last: Vec<_> = table
        .lines()
        .skip(1)
        .map(|line| line.rsplit(',').next().unwrap())
        .collect();
    assert_eq!(last, ["steel", "\"'@steel\""]);
    // Numbers are numbers, and `plot` knows the names as they are.
    assert!(table.contains(",-"));
    bench
        .hyperstat(&["plot", "bar.csv", "--lines=-push.dz", "--over", "design"])
        .ends_with(0);
}

/// A text with a byte that steers a terminal, as RON writes it.
const STEERING: &str = "a\\u{1b}[2J\\u{9b}31m\\u{7}\\u{202e}b";

#[track_caller]
fn steers_nothing(text: &str) {
    let steers = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
    assert!(!text.contains(steers), "{text:?}");
}

#[test]
fn names_steer_no_terminal() {
    let bench = Bench::new("safety-terminal");
    let steering = CANTILEVER.replace("\"bar\"", &format!("\"{STEERING}\""));
    let steering = steering.replace("name: \"", &format!("name: \"{STEERING}"));
    bench.file("bar.ron", &steering);
    for command in [
        &["solve", "bar.ron"][..],
        &["solve", "bar.ron", "--why"],
        &["check", "bar.ron"],
        &["export", "bar.ron"],
        &["solve", "bar.ron", "--format", "json"],
        &["plot", "bar.ron", "--deformed"],
    ] {
        let outcome = bench.hyperstat(command).ends_with(0);
        steers_nothing(outcome.out());
        steers_nothing(outcome.err());
        assert!(
            outcome.out().contains("1b") || command[0] == "plot",
            "{}",
            outcome.out()
        );
    }
    let json = bench
        .hyperstat(&["solve", "bar.ron", "--format", "json"])
        .json();
    let name = "a\u{1b}[2J\u{9b}31m\u{7}\u{202e}b.B";
    assert!(json["displacements"][name].is_array(), "{json}");
    let exported = bench.hyperstat(&["export", "bar.ron"]);
    bench.file("again.ron", exported.out());
    let again = bench
        .hyperstat(&["solve", "again.ron", "--format", "json"])
        .ends_with(0);
    assert!(again.json()["displacements"][name].is_array());
}

#[test]
fn mistakes_steer_no_terminal() {
    let bench = Bench::new("safety-mistakes");
    // The bytes themselves, in the file and in its name.
    let raw = "st\u{1b}[2Jeel";
    let wrong = CANTILEVER.replace("material: \"steel\"", &format!("material: \"{raw}\""));
    assert_ne!(wrong, CANTILEVER);
    for name in ["plain.ron", "a\u{1b}[31m.ron"] {
        bench.file(name, &wrong);
        let outcome = bench.hyperstat(&["solve", name]).ends_with(2);
        steers_nothing(outcome.err());
        outcome.says(&["st\\u{1b}[2Jeel", "^"]);
    }
    let outcome = bench
        .hyperstat(&["solve", "none\u{1b}[2J.ron"])
        .ends_with(2);
    steers_nothing(outcome.err());
    let outcome = bench
        .hyperstat(&["solve", "a.ron", "b\u{1b}[2J.ron"])
        .ends_with(2);
    steers_nothing(outcome.err());
    outcome.says(&["unexpected argument 'b"]);
}

#[test]
fn what_a_dead_run_left_is_removed() {
    let bench = Bench::new("safety-dead");
    bench.file("bar.ron", CANTILEVER);
    bench.file(
        "batch.ron",
        r#"(jobs: [(name: "bar", mechanism: File("bar.ron"))])"#,
    );
    fs::create_dir(bench.path("out")).unwrap();
    for left in [
        ".bar.csv.1.part",
        ".bar.csv.4294967295-2.part",
        ".other.csv.1.part",
    ] {
        bench.file(&format!("out/{left}"), "half");
    }
    bench
        .hyperstat(&["run", "batch.ron", "--out", "out"])
        .ends_with(0);
    assert_eq!(bench.results("out"), [".other.csv.1.part", "bar.csv"]);
}

#[test]
fn a_job_whose_files_cannot_have_their_names_is_told_before_the_first_runs() {
    let bench = Bench::new("safety-long");
    bench.file("cantilever.ron", CANTILEVER);
    let long = BATCH.replace("name: \"bar\"", &format!("name: \"{}\"", "a".repeat(240)));
    assert_ne!(long, BATCH);
    let first = r#"jobs: [(name: "first", mechanism: File("cantilever.ron")),"#;
    bench.file("long.ron", &long.replace("jobs: [", first));
    let outcome = bench
        .hyperstat(&["run", "long.ron", "--out", "out"])
        .ends_with(2);
    outcome.says(&["long.ron:", "is too long", "help: ", "characters"]);
    assert!(!bench.path("out").exists());
    let fits = BATCH.replace("name: \"bar\"", &format!("name: \"{}\"", "a".repeat(200)));
    bench.file("fits.ron", &fits);
    bench
        .hyperstat(&["run", "fits.ron", "--out", "out"])
        .ends_with(0);
}

#[test]
fn a_run_of_very_many_rows_needs_a_word() {
    let bench = Bench::new("safety-many");
    let poses = "Grid(x: (0.0, 0.1, 1001), y: (0.0, 0.1, 1001), z: (0.4, 0.5, 1001))";
    bench.file("many.ron", &delta_batch("many", poses, ""));
    let outcome = bench
        .hyperstat(&["run", "many.ron", "--out", "out"])
        .ends_with(2);
    outcome.says(&["1003003001 rows", "GB", "--yes"]);
    assert!(!bench.path("out").exists());
    bench.file(
        "few.ron",
        &delta_batch("few", "List([(0.0, 0.0, 0.45)])", ""),
    );
    bench
        .hyperstat(&["run", "few.ron", "--out", "out", "--yes"])
        .ends_with(0);
}

#[test]
fn threads_are_as_many_as_make_sense() {
    let bench = Bench::new("safety-threads");
    bench.file(
        "few.ron",
        &delta_batch("few", "List([(0.0, 0.0, 0.45)])", ""),
    );
    bench
        .hyperstat(&["run", "few.ron", "--out", "out", "--threads", "1000000"])
        .ends_with(0);
}

#[test]
fn a_run_says_once_a_job_what_is_hardly_meant() {
    let bench = Bench::new("safety-plausible");
    bench.file(
        "few.ron",
        &delta_batch("few", "List([(0.0, 0.0, 0.45), (0.0, 0.1, 0.45)])", ""),
    );
    let outcome = bench
        .hyperstat(&["run", "few.ron", "--out", "out"])
        .ends_with(0);
    assert!(!outcome.out().contains("warning"), "{}", outcome.out());
    let wrong = bench.read("few.ron").replace("2.1e11", "210.0");
    bench.file("few.ron", &wrong);
    let outcome = bench
        .hyperstat(&["run", "few.ron", "--out", "out"])
        .ends_with(0);
    for part in ["warning: Young's modulus of `", "GPa", " moves by "] {
        assert_eq!(
            outcome.out().matches(part).count(),
            1,
            "{part} in {}",
            outcome.out()
        );
    }
    for (command, found) in [("solve", true), ("check", false)] {
        let outcome = bench
            .hyperstat(&[command, "few.ron", "--format", "json"])
            .ends_with(0);
        let warnings = outcome.json()["warnings"].to_string();
        assert!(
            warnings.contains("Young's modulus"),
            "{command}: {warnings}"
        );
        assert_eq!(
            warnings.contains("moves by"),
            found,
            "{command}: {warnings}"
        );
    }
}
