//! Where the panels of a map and its colour bar are on the page.

use super::{MapFigure, MapPanel, Samples};
use crate::canvas::WIDTH;
use crate::geometry::Area;
use crate::page::{CAPTION_LINE, MARGIN};
use crate::plane_axes::PlaneAxes;
use crate::quantity::{Quantity, Scaled};

/// Left edge of the panels, and right edge of the room for them \[pixels\].
const LEFT: f64 = 84.0;
const RIGHT: f64 = 742.0;

/// Upper edge of the first panel \[pixels\].
const TOP: f64 = 116.0;

/// Distance of panels beside and above each other \[pixels\].
const BESIDE: f64 = 40.0;
const ABOVE: f64 = 42.0;

/// Room for the axis below the panels and a line of the caption \[pixels\].
const BELOW: f64 = 92.0;

/// Largest height of a panel over the room's width.
const TALLEST: f64 = 0.86;

/// The same where every panel has the labels of its own axes.
const BESIDE_LABELS: f64 = 88.0;
const ABOVE_LABELS: f64 = 92.0;

/// Places of everything on a map's page.
#[derive(Debug)]
pub(super) struct Layout {
    /// Height of the page \[pixels\].
    pub(super) height: u32,
    pub(super) panels: Vec<Cell>,
    pub(super) bar: Area,
    /// How far left of the bar the name above it starts \[pixels\].
    pub(super) name_room: f64,
}

/// Cell of a panel.
#[derive(Debug)]
pub(super) struct Cell {
    pub(super) axes: PlaneAxes,
    /// Whether it shows the labels of its lower and its left axis.
    pub(super) labels: [bool; 2],
    /// The units along the axes.
    pub(super) scaled: [Scaled; 2],
}

/// What the axes of a panel reach over.
struct Frame {
    ranges: [[f64; 2]; 2],
    scaled: [Scaled; 2],
    /// Its height over its width.
    ratio: f64,
}

impl Frame {
    /// That of panels of the same axes.
    fn of(axes: &[Quantity; 2], panels: &[&MapPanel]) -> Self {
        let ranges = ranges(panels);
        let sides = ranges.map(|[least, most]| most - least);
        // The same scale along both axes where they have the same unit, unless one is far longer.
        let ratio = sides[1] / sides[0];
        let to_scale = axes[0].unit == axes[1].unit && (0.1..10.0).contains(&ratio);
        Self {
            ranges,
            scaled: std::array::from_fn(|axis| {
                let [least, most] = ranges[axis];
                axes[axis].scaled(least.abs().max(most.abs()))
            }),
            ratio: if to_scale { ratio } else { 0.75 },
        }
    }
}

impl Layout {
    /// The places of a map with so many lines of caption.
    pub(super) fn new(map: &MapFigure, captions: usize) -> Self {
        let panels = &map.panels;
        let frame = |panel: &MapPanel| {
            let axes = map.axes_of(panel);
            let same = panels.iter().filter(|other| map.axes_of(other) == axes);
            Frame::of(axes, &same.collect::<Vec<_>>())
        };
        let frames: Vec<Frame> = panels.iter().map(frame).collect();
        let alike = panels.iter().all(|panel| panel.axes.is_none());
        let (beside, above) = match alike {
            true => (BESIDE, ABOVE),
            false => (BESIDE_LABELS, ABOVE_LABELS),
        };
        let columns = map.columns.unwrap_or(match panels.len() {
            0 | 1 => 1,
            2..=4 => 2,
            _ => 3,
        });
        let columns = columns.clamp(1, panels.len().max(1));
        let room = (RIGHT - LEFT - beside * (columns - 1) as f64) / columns as f64;
        let tallest = TALLEST * (RIGHT - LEFT) / (columns as f64).sqrt();
        let width = |frame: &Frame| room.min(tallest / frame.ratio);
        let width = frames.iter().map(width).fold(room, f64::min);
        let mut top = TOP;
        let mut cells = Vec::with_capacity(frames.len());
        for row in frames.chunks(columns) {
            let mut tall = 0.0_f64;
            for (column, frame) in row.iter().enumerate() {
                let left = LEFT + column as f64 * (width + beside);
                let height = width * frame.ratio;
                tall = tall.max(height);
                let along = |axis: usize| {
                    let factor = frame.scaled[axis].factor;
                    frame.ranges[axis].map(|end| end * factor)
                };
                cells.push(Cell {
                    axes: PlaneAxes {
                        area: Area {
                            left,
                            top,
                            right: left + width,
                            bottom: top + height,
                        },
                        x: along(0),
                        y: along(1),
                    },
                    labels: [
                        !alike || cells.len() + columns >= panels.len(),
                        !alike || column == 0,
                    ],
                    scaled: frame.scaled.clone(),
                });
            }
            top += tall + above;
        }
        let used = columns.min(panels.len()) as f64;
        let right = LEFT + used * width + (used - 1.0) * beside;
        let bottom = top - above;
        let more = CAPTION_LINE * captions.saturating_sub(1) as f64;
        let page = (bottom + BELOW).max(330.0) + more;
        let bar_left = right + 30.0;
        Self {
            height: page.ceil() as u32,
            panels: cells,
            bar: Area {
                left: bar_left,
                top: TOP,
                right: bar_left + 20.0,
                bottom: bottom.clamp(TOP + 140.0, TOP + 480.0),
            },
            name_room: (bar_left + 190.0 - (f64::from(WIDTH) - MARGIN)).clamp(0.0, 60.0),
        }
    }
}

/// What the axes reach over, along x and along y.
fn ranges(panels: &[&MapPanel]) -> [[f64; 2]; 2] {
    let mut ranges = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    let mut scattered = false;
    let mut widen = |axis: usize, value: f64| {
        let [least, most] = ranges[axis];
        ranges[axis] = [least.min(value), most.max(value)];
    };
    for panel in panels {
        match &panel.samples {
            Samples::Grid { x, y, .. } => {
                x.iter().for_each(|x| widen(0, *x));
                y.iter().for_each(|y| widen(1, *y));
            }
            Samples::Points { at, .. } => {
                scattered = true;
                at.iter().for_each(|[x, y]| {
                    widen(0, *x);
                    widen(1, *y);
                });
            }
        }
    }
    let largest = (ranges.iter()).fold(0.0_f64, |side, [least, most]| side.max(most - least));
    ranges.map(|[least, most]| {
        let side = most - least;
        // Dots are not cut by the frame; a line of them has some height.
        let air = if scattered {
            (0.05 * side).max(0.03 * largest)
        } else {
            0.0
        };
        let least_air = 1e-9 * least.abs().max(most.abs());
        let air = if side + 2.0 * air > least_air {
            air
        } else {
            air + least_air.max(if largest > 0.0 { 0.1 * largest } else { 0.1 })
        };
        [least - air, most + air]
    })
}
