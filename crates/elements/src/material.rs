//! Linear elastic, isotropic materials.

use crate::error::{ElementError, check, positive};

/// The second elastic constant of a material, beside Young's modulus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Elasticity {
    /// Poisson's ratio ν, −1 < ν ≤ 0.5; the shear modulus is E / (2 (1 + ν)).
    Poisson(f64),
    /// Shear modulus \[Pa\], for composites whose E and G are independent.
    Shear(f64),
}

/// A linear elastic material.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    young: f64,
    shear: f64,
    elasticity: Elasticity,
    density: Option<f64>,
    expansion: Option<f64>,
    yield_strength: Option<f64>,
}

impl Material {
    /// A material from Young's modulus \[Pa\], its second elastic constant, and its density
    /// \[kg/m³\] where something needs it.
    ///
    /// # Errors
    /// [`ElementError::OutOfRange`] for `young`, `poisson`, `shear` or `density`.
    pub fn new(
        young: f64,
        elasticity: Elasticity,
        density: Option<f64>,
    ) -> Result<Self, ElementError> {
        positive("young", young)?;
        let shear = match elasticity {
            Elasticity::Poisson(poisson) => {
                let wanted = "above -1 and at most 0.5";
                check(poisson > -1.0 && poisson <= 0.5, "poisson", poisson, wanted)?;
                young / (2.0 * (1.0 + poisson))
            }
            Elasticity::Shear(shear) => positive("shear", shear)?,
        };
        if let Some(density) = density {
            let right = density.is_finite() && density >= 0.0;
            check(right, "density", density, "a finite number, zero or more")?;
        }
        Ok(Self {
            young,
            shear,
            elasticity,
            density,
            expansion: None,
            yield_strength: None,
        })
    }

    /// The material with this coefficient of linear thermal expansion \[1/K\]; a negative one
    /// shrinks when heated, as carbon fibres do along their axis.
    ///
    /// # Errors
    /// [`ElementError::OutOfRange`] for one that is not finite.
    pub fn with_expansion(self, expansion: f64) -> Result<Self, ElementError> {
        let wanted = "a finite number [1/K]";
        let expansion = Some(check(
            expansion.is_finite(),
            "expansion",
            expansion,
            wanted,
        )?);
        Ok(Self { expansion, ..self })
    }

    /// The material with this yield strength \[Pa\], which stresses are compared with.
    ///
    /// # Errors
    /// [`ElementError::OutOfRange`] for one that is not finite and positive.
    pub fn with_yield_strength(self, yield_strength: f64) -> Result<Self, ElementError> {
        let yield_strength = Some(positive("yield", yield_strength)?);
        Ok(Self {
            yield_strength,
            ..self
        })
    }

    /// Young's modulus E \[Pa\].
    pub fn young(&self) -> f64 {
        self.young
    }

    /// Shear modulus G \[Pa\].
    pub fn shear(&self) -> f64 {
        self.shear
    }

    /// The second elastic constant, as it was given.
    pub fn elasticity(&self) -> Elasticity {
        self.elasticity
    }

    /// Density \[kg/m³\], if one was given.
    pub fn density(&self) -> Option<f64> {
        self.density
    }

    /// Coefficient of linear thermal expansion \[1/K\], if one was given.
    pub fn expansion(&self) -> Option<f64> {
        self.expansion
    }

    /// Yield strength \[Pa\], if one was given.
    pub fn yield_strength(&self) -> Option<f64> {
        self.yield_strength
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shear_modulus_follows_from_poisson() {
        let steel = Material::new(2.1e11, Elasticity::Poisson(0.3), Some(7850.0)).unwrap();
        assert!((steel.shear() / 8.076923076923077e10 - 1.0).abs() < 1e-15);
        assert_eq!(steel.density(), Some(7850.0));
    }

    #[test]
    fn shear_modulus_may_be_given() {
        let carbon = Material::new(1.4e11, Elasticity::Shear(5e9), None).unwrap();
        assert_eq!((carbon.young(), carbon.shear()), (1.4e11, 5e9));
    }

    #[test]
    fn numbers_out_of_range_are_named() {
        let field = |young, elasticity, density| match Material::new(young, elasticity, density) {
            Err(ElementError::OutOfRange { field, .. }) => field,
            other => panic!("{other:?}"),
        };
        use Elasticity::{Poisson, Shear};
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(field(bad, Poisson(0.3), None), "young");
            assert_eq!(field(1e9, Shear(bad), None), "shear");
        }
        for bad in [-1.0, -1.5, 0.5000001, f64::NAN, f64::NEG_INFINITY] {
            assert_eq!(field(1e9, Poisson(bad), None), "poisson");
        }
        for bad in [-1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(field(1e9, Poisson(0.3), Some(bad)), "density");
        }
        assert!(Material::new(1e9, Poisson(0.5), Some(0.0)).is_ok());
        assert!(Material::new(1e9, Poisson(-0.99), None).is_ok());
    }

    #[test]
    fn expansion_and_yield_strength_are_added() {
        let plain = Material::new(2.1e11, Elasticity::Poisson(0.3), None).unwrap();
        assert_eq!((plain.expansion(), plain.yield_strength()), (None, None));
        let steel = plain.clone().with_expansion(1.2e-5).unwrap();
        let steel = steel.with_yield_strength(3.55e8).unwrap();
        assert_eq!(steel.expansion(), Some(1.2e-5));
        assert_eq!(steel.yield_strength(), Some(3.55e8));
        assert_eq!((steel.young(), steel.density()), (2.1e11, None));
        assert!(plain.clone().with_expansion(-5e-7).is_ok());
        for bad in [f64::NAN, f64::INFINITY] {
            let error = plain.clone().with_expansion(bad).unwrap_err();
            assert!(error.to_string().starts_with("`expansion` is"), "{error}");
        }
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = plain.clone().with_yield_strength(bad).unwrap_err();
            assert!(error.to_string().starts_with("`yield` is"), "{error}");
        }
    }

    #[test]
    fn message_says_what_would_be_right() {
        let error = Material::new(2.1e11, Elasticity::Poisson(0.7), None).unwrap_err();
        assert_eq!(
            error.to_string(),
            "`poisson` is 0.7, it must be above -1 and at most 0.5"
        );
    }
}
