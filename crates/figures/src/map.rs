//! A quantity over a plane, or over several: a heat map with contours and a colour bar.

mod colors;
mod layout;
mod panel;

use crate::error::FigureError;
use crate::page::Words;
use crate::quantity::Quantity;
use crate::{checks, png};
use colors::Colors;
use layout::Layout;

/// A quantity over one plane or several of them side by side, in colours that are even to the eye
/// (viridis), with contours at round values and a colour bar.
///
/// Between the points of a grid the field is linear; nothing is drawn beyond them. Points without
/// a value are left white and marked, and so are the cells at them.
#[derive(Debug, Clone, PartialEq)]
pub struct MapFigure {
    /// Title of the figure.
    pub title: String,
    /// What is drawn, in words.
    pub subtitle: String,
    /// What is along the axes, to the right and up.
    pub axes: [Quantity; 2],
    /// What the colours mean.
    pub quantity: Quantity,
    /// The planes, one or more, all drawn to the same scale and in the same colours.
    pub panels: Vec<MapPanel>,
}

/// One plane of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct MapPanel {
    /// Which plane, as in `z = 0.5 m`; may be empty.
    pub name: String,
    /// What is known on it.
    pub samples: Samples,
}

/// Values at points of a plane, in SI units; `None` where there is none.
#[derive(Debug, Clone, PartialEq)]
pub enum Samples {
    /// At all points of a grid.
    Grid {
        /// Coordinates to the right, ascending, two or more.
        x: Vec<f64>,
        /// Coordinates up, ascending, two or more.
        y: Vec<f64>,
        /// A value for each, x fastest.
        values: Vec<Option<f64>>,
    },
    /// At scattered points, drawn as dots.
    Points {
        /// Coordinates to the right and up, one point or more.
        at: Vec<[f64; 2]>,
        /// A value for each.
        values: Vec<Option<f64>>,
    },
}

impl MapFigure {
    /// The figure as an SVG document.
    ///
    /// # Errors
    ///
    /// A [`FigureError`] for a figure without panels or without any value, lists of unequal
    /// lengths, numbers that are not finite or too large to draw, and a grid that does not ascend.
    pub fn svg(&self) -> Result<String, FigureError> {
        for (k, panel) in self.panels.iter().enumerate() {
            panel.samples.check(&format!("panel {k}"))?;
        }
        let samples = || self.panels.iter().map(|panel| &panel.samples);
        let colors =
            Colors::new(&self.quantity, samples().flat_map(Samples::found)).ok_or_else(|| {
                FigureError::NoPoints {
                    what: "map".to_string(),
                }
            })?;
        let layout = Layout::new(&self.axes, &self.panels);
        let words = Words {
            title: &self.title,
            subtitle: &self.subtitle,
            captions: &[self.caption()],
        };
        words.svg(layout.height, |canvas| {
            for (panel, place) in self.panels.iter().zip(&layout.panels) {
                panel::draw(canvas, panel, place, &layout, &colors)?;
            }
            colors.draw_bar(canvas, layout.bar, layout.name_room)
        })
    }

    /// The figure as a PNG file.
    ///
    /// # Errors
    ///
    /// As [`svg`](Self::svg).
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        png::render(&self.svg()?)
    }

    /// The range of the values and how many points have none, as a sentence.
    #[must_use]
    pub fn caption(&self) -> String {
        let found = || self.panels.iter().flat_map(|panel| panel.samples.found());
        let all: usize = self.panels.iter().map(|panel| panel.samples.len()).sum();
        let count = found().count();
        let least = found().fold(f64::INFINITY, f64::min);
        let most = found().fold(f64::NEG_INFINITY, f64::max);
        let Quantity { name, .. } = &self.quantity;
        let mut caption = if count == 0 {
            format!("{name} has no value.")
        } else {
            let [least, most] = [least, most].map(|value| self.quantity.value(value));
            format!("{name} from {least} to {most}.")
        };
        if count < all {
            let missing = all - count;
            caption += &format!(" {missing} of {all} poses without a result, marked ×.");
        }
        caption
    }
}

impl Samples {
    /// The values that there are.
    pub(crate) fn found(&self) -> impl Iterator<Item = f64> {
        self.values().iter().copied().flatten()
    }

    fn values(&self) -> &[Option<f64>] {
        match self {
            Self::Grid { values, .. } | Self::Points { values, .. } => values,
        }
    }

    fn len(&self) -> usize {
        self.values().len()
    }

    fn check(&self, what: &str) -> Result<(), FigureError> {
        let points = match self {
            Self::Grid { x, y, .. } => {
                for (axis, ticks) in [("x", x), ("y", y)] {
                    let what = format!("{what}, {axis}");
                    checks::numbers(&what, ticks)?;
                    let ascends = ticks.windows(2).all(|pair| pair[0] < pair[1]);
                    if !ascends || ticks.len() < 2 {
                        return Err(FigureError::NoGrid { what });
                    }
                }
                x.len() * y.len()
            }
            Self::Points { at, .. } => {
                let all: Vec<f64> = at.iter().flatten().copied().collect();
                checks::numbers(what, &all)?;
                at.len()
            }
        };
        if points != self.len() {
            return Err(FigureError::ValuesMismatch {
                what: what.into(),
                points,
                values: self.len(),
            });
        }
        let found: Vec<f64> = self.found().collect();
        checks::numbers(&format!("{what}, values"), &found)
    }
}
