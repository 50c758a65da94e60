//! A mechanism that moves: in a natural mode, as its load grows, or from pose to pose.

use std::f64::consts::TAU;

use super::{DeformedFigure, Shown};
use crate::canvas::Canvas;
use crate::error::FigureError;
use crate::geometry::Bounds;
use crate::page::{self, Page, Words};
use crate::scale::largest;
use crate::{gif, png};

/// Times in which a swing is divided, and how long each is seen \[ms\].
const SWING: usize = 20;
const SWING_TIME: u32 = 100;

/// How long a pose is seen \[ms\].
const POSE_TIME: u32 = 200;

/// Figures of a mechanism in one picture that moves, in one box and to one scale: as SVG by itself,
/// without a script, and as GIF. What does not move (a PNG, a reader of SVG that knows no animation)
/// shows the first.
#[derive(Debug, Clone, PartialEq)]
pub struct AnimatedFigure {
    motion: Motion,
}

#[derive(Debug, Clone, PartialEq)]
enum Motion {
    /// Displaced by its displacements times factors that come and go.
    Swing(Box<DeformedFigure>),
    /// One figure after the other.
    Run(Vec<DeformedFigure>),
}

/// The times at which a picture is seen.
struct Times {
    /// Of how many there are, those.
    seen: Vec<bool>,
    /// How long all take \[ms\]; `None` of a picture that does not move.
    takes: Option<u32>,
}

impl AnimatedFigure {
    /// A mechanism that swings in its natural mode from one side to the other; under loads, which come
    /// and go, between what it is with them and without.
    #[must_use]
    pub fn swing(figure: DeformedFigure) -> Self {
        Self {
            motion: Motion::Swing(Box::new(figure)),
        }
    }

    /// One figure after the other, such as the poses of a path, from the first again after the last.
    /// Title, view and names are those of the first; magnified are all by what fits all, where the first
    /// leaves it open.
    ///
    /// # Errors
    /// [`FigureError::NoFrames`] without any.
    pub fn run(figures: Vec<DeformedFigure>) -> Result<Self, FigureError> {
        match figures.is_empty() {
            true => Err(FigureError::NoFrames),
            false => Ok(Self {
                motion: Motion::Run(figures),
            }),
        }
    }

    /// The figure as an SVG document that moves.
    ///
    /// # Errors
    /// As [`DeformedFigure::svg`].
    pub fn svg(&self) -> Result<String, FigureError> {
        self.drawn(None)
    }

