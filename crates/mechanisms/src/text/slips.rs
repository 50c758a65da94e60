//! What was probably meant where a file holds what the format does not: habits of other languages,
//! of spreadsheets and of other countries.

use std::ops::Range;

/// What was probably meant.
#[derive(Debug, PartialEq)]
pub(crate) struct Slip {
    /// The bytes of the text that are meant otherwise.
    pub(crate) span: Range<usize>,
    /// What is wrong.
    pub(crate) message: String,
    /// What would be right.
    pub(crate) help: String,
}

/// What texts are written in.
const QUOTES: &str = "texts stand in double quotes";

/// What arithmetic is written with.
const OPERATORS: &str = "*/+-^−×·÷";

/// How decimals are written.
const POINT: &str = "decimals have a point, and a comma separates two values";

/// The slip at the place of a text at which its grammar is noticed to be wrong.
pub(crate) fn in_grammar(text: &str, noticed: usize) -> Option<Slip> {
    let found = |span, message: String, help: String| {
        Some(Slip {
            span,
            message,
            help,
        })
    };
    let line = text[..noticed].rfind('\n').map_or(0, |k| k + 1);
    let end = text[noticed..]
        .find('\n')
        .map_or(text.len(), |k| noticed + k);
    if let Some(quoted) = single_quoted(&text[line..end], noticed - line) {
        let span = line + quoted.start..line + quoted.end;
        let inner = &text[span.start + 1..span.end - 1];
        return found(span, QUOTES.into(), format!("write \"{inner}\""));
    }
    let next = text[noticed..].chars().next()?;
    let at = noticed..noticed + next.len_utf8();
    match next {
        '#' => found(
            at,
            "`#` begins no comment".into(),
            "comments are `// …` to the end of the line, or `/* … */`".into(),
        ),
        '=' => found(
            at,
            "`=` gives nothing a value".into(),
            "write `field: value`".into(),
        ),
        ';' => found(
            at,
            "`;` separates nothing".into(),
            "separate fields and values by commas".into(),
        ),
        '“' | '”' | '„' | '«' | '»' | '‘' | '’' | '‚' => found(
            at,
            format!("`{next}` is no quote of the format"),
            "texts stand in straight double quotes, \"…\"".into(),
        ),
        '−' | '–' | '—' => found(
            at,
            format!("`{next}` is no minus sign of the format"),
            "write the hyphen `-`".into(),
        ),
        _ => number(text, noticed),
    }
}

/// The slip in numbers around the place at which the grammar is noticed to be wrong.
fn number(text: &str, noticed: usize) -> Option<Slip> {
    if let Some((span, right)) = comma_before(text, noticed) {
        return Some(Slip {
            span,
            message: POINT.into(),
            help: format!("write {right}"),
        });
    }
    let span = word(text, noticed);
    if let Some((message, help)) = of_number(&text[span.clone()]) {
        return Some(Slip {
            span,
            message,
            help,
        });
    }
    // `2 * 0.5` and `5 mm`: what comes before the place is a number of its own, and what follows an
    // operator as well.
    let before = text[..noticed].trim_end_matches([' ', '\t']);
    let first = word(text, before.len()).start;
    let behind = text[span.end..].trim_start_matches([' ', '\t']);
    let operator = &text[span.clone()];
    let end = match !operator.is_empty() && operator.chars().all(|c| OPERATORS.contains(c)) {
        true => word(text, text.len() - behind.len()).end,
        false => span.end,
    };
    let whole: String = text[first..end].split([' ', '\t']).collect();
    let (message, help) = of_number(&whole).filter(|_| first < before.len())?;
    Some(Slip {
        span: first..end,
        message,
        help,
    })
}

