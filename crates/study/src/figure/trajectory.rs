//! The figure of a job's trajectory, from the records of its sweep (Fig. 8).

use std::ops::Range;

use hyperstat_assembly::Floor;
use hyperstat_figures::{Scale, SecondMethod, TrajectoryFigure, Viewpoint};
use hyperstat_mechanisms::{Figure, Job};
#[cfg(feature = "threads")]
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::rows::Choice;
use super::second::{SECOND, difference_in};
use crate::answer::linear;
use crate::plot_error::PlotError;
use crate::schema::{COORDINATES, DISPLACEMENT};
use crate::study::job_model;
use crate::sweep::Record;
use crate::table::TableReader;
use crate::title::title;

/// Most poses that a figure shows: more cannot be told apart.
const MOST_POSES: usize = 1000;

/// Positions and displacements of a job's output at evenly spaced poses that have a result.
#[derive(Debug)]
pub struct Trajectory {
    /// Every so many poses one is shown: all of them where they are not too many.
    stride: usize,
    /// Rows of the first design that can be: figures are of it.
    first: Range<usize>,
    path: Path,
}

/// Poses of a trajectory; those of parts of the rows merge to those of the whole.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct Path {
    poses: Vec<usize>,
    commanded: Vec<[f64; 3]>,
    displacement: Vec<[f64; 3]>,
}

impl Trajectory {
    /// An empty trajectory, where the job asks for a figure of it.
    pub fn wanted_by(job: &Job) -> Option<Self> {
        let is_trajectory = |figure: &Figure| matches!(figure, Figure::Trajectory { .. });
        job.figures.iter().any(is_trajectory).then(|| Self {
            stride: job.len().div_ceil(MOST_POSES),
            first: job.first_design() * job.len()..(job.first_design() + 1) * job.len(),
            path: Path::default(),
        })
    }

    /// The poses so far.
    #[cfg(feature = "parts")]
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Adds poses of later rows of the same job.
    #[cfg(feature = "parts")]
    pub(crate) fn merge(&mut self, later: &Path) {
        self.path.poses.extend_from_slice(&later.poses);
        self.path.commanded.extend_from_slice(&later.commanded);
        self.path
            .displacement
            .extend_from_slice(&later.displacement);
    }

    /// Adds records of rows of the job from `first_row` on, in the order of the rows; those of other
    /// designs than the first that can be are left out.
    pub fn add(&mut self, first_row: usize, records: &[Record]) {
        for (row, record) in (first_row..).zip(records) {
            if !self.first.contains(&row) {
                continue;
            }
            let pose = row - self.first.start;
            match (&record.result, record.pose) {
                (Ok(found), [Some(x), Some(y), Some(z), ..])
                    if pose.is_multiple_of(self.stride) =>
                {
                    self.path.poses.push(pose);
                    self.path.commanded.push([x, y, z]);
                    self.path.displacement.push(linear(&found.displacement));
                }
                _ => {}
            }
        }
    }

    /// Whether it is of a job of as many poses.
    pub(super) fn fits(&self, job: &Job) -> bool {
        self.first.len() == job.len()
    }

    /// Whether no pose has a result.
    pub(super) fn is_empty(&self) -> bool {
        self.path.poses.is_empty()
    }

    /// The figure of it, with the reference solver's points.
    pub(super) fn figure(&self, job: &Job, scale: Scale) -> TrajectoryFigure {
        TrajectoryFigure {
            title: job.name.clone(),
            commanded: self.path.commanded.clone(),
            displacement: self.path.displacement.clone(),
            second: self.second(job),
            scale,
            view: Viewpoint::default(),
            axis_names: None,
        }
    }

    /// The reference solver's displacements at the poses that the figure marks; `None` where it has
    /// no answer at some of them. It is slow: at every pose it would take far longer than the sweep.
    fn second(&self, job: &Job) -> Option<SecondMethod> {
        let Path {
            poses,
            displacement: found,
            ..
        } = &self.path;
        let at = TrajectoryFigure::marked(poses.len());
        let solve = |&place: &usize| {
            let model = job_model(job, poses[place]).ok()?;
            let solution = hyperstat_reference::solve(&model).ok()?;
            Some(linear(&solution.displacement?))
        };
        #[cfg(feature = "threads")]
        let displacement: Vec<_> = at.par_iter().map(solve).collect::<Option<_>>()?;
        #[cfg(not(feature = "threads"))]
        let displacement: Vec<_> = at.iter().map(solve).collect::<Option<_>>()?;
        let ours: Vec<_> = at.iter().map(|place| found[*place]).collect();
        let first = job_model(job, *poses.first()?).ok()?;
        let least = Floor::of(&first).ok()?.least_displacement();
        Some(SecondMethod {
            name: SECOND.into(),
            difference: difference_in(&ours, &displacement, found, least),
            at,
            displacement,
        })
    }
}

/// The poses with a result as a trajectory, commanded and deflected.
///
/// # Errors
/// No pose that is chosen has a result, or the table cannot be read.
pub fn of_table(
    table: &TableReader,
    choice: Choice,
    scale: Scale,
    own_title: Option<String>,
) -> Result<TrajectoryFigure, PlotError> {
    let names = COORDINATES[..3].iter().chain(&DISPLACEMENT[..3]);
    let columns: Vec<_> = names.filter_map(|name| table.find(name)).collect();
    let columns = table.read(&columns)?;
    let mut figure = TrajectoryFigure {
        title: own_title.unwrap_or_else(|| {
            let design = choice.design.filter(|_| table.varies());
            title(&table.job(), design, None, None)
        }),
        commanded: Vec::new(),
        displacement: Vec::new(),
        second: None,
        scale,
        view: Viewpoint::default(),
        axis_names: None,
    };
    for row in choice.rows(table)? {
        let numbers: Option<Vec<f64>> = columns.iter().map(|column| column[row]).collect();
        if let Some([x, y, z, dx, dy, dz]) = numbers.as_deref() {
            figure.commanded.push([*x, *y, *z]);
            figure.displacement.push([*dx, *dy, *dz]);
        }
    }
    match figure.commanded.is_empty() {
        true => Err(PlotError::Nothing {
            path: table.path().into(),
        }),
        false => Ok(figure),
    }
}
