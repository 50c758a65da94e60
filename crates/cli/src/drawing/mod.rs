//! Figures of all kinds, drawn, captioned and written in one way: for `hyperstat plot` and for the
//! `figures` of a job.

mod budget;
mod deformed;

use std::path::{Path, PathBuf};

use hyperstat_figures::{
    BarFigure, DeformedFigure, FigureError, LineFigure, MapFigure, TrajectoryFigure,
};
use nalgebra::Vector6;

use crate::atomic::AtomicFile;
use crate::error::CliError;
pub(crate) use budget::budget;
pub(crate) use deformed::{compare, deformed, mode};

/// Name of the second method in the figures.
pub(crate) const SECOND: &str = "reference solver";

/// A figure of any kind.
pub(crate) enum Drawing {
    Map(MapFigure),
    Lines(LineFigure),
    Trajectory(TrajectoryFigure),
    Deformed(DeformedFigure),
    Budget(BarFigure),
}

impl Drawing {
    /// The figure as an SVG document.
    fn svg(&self) -> Result<String, FigureError> {
        match self {
            Self::Map(figure) => figure.svg(),
            Self::Lines(figure) => figure.svg(),
            Self::Trajectory(figure) => figure.svg(),
            Self::Deformed(figure) => figure.svg(),
            Self::Budget(figure) => figure.svg(),
        }
    }

    /// The figure as a PNG file.
    fn png(&self) -> Result<Vec<u8>, FigureError> {
        match self {
            Self::Map(figure) => figure.png(),
            Self::Lines(figure) => figure.png(),
            Self::Trajectory(figure) => figure.png(),
            Self::Deformed(figure) => figure.png(),
            Self::Budget(figure) => figure.png(),
        }
    }

    /// What a caption says of it.
    pub(crate) fn caption(&self) -> Result<String, FigureError> {
        Ok(match self {
            Self::Map(figure) => format!("{} {}", figure.subtitle, figure.caption()),
            Self::Lines(figure) => format!("{} {}", figure.subtitle, figure.caption()),
            Self::Trajectory(figure) => figure.caption()?,
            Self::Deformed(figure) => figure.caption()?,
            Self::Budget(figure) => format!("{} {}", figure.subtitle, figure.caption()),
        })
    }

    /// How far a second method in it is off at most, relative to the largest displacement.
    pub(crate) fn difference(&self) -> Option<f64> {
        match self {
            Self::Trajectory(figure) => figure.second.as_ref().map(|second| second.difference),
            Self::Deformed(figure) => figure.second.as_ref().map(|second| second.difference),
            _ => None,
        }
    }

    /// Writes the figure as `STEM.svg` and `STEM.png`; both are drawn before the first is written.
    pub(crate) fn write(&self, stem: &Path) -> Result<[PathBuf; 2], CliError> {
        let [as_svg, as_png] = files(stem);
        let cannot_draw = |path: &Path, source| CliError::Figure {
            path: path.into(),
            source,
        };
        let svg = self.svg().map_err(|source| cannot_draw(&as_svg, source))?;
        let png = self.png().map_err(|source| cannot_draw(&as_png, source))?;
        for (path, content) in [(&as_svg, svg.as_bytes()), (&as_png, &png)] {
            AtomicFile::write(path, content).map_err(|source| CliError::Write {
                path: path.clone(),
                source,
            })?;
        }
        Ok([as_svg, as_png])
    }
}

/// The files `STEM.svg` and `STEM.png` of a figure.
pub(crate) fn files(stem: &Path) -> [PathBuf; 2] {
    ["svg", "png"].map(|extension| {
        let mut path = stem.as_os_str().to_owned();
        path.push(".");
        path.push(extension);
        PathBuf::from(path)
    })
}

/// Title of a figure of one configuration: the mechanism's name, or the job's with its design and
/// pose; and the case.
pub(crate) fn title(
    name: &str,
    design: Option<usize>,
    pose: Option<usize>,
    case: Option<&str>,
) -> String {
    let numbers = [("design", design), ("pose", pose)];
    let numbers = numbers
        .into_iter()
        .filter_map(|(what, number)| Some(format!("{what} {}", number?)));
    let case = case.map(|case| format!("case {case}"));
    let parts: Vec<_> = std::iter::once(name.to_string())
        .chain(numbers)
        .chain(case)
        .collect();
    parts.join(", ")
}

/// The translation of a displacement.
pub(crate) fn linear(displacement: &Vector6<f64>) -> [f64; 3] {
    [displacement[0], displacement[1], displacement[2]]
}

/// The largest difference between two lists of displacements over the largest displacement in
/// either, over `least` where all are smaller; zero where nothing moves.
pub(crate) fn difference(ours: &[[f64; 3]], others: &[[f64; 3]], least: f64) -> f64 {
    difference_in(ours, others, ours, least)
}

/// The same over the largest displacement of the second list or of `all`.
pub(crate) fn difference_in(
    ours: &[[f64; 3]],
    others: &[[f64; 3]],
    all: &[[f64; 3]],
    least: f64,
) -> f64 {
    let norm = |v: &[f64; 3]| v[0].hypot(v[1]).hypot(v[2]);
    let largest = all.iter().chain(others).map(norm).fold(least, f64::max);
    let pairs = ours.iter().zip(others);
    let apart = pairs
        .map(|(a, b)| norm(&[a[0] - b[0], a[1] - b[1], a[2] - b[2]]))
        .fold(0.0, f64::max);
    if largest == 0.0 { 0.0 } else { apart / largest }
}

#[cfg(test)]
mod tests {
    use super::{difference, title};

    #[test]
    fn the_difference_is_relative_to_the_largest_displacement() {
        let ours = [[0.0, 3.0, 4.0], [1.0, 0.0, 0.0]];
        let others = [[0.0, 3.0, 4.0], [1.0, 0.5, 0.0]];
        assert_eq!(difference(&ours, &others, 1.0), 0.1);
        assert_eq!(difference(&[[0.0; 3]], &[[0.0; 3]], 0.0), 0.0);
        assert_eq!(difference(&[[0.0; 3]], &[[0.0, 2.0, 0.0]], 0.0), 1.0);
        assert_eq!(difference(&[[0.0; 3]], &[[0.0, 2.0, 0.0]], 4.0), 0.5);
    }

    #[test]
    fn titles_name_what_is_drawn() {
        assert_eq!(title("portal", None, None, None), "portal");
        let all = title("delta", Some(2), Some(12), Some("push"));
        assert_eq!(all, "delta, design 2, pose 12, case push");
    }
}
