//! Why a figure that is asked for cannot be drawn.

use std::io;
use std::path::PathBuf;

use hyperstat_mechanisms::Location;
#[cfg(feature = "parquet")]
use parquet::errors::ParquetError;
use thiserror::Error;

use crate::digits::digits;

/// A table that cannot be drawn, or does not hold what is asked for.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PlotError {
    /// A file that cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A file that is neither of the tables that `run` writes.
    #[error("{} is no table: its name ends with neither `.csv` nor `.parquet`", .path.display())]
    Extension {
        /// The file.
        path: PathBuf,
    },
    /// A Parquet file that cannot be read as one.
    #[cfg(feature = "parquet")]
    #[error("{} cannot be read as Parquet: {source}", .path.display())]
    Parquet {
        /// The file.
        path: PathBuf,
        /// Why.
        source: ParquetError,
    },
    /// A table without a column that each table of a run has.
    #[error("not a table of `hyperstat run`: it has no column `{missing}`")]
    NoRun {
        /// Where.
        location: Box<Location>,
        /// The column that it lacks.
        missing: &'static str,
    },
    /// A line of another number of cells than the table has columns.
    #[error("expected {expected} cells, one a column, found {found}")]
    Cells {
        /// Where.
        location: Box<Location>,
        /// How many columns there are.
        expected: usize,
        /// How many cells the line has.
        found: usize,
    },
    /// A cell that must hold a number and holds something else.
    #[error("expected a number in the column `{column}`, found `{text}`")]
    NoNumber {
        /// Where.
        location: Box<Location>,
        /// Name of the column.
        column: String,
        /// What the cell holds.
        text: String,
    },
    /// A column of texts where numbers are needed.
    #[error("the column `{column}` of {} holds no numbers", .path.display())]
    Texts {
        /// The table.
        path: PathBuf,
        /// Name of the column.
        column: String,
    },
    /// A quantity that the table does not hold.
    #[error("{} holds no column `{name}`", .path.display())]
    UnknownColumn {
        /// The file.
        path: PathBuf,
        /// The name that was given.
        name: String,
        /// What would be right.
        help: String,
    },
    /// A plane at which the table has no pose.
    #[error("there is no plane {axis} = {value}")]
    NoPlane {
        /// The coordinate.
        axis: String,
        /// What was given.
        value: f64,
        /// What there is.
        known: Vec<f64>,
    },
    /// Of a coordinate that poses have not.
    #[error("`{name}` is no coordinate of these poses")]
    NoCoordinate {
        /// The name that was given.
        name: String,
        /// What would be right.
        help: String,
    },
    /// Two tables of which no pose of one is a pose of the other.
    #[error(
        "no pose of {} is in {}, and they have {} and {} rows",
        .paths[0].display(),
        .paths[1].display(),
        .rows[0],
        .rows[1]
    )]
    NoPartners {
        /// The tables.
        paths: [PathBuf; 2],
        /// Rows of each.
        rows: [usize; 2],
    },
    /// A coordinate that no pose has at this value.
    #[error("no pose has {axis} = {value}")]
    NoPoseAt {
        /// The coordinate.
        axis: String,
        /// What was given.
        value: f64,
        /// What there is.
        known: Vec<f64>,
    },
    /// Coordinates that poses have, but none all of them.
    #[error("no pose has {at} together")]
    NoSuchPoseAt {
        /// The coordinates, in words.
        at: String,
    },
    /// Coordinates that several poses have.
    #[error("{count} poses have {at}")]
    SeveralPosesAt {
        /// The coordinates, in words.
        at: String,
        /// How many.
        count: usize,
        /// Coordinates in which they differ.
        differ: Vec<String>,
    },
    /// Poses of which none can be reached.
    #[error("no pose of job `{job}` can be reached: there is nothing to draw")]
    NoPoses {
        /// The job.
        job: String,
    },
    /// A label for what the figure has not.
    #[error("nothing in the figure is called `{name}`")]
    NoLabel {
        /// The name that was given.
        name: String,
        /// What would be right.
        help: String,
    },
    /// Two tables without the same planes.
    #[error("{} and {} are of other planes", .paths[0].display(), .paths[1].display())]
    OtherPlanes {
        /// The tables.
        paths: [PathBuf; 2],
        /// A plane that both have, as in `z = 0.5 m`.
        common: Option<String>,
    },
    /// Two tables without the same poses.
    #[error("{} and {} are of other poses{}", .paths[0].display(), .paths[1].display(), at(.plane))]
    OtherPoses {
        /// The tables.
        paths: [PathBuf; 2],
        /// Where, as in `z = 0.5 m`; may be empty.
        plane: String,
    },
    /// Values of opposite signs, or zero: no ratio above zero.
    #[error(
        "`{value}` is zero in one table, or has another sign than in the other: it has no ratio above zero"
    )]
    NoRatio {
        /// The quantity.
        value: String,
    },
    /// A plane of a coordinate that nobody asked for.
    #[error("`{axis}` follows from {}: it has no planes", .asked.join(", "))]
    Follows {
        /// The coordinate.
        axis: String,
        /// Those that were asked for.
        asked: Vec<String>,
    },
    /// Planes of so many coordinates that none is left.
    #[error("all coordinates but one are held: there are no two for a map")]
    AllHeld,
    /// A quantity that a table will not hold.
    #[error("there is no quantity `{name}`")]
    NoQuantity {
        /// The name that was given.
        name: String,
        /// What would be right.
        help: String,
    },
    /// Limits of colours that measure something else than the quantity.
    #[error("`limits` of `{name}` are {given}, `{name}` is {wanted}")]
    LimitsMeasure {
        /// The quantity.
        name: String,
        /// What the limits measure.
        given: String,
        /// What the quantity measures.
        wanted: String,
        /// Its unit.
        unit: String,
    },
    /// A design that the job does not have.
    #[error("there is no design {design}")]
    NoDesign {
        /// Its number.
        design: usize,
        /// How many there are.
        count: usize,
    },
    /// A plane normal to one of the axes that lie in it.
    #[error("a plane at one {axis} does not lie along {axis}")]
    AlongNormal {
        /// The coordinate.
        axis: String,
    },
    /// A coordinate that is held at two values.
    #[error("{axis} is held twice")]
    HeldTwice {
        /// The coordinate.
        axis: String,
    },
    /// Several poses at one place of the plane.
    #[error("the table has several poses at {} = {}, {} = {}", .axes[0], .at[0], .axes[1], .at[1])]
    Several {
        /// The coordinates along the axes.
        axes: [String; 2],
        /// Their values there.
        at: [String; 2],
        /// Coordinates in which they differ.
        differ: Vec<String>,
    },
    /// Nothing left to draw.
    #[error("no pose of {} has a result there: there is nothing to draw", .path.display())]
    Nothing {
        /// The file.
        path: PathBuf,
    },
    /// JSON that is not of `solve --why`.
    #[error("not the JSON of `hyperstat solve --why`: {message}")]
    NoSolve {
        /// Where.
        location: Box<Location>,
        /// What is wrong.
        message: String,
    },
    /// JSON of `solve` without `--why`.
    #[error("{} holds no budget", .path.display())]
    NoBudget {
        /// The file.
        path: PathBuf,
    },
    /// A budget of an output that moves freely.
    #[error("{}: the output moves freely: nothing elastic gives, and there is no budget", .path.display())]
    Free {
        /// The file.
        path: PathBuf,
    },
    /// A budget of nothing.
    #[error("{}: the output does not move along this direction: nothing has a share in it", .path.display())]
    NoShares {
        /// The file.
        path: PathBuf,
    },
    /// A mode beyond the last.
    #[error("{} has no mode {number}: it has {count}", .path.display())]
    NoMode {
        /// The file.
        path: PathBuf,
        /// What was given.
        number: usize,
        /// How many there are.
        count: usize,
    },
    /// A design or a pose that the table does not hold.
    #[error("{} holds no {what} {number}", .path.display())]
    NoRows {
        /// The file.
        path: PathBuf,
        /// `design` or `pose`.
        what: &'static str,
        /// What was given.
        number: usize,
        /// The largest that it holds.
        last: usize,
    },
    /// A table of a header alone.
    #[error("{} has no rows: there is nothing to draw", .path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
}

