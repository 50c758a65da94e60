//! A quantity over planes of a table's poses.

use hyperstat_figures::{ColorScale, Extreme, MapFigure, MapPanel, Quantity, Samples};
use hyperstat_mechanisms::Commanded;

use super::coordinates::{Coordinates, unknown};
use super::labels::Labels;
use super::plane::Levels;
use super::quantity::Drawn;
use super::rows::{Choice, chosen};
use crate::plot_error::PlotError;
use crate::schema::COORDINATES;
use crate::table::{Column, TableReader};

/// Most planes side by side in a figure.
const MOST_PLANES: usize = 9;

/// A map that is asked for.
#[derive(Debug, Clone)]
pub struct Map {
    /// The quantity.
    pub value: String,
    /// Coordinates that are held on all planes, and at what.
    pub plane: Vec<(String, f64)>,
    /// Planes side by side, on each of which one of these is held besides, along axes of its own; without any,
    /// all planes that there are along the same axes.
    pub planes: Vec<(String, f64)>,
    /// Coordinates along the axes; two of those that were asked for, by default.
    pub axes: Option<[String; 2]>,
    /// Names of the coordinates that the poses were asked for by, where that is known.
    pub asked: Option<Vec<String>>,
    /// Where the colours begin and end, in the SI unit; else at the least and the largest value.
    pub limits: Option<[f64; 2]>,
    /// How colours go with values.
    pub scale: ColorScale,
    /// Which rows.
    pub choice: Choice,
    /// What is marked on each plane where it stands.
    pub marks: Vec<Extreme>,
    /// Title of the figure; else the name of the job.
    pub title: Option<String>,
    /// Names of the quantity and of coordinates in it.
    pub labels: Labels,
}

/// The poses of a table with a value each.
struct Poses {
    coordinates: Coordinates,
    values: Column,
}

/// Of every coordinate the level that it is held at.
type Held = Vec<Option<usize>>;

/// What a map shows of one table.
pub(super) struct Part {
    /// What is drawn, in words.
    words: String,
    /// Over what, in words.
    pub(super) over: Vec<String>,
    /// The coordinates that are held, and at what, in words.
    pub(super) held: Vec<String>,
    pub(super) axes: [Quantity; 2],
    /// The coordinates along the axes, where they are the same on all planes.
    pub(super) along: Option<[String; 2]>,
    pub(super) quantity: Quantity,
    pub(super) panels: Vec<MapPanel>,
}

/// The figure of a map.
///
/// # Errors
/// The table holds no such quantity, plane, axis, design or pose, several values at one place, or no
/// result there; or it cannot be read.
pub fn figure(table: &TableReader, map: &Map) -> Result<MapFigure, PlotError> {
    let part = Part::read(table, map)?;
    Ok(map.figure(part, || table.job()))
}

impl Part {
    /// What a map shows of a table.
    pub(super) fn read(table: &TableReader, map: &Map) -> Result<Self, PlotError> {
        let mut all: Option<Self> = None;
        for plane in &map.planes {
            let part = Self::along_axes(table, map, Some(plane))?;
            let Some(all) = &mut all else {
                all = Some(part);
                continue;
            };
            all.panels.extend(part.panels);
            all.along = None;
            let new = part.over.into_iter();
            let new: Vec<_> = new.filter(|words| !all.over.contains(words)).collect();
            all.over.extend(new);
        }
        match all {
            Some(all) => Ok(all),
            None => Self::along_axes(table, map, None),
        }
    }

