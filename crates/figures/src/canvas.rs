//! The page that everything is drawn on: a thin layer over plotters' SVG backend.
//!
//! plotters counts whole pixels; the page is therefore drawn with [`UNITS`] of them to a pixel
//! of the figure, and shown that much smaller by an outer `svg` element, which also rounds the
//! ends and corners of all lines.

use std::cell::RefCell;
use std::fmt::Write as _;
use std::io;

use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::{Circle, Drawable, PathElement, PointCollection, Polygon, Text};
use plotters::prelude::SVGBackend;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontDesc, FontFamily, FontStyle, RGBAColor, ShapeStyle, TextStyle};

use crate::error::FigureError;
use crate::geometry::PagePoint;
use crate::paths;

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

/// plotters' font size over that of SVG, of which it is the height of a line.
const LINE_HEIGHT: f64 = 1.24;

/// How a line is drawn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stroke {
    pub(crate) color: RGBAColor,
    /// \[pixels\]
    pub(crate) width: f64,
    /// Lengths of strokes and gaps in turn \[pixels\]; none for a solid line.
    pub(crate) dashes: &'static [f64],
}

impl Stroke {
    pub(crate) const fn solid(color: RGBAColor, width: f64) -> Self {
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
    pub(crate) color: RGBAColor,
    /// Which part of the line of text the given point is.
    pub(crate) anchor: HPos,
}

/// What a page is apart from its drawing.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sheet<'a> {
    /// Height, where the width is [`WIDTH`] \[pixels\].
    pub(crate) height: u32,
    /// For programs that read a figure aloud or list it; not drawn.
    pub(crate) title: &'a str,
    pub(crate) description: &'a str,
}

/// The page.
pub(crate) struct Canvas<'a> {
    page: DrawingArea<SVGBackend<'a>, Shift>,
    /// Shaded regions, under all that is drawn.
    shades: RefCell<String>,
}

/// Draws a page and gives it as an SVG document.
pub(crate) fn svg(
    sheet: Sheet<'_>,
    draw: impl FnOnce(&Canvas<'_>) -> Result<(), FigureError>,
) -> Result<String, FigureError> {
    let (width, height) = (WIDTH, sheet.height);
    let (inner_width, inner_height) = (width * UNITS, height * UNITS);
    let mut inner = String::new();
    let backend = SVGBackend::with_string(&mut inner, (inner_width, inner_height));
    let canvas = Canvas {
        page: backend.into_drawing_area(),
        shades: RefCell::default(),
    };
    draw(&canvas)?;
    canvas.page.present().map_err(svg_error)?;
    let shades = canvas.shades.take();
    drop(canvas);
    let [title, description] = [sheet.title, sheet.description].map(escaped);
    Ok(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {inner_width} {inner_height}\" \
         stroke-linecap=\"round\" stroke-linejoin=\"round\">\n\
         <title>{title}</title>\n<desc>{description}</desc>\n\
         <rect x=\"0\" y=\"0\" width=\"{inner_width}\" height=\"{inner_height}\" \
         fill=\"#FFFFFF\"/>\n{shades}{inner}</svg>\n"
    ))
}

/// Text without what means something, or nothing, in XML.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in in_xml(text).chars() {
        match c {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            c => escaped.push(c),
        }
    }
    escaped
}

/// The text with a space for each character that has no place in XML.
fn in_xml(text: &str) -> String {
    let known = |c: char| !c.is_control() && !matches!(c, '\u{fffe}' | '\u{ffff}');
    text.chars()
        .map(|c| if known(c) { c } else { ' ' })
        .collect()
}

