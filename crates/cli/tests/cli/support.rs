//! A folder for every test, and the binary run in it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

/// A fresh folder in which a test runs the binary.
pub struct Bench {
    folder: PathBuf,
}

impl Bench {
    /// The folder of the test `name`.
    pub fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        Self { folder }
    }

    /// Writes a file into the folder.
    pub fn file(&self, name: &str, content: &str) {
        fs::write(self.folder.join(name), content).unwrap();
    }

    /// Path of a file in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Content of a file in the folder.
    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Names of the files in a folder of the folder, in order.
    pub fn names(&self, folder: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path(folder)).unwrap();
        let mut names: Vec<_> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    /// Names of the results in a folder of the folder, in order: all but what runs note of themselves.
    pub fn results(&self, folder: &str) -> Vec<String> {
        let mut names = self.names(folder);
        names.retain(|name| name != "parts");
        names
    }

    /// Runs the binary in the folder.
    pub fn hyperstat(&self, arguments: &[&str]) -> Outcome {
        self.hyperstat_into(arguments, Stdio::piped())
    }

    /// Runs the binary in the folder with its standard output in `out`.
    pub fn hyperstat_into(&self, arguments: &[&str], out: impl Into<Stdio>) -> Outcome {
        let mut command = Command::new(env!("CARGO_BIN_EXE_hyperstat"));
        command.args(arguments);
        self.output_of(command, out)
    }

    /// Runs the binary where no file can grow beyond 32 or 64 kB: writing on fails, as on a full
    /// disk. `None` where the system has no such limit.
    pub fn hyperstat_on_a_small_disk(&self, arguments: &[&str]) -> Option<Outcome> {
        if !cfg!(unix) {
            return None;
        }
        let mut command = Command::new("sh");
        command
            .args(["-c", "trap '' XFSZ; ulimit -f 64; exec \"$@\"", "sh"])
            .arg(env!("CARGO_BIN_EXE_hyperstat"))
            .args(arguments);
        Some(self.output_of(command, Stdio::piped()))
    }

    fn output_of(&self, mut command: Command, out: impl Into<Stdio>) -> Outcome {
        let child = command
            .current_dir(&self.folder)
            .stdin(Stdio::null())
            .stdout(out)
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        Outcome(child.wait_with_output().unwrap())
    }
}

/// What a run of the binary gave.
pub struct Outcome(Output);

impl Outcome {
    /// The exit status.
    pub fn status(&self) -> i32 {
        self.0.status.code().unwrap()
    }

    /// Standard output.
    pub fn out(&self) -> &str {
        std::str::from_utf8(&self.0.stdout).unwrap()
    }

    /// Standard error.
    pub fn err(&self) -> &str {
        std::str::from_utf8(&self.0.stderr).unwrap()
    }

    /// Asserts the exit status; shows everything where it is another.
    #[track_caller]
    pub fn ends_with(self, status: i32) -> Self {
        assert_eq!(
            self.status(),
            status,
            "\nstandard output:\n{}\nstandard error:\n{}",
            self.out(),
            self.err()
        );
        self
    }

    /// Standard output as JSON.
    #[track_caller]
    pub fn json(&self) -> Value {
        serde_json::from_str(self.out()).unwrap()
    }

    /// Asserts that standard error holds all of `parts`.
    #[track_caller]
    pub fn says(&self, parts: &[&str]) {
        for part in parts {
            assert!(self.err().contains(part), "no `{part}` in\n{}", self.err());
        }
    }
}

/// A table: names of its columns and cells of its rows.
pub struct Table {
    pub names: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// That of a file in the folder of a test.
    pub fn read(bench: &Bench, path: &str) -> Self {
        let text = bench.read(path);
        let cells = |line: &str| line.split(',').map(String::from).collect::<Vec<_>>();
        let mut lines = text.lines();
        let names = cells(lines.next().unwrap());
        let rows: Vec<_> = lines.map(cells).collect();
        assert!(rows.iter().all(|row| row.len() == names.len()));
        Self { names, rows }
    }

    /// A cell by the name of its column.
    pub fn cell(&self, row: usize, name: &str) -> &str {
        let column = self.names.iter().position(|known| known == name);
        &self.rows[row][column.unwrap_or_else(|| panic!("no column {name}"))]
    }

    /// The number in it.
    pub fn number(&self, row: usize, name: &str) -> f64 {
        let cell = self.cell(row, name);
        cell.parse().unwrap_or_else(|_| panic!("{name}: `{cell}`"))
    }
}

/// The numbers of a JSON array.
#[track_caller]
pub fn numbers(value: &Value) -> Vec<f64> {
    let entries = value.as_array().unwrap();
    entries
        .iter()
        .map(|entry| entry.as_f64().unwrap())
        .collect()
}

/// Asserts that two numbers agree to `tolerance` of `scale`.
#[track_caller]
pub fn assert_near(found: f64, expected: f64, tolerance: f64, scale: f64) {
    assert!(
        (found - expected).abs() <= tolerance * scale,
        "{found:e} is not {expected:e}"
    );
}

/// The mechanism file in the help: a round bar of 20 mm, 0.5 m long along x, held at one end; at the other 100 N down and a
/// torque of 10 N·m.
pub const CANTILEVER: &str = include_str!("../../help/cantilever.ron");

/// The batch file in the help: the bar with another load.
pub const BATCH: &str = include_str!("../../help/batch.ron");

/// The same bar on a hinge about y that nothing locks.
pub fn hinged() -> String {
    let hinge = "kind: Revolute(axis: (0.0, 1.0, 0.0))";
    CANTILEVER
        .replace("kind: Fixed", hinge)
        .replace("moment: (10.0, 0.0, 0.0)", "moment: (0.0, 0.0, 0.0)")
}

/// A batch of one job with the paper's delta; `rest` are more fields of the job.
pub fn delta_batch(name: &str, poses: &str, rest: &str) -> String {
    let steel = "material: (young: 2.1e11, poisson: 0.3, density: 7850.0)";
    format!(
        r#"(
    jobs: [
        (
            name: "{name}",
            mechanism: Delta(
                base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60,
                rod_spacing: 0.12,
                arm: (section: Circle(diameter: 0.030), {steel}),
                bar: (section: Circle(diameter: 0.020), {steel}),
                rod: (section: Circle(diameter: 0.014), {steel}),
            ),
            poses: {poses},
            loads: [(on: ("platform", "P"), force: (-20.0, 10.0, 100.0), moment: (5.0, 5.0, 8.0))],
            {rest}
        ),
    ],
)
"#
    )
}
