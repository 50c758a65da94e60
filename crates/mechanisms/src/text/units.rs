//! Numbers with a unit, such as `14 mm`, `35 N/um` or `7.85 g/cm^3`.

use std::f64::consts::PI;
use std::ops::Range;

use super::dimension::Dimension;
use super::names;

/// A unit: its symbol, the power of ten and the factor that make SI of it, and what it measures.
type Unit = (&'static str, i32, f64, Dimension);

/// All units. Powers of ten stand apart, so that `14 mm` is the double 0.014.
const UNITS: [Unit; 57] = [
    ("m", 0, 1.0, Dimension::LENGTH),
    ("km", 3, 1.0, Dimension::LENGTH),
    ("dm", -1, 1.0, Dimension::LENGTH),
    ("cm", -2, 1.0, Dimension::LENGTH),
    ("mm", -3, 1.0, Dimension::LENGTH),
    ("um", -6, 1.0, Dimension::LENGTH),
    ("µm", -6, 1.0, Dimension::LENGTH),
    ("μm", -6, 1.0, Dimension::LENGTH),
    ("nm", -9, 1.0, Dimension::LENGTH),
    ("in", -4, 254.0, Dimension::LENGTH),
    ("ft", -4, 3048.0, Dimension::LENGTH),
    ("rad", 0, 1.0, Dimension::ANGLE),
    ("mrad", -3, 1.0, Dimension::ANGLE),
    ("urad", -6, 1.0, Dimension::ANGLE),
    ("µrad", -6, 1.0, Dimension::ANGLE),
    ("μrad", -6, 1.0, Dimension::ANGLE),
    ("deg", 0, PI / 180.0, Dimension::ANGLE),
    ("°", 0, PI / 180.0, Dimension::ANGLE),
    ("arcmin", 0, PI / 10_800.0, Dimension::ANGLE),
    ("arcsec", 0, PI / 648_000.0, Dimension::ANGLE),
    ("rev", 0, 2.0 * PI, Dimension::ANGLE),
    ("N", 0, 1.0, Dimension::FORCE),
    ("uN", -6, 1.0, Dimension::FORCE),
    ("mN", -3, 1.0, Dimension::FORCE),
    ("daN", 1, 1.0, Dimension::FORCE),
    ("kN", 3, 1.0, Dimension::FORCE),
    ("MN", 6, 1.0, Dimension::FORCE),
    ("lbf", 0, 4.448_221_615_260_5, Dimension::FORCE),
    ("Nm", 0, 1.0, Dimension::MOMENT),
    ("Nmm", -3, 1.0, Dimension::MOMENT),
    ("kNm", 3, 1.0, Dimension::MOMENT),
    ("Pa", 0, 1.0, Dimension::PRESSURE),
    ("kPa", 3, 1.0, Dimension::PRESSURE),
    ("MPa", 6, 1.0, Dimension::PRESSURE),
    ("GPa", 9, 1.0, Dimension::PRESSURE),
    ("bar", 5, 1.0, Dimension::PRESSURE),
    ("psi", 0, 6_894.757_293_168_361, Dimension::PRESSURE),
    ("ksi", 3, 6_894.757_293_168_361, Dimension::PRESSURE),
    ("kg", 0, 1.0, Dimension::MASS),
    ("g", -3, 1.0, Dimension::MASS),
    ("mg", -6, 1.0, Dimension::MASS),
    ("t", 3, 1.0, Dimension::MASS),
    ("lb", 0, 0.453_592_37, Dimension::MASS),
    ("s", 0, 1.0, Dimension::TIME),
    ("ms", -3, 1.0, Dimension::TIME),
    ("us", -6, 1.0, Dimension::TIME),
    ("µs", -6, 1.0, Dimension::TIME),
    ("μs", -6, 1.0, Dimension::TIME),
    ("min", 0, 60.0, Dimension::TIME),
    ("K", 0, 1.0, Dimension::TEMPERATURE),
    ("mK", -3, 1.0, Dimension::TEMPERATURE),
    ("%", -2, 1.0, Dimension::NUMBER),
    ("‰", -3, 1.0, Dimension::NUMBER),
    ("ppm", -6, 1.0, Dimension::NUMBER),
    ("1", 0, 1.0, Dimension::NUMBER),
    ("ha", 4, 1.0, Dimension::AREA),
    ("l", -3, 1.0, Dimension::VOLUME),
];

/// A number with a unit: its value in SI, and what it measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Quantity {
    pub(crate) value: f64,
    pub(crate) dimension: Dimension,
}

