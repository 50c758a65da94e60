//! Pages that are drawn on freely, with what all figures are drawn with.

use crate::canvas::{self, Canvas, Lettering, Sheet, Stroke};
use crate::geometry::PagePoint;
use crate::svg::{Anchor, Color};

/// A colour: red, green, blue.
pub type Rgb = [u8; 3];

/// A page that is drawn on freely: places are pixels from its upper left corner, to the right and down. What
/// is drawn later covers what was drawn before.
#[derive(Debug)]
pub struct Sketch<'c>(&'c mut Canvas);

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pen {
    /// Its colour.
    pub color: Rgb,
    /// Its width \[pixels\].
    pub width: f64,
    /// Whether it has gaps.
    pub dashed: bool,
}

/// Strokes and gaps \[pixels\].
const DASHES: &[f64] = &[6.0, 4.0];

impl Sketch<'_> {
    /// A page so wide and high \[pixels\], with what `draw` draws on it, as an SVG document; its title is for
    /// programs that read it aloud.
    pub fn svg(
        [width, height]: [u32; 2],
        title: &str,
        draw: impl FnOnce(&mut Sketch<'_>),
    ) -> String {
        let sheet = Sheet {
            width,
            height,
            title,
            description: "",
        };
        canvas::svg(sheet, |canvas| draw(&mut Sketch(canvas)))
    }

    /// A line through points.
    pub fn line(&mut self, points: &[PagePoint], pen: Pen) {
        let stroke = Stroke {
            color: color(pen.color),
            width: pen.width,
            dashes: if pen.dashed { DASHES } else { &[] },
        };
        self.0.line(points, stroke);
    }

    /// A filled polygon without an outline.
    pub fn area(&mut self, corners: &[PagePoint], fill: Rgb) {
        self.0.polygon(corners, color(fill));
    }

    /// A disc with an outline.
    pub fn disc(&mut self, center: PagePoint, radius: f64, fill: Rgb, outline: Pen) {
        let stroke = Stroke::solid(color(outline.color), outline.width);
        self.0.disc(center, radius, color(fill));
        self.0.ring(center, radius, stroke);
    }

    /// A line of text of a size \[pixels\], its middle at a place.
    pub fn words(&mut self, text: &str, middle: PagePoint, size: f64, ink: Rgb) {
        let lettering = Lettering {
            size,
            color: color(ink),
            anchor: Anchor::Middle,
        };
        self.0.text(text, middle, lettering);
    }
}

fn color([red, green, blue]: Rgb) -> Color {
    Color::new(red, green, blue)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_has_its_size_and_what_is_drawn_on_it() {
        let pen = Pen {
            color: [0, 0, 0],
            width: 1.5,
            dashed: true,
        };
        let svg = Sketch::svg([300, 200], "a sketch", |sketch| {
            sketch.area(&[[0.0, 0.0], [9.0, 0.0], [0.0, 9.0]], [255, 0, 0]);
            sketch.line(&[[0.0, 0.0], [16.0, 0.0]], pen);
            sketch.disc([5.0, 5.0], 2.0, [0, 0, 255], pen);
            sketch.words("node 1", [150.0, 100.0], 15.0, [0, 0, 0]);
        });
        let parts = [
            "width=\"300\" height=\"200\" viewBox=\"0 0 3000 2000\"",
            "<title>a sketch</title>",
            "fill=\"#FF0000\" points=\"0,0 90,0 0,90 \"",
            "points=\"0,0 60,0 \"",
            "points=\"100,0 160,0 \"",
            "fill=\"#0000FF\"",
            "x=\"1500\" y=\"1000\" dy=\"0.5ex\" text-anchor=\"middle\"",
        ];
        for part in parts {
            assert!(svg.contains(part), "{part}: {svg}");
        }
    }
}
