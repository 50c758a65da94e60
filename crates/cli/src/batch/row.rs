//! The lines of a job's CSV file.

use std::fmt::Write as _;

use hyperstat_assembly::{PoseResult, SolveError};
use hyperstat_mechanisms::PoseError;
use nalgebra::{Matrix6, Vector6};
use thiserror::Error;

/// Why a pose has no result.
#[derive(Debug, Clone, Error)]
pub(crate) enum Failure {
    /// The mechanism cannot take the pose.
    #[error(transparent)]
    Pose(PoseError),
    /// The mechanism has no solution there.
    #[error(transparent)]
    Solve(SolveError),
    /// The output moves without energy.
    #[error("the output moves freely, drives locked")]
    Free,
    /// The output is held rigidly in some direction.
    #[error("the output is rigidly held in some direction: it has no finite stiffness")]
    Rigid,
}

impl Failure {
    /// The word for it in the CSV file.
    pub(crate) fn status(&self) -> &'static str {
        match self {
            Self::Pose(PoseError::Unreachable { .. }) => "unreachable",
            Self::Solve(SolveError::Unheld { .. } | SolveError::LoadOnFreeMotion { .. })
            | Self::Free => "unrestrained",
            Self::Pose(PoseError::Singular { .. }) => "singular",
            Self::Rigid => "rigid",
            Self::Pose(_) | Self::Solve(_) => "failed",
        }
    }
}

/// What a sweep found at one pose.
#[derive(Debug)]
pub(crate) struct Record {
    /// Pose of the output: x y z [m], rotation vector [rad].
    pub(crate) pose: [f64; 6],
    pub(crate) result: Result<Found, Failure>,
}

/// The output at one pose, in global axes.
#[derive(Debug, Clone)]
pub(crate) struct Found {
    pub(crate) stiffness: Matrix6<f64>,
    pub(crate) displacement: Vector6<f64>,
}

impl TryFrom<PoseResult> for Found {
    type Error = Failure;

    fn try_from(result: PoseResult) -> Result<Self, Failure> {
        Ok(Self {
            displacement: result.displacement.ok_or(Failure::Free)?,
            stiffness: result.stiffness.ok_or(Failure::Rigid)?,
        })
    }
}

/// The first line of a CSV file.
pub(crate) fn header() -> String {
    let mut line = String::from("pose,x,y,z,rx,ry,rz,status,dx,dy,dz,drx,dry,drz");
    for row in 1..=6 {
        for column in row..=6 {
            // Writing to a String cannot fail.
            let _ = write!(line, ",k{row}{column}");
        }
    }
    line + "\n"
}

/// Appends the line of pose number `pose` to `text`. Numbers read back to the same double.
pub(crate) fn append(text: &mut String, pose: usize, record: &Record) {
    // Writing to a String cannot fail.
    let _ = write!(text, "{pose}");
    for coordinate in record.pose {
        append_number(text, coordinate);
    }
    match &record.result {
        Ok(found) => {
            *text += ",ok";
            for component in found.displacement.iter() {
                append_number(text, *component);
            }
            for row in 0..6 {
                for column in row..6 {
                    append_number(text, found.stiffness[(row, column)]);
                }
            }
        }
        Err(failure) => {
            let _ = write!(text, ",{}{}", failure.status(), ",".repeat(NUMBERS));
        }
    }
    text.push('\n');
}

/// Six components of the displacement and the upper triangle of the stiffness.
const NUMBERS: usize = 6 + 21;

/// The shortest decimal number that reads back to `value`.
fn append_number(text: &mut String, value: f64) {
    let _ = write!(text, ",{value:?}");
}

#[cfg(test)]
mod tests {
    use hyperstat_mechanisms::PoseError;
    use nalgebra::{Matrix6, Vector6};

    use super::{Failure, Found, Record, append, header};

    #[test]
    fn the_header_is_that_of_the_format() {
        let line = header();
        assert!(line.starts_with("pose,x,y,z,rx,ry,rz,status,dx,dy,dz,drx,dry,drz,k11,k12,k13,"));
        assert!(
            line.ends_with(",k16,k22,k23,k24,k25,k26,k33,k34,k35,k36,k44,k45,k46,k55,k56,k66\n")
        );
    }

    #[test]
    fn numbers_read_back_to_the_same_double() {
        let found = Found {
            stiffness: Matrix6::from_fn(|r, c| 1e8 / (1.0 + (r.min(c) * 6 + r.max(c)) as f64)),
            displacement: Vector6::new(0.1 + 0.2, -1.0 / 3.0, 5e-324, 1e300, -0.0, 1e-7),
        };
        let mut text = String::new();
        let record = Record {
            pose: [1.0 / 7.0, 0.0, 0.5, 0.0, 0.0, -1e-20],
            result: Ok(found.clone()),
        };
        append(&mut text, 12, &record);
        let cells: Vec<_> = text.trim_end().split(',').collect();
        let header = header();
        let names: Vec<_> = header.trim_end().split(',').collect();
        assert_eq!(cells.len(), names.len());
        let cell = |name: &str| cells[names.iter().position(|n| *n == name).unwrap()];
        let number = |name: &str| cell(name).parse::<f64>().unwrap();
        assert_eq!(cell("pose"), "12");
        assert_eq!(cell("status"), "ok");
        assert_eq!(number("x"), record.pose[0]);
        assert_eq!(number("rz"), record.pose[5]);
        for (k, name) in ["dx", "dy", "dz", "drx", "dry", "drz"].iter().enumerate() {
            assert_eq!(number(name).to_bits(), found.displacement[k].to_bits());
        }
        for row in 0..6 {
            for column in row..6 {
                let name = format!("k{}{}", row + 1, column + 1);
                assert_eq!(number(&name), found.stiffness[(row, column)]);
            }
        }
    }

    #[test]
    fn a_pose_without_result_has_empty_numbers() {
        let what = "too far".to_string();
        let record = Record {
            pose: [9.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            result: Err(Failure::Pose(PoseError::Unreachable { what })),
        };
        let mut text = String::new();
        append(&mut text, 0, &record);
        assert!(text.starts_with("0,9.0,0.0,0.0,0.0,0.0,0.0,unreachable,,"));
        assert_eq!(text.matches(',').count(), header().matches(',').count());
        assert!(text.trim_end().ends_with(&",".repeat(27)));
    }
}
