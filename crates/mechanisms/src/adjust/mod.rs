//! A file whose coordinates are rounded, and the nearest one that has the freedoms which these miss.

mod coordinates;

use hyperstat_closure::{Adjusted, Adjusting, LoopClosure, Rounded, Unadjusted};
use hyperstat_model::Model;

use crate::error::Location;
use crate::file::groups;
use crate::file::mechanism::Mechanism;
use crate::text::scope::Open;
use crate::text::tree::Node;
pub use coordinates::Digits;
use coordinates::{Coordinate, Coordinates, Numbers};

/// Most roundings that a coordinate may be moved by.
pub const MOST: f64 = 5.0;
/// The root of the mean square of roundings is under a third of a unit: moves that are larger on the
/// whole than half a unit were not made by rounding.
const MEAN: f64 = 0.5;
/// The coarsest rounding that is looked for where no number has one.
const COARSE: f64 = 1e-3;
/// Joint coordinates of a mechanism that is looked at without being asked to.
const SMALL: usize = 300;

/// What gives a mechanism the freedoms that its rounded coordinates miss.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Adjustment {
    /// Freedoms of the mechanism, idle motions included and drives released.
    pub freedoms: usize,
    /// By how much each of the freedoms is missed as it is written, the least first (lengths over the
    /// mechanism's size).
    pub missed: Vec<f64>,
    /// By how much its loops open along the freedoms as it is written (over the size, or rad).
    pub open: f64,
    /// The largest sine of an angle between the travel of a joint and the beam that it is to slide along.
    pub bent: f64,
    /// What the coordinates were rounded to.
    pub rounded: Digits,
    /// By how much loops stay open in the adjusted mechanism, in configurations that took no part
    /// (over the size, or rad).
    pub misfit: f64,
    /// The numbers that move, in the order of the file.
    pub moved: Vec<Moved>,
    /// Whether some of them stand elsewhere than as numbers in the file: in expressions, in other files, or as parts
    /// of unit vectors. Then it is known that rounding explains what is missed, and there is no text.
    pub elsewhere: bool,
    /// The file with these in their places; everything else is as it was.
    pub text: String,
}

/// A number of a file that moves.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Moved {
    /// Its path, such as `points.A.0` or `joints.A1.kind.axis.2`.
    pub path: String,
    /// Where it is written.
    pub location: Location,
    /// Its value as it is written (m, or a part of a direction).
    pub from: f64,
    /// The new one.
    pub to: f64,
    /// The difference, in roundings.
    pub roundings: f64,
}

/// Why a file is not adjusted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum NotAdjusted {
    /// The freedoms of the mechanism are finite as they are.
    Exact,
    /// No coordinate is a number with few digits: all are exact, or written as expressions.
    NoNumbers,
    /// It nearly has freedoms, but no moves of its numbers by [`MOST`] roundings give them.
    Nothing,
    /// Its loops cannot be closed: a mechanism that is too large, or has joints that do not say how
    /// they move.
    Unknown,
}

/// What is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Asked {
    /// Freedoms, and straight beams.
    All,
    /// Nothing, where only beams are not straight.
    Freedoms,
}

impl Mechanism {
    /// The nearest mechanism that has by finite amounts the freedoms which this one nearly has, and beams
    /// that are straight where joints slide along them: points and axes that are written as numbers
    /// move, by the least amount on the whole, each measured by its rounding.
    ///
    /// # Errors
    /// Why there is none.
    pub fn adjusted(&self) -> Result<Adjustment, NotAdjusted> {
        let closure = LoopClosure::new(&self.model).map_err(|_| NotAdjusted::Unknown)?;
        self.adjust(
            &closure.adjusting(),
            Asked::All,
            Numbers::Written(self.root()),
        )
    }

    /// The same where rounding alone explains that freedoms are missed: nothing is said of a mechanism
    /// that was meant as it is written. `None` of one of very many joints, too.
    pub fn nearly_free(&self) -> Option<Adjustment> {
        let coordinates: usize = (self.model.joints().iter())
            .map(|joint| joint.released().len())
            .sum();
        if coordinates == 0 || coordinates > SMALL {
            return None;
        }
        let closure = LoopClosure::new(&self.model).ok()?;
        let adjusting = closure.adjusting();
        let own = self.adjust(&adjusting, Asked::Freedoms, Numbers::Written(self.root()));
        let found = match own {
            Ok(found) => found,
            Err(NotAdjusted::NoNumbers | NotAdjusted::Nothing) => {
                let (open, root) = Open::mark(self.root(), &[]);
                let values = groups::settled(&root, &open)?;
                let mut sets = [Numbers::Anywhere(&values), Numbers::WithAxes(&values)].into_iter();
                sets.find_map(|numbers| self.adjust(&adjusting, Asked::Freedoms, numbers).ok())?
            }
            Err(_) => return None,
        };
        (found.open > CLOSED).then_some(found)
    }

