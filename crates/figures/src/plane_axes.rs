//! Two axes in the plane of the page, with ticks, labels and names.

use crate::canvas::{Canvas, text_width};
use crate::geometry::{Area, PagePoint};
use crate::page::fitted;
use crate::{numbers, round, style};

/// Length of a tick \[pixels\].
pub(crate) const TICK_LENGTH: f64 = 5.0;

/// Height of a line of labels over that of their letters, and most lines of one label.
const LINE: f64 = 1.3;
const MOST_LINES: usize = 4;

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
    pub(crate) fn draw_grid(&self, canvas: &mut Canvas) {
        let [across, _] = self.ticks();
        for x in across.values {
            canvas.line(&self.y.map(|y| self.at([x, y])), style::GRID);
        }
        self.draw_levels(canvas);
    }

    /// Draws lines at the ticks of the upright axis alone.
    pub(crate) fn draw_levels(&self, canvas: &mut Canvas) {
        let [_, upright] = self.ticks();
        for y in upright.values {
            canvas.line(&self.x.map(|x| self.at([x, y])), style::GRID);
        }
    }

    /// Draws the frame with its ticks, labels and the names of the axes that are given; an axis
    /// without a name has no labels.
    pub(crate) fn draw(&self, canvas: &mut Canvas, names: [Option<&str>; 2]) {
        let [across, _] = self.ticks();
        self.draw_frame(canvas, names[1]);
        for x in &across.values {
            let at = self.at([*x, self.y[0]]);
            canvas.line(&[at, [at[0], at[1] + TICK_LENGTH]], style::AXIS);
            if names[0].is_some() {
                let below = [at[0], at[1] + TICK_LENGTH + GAP + 0.5 * style::TICK.size];
                canvas.text(&across.label(*x), below, style::TICK);
            }
        }
        if let Some(name) = names[0] {
            self.draw_name_below(canvas, name, 1);
        }
    }

    /// As [`draw`](Self::draw), with categories along the lower axis: number k is at x = k.
    pub(crate) fn draw_categories(
        &self,
        canvas: &mut Canvas,
        names: [Option<&str>; 2],
        categories: &[String],
    ) {
        self.draw_frame(canvas, names[1]);
        let room = self.category_room(categories.len());
        for (k, category) in categories.iter().enumerate() {
            let at = self.at([k as f64, self.y[0]]);
            canvas.line(&[at, [at[0], at[1] + TICK_LENGTH]], style::AXIS);
            if names[0].is_none() {
                continue;
            }
            for (line, text) in wrapped(category, room).iter().enumerate() {
                let below = TICK_LENGTH + GAP + (0.5 + LINE * line as f64) * style::TICK.size;
                fitted(canvas, text, [at[0], at[1] + below], room, style::TICK);
            }
        }
        if let Some(name) = names[0] {
            self.draw_name_below(canvas, name, self.category_lines(categories));
        }
    }

    /// Number of lines that the labels of categories take.
    pub(crate) fn category_lines(&self, categories: &[String]) -> usize {
        let room = self.category_room(categories.len());
        let lines = categories.iter().map(|text| wrapped(text, room).len());
        lines.max().unwrap_or(1)
    }

    /// Room for the label of one of so many categories \[pixels\].
    fn category_room(&self, count: usize) -> f64 {
        (self.area.right - self.area.left) / count.max(1) as f64 - 2.0 * GAP
    }

    /// Draws the frame and the upright axis.
    fn draw_frame(&self, canvas: &mut Canvas, name: Option<&str>) {
        let Area {
            left,
            top,
            right,
            bottom,
        } = self.area;
        let [_, upright] = self.ticks();
        let frame = [
            [left, top],
            [right, top],
            [right, bottom],
            [left, bottom],
            [left, top],
        ];
        canvas.line(&frame, style::AXIS);
        for y in &upright.values {
            let at = self.at([self.x[0], *y]);
            canvas.line(&[at, [at[0] - TICK_LENGTH, at[1]]], style::AXIS);
            if name.is_some() {
                let beside = [at[0] - TICK_LENGTH - GAP, at[1]];
                canvas.text(&upright.label(*y), beside, style::TICK_LEFT);
            }
        }
        let Some(name) = name else {
            return;
        };
        let above = [left - TICK_LENGTH, top - 1.1 * style::AXIS_NAME.size];
        canvas.text(name, above, style::AXIS_NAME_LEFT);
    }

    /// Writes the name of the lower axis under labels of so many lines.
    fn draw_name_below(&self, canvas: &mut Canvas, name: &str, lines: usize) {
        let Area {
            left,
            right,
            bottom,
            ..
        } = self.area;
        let labels = (0.4 + LINE * lines as f64) * style::TICK.size;
        let below = bottom + TICK_LENGTH + 2.0 * GAP + labels;
        canvas.text(name, [0.5 * (left + right), below], style::AXIS_NAME);
    }
}

/// A text in lines of so many pixels at most, where its words allow.
fn wrapped(text: &str, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_inclusive([' ', '(']) {
        let full = lines.len() == MOST_LINES;
        let fits = |line: &String| {
            let both = format!("{line}{word}");
            text_width(both.trim_end(), style::TICK.size) <= room
        };
        match lines.last_mut() {
            Some(line) if full || fits(line) => line.push_str(word),
            _ => lines.push(word.into()),
        }
    }
    lines
        .into_iter()
        .map(|line| line.trim_end().into())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{Ticks, wrapped};

    #[test]
    fn long_labels_are_wrapped_at_words() {
        let label = "Tube(outer: 0.018, inner: 0.014)";
        assert_eq!(wrapped(label, 1000.0), [label]);
        let lines = wrapped(label, 120.0);
        assert_eq!(lines, ["Tube(outer:", "0.018, inner:", "0.014)"]);
        assert_eq!(
            wrapped("a b c d e f g h", 1.0),
            ["a", "b", "c", "d e f g h"]
        );
        assert!(wrapped("", 10.0).is_empty());
    }

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
