//! Where the panels of a map and its colour bar are on the page.

use super::{MapFigure, MapPanel, Samples};
use crate::canvas::WIDTH;
use crate::geometry::Area;
use crate::page::{CAPTION_LINE, MARGIN};
use crate::plane_axes::PlaneAxes;
use crate::quantity::Scaled;

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

/// Places of everything on a map's page.
#[derive(Debug)]
pub(super) struct Layout {
    /// Height of the page \[pixels\].
    pub(super) height: u32,
    pub(super) panels: Vec<Cell>,
    pub(super) bar: Area,
    /// How far left of the bar the name above it starts \[pixels\].
    pub(super) name_room: f64,
    /// The units along the axes.
    pub(super) scaled: [Scaled; 2],
}

/// Cell of a panel.
#[derive(Debug)]
pub(super) struct Cell {
    pub(super) axes: PlaneAxes,
    /// Whether it shows the labels of its lower and its left axis.
    pub(super) labels: [bool; 2],
}

impl Layout {
    /// The places of a map with so many lines of caption.
    pub(super) fn new(map: &MapFigure, captions: usize) -> Self {
        let (axes, panels) = (&map.axes, &map.panels);
        let ranges = ranges(panels);
        let scaled: [Scaled; 2] = std::array::from_fn(|axis| {
            let [least, most] = ranges[axis];
            axes[axis].scaled(least.abs().max(most.abs()))
        });
        let sides = ranges.map(|[least, most]| most - least);
        let columns = map.columns.unwrap_or(match panels.len() {
            0 | 1 => 1,
            2..=4 => 2,
            _ => 3,
        });
        let columns = columns.clamp(1, panels.len().max(1));
        let room = (RIGHT - LEFT - BESIDE * (columns - 1) as f64) / columns as f64;
        // The same scale along both axes where they have the same unit, unless one is far longer.
        let ratio = sides[1] / sides[0];
        let to_scale = axes[0].unit == axes[1].unit && (0.1..10.0).contains(&ratio);
        let ratio = if to_scale { ratio } else { 0.75 };
        let tallest = TALLEST * (RIGHT - LEFT) / (columns as f64).sqrt();
        let width = room.min(tallest / ratio);
        let height = width * ratio;
        let rows = panels.len().div_ceil(columns);
        let places = (0..panels.len()).map(|k| {
            let (row, column) = (k / columns, k % columns);
            let left = LEFT + column as f64 * (width + BESIDE);
            let top = TOP + row as f64 * (height + ABOVE);
            Cell {
                axes: PlaneAxes {
                    area: Area {
                        left,
                        top,
                        right: left + width,
                        bottom: top + height,
                    },
                    x: ranges[0].map(|end| end * scaled[0].factor),
                    y: ranges[1].map(|end| end * scaled[1].factor),
                },
                labels: [k + columns >= panels.len(), column == 0],
            }
        });
        let used = columns.min(panels.len()) as f64;
        let right = LEFT + used * width + (used - 1.0) * BESIDE;
        let bottom = TOP + rows as f64 * (height + ABOVE) - ABOVE;
        let more = CAPTION_LINE * captions.saturating_sub(1) as f64;
        let page = (bottom + BELOW).max(330.0) + more;
        let bar_left = right + 30.0;
        Self {
            height: page.ceil() as u32,
            panels: places.collect(),
            bar: Area {
                left: bar_left,
                top: TOP,
                right: bar_left + 20.0,
                bottom: bottom.clamp(TOP + 140.0, TOP + 480.0),
            },
            name_room: (bar_left + 190.0 - (f64::from(WIDTH) - MARGIN)).clamp(0.0, 60.0),
            scaled,
        }
    }
}

/// What the axes reach over, along x and along y.
fn ranges(panels: &[MapPanel]) -> [[f64; 2]; 2] {
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
