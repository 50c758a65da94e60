//! A job's poses, solved on all threads, with their results handed out in order.

mod asked;
mod chunk;
mod exact;
mod poser;
mod record;
mod share;
mod slopes;
mod statistics;
mod summary;
mod threads;
mod wide;

use std::collections::HashSet;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use hyperstat_assembly::{
    Beside, Carried, Geometry, LANES, Lanes, ModalPlan, PoseResult, Prepared, SolveError,
};
use hyperstat_mechanisms::{Design, Job, Placing};

use crate::error::StudyError;
pub use crate::schema::Columns;
use crate::schema::{self, Group};
use crate::source::Written;
use asked::Asked;
pub use chunk::{Chunk, Row};
pub use poser::Poser;
pub use record::{Cell, Failure, Found, Held, NUMBERS, Record, UPPER};
pub(crate) use slopes::Sought;
use slopes::{Slope, cells};
pub use statistics::{Extreme, MeasureReport, Percentile, Statistics, Values, measure};
#[cfg(feature = "parts")]
pub(crate) use summary::KeptSummary;
pub use summary::{Failures, Summary};
pub use threads::Threads;
pub use wide::placing;

/// Rows that a thread solves at a time.
const CHUNK: usize = 32 * LANES;

/// The same where forces are asked for, which some mechanisms have from a full solution alone.
const MIDDLE_CHUNK: usize = 8 * LANES;
/// The same where natural frequencies make a row take long.
const SHORT_CHUNK: usize = LANES;

/// Designs after the first among which one has a topology, where the first has none.
const TRIED: usize = 1000;

/// A job whose topology is worked out.
#[derive(Debug)]
pub struct Sweep<'a> {
    job: &'a Job,
    way: Way,
    /// Number of a design that the others share with what they can, and why no pose of it is reached,
    /// where none is.
    first: (usize, Result<Arc<Planned>, Failure>),
    sought: Option<Sought>,
}

/// The way that poses go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Through the lanes, where they take the mechanism.
    Lanes,
    /// Each by itself through the numeric pass.
    OneByOne,
}

/// A design made ready.
#[derive(Debug)]
struct Planned {
    prepared: Prepared,
    /// Where natural frequencies are asked for.
    modal: Option<ModalPlan>,
    /// Whether these stand where those of a job's `modes` do.
    modes: bool,
    /// Columns on request, where there are some.
    asked: Option<Asked>,
    /// Derivatives, where the lanes find them.
    slope: Option<Slope>,
}

impl<'a> Sweep<'a> {
    /// Works out the topology of a job: of the first of its designs that has one.
    ///
    /// # Errors
    /// Why the first design that can be has none, where none of the next 1000 has one; columns on request
    /// whose names others have.
    pub fn new(job: &'a Job, way: Way) -> Result<Self, StudyError> {
        Self::seeking(job, way, None)
    }

    /// The same with derivatives, which stand last among what a row has further.
    pub(crate) fn seeking(
        job: &'a Job,
        way: Way,
        sought: Option<Sought>,
    ) -> Result<Self, StudyError> {
        check(job)?;
        let planned = |number| -> Result<_, StudyError> {
            let design = job.design(number)?;
            let mut model = match design.model() {
                Ok(model) => model,
                // No pose in reach is told of its rows.
                Err(error) => return Ok((number, Err(Failure::from(error)))),
            };
            let seeking = sought.as_ref();
            let ready = seeking.map(|own| own.prepare(job, &design, &mut model));
            if let Some(Err(error)) = ready {
                return Ok((number, Err(error.into())));
            }
            let prepared = Prepared::new(model);
            let planned = Planned::of(prepared, Some(job), sought.as_ref()).map_err(|failed| {
                let (prepared, error) = *failed;
                Written::Design(job, &design).unsolvable(&prepared.here(), error)
            });
            Ok((number, Ok(Arc::new(planned?))))
        };
        let first = job.first_design();
        let mut others = (first + 1..job.designs()).take(TRIED);
        let first = planned(first)
            .or_else(|error| others.find_map(|number| planned(number).ok()).ok_or(error))?;
        Ok(Self {
            job,
            way,
            first,
            sought,
        })
    }

