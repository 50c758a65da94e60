//! What can be drawn of a table: its columns, and quantities derived from them, with units and in
//! words.

use hyperstat_figures::Quantity;
use hyperstat_mechanisms::nearest;
use nalgebra::{Cholesky, Matrix3, Matrix6};

use crate::plot_error::PlotError;
use crate::table::{Column, TableReader};

/// A quantity of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// Its name and unit.
    pub quantity: Quantity,
    /// What it is, in words.
    pub words: String,
    rule: Rule,
    /// The columns that it is found from.
    columns: Vec<String>,
}

/// How a quantity is found from columns.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Rule {
    Same,
    /// Length of a vector.
    Length,
    /// Of the upper triangle of the stiffness: the least or the greatest principal stiffness of the
    /// translations (block 0) or the rotations (block 3), the others free or held.
    Principal {
        block: usize,
        others: Others,
        least: bool,
    },
    /// Of the same: the inverse of an entry of the compliance's diagonal.
    Along(usize),
}

/// What the output does in the directions that a stiffness is not about.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Others {
    /// It goes where it likes: a force, or a moment, acts alone. Inverses of eigenvalues of a block of
    /// the compliance.
    Free,
    /// It stays: a translation, or a rotation, is made alone. Eigenvalues of a block of the stiffness.
    Held,
}

/// Quantities that are found from others, by name.
pub const DERIVED: [&str; 16] = [
    "deflection",
    "rotation",
    "pure_force_stiffness_min",
    "pure_force_stiffness_max",
    "pure_force_stiffness_x",
    "pure_force_stiffness_y",
    "pure_force_stiffness_z",
    "pure_moment_stiffness_min",
    "pure_moment_stiffness_max",
    "pure_moment_stiffness_x",
    "pure_moment_stiffness_y",
    "pure_moment_stiffness_z",
    "pure_translation_stiffness_min",
    "pure_translation_stiffness_max",
    "pure_rotation_stiffness_min",
    "pure_rotation_stiffness_max",
];

impl Drawn {
    /// The quantity `name` of a table with these columns; `None` where there is none.
    pub fn named(name: &str, known: &[String]) -> Option<Self> {
        let is_known = |column: &String| known.contains(column);
        let same = |name: &str| Self {
            quantity: Quantity::new(name, unit(name)),
            words: words(name),
            rule: Rule::Same,
            columns: vec![name.into()],
        };
        let drawn = if known.iter().any(|column| column == name) {
            same(name)
        } else {
            derived(name)?
        };
        drawn.columns.iter().all(is_known).then_some(drawn)
    }

    /// The quantity `name` of a table.
    pub fn of_table(name: &str, table: &TableReader) -> Result<Self, PlotError> {
        Self::named(name, table.names()).ok_or_else(|| PlotError::UnknownColumn {
            path: table.path().into(),
            name: name.into(),
            help: instead_of(name, table.names()),
        })
    }

    /// Its value at every row; `None` where a column that it needs has none.
    pub fn read(&self, table: &TableReader) -> Result<Column, PlotError> {
        let places: Vec<_> = (self.columns.iter())
            .filter_map(|name| table.find(name))
            .collect();
        let mut columns = table.read(&places)?;
        if self.rule == Rule::Same {
            return Ok(columns.pop().unwrap_or_default());
        }
        let rows = columns.first().map_or(0, Vec::len);
        let value = |row| {
            let numbers: Option<Vec<f64>> = columns.iter().map(|column| column[row]).collect();
            self.rule.value(&numbers?)
        };
        Ok((0..rows).map(value).collect())
    }
}

