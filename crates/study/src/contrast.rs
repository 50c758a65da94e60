//! What differs between two tables of sweeps: poses, statuses, and every number.

use std::collections::{BTreeMap, HashMap};
use std::path::PathBuf;

use serde::Serialize;

use crate::figure::Drawn;
use crate::measures::MEASURES;
use crate::plot_error::PlotError;
use crate::schema::{self, COORDINATES, DESIGN, DISPLACEMENT, POSE, STATUS, unit};
use crate::table::{Column, TableReader};

/// Coordinates are the same where they do not differ by more \[m, rad\]: poses are written so or closer.
const SAME_POSE: f64 = 1e-9;
/// Differences below this part of the largest of their kind are none, and values below it have no ratio: they
/// are rounding beside it.
const ROUNDING: f64 = 1e-12;
/// Columns that are read in one pass through a file.
const AT_ONCE: usize = 8;

/// What differs between two tables, the first `[0]` and the second `[1]`. Field names are those of the JSON
/// output.
#[derive(Debug, Serialize)]
pub struct TableComparison {
    /// The files.
    pub names: [PathBuf; 2],
    /// Rows of each.
    pub rows: [usize; 2],
    /// How the rows of one go with those of the other.
    pub matched: Matched,
    /// Columns that only one has.
    pub only_in: [Vec<String>; 2],
    /// How often each pair of statuses comes; pairs of the same status too.
    pub statuses: Vec<StatusCount>,
    /// Columns of numbers that differ, and measures of the stiffness, in the order of the first table.
    pub columns: Vec<ColumnDifference>,
    /// Columns of numbers, and measures, that are the same in all rows.
    pub same: Vec<String>,
}

/// How the rows of two tables go with each other.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Matched {
    /// `pose`: rows of the same pose, wherever they stand; `row`: those of the same number.
    pub by: &'static str,
    /// Rows that have a partner.
    pub rows: usize,
    /// Where rows go by number although poses differ: the largest difference of a coordinate \[m, rad\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub off: Option<f64>,
}

/// How many rows have one status in the first table and one in the second.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct StatusCount {
    /// The status in each.
    pub statuses: [String; 2],
    /// Rows that have them.
    pub rows: usize,
    /// The first of these rows, in the first table, from 0.
    pub first_row: usize,
}

/// How far a column of one table is from the same column of the other, over the rows where both have a
/// number.
#[derive(Debug, Clone, Serialize)]
pub struct ColumnDifference {
    /// Its name, that of a column or of a measure.
    pub column: String,
    /// Its SI unit.
    pub unit: String,
    /// Rows where both have a number.
    pub rows: usize,
    /// Rows where one has a number and the other none.
    pub one_only: usize,
    /// Where the two are furthest apart.
    pub furthest: Option<Furthest>,
    /// The second over the first, where that is more than rounding.
    pub ratio: Option<Ratios>,
}

/// Where two columns are furthest apart.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Furthest {
    /// Row of the first table, from 0.
    pub row: usize,
    /// The numbers there.
    pub values: [f64; 2],
}

/// Ratios of the second to the first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Ratios {
    /// The least.
    pub least: f64,
    /// The median.
    pub median: f64,
    /// The greatest.
    pub most: f64,
}

/// Compares two tables of sweeps.
///
/// # Errors
/// One of them cannot be read, or no row of one goes with a row of the other.
pub fn tables(tables: [&TableReader; 2]) -> Result<TableComparison, PlotError> {
    let [a, b] = tables;
    let partners = Partners::new(tables)?;
    let missing = |k: usize| {
        let names = tables[k].names().iter();
        names
            .filter(|name| tables[1 - k].find(name).is_none())
            .cloned()
            .collect()
    };
    let mut columns = Vec::new();
    let mut same = Vec::new();
    let sizes = Sizes::new(tables)?;
    let mut take = |name: &str, unit: &str, values: [&Column; 2]| {
        let found = partners.difference(name, unit, values, sizes.of(name));
        match found.furthest.is_some() || found.one_only > 0 {
            true => columns.push(found),
            false => same.push(name.to_string()),
        }
    };
    let skipped = |name: &str| {
        [POSE, STATUS, DESIGN].contains(&name)
            || tables.iter().any(|table| table.may_hold_words(name))
    };
    let shared: Vec<&String> = (a.names().iter())
        .filter(|name| b.find(name).is_some() && !skipped(name))
        .collect();
    for names in shared.chunks(AT_ONCE) {
        let read = |table: &TableReader| {
            let places: Vec<_> = names.iter().filter_map(|name| table.find(name)).collect();
            table.read(&places)
        };
        let [first, second] = [read(a)?, read(b)?];
        for (name, values) in names.iter().zip(first.iter().zip(&second)) {
            take(name, unit(name), [values.0, values.1]);
        }
    }
    for measure in &MEASURES {
        let drawn = tables.map(|table| Drawn::named(measure.name, table.names()));
        if let [Some(first), Some(second)] = drawn {
            let values = [first.read(a)?, second.read(b)?];
            take(measure.name, measure.unit, values.each_ref());
        }
    }
    Ok(TableComparison {
        names: tables.map(|table| table.path().into()),
        rows: partners.rows,
        only_in: [missing(0), missing(1)],
        statuses: partners.statuses(tables)?,
        matched: partners.matched,
        columns,
        same,
    })
}

