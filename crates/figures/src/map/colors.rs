//! Colours of values, and the bar that tells them.

use colorous::VIRIDIS;
use plotters::style::RGBAColor;

use crate::canvas::{Canvas, Stroke};
use crate::error::FigureError;
use crate::geometry::Area;
use crate::page::fitted;
use crate::plane_axes::{TICK_LENGTH, Ticks};
use crate::quantity::{Quantity, Scaled};
use crate::style;

/// Number of shades from the least to the largest value.
const SHADES: usize = 64;

/// A range relative to the values' size that is taken as rounding, not as a field.
const FLAT: f64 = 1e-9;

/// The colours of a range of values.
#[derive(Debug)]
pub(super) struct Colors {
    /// Least and largest value.
    range: [f64; 2],
    name: String,
    scaled: Scaled,
    /// Values of the contours, with their prefix.
    ticks: Ticks,
}

impl Colors {
    /// The colours of values; `None` where there are none.
    pub(super) fn new(quantity: &Quantity, values: impl Iterator<Item = f64>) -> Option<Self> {
        let [least, most] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], v| {
            [least.min(v), most.max(v)]
        });
        if least > most {
            return None;
        }
        let largest = least.abs().max(most.abs());
        let range = if most - least > FLAT * largest {
            [least, most]
        } else {
            let around = if largest > 0.0 { 1e-2 * largest } else { 1.0 };
            [least - around, most + around]
        };
        let scaled = quantity.scaled(largest);
        Some(Self {
            range,
            name: quantity.name.clone(),
            ticks: Ticks::between(range.map(|end| end * scaled.factor), 8.0),
            scaled,
        })
    }

    /// The values from which each shade is used, ascending, with its colour; the first is below
    /// all values.
    pub(super) fn shades(&self) -> impl Iterator<Item = (f64, RGBAColor)> {
        let [least, most] = self.range;
        (0..SHADES).map(move |k| {
            let part = k as f64 / SHADES as f64;
            let level = if k == 0 {
                f64::NEG_INFINITY
            } else {
                least + part * (most - least)
            };
            (level, color(part + 0.5 / SHADES as f64))
        })
    }

    /// The colour of a value.
    pub(super) fn of(&self, value: f64) -> RGBAColor {
        color(self.part(value))
    }

    /// Values of the contours, each with its label and its stroke.
    pub(super) fn contours(&self) -> impl Iterator<Item = (f64, String, Stroke)> {
        self.ticks.values.iter().map(|tick| {
            let value = tick / self.scaled.factor;
            (value, self.ticks.label(*tick), self.stroke(value))
        })
    }

    fn stroke(&self, value: f64) -> Stroke {
        if self.part(value) > 0.45 {
            style::CONTOUR
        } else {
            style::CONTOUR_ON_DARK
        }
    }

    fn part(&self, value: f64) -> f64 {
        let [least, most] = self.range;
        ((value - least) / (most - least)).clamp(0.0, 1.0)
    }

    /// Draws the bar, with the name of the quantity above it over so much room to its left.
    pub(super) fn draw_bar(
        &self,
        canvas: &Canvas<'_>,
        bar: Area,
        name_room: f64,
    ) -> Result<(), FigureError> {
        let height = |part: f64| bar.bottom - part * (bar.bottom - bar.top);
        for (k, (_, color)) in self.shades().enumerate() {
            let from = height(k as f64 / SHADES as f64);
            let corners = [
                [bar.left, from],
                [bar.right, from],
                [bar.right, bar.top],
                [bar.left, bar.top],
            ];
            canvas.shade(&[corners.to_vec()], color);
        }
        for (value, label, stroke) in self.contours() {
            let y = height(self.part(value));
            canvas.line(&[[bar.left, y], [bar.right, y]], stroke)?;
            let beside = [bar.right + TICK_LENGTH, y];
            canvas.line(&[[bar.right, y], beside], style::AXIS)?;
            canvas.text(&label, [beside[0] + 5.0, y], style::TICK_RIGHT)?;
        }
        let frame = [
            [bar.left, bar.top],
            [bar.right, bar.top],
            [bar.right, bar.bottom],
            [bar.left, bar.bottom],
            [bar.left, bar.top],
        ];
        canvas.line(&frame, style::AXIS)?;
        let name = match &*self.scaled.unit {
            "" => self.name.clone(),
            unit => format!("{} ({unit})", self.name),
        };
        let above = [bar.left - name_room, bar.top - 17.0];
        let room = f64::from(crate::canvas::WIDTH) - crate::page::MARGIN - above[0];
        fitted(canvas, &name, above, room, style::AXIS_NAME_LEFT)
    }
}

fn color(part: f64) -> RGBAColor {
    let color = VIRIDIS.eval_continuous(part);
    RGBAColor(color.r, color.g, color.b, 1.0)
}
