//! Checks of the data that a figure is given.

use crate::error::FigureError;
use crate::geometry::{FARTHEST, Point, moved};

/// Points that can be drawn, with their displacements.
#[derive(Debug, Clone)]
pub(crate) struct Displaced<'a> {
    /// What they are called in messages.
    what: String,
    /// One or more.
    pub(crate) points: &'a [Point],
    /// As many.
    pub(crate) displacement: &'a [Point],
}

impl<'a> Displaced<'a> {
    /// Checks a list of points and the list of their displacements.
    ///
    /// # Errors
    ///
    /// [`FigureError::LengthMismatch`], [`FigureError::NoPoints`], [`FigureError::NotFinite`],
    /// [`FigureError::TooFar`].
    pub(crate) fn new(
        what: impl Into<String>,
        points: &'a [Point],
        displacement: &'a [Point],
    ) -> Result<Self, FigureError> {
        let what = what.into();
        if points.len() != displacement.len() {
            return Err(FigureError::LengthMismatch {
                what,
                points: points.len(),
                displacements: displacement.len(),
            });
        }
        if points.is_empty() {
            return Err(FigureError::NoPoints { what });
        }
        drawable(&what, points)?;
        drawable(&format!("{what}, displacements"), displacement)?;
        Ok(Self {
            what,
            points,
            displacement,
        })
    }

    /// The points with their displacements magnified.
    ///
    /// # Errors
    ///
    /// [`FigureError::TooFar`].
    pub(crate) fn moved(&self, factor: f64) -> Result<Vec<Point>, FigureError> {
        let pairs = self.points.iter().zip(self.displacement);
        let moved: Vec<_> = pairs
            .map(|(point, displacement)| moved(*point, *displacement, factor))
            .collect();
        near(&format!("{}, displaced", self.what), &moved)?;
        Ok(moved)
    }
}

/// That all points are finite and near enough to be drawn.
pub(crate) fn drawable(what: &str, points: &[Point]) -> Result<(), FigureError> {
    finite(what, points)?;
    near(what, points)
}

/// That all numbers are finite and small enough to be drawn.
pub(crate) fn numbers(what: &str, numbers: &[f64]) -> Result<(), FigureError> {
    // Also false for a NaN.
    let is_near = |number: &f64| number.abs() <= FARTHEST;
    match numbers.iter().position(|number| !is_near(number)) {
        Some(index) => Err(FigureError::InvalidNumber {
            what: what.into(),
            index,
            value: numbers[index],
            limit: FARTHEST,
        }),
        None => Ok(()),
    }
}

fn finite(what: &str, vectors: &[Point]) -> Result<(), FigureError> {
    let is_finite = |vector: &Point| vector.iter().all(|component| component.is_finite());
    match vectors.iter().position(|vector| !is_finite(vector)) {
        Some(index) => Err(FigureError::NotFinite {
            what: what.into(),
            index,
            value: vectors[index],
        }),
        None => Ok(()),
    }
}

fn near(what: &str, points: &[Point]) -> Result<(), FigureError> {
    let is_near = |point: &Point| point.iter().all(|coordinate| coordinate.abs() <= FARTHEST);
    match points.iter().position(|point| !is_near(point)) {
        Some(index) => Err(FigureError::TooFar {
            what: what.into(),
            index,
            position: points[index],
            limit: FARTHEST,
        }),
        None => Ok(()),
    }
}

/// That a difference from a second method is finite and not negative.
pub(crate) fn difference(name: &str, difference: f64) -> Result<(), FigureError> {
    if difference.is_finite() && difference >= 0.0 {
        Ok(())
    } else {
        Err(FigureError::InvalidDifference {
            name: name.into(),
            difference,
        })
    }
}
