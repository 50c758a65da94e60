//! Numbers in reports: how many digits are told, and what is rounding.

/// A number of six digits, as an engineer reads it.
pub fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let text = format!("{value:.5e}");
    // Its power of ten, after rounding.
    let power = text.split('e').nth(1).and_then(|power| power.parse().ok());
    match power {
        Some(power @ -2..=4) => format!("{value:.*}", (5_i32 - power) as usize),
        _ => text,
    }
}

/// Entries of a matrix below this share of √(K_ii K_jj) are rounding, and numbers of a list below
/// this share of the largest.
pub const ROUNDING: f64 = 1e-14;

/// A matrix in which what is rounding beside its diagonal entries is 0.
pub fn without_rounding(matrix: &[[f64; 6]; 6]) -> [[f64; 6]; 6] {
    let entry = |r: usize, c: usize| {
        let scale = (matrix[r][r] * matrix[c][c]).abs().sqrt();
        match matrix[r][c] {
            entry if entry.abs() < ROUNDING * scale => 0.0,
            entry => entry,
        }
    };
    std::array::from_fn(|r| std::array::from_fn(|c| entry(r, c)))
}

/// What is rounding beside the largest number of its kind, shown as 0: of six components, the first
/// three are of one kind and the last three of another.
#[derive(Debug)]
pub struct Rounding([f64; 2]);

impl Rounding {
    /// Of all rows of a table.
    pub fn of<'a>(rows: impl IntoIterator<Item = &'a [f64; 6]>) -> Self {
        let mut largest = [0.0_f64; 2];
        for row in rows {
            for (k, number) in row.iter().enumerate() {
                largest[k / 3] = largest[k / 3].max(number.abs());
            }
        }
        Self(largest.map(|largest| ROUNDING * largest))
    }

    /// A row as it is shown.
    pub fn shown(&self, row: &[f64; 6]) -> [f64; 6] {
        std::array::from_fn(|k| {
            if row[k].abs() < self.0[k / 3] {
                0.0
            } else {
                row[k]
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_have_six_digits() {
        let cases = [
            (0.0, "0"),
            (1.0, "1.00000"),
            (-12.345_678_9, "-12.3457"),
            (0.05, "0.0500000"),
            (99_999.4, "99999.4"),
            (99_999.96, "1.00000e5"),
            (9.999_999_9, "10.0000"),
            (9.999_999_9e-3, "0.0100000"),
            (f64::NAN, "NaN"),
            (123_456_789.0, "1.23457e8"),
            (-1.5e-7, "-1.50000e-7"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }
}
