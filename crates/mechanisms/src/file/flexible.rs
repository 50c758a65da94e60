//! Flexible bodies: elastic bodies whose stiffness a finite-element program computed.

use hyperstat_elements::ElementError;
use hyperstat_model::{BodyId, Model, ModelError};
use nalgebra::DMatrix;

use super::through::{Tables, pairs, through};
use crate::error::LoadError;
use crate::text::fields::Fields;
use crate::text::source::Place;
use crate::text::{csv, named};

/// What the stiffness must be, for messages.
const WANTED: &str = "give the stiffness of the free body over its points: six rows and columns \
    a point, x y z rx ry rz, in the order of `points`, global axes, N, m and rad";

/// Reads `Flexible(points: […], stiffness: Csv("link.csv"))`.
pub(crate) fn read(
    name: &str,
    fields: &Fields<'_>,
    tables: &Tables,
    model: &mut Model,
) -> Result<BodyId, LoadError> {
    let list = fields.required("points")?;
    let points = through(fields, list, tables)?;
    if points.len() < 2 {
        return Err(list
            .error(format!("flexible body `{name}` has fewer than two points"))
            .with_help("nothing can deform it; use `Rigid` for a body of one point"));
    }
    let given = fields.required("stiffness")?;
    let expected = "a stiffness, `Csv(\"file.csv\")`";
    let path = match given.variant(expected)? {
        (kind, Some(arguments)) if kind.text() == "Csv" => {
            let [path] = arguments.array("one path, `Csv(\"file.csv\")`")?;
            path
        }
        _ => return Err(given.expected(expected)),
    };
    let table = named::read_named(path)?;
    let rows = csv::numbers(&table).map_err(|error| error.with_help(WANTED))?;
    let size = 6 * points.len();
    let line = |row: &[(f64, Place)]| row.first().map(|(_, place)| place.clone());
    for (k, row) in rows.iter().enumerate() {
        let message = if k == size {
            format!(
                "the table has more than {size} rows, six for each of {} points",
                points.len()
            )
        } else if row.len() != size {
            format!("expected {size} numbers, six a point, found {}", row.len())
        } else {
            continue;
        };
        let place = line(row).unwrap_or_else(|| path.place());
        return Err(place.error(message).with_help(WANTED));
    }
    if rows.len() < size {
        let last = rows.last().and_then(|row| line(row));
        return Err(last
            .unwrap_or_else(|| path.place())
            .error(format!(
                "the table ends after {} rows, {} points need {size}",
                rows.len(),
                points.len()
            ))
            .with_help(WANTED));
    }
    let stiffness = DMatrix::from_fn(size, size, |row, column| rows[row][column].0);
    model
        .add_flexible(name, &pairs(&points), &stiffness)
        .map_err(|error| match error {
            ModelError::Flexible { source, .. } => explained(&source, name, &rows, &path.place()),
            other => list.error(other.to_string()),
        })
}

/// What is wrong with a stiffness, and what to do about it.
fn explained(
    error: &ElementError,
    name: &str,
    rows: &[Vec<(f64, Place)>],
    path: &Place,
) -> LoadError {
    let stiffness = format!("the stiffness of `{name}`");
    match *error {
        ElementError::NotSymmetric {
            row,
            column,
            value,
            mirrored,
        } => rows[row][column]
            .1
            .error(format!(
                "{stiffness} is not symmetric: {value} in row {}, column {}, but {mirrored} in row \
                 {}, column {}",
                row + 1,
                column + 1,
                column + 1,
                row + 1
            ))
            .with_help("write both halves of the matrix, with seven digits or more"),
        ElementError::ResistsRigidMotion { motion, part } => path
            .error(format!(
                "{stiffness} resists {motion} of the whole body, with {part:.0e} of its entries"
            ))
            .with_help(format!(
                "{WANTED}; see that no node was held, that the points lie where the matrix was \
                 made for, and that it has seven digits or more"
            )),
        ElementError::NegativeEnergy { eigenvalue } => path
            .error(format!(
                "{stiffness} is not positive semidefinite: scaled to a unit diagonal it has the \
                 eigenvalue {eigenvalue:.0e}"
            ))
            .with_help("export it anew, with seven digits or more; forces are those on the body"),
        ElementError::MoreThanSixFreeMotions { found } => path
            .error(format!(
                "{stiffness} leaves {found} motions free; a body that hangs together has six"
            ))
            .with_help(
                "tie each point rigidly to the surface it belongs to (nodes of solid elements resist \
                 no rotation), join what is loose in the body, or write more digits",
            ),
        ref other => path
            .error(format!("{stiffness}: {other}"))
            .with_help(WANTED),
    }
}
