//! Figures of stiffness results, as SVG and PNG.

#![doc = include_str!("../README.md")]

mod axes_box;
mod bars;
mod canvas;
mod checks;
mod contours;
mod deformed;
mod error;
mod geometry;
mod lines;
mod map;
mod numbers;
mod page;
mod paths;
mod plane_axes;
mod png;
mod quantity;
mod refine;
mod round;
mod scale;
mod style;
mod svg;
mod trajectory;
mod viewpoint;

pub use bars::{Bar, BarFigure, BarGroup};
pub use deformed::{
    Arrow, Axis, Curve, DeformedFigure, Frame, Mass, Name, Named, Notes, RigidBody, SecondPoints,
    Shown,
};
pub use error::FigureError;
pub use lines::{Diagram, LineFigure, MOST_SERIES, Series};
pub use map::{ColorScale, MapFigure, MapPanel, Samples};
pub use quantity::Quantity;
pub use scale::Scale;
pub use trajectory::{SecondMethod, TrajectoryFigure};
pub use viewpoint::Viewpoint;
