//! A wrench of one pose, about a point of its own.

use nalgebra::{Vector3, Vector6};

/// A force and a moment about some point.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Wrench {
    pub force: Vector3<f64>,
    pub moment: Vector3<f64>,
}

impl Wrench {
    pub fn of(six: &Vector6<f64>) -> Self {
        Self {
            force: six.fixed_rows::<3>(0).into_owned(),
            moment: six.fixed_rows::<3>(3).into_owned(),
        }
    }

    /// The same about another point; `arm`: from there to the own one.
    pub fn carried(self, arm: &Vector3<f64>) -> Self {
        Self {
            moment: self.moment + arm.cross(&self.force),
            ..self
        }
    }

    pub fn six(self) -> Vector6<f64> {
        let (f, m) = (self.force, self.moment);
        Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z)
    }

    pub fn add(&mut self, other: Self) {
        self.force += other.force;
        self.moment += other.moment;
    }

    /// What it does along a twist about its point.
    pub fn work(&self, [linear, angular]: &[Vector3<f64>; 2]) -> f64 {
        self.force.dot(linear) + self.moment.dot(angular)
    }

    pub fn turned_back(self) -> Self {
        Self {
            force: -self.force,
            moment: -self.moment,
        }
    }
}
