//! The table's one schema: names of its columns, in their order, with units and in words.

mod asked;

use hyperstat_mechanisms::{Job, Varied};

use asked::AT;
#[cfg(feature = "figures")]
pub(crate) use asked::asking_for;
pub(crate) use asked::{DEFORMATIONS, Group, Worst, drives};

/// Name of the column with the number of the pose, from 0.
pub(crate) const POSE: &str = "pose";

/// Names of the columns of the output's pose: position \[m\], rotation vector \[rad\].
pub(crate) const COORDINATES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// Name of the column that says how a pose came out.
pub(crate) const STATUS: &str = "status";

/// Names of the columns of the output's displacement \[m, rad\]; those of a case follow its name and a
/// point.
pub(crate) const DISPLACEMENT: [&str; 6] = ["dx", "dy", "dz", "drx", "dry", "drz"];

/// Names of the columns of the output's stiffness: the upper triangle by rows.
pub(crate) fn stiffness() -> impl Iterator<Item = String> {
    (1..=6).flat_map(|row| (row..=6).map(move |column| format!("k{row}{column}")))
}

/// Name of the column of a job that varies with the number of the design.
pub(crate) const DESIGN: &str = "design";

/// The columns of a job's table that not every job has.
#[derive(Debug, Default)]
pub struct Columns<'a> {
    /// Names of what is found beside these, after the stiffness.
    pub further: Vec<String>,
    /// How many of them, the last, the job has asked for.
    pub asked: usize,
    /// The drives whose values the poses are, after these.
    pub drives: &'a [String],
    /// What varies from design to design, last.
    pub varied: &'a [Varied],
}

impl<'a> Columns<'a> {
    /// Those of a job.
    pub fn of(job: &'a Job) -> Self {
        let cases = job.cases().iter();
        let cases = cases.flat_map(|case| DISPLACEMENT.map(|part| format!("{case}.{part}")));
        let count = job.modes.as_ref().map_or(0, |options| options.count);
        let mut further: Vec<String> = cases.chain(frequencies(count)).collect();
        let known = further.len();
        let groups = Group::all(job);
        further.extend(groups.iter().flat_map(|group| group.names(job.cases())));
        Self {
            asked: further.len() - known,
            further,
            drives: job.drives(),
            varied: job.varied(),
        }
    }
}

/// Names of the columns of natural frequencies.
fn frequencies(count: usize) -> impl Iterator<Item = String> {
    (1..=count).map(|k| format!("f{k}"))
}

/// Names of the columns: the number of the pose, the pose, the status, and the numbers found; of a
/// job whose poses are values of drives these after them; of a job that varies the number of the design
/// and its values last.
pub fn columns(columns: &Columns<'_>) -> impl Iterator<Item = String> {
    let varied = columns.varied;
    let first = [POSE].into_iter().chain(COORDINATES);
    let first = first.chain([STATUS]).chain(DISPLACEMENT);
    let design = (!varied.is_empty()).then(|| DESIGN.to_owned());
    let values = varied.iter().map(|varied| varied.path.clone());
    let found = first.map(String::from).chain(stiffness());
    let found = found.chain(columns.further.iter().cloned());
    let found = found.chain(columns.drives.iter().cloned());
    found.chain(design).chain(values)
}

/// Names of the columns that hold numbers.
pub fn numeric(of: &Columns<'_>) -> Vec<String> {
    let is_text = |name: &String| {
        let mut varied = of.varied.iter();
        name == STATUS
            || of.further.contains(name) && holds_words(name)
            || varied.any(|varied| varied.path == *name && !varied.numeric)
    };
    columns(of).filter(|name| !is_text(name)).collect()
}

/// Whether what is found of a pose by this name is a text.
pub(crate) fn holds_words(name: &str) -> bool {
    let last = name.rsplit('.').next().unwrap_or(name);
    [Worst::Stress, Worst::Utilisation]
        .iter()
        .any(|worst| last.strip_prefix(worst.name()) == Some(AT[0]))
}

/// Row and column, from 1, of a stiffness column `k11` to `k66`.
pub(crate) fn entry(name: &str) -> Option<[usize; 2]> {
    let digits: Vec<usize> = (name.strip_prefix('k')?.chars())
        .map(|c| {
            c.to_digit(10)
                .filter(|d| (1..=6).contains(d))
                .map(|d| d as usize)
        })
        .collect::<Option<_>>()?;
    digits.try_into().ok()
}