impl Rule {
    fn value(self, numbers: &[f64]) -> Option<f64> {
        match self {
            Self::Same => numbers.first().copied(),
            Self::Length => Some(numbers.iter().fold(0.0_f64, |sum, n| sum.hypot(*n))),
            Self::Along(place) => {
                let compliance = compliance(numbers)?;
                Some(1.0 / compliance[(place, place)])
            }
            Self::Principal {
                block,
                others,
                least,
            } => {
                let of = |matrix: Matrix6<f64>| {
                    let block: Matrix3<f64> = matrix.fixed_view::<3, 3>(block, block).into();
                    block.symmetric_eigenvalues()
                };
                match (others, least) {
                    (Others::Free, true) => Some(1.0 / of(compliance(numbers)?).max()),
                    (Others::Free, false) => Some(1.0 / of(compliance(numbers)?).min()),
                    (Others::Held, true) => Some(of(stiffness(numbers)).min()),
                    (Others::Held, false) => Some(of(stiffness(numbers)).max()),
                }
            }
        }
        .filter(|value| value.is_finite())
    }
}

/// The stiffness from its upper triangle by rows.
fn stiffness(upper: &[f64]) -> Matrix6<f64> {
    let mut stiffness = Matrix6::zeros();
    let places = (0..6).flat_map(|row| (row..6).map(move |column| (row, column)));
    for ((row, column), value) in places.zip(upper) {
        stiffness[(row, column)] = *value;
        stiffness[(column, row)] = *value;
    }
    stiffness
}

/// The compliance from the upper triangle of a stiffness, by rows; `None` where it is not positive
/// definite.
fn compliance(upper: &[f64]) -> Option<Matrix6<f64>> {
    Some(Cholesky::new(stiffness(upper))?.inverse())
}

fn derived(name: &str) -> Option<Drawn> {
    let (case, kind) = match name.rsplit_once('.') {
        Some((case, kind)) => (format!("{case}."), kind),
        None => (String::new(), name),
    };
    let of_case = match &*case {
        "" => String::new(),
        case => format!(", case {}", case.trim_end_matches('.')),
    };
    let vector = |axes: [&str; 3], unit: &str, words: &str| Drawn {
        quantity: Quantity::new(name, unit),
        words: format!("{words}{of_case}"),
        rule: Rule::Length,
        columns: axes.map(|axis| format!("{case}{axis}")).to_vec(),
    };
    match kind {
        "deflection" => {
            let words = "length of the output's displacement";
            return Some(vector(["dx", "dy", "dz"], "m", words));
        }
        "rotation" => {
            let words = "angle of the output's rotation";
            return Some(vector(["drx", "dry", "drz"], "rad", words));
        }
        _ => {}
    }
    if !case.is_empty() {
        return None;
    }
    let (cause, rest) = kind.strip_prefix("pure_")?.split_once("_stiffness_")?;
    let (block, others) = match cause {
        "force" => (0, Others::Free),
        "moment" => (3, Others::Free),
        "translation" => (0, Others::Held),
        "rotation" => (3, Others::Held),
        _ => return None,
    };
    let free = match (block, others) {
        (0, Others::Free) => "rotations free",
        (0, Others::Held) => "rotations held",
        (_, Others::Free) => "translations free",
        (_, Others::Held) => "translations held",
    };
    let axis = ["x", "y", "z"].iter().position(|axis| *axis == rest);
    let (rule, words) = match (rest, axis, others) {
        (_, Some(axis), Others::Free) => {
            let effect = ["displacement", "rotation"][block / 3];
            let words = format!("{cause} along {rest} alone per {effect} along {rest}");
            (Rule::Along(block + axis), words)
        }
        ("min" | "max", ..) => {
            let least = rest == "min";
            let size = if least { "least" } else { "greatest" };
            let rule = Rule::Principal {
                block,
                others,
                least,
            };
            let words = format!("{size} principal stiffness against a pure {cause}, {free}");
            (rule, words)
        }
        _ => return None,
    };
    Some(Drawn {
        quantity: Quantity::new(name, ["N/m", "N·m/rad"][block / 3]),
        words,
        rule,
        columns: upper_triangle().collect(),
    })
}

