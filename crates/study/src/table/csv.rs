//! A table of comma-separated values: a line of column names, then a line a pose.

use std::fmt::Write as _;
#[cfg(feature = "parts")]
use std::io::Read;
use std::io::{self, Write};
#[cfg(feature = "parts")]
use std::sync::Arc;

use hyperstat_mechanisms::Value;

use super::cells::quoted;
#[cfg(feature = "parts")]
use super::content::{Content, Reader};
use crate::sweep::{Cell, Chunk, Columns, NUMBERS, Row, UPPER};

/// A table being written as CSV.
#[derive(Debug)]
pub(super) struct Csv<W> {
    writer: W,
    /// The line of names.
    #[cfg(feature = "parts")]
    names: String,
}

impl<W: Write> Csv<W> {
    pub(super) fn new(mut writer: W, columns: &Columns<'_>) -> io::Result<Self> {
        let names = crate::schema::columns(columns).map(|name| quoted(&name).into_owned());
        let names: Vec<_> = names.collect();
        let names = names.join(",") + "\n";
        writer.write_all(names.as_bytes())?;
        Ok(Self {
            writer,
            #[cfg(feature = "parts")]
            names,
        })
    }

    /// Appends the lines of a table with the same columns.
    #[cfg(feature = "parts")]
    pub(super) fn join(&mut self, content: &Arc<dyn Content>) -> io::Result<()> {
        let mut reader = Reader::new(Arc::clone(content), 0);
        let mut names = vec![0; self.names.len()];
        reader.read_exact(&mut names)?;
        if names != self.names.as_bytes() {
            let message = "its columns are others than those of the table";
            return Err(io::Error::new(io::ErrorKind::InvalidData, message));
        }
        io::copy(&mut reader, &mut self.writer).map(drop)
    }

    pub(super) fn append(&mut self, chunk: &Chunk) -> io::Result<()> {
        if chunk.text.is_empty() {
            // Nobody has rendered it.
            return self.writer.write_all(lines(chunk).as_bytes());
        }
        self.writer.write_all(chunk.text.as_bytes())
    }

    pub(super) fn finish(self) -> W {
        self.writer
    }
}

/// Writes the lines of a chunk into its text.
pub(super) fn render(chunk: &mut Chunk) {
    let mut text = std::mem::take(&mut chunk.text);
    add_lines(chunk, &mut text);
    chunk.text = text;
}

/// The lines of a chunk.
fn lines(chunk: &Chunk) -> String {
    let mut text = String::new();
    add_lines(chunk, &mut text);
    text
}

fn add_lines(chunk: &Chunk, text: &mut String) {
    for row in chunk.table_rows() {
        append(text, &row);
    }
}

/// Appends the line of a row to `text`.
fn append(text: &mut String, row: &Row<'_>) {
    let record = row.record;
    // Writing to a String cannot fail.
    let _ = write!(text, "{}", row.pose);
    append_known(text, &record.pose);
    text.push(',');
    text.push_str(record.status());
    let further = match record.known() {
        Some((displacement, further)) => {
            append_numbers(text, displacement.as_slice());
            match &record.result {
                Ok(found) => append_numbers(text, &found.upper()),
                Err(_) => text.extend(std::iter::repeat_n(',', UPPER)),
            }
            further
        }
        None => {
            text.extend(std::iter::repeat_n(',', NUMBERS));
            &[]
        }
    };
    for k in 0..further.len().max(row.further) {
        match further.get(k) {
            Some(Cell::Number(number)) => append_numbers(text, &[*number]),
            Some(Cell::Text(words)) => append_words(text, words),
            Some(Cell::Empty) | None => text.push(','),
        }
    }
    append_numbers(text, row.drives);
    if let Some((number, values)) = row.design {
        let _ = write!(text, ",{number}");
        for value in values {
            match value {
                Value::Number(number) => append_numbers(text, &[*number]),
                Value::Text(words) => append_words(text, words),
            }
        }
    }
    text.push('\n');
}

/// Appends a text, with a comma before it.
fn append_words(text: &mut String, words: &str) {
    text.push(',');
    text.push_str(&quoted(words));
}

/// Appends each number as [`append_numbers`], nothing but the comma for one that is not known.
fn append_known(text: &mut String, numbers: &[Option<f64>]) {
    for number in numbers {
        match number {
            Some(number) => append_numbers(text, &[*number]),
            None => text.push(','),
        }
    }
}

