//! Natural frequencies and modes: K φ = ω² M φ over the independent displacement coordinates.
//!
//! No joint is absorbed, so that every node with a mass has its displacement, and every segment has
//! inner shapes beside its static ones, as many as its length of wave at the highest frequency asks
//! for ([`InnerShapes`](hyperstat_elements::InnerShapes)); or, for consistent and lumped masses, the
//! inner nodes of its elements. Loops are closed by the same elimination as in statics: rigid joints
//! and bodies are exact, and no mass or stiffness is invented for them.

mod lanczos;
mod mass;
mod member;
mod ready;
mod sensitivity;
mod shape;
mod system;

use hyperstat_elements::rotate_vector6;
use hyperstat_model::{BodyId, Geometry, ModalOptions, Model, NodeId, Segment};
use nalgebra::Vector6;

use crate::error::SolveError;
use crate::modal::ready::{Outcome, Ready};
pub use crate::modal::sensitivity::{FrequencySensitivity, ModalSensitivities};
use crate::modal::shape::Curve;
use crate::modal::system::Mode as Found;
use crate::plan::fault::Fault;

/// Times that members are made again for a configuration, each finer than the last.
const MOST_ROUNDS: usize = 10;

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
    /// What every segment does along it.
    curves: Vec<Curve>,
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
    /// How many there are below which frequency, by that count.
    pub counted: Option<Counted>,
}

/// A count of frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Counted {
    /// The frequency \[Hz\] below which they were counted: in the gap after the last that was asked
    /// for, or after those that equal it.
    pub below: f64,
    /// Their number, with those of the output's free motions, which are zero, and without the idle
    /// ones.
    pub modes: usize,
    /// How many of them were found: the same where none is missing.
    pub found: usize,
}

/// A topology made ready for natural frequencies: one plan serves every pose of a mechanism.
#[derive(Debug)]
pub struct ModalPlan {
    model: Model,
    options: ModalOptions,
    ready: Ready,
}

impl ModalPlan {
    /// Plan of a model, whose elastic bodies have densities. Masses of nodes belong to the model's
    /// own configuration, and so does the highest frequency by which exact masses are as fine as they
    /// need to be: poses of frequencies beyond twice that ω² make finer ones of their own.
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
        let made = |limit| Ready::new(model, model.geometry(), options, limit);
        let mut ready = made(None)?;
        for _ in 0..MOST_ROUNDS {
            // What is wrong with a configuration is told of it, when it is asked for.
            let wanted = match ready.find(model, model.geometry(), options.count, false) {
                Ok(outcome) => outcome.wanted(options.count),
                Err(_) => break,
            };
            let settled = wanted <= ready.limit();
            if wanted != ready.limit() {
                ready = made(Some(wanted))?;
            }
            if settled {
                break;
            }
        }
        Ok(Self {
            model: model.clone(),
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
            counted: outcome.counted.map(|counted| Counted {
                below: hertz(counted.below),
                ..counted
            }),
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
        let segments = self.model.segments();
        let curves = outcome.curves(found);
        let frames = outcome.frames(&self.model);
        let inner = segments.iter().zip(&curves).zip(frames);
        let bodies = self.model.bodies().len();
        let (participation, kinetic) = outcome.shares(bodies, found);
        let nodes = (0..self.model.nodes().len()).map(NodeId);
        Mode {
            frequency: hertz(found.eigenvalue),
            displacements: nodes
                .map(|node| outcome.displacement(node, found))
                .collect(),
            inner: inner
                .map(|((segment, curve), frame)| {
                    let place = |k: usize| k as f64 / segment.elements as f64;
                    let inner = (1..segment.elements).map(place);
                    inner
                        .map(|xi| rotate_vector6(&curve.at(xi), &frame))
                        .collect()
                })
                .collect(),
            effective_mass: participation.map(|p| p * p).into(),
            kinetic,
            residual: found.residual,
            curves,
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
        let mut own: Option<Ready> = None;
        for _ in 0..MOST_ROUNDS {
            let ready = own.as_ref().unwrap_or(&self.ready);
            let limit = match ready.find(&self.model, geometry, count, diagnose) {
                Ok(outcome) if outcome.is_resolved(count) => return Ok(take(outcome)),
                Ok(outcome) => outcome.wanted(count),
                Err(Fault::Error(error)) => return Err(error),
                Err(Fault::Changed) if own.is_some() => return Err(SolveError::Singular),
                Err(Fault::Changed) => ready.limit(),
            };
            own = Some(Ready::new(
                &self.model,
                geometry,
                &self.options,
                Some(limit),
            )?);
        }
        Err(SolveError::ModesNotFound { found: 0 })
    }
}

/// ω² in Hz.
fn hertz(eigenvalue: f64) -> f64 {
    eigenvalue.max(0.0).sqrt() / std::f64::consts::TAU
}
