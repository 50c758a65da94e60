//! What elimination says of one configuration: each of the eliminations is done once, when it is
//! first asked for, and whoever asks again is told the same.

use std::sync::OnceLock;

use hyperstat_model::Model;

use super::Kinematics;
use super::jacobian::{Eliminated, Jacobian};
use super::redundancy::{Redundancy, redundancies};
use crate::error::SolveError;
use crate::posture::Posture;

/// Conditions, and what their elimination leaves.
#[derive(Debug)]
pub(crate) struct Conditions {
    pub jacobian: Jacobian,
    pub eliminated: Eliminated,
}

impl Conditions {
    fn new(jacobian: Jacobian) -> Self {
        Self {
            eliminated: jacobian.eliminated(),
            jacobian,
        }
    }
}

/// The eliminations of one configuration.
#[derive(Debug, Default)]
pub(crate) struct Diagnosis {
    released: OnceLock<Conditions>,
    held: OnceLock<Conditions>,
    kinematics: OnceLock<Result<Kinematics, SolveError>>,
}

impl Diagnosis {
    /// The conditions of the joints with their drives released.
    fn released(&self, at: &Posture<'_>) -> &Conditions {
        let found = || Conditions::new(Jacobian::released(at));
        self.released.get_or_init(found)
    }

    /// The conditions of the rigid and elastic directions.
    fn held(&self, at: &Posture<'_>) -> &Conditions {
        let found = || Conditions::new(Jacobian::held(at));
        self.held.get_or_init(found)
    }

    /// Whether anything moves without energy, drives locked.
    pub fn is_loose(&self, at: &Posture<'_>) -> bool {
        self.held(at).eliminated.rank() < freedoms(at.model)
    }

    /// Counts and motions.
    ///
    /// # Errors
    /// Motions too many, of too many bodies each.
    pub fn kinematics(&self, at: &Posture<'_>) -> Result<&Kinematics, SolveError> {
        let found = self.kinematics.get_or_init(|| self.found(at));
        found.as_ref().map_err(Clone::clone)
    }

    fn found(&self, at: &Posture<'_>) -> Result<Kinematics, SolveError> {
        let (released, held) = (self.released(at), self.held(at));
        let nearly_free = match held.eliminated.doubtful() {
            Some(_) => held.jacobian.nearly_free(at.size)?,
            None => None,
        };
        let rank = released.eliminated.rank();
        let doubtful = held.eliminated.doubtful();
        Ok(Kinematics {
            mobility: freedoms(at.model) - rank,
            overconstraint: released.jacobian.directions.len() - rank,
            motions: held.jacobian.motions(&held.eliminated, at.size)?,
            doubtful: doubtful.or(released.eliminated.doubtful()),
            nearly_free,
        })
    }

    /// The redundant constraints.
    pub fn redundancies(&self, at: &Posture<'_>) -> Vec<Redundancy> {
        let Conditions {
            jacobian,
            eliminated,
        } = self.released(at);
        redundancies(jacobian, eliminated)
    }
}

/// Freedoms of all bodies without joints.
fn freedoms(model: &Model) -> usize {
    6 * model.bodies().len()
}
