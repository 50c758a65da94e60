//! A quantity over planes of a table's poses.

use hyperstat_figures::{MapFigure, MapPanel, Quantity, Samples};

use super::error::PlotError;
use super::plane::{COORDINATES, Levels};
use super::quantity::Drawn;
use super::rows::{Choice, chosen};
use super::table::{Column, Table};

/// Most planes side by side in a figure.
const MOST_PLANES: usize = 9;

/// A map that is asked for.
#[derive(Debug, Clone)]
pub(crate) struct Map {
    pub(crate) value: String,
    /// Coordinates that are held, and at what.
    pub(crate) planes: Vec<(String, f64)>,
    /// Coordinates along the axes; those that are not held, by default.
    pub(crate) axes: Option<[String; 2]>,
    pub(crate) choice: Choice,
    pub(crate) title: Option<String>,
}

/// The poses of a table that have a place.
struct Poses {
    /// Values of each coordinate.
    levels: [Levels; 6],
    values: Column,
}

/// The figure of a map.
pub(crate) fn figure(table: &Table, map: &Map) -> Result<MapFigure, PlotError> {
    let drawn = Drawn::of_table(&map.value, table)?;
    let poses = Poses::read(table, &drawn, map.choice)?;
    let held = map.held(&poses)?;
    let axes = map.axes(&poses, &held)?;
    // What is neither held nor along an axis has a panel for each value, or is no matter.
    let free = (0..6).filter(|k| !axes.contains(k) && held[*k].is_none());
    let mut free = free.filter(|k| poses.levels[*k].values.len() > 1);
    let across = free.next();
    let others: Vec<usize> = free.collect();
    let (name, planes) = match across {
        None => (None, vec![None]),
        Some(k) => {
            let count = poses.levels[k].values.len();
            (Some(k), evenly(count).into_iter().map(Some).collect())
        }
    };
    let mut panels = Vec::new();
    for plane in &planes {
        let mut wanted = held;
        if let (Some(k), Some(level)) = (name, plane) {
            wanted[k] = Some(*level);
        }
        let rows = poses.rows(&wanted);
        let label = match (name, plane) {
            (Some(k), Some(level)) => place(k, poses.levels[k].values[*level]),
            _ => String::new(),
        };
        panels.push(MapPanel {
            name: label,
            samples: poses.samples(&rows, axes, &others)?,
        });
    }
    let has_value = |panel: &MapPanel| match &panel.samples {
        Samples::Grid { values, .. } | Samples::Points { values, .. } => {
            values.iter().any(Option::is_some)
        }
    };
    if !panels.iter().any(has_value) {
        return Err(PlotError::Nothing {
            path: table.path().into(),
        });
    }
    let mut over: Vec<String> = (0..6)
        .filter_map(|k| Some(place(k, poses.levels[k].values[held[k]?])))
        .collect();
    if held.iter().all(Option::is_none) && name.is_none() && axes.iter().all(|k| *k < 3) {
        // The only plane there is.
        let normal = 3 - axes[0] - axes[1];
        over.extend(
            poses.levels[normal]
                .values
                .first()
                .map(|v| place(normal, *v)),
        );
    }
    if let Some(k) = name {
        let all = poses.levels[k].values.len();
        let shown = planes.len();
        let count = if shown < all {
            format!("{shown} of {all} planes of {}", COORDINATES[k])
        } else {
            format!("{all} planes of {}", COORDINATES[k])
        };
        over.push(count);
    }
    let [first, second] = axes.map(|k| {
        let name = COORDINATES[k];
        Quantity::new(name, if k < 3 { "m" } else { "rad" })
    });
    let words = match drawn.words == drawn.quantity.name {
        true => drawn.words.clone(),
        false => format!("{}: {}", drawn.quantity.name, drawn.words),
    };
    let over = match &*over {
        [] => String::new(),
        over => format!("; {}", over.join(", ")),
    };
    Ok(MapFigure {
        title: map.title.clone().unwrap_or_else(|| table.job()),
        subtitle: format!("{words}{over}."),
        axes: [first, second],
        quantity: drawn.quantity,
        panels,
    })
}

impl Map {
    /// The level of each coordinate that is held.
    fn held(&self, poses: &Poses) -> Result<[Option<usize>; 6], PlotError> {
        let mut held = [None; 6];
        for (axis, value) in &self.planes {
            if let Some(k) = COORDINATES.iter().position(|name| name == axis) {
                held[k] = Some(poses.levels[k].asked(axis, *value)?);
            }
        }
        Ok(held)
    }

    /// The coordinates along the axes.
    fn axes(&self, poses: &Poses, held: &[Option<usize>; 6]) -> Result<[usize; 2], PlotError> {
        let axes = match &self.axes {
            Some(axes) => axes.each_ref().map(|axis| {
                COORDINATES
                    .iter()
                    .position(|name| name == axis)
                    .unwrap_or(0)
            }),
            None => {
                let count = |k: &usize| poses.levels[*k].values.len();
                // The two of most values, in the order of the coordinates; positions before
                // rotations.
                let mut free: Vec<usize> = (0..6).filter(|k| held[*k].is_none()).collect();
                free.sort_by_key(|k| (count(k) < 2, *k > 2, std::cmp::Reverse(count(k).min(2))));
                if held.iter().all(Option::is_none) && (0..3).all(|k| count(&k) > 1) {
                    let fewest = (0..3).rev().min_by_key(count).unwrap_or(2);
                    free.retain(|k| *k != fewest);
                }
                let mut axes = [free[0], free[1]];
                axes.sort_unstable();
                axes
            }
        };
        match axes.into_iter().find(|k| held[*k].is_some()) {
            Some(k) => Err(PlotError::AlongNormal {
                axis: COORDINATES[k].into(),
            }),
            None => Ok(axes),
        }
    }
}

