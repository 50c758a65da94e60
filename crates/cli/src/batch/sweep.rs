//! A job's poses, solved on all threads, with their results handed out in order.

use std::collections::VecDeque;
use std::ops::Range;
use std::sync::mpsc::{Receiver, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};

use hyperstat_assembly::{Geometry, LANES, Lanes, ModalPlan, Prepared, SolveError};
use hyperstat_mechanisms::{Design, Job, Value};
use rayon::{Scope, ThreadPool};

use super::record::{Columns, Failure, Found, Record};
use super::statistics::Values;
use crate::case::Source;
use crate::error::CliError;

/// Rows that a thread solves at a time.
const CHUNK: usize = 32 * LANES;

/// The same where natural frequencies make a row take long.
const SHORT_CHUNK: usize = LANES;

/// Designs after the first among which one has a topology, where the first has none.
const TRIED: usize = 1000;

/// A job whose topology is worked out.
#[derive(Debug)]
pub(crate) struct Sweep<'a> {
    job: &'a Job,
    way: Way,
    /// Number of a design that the others share with what they can, and why no pose of it is reached,
    /// where none is.
    first: (usize, Result<Arc<Planned>, Failure>),
}

/// The way that poses go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Way {
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
}

/// Neighbouring rows of a job's table. Used again and again, so that nothing is allocated for it.
#[derive(Debug, Default)]
pub(crate) struct Chunk {
    /// The rows, counted from 0 over the whole table.
    pub(crate) rows: Range<usize>,
    /// A record for each of them.
    pub(crate) records: Vec<Record>,
    /// Their measures, where a summary is wanted.
    pub(crate) measures: Vec<Option<Values>>,
    /// Their lines, where the table is one of text.
    pub(crate) text: String,
    /// Rows of a design.
    pub(crate) poses: usize,
    /// Further numbers that a row has where it has a result.
    pub(crate) further: usize,
    /// Values of the drives that make its pose, of every row those of a job that gives them.
    pub(crate) drives: Vec<f64>,
    /// Of a job that varies the designs, by number, that the rows are of, and their values.
    pub(crate) designs: Vec<(usize, Vec<Value>)>,
}

/// A row of a job's table.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Row<'c> {
    /// Number of the pose in its design.
    pub(crate) pose: usize,
    pub(crate) record: &'c Record,
    /// Further numbers that it has where it has a result.
    pub(crate) further: usize,
    /// Values of the drives, in a job that gives them.
    pub(crate) drives: &'c [f64],
    /// Number of the design and its values, in a job that varies.
    pub(crate) design: Option<(usize, &'c [Value])>,
}

impl Chunk {
    /// The rows in order.
    pub(crate) fn table_rows(&self) -> impl Iterator<Item = Row<'_>> {
        let first = self.rows.start.checked_div(self.poses).unwrap_or(0);
        let drives = self.drives.len() / self.records.len().max(1);
        self.rows
            .clone()
            .zip(self.records.iter().enumerate())
            .map(move |(row, (place, record))| {
                let design = row.checked_div(self.poses).unwrap_or(0);
                let of_design = self.designs.get(design - first);
                Row {
                    pose: row - design * self.poses,
                    record,
                    further: self.further,
                    drives: &self.drives[place * drives..][..drives],
                    design: of_design.map(|(number, values)| (*number, values.as_slice())),
                }
            })
    }
}

impl<'a> Sweep<'a> {
    /// Works out the topology of a job: of the first of its designs that has one.
    ///
    /// # Errors
    /// Why the first design that can be has none, where none of the next [`TRIED`] has one.
    pub(crate) fn new(job: &'a Job, way: Way) -> Result<Self, CliError> {
        let planned = |number| -> Result<_, CliError> {
            let design = job.design(number)?;
            let model = match design.model() {
                Ok(model) => model,
                // No pose in reach is told of its rows.
                Err(error) => return Ok((number, Err(Failure::from(error)))),
            };
            let prepared = Prepared::new(model);
            let planned = match Planned::modal(&prepared, job) {
                Ok(modal) => Ok(Planned { prepared, modal }),
                Err(error) => Err(Source::Design(job, &design).unsolvable(&prepared.here(), error)),
            };
            Ok((number, Ok(Arc::new(planned?))))
        };
        let first = job.first_design();
        let mut others = (first + 1..job.designs()).take(TRIED);
        let first = planned(first)
            .or_else(|error| others.find_map(|number| planned(number).ok()).ok_or(error))?;
        Ok(Self { job, way, first })
    }

