//! A job's rows: looked up where they are there, computed where they are not, joined.

mod compute;
mod join;

use std::ops::Range;
use std::time::Duration;

use hyperstat_mechanisms::Batch;

use super::error::PartsError;
use super::manifest::{Manifest, folder, stem};
use super::missing::Missing;
use super::origin::Origin;
use super::part::{Part, Share};
use super::pieces::{self, Pieces};
use super::plan::{Step, computed, plan};
use super::shelf::Shelf;
use crate::error::StudyError;
use crate::figure;
use crate::ran::Ran;
use crate::sweep::{Columns, Sweep, Threads, Way};
use crate::table;

/// The sweeps of all jobs of a batch, which are checked before the first runs.
///
/// # Errors
/// A job whose figures are of nothing that its table will hold, or that cannot be swept.
pub fn sweeps_of(batch: &Batch, way: Way) -> Result<Vec<Sweep<'_>>, StudyError> {
    let sweep = |job| {
        figure::check(job, &table::numeric(&Columns::of(job)))?;
        Sweep::new(job, way)
    };
    batch.jobs.iter().map(sweep).collect()
}

/// How a run does its jobs.
#[derive(Clone)]
pub struct Work<'w> {
    /// Where its files are.
    pub shelf: &'w dyn Shelf,
    /// All that was read and asked for.
    pub origin: &'w Origin,
    /// The rows of every job that are asked for.
    pub part: Part,
    /// Threads that solve.
    pub threads: &'w Threads,
    /// What is done for so long is kept as a piece.
    pub secured_every: Duration,
    /// Says when to stop: what is done then is kept, too, and nothing is joined any more.
    pub stop: &'w (dyn Fn() -> bool + Sync),
}

impl std::fmt::Debug for Work<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Work")
            .field("part", &self.part)
            .finish_non_exhaustive()
    }
}

impl<'w> Work<'w> {
    /// That of joining what parts have, until `stop` says so: nothing is computed.
    pub fn of_parts(
        shelf: &'w dyn Shelf,
        origin: &'w Origin,
        threads: &'w Threads,
        stop: &'w (dyn Fn() -> bool + Sync),
    ) -> Self {
        Self {
            shelf,
            origin,
            part: Part::Whole,
            threads,
            secured_every: Duration::MAX,
            stop,
        }
    }

    /// What there is of every job, without tables that are joined already where only parts count; and what is
    /// missing.
    ///
    /// # Errors
    /// The folder has parts of another run, or cannot be read.
    pub fn gather(
        &self,
        sweeps: &[Sweep<'_>],
        parts_alone: bool,
    ) -> Result<(Vec<Found>, Missing), PartsError> {
        let mut all = Vec::with_capacity(sweeps.len());
        let mut missing = Missing::default();
        for sweep in sweeps {
            let mut found = self.look(sweep, false)?;
            if parts_alone {
                found = found.parts_alone();
            }
            found.missing(&mut missing);
            all.push(found);
        }
        Ok((all, missing))
    }
}

/// What is there of the rows of a job that are asked for, and what is to be computed.
#[derive(Debug)]
pub struct Found {
    rows: Range<usize>,
    pieces: Pieces,
    steps: Vec<Step>,
}

/// How a job's rows came out.
#[derive(Debug)]
pub struct Done {
    /// What was found beside the table.
    pub ran: Ran,
    /// The rows that were asked for.
    pub rows: Range<usize>,
    /// How many of them are done.
    pub done: usize,
    /// How many of these were computed now.
    pub computed: usize,
}

impl Done {
    /// Whether it was stopped before the last row.
    pub fn is_stopped(&self) -> bool {
        self.done < self.rows.len()
    }
}

impl Found {
    /// The rows that were asked for.
    pub fn rows(&self) -> &Range<usize> {
        &self.rows
    }

    /// How many are there.
    pub fn taken(&self) -> usize {
        let left: usize = computed(&self.steps).map(|rows| rows.len()).sum();
        self.rows.len() - left
    }

    /// The same without tables that are joined already.
    pub fn parts_alone(mut self) -> Self {
        self.pieces.whole.retain(|piece| !piece.is_result());
        let there: Vec<_> = self
            .pieces
            .whole
            .iter()
            .map(|piece| piece.rows.clone())
            .collect();
        self.steps = plan(&self.rows, &there);
        self
    }

    /// Adds what is missing.
    pub fn missing(&self, all: &mut Missing) {
        let shares = self.pieces.whole.iter().filter_map(|piece| piece.share);
        let broken = self.pieces.others.iter().filter_map(|piece| piece.share);
        let shares: Vec<Share> = shares.chain(broken).collect();
        all.add(
            self.rows.end,
            computed(&self.steps).cloned().collect(),
            shares,
        );
    }

    /// Files that cannot be used, and why.
    pub fn broken(&self) -> impl Iterator<Item = (&str, &str)> {
        let broken = self.pieces.broken.iter();
        broken.map(|(name, why)| (&**name, &**why))
    }

    /// What was different in the finished run whose table this one replaces, in words: where it is one of
    /// another hash.
    pub fn replaces(&self, shelf: &dyn Shelf, origin: &Origin) -> Option<String> {
        let other = self.pieces.others.iter().find(|other| other.is_result())?;
        let then = Origin::known(shelf, &other.run);
        Some(then.map_or_else(|_| String::new(), |then| origin.difference(&then)))
    }
}

/// Times that what is there is looked up again, where another run took it away meanwhile.
const TRIES: usize = 3;

impl Work<'_> {
    /// Removes all parts of a job's rows, of whatever run.
    ///
    /// # Errors
    /// They cannot be removed.
    pub fn clear(&self, sweep: &Sweep<'_>) -> Result<(), PartsError> {
        let rows = match self.part {
            // Of another run, which had more rows, too.
            Part::Whole => 0..usize::MAX,
            _ => self.part.rows(sweep.len()),
        };
        pieces::clear(self.shelf, &sweep.job().name, &rows)
    }

