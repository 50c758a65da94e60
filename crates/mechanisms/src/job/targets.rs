//! The poses of a mechanism of a file: what its output or its drives are asked for.

use std::str::FromStr;

use hyperstat_closure::{Drive, LoopClosure};
use hyperstat_joints::Dof;
use hyperstat_model::{JointId, Model};

use crate::error::LoadError;
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;
use crate::text::source::Place;
use crate::text::values::Values;
use crate::text::{csv, named, names, quantities};

/// Targets of a mechanism of a file, one a pose.
#[derive(Debug)]
pub(crate) enum Targets {
    /// Coordinates of the output; `None` follows from the mechanism.
    List(Vec<[Option<f64>; 6]>),
    /// All combinations of values of the coordinates that are asked, x fastest.
    Grid([Option<Values>; 6]),
    /// Values of drives, a row a pose.
    Drives {
        drives: Vec<(JointId, Dof)>,
        /// Their names, `joint.direction`.
        names: Vec<String>,
        rows: Vec<Vec<f64>>,
    },
}

/// One of them.
#[derive(Debug)]
pub(crate) enum Asked {
    Output([Option<f64>; 6]),
    Drives(Vec<Drive>),
}

const EXPECTED: &str =
    "poses, `Csv(\"file.csv\")`, `List([…])`, `Grid(…)` or `Drives(Csv(\"file.csv\"))`";

impl Targets {
    /// Reads the poses of a job whose mechanism is `model`.
    pub(crate) fn read(fragment: Fragment<'_>, model: &Model) -> Result<Self, LoadError> {
        let closure = movable(model, &fragment.place())?;
        let (kind, arguments) = fragment.variant(EXPECTED)?;
        let arguments = || arguments.ok_or_else(|| fragment.expected(EXPECTED));
        match kind.text() {
            "Csv" => {
                let [path] = arguments()?.array("one path, `Csv(\"file.csv\")`")?;
                let (columns, rows) = csv::named(&named::read_named(path)?, csv::coordinate)?;
                Ok(Self::List(
                    rows.iter().map(|row| asked(&columns, row)).collect(),
                ))
            }
            "List" => {
                let [list] = arguments()?.array("one list, `List([(x, y, z), …])`")?;
                list_of_poses(list).map(Self::List)
            }
            "Grid" => grid(arguments()?, fragment).map(Self::Grid),
            "Drives" => {
                let expected = "a table of the drives' values, `Drives(Csv(\"file.csv\"))`";
                let [table] = arguments()?.array(expected)?;
                let (kind, inner) = table.variant(expected)?;
                let (true, Some(inner)) = (kind.text() == "Csv", inner) else {
                    return Err(table.expected(expected));
                };
                let [path] = inner.array("one path, `Csv(\"file.csv\")`")?;
                let table = named::read_named(path)?;
                let drive = |name: &str, place: &Place| drive(name, place, model, &closure);
                let (drives, rows) = csv::named(&table, drive)?;
                Ok(Self::of_drives(drives, rows, model))
            }
            other => Err(kind
                .error(format!("unknown kind of poses `{other}`"))
                .with_help(names::help(
                    other,
                    "kinds of poses",
                    ["Csv", "List", "Grid", "Drives"],
                ))),
        }
    }

    /// Values of these drives, a row a pose.
    fn of_drives(drives: Vec<(JointId, Dof)>, rows: Vec<Vec<f64>>, model: &Model) -> Self {
        let name = |(joint, direction): &(JointId, Dof)| {
            format!("{}.{direction}", model.joints()[joint.0].name)
        };
        Self::Drives {
            names: drives.iter().map(name).collect(),
            drives,
            rows,
        }
    }

    /// A table whose columns are coordinates of the output or drives of `model`, all of one kind; `at`
    /// names the place of a column.
    pub(crate) fn table(
        columns: &[String],
        rows: &[f64],
        model: &Model,
        whole: &Place,
        at: impl Fn(&str) -> Place,
    ) -> Result<Self, LoadError> {
        let closure = movable(model, whole)?;
        let rows = rows.chunks_exact(columns.len().max(1));
        if columns.iter().any(|name| name.contains('.')) {
            let drives = distinct(columns, &at, |name, place| {
                drive(name, place, model, &closure)
            })?;
            let rows = rows.map(<[f64]>::to_vec).collect();
            return Ok(Self::of_drives(drives, rows, model));
        }
        let columns = distinct(columns, &at, csv::coordinate)?;
        Ok(Self::List(rows.map(|row| asked(&columns, row)).collect()))
    }

    /// Number of poses.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::List(poses) => poses.len(),
            Self::Grid(axes) => axes.iter().flatten().map(Values::len).product(),
            Self::Drives { rows, .. } => rows.len(),
        }
    }

    /// Names of the drives that are given values; none where poses of the output are.
    pub(crate) fn drives(&self) -> &[String] {
        match self {
            Self::Drives { names, .. } => names,
            _ => &[],
        }
    }

    /// Their values in pose `k`, from 0.
    pub(crate) fn drive_values(&self, k: usize) -> &[f64] {
        match self {
            Self::Drives { rows, .. } => &rows[k],
            _ => &[],
        }
    }

    /// What is asked in pose `k`, from 0.
    pub(crate) fn get(&self, k: usize) -> Asked {
        match self {
            Self::List(poses) => Asked::Output(poses[k]),
            Self::Grid(axes) => {
                let mut rest = k;
                Asked::Output(axes.map(|axis| {
                    let axis = axis?;
                    let value = axis.get(rest % axis.len());
                    rest /= axis.len();
                    Some(value)
                }))
            }
            Self::Drives { drives, rows, .. } => {
                let named = drives.iter().zip(&rows[k]);
                let drive = |(&(joint, direction), &value): (&(JointId, Dof), &f64)| Drive {
                    joint,
                    direction,
                    value,
                };
                Asked::Drives(named.map(drive).collect())
            }
        }
    }
}

