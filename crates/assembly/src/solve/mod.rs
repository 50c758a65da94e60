//! Full solves and poses of a sweep, by what a plan has made ready.

pub(crate) mod output;
pub(crate) mod sweep;

use nalgebra::Matrix6;

use crate::answer::solution::{Output, State, Warning};
use crate::error::SolveError;
use crate::kinematics::Kinematics;
use crate::kinematics::diagnosis::Diagnosis;
use crate::kinematics::motion::describe;
use crate::plan::Plan;
use crate::plan::fault::Fault;
use crate::plan::workspace::{LOADS, Workspace};
use crate::pose::recover::recover;
use crate::pose::restraint::Restraint;
use crate::pose::{act, form};
use crate::posture::Posture;
use crate::state::acting::Acting;
use crate::state::floor::Floor;

/// A full solve refines down to rounding.
const ROUNDING: f64 = 1e-15;
/// An error above this, or a last correction above this share of the solution, is worth a warning.
const LOST_DIGITS: f64 = 1e-10;

/// How much is asked of a full solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Asked {
    /// States, output, and an estimate of their precision, for a warning.
    All,
    /// States alone.
    States,
}

/// What a full solve finds.
pub(crate) struct Solved {
    pub output: Output,
    /// One a set of loads.
    pub states: Vec<State>,
    pub warnings: Vec<Warning>,
}

/// What stands without energy in a configuration, as a full solve needs it.
#[derive(Clone, Copy)]
pub(crate) struct Free<'a> {
    pub diagnosis: &'a Diagnosis,
    pub kinematics: &'a Kinematics,
    pub restraint: &'a Restraint,
}

/// One configuration, formed and, once it has served a first set of loads, factored: any others are
/// further right-hand sides.
#[derive(Debug)]
pub(crate) struct Factored {
    /// A plan of this very configuration, where the mechanism's does not take it.
    own: Option<Plan>,
    workspace: Workspace,
    /// The coordinates that are held so that nothing moves without energy; `None`: not factored yet.
    pins: Option<Vec<usize>>,
    /// The columns of unit forces on the output, and the compliance that corrects them, where its
    /// coordinates are independent and it is held.
    units: Option<(Vec<f64>, Matrix6<f64>)>,
}

impl Factored {
    /// Forms a configuration.
    ///
    /// # Errors
    /// An element or joint that cannot be formed; as [`Plan::absorbing`].
    pub fn new(plan: &Plan, at: &Posture<'_>, diagnosis: &Diagnosis) -> Result<Self, SolveError> {
        let mut workspace = plan.workspace();
        let own = match form(plan, at, &mut workspace) {
            Ok(()) => None,
            Err(Fault::Error(error)) => return Err(error),
            Err(Fault::Changed) => {
                let own = Plan::absorbing(at, true, diagnosis)?;
                workspace = own.workspace();
                settled(form(&own, at, &mut workspace))?;
                Some(own)
            }
        };
        Ok(Self {
            own,
            workspace,
            pins: None,
            units: None,
        })
    }

    /// What each of these sets of loads does.
    fn solve(
        &mut self,
        plan: &Plan,
        at: &Posture<'_>,
        free: Free<'_>,
        acting: &[Acting],
        asked: Asked,
    ) -> Result<Solved, SolveError> {
        let plan = self.own.as_ref().unwrap_or(plan);
        let (restraint, workspace) = (free.restraint, &mut self.workspace);
        settled(act(plan, at, acting, workspace))?;
        let pins = match &self.pins {
            Some(pins) => pins,
            None => {
                let pins = restraint.pins(plan, at, workspace);
                plan.factor(workspace, &pins)?;
                self.pins.insert(pins)
            }
        };
        let condensed = plan.find(workspace, pins, ROUNDING)?;
        let at_rest = Floor::at_rest(at);
        let floors: Vec<Floor> = acting.iter().map(|a| at_rest.under(at, a)).collect();
        let works: Vec<f64> = floors.iter().map(Floor::least_work).collect();
        let (mut output, displacements, settled, compliance) =
            plan.output(at.geometry, workspace, pins, restraint, &works)?;
        let held = output.free_motions.is_empty();
        if let Some(inverse) = compliance.as_ref().filter(|_| held && asked == Asked::All) {
            let (refined, columns) = plan.refined_compliance(workspace, pins, inverse);
            output.compliance = Some(refined);
            self.units = Some((columns, *inverse));
        }
        let mut doubtful = free.kinematics.doubtful.or(workspace.doubtful);
        let mut states = Vec::with_capacity(acting.len());
        let mut off = 0.0_f64;
        let each = acting.iter().zip(&floors).zip(displacements);
        for (set, (acting, displacement)) in each.enumerate() {
            let recovered = recover(plan, at, workspace, set, acting, displacement)?;
            doubtful = doubtful.or(recovered.doubtful);
            let state = recovered.state;
            let scale = state.largest_wrench();
            if recovered.off > 0.0 && scale > 0.0 {
                off = off.max(recovered.off / scale);
            }
            if !state.is_finite() {
                return Err(SolveError::Overflow);
            }
            states.push(state);
        }
        if !output.is_finite() {
            return Err(SolveError::Overflow);
        }
        let mut warnings = Vec::new();
        if let Some(value) = doubtful {
            let nearly_free = free.kinematics.nearly_free.as_ref();
            warnings.push(Warning::NearSingular {
                value,
                motion: nearly_free.map(|motion| describe(motion, at.model, at.geometry, at.size)),
            });
        }
        if let Some(first) = states.first() {
            output.displacement = first.output;
        }
        if asked == Asked::All {
            let lost = plan.lost(at, workspace, &output, &states)?;
            let held = (&**pins, compliance.as_ref());
            let spread = plan.spread(at, workspace, held, &states)?;
            let error = lost.max(condensed).max(settled).max(spread).max(off);
            if error > LOST_DIGITS {
                warnings.push(Warning::LostDigits { error });
            }
        }
        Ok(Solved {
            output,
            states,
            warnings,
        })
    }
}