impl PlotError {
    /// The fields of a job's figure that may be to blame, as far as the kind of error tells them.
    pub(crate) fn fields(&self) -> &'static [&'static str] {
        match self {
            Self::NoPlane { .. }
            | Self::Follows { .. }
            | Self::AlongNormal { .. }
            | Self::HeldTwice { .. } => &["plane", "planes"],
            Self::NoCoordinate { .. } => &["axes", "plane", "planes"],
            Self::NoLabel { .. } => &["labels"],
            Self::LimitsMeasure { .. } => &["limits"],
            Self::NoDesign { .. } => &["beside"],
            _ => &[],
        }
    }

    /// The place in the table that the error is about.
    pub fn location(&self) -> Option<&Location> {
        match self {
            Self::NoRun { location, .. }
            | Self::Cells { location, .. }
            | Self::NoNumber { location, .. }
            | Self::NoSolve { location, .. } => Some(location),
            _ => None,
        }
    }

    /// What would be right.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Extension { .. } | Self::NoRun { .. } => {
                Some("give a table that `hyperstat run` wrote, such as `out/delta-map.csv`".into())
            }
            Self::NoSolve { .. } | Self::NoBudget { .. } => Some(
                "give what `hyperstat solve FILE.ron --why --format json` prints, or FILE.ron itself"
                    .into(),
            ),
            Self::Free { .. } => Some("lock a drive or make it elastic".into()),
            Self::NoShares { .. } => Some("give another direction".into()),
            Self::NoMode { count: 0, .. } => {
                Some("nothing that moves has mass: give the materials a `density`".into())
            }
            Self::NoMode { count, .. } => Some(format!(
                "choose a mode from 1 to {count}: no more coordinates have mass (of consistent and \
                 lumped masses, more `elements` a segment make more)"
            )),
            Self::Cells { .. } | Self::NoNumber { .. } => {
                Some("the table is not as `hyperstat run` wrote it; run the batch again".into())
            }
            Self::Texts { .. } => Some("choose a column of numbers".into()),
            Self::UnknownColumn { help, .. }
            | Self::NoCoordinate { help, .. }
            | Self::NoLabel { help, .. }
            | Self::NoQuantity { help, .. } => Some(help.clone()),
            Self::NoDesign { count: 1, .. } => {
                Some("the job has one: give it `vary`, or leave `beside` out".into())
            }
            Self::NoDesign { count, .. } => {
                Some(format!("the job's designs are 0 to {}", count - 1))
            }
            Self::LimitsMeasure { unit, .. } => Some(match &**unit {
                "" => "write the numbers alone".into(),
                unit => format!("give them in {unit}, or without a unit"),
            }),
            Self::Follows { asked, .. } => {
                Some(format!("choose a plane of {}, or none", asked.join(", ")))
            }
            Self::NoPartners { .. } => Some("give tables of the same poses".into()),
            Self::NoPoseAt { axis, known, .. } => Some(planes(axis, known)
                .replace("there are planes at ", "poses have ")
                .replace("there is one at ", "poses have ")),
            Self::NoSuchPoseAt { .. } => Some("give the pose by its number".into()),
            Self::SeveralPosesAt { differ, .. } => Some(match &**differ {
                [] => "they are the same: give the pose by its number".into(),
                differ => format!("say {}, too", differ.join(" and ")),
            }),
            Self::OtherPlanes { common, .. } => Some(match common {
                Some(plane) => format!("choose a plane of both, such as {plane}"),
                None => "run both over the same poses".into(),
            }),
            Self::OtherPoses { .. } => Some("run both over the same poses".into()),
            Self::NoRatio { .. } => {
                Some("choose a quantity above zero, such as `k33` or `deflection`".into())
            }
            Self::AllHeld => Some("leave out some of the planes".into()),
            Self::NoPlane { axis, known, .. } => Some(planes(axis, known)),
            Self::HeldTwice { .. } => Some(
                "hold it once: on all planes, or on each of some side by side, as in `--planes x=0,z=0.5`".into(),
            ),
            Self::AlongNormal { .. } => Some("choose other axes, or another plane".into()),
            Self::Several { differ, .. } => Some(match &**differ {
                [] => "the same pose is there more than once: draw lines over `pose`".into(),
                differ => format!("choose among them by a plane of {}", differ.join(" and of ")),
            }),
            Self::NoRows { what, last: 0, .. } => {
                Some(format!("{what}s are counted from 0: leave the {what} out"))
            }
            Self::NoRows { what, last, .. } => Some(format!(
                "choose a {what} from 0 to {last}: {what}s are counted from 0"
            )),
            Self::Empty { .. } => {
                Some("`hyperstat run` writes a row for every pose; run the batch again".into())
            }
            _ => None,
        }
    }
}

/// Where, where that is told.
fn at(plane: &str) -> String {
    match plane {
        "" => String::new(),
        plane => format!(" at {plane}"),
    }
}

/// The planes that there are, in words.
fn planes(axis: &str, known: &[f64]) -> String {
    const MOST: usize = 12;
    let list = |values: &[f64]| {
        let values: Vec<_> = values.iter().map(|value| digits(*value, known)).collect();
        values.join(", ")
    };
    match known {
        [] => "the table has no pose".into(),
        known if known.len() <= MOST => format!("there are planes at {axis} = {}", list(known)),
        [first, .., last] => format!(
            "there are {} planes from {axis} = {} to {}: {}, …",
            known.len(),
            list(&[*first]),
            list(&[*last]),
            list(&known[..MOST])
        ),
        [only] => format!("there is one at {axis} = {}", list(&[*only])),
    }
}
