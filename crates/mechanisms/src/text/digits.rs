//! How many digits a number is written with, and another number in its place, in the same unit.

use super::tree::{Content, Node};
use super::units;

/// The digits of a number that is written out, with or without a unit.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Digits {
    /// Digits behind the point, of the number in SI where its unit is a power of ten.
    pub(crate) decimals: i32,
    /// The same without zeros at the end.
    pub(crate) needed: i32,
    /// Digits that count.
    pub(crate) significant: i32,
    /// Its unit, in SI.
    unit: f64,
    /// What stands around the number: quotes, and the unit.
    around: [String; 2],
}

impl Digits {
    /// Of the number that stands here; `None` of anything else, an expression too.
    pub(crate) fn of(node: &Node) -> Option<Self> {
        let text = node.text();
        match &node.content {
            Content::Number(_) => {
                let plain = text.replace('_', "");
                let (mantissa, ten, end) = units::number(&plain)?;
                (end == plain.len()).then(|| Self::counted(mantissa, ten, 1.0, ["", ""]))
            }
            Content::Text(_) => {
                let inside = text.strip_prefix('"')?;
                let blank = inside.len() - inside.trim_start().len();
                let (mantissa, ten, end) = units::number(&inside[blank..])?;
                let rest = &inside[blank + end..];
                let unit = units::read(&format!("1{}", rest.strip_suffix('"')?), None).ok()?;
                let around = [&text[..1 + blank], rest];
                Some(Self::counted(mantissa, ten, unit.value, around))
            }
            _ => None,
        }
    }

    /// Of a number as it is written shortest; `None` of one that is not finite.
    pub(crate) fn of_value(value: f64) -> Option<Self> {
        let text = format!("{value:?}");
        let (mantissa, ten, end) = units::number(&text)?;
        (end == text.len()).then(|| Self::counted(mantissa, ten, 1.0, ["", ""]))
    }

    /// Takes it for one that was rounded to so many decimals.
    pub(crate) fn round(&mut self, decimals: i32) {
        (self.decimals, self.needed, self.significant) = (decimals, decimals, decimals);
    }

    fn counted(mantissa: &str, ten: i32, unit: f64, around: [&str; 2]) -> Self {
        let behind = mantissa.split_once('.').map_or("", |(_, behind)| behind);
        let ten = ten + unit.log10().round() as i32;
        let decimals = |behind: &str| behind.len() as i32 - ten;
        let digits = mantissa.bytes().filter(u8::is_ascii_digit);
        let significant = digits.skip_while(|digit| *digit == b'0').count();
        Self {
            decimals: decimals(behind),
            needed: decimals(behind.trim_end_matches('0')),
            significant: significant as i32,
            unit,
            around: around.map(Into::into),
        }
    }

    /// Another number (SI), as it is written in the place of this one: the shortest that reads back to it,
    /// with all the digits that it takes.
    pub(crate) fn written(&self, value: f64) -> String {
        let [before, after] = &self.around;
        format!("{before}{:?}{after}", value / self.unit)
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::text::files::MemoryFiles;
    use crate::text::fragment::Fragment;
    use crate::text::source::Source;

    fn digits(text: &str) -> Option<Digits> {
        let source = Source::new(Path::new("f.ron"), text, &MemoryFiles::new());
        Digits::of(&Node::of(Fragment::of_file(&source).unwrap()))
    }

    #[test]
    fn digits_are_counted_as_they_are_written() {
        let counted = |text| digits(text).map(|d| (d.decimals, d.significant));
        assert_eq!(counted("0.250"), Some((3, 3)));
        assert_eq!(counted("-12.5e-3"), Some((4, 3)));
        assert_eq!(counted("0.0"), Some((1, 0)));
        assert_eq!(digits("0.250").map(|d| d.needed), Some(2));
        assert_eq!(digits("1.0").map(|d| d.needed), Some(0));
        assert_eq!(counted("7"), Some((0, 1)));
        assert_eq!(counted("\"14.25 mm\""), Some((5, 4)));
        assert_eq!(counted("\"= 1 + 2\""), None);
        assert_eq!(counted("\"rod\""), None);
    }

    #[test]
    fn another_number_keeps_the_unit() {
        let written = |text, value| digits(text).unwrap().written(value);
        assert_eq!(written("0.250", 0.25), "0.25");
        assert_eq!(written("1", 1.0 + f64::EPSILON), "1.0000000000000002");
        assert_eq!(written("\"14.2 mm\"", 0.01421), "\"14.21 mm\"");
        assert_eq!(written("\" 5cm\"", -0.051), "\" -5.1cm\"");
    }
}