    /// What it shows along the same axes everywhere, of the planes with one coordinate that is held besides where
    /// there is one.
    fn along_axes(
        table: &TableReader,
        map: &Map,
        own: Option<&(String, f64)>,
    ) -> Result<Self, PlotError> {
        let drawn = Drawn::of_table(&map.value, table)?;
        let rows = map.choice.rows(table)?;
        let mut poses = Poses {
            coordinates: Coordinates::read(table, &rows, map.asked.as_deref())?,
            values: chosen(&drawn.read(table)?, &rows),
        };
        let names: Vec<&str> = (poses.coordinates.names()).chain([&*map.value]).collect();
        map.labels.check(names.into_iter())?;
        poses.coordinates.label(&map.labels);
        let drawn = drawn.labelled(&map.labels);
        let coordinates = &poses.coordinates;
        let held = map.held(coordinates, own)?;
        let own = own.and_then(|(axis, _)| coordinates.find(axis).ok());
        let free: Vec<usize> = (coordinates.asked.iter().copied())
            .filter(|k| held[*k].is_none())
            .collect();
        let axes = map.axes(coordinates, &free, &held)?;
        let of_planes = poses.rows(&held).len();
        let others = coordinates.across(&free, axes, of_planes);
        let across = others.first().copied();
        let planes = match across {
            None => vec![None],
            Some(k) => {
                let shown = evenly(coordinates.count(k), MOST_PLANES).into_iter();
                shown.map(|level| Some((k, level))).collect()
            }
        };
        let axis = |k: usize| {
            let coordinate = coordinates.get(k);
            Quantity::new(&*coordinate.label, coordinate.unit)
        };
        let own_place = own.and_then(|k| Some(coordinates.place(k, held[k]?)));
        let mut panels = Vec::new();
        let mut lost = 0;
        for plane in &planes {
            let mut wanted = held.clone();
            if let Some((k, level)) = plane {
                wanted[*k] = Some(*level);
            }
            let mut rows = poses.rows(&wanted);
            let all = rows.len();
            rows.retain(|row| axes.iter().all(|k| poses.level(*k, *row).is_some()));
            lost += all - rows.len();
            panels.push(MapPanel {
                name: {
                    let across = plane.map(|(k, level)| coordinates.place(k, level));
                    let names = own_place.iter().cloned().chain(across);
                    names.collect::<Vec<_>>().join(", ")
                },
                axes: own.map(|_| axes.map(axis)),
                samples: poses.samples(&rows, axes, others.get(1..).unwrap_or_default())?,
            });
        }
        if !panels.iter().any(|panel| panel.samples.has_value()) {
            return Err(PlotError::Nothing {
                path: table.path().into(),
            });
        }
        let mut over: Vec<String> = map.choice.in_words(table).into_iter().collect();
        let mut held = poses.held_in_words(&held, axes);
        held.retain(|words| own_place.as_ref() != Some(words));
        over.extend(held.iter().cloned());
        if let Some(k) = across {
            let (all, shown) = (coordinates.count(k), planes.len());
            let name = &coordinates.get(k).label;
            over.push(match shown < all {
                true => format!("{shown} of {all} planes of {name}"),
                false => format!("{all} planes of {name}"),
            });
        }
        match lost {
            0 => {}
            1 => over.push("1 pose has no place here".into()),
            lost => over.push(format!("{lost} poses have no place here")),
        }
        Ok(Self {
            words: match drawn.words == drawn.quantity.name {
                true => drawn.words.clone(),
                false => format!("{}: {}", drawn.quantity.name, drawn.words),
            },
            over,
            held,
            axes: axes.map(axis),
            along: Some(axes.map(|k| coordinates.get(k).name.clone())),
            quantity: drawn.quantity,
            panels,
        })
    }

    /// What is drawn and over what, as a sentence; `and` is told of what is drawn.
    pub(super) fn subtitle(&self, and: &str) -> String {
        let over = match &*self.over {
            [] => String::new(),
            over => format!("; {}", over.join(", ")),
        };
        format!("{}{and}{over}.", self.words)
    }
}