impl Factored {
    /// What unit forces on the output do: they are what its compliance was found from. `None` where
    /// its coordinates are not independent.
    fn units(
        &mut self,
        plan: &Plan,
        at: &Posture<'_>,
        free: Free<'_>,
        acting: &[Acting],
    ) -> Result<Option<Vec<State>>, SolveError> {
        if self.units.is_none() {
            self.solve(plan, at, free, &[], Asked::All)?;
        }
        let plan = self.own.as_ref().unwrap_or(plan);
        let (Some((columns, compliance)), Some(pins)) = (&self.units, &self.pins) else {
            return Ok(None);
        };
        let workspace = &mut self.workspace;
        let n = plan.unknowns();
        let motions = workspace.solutions[..LOADS * n].to_vec();
        settled(act(plan, at, acting, workspace))?;
        workspace.solutions[..LOADS * n].copy_from_slice(&motions);
        workspace.solutions[LOADS * n..].copy_from_slice(columns);
        let sets = LOADS..workspace.columns();
        plan.find_remainder(workspace, pins, Some(compliance), sets);
        let at_rest = Floor::at_rest(at);
        let states = acting.iter().enumerate().map(|(set, acting)| {
            let floor = at_rest.under(at, acting);
            let output = plan.output_displacement(workspace, LOADS + set);
            let state = recover(plan, at, workspace, set, (acting, &floor), output)?.state;
            match state.is_finite() {
                true => Ok(state),
                false => Err(SolveError::Overflow),
            }
        });
        states.collect::<Result<_, _>>().map(Some)
    }
}

/// What unit forces on the output do, one by one.
///
/// # Errors
/// As [`solve_all`].
pub(crate) fn respond_to_units(
    plan: &Plan,
    at: &Posture<'_>,
    free: Free<'_>,
    kept: &mut Option<Box<Factored>>,
    acting: &[Acting],
) -> Result<Vec<State>, SolveError> {
    free.restraint.check_loads(at, acting)?;
    plan.check_sets(at.model, acting.len())?;
    let mut factored = match kept.take() {
        Some(factored) => factored,
        None => Box::new(Factored::new(plan, at, free.diagnosis)?),
    };
    let states = match factored.units(plan, at, free, acting)? {
        Some(states) => states,
        None => {
            factored
                .solve(plan, at, free, acting, Asked::States)?
                .states
        }
    };
    *kept = Some(factored);
    Ok(states)
}

/// What each of these sets of loads does in a configuration, by the plan of its mechanism. What is
/// formed and factored is left in `kept`, and taken from there.
///
/// # Errors
/// As [`solve`](crate::solve).
pub(crate) fn solve_all(
    plan: &Plan,
    at: &Posture<'_>,
    free: Free<'_>,
    kept: &mut Option<Box<Factored>>,
    (acting, asked): (&[Acting], Asked),
) -> Result<Solved, SolveError> {
    free.restraint.check_loads(at, acting)?;
    plan.check_sets(at.model, acting.len())?;
    let mut factored = match kept.take() {
        Some(factored) => factored,
        None => Box::new(Factored::new(plan, at, free.diagnosis)?),
    };
    let solved = factored.solve(plan, at, free, acting, asked)?;
    *kept = Some(factored);
    Ok(solved)
}

/// What a plan gives that was made for this very configuration.
fn settled<T>(result: Result<T, Fault>) -> Result<T, SolveError> {
    result.map_err(|fault| match fault {
        Fault::Error(error) => error,
        Fault::Changed => SolveError::Singular,
    })
}
