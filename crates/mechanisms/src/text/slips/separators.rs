//! Numbers with decimal commas, and with what separates thousands.

use std::ops::Range;

/// How decimals are written.
const POINT: &str = "decimals have a point, and a comma separates two values";

/// How large numbers are written.
const NO_THOUSANDS: &str = "nothing separates thousands, and a comma separates two values";

/// What a number with separators may mean.
#[derive(Debug, PartialEq)]
pub(super) struct Read {
    /// Its comma as that of decimals.
    decimal: Option<String>,
    /// What separates as between thousands.
    thousands: Option<String>,
}

impl Read {
    /// What is wrong with the number, and what would be right.
    pub(super) fn told(&self) -> (String, String) {
        match (&self.decimal, &self.thousands) {
            (Some(decimal), Some(thousands)) => (
                POINT.into(),
                format!("write {decimal}, or {thousands} if the comma separates thousands"),
            ),
            (Some(decimal), None) => (POINT.into(), format!("write {decimal}")),
            (None, thousands) => (
                NO_THOUSANDS.into(),
                format!("write {}", thousands.as_deref().unwrap_or_default()),
            ),
        }
    }
}

fn digits(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())
}

/// Whether a text may be the digits before the first separator of thousands.
fn leads(text: &str) -> bool {
    digits(text) && text.len() <= 3 && !text.starts_with('0')
}

/// The digits of `210,000,000`: groups of three behind at most three.
fn joined(text: &str, separator: char) -> Option<String> {
    let (first, rest) = text.split_once(separator)?;
    let mut groups = rest.split(separator);
    let whole = leads(first) && groups.all(|group| digits(group) && group.len() == 3);
    whole.then(|| text.replace(separator, ""))
}

/// What a text of digits, points and commas means that is no number of the format; a sign may stand
/// before it, and an exponent behind it.
pub(super) fn read(text: &str) -> Option<Read> {
    let body = text.trim_start_matches(['-', '+']);
    let sign = &text[..text.len() - body.len()];
    let (body, exponent) = body.split_at(body.find(['e', 'E']).unwrap_or(body.len()));
    if sign.len() > 1 || !exponent.is_empty() && format!("1{exponent}").parse::<f64>().is_err() {
        return None;
    }
    let (decimal, thousands) = match (body.find('.'), body.rfind(',')?) {
        (None, comma) => {
            let (whole, decimals) = (&body[..comma], &body[comma + 1..]);
            let decimal = digits(whole) && digits(decimals);
            (
                decimal.then(|| format!("{whole}.{decimals}")),
                joined(body, ',').map(|whole| format!("{whole}.0")),
            )
        }
        // 7,850.0
        (Some(point), comma) if comma < point => {
            let decimals = &body[point + 1..];
            let right = decimals.is_empty() || digits(decimals);
            let whole = joined(&body[..point], ',').filter(|_| right);
            (None, whole.map(|whole| format!("{whole}.{decimals}")))
        }
        // 1.234,5 and 0.014,000
        (Some(point), comma) => {
            let (whole, decimals) = (&body[..comma], &body[comma + 1..]);
            let of_points = joined(whole, '.').filter(|_| digits(decimals));
            let mut groups = body[point + 1..].split(',');
            let of_decimals =
                digits(&body[..point]) && groups.all(|group| digits(group) && group.len() == 3);
            (
                of_points.map(|whole| format!("{whole}.{decimals}")),
                of_decimals.then(|| body.replace(',', "")),
            )
        }
    };
    let whole = |number: String| format!("{sign}{number}{exponent}");
    let found = Read {
        decimal: decimal.map(whole),
        thousands: thousands.map(whole),
    };
    (found.decimal.is_some() || found.thousands.is_some()).then_some(found)
}

/// The whole number with commas that a place is in or just behind, and what it means.
pub(super) fn around(text: &str, place: usize) -> Option<(Range<usize>, Read)> {
    let bytes = text.as_bytes();
    let part = |k: &usize| bytes[*k].is_ascii_digit() || matches!(bytes[*k], b'.' | b',');
    let mut start = (0..place).rev().take_while(part).last().unwrap_or(place);
    let mut end = (place..bytes.len())
        .take_while(part)
        .last()
        .map_or(place, |k| k + 1);
    end -= text[start..end].len() - text[start..end].trim_end_matches(',').len();
    start = start.max(end - text[start..end].trim_start_matches(',').len());
    if start < end && start > 0 && bytes[start - 1] == b'-' {
        start -= 1;
    }
    // The exponent.
    let behind = text[end..].strip_prefix(['e', 'E']).map(|power| {
        let signed = power.trim_start_matches(['-', '+']);
        let digits = signed.bytes().take_while(u8::is_ascii_digit).count();
        1 + power.len() - signed.len() + digits
    });
    let whole = start..end + behind.unwrap_or(0);
    if let Some(found) = read(&text[whole.clone()]) {
        return Some((whole, found));
    }
    // Values of their own around it: the two numbers beside the comma.
    let digit = |k: &usize| bytes[*k].is_ascii_digit();
    let first = (0..place).rev().take_while(digit).last().unwrap_or(place);
    let last = (first..bytes.len()).take_while(digit).last()?;
    let comma = first.checked_sub(1).filter(|&k| bytes[k] == b',')?;
    let whole = (0..comma).rev().take_while(digit).last()?;
    let before = whole.checked_sub(1).map(|k| bytes[k]);
    if before == Some(b'.') || bytes.get(last + 1) == Some(&b'.') {
        return None;
    }
    let start = whole - usize::from(before == Some(b'-'));
    let found = read(&text[start..=last])?;
    Some((start..last + 1, found))
}

