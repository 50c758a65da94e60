//! Shares of a whole as horizontal bars, in groups that share one scale.

use crate::canvas::{self, Canvas, text_width};
use crate::error::FigureError;
use crate::geometry::{Area, PagePoint};
use crate::page::{CAPTION_LINE, MARGIN, Words, fitted};
use crate::plane_axes::{TICK_LENGTH, Ticks};
use crate::quantity::Quantity;
use crate::{checks, numbers, png, style};

/// Upper edge of the first group, whose heading is above it \[pixels\].
const TOP: f64 = 118.0;
/// Height of a row, and of the bar in it \[pixels\].
const ROW: f64 = 24.0;
const BAR: f64 = 15.0;
/// Distance of groups above each other, and room for the axis below the last \[pixels\].
const ABOVE: f64 = 44.0;
const BELOW: f64 = 92.0;
/// Room for the names, at least and at most, and for a value to the right \[pixels\].
const NAMES: [f64; 2] = [70.0, 240.0];
const VALUES: f64 = 110.0;
/// Free space beside letters \[pixels\].
const GAP: f64 = 8.0;

/// Shares of a whole, in one division of it or several.
///
/// A bar reaches from zero to the right; the bar of a part against the whole, of a negative share,
/// to the left and in another colour. All groups have the same scale.
#[derive(Debug, Clone, PartialEq)]
pub struct BarFigure {
    /// Title of the figure.
    pub title: String,
    /// What is drawn, in words.
    pub subtitle: String,
    /// What the whole is.
    pub quantity: Quantity,
    /// The whole, in its SI unit; not zero.
    pub total: f64,
    /// The divisions, one or more.
    pub groups: Vec<BarGroup>,
}

/// One division of the whole.
#[derive(Debug, Clone, PartialEq)]
pub struct BarGroup {
    /// By what it is divided.
    pub name: String,
    /// The parts, from above; one or more.
    pub bars: Vec<Bar>,
}

/// A part of the whole.
#[derive(Debug, Clone, PartialEq)]
pub struct Bar {
    /// Whose part it is.
    pub name: String,
    /// The part, in the SI unit of the whole.
    pub value: f64,
}

/// Where everything is on the page.
struct Layout {
    height: u32,
    /// The bars of all groups, without names and values.
    area: Area,
    /// Shares at the left and the right edge \[%\].
    ends: [f64; 2],
    ticks: Ticks,
}

