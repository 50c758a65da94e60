//! The coordinates of a table's poses: of the output and of drives, and which of them were asked
//! for. What was not follows from the mechanism.

use std::collections::HashSet;

use hyperstat_mechanisms::nearest;

use super::labels::Labels;
use super::plane::Levels;
use super::rows::chosen;
use crate::plot_error::PlotError;
use crate::schema::{COORDINATES, unit};
use crate::table::TableReader;

/// Poses that a plane has on average where poses that fill no grid are told apart by planes.
const IN_A_PLANE: usize = 4;

/// The coordinates of the chosen rows of a table.
pub(super) struct Coordinates {
    /// x to rz, then drives.
    all: Vec<Coordinate>,
    /// Those that were asked for and differ from pose to pose, by place.
    pub(super) asked: Vec<usize>,
    /// Whether the poses are all combinations of the values of those.
    pub(super) grid: bool,
    /// Number of rows.
    pub(super) rows: usize,
}

/// A coordinate and its value at every row.
pub(super) struct Coordinate {
    pub(super) name: String,
    /// What it is called in the figure.
    pub(super) label: String,
    /// Its SI unit.
    pub(super) unit: &'static str,
    pub(super) levels: Levels,
}

impl Coordinates {
    /// Those of these rows; `asked` names the coordinates that the poses gave, where that is known.
    pub(super) fn read(
        table: &TableReader,
        rows: &[usize],
        asked: Option<&[String]>,
    ) -> Result<Self, PlotError> {
        let names = COORDINATES
            .map(String::from)
            .into_iter()
            .chain(table.drives());
        let names: Vec<String> = names.collect();
        let places: Vec<_> = names.iter().filter_map(|name| table.find(name)).collect();
        let columns = table.read(&places)?;
        let columns: Vec<_> = columns.iter().map(|column| chosen(column, rows)).collect();
        let size = |columns: &[Vec<Option<f64>>]| {
            let all = columns.iter().flatten().flatten();
            all.fold(0.0_f64, |size, value| size.max(value.abs()))
        };
        let space = size(&columns[..3]);
        let coordinates = names.into_iter().zip(&columns).map(|(name, column)| {
            let unit = unit(&name);
            // A turn is of the order of 1.
            let size = match unit {
                "m" => space.max(size(std::slice::from_ref(column))),
                _ => size(std::slice::from_ref(column)).max(1.0),
            };
            Coordinate {
                levels: Levels::new(column, size),
                label: name.clone(),
                name,
                unit,
            }
        });
        let mut coordinates = Self {
            all: coordinates.collect(),
            asked: Vec::new(),
            grid: false,
            rows: rows.len(),
        };
        (coordinates.asked, coordinates.grid) = coordinates.find_asked(asked);
        Ok(coordinates)
    }

    /// Finds which coordinates were asked for: those that are told; else those of fewest values
    /// of which the poses are all combinations; else all that there are. And whether these fill a
    /// grid.
    fn find_asked(&self, told: Option<&[String]>) -> (Vec<usize>, bool) {
        let varies = |k: &usize| self.levels(*k).values.len() > 1;
        let all = 0..self.all.len();
        if let Some(told) = told {
            let told = |k: &usize| told.contains(&self.all[*k].name);
            let asked: Vec<usize> = all.filter(varies).filter(told).collect();
            let grid = asked.len() > 1 && self.fill_a_grid(&asked);
            return (asked, grid);
        }
        let drives: Vec<usize> = (COORDINATES.len()..self.all.len()).filter(varies).collect();
        let candidates: Vec<usize> = match &*drives {
            // A table has columns of drives where these were given.
            [] => (all.clone())
                .filter(varies)
                .filter(|k| self.levels(*k).of_row.iter().all(Option::is_some))
                .collect(),
            _ => drives,
        };
        // Fewest values; of as many the most coordinates; evenly spaced ones; first ones.
        let rank = |choice: &Vec<usize>| {
            let values = |k: &usize| self.levels(*k).values.len();
            (
                choice.iter().map(values).sum::<usize>(),
                std::cmp::Reverse(choice.len()),
                (choice.iter()).filter(|k| !self.levels(**k).even()).count(),
                choice.clone(),
            )
        };
        let choices = (1_u64..1 << candidates.len().min(16)).map(|set| {
            let inside = |(place, _): &(usize, &usize)| (set >> place) & 1 == 1;
            let chosen = candidates.iter().enumerate().filter(inside);
            chosen.map(|(_, k)| *k).collect::<Vec<usize>>()
        });
        let filled = choices.filter(|choice| self.fill_a_grid(choice));
        match filled.min_by_key(rank) {
            Some(choice) if choice.len() > 1 => (choice, true),
            _ => (all.filter(varies).collect(), false),
        }
    }

