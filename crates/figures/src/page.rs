//! The parts that all figures share: the words around a drawing; and the page of a drawing in space.

use crate::axes_box;
use crate::canvas::{self, Canvas, HEIGHT, Lettering, Sheet, Stroke, WIDTH, text_width};
use crate::geometry::{Area, Bounds, PagePoint, View};
use crate::numbers;
use crate::style;
use crate::svg::Color;
use crate::viewpoint::Viewpoint;

/// Free space at the edges of the page \[pixels\].
pub(crate) const MARGIN: f64 = 28.0;

/// Where the box of axes may be, without its ticks and names.
pub(crate) const DRAWING: Area = Area {
    left: 84.0,
    top: 86.0,
    right: 632.0,
    bottom: 528.0,
};

/// Left edge of the legend and centre of its first line.
const LEGEND: PagePoint = [664.0, 116.0];

/// Height of a line of the legend and of a caption \[pixels\].
const LEGEND_LINE: f64 = 26.0;
pub(crate) const CAPTION_LINE: f64 = 20.0;

/// Width of a sample in the legend \[pixels\].
const SAMPLE: f64 = 34.0;

/// The words around a drawing: title and subtitle above it, captions below.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Words<'a> {
    pub(crate) title: &'a str,
    pub(crate) subtitle: &'a str,
    /// Lines, from above.
    pub(crate) captions: &'a [String],
}

impl Words<'_> {
    /// A page of this height \[pixels\] with these words, and what `draw` draws, as an SVG document.
    pub(crate) fn svg(&self, height: u32, draw: impl FnOnce(&mut Canvas)) -> String {
        let description = self.description();
        let sheet = Sheet {
            width: WIDTH,
            height,
            title: self.title,
            description: &description,
        };
        canvas::svg(sheet, |canvas| {
            let room = f64::from(WIDTH) - 2.0 * MARGIN;
            fitted(canvas, self.title, [MARGIN, 34.0], room, style::TITLE);
            subtitle(canvas, self.subtitle, room);
            for (line, caption) in self.captions.iter().rev().enumerate() {
                let bottom = f64::from(height) - MARGIN - line as f64 * CAPTION_LINE;
                fitted(canvas, caption, [MARGIN, bottom], room, style::CAPTION);
            }
            draw(canvas);
        })
    }

    /// Subtitle and captions as sentences.
    pub(crate) fn description(&self) -> String {
        let lines = std::iter::once(self.subtitle).chain(self.captions.iter().map(String::as_str));
        let sentences = lines.map(|line| match line.ends_with('.') {
            true => line.to_string(),
            false => format!("{line}."),
        });
        sentences.collect::<Vec<_>>().join(" ")
    }
}

/// What a figure is made of, apart from the drawing in its box of axes.
pub(crate) struct Page<'a> {
    pub(crate) title: &'a str,
    pub(crate) subtitle: String,
    pub(crate) legend: Vec<(Sample, String)>,
    pub(crate) captions: Vec<String>,
    /// Around everything that is drawn.
    pub(crate) bounds: Bounds,
    /// Where it is seen from.
    pub(crate) eye: Viewpoint,
    /// What the axes are called where that is not x, y, z.
    pub(crate) axes: Option<&'a [String; 3]>,
}

/// What stands in the legend for a part of the drawing.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Sample {
    Line(Stroke),
    Body,
    Ground,
    Start,
    Second,
    Force,
    Moment,
    Mass,
}

impl Page<'_> {
    /// The page as an SVG document, with what `draw` draws in the box of axes.
    pub(crate) fn svg(&self, draw: impl FnOnce(&mut Canvas, &View)) -> String {
        let bounds = self.bounds.roomy();
        // Seen from a side, the box reaches up to where its upright axis has its name.
        let area = match self.eye == Viewpoint::default() {
            true => DRAWING,
            false => Area {
                top: DRAWING.top + 20.0,
                ..DRAWING
            },
        };
        let view = View::fit(&bounds, area, self.eye);
        let words = Words {
            title: self.title,
            subtitle: &self.subtitle,
            captions: &self.captions,
        };
        words.svg(HEIGHT, |canvas| {
            let names = self.axes.map_or(axes_box::NAMES, |names| {
                names.each_ref().map(|name| &**name)
            });
            axes_box::draw(canvas, &view, &bounds, names);
            draw(canvas, &view);
            for (line, (sample, label)) in self.legend.iter().enumerate() {
                let [left, top] = LEGEND;
                let at = [left, top + line as f64 * LEGEND_LINE];
                sample.draw(canvas, at);
                let text = [at[0] + SAMPLE + 12.0, at[1]];
                let room = f64::from(WIDTH) - MARGIN - text[0];
                fitted(canvas, label, text, room, style::LEGEND);
            }
        })
    }
}

