//! What can be asked of a study: its solution as an answer with everything that belongs to it, a
//! check, its natural frequencies, and a comparison with the independent solver.

use hyperstat_assembly::{BeamMass, ModalOptions, ModalPlan, Model, Modes, NodeMass, Solution};
use hyperstat_mechanisms::Along;
use hyperstat_reference::ReferenceSolution;

use crate::answer::{
    Asked, BudgetReport, CheckReport, FrequencyReport, MeasuresReport, ModesReport, SolveReport,
    Why,
};
use crate::error::StudyError;
use crate::study::Study;
use crate::verification::Verification;

/// What is asked of a solution, beside what it always tells.
#[derive(Debug, Clone, Default)]
pub struct Question {
    /// Solve a second time with the independent solver, and tell the largest differences.
    pub verify: bool,
    /// Displacements of the nodes inside segments too.
    pub all_nodes: bool,
    /// So many natural frequencies, the lowest; without a number those that the job asks for.
    pub modes: Option<usize>,
    /// Masses of beams, in place of those that the job asks for, or of exact ones.
    pub mass: Option<BeamMass>,
    /// What is soft, and why.
    pub why: Option<Asked>,
}

/// What comparisons and reports dwell on, beside what they always tell.
#[derive(Debug, Clone)]
pub struct Focus {
    /// Direction and case of compliance budgets, and of the displacement under loads.
    pub asked: Asked,
    /// So many natural frequencies; `None`: those of the job, else three where all that moves has mass.
    pub modes: Option<usize>,
}

impl Default for Focus {
    fn default() -> Self {
        Self {
            asked: Asked {
                case: None,
                along: Along::Displacement,
            },
            modes: None,
        }
    }
}

/// An answer, and what it was made from.
#[derive(Debug)]
pub struct Answered {
    /// What was found, ready to be written as JSON.
    pub report: SolveReport,
    /// The solution itself.
    pub solution: Solution,
    /// The natural modes, where some were asked for.
    pub modes: Option<Modes>,
}

impl Study {
    /// Solves the mechanism and answers a question.
    ///
    /// # Errors
    /// It has no solution; there is no case of the name that is asked about; the independent solver
    /// has no result. An output that moves freely is no error here: [`Study::free_output`] tells of it.
    pub fn answer(&mut self, question: &Question) -> Result<Answered, StudyError> {
        if question.why.is_some() {
            self.name_values();
        }
        let solution = self.solve()?;
        let case = question
            .why
            .as_ref()
            .and_then(|asked| asked.case.as_deref());
        let loaded = self.under(&solution, case)?;
        let verification = match question.verify {
            true => Some(self.verify(&solution)?),
            false => None,
        };
        let mut report = SolveReport::new(self, &solution, verification);
        if question.all_nodes {
            report
                .add_inner_displacements(self.model(), &solution)
                .map_err(|error| self.unsolvable(error))?;
        }
        let options = self.modal_options(question.modes, question.mass);
        let modal = options.as_ref().map(|options| self.modal(options));
        let modal = modal.transpose()?;
        let modes = modal.as_ref().map(|modal| self.modes_of(modal));
        let modes = modes.transpose()?;
        if let (Some(options), Some(found)) = (&options, &modes) {
            let all = question.all_nodes;
            report.add_modes(ModesReport::new(self.model(), found, options, all));
        }
        if let Some(asked) = &question.why {
            report.add_why(self.why(&loaded, asked)?);
            if let Some((modal, options)) = modal.as_ref().zip(options.as_ref()) {
                self.add_frequencies(modal, options, &mut report)?;
            }
        }
        drop(loaded);
        Ok(Answered {
            report,
            solution,
            modes,
        })
    }

    /// Checks the mechanism: its counts, what may be a slip, and whether it can be solved; and the
    /// error that [`Study::answer`] would end with, or that of an output that moves freely.
    pub fn check(&self) -> (CheckReport, Option<StudyError>) {
        let here = self.here();
        let kinematics = here.kinematics().ok();
        let (solution, error) = match self.solve() {
            Ok(solution) => {
                let error = self.free_output(&solution);
                (Some(solution), error)
            }
            Err(error) => (None, Some(error)),
        };
        let report = CheckReport::new(self, kinematics, solution.as_ref(), error.as_ref());
        (report, error)
    }

    /// The natural frequencies that are asked for, here or by the job: how many, and with which masses
    /// of beams; `None` where nobody asks.
    pub fn modal_options(
        &self,
        count: Option<usize>,
        mass: Option<BeamMass>,
    ) -> Option<ModalOptions> {
        let of_job = self.modes_of_job().cloned();
        let mut options = match (count, of_job) {
            (Some(count), Some(of_job)) => ModalOptions { count, ..of_job },
            (Some(count), None) => ModalOptions::lowest(count),
            (None, of_job) => of_job?,
        };
        options.mass = mass.unwrap_or(options.mass);
        Some(options)
    }

