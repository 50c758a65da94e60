//! What several commands take: a file and what is chosen of it, a direction, the form of a report.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use hyperstat_mechanisms::Along;
use hyperstat_study::{Asked, Focus, Selection};

/// What is to be solved, checked or exported.
#[derive(Debug, Args)]
pub(crate) struct Input {
    /// Mechanism file or batch file (RON or JSON)
    #[arg(value_name = "FILE.ron")]
    pub(crate) file: PathBuf,
    /// Job of a batch file; may be left out where there is only one
    #[arg(long, value_name = "NAME")]
    pub(crate) job: Option<String>,
    /// Design of a job that varies, counted from 0 [default: 0]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) design: Option<usize>,
    /// Pose of the job, counted from 0 [default: 0]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number_of_pose)]
    pub(crate) pose: Option<usize>,
}

impl Input {
    /// What is chosen of a batch file.
    pub(crate) fn selection(&self) -> Selection {
        Selection {
            job: self.job.clone(),
            design: self.design,
            pose: self.pose,
        }
    }
}

/// What a comparison or a report dwells on.
#[derive(Debug, Args)]
pub(crate) struct Dwelling {
    /// Direction of the budget, as of `solve --why`; `displacement` of a comparison is that of the first
    #[arg(
        long,
        value_name = "DIRECTION",
        value_parser = along,
        default_value = "displacement",
        allow_hyphen_values = true
    )]
    pub(crate) along: Along,
    /// The case whose displacement and budget are told [default: the loads of no case]
    #[arg(long, value_name = "NAME")]
    pub(crate) case: Option<String>,
    /// Tell the N lowest natural frequencies [default: a job's `modes`, or 3 where all that moves has mass]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub(crate) modes: Option<u16>,
}

impl Dwelling {
    /// The same as the library takes it.
    pub(crate) fn focus(&self) -> Focus {
        Focus {
            asked: Asked {
                case: self.case.clone(),
                along: self.along,
            },
            modes: self.modes.map(usize::from),
        }
    }
}

/// Form of a report.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// Tables to read
    #[default]
    Text,
    /// JSON, numbers that read back to the same double
    Json,
}

/// Reads the number of a pose.
pub(super) fn number_of_pose(text: &str) -> Result<usize, String> {
    let right = "expected the number of a pose, from 0: the column `pose` of the job's table";
    text.parse().map_err(|_| right.into())
}

/// Reads the direction that the output gives along.
pub(super) fn along(text: &str) -> Result<Along, String> {
    if let Some(named) = Along::named(text) {
        return Ok(named);
    }
    let numbers: Result<Vec<f64>, _> = text
        .split(',')
        .map(|number| number.trim().parse())
        .collect();
    let right = format!(
        "`{}` or three numbers such as `0,1,-1`",
        Along::WORDS.join("`, `")
    );
    match numbers.as_deref() {
        Ok(&[a, b, c]) => Along::direction([a, b, c])
            .ok_or_else(|| format!("a direction has a length; give {right}")),
        _ => Err(format!("give {right}")),
    }
}
