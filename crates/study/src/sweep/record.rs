//! What a sweep finds at one pose.

use std::sync::Arc;

use hyperstat_assembly::{PoseResult, SolveError};
use hyperstat_mechanisms::{LoadError, PoseError};
use nalgebra::{Matrix6, Vector6};
use thiserror::Error;

use crate::measures::{self, Pose};

/// What stands in a further column of a row.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum Cell {
    /// Nothing: the pose has none of it.
    #[default]
    Empty,
    /// A number.
    Number(f64),
    /// A text.
    Text(Arc<str>),
}

impl Cell {
    /// The number that it is.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// The text that it is.
    pub fn text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text),
            _ => None,
        }
    }
}

impl From<f64> for Cell {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<Option<f64>> for Cell {
    fn from(number: Option<f64>) -> Self {
        number.map_or(Self::Empty, Self::Number)
    }
}

/// Why a pose has no result.
#[derive(Debug, Clone, Error)]
pub enum Failure {
    /// The varied values make no mechanism.
    #[error(transparent)]
    Design(Arc<LoadError>),
    /// The mechanism cannot take the pose.
    #[error(transparent)]
    Pose(#[from] PoseError),
    /// The mechanism has no solution there.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The output moves without energy.
    #[error("the output moves freely, drives locked")]
    Free,
    /// The output is held rigidly in some direction.
    #[error("the output is rigidly held in some direction: it has no finite stiffness")]
    Rigid(Box<Held>),
}

/// What is known of an output that is rigidly held in some direction.
#[derive(Debug, Clone)]
pub struct Held {
    /// Displacement of the output: x y z \[m\], rx ry rz \[rad\].
    pub displacement: Vector6<f64>,
    /// As of [`Found`].
    pub further: Vec<Cell>,
}

impl Failure {
    /// All words for one in a table.
    #[cfg(feature = "parts")]
    pub(crate) const STATUSES: [&'static str; 7] = [
        "design",
        "unreachable",
        "singular",
        "branch",
        "unrestrained",
        "rigid",
        "failed",
    ];

    /// What is wrong, and what would be right where that can be said.
    pub fn in_words(&self) -> String {
        match self {
            Self::Design(error) => match error.help() {
                Some(help) => format!("{error}; {help}"),
                None => error.to_string(),
            },
            other => other.to_string(),
        }
    }

    /// The word for it in a table.
    pub fn status(&self) -> &'static str {
        match self {
            Self::Design(_) => "design",
            Self::Pose(error) => error.status(),
            Self::Solve(
                SolveError::Unheld { .. }
                | SolveError::LoadOnFreeMotion { .. }
                | SolveError::PreloadOnFreeMotion { .. },
            )
            | Self::Free => "unrestrained",
            Self::Rigid(_) => "rigid",
            Self::Solve(_) => "failed",
        }
    }
}

/// What a sweep found at one pose.
#[derive(Debug)]
pub struct Record {
    /// Pose of the output: x y z \[m\], rotation vector \[rad\]; `None` where it is not known.
    pub pose: [Option<f64>; 6],
    /// What was found there, or why nothing was.
    pub result: Result<Found, Failure>,
}

impl Record {
    /// The displacement of the output and what stands in further columns, where they are known.
    pub fn known(&self) -> Option<(&Vector6<f64>, &[Cell])> {
        match &self.result {
            Ok(found) => Some((&found.displacement, &found.further)),
            Err(Failure::Rigid(held)) => Some((&held.displacement, &held.further)),
            Err(_) => None,
        }
    }

    /// What was found at a pose that was reached. No result has a number that is not finite.
    pub fn reached(pose: [f64; 6], result: Result<Found, Failure>) -> Self {
        let known = pose.map(|coordinate| Some(coordinate).filter(|c| c.is_finite()));
        let finite = known.iter().all(Option::is_some)
            && match &result {
                Ok(found) => found.is_finite(),
                Err(Failure::Rigid(held)) => all_finite(&held.displacement, &held.further),
                Err(_) => true,
            };
        Self {
            result: match finite {
                true => result,
                false => Err(SolveError::Overflow.into()),
            },
            pose: known,
        }
    }

    /// The word for the outcome in a table.
    pub fn status(&self) -> &'static str {
        match &self.result {
            Ok(_) => "ok",
            Err(failure) => failure.status(),
        }
    }
}

