//! What stands beside a mechanism where it is asked for: names, loads, masses and frames.

use crate::canvas::{Canvas, Lettering, text_width};
use crate::checks;
use crate::error::FigureError;
use crate::geometry::{PagePoint, Point, View, length};
use crate::page::{self, DRAWING, Sample};
use crate::style;

/// What stands beside the mechanism as it is without load.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Notes {
    /// Names of joints and bodies.
    pub names: Vec<Name>,
    /// Forces and moments.
    pub loads: Vec<Arrow>,
    /// Masses.
    pub masses: Vec<Mass>,
    /// Frames of joints, or of the output.
    pub frames: Vec<Frame>,
}

/// A name in the drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Name {
    /// The point that it is written beside \[m, global axes\].
    pub at: [f64; 3],
    /// The name.
    pub text: String,
    /// What has it.
    pub of: Named,
}

/// What has a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Named {
    /// A joint.
    Joint,
    /// A body.
    Body,
}

/// A force or a moment: an arrow that ends where it acts, of the same length for all.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrow {
    /// Where it acts \[m, global axes\].
    pub at: [f64; 3],
    /// Its direction, global axes; of any length but zero.
    pub direction: [f64; 3],
    /// Whether it is a moment, whose arrow has two heads.
    pub moment: bool,
}

/// A mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mass {
    /// Where it is \[m, global axes\].
    pub at: [f64; 3],
    /// How much \[kg\].
    pub mass: f64,
}

/// A frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Its origin \[m, global axes\].
    pub at: [f64; 3],
    /// Its axes x, y, z as unit vectors, global axes.
    pub axes: [[f64; 3]; 3],
}

/// Length of arrows and of the axes of frames, over the mechanism's size.
const ARROW: f64 = 0.11;
const TRIAD: f64 = 0.045;

/// Distances from a point at which its name is tried \[pixels\].
const RINGS: [f64; 4] = [13.0, 24.0, 38.0, 56.0];
/// From here on a line leads from the name to the point \[pixels\].
const LED: f64 = 20.0;
/// Directions in which it is tried: the sides and the corners, the upper right one first.
const SIDES: [PagePoint; 8] = [
    [0.7, -0.7],
    [-0.7, -0.7],
    [0.7, 0.7],
    [-0.7, 0.7],
    [1.0, 0.0],
    [-1.0, 0.0],
    [0.0, -1.0],
    [0.0, 1.0],
];

impl Notes {
    /// Refuses what cannot be drawn.
    pub(super) fn check(&self) -> Result<(), FigureError> {
        let names: Vec<_> = self.names.iter().map(|name| name.at).collect();
        checks::drawable("names", &names)?;
        let loads: Vec<_> = self.loads.iter().map(|load| load.at).collect();
        checks::drawable("loads", &loads)?;
        let directions: Vec<_> = self.loads.iter().map(|load| load.direction).collect();
        checks::drawable("loads, directions", &directions)?;
        let masses: Vec<_> = self.masses.iter().map(|mass| mass.at).collect();
        checks::drawable("masses", &masses)?;
        let frames: Vec<_> = self.frames.iter().flat_map(|frame| frame.axes).collect();
        checks::drawable("frames, axes", &frames)?;
        let frames: Vec<_> = self.frames.iter().map(|frame| frame.at).collect();
        checks::drawable("frames", &frames)?;
        match self
            .loads
            .iter()
            .position(|load| length(load.direction) == 0.0)
        {
            Some(index) => Err(FigureError::ZeroAxis { index }),
            None => Ok(()),
        }
    }

    /// Everything that must be in the box, of a mechanism of this size \[m\].
    pub(super) fn points(&self, size: f64) -> Vec<Point> {
        let tails = self.loads.iter().map(|load| tail(load, size));
        let ends = self.frames.iter().flat_map(|frame| {
            let end = |axis: [f64; 3]| along(frame.at, axis, TRIAD * size);
            frame.axes.map(end)
        });
        tails.chain(ends).collect()
    }

