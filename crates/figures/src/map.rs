//! A quantity over a plane, or over several: a heat map with contours and a colour bar.

mod colors;
mod extremes;
mod layout;
mod panel;

use crate::error::FigureError;
use crate::page::Words;
use crate::quantity::Quantity;
use crate::{checks, png};
use colors::Colors;
use layout::Layout;

pub use extremes::Extreme;

/// A quantity over one plane or several of them side by side, in colours that are even to the eye
/// (viridis), with contours at round values and a colour bar.
///
/// Between the points of a grid the field is a smooth interpolation of them, which leaves their
/// values as they are and has no value inside a cell beyond those at its corners; nothing is drawn
/// beyond the grid. Points without a value are left white and marked, and so are the cells at them.
#[derive(Debug, Clone, PartialEq)]
pub struct MapFigure {
    /// Title of the figure.
    pub title: String,
    /// What is drawn, in words.
    pub subtitle: String,
    /// What is along the axes, to the right and up, of planes that have none of their own.
    pub axes: [Quantity; 2],
    /// What the colours mean.
    pub quantity: Quantity,
    /// The values, in the SI unit, at which the colours begin and end: what is beyond has the first
    /// or the last colour. `None`: the least and the largest value.
    pub limits: Option<[f64; 2]>,
    /// How the colours go from one end to the other.
    pub scale: ColorScale,
    /// The planes, one or more, all in the same colours, and to the same scale where they have the same axes.
    pub panels: Vec<MapPanel>,
    /// How many of them are beside each other; `None`: as many as there is room for.
    pub columns: Option<usize>,
    /// What is marked on each plane where it stands, with its value.
    pub marks: Vec<Extreme>,
}

/// How colours go with values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ColorScale {
    /// Logarithmic where all values are above zero and half of them would share a tenth of the
    /// colours; else linear.
    #[default]
    Auto,
    /// Evenly with the values.
    Linear,
    /// Evenly with their logarithms; the first value of the colours must be above zero.
    Log,
    /// Of ratios, above zero: evenly with their logarithms, in colours that part at 1, which is
    /// white, and go as far to either side.
    Ratio,
}

/// One plane of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct MapPanel {
    /// Which plane, as in `z = 0.5 m`; may be empty.
    pub name: String,
    /// What is along its axes, where that is not the same on all planes; planes of the same axes have the same
    /// ranges.
    pub axes: Option<[Quantity; 2]>,
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
    /// lengths, numbers that are not finite or too large to draw, a grid that does not ascend,
    /// limits that do not, and a logarithmic scale of what is not above zero.
    pub fn svg(&self) -> Result<String, FigureError> {
        for (k, panel) in self.panels.iter().enumerate() {
            panel.samples.check(&format!("panel {k}"))?;
        }
        let colors = Colors::new(self)?;
        let captions = self.captions();
        let layout = Layout::new(self, captions.len());
        let words = Words {
            title: &self.title,
            subtitle: &self.subtitle,
            captions: &captions,
        };
        Ok(words.svg(layout.height, |canvas| {
            for (panel, place) in self.panels.iter().zip(&layout.panels) {
                let marks = self.marked(panel);
                panel::draw(canvas, panel, place, (&colors, &marks));
            }
            colors.draw_bar(canvas, layout.bar, layout.name_room);
        }))
    }

    /// The figure as a PNG file.
    ///
    /// # Errors
    ///
    /// As [`svg`](Self::svg).
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        png::render(&self.svg()?)
    }

    /// The range of the values, what the colours do with it, how many points have none, and where
    /// the marked ones are, as sentences.
    #[must_use]
    pub fn caption(&self) -> String {
        self.captions().join(" ")
    }

    /// What is along the axes of a plane.
    fn axes_of<'f>(&'f self, panel: &'f MapPanel) -> &'f [Quantity; 2] {
        panel.axes.as_ref().unwrap_or(&self.axes)
    }

    /// The lines of the caption.
    fn captions(&self) -> Vec<String> {
        let marked = self.extremes_in_words();
        std::iter::once(self.range_in_words())
            .chain(marked)
            .collect()
    }

    fn range_in_words(&self) -> String {
        let all: usize = self.panels.iter().map(|panel| panel.samples.len()).sum();
        let count = self.found().count();
        let least = self.found().fold(f64::INFINITY, f64::min);
        let most = self.found().fold(f64::NEG_INFINITY, f64::max);
        let Quantity { name, .. } = &self.quantity;
        let told = |value| self.quantity.value(value);
        let mut caption = if count == 0 {
            format!("{name} has no value.")
        } else {
            format!("{name} from {} to {}.", told(least), told(most))
        };
        let logarithmic = Colors::new(self).is_ok_and(|colors| colors.logarithmic);
        let kind = match self.scale {
            ColorScale::Ratio => "Colours that part at 1",
            _ if logarithmic => "Logarithmic colours",
            _ => "Colours",
        };
        match self.limits {
            Some([low, high]) => {
                let [low, high] = match self.scale {
                    ColorScale::Ratio => colors::parted([low, high]),
                    _ => [low, high],
                };
                caption += &format!(" {kind} from {} to {}.", told(low), told(high));
            }
            None if logarithmic => caption += &format!(" {kind}."),
            None => {}
        }
        if count < all {
            let missing = all - count;
            caption += &format!(" {missing} of {all} poses without a result, marked ×.");
        }
        caption
    }

    /// All values that there are.
    fn found(&self) -> impl Iterator<Item = f64> {
        self.panels.iter().flat_map(|panel| panel.samples.found())
    }
}

impl Samples {
    /// Whether there is any value.
    #[must_use]
    pub fn has_value(&self) -> bool {
        self.found().next().is_some()
    }

    /// The values that there are.
    pub(crate) fn found(&self) -> impl Iterator<Item = f64> {
        self.values().iter().copied().flatten()
    }

    /// A value, or none, for every point.
    #[must_use]
    pub fn values(&self) -> &[Option<f64>] {
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