impl Map {
    /// The figure of what it shows; `own` is the title that it has by itself.
    pub(super) fn figure(&self, part: Part, own: impl FnOnce() -> String) -> MapFigure {
        MapFigure {
            title: self.title.clone().unwrap_or_else(own),
            subtitle: part.subtitle(""),
            axes: part.axes,
            quantity: part.quantity,
            limits: self.limits,
            scale: self.scale,
            panels: part.panels,
            columns: None,
            marks: self.marks.clone(),
        }
    }

    /// That poses which give these coordinates have the planes and the axes.
    pub fn check(&self, commanded: &[Commanded]) -> Result<(), PlotError> {
        let names = || commanded.iter().map(|coordinate| &*coordinate.name);
        let all = || {
            let drives = names().filter(|name| !COORDINATES.contains(name));
            COORDINATES.into_iter().chain(drives)
        };
        let planes = self.plane.iter().chain(&self.planes).map(|(axis, _)| axis);
        for name in planes.chain(self.axes.iter().flatten()) {
            if !all().any(|known| known == name) {
                return Err(unknown(name, all()));
            }
        }
        self.labels.check(all().chain([&*self.value]))?;
        let twice = |(k, (axis, _)): &(usize, &(String, f64))| {
            let mut before = self.plane[..*k].iter().chain(&self.planes);
            before.any(|(other, _)| other == axis)
        };
        if let Some((_, (axis, _))) = self.plane.iter().enumerate().find(twice) {
            return Err(PlotError::HeldTwice { axis: axis.clone() });
        }
        for (axis, value) in self.plane.iter().chain(&self.planes) {
            let given = commanded.iter().find(|coordinate| coordinate.name == *axis);
            let Some(given) = given else {
                return Err(PlotError::Follows {
                    axis: axis.clone(),
                    asked: names().map(String::from).collect(),
                });
            };
            let values: Vec<_> = given.values.iter().copied().map(Some).collect();
            let size = given
                .values
                .iter()
                .fold(0.0_f64, |most, v| most.max(v.abs()));
            Levels::new(&values, size).asked(axis, *value)?;
            if self.axes.iter().flatten().any(|along| along == axis) {
                return Err(PlotError::AlongNormal { axis: axis.clone() });
            }
        }
        Ok(())
    }

    /// The levels of the coordinates that are held, one of them besides those of all planes.
    fn held(
        &self,
        coordinates: &Coordinates,
        own: Option<&(String, f64)>,
    ) -> Result<Held, PlotError> {
        let mut held = vec![None; coordinates.len()];
        for (axis, value) in self.plane.iter().chain(own) {
            let k = coordinates.find(axis)?;
            let follows = coordinates.grid && !coordinates.asked.contains(&k);
            if follows && coordinates.count(k) > 1 {
                return Err(PlotError::Follows {
                    axis: axis.clone(),
                    asked: coordinates.asked_names(),
                });
            }
            if held[k].is_some() {
                return Err(PlotError::HeldTwice { axis: axis.clone() });
            }
            held[k] = Some(coordinates.levels(k).asked(axis, *value)?);
        }
        Ok(held)
    }

    /// The coordinates along the axes.
    fn axes(
        &self,
        coordinates: &Coordinates,
        free: &[usize],
        held: &[Option<usize>],
    ) -> Result<[usize; 2], PlotError> {
        let axes = match &self.axes {
            Some([right, up]) => [coordinates.find(right)?, coordinates.find(up)?],
            None => coordinates.axes(free, held)?,
        };
        match axes.into_iter().find(|k| held[*k].is_some()) {
            Some(k) => Err(PlotError::AlongNormal {
                axis: coordinates.get(k).name.clone(),
            }),
            None => Ok(axes),
        }
    }
}

impl Poses {
    fn level(&self, coordinate: usize, row: usize) -> Option<usize> {
        self.coordinates.levels(coordinate).of_row[row]
    }

    /// The rows with these levels.
    fn rows(&self, wanted: &[Option<usize>]) -> Vec<usize> {
        let fits = |row: &usize| {
            let mut wanted = wanted.iter().enumerate();
            wanted.all(|(k, level)| level.is_none() || self.level(k, *row) == *level)
        };
        (0..self.values.len()).filter(fits).collect()
    }