/// Why a text is no number with a unit.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Wrong {
    /// It does not begin with a number that something follows.
    NoQuantity,
    /// The unit, at these bytes, is none; what would be right.
    Unit(Range<usize>, String),
    /// The number is too large.
    Number,
}

/// Reads a number with a unit; `wanted` is what it should measure, for what was meant.
pub(crate) fn read(text: &str, wanted: Option<Dimension>) -> Result<Quantity, Wrong> {
    let (mantissa, exponent, rest) = number(text).ok_or(Wrong::NoQuantity)?;
    let unit = text[rest..].trim();
    if unit.is_empty() || unit == "1" || unit.starts_with(',') {
        return Err(Wrong::NoQuantity);
    }
    let start = rest + (text[rest..].len() - text[rest..].trim_start().len());
    let mut measured = Measured {
        ten: 0,
        factor: 1.0,
        dimension: Dimension::NUMBER,
    };
    let mut at = start;
    let mut sign = 1;
    if unit.starts_with('/') {
        sign = -1;
        at += 1;
    }
    for (k, part) in text[at..start + unit.len()]
        .split_inclusive(SEPARATORS)
        .enumerate()
    {
        let name = part.trim_end_matches(SEPARATORS);
        let separator = part[name.len()..].chars().next();
        let span = at..at + name.len();
        measured.multiply(name, sign).ok_or_else(|| {
            let right = meant(name, wanted, k == 0 && separator.is_none());
            Wrong::Unit(span.clone(), right)
        })?;
        at += part.len();
        match separator {
            Some('/') => sign = -1,
            Some(_) if unit.contains("**") => {
                let help = "a power stands behind `^`, such as `mm^2`";
                return Err(Wrong::Unit(start..start + unit.len(), help.into()));
            }
            Some(_) if sign < 0 => {
                let help = "write all that is divided by behind a `/` of its own: `N*m/rad/m`";
                return Err(Wrong::Unit(start..start + unit.len(), help.into()));
            }
            Some(_) if at == start + unit.len() => {
                return Err(Wrong::Unit(start..at, "a unit follows `*`".into()));
            }
            _ => {}
        }
    }
    if unit.ends_with('/') {
        return Err(Wrong::Unit(start..at, "a unit follows `/`".into()));
    }
    let ten = exponent.saturating_add(measured.ten);
    let value = format!("{mantissa}e{ten}").parse::<f64>();
    let value = value.map_err(|_| Wrong::NoQuantity)? * measured.factor;
    match value.is_finite() {
        true => Ok(Quantity {
            value,
            dimension: measured.dimension,
        }),
        false => Err(Wrong::Number),
    }
}

/// What stands between units.
const SEPARATORS: [char; 3] = ['*', '·', '/'];

/// The number that a text begins with: its digits, its power of ten, and where it ends.
pub(super) fn number(text: &str) -> Option<(&str, i32, usize)> {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        let rest = bytes[from..].iter();
        from + rest.take_while(|byte| byte.is_ascii_digit()).count()
    };
    let signed = |from: usize| from + usize::from(matches!(bytes.get(from), Some(b'+' | b'-')));
    let whole = digits(signed(0));
    let end = match bytes.get(whole) {
        Some(b'.') => digits(whole + 1),
        _ => whole,
    };
    let mantissa = &text[..end];
    if !mantissa.bytes().any(|byte| byte.is_ascii_digit()) {
        return None;
    }
    if let Some(b'e' | b'E') = bytes.get(end) {
        let first = signed(end + 1);
        let last = digits(first);
        if last > first {
            return Some((mantissa, text[end + 1..last].parse().ok()?, last));
        }
    }
    Some((mantissa, 0, end))
}

/// A product of units.
struct Measured {
    ten: i32,
    factor: f64,
    dimension: Dimension,
}

impl Measured {
    /// Multiplies it by a unit with its power, or divides it; `None` of a unit that there is not.
    fn multiply(&mut self, text: &str, sign: i8) -> Option<()> {
        let (name, power) = powered(text.trim());
        let power = sign.checked_mul(power?)?;
        let (_, ten, factor, dimension) = UNITS.iter().find(|(symbol, ..)| *symbol == name)?;
        self.ten += ten * i32::from(power);
        self.factor *= factor.powi(i32::from(power));
        self.dimension = self.dimension.times(*dimension, power)?;
        Some(())
    }
}