impl Sample {
    /// Draws the sample with its left end at `at`.
    fn draw(self, canvas: &mut Canvas, at: PagePoint) {
        let [left, y] = at;
        let middle = [left + 0.5 * SAMPLE, y];
        match self {
            Self::Line(stroke) => canvas.line(&[at, [left + SAMPLE, y]], stroke),
            Self::Body => {
                let corners = [
                    [left + 3.0, y + 7.0],
                    [left + SAMPLE - 3.0, y + 7.0],
                    [left + 0.6 * SAMPLE, y - 8.0],
                ];
                outlined(canvas, &corners, style::BODY_FILL, style::BODY)
            }
            Self::Ground => ground_mark(canvas, [middle[0], y - 8.0]),
            Self::Start => start_mark(canvas, middle),
            Self::Second => second_mark(canvas, middle),
            Self::Force => arrow(canvas, [at, [left + SAMPLE, y]], 1),
            Self::Moment => arrow(canvas, [at, [left + SAMPLE, y]], 2),
            Self::Mass => mass_mark(canvas, middle),
        }
    }
}

/// The subtitle on a line, or, where it is too long for one, on two small ones.
fn subtitle(canvas: &mut Canvas, text: &str, room: f64) {
    let longest = longest(room, style::SUBTITLE);
    if text.chars().count() <= longest {
        fitted(canvas, text, [MARGIN, 61.0], room, style::SUBTITLE);
        return;
    }
    let small = Lettering {
        size: SMALLEST * style::SUBTITLE.size,
        ..style::SUBTITLE
    };
    let ends = text.char_indices().take(longest + 1);
    let space = ends.filter(|(_, c)| *c == ' ').last();
    let end = text
        .char_indices()
        .nth(longest)
        .map_or(text.len(), |(end, _)| end);
    let (first, rest) = text.split_at(space.map_or(end, |(space, _)| space));
    canvas.text(first, [MARGIN, 53.0], small);
    let rest = shortened(rest.trim_start(), longest);
    canvas.text(&rest, [MARGIN, 67.0], small);
}

/// How small letters become before a text is cut.
const SMALLEST: f64 = 0.7;

/// How many characters there is room for \[pixels\].
fn longest(room: f64, lettering: Lettering) -> usize {
    (room / text_width("x", SMALLEST * lettering.size)).floor() as usize
}

/// Text that is made smaller, and in the end cut, to stay within `room` \[pixels\].
pub(crate) fn fitted(
    canvas: &mut Canvas,
    text: &str,
    at: PagePoint,
    room: f64,
    lettering: Lettering,
) {
    let text = shortened(text, longest(room, lettering));
    let shrink = (room / text_width(&text, lettering.size)).min(1.0);
    canvas.text(
        &text,
        at,
        Lettering {
            size: shrink * lettering.size,
            ..lettering
        },
    );
}

/// The text, cut with an ellipsis where it is longer than so many characters.
fn shortened(text: &str, longest: usize) -> String {
    if text.chars().count() <= longest {
        return text.into();
    }
    let kept: String = text.chars().take(longest.saturating_sub(1)).collect();
    format!("{}…", kept.trim_end())
}

/// A filled polygon with an outline.
pub(crate) fn outlined(canvas: &mut Canvas, corners: &[PagePoint], fill: Color, outline: Stroke) {
    canvas.polygon(corners, fill);
    let closed: Vec<_> = corners.iter().chain(corners.first()).copied().collect();
    canvas.line(&closed, outline);
}

/// The mark of a point that is held to the ground: a triangle under it, on hatched ground.
pub(crate) fn ground_mark(canvas: &mut Canvas, [x, y]: PagePoint) {
    let base = y + 11.0;
    outlined(
        canvas,
        &[[x, y], [x - 7.0, base], [x + 7.0, base]],
        style::WHITE,
        style::MARK_STROKE,
    );
    canvas.line(&[[x - 10.0, base], [x + 10.0, base]], style::MARK_STROKE);
    for offset in [-8.0, -3.0, 2.0, 7.0] {
        let hatch = [[x + offset + 2.0, base], [x + offset - 2.0, base + 5.0]];
        canvas.line(&hatch, style::MARK_STROKE);
    }
}

