//! What can be drawn of a table: its columns, and quantities derived from them, with units and in
//! words.

use hyperstat_figures::Quantity;
use hyperstat_mechanisms::nearest;
use nalgebra::{Matrix6, Vector6};

use super::labels::Labels;
use crate::measures::{self, Pose};
use crate::plot_error::PlotError;
use crate::schema::{self, DISPLACEMENT, STATUS, unit, words};
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
    /// A measure of the stiffness, from its upper triangle by rows.
    Of(measures::Rule),
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
        let drawn = Self::named(name, table.names()).ok_or_else(|| PlotError::UnknownColumn {
            path: table.path().into(),
            name: name.into(),
            help: instead_of(name, table.names()),
        })?;
        Ok(match drawn.rule {
            Rule::Same => Self {
                quantity: Quantity::new(name, table.unit(name)),
                ..drawn
            },
            _ => drawn,
        })
    }

    /// The same by the name that it has in a figure.
    pub(super) fn labelled(mut self, labels: &Labels) -> Self {
        let label = labels.of(&self.quantity.name).to_owned();
        if self.words == self.quantity.name {
            self.words.clone_from(&label);
        }
        self.quantity.name = label;
        self
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
            Self::Of(rule) => {
                let pose = Pose::new(&stiffness(numbers));
                pose.measure(rule, &Vector6::zeros())
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

fn derived(name: &str) -> Option<Drawn> {
    let (case, kind) = match name.rsplit_once('.') {
        Some((case, kind)) => (format!("{case}."), kind),
        None => (String::new(), name),
    };
    let measure = measures::named(DERIVED.into_iter().find(|known| *known == kind)?)?;
    let quantity = Quantity::new(name, measure.unit);
    if let measures::Rule::Length(first) = measure.rule {
        let of_case = match &*case {
            "" => String::new(),
            case => format!(", case {}", case.trim_end_matches('.')),
        };
        let axes = &DISPLACEMENT[first..first + 3];
        return Some(Drawn {
            quantity,
            words: format!("{}{of_case}", measure.words),
            rule: Rule::Length,
            columns: axes.iter().map(|axis| format!("{case}{axis}")).collect(),
        });
    }
    case.is_empty().then(|| Drawn {
        quantity,
        words: measure.words.into(),
        rule: Rule::Of(measure.rule),
        columns: schema::stiffness().collect(),
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

/// What a table with these columns holds, in words: the quantity that was meant by `name`, or all.
fn known(name: &str, names: &[String]) -> String {
    let not_drawn = |name: &&String| name.as_str() != STATUS;
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
    use super::Drawn;
    use crate::schema;

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
            let columns: Vec<String> = schema::stiffness().collect();
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
