//! The GIF of a moving figure: its frames as pictures.

use gif::{Encoder, Frame, Repeat};

use crate::error::FigureError;
use crate::png;

/// How well colours are chosen, from 1, best, to 30.
const SPEED: i32 = 10;

/// Renders SVG documents of ours as the frames of a GIF that repeats, each shown for so many
/// milliseconds.
pub(crate) fn render(frames: &[String], each: u32) -> Result<Vec<u8>, FigureError> {
    let failed = |error| FigureError::Gif(Box::new(error));
    let mut file = Vec::new();
    let mut encoder: Option<Encoder<&mut Vec<u8>>> = None;
    let mut file_of = Some(&mut file);
    for svg in frames {
        let pixels = png::pixels(svg, 1.0)?;
        let [width, height] = [pixels.width(), pixels.height()].map(|side| side as u16);
        if let Some(file) = file_of.take() {
            let mut begun = Encoder::new(file, width, height, &[]).map_err(failed)?;
            begun.set_repeat(Repeat::Infinite).map_err(failed)?;
            encoder = Some(begun);
        }
        let mut frame = Frame::from_rgba_speed(width, height, &mut pixels.take(), SPEED);
        frame.delay = (each / 10) as u16;
        if let Some(encoder) = &mut encoder {
            encoder.write_frame(&frame).map_err(failed)?;
        }
    }
    drop(encoder);
    Ok(file)
}
