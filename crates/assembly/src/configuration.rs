//! A mechanism in one configuration: whatever is found of it is found once.

use std::sync::{Mutex, OnceLock, PoisonError};

use hyperstat_model::{Geometry, LoadSet, ModalOptions, Model, characteristic_length};

use crate::answer::forces::Forces;
use crate::answer::solution::{CaseSolution, Solution, State};
use crate::error::SolveError;
use crate::kinematics::Kinematics;
use crate::kinematics::diagnosis::Diagnosis;
use crate::kinematics::motion::Motion;
use crate::kinematics::redundancy::Redundancy;
use crate::modal::{ModalPlan, Modes};
use crate::plan::Plan;
use crate::pose::restraint::Restraint;
use crate::posture::{Beams, Posture};
use crate::response::influence::Influence;
use crate::solve::{Asked, Factored, Free, Solved, respond_to_units, solve_all};
use crate::state::acting::Acting;

/// A plan that is made when it is first asked for, or why there is none.
pub(crate) type Planned = OnceLock<Result<Plan, SolveError>>;

/// What is found of a configuration, each thing when it is first asked for.
#[derive(Debug, Default)]
pub(crate) struct Kept {
    size: OnceLock<f64>,
    beams: Beams,
    diagnosis: Diagnosis,
    restraint: OnceLock<Result<Restraint, SolveError>>,
    factored: Mutex<Option<Box<Factored>>>,
}

/// A mechanism in one configuration, by [`Prepared::here`](crate::Prepared::here) or
/// [`Prepared::at`](crate::Prepared::at).
///
/// What follows from the configuration (its size, the beams of its segments, what moves without
/// energy, the factored stiffness) is worked out when it is first asked for and serves all that is
/// asked after that: a solve, why the output gives, what a check says.
#[derive(Debug)]
pub struct Configuration<'a> {
    model: &'a Model,
    geometry: &'a Geometry,
    plan: &'a Planned,
    /// What is found of the model's own configuration.
    own: &'a Kept,
    /// The same of this one, where it is another.
    there: Option<Box<Kept>>,
}

/// The plan of a model, made in the model's own configuration.
pub(crate) fn planned<'a>(
    plan: &'a Planned,
    model: &Model,
    found: &Kept,
) -> Result<&'a Plan, SolveError> {
    let made = plan.get_or_init(|| {
        let at = posture(model, model.geometry(), found);
        Plan::absorbing(&at, true, &found.diagnosis)
    });
    made.as_ref().map_err(Clone::clone)
}

fn posture<'a>(model: &'a Model, geometry: &'a Geometry, found: &'a Kept) -> Posture<'a> {
    let size = *found.size.get_or_init(|| characteristic_length(geometry));
    Posture::keeping(model, geometry, size, &found.beams)
}

impl<'a> Configuration<'a> {
    /// The model's own configuration.
    pub(crate) fn new(model: &'a Model, plan: &'a Planned, own: &'a Kept) -> Self {
        Self {
            model,
            geometry: model.geometry(),
            plan,
            own,
            there: None,
        }
    }

    /// The same in another configuration.
    pub(crate) fn moved(self, geometry: &'a Geometry) -> Self {
        Self {
            geometry,
            there: Some(Box::default()),
            ..self
        }
    }

    fn found(&self) -> &Kept {
        self.there.as_deref().unwrap_or(self.own)
    }

