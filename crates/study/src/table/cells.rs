//! Cells of text in a table of comma-separated values.

use std::borrow::Cow;

/// What a spreadsheet takes for the start of a formula.
const FORMULA: [char; 6] = ['=', '+', '-', '@', '\t', '\r'];

/// The cell that holds `text`: in quotes, its quotes doubled, where it would not be one cell; with
/// an apostrophe before it, in quotes, where a spreadsheet would take it for a formula.
pub fn quoted(text: &str) -> Cow<'_, str> {
    let formula = text.starts_with(FORMULA);
    if formula || text.contains(['"', ',', '\n', '\r']) {
        let guard = if formula { "'" } else { "" };
        Cow::Owned(format!("\"{guard}{}\"", text.replace('"', "\"\"")))
    } else {
        Cow::Borrowed(text)
    }
}

/// The text of a cell whose quotes are taken away already.
#[cfg(any(test, feature = "figures"))]
pub fn text(cell: &str) -> &str {
    let guarded = cell.strip_prefix('\'');
    guarded
        .filter(|text| text.starts_with(FORMULA))
        .unwrap_or(cell)
}

#[cfg(test)]
mod tests {
    use super::{quoted, text};

    #[test]
    fn cells_come_back_as_they_were() {
        for (given, cell) in [
            ("rod.section", "rod.section"),
            ("a,b", "\"a,b\""),
            ("say \"a\"", "\"say \"\"a\"\"\""),
            ("=1+1", "\"'=1+1\""),
            ("-z.dx", "\"'-z.dx\""),
            ("@a", "\"'@a\""),
            ("+\"a\"", "\"'+\"\"a\"\"\""),
            ("'quoted'", "'quoted'"),
        ] {
            assert_eq!(quoted(given), cell);
            let line = quoted(given);
            let mut reader = csv::ReaderBuilder::new()
                .has_headers(false)
                .from_reader(line.as_bytes());
            let record = reader.records().next().unwrap().unwrap();
            assert_eq!(record.len(), 1);
            assert_eq!(text(&record[0]), given);
        }
    }
}