/// The output at one pose, in global axes.
#[derive(Debug, Clone)]
pub struct Found {
    /// Stiffness of the output \[N/m, N/rad; N, N·m/rad\].
    pub stiffness: Matrix6<f64>,
    /// Its displacement under the loads: x y z \[m\], rx ry rz \[rad\].
    pub displacement: Vector6<f64>,
    /// What stands in the table's further columns.
    pub further: Vec<Cell>,
}

impl Found {
    /// The upper triangle of the stiffness by rows.
    pub fn upper(&self) -> [f64; UPPER] {
        let mut numbers = [0.0; UPPER];
        let upper = (0..6).flat_map(|row| (row..6).map(move |column| (row, column)));
        for (number, place) in numbers.iter_mut().zip(upper) {
            *number = self.stiffness[place];
        }
        numbers
    }

    /// Its inverse \[m/N, m/(N·m); rad/N, rad/(N·m)\]; `None` of a stiffness that is not positive definite.
    pub fn compliance(&self) -> Option<Matrix6<f64>> {
        Pose::new(&self.stiffness).compliance().copied()
    }

    /// A measure by its name, such as `deflection` or `softest_force` (`hyperstat plot`'s, SI); `None` where
    /// it has none, or there is no such measure.
    pub fn measure(&self, name: &str) -> Option<f64> {
        let rule = measures::named(name)?.rule;
        Pose::new(&self.stiffness).measure(rule, &self.displacement)
    }

    /// The displacement in a load case, by its number in the job.
    pub(crate) fn of_case(&self, case: usize) -> Option<Vector6<f64>> {
        let own = self.further.get(6 * case..6 * case + 6)?;
        let numbers: Vec<f64> = own.iter().filter_map(Cell::number).collect();
        (numbers.len() == 6).then(|| Vector6::from_column_slice(&numbers))
    }

    fn is_finite(&self) -> bool {
        let stiffness = self.upper().iter().all(|number| number.is_finite());
        stiffness && all_finite(&self.displacement, &self.further)
    }
}

fn all_finite(displacement: &Vector6<f64>, further: &[Cell]) -> bool {
    let mut further = further.iter().filter_map(Cell::number);
    displacement.iter().all(|n| n.is_finite()) && further.all(f64::is_finite)
}

/// Numbers in the upper triangle of the stiffness.
pub const UPPER: usize = 21;
/// Six components of the displacement and the upper triangle of the stiffness.
pub const NUMBERS: usize = 6 + UPPER;

impl TryFrom<PoseResult> for Found {
    type Error = Failure;

    fn try_from(result: PoseResult) -> Result<Self, Failure> {
        let displacement = result.displacement.ok_or(Failure::Free)?;
        let further = result
            .cases
            .iter()
            .flatten()
            .copied()
            .map(Cell::Number)
            .collect();
        match result.stiffness {
            Some(stiffness) => Ok(Self {
                stiffness,
                displacement,
                further,
            }),
            None => Err(Failure::Rigid(Box::new(Held {
                displacement,
                further,
            }))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever path a number comes by, no row is `ok` with one that is not finite.
    #[test]
    fn a_number_that_is_not_finite_is_no_result() {
        let sound = Found {
            stiffness: Matrix6::identity(),
            displacement: Vector6::zeros(),
            further: vec![Cell::Number(1.0), Cell::Empty],
        };
        let status = |pose: f64, found: Found| {
            let record = Record::reached([0.0, pose, 0.0, 0.0, 0.0, 0.0], Ok(found));
            assert!(record.pose.iter().flatten().all(|c| c.is_finite()));
            record.status()
        };
        assert_eq!(status(0.5, sound.clone()), "ok");
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(status(value, sound.clone()), "failed");
            let mut spoilt = sound.clone();
            spoilt.stiffness[(2, 5)] = value;
            assert_eq!(status(0.5, spoilt), "failed");
            let mut spoilt = sound.clone();
            spoilt.displacement[3] = value;
            assert_eq!(status(0.5, spoilt), "failed");
            let mut spoilt = sound.clone();
            spoilt.further[0] = Cell::Number(value);
            assert_eq!(status(0.5, spoilt), "failed");
        }
    }
}
