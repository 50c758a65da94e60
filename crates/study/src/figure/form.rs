//! The forms that figures have as files.

use std::path::{Path, PathBuf};

use hyperstat_figures::FigureError;

use super::drawing::Drawing;

/// A form in which a figure is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// SVG.
    Svg,
    /// PNG.
    Png,
    /// PDF.
    Pdf,
    /// GIF, of a figure that moves.
    Gif,
}

impl Form {
    /// The forms of every figure, and a PDF where it is asked for.
    pub fn all(pdf: bool) -> Vec<Self> {
        let more = pdf.then_some(Self::Pdf);
        [Self::Svg, Self::Png].into_iter().chain(more).collect()
    }

    fn extension(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Pdf => "pdf",
            Self::Gif => "gif",
        }
    }

    /// The file's bytes.
    ///
    /// # Errors
    /// The figure cannot be drawn.
    pub fn drawn(self, drawing: &Drawing) -> Result<Vec<u8>, FigureError> {
        match self {
            Self::Svg => drawing.svg().map(String::into_bytes),
            Self::Png => drawing.png(),
            Self::Pdf => drawing.pdf(),
            Self::Gif => drawing.gif().map(Option::unwrap_or_default),
        }
    }

    /// The files of a figure in these forms, `STEM.svg` and so on.
    pub fn files(stem: &Path, forms: &[Self]) -> Vec<PathBuf> {
        let file = |form: &Self| {
            let mut path = stem.as_os_str().to_owned();
            path.push(".");
            path.push(form.extension());
            PathBuf::from(path)
        };
        forms.iter().map(file).collect()
    }
}
