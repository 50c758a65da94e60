//! Quantities with units, and the prefix that makes their numbers short.

use crate::numbers;

/// What an axis or a colour means.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Quantity {
    /// Its name, as in `k33`.
    pub name: String,
    /// Its SI unit without a prefix, as in `N/m`; empty for a number without unit.
    pub unit: String,
}

/// A quantity in a unit with a prefix.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scaled {
    /// What a value in the SI unit is multiplied by.
    pub(crate) factor: f64,
    /// Name and unit, as in `k33 (MN/m)`.
    pub(crate) label: String,
    /// The unit alone, as in `MN/m`.
    pub(crate) unit: String,
    /// The power of ten that the unit begins with where it takes no prefix.
    power: Option<i32>,
}

const PREFIXES: [(i32, &str); 9] = [
    (-12, "p"),
    (-9, "n"),
    (-6, "µ"),
    (-3, "m"),
    (0, ""),
    (3, "k"),
    (6, "M"),
    (9, "G"),
    (12, "T"),
];

/// Units that take a prefix, each as the start of a unit.
const PREFIXED: [&str; 5] = ["N", "m", "rad", "Pa", "Hz"];

impl Quantity {
    /// A quantity by name and SI unit.
    #[must_use]
    pub fn new(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            unit: unit.into(),
        }
    }

    /// With the prefix for values as large as `largest`.
    pub(crate) fn scaled(&self, largest: f64) -> Scaled {
        let plain = Scaled {
            factor: 1.0,
            label: match &*self.unit {
                "" => self.name.clone(),
                unit => format!("{} ({unit})", self.name),
            },
            unit: self.unit.clone(),
            power: None,
        };
        let magnitude = largest.abs();
        if magnitude == 0.0 || !magnitude.is_finite() || (0.1..1e4).contains(&magnitude) {
            return plain;
        }
        let power = (magnitude.log10() / 3.0).floor() as i32 * 3;
        let first = self.unit.split(['/', '·']).next().unwrap_or_default();
        let prefix = PREFIXES.iter().find(|(known, _)| *known == power);
        let (Some((_, prefix)), true) = (prefix, PREFIXED.contains(&first)) else {
            let unit = match &*self.unit {
                "" => format!("1e{power}"),
                unit => format!("1e{power} {unit}"),
            };
            return Scaled {
                factor: 10_f64.powi(-power),
                label: format!("{} ({unit})", self.name),
                unit,
                power: Some(power),
            };
        };
        let unit = format!("{prefix}{}", self.unit);
        Scaled {
            factor: 10_f64.powi(-power),
            label: format!("{} ({unit})", self.name),
            unit,
            power: None,
        }
    }

    /// A value with four digits and its unit.
    #[must_use]
    pub fn value(&self, value: f64) -> String {
        let scaled = self.scaled(value);
        let number = numbers::short(value * scaled.factor);
        let (number, unit) = match scaled.power {
            None => (number, scaled.unit),
            Some(power) => (format!("{number}e{power}"), self.unit.clone()),
        };
        match &*unit {
            "" => number,
            unit => format!("{number} {unit}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Quantity;

    #[test]
    fn prefixes_keep_numbers_short() {
        for (unit, value, text) in [
            ("N/m", 3.214_56e6, "3.215 MN/m"),
            ("N/m", -12.5, "−12.5 N/m"),
            ("m", 2.5e-4, "250 µm"),
            ("m", 0.25, "0.25 m"),
            ("m", 0.012_34, "12.34 mm"),
            ("N·m/rad", 9.9e5, "990 kN·m/rad"),
            ("kg", 2e-4, "200e-6 kg"),
            ("", 3.0, "3"),
            ("", 2.0e7, "20e6"),
            ("", -0.062_31, "−62.31e-3"),
            ("m", 0.0, "0 m"),
        ] {
            assert_eq!(Quantity::new("q", unit).value(value), text);
        }
    }

    #[test]
    fn a_label_names_the_unit() {
        let label = |unit: &str, largest| Quantity::new("k33", unit).scaled(largest).label;
        assert_eq!(label("N/m", 2e6), "k33 (MN/m)");
        assert_eq!(label("N/m", 20.0), "k33 (N/m)");
        assert_eq!(label("", 1.0), "k33");
    }
}