    /// The job.
    pub fn job(&self) -> &'a Job {
        self.job
    }

    /// Whether it has no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of rows of the job's table: a row a pose, design by design.
    pub fn len(&self) -> usize {
        self.job.designs() * self.job.len()
    }

    /// Solves these rows on `threads`, which also `render` each chunk; `take` gets the chunks on the
    /// calling thread, in the order of the rows, while the next are computed: what it counts is the
    /// progress, and an error of it stops the sweep. The number of chunks under way is bounded: memory
    /// does not grow with the number of rows.
    ///
    /// # Errors
    /// The first error of `take`.
    pub fn run<E>(
        &self,
        threads: &Threads,
        rows: Range<usize>,
        render: impl Fn(&mut Chunk) + Sync,
        take: impl FnMut(&mut Chunk) -> Result<(), E>,
    ) -> Result<(), E> {
        match self.run_until(threads, rows, &|| false, render, take) {
            Err(Ended::Failed(error)) => Err(error),
            Ok(()) | Err(Ended::Stopped) => Ok(()),
        }
    }

    /// The same until `stop` says so, which every thread asks after some rows: what was taken by then is
    /// whole.
    ///
    /// # Errors
    /// The first error of `take`, or that it was stopped.
    pub fn run_until<E>(
        &self,
        threads: &Threads,
        rows: Range<usize>,
        stop: &(impl Fn() -> bool + Sync),
        render: impl Fn(&mut Chunk) + Sync,
        mut take: impl FnMut(&mut Chunk) -> Result<(), E>,
    ) -> Result<(), Ended<E>> {
        // Nobody wants what is under way when the sweep ends with an error.
        let over = AtomicBool::new(false);
        let stop = || over.load(Ordering::Relaxed) || stop();
        let compute = |solver: &mut Option<Solver>, chunk: &mut Chunk| {
            chunk.clear();
            if self.solve(solver, chunk, &stop) {
                render(chunk);
            }
        };
        let take = |chunk: &mut Chunk| {
            let taken = match chunk.records.len() == chunk.rows.len() {
                true => take(chunk).map_err(Ended::Failed),
                false => Err(Ended::Stopped),
            };
            taken.inspect_err(|_| over.store(true, Ordering::Relaxed))
        };
        let further = Columns::of(self.job).further.len();
        let empty = || Chunk {
            poses: self.job.len(),
            further,
            ..Chunk::default()
        };
        let size = if self.job.frequencies().is_some() {
            SHORT_CHUNK
        } else if Group::all(self.job).iter().any(Group::is_solved) {
            MIDDLE_CHUNK
        } else {
            CHUNK
        };
        let rows = rows.start.min(self.len())..rows.end.min(self.len());
        threads.share(aligned(rows, size), empty, compute, take)
    }

    /// Solves these rows on the calling thread.
    pub fn records(&self, rows: Range<usize>) -> Vec<Record> {
        let mut chunk = Chunk {
            rows: rows.start.min(self.len())..rows.end.min(self.len()),
            poses: self.job.len(),
            ..Chunk::default()
        };
        self.solve(&mut None, &mut chunk, &|| false);
        chunk.records
    }

    /// Solves the rows of a chunk with a thread's solver, which is left at their last design; returns whether
    /// it was not stopped before the last.
    fn solve(
        &self,
        solver: &mut Option<Solver>,
        chunk: &mut Chunk,
        stop: &impl Fn() -> bool,
    ) -> bool {
        let poses = self.job.len();
        let mut rows = chunk.rows.clone();
        while !rows.is_empty() {
            if stop() {
                return false;
            }
            let number = rows.start / poses;
            let own = match solver {
                Some(own) if own.number == number => own,
                _ => solver.insert(self.solver(number)),
            };
            if !self.job.varied().is_empty() {
                chunk.designs.push((number, self.job.values(number)));
            }
            let first = number * poses;
            let end = rows.end.min(first + poses);
            let range = rows.start - first..end - first;
            for pose in range.clone() {
                chunk.drives.extend(self.job.drive_values(pose));
            }
            for first in range.clone().step_by(LANES) {
                if stop() {
                    return false;
                }
                let lanes = first..range.end.min(first + LANES);
                own.solve(self.job, lanes, &mut chunk.records);
            }
            rows.start = end;
        }
        true
    }

    /// A thread's solver of a design.
    fn solver(&self, number: usize) -> Solver {
        let design = match self.job.design(number) {
            Ok(design) => design,
            Err(error) => {
                return Solver {
                    number,
                    design: None,
                    ready: Err(Failure::Design(Arc::new(error))),
                    placing: placing(),
                    sought: None,
                };
            }
        };
        let (first, planned) = &self.first;
        let planned = match number == *first {
            true => planned.clone(),
            false => Planned::new(&design, self.job, planned, self.sought.as_ref()).map(Arc::new),
        };
        let ready = planned.and_then(|planned| {
            let lanes = match self.way {
                Way::Lanes => planned.prepared.lanes_beside(planned.beside())?,
                Way::OneByOne => planned.prepared.lanes_one_by_one()?,
            };
            Ok((planned, lanes))
        });
        let mut placing = placing();
        if let Ok((planned, _)) = &ready {
            planned.prepare(&mut placing);
        }
        Solver {
            number,
            design: Some(design),
            ready,
            placing,
            sought: self.sought.as_ref().map(|own| own.parameters.len()),
        }
    }
}