impl Canvas<'_> {
    /// A line through points. Of very many, those that cannot be seen are left out.
    pub(crate) fn line(&self, points: &[PagePoint], stroke: Stroke) -> Result<(), FigureError> {
        let points = &*paths::thinned(points);
        if stroke.dashes.is_empty() || paths::length(points) > LONGEST_DASHED {
            return self.solid_line(points, stroke);
        }
        dashed(points, stroke.dashes)
            .iter()
            .try_for_each(|dash| self.solid_line(dash, stroke))
    }

    fn solid_line(&self, points: &[PagePoint], stroke: Stroke) -> Result<(), FigureError> {
        let mut points: Vec<_> = points.iter().map(|point| units(*point)).collect();
        points.dedup();
        let mut rest = &*points;
        // Each part begins where the one before ends. A picture of lines through very many points
        // takes a time with the square of those in one part.
        while rest.len() > 1 {
            let part = &rest[..rest.len().min(LONGEST_PART)];
            self.draw(&PathElement::new(part, shape(stroke)))?;
            rest = &rest[part.len() - 1..];
        }
        Ok(())
    }

    /// A filled polygon.
    pub(crate) fn polygon(
        &self,
        corners: &[PagePoint],
        fill: RGBAColor,
    ) -> Result<(), FigureError> {
        let corners: Vec<_> = corners.iter().map(|corner| units(*corner)).collect();
        self.draw(&Polygon::new(corners, fill))
    }

    /// A region between closed lines, of one colour, under all else; those drawn later cover those
    /// drawn before. What lies inside an even number of the lines is outside.
    pub(crate) fn shade(&self, outlines: &[Vec<PagePoint>], fill: RGBAColor) {
        let mut shades = self.shades.borrow_mut();
        // Writing to a String cannot fail.
        let _ = shades.write_str("<path fill-rule=\"evenodd\" d=\"");
        for outline in outlines {
            let outline = paths::straightened(outline);
            let mut corners: Vec<_> = outline.iter().map(|corner| units(*corner)).collect();
            corners.dedup();
            for (k, (x, y)) in corners.into_iter().enumerate() {
                let step = if k == 0 { 'M' } else { 'L' };
                let _ = write!(shades, "{step}{x} {y}");
            }
            shades.push('Z');
        }
        let RGBAColor(red, green, blue, _) = fill;
        let _ = writeln!(shades, "\" fill=\"#{red:02X}{green:02X}{blue:02X}\"/>");
    }

    /// A disc.
    pub(crate) fn disc(
        &self,
        center: PagePoint,
        radius: f64,
        fill: RGBAColor,
    ) -> Result<(), FigureError> {
        let style = ShapeStyle::from(fill).filled();
        self.draw(&Circle::new(units(center), unit(radius), style))
    }

    /// An open circle.
    pub(crate) fn ring(
        &self,
        center: PagePoint,
        radius: f64,
        stroke: Stroke,
    ) -> Result<(), FigureError> {
        self.draw(&Circle::new(units(center), unit(radius), shape(stroke)))
    }

    /// A line of text, centred in height on `at`.
    pub(crate) fn text(
        &self,
        text: &str,
        at: PagePoint,
        lettering: Lettering,
    ) -> Result<(), FigureError> {
        let size = LINE_HEIGHT * lettering.size * f64::from(UNITS);
        let font = FontDesc::new(FontFamily::Name(FONT), size, FontStyle::Normal);
        let style = TextStyle::from(font)
            .color(&lettering.color)
            .pos(Pos::new(lettering.anchor, VPos::Center));
        self.draw(&Text::new(in_xml(text), units(at), style))
    }

    fn draw<E>(&self, element: &E) -> Result<(), FigureError>
    where
        for<'b> &'b E: PointCollection<'b, (i32, i32)>,
        for<'b> E: Drawable<SVGBackend<'b>>,
    {
        self.page.draw(element).map_err(svg_error)
    }
}

/// About the width of a line of text \[pixels\], rather too wide than too narrow.
pub(crate) fn text_width(text: &str, size: f64) -> f64 {
    0.58 * size * text.chars().count() as f64
}

fn svg_error(error: DrawingAreaErrorKind<io::Error>) -> FigureError {
    FigureError::Svg(Box::new(error))
}

fn shape(stroke: Stroke) -> ShapeStyle {
    ShapeStyle::from(stroke.color).stroke_width(unit(stroke.width) as u32)
}

fn units([x, y]: PagePoint) -> (i32, i32) {
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
            color: RGBAColor(0, 0, 0, 1.0),
            anchor: HPos::Left,
        };
        let text = "a\u{1}b<c>&\n\u{ffff}d";
        let sheet = Sheet {
            height: HEIGHT,
            title: text,
            description: "",
        };
        let svg = svg(sheet, |canvas| canvas.text(text, [10.0, 10.0], lettering)).unwrap();
        assert!(svg.contains("<title>a b&lt;c&gt;&amp;  d</title>"), "{svg}");
        assert!(svg.contains("a b&lt;c&gt;&amp;  d"), "{svg}");
    }
}
