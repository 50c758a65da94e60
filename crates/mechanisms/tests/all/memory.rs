//! Files from memory: all that is read comes from there, and means what it means on a disk.

use std::path::{Path, PathBuf};

use hyperstat_mechanisms::{
    Batch, Disk, Files, MemoryFiles, Registry, load, load_batch, load_mechanism, load_str,
};

/// The examples as they lie on the disk, under another name.
fn examples() -> MemoryFiles {
    let names = [
        "designs.ron",
        "five_bar.ron",
        "five_bar_drives.csv",
        "five_bar_sweep.ron",
        "flexible_link.csv",
        "flexible_link.ron",
        "paper.ron",
        "portal.ron",
        "trajectory.csv",
    ];
    let file = |name: &str| {
        let content = std::fs::read(Path::new("../../examples").join(name)).unwrap();
        (Path::new("nowhere").join(name), content)
    };
    names.into_iter().map(file).collect()
}

/// All that a batch says, at every pose of every design.
fn whole(batch: &Batch) -> String {
    let mut text = String::new();
    for job in &batch.jobs {
        text += &format!("{} {:?} {:?}\n", job.name, job.figures, job.commanded());
        for design in 0..job.designs().min(5) {
            let design = job.design(design).unwrap();
            let model = design.model().unwrap();
            text += &format!("{:?} {:?}\n", model.segments(), model.joints());
            let mut geometry = model.geometry().clone();
            for pose in 0..design.len().min(5) {
                let placed = design.place(pose, &mut geometry);
                text += &format!("{placed:?} {geometry:?}\n");
            }
        }
    }
    text
}

#[test]
fn batches_from_memory_are_those_of_the_disk() {
    let registry = Registry::builtin();
    for (name, named) in [
        ("designs.ron", &["portal.ron"][..]),
        ("paper.ron", &["trajectory.csv"]),
        (
            "five_bar_sweep.ron",
            &["five_bar.ron", "five_bar_drives.csv"],
        ),
    ] {
        let memory = Path::new("nowhere").join(name);
        let memory = load_batch(&memory, &examples(), &registry).unwrap();
        let disk = load_batch(&Path::new("../../examples").join(name), &Disk, &registry).unwrap();
        assert!(whole(&memory) == whole(&disk), "{name}");
        let mut read: Vec<PathBuf> = (named.iter().chain([&name]))
            .map(|name| Path::new("nowhere").join(name))
            .collect();
        read.sort();
        assert_eq!(memory.files(), read);
    }
}

#[test]
fn a_mechanism_and_its_table_from_memory() {
    let registry = Registry::builtin();
    let memory = load_mechanism(
        Path::new("nowhere/flexible_link.ron"),
        &examples(),
        &registry,
    );
    let disk = Path::new("../../examples/flexible_link.ron");
    let disk = load_mechanism(disk, &Disk, &registry).unwrap();
    let memory = memory.unwrap();
    assert_eq!(
        format!("{:?}", memory.model.bodies()),
        format!("{:?}", disk.model.bodies())
    );
    assert_eq!(
        memory.files(),
        ["flexible_link.csv", "flexible_link.ron"].map(|name| Path::new("nowhere").join(name))
    );
}

/// What a design names is read when it is made: from the same files, whatever has become of them.
#[test]
fn designs_are_read_from_the_files_of_their_job() {
    let text = r#"(jobs: [(name: "j", mechanism: File("flexible_link.ron"),
        vary: { "bodies.arm.stiffness": [Csv("flexible_link.csv"), Csv("double.csv")] })])"#;
    let mut files = examples();
    let table = std::fs::read_to_string("../../examples/flexible_link.csv").unwrap();
    let doubled = table.lines().map(|line| {
        let double = |cell: &str| match cell.trim().parse::<f64>() {
            Ok(number) => format!("{:?}", 2.0 * number),
            Err(_) => cell.to_owned(),
        };
        line.split(',').map(double).collect::<Vec<_>>().join(",")
    });
    files.insert("nowhere/double.csv", doubled.collect::<Vec<_>>().join("\n"));
    files.insert("nowhere/batch.ron", text);
    let batch = load_batch(Path::new("nowhere/batch.ron"), &files, &Registry::builtin()).unwrap();
    drop(files);
    let entry = |design: usize| {
        let model = batch.jobs[0].design(design).unwrap().model().unwrap();
        model.flexibles()[0].element.stiffness()[(0, 0)]
    };
    assert!((entry(1) / entry(0) - 2.0).abs() < 1e-12);
}

#[test]
fn a_file_that_was_not_handed_in() {
    let registry = Registry::builtin();
    let none = MemoryFiles::new();
    let error = load(Path::new("a.ron"), &none, &registry).unwrap_err();
    assert_eq!(
        error.to_string(),
        "a.ron: cannot be read: no file of this name was handed in"
    );
    let batch = r#"(jobs: [(name: "j", mechanism: File("sub/portal.ron"))])"#;
    let error = load_str(batch, Path::new("here/b.ron"), &none, &registry).unwrap_err();
    assert_eq!(
        error.to_string(),
        "here/b.ron:1:37: cannot read here/sub/portal.ron: no file of this name was handed in"
    );
    assert_eq!(
        error.help(),
        Some("a path is relative to the folder of the file that names it")
    );
}

/// As on a disk, nothing is shown of a file outside of the folder that is not what it was taken for.
#[test]
fn a_file_from_elsewhere_is_not_shown() {
    let registry = Registry::builtin();
    let batch = |path: &str| format!(r#"(jobs: [(name: "j", mechanism: File("{path}"))])"#);
    let mut files = MemoryFiles::new();
    for name in ["here/secret", "secret"] {
        files.insert(name, "password\n");
    }
    let message = |path: &str| {
        let read = load_str(&batch(path), Path::new("here/b.ron"), &files, &registry);
        read.unwrap_err().to_string()
    };
    assert!(!message("./secret").contains("not shown"));
    assert!(message("../secret").contains("not shown"));
    assert!(files.resolve(Path::new("here/../secret")).unwrap() == Path::new("secret"));
}
