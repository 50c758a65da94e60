//! Why a figure cannot be drawn.

use std::error::Error as StdError;

use thiserror::Error;

use crate::numbers;

/// A figure that cannot be drawn from the data given.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FigureError {
    /// A list without points.
    #[error("{what}: there is no point to draw")]
    NoPoints {
        /// Which list, such as `commanded trajectory` or `curve 3`.
        what: String,
    },
    /// A list of points with a list of displacements of another length.
    #[error("{what}: {displacements} displacements for {points} points, one each is needed")]
    LengthMismatch {
        /// Which list.
        what: String,
        /// Number of points.
        points: usize,
        /// Number of displacements.
        displacements: usize,
    },
    /// A NaN or an infinity.
    #[error("{what}: entry {index} is ({}), not three finite numbers", numbers(.value))]
    NotFinite {
        /// Which list.
        what: String,
        /// Its entry, counted from 0.
        index: usize,
        /// The entry as given.
        value: [f64; 3],
    },
    /// A point, as given or with its displacement magnified, beyond what can be drawn.
    #[error("{what}: entry {index} is at ({}) m, beyond {limit:e} m", numbers(.position))]
    TooFar {
        /// Which list.
        what: String,
        /// Its entry, counted from 0.
        index: usize,
        /// Where it would be drawn \[m\].
        position: [f64; 3],
        /// The largest coordinate that can be drawn \[m\].
        limit: f64,
    },
    /// A number that is not finite, or too large to draw.
    #[error("{what}: entry {index} is {}, not a finite number within {limit:e}", number(*.value))]
    InvalidNumber {
        /// Which list.
        what: String,
        /// Its entry, counted from 0.
        index: usize,
        /// The entry as given.
        value: f64,
        /// The largest number that can be drawn.
        limit: f64,
    },
    /// A list of values of another length than the places they are for.
    #[error("{what}: {values} values for {points} points, one each is needed")]
    ValuesMismatch {
        /// Which list.
        what: String,
        /// Number of points.
        points: usize,
        /// Number of values.
        values: usize,
    },
    /// Coordinates of a grid that are fewer than two or do not ascend.
    #[error("{what}: a grid needs two coordinates or more, ascending")]
    NoGrid {
        /// Which list.
        what: String,
    },
    /// Limits of colours that are not two ascending numbers.
    #[error("the colours go from {} to {}; they need two finite numbers, ascending", number(.limits[0]), number(.limits[1]))]
    InvalidLimits {
        /// The limits as given.
        limits: [f64; 2],
    },
    /// A logarithmic scale that would begin at zero or below.
    #[error("a logarithmic scale needs values above zero, and would begin at {}", number(*.least))]
    Logarithm {
        /// Where it would begin.
        least: f64,
    },
    /// A whole of zero, of which nothing is a share.
    #[error("{what}: shares are of a whole that is not zero")]
    NoWhole {
        /// What the whole is.
        what: String,
    },
    /// More lines in a diagram than can be told apart.
    #[error("a diagram has {lines} lines, of which at most {most} can be told apart")]
    TooManyLines {
        /// Number of lines.
        lines: usize,
        /// The most that can be drawn.
        most: usize,
    },
    /// A place on an axis of categories that is none of them.
    #[error("{what}: entry {index} is {}, the number of none of {count} categories", number(*.value))]
    NoCategory {
        /// Which list.
        what: String,
        /// Its entry, counted from 0.
        index: usize,
        /// The entry as given.
        value: f64,
        /// Number of categories.
        count: usize,
    },
    /// A second method's point that the trajectory does not have.
    #[error("`{name}` has a point {index} of {points}")]
    NoSuchPoint {
        /// Name of the second method.
        name: String,
        /// The point as given, from 0.
        index: usize,
        /// Number of points of the trajectory.
        points: usize,
    },
    /// A magnification that is not a finite number above zero.
    #[error("the magnification is {}; it must be a finite number above zero", number(*.factor))]
    InvalidFactor {
        /// The magnification as given.
        factor: f64,
    },
    /// A difference between two methods that is not a finite number, zero or above.
    #[error("the difference from `{name}` is {}; it must be finite and not negative", number(*.difference))]
    InvalidDifference {
        /// Name of the second method.
        name: String,
        /// The difference as given.
        difference: f64,
    },
    /// A joint axis without direction.
    #[error("joint axis {index} has no direction")]
    ZeroAxis {
        /// Which axis, counted from 0.
        index: usize,
    },
    /// Figures of which none is first: there is none.
    #[error("there is no frame to draw")]
    NoFrames,
    /// The PDF could not be made from the SVG.
    #[error("the figure could not be drawn as PDF")]
    Pdf(#[source] Box<dyn StdError + Send + Sync>),
    /// The GIF could not be made from its frames.
    #[error("the figure could not be drawn as GIF")]
    Gif(#[source] Box<dyn StdError + Send + Sync>),
    /// The PNG could not be made from the SVG.
    #[error("the figure could not be drawn as PNG")]
    Png(#[source] Box<dyn StdError + Send + Sync>),
}

fn numbers(values: &[f64; 3]) -> String {
    values.map(number).join(", ")
}

/// A number of at most six digits: plain where that is short, else with an exponent.
fn number(value: f64) -> String {
    numbers::number(numbers::rounded(value, 5))
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn messages_have_short_numbers() {
        for (value, text) in [
            (-1.534_621_973_498e-5, "-1.53462e-5"),
            (-0.1 - 0.2, "-0.3"),
            (1.797_693e308, "1.79769e308"),
            (f64::NAN, "NaN"),
            (f64::NEG_INFINITY, "-inf"),
            (0.0, "0"),
        ] {
            assert_eq!(number(value), text);
        }
    }
}
