//! Every command over every mechanism and batch of the repository: an answer with a documented exit
//! status, and never a panic.

use std::path::{Path, PathBuf};

use hyperstat_mechanisms::{Disk, Input, Registry, load};

use super::support::{Bench, Outcome};

/// A file, and the jobs of a batch.
struct File {
    path: PathBuf,
    jobs: Vec<String>,
}

/// The files of a folder of the repository.
fn files(folder: &str) -> Vec<File> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(folder);
    let mut files = Vec::new();
    for entry in folder.read_dir().unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "ron") {
            let path = path.canonicalize().unwrap();
            let jobs = match load(&path, &Disk, &Registry::builtin()).unwrap() {
                Input::Batch(batch) => batch.jobs.into_iter().map(|job| job.name).collect(),
                Input::Mechanism(_) => Vec::new(),
            };
            files.push(File { path, jobs });
        }
    }
    files.sort_by(|a, b| a.path.cmp(&b.path));
    assert!(!files.is_empty());
    files
}

/// Runs a command on a file; its exit status must be one of these, and an error must be told.
fn run(bench: &Bench, words: &[&str], file: &Path, chosen: &[&str], statuses: &[i32]) -> Outcome {
    let file = file.to_str().unwrap();
    let mut command = vec![words[0], file];
    command.extend(&words[1..]);
    command.extend(chosen);
    let outcome = bench.hyperstat(&command);
    let (status, said) = (outcome.status(), outcome.err());
    assert!(statuses.contains(&status), "{command:?}: {status}\n{said}");
    assert!(!said.contains("panicked"), "{command:?}:\n{said}");
    assert_eq!(said.contains("error"), status > 1, "{command:?}:\n{said}");
    outcome
}

/// The commands that tell of one mechanism: a file, or a job of one. All these can be solved; modes
/// need densities, the dense solver takes small models only, and a flexible body's table cannot be
/// written into a file.
fn told(bench: &Bench, file: &Path, chosen: &[&str]) {
    let run = |words: &[&str], statuses: &[i32]| run(bench, words, file, chosen, statuses);
    run(&["check"], &[0]);
    run(&["solve", "--why", "--modes", "3", "--verify"], &[0, 2]);
    let json = ["solve", "--why", "--all-nodes", "--format", "json"];
    run(&[&json[..], &["--vtu", "solved.vtu"]].concat(), &[0]).json();
    run(&["export", "--out", "exported.ron"], &[0, 2]);
}

/// The figures of one mechanism.
fn drawn(bench: &Bench, file: &Path) {
    let run = |words: &[&str], statuses: &[i32]| run(bench, words, file, &[], statuses);
    run(&["plot", "--budget", "--out", "budget"], &[0]);
    run(&["plot", "--deformed", "--out", "deformed"], &[0]);
    run(&["plot", "--mode", "1", "--out", "mode"], &[0, 2]);
}

/// A batch run, and its tables drawn.
fn run_and_drawn(bench: &Bench, file: &File) {
    run(
        bench,
        &["run", "--out", "out", "--summary"],
        &file.path,
        &[],
        &[0, 1],
    );
    for job in &file.jobs {
        let table = bench.path(&format!("out/{job}.csv"));
        for kind in [
            ["plot", "--map", "k33"].as_slice(),
            &["plot", "--lines", "deflection,k11"],
            &["plot", "--trajectory"],
        ] {
            // Not every table has what a figure is of.
            run(bench, kind, &table, &[], &[0, 2]);
        }
    }
}

#[test]
fn every_command_on_every_reference_file() {
    let bench = Bench::new("everything-reference");
    for file in files("tests/reference") {
        told(&bench, &file.path, &[]);
    }
}

#[test]
fn every_command_on_every_example_of_a_mechanism() {
    let bench = Bench::new("everything-examples");
    for file in files("examples").iter().filter(|file| file.jobs.is_empty()) {
        told(&bench, &file.path, &[]);
        drawn(&bench, &file.path);
    }
}

#[test]
fn every_command_on_every_job_of_the_examples() {
    let bench = Bench::new("everything-jobs");
    for file in files("examples") {
        for job in &file.jobs {
            let path = file.path.to_str().unwrap();
            let in_reach = |pose: &&str| {
                let check = ["check", path, "--job", job, "--pose", pose];
                bench.hyperstat(&check).status() == 0
            };
            let pose = ["0", "40"].into_iter().find(in_reach);
            let pose = pose.unwrap_or_else(|| panic!("{path}, {job}: no pose in reach"));
            told(&bench, &file.path, &["--job", job, "--pose", pose]);
        }
    }
}

#[test]
fn every_example_of_a_batch_is_run_and_drawn() {
    let bench = Bench::new("everything-batches");
    for file in files("examples")
        .iter()
        .filter(|file| !file.jobs.is_empty())
    {
        run_and_drawn(&bench, file);
    }
}

/// Of broken files `check` and `solve` say what is wrong, and `check` ends as `solve` does.
#[test]
fn broken_files_are_refused_by_every_command() {
    let bench = Bench::new("everything-broken");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../mechanisms/tests/broken");
    let mut count = 0;
    for entry in folder.read_dir().unwrap() {
        let path = entry.unwrap().path().canonicalize().unwrap();
        // A few of each kind: the messages themselves are tested with the loader.
        if path.extension().is_some_and(|extension| extension == "ron") {
            count += 1;
            if count % 8 == 0 {
                let checked = run(&bench, &["check"], &path, &[], &[0, 2]).status();
                run(&bench, &["solve"], &path, &[], &[checked]);
                run(&bench, &["run", "--out", "out"], &path, &[], &[0, 1, 2]);
                run(&bench, &["export"], &path, &[], &[0, 2]);
            }
        }
    }
    assert!(count > 300);
}
