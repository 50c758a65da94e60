//! The poses of a job: a list, a grid or a table in a file of its own.

use super::targets::Targets;
use crate::error::LoadError;
use crate::prebuilt::PoseCoordinate;
use crate::text::columns::Given;
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;
use crate::text::source::Place;
use crate::text::values::Values;
use crate::text::{csv, named, names, quantities};

/// Poses x y z \[m\] and rotation vector \[rad\] of the output.
#[derive(Debug)]
pub(crate) enum Poses {
    /// The mechanism's own configuration.
    Own,
    /// These.
    List(Vec<[f64; 6]>),
    /// All combinations of values of the six coordinates, x fastest.
    Grid([Values; 6]),
    /// Those of a mechanism of a file.
    Asked(Targets),
}

impl Poses {
    /// Number of poses.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Own => 1,
            Self::List(poses) => poses.len(),
            Self::Grid(axes) => axes.iter().map(|axis| axis.len()).product(),
            Self::Asked(targets) => targets.len(),
        }
    }

    /// Names of the drives whose values the poses are; none where they are those of the output.
    pub(crate) fn drives(&self) -> &[String] {
        match self {
            Self::Asked(targets) => targets.drives(),
            _ => &[],
        }
    }

    /// Values of these drives in pose `k`, from 0.
    pub(crate) fn drive_values(&self, k: usize) -> &[f64] {
        match self {
            Self::Asked(targets) => targets.drive_values(k),
            _ => &[],
        }
    }

    /// Pose `k`, from 0, of a prebuilt mechanism; zero where not given.
    pub(crate) fn get(&self, k: usize) -> [f64; 6] {
        match self {
            Self::Own | Self::Asked(_) => [0.0; 6],
            Self::List(poses) => poses[k],
            Self::Grid(axes) => {
                // Every pose of a sweep comes here: axes of one value take no division.
                let (mut rest, mut pose) = (k, [0.0; 6]);
                for (coordinate, axis) in pose.iter_mut().zip(axes) {
                    let count = axis.len();
                    let place = if count == 1 { 0 } else { rest % count };
                    *coordinate = axis.get(place);
                    if count > 1 {
                        rest /= count;
                    }
                }
                pose
            }
        }
    }

    /// A table whose columns are coordinates of the output; `whole` is the argument, `at` names a part of
    /// it.
    pub(crate) fn table(
        columns: &[String],
        rows: &[f64],
        given: &Given<'_>,
        whole: &Place,
        at: impl Fn(&str) -> Place,
    ) -> Result<Self, LoadError> {
        let named = columns.iter().map(|name| (name.as_str(), at(name)));
        let places = csv::pose_columns(named, whole)?;
        let mut poses = Vec::with_capacity(rows.len() / places.len());
        for (k, row) in rows.chunks_exact(places.len()).enumerate() {
            let mut pose = [0.0; 6];
            for ((&value, &place), name) in row.iter().zip(&places).zip(columns) {
                given.check(place, value, || at(&format!("{k}.{name}")))?;
                pose[place] = value;
            }
            poses.push(pose);
        }
        Ok(Self::List(poses))
    }

    /// Reads `Csv(…)`, `List(…)` or `Grid(…)`.
    pub(crate) fn read(fragment: Fragment<'_>, given: &Given<'_>) -> Result<Self, LoadError> {
        let expected = "poses, `Csv(\"file.csv\")`, `List([…])` or `Grid(…)`";
        let (kind, arguments) = fragment.variant(expected)?;
        let arguments = || arguments.ok_or_else(|| fragment.expected(expected));
        match kind.text() {
            "Csv" => {
                let [path] = arguments()?.array("one path, `Csv(\"file.csv\")`")?;
                let table = named::read_named(path)?;
                csv::read(&table, given).map(Self::List)
            }
            "List" => {
                let [list] = arguments()?.array("one list, `List([(x, y, z), …])`")?;
                list_of_poses(list, given).map(Self::List)
            }
            "Grid" => grid(arguments()?, fragment, given),
            other => Err(kind
                .error(format!("unknown kind of poses `{other}`"))
                .with_help(names::help(
                    other,
                    "kinds of poses",
                    ["Csv", "List", "Grid"],
                ))),
        }
    }
}