    /// Looks up what is there of a job's rows. With `fresh`, parts of other runs elsewhere in it do not matter.
    ///
    /// # Errors
    /// There are parts of another run.
    pub fn look(&self, sweep: &Sweep<'_>, fresh: bool) -> Result<Found, PartsError> {
        let job = &sweep.job().name;
        let rows = self.part.rows(sweep.len());
        let pieces = Pieces::look(self.shelf, job, self.origin.hash(), &rows)?;
        if !fresh {
            pieces.refuse_others(self.shelf, job, self.origin)?;
        }
        let there: Vec<_> = pieces
            .whole
            .iter()
            .map(|piece| piece.rows.clone())
            .collect();
        let steps = plan(&rows, &there);
        Ok(Found {
            rows,
            pieces,
            steps,
        })
    }

    /// Does what is to be done of a job's rows: `advance` is told how many are computed, as they are.
    ///
    /// # Errors
    /// What cannot be read or written.
    pub fn run(
        &self,
        sweep: &Sweep<'_>,
        found: Found,
        advance: &mut dyn FnMut(usize),
    ) -> Result<Done, PartsError> {
        let mut found = found;
        let mut computed = 0;
        for _ in 1..TRIES {
            match self.attempt(sweep, found, advance, &mut computed) {
                Err(error) if is_gone(&error) => found = self.look(sweep, true)?,
                other => return other,
            }
        }
        self.attempt(sweep, found, advance, &mut computed)
    }

    fn attempt(
        &self,
        sweep: &Sweep<'_>,
        found: Found,
        advance: &mut dyn FnMut(usize),
        computed: &mut usize,
    ) -> Result<Done, PartsError> {
        let Found {
            rows,
            pieces,
            steps,
        } = found;
        let mut there: Vec<Option<Manifest>> = pieces.whole.into_iter().map(Some).collect();
        let undivided = steps == [Step::Computed(rows.clone())];
        let mut parts: Vec<Manifest> = Vec::new();
        let mut stopped = false;
        for step in steps {
            match step {
                Step::Taken(number) => parts.extend(there[number].take()),
                // What comes after is looked up by the next run.
                Step::Computed(_) if stopped => {}
                Step::Computed(range) => {
                    let result = undivided.then(|| self.table_name(sweep));
                    let new = self.compute(sweep, range.clone(), result, advance)?;
                    let done: usize = new.iter().map(|piece| piece.rows.len()).sum();
                    *computed += done;
                    stopped = done < range.len();
                    parts.extend(new);
                }
            }
        }
        let mut ran = Ran::new(sweep.job(), self.origin.options().summary);
        for part in &parts {
            ran.add(&part.found);
        }
        let done = Done {
            ran,
            done: parts.iter().map(|part| part.rows.len()).sum(),
            computed: *computed,
            rows,
        };
        if !done.is_stopped() {
            self.complete(sweep, &parts, &done.rows)?;
        }
        Ok(done)
    }

    /// Joins what is there of a job's rows, nothing of which is missing: to its table, or to none where the
    /// parts stay as they are, a `dataset`.
    ///
    /// # Errors
    /// What cannot be read or written; as a dataset, files with rows that others have, too.
    pub fn merge(
        &self,
        sweep: &Sweep<'_>,
        found: Found,
        dataset: bool,
    ) -> Result<Done, PartsError> {
        let Found {
            rows,
            pieces,
            steps,
        } = found;
        let mut there: Vec<Option<Manifest>> = pieces.whole.into_iter().map(Some).collect();
        let taken = steps.iter().filter_map(|step| match step {
            Step::Taken(number) => there[*number].take(),
            Step::Computed(_) => None,
        });
        let parts: Vec<Manifest> = taken.collect();
        if dataset {
            let unused = there.iter().flatten().map(|piece| piece.table.name.clone());
            let broken = pieces.broken.into_iter().map(|(name, _)| name);
            let mut more = unused.chain(pieces.stray).chain(broken);
            if let Some(name) = more.next() {
                return Err(PartsError::Twice { name });
            }
        } else if !matches!(&parts[..], [all] if all.is_result()) {
            self.join(sweep, &parts, &rows)?;
        }
        let mut ran = Ran::new(sweep.job(), self.origin.options().summary);
        for part in &parts {
            ran.add(&part.found);
        }
        Ok(Done {
            ran,
            done: rows.len(),
            computed: 0,
            rows,
        })
    }

    /// Name of the table of a job's rows that are asked for, in the folder of results.
    pub fn table_name(&self, sweep: &Sweep<'_>) -> String {
        let rows = self.part.rows(sweep.len());
        let job = &sweep.job().name;
        let extension = self.origin.options().format().extension();
        match self.part {
            Part::Whole => format!("{job}.{extension}"),
            _ => format!("{}/{}.{extension}", folder(job), stem(&rows)),
        }
    }
}

/// Whether another run has taken away what was there, as it completed the same.
fn is_gone(error: &PartsError) -> bool {
    let PartsError::Read { source, .. } = error else {
        return false;
    };
    source.kind() == std::io::ErrorKind::NotFound
}
