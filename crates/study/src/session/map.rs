//! A quantity over one or two coordinates of the output, some rows at a time.

use std::ops::Range;

use hyperstat_mechanisms::{Job, JobPoses};
use serde::Serialize;

use super::answer::append;
use super::loaded::{Subject, unknown_coordinate};
use super::refused::Refused;
use super::request::SweepAsked;
use crate::error::StudyError;
use crate::gradient::Quantity;
use crate::measures::{Measure, Pose};
use crate::scene::Span;
use crate::schema::{self, COORDINATES};
use crate::sweep::{Found, Record, Sweep, Way};

/// Most rows of a sweep, and most that are kept for another quantity of them.
const MOST_ROWS: usize = 4_000_000;
const MOST_KEPT: usize = 20_000;

/// What was found in some rows. Field names are those of the JSON.
#[derive(Debug, Serialize)]
pub struct Mapped {
    /// First row and the one after the last.
    pub rows: [usize; 2],
    /// How many rows there are in all.
    pub total: usize,
    /// Name of the quantity.
    pub measure: String,
    /// Its unit.
    pub unit: &'static str,
    /// Where the values are, one a row; NaN where there is none.
    pub values: Span,
    /// Where the places of the statuses are, one a row.
    pub codes: Span,
    /// The words for how rows came out.
    pub statuses: Vec<&'static str>,
}

/// A job over all rows of a sweep.
#[derive(Debug)]
pub(super) struct Ready {
    asked: SweepAsked,
    job: Job,
    /// The rows that were solved last, with what was found.
    kept: Option<(Range<usize>, Vec<Record>)>,
}

impl Subject {
    /// A quantity over coordinates, with the numbers.
    pub(super) fn sweep(&mut self, asked: SweepAsked) -> Result<(Mapped, Vec<f64>), Refused> {
        let named = Quantity::named(&asked.measure);
        let quantity = named.ok_or_else(|| unknown_quantity(&asked.measure))?;
        let case = match &asked.case {
            None => None,
            Some(name) => Some(self.case(name)?),
        };
        let rows = asked.rows;
        let whole = SweepAsked {
            measure: String::new(),
            case: None,
            rows: None,
            ..asked.clone()
        };
        let mut ready = match self.ready.take().filter(|ready| ready.asked == whole) {
            Some(ready) => ready,
            None => Ready {
                job: self.swept(&whole)?,
                asked: whole,
                kept: None,
            },
        };
        let total = ready.job.len();
        let [first, end] = rows.unwrap_or([0, total]);
        let rows = first.min(total)..end.clamp(first, total.max(first)).min(total);
        let records = match ready.kept.take().filter(|(own, _)| *own == rows) {
            Some((_, records)) => records,
            None => Sweep::new(&ready.job, Way::Lanes)?.records(rows.clone()),
        };
        let mut statuses = Vec::new();
        let mut code = |record: &Record| {
            let status = record.status();
            let place = statuses.iter().position(|own| *own == status);
            place.unwrap_or_else(|| {
                statuses.push(status);
                statuses.len() - 1
            }) as f64
        };
        let codes: Vec<f64> = records.iter().map(&mut code).collect();
        let value = |found: &Found| {
            let displacement = match case {
                Some(case) => found.of_case(case)?,
                None => found.displacement,
            };
            quantity.value(&Pose::new(&found.stiffness), &displacement)
        };
        let value = |record: &Record| {
            let found = record.result.as_ref().ok();
            found.and_then(value).unwrap_or(f64::NAN)
        };
        let mut numbers = Vec::with_capacity(2 * records.len());
        let values = append(&mut numbers, records.iter().map(value));
        let codes = append(&mut numbers, codes);
        if records.len() <= MOST_KEPT {
            ready.kept = Some((rows.clone(), records));
        }
        self.ready = Some(ready);
        let mapped = Mapped {
            rows: [rows.start, rows.end],
            total,
            unit: match quantity {
                Quantity::Measure(measure) => measure.unit,
                _ => schema::unit(&asked.measure),
            },
            measure: asked.measure,
            values,
            codes,
            statuses,
        };
        Ok((mapped, numbers))
    }

    /// The number of a case.
    fn case(&self, name: &str) -> Result<usize, StudyError> {
        let known = self.job.cases();
        let place = known.iter().position(|own| own == name);
        place.ok_or_else(|| StudyError::UnknownCase {
            of: format!("job `{}`", self.job.name),
            case: name.into(),
            known: known.to_vec(),
        })
    }

    /// The job that has a pose a row.
    fn swept(&self, asked: &SweepAsked) -> Result<Job, Refused> {
        let counts = asked.axes.iter().map(|axis| axis.count);
        let total = counts.clone().try_fold(1_usize, usize::checked_mul);
        let total = total.filter(|total| *total <= MOST_ROWS);
        if asked.axes.is_empty() || asked.axes.len() > 2 || counts.min() == Some(0) {
            return Err(Refused::Unknown {
                message: "a sweep without a value, or over other than one or two coordinates"
                    .into(),
                help: "give one axis or two, each of at least one value".into(),
            });
        }
        let Some(total) = total else {
            return Err(Refused::Unknown {
                message: "more rows than a sweep has room for".into(),
                help: format!("there may be {MOST_ROWS}: give fewer values"),
            });
        };
        let mut asked_for = asked.fixed.clone();
        for axis in &asked.axes {
            if !COORDINATES.contains(&&*axis.name) {
                return Err(unknown_coordinate(&axis.name));
            }
            asked_for.insert(axis.name.clone(), axis.first);
        }
        let named = self.whole(&asked_for)?;
        let mut rows = Vec::with_capacity(total * named.len());
        let width = asked.axes[0].count;
        for row in 0..total {
            let place = [row % width, row / width];
            rows.extend(named.iter().map(|(name, value)| {
                let mut axes = asked.axes.iter().zip(place);
                let own = axes.find(|(axis, _)| axis.name == *name);
                own.map_or(*value, |(axis, place)| axis.value(place))
            }));
        }
        let columns = named.into_iter().map(|(name, _)| name).collect();
        let mut job = self.job.clone();
        job.leave_columns();
        job.modes = None;
        job.set_poses(JobPoses::Table { columns, rows })?;
        Ok(job)
    }
}

fn unknown_quantity(name: &str) -> Refused {
    let known: Vec<&str> = Measure::all().iter().map(|own| own.name).collect();
    Refused::Unknown {
        message: format!("unknown measure `{name}`"),
        help: format!(
            "the measures are {}; or a column of stiffness or displacement, k11 to k66, dx to drz",
            known.join(", ")
        ),
    }
}
