//! The PNG of a figure: its SVG, rendered with the embedded font only.

use std::sync::Arc;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb::Database};

use crate::error::FigureError;

/// Pixels of the PNG to a pixel of the SVG, along each side.
const DENSITY: f32 = 2.5;

/// Liberation Sans 2.1.5, under the SIL Open Font License 1.1.
pub(crate) static FONT: &[u8] = include_bytes!("../fonts/LiberationSans-Regular.ttf");

/// Renders an SVG document of ours as a PNG file.
pub(crate) fn render(svg: &str) -> Result<Vec<u8>, FigureError> {
    pixels(svg, DENSITY)?
        .encode_png()
        .map_err(|error| FigureError::Png(Box::new(error)))
}

/// Renders an SVG document of ours with so many pixels to one of its own along each side.
pub(crate) fn pixels(svg: &str, density: f32) -> Result<Pixmap, FigureError> {
    let mut fonts = Database::new();
    fonts.load_font_data(FONT.to_vec());
    let options = Options {
        fontdb: Arc::new(fonts),
        ..Options::default()
    };
    let tree = Tree::from_str(svg, &options).map_err(|error| FigureError::Png(Box::new(error)))?;
    let size = tree.size();
    let [width, height] = [size.width(), size.height()].map(|side| (side * density) as u32);
    let mut pixels = Pixmap::new(width, height).expect("a page has a size");
    let to_pixels = Transform::from_scale(density, density);
    resvg::render(&tree, to_pixels, &mut pixels.as_mut());
    Ok(pixels)
}