    /// The first figure as a PNG file.
    ///
    /// # Errors
    /// As [`svg`](Self::svg).
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        png::render(&self.drawn(Some(0))?)
    }

    /// The figure as a GIF file that moves.
    ///
    /// # Errors
    /// As [`svg`](Self::svg).
    pub fn gif(&self) -> Result<Vec<u8>, FigureError> {
        let frames = (0..self.times()).map(|time| self.drawn(Some(time)));
        gif::render(&frames.collect::<Result<Vec<_>, _>>()?, self.each())
    }

    /// What is drawn, how much it is magnified, and what of, as sentences.
    ///
    /// # Errors
    /// A magnification that is not above zero.
    pub fn caption(&self) -> Result<String, FigureError> {
        let factor = self.factor()?;
        let first = self.first();
        let words = Words {
            title: &first.title,
            subtitle: &self.subtitle(factor),
            captions: &self.captions(factor),
        };
        Ok(words.description())
    }

    fn first(&self) -> &DeformedFigure {
        match &self.motion {
            Motion::Swing(figure) => figure,
            Motion::Run(figures) => &figures[0],
        }
    }

    fn figures(&self) -> &[DeformedFigure] {
        match &self.motion {
            Motion::Swing(figure) => std::slice::from_ref(figure),
            Motion::Run(figures) => figures,
        }
    }

    /// Number of times, and how long each is seen \[ms\].
    fn times(&self) -> usize {
        match &self.motion {
            Motion::Swing(_) => SWING,
            Motion::Run(figures) => figures.len(),
        }
    }

    fn each(&self) -> u32 {
        match &self.motion {
            Motion::Swing(_) => SWING_TIME,
            Motion::Run(_) => POSE_TIME,
        }
    }

    /// The magnification of all.
    fn factor(&self) -> Result<f64, FigureError> {
        let first = self.first();
        let (points, displacements) = self.figures().iter().fold(
            (Vec::new(), Vec::new()),
            |(mut points, mut displacements), figure| {
                points.extend(figure.points());
                displacements.extend(figure.displacements());
                (points, displacements)
            },
        );
        first
            .scale
            .factor(points.into_iter(), displacements.into_iter())
    }

    fn subtitle(&self, factor: f64) -> String {
        let still = self.first().subtitle(factor);
        match &self.motion {
            Motion::Swing(_) => still,
            Motion::Run(figures) => format!("{still}, {} poses", figures.len()),
        }
    }

    /// The lines of the caption that stay as they are.
    fn captions(&self, factor: f64) -> Vec<String> {
        match &self.motion {
            Motion::Swing(figure) => figure.captions(factor),
            Motion::Run(figures) => {
                let displacements = figures.iter().flat_map(DeformedFigure::displacements);
                page::captions(largest(displacements), None)
            }
        }
    }

    /// The document: as it moves, or what is seen at one of the times.
    fn drawn(&self, only: Option<usize>) -> Result<String, FigureError> {
        let factor = self.factor()?;
        match &self.motion {
            Motion::Swing(figure) => self.swinging(figure, factor, only),
            Motion::Run(figures) => self.running(figures, factor, only),
        }
    }

    fn swinging(
        &self,
        figure: &DeformedFigure,
        factor: f64,
        only: Option<usize>,
    ) -> Result<String, FigureError> {
        let mechanism = figure.mechanism()?;
        // There and back are the same: each is drawn once, for two times.
        let drawings = (0..=SWING / 2).map(|time| {
            let turn = (TAU * time as f64 / SWING as f64).cos();
            let part = match figure.shown {
                Shown::Mode { .. } => turn,
                Shown::Deflection => 0.5 + 0.5 * turn,
            };
            figure.drawing(&mechanism, factor * part)
        });
        let drawings = drawings.collect::<Result<Vec<_>, _>>()?;
        let points = drawings
            .iter()
            .flat_map(|drawing| figure.all_points(drawing));
        let page = self.page(factor, Bounds::around(points));
        let size = figure.size();
        Ok(page.svg(|canvas, view| {
            drawings[0].draw_rest(canvas, view);
            for (k, drawing) in drawings.iter().enumerate() {
                let seen = |time: usize| time == k || SWING - time == k;
                self.frame(canvas, only, seen, |canvas| {
                    drawing.draw_deformed(canvas, view)
                });
            }
            figure.notes.draw(canvas, view, size);
        }))
    }

    fn running(
        &self,
        figures: &[DeformedFigure],
        factor: f64,
        only: Option<usize>,
    ) -> Result<String, FigureError> {
        let drawings = figures.iter().map(|figure| {
            let mechanism = figure.mechanism()?;
            Ok((figure, figure.drawing(&mechanism, factor)?))
        });
        let drawings = drawings.collect::<Result<Vec<_>, FigureError>>()?;
        let points = drawings.iter();
        let points = points.flat_map(|(figure, drawing)| figure.all_points(drawing));
        let page = self.page(factor, Bounds::around(points));
        let above = page.captions.len();
        Ok(page.svg(|canvas, view| {
            for (k, (figure, drawing)) in drawings.iter().enumerate() {
                self.frame(
                    canvas,
                    only,
                    |time| time == k,
                    |canvas| {
                        drawing.draw_rest(canvas, view);
                        drawing.draw_deformed(canvas, view);
                        figure.notes.draw(canvas, view, figure.size());
                        if let Some(pose) = &figure.pose {
                            page::caption(canvas, pose, above);
                        }
                    },
                );
            }
        }))
    }

    fn page(&self, factor: f64, bounds: Bounds) -> Page<'_> {
        let first = self.first();
        Page {
            title: &first.title,
            subtitle: self.subtitle(factor),
            legend: first.legend(factor),
            captions: self.captions(factor),
            bounds,
            eye: first.view,
            axes: first.axis_names.as_ref(),
        }
    }

    /// Draws what is seen at some of the times.
    fn frame(
        &self,
        canvas: &mut Canvas,
        only: Option<usize>,
        seen: impl Fn(usize) -> bool,
        draw: impl FnOnce(&mut Canvas),
    ) {
        let times = match only {
            None => Times {
                seen: (0..self.times()).map(seen).collect(),
                takes: Some(self.each() * self.times() as u32),
            },
            Some(time) if seen(time) => Times {
                seen: vec![true],
                takes: None,
            },
            Some(_) => return,
        };
        canvas.frame(&times.seen, times.takes, draw);
    }
}
