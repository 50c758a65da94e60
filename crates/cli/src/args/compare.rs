//! The options of `hyperstat compare`.

use std::path::PathBuf;

use clap::Args;
use hyperstat_mechanisms::Along;
use hyperstat_study::Selection;

use super::input::{Dwelling, Format, Input, number_of_pose};

pub(super) const COMPARE_HELP: &str = "\
Of mechanisms: parameters and parts that differ, then stiffness, displacement, measures, natural
frequencies, and where the deflection comes from, of the first (A), of the second (B), and B/A. Sections
and materials are compared as those of the bodies that have them, whatever they are called; coordinates
that differ by rounding only (1e-12) are the same.
Of tables of `run`: rows of the same pose are compared, else rows of the same number; how often each pair
of statuses comes, and of every column and measure where the two are furthest apart and the least, median
and greatest ratio B/A.
The text tells what differs most, JSON all. It ends with 0, whatever differs.

Examples:
  hyperstat compare portal.ron stiffer.ron
  hyperstat compare study.ron --design 0 --with-design 3
                                             Two designs of a job that varies
  hyperstat compare study.ron --pose 0 --with-pose 20 --along z
  hyperstat compare portal.ron stiffer.ron --out change
                                             The two budgets as bars, SVG and PNG
  hyperstat compare before/map.csv after/map.csv
  hyperstat plot before/map.csv --map k33 --beside after/map.csv --ratio
                                             The same as a map of B/A";

/// `hyperstat compare`
#[derive(Debug, Args)]
pub(crate) struct Compare {
    #[command(flatten)]
    pub(crate) input: Input,
    /// What the file is compared with: another mechanism or batch file, or, of a table, another table
    /// [default: the same file]
    #[arg(value_name = "OTHER")]
    other: Option<PathBuf>,
    /// Job of OTHER [default: that of --job]
    #[arg(long, value_name = "NAME")]
    with_job: Option<String>,
    /// Design of OTHER [default: that of --design]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    with_design: Option<usize>,
    /// Pose of OTHER [default: that of --pose]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number_of_pose)]
    with_pose: Option<usize>,
    #[command(flatten)]
    pub(crate) dwelling: Dwelling,
    /// Draw both budgets as bars too: NAME.svg and NAME.png
    #[arg(long, value_name = "NAME")]
    pub(crate) out: Option<PathBuf>,
    /// Form of the report on standard output
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

impl Compare {
    /// What is compared with: a file, and what is chosen of it; `None` where nothing is said of it.
    pub(crate) fn with(&self) -> Option<(PathBuf, Selection)> {
        let own = self.input.selection();
        let chosen = self.chosen_with();
        if self.other.is_none() && chosen == Selection::default() {
            return None;
        }
        let file = self
            .other
            .clone()
            .unwrap_or_else(|| self.input.file.clone());
        let chosen = Selection {
            job: chosen.job.or(own.job),
            design: chosen.design.or(own.design),
            pose: chosen.pose.or(own.pose),
        };
        Some((file, chosen))
    }

    /// What is chosen of the other alone.
    pub(crate) fn chosen_with(&self) -> Selection {
        Selection {
            job: self.with_job.clone(),
            design: self.with_design,
            pose: self.with_pose,
        }
    }

    /// The first option that is given and has no meaning for tables.
    pub(crate) fn of_mechanisms(&self) -> Option<&'static str> {
        let own = self.input.selection();
        let given = [
            ("--job", own.job.is_some()),
            ("--design", own.design.is_some()),
            ("--pose", own.pose.is_some()),
            ("--with-job", self.with_job.is_some()),
            ("--with-design", self.with_design.is_some()),
            ("--with-pose", self.with_pose.is_some()),
            ("--case", self.dwelling.case.is_some()),
            ("--modes", self.dwelling.modes.is_some()),
            ("--along", self.dwelling.along != Along::Displacement),
            ("--out", self.out.is_some()),
        ];
        given
            .into_iter()
            .find_map(|(option, given)| given.then_some(option))
    }
}
