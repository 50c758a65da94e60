//! Two links in a plane between two given points: where their common joint, the elbow, stands.

use nalgebra::Point3;
use serde::Deserialize;

use super::construction::{Name, NamedPoint};
use super::error::shown;
use crate::prebuilt::PoseError;

/// How far, relative to the links' length, a pose may miss the edge of their reach and still
/// count as on it (both links in one line). Loops then close to this, not to rounding.
const EDGE: f64 = 1e-12;

/// On which side the elbow B of a limb A–B–C stands, for one who looks along A to C with the
/// limb's joint axes pointing up; on a sphere, with its centre below.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
pub enum ElbowSide {
    /// On the left: from A, the way to B is that to C turned by a positive angle about the axes.
    #[default]
    Left,
    /// On the right.
    Right,
}

impl ElbowSide {
    /// 1 on the left, −1 on the right.
    pub(super) fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }
}

/// Two links of these lengths (m) from A to B and from B to C, in the plane normal to their
/// joint axes.
pub(super) struct TwoLinks {
    /// Number of the limb, from 1, for messages.
    pub(super) limb: usize,
    pub(super) proximal: f64,
    pub(super) distal: f64,
    pub(super) side: ElbowSide,
}

impl TwoLinks {
    /// The elbow B seen from A, for C at `reach` from A (m).
    pub(super) fn elbow(&self, reach: [f64; 2]) -> Result<[f64; 2], PoseError> {
        let Self { limb, .. } = self;
        let (sum, difference) = (self.proximal + self.distal, self.proximal - self.distal);
        let edge = EDGE * sum;
        let distance = (reach[0] * reach[0] + reach[1] * reach[1]).sqrt();
        if distance > sum + edge {
            return Err(PoseError::unreachable(format!(
                "limb {limb}: point C{limb} is too far from A{limb}: {} m across the joint axes, \
                 where the two links reach {} m",
                shown(distance),
                shown(sum),
            )));
        }
        if distance < difference.abs() - edge {
            return Err(PoseError::unreachable(format!(
                "limb {limb}: point C{limb} is too close to A{limb}: {} m across the joint axes, \
                 where the two links reach no nearer than {} m",
                shown(distance),
                shown(difference.abs()),
            )));
        }
        if distance <= edge {
            return Err(PoseError::singular(format!(
                "limb {limb}: point C{limb} lies on the axis of A{limb}, so the links may have \
                 any angle"
            )));
        }

        // Foot of the elbow's height over the line from A to C, and that height by Heron's
        // formula, which keeps its digits where the links are nearly in line.
        let foot = (distance * distance + sum * difference) / (2.0 * distance);
        let square =
            (sum - distance) * (sum + distance) * (distance - difference) * (distance + difference);
        let height = self.side.sign() * square.max(0.0).sqrt() / (2.0 * distance);
        let along = [reach[0] / distance, reach[1] / distance];
        Ok([
            foot * along[0] - height * along[1],
            foot * along[1] + height * along[0],
        ])
    }
}

/// The joints A, B and C of a limb (from 0), by name.
#[inline]
pub(super) fn joints_of([a, b, c]: [Point3<f64>; 3], index: usize) -> [NamedPoint; 3] {
    [
        (Name::limb("A", index), a),
        (Name::limb("B", index), b),
        (Name::limb("C", index), c),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINKS: TwoLinks = TwoLinks {
        limb: 2,
        proximal: 3.0,
        distal: 4.0,
        side: ElbowSide::Left,
    };

    #[test]
    fn a_right_angle_between_the_links() {
        let elbow = LINKS.elbow([5.0, 0.0]).expect("in reach");
        assert!((elbow[0] - 1.8).abs() < 1e-15 && (elbow[1] - 2.4).abs() < 1e-15);
        let right = TwoLinks {
            side: ElbowSide::Right,
            ..LINKS
        };
        let elbow = right.elbow([0.0, 5.0]).expect("in reach");
        assert!((elbow[0] - 2.4).abs() < 1e-15 && (elbow[1] - 1.8).abs() < 1e-15);
    }

    #[test]
    fn the_edges_of_the_reach() {
        let stretched = LINKS.elbow([0.0, 7.0]).expect("in reach");
        assert!(stretched[0].abs() < 1e-7 && (stretched[1] - 3.0).abs() < 1e-7);
        for (reach, word) in [([7.001, 0.0], "too far"), ([0.0, 0.999], "too close")] {
            let error = LINKS.elbow(reach).expect_err(word).to_string();
            assert!(error.contains(word) && error.contains("limb 2"), "{error}");
        }
        let even = TwoLinks {
            distal: 3.0,
            ..LINKS
        };
        let error = even.elbow([0.0, 0.0]);
        assert!(matches!(error, Err(PoseError::Singular { .. })));
    }
}
