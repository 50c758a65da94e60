//! The PDF of a figure: its SVG as lines and letters of the embedded font, without a date.

use std::sync::Arc;

use svg2pdf::usvg::{Options, Tree, fontdb::Database};
use svg2pdf::{ConversionOptions, PageOptions};

use crate::error::FigureError;
use crate::png::FONT;

/// Pixels of the SVG to an inch of the page.
const DENSITY: f32 = 96.0;

/// The PDF of an SVG document that a figure of this crate gave: a page of its size, 238 mm across, on
/// which text stays text. The same document gives the same bytes.
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
    svg2pdf::to_pdf(&tree, ConversionOptions::default(), page)
        .map_err(|error| FigureError::Pdf(error.to_string().into()))
}
