//! A mechanism made ready for natural frequencies: what is asked of it.

use hyperstat_elements::rotate_vector6;
use hyperstat_model::{BeamMass, Geometry, ModalOptions, Model, NodeId, Segment};

use crate::error::SolveError;
use crate::modal::mode::{Counted, Mode, Modes};
use crate::modal::ready::{Outcome, Ready};
use crate::modal::system::Mode as Found;
use crate::plan::fault::Fault;

/// Times that members are made again for a configuration, each finer than the last.
const MOST_ROUNDS: usize = 10;

/// A topology made ready for natural frequencies: one plan serves every pose of a mechanism.
#[derive(Debug)]
pub struct ModalPlan {
    pub(super) model: Model,
    pub(super) options: ModalOptions,
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
        if options.mass == BeamMass::Exact {
            ready.begin_with(model, model.geometry(), options.count);
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
        self.find(geometry, self.options.count, true, |mut outcome| {
            outcome.align(self.model.bodies().len());
            Modes {
                modes: outcome
                    .modes
                    .iter()
                    .take(self.options.count)
                    .map(|m| self.mode(&outcome, m))
                    .collect(),
                mass: outcome.masses.total,
                idle: outcome.idle,
                complete: outcome.complete,
                counted: outcome.counted.map(|counted| Counted {
                    below: hertz(counted.below),
                    ..counted
                }),
            }
        })
    }

    /// Natural frequencies \[Hz\] alone, lowest first.
    ///
    /// # Errors
    /// As [`ModalPlan::modes`], which tells of a count that fails in its result: here it is
    /// [`SolveError::ModesUncounted`], where masses are exact.
    pub fn frequencies(&self, geometry: &Geometry) -> Result<Vec<f64>, SolveError> {
        if let Some(squares) = self.ready.squares(&self.model, geometry) {
            return Ok(squares.into_iter().map(hertz).collect());
        }
        self.find(geometry, self.options.count, false, |outcome| {
            if !outcome.complete && self.options.mass == BeamMass::Exact {
                let found = outcome.modes.len();
                return Err(SolveError::ModesUncounted { found });
            }
            let modes = outcome.modes.iter().take(self.options.count);
            Ok(modes.map(|mode| hertz(mode.eigenvalue)).collect())
        })?
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
    pub(super) fn find<T>(
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
pub(super) fn hertz(eigenvalue: f64) -> f64 {
    eigenvalue.max(0.0).sqrt() / std::f64::consts::TAU
}
