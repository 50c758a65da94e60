//! The report of `hyperstat adjust`.

use std::path::Path;

use hyperstat_mechanisms::{Adjustment, Mechanism, Moved, NotAdjusted};
use serde::Serialize;

use crate::error::StudyError;
use crate::near::rounding;

/// How the coordinates of a file are moved. Field names are those of the JSON output.
#[derive(Debug, Serialize)]
pub struct AdjustReport {
    /// Name of the mechanism.
    pub name: String,
    /// Freedoms of the mechanism, idle motions included and drives released; none where nothing moves.
    pub freedoms: Option<usize>,
    /// By how much each of the freedoms was missed, the least first: singular values of the conditions of
    /// the loops, lengths over the mechanism's size.
    pub missed: Vec<f64>,
    /// By how much the loops opened along the freedoms (over the size, or rad).
    pub open: f64,
    /// The largest sine of an angle between the travel of a joint and the beam that it is to slide along.
    pub bent: f64,
    /// By how much the loops open after the moves, in configurations that took no part in finding them.
    pub misfit: f64,
    /// What the coordinates were rounded to, in words.
    pub rounded: Option<String>,
    /// Points and axes that move, in the order of the file.
    pub moved: Vec<MovedReport>,
    /// The most that a number moves, in roundings.
    pub most_roundings: f64,
}

/// A point or an axis that moves.
#[derive(Debug, Serialize)]
pub struct MovedReport {
    /// Its path in the file, such as `points.A` or `joints.A1.kind.axis`.
    pub path: String,
    /// Line of its first number that moves.
    pub line: usize,
    /// How far it moves: m of a point; of an axis the length of the change of what is written.
    pub distance: f64,
    /// The most that a number of it moves, in roundings.
    pub roundings: f64,
    /// Its numbers that move.
    pub numbers: Vec<NumberReport>,
}

/// A number that moves.
#[derive(Debug, Serialize)]
pub struct NumberReport {
    /// Its path in the file, such as `points.A.0`.
    pub path: String,
    /// Line of it.
    pub line: usize,
    /// Column of it.
    pub column: usize,
    /// Its value as it is written, in SI.
    pub from: f64,
    /// The new one.
    pub to: f64,
}

impl AdjustReport {
    /// How the mechanism of the file `path` is adjusted, and the text of the file with the new numbers;
    /// `None` where its freedoms are right as they are.
    ///
    /// # Errors
    /// It nearly has freedoms, and no moves of its numbers give them.
    pub fn new(mechanism: &Mechanism, path: &Path) -> Result<(Self, Option<String>), StudyError> {
        let name = mechanism.model.name.clone();
        match mechanism.adjusted() {
            Ok(found) => Ok((Self::of(name, &found), Some(found.text))),
            Err(NotAdjusted::Exact) => Ok((Self::nothing(name), None)),
            Err(why) => Err(StudyError::Unadjusted {
                path: path.into(),
                why,
                held: mechanism.held_coordinates(),
            }),
        }
    }

    fn nothing(name: String) -> Self {
        Self {
            name,
            freedoms: None,
            missed: Vec::new(),
            open: 0.0,
            bent: 0.0,
            misfit: 0.0,
            rounded: None,
            moved: Vec::new(),
            most_roundings: 0.0,
        }
    }

    fn of(name: String, found: &Adjustment) -> Self {
        let mut moved: Vec<MovedReport> = Vec::new();
        for number in &found.moved {
            let (path, _) = number.path.rsplit_once('.').unwrap_or((&number.path, ""));
            match moved.iter_mut().find(|own| own.path == path) {
                Some(own) => own.add(number),
                None => {
                    let mut own = MovedReport {
                        path: path.into(),
                        line: number.location.line,
                        distance: 0.0,
                        roundings: 0.0,
                        numbers: Vec::new(),
                    };
                    own.add(number);
                    moved.push(own);
                }
            }
        }
        Self {
            name,
            freedoms: Some(found.freedoms),
            missed: found.missed.clone(),
            open: found.open,
            bent: found.bent,
            misfit: found.misfit,
            rounded: Some(rounding(found.rounded)),
            most_roundings: moved.iter().map(|own| own.roundings).fold(0.0, f64::max),
            moved,
        }
    }
}

impl MovedReport {
    fn add(&mut self, number: &Moved) {
        self.distance = self.distance.hypot(number.to - number.from);
        self.roundings = self.roundings.max(number.roundings);
        self.numbers.push(NumberReport {
            path: number.path.clone(),
            line: number.location.line,
            column: number.location.column,
            from: number.from,
            to: number.to,
        });
    }
}
