//! What `run` says about a job when it is done.

use std::fmt;

use hyperstat_study::parts::Outcome;
use hyperstat_study::sweep::Failures;

use super::parts::stiffness_table;
use super::statistics::Told;

/// An outcome in words.
pub(crate) struct Said<'o>(pub(crate) &'o Outcome);

impl fmt::Display for Said<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(outcome) = self;
        let count = |count: usize, what: &str| match count {
            1 => format!("1 {what}"),
            count => format!("{count} {what}s"),
        };
        let mut poses = count(outcome.summary.poses, "pose");
        if let Some(designs) = outcome.summary.designs {
            poses = format!("{}, {poses}", count(designs, "design"));
        }
        if let Some((first, all)) = outcome.part {
            let end = first + outcome.summary.poses;
            poses = match outcome.summary.poses {
                0 => format!("none of its {all} rows"),
                _ => format!("rows {first}..{end} of {all}"),
            };
        }
        let failed: usize = outcome
            .summary
            .failures
            .iter()
            .map(|failures| failures.count)
            .sum();
        match failed {
            0 => writeln!(f, "{}: {poses}, all solved", outcome.summary.job)?,
            _ => writeln!(
                f,
                "{}: {poses}, {failed} without a result",
                outcome.summary.job
            )?,
        }
        for Failures {
            status,
            count,
            first_pose,
            why,
        } in &outcome.summary.failures
        {
            let (design, pose) = (
                first_pose / outcome.summary.of_design,
                first_pose % outcome.summary.of_design,
            );
            let design = match outcome.summary.designs {
                Some(_) => format!("design {design}, "),
                None => String::new(),
            };
            writeln!(
                f,
                "  {count} {status}, the first of them {design}pose {pose}: {why}"
            )?;
        }
        for warning in &outcome.warnings {
            writeln!(f, "  warning: {warning}")?;
        }
        for path in &outcome.files {
            writeln!(f, "  {}", path.display())?;
        }
        for (figure, why) in &outcome.left_out {
            writeln!(f, "  no {figure}: {why}")?;
        }
        if let Some(difference) = outcome.largest_difference {
            writeln!(
                f,
                "  largest difference from the reference solver in the figures: {difference:.1e} \
                 of the largest displacement"
            )?;
        }
        if !outcome.measures.is_empty() {
            write!(f, "{}", Told(&outcome.measures))?;
        }
        if let (1, Some(stiffness)) = (outcome.summary.poses, &outcome.summary.stiffness) {
            write!(
                f,
                "  stiffness of the output [N/m, N/rad; N, N·m/rad]\n{}",
                stiffness_table(&std::array::from_fn(|r| stiffness
                    .row(r)
                    .into_owned()
                    .into()))
            )?;
        }
        Ok(())
    }
}
