//! The deflected trajectory against the commanded one (the paper's Fig. 8).

use crate::canvas::Canvas;
use crate::checks::{self, Displaced};
use crate::error::FigureError;
use crate::geometry::{Bounds, Point, View};
use crate::page::{self, Page, Sample, Words};
use crate::scale::{Scale, largest};
use crate::viewpoint::Viewpoint;
use crate::{numbers, png, style};

/// Most points, but for the last, at which the deflection and the second method are drawn.
const MOST_MARKS: usize = 40;

/// A trajectory as it was commanded and as it is under load, with the deflection magnified.
#[derive(Debug, Clone, PartialEq)]
pub struct TrajectoryFigure {
    /// Title of the figure.
    pub title: String,
    /// Commanded positions, in order; one or more \[m, global axes\].
    pub commanded: Vec<[f64; 3]>,
    /// The displacement at each of them \[m, global axes\].
    pub displacement: Vec<[f64; 3]>,
    /// The same displacements by a second method, to compare with.
    pub second: Option<SecondMethod>,
    /// Magnification of the displacements.
    pub scale: Scale,
    /// Where it is seen from.
    pub view: Viewpoint,
    /// What the axes are called where that is not x, y, z.
    pub axis_names: Option<[String; 3]>,
}

/// Displacements of a trajectory by a second method.
#[derive(Debug, Clone, PartialEq)]
pub struct SecondMethod {
    /// Name of the method, as in `reference solver`.
    pub name: String,
    /// The commanded positions that it is known at, each by its number from 0; it is drawn at all
    /// of them ([`TrajectoryFigure::marked`] has as many as can be told apart).
    pub at: Vec<usize>,
    /// The displacement at each of these \[m, global axes\].
    pub displacement: Vec<[f64; 3]>,
    /// The largest difference between the methods, relative to the largest displacement.
    pub difference: f64,
}

impl TrajectoryFigure {
    /// The figure as an SVG document.
    ///
    /// # Errors
    ///
    /// A [`FigureError`] for lists that are empty or of unequal lengths, numbers that are not
    /// finite or too large to draw, and a magnification that is not above zero.
    pub fn svg(&self) -> Result<String, FigureError> {
        let ours = Displaced::new("trajectory", &self.commanded, &self.displacement)?;
        let factor = self.factor()?;
        let deflected = ours.moved(factor)?;
        let second = match &self.second {
            Some(second) => {
                checks::difference(&second.name, second.difference)?;
                let commanded = second.commanded(&self.commanded)?;
                Displaced::new(&*second.name, &commanded, &second.displacement)?.moved(factor)?
            }
            None => Vec::new(),
        };
        let page = Page {
            title: &self.title,
            subtitle: subtitle(factor),
            legend: self.legend(factor),
            captions: self.captions(),
            bounds: Bounds::around(
                self.commanded
                    .iter()
                    .chain(&deflected)
                    .chain(&second)
                    .copied(),
            ),
            eye: self.view,
            axes: self.axis_names.as_ref(),
        };
        Ok(page.svg(|canvas, view| draw(canvas, view, &self.commanded, &deflected, &second)))
    }

    /// The figure as a PNG file.
    ///
    /// # Errors
    ///
    /// As [`svg`](Self::svg).
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        png::render(&self.svg()?)
    }

    /// What is drawn, how much it is magnified, and what of, as sentences.
    ///
    /// # Errors
    ///
    /// A magnification that is not above zero.
    pub fn caption(&self) -> Result<String, FigureError> {
        let words = Words {
            title: &self.title,
            subtitle: &subtitle(self.factor()?),
            captions: &self.captions(),
        };
        Ok(words.description())
    }

    /// The places, from 0, at which a trajectory of so many positions is marked: few enough to be
    /// told apart, evenly spaced from the first on, and the last.
    #[must_use]
    pub fn marked(count: usize) -> Vec<usize> {
        let Some(last) = count.checked_sub(1) else {
            return Vec::new();
        };
        let stride = last.div_ceil(MOST_MARKS).max(1);
        (0..last).step_by(stride).chain([last]).collect()
    }

    fn factor(&self) -> Result<f64, FigureError> {
        let (points, displacements) = (self.commanded.iter(), self.displacement.iter());
        self.scale.factor(points, displacements)
    }

    fn captions(&self) -> Vec<String> {
        page::captions(
            largest(self.displacement.iter()),
            self.second.as_ref().map(|second| second.difference),
        )
    }

    fn legend(&self, factor: f64) -> Vec<(Sample, String)> {
        let deflected = format!("deflected, × {}", numbers::number(factor));
        let mut legend = vec![
            (Sample::Line(style::UNDEFORMED), "commanded".into()),
            (Sample::Line(style::DEFORMED), deflected),
            (Sample::Line(style::DEFLECTION), "deflection".into()),
            (Sample::Start, "start".into()),
        ];
        legend.extend(
            self.second
                .iter()
                .map(|second| (Sample::Second, second.name.clone())),
        );
        legend
    }
}

impl SecondMethod {
    /// The positions that it is known at.
    fn commanded(&self, all: &[Point]) -> Result<Vec<Point>, FigureError> {
        let position = |&index: &usize| {
            all.get(index)
                .copied()
                .ok_or_else(|| FigureError::NoSuchPoint {
                    name: self.name.clone(),
                    index,
                    points: all.len(),
                })
        };
        self.at.iter().map(position).collect()
    }
}

fn subtitle(factor: f64) -> String {
    format!(
        "Commanded and deflected trajectory, deflection × {}",
        numbers::number(factor)
    )
}

fn draw(
    canvas: &mut Canvas,
    view: &View,
    commanded: &[Point],
    deflected: &[Point],
    second: &[Point],
) {
    let project =
        |points: &[Point]| -> Vec<_> { points.iter().map(|p| view.project(*p)).collect() };
    let [commanded, deflected, second] = [commanded, deflected, second].map(project);
    for k in TrajectoryFigure::marked(commanded.len()) {
        canvas.line(&[commanded[k], deflected[k]], style::DEFLECTION);
    }
    canvas.line(&commanded, style::UNDEFORMED);
    canvas.line(&deflected, style::DEFORMED);
    for path in [&commanded, &deflected] {
        page::start_mark(canvas, path[0]);
    }
    for at in second {
        page::second_mark(canvas, at);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_few_and_include_both_ends() {
        let marked = TrajectoryFigure::marked;
        assert!(marked(0).is_empty());
        assert_eq!(marked(1), [0]);
        assert_eq!(marked(3), [0, 1, 2]);
        assert_eq!(marked(42)[19..], [38, 40, 41]);
        assert!(marked(100_000).len() <= MOST_MARKS + 1);
    }
}