/// What was meant by a name that no quantity of a table with these columns has.
pub fn instead_of(name: &str, names: &[String]) -> String {
    let (rotational, rest) = match name.strip_prefix("rotational_") {
        Some(rest) => (true, rest),
        None => (false, name),
    };
    let [cause, motion, other, k] = match rotational {
        false => ["force", "translation", "rotations", "k11 k22 k33"],
        true => ["moment", "rotation", "translations", "k44 k55 k66"],
    };
    match rest.strip_prefix("stiffness_") {
        Some(rest @ ("min" | "max")) => format!(
            "there are two: `pure_{cause}_stiffness_{rest}`, {other} free, and \
             `pure_{motion}_stiffness_{rest}`, {other} held"
        ),
        Some(axis @ ("x" | "y" | "z")) => {
            let k = k.split(' ').nth(usize::from(axis.as_bytes()[0] - b'x'));
            format!(
                "there are two: `pure_{cause}_stiffness_{axis}`, all other directions free, and `{}`, \
                 all others held",
                k.unwrap_or_default()
            )
        }
        _ => known(name, names),
    }
}

fn upper_triangle() -> impl Iterator<Item = String> {
    (1..=6).flat_map(|row| (row..=6).map(move |column| format!("k{row}{column}")))
}

/// Row and column, from 1, of a stiffness column `k11` to `k66`.
fn entry(name: &str) -> Option<[usize; 2]> {
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
pub(super) fn unit(name: &str) -> &'static str {
    if let Some([row, column]) = entry(name) {
        return match (row > 3, column > 3) {
            (false, false) => "N/m",
            (false, true) => "N/rad",
            (true, false) => "N",
            (true, true) => "N·m/rad",
        };
    }
    let last = name.rsplit('.').next().unwrap_or(name);
    let stiffness = name.contains("stiffness");
    match last {
        "x" | "y" | "z" if stiffness => "N/m",
        "u" | "v" | "w" | "drive_stiffness" if stiffness => "N·m/rad",
        "x" | "y" | "z" | "dx" | "dy" | "dz" => "m",
        // Of a drive.
        "u" | "v" | "w" => "rad",
        "rx" | "ry" | "rz" | "drx" | "dry" | "drz" => "rad",
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
fn words(name: &str) -> String {
    const AXES: [&str; 3] = ["x", "y", "z"];
    if let Some([row, column]) = entry(name) {
        let of =
            |k: usize, words: [&str; 2]| format!("{} {}", words[(k - 1) / 3], AXES[(k - 1) % 3]);
        let force = of(row, ["force along", "moment about"]);
        let motion = of(column, ["displacement along", "rotation about"]);
        return format!("{force} per {motion}, all other displacements zero");
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

/// What a table with these columns holds, in words: the quantity that was meant by `name`, or all.
fn known(name: &str, names: &[String]) -> String {
    let not_drawn = |name: &&String| name.as_str() != "status";
    let columns: Vec<_> = names.iter().filter(not_drawn).map(String::as_str).collect();
    let derived: Vec<_> = (DERIVED.into_iter())
        .filter(|name| Drawn::named(name, names).is_some())
        .collect();
    let every: Vec<_> = columns.iter().chain(&derived).copied().collect();
    let all = format!(
        "its columns are {}; found from them are {}",
        columns.join(", "),
        derived.join(", ")
    );
    match nearest(name, &every) {
        Some(meant) => format!("did you mean `{meant}`? {all}"),
        None => all,
    }
}

#[cfg(test)]
mod tests {
    use super::{Drawn, Others, Rule, unit, words};

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

    #[test]
    fn principal_stiffness_of_springs_at_an_angle() {
        // 1e6 N/m along (1, 1)/√2 in x-y, 4e6 across it, 2e6 along z, rotations apart.
        let mut upper = vec![0.0; 21];
        for (place, value) in [(0, 2.5e6), (1, -1.5e6), (6, 2.5e6), (11, 2e6)] {
            upper[place] = value;
        }
        for (place, value) in [(15, 10.0), (18, 20.0), (20, 30.0)] {
            upper[place] = value;
        }
        let of = |block, others, least| {
            let rule = Rule::Principal {
                block,
                others,
                least,
            };
            rule.value(&upper).unwrap()
        };
        for (found, expected) in [
            (of(0, Others::Free, true), 1e6),
            (of(0, Others::Free, false), 4e6),
            (of(3, Others::Free, true), 10.0),
            (of(3, Others::Free, false), 30.0),
            (of(0, Others::Held, true), 1e6),
            (of(3, Others::Held, false), 30.0),
            // 1 / (1/2 (1/1e6 + 1/4e6)).
            (Rule::Along(0).value(&upper).unwrap(), 1.6e6),
            (Rule::Along(2).value(&upper).unwrap(), 2e6),
        ] {
            assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
        }
        upper[0] = -1.0;
        assert_eq!(Rule::Along(2).value(&upper), None);
    }

    /// A spring k along x at the height h above the output, held in rotation by a spring c: a force
    /// alone turns the output, 1/K = 1/k + h²/c; a translation alone meets k.
    #[test]
    fn rotations_free_and_held_are_two_stiffnesses() {
        let (k, h, c) = (2e6, 0.3, 5e4);
        let mut upper = vec![0.0; 21];
        // k11, k15, k22, k33, k44, k55, k66 of the spring and of stiff ones in all other directions.
        for (place, value) in [
            (0, k),
            (4, k * h),
            (6, 1e9),
            (11, 1e9),
            (15, 1e9),
            (18, c + k * h * h),
            (20, 1e9),
        ] {
            upper[place] = value;
        }
        let columns: Vec<String> = super::upper_triangle().collect();
        for (name, expected) in [
            ("pure_force_stiffness_min", 1.0 / (1.0 / k + h * h / c)),
            ("pure_force_stiffness_x", 1.0 / (1.0 / k + h * h / c)),
            ("pure_translation_stiffness_min", k),
            ("pure_moment_stiffness_min", c),
            ("pure_rotation_stiffness_min", c + k * h * h),
        ] {
            let found = Drawn::named(name, &columns).unwrap().rule.value(&upper);
            assert!((found.unwrap() / expected - 1.0).abs() < 1e-12, "{name}");
        }
    }

    #[test]
    fn a_name_of_two_meanings_is_told_both() {
        for (name, both) in [
            (
                "stiffness_min",
                ["pure_force_stiffness_min", "pure_translation_stiffness_min"],
            ),
            ("stiffness_z", ["pure_force_stiffness_z", "k33"]),
            (
                "rotational_stiffness_max",
                ["pure_moment_stiffness_max", "pure_rotation_stiffness_max"],
            ),
            ("rotational_stiffness_y", ["pure_moment_stiffness_y", "k55"]),
        ] {
            let columns: Vec<String> = super::upper_triangle().collect();
            assert_eq!(Drawn::named(name, &columns), None);
            let told = super::instead_of(name, &columns);
            assert!(
                both.iter().all(|name| told.contains(&format!("`{name}`"))),
                "{told}"
            );
            // The other one is a quantity, too.
            assert!(
                both.iter()
                    .all(|name| Drawn::named(name, &columns).is_some())
            );
        }
    }

    #[test]
    fn a_quantity_needs_its_columns() {
        let known = ["push.dx", "push.dy", "push.dz"].map(String::from);
        let drawn = Drawn::named("push.deflection", &known).unwrap();
        assert_eq!(
            drawn.words,
            "length of the output's displacement, case push"
        );
        assert_eq!(drawn.quantity.unit, "m");
        for missing in [
            "deflection",
            "push.rotation",
            "pure_force_stiffness_min",
            "push.pure_force_stiffness_min",
        ] {
            assert_eq!(Drawn::named(missing, &known), None, "{missing}");
        }
    }
}