    /// The job.
    pub(crate) fn job(&self) -> &'a Job {
        self.job
    }

    /// Number of rows of the job's table: a row a pose, design by design.
    pub(crate) fn len(&self) -> usize {
        self.job.designs() * self.job.len()
    }

    /// Solves all rows on the threads of `pool`, which also `render` each chunk; `take` gets the
    /// chunks on the calling thread, in the order of the rows, while the next are computed. The
    /// number of chunks under way is bounded: memory does not grow with the number of rows.
    ///
    /// # Errors
    /// The first error of `take`, which ends the sweep.
    pub(crate) fn run<E>(
        &self,
        pool: &ThreadPool,
        render: impl Fn(&mut Chunk) + Sync,
        mut take: impl FnMut(&mut Chunk) -> Result<(), E>,
    ) -> Result<(), E> {
        let threads = pool.current_num_threads();
        let solvers: Vec<_> = (0..threads).map(|_| Mutex::new(None)).collect();
        let compute = |chunk: &mut Chunk| {
            // A thread of the pool has its own solver: nobody waits.
            let thread = pool.current_thread_index().unwrap_or(0);
            let mut solver = solvers[thread]
                .lock()
                .unwrap_or_else(PoisonError::into_inner);
            chunk.records.clear();
            chunk.drives.clear();
            chunk.designs.clear();
            self.solve(&mut solver, chunk);
            drop(solver);
            chunk.text.clear();
            render(chunk);
        };
        let further = Columns::of(self.job).further.len();
        let size = match self.job.modes {
            Some(_) => SHORT_CHUNK,
            None => CHUNK,
        };
        let chunks = (0..self.len()).step_by(size);
        let mut ranges = chunks.map(|first| first..(first + size).min(self.len()));
        pool.in_place_scope(|scope| {
            let ahead = ranges.by_ref().take(2 * threads + 2);
            let mut under_way: VecDeque<_> = ahead
                .map(|rows| {
                    let chunk = Chunk {
                        rows,
                        poses: self.job.len(),
                        further,
                        ..Chunk::default()
                    };
                    start(scope, &compute, chunk)
                })
                .collect();
            // Nothing arrives where a thread has panicked; the scope then goes on with its panic.
            while let Some(Ok(mut chunk)) = under_way.pop_front().map(|chunk| chunk.recv()) {
                take(&mut chunk)?;
                if let Some(rows) = ranges.next() {
                    chunk.rows = rows;
                    under_way.push_back(start(scope, &compute, chunk));
                }
            }
            Ok(())
        })
    }

    /// Solves the rows of a chunk with a thread's solver, which is left at their last design.
    fn solve(&self, solver: &mut Option<Solver>, chunk: &mut Chunk) {
        let poses = self.job.len();
        let mut rows = chunk.rows.clone();
        while !rows.is_empty() {
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
            own.solve(self.job, range, &mut chunk.records);
            rows.start = end;
        }
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
                };
            }
        };
        let (first, planned) = &self.first;
        let planned = match number == *first {
            true => planned.clone(),
            false => Planned::new(&design, self.job, planned).map(Arc::new),
        };
        let ready = planned.and_then(|planned| {
            let lanes = match self.way {
                Way::Lanes => planned.prepared.lanes()?,
                Way::OneByOne => planned.prepared.lanes_one_by_one()?,
            };
            Ok((planned, lanes))
        });
        Solver {
            number,
            design: Some(design),
            ready,
        }
    }
}

impl Planned {
    /// A design, whose plan shares with the first's what it can: never with that of the design
    /// before it, which differs from thread to thread.
    fn new(
        design: &Design,
        job: &Job,
        first: &Result<Arc<Self>, Failure>,
    ) -> Result<Self, Failure> {
        let model = design.model()?;
        let prepared = match first {
            Ok(first) => first.prepared.for_design(model)?,
            Err(_) => Prepared::new(model),
        };
        let modal = Self::modal(&prepared, job)?;
        Ok(Self { prepared, modal })
    }

    /// What natural frequencies need, where they are asked for; the mechanism has a plan.
    fn modal(prepared: &Prepared, job: &Job) -> Result<Option<ModalPlan>, SolveError> {
        prepared.unknowns()?;
        let modal = job.modes.as_ref();
        modal.map(|options| prepared.modal(options)).transpose()
    }

    /// Numbers of a table's further columns in a configuration.
    fn further(&self, geometry: &Geometry) -> Result<Vec<Option<f64>>, SolveError> {
        let Some(modal) = &self.modal else {
            return Ok(Vec::new());
        };
        let mut found: Vec<_> = modal.frequencies(geometry)?.into_iter().map(Some).collect();
        found.resize(modal.count(), None);
        Ok(found)
    }
}

/// Has a thread compute a chunk, which then arrives at the end that is returned.
fn start<'s>(
    scope: &Scope<'s>,
    compute: &'s (impl Fn(&mut Chunk) + Sync),
    mut chunk: Chunk,
) -> Receiver<Chunk> {
    let (done, arrives) = sync_channel(1);
    scope.spawn(move |_| {
        compute(&mut chunk);
        // Nobody waits for it where the sweep has ended.
        let _ = done.send(chunk);
    });
    arrives
}

/// A design with one thread's own poses and buffers.
struct Solver {
    number: usize,
    /// Where it can be.
    design: Option<Design>,
    /// Why no pose of it can be solved, where none can.
    ready: Result<(Arc<Planned>, Lanes), Failure>,
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
            let mut placed = [const { None }; LANES];
            for (lane, pose) in (first..poses.end).take(LANES).enumerate() {
                placed[lane] = Some(design.place(pose, lanes.geometry_mut(lane)));
            }
            let filled = placed.each_ref().map(|pose| matches!(pose, Some(Ok(_))));
            let mut found = planned.prepared.sweep_lanes(lanes, filled);
            for (lane, placed) in placed.into_iter().enumerate() {
                match (placed, found[lane].take()) {
                    (Some(Ok(pose)), Some(result)) => {
                        let mut result = result.map_err(Failure::Solve).and_then(Found::try_from);
                        if let Ok(found) = &mut result {
                            match planned.further(lanes.geometry_mut(lane)) {
                                Ok(further) => found.further.extend(further),
                                Err(error) => result = Err(error.into()),
                            }
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
