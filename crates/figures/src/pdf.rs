//! The PDF of a figure: its SVG as lines and letters of the embedded font, without a date.

use std::sync::Arc;

use svg2pdf::usvg::{Group, Node, Options, Tree, fontdb::Database};
use svg2pdf::{ConversionOptions, PageOptions};

use crate::error::FigureError;
use crate::png::FONT;

/// Pixels of the SVG to an inch of the page.
const DENSITY: f32 = 96.0;

/// The PDF of an SVG document that a figure of this crate gave: a page of its size, 238 mm across, on
/// which text stays text. Where it has letters that the embedded font has not, readers of PDFs leave them
/// out: all text is then drawn, with the same empty boxes in their places as in a PNG. The same document gives
/// the same bytes.
///
/// # Errors
/// [`FigureError::Pdf`] for what is no SVG document.
pub fn pdf(svg: &str) -> Result<Vec<u8>, FigureError> {
    let mut fonts = Database::new();
    fonts.load_font_data(FONT.to_vec());
    let options = Options {
        fontdb: Arc::new(fonts),
        ..Options::default()
    };
    let tree = Tree::from_str(svg, &options).map_err(|error| FigureError::Pdf(Box::new(error)))?;
    let page = PageOptions { dpi: DENSITY };
    let options = ConversionOptions {
        embed_text: !lacks_letters(tree.root()),
        ..ConversionOptions::default()
    };
    svg2pdf::to_pdf(&tree, options, page)
        .map(|bytes| ordered(&bytes))
        .map_err(|error| FigureError::Pdf(error.to_string().into()))
}

/// Whether a letter of the text has no glyph.
fn lacks_letters(group: &Group) -> bool {
    group.children().iter().any(|node| match node {
        Node::Group(inner) => lacks_letters(inner),
        Node::Text(text) => {
            let mut glyphs = text
                .layouted()
                .iter()
                .flat_map(|span| &span.positioned_glyphs);
            glyphs.any(|glyph| glyph.id.0 == 0)
        }
        _ => false,
    })
}

/// The same file with the entries of its dictionaries of resources in order, where svg2pdf leaves them
/// to chance. Each is a line, `/xo3 12 0 R`, so that all places in the file stay.
fn ordered(bytes: &[u8]) -> Vec<u8> {
    let mut lines: Vec<&[u8]> = bytes.split_inclusive(|byte| *byte == b'\n').collect();
    let mut inside = false;
    let is_entry: Vec<bool> = (lines.iter())
        .map(|line| {
            inside = match line.trim_ascii() {
                b"stream" => true,
                end if end.ends_with(b"endstream") => false,
                _ => inside,
            };
            !inside && is_resource(line)
        })
        .collect();
    let mut from = 0;
    while from < lines.len() {
        let count = is_entry[from..].iter().take_while(|own| **own).count();
        lines[from..from + count].sort_by_key(|line| (line.len(), *line));
        from += count.max(1);
    }
    lines.concat()
}

/// Whether a line is an entry of a dictionary of resources.
fn is_resource(line: &[u8]) -> bool {
    let words: Vec<&[u8]> = line.trim_ascii().split(|byte| *byte == b' ').collect();
    let [name, number, b"0", b"R"] = words[..] else {
        return false;
    };
    let digits = |text: &[u8]| !text.is_empty() && text.iter().all(u8::is_ascii_digit);
    let letters = name
        .iter()
        .skip(1)
        .take_while(|byte| byte.is_ascii_lowercase());
    let letters = letters.count();
    name.starts_with(b"/") && letters > 0 && digits(&name[1 + letters..]) && digits(number)
}

#[cfg(test)]
mod tests {
    use super::{ordered, pdf};
    use crate::sketch::Sketch;

    #[test]
    fn letters_that_the_font_has_not_are_drawn() {
        let of = |text: &str| {
            let svg = Sketch::svg([200, 100], "", |page| {
                page.words(text, [100.0, 50.0], 15.0, [0, 0, 0]);
            });
            pdf(&svg).unwrap()
        };
        let has_font = |file: Vec<u8>| file.windows(9).any(|bytes| bytes == b"/FontFile");
        assert!(has_font(of("Größe → Ω")));
        assert!(!has_font(of("k33 中文")));
    }

    #[test]
    fn resources_are_in_order() {
        let file = b"<<\n  /xo10 12 0 R\n  /xo2 7 0 R\n>>\nstream\n/b2 1 0 R\n/a1 1 0 R\n\nendstream\n/gs1 3 0 R\n/gs0 4 0 R\n/Root 2 0 R\n";
        let expected = b"<<\n  /xo2 7 0 R\n  /xo10 12 0 R\n>>\nstream\n/b2 1 0 R\n/a1 1 0 R\n\nendstream\n/gs0 4 0 R\n/gs1 3 0 R\n/Root 2 0 R\n";
        assert_eq!(ordered(file), expected);
    }
}
