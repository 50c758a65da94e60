//! Natural frequencies and modes: K φ = ω² M φ over the independent displacement coordinates.
//!
//! The model's segments are divided into their elements, whose inner nodes have coordinates here,
//! and no joint is absorbed, so that every node with a mass has its displacement. Loops are closed
//! by the same elimination as in statics: rigid joints and bodies are exact, and no mass or
//! stiffness is invented for them.

mod lanczos;
mod mass;
mod sensitivity;
mod shape;
mod system;

use nalgebra::Vector6;

use crate::error::SolveError;
use crate::kinematics::diagnosis::Diagnosis;
use crate::modal::lanczos::lowest;
use crate::modal::mass::{MassPlan, Masses};
pub use crate::modal::sensitivity::{FrequencySensitivity, ModalSensitivities};
use crate::modal::system::{Mode as Found, System};
use crate::plan::Plan;
use crate::plan::fault::Fault;
use crate::plan::workspace::Workspace;
use crate::pose::evaluate;
use crate::pose::restraint::Restraint;
use crate::posture::Posture;
use crate::room;
use crate::room::MOST_NUMBERS;
use hyperstat_model::ModalOptions;
use hyperstat_model::Model;
use hyperstat_model::{BodyId, Geometry, NodeId, Segment};

/// What the inner nodes of too many elements ask for.
const COORDINATES: &str = "the coordinates of its elements";
/// Elements of a model at the most.
const MOST_ELEMENTS: usize = 200_000;

/// A natural mode.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Mode {
    /// Natural frequency \[Hz\]; zero for a motion of the output that nothing resists.
    pub frequency: f64,
    /// Displacement of every node by `NodeId`, global axes \[m/√kg, rad/√kg\]: of unit modal mass,
    /// φᵀ M φ = 1. Of equal frequencies any orthonormal combination is as good.
    pub displacements: Vec<Vector6<f64>>,
    /// The same of the nodes inside every segment, by `SegmentId`, from its first end on.
    pub inner: Vec<Vec<Vector6<f64>>>,
    /// Effective mass in a translation of the ground along x, y and z \[kg\]; over all modes they
    /// add to the mass that can move.
    pub effective_mass: [f64; 3],
    /// Share of every body in the kinetic energy, by `BodyId`; they add to 1.
    pub kinetic: Vec<f64>,
    /// ‖ω² K⁻¹ M φ − φ‖ in the mass, φ having length 1: ω² is good to about its square.
    pub residual: f64,
}

impl Mode {
    /// The bodies that have most of the kinetic energy, largest first.
    pub fn most_moved(&self) -> Vec<(BodyId, f64)> {
        let bodies = self.kinetic.iter().enumerate();
        let mut shares: Vec<_> = bodies.map(|(k, share)| (BodyId(k), *share)).collect();
        shares.sort_by(|a, b| b.1.total_cmp(&a.1));
        shares
    }
}

/// Natural frequencies and modes of one configuration.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Modes {
    /// The modes, lowest first.
    pub modes: Vec<Mode>,
    /// Mass of all beams and nodes \[kg\].
    pub mass: f64,
    /// Motions without energy that leave the output where it is, and have mass: their frequency is
    /// zero, and they are not among the modes.
    pub idle: usize,
    /// Whether a count of all frequencies below the last one (Sylvester's law of inertia) says
    /// that none is missing.
    pub complete: bool,
}

/// A topology made ready for natural frequencies: one plan serves every pose of a mechanism.
#[derive(Debug)]
pub struct ModalPlan {
    model: Model,
    /// The same with the nodes inside segments.
    divided: Model,
    options: ModalOptions,
    ready: Ready,
}

/// A topology made ready: where the coordinates are, and where the masses.
#[derive(Debug)]
struct Ready {
    plan: Plan,
    masses: MassPlan,
}

impl Ready {
    fn new(divided: &Model, geometry: &Geometry) -> Result<Self, SolveError> {
        let at = Posture::new(divided, geometry);
        let plan = Plan::absorbing(&at, false, &Diagnosis::default())?;
        let masses = MassPlan::new(&plan, divided)?;
        Ok(Self { plan, masses })
    }
}

/// What was found in a configuration, and from what.
struct Outcome<'a> {
    ready: &'a Ready,
    workspace: &'a Workspace,
    geometry: &'a Geometry,
    masses: &'a Masses,
    modes: Vec<Found>,
    idle: usize,
    complete: bool,
}

impl ModalPlan {
    /// Plan of a model, whose elastic bodies have densities. Masses of nodes belong to the model's
    /// own configuration.
    ///
    /// # Errors
    /// As [`Prepared::unknowns`](crate::Prepared::unknowns); [`SolveError::NoDensity`]; [`SolveError::TooLarge`] for more than 200 000
    /// elements; [`SolveError::SingularCompliance`] for a joint that only a subassembly could take
    /// in, since none is absorbed here.
    pub fn new(model: &Model, options: &ModalOptions) -> Result<Self, SolveError> {
        model.check()?;
        let bare = |s: &&Segment| s.material.density().is_none();
        if let Some(segment) = model.segments().iter().find(bare) {
            return Err(SolveError::NoDensity {
                body: model.bodies()[segment.body.0].name.clone(),
            });
        }
        let sizes = model.segments().iter().map(|segment| segment.elements);
        let elements = sizes.fold(0, usize::saturating_add);
        room::check(COORDINATES, elements.saturating_mul(6), 6 * MOST_ELEMENTS)?;
        let divided = model.divided()?;
        let ready = Ready::new(&divided, divided.geometry())?;
        let unknowns = ready.plan.unknowns;
        let numbers = room::matrix(options.count.min(unknowns), unknowns);
        room::check("its natural modes", numbers, MOST_NUMBERS)?;
        Ok(Self {
            model: model.clone(),
            divided,
            options: options.clone(),
            ready,
        })
    }

