//! What was probably meant where a file holds what the format does not: habits of other languages,
//! of spreadsheets and of other countries.

mod separators;

use std::ops::{Range, RangeInclusive};

pub(crate) use separators::decimal_commas;

use super::expression::Expression;
use super::units;

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

/// Characters that look like a blank or like nothing, with their names.
const INVISIBLE: [(RangeInclusive<char>, &str); 12] = [
    ('\u{00a0}'..='\u{00a0}', "no-break space"),
    ('\u{00ad}'..='\u{00ad}', "soft hyphen"),
    ('\u{2000}'..='\u{200a}', "space of typesetting"),
    ('\u{200b}'..='\u{200b}', "zero-width space"),
    ('\u{200c}'..='\u{200d}', "zero-width joiner"),
    ('\u{200e}'..='\u{200f}', "mark of direction"),
    ('\u{2028}'..='\u{2029}', "line separator"),
    ('\u{202a}'..='\u{202e}', "mark of direction"),
    ('\u{202f}'..='\u{202f}', "narrow no-break space"),
    ('\u{2060}'..='\u{2069}', "word joiner"),
    ('\u{3000}'..='\u{3000}', "ideographic space"),
    ('\u{feff}'..='\u{feff}', "byte order mark"),
];

/// The invisible character of a text, with what it is in words: its code point and its name.
pub(crate) fn invisible(text: &str) -> Option<(usize, String)> {
    text.char_indices().find_map(|(at, c)| {
        let known = INVISIBLE.iter().find(|(range, _)| range.contains(&c));
        let name = match known {
            Some((_, name)) => name,
            None if c.is_control() && !c.is_whitespace() => "control character",
            None => return None,
        };
        Some((at, format!("U+{:04X} ({name})", u32::from(c))))
    })
}

