//! Colours, widths and letters, the same in all figures.
//!
//! The colours are those of Okabe and Ito, which readers with any kind of colour vision tell
//! apart.

use plotters::style::RGBAColor;
use plotters::style::text_anchor::HPos;

use crate::canvas::{Lettering, Stroke};

pub(crate) const WHITE: RGBAColor = RGBAColor(255, 255, 255, 1.0);
const BLACK: RGBAColor = RGBAColor(25, 25, 25, 1.0);
const DARK: RGBAColor = RGBAColor(85, 85, 85, 1.0);
const GREY: RGBAColor = RGBAColor(150, 150, 150, 1.0);
const PALE: RGBAColor = RGBAColor(186, 186, 186, 1.0);
const LIGHT: RGBAColor = RGBAColor(222, 222, 222, 1.0);
const BLUE: RGBAColor = RGBAColor(0, 114, 178, 1.0);
const GREEN: RGBAColor = RGBAColor(0, 158, 115, 1.0);
const VERMILLION: RGBAColor = RGBAColor(213, 94, 0, 1.0);

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
pub(crate) const DEFLECTION: Stroke = Stroke::solid(RGBAColor(0, 114, 178, 0.45), 0.9);
/// A rigid body without load.
pub(crate) const UNDEFORMED_SPOKE: Stroke = Stroke::solid(PALE, 2.2);
pub(crate) const UNDEFORMED_FILL: RGBAColor = RGBAColor(186, 186, 186, 0.35);
/// A rigid body under load.
pub(crate) const BODY: Stroke = Stroke::solid(GREEN, 2.4);
pub(crate) const BODY_FILL: RGBAColor = RGBAColor(0, 158, 115, 0.3);
/// Spokes of a rigid body, inside its outline.
pub(crate) const BODY_SPOKE: Stroke = Stroke::solid(GREEN, 1.4);
/// Axes of joints.
pub(crate) const JOINT_AXIS: Stroke = Stroke {
    color: BLACK,
    width: 1.1,
    dashes: &[7.0, 2.6, 1.2, 2.6],
};
/// Marks of what is held to the ground, and of where a trajectory starts.
pub(crate) const MARK: RGBAColor = BLACK;
pub(crate) const MARK_STROKE: Stroke = Stroke::solid(BLACK, 1.2);
/// Points of a second method.
pub(crate) const SECOND: Stroke = Stroke::solid(VERMILLION, 1.5);
pub(crate) const SECOND_RADIUS: f64 = 4.2;

const fn lettering(size: f64, color: RGBAColor, anchor: HPos) -> Lettering {
    Lettering {
        size,
        color,
        anchor,
    }
}

pub(crate) const TITLE: Lettering = lettering(21.0, BLACK, HPos::Left);
pub(crate) const SUBTITLE: Lettering = lettering(15.0, DARK, HPos::Left);
pub(crate) const CAPTION: Lettering = lettering(14.0, DARK, HPos::Left);
pub(crate) const LEGEND: Lettering = lettering(14.5, BLACK, HPos::Left);
pub(crate) const TICK: Lettering = lettering(13.0, DARK, HPos::Center);
pub(crate) const AXIS_NAME: Lettering = lettering(15.0, BLACK, HPos::Center);
/// Labels of ticks that end at their tick.
pub(crate) const TICK_RIGHT: Lettering = lettering(13.0, DARK, HPos::Left);
pub(crate) const TICK_LEFT: Lettering = lettering(13.0, DARK, HPos::Right);
pub(crate) const AXIS_NAME_LEFT: Lettering = lettering(15.0, BLACK, HPos::Left);
pub(crate) const PANEL: Lettering = lettering(14.5, BLACK, HPos::Center);
/// Heading of a group of bars, names beside bars, and labels at their ends.
pub(crate) const GROUP: Lettering = lettering(15.0, BLACK, HPos::Left);
pub(crate) const BAR_NAME: Lettering = lettering(14.0, BLACK, HPos::Right);
pub(crate) const BAR_LABEL: Lettering = lettering(13.0, BLACK, HPos::Left);
/// Shares of a whole, and those against it.
pub(crate) const BAR: RGBAColor = BLUE;
pub(crate) const BAR_AGAINST: RGBAColor = VERMILLION;
pub(crate) const CONTOUR_LABEL: Lettering = lettering(11.5, BLACK, HPos::Center);
pub(crate) const CONTOUR_HALO: RGBAColor = RGBAColor(255, 255, 255, 0.78);
/// Contours over light and over dark colours.
pub(crate) const CONTOUR: Stroke = Stroke::solid(RGBAColor(25, 25, 25, 0.75), 0.9);
pub(crate) const CONTOUR_ON_DARK: Stroke = Stroke::solid(RGBAColor(255, 255, 255, 0.8), 0.9);
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
        color: RGBAColor(204, 121, 167, 1.0),
        width: 2.2,
        dashes: &[9.0, 4.0, 2.0, 4.0],
    },
    Stroke::solid(RGBAColor(230, 159, 0, 1.0), 2.2),
    Stroke {
        color: RGBAColor(86, 180, 233, 1.0),
        width: 2.2,
        dashes: &[14.0, 5.0],
    },
];