/// What is wrong with a value of another kind than wanted, and what would be right.
pub(crate) fn in_value(text: &str, expected: &str) -> Option<String> {
    let wants_text = expected.contains("quotes");
    let wants_number = expected.contains("number");
    let inner = |quote: char| text.strip_prefix(quote)?.strip_suffix(quote);
    if let Some(inner) = inner('\'') {
        return Some(format!("{QUOTES}: write \"{inner}\""));
    }
    if wants_text && !text.is_empty() && text.chars().all(|c| c.is_alphanumeric() || c == '_') {
        return Some(format!("{QUOTES}: write \"{text}\""));
    }
    if wants_number && let Some(inner) = inner('"') {
        return match inner.parse::<f64>() {
            Ok(_) => Some(format!("numbers stand without quotes: write {inner}")),
            Err(_) => of_number(inner).map(|(_, help)| help),
        };
    }
    if let (true, "True" | "False" | "yes" | "no") = (expected.contains("true"), text) {
        let right = matches!(text, "True" | "yes");
        return Some(format!("write {right}"));
    }
    of_number(text).map(|(message, help)| format!("{message}: {help}"))
}

/// The values of a tuple, so many, that was written with decimal commas: `(0,0, 0,0, 0,9)`.
///
/// Two whole numbers are one decimal number where no space stands between them, beside the comma.
pub(crate) fn decimal_commas(items: &[&str], wanted: usize) -> Option<String> {
    let whole = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let mut values: Vec<String> = Vec::new();
    let mut merged = 0;
    let mut k = 0;
    while k < items.len() {
        let first = items[k];
        let glued = items.get(k + 1).filter(|next| {
            // Parts of one text: their distance is what stands between them.
            let distance = next.as_ptr() as usize - first.as_ptr() as usize;
            distance == first.len() + 1 && whole(next)
        });
        let sign = first.strip_prefix(['-', '+']).unwrap_or(first);
        match glued.filter(|_| whole(sign)) {
            Some(next) => {
                values.push(format!("{first}.{next}"));
                merged += 1;
                k += 2;
            }
            None => {
                values.push(first.into());
                k += 1;
            }
        }
    }
    let right = merged > 0 && values.len() == wanted;
    right.then(|| format!("{POINT}: write ({})", values.join(", ")))
}

/// What is wrong with a text that should be one number, and what would be right.
fn of_number(text: &str) -> Option<(String, String)> {
    let end = |text: &str| {
        // The longest start that is a number.
        (1..=text.len()).rev().find(|&k| {
            text.is_char_boundary(k)
                && text[..k].parse::<f64>().is_ok()
                && text[..k].ends_with(|c: char| c.is_ascii_digit() || c == '.')
        })
    };
    let first = end(text)?;
    let rest = &text[first..];
    let operator = rest.chars().next()?;
    if OPERATORS.contains(operator) {
        let message = "nothing is calculated in a file".to_string();
        let [a, b] = [&text[..first], &rest[operator.len_utf8()..]].map(str::parse::<f64>);
        let value = match (a, b, operator) {
            (Ok(a), Ok(b), '*' | '×' | '·') => Some(a * b),
            (Ok(a), Ok(b), '/' | '÷') => Some(a / b),
            (Ok(a), Ok(b), '+') => Some(a + b),
            (Ok(a), Ok(b), '-' | '−') => Some(a - b),
            (Ok(a), Ok(b), '^') => Some(a.powf(b)),
            _ => None,
        };
        // Without the rounding of 0.6 - 0.5.
        let value = value.and_then(|value| format!("{value:.11e}").parse::<f64>().ok());
        let value = value.filter(|value| value.is_finite());
        let help = value.map_or_else(
            || "write the number that comes out".into(),
            |value| format!("write the number that comes out, {value:?}"),
        );
        return Some((message, help));
    }
    if let Some(digits) = rest.strip_prefix(',') {
        let right = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
        return right.then(|| (POINT.into(), format!("write {}.{digits}", &text[..first])));
    }
    let unit = operator.is_alphabetic() || "°%µ".contains(operator);
    let known = ["inf", "nan", "e", "E", "x", "b", "o"];
    if unit && !known.iter().any(|other| rest.starts_with(other)) {
        return Some((
            format!("a number has no unit: `{rest}` cannot follow it"),
            "write the number alone, in m, N, rad, kg and s".into(),
        ));
    }
    None
}