impl BarFigure {
    /// The figure as an SVG document.
    ///
    /// # Errors
    ///
    /// A [`FigureError`] for a figure without groups or bars, a whole that is zero, and numbers
    /// that are not finite or too large to draw.
    pub fn svg(&self) -> Result<String, FigureError> {
        self.check()?;
        let captions = self.captions();
        let layout = self.layout(captions.len());
        let words = Words {
            title: &self.title,
            subtitle: &self.subtitle,
            captions: &captions,
        };
        Ok(words.svg(layout.height, |canvas| {
            let mut top = TOP;
            for group in &self.groups {
                top = self.draw(canvas, group, &layout, top) + ABOVE;
            }
            layout.draw_axis(canvas);
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

    /// The whole, and what a negative share means, as sentences.
    #[must_use]
    pub fn caption(&self) -> String {
        self.captions().join(" ")
    }

    fn captions(&self) -> Vec<String> {
        let Quantity { name, .. } = &self.quantity;
        let whole = format!("100 % is a {name} of {}.", self.quantity.value(self.total));
        let against = self.bars().any(|bar| self.share(bar) < 0.0);
        let negative = "Negative shares, to the left, are of parts that move it the other way.";
        std::iter::once(whole)
            .chain(against.then(|| negative.into()))
            .collect()
    }

    fn bars(&self) -> impl Iterator<Item = &Bar> {
        self.groups.iter().flat_map(|group| &group.bars)
    }

    /// \[%\]
    fn share(&self, bar: &Bar) -> f64 {
        100.0 * bar.value / self.total
    }

    fn check(&self) -> Result<(), FigureError> {
        checks::numbers(&self.quantity.name, &[self.total])?;
        if self.total == 0.0 {
            return Err(FigureError::NoWhole {
                what: self.quantity.name.clone(),
            });
        }
        let empty = self.groups.iter().find(|group| group.bars.is_empty());
        if self.groups.is_empty() || empty.is_some() {
            return Err(FigureError::NoPoints {
                what: empty.map_or_else(|| "bars".into(), |group| group.name.clone()),
            });
        }
        let values: Vec<f64> = self.bars().map(|bar| bar.value).collect();
        checks::numbers(&self.quantity.name, &values)?;
        let shares: Vec<f64> = self.bars().map(|bar| self.share(bar)).collect();
        checks::numbers("shares", &shares)
    }

    fn layout(&self, captions: usize) -> Layout {
        let widths = self
            .bars()
            .map(|bar| text_width(&bar.name, style::BAR_NAME.size));
        let names = widths.fold(NAMES[0], f64::max).min(NAMES[1]);
        let rows: usize = self.groups.iter().map(|group| group.bars.len()).sum();
        let between = ABOVE * (self.groups.len() - 1) as f64;
        let bottom = TOP + rows as f64 * ROW + between;
        let shares = || self.bars().map(|bar| self.share(bar));
        let [least, most] = shares().fold([0.0_f64; 2], |[least, most], share| {
            [least.min(share), most.max(share)]
        });
        // The longest label has room to the right of the longest bar.
        let labels = shares().map(|share| text_width(&percent(share), style::BAR_LABEL.size));
        let label = labels.fold(0.0, f64::max) + 2.0 * GAP;
        let left = MARGIN + names + GAP;
        let right = f64::from(canvas::WIDTH) - MARGIN - VALUES;
        let used = (right - left - label).max(0.4 * (right - left));
        let scale = (most - least) / used;
        let ends = [least, least + scale * (right - left)];
        let ticks = Ticks::between(ends, (right - left) / 70.0);
        Layout {
            height: (bottom + BELOW + CAPTION_LINE * (captions - 1) as f64).ceil() as u32,
            area: Area {
                left,
                top: TOP,
                right,
                bottom,
            },
            ends,
            ticks,
        }
    }

    /// Draws a group from `top` on, and gives where it ends.
    fn draw(&self, canvas: &mut Canvas, group: &BarGroup, layout: &Layout, top: f64) -> f64 {
        let area = layout.area;
        let bottom = top + ROW * group.bars.len() as f64;
        let heading = top - 13.0;
        let scaled = self.quantity.scaled(self.total);
        let right = f64::from(canvas::WIDTH) - MARGIN;
        let room = area.right - MARGIN;
        fitted(canvas, &group.name, [MARGIN, heading], room, style::GROUP);
        canvas.text(&scaled.unit, [right, heading], style::TICK_LEFT);
        for tick in &layout.ticks.values {
            let x = layout.x(*tick);
            canvas.line(&[[x, top], [x, bottom]], style::GRID);
        }
        for (row, bar) in group.bars.iter().enumerate() {
            let middle = top + ROW * (row as f64 + 0.5);
            let share = self.share(bar);
            let ends = [layout.x(share.min(0.0)), layout.x(share.max(0.0))];
            let fill = match share < 0.0 {
                true => style::BAR_AGAINST,
                false => style::BAR,
            };
            let [above, below] = [middle - 0.5 * BAR, middle + 0.5 * BAR];
            let corners = [
                [ends[0], above],
                [ends[1], above],
                [ends[1], below],
                [ends[0], below],
            ];
            canvas.polygon(&corners, fill);
            let name = [area.left - GAP, middle];
            let room = area.left - GAP - MARGIN;
            fitted(canvas, &bar.name, name, room, style::BAR_NAME);
            label(canvas, &percent(share), [ends[1] + GAP, middle]);
            let value = numbers::tick(bar.value * scaled.factor, step(self.total * scaled.factor));
            canvas.text(&value, [right, middle], style::TICK_LEFT);
        }
        let zero = layout.x(0.0);
        canvas.line(&[[zero, top], [zero, bottom]], style::AXIS);
        bottom
    }
}

/// Draws a label that starts at a point, on white: the lines of the grid stop at it.
fn label(canvas: &mut Canvas, text: &str, [x, y]: PagePoint) {
    let (width, height) = (
        text_width(text, style::BAR_LABEL.size),
        style::BAR_LABEL.size,
    );
    let [left, right] = [x - 2.0, x + width];
    let [above, below] = [y - 0.6 * height, y + 0.6 * height];
    let ground = [[left, above], [right, above], [right, below], [left, below]];
    canvas.polygon(&ground, style::WHITE);
    canvas.text(text, [x, y], style::BAR_LABEL);
}

impl Layout {
    /// Where a share is across the page.
    fn x(&self, share: f64) -> f64 {
        let [least, most] = self.ends;
        let part = (share - least) / (most - least);
        self.area.left + part * (self.area.right - self.area.left)
    }

    /// Draws the axis below the last group.
    fn draw_axis(&self, canvas: &mut Canvas) {
        let bottom = self.area.bottom;
        let line = [[self.area.left, bottom], [self.area.right, bottom]];
        canvas.line(&line, style::AXIS);
        for tick in &self.ticks.values {
            let x = self.x(*tick);
            canvas.line(&[[x, bottom], [x, bottom + TICK_LENGTH]], style::AXIS);
            let below = [x, bottom + TICK_LENGTH + GAP + 3.0];
            canvas.text(&self.ticks.label(*tick), below, style::TICK);
        }
        let name = [
            0.5 * (self.area.left + self.area.right),
            bottom + TICK_LENGTH + 34.0,
        ];
        canvas.text("share (%)", name, style::AXIS_NAME);
    }
}

/// A share with one decimal.
fn percent(share: f64) -> String {
    format!("{} %", numbers::tick(share, 0.1))
}

/// What the last digit of values counts where the largest is about so large: four digits.
fn step(largest: f64) -> f64 {
    10_f64.powf(largest.abs().log10().floor() - 3.0)
}
