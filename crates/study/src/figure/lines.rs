//! Quantities of a table along its poses, or along one of its columns: a curve for each value of
//! what else varies.

use std::collections::HashMap;

use hyperstat_figures::{Diagram, LineFigure, MOST_SERIES, Quantity, Series};

use super::coordinates::Coordinates;
use super::labels::Labels;
use super::map::evenly;
use super::quantity::Drawn;
use super::rows::{Choice, chosen};
use crate::plot_error::PlotError;
use crate::table::{Column, TableReader};

/// Lines that are asked for.
#[derive(Debug, Clone)]
pub struct Lines {
    /// The quantities.
    pub values: Vec<String>,
    /// The quantity along the lower axis.
    pub over: String,
    /// Which rows.
    pub choice: Choice,
    /// Title of the figure; else the name of the job.
    pub title: Option<String>,
    /// Names of quantities in it.
    pub labels: Labels,
}

/// What is along the lower axis.
struct Over {
    quantity: Quantity,
    /// Words, where it is no number.
    categories: Vec<String>,
    /// At every row of the table: a number, or that of a category.
    at: Column,
}

/// What a curve is of.
#[derive(Debug, Clone)]
struct Curve {
    /// The value of what else varies; empty where nothing does.
    name: String,
    rows: Vec<usize>,
}

/// Curves, and what tells them apart.
struct Curves {
    names: Vec<String>,
    all: Vec<Curve>,
    /// Number of them before most were left out.
    count: usize,
}

/// The figure of lines.
pub fn figure(table: &TableReader, lines: &Lines) -> Result<LineFigure, PlotError> {
    let names = table.names().iter().chain(&lines.values);
    let names = names.chain([&lines.over]).map(String::as_str);
    let over = Over::read(table, lines)?;
    let drawn = lines.values.iter();
    let drawn = drawn.map(|name| Ok(Drawn::of_table(name, table)?.labelled(&lines.labels)));
    let drawn: Vec<Drawn> = drawn.collect::<Result<_, PlotError>>()?;
    lines.labels.check(names)?;
    let mut rows = lines.choice.rows(table)?;
    rows.retain(|&row| over.at[row].is_some());
    let curves = Curves::find(table, lines, &over, rows)?;
    let diagrams = diagrams(table, &drawn, &over, &curves)?;
    let mut series = diagrams.iter().flat_map(|diagram| &diagram.series);
    if !series.any(|series| series.values.iter().any(Option::is_some)) {
        return Err(PlotError::Nothing {
            path: table.path().into(),
        });
    }
    let words = |drawn: &Drawn| match drawn.words == drawn.quantity.name {
        true => drawn.words.clone(),
        false => format!("{}: {}", drawn.quantity.name, drawn.words),
    };
    let mut subtitle = match &*drawn {
        [one] => words(one),
        all => {
            let names: Vec<_> = all.iter().map(|drawn| &*drawn.quantity.name).collect();
            format!("{} over {}", names.join(", "), over.quantity.name)
        }
    };
    if let Some(design) = lines.choice.in_words(table) {
        subtitle += &format!("; {design}");
    }
    if curves.all.len() < curves.count {
        let (shown, all) = (curves.all.len(), curves.count);
        subtitle += &format!("; {shown} of {all} values of {}", curves.names.join(", "));
    }
    Ok(LineFigure {
        title: lines.title.clone().unwrap_or_else(|| table.job()),
        subtitle: format!("{subtitle}."),
        over: over.quantity,
        categories: over.categories,
        diagrams,
    })
}

/// The diagrams: quantities of one unit share one, unless each has several curves.
fn diagrams(
    table: &TableReader,
    drawn: &[Drawn],
    over: &Over,
    curves: &Curves,
) -> Result<Vec<Diagram>, PlotError> {
    let mut diagrams: Vec<Diagram> = Vec::new();
    for drawn in drawn {
        let Quantity { name, unit } = &drawn.quantity;
        let column = drawn.read(table)?;
        let series = |curve: &Curve, name: &str| Series {
            name: name.into(),
            at: chosen(&over.at, &curve.rows)
                .into_iter()
                .flatten()
                .collect(),
            values: chosen(&column, &curve.rows),
        };
        if let [only] = &*curves.all {
            let series = series(only, name);
            let open = |diagram: &&mut Diagram| {
                diagram.unit == *unit && diagram.series.len() < MOST_SERIES
            };
            if let Some(diagram) = diagrams.iter_mut().find(open) {
                diagram.name = format!("{}, {name}", diagram.name);
                diagram.series.push(series);
                continue;
            }
            diagrams.push(Diagram {
                name: name.clone(),
                unit: unit.clone(),
                legend: String::new(),
                series: vec![series],
            });
            continue;
        }
        diagrams.push(Diagram {
            name: name.clone(),
            unit: unit.clone(),
            legend: curves.names.join(", "),
            series: (curves.all.iter())
                .map(|curve| series(curve, &curve.name))
                .collect(),
        });
    }
    Ok(diagrams)
}