/// What would be right instead of an invisible character.
pub(crate) const VISIBLE: &str = "delete it, or write an ordinary blank: it came from a web page or a word \
                                  processor, and does not show";

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
    // In the word that is not understood, wherever that is noticed.
    let apart = |c: char| c.is_ascii_whitespace() || "()[]{},:\"'".contains(c);
    let start = text[..noticed].rfind(apart).map_or(0, |k| k + 1);
    let end = text[noticed..]
        .find(apart)
        .map_or(text.len(), |k| noticed + k);
    if let Some((inside, name)) = invisible(&text[start..end]) {
        let first = start + inside;
        let width = text[first..].chars().next().map_or(1, char::len_utf8);
        let message = format!("{name} cannot stand here");
        return found(first..first + width, message, VISIBLE.into());
    }
    match next {
        '#' => Some(hash(noticed)),
        '=' => found(
            at,
            "`=` gives nothing a value".into(),
            match expression_behind(text, noticed) {
                Some(expression) => format!("expressions stand in quotes: write \"{expression}\""),
                None => "write `field: value`".into(),
            },
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

/// The slip of a comment that begins with a `#`, here.
pub(crate) fn hash(at: usize) -> Slip {
    Slip {
        span: at..at + 1,
        message: "`#` begins no comment".into(),
        help: "comments are `// …` to the end of the line, or `/* … */`".into(),
    }
}

/// The slip in numbers around the place at which the grammar is noticed to be wrong.
fn number(text: &str, noticed: usize) -> Option<Slip> {
    if let Some((span, read)) = separators::around(text, noticed) {
        let (message, help) = read.told();
        return Some(Slip {
            span,
            message,
            help,
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

/// The expression that begins with the `=` here, where it stands in the place of a value.
fn expression_behind(text: &str, at: usize) -> Option<&str> {
    let before = text[..at].trim_end();
    let end = text[at..]
        .find([',', ')', ']', '}', '\n'])
        .map(|k| at + k)?;
    let expression = text[at..end].trim_end();
    (before.ends_with(['(', '[', ',', ':']) && expression.len() > 1).then_some(expression)
}

/// The expression that a value is without its quotes or its `=`, of names that are all `known` and at least one.
fn expression_of(text: &str, known: impl Fn(&str) -> bool) -> Option<String> {
    let quoted = format!("\"= {text}\"");
    let expression = Expression::read(&quoted);
    let mut names = expression.names().peekable();
    names.peek()?;
    names.all(known).then_some(quoted)
}

/// What is wrong with a value of another kind than wanted in a file of this text, and what would be right.
pub(crate) fn in_value(text: &str, expected: &str, file: &str) -> Option<String> {
    let wants_text = expected.contains("quotes");
    let wants_number = expected.contains("number");
    let inner = |quote: char| text.strip_prefix(quote)?.strip_suffix(quote);
    if let Some(inner) = inner('\'') {
        return Some(format!("{QUOTES}: write \"{inner}\""));
    }
    if wants_text && !text.is_empty() && text.chars().all(|c| c.is_alphanumeric() || c == '_') {
        return Some(format!("{QUOTES}: write \"{text}\""));
    }
    // What stands in quotes before a colon is a name: of a parameter or of a point.
    let named = |name: &str| {
        let quoted = format!("\"{name}\"");
        let mut found = file.match_indices(&quoted);
        found.any(|(at, _)| file[at + quoted.len()..].trim_start().starts_with(':'))
    };
    if wants_number && let Some(right) = expression_of(inner('"').unwrap_or(text), named) {
        return Some(match inner('"') {
            Some(_) => format!("expressions begin with `=`: write {right}"),
            None => format!("expressions stand in quotes, behind `=`: write {right}"),
        });
    }
    if wants_number && let Some(inner) = inner('"') {
        return match inner.parse::<f64>() {
            Ok(_) => Some(format!("numbers stand without quotes: write {inner}")),
            Err(_) => {
                let pointed = inner.replacen(',', ".", 1);
                let whole = inner.replacen(',', "", 1);
                let thousands = inner.split_once(',').is_some_and(|(first, rest)| {
                    let digits = rest.chars().take_while(char::is_ascii_digit).count();
                    !first.starts_with('0') && digits == 3 && units::read(&whole, None).is_ok()
                });
                let commas = inner.contains(',') && units::read(&pointed, None).is_ok();
                match commas {
                    true if thousands => Some(format!(
                        "write \"{whole}\" without a separator, or \"{pointed}\" with a decimal point"
                    )),
                    true => Some(format!("write \"{pointed}\", with a decimal point")),
                    false => of_number(inner).map(|(_, help)| help),
                }
            }
        };
    }
    if let (true, "True" | "False" | "yes" | "no") = (expected.contains("true"), text) {
        let right = matches!(text, "True" | "yes");
        return Some(format!("write {right}"));
    }
    of_number(text).map(|(message, help)| format!("{message}: {help}"))
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
        let message = "arithmetic stands in quotes, behind `=`".to_string();
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
        let mut help = format!("write \"= {text}\"");
        if let Some(value) = value {
            help += &format!(", or the number that comes out, {value:?}");
        }
        return Some((message, help));
    }
    if rest.contains(',') {
        return separators::read(text).map(|read| read.told());
    }
    let unit = operator.is_alphabetic() || "°%µ".contains(operator);
    let known = ["inf", "nan", "e", "E", "x", "b", "o"];
    if unit && !known.iter().any(|other| rest.starts_with(other)) {
        let (number, alone) = (&text[..first], "write the number alone, in SI units");
        return Some(match units::read(text, None) {
            Ok(_) => (
                "a number with its unit stands in quotes".into(),
                format!("write \"{number} {rest}\""),
            ),
            Err(_) => (
                format!("`{rest}` is no unit that could follow a number"),
                format!("{alone}, or with its unit in quotes, such as \"14 mm\""),
            ),
        });
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
        let comes_out = |text: &str, value: &str| {
            let right = right(text).unwrap();
            let expected = format!("write \"= {text}\", or the number that comes out, {value}");
            assert_eq!(right, expected);
        };
        comes_out("0.06/2", "0.03");
        comes_out("2*0.5", "1.0");
        comes_out("0.6-0.5", "0.1");
        comes_out("-1e3+1", "-999.0");
        assert_eq!(right("2*pi"), Some("write \"= 2*pi\"".into()));
        assert_eq!(right("0,014"), Some("write 0.014".into()));
        let units = [
            ("5", "mm"),
            ("0.3", "m"),
            ("30", "°"),
            ("210", "GPa"),
            ("5", "µm"),
        ];
        for (number, unit) in units {
            let expected = Some(format!("write \"{number} {unit}\""));
            assert_eq!(right(&format!("{number}{unit}")), expected);
        }
        assert!(
            right("5furlongs")
                .unwrap()
                .starts_with("write the number alone")
        );
        for no_slip in ["", "steel", "0.5", "-3e-4", "1e", "A1", "inf", "0x1f"] {
            assert_eq!(right(no_slip), None, "{no_slip}");
        }
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
