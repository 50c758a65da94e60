//! Tables of text: names to the left, numbers to the right, columns as wide as they need.

use std::fmt;

pub(crate) use hyperstat_study::number;

/// A table; every row has as many cells as the header.
#[derive(Debug)]
pub(crate) struct Table {
    /// Number of leading columns of names, aligned to the left.
    names: usize,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with the given column heads, of which the first `names` are over names.
    pub(crate) fn new(names: usize, heads: &[&str]) -> Self {
        let heads = heads.iter().map(|head| (*head).to_string()).collect();
        Self {
            names,
            rows: vec![heads],
        }
    }

    /// Adds a row of names followed by numbers; a dash stands for one that there is not.
    pub(crate) fn row<N: Into<Option<f64>>>(
        &mut self,
        names: &[&str],
        numbers: impl IntoIterator<Item = N>,
    ) {
        let names = names.iter().map(|name| (*name).to_string());
        let numbers = numbers.into_iter().map(|value| match value.into() {
            Some(value) => number(value),
            None => "–".into(),
        });
        self.rows.push(names.chain(numbers).collect());
    }

    /// Adds a row of names followed by a remark in place of the numbers.
    pub(crate) fn remark(&mut self, names: &[&str], remark: &str) {
        let names = names.iter().map(|name| (*name).to_string());
        self.rows.push(names.chain([remark.to_string()]).collect());
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut widths = vec![0; self.rows[0].len()];
        for row in &self.rows {
            // A remark runs over the columns behind it.
            let counted = if row.len() < widths.len() {
                self.names
            } else {
                row.len()
            };
            for (width, cell) in widths.iter_mut().zip(&row[..counted]) {
                *width = (*width).max(cell.chars().count());
            }
        }
        for row in &self.rows {
            let remark = row.len() < widths.len();
            let mut line = String::new();
            for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
                if column < self.names {
                    line += &format!("  {}", left(cell, *width));
                } else if remark {
                    line += &format!("  {cell}");
                } else {
                    line += &format!("  {}{cell}", blanks(cell, *width));
                }
            }
            writeln!(f, "{}", line.trim_end())?;
        }
        Ok(())
    }
}

/// A text to the left of a column of any width; the widths of `format!` end at 65 535.
pub(super) fn left(text: &str, width: usize) -> String {
    format!("{text}{}", blanks(text, width))
}

/// What a text lacks to the width of a column.
fn blanks(text: &str, width: usize) -> String {
    " ".repeat(width.saturating_sub(text.chars().count()))
}

#[cfg(test)]
mod tests {
    use super::Table;

    #[test]
    fn names_of_any_length_have_a_column() {
        for length in [65_532, 65_535, 65_536, 200_000] {
            let name = "n".repeat(length);
            let mut table = Table::new(1, &["node", "x"]);
            table.row(&[&name], [1.0]);
            table.row(&["a"], [-2.5]);
            let text = table.to_string();
            let widths: Vec<_> = text.lines().map(|line| line.chars().count()).collect();
            assert_eq!(widths, [length + 12; 3], "{length}");
        }
    }

    #[test]
    fn columns_line_up() {
        let mut table = Table::new(1, &["node", "x", "y"]);
        table.row(&["a"], [1.0, -2.5e9]);
        table.row(&["platform.P"], [0.0, 3.0]);
        table.remark(&["b"], "not determined");
        let lines = [
            "  node              x           y",
            "  a           1.00000  -2.50000e9",
            "  platform.P        0     3.00000",
            "  b           not determined",
            "",
        ];
        assert_eq!(table.to_string(), lines.join("\n"));
    }
}
