//! Quantities along one variable: lines over an axis, quantities of one unit in one diagram.

use crate::canvas::{Canvas, WIDTH, text_width};
use crate::error::FigureError;
use crate::geometry::Area;
use crate::page::{MARGIN, Words, fitted};
use crate::plane_axes::PlaneAxes;
use crate::quantity::{Quantity, Scaled};
use crate::{checks, png, style};

/// Left edge of the diagrams, and the upper edge of the first \[pixels\].
const LEFT: f64 = 84.0;
const TOP: f64 = 116.0;

/// The legend beside a diagram: its distance, a sample and the free space around it, and the room
/// for its words, least and most \[pixels\].
const BESIDE: f64 = 22.0;
const SAMPLE: f64 = 34.0;
const GAP: f64 = 12.0;
const WORDS: [f64; 2] = [104.0, 240.0];

/// Height of a line of the legend, and of a line of categories \[pixels\].
const LEGEND_LINE: f64 = 24.0;
const CATEGORY_LINE: f64 = 17.0;

/// Distance of diagrams above each other, and room below the last \[pixels\].
const ABOVE: f64 = 44.0;
const BELOW: f64 = 92.0;

/// A line through so many points or fewer has a dot at each.
const DOTTED: usize = 30;

/// Room of a category over which dots of several series stand beside each other.
const APART: f64 = 0.5;

/// Quantities along one variable, as lines in diagrams above each other; over categories as dots.
#[derive(Debug, Clone, PartialEq)]
pub struct LineFigure {
    /// Title of the figure.
    pub title: String,
    /// What is drawn, in words.
    pub subtitle: String,
    /// What is along the lower axis.
    pub over: Quantity,
    /// Names of what is along the lower axis where it is no number: a place there is the number of
    /// one of them, from 0. Empty where it is a number.
    pub categories: Vec<String>,
    /// The diagrams, one or more.
    pub diagrams: Vec<Diagram>,
}

/// Quantities of one unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagram {
    /// What is along its upright axis.
    pub name: String,
    /// Its SI unit, as in `N/m`; empty for numbers without unit.
    pub unit: String,
    /// What tells the series apart, over the legend; empty where that is their quantity.
    pub legend: String,
    /// One to [`MOST_SERIES`].
    pub series: Vec<Series>,
}

/// A quantity along the variable.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Its name.
    pub name: String,
    /// Places along the lower axis, in SI units.
    pub at: Vec<f64>,
    /// A value for each of them, in SI units; the line has a gap where there is none.
    pub values: Vec<Option<f64>>,
}

/// The most lines in a diagram that can be told apart.
pub const MOST_SERIES: usize = style::SERIES.len();