/// Appends each number, with a comma before it, as the shortest decimal number that reads back to
/// the same double.
fn append_numbers(text: &mut String, numbers: &[f64]) {
    let mut buffer = zmij::Buffer::new();
    for number in numbers {
        text.push(',');
        text.push_str(buffer.format(*number));
    }
}

#[cfg(test)]
mod tests {
    use hyperstat_mechanisms::PoseError;
    use nalgebra::{Matrix6, Vector6};

    use super::append;
    use crate::schema::columns;
    use crate::sweep::{Cell, Columns, Failure, Found, Held, Record, Row};

    fn two_further() -> Columns<'static> {
        Columns {
            further: vec!["f1".into(), "f2".into()],
            ..Columns::default()
        }
    }

    fn row(pose: usize, record: &Record) -> Row<'_> {
        Row {
            pose,
            record,
            further: 0,
            drives: &[],
            design: None,
        }
    }

    #[test]
    fn numbers_read_back_to_the_same_double() {
        let found = Found {
            stiffness: Matrix6::from_fn(|r, c| 1e8 / (1.0 + (r.min(c) * 6 + r.max(c)) as f64)),
            displacement: Vector6::new(0.1 + 0.2, -1.0 / 3.0, 5e-324, 1e300, -0.0, 1e-7),
            further: vec![Cell::Number(0.1), Cell::Empty],
        };
        let mut text = String::new();
        let record = Record {
            pose: [1.0 / 7.0, 0.0, 0.5, 0.0, 0.0, -1e-20].map(Some),
            result: Ok(found.clone()),
        };
        append(&mut text, &row(12, &record));
        let cells: Vec<_> = text.trim_end().split(',').collect();
        let names: Vec<_> = columns(&two_further()).collect();
        assert_eq!(cells.len(), names.len());
        let cell = |name: &str| cells[names.iter().position(|n| *n == name).unwrap()];
        let number = |name: &str| cell(name).parse::<f64>().unwrap();
        assert_eq!(cell("pose"), "12");
        assert_eq!(cell("status"), "ok");
        assert_eq!(Some(number("x")), record.pose[0]);
        assert_eq!(Some(number("rz")), record.pose[5]);
        assert_eq!((number("f1"), cell("f2")), (0.1, ""));
        for (k, name) in ["dx", "dy", "dz", "drx", "dry", "drz"].iter().enumerate() {
            assert_eq!(number(name).to_bits(), found.displacement[k].to_bits());
        }
        for row in 0..6 {
            for column in row..6 {
                let name = format!("k{}{}", row + 1, column + 1);
                assert_eq!(number(&name), found.stiffness[(row, column)]);
            }
        }
    }

    #[test]
    fn a_rigidly_held_output_has_a_displacement_and_no_stiffness() {
        let held = Held {
            displacement: Vector6::new(1.0, 0.0, 2.0, 0.0, 0.0, 0.5),
            further: vec![Cell::Number(3.0)],
        };
        let record = Record {
            pose: [Some(0.0); 6],
            result: Err(Failure::Rigid(Box::new(held))),
        };
        let mut text = String::new();
        let row = Row {
            further: 2,
            ..row(0, &record)
        };
        append(&mut text, &row);
        let numbers = "1.0,0.0,2.0,0.0,0.0,0.5";
        let stiffness = ",".repeat(21);
        assert!(
            text.ends_with(&format!(",rigid,{numbers}{stiffness},3.0,\n")),
            "{text}"
        );
        assert_eq!(
            text.matches(',').count() + 1,
            columns(&two_further()).count()
        );
    }

    #[test]
    fn what_is_not_known_is_empty() {
        let what = "too far".to_string();
        let record = Record {
            pose: [Some(9.0), Some(0.0), None, None, Some(-0.5), None],
            result: Err(Failure::Pose(PoseError::Unreachable { what })),
        };
        let mut text = String::new();
        let row = Row {
            further: 2,
            drives: &[0.25, -1.0],
            ..row(0, &record)
        };
        append(&mut text, &row);
        let nothing = ",".repeat(29);
        assert_eq!(
            text,
            format!("0,9.0,0.0,,,-0.5,,unreachable{nothing},0.25,-1.0\n")
        );
        let drives = ["A1.v", "A2.v"].map(String::from);
        let wanted = Columns {
            drives: &drives,
            ..two_further()
        };
        assert_eq!(text.matches(',').count() + 1, columns(&wanted).count());
        assert!(columns(&wanted).skip(35 + 2).eq(drives.clone()));
    }
}
