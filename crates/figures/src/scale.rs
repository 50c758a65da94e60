//! How much deflections are magnified.

use crate::error::FigureError;
use crate::geometry::{Bounds, Point, length};
use crate::round;

/// Magnification of the deflections in a figure.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Scale {
    /// The largest of 1, 2, 5 × 10ᵏ with which no deflection is drawn longer than 12 % of the
    /// drawing's size (the diagonal of the box around everything undeformed); 1 where nothing
    /// moves or the size is zero.
    #[default]
    Auto,
    /// This factor, finite and above zero.
    Factor(f64),
}

/// Part of the drawing's size that the largest deflection may take with [`Scale::Auto`].
const LARGEST_PART: f64 = 0.12;

impl Scale {
    /// The factor for a figure of these undeformed points and their displacements.
    ///
    /// # Errors
    ///
    /// [`FigureError::InvalidFactor`] for a factor that is not finite and above zero.
    pub(crate) fn factor<'a>(
        self,
        points: impl Iterator<Item = &'a Point>,
        displacements: impl Iterator<Item = &'a Point>,
    ) -> Result<f64, FigureError> {
        match self {
            Self::Factor(factor) if factor.is_finite() && factor > 0.0 => Ok(factor),
            Self::Factor(factor) => Err(FigureError::InvalidFactor { factor }),
            Self::Auto => {
                let size = Bounds::around(points.copied()).diagonal();
                Ok(round::down(LARGEST_PART * size / largest(displacements)).unwrap_or(1.0))
            }
        }
    }
}

/// Length of the longest of these vectors.
pub(crate) fn largest<'a>(vectors: impl Iterator<Item = &'a Point>) -> f64 {
    vectors.map(|vector| length(*vector)).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_deflection_is_drawn_at_most_at_12_percent_of_the_size() {
        let points = [[0.0; 3], [3.0, 4.0, 0.0]];
        let factor = |displacement| {
            Scale::Auto
                .factor(points.iter(), [[0.0; 3], [0.0, 0.0, displacement]].iter())
                .unwrap()
        };
        assert_eq!(factor(1e-3), 500.0);
        assert_eq!(factor(3.1e-4), 1000.0);
        assert_eq!(factor(2.9e-4), 2000.0);
        assert_eq!(factor(10.0), 0.05);
        assert_eq!(factor(0.0), 1.0);
    }

    #[test]
    fn a_factor_must_be_finite_and_above_zero() {
        for factor in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let refused = Scale::Factor(factor).factor([].iter(), [].iter());
            assert!(
                matches!(refused, Err(FigureError::InvalidFactor { .. })),
                "{factor}"
            );
        }
        assert_eq!(
            Scale::Factor(12.5).factor([].iter(), [].iter()).unwrap(),
            12.5
        );
    }
}
