//! Figures of a study: deformed, in a natural mode, and what its deflection comes from.

use std::path::Path;

use hyperstat_figures::{AnimatedFigure, DeformedFigure, Scale};
use hyperstat_mechanisms::{Files, Input, Noted, Registry};

use super::budget::budget;
use super::deformed::{compare, deformed, mode};
use super::drawing::Drawing;
use super::job::check;
use super::labels::Labels;
use super::map::evenly;
use super::notes;
use super::pose::{in_words, of_job};
use crate::answer::Asked;
use crate::error::StudyError;
use crate::plot_error::PlotError;
use crate::schema::{Columns, numeric};
use crate::selection::{Selection, choose};
use crate::study::Study;
use crate::sweep::{Sweep, Way};

/// Most poses that a moving figure runs through.
const MOST_POSES: usize = 40;

/// What a figure of a study looks like.
#[derive(Debug, Clone, Default)]
pub struct Look {
    /// Magnification.
    pub scale: Scale,
    /// Title; else one that says what is drawn.
    pub title: Option<String>,
    /// Where it is seen from, and what stands beside the mechanism.
    pub look: hyperstat_mechanisms::Look,
    /// Names of its axes.
    pub labels: Labels,
}

impl Study {
    /// That its job can be swept and its figures drawn, as far as that is known before the job is run.
    ///
    /// # Errors
    /// What is wrong with the first that is wrong.
    pub fn check_job(&self) -> Result<(), StudyError> {
        let Some(job) = self.whole_job() else {
            return Ok(());
        };
        check(job, &numeric(&Columns::of(job)))?;
        Sweep::new(job, Way::Lanes).map(drop)
    }

    /// [`Study::open`] at the pose that has these coordinates, of those that the job's poses give, in
    /// place of one by its number.
    ///
    /// # Errors
    /// As there; no pose has them, or several have.
    pub fn open_at(
        path: &Path,
        selection: &Selection,
        at: &[(String, f64)],
        files: &dyn Files,
        registry: &Registry,
    ) -> Result<Self, StudyError> {
        let loaded = hyperstat_mechanisms::load(path, files, registry)?;
        let Input::Batch(batch) = &loaded else {
            let (what, path) = ("pose", path.into());
            return Err(StudyError::NotABatch { what, path });
        };
        let job = choose(batch.jobs.clone(), path, selection)?;
        let pose = Some(of_job(&job, at)?);
        let selection = Selection {
            pose,
            ..selection.clone()
        };
        Self::of(loaded, path, &selection)
    }

    /// [`Study::of_first`] of the file at this path.
    ///
    /// # Errors
    /// As there.
    pub fn open_first(
        path: &Path,
        selection: &Selection,
        files: &dyn Files,
        registry: &Registry,
    ) -> Result<Self, StudyError> {
        let loaded = hyperstat_mechanisms::load(path, files, registry)?;
        Self::of_first(loaded, path, selection)
    }

    /// The mechanism undeformed and deformed, under its loads or those of a case; with the points of
    /// the independent solver where it is to `verify`.
    ///
    /// # Errors
    /// It has no solution, or no such case, or the output moves freely.
    pub fn deformed(
        &self,
        case: Option<&str>,
        verify: bool,
        look: Look,
    ) -> Result<Drawing, StudyError> {
        let solution = self.solve_held()?;
        let loaded = self.under(&solution, case)?;
        let title = look.title.clone().unwrap_or_else(|| self.title(case));
        let mut figure = deformed(self.model(), &loaded, title, look.scale)
            .map_err(|error| self.unsolvable(error))?;
        self.dress(&mut figure, case, &look)?;
        if verify {
            let reference = self.reference()?;
            compare(&mut figure, self.model(), &solution, &reference);
        }
        Ok(Drawing::Deformed(figure))
    }

    /// The mechanism in its natural mode of this number, from 1; `path` is the file that an error
    /// names.
    ///
    /// # Errors
    /// It has no such mode.
    pub fn mode(&self, path: &Path, number: usize, look: Look) -> Result<Drawing, StudyError> {
        let options = self.modal_options(Some(number), None);
        let modes = options.as_ref().map(|options| self.modes(options));
        let modes = modes
            .transpose()?
            .map(|found| found.modes)
            .unwrap_or_default();
        let found = modes.get(number.wrapping_sub(1));
        let found = found.ok_or_else(|| PlotError::NoMode {
            path: path.into(),
            number,
            count: modes.len(),
        })?;
        let title = look.title.clone().unwrap_or_else(|| self.title(None));
        let mut figure = mode(self.model(), found, number, title, look.scale)
            .map_err(|error| self.unsolvable(error))?;
        self.dress(&mut figure, None, &look)?;
        Ok(Drawing::Deformed(figure))
    }

    /// The mechanism deformed, at one pose of its job after the other, evenly chosen where there are
    /// many; `None` where it is at the only one. Poses without a result are left out.
    ///
    /// # Errors
    /// No pose has a result: that of its own; no such case.
    pub fn through_poses(
        &self,
        case: Option<&str>,
        look: &Look,
    ) -> Result<Option<Drawing>, StudyError> {
        let Some((job, _)) = self.of_pose().filter(|(job, _)| job.len() > 1) else {
            return Ok(None);
        };
        let title = || crate::title::title(&job.name, self.design(), None, case);
        let look = Look {
            title: Some(look.title.clone().unwrap_or_else(title)),
            ..look.clone()
        };
        let mut figures = Vec::new();
        let mut refused = None;
        for pose in evenly(job.len(), MOST_POSES) {
            let Some(there) = self.at_pose(pose) else {
                continue;
            };
            match there.deformed(case, false, look.clone()) {
                Ok(Drawing::Deformed(figure)) => figures.push(DeformedFigure {
                    pose: in_words(job, pose),
                    ..figure
                }),
                Ok(_) => {}
                Err(error) => refused = refused.or(Some(error)),
            }
        }
        match (AnimatedFigure::run(figures), refused) {
            (Ok(moving), _) => Ok(Some(Drawing::Moving(moving))),
            (Err(_), Some(error)) => Err(error),
            (Err(_), None) => Err(PlotError::NoPoses {
                job: job.name.clone(),
            }
            .into()),
        }
    }

    /// Gives a figure of it its look.
    fn dress(
        &self,
        figure: &mut DeformedFigure,
        case: Option<&str>,
        look: &Look,
    ) -> Result<(), StudyError> {
        notes::add(figure, self.model(), case, &look.look);
        figure.axis_names = look.labels.axes()?;
        if look.look.shown.contains(&Noted::Pose) {
            figure.pose = (self.of_pose()).and_then(|(job, pose)| in_words(job, pose));
        }
        Ok(())
    }

    /// What the deflection comes from, as bars; `path` is the file that an error names.
    ///
    /// # Errors
    /// It has no solution, or no such case; the output moves freely, or not along this direction.
    pub fn budget_figure(
        &self,
        path: &Path,
        asked: &Asked,
        title: Option<String>,
    ) -> Result<Drawing, StudyError> {
        let case = asked.case.as_deref();
        let solution = self.solve_held()?;
        let loaded = self.under(&solution, case)?;
        let found = self.budget(&loaded, asked)?;
        let found = found.ok_or_else(|| PlotError::Free { path: path.into() })?;
        let output = self
            .model()
            .output()
            .map(|node| self.model().node_name(node));
        let title = title.unwrap_or_else(|| self.title(case));
        let figure = budget(&found, &output.unwrap_or_default(), title);
        let figure = figure.ok_or_else(|| PlotError::NoShares { path: path.into() })?;
        Ok(Drawing::Budget(figure))
    }
}
