//! Geometry moved by the least amount that gives a mechanism the freedoms that it nearly has.
//!
//! Coordinates that are written with few digits take freedoms away from an over-constrained mechanism,
//! or leave it some at home alone. What is wanted is that its loops close along every one of these
//! freedoms by finite amounts: at configurations some way along them, in which the joints' coordinates
//! are unknown as well as the geometry. Of all that meets these conditions the geometry is taken that is
//! nearest to the one that is written, each number measured by its rounding; whether it is right is
//! asked of configurations that took no part.

mod effect;
mod fit;
mod freedoms;
mod rails;
mod sample;

use hyperstat_model::Model;

use crate::closure::LoopClosure;
use effect::Effects;
use fit::Fit;
use freedoms::Freedoms;
use rails::Rails;

/// Numbers that the geometry of a model is made of, with how far each was rounded.
#[derive(Clone, Copy)]
pub struct Rounded<'a> {
    /// The numbers, as they are written.
    pub values: &'a [f64],
    /// What the last digit of each is worth.
    pub roundings: &'a [f64],
    /// The model with other values in their places; `None` where these make no mechanism.
    pub model: &'a dyn Fn(&[f64]) -> Option<Model>,
}

/// A geometry that has the freedoms which the one that is written nearly has.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Adjusted {
    /// The numbers; those that need not move are as they were.
    pub values: Vec<f64>,
    /// Freedoms of the mechanism, all drives released.
    pub freedoms: usize,
    /// The most freedoms that the geometry which is written may have been meant to have: more than
    /// [`Adjusted::freedoms`] where no geometry so near has them.
    pub wanted: usize,
    /// How far each of the freedoms is missed in the geometry that is written, the least first: singular
    /// values of the conditions of the loops, lengths over the mechanism's size.
    pub missed: Vec<f64>,
    /// By how much loops open along the freedoms in the geometry that is written (over the size, or rad).
    pub open: f64,
    /// The largest sine of an angle between the travel of a joint and the beam that it is to slide along.
    pub bent: f64,
    /// By how much loops stay open in the adjusted geometry, in configurations that took no part in
    /// the adjustment (over the size, or rad).
    pub misfit: f64,
}

impl Adjusted {
    /// The most that a number has moved, in roundings.
    pub fn most(&self, rounded: &Rounded<'_>) -> f64 {
        let moves = self.moves(rounded);
        moves.fold(0.0, f64::max)
    }

    /// The root of the mean square of all moves, in roundings.
    pub fn mean(&self, rounded: &Rounded<'_>) -> f64 {
        let sum: f64 = self.moves(rounded).map(|m| m * m).sum();
        (sum / self.values.len().max(1) as f64).sqrt()
    }

    fn moves<'a>(&'a self, rounded: &'a Rounded<'_>) -> impl Iterator<Item = f64> + 'a {
        let both = self.values.iter().zip(rounded.values);
        both.zip(rounded.roundings)
            .map(|((to, from), h)| ((to - from) / h).abs())
    }
}

/// Why a geometry is not adjusted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unadjusted {
    /// Its freedoms are finite as they are.
    Exact,
    /// It nearly has freedoms, but no geometry within so many roundings has them by finite amounts.
    Nothing,
}

/// A mechanism whose geometry may be moved: what does not depend on how its numbers were rounded, found once.
#[derive(Debug)]
pub struct Adjusting<'c> {
    closure: &'c LoopClosure,
    freedoms: Freedoms,
    rails: Rails,
}

impl LoopClosure {
    /// What moves of the geometry can give this mechanism.
    pub fn adjusting(&self) -> Adjusting<'_> {
        Adjusting {
            closure: self,
            freedoms: Freedoms::of(&self.system),
            rails: Rails::of(self),
        }
    }

    /// The largest of the roundings, lengths over the size.
    fn relative(&self, rounded: &Rounded<'_>) -> f64 {
        let largest = rounded.roundings.iter().copied().fold(0.0, f64::max);
        largest / self.system.size.min(1.0)
    }
}

impl Adjusting<'_> {
    /// The geometry nearest to the one of the mechanism, which `rounded` says the numbers of, that has by
    /// finite amounts the freedoms which it nearly has, and in which the beams are straight that joints
    /// slide along; no number moves by more than `most` roundings.
    ///
    /// # Errors
    /// It has them already, or there is no such geometry.
    pub fn adjusted(&self, rounded: &Rounded<'_>, most: f64) -> Result<Adjusted, Unadjusted> {
        let Self {
            closure,
            freedoms,
            rails,
        } = self;
        let wanted = self.candidates(rounded);
        if wanted.is_empty() && rails.is_empty() {
            return Err(Unadjusted::Exact);
        }
        let effects = Effects::of(closure, rounded, rails).ok_or(Unadjusted::Nothing)?;
        let bends = effects.rails(rails, rounded);
        let wanted = match (wanted.is_empty(), bends.none(&effects.bent)) {
            (true, true) => return Err(Unadjusted::Exact),
            (true, false) => vec![freedoms.exact()],
            _ => wanted,
        };
        let fit = Fit::new(closure, rounded, &effects, (rails, &bends));
        let largest = wanted.first().copied().unwrap_or(0);
        let found = wanted.into_iter().find_map(|count| {
            let mut found = fit.adjusted(freedoms, count)?;
            found.wanted = largest;
            (found.most(rounded) <= most).then_some(found)
        });
        let exact = freedoms.exact();
        let meant = largest <= exact || !freedoms.is_clear(largest);
        let finite = || bends.none(&effects.bent) && freedoms.are_finite(&closure.system, exact);
        found.ok_or_else(|| match meant && finite() {
            true => Unadjusted::Exact,
            false => Unadjusted::Nothing,
        })
    }

    /// Whether roundings like these may have taken a freedom, or left it at home alone: if not,
    /// [`Adjusting::adjusted`] has beams alone to make straight.
    pub fn may_be_rounded(&self, rounded: &Rounded<'_>) -> bool {
        !self.candidates(rounded).is_empty()
    }

    /// Numbers of freedoms that it may have been meant to have.
    fn candidates(&self, rounded: &Rounded<'_>) -> Vec<usize> {
        let system = &self.closure.system;
        (self.freedoms).candidates(system, self.closure.relative(rounded))
    }
}