impl Poses {
    fn read(table: &Table, drawn: &Drawn, choice: Choice) -> Result<Self, PlotError> {
        let places = COORDINATES.map(|name| table.find(name).unwrap_or(0));
        let coordinates = table.read(&places)?;
        let values = drawn.read(table)?;
        let rows = choice.rows(table)?;
        let columns: Vec<Column> = (coordinates.iter())
            .map(|column| chosen(column, &rows))
            .collect();
        let size = |kind: &[Column]| {
            let all = kind.iter().flatten().flatten();
            all.fold(0.0_f64, |size, value| size.max(value.abs()))
        };
        let sizes = [size(&columns[..3]), size(&columns[3..]).max(1.0)];
        Ok(Self {
            levels: std::array::from_fn(|k| Levels::new(&columns[k], sizes[k / 3])),
            values: chosen(&values, &rows),
        })
    }

    /// The rows with these levels.
    fn rows(&self, wanted: &[Option<usize>; 6]) -> Vec<usize> {
        let fits = |row: &usize| {
            let pairs = self.levels.iter().zip(wanted);
            pairs.into_iter().all(|(levels, wanted)| {
                wanted.is_none_or(|level| levels.of_row[*row] == Some(level))
            })
        };
        (0..self.values.len()).filter(fits).collect()
    }

    /// What is known at those of these rows that have a place along two coordinates; a grid where they
    /// fill one.
    fn samples(
        &self,
        rows: &[usize],
        axes: [usize; 2],
        others: &[usize],
    ) -> Result<Samples, PlotError> {
        let of_row = |k: usize, row: usize| self.levels[k].of_row[row];
        let has_place = |row: &usize| axes.iter().all(|k| of_row(*k, *row).is_some());
        let rows: Vec<usize> = rows.iter().copied().filter(has_place).collect();
        let along = axes.map(|k| {
            let used = rows.iter().filter_map(|row| of_row(k, *row));
            let mut used: Vec<_> = used.collect();
            used.sort_unstable();
            used.dedup();
            used
        });
        let [across, up] = along.each_ref().map(Vec::len);
        let value = |axis: usize, level: usize| self.levels[axes[axis]].values[level];
        let place = |axis: usize, row: usize| {
            let level = of_row(axes[axis], row);
            along[axis].partition_point(|known| Some(*known) < level)
        };
        let is_grid = across > 1 && up > 1 && across * up <= rows.len();
        if !is_grid {
            let at = |row: &usize| [0, 1].map(|axis| value(axis, along[axis][place(axis, *row)]));
            return Ok(Samples::Points {
                at: rows.iter().map(at).collect(),
                values: rows.iter().map(|row| self.values[*row]).collect(),
            });
        }
        let mut filled = vec![None; across * up];
        for &row in &rows {
            let cell = &mut filled[place(0, row) + place(1, row) * across];
            if cell.is_some() {
                return Err(PlotError::Several {
                    axes: axes.map(|k| COORDINATES[k].into()),
                    at: [0, 1].map(|axis| value(axis, along[axis][place(axis, row)])),
                    differ: others.iter().map(|k| COORDINATES[*k].into()).collect(),
                });
            }
            *cell = Some(self.values[row]);
        }
        let ticks = |axis: usize| {
            along[axis]
                .iter()
                .map(|level| value(axis, *level))
                .collect()
        };
        Ok(Samples::Grid {
            x: ticks(0),
            y: ticks(1),
            values: filled.into_iter().map(Option::flatten).collect(),
        })
    }
}

/// Places of the planes that are shown of so many: all, or evenly from the first to the last.
fn evenly(count: usize) -> Vec<usize> {
    let shown = count.min(MOST_PLANES);
    let last = shown.saturating_sub(1).max(1);
    (0..shown)
        .map(|k| (k * (count - 1) + last / 2) / last)
        .collect()
}

/// A plane in words, as in `z = 0.5 m`.
fn place(coordinate: usize, value: f64) -> String {
    let unit = if coordinate < 3 { "m" } else { "rad" };
    // Digits of the grid's arithmetic are not told.
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    format!("{} = {rounded} {unit}", COORDINATES[coordinate])
}

#[cfg(test)]
mod tests {
    use super::{evenly, place};

    #[test]
    fn planes_are_shown_evenly_with_both_ends() {
        assert_eq!(evenly(1), [0]);
        assert_eq!(evenly(3), [0, 1, 2]);
        assert_eq!(evenly(17), [0, 2, 4, 6, 8, 10, 12, 14, 16]);
        let many = evenly(101);
        assert_eq!((many.len(), many[0], many[8]), (9, 0, 100));
    }

    #[test]
    fn planes_are_named_by_round_numbers() {
        assert_eq!(place(2, 0.1 + 0.2), "z = 0.3 m");
        assert_eq!(place(3, -0.25), "rx = -0.25 rad");
    }
}