fn list_of_poses(list: Fragment<'_>, given: &Given<'_>) -> Result<Vec<[f64; 6]>, LoadError> {
    let expected = "a pose of 3 or 6 numbers, `(x, y, z)` or `(x, y, z, rx, ry, rz)`";
    let mut poses = Vec::new();
    for item in list.list("a list of poses, `[(x, y, z), …]`")? {
        let numbers = item.tuple(expected)?;
        item.no_decimal_commas(&numbers, 3, expected)?;
        if ![3, 6].contains(&numbers.len()) {
            return Err(item.expected(expected));
        }
        let mut pose = [0.0; 6];
        for (k, number) in numbers.iter().enumerate() {
            pose[k] = csv::quantity(k, *number)?;
            given.check(k, pose[k], || number.place())?;
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

/// A position that the mechanism takes must be given; a rotation that is not is zero.
fn grid(
    arguments: Fragment<'_>,
    whole: Fragment<'_>,
    given: &Given<'_>,
) -> Result<Poses, LoadError> {
    let fields = Fields::read(arguments, "`Grid`", &csv::COLUMNS)?.within(whole);
    let mut axes = [Values::ZERO; 6];
    for (index, (axis, name)) in axes.iter_mut().zip(csv::COLUMNS).enumerate() {
        let position = |c: &PoseCoordinate| c.index() == index && index < 3;
        let field = match fields.get(name) {
            Some(field) => field,
            None if given.coordinates.iter().any(position) => fields.required(name)?,
            None => continue,
        };
        *axis = {
            let dimension = quantities::displacement()[index];
            Values::read(
                field,
                "three values, `(first, last, count)`",
                Some(dimension),
            )?
        };
        for value in axis.ends() {
            given.check(index, value, || field.place())?;
        }
    }
    let total = axes
        .iter()
        .try_fold(1_usize, |n, axis| n.checked_mul(axis.len()));
    if total.is_none() {
        return Err(whole
            .error("the grid has more poses than can be counted")
            .with_help("give fewer values of a coordinate, `x: (first, last, count)`"));
    }
    Ok(Poses::Grid(axes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_runs_through_x_first_and_ends_exactly() {
        let axis = Values::new;
        let alone = Values::ZERO;
        let (x, y, z) = (axis(-0.2, 0.2, 5), axis(0.1, 0.3, 3), axis(0.5, 0.5, 1));
        let grid = Poses::Grid([x, y, z, alone, alone, alone]);
        assert_eq!(grid.len(), 15);
        assert_eq!(grid.get(0), [-0.2, 0.1, 0.5, 0.0, 0.0, 0.0]);
        assert_eq!(grid.get(2)[0], 0.0);
        assert_eq!(grid.get(4)[..2], [0.2, 0.1]);
        assert_eq!(grid.get(5)[..2], [-0.2, 0.2]);
        assert_eq!(grid.get(14), [0.2, 0.3, 0.5, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn a_grid_of_rotations() {
        let alone = Values::ZERO;
        let turn = Values::new(-0.1, 0.1, 3);
        let grid = Poses::Grid([alone, alone, alone, alone, turn, turn]);
        assert_eq!(grid.len(), 9);
        assert_eq!(grid.get(5), [0.0, 0.0, 0.0, 0.0, 0.1, 0.0]);
    }

    #[test]
    fn a_large_grid_takes_no_memory() {
        let axis = Values::new(-1.0, 1.0, 1 << 20);
        let alone = Values::ZERO;
        let grid = Poses::Grid([axis, axis, axis, alone, alone, alone]);
        assert_eq!(grid.len(), 1 << 60);
        assert_eq!(grid.get((1 << 60) - 1)[..3], [1.0; 3]);
    }
}