/// The text `'…'` of a line, not a character of the format, in which or behind which a place lies.
fn single_quoted(line: &str, place: usize) -> Option<Range<usize>> {
    let start = line.get(..place.min(line.len()))?.rfind('\'')?;
    // The place may lie behind the closing quote, too.
    let before = line[..start].rfind('\'');
    let candidates = [Some(start), before];
    candidates.into_iter().flatten().find_map(|start| {
        let end = start + 1 + line[start + 1..].find('\'')?;
        let inner = &line[start + 1..end];
        let text = inner.chars().count() != 1 && !inner.contains(['"', ',', ':', '(', ')']);
        (text && place <= end + 1).then_some(start..end + 1)
    })
}

/// The whole of `0,014` where the place is that of its decimals, or just behind, with what is right.
fn comma_before(text: &str, place: usize) -> Option<(Range<usize>, String)> {
    let digit = |b: &u8| b.is_ascii_digit();
    let bytes = text.as_bytes();
    // The decimals around the place.
    let first = (0..place).rev().take_while(|&k| digit(&bytes[k])).last();
    let first = first.unwrap_or(place);
    let last = (first..bytes.len())
        .take_while(|&k| digit(&bytes[k]))
        .last()?;
    let comma = first.checked_sub(1).filter(|&k| bytes[k] == b',')?;
    let whole = (0..comma).rev().take_while(|&k| digit(&bytes[k])).last()?;
    let signed = whole.checked_sub(1).filter(|&k| bytes[k] == b'-');
    let start = signed.unwrap_or(whole);
    let right = format!("{}.{}", &text[start..comma], &text[first..=last]);
    Some((start..last + 1, right))
}

/// The word that a place is in or just behind: what no bracket, separator or space parts.
fn word(text: &str, place: usize) -> Range<usize> {
    let apart = |c: char| c.is_whitespace() || "()[]{},:;\"'".contains(c);
    let start = text[..place].rfind(apart);
    let start = start.map_or(0, |k| {
        k + text[k..].chars().next().map_or(1, char::len_utf8)
    });
    let end = text[place..].find(apart).map_or(text.len(), |k| place + k);
    start..end
}

#[cfg(test)]
mod tests {
    use super::*;

    fn right(text: &str) -> Option<String> {
        of_number(text).map(|(_, help)| help)
    }

    #[test]
    fn what_stands_in_for_a_number_is_recognised() {
        let comes_out = |value| Some(format!("write the number that comes out, {value}"));
        assert_eq!(right("0.06/2"), comes_out("0.03"));
        assert_eq!(right("2*0.5"), comes_out("1.0"));
        assert_eq!(right("0.6-0.5"), comes_out("0.1"));
        assert_eq!(right("-1e3+1"), comes_out("-999.0"));
        assert_eq!(right("0,014"), Some("write 0.014".into()));
        let alone = Some("write the number alone, in m, N, rad, kg and s".into());
        for unit in ["5mm", "0.3m", "30°", "210GPa", "5µm"] {
            assert_eq!(right(unit), alone, "{unit}");
        }
        for no_slip in ["", "steel", "0.5", "-3e-4", "1e", "A1", "inf", "0x1f"] {
            assert_eq!(right(no_slip), None, "{no_slip}");
        }
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
    }

    #[test]
    fn texts_in_single_quotes_are_found() {
        let line = "material: 'ram', (x: 'y')";
        assert_eq!(single_quoted(line, 12), Some(10..15));
        assert_eq!(single_quoted(line, 15), Some(10..15));
        assert_eq!(single_quoted(line, 24), None);
        assert_eq!(single_quoted("no quotes", 4), None);
    }
}