/// The SI unit of a column; empty where it has none or is unknown.
pub fn unit(name: &str) -> &'static str {
    if let Some([row, column]) = entry(name) {
        return match (row > 3, column > 3) {
            (false, false) => "N/m",
            (false, true) => "N/rad",
            (true, false) => "N",
            (true, true) => "N·m/rad",
        };
    }
    if let Some(unit) = asked::unit(name) {
        return unit;
    }
    let last = name.rsplit('.').next().unwrap_or(name);
    let stiffness = name.contains("stiffness");
    let linear = |names: &[&str; 6]| names[..3].contains(&last);
    let angular = |names: &[&str; 6]| names[3..].contains(&last);
    match last {
        "x" | "y" | "z" if stiffness => "N/m",
        "u" | "v" | "w" | "drive_stiffness" if stiffness => "N·m/rad",
        _ if linear(&COORDINATES) || linear(&DISPLACEMENT) => "m",
        // Of a drive.
        "u" | "v" | "w" => "rad",
        _ if angular(&COORDINATES) || angular(&DISPLACEMENT) => "rad",
        "diameter" | "outer" | "inner" | "width" | "height" | "thickness" => "m",
        "young" | "shear" | "yield" => "Pa",
        "density" => "kg/m³",
        _ if is_frequency(last) => "Hz",
        _ if ["_length", "_radius", "_spacing"]
            .iter()
            .any(|end| last.ends_with(end)) =>
        {
            "m"
        }
        _ => "",
    }
}

/// Whether a column is a natural frequency: `f1`, `f2` …
pub fn is_frequency(name: &str) -> bool {
    let number = name.strip_prefix('f').unwrap_or_default();
    !number.is_empty() && number.chars().all(|c| c.is_ascii_digit())
}

/// What a column is, in words.
pub fn words(name: &str) -> String {
    const AXES: [&str; 3] = ["x", "y", "z"];
    if let Some([row, column]) = entry(name) {
        let of =
            |k: usize, words: [&str; 2]| format!("{} {}", words[(k - 1) / 3], AXES[(k - 1) % 3]);
        let force = of(row, ["force along", "moment about"]);
        let motion = of(column, ["displacement along", "rotation about"]);
        return format!("{force} per {motion}, all other displacements zero");
    }
    if let Some(words) = asked::words(name) {
        return words;
    }
    let (case, last) = match name.rsplit_once('.') {
        Some((case, last)) => (format!(", case {case}"), last),
        None => (String::new(), name),
    };
    let axis = |rest: &str| AXES.contains(&rest);
    match (last.strip_prefix("dr"), last.strip_prefix('d')) {
        (Some(rest), _) if axis(rest) => format!("rotation of the output about {rest}{case}"),
        (_, Some(rest)) if axis(rest) => format!("displacement of the output along {rest}{case}"),
        _ if is_frequency(name) => format!("natural frequency {}", &name[1..]),
        _ => name.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::{Columns, unit, words};

    #[test]
    fn the_columns_are_those_of_the_format() {
        let names: Vec<_> = super::columns(&Columns::default()).collect();
        let expected = "pose,x,y,z,rx,ry,rz,status,dx,dy,dz,drx,dry,drz,k11,k12,k13,k14,k15,k16,\
                        k22,k23,k24,k25,k26,k33,k34,k35,k36,k44,k45,k46,k55,k56,k66";
        assert_eq!(names.join(","), expected);
    }

    #[test]
    fn columns_have_units_and_words() {
        for (name, expected) in [
            ("k11", "N/m"),
            ("k35", "N/rad"),
            ("k66", "N·m/rad"),
            ("dz", "m"),
            ("own weight.drx", "rad"),
            ("f3", "Hz"),
            ("rod.section.diameter", "m"),
            ("joints.wrist.stiffness.x", "N/m"),
            ("drive_stiffness", "N·m/rad"),
            ("A1.v", "rad"),
            ("D1.y", "m"),
            ("elements", ""),
        ] {
            assert_eq!(unit(name), expected, "{name}");
        }
        assert_eq!(
            words("k15"),
            "force along x per rotation about y, all other displacements zero"
        );
        assert_eq!(
            words("gravity.dz"),
            "displacement of the output along z, case gravity"
        );
    }
}
