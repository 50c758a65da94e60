//! Colours, widths and letters, the same in all figures.
//!
//! The colours are those of Okabe and Ito, which readers with any kind of colour vision tell
//! apart.

use crate::canvas::{Lettering, Stroke};
use crate::svg::{Anchor, Color};

pub(crate) const WHITE: Color = Color::new(255, 255, 255);
const BLACK: Color = Color::new(25, 25, 25);
const DARK: Color = Color::new(85, 85, 85);
const GREY: Color = Color::new(150, 150, 150);
const PALE: Color = Color::new(186, 186, 186);
const LIGHT: Color = Color::new(222, 222, 222);
const BLUE: Color = Color::new(0, 114, 178);
const GREEN: Color = Color::new(0, 158, 115);
const VERMILLION: Color = Color::new(213, 94, 0);

/// Lines on the walls of the box of axes.
pub(crate) const GRID: Stroke = Stroke::solid(LIGHT, 0.8);
/// Edges of the box of axes.
pub(crate) const EDGE: Stroke = Stroke::solid(GREY, 0.9);
/// The axes with their ticks.
pub(crate) const AXIS: Stroke = Stroke::solid(DARK, 1.2);

/// Links without load, or the commanded trajectory: so wide that it is seen under what lies on it.
pub(crate) const UNDEFORMED: Stroke = Stroke::solid(PALE, 4.4);
/// Links under load, or the deflected trajectory.
pub(crate) const DEFORMED: Stroke = Stroke::solid(BLUE, 2.4);
/// From points to where they are displaced.
pub(crate) const DEFLECTION: Stroke = Stroke::solid(BLUE.opacity(0.45), 0.9);
/// A rigid body without load.
pub(crate) const UNDEFORMED_SPOKE: Stroke = Stroke::solid(PALE, 2.2);
pub(crate) const UNDEFORMED_FILL: Color = PALE.opacity(0.35);
/// A rigid body under load.
pub(crate) const BODY: Stroke = Stroke::solid(GREEN, 2.4);
pub(crate) const BODY_FILL: Color = GREEN.opacity(0.3);
/// Spokes of a rigid body, inside its outline.
pub(crate) const BODY_SPOKE: Stroke = Stroke::solid(GREEN, 1.4);
/// Axes of joints.
pub(crate) const JOINT_AXIS: Stroke = Stroke {
    color: BLACK,
    width: 1.1,
    dashes: &[7.0, 2.6, 1.2, 2.6],
};
/// Marks of what is held to the ground, and of where a trajectory starts.
pub(crate) const MARK: Color = BLACK;
pub(crate) const MARK_STROKE: Stroke = Stroke::solid(BLACK, 1.2);
/// Around a mark on any colour.
pub(crate) const MARK_EDGE: Stroke = Stroke::solid(WHITE, 1.2);
/// Forces and moments.
pub(crate) const LOAD: Stroke = Stroke::solid(VERMILLION, 2.0);
/// The axes x, y, z of a frame, in colours of Tol that are told apart from those of loads, rigid bodies and
/// links.
pub(crate) const TRIAD: [Stroke; 3] = [
    Stroke::solid(Color::new(170, 51, 119), 1.8),
    Stroke::solid(Color::new(153, 153, 51), 1.8),
    Stroke::solid(Color::new(51, 187, 238), 1.8),
];
/// From a name to what has it, where they are apart.
pub(crate) const LEADER: Stroke = Stroke::solid(GREY, 0.8);
/// Points of a second method.
pub(crate) const SECOND: Stroke = Stroke::solid(VERMILLION, 1.5);
pub(crate) const SECOND_RADIUS: f64 = 4.2;

const fn lettering(size: f64, color: Color, anchor: Anchor) -> Lettering {
    Lettering {
        size,
        color,
        anchor,
    }
}

pub(crate) const TITLE: Lettering = lettering(21.0, BLACK, Anchor::Start);
pub(crate) const SUBTITLE: Lettering = lettering(15.0, DARK, Anchor::Start);
pub(crate) const CAPTION: Lettering = lettering(14.0, DARK, Anchor::Start);
pub(crate) const LEGEND: Lettering = lettering(14.5, BLACK, Anchor::Start);
pub(crate) const TICK: Lettering = lettering(13.0, DARK, Anchor::Middle);
pub(crate) const AXIS_NAME: Lettering = lettering(15.0, BLACK, Anchor::Middle);
/// Labels of ticks that end at their tick.
pub(crate) const TICK_RIGHT: Lettering = lettering(13.0, DARK, Anchor::Start);
pub(crate) const TICK_LEFT: Lettering = lettering(13.0, DARK, Anchor::End);
pub(crate) const AXIS_NAME_LEFT: Lettering = lettering(15.0, BLACK, Anchor::Start);
pub(crate) const PANEL: Lettering = lettering(14.5, BLACK, Anchor::Middle);
/// Heading of a group of bars, names beside bars, and labels at their ends.
pub(crate) const GROUP: Lettering = lettering(15.0, BLACK, Anchor::Start);
pub(crate) const BAR_NAME: Lettering = lettering(14.0, BLACK, Anchor::End);
pub(crate) const BAR_LABEL: Lettering = lettering(13.0, BLACK, Anchor::Start);
/// Shares of a whole, and those against it.
pub(crate) const BAR: Color = BLUE;
pub(crate) const BAR_AGAINST: Color = VERMILLION;
/// Names of joints, and of bodies, in a drawing.
pub(crate) const JOINT_NAME: Lettering = lettering(12.5, BLACK, Anchor::Middle);
pub(crate) const BODY_NAME: Lettering = lettering(12.5, BLUE, Anchor::Middle);
pub(crate) const NAME_HALO: Color = WHITE.opacity(0.78);
pub(crate) const CONTOUR_LABEL: Lettering = lettering(11.5, BLACK, Anchor::Middle);
pub(crate) const CONTOUR_HALO: Color = WHITE.opacity(0.78);
/// Contours over light and over dark colours.
pub(crate) const CONTOUR: Stroke = Stroke::solid(BLACK.opacity(0.75), 0.9);
pub(crate) const CONTOUR_ON_DARK: Stroke = Stroke::solid(WHITE.opacity(0.8), 0.9);
/// Poses without a result.
pub(crate) const MISSING: Stroke = Stroke::solid(GREY, 1.0);
/// Radius of the dots at the points of a line \[pixels\].
pub(crate) const DOT: f64 = 3.4;
/// Lines of a diagram, one after the other.
pub(crate) const SERIES: [Stroke; 6] = [
    Stroke::solid(BLUE, 2.2),
    Stroke {
        color: VERMILLION,
        width: 2.2,
        dashes: &[9.0, 5.0],
    },
    Stroke {
        color: GREEN,
        width: 2.2,
        dashes: &[2.0, 4.5],
    },
    Stroke {
        color: Color::new(204, 121, 167),
        width: 2.2,
        dashes: &[9.0, 4.0, 2.0, 4.0],
    },
    Stroke::solid(Color::new(230, 159, 0), 2.2),
    Stroke {
        color: Color::new(86, 180, 233),
        width: 2.2,
        dashes: &[14.0, 5.0],
    },
];
