//! SVG as text: the few elements that figures are made of, in whole units of the drawing.

use std::fmt::{Arguments, Write as _};

/// A place on the page \[units\].
pub(crate) type Place = (i32, i32);

/// A colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Color {
    pub(crate) red: u8,
    pub(crate) green: u8,
    pub(crate) blue: u8,
    /// From 0, not seen, to 1.
    pub(crate) opacity: f64,
}

impl Color {
    pub(crate) const fn new(red: u8, green: u8, blue: u8) -> Self {
        Self {
            red,
            green,
            blue,
            opacity: 1.0,
        }
    }

    /// The same colour, seen through.
    pub(crate) const fn opacity(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }

    /// As SVG names it, without the opacity.
    fn name(self) -> String {
        format!("#{:02X}{:02X}{:02X}", self.red, self.green, self.blue)
    }
}

/// Which part of a line of text the given place is.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// Elements in the order in which they are drawn, one a line.
#[derive(Debug, Default)]
pub(crate) struct Elements(String);

impl Elements {
    /// The elements as text.
    pub(crate) fn as_str(&self) -> &str {
        &self.0
    }

    fn write(&mut self, text: Arguments<'_>) {
        // Writing to a String cannot fail.
        let _ = self.0.write_fmt(text);
    }

    /// A line through points, so wide \[units\].
    pub(crate) fn polyline(&mut self, points: &[Place], color: Color, width: i32) {
        let (name, opacity) = (color.name(), color.opacity);
        self.write(format_args!(
            "<polyline fill=\"none\" opacity=\"{opacity}\" stroke=\"{name}\" \
             stroke-width=\"{width}\""
        ));
        self.points(points);
    }

    /// A filled polygon.
    pub(crate) fn polygon(&mut self, corners: &[Place], fill: Color) {
        let (name, opacity) = (fill.name(), fill.opacity);
        self.write(format_args!(
            "<polygon opacity=\"{opacity}\" fill=\"{name}\""
        ));
        self.points(corners);
    }

    /// The points of an element, and its end.
    fn points(&mut self, points: &[Place]) {
        self.0.push_str(" points=\"");
        for (x, y) in points {
            self.write(format_args!("{x},{y} "));
        }
        self.0.push_str("\"/>\n");
    }

    /// A region between closed lines, of one colour. What lies inside an even number of the lines is
    /// outside.
    pub(crate) fn region(&mut self, outlines: &[Vec<Place>], fill: Color) {
        self.0.push_str("<path fill-rule=\"evenodd\" d=\"");
        for outline in outlines {
            for (k, (x, y)) in outline.iter().enumerate() {
                let step = if k == 0 { 'M' } else { 'L' };
                self.write(format_args!("{step}{x} {y}"));
            }
            self.0.push('Z');
        }
        let name = fill.name();
        self.write(format_args!("\" fill=\"{name}\"/>\n"));
    }

    /// What is seen at some of the times, one after the other, in which a picture that takes so many
    /// milliseconds is divided; where it is not to move, what is seen at the first.
    pub(crate) fn frame(&mut self, inner: &Self, seen: &[bool], takes: Option<u32>) {
        let word = |seen: &bool| if *seen { "visible" } else { "hidden" };
        let first = seen.first().map_or("hidden", word);
        self.write(format_args!("<g visibility=\"{first}\">\n"));
        if let Some(takes) = takes {
            let words: Vec<_> = seen.iter().map(word).collect();
            self.write(format_args!(
                "<animate attributeName=\"visibility\" calcMode=\"discrete\" dur=\"{takes}ms\" \
                 repeatCount=\"indefinite\" values=\"{}\"/>\n",
                words.join(";")
            ));
        }
        self.0 += &inner.0;
        self.0 += "</g>\n";
    }

    /// A disc.
    pub(crate) fn disc(&mut self, center: Place, radius: i32, fill: Color) {
        self.circle(center, radius, fill.opacity, [&fill.name(), "none"], 1);
    }

    /// A circle, so wide \[units\].
    pub(crate) fn ring(&mut self, center: Place, radius: i32, color: Color, width: i32) {
        self.circle(
            center,
            radius,
            color.opacity,
            ["none", &color.name()],
            width,
        );
    }

    fn circle(
        &mut self,
        (x, y): Place,
        radius: i32,
        opacity: f64,
        [fill, stroke]: [&str; 2],
        width: i32,
    ) {
        self.write(format_args!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" opacity=\"{opacity}\" fill=\"{fill}\" \
             stroke=\"{stroke}\" stroke-width=\"{width}\"/>\n"
        ));
    }

    /// A line of text of a size \[units\], centred in height on its place.
    pub(crate) fn text(
        &mut self,
        text: &str,
        (x, y): Place,
        anchor: Anchor,
        [family, size]: [&str; 2],
        color: Color,
    ) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (name, opacity, text) = (color.name(), color.opacity, escaped(text));
        self.write(format_args!(
            "<text x=\"{x}\" y=\"{y}\" dy=\"0.5ex\" text-anchor=\"{anchor}\" \
             font-family=\"{family}\" font-size=\"{size}\" opacity=\"{opacity}\" \
             fill=\"{name}\">\n{text}\n</text>\n"
        ));
    }
}

/// Text without what means something, or nothing, in XML. What has no place there becomes a space.
pub(crate) fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            '\'' => escaped += "&apos;",
            '\u{fffe}' | '\u{ffff}' => escaped.push(' '),
            c if c.is_control() => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLUE: Color = Color::new(0, 114, 178);

    #[test]
    fn elements_are_what_svg_calls_them() {
        let mut elements = Elements::default();
        elements.polyline(&[(1, 2), (3, -4)], BLUE.opacity(0.45), 9);
        elements.polygon(&[(0, 0), (5, 0), (0, 5)], BLUE);
        elements.disc((10, 20), 30, BLUE);
        elements.ring((10, 20), 30, BLUE, 4);
        let square = vec![(0, 0), (9, 0), (9, 9)];
        elements.region(&[square], BLUE);
        let lines: Vec<&str> = elements.as_str().lines().collect();
        assert_eq!(
            lines,
            [
                "<polyline fill=\"none\" opacity=\"0.45\" stroke=\"#0072B2\" stroke-width=\"9\" points=\"1,2 3,-4 \"/>",
                "<polygon opacity=\"1\" fill=\"#0072B2\" points=\"0,0 5,0 0,5 \"/>",
                "<circle cx=\"10\" cy=\"20\" r=\"30\" opacity=\"1\" fill=\"#0072B2\" stroke=\"none\" stroke-width=\"1\"/>",
                "<circle cx=\"10\" cy=\"20\" r=\"30\" opacity=\"1\" fill=\"none\" stroke=\"#0072B2\" stroke-width=\"4\"/>",
                "<path fill-rule=\"evenodd\" d=\"M0 0L9 0L9 9Z\" fill=\"#0072B2\"/>",
            ]
        );
    }
}