/// A unit's symbol and its power: `mm^2`, `mm2` or `mm²`.
fn powered(text: &str) -> (&str, Option<i8>) {
    const RAISED: [(char, i8); 3] = [('²', 2), ('³', 3), ('⁴', 4)];
    if let Some((raised, power)) = RAISED.iter().find(|(raised, _)| text.ends_with(*raised)) {
        return (text.trim_end_matches(*raised), Some(*power));
    }
    if let Some((name, power)) = text.split_once('^') {
        return (name.trim_end(), power.trim().parse().ok());
    }
    let name = text.trim_end_matches(|c: char| c.is_ascii_digit());
    match name.is_empty() || name.len() == text.len() {
        true => (text, Some(1)),
        false => (name, text[name.len()..].parse().ok()),
    }
}

/// What would be right instead of an unknown unit.
fn meant(text: &str, wanted: Option<Dimension>, alone: bool) -> String {
    let (name, _) = powered(text.trim());
    if ["degC", "°C", "C", "degF", "°F"].contains(&name) {
        return "a temperature is a change, in K: `20 K`".into();
    }
    let fits = |unit: &&Unit| !alone || wanted.is_none_or(|wanted| unit.3 == wanted);
    let same = |unit: &&Unit| unit.0.eq_ignore_ascii_case(name);
    let found = UNITS.iter().find(|unit| same(unit) && fits(unit));
    if let Some((symbol, ..)) = found.or_else(|| UNITS.iter().find(same)) {
        return format!("did you mean `{symbol}`?");
    }
    let symbols: Vec<&str> = UNITS.iter().filter(fits).map(|unit| unit.0).collect();
    match wanted
        .and_then(Dimension::example)
        .filter(|_| symbols.is_empty() || !alone)
    {
        Some(example) => format!("write such as `{example}`"),
        None if wanted == Some(Dimension::NUMBER) => "write the number alone".into(),
        None => names::help(name, "units", symbols),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_of_ten_gives_the_double_that_is_written_without_it() {
        let cases = [
            ("14 mm", 0.014),
            ("0.3mm", 3e-4),
            ("210 GPa", 2.1e11),
            ("2.1e5 N/mm^2", 2.1e11),
            ("35 N/um", 3.5e7),
            ("7.85 g/cm³", 7850.0),
            ("-1.5e-1 kN", -150.0),
            ("12e-6 1/K", 1.2e-5),
            ("12 um/m/K", 1.2e-5),
            ("3 kg·cm2", 3e-4),
            ("0.1 %", 1e-3),
        ];
        for (text, value) in cases {
            assert_eq!(read(text, None).unwrap().value, value, "{text}");
        }
    }

    #[test]
    fn angles_are_told_from_pure_numbers() {
        let angle = read("120 deg", None).unwrap();
        assert_eq!(
            (angle.value, angle.dimension),
            (2.0 * PI / 3.0, Dimension::ANGLE)
        );
        let pitch = read("5 mm/rev", None).unwrap();
        assert_eq!(pitch.dimension, Dimension::PITCH);
        assert!((pitch.value - 0.005 / (2.0 * PI)).abs() < 1e-18);
        let stiffness = read("10 N*m/deg", None).unwrap();
        assert_eq!(stiffness.dimension, Dimension::ROTATIONAL_STIFFNESS);
        assert!((stiffness.value - 1800.0 / PI).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_unit_is_answered_with_what_was_meant() {
        let right = |text: &str, wanted| match read(text, Some(wanted)) {
            Err(Wrong::Unit(at, help)) => (text[at].to_owned(), help),
            other => panic!("{text}: {other:?}"),
        };
        let meant = |unit: &str, meant: &str| (unit.to_owned(), format!("did you mean `{meant}`?"));
        assert_eq!(right("14 mpa", Dimension::PRESSURE), meant("mpa", "MPa"));
        assert_eq!(right("14 Mm", Dimension::LENGTH), meant("Mm", "mm"));
        assert_eq!(right("14 n/mm^2", Dimension::PRESSURE), meant("n", "N"));
        let (_, help) = right("20 degC", Dimension::TEMPERATURE);
        assert_eq!(help, "a temperature is a change, in K: `20 K`");
        for wrong in ["", "mm", "14", "steel 3", "1e5", ".", "- mm"] {
            assert_eq!(read(wrong, None), Err(Wrong::NoQuantity), "{wrong}");
        }
        for wrong in ["1 m^999", "1 m**2", "1 N/", "1 N*", "1 N/m*s"] {
            assert!(matches!(read(wrong, None), Err(Wrong::Unit(..))), "{wrong}");
        }
        assert_eq!(read("1e400 m", None), Err(Wrong::Number));
    }
}