impl LineFigure {
    /// The figure as an SVG document.
    ///
    /// # Errors
    ///
    /// A [`FigureError`] for a figure without diagrams or points, lists of unequal lengths, places
    /// that are no category, and numbers that are not finite or too large to draw.
    pub fn svg(&self) -> Result<String, FigureError> {
        self.check()?;
        let count = self.diagrams.len() as f64;
        let each = (620.0 / count).clamp(130.0, 400.0);
        let right = self.right();
        let area = |k: usize| {
            let top = TOP + k as f64 * (each + ABOVE);
            Area {
                left: LEFT,
                top,
                right,
                bottom: top + each,
            }
        };
        let across = self.across();
        let lines = PlaneAxes {
            area: area(0),
            x: across.1,
            y: [0.0, 1.0],
        }
        .category_lines(&self.categories);
        let categories = CATEGORY_LINE * lines.saturating_sub(1) as f64;
        let height = TOP + count * (each + ABOVE) - ABOVE + BELOW + categories;
        let words = Words {
            title: &self.title,
            subtitle: &self.subtitle,
            captions: &[self.caption()],
        };
        Ok(words.svg(height.ceil() as u32, |canvas| {
            for (k, diagram) in self.diagrams.iter().enumerate() {
                let last = k + 1 == self.diagrams.len();
                self.draw(canvas, diagram, area(k), &across, last);
            }
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

    /// The ranges of the quantities, as a sentence.
    #[must_use]
    pub fn caption(&self) -> String {
        let of = |unit: &str, name: &str, [least, most]: [f64; 2]| {
            if least > most {
                return format!("{name} has no value");
            }
            let quantity = Quantity::new("", unit);
            let [least, most] = [least, most].map(|value| quantity.value(value));
            format!("{name} from {least} to {most}")
        };
        let told = |diagram: &Diagram| -> Vec<String> {
            let series = diagram.series.iter();
            match &*diagram.legend {
                "" => series
                    .map(|series| of(&diagram.unit, &series.name, range(series.found())))
                    .collect(),
                _ => vec![of(
                    &diagram.unit,
                    &diagram.name,
                    range(series.flat_map(Series::found)),
                )],
            }
        };
        let all: Vec<_> = self.diagrams.iter().flat_map(told).collect();
        all.join("; ") + "."
    }

    fn series(&self) -> impl Iterator<Item = &Series> {
        self.diagrams.iter().flat_map(|diagram| &diagram.series)
    }

    fn check(&self) -> Result<(), FigureError> {
        if self.series().flat_map(Series::found).next().is_none() {
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
        let count = self.categories.len();
        let is_category = |place: &f64| (0..count).any(|k| k as f64 == *place);
        for series in self.series() {
            let Series { name, at, values } = series;
            if values.len() != at.len() {
                return Err(FigureError::ValuesMismatch {
                    what: name.clone(),
                    points: at.len(),
                    values: values.len(),
                });
            }
            checks::numbers(&format!("{name}, {}", self.over.name), at)?;
            checks::numbers(name, &series.found().collect::<Vec<_>>())?;
            let place = at.iter().position(|place| count > 0 && !is_category(place));
            if let Some(index) = place {
                return Err(FigureError::NoCategory {
                    what: name.clone(),
                    index,
                    value: at[index],
                    count,
                });
            }
        }
        Ok(())
    }

    /// The lower axis: its unit, and its ends in that unit.
    fn across(&self) -> (Scaled, [f64; 2]) {
        let count = self.categories.len();
        if count > 0 {
            return (self.over.scaled(0.0), [-0.5, count as f64 - 0.5]);
        }
        let at = self.series().flat_map(|series| &series.at);
        axis(&self.over, at.copied(), 0.0)
    }

    /// Right edge of the diagrams, which leaves the legend the room it needs.
    fn right(&self) -> f64 {
        let series = self.series().map(|series| &series.name);
        let headings = self.diagrams.iter().map(|diagram| &diagram.legend);
        let width = |text: &String| text_width(text, style::LEGEND.size);
        let words = series.map(width).fold(0.0, f64::max);
        let heading = headings.map(width).fold(0.0, f64::max) - SAMPLE - GAP;
        let [least, most] = WORDS;
        let room = words.max(heading).clamp(least, most);
        f64::from(WIDTH) - MARGIN - room - GAP - SAMPLE - BESIDE
    }

    fn draw(
        &self,
        canvas: &mut Canvas,
        diagram: &Diagram,
        area: Area,
        (across, x): &(Scaled, [f64; 2]),
        last: bool,
    ) {
        let upright = Quantity::new(&*diagram.name, &*diagram.unit);
        let found = diagram.series.iter().flat_map(Series::found);
        let (upright, y) = axis(&upright, found, 0.06);
        let axes = PlaneAxes { area, x: *x, y };
        let names = [last.then_some(&*across.label), Some(&*upright.label)];
        let by_category = !self.categories.is_empty();
        if by_category {
            axes.draw_levels(canvas);
        } else {
            axes.draw_grid(canvas);
        }
        let count = diagram.series.len() as f64;
        for (k, (series, stroke)) in diagram.series.iter().zip(style::SERIES).enumerate() {
            // Dots of one category stand beside each other.
            let aside = match by_category {
                true => APART * ((k as f64 + 0.5) / count - 0.5),
                false => 0.0,
            };
            let points =
                series.at.iter().zip(&series.values).map(|(x, y)| {
                    y.map(|y| axes.at([x * across.factor + aside, y * upright.factor]))
                });
            let points: Vec<_> = points.collect();
            let dotted = by_category || points.len() <= DOTTED;
            for run in points.split(Option::is_none) {
                let run: Vec<_> = run.iter().copied().flatten().collect();
                if !by_category {
                    canvas.line(&run, stroke);
                }
                if dotted || run.len() == 1 {
                    for at in run {
                        canvas.disc(at, style::DOT, stroke.color);
                    }
                }
            }
        }
        self.draw_legend(canvas, diagram, area);
        match by_category {
            true => axes.draw_categories(canvas, names, &self.categories),
            false => axes.draw(canvas, names),
        }
    }

    fn draw_legend(&self, canvas: &mut Canvas, diagram: &Diagram, area: Area) {
        let mut at = [area.right + BESIDE, area.top + 10.0];
        let room = f64::from(WIDTH) - MARGIN;
        if !diagram.legend.is_empty() {
            let room = room - at[0];
            fitted(canvas, &diagram.legend, at, room, style::LEGEND);
            at[1] += LEGEND_LINE;
        }
        for (series, stroke) in diagram.series.iter().zip(style::SERIES) {
            if self.categories.is_empty() {
                canvas.line(&[at, [at[0] + SAMPLE, at[1]]], stroke);
            } else {
                let middle = [at[0] + 0.5 * SAMPLE, at[1]];
                canvas.disc(middle, style::DOT, stroke.color);
            }
            let text = [at[0] + SAMPLE + GAP, at[1]];
            fitted(canvas, &series.name, text, room - text[0], style::LEGEND);
            at[1] += LEGEND_LINE;
        }
    }
}

impl Series {
    /// The values that there are.
    fn found(&self) -> impl Iterator<Item = f64> {
        self.values.iter().copied().flatten()
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