    /// Number of modes that are asked for.
    pub fn count(&self) -> usize {
        self.options.count
    }

    /// Natural frequencies and modes in a configuration of the model.
    ///
    /// # Errors
    /// [`SolveError::NoMass`] where nothing has mass; [`SolveError::ModesNotFound`] where they do
    /// not converge; as [`solve`](crate::solve).
    pub fn modes(&self, geometry: &Geometry) -> Result<Modes, SolveError> {
        self.find(geometry, self.options.count, true, |outcome| Modes {
            modes: outcome
                .modes
                .iter()
                .map(|m| self.mode(&outcome, m))
                .collect(),
            mass: outcome.masses.total,
            idle: outcome.idle,
            complete: outcome.complete,
        })
    }

    /// Natural frequencies \[Hz\] alone, lowest first.
    ///
    /// # Errors
    /// As [`ModalPlan::modes`].
    pub fn frequencies(&self, geometry: &Geometry) -> Result<Vec<f64>, SolveError> {
        self.find(geometry, self.options.count, false, |outcome| {
            let modes = outcome.modes.iter();
            modes.map(|mode| hertz(mode.eigenvalue)).collect()
        })
    }

    /// A mode at the nodes.
    fn mode(&self, outcome: &Outcome<'_>, found: &Found) -> Mode {
        let (ready, x) = (outcome.ready, &found.vector);
        let at = |node| {
            let (plan, workspace) = (&ready.plan, outcome.workspace);
            ready
                .masses
                .displacement(plan, workspace, outcome.geometry, node, x)
        };
        let mut inner = (self.model.nodes().len()..).map(NodeId);
        let segments = self.model.segments().iter();
        let bodies = self.model.bodies().len();
        let (participation, kinetic) = ready.masses.shares(outcome.masses, bodies, x);
        Mode {
            frequency: hertz(found.eigenvalue),
            displacements: (0..self.model.nodes().len())
                .map(|k| at(NodeId(k)))
                .collect(),
            inner: segments
                .map(|segment| inner.by_ref().take(segment.elements - 1).map(at).collect())
                .collect(),
            effective_mass: participation.map(|p| p * p).into(),
            kinetic,
            residual: found.residual,
        }
    }

    /// Finds the `count` lowest modes of a configuration; `diagnose` looks for motions without energy even where
    /// the plan's own configuration has none.
    fn find<T>(
        &self,
        geometry: &Geometry,
        count: usize,
        diagnose: bool,
        take: impl FnOnce(Outcome<'_>) -> T,
    ) -> Result<T, SolveError> {
        self.model
            .check_geometry(geometry, self.ready.plan.one_point)?;
        let geometry = self.model.divided_geometry(geometry)?;
        let at = Posture::new(&self.divided, &geometry);
        let mut workspace = self.ready.plan.workspace();
        let mut changed = None;
        let mut ready = &self.ready;
        match evaluate(&ready.plan, &at, &[], &mut workspace) {
            Ok(()) => {}
            Err(Fault::Error(error)) => return Err(error),
            Err(Fault::Changed) => {
                ready = changed.insert(Ready::new(&self.divided, &geometry)?);
                workspace = ready.plan.workspace();
                let again = evaluate(&ready.plan, &at, &[], &mut workspace);
                again.map_err(|fault| match fault {
                    Fault::Error(error) => error,
                    Fault::Changed => SolveError::Singular,
                })?;
            }
        }
        let (plan, workspace) = (&ready.plan, &workspace);
        let parts = self.model.segments().iter().map(|s| s.elements);
        let masses = ready.masses.elements(
            plan,
            &self.divided,
            &geometry,
            workspace,
            parts,
            &self.options,
        )?;
        if masses.total <= 0.0 {
            return Err(SolveError::NoMass);
        }
        let system = |restraint: Option<&Restraint>| {
            let restraint = restraint.map(|r| (r, &at));
            System::new(plan, workspace, &ready.masses, &masses, restraint)
        };
        let held = (!diagnose && !plan.has_idle).then(|| system(None));
        let mut system = match held {
            Some(Ok(system)) => system,
            _ => system(Some(&Restraint::of(&at, plan.output)?))?,
        };
        let mut modes: Vec<Found> = system.moving().take(count).map(Found::at_rest).collect();
        let mut complete = true;
        if modes.len() < count {
            let elastic = lowest(&mut system, count - modes.len())?;
            complete = elastic.complete;
            modes.extend(elastic.modes);
        }
        Ok(take(Outcome {
            ready,
            workspace,
            geometry: &geometry,
            masses: &masses,
            idle: system.idle,
            modes,
            complete,
        }))
    }
}

/// ω² in Hz.
fn hertz(eigenvalue: f64) -> f64 {
    eigenvalue.max(0.0).sqrt() / std::f64::consts::TAU
}
