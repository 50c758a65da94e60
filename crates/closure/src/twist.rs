//! Twists and the finite motions along them.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3, Vector6};

/// A motion of a rigid body: the velocity of the point of it at the origin, and its angular
/// velocity, in the axes of one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Twist {
    pub linear: Vector3<f64>,
    pub angular: Vector3<f64>,
}

/// Angles below this take a series: the closed form would lose digits.
const SMALL: f64 = 0.1;

impl Twist {
    /// The column of a joint's basis: linear part first.
    pub fn new(column: &Vector6<f64>) -> Self {
        Self {
            linear: column.fixed_rows::<3>(0).into_owned(),
            angular: column.fixed_rows::<3>(3).into_owned(),
        }
    }

    /// A turn about an axis through the origin.
    pub fn turn(angular: Vector3<f64>) -> Self {
        Self {
            linear: Vector3::zeros(),
            angular,
        }
    }

    /// Whether it turns nothing.
    pub fn is_translation(&self) -> bool {
        self.angular == Vector3::zeros()
    }

    /// The finite motion along it by `amount`, of any number of turns.
    pub fn exp(&self, amount: f64) -> Isometry3<f64> {
        let turn = self.angular * amount;
        let travel = self.linear * amount;
        let angle = turn.norm();
        let square = angle * angle;
        let (b, c) = if angle < SMALL {
            (
                0.5 - square * (1.0 / 24.0 - square * (1.0 / 720.0 - square / 40320.0)),
                1.0 / 6.0 - square * (1.0 / 120.0 - square * (1.0 / 5040.0 - square / 362_880.0)),
            )
        } else {
            (
                (1.0 - angle.cos()) / square,
                (angle - angle.sin()) / (square * angle),
            )
        };
        let once = turn.cross(&travel);
        let moved = travel + once * b + turn.cross(&once) * c;
        Isometry3::from_parts(
            Translation3::from(moved),
            UnitQuaternion::from_scaled_axis(turn),
        )
    }

    /// The same motion in the axes and about the origin in which `frame` is given.
    pub fn seen_through(&self, frame: &Isometry3<f64>) -> Self {
        let angular = frame.rotation * self.angular;
        let linear = frame.rotation * self.linear + frame.translation.vector.cross(&angular);
        Self { linear, angular }
    }

    /// The velocity of the body's point at `point`.
    pub fn velocity(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.linear + self.angular.cross(point)
    }

    /// Linear part first.
    pub fn column(&self) -> Vector6<f64> {
        let (v, w) = (self.linear, self.angular);
        Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z)
    }
}

/// The rotation vector of `rotation` that is nearest to `before`: a turn may be more than half a
/// revolution where it has come to be so.
pub(crate) fn rotation_vector(
    rotation: &UnitQuaternion<f64>,
    before: &Vector3<f64>,
) -> Vector3<f64> {
    let shortest = rotation.scaled_axis();
    let angle = shortest.norm();
    let axis = if angle > 1e-9 {
        shortest / angle
    } else if before.norm() > std::f64::consts::PI {
        before.normalize()
    } else {
        return shortest;
    };
    let turns = ((before.dot(&axis) - angle) / std::f64::consts::TAU).round();
    shortest + axis * (turns * std::f64::consts::TAU)
}

/// The change of the rotation vector `r` for an angular velocity: the inverse of its left
/// Jacobian, `E − ½ [r×] + (1 − θ/2 cot θ/2)/θ² [r×]²`.
pub(crate) fn rotation_vector_rate(r: &Vector3<f64>, angular: &Vector3<f64>) -> Vector3<f64> {
    let angle = r.norm();
    let half = 0.5 * angle;
    let factor = if angle < SMALL {
        let square = angle * angle;
        1.0 / 12.0 + square * (1.0 / 720.0 + square / 30240.0)
    } else {
        (1.0 - half / half.tan()) / (angle * angle)
    };
    let once = r.cross(angular);
    angular - once * 0.5 + r.cross(&once) * factor
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_screw_of_many_turns_travels_in_proportion() {
        let screw = Twist::new(&Vector6::new(0.0, 0.002, 0.0, 0.0, 1.0, 0.0));
        let moved = screw.exp(100.0);
        assert!((moved.translation.vector - Vector3::new(0.0, 0.2, 0.0)).amax() < 1e-15);
    }

    #[test]
    fn a_motion_is_the_sum_of_its_parts() {
        let twist = Twist::new(&Vector6::new(0.3, -0.2, 0.5, 0.4, 0.7, -0.1));
        for amount in [1e-3, 0.05, 0.12, 0.2, 3.0] {
            let whole = twist.exp(amount);
            let half = twist.exp(0.5 * amount);
            let twice = half * half;
            let off = (whole.translation.vector - twice.translation.vector).amax();
            assert!(off < 1e-15, "{amount}: {off:e}");
            assert!(whole.rotation.angle_to(&twice.rotation) < 1e-15);
        }
    }

    #[test]
    fn rotation_vectors_keep_their_turns() {
        let axis = Vector3::new(0.6, 0.0, 0.8);
        let mut before = Vector3::zeros();
        for k in 0..200 {
            let wanted = axis * (0.1 * f64::from(k));
            let rotation = UnitQuaternion::from_scaled_axis(wanted);
            before = rotation_vector(&rotation, &before);
            assert!((before - wanted).amax() < 1e-12, "{k}");
        }
    }

    #[test]
    fn the_rate_of_a_rotation_vector_is_its_difference() {
        for r in [
            Vector3::new(0.01, 0.02, -0.03),
            Vector3::new(1.2, -0.7, 0.9),
        ] {
            let angular = Vector3::new(0.3, 0.5, -0.2);
            let step = 1e-6;
            let at = |amount: f64| {
                let turn = UnitQuaternion::from_scaled_axis(angular * amount);
                (turn * UnitQuaternion::from_scaled_axis(r)).scaled_axis()
            };
            let slope = (at(step) - at(-step)) / (2.0 * step);
            assert!((rotation_vector_rate(&r, &angular) - slope).amax() < 1e-9);
        }
    }
}
