//! The least and the largest values of a map: where they stand, and what is told of them.

use super::{MapFigure, MapPanel, Samples};

/// Values that differ by less than this part of their size are one: the first of them is marked.
const SAME: f64 = 1e-9;

/// A value that a map marks where it stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extreme {
    /// The least, by a triangle that points down.
    Least,
    /// The largest, by a triangle that points up.
    Most,
}

/// A value that is marked.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Marked {
    pub(super) of: Extreme,
    /// Along the axes, in SI units.
    pub(super) at: [f64; 2],
    pub(super) value: f64,
    /// The value with its unit.
    pub(super) label: String,
}

impl Extreme {
    fn sign(self) -> f64 {
        match self {
            Self::Least => 1.0,
            Self::Most => -1.0,
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::Least => "Least, ▼",
            Self::Most => "Largest, ▲",
        }
    }
}

impl MapFigure {
    /// What is marked, each once.
    fn asked_once(&self) -> impl Iterator<Item = &Extreme> {
        let marks = self.marks.iter().enumerate();
        let is_new = |(k, of): &(usize, &Extreme)| !self.marks[..*k].contains(of);
        marks.filter(is_new).map(|(_, of)| of)
    }

    /// What is marked on a plane.
    pub(super) fn marked(&self, panel: &MapPanel) -> Vec<Marked> {
        let marks = self.asked_once();
        let marked = marks.filter_map(|of| {
            let (at, value) = panel.samples.extreme(*of)?;
            Some(Marked {
                of: *of,
                at,
                value,
                label: self.quantity.value(value),
            })
        });
        marked.collect()
    }

    /// Where the least and the largest value of all planes are, of those that are marked.
    pub(super) fn extremes_in_words(&self) -> Option<String> {
        let told = self.asked_once().filter_map(|of| {
            let panels = self.panels.iter();
            let found = panels.filter_map(|panel| {
                let (at, value) = panel.samples.extreme(*of)?;
                Some((panel, at, value))
            });
            // The first of those that are least.
            let (panel, at, value) = found.min_by(|(.., a), (.., b)| {
                let [a, b] = [a, b].map(|value| of.sign() * value);
                a.total_cmp(&b)
            })?;
            let axes = self.axes_of(panel).iter().zip(at);
            let mut places: Vec<_> = axes
                .map(|(axis, at)| format!("{} = {}", axis.name, axis.value(at)))
                .collect();
            if !panel.name.is_empty() {
                places.push(panel.name.clone());
            }
            let value = self.quantity.value(value);
            Some(format!("{}: {value} at {}.", of.words(), places.join(", ")))
        });
        let told: Vec<String> = told.collect();
        (!told.is_empty()).then(|| told.join(" "))
    }
}

impl Samples {
    /// Where the least or the largest value is, the first of those that differ by rounding, and its
    /// value; `None` where there is no value.
    fn extreme(&self, of: Extreme) -> Option<([f64; 2], f64)> {
        let signed = || self.found().map(|value| of.sign() * value);
        let least = signed().min_by(f64::total_cmp)?;
        let nearly = |value: &f64| of.sign() * value - least <= SAME * least.abs();
        let mut found = self.values().iter().enumerate();
        let (place, value) =
            found.find_map(|(place, value)| Some((place, value.filter(&nearly)?)))?;
        let at = match self {
            Self::Grid { x, y, .. } => [x[place % x.len()], y[place / x.len()]],
            Self::Points { at, .. } => at[place],
        };
        Some((at, value))
    }
}
