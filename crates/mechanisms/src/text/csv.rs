//! Tables of comma-separated numbers: poses, with a line of column names at the top, and matrices.

use std::ops::Range;
use std::sync::Arc;

use super::columns::Given;
use super::fragment::Fragment;
use super::source::{Place, Source};
use crate::error::LoadError;
use crate::text::{names, quantities, slips};

/// Names of the columns: a table has the first three or all six.
pub(crate) const COLUMNS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// A number of a pose, by its place among the columns.
pub(crate) fn quantity(column: usize, number: Fragment<'_>) -> Result<f64, LoadError> {
    let dimension = quantities::displacement()[column];
    number.quantity(&format!("`{}`", COLUMNS[column]), dimension)
}

/// Reads all poses of a table; empty lines are passed over.
pub(crate) fn read(table: &Arc<Source>, given: &Given<'_>) -> Result<Vec<[f64; 6]>, LoadError> {
    let place = |span| Place {
        source: Arc::clone(table),
        span,
    };
    let mut lines = lines(table.text());
    let Some(header) = lines.next() else {
        return Err(place(0..0)
            .error("the table of poses is empty")
            .with_help("its first line names the columns: x,y,z or x,y,z,rx,ry,rz"));
    };
    let columns = columns(table, header.clone(), &place)?;
    table.understood();
    let mut poses = Vec::new();
    for line in lines {
        let cells: Vec<_> = cells(table.text(), &line).collect();
        if cells.len() != columns.len() {
            return Err(wrong_count(table, &header, columns.len(), line, &cells));
        }
        let mut pose = [0.0; 6];
        for (cell, &column) in cells.into_iter().zip(&columns) {
            let place = place(cell);
            pose[column] = number(&place)?;
            given.check(column, pose[column], || place)?;
        }
        poses.push(pose);
    }
    if poses.is_empty() {
        return Err(place(table.text().len()..table.text().len())
            .error("the table names its columns and holds no pose")
            .with_help("add a line of numbers for every pose"));
    }
    Ok(poses)
}

/// Reads a table whose first line names its columns; `column` says what a name means, and refuses
/// others. Empty lines are passed over.
pub(crate) fn named<C: PartialEq>(
    table: &Arc<Source>,
    column: impl Fn(&str, &Place) -> Result<C, LoadError>,
) -> Result<(Vec<C>, Vec<Vec<f64>>), LoadError> {
    let place = |span| Place {
        source: Arc::clone(table),
        span,
    };
    let text = table.text();
    let mut lines = lines(text);
    let Some(header) = lines.next() else {
        return Err(place(0..0)
            .error("the table is empty")
            .with_help("its first line names the columns"));
    };
    separated(table, &header)?;
    let mut columns = Vec::new();
    for cell in cells(text, &header) {
        let name = unquoted(&text[cell.clone()]);
        let place = place(cell.clone());
        let meant = column(name, &place)?;
        if columns.contains(&meant) {
            return Err(place
                .error(format!("the column `{name}` is given twice"))
                .with_help("leave one of them out"));
        }
        columns.push(meant);
    }
    table.understood();
    let mut rows = Vec::new();
    for line in lines {
        let cells: Vec<_> = cells(text, &line).collect();
        let numbers = cells.iter().map(|cell| number(&place(cell.clone())));
        let row: Vec<f64> = numbers.collect::<Result<_, _>>()?;
        if row.len() != columns.len() {
            return Err(wrong_count(table, &header, columns.len(), line, &cells));
        }
        rows.push(row);
    }
    if rows.is_empty() {
        return Err(place(text.len()..text.len())
            .error("the table names its columns and holds no pose")
            .with_help("add a line of numbers for every pose"));
    }
    Ok((columns, rows))
}

/// Reads a table of numbers without names of columns, each with its place; empty lines are passed
/// over.
pub(crate) fn numbers(table: &Arc<Source>) -> Result<Vec<Vec<(f64, Place)>>, LoadError> {
    let cell = |span| {
        let place = Place {
            source: Arc::clone(table),
            span,
        };
        Ok((number(&place)?, place))
    };
    lines(table.text())
        .map(|line| {
            let row: Result<Vec<_>, _> = cells(table.text(), &line).map(cell).collect();
            // A line of numbers alone is of a table of numbers.
            if row.is_ok() {
                table.understood();
            }
            row
        })
        .collect()
}