/// The values of a tuple, so many, that was written with decimal commas: `(0,0, 0,0, 0,9)`, or
/// with separators of thousands: `(0, 0, -1,000.0)`.
///
/// Numbers are one where no space stands between them, beside the comma.
pub(crate) fn decimal_commas(items: &[&str], wanted: usize) -> Option<String> {
    // Parts of one text: their distance is what stands between them.
    let glued = |k: usize| {
        let distance = items[k + 1].as_ptr() as usize - items[k].as_ptr() as usize;
        distance == items[k].len() + 1
    };
    let mut values: Vec<[String; 2]> = Vec::new();
    let (mut both, mut decimal, mut thousands) = (false, false, false);
    let mut k = 0;
    while k < items.len() {
        let last = (k..items.len() - 1)
            .find(|k| !glued(*k))
            .unwrap_or(items.len() - 1);
        // Of three parts and more only thousands make one.
        let ends = (k + 1..=last).rev();
        let found = ends.into_iter().find_map(|end| {
            let read = read(&items[k..=end].join(","))?;
            (end == k + 1 || read.thousands.is_some() && read.decimal.is_none())
                .then_some((end, read))
        });
        match found.filter(|_| !items[k].contains('.')) {
            Some((end, read)) => {
                both |= read.decimal.is_some() && read.thousands.is_some();
                decimal |= read.decimal.is_some();
                thousands |= read.decimal.is_none();
                let first = read.decimal.clone().or_else(|| read.thousands.clone());
                let second = read.thousands.or(read.decimal);
                values.push([first, second].map(Option::unwrap_or_default));
                k = end + 1;
            }
            None => {
                values.push([items[k]; 2].map(String::from));
                k += 1;
            }
        }
    }
    if values.len() != wanted || !(decimal || thousands) {
        return None;
    }
    let list = |reading: usize| {
        let values: Vec<&str> = values.iter().map(|value| &*value[reading]).collect();
        format!("({})", values.join(", "))
    };
    let message = if decimal { POINT } else { NO_THOUSANDS };
    let other = match both {
        true => format!(", or {} if commas separate thousands", list(1)),
        false => String::new(),
    };
    Some(format!("{message}: write {}{other}", list(0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn right(text: &str) -> Option<String> {
        read(text).map(|read| read.told().1)
    }

    #[test]
    fn separators_of_thousands_are_no_decimals() {
        for (text, help) in [
            ("0,014", "write 0.014"),
            ("1,5e3", "write 1.5e3"),
            (
                "7,850",
                "write 7.850, or 7850.0 if the comma separates thousands",
            ),
            ("7,850.0", "write 7850.0"),
            ("-1,000.5", "write -1000.5"),
            ("210,000,000,000.0", "write 210000000000.0"),
            ("210,000,000,000", "write 210000000000.0"),
            ("0.014,000", "write 0.014000"),
            ("1.234,5", "write 1234.5"),
            ("1.234.567,8", "write 1234567.8"),
            (
                "1.234,567",
                "write 1234.567, or 1.234567 if the comma separates thousands",
            ),
        ] {
            assert_eq!(right(text).as_deref(), Some(help), "{text}");
        }
        for no_slip in [
            "1,2,3", "0.5,1.0", "0.5,100", "5,1.0", "1,", ",5", "--1,5", "7850",
        ] {
            assert_eq!(right(no_slip), None, "{no_slip}");
        }
    }

    #[test]
    fn a_number_is_found_around_a_place() {
        let found = |text: &str, mark: &str| {
            let (span, _) = around(text, text.find(mark).unwrap())?;
            Some(text[span].to_string())
        };
        let found = |text, mark| found(text, mark).unwrap_or_default();
        assert_eq!(
            found("young: 210,000,000,000.0,\n", "000,000,0"),
            "210,000,000,000.0"
        );
        assert_eq!(found("diameter: 0.014,000)", "000"), "0.014,000");
        assert_eq!(found("x: -7,850 ", "850"), "-7,850");
        assert_eq!(found("x: 0,5e-3)", "5e"), "0,5e-3");
        assert_eq!(found("(0,014,0,5)", "014"), "0,014");
        assert_eq!(found("(0.5,1)", "1)"), "");
    }

    #[test]
    fn commas_are_decimal_where_the_count_says_so() {
        let read = |text: &'static str, wanted| {
            let items: Vec<&str> = text.split(',').map(str::trim).collect();
            decimal_commas(&items, wanted)
        };
        let right = |values| Some(format!("{POINT}: write ({values})"));
        assert_eq!(read("0,0, 0,0, 0,9", 3), right("0.0, 0.0, 0.9"));
        assert_eq!(read("0,0,0,0,0,9", 3), right("0.0, 0.0, 0.9"));
        assert_eq!(read("-0,2, 0,2, 41", 3), right("-0.2, 0.2, 41"));
        assert_eq!(read("1, 2, 3, 4, 5, 6", 3), None);
        assert_eq!(read("0.5,1,2", 3), None);
        assert_eq!(read("0,0, 1", 3), None);
        let right = |values| Some(format!("{NO_THOUSANDS}: write ({values})"));
        assert_eq!(read("0, 0, -1,000.0", 3), right("0, 0, -1000.0"));
        assert_eq!(read("0, 0, -1,000,000", 3), right("0, 0, -1000000.0"));
        let both = "0, 0, 1.000), or (0, 0, 1000.0) if commas separate thousands";
        assert_eq!(
            read("0, 0, 1,000", 3),
            Some(format!("{POINT}: write ({both}"))
        );
    }
}
