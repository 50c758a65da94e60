//! What numbers measure: dimensions, their names and SI units.

use std::fmt;

use super::units;

/// What a number measures: powers of the units that it is made of. Angles count, so that a stiffness
/// against a rotation (N·m/rad) is no moment (N·m).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Dimension {
    /// Of m, kg, s, K and rad.
    powers: [i8; 5],
}

/// Symbols of the units that dimensions are powers of.
const BASES: [&str; 5] = ["m", "kg", "s", "K", "rad"];

impl Dimension {
    /// A pure number.
    pub const NUMBER: Self = Self::of([0, 0, 0, 0, 0]);
    /// m
    pub const LENGTH: Self = Self::of([1, 0, 0, 0, 0]);
    /// m²
    pub const AREA: Self = Self::of([2, 0, 0, 0, 0]);
    /// m³
    pub const VOLUME: Self = Self::of([3, 0, 0, 0, 0]);
    /// m⁴
    pub const AREA_MOMENT: Self = Self::of([4, 0, 0, 0, 0]);
    /// rad
    pub const ANGLE: Self = Self::of([0, 0, 0, 0, 1]);
    /// m/rad
    pub const PITCH: Self = Self::of([1, 0, 0, 0, -1]);
    /// kg
    pub const MASS: Self = Self::of([0, 1, 0, 0, 0]);
    /// kg/m³
    pub const DENSITY: Self = Self::of([-3, 1, 0, 0, 0]);
    /// kg·m²
    pub const INERTIA: Self = Self::of([2, 1, 0, 0, 0]);
    /// m/s²
    pub const ACCELERATION: Self = Self::of([1, 0, -2, 0, 0]);
    /// N; of a moment along a beam, N·m/m
    pub const FORCE: Self = Self::of([1, 1, -2, 0, 0]);
    /// N·m
    pub const MOMENT: Self = Self::of([2, 1, -2, 0, 0]);
    /// N/m; of a force along a beam, too
    pub const STIFFNESS: Self = Self::of([0, 1, -2, 0, 0]);
    /// N·m/rad
    pub const ROTATIONAL_STIFFNESS: Self = Self::of([2, 1, -2, 0, -1]);
    /// N/rad, between a force and a rotation; the same number as N, between a moment and a translation
    pub const COUPLING: Self = Self::of([1, 1, -2, 0, -1]);
    /// Pa
    pub const PRESSURE: Self = Self::of([-1, 1, -2, 0, 0]);
    /// K, a change of temperature
    pub const TEMPERATURE: Self = Self::of([0, 0, 0, 1, 0]);
    /// 1/K
    pub const EXPANSION: Self = Self::of([0, 0, 0, -1, 0]);
    /// s
    pub const TIME: Self = Self::of([0, 0, 1, 0, 0]);

    const fn of(powers: [i8; 5]) -> Self {
        Self { powers }
    }

    /// The dimension of what is told in this unit, such as `N·m/rad`; `-` and nothing are those of a pure
    /// number. `None` of what is no unit of files.
    pub fn of_unit(unit: &str) -> Option<Self> {
        match unit {
            "" | "-" => Some(Self::NUMBER),
            unit => Some(units::read(&format!("1 {unit}"), None).ok()?.dimension),
        }
    }

    /// The dimension of a product with a power of another one; `None` of powers beyond any use.
    pub(crate) fn times(self, other: Self, power: i8) -> Option<Self> {
        let mut powers = self.powers;
        for (own, other) in powers.iter_mut().zip(other.powers) {
            *own = own.checked_add(other.checked_mul(power)?)?;
        }
        Some(Self { powers })
    }

    /// Its name with an article, its SI unit, and a number with a unit that is often used.
    fn words(self) -> Option<&'static (Self, &'static str, &'static str, &'static str)> {
        WORDS.iter().find(|(own, ..)| *own == self)
    }

    /// Its name with an article, such as "a length".
    pub fn name(self) -> Option<&'static str> {
        self.words().map(|words| words.1)
    }

    /// The unit of a number without one.
    pub fn unit(self) -> String {
        let made = || {
            let factor = |(base, power): (&str, i8)| match power {
                0 => None,
                1 => Some(base.to_owned()),
                power => Some(format!("{base}^{power}")),
            };
            let factors = BASES.into_iter().zip(self.powers).filter_map(factor);
            factors.collect::<Vec<_>>().join("*")
        };
        self.words().map_or_else(made, |words| words.2.into())
    }

    /// A number with a unit that is often used.
    pub(crate) fn example(self) -> Option<&'static str> {
        self.words()
            .map(|words| words.3)
            .filter(|example| !example.is_empty())
    }
}

/// Dimensions with a name, their SI units, and examples.
const WORDS: [(Dimension, &str, &str, &str); 20] = [
    (Dimension::NUMBER, "a pure number", "", ""),
    (Dimension::LENGTH, "a length", "m", "14 mm"),
    (Dimension::AREA, "an area", "m^2", "400 mm^2"),
    (Dimension::VOLUME, "a section modulus", "m^3", "1200 mm^3"),
    (
        Dimension::AREA_MOMENT,
        "a second moment of area",
        "m^4",
        "5000 mm^4",
    ),
    (Dimension::ANGLE, "an angle", "rad", "120 deg"),
    (Dimension::PITCH, "a length per angle", "m/rad", "5 mm/rev"),
    (Dimension::MASS, "a mass", "kg", "2.5 kg"),
    (Dimension::DENSITY, "a density", "kg/m^3", "7.85 g/cm^3"),
    (
        Dimension::INERTIA,
        "a moment of inertia",
        "kg*m^2",
        "3 kg*cm^2",
    ),
    (
        Dimension::ACCELERATION,
        "an acceleration",
        "m/s^2",
        "9.81 m/s^2",
    ),
    (Dimension::FORCE, "a force", "N", "1.2 kN"),
    (Dimension::MOMENT, "a moment", "N*m", "300 N*mm"),
    (Dimension::STIFFNESS, "a force per length", "N/m", "35 N/um"),
    (
        Dimension::ROTATIONAL_STIFFNESS,
        "a moment per angle",
        "N*m/rad",
        "1e5 N*m/rad",
    ),
    (
        Dimension::COUPLING,
        "a force per angle",
        "N/rad",
        "1e5 N/rad",
    ),
    (Dimension::PRESSURE, "a force per area", "Pa", "210 GPa"),
    (
        Dimension::TEMPERATURE,
        "a change of temperature",
        "K",
        "20 K",
    ),
    (
        Dimension::EXPANSION,
        "an expansion per temperature",
        "1/K",
        "12e-6 1/K",
    ),
    (Dimension::TIME, "a time", "s", "20 ms"),
];

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.name() {
            Some(name) => f.write_str(name),
            None => write!(f, "a quantity in {}", self.unit()),
        }
    }
}
