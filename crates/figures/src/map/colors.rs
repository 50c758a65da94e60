//! Colours of values, linear or logarithmic, and the bar that tells them.

use colorous::{Gradient, PURPLE_ORANGE, VIRIDIS};

use super::{ColorScale, MapFigure};
use crate::canvas::{Canvas, Stroke, WIDTH, text_width};
use crate::error::FigureError;
use crate::geometry::Area;
use crate::page::{MARGIN, fitted};
use crate::plane_axes::{TICK_LENGTH, Ticks};
use crate::quantity::Scaled;
use crate::svg::Color;
use crate::{numbers, style};

/// Number of shades from one end of the colours to the other.
const SHADES: usize = 64;

/// A range relative to the values' size that is taken as rounding, not as a field.
const FLAT: f64 = 1e-9;

/// Most values that the bar tells.
const MOST_TICKS: f64 = 8.0;

/// From this part of the colours below, the middle of the values makes a logarithmic scale.
const CROWDED: f64 = 0.1;

/// A logarithmic scale over less than this factor has ticks at even distances.
const SHORT: f64 = 4.0;

/// Height of the tip of the bar for values beyond the colours \[pixels\].
const TIP: f64 = 14.0;

/// The colours of a range of values.
#[derive(Debug)]
pub(super) struct Colors {
    /// Tones at which the colours begin and end.
    tones: [f64; 2],
    /// The value at which the colours begin.
    first: f64,
    pub(super) logarithmic: bool,
    /// Whether there are values below, and above, those with colours of their own.
    beyond: [bool; 2],
    gradient: Gradient,
    /// From here to there contours are black, elsewhere white.
    light: [f64; 2],
    name: String,
    scaled: Scaled,
    /// Values of the contours, with their labels.
    ticks: Vec<(f64, String)>,
}

impl Colors {
    /// The colours of a map.
    pub(super) fn new(map: &MapFigure) -> Result<Self, FigureError> {
        let mut values: Vec<f64> = map.found().collect();
        values.sort_by(f64::total_cmp);
        let (Some(&least), Some(&most)) = (values.first(), values.last()) else {
            return Err(FigureError::NoPoints {
                what: "map".to_string(),
            });
        };
        let ends = match map.limits {
            Some([low, high]) if low.is_finite() && high.is_finite() && low < high => [low, high],
            Some(limits) => return Err(FigureError::InvalidLimits { limits }),
            None => [least, most],
        };
        let logarithmic = match map.scale {
            ColorScale::Linear => false,
            ColorScale::Log | ColorScale::Ratio if ends[0] > 0.0 => true,
            ColorScale::Log | ColorScale::Ratio => {
                return Err(FigureError::Logarithm { least: ends[0] });
            }
            ColorScale::Auto => {
                let middle = values[values.len() / 2].clamp(ends[0], ends[1]);
                ends[0] > 0.0
                    && ends[1] - ends[0] > FLAT * ends[1]
                    && middle - ends[0] < CROWDED * (ends[1] - ends[0])
            }
        };
        let ends = match map.scale {
            ColorScale::Ratio => parted(ends),
            _ => ends,
        };
        let largest = ends[0].abs().max(ends[1].abs());
        let [first, last] = if ends[1] - ends[0] > FLAT * largest {
            ends
        } else {
            let around = if largest > 0.0 { 1e-2 * largest } else { 1.0 };
            [ends[0] - around, ends[1] + around]
        };
        let scaled = map.quantity.scaled(largest);
        let in_unit = [first, last].map(|end| end * scaled.factor);
        let ticks = if logarithmic && last >= SHORT * first {
            let ticks = round_factors(in_unit).into_iter();
            ticks.map(|tick| (tick, numbers::short(tick))).collect()
        } else {
            let ticks = Ticks::between(in_unit, MOST_TICKS);
            let labelled = |tick: &f64| (*tick, ticks.label(*tick));
            ticks.values.iter().map(labelled).collect::<Vec<_>>()
        };
        let mut colors = Self {
            tones: [first, last],
            first,
            logarithmic,
            beyond: [least < first, most > last],
            gradient: match map.scale {
                ColorScale::Ratio => PURPLE_ORANGE,
                _ => VIRIDIS,
            },
            light: match map.scale {
                ColorScale::Ratio => [0.2, 0.8],
                _ => [0.45, f64::INFINITY],
            },
            name: map.quantity.name.clone(),
            ticks: (ticks.into_iter())
                .map(|(tick, label)| (tick / scaled.factor, label))
                .collect(),
            scaled,
        };
        colors.tones = [first, last].map(|end| colors.tone(end));
        Ok(colors)
    }

    /// What the colours are even in: a value, or its logarithm. What has none is at the first
    /// colour.
    pub(super) fn tone(&self, value: f64) -> f64 {
        match self.logarithmic {
            true => value.max(self.first).ln(),
            false => value,
        }
    }

    /// The tones from which each shade is used, ascending, with its colour; the first is below
    /// all values.
    pub(super) fn shades(&self) -> impl Iterator<Item = (f64, Color)> {
        let [least, most] = self.tones;
        (0..SHADES).map(move |k| {
            let part = k as f64 / SHADES as f64;
            let level = if k == 0 {
                f64::NEG_INFINITY
            } else {
                least + part * (most - least)
            };
            (level, self.color(part + 0.5 / SHADES as f64))
        })
    }

    /// The colour of a value.
    pub(super) fn of(&self, value: f64) -> Color {
        self.color(self.part(self.tone(value)))
    }

