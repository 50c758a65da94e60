//! Figures of stiffness results, as SVG, PNG and PDF, and moving ones as SVG and GIF.

#![doc = include_str!("../README.md")]

mod axes_box;
mod bars;
mod canvas;
mod checks;
mod contours;
mod deformed;
mod error;
mod geometry;
mod gif;
mod lines;
mod map;
mod numbers;
mod page;
mod paths;
mod pdf;
mod plane_axes;
mod png;
mod quantity;
mod refine;
mod round;
mod scale;
mod sketch;
mod style;
mod svg;
mod trajectory;
mod viewpoint;

pub use bars::{Bar, BarFigure, BarGroup};
pub use deformed::{
    AnimatedFigure, Arrow, Axis, Curve, DeformedFigure, Frame, Mass, Name, Named, Notes, RigidBody,
    SecondPoints, Shown,
};
pub use error::FigureError;
pub use lines::{Diagram, LineFigure, MOST_SERIES, Series};
pub use map::{ColorScale, Extreme, MapFigure, MapPanel, Samples};
pub use pdf::pdf;
pub use quantity::Quantity;
pub use scale::Scale;
pub use sketch::{Pen, Rgb, Sketch};
pub use trajectory::{SecondMethod, TrajectoryFigure};
pub use viewpoint::Viewpoint;