/// The mark of the first point of a trajectory.
pub(crate) fn start_mark(canvas: &mut Canvas, at: PagePoint) {
    canvas.disc(at, 5.0, style::MARK);
}

/// The mark of a least value, a triangle that points down with its middle at the point; of the largest
/// one, it points up.
pub(crate) fn extreme_mark(canvas: &mut Canvas, [x, y]: PagePoint, most: bool) {
    const HALF: f64 = 5.5;
    let tip = if most { -HALF } else { HALF };
    let corners = [[x, y + tip], [x - HALF, y - tip], [x + HALF, y - tip]];
    outlined(canvas, &corners, style::MARK, style::MARK_EDGE);
}

/// The mark of a point of the second method.
pub(crate) fn second_mark(canvas: &mut Canvas, at: PagePoint) {
    canvas.ring(at, style::SECOND_RADIUS, style::SECOND);
}

/// An arrow with this number of heads, one behind the other: one for a force, two for a moment.
pub(crate) fn arrow(canvas: &mut Canvas, [from, to]: [PagePoint; 2], heads: usize) {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = along[0].hypot(along[1]);
    // One that points to the eye has no direction on the page.
    if length < HEAD {
        canvas.disc(to, 3.5, style::LOAD.color);
        return;
    }
    let unit = along.map(|c| c / length);
    canvas.line(&[from, to], style::LOAD);
    for head in 0..heads {
        let tip = [0, 1].map(|k| to[k] - head as f64 * HEAD * unit[k]);
        let side = |sign: f64| {
            let across = [-unit[1], unit[0]].map(|c| sign * 0.4 * HEAD * c);
            [0, 1].map(|k| tip[k] - HEAD * unit[k] + across[k])
        };
        canvas.polygon(&[tip, side(1.0), side(-1.0)], style::LOAD.color);
    }
}

/// Length of an arrow's head \[pixels\].
const HEAD: f64 = 11.0;

/// The mark of a mass: a disc whose quarters are filled in turn, as of a centre of gravity.
pub(crate) fn mass_mark(canvas: &mut Canvas, [x, y]: PagePoint) {
    const RADIUS: f64 = 6.5;
    canvas.disc([x, y], RADIUS, style::WHITE);
    for start in [0.0, std::f64::consts::PI] {
        let arc = (0..=6).map(|k| start + f64::from(k) * std::f64::consts::FRAC_PI_2 / 6.0);
        let arc = arc.map(|a| [x + RADIUS * a.cos(), y - RADIUS * a.sin()]);
        let quarter: Vec<_> = std::iter::once([x, y]).chain(arc).collect();
        canvas.polygon(&quarter, style::MARK);
    }
    canvas.ring([x, y], RADIUS, style::MARK_STROKE);
}

/// Writes a line of a caption above so many others, on a page of a drawing in space.
pub(crate) fn caption(canvas: &mut Canvas, text: &str, above: usize) {
    let bottom = f64::from(HEIGHT) - MARGIN - above as f64 * CAPTION_LINE;
    let room = f64::from(WIDTH) - 2.0 * MARGIN;
    fitted(canvas, text, [MARGIN, bottom], room, style::CAPTION);
}

/// The captions: the largest deflection \[m\], and the largest difference of a second method,
/// relative to it.
pub(crate) fn captions(deflection: f64, difference: Option<f64>) -> Vec<String> {
    let deflection = format!("Largest deflection: {}.", numbers::metres(deflection));
    let difference = difference.map(|difference| {
        let difference = numbers::relative(difference);
        format!(
            "Largest difference between the two methods: {difference} of the largest deflection."
        )
    });
    [Some(deflection), difference]
        .into_iter()
        .flatten()
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_text_is_cut() {
        assert_eq!(shortened("deflected", 9), "deflected");
        assert_eq!(shortened("deflected path", 11), "deflected…");
        assert_eq!(shortened("…", 0), "…");
    }

    #[test]
    fn captions_state_the_largest_deflection_and_difference() {
        let captions = captions(2.08e-4, Some(0.0094));
        assert_eq!(
            captions,
            [
                "Largest deflection: 208 µm.",
                "Largest difference between the two methods: 0.94 % of the largest deflection."
            ]
        );
    }
}