    /// Paths of the coordinates that are never moved: they are expressions, or stand in another file.
    pub fn held_coordinates(&self) -> Vec<String> {
        coordinates::held(self.root())
    }

    fn adjust(
        &self,
        adjusting: &Adjusting<'_>,
        asked: Asked,
        numbers: Numbers<'_>,
    ) -> Result<Adjustment, NotAdjusted> {
        let mut why = NotAdjusted::NoNumbers;
        let mut sure = asked == Asked::All;
        let mut best: Option<(Coordinates, Adjusted)> = None;
        for coordinates in Coordinates::guesses(numbers) {
            let root = numbers.root();
            let model = |values: &[f64]| self.with_coordinates(root, &coordinates.all, values);
            let values: Vec<f64> = coordinates.all.iter().map(|own| own.value).collect();
            let roundings: Vec<f64> = coordinates.all.iter().map(|own| own.rounding).collect();
            let rounded = Rounded {
                values: &values,
                roundings: &roundings,
                model: &model,
            };
            if asked == Asked::Freedoms && !adjusting.may_be_rounded(&rounded) {
                continue;
            }
            match adjusting.adjusted(&rounded, MOST) {
                // Who did not ask, or has a mechanism that may be meant as it is, is told what rounding
                // explains, and nothing else.
                Ok(found) if sure || found.mean(&rounded) <= MEAN => {
                    let more = |(_, own): &(_, Adjusted)| found.freedoms > own.freedoms;
                    let all = found.freedoms == found.wanted;
                    if best.as_ref().is_none_or(more) {
                        best = Some((coordinates, found));
                    }
                    // With larger roundings there may be more.
                    if all {
                        break;
                    }
                }
                Err(Unadjusted::Exact) => (why, sure) = (NotAdjusted::Exact, false),
                _ if why == NotAdjusted::NoNumbers => why = NotAdjusted::Nothing,
                _ => {}
            }
        }
        if why == NotAdjusted::NoNumbers && !Self::misses_freedoms(adjusting) {
            why = NotAdjusted::Exact;
        }
        let elsewhere = !matches!(numbers, Numbers::Written(_));
        best.map(|(coordinates, found)| self.adjustment(&coordinates, &found, elsewhere))
            .ok_or(why)
    }

    /// Whether freedoms are missed as if by the coarsest rounding, whatever numbers there are.
    fn misses_freedoms(adjusting: &Adjusting<'_>) -> bool {
        adjusting.may_be_rounded(&Rounded {
            values: &[0.0],
            roundings: &[COARSE],
            model: &|_| None,
        })
    }

    /// The model with other values of some coordinates.
    fn with_coordinates(
        &self,
        root: &Node,
        coordinates: &[Coordinate],
        values: &[f64],
    ) -> Option<Model> {
        let mut tree = root.clone();
        for (own, value) in coordinates.iter().zip(values) {
            if *value != own.value {
                tree.replace(&own.steps, Node::number(*value, None, own.place.clone()));
            }
        }
        Some(Self::read(tree, self.registry()).ok()?.model)
    }

    fn adjustment(
        &self,
        coordinates: &Coordinates,
        found: &Adjusted,
        elsewhere: bool,
    ) -> Adjustment {
        let both = coordinates.all.iter().zip(&found.values);
        let mut moved: Vec<(&Coordinate, f64)> = both
            .filter(|(own, to)| own.value != **to)
            .map(|(own, to)| (own, *to))
            .collect();
        moved.sort_by_key(|(own, _)| own.place.span.start);
        let mut text = match elsewhere {
            true => String::new(),
            false => self.root().source().written().to_owned(),
        };
        for (own, to) in moved.iter().rev().filter(|_| !elsewhere) {
            text.replace_range(own.place.span.clone(), &own.digits.written(*to));
        }
        Adjustment {
            freedoms: found.freedoms,
            missed: found.missed.clone(),
            open: found.open,
            bent: found.bent,
            rounded: coordinates.rounded,
            misfit: found.misfit,
            moved: (moved.iter())
                .map(|(own, to)| Moved {
                    path: own.path.clone(),
                    location: own.place.location(),
                    from: own.value,
                    to: *to,
                    roundings: (to - own.value).abs() / own.rounding,
                })
                .collect(),
            elsewhere,
            text,
        }
    }
}

/// Loops that open by less are closed, as far as doubles go: ten times what an adjustment closes them to, so that
/// what is adjusted is never told of.
const CLOSED: f64 = 1e-10;