/// The error of a line of another number of cells than the `wanted` columns.
fn wrong_count(
    table: &Arc<Source>,
    header: &Range<usize>,
    wanted: usize,
    line: Range<usize>,
    cells: &[Range<usize>],
) -> LoadError {
    let text = table.text();
    if let Err(error) = separated(table, &line) {
        return error;
    }
    let place = Place {
        source: Arc::clone(table),
        span: line,
    };
    let values: Vec<&str> = cells.iter().map(|cell| &text[cell.clone()]).collect();
    let found = values.len();
    let message = format!("expected {wanted} numbers, one a column, found {found}");
    let columns = shortened(&text[header.clone()]);
    place
        .error(message)
        .with_help(match slips::decimal_commas(&values, wanted) {
            Some(_) => format!("{NUMBER}: a comma separates two cells"),
            None => format!(
                "give a number for each of the columns {columns}, with a comma between two of them"
            ),
        })
}

/// Refuses a line of cells that something else than commas separates, or that is a comment.
fn separated(table: &Arc<Source>, line: &Range<usize>) -> Result<(), LoadError> {
    let text = &table.text()[line.clone()];
    let place = |at: usize| Place {
        source: Arc::clone(table),
        span: line.start + at..line.start + at + 1,
    };
    if text.starts_with('#') {
        return Err(place(0)
            .error("`#` begins no comment")
            .with_help("a table has no comments: leave the line out"));
    }
    // Blanks separate words of a header, and numbers.
    let number = |word: &str| word.parse::<f64>().is_ok();
    let blank = |at: &usize| line.start == 0 || text[*at..].split(' ').any(number);
    let other = text.find([';', '\t']);
    let blanks = text.find(' ').filter(|_| !text.contains('"'));
    let other = other.or_else(|| blanks.filter(blank));
    let Some(at) = other.filter(|_| !text.contains(',')) else {
        return Ok(());
    };
    let what = match &text[at..=at] {
        ";" => "`;`",
        "\t" => "a tab",
        _ => "a blank",
    };
    let place = place(at);
    Err(place
        .error(format!("{what} separates the cells of this table"))
        .with_help("separate cells by commas, and write decimals with a point"))
}

/// The start of a text that a message shows.
pub(crate) fn shortened(text: &str) -> String {
    const SHOWN: usize = 60;
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.into(),
    }
}

/// What would be right instead of what is no number.
const NUMBER: &str = "give a number such as 0.25 or 2.1e11 in every cell, with a decimal point";

/// The finite number in a cell.
fn number(place: &Place) -> Result<f64, LoadError> {
    let text = unquoted(&place.source.text()[place.span.clone()]);
    let shown = || shortened(text);
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(_) => Err(place
            .error(format!("`{}` is not a finite number", shown()))
            .with_help(NUMBER)),
        Err(_) => {
            separated(&place.source, &place.span)?;
            if let Some((_, name)) = slips::invisible(text) {
                return Err(place
                    .error(format!("expected a number, found {name} in `{}`", shown()))
                    .with_help(slips::VISIBLE));
            }
            Err(place
                .error(format!("expected a number, found `{}`", shown()))
                .with_help(NUMBER))
        }
    }
}

/// The place in a pose of every column of the header.
fn columns(
    table: &Arc<Source>,
    header: Range<usize>,
    place: &impl Fn(Range<usize>) -> Place,
) -> Result<Vec<usize>, LoadError> {
    separated(table, &header)?;
    let cells = cells(table.text(), &header);
    let names = cells.map(|cell| (unquoted(&table.text()[cell.clone()]), place(cell)));
    pose_columns(names, &place(header.clone()))
}

/// The place in a pose of every column of these names: the first three or all six; `header` is where they
/// stand.
pub(crate) fn pose_columns<'n>(
    names: impl Iterator<Item = (&'n str, Place)>,
    header: &Place,
) -> Result<Vec<usize>, LoadError> {
    let mut columns = Vec::new();
    for (name, place) in names {
        let column = coordinate(name, &place)?;
        if columns.contains(&column) {
            return Err(place
                .error(format!("the column `{name}` is given twice"))
                .with_help("the columns are x,y,z or x,y,z,rx,ry,rz"));
        }
        columns.push(column);
    }
    let wanted = if columns.len() <= 3 { 3 } else { 6 };
    if let Some(missing) = (0..wanted).find(|column| !columns.contains(column)) {
        return Err(header
            .error(format!("the column `{}` is missing", COLUMNS[missing]))
            .with_help("the columns are x,y,z or x,y,z,rx,ry,rz"));
    }
    Ok(columns)
}