    /// Whether the rows are all combinations of the values of these coordinates, each once.
    fn fill_a_grid(&self, coordinates: &[usize]) -> bool {
        let counts = coordinates.iter().map(|k| self.levels(*k).values.len());
        let all = counts.clone().try_fold(1_usize, usize::checked_mul);
        if all != Some(self.rows) {
            return false;
        }
        let mut seen = HashSet::with_capacity(self.rows);
        (0..self.rows).all(|row| {
            let place = (coordinates.iter().zip(counts.clone()))
                .try_fold(0, |place, (k, count)| {
                    Some(place * count + self.levels(*k).of_row[row]?)
                });
            place.is_some_and(|place| seen.insert(place))
        })
    }

    /// Number of coordinates.
    pub(super) fn len(&self) -> usize {
        self.all.len()
    }

    pub(super) fn get(&self, k: usize) -> &Coordinate {
        &self.all[k]
    }

    pub(super) fn levels(&self, k: usize) -> &Levels {
        &self.all[k].levels
    }

    /// Number of different values of a coordinate.
    pub(super) fn count(&self, k: usize) -> usize {
        self.levels(k).values.len()
    }

    pub(super) fn is_position(&self, k: usize) -> bool {
        k < 3
    }

    /// Their names.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.all.iter().map(|coordinate| &*coordinate.name)
    }

    /// Calls them as the labels say.
    pub(super) fn label(&mut self, labels: &Labels) {
        for coordinate in &mut self.all {
            coordinate.label = labels.of(&coordinate.name).into();
        }
    }

    /// The place of a coordinate by its name.
    pub(super) fn find(&self, name: &str) -> Result<usize, PlotError> {
        let place = self.names().position(|known| known == name);
        place.ok_or_else(|| unknown(name, self.names()))
    }

    /// Of the asked coordinates that are free, those that must be told apart by planes when a map
    /// is along two axes, fewest values first. `rows` is the number of poses that are left.
    pub(super) fn across(&self, free: &[usize], axes: [usize; 2], rows: usize) -> Vec<usize> {
        let mut others: Vec<usize> = (free.iter().copied())
            .filter(|k| !axes.contains(k))
            .collect();
        others.sort_by_key(|k| self.count(*k));
        if self.grid {
            // An axis that follows takes the place of one that was asked for.
            others.truncate(free.len().saturating_sub(2));
        } else {
            others.retain(|k| IN_A_PLANE * self.count(*k) <= rows);
        }
        others
    }

    /// The two coordinates that a map is along by itself.
    pub(super) fn axes(
        &self,
        free: &[usize],
        held: &[Option<usize>],
    ) -> Result<[usize; 2], PlotError> {
        let pairs = free.iter().enumerate().flat_map(|(place, first)| {
            let rest = free[place + 1..].iter();
            rest.map(move |second| [*first, *second])
        });
        // Of one unit where there are such; of most values; the first.
        let rank = |pair: &[usize; 2]| {
            let [a, b] = *pair;
            let same = self.get(a).unit == self.get(b).unit;
            let values = self.count(a).saturating_mul(self.count(b));
            (same, values, std::cmp::Reverse(*pair))
        };
        match pairs.max_by_key(rank) {
            Some(pair) if self.grid => Ok(pair),
            // Places in space where they differ, else whatever does.
            _ => {
                let mut others: Vec<usize> = (0..self.len())
                    .filter(|k| held[*k].is_none() && !free.contains(k))
                    .collect();
                let in_space = free.iter().any(|k| self.is_position(*k));
                let mut along: Vec<usize> = free.to_vec();
                along.append(&mut others);
                along.sort_by_key(|k| {
                    let aside = in_space && !self.is_position(*k);
                    (aside, !free.contains(k), self.count(*k) < 2, *k)
                });
                let [first, second, ..] = along[..] else {
                    return Err(PlotError::AllHeld);
                };
                Ok([first.min(second), first.max(second)])
            }
        }
    }

    /// Names of the asked coordinates, for messages.
    pub(super) fn asked_names(&self) -> Vec<String> {
        let name = |k: &usize| self.all[*k].name.clone();
        self.asked.iter().map(name).collect()
    }

    /// A coordinate at one of its values in words, as in `z = 0.5 m`.
    pub(super) fn place(&self, k: usize, level: usize) -> String {
        let Coordinate {
            label,
            unit,
            levels,
            ..
        } = self.get(k);
        format!("{label} = {} {unit}", levels.label(level))
    }
}

/// The error of a coordinate that poses have not.
pub(super) fn unknown<'n>(name: &str, known: impl Iterator<Item = &'n str>) -> PlotError {
    let known: Vec<&str> = known.collect();
    PlotError::NoCoordinate {
        name: name.into(),
        help: match nearest(name, &known) {
            Some(meant) => format!("did you mean `{meant}`?"),
            None => format!("those are {}", known.join(", ")),
        },
    }
}
