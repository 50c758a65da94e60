//! The undeformed and the deformed mechanism (the paper's Fig. 9), under loads or in a mode.

mod animation;
mod drawing;
mod notes;

use crate::checks::{self, Displaced};
use crate::error::FigureError;
use crate::geometry::{Bounds, length};
use crate::page::{self, Page, Sample, Words};
use crate::quantity::Quantity;
use crate::scale::{Scale, largest};
use crate::viewpoint::Viewpoint;
use crate::{numbers, png, style};
use drawing::{AXIS_LENGTH, Drawing, Part};

pub use animation::AnimatedFigure;
pub use notes::{Arrow, Frame, Mass, Name, Named, Notes};

/// A mechanism as it was built and as it is under load or in a natural mode, with the displacements
/// magnified.
#[derive(Debug, Clone, PartialEq)]
pub struct DeformedFigure {
    /// Title of the figure.
    pub title: String,
    /// What the displacements are.
    pub shown: Shown,
    /// The elastic links.
    pub curves: Vec<Curve>,
    /// The rigid bodies.
    pub rigid: Vec<RigidBody>,
    /// The axes of the joints, drawn where they are without load.
    pub axes: Vec<Axis>,
    /// Points that are held to the ground, without load \[m, global axes\].
    pub ground: Vec<[f64; 3]>,
    /// Displacements of some points by a second method, to compare with.
    pub second: Option<SecondPoints>,
    /// Magnification of the displacements.
    pub scale: Scale,
    /// Names, loads, masses and frames, drawn where they are without load.
    pub notes: Notes,
    /// Where it is seen from.
    pub view: Viewpoint,
    /// What the axes are called where that is not x, y, z.
    pub axis_names: Option<[String; 3]>,
    /// Which pose it is, in words, as a line of the caption.
    pub pose: Option<String>,
}

/// What the displacements in a [`DeformedFigure`] are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shown {
    /// The deflection under loads \[m\].
    Deflection,
    /// A natural mode, of unit modal mass \[m/√kg\]: its factor is in √kg.
    Mode {
        /// Its number, from 1, lowest first.
        number: usize,
        /// Its frequency \[Hz\].
        frequency: f64,
    },
}

/// A link as its elastic curve, sampled from one end to the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Points of the link without load, one or more \[m, global axes\].
    pub points: Vec<[f64; 3]>,
    /// The displacement of each \[m, global axes\].
    pub displacement: Vec<[f64; 3]>,
}

/// A rigid body by the points where others meet it.
///
/// It is drawn as the convex outline of its points with a spoke to each from their mean.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidBody {
    /// Points of the body without load, one or more \[m, global axes\].
    pub points: Vec<[f64; 3]>,
    /// The displacement of each \[m, global axes\].
    pub displacement: Vec<[f64; 3]>,
}

/// An axis of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// A point on the axis, in the middle of what is drawn of it \[m, global axes\].
    pub at: [f64; 3],
    /// Its direction, global axes; of any length but zero.
    pub direction: [f64; 3],
}

/// Displacements of points of a mechanism by a second method.
#[derive(Debug, Clone, PartialEq)]
pub struct SecondPoints {
    /// Name of the method, as in `reference solver`.
    pub name: String,
    /// Points without load \[m, global axes\].
    pub points: Vec<[f64; 3]>,
    /// The displacement of each \[m, global axes\].
    pub displacement: Vec<[f64; 3]>,
    /// The largest difference between the methods, relative to the largest displacement.
    pub difference: f64,
}

impl DeformedFigure {
    /// The figure as an SVG document.
    ///
    /// # Errors
    ///
    /// A [`FigureError`] for a mechanism without links and rigid bodies, lists that are empty or
    /// of unequal lengths, numbers that are not finite or too large to draw, an axis without
    /// direction, and a magnification that is not above zero.
    pub fn svg(&self) -> Result<String, FigureError> {
        let mechanism = self.mechanism()?;
        let factor = self.factor()?;
        let drawing = self.drawing(&mechanism, factor)?;
        let size = self.size();
        let page = Page {
            title: &self.title,
            subtitle: self.subtitle(factor),
            legend: self.legend(factor),
            captions: self.captions(factor),
            bounds: Bounds::around(self.all_points(&drawing)),
            eye: self.view,
            axes: self.axis_names.as_ref(),
        };
        Ok(page.svg(|canvas, view| {
            drawing.draw_rest(canvas, view);
            drawing.draw_deformed(canvas, view);
            self.notes.draw(canvas, view, size);
        }))
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
        let factor = self.factor()?;
        let words = Words {
            title: &self.title,
            subtitle: &self.subtitle(factor),
            captions: &self.captions(factor),
        };
        Ok(words.description())
    }