/// Why a sweep ends before its last row.
#[derive(Debug)]
pub enum Ended<E> {
    /// It was stopped.
    Stopped,
    /// What takes its rows failed.
    Failed(E),
}

/// Rows in ranges of this size, which begin at its multiples wherever the rows do.
fn aligned(rows: Range<usize>, size: usize) -> impl Iterator<Item = Range<usize>> {
    let mut next = rows.start;
    std::iter::from_fn(move || {
        let first = next;
        next = (first / size).saturating_add(1).saturating_mul(size);
        next = next.min(rows.end);
        (first < rows.end).then_some(first..next)
    })
}

/// Refuses a job whose table would have two columns of one name.
fn check(job: &Job) -> Result<(), StudyError> {
    let mut seen = HashSet::new();
    let columns = Columns::of(job);
    let mut all = schema::columns(&columns);
    let Some(name) = all.find(|name| !seen.insert(name.clone())) else {
        return Ok(());
    };
    // One that is asked for is told where that is.
    let asked = |group: &Group| group.names(job.cases()).contains(&name);
    let location = match Group::all(job).iter().position(asked) {
        Some(place) => job.column_location(place),
        None => job.location(),
    };
    Err(StudyError::SameColumn {
        location: Box::new(location),
        name,
    })
}

impl Planned {
    /// A design, whose plan shares with the first's what it can: never with that of the design
    /// before it, which differs from thread to thread.
    fn new(
        design: &Design,
        job: &Job,
        first: &Result<Arc<Self>, Failure>,
        sought: Option<&Sought>,
    ) -> Result<Self, Failure> {
        let mut model = design.model()?;
        if let Some(sought) = sought {
            sought.prepare(job, design, &mut model)?;
        }
        let prepared = match first {
            Ok(first) => first.prepared.for_design(model)?,
            Err(_) => Prepared::new(model),
        };
        Self::of(prepared, Some(job), sought).map_err(|failed| Failure::from(failed.1))
    }

    /// What is needed for a job's rows, of a mechanism that has a plan; without a job for a pose alone. An
    /// error comes with the mechanism.
    fn of(
        prepared: Prepared,
        job: Option<&Job>,
        sought: Option<&Sought>,
    ) -> Result<Self, Box<(Prepared, SolveError)>> {
        let found = || {
            prepared.unknowns()?;
            let Some(job) = job else {
                return Ok((None, None, None));
            };
            let slope = sought.map(|sought| Slope::of(sought, prepared.model()));
            let modal = job.frequencies();
            let modal = modal.map(|options| prepared.modal(options)).transpose()?;
            let asked = Asked::of(job, prepared.model())?;
            Ok((modal, asked, slope.transpose()?.flatten()))
        };
        match found() {
            Ok((modal, asked, slope)) => Ok(Self {
                prepared,
                slope,
                modal,
                modes: job.is_some_and(|job| job.modes.is_some()),
                asked,
            }),
            Err(error) => Err(Box::new((prepared, error))),
        }
    }

    /// Has values of drives kept, where they are asked for.
    fn prepare(&self, placing: &mut Placing) {
        if self.asked.as_ref().is_some_and(Asked::needs_drives) {
            placing.keep_drives();
        }
    }

    /// What lanes have to find beside the output.
    fn beside(&self) -> Beside {
        let asked = self.asked.as_ref().map(Asked::beside);
        let slope = self.slope.as_ref().map(Slope::beside);
        asked.max(slope).unwrap_or_default()
    }

    /// What joints and segments carry at a pose of this result, with the budgets where these are asked for;
    /// `None` where nothing of it is asked for, and where a whole solution is needed for it.
    fn carried(
        &self,
        lanes: &mut Lanes,
        pose: usize,
        result: &Result<PoseResult, SolveError>,
    ) -> Option<Result<Carried, SolveError>> {
        let found = result.as_ref().ok()?;
        found.displacement?;
        match self.asked.as_ref()?.beside() {
            Beside::Forces => {
                let forces = self.prepared.forces(lanes, pose);
                Some(forces.map(Carried::from))
            }
            Beside::Budgets => self.prepared.budgets(lanes, pose, found).transpose(),
            _ => None,
        }
    }