/// How large the numbers are beside which those of a column may be rounding.
struct Sizes(HashMap<String, f64>);

impl Sizes {
    /// Of the diagonal of the stiffness, and of displacements.
    fn new(tables: [&TableReader; 2]) -> Result<Self, PlotError> {
        let mut sizes = HashMap::new();
        for table in tables {
            let counts = |name: &&String| diagonal(name).is_some() || block(name).is_some();
            let names: Vec<&String> = table.names().iter().filter(counts).collect();
            for names in names.chunks(AT_ONCE) {
                let places: Vec<_> = names.iter().filter_map(|name| table.find(name)).collect();
                for (name, column) in names.iter().zip(table.read(&places)?) {
                    let numbers = column.iter().flatten();
                    let largest = numbers.fold(0.0_f64, |largest, n| largest.max(n.abs()));
                    let size = sizes.entry((*name).clone()).or_insert(0.0_f64);
                    *size = size.max(largest);
                }
            }
        }
        Ok(Self(sizes))
    }

    /// Of the kind of a column: √(K_ii K_jj) of a stiffness, the largest translation or rotation of a
    /// displacement; else 0.
    fn of(&self, name: &str) -> f64 {
        let size = |name: &str| self.0.get(name).copied().unwrap_or(0.0);
        if let Some([row, column]) = schema::entry(name) {
            return (size(&format!("k{row}{row}")) * size(&format!("k{column}{column}"))).sqrt();
        }
        let Some(block) = block(name) else { return 0.0 };
        block.iter().map(|name| size(name)).fold(0.0, f64::max)
    }
}

/// The place on the diagonal of a column that is of it.
fn diagonal(name: &str) -> Option<usize> {
    schema::entry(name).and_then(|[row, column]| (row == column).then_some(row))
}

/// The columns of the translation, or the rotation, of which a column is a component.
fn block(name: &str) -> Option<[String; 3]> {
    let (case, last) = match name.rsplit_once('.') {
        Some((case, last)) => (format!("{case}."), last),
        None => (String::new(), name),
    };
    let place = DISPLACEMENT.iter().position(|known| *known == last)?;
    let first = place / 3 * 3;
    Some(std::array::from_fn(|k| {
        format!("{case}{}", DISPLACEMENT[first + k])
    }))
}

/// Which row of the second table goes with a row of the first.
struct Partners {
    rows: [usize; 2],
    pairs: Vec<[usize; 2]>,
    matched: Matched,
}

impl Partners {
    fn new(tables: [&TableReader; 2]) -> Result<Self, PlotError> {
        let [a, b] = tables;
        // What a row is known by in both: its design, its pose, its drives.
        let drives: Vec<String> = a.drives().filter(|name| b.find(name).is_some()).collect();
        let names = [DESIGN].into_iter().chain(COORDINATES);
        let names: Vec<&str> = (names.chain(drives.iter().map(String::as_str)))
            .filter(|name| tables.iter().all(|table| table.find(name).is_some()))
            .collect();
        let read = |table: &TableReader| {
            let places: Vec<_> = names.iter().filter_map(|name| table.find(name)).collect();
            table.read(&places)
        };
        let keys = [read(a)?, read(b)?];
        let rows = keys.each_ref().map(|keys| keys.first().map_or(0, Vec::len));
        if let Some(empty) = (0..2).find(|k| rows[*k] == 0) {
            return Err(PlotError::Empty {
                path: tables[empty].path().into(),
            });
        }
        let pairs = by_pose(&keys, rows);
        if pairs.len() == rows[0].min(rows[1]) || (rows[0] != rows[1] && !pairs.is_empty()) {
            let (by, rows_of) = ("pose", pairs.len());
            let matched = Matched {
                by,
                rows: rows_of,
                off: None,
            };
            return Ok(Self {
                rows,
                pairs,
                matched,
            });
        }
        if rows[0] != rows[1] {
            return Err(PlotError::NoPartners {
                paths: tables.map(|table| table.path().into()),
                rows,
            });
        }
        let apart = keys[0]
            .iter()
            .zip(&keys[1])
            .flat_map(|(a, b)| a.iter().zip(b));
        let apart = apart.filter_map(|(a, b)| Some(((*a)? - (*b)?).abs()));
        let matched = Matched {
            by: "row",
            rows: rows[0],
            off: Some(apart.fold(0.0, f64::max)),
        };
        let pairs = (0..rows[0]).map(|row| [row, row]).collect();
        Ok(Self {
            rows,
            pairs,
            matched,
        })
    }