    /// What is to be in the legend.
    pub(super) fn legend(&self) -> impl Iterator<Item = (Sample, String)> {
        let has = |moment: bool| self.loads.iter().any(|load| load.moment == moment);
        let entries = [
            (Sample::Force, "force", has(false)),
            (Sample::Moment, "moment", has(true)),
            (Sample::Mass, "mass", !self.masses.is_empty()),
            (
                Sample::Line(style::TRIAD[0]),
                "x of a frame",
                !self.frames.is_empty(),
            ),
            (Sample::Line(style::TRIAD[1]), "y", !self.frames.is_empty()),
            (Sample::Line(style::TRIAD[2]), "z", !self.frames.is_empty()),
        ];
        let there = entries.into_iter().filter(|(.., there)| *there);
        there.map(|(sample, label, _)| (sample, label.into()))
    }

    /// Draws all, names last.
    pub(super) fn draw(&self, canvas: &mut Canvas, view: &View, size: f64) {
        for frame in &self.frames {
            for (axis, stroke) in frame.axes.into_iter().zip(style::TRIAD) {
                let ends = [frame.at, along(frame.at, axis, TRIAD * size)];
                canvas.line(&ends.map(|end| view.project(end)), stroke);
            }
        }
        for mass in &self.masses {
            page::mass_mark(canvas, view.project(mass.at));
        }
        for load in &self.loads {
            let ends = [tail(load, size), load.at].map(|end| view.project(end));
            page::arrow(canvas, ends, if load.moment { 2 } else { 1 });
        }
        let mut taken = Vec::new();
        for name in &self.names {
            draw_name(canvas, view.project(name.at), name, &mut taken);
        }
    }
}

/// Where an arrow begins.
fn tail(load: &Arrow, size: f64) -> Point {
    along(load.at, load.direction, -ARROW * size)
}

/// A point at a distance along a direction.
fn along(at: Point, direction: [f64; 3], distance: f64) -> Point {
    let norm = length(direction);
    std::array::from_fn(|k| at[k] + distance * (direction[k] / norm))
}

/// A box on the page: its centre and half of its sides.
type Taken = (PagePoint, PagePoint);

/// Writes a name beside a point, where it covers no other name if there is such a place.
fn draw_name(canvas: &mut Canvas, point: PagePoint, name: &Name, taken: &mut Vec<Taken>) {
    let lettering: Lettering = match name.of {
        Named::Joint => style::JOINT_NAME,
        Named::Body => style::BODY_NAME,
    };
    let half = [
        0.5 * text_width(&name.text, lettering.size),
        0.6 * lettering.size,
    ];
    let place =
        |ring: f64, side: PagePoint| [0, 1].map(|k| point[k] + side[k] * (ring + 0.7 * half[k]));
    let places = RINGS
        .into_iter()
        .flat_map(|ring| SIDES.map(|side| (ring, place(ring, side))));
    let covered = |at: &PagePoint| -> f64 {
        let with = |(other, of): &Taken| {
            let common = [0, 1].map(|k| (half[k] + of[k] - (at[k] - other[k]).abs()).max(0.0));
            common[0] * common[1]
        };
        let area = [[DRAWING.left, DRAWING.right], [DRAWING.top, DRAWING.bottom]];
        let beyond = [0, 1].map(|k| {
            let [least, most] = area[k];
            (least - at[k] + half[k]).max(0.0) + (at[k] + half[k] - most).max(0.0)
        });
        taken.iter().map(with).sum::<f64>() + 100.0 * (beyond[0] + beyond[1])
    };
    let mut best: Option<(f64, f64, PagePoint)> = None;
    for (ring, at) in places {
        let covered = covered(&at);
        if best.is_none_or(|(least, ..)| covered < least) {
            best = Some((covered, ring, at));
        }
        if covered == 0.0 {
            break;
        }
    }
    let Some((_, ring, at)) = best else { return };
    if ring > LED {
        canvas.line(&[point, at], style::LEADER);
    }
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let corners = corners.map(|corner: PagePoint| [0, 1].map(|k| at[k] + corner[k] * half[k]));
    canvas.polygon(&corners, style::NAME_HALO);
    canvas.text(&name.text, at, lettering);
    taken.push((at, half));
}