    /// The natural frequencies that a focus is on; `None` where it says nothing, and not all that moves has
    /// mass.
    pub(crate) fn modes_in(&self, focus: &Focus) -> Option<ModalOptions> {
        const USUAL: usize = 3;
        if focus.modes.is_some() {
            return self.modal_options(focus.modes, None);
        }
        let options = self.modal_options(None, None);
        let options = options.unwrap_or_else(|| ModalOptions::lowest(USUAL));
        self.modal_plan(&options).is_some().then_some(options)
    }

    /// The plan of natural frequencies over its poses; `None` where not all that moves has mass.
    pub(crate) fn modal_plan(&self, options: &ModalOptions) -> Option<ModalPlan> {
        let heavy = has_mass(self.model());
        heavy.then(|| self.prepared.modal(options).ok()).flatten()
    }

    /// Natural frequencies \[Hz\] and modes.
    ///
    /// # Errors
    /// There is no mass, or the mechanism is not held.
    pub fn modes(&self, options: &ModalOptions) -> Result<Modes, StudyError> {
        self.modes_of(&self.modal(options)?)
    }

    /// The mechanism made ready for natural frequencies.
    fn modal(&self, options: &ModalOptions) -> Result<ModalPlan, StudyError> {
        let modal = self.prepared.modal(options);
        modal.map_err(|error| self.unsolvable(error))
    }

    fn modes_of(&self, modal: &ModalPlan) -> Result<Modes, StudyError> {
        let modes = modal.modes(self.model().geometry());
        modes.map_err(|error| self.unsolvable(error))
    }

    /// What is soft and why: the answer to a question about a solution of this study, or about what
    /// a case has of it ([`Study::under`]).
    ///
    /// # Errors
    /// Unit states that cannot be found.
    pub fn why(&self, solution: &Solution, asked: &Asked) -> Result<Why, StudyError> {
        Why::new(self, solution, asked).map_err(|error| self.unsolvable(error))
    }

    /// The compliance budget alone; `None` where the output moves freely.
    ///
    /// # Errors
    /// As [`Study::why`].
    pub fn budget(
        &self,
        solution: &Solution,
        asked: &Asked,
    ) -> Result<Option<BudgetReport>, StudyError> {
        crate::answer::budget(&self.here(), solution, asked).map_err(|error| self.unsolvable(error))
    }

    /// The budget with the measures of the stiffness; neither where the output moves freely.
    ///
    /// # Errors
    /// As [`Study::why`].
    pub(crate) fn budget_and_measures(
        &self,
        solution: &Solution,
        asked: &Asked,
    ) -> Result<(Option<BudgetReport>, Option<MeasuresReport>), StudyError> {
        let found = crate::answer::budget_and_measures(&self.here(), solution, asked);
        found.map_err(|error| self.unsolvable(error))
    }

    /// Compares a solution with the independent solver's.
    ///
    /// # Errors
    /// The independent solver has no result.
    pub fn verify(&self, solution: &Solution) -> Result<Verification, StudyError> {
        Ok(Verification::new(
            &self.here(),
            solution,
            &self.reference()?,
        ))
    }

    /// The independent solver's solution.
    ///
    /// # Errors
    /// It has none.
    pub fn reference(&self) -> Result<ReferenceSolution, StudyError> {
        hyperstat_reference::solve(self.model()).map_err(StudyError::Unverified)
    }

    /// A solution as a VTU file (XML, for ParaView), with modes where there are some.
    ///
    /// # Errors
    /// A segment that cannot be formed, which no segment of a solved model is.
    pub fn vtu(&self, solution: &Solution, modes: Option<&Modes>) -> Result<String, StudyError> {
        crate::vtu::vtu(self.model(), solution, modes).map_err(|error| self.unsolvable(error))
    }

    /// Adds what changes natural frequencies.
    fn add_frequencies(
        &self,
        modal: &ModalPlan,
        options: &ModalOptions,
        report: &mut SolveReport,
    ) -> Result<(), StudyError> {
        let found = modal.sensitivities(self.model().geometry());
        let found = found.map_err(|error| self.unsolvable(error))?;
        report.add_frequencies(FrequencyReport::all(self, &found, options), found.complete);
        Ok(())
    }
}

/// Whether anything of a model has mass.
fn has_mass(model: &Model) -> bool {
    let is_heavy = |mass: &NodeMass| mass.mass.mass() > 0.0 || mass.mass.inertia().amax() > 0.0;
    let segments = model.segments().iter();
    let mut densities = segments.filter_map(|segment| segment.material.density());
    model.masses().iter().any(is_heavy) || densities.any(|density| density > 0.0)
}
