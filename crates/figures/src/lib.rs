//! Figures of stiffness results, as SVG and PNG.

#![doc = include_str!("../README.md")]

mod axes_box;
mod canvas;
mod checks;
mod deformed;
mod error;
mod geometry;
mod numbers;
mod page;
mod png;
mod round;
mod scale;
mod style;
mod trajectory;

pub use deformed::{Axis, Curve, DeformedFigure, RigidBody, SecondPoints};
pub use error::FigureError;
pub use scale::Scale;
pub use trajectory::{SecondMethod, TrajectoryFigure};
