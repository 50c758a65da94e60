//! Two axes in the plane of the page, with ticks, labels and names.

use crate::canvas::{Canvas, text_width};
use crate::error::FigureError;
use crate::geometry::{Area, PagePoint};
use crate::{numbers, round, style};

/// Length of a tick \[pixels\].
pub(crate) const TICK_LENGTH: f64 = 5.0;

/// Free space around letters \[pixels\].
const GAP: f64 = 5.0;

/// Round values on an axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Ticks {
    pub(crate) step: f64,
    pub(crate) values: Vec<f64>,
}

impl Ticks {
    /// Round values from `min` to `max`, at most about `most` of them.
    pub(crate) fn between([min, max]: [f64; 2], most: f64) -> Self {
        let step = round::up((max - min) / most.max(1.0)).unwrap_or(1.0);
        // The ends of a range of round numbers are meant although they are not quite met.
        let first = (min / step - 1e-9).ceil();
        let last = (max / step + 1e-9).floor();
        let count = (last - first).clamp(-1.0, 1000.0) as i64;
        let values = (0..=count).map(|k| (first + k as f64) * step).collect();
        Self { step, values }
    }

    pub(crate) fn label(&self, value: f64) -> String {
        numbers::tick(value, self.step)
    }
}

/// A rectangle on the page with a scale along x and one along y.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlaneAxes {
    pub(crate) area: Area,
    /// From the left to the right edge.
    pub(crate) x: [f64; 2],
    /// From the lower to the upper edge.
    pub(crate) y: [f64; 2],
}

impl PlaneAxes {
    /// Where a point is on the page.
    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> PagePoint {
        let Area {
            left,
            top,
            right,
            bottom,
        } = self.area;
        let part = |value: f64, [min, max]: [f64; 2]| (value - min) / (max - min);
        [
            left + part(x, self.x) * (right - left),
            bottom - part(y, self.y) * (bottom - top),
        ]
    }

    fn ticks(&self) -> [Ticks; 2] {
        let area = self.area;
        let upright = Ticks::between(self.y, (area.bottom - area.top) / 38.0);
        // As many as there is room for with the longest label.
        let mut most = (area.right - area.left) / 45.0;
        loop {
            let ticks = Ticks::between(self.x, most);
            let widths = ticks.values.iter().map(|value| {
                let label = ticks.label(*value);
                text_width(&label, style::TICK.size) + 2.0 * GAP
            });
            let room = (area.right - area.left) * ticks.step / (self.x[1] - self.x[0]);
            if widths.fold(0.0, f64::max) <= room || most < 1.5 {
                return [ticks, upright];
            }
            most *= 0.7;
        }
    }

    /// Draws lines at the ticks, under what is drawn next.
    pub(crate) fn draw_grid(&self, canvas: &Canvas<'_>) -> Result<(), FigureError> {
        let [across, upright] = self.ticks();
        for x in across.values {
            canvas.line(&self.y.map(|y| self.at([x, y])), style::GRID)?;
        }
        for y in upright.values {
            canvas.line(&self.x.map(|x| self.at([x, y])), style::GRID)?;
        }
        Ok(())
    }

    /// Draws the frame with its ticks, labels and the names of the axes that are given; an axis
    /// without a name has no labels.
    pub(crate) fn draw(
        &self,
        canvas: &Canvas<'_>,
        names: [Option<&str>; 2],
    ) -> Result<(), FigureError> {
        let Area {
            left,
            top,
            right,
            bottom,
        } = self.area;
        let [across, upright] = self.ticks();
        let frame = [
            [left, top],
            [right, top],
            [right, bottom],
            [left, bottom],
            [left, top],
        ];
        canvas.line(&frame, style::AXIS)?;
        for x in &across.values {
            let at = self.at([*x, self.y[0]]);
            canvas.line(&[at, [at[0], at[1] + TICK_LENGTH]], style::AXIS)?;
            if names[0].is_some() {
                let below = [at[0], at[1] + TICK_LENGTH + GAP + 0.5 * style::TICK.size];
                canvas.text(&across.label(*x), below, style::TICK)?;
            }
        }
        for y in &upright.values {
            let at = self.at([self.x[0], *y]);
            canvas.line(&[at, [at[0] - TICK_LENGTH, at[1]]], style::AXIS)?;
            if names[1].is_some() {
                let beside = [at[0] - TICK_LENGTH - GAP, at[1]];
                canvas.text(&upright.label(*y), beside, style::TICK_LEFT)?;
            }
        }
        if let Some(name) = names[0] {
            let below = bottom + TICK_LENGTH + 2.0 * GAP + 1.7 * style::TICK.size;
            canvas.text(name, [0.5 * (left + right), below], style::AXIS_NAME)?;
        }
        if let Some(name) = names[1] {
            let above = [left - TICK_LENGTH, top - 1.1 * style::AXIS_NAME.size];
            canvas.text(name, above, style::AXIS_NAME_LEFT)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Ticks;

    #[test]
    fn ticks_are_round_and_include_round_ends() {
        let labels = |range, most| {
            let ticks = Ticks::between(range, most);
            let labels: Vec<_> = ticks.values.iter().map(|v| ticks.label(*v)).collect();
            labels.join(" ")
        };
        assert_eq!(labels([-0.2, 0.2], 4.0), "−0.2 −0.1 0.0 0.1 0.2");
        assert_eq!(labels([0.1, 0.3], 2.0), "0.1 0.2 0.3");
        assert_eq!(labels([1.04, 1.96], 5.0), "1.2 1.4 1.6 1.8");
        assert_eq!(labels([0.0, 60.0], 6.0), "0 10 20 30 40 50 60");
    }
}