    /// The mechanism.
    pub fn model(&self) -> &'a Model {
        self.model
    }

    /// Where its parts are.
    pub fn geometry(&self) -> &'a Geometry {
        self.geometry
    }

    /// Mobility, over-constraint and motions without energy. It asks for no output and for nothing that
    /// holds the bodies: it is there for mechanisms that cannot be solved, too.
    ///
    /// # Errors
    /// [`SolveError::TooLarge`]: motions too many, of too many bodies each.
    pub fn kinematics(&self) -> Result<&Kinematics, SolveError> {
        self.found().diagnosis.kinematics(&self.posture())
    }

    /// The redundant constraints: as many as the degree of over-constraint
    /// ([`Kinematics::overconstraint`]), each with as few directions as elimination finds. Of a
    /// mechanism of more than 40 bodies or joints, the first 1000.
    pub fn redundant_constraints(&self) -> Vec<Redundancy> {
        self.found().diagnosis.redundancies(&self.posture())
    }

    /// The motions without energy that leave the output where it is. They do not depend on what acts,
    /// nor on whether it works on any of them.
    ///
    /// # Errors
    /// As [`Configuration::solve`] without any load.
    pub fn idle_motions(&self) -> Result<Vec<Motion>, SolveError> {
        let plan = self.plan()?;
        self.solve_all(plan, &[], Asked::States)?;
        Ok(self.restraint(plan)?.idle.clone())
    }

    /// Everything under the model's loads and those of its cases.
    ///
    /// # Errors
    /// No output, a model that is not one whole ([`Model::check`]), bodies that nothing holds, a load
    /// on a motion that nothing resists, numbers of too different size, a model too large for memory.
    pub fn solve(&self) -> Result<Solution, SolveError> {
        let plan = self.plan()?;
        let acting = Acting::of_model(&self.posture())?;
        let solved = self.solve_all(plan, &acting, Asked::All)?;
        let kinematics = self.kinematics()?;
        let mut states = solved.states.into_iter();
        let base = states.next().ok_or(SolveError::Singular)?;
        let cases = self.model.cases().iter().zip(states);
        Ok(Solution {
            unknowns: plan.unknowns(),
            mobility: kinematics.mobility,
            overconstraint: kinematics.overconstraint,
            idle: self.restraint(plan)?.idle.clone(),
            output: solved.output,
            displacements: base.displacements,
            joint_wrenches: base.joint_wrenches,
            segments: base.segments,
            floor: base.floor,
            cases: cases
                .map(|(case, state)| CaseSolution {
                    name: case.name.clone(),
                    state,
                })
                .collect(),
            warnings: solved.warnings,
        })
    }

    /// What joints and segments carry under the model's loads, and those of each of its cases: of the states
    /// of [`Configuration::solve`].
    pub(crate) fn forces(&self) -> Result<Vec<Forces>, SolveError> {
        let plan = self.plan()?;
        let acting = Acting::of_model(&self.posture())?;
        let states = self.solve_all(plan, &acting, Asked::States)?.states;
        Ok(states.into_iter().map(Forces::from).collect())
    }

    /// What each of these sets of loads alone does: without the model's loads, weight and
    /// temperatures. The factorization of a solve serves them too.
    ///
    /// # Errors
    /// As [`Configuration::solve`]; loads on what is not of the model.
    pub fn respond(&self, sets: &[LoadSet]) -> Result<Vec<State>, SolveError> {
        let plan = self.plan()?;
        for set in sets {
            self.model.check_loads(set)?;
        }
        let at = self.posture();
        let acting: Result<Vec<_>, _> = sets.iter().map(|set| Acting::new(&at, set)).collect();
        Ok(self.solve_all(plan, &acting?, Asked::States)?.states)
    }

    /// What unit wrenches on the output do: what budgets and sensitivities are made of.
    ///
    /// # Errors
    /// As [`Configuration::solve`]; a wrench on an output that moves freely is a load on a free motion.
    pub fn influence(&self) -> Result<Influence<'a>, SolveError> {
        let plan = self.plan()?;
        let at = self.posture();
        let units = Influence::units(plan.output);
        let units: Result<Vec<_>, _> = units.iter().map(|set| Acting::new(&at, set)).collect();
        let units = units?;
        let states = self.by_factor(plan, |free, kept| {
            respond_to_units(plan, &at, free, kept, &units)
        })?;
        Influence::new(self.model, self.geometry, &self.posture(), states)
    }

    /// Natural frequencies and modes.
    ///
    /// # Errors
    /// As [`ModalPlan::new`] and [`ModalPlan::modes`].
    pub fn modes(&self, options: &ModalOptions) -> Result<Modes, SolveError> {
        ModalPlan::new(self.model, options)?.modes(self.geometry)
    }

    fn posture(&self) -> Posture<'_> {
        posture(self.model, self.geometry, self.found())
    }

    fn plan(&self) -> Result<&'a Plan, SolveError> {
        planned(self.plan, self.model, self.own)
    }

    fn restraint(&self, plan: &Plan) -> Result<&Restraint, SolveError> {
        let kinematics = self.kinematics()?;
        let found = || Restraint::new(&self.posture(), kinematics, plan.output);
        let found = self.found().restraint.get_or_init(found);
        found.as_ref().map_err(Clone::clone)
    }

    fn solve_all(
        &self,
        plan: &Plan,
        acting: &[Acting],
        asked: Asked,
    ) -> Result<Solved, SolveError> {
        self.by_factor(plan, |free, kept| {
            solve_all(plan, &self.posture(), free, kept, (acting, asked))
        })
    }

    /// Asks what is factored, or will be.
    fn by_factor<T>(
        &self,
        plan: &Plan,
        ask: impl FnOnce(Free<'_>, &mut Option<Box<Factored>>) -> Result<T, SolveError>,
    ) -> Result<T, SolveError> {
        let free = Free {
            diagnosis: &self.found().diagnosis,
            kinematics: self.kinematics()?,
            restraint: self.restraint(plan)?,
        };
        let kept = self.found().factored.lock();
        ask(free, &mut kept.unwrap_or_else(PoisonError::into_inner))
    }
}