    /// What is found in a configuration that a solution is known of, with the values of its drives and the
    /// forces and budgets of every state, where they are.
    fn found(
        &self,
        solved: Result<PoseResult, SolveError>,
        geometry: &Geometry,
        drives: Option<&[f64]>,
        carried: Option<Result<Carried, SolveError>>,
    ) -> Result<Found, Failure> {
        let solved = solved?;
        let carried = carried.transpose();
        let displacements = solved.displacement.into_iter();
        let displacements = match self.asked {
            Some(_) => displacements.chain(solved.cases.iter().copied()).collect(),
            None => Vec::new(),
        };
        let stiffness = solved.stiffness;
        let add = |frequencies: &[Cell], further: &mut Vec<Cell>| {
            if self.modes {
                further.extend_from_slice(frequencies);
            }
            let Some(asked) = &self.asked else {
                return Ok(());
            };
            let carried = carried.as_ref().map_err(Clone::clone)?;
            let found = asked::Found {
                carried: carried.as_ref(),
                prepared: &self.prepared,
                geometry,
                stiffness: stiffness.as_ref(),
                displacements: &displacements,
                drives,
                frequencies,
            };
            asked.add(&found, further)
        };
        match Found::try_from(solved) {
            Ok(mut found) => {
                add(&self.frequencies(geometry)?, &mut found.further)?;
                Ok(found)
            }
            Err(Failure::Rigid(mut held)) if self.asked.is_some() => {
                let count = self.modal.as_ref().map_or(0, ModalPlan::count);
                let known = held.further.len();
                // What cannot be found of it stays open.
                if add(&vec![Cell::Empty; count], &mut held.further).is_err() {
                    held.further.truncate(known);
                }
                Err(Failure::Rigid(held))
            }
            Err(failure) => Err(failure),
        }
    }

    /// Natural frequencies in a configuration, where they are asked for.
    fn frequencies(&self, geometry: &Geometry) -> Result<Vec<Cell>, SolveError> {
        let Some(modal) = &self.modal else {
            return Ok(Vec::new());
        };
        let found = modal.frequencies(geometry)?.into_iter();
        let mut found: Vec<_> = found.map(Cell::Number).collect();
        found.resize(modal.count(), Cell::Empty);
        Ok(found)
    }
}

/// A design with one thread's own poses and buffers.
struct Solver {
    number: usize,
    /// Where it can be.
    design: Option<Design>,
    /// Why no pose of it can be solved, where none can.
    ready: Result<(Arc<Planned>, Lanes), Failure>,
    placing: Placing,
    /// Number of derivatives, where these are sought.
    sought: Option<usize>,
}

impl Solver {
    /// Appends a record for each of these poses. What is found at a pose does not depend on the
    /// poses that are solved with it, nor on those that were solved before.
    fn solve(&mut self, job: &Job, poses: Range<usize>, records: &mut Vec<Record>) {
        let unreached = |pose, failure| Record {
            pose: job.target(pose),
            result: Err(failure),
        };
        let (planned, lanes) = match &mut self.ready {
            Ok((planned, lanes)) => (planned, lanes),
            Err(failure) => {
                let failure = failure.clone();
                let model = self.design.as_ref().and_then(|design| design.model().ok());
                let mut geometry = model.map(|model| model.geometry().clone());
                records.extend(poses.map(|pose| {
                    let placed = self.design.as_ref().zip(geometry.as_mut());
                    let placed = placed.map(|(design, geometry)| design.place(pose, geometry));
                    match placed {
                        Some(Ok(pose)) => Record::reached(pose, Err(failure.clone())),
                        _ => unreached(pose, failure.clone()),
                    }
                }));
                return;
            }
        };
        let Some(design) = &self.design else { return };
        for first in poses.clone().step_by(LANES) {
            let poses = first..poses.end.min(first + LANES);
            let placed = design.place_lanes(poses, lanes.geometries_mut(), &mut self.placing);
            let filled = placed.each_ref().map(|pose| matches!(pose, Some(Ok(_))));
            let (mut found, mut slopes) = match &planned.slope {
                Some(slope) => slope.sweep(&planned.prepared, lanes, filled),
                None => {
                    let found = planned.prepared.sweep_lanes(lanes, filled);
                    (found, [const { None }; LANES])
                }
            };
            for (lane, placed) in placed.into_iter().enumerate() {
                match (placed, found[lane].take()) {
                    (Some(Ok(pose)), Some(result)) => {
                        let carried = planned.carried(lanes, lane, &result);
                        let drives = self.placing.drives(lane);
                        let geometry = lanes.geometry_mut(lane);
                        let mut result = planned.found(result, geometry, drives, carried);
                        if let (Ok(found), Some(count)) = (&mut result, self.sought) {
                            found.further.extend(cells(slopes[lane].take(), count));
                        }
                        records.push(Record::reached(pose, result));
                    }
                    (Some(Err(error)), _) => records.push(unreached(first + lane, error.into())),
                    _ => {}
                }
            }
        }
    }
}
