//! Quantities of a table along its poses, or along one of its columns.

use hyperstat_figures::{Diagram, LineFigure, MOST_SERIES, Quantity, Series};

use super::error::PlotError;
use super::quantity::Drawn;
use super::rows::{Choice, chosen};
use super::table::Table;

/// Lines that are asked for.
#[derive(Debug, Clone)]
pub(crate) struct Lines {
    pub(crate) values: Vec<String>,
    /// The quantity along the lower axis.
    pub(crate) over: String,
    pub(crate) choice: Choice,
    pub(crate) title: Option<String>,
}

/// The figure of lines.
pub(crate) fn figure(table: &Table, lines: &Lines) -> Result<LineFigure, PlotError> {
    let over = Drawn::of_table(&lines.over, table)?;
    let drawn = lines.values.iter().map(|name| Drawn::of_table(name, table));
    let drawn: Vec<Drawn> = drawn.collect::<Result<_, _>>()?;
    let mut rows = lines.choice.rows(table)?;
    let along = over.read(table)?;
    rows.retain(|&row| along[row].is_some());
    let mut diagrams: Vec<Diagram> = Vec::new();
    for drawn in &drawn {
        let series = Series {
            name: drawn.quantity.name.clone(),
            values: chosen(&drawn.read(table)?, &rows),
        };
        let unit = &drawn.quantity.unit;
        let open =
            |diagram: &&mut Diagram| diagram.unit == *unit && diagram.series.len() < MOST_SERIES;
        match diagrams.iter_mut().find(open) {
            Some(diagram) => diagram.series.push(series),
            None => diagrams.push(Diagram {
                unit: unit.clone(),
                series: vec![series],
            }),
        }
    }
    let series = || diagrams.iter().flat_map(|diagram| &diagram.series);
    if !series().any(|series| series.values.iter().any(Option::is_some)) {
        return Err(PlotError::Nothing {
            path: table.path().into(),
        });
    }
    let words = |drawn: &Drawn| match drawn.words == drawn.quantity.name {
        true => drawn.words.clone(),
        false => format!("{}: {}", drawn.quantity.name, drawn.words),
    };
    let subtitle = match &*drawn {
        [one] => words(one),
        all => {
            let names: Vec<_> = all.iter().map(|drawn| &*drawn.quantity.name).collect();
            format!("{} over {}", names.join(", "), over.quantity.name)
        }
    };
    let at: Vec<f64> = chosen(&along, &rows).into_iter().flatten().collect();
    Ok(LineFigure {
        title: lines.title.clone().unwrap_or_else(|| table.job()),
        subtitle: format!("{subtitle}."),
        over: Quantity::new(over.quantity.name, over.quantity.unit),
        at,
        diagrams,
    })
}