/// The mechanism as one that can be moved; else the error of the poses at `place`.
fn movable(model: &Model, place: &Place) -> Result<LoopClosure, LoadError> {
    LoopClosure::new(model).map_err(|error| {
        place
            .error(format!("the mechanism cannot be moved: {error}"))
            .with_help("leave `poses` out: the job has the configuration in the file")
    })
}

/// What a row of a table asks of the output.
fn asked(columns: &[usize], row: &[f64]) -> [Option<f64>; 6] {
    let mut asked = [None; 6];
    for (column, value) in columns.iter().zip(row) {
        asked[*column] = Some(*value);
    }
    asked
}

/// What columns of these names mean, each given once.
fn distinct<C: PartialEq>(
    names: &[String],
    at: impl Fn(&str) -> Place,
    column: impl Fn(&str, &Place) -> Result<C, LoadError>,
) -> Result<Vec<C>, LoadError> {
    let mut columns = Vec::new();
    for name in names {
        let place = at(name);
        let meant = column(name, &place)?;
        if columns.contains(&meant) {
            return Err(place
                .error(format!("the column `{name}` is given twice"))
                .with_help("leave one of them out"));
        }
        columns.push(meant);
    }
    Ok(columns)
}

/// A column of a table of drives: `joint.direction`.
fn drive(
    name: &str,
    place: &Place,
    model: &Model,
    closure: &LoopClosure,
) -> Result<(JointId, Dof), LoadError> {
    let all = closure.drives().map(|(joint, dof)| {
        let joint = &model.joints()[joint.0].name;
        format!("{joint}.{dof}")
    });
    let all: Vec<String> = all.collect();
    let help = || match all.is_empty() {
        true => "the mechanism has no drive: give the joints that move it `locked: true`".into(),
        false => names::help(name, "drives", all.iter().map(String::as_str)),
    };
    let parts = name.split_once('.').and_then(|(joint, direction)| {
        let joint = model
            .joints()
            .iter()
            .position(|other| other.name == joint)?;
        Some((JointId(joint), Dof::from_str(direction).ok()?))
    });
    let Some((joint, direction)) = parts else {
        return Err(place
            .error(format!(
                "`{}` is no `joint.direction` of the mechanism",
                csv::shortened(name)
            ))
            .with_help(help()));
    };
    closure
        .check_drive(joint, direction)
        .map_err(|error| place.error(error.to_string()).with_help(help()))?;
    Ok((joint, direction))
}

fn list_of_poses(list: Fragment<'_>) -> Result<Vec<[Option<f64>; 6]>, LoadError> {
    let expected = "a pose of 3 or 6 numbers, `(x, y, z)` or `(x, y, z, rx, ry, rz)`";
    let mut poses = Vec::new();
    for item in list.list("a list of poses, `[(x, y, z), …]`")? {
        let numbers = item.tuple(expected)?;
        item.no_decimal_commas(&numbers, 3, expected)?;
        if ![3, 6].contains(&numbers.len()) {
            return Err(item.expected(expected));
        }
        let mut pose = [None; 6];
        for (k, number) in numbers.iter().enumerate() {
            pose[k] = Some(csv::quantity(k, *number)?);
        }
        poses.push(pose);
    }
    if poses.is_empty() {
        return Err(list
            .error("the list of poses is empty")
            .with_help("give at least one pose, `List([(x, y, z)])`"));
    }
    Ok(poses)
}

fn grid(arguments: Fragment<'_>, whole: Fragment<'_>) -> Result<[Option<Values>; 6], LoadError> {
    let fields = Fields::read(arguments, "`Grid`", &csv::COLUMNS)?.within(whole);
    let mut axes = [None; 6];
    for ((axis, name), dimension) in axes
        .iter_mut()
        .zip(csv::COLUMNS)
        .zip(quantities::displacement())
    {
        let expected = "three values, `(first, last, count)`";
        let read = |field| Values::read(field, expected, Some(dimension));
        *axis = fields.get(name).map(read).transpose()?;
    }
    if axes.iter().all(Option::is_none) {
        return Err(whole
            .error("the grid has no axis")
            .with_help("give the coordinates that the output follows, `x: (first, last, count)`"));
    }
    let mut counts = axes.iter().flatten().map(Values::len);
    if counts.try_fold(1_usize, usize::checked_mul).is_none() {
        return Err(whole
            .error("the grid has more poses than can be counted")
            .with_help("give fewer values of a coordinate, `x: (first, last, count)`"));
    }
    Ok(axes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_asks_for_its_axes_alone() {
        let mut axes = [None; 6];
        axes[2] = Some(Values::new(0.5, 0.7, 3));
        axes[4] = Some(Values::new(-0.1, 0.1, 2));
        let grid = Targets::Grid(axes);
        assert_eq!(grid.len(), 6);
        let Asked::Output(asked) = grid.get(5) else {
            panic!("no drives");
        };
        assert_eq!(asked, [None, None, Some(0.7), None, Some(0.1), None]);
    }
}
