//! The page that everything is drawn on.
//!
//! Elements stand at whole numbers; the page is therefore drawn with [`UNITS`] of them to a pixel
//! of the figure, and shown that much smaller by an outer `svg` element, which also rounds the
//! ends and corners of all lines.

use crate::geometry::PagePoint;
use crate::paths;
use crate::svg::{Anchor, Color, Elements, Place, escaped};

/// Width of a figure, and the height of one in space \[pixels\].
pub(crate) const WIDTH: u32 = 900;
pub(crate) const HEIGHT: u32 = 640;

/// Units of the drawing in a pixel.
const UNITS: u32 = 10;

/// Most points of one line element.
const LONGEST_PART: usize = 2000;

/// A line longer than this is drawn without its dashes, which nobody could tell apart \[pixels\].
const LONGEST_DASHED: f64 = 20_000.0;

/// Families of the text, the embedded one first; the next have letters of the same widths.
const FONT: &str = "Liberation Sans, Arimo, Arial, Helvetica, sans-serif";

/// How a line is drawn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stroke {
    pub(crate) color: Color,
    /// \[pixels\]
    pub(crate) width: f64,
    /// Lengths of strokes and gaps in turn \[pixels\]; none for a solid line.
    pub(crate) dashes: &'static [f64],
}

impl Stroke {
    pub(crate) const fn solid(color: Color, width: f64) -> Self {
        Self {
            color,
            width,
            dashes: &[],
        }
    }
}

/// How text is drawn.
#[derive(Clone, Copy)]
pub(crate) struct Lettering {
    /// Size of the font \[pixels\].
    pub(crate) size: f64,
    pub(crate) color: Color,
    /// Which part of the line of text the given point is.
    pub(crate) anchor: Anchor,
}

/// What a page is apart from its drawing.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sheet<'a> {
    /// Its size \[pixels\].
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// For programs that read a figure aloud or list it; not drawn.
    pub(crate) title: &'a str,
    pub(crate) description: &'a str,
}

/// The page.
#[derive(Debug, Default)]
pub(crate) struct Canvas {
    /// Shaded regions, under all that is drawn.
    shades: Elements,
    elements: Elements,
}

/// Draws a page and gives it as an SVG document.
pub(crate) fn svg(sheet: Sheet<'_>, draw: impl FnOnce(&mut Canvas)) -> String {
    let (width, height) = (sheet.width, sheet.height);
    let (inner_width, inner_height) = (width * UNITS, height * UNITS);
    let mut canvas = Canvas::default();
    draw(&mut canvas);
    let [shades, elements] = [&canvas.shades, &canvas.elements].map(Elements::as_str);
    let [title, description] = [sheet.title, sheet.description].map(escaped);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {inner_width} {inner_height}\" \
         stroke-linecap=\"round\" stroke-linejoin=\"round\">\n\
         <title>{title}</title>\n<desc>{description}</desc>\n\
         <rect x=\"0\" y=\"0\" width=\"{inner_width}\" height=\"{inner_height}\" \
         fill=\"#FFFFFF\"/>\n{shades}\
         <svg width=\"{inner_width}\" height=\"{inner_height}\" \
         viewBox=\"0 0 {inner_width} {inner_height}\" \
         xmlns=\"http://www.w3.org/2000/svg\">\n{elements}</svg>\n</svg>\n"
    )
}

impl Canvas {
    /// A line through points. Of very many, those that cannot be seen are left out.
    pub(crate) fn line(&mut self, points: &[PagePoint], stroke: Stroke) {
        let points = &*paths::thinned(points);
        if stroke.dashes.is_empty() || paths::length(points) > LONGEST_DASHED {
            return self.solid_line(points, stroke);
        }
        for dash in dashed(points, stroke.dashes) {
            self.solid_line(&dash, stroke);
        }
    }

    fn solid_line(&mut self, points: &[PagePoint], stroke: Stroke) {
        let points = places(points);
        let mut rest = &*points;
        // Each part begins where the one before ends. A picture of lines through very many points
        // takes a time with the square of those in one part.
        while rest.len() > 1 {
            let part = &rest[..rest.len().min(LONGEST_PART)];
            self.elements
                .polyline(part, stroke.color, unit(stroke.width));
            rest = &rest[part.len() - 1..];
        }
    }

    /// A filled polygon.
    pub(crate) fn polygon(&mut self, corners: &[PagePoint], fill: Color) {
        let corners: Vec<_> = corners.iter().map(|corner| place(*corner)).collect();
        self.elements.polygon(&corners, fill);
    }