impl Over {
    fn read(table: &TableReader, lines: &Lines) -> Result<Self, PlotError> {
        let name = &lines.over;
        let drawn = Drawn::of_table(name, table)?;
        let mut categories = Vec::new();
        let at = match drawn.read(table) {
            Err(PlotError::Texts { .. }) => {
                let words = table.words(table.find(name).unwrap_or(0))?;
                let mut known: HashMap<String, usize> = HashMap::new();
                let number = |word: String| {
                    let next = known.len();
                    let number = *known.entry(word.clone()).or_insert(next);
                    if number == next {
                        categories.push(word);
                    }
                    Some(number as f64)
                };
                words.into_iter().map(number).collect()
            }
            read => read?,
        };
        Ok(Self {
            quantity: drawn.labelled(&lines.labels).quantity,
            categories,
            at,
        })
    }
}

impl Curves {
    /// One curve, where no two rows are at the same place; else one for each value of what else
    /// varies.
    fn find(
        table: &TableReader,
        lines: &Lines,
        over: &Over,
        rows: Vec<usize>,
    ) -> Result<Self, PlotError> {
        let one = |rows| Self {
            names: Vec::new(),
            all: vec![Curve {
                name: String::new(),
                rows,
            }],
            count: 1,
        };
        let at = |row: usize| over.at[row].unwrap_or_default().to_bits();
        let places: std::collections::HashSet<u64> = rows.iter().map(|row| at(*row)).collect();
        if places.len() == rows.len() {
            return Ok(one(rows));
        }
        // Columns that vary, but do not follow from the place.
        let mut columns = others(table, lines, &rows)?;
        columns.retain(|(_, words)| {
            let mut of_place: HashMap<u64, &str> = HashMap::new();
            let follows = rows.iter().zip(words).all(|(row, word)| {
                let known = of_place.entry(at(*row)).or_insert(word);
                known == word
            });
            !follows
        });
        if columns.is_empty() {
            return Ok(one(rows));
        }
        let mut all: Vec<Curve> = Vec::new();
        let mut known: HashMap<String, usize> = HashMap::new();
        for (place, row) in rows.iter().enumerate() {
            let words: Vec<_> = columns.iter().map(|(_, words)| &*words[place]).collect();
            let name = words.join(", ");
            let curve = *known.entry(name).or_insert_with_key(|name| {
                all.push(Curve {
                    name: name.clone(),
                    rows: Vec::new(),
                });
                all.len() - 1
            });
            all[curve].rows.push(*row);
        }
        if table.varied().contains(&lines.over) {
            // The order of the designs is not that of their values.
            for curve in &mut all {
                curve.rows.sort_by(|a, b| {
                    let [a, b] = [a, b].map(|row| over.at[*row].unwrap_or_default());
                    a.total_cmp(&b)
                });
            }
        }
        let count = all.len();
        let shown = evenly(count, MOST_SERIES).into_iter();
        Ok(Self {
            all: shown.map(|k| all[k].clone()).collect(),
            names: (columns.iter())
                .map(|(name, _)| lines.labels.of(name).to_owned())
                .collect(),
            count,
        })
    }
}

/// What else may vary over these rows, each with its value at every one of them in words: the
/// other values of the designs, or the other coordinates that the poses were asked for by.
fn others(
    table: &TableReader,
    lines: &Lines,
    rows: &[usize],
) -> Result<Vec<(String, Vec<String>)>, PlotError> {
    let mut columns = Vec::new();
    if lines.choice.design.is_none() {
        for name in table.varied().iter().filter(|name| **name != lines.over) {
            let words = table.words(table.find(name).unwrap_or(0))?;
            let unit = table.unit(name);
            let told = |row: &usize| match words[*row].parse::<f64>() {
                Ok(number) => Quantity::new("", unit).value(number),
                Err(_) => words[*row].clone(),
            };
            columns.push((name.clone(), rows.iter().map(told).collect()));
        }
        return Ok(columns);
    }
    let coordinates = Coordinates::read(table, rows, None)?;
    let along = coordinates.find(&lines.over).ok();
    if !coordinates.grid || along.is_none_or(|over| !coordinates.asked.contains(&over)) {
        return Ok(columns);
    }
    for k in coordinates
        .asked
        .iter()
        .copied()
        .filter(|k| Some(*k) != along)
    {
        let coordinate = coordinates.get(k);
        let levels = &coordinate.levels;
        let told = |row: usize| match levels.of_row[row] {
            Some(level) => format!("{} {}", levels.label(level), coordinate.unit),
            None => String::new(),
        };
        let words = (0..rows.len()).map(told).collect();
        columns.push((coordinate.name.clone(), words));
    }
    Ok(columns)
}