    fn difference(
        &self,
        name: &str,
        unit: &str,
        [a, b]: [&Column; 2],
        size: f64,
    ) -> ColumnDifference {
        let both = self
            .pairs
            .iter()
            .filter_map(|[i, j]| Some((*i, [(*a.get(*i)?)?, (*b.get(*j)?)?])));
        let both: Vec<(usize, [f64; 2])> = both.collect();
        let known = |column: &Column, row: usize| column.get(row).is_some_and(Option::is_some);
        let one_only = self
            .pairs
            .iter()
            .filter(|[i, j]| known(a, *i) != known(b, *j))
            .count();
        let largest = both.iter().flat_map(|(_, values)| values);
        let largest = largest.fold(size, |largest, value| largest.max(value.abs()));
        let apart = |[a, b]: [f64; 2]| (b - a).abs();
        let mut furthest: Option<Furthest> = None;
        for (row, values) in &both {
            let now = furthest.map_or(0.0, |found| apart(found.values));
            if apart(*values) > now.max(ROUNDING * largest) {
                furthest = Some(Furthest {
                    row: *row,
                    values: *values,
                });
            }
        }
        let ratios = both
            .iter()
            .filter(|(_, [a, _])| a.abs() > ROUNDING * largest);
        let mut ratios: Vec<f64> = ratios.map(|(_, [a, b])| b / a).collect();
        ratios.sort_by(f64::total_cmp);
        ColumnDifference {
            column: name.into(),
            unit: unit.into(),
            rows: both.len(),
            one_only,
            furthest,
            ratio: ratios
                .first()
                .zip(ratios.last())
                .map(|(least, most)| Ratios {
                    least: *least,
                    median: 0.5 * (ratios[(ratios.len() - 1) / 2] + ratios[ratios.len() / 2]),
                    most: *most,
                }),
        }
    }

    fn statuses(&self, tables: [&TableReader; 2]) -> Result<Vec<StatusCount>, PlotError> {
        let words = |table: &TableReader| table.words(table.find(STATUS).unwrap_or(0));
        let [a, b] = [words(tables[0])?, words(tables[1])?];
        let mut counts: BTreeMap<[&str; 2], (usize, usize)> = BTreeMap::new();
        for [i, j] in &self.pairs {
            if let (Some(a), Some(b)) = (a.get(*i), b.get(*j)) {
                counts.entry([a, b]).or_insert((0, *i)).0 += 1;
            }
        }
        let count = |(statuses, (rows, first_row)): ([&str; 2], (usize, usize))| StatusCount {
            statuses: statuses.map(String::from),
            rows,
            first_row,
        };
        Ok(counts.into_iter().map(count).collect())
    }
}

/// Pairs of rows of the same pose, in the order of the first table; of a pose that comes several times the
/// first with the first.
fn by_pose(keys: &[Vec<Column>; 2], rows: [usize; 2]) -> Vec<[usize; 2]> {
    let key = |k: usize, row: usize| -> Vec<Option<i64>> {
        let rounded = |value: f64| (value / SAME_POSE).round() as i64;
        let of = |column: &Column| column.get(row).copied().flatten().map(rounded);
        keys[k].iter().map(of).collect()
    };
    let mut left: HashMap<Vec<Option<i64>>, Vec<usize>> = HashMap::new();
    for row in (0..rows[1]).rev() {
        left.entry(key(1, row)).or_default().push(row);
    }
    let partner = |row: usize| Some([row, left.get_mut(&key(0, row))?.pop()?]);
    (0..rows[0]).filter_map(partner).collect()
}