    /// A region between closed lines, of one colour, under all else; those drawn later cover those
    /// drawn before. What lies inside an even number of the lines is outside.
    pub(crate) fn shade(&mut self, outlines: &[Vec<PagePoint>], fill: Color) {
        let outlines = outlines
            .iter()
            .map(|outline| places(&paths::straightened(outline)));
        self.shades.region(&outlines.collect::<Vec<_>>(), fill);
    }

    /// A disc.
    pub(crate) fn disc(&mut self, center: PagePoint, radius: f64, fill: Color) {
        self.elements.disc(place(center), unit(radius), fill);
    }

    /// An open circle.
    pub(crate) fn ring(&mut self, center: PagePoint, radius: f64, stroke: Stroke) {
        let width = unit(stroke.width);
        self.elements
            .ring(place(center), unit(radius), stroke.color, width);
    }

    /// What `draw` draws, seen at some of the times of a moving picture ([`Elements::frame`]).
    pub(crate) fn frame(
        &mut self,
        seen: &[bool],
        takes: Option<u32>,
        draw: impl FnOnce(&mut Self),
    ) {
        let mut inner = Self::default();
        draw(&mut inner);
        self.elements.frame(&inner.elements, seen, takes);
    }

    /// A line of text, centred in height on `at`.
    pub(crate) fn text(&mut self, text: &str, at: PagePoint, lettering: Lettering) {
        let Lettering {
            size,
            color,
            anchor,
        } = lettering;
        let size = (size * f64::from(UNITS)).to_string();
        self.elements
            .text(text, place(at), anchor, [FONT, &size], color);
    }
}

/// About the width of a line of text \[pixels\], rather too wide than too narrow.
pub(crate) fn text_width(text: &str, size: f64) -> f64 {
    0.58 * size * text.chars().count() as f64
}

/// Points on the drawing, those that fall on the one before left out.
fn places(points: &[PagePoint]) -> Vec<Place> {
    let mut places: Vec<_> = points.iter().map(|point| place(*point)).collect();
    places.dedup();
    places
}

fn place([x, y]: PagePoint) -> Place {
    (unit(x), unit(y))
}

/// Pixels in units of the drawing; what is far off the page stays off it.
fn unit(pixels: f64) -> i32 {
    (pixels * f64::from(UNITS)).round() as i32
}

/// The strokes of a dashed line.
fn dashed(points: &[PagePoint], dashes: &[f64]) -> Vec<Vec<PagePoint>> {
    let mut strokes = Vec::new();
    let mut stroke: Vec<PagePoint> = points.first().copied().into_iter().collect();
    let mut turn = 0;
    let mut left = dashes[0];
    for pair in points.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let mut done = 0.0;
        while length - done > left {
            done += left;
            let part = done / length;
            let at = [0, 1].map(|k| from[k] + part * (to[k] - from[k]));
            if turn % 2 == 0 {
                stroke.push(at);
                strokes.push(std::mem::take(&mut stroke));
            } else {
                stroke = vec![at];
            }
            turn += 1;
            left = dashes[turn % dashes.len()];
        }
        left -= length - done;
        if turn % 2 == 0 {
            stroke.push(to);
        }
    }
    if turn % 2 == 0 {
        strokes.push(stroke);
    }
    strokes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_go_on_round_a_corner() {
        let corner = [[0.0, 0.0], [3.0, 0.0], [3.0, 4.0]];
        assert_eq!(
            dashed(&corner, &[2.0, 0.5]),
            [
                vec![[0.0, 0.0], [2.0, 0.0]],
                vec![[2.5, 0.0], [3.0, 0.0], [3.0, 1.5]],
                vec![[3.0, 2.0], [3.0, 4.0]],
            ]
        );
    }

    #[test]
    fn a_dashed_line_of_one_point_or_none_is_nothing_to_see() {
        assert_eq!(dashed(&[[1.0, 1.0]], &[2.0, 1.0]), [[[1.0, 1.0]]]);
        assert_eq!(dashed(&[], &[2.0, 1.0]), [[]; 1] as [[PagePoint; 0]; 1]);
    }

    #[test]
    fn characters_without_a_place_in_xml_do_not_reach_the_document() {
        let lettering = Lettering {
            size: 12.0,
            color: Color::new(0, 0, 0),
            anchor: Anchor::Start,
        };
        let text = "a\u{1}b<c>&\n\u{ffff}d";
        let sheet = Sheet {
            width: WIDTH,
            height: HEIGHT,
            title: text,
            description: "",
        };
        let svg = svg(sheet, |canvas| canvas.text(text, [10.0, 10.0], lettering));
        assert!(svg.contains("<title>a b&lt;c&gt;&amp;  d</title>"), "{svg}");
        assert!(svg.contains("a b&lt;c&gt;&amp;  d"), "{svg}");
    }
}
