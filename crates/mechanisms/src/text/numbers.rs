//! The numbers of a file: plain ones, those with a unit, and those that expressions give.

use nalgebra::Vector3;
use serde::de::Deserialize;

use super::dimension::Dimension;
use super::expression::Expression;
use super::fragment::Fragment;
use super::json;
use super::tree::Content;
use super::units::{self, Wrong};
use crate::error::LoadError;

impl<'a> Fragment<'a> {
    /// A finite number without a unit.
    pub(super) fn plain_number(self) -> Result<f64, LoadError> {
        let number = match self.is_json() {
            true => json::number(self.text).ok_or_else(|| self.expected("a number"))?,
            false => self.parse("a number")?,
        };
        if !number.is_finite() {
            return Err(self
                .error(format!("`{}` is not a finite number", self.text))
                .unreadable()
                .with_help("give a number such as 0.25 or 2.1e11"));
        }
        Ok(number)
    }

    /// A finite number with any unit or none, SI, and what it measures, if it has one.
    pub(crate) fn measured(
        self,
        wanted: Option<Dimension>,
    ) -> Result<(f64, Option<Dimension>), LoadError> {
        let text = match self.content() {
            Some(Content::Number(number)) => return Ok((*number, None)),
            Some(Content::Measured(number, dimension)) => return Ok((*number, Some(*dimension))),
            Some(Content::Failed(error)) => return Err(error.again()),
            Some(Content::Text(text)) => Some((**text).into()),
            Some(Content::Tuple(_)) if Expression::begins(self.text) => {
                return Err(self
                    .error("this is a point, where a number is wanted")
                    .unreadable()
                    .with_help("give one of its coordinates, `.x`, `.y` or `.z`"));
            }
            _ if self.text.starts_with('"') => self.string().ok(),
            _ => None,
        };
        let found = text.as_deref().map(|text| units::read(text, wanted));
        match found {
            None | Some(Err(Wrong::NoQuantity)) => Ok((self.plain_number()?, None)),
            Some(Ok(found)) => Ok((found.value, Some(found.dimension))),
            Some(Err(Wrong::Number)) => {
                let error = self.error(format!("{} is not a finite number", self.text));
                Err(error.unreadable())
            }
            Some(Err(Wrong::Unit(at, help))) => {
                // A text without escapes stands in the file as it is.
                let inner = self.text.get(1..self.text.len().saturating_sub(1));
                let inner = inner.filter(|inner| Some(*inner) == text.as_deref());
                let unit = inner.and_then(|inner| inner.get(at.clone()));
                let at = unit.filter(|unit| !unit.is_empty());
                let at = at.map_or(self, |unit| self.part(unit));
                let unit = unit.unwrap_or(self.text);
                Err(at
                    .error(format!("`{unit}` is no unit"))
                    .unreadable()
                    .with_help(help))
            }
        }
    }

    /// A finite number, SI, with any unit or none.
    pub(crate) fn number(self) -> Result<f64, LoadError> {
        self.measured(None).map(|(number, _)| number)
    }

    /// A finite number of this dimension, SI; without a unit it is one. `what` it is, in words or by the
    /// name of its field in backquotes.
    pub(crate) fn quantity(self, what: &str, wanted: Dimension) -> Result<f64, LoadError> {
        let (number, dimension) = self.measured(Some(wanted))?;
        match dimension {
            Some(other) if other != wanted => Err(self.of_dimension(what, wanted, other)),
            _ => Ok(number),
        }
    }

    /// Refuses a number with a unit that takes the place of one that measures something else; `what` it is, in
    /// words.
    pub(crate) fn in_place_of(self, known: Self, what: &str) -> Result<(), LoadError> {
        let dimension = |own: Self| own.measured(None).ok().and_then(|(_, dimension)| dimension);
        match (dimension(known), dimension(self)) {
            (Some(wanted), Some(other)) if wanted != other => {
                Err(self.of_dimension(what, wanted, other))
            }
            _ => Ok(()),
        }
    }

    /// The error of a number that measures something else than wanted.
    pub(crate) fn of_dimension(self, what: &str, wanted: Dimension, other: Dimension) -> LoadError {
        let text = self.text;
        let unit = wanted.unit();
        let help = match wanted.example() {
            None => "write the number alone".into(),
            Some(example) => format!("give it in {unit}, or such as \"{example}\""),
        };
        self.error(format!("{what} is {wanted}, {text} is {other}"))
            .unreadable()
            .with_help(help)
    }

    /// A whole number that is no measure, or any other type of one; `expected` says what it is.
    pub(crate) fn count<T: TryFrom<u64> + Deserialize<'a>>(
        self,
        expected: &str,
    ) -> Result<T, LoadError> {
        /// Whole numbers up to here are exact.
        const LARGEST: f64 = 9_007_199_254_740_992.0;
        match self.content() {
            Some(Content::Failed(error)) => Err(error.again()),
            Some(Content::Number(number) | Content::Measured(number, _))
                if self.text.starts_with('"') =>
            {
                let whole = number.fract() == 0.0 && (0.0..=LARGEST).contains(number);
                let count = whole.then(|| T::try_from(*number as u64).ok()).flatten();
                count.ok_or_else(|| {
                    let message = format!("expected {expected}, found {}", self.shown());
                    self.error(message).unreadable()
                })
            }
            _ => self.parse(expected),
        }
    }

    /// What stands here, for messages: of an expression its value, too.
    pub(crate) fn shown(self) -> String {
        match self.content() {
            Some(Content::Number(number)) if Expression::begins(self.text) => {
                format!("{number:?}, which {} gives", self.text)
            }
            _ => self.text.into(),
        }
    }

    /// A number of what acts on a mechanism, no larger than [`MOST`].
    pub(crate) fn acting(self, what: &str, wanted: Dimension) -> Result<f64, LoadError> {
        let number = self.quantity(what, wanted)?;
        if number.abs() > MOST {
            return Err(self
                .error(format!("nothing that acts may be larger than {MOST:?}"))
                .with_help("units are m, N, rad, kg, s and K"));
        }
        Ok(number)
    }

    /// Three of them.
    pub(crate) fn acting_vector(
        self,
        what: &str,
        wanted: Dimension,
    ) -> Result<Vector3<f64>, LoadError> {
        let [x, y, z] = self.array("three numbers `(x, y, z)`")?;
        let [x, y, z] = [x, y, z].map(|part| part.acting(what, wanted));
        Ok(Vector3::new(x?, y?, z?))
    }

    /// Three finite numbers of this dimension.
    pub(crate) fn vector(self, what: &str, wanted: Dimension) -> Result<Vector3<f64>, LoadError> {
        let [x, y, z] = self.array("three numbers `(x, y, z)`")?;
        let [x, y, z] = [x, y, z].map(|part| part.quantity(what, wanted));
        Ok(Vector3::new(x?, y?, z?))
    }

    /// Three finite numbers, not all zero.
    pub(crate) fn direction(self) -> Result<Vector3<f64>, LoadError> {
        let vector = self.vector("a part of a direction", Dimension::NUMBER)?;
        if vector == Vector3::zeros() {
            return Err(self
                .error("a zero vector has no direction")
                .with_help("give a vector of any length but zero, such as (0.0, 0.0, 1.0)"));
        }
        Ok(vector)
    }
}

/// Largest number of what acts, in SI units: the squares of larger ones, and their products with
/// stiffnesses and lever arms, overflow.
const MOST: f64 = 1e50;