    /// What all poses of a map along these axes have in common.
    fn held_in_words(&self, held: &[Option<usize>], axes: [usize; 2]) -> Vec<String> {
        let in_space = axes.iter().all(|k| self.coordinates.is_position(*k));
        let told = (0..self.coordinates.len()).filter_map(|k| {
            if let Some(level) = held[k] {
                return Some(self.coordinates.place(k, level));
            }
            let [only] = self.coordinates.levels(k).values[..] else {
                return None;
            };
            // A coordinate at home needs no words, but for the normal of a plane in space.
            let normal = in_space && self.coordinates.is_position(k);
            let told = !axes.contains(&k) && (only != 0.0 || normal);
            told.then(|| self.coordinates.place(k, 0))
        });
        told.collect()
    }

    /// What is known at these rows along two coordinates; a grid where they fill one. `others`
    /// differ from row to row, too.
    fn samples(
        &self,
        rows: &[usize],
        axes: [usize; 2],
        others: &[usize],
    ) -> Result<Samples, PlotError> {
        // Every row has a level here.
        let level = |axis: usize, row: usize| self.level(axes[axis], row).unwrap_or(0);
        let along = [0, 1].map(|axis| {
            let mut used: Vec<_> = rows.iter().map(|row| level(axis, *row)).collect();
            used.sort_unstable();
            used.dedup();
            used
        });
        let [across, up] = along.each_ref().map(Vec::len);
        let value = |axis: usize, level: usize| {
            let levels = self.coordinates.levels(axes[axis]);
            levels.values[level]
        };
        let place = |axis: usize, row: usize| {
            let level = level(axis, row);
            along[axis].partition_point(|known| *known < level)
        };
        let is_grid = across > 1 && up > 1 && across.saturating_mul(up) <= rows.len();
        if !is_grid {
            let at = |row: &usize| [0, 1].map(|axis| value(axis, level(axis, *row)));
            return Ok(Samples::Points {
                at: rows.iter().map(at).collect(),
                values: rows.iter().map(|row| self.values[*row]).collect(),
            });
        }
        let mut filled = vec![None; across * up];
        for &row in rows {
            let cell = &mut filled[place(0, row) + place(1, row) * across];
            if cell.is_some() {
                let name = |k: usize| self.coordinates.get(k).name.clone();
                return Err(PlotError::Several {
                    axes: axes.map(name),
                    at: [0, 1].map(|axis| {
                        let levels = self.coordinates.levels(axes[axis]);
                        levels.label(level(axis, row))
                    }),
                    differ: others.iter().map(|k| name(*k)).collect(),
                });
            }
            *cell = Some(self.values[row]);
        }
        let ticks = |axis: usize| {
            let levels = along[axis].iter();
            levels.map(|level| value(axis, *level)).collect()
        };
        Ok(Samples::Grid {
            x: ticks(0),
            y: ticks(1),
            values: filled.into_iter().map(Option::flatten).collect(),
        })
    }
}

/// Of so many places all, or `most` of them evenly from the first to the last.
pub(super) fn evenly(count: usize, most: usize) -> Vec<usize> {
    let shown = count.min(most);
    let last = shown.saturating_sub(1).max(1);
    (0..shown)
        .map(|k| (k * (count - 1) + last / 2) / last)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::evenly;

    #[test]
    fn planes_are_shown_evenly_with_both_ends() {
        assert_eq!(evenly(1, 9), [0]);
        assert_eq!(evenly(3, 9), [0, 1, 2]);
        assert_eq!(evenly(17, 9), [0, 2, 4, 6, 8, 10, 12, 14, 16]);
        let many = evenly(101, 9);
        assert_eq!((many.len(), many[0], many[8]), (9, 0, 100));
    }
}