    /// Links and rigid bodies, each checked.
    fn mechanism(&self) -> Result<Mechanism<'_>, FigureError> {
        let curves = self.curves.iter().enumerate().map(|(k, curve)| {
            Displaced::new(format!("curve {k}"), &curve.points, &curve.displacement)
        });
        let curves = curves.collect::<Result<Vec<_>, _>>()?;
        let rigid = self.rigid.iter().enumerate().map(|(k, body)| {
            Displaced::new(format!("rigid body {k}"), &body.points, &body.displacement)
        });
        let rigid = rigid.collect::<Result<Vec<_>, _>>()?;
        if curves.is_empty() && rigid.is_empty() {
            return Err(FigureError::NoPoints {
                what: "mechanism".into(),
            });
        }
        checks::drawable("ground", &self.ground)?;
        self.notes.check()?;
        Ok(Mechanism { curves, rigid })
    }

    /// What there is to draw of it, displacements times a factor.
    fn drawing<'a>(
        &'a self,
        mechanism: &Mechanism<'a>,
        factor: f64,
    ) -> Result<Drawing<'a>, FigureError> {
        Ok(Drawing {
            curves: parts(&mechanism.curves, factor)?,
            rigid: parts(&mechanism.rigid, factor)?,
            axes: self.axis_lines(AXIS_LENGTH * self.size())?,
            ground: &self.ground,
            second: self.second_moved(factor)?,
        })
    }

    /// Size of the mechanism without load \[m\].
    fn size(&self) -> f64 {
        Bounds::around(self.points().copied()).diagonal()
    }

    /// Everything that must be in the box.
    fn all_points(&self, drawing: &Drawing<'_>) -> Vec<[f64; 3]> {
        let notes = self.notes.points(self.size());
        drawing.points().chain(notes).collect()
    }

    fn points(&self) -> impl Iterator<Item = &[f64; 3]> {
        let curves = self.curves.iter().flat_map(|curve| &curve.points);
        curves.chain(self.rigid.iter().flat_map(|body| &body.points))
    }

    fn displacements(&self) -> impl Iterator<Item = &[f64; 3]> {
        let curves = self.curves.iter().flat_map(|curve| &curve.displacement);
        curves.chain(self.rigid.iter().flat_map(|body| &body.displacement))
    }

    fn factor(&self) -> Result<f64, FigureError> {
        self.scale.factor(self.points(), self.displacements())
    }

    fn subtitle(&self, factor: f64) -> String {
        match self.shown {
            Shown::Deflection => format!(
                "Undeformed and deformed mechanism, deflection × {}",
                numbers::number(factor)
            ),
            Shown::Mode { number, frequency } => {
                let frequency = Quantity::new("", "Hz").value(frequency);
                format!("Natural mode {number}, at {frequency}, and the mechanism at rest")
            }
        }
    }

    fn captions(&self, factor: f64) -> Vec<String> {
        let largest = largest(self.displacements());
        let told = match self.shown {
            Shown::Deflection => {
                let second = self.second.as_ref();
                page::captions(largest, second.map(|second| second.difference))
            }
            Shown::Mode { .. } => vec![format!(
                "Shape of unit modal mass × {} √kg; its largest translation is drawn as {}.",
                numbers::number(factor),
                numbers::metres(factor * largest)
            )],
        };
        self.pose.iter().cloned().chain(told).collect()
    }

    /// What is drawn of the joint axes: lines of this length \[m\].
    fn axis_lines(&self, drawn: f64) -> Result<Vec<[[f64; 3]; 2]>, FigureError> {
        let places: Vec<_> = self.axes.iter().map(|axis| axis.at).collect();
        let directions: Vec<_> = self.axes.iter().map(|axis| axis.direction).collect();
        checks::drawable("joint axes", &places)?;
        checks::drawable("joint axes, directions", &directions)?;
        let lines = self.axes.iter().enumerate().map(|(index, axis)| {
            let norm = length(axis.direction);
            if norm == 0.0 {
                return Err(FigureError::ZeroAxis { index });
            }
            Ok([-0.5, 0.5].map(|side| {
                let along = |k: usize| side * drawn * (axis.direction[k] / norm);
                std::array::from_fn(|k| axis.at[k] + along(k))
            }))
        });
        lines.collect()
    }

    fn second_moved(&self, factor: f64) -> Result<Vec<[f64; 3]>, FigureError> {
        let Some(second) = &self.second else {
            return Ok(Vec::new());
        };
        checks::difference(&second.name, second.difference)?;
        Displaced::new(&*second.name, &second.points, &second.displacement)?.moved(factor)
    }

    fn legend(&self, factor: f64) -> Vec<(Sample, String)> {
        let (at_rest, deformed) = match self.shown {
            Shown::Deflection => {
                let deformed = format!("deformed, × {}", numbers::number(factor));
                ("undeformed", deformed)
            }
            Shown::Mode { .. } => ("at rest", "mode shape".into()),
        };
        let mut legend = vec![
            (Sample::Line(style::UNDEFORMED), at_rest.to_string()),
            (Sample::Line(style::DEFORMED), deformed),
        ];
        let others = [
            (Sample::Body, "rigid body", self.rigid.is_empty()),
            (
                Sample::Line(style::JOINT_AXIS),
                "joint axis",
                self.axes.is_empty(),
            ),
            (Sample::Ground, "ground", self.ground.is_empty()),
        ];
        let others = others.into_iter().filter(|(_, _, missing)| !missing);
        legend.extend(others.map(|(sample, label, _)| (sample, label.to_string())));
        legend.extend(self.notes.legend());
        legend.extend(
            self.second
                .iter()
                .map(|second| (Sample::Second, second.name.clone())),
        );
        legend
    }
}

/// What a figure is of.
struct Mechanism<'a> {
    curves: Vec<Displaced<'a>>,
    rigid: Vec<Displaced<'a>>,
}

fn parts<'a>(displaced: &[Displaced<'a>], factor: f64) -> Result<Vec<Part<'a>>, FigureError> {
    let part = |part: &Displaced<'a>| {
        Ok(Part {
            undeformed: part.points,
            deformed: part.moved(factor)?,
        })
    };
    displaced.iter().map(part).collect()
}
