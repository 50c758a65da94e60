//! Quantities along one variable: lines over an axis, quantities of one unit in one diagram.

use crate::canvas::{self, Canvas};
use crate::error::FigureError;
use crate::geometry::Area;
use crate::page::{MARGIN, Words, fitted};
use crate::plane_axes::PlaneAxes;
use crate::quantity::{Quantity, Scaled};
use crate::{checks, png, style};

/// Edges of the diagrams, and the upper edge of the first \[pixels\].
const LEFT: f64 = 84.0;
const RIGHT: f64 = 700.0;
const TOP: f64 = 116.0;

/// Distance of diagrams above each other, and room below the last \[pixels\].
const ABOVE: f64 = 44.0;
const BELOW: f64 = 92.0;

/// Quantities along one variable, as lines in diagrams above each other.
#[derive(Debug, Clone, PartialEq)]
pub struct LineFigure {
    /// Title of the figure.
    pub title: String,
    /// What is drawn, in words.
    pub subtitle: String,
    /// What is along the lower axis.
    pub over: Quantity,
    /// Its values, in SI units, one or more.
    pub at: Vec<f64>,
    /// The diagrams, one or more.
    pub diagrams: Vec<Diagram>,
}

/// Quantities of one unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagram {
    /// Their common SI unit, as in `N/m`; empty for numbers without unit.
    pub unit: String,
    /// The quantities, one to six.
    pub series: Vec<Series>,
}

/// A quantity along the variable.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Its name.
    pub name: String,
    /// A value for each place, in SI units; the line has a gap where there is none.
    pub values: Vec<Option<f64>>,
}

/// The most lines in a diagram that can be told apart.
pub const MOST_SERIES: usize = style::SERIES.len();

impl LineFigure {
    /// The figure as an SVG document.
    ///
    /// # Errors
    ///
    /// A [`FigureError`] for a figure without diagrams or points, lists of unequal lengths, and
    /// numbers that are not finite or too large to draw.
    pub fn svg(&self) -> Result<String, FigureError> {
        self.check()?;
        let count = self.diagrams.len() as f64;
        let each = (620.0 / count).clamp(130.0, 400.0);
        let height = (TOP + count * (each + ABOVE) - ABOVE + BELOW).ceil() as u32;
        let words = Words {
            title: &self.title,
            subtitle: &self.subtitle,
            captions: &[self.caption()],
        };
        words.svg(height, |canvas| {
            for (k, diagram) in self.diagrams.iter().enumerate() {
                let top = TOP + k as f64 * (each + ABOVE);
                let area = Area {
                    left: LEFT,
                    top,
                    right: RIGHT,
                    bottom: top + each,
                };
                self.draw(canvas, diagram, area, k + 1 == self.diagrams.len())?;
            }
            Ok(())
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

    /// The ranges of the quantities, as a sentence.
    #[must_use]
    pub fn caption(&self) -> String {
        let of = |unit: &str, series: &Series| {
            let [least, most] = range(series.values.iter().copied().flatten());
            if least > most {
                return format!("{} has no value", series.name);
            }
            let quantity = Quantity::new("", unit);
            let [least, most] = [least, most].map(|value| quantity.value(value));
            format!("{} from {least} to {most}", series.name)
        };
        let all = self.diagrams.iter().flat_map(|diagram| {
            let series = diagram.series.iter();
            series.map(|series| of(&diagram.unit, series))
        });
        all.collect::<Vec<_>>().join("; ") + "."
    }

    fn check(&self) -> Result<(), FigureError> {
        checks::numbers(&self.over.name, &self.at)?;
        let series = || self.diagrams.iter().flat_map(|diagram| &diagram.series);
        let found = || series().flat_map(|series| series.values.iter().flatten());
        if self.at.is_empty() || found().next().is_none() {
            return Err(FigureError::NoPoints {
                what: "diagram".into(),
            });
        }
        for diagram in &self.diagrams {
            if diagram.series.len() > MOST_SERIES {
                return Err(FigureError::TooManyLines {
                    lines: diagram.series.len(),
                    most: MOST_SERIES,
                });
            }
        }
        for Series { name, values } in series() {
            if values.len() != self.at.len() {
                return Err(FigureError::ValuesMismatch {
                    what: name.clone(),
                    points: self.at.len(),
                    values: values.len(),
                });
            }
            let found: Vec<f64> = values.iter().copied().flatten().collect();
            checks::numbers(name, &found)?;
        }
        Ok(())
    }

    fn draw(
        &self,
        canvas: &Canvas<'_>,
        diagram: &Diagram,
        area: Area,
        last: bool,
    ) -> Result<(), FigureError> {
        let (across, x) = axis(&self.over, self.at.iter().copied(), 0.0);
        let name = match &*diagram.series {
            [only] => only.name.clone(),
            all => {
                let names: Vec<_> = all.iter().map(|series| &*series.name).collect();
                names.join(", ")
            }
        };
        let found = diagram.series.iter().flat_map(|series| &series.values);
        let upright = Quantity::new(name, &*diagram.unit);
        let (upright, y) = axis(&upright, found.copied().flatten(), 0.06);
        let axes = PlaneAxes { area, x, y };
        axes.draw_grid(canvas)?;
        for (k, (series, stroke)) in diagram.series.iter().zip(style::SERIES).enumerate() {
            let at = self.at.iter().map(|x| x * across.factor);
            let points: Vec<_> = at
                .zip(&series.values)
                .map(|(x, y)| y.map(|y| axes.at([x, y * upright.factor])))
                .collect();
            for run in points.split(Option::is_none) {
                let run: Vec<_> = run.iter().copied().flatten().collect();
                match &*run {
                    [alone] => canvas.disc(*alone, 3.0, stroke.color)?,
                    _ => canvas.line(&run, stroke)?,
                }
            }
            let beside = [area.right + 22.0, area.top + 10.0 + 24.0 * k as f64];
            canvas.line(&[beside, [beside[0] + 34.0, beside[1]]], stroke)?;
            let text = [beside[0] + 46.0, beside[1]];
            let room = f64::from(canvas::WIDTH) - MARGIN - text[0];
            fitted(canvas, &series.name, text, room, style::LEGEND)?;
        }
        let below = last.then_some(&*across.label);
        axes.draw(canvas, [below, Some(&upright.label)])
    }
}

/// An axis for values, with so much air at its ends: its unit, and its ends in that unit.
fn axis(quantity: &Quantity, values: impl Iterator<Item = f64>, air: f64) -> (Scaled, [f64; 2]) {
    let [least, most] = match range(values) {
        [least, most] if least <= most => [least, most],
        _ => [0.0, 0.0],
    };
    let largest = least.abs().max(most.abs());
    let scaled = quantity.scaled(largest);
    let side = most - least;
    let air = if side > 1e-9 * largest {
        air * side
    } else if largest > 0.0 {
        0.01 * largest
    } else {
        1.0
    };
    let ends = [least - air, most + air].map(|end| end * scaled.factor);
    (scaled, ends)
}

/// The least and the largest value; the wrong way round where there is none.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold(
        [f64::INFINITY, f64::NEG_INFINITY],
        |[least, most], value| [least.min(value), most.max(value)],
    )
}
