//! Three driven carriages on rails, 120° apart about z, and where they stand for rods of given
//! length.

use nalgebra::{Point3, Vector3};
use serde::Deserialize;

use super::error::shown;
use super::limbs::{LIMBS, outward};
use crate::prebuilt::{ParameterError, PoseError, parameter};

/// How far, relative to the rods' length, a pose may miss the edge of their reach and still
/// count as on it (the rods normal to the rail). Loops then close to this, not to rounding.
const EDGE: f64 = 1e-12;

/// The rails of a mechanism: rail i is rail 1 turned by 120° (i − 1) about z, rail 1 over +y.
#[derive(Debug, Clone, PartialEq)]
pub struct Rails {
    /// Distance of the rails' feet, at z = 0, from z (m).
    pub radius: f64,
    /// By how much the rails lean inward from z (rad), −π/2 to π/2: 0 is upright, π/2 level and
    /// towards the middle, −π/2 level and away from it.
    pub tilt: f64,
    /// Travel of a carriage from the foot of its rail (m). A pose that needs more, or less than
    /// none, is out of reach.
    pub travel: f64,
    /// Which of the two places on its rail a carriage takes.
    pub carriage: CarriageSide,
}

/// On which side of the foot of the perpendicular from the platform's joint to its rail a
/// carriage stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
pub enum CarriageSide {
    /// Nearer to the rail's foot: on upright rails the rods rise to the platform.
    #[default]
    Near,
    /// Farther from it: on upright rails the platform hangs on the rods.
    Far,
}

impl Rails {
    /// Looks whether every parameter is in its physical range.
    ///
    /// # Errors
    /// The first that is not: a negative radius, a tilt out of −π/2 to π/2, a travel that is not
    /// above zero.
    pub fn check(&self) -> Result<(), ParameterError> {
        parameter::radius("radius", self.radius)?;
        parameter::tilt("tilt", self.tilt)?;
        parameter::positive_length("travel", self.travel)
    }

    /// Directions of the rails, away from their feet.
    #[inline]
    pub(super) fn directions(&self) -> [Vector3<f64>; LIMBS] {
        let (sin, cos) = self.tilt.sin_cos();
        [0, 1, 2].map(|index| Vector3::z() * cos - outward(index) * sin)
    }

    /// Where the carriage of rail `index` (from 0) stands, from which rods of `length` reach to
    /// `target`, named `name` and the limb's number in messages. `direction` is the rail's.
    #[inline]
    pub(super) fn carriage(
        &self,
        index: usize,
        direction: &Vector3<f64>,
        length: f64,
        target: &Point3<f64>,
        name: &str,
    ) -> Result<Point3<f64>, PoseError> {
        let limb = index + 1;
        let foot = outward(index) * self.radius;
        let reach = target.coords - foot;
        let along = reach.dot(direction);
        let apart = (reach - direction * along).norm();
        if apart.is_nan() || apart > length * (1.0 + EDGE) {
            return Err(PoseError::unreachable(format!(
                "limb {limb}: {name}{limb} is {} m from its rail, too far for {} m",
                shown(apart),
                shown(length),
            )));
        }
        let half = ((length - apart) * (length + apart)).max(0.0).sqrt();
        let travel = match self.carriage {
            CarriageSide::Near => along - half,
            CarriageSide::Far => along + half,
        };
        let edge = EDGE * self.travel;
        if travel < -edge || travel > self.travel + edge {
            return Err(PoseError::unreachable(format!(
                "limb {limb}: the carriage would stand at {} m on its rail, which goes from 0 to \
                 {} m",
                shown(travel),
                shown(self.travel),
            )));
        }
        Ok(Point3::from(foot + direction * travel))
    }
}