    /// Tones of the contours, each with its label and its stroke.
    pub(super) fn contours(&self) -> impl Iterator<Item = (f64, String, Stroke)> {
        self.ticks.iter().map(|(value, label)| {
            let tone = self.tone(*value);
            (tone, label.clone(), self.stroke(tone))
        })
    }

    fn stroke(&self, tone: f64) -> Stroke {
        let [from, to] = self.light;
        if self.part(tone) > from && self.part(tone) < to {
            style::CONTOUR
        } else {
            style::CONTOUR_ON_DARK
        }
    }

    fn color(&self, part: f64) -> Color {
        let color = self.gradient.eval_continuous(part);
        Color::new(color.r, color.g, color.b)
    }

    fn part(&self, tone: f64) -> f64 {
        let [least, most] = self.tones;
        ((tone - least) / (most - least)).clamp(0.0, 1.0)
    }

    /// Draws the bar, with the name and the unit of the quantity above it over so much room to its
    /// left. It has a tip where values are beyond its end.
    pub(super) fn draw_bar(&self, canvas: &mut Canvas, bar: Area, name_room: f64) {
        let Area {
            left,
            top,
            right,
            bottom,
        } = bar;
        let [low, high] = self.beyond.map(|beyond| if beyond { TIP } else { 0.0 });
        let (first, last) = (bottom - low, top + high);
        let middle = 0.5 * (left + right);
        if self.beyond[1] {
            let tip = [[left, last], [middle, top], [right, last]];
            canvas.shade(&[tip.to_vec()], self.color(1.0));
        }
        if self.beyond[0] {
            let tip = [[left, first], [right, first], [middle, bottom]];
            canvas.shade(&[tip.to_vec()], self.color(0.0));
        }
        let height = |part: f64| first - part * (first - last);
        for (k, (_, color)) in self.shades().enumerate() {
            let from = height(k as f64 / SHADES as f64);
            let corners = [[left, from], [right, from], [right, last], [left, last]];
            canvas.shade(&[corners.to_vec()], color);
        }
        for (tone, label, stroke) in self.contours() {
            let y = height(self.part(tone));
            canvas.line(&[[left, y], [right, y]], stroke);
            let beside = [right + TICK_LENGTH, y];
            canvas.line(&[[right, y], beside], style::AXIS);
            canvas.text(&label, [beside[0] + 5.0, y], style::TICK_RIGHT);
        }
        let frame = [
            [left, last],
            [middle, top],
            [right, last],
            [right, first],
            [middle, bottom],
            [left, first],
            [left, last],
        ];
        canvas.line(&frame, style::AXIS);
        self.draw_name(canvas, [left - name_room, top - 17.0]);
    }

    /// Writes name and unit, from `at` to the right: in two lines where there is no room for one.
    fn draw_name(&self, canvas: &mut Canvas, at: [f64; 2]) {
        let lettering = style::AXIS_NAME_LEFT;
        let room = f64::from(WIDTH) - MARGIN - at[0];
        let unit = match &*self.scaled.unit {
            "" => String::new(),
            unit => format!("({unit})"),
        };
        let whole = format!("{} {unit}", self.name);
        if unit.is_empty() || text_width(&whole, lettering.size) <= room {
            return fitted(canvas, whole.trim_end(), at, room, lettering);
        }
        let above = [at[0], at[1] - 1.25 * lettering.size];
        fitted(canvas, &self.name, above, room, lettering);
        canvas.text(&unit, at, lettering);
    }
}

/// Round values over a range above zero of a factor [`SHORT`] or more: 1, 2, 5 × 10ᵏ, or 1 × 10ᵏ
/// of every, every second … k.
fn round_factors([first, last]: [f64; 2]) -> Vec<f64> {
    // Round ends are meant although they are not quite met.
    let inside = |value: &f64| (first * (1.0 - 1e-9)..=last * (1.0 + 1e-9)).contains(value);
    let powers = first.log10().floor() as i32..=last.log10().ceil() as i32;
    let ticks = |mantissas: &[u8], every: usize| -> Vec<f64> {
        let powers = powers.clone().step_by(every);
        let all = powers.flat_map(|power| {
            let number = move |m: &u8| format!("{m}e{power}").parse::<f64>();
            mantissas.iter().filter_map(move |m| number(m).ok())
        });
        all.filter(inside).collect()
    };
    let fine = ticks(&[1, 2, 5], 1);
    if fine.len() as f64 <= 1.5 * MOST_TICKS {
        return fine;
    }
    let mut every = 1;
    loop {
        let coarse = ticks(&[1], every);
        if coarse.len() as f64 <= 1.5 * MOST_TICKS {
            return coarse;
        }
        every += 1;
    }
}

/// The ends of colours of a ratio, as far above 1 as below, that hold these.
pub(super) fn parted([low, high]: [f64; 2]) -> [f64; 2] {
    let reach = high.max(low.recip());
    [reach.recip(), reach]
}

#[cfg(test)]
mod tests {
    use super::round_factors;

    #[test]
    fn logarithmic_ticks_are_round() {
        assert_eq!(
            round_factors([0.0726, 5.724]),
            [0.1, 0.2, 0.5, 1.0, 2.0, 5.0]
        );
        assert_eq!(round_factors([1.0, 5.0]), [1.0, 2.0, 5.0]);
        let decades = round_factors([1e-6, 1e3]);
        assert_eq!((decades.len(), decades[0], decades[9]), (10, 1e-6, 1e3));
        assert!(round_factors([1e-150, 1e150]).len() <= 12);
    }
}