/// The place in a pose of a column of this name.
pub(crate) fn coordinate(name: &str, place: &Place) -> Result<usize, LoadError> {
    let found = COLUMNS.iter().position(|known| *known == name);
    found.ok_or_else(|| {
        place
            .error(format!("unknown column `{}`", shortened(name)))
            .with_help(names::help(name, "columns", COLUMNS))
    })
}

/// The lines that are not blank, without their line breaks.
fn lines(text: &str) -> impl Iterator<Item = Range<usize>> {
    let mut start = 0;
    text.split_inclusive('\n').filter_map(move |line| {
        let from = start;
        start += line.len();
        let content = line.trim_end();
        (!content.is_empty()).then(|| from..from + content.len())
    })
}

/// The cells of a line, without the white space around them.
fn cells<'t>(text: &'t str, line: &Range<usize>) -> impl Iterator<Item = Range<usize>> + 't {
    let mut start = line.start;
    text[line.clone()].split(',').map(move |cell| {
        let from = start + (cell.len() - cell.trim_start().len());
        start += cell.len() + 1;
        from..from + cell.trim().len()
    })
}

/// A cell without the quotes that some programs put around it.
fn unquoted(cell: &str) -> &str {
    let inner = cell.strip_prefix('"').and_then(|c| c.strip_suffix('"'));
    inner.unwrap_or(cell).trim()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::prebuilt::PoseCoordinate;
    use crate::text::files::MemoryFiles;

    const DELTA: Given<'_> = Given {
        kind: "Delta",
        coordinates: &[PoseCoordinate::X, PoseCoordinate::Y, PoseCoordinate::Z],
    };

    fn table(text: &str) -> Result<Vec<[f64; 6]>, String> {
        let source = Source::new(Path::new("p.csv"), text, &MemoryFiles::new());
        read(&source, &DELTA).map_err(|error| error.to_string())
    }

    #[test]
    fn reads_tables_as_programs_write_them() {
        let poses = vec![[0.1, 2.0, -3e-1, 0.0, 0.0, 0.0]];
        assert_eq!(table("x,y,z\n0.1,2,-3e-1\n").unwrap(), poses);
        assert_eq!(
            table("\u{feff}\"y\", x ,z\r\n\r\n2, 0.1 ,-0.3").unwrap(),
            poses
        );
        assert_eq!(
            table("x,y,z,rx,ry,rz\n0.1,2,-.3,0,0,-0\n").unwrap()[0][..3],
            poses[0][..3]
        );
    }

    #[test]
    fn mistakes_are_told_with_their_place() {
        let cases = [
            ("", "p.csv:1:1: the table of poses is empty"),
            (
                "x,y,z\n",
                "p.csv:2:1: the table names its columns and holds no pose",
            ),
            ("x,y\n1,2", "p.csv:1:1: the column `z` is missing"),
            ("x,y,z,rx\n1,2,3,4", "p.csv:1:1: the column `ry` is missing"),
            ("x,y,t,z\n", "p.csv:1:5: unknown column `t`"),
            ("x,y,x\n", "p.csv:1:5: the column `x` is given twice"),
            (
                "x,y,z\n1,2\n",
                "p.csv:2:1: expected 3 numbers, one a column, found 2",
            ),
            (
                "x,y,z\n1,2,3,\n",
                "p.csv:2:1: expected 3 numbers, one a column, found 4",
            ),
            (
                "x,y,z\n1,2,3\n1, a,3\n",
                "p.csv:3:4: expected a number, found `a`",
            ),
            ("x,y,z\n1,,3\n", "p.csv:2:3: expected a number, found ``"),
            (
                "x,y,z\n1,2,NaN\n",
                "p.csv:2:5: `NaN` is not a finite number",
            ),
            (
                "x,y,z\n1,2,1e999\n",
                "p.csv:2:5: `1e999` is not a finite number",
            ),
            (
                "x,y,z,rx,ry,rz\n1,2,3,0,0.5,0\n",
                "p.csv:2:9: `Delta` cannot follow this coordinate",
            ),
        ];
        for (text, message) in cases {
            assert_eq!(table(text).unwrap_err(), message, "{text:?}");
        }
    }
}
