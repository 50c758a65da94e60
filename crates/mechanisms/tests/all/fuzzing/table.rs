//! A text as every kind of table that a mechanism or batch names.

use std::fs;

use hyperstat_mechanisms::{Disk, Registry, load_str};

use super::folder::Folder;
use super::{check_error, solve};

/// What names a table: the poses of a prebuilt mechanism of three and of six coordinates, those of
/// a file's output and of its drives, the stiffness of a flexible body.
pub const ROLES: [fn(&str) -> String; 5] = [
    |table| job(DELTA, &format!("Csv(\"{table}\")")),
    |table| job(HEXAPOD, &format!("Csv(\"{table}\")")),
    |table| job("File(\"five_bar.ron\")", &format!("Csv(\"{table}\")")),
    |table| {
        job(
            "File(\"five_bar.ron\")",
            &format!("Drives(Csv(\"{table}\"))"),
        )
    },
    |table| FLEXIBLE.replace("TABLE", table),
];

const DELTA: &str = "Delta(
    base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60, rod_spacing: 0.12,
    arm: (section: Circle(diameter: 0.03), material: (young: 2.1e11, poisson: 0.3)),
    bar: (section: Circle(diameter: 0.02), material: (young: 2.1e11, poisson: 0.3)),
    rod: (section: Circle(diameter: 0.014), material: (young: 2.1e11, poisson: 0.3)),
)";

const HEXAPOD: &str = "CubicHexapod(
    edge: 0.6,
    leg: (
        cylinder: (section: Tube(outer: 0.06, inner: 0.045), material: (young: 2.1e11, poisson: 0.3)),
        piston: (section: Circle(diameter: 0.04), material: (young: 2.1e11, poisson: 0.3)),
        cylinder_length: 0.4, lengths: (0.5, 0.75),
    ),
)";

/// The table of `examples/flexible_link.csv` fits it.
const FLEXIBLE: &str = "(
    name: \"flexible\",
    points: { \"A\": (0.0, 0.0, 0.0), \"M\": (0.0, 0.15, 0.1), \"B\": (0.0, 0.3, 0.2) },
    bodies: { \"arm\": Flexible(points: [\"A\", \"M\", \"B\"], stiffness: Csv(\"TABLE\")) },
    joints: { \"foot\": (at: \"A\", between: (\"ground\", \"arm\"), kind: Fixed) },
    loads: [(on: (\"arm\", \"M\"), force: (20.0, 0.0, 0.0))],
    output: (\"arm\", \"B\"),
)";

fn job(mechanism: &str, poses: &str) -> String {
    format!("(jobs: [(name: \"under-test\", mechanism: {mechanism}, poses: {poses})])")
}

/// Reads a table in all its [`ROLES`]: each time the answer must be an error that points into the
/// table, or a mechanism or job with which all goes on. Says in how many it was taken.
pub fn table(bytes: &[u8], folder: &Folder) -> usize {
    let (file, name) = folder.table();
    fs::write(&file, bytes).unwrap();
    let text = String::from_utf8_lossy(bytes);
    let path = folder.text();
    let mut taken = 0;
    for role in ROLES {
        let names_it = role(&name);
        match load_str(&names_it, &path, &Disk, &Registry::builtin()) {
            Ok(input) => {
                taken += 1;
                solve::follow(&input);
            }
            Err(error) => {
                check_error(&error, &text, &file);
                check_error(&error, &names_it, &path);
            }
        }
    }
    taken
}
