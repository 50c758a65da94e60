//! The drawing of a mechanism in its box of axes.

use crate::canvas::{Canvas, Stroke};
use crate::geometry::{PagePoint, Point, View, hull, mean};
use crate::svg::Color;
use crate::{page, style};

/// What is drawn of a joint axis, over the mechanism's size.
pub(super) const AXIS_LENGTH: f64 = 0.07;

/// Distance at which two marks cannot be told apart \[pixels\].
const SAME_PLACE: f64 = 0.1;

/// What there is to draw, all in space \[m\].
pub(super) struct Drawing<'a> {
    pub(super) curves: Vec<Part<'a>>,
    pub(super) rigid: Vec<Part<'a>>,
    pub(super) axes: Vec<[Point; 2]>,
    pub(super) ground: &'a [Point],
    /// Displaced by the second method.
    pub(super) second: Vec<Point>,
}

/// A link or a rigid body, of one point or more.
pub(super) struct Part<'a> {
    pub(super) undeformed: &'a [Point],
    /// With its displacements magnified.
    pub(super) deformed: Vec<Point>,
}

/// How a rigid body is drawn.
struct BodyStyle {
    fill: Color,
    outline: Stroke,
    spoke: Stroke,
}

impl Drawing<'_> {
    /// Everything that must be in the box.
    pub(super) fn points(&self) -> impl Iterator<Item = Point> {
        let parts = self.curves.iter().chain(&self.rigid);
        parts
            .flat_map(|part| part.undeformed.iter().chain(&part.deformed))
            .chain(self.axes.iter().flatten())
            .chain(self.ground)
            .chain(&self.second)
            .copied()
    }

    /// Draws what is without load.
    pub(super) fn draw_rest(&self, canvas: &mut Canvas, view: &View) {
        let undeformed = BodyStyle {
            fill: style::UNDEFORMED_FILL,
            outline: style::UNDEFORMED,
            spoke: style::UNDEFORMED_SPOKE,
        };
        for body in &self.rigid {
            draw_body(canvas, view, body.undeformed, &undeformed);
        }
        for curve in &self.curves {
            canvas.line(&projected(view, curve.undeformed), style::UNDEFORMED);
        }
        for point in self.ground {
            page::ground_mark(canvas, view.project(*point));
        }
        for axis in &self.axes {
            canvas.line(&projected(view, axis), style::JOINT_AXIS);
        }
    }

    /// Draws what is displaced, from what is to be in the background on.
    pub(super) fn draw_deformed(&self, canvas: &mut Canvas, view: &View) {
        let deformed = BodyStyle {
            fill: style::BODY_FILL,
            outline: style::BODY,
            spoke: style::BODY_SPOKE,
        };
        for body in &self.rigid {
            draw_body(canvas, view, &body.deformed, &deformed);
        }
        for curve in &self.curves {
            canvas.line(&projected(view, &curve.deformed), style::DEFORMED);
        }
        self.draw_second(canvas, view);
    }

    /// Draws the points of the second method, but only one of those in the same place.
    fn draw_second(&self, canvas: &mut Canvas, view: &View) {
        let mut marks = projected(view, &self.second);
        marks.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        marks.dedup_by(|a, b| (a[0] - b[0]).hypot(a[1] - b[1]) < SAME_PLACE);
        for at in marks {
            page::second_mark(canvas, at);
        }
    }
}

fn draw_body(canvas: &mut Canvas, view: &View, points: &[Point], style: &BodyStyle) {
    let center = view.project(mean(points));
    let points = projected(view, points);
    let outline = hull(&points);
    if outline.len() > 2 {
        page::outlined(canvas, &outline, style.fill, style.outline);
    }
    // Without an outline to hold them together, the spokes are the body.
    let spoke = if outline.len() > 2 {
        style.spoke
    } else {
        style.outline
    };
    for point in points {
        canvas.line(&[center, point], spoke);
    }
}

fn projected(view: &View, points: &[Point]) -> Vec<PagePoint> {
    points.iter().map(|point| view.project(*point)).collect()
}
