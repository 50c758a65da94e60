//! The columns that a job asks for, beside those that every table has.

use hyperstat_model::{ModalOptions, Model};

use crate::error::LoadError;
use crate::job::modes;
use crate::terms::job::COLUMN;
use crate::text::fields::Fields;
use crate::text::fragment::{Fragment, first_at};
use crate::text::names;
use crate::text::source::Place;

/// Natural frequencies where nothing is said of their number.
const FREQUENCIES: usize = 6;

/// Columns of a job's table that belong together.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Column {
    /// Values of the drives.
    Drives,
    /// Forces and moments of the drives.
    DriveForces,
    /// The wrench in the joint of this name.
    Wrench(String),
    /// The largest stress, and where it is.
    Stress,
    /// The largest utilisation, and where it is.
    Utilisation,
    /// Mass of what moves.
    Mass,
    /// Every measure of the stiffness and the displacement.
    Measures,
    /// Natural frequencies: those of the job's `modes`, where it has them, else so many.
    Frequencies(ModalOptions),
    /// Shares in the deflection.
    Budget,
}

/// What a job has that its columns ask for.
pub(crate) struct Known<'a> {
    /// Its first design in a pose that can be reached, where there is one.
    pub(crate) model: Option<&'a Model>,
    /// Whether it has `modes`.
    pub(crate) has_modes: bool,
}

/// Reads the columns of a job, each with its place.
pub(crate) fn read(
    list: Fragment<'_>,
    known: &Known<'_>,
) -> Result<Vec<(Column, Place)>, LoadError> {
    let items = list.list("a list of columns, such as `[DriveForces, Wrench(\"B1\"), Stress]`")?;
    let mut columns: Vec<(Column, Fragment<'_>)> = Vec::new();
    for item in items {
        let column = column(item, known)?;
        if let Some(model) = known.model {
            column.check(model, item)?;
        }
        let same = |(other, _): &&(Column, Fragment<'_>)| column.is_same(other);
        if let Some((_, first)) = columns.iter().find(same) {
            let error = item.error(format!("the columns `{}` are asked for twice", item.text()));
            return Err(error.with_help(first_at(*first)));
        }
        columns.push((column, item));
    }
    Ok((columns.into_iter())
        .map(|(column, at)| (column, at.place()))
        .collect())
}

fn column(whole: Fragment<'_>, known: &Known<'_>) -> Result<Column, LoadError> {
    let expected = "columns, such as `Stress` or `Wrench(\"B1\")`";
    let (kind, arguments) = whole.variant(expected)?;
    if kind.text() == "Wrench" {
        let expected = "the name of a joint, `Wrench(\"B1\")`";
        let arguments = arguments.ok_or_else(|| whole.expected(expected))?;
        let [joint] = arguments.array(expected)?;
        let name = joint.string()?;
        if let Some(model) = known.model {
            let mut joints = model.joints().iter().map(|joint| joint.name.as_str());
            if !joints.clone().any(|own| own == name) {
                let error = joint.error(format!("the mechanism has no joint `{name}`"));
                return Err(error.with_help(names::help(&name, "joints", &mut joints)));
            }
        }
        return Ok(Column::Wrench(name));
    }
    let Some(fields) = COLUMN.fields(kind.text()) else {
        return Err(kind
            .error(format!("unknown columns `{}`", kind.text()))
            .with_help(names::help(kind.text(), "columns", COLUMN.names())));
    };
    let owner = format!("`{}`", kind.text());
    let fields = match arguments {
        Some(arguments) => Fields::read(arguments, owner, &fields)?.within(whole),
        None => Fields::none(whole, owner),
    };
    Ok(match kind.text() {
        "Drives" => Column::Drives,
        "DriveForces" => Column::DriveForces,
        "Stress" => Column::Stress,
        "Utilisation" => Column::Utilisation,
        "Mass" => Column::Mass,
        "Measures" => Column::Measures,
        "Budget" => Column::Budget,
        _ => Column::Frequencies(frequencies(&fields, known)?),
    })
}

/// Reads how many natural frequencies are asked for.
fn frequencies(fields: &Fields<'_>, known: &Known<'_>) -> Result<ModalOptions, LoadError> {
    let count = match fields.get("count") {
        None => FREQUENCIES,
        Some(count) if known.has_modes => {
            return Err(count
                .error("the job's `modes` say how many natural frequencies there are")
                .with_help("leave the number out here, or leave out `modes`"));
        }
        Some(count) => modes::count(count, modes::COUNT)?,
    };
    Ok(ModalOptions::lowest(count))
}

impl Column {
    /// Whether two of them would be the same columns of a table.
    fn is_same(&self, other: &Self) -> bool {
        matches!((self, other), (Self::Frequencies(_), Self::Frequencies(_))) || self == other
    }

    /// Refuses what a mechanism has no numbers for.
    fn check(&self, model: &Model, at: Fragment<'_>) -> Result<(), LoadError> {
        let mut segments = model.segments().iter();
        let (missing, help) = match self {
            Self::Drives | Self::DriveForces if model.drives().next().is_none() => (
                "the mechanism has no drives",
                "a drive is a free direction of a joint with `locked: true` or a `stiffness`",
            ),
            Self::Stress | Self::Utilisation if model.segments().is_empty() => {
                ("the mechanism has no beams", "make a link a `Beam`")
            }
            Self::Utilisation if segments.all(|own| own.material.yield_strength().is_none()) => (
                "no material of the mechanism has a yield strength",
                "give the materials a `yield`, in Pa",
            ),
            _ => return Ok(()),
        };
        Err(at.error(missing).with_help(format!(
            "{help}; or leave `{}` out of the columns",
            at.text()
        )))
    }
}
