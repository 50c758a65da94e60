//! Mass and inertia of rigid bodies.

use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3};

use crate::error::{ElementError, check};
use crate::frame::transport;

/// An eigenvalue of an inertia below this part of its largest entry, negated, is negative: more
/// than the rounding of a file with seven digits.
const ROUNDING: f64 = 1e-6;

/// Mass and inertia of a rigid body about its centre of mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidMass {
    mass: f64,
    inertia: Matrix3<f64>,
}

impl RigidMass {
    /// A mass \[kg\] without inertia of its own.
    ///
    /// # Errors
    /// [`ElementError::OutOfRange`] for one that is negative or not finite.
    pub fn point(mass: f64) -> Result<Self, ElementError> {
        Self::new(mass, Matrix3::zeros())
    }

    /// A body of this mass \[kg\] and these moments of inertia about axes through its centre of
    /// mass (Jxx, Jyy, Jzz) \[kg·m²\], in the axes of the body.
    ///
    /// # Errors
    /// [`ElementError::OutOfRange`] for a mass or a moment that is negative or not finite.
    pub fn with_moments(mass: f64, moments: [f64; 3]) -> Result<Self, ElementError> {
        for moment in moments {
            let right = moment.is_finite() && moment >= 0.0;
            check(right, "inertia", moment, "finite numbers, zero or more")?;
        }
        Self::new(mass, Matrix3::from_diagonal(&moments.into()))
    }

    /// A body of this mass \[kg\] and the inertia matrix about its centre of mass given by its
    /// entries (Jxx, Jyy, Jzz, Jxy, Jxz, Jyz) \[kg·m²\], in the axes of the body. Off the diagonal
    /// stand the entries of the matrix, Jxy = −∫ x y dm.
    ///
    /// # Errors
    /// [`ElementError::OutOfRange`] for a mass that is negative or not finite, or an entry that
    /// is not finite; [`ElementError::NegativeInertia`] for a matrix with a negative principal
    /// moment.
    pub fn with_inertia(mass: f64, entries: [f64; 6]) -> Result<Self, ElementError> {
        let [xx, yy, zz, xy, xz, yz] = entries;
        for entry in entries {
            check(entry.is_finite(), "inertia", entry, "finite numbers")?;
        }
        let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let moment = inertia.symmetric_eigenvalues().min();
        if moment < -ROUNDING * inertia.amax() {
            return Err(ElementError::NegativeInertia { moment });
        }
        Self::new(mass, inertia)
    }

    fn new(mass: f64, inertia: Matrix3<f64>) -> Result<Self, ElementError> {
        let right = mass.is_finite() && mass >= 0.0;
        check(right, "mass", mass, "a finite number, zero or more")?;
        Ok(Self { mass, inertia })
    }

    /// Mass \[kg\].
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Inertia about the centre of mass \[kg·m²\].
    pub fn inertia(&self) -> &Matrix3<f64> {
        &self.inertia
    }

    /// The same body with its axes the columns of `rotation`, in the axes those are given in.
    pub fn turned(&self, rotation: &Rotation3<f64>) -> Self {
        let inertia = rotation.matrix() * self.inertia * rotation.matrix().transpose();
        Self {
            mass: self.mass,
            inertia: (inertia + inertia.transpose()) * 0.5,
        }
    }

    /// Mass matrix about the point from which the centre of mass lies at `centre` \[m\]:
    /// force and moment at that point per its acceleration (linear part first) \[kg, kg·m,
    /// kg·m²\]. Symmetric to the last bit.
    pub fn about(&self, centre: &Vector3<f64>) -> Matrix6<f64> {
        let carry = transport(centre);
        let at_centre = {
            let mut m = Matrix6::from_diagonal_element(self.mass);
            m.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.inertia);
            m
        };
        let moved = carry.transpose() * at_centre * carry;
        (moved + moved.transpose()) * 0.5
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector6;

    /// Huygens and Steiner: J_P = J_C + m (r² E − r rᵀ); linear and angular motion couple by m r×.
    #[test]
    fn shifted_to_another_point() {
        let body = RigidMass::with_inertia(2.0, [3.0, 4.0, 5.0, 0.1, -0.2, 0.3]).unwrap();
        let r = Vector3::new(0.3, -0.2, 0.7);
        let m = body.about(&r);
        assert_eq!(m, m.transpose());
        let steiner = (Matrix3::identity() * r.norm_squared() - r * r.transpose()) * 2.0;
        let turning = m.fixed_view::<3, 3>(3, 3) - body.inertia() - steiner;
        assert!(turning.amax() < 1e-15);
        assert_eq!(m.fixed_view::<3, 3>(0, 0), Matrix3::identity() * 2.0);
        let coupling = m.fixed_view::<3, 3>(3, 0) - r.cross_matrix() * 2.0;
        assert!(coupling.amax() < 1e-15);
    }

    /// Kinetic energy is that of the centre of mass and of turning about it.
    #[test]
    fn energy_of_a_turning_body() {
        let rotation = Rotation3::from_euler_angles(0.4, -0.9, 1.3);
        let body = RigidMass::with_moments(1.5, [0.2, 0.3, 0.4]).unwrap();
        let r = Vector3::new(-0.4, 0.1, 0.2);
        let (v, w) = (Vector3::new(1.0, 2.0, -1.0), Vector3::new(0.5, -0.3, 0.8));
        let twist = Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z);
        let energy = 0.5 * twist.dot(&(body.turned(&rotation).about(&r) * twist));
        let in_body = rotation.inverse() * w;
        let moments = Vector3::new(0.2, 0.3, 0.4);
        let turning = in_body.component_mul(&in_body).dot(&moments);
        let expected = 0.5 * (1.5 * (v + w.cross(&r)).norm_squared() + turning);
        assert!((energy / expected - 1.0).abs() < 1e-14);
    }

    #[test]
    fn impossible_bodies_are_refused() {
        for bad in [-1.0, f64::NAN, f64::INFINITY] {
            let error = RigidMass::point(bad).unwrap_err().to_string();
            assert!(error.starts_with("`mass` is"), "{error}");
            let error = RigidMass::with_moments(1.0, [1.0, bad, 1.0]).unwrap_err();
            assert!(error.to_string().starts_with("`inertia` is"), "{error}");
        }
        let error = RigidMass::with_inertia(1.0, [1.0, 1.0, 1.0, 1.5, 0.0, 0.0]).unwrap_err();
        assert!(
            error.to_string().contains("moment, -5.000000e-1 kg·m²"),
            "{error}"
        );
        let error = RigidMass::with_inertia(1.0, [1.0, 1.0, 1.0, f64::NAN, 0.0, 0.0]).unwrap_err();
        assert!(error.to_string().starts_with("`inertia` is"), "{error}");
        // A thin rod's inertia about itself is zero; its matrix may be rounded.
        let rod = [1e-12, 1.0 - 5e-8, 1.0, 0.0, 0.0, 0.0];
        assert!(RigidMass::with_inertia(1.0, rod).is_ok());
        assert!(RigidMass::with_inertia(0.0, [0.0; 6]).is_ok());
    }
}
