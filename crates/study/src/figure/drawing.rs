//! A figure of any kind.

use hyperstat_figures::{
    AnimatedFigure, BarFigure, DeformedFigure, FigureError, LineFigure, MapFigure, TrajectoryFigure,
};

/// A figure of any kind.
#[derive(Debug)]
pub enum Drawing {
    /// A quantity over planes of the workspace.
    Map(MapFigure),
    /// Quantities along the poses, or over a column.
    Lines(LineFigure),
    /// The commanded trajectory and the deflected one.
    Trajectory(TrajectoryFigure),
    /// A mechanism displaced by loads or in a natural mode.
    Deformed(DeformedFigure),
    /// Where a deflection comes from.
    Budget(BarFigure),
    /// A mechanism that moves.
    Moving(AnimatedFigure),
}

impl Drawing {
    /// The figure as an SVG document.
    ///
    /// # Errors
    /// It cannot be drawn.
    pub fn svg(&self) -> Result<String, FigureError> {
        match self {
            Self::Map(figure) => figure.svg(),
            Self::Lines(figure) => figure.svg(),
            Self::Trajectory(figure) => figure.svg(),
            Self::Deformed(figure) => figure.svg(),
            Self::Budget(figure) => figure.svg(),
            Self::Moving(figure) => figure.svg(),
        }
    }

    /// The figure as a PNG file.
    ///
    /// # Errors
    /// It cannot be drawn.
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        match self {
            Self::Map(figure) => figure.png(),
            Self::Lines(figure) => figure.png(),
            Self::Trajectory(figure) => figure.png(),
            Self::Deformed(figure) => figure.png(),
            Self::Budget(figure) => figure.png(),
            Self::Moving(figure) => figure.png(),
        }
    }

    /// The figure as a PDF file; of one that moves, what it shows first.
    ///
    /// # Errors
    /// It cannot be drawn.
    pub fn pdf(&self) -> Result<Vec<u8>, FigureError> {
        hyperstat_figures::pdf(&self.svg()?)
    }

    /// The figure as a GIF file that moves; `None` of one that does not.
    ///
    /// # Errors
    /// It cannot be drawn.
    pub fn gif(&self) -> Result<Option<Vec<u8>>, FigureError> {
        match self {
            Self::Moving(figure) => figure.gif().map(Some),
            _ => Ok(None),
        }
    }

    /// The same, moving: a mechanism that swings in its mode, or whose loads come and go. Others stay
    /// as they are.
    #[must_use]
    pub fn moving(self) -> Self {
        match self {
            Self::Deformed(figure) => Self::Moving(AnimatedFigure::swing(figure)),
            other => other,
        }
    }

    /// What a caption says of it.
    ///
    /// # Errors
    /// It cannot be drawn.
    pub fn caption(&self) -> Result<String, FigureError> {
        Ok(match self {
            Self::Map(figure) => format!("{} {}", figure.subtitle, figure.caption()),
            Self::Lines(figure) => format!("{} {}", figure.subtitle, figure.caption()),
            Self::Trajectory(figure) => figure.caption()?,
            Self::Deformed(figure) => figure.caption()?,
            Self::Moving(figure) => figure.caption()?,
            Self::Budget(figure) => format!("{} {}", figure.subtitle, figure.caption()),
        })
    }

    /// How far a second method in it is off at most, relative to the largest displacement.
    pub fn difference(&self) -> Option<f64> {
        match self {
            Self::Trajectory(figure) => figure.second.as_ref().map(|second| second.difference),
            Self::Deformed(figure) => figure.second.as_ref().map(|second| second.difference),
            _ => None,
        }
    }
}
