//! The nearest geometry whose loops close at all of some configurations.

use hyperstat_model::Model;
use nalgebra::{DMatrix, DVector};

use super::effect::Effects;
use super::freedoms::{CLOSED, Freedoms};
use super::rails::{Bends, Rails};
use super::sample::{self, Basis, Sample};
use super::{Adjusted, Rounded};
use crate::closure::LoopClosure;
use crate::equations::System;
use crate::linkage::Linkage;

/// Configurations that the fit begins with at least, and that are added where others are not closed.
const SAMPLES: usize = 6;
const MORE: usize = 4;
/// Times that some are added.
const ROUNDS: usize = 4;
/// Configurations that are tried afterwards.
const TRIED: usize = 4;
/// Steps of a fit at most, and of them those to the nearest geometry.
const STEPS: usize = 16;
const NEAREST: usize = 3;
/// Loops that stay open by no more are closed as far as doubles go.
const ROUND: f64 = 1e-15;
/// Least damping, relative to the conditions: they are squared.
const DAMPING: f64 = 1e-7;
/// Roundings beyond which a fit is given up.
const LOST: f64 = 100.0;
/// Moves below this part of a rounding are none: such numbers stay as they are written.
const NONE: f64 = 1e-6;

/// What is fitted.
pub(super) struct Fit<'a> {
    closure: &'a LoopClosure,
    rounded: &'a Rounded<'a>,
    effects: &'a Effects,
    rails: &'a Rails,
    bends: &'a Bends,
}

/// Linear conditions on the moves of all numbers, in roundings.
struct Conditions {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
}

impl<'a> Fit<'a> {
    pub fn new(
        closure: &'a LoopClosure,
        rounded: &'a Rounded<'a>,
        effects: &'a Effects,
        (rails, bends): (&'a Rails, &'a Bends),
    ) -> Self {
        Self {
            closure,
            rounded,
            effects,
            rails,
            bends,
        }
    }

    /// The nearest geometry that has `count` freedoms by finite amounts.
    pub fn adjusted(&self, freedoms: &Freedoms, count: usize) -> Option<Adjusted> {
        let basis = Basis::new(&freedoms.motions, count);
        let rows = self.closure.system.closing_rows() + count;
        let conditions = rows.saturating_sub(freedoms.values.len()).max(1);
        let mut samples = SAMPLES
            .max(self.rounded.values.len().div_ceil(conditions))
            .min(4 * SAMPLES);
        for _ in 0..ROUNDS {
            let moves = self.fitted(&basis, samples)?;
            let (values, misfit) = self.tried(&basis, samples, &moves)?;
            if misfit <= 0.1 * CLOSED {
                return Some(Adjusted {
                    values,
                    freedoms: count,
                    wanted: count,
                    missed: freedoms.values[..count].to_vec(),
                    open: sample::opening(&self.closure.system, &basis, 0..TRIED)?,
                    bent: self.bends.largest(&self.effects.bent),
                    misfit,
                });
            }
            samples += MORE;
        }
        None
    }

    /// The moves, in roundings, after which the loops close at this many configurations.
    fn fitted(&self, basis: &Basis, samples: usize) -> Option<DVector<f64>> {
        let home = &self.closure.system;
        let mut samples: Vec<Sample> = (0..samples)
            .map(|k| Sample::placed(home, basis, k))
            .collect::<Option<_>>()?;
        let mut moves = DVector::zeros(self.rounded.values.len());
        // What each number may move by; none of it where it need not.
        let mut scales = self.scales();
        let mut best = (f64::INFINITY, moves.clone());
        // How far the geometry is off, over its size: a rounding at first.
        let rounding = self.closure.relative(self.rounded);
        let mut off = rounding;
        for k in 0..STEPS {
            if k == NEAREST {
                for (own, scale) in moves.iter_mut().zip(&mut scales) {
                    let own: &mut f64 = own;
                    if own.abs() < NONE {
                        (*own, *scale) = (0.0, 0.0);
                    }
                }
            }
            let model = self.model_at(&moves)?;
            let system = self.system_of(&model)?;
            let splits = samples.iter().map(|sample| {
                let effect = self.effects.on_loops(&system, &sample.configuration);
                sample.split(&system, basis, &scaled(effect, &scales))
            });
            let splits: Vec<_> = splits.collect::<Option<_>>()?;
            let by_moves = self.bends_by_moves(&scales);
            let bends = self.bends_of(&model);
            let parts: Vec<_> = (splits.iter())
                .map(|split| (&split.effect, &split.misfit))
                .chain([(&by_moves, &bends)])
                .collect();
            let left = parts.iter().filter(|part| !part.1.is_empty());
            let left = left.map(|part| part.1.amax()).fold(0.0, f64::max);
            if k > NEAREST && left < best.0 {
                best = (left, moves.clone());
            }
            if k > NEAREST && left <= ROUND {
                break;
            }
            // The nearest geometry of all at first; then from there to where the loops close.
            let change = match k < NEAREST {
                true => Conditions::new(&parts, &moves).least(off)? - &moves,
                false => {
                    Conditions::new(&parts, &DVector::zeros(moves.len())).least(10.0 * left)?
                }
            };
            for (sample, split) in samples.iter_mut().zip(&splits) {
                let step = split.step(basis, &change);
                sample.configuration = system.linkage.advanced(&sample.configuration, &step);
            }
            moves += &change;
            if moves.iter().any(|own| !own.is_finite() || own.abs() > LOST) {
                return None;
            }
            off = (change.amax() * rounding).min(off);
        }
        Some(best.1)
    }

    /// The numbers after these moves, and by how much the loops stay open at configurations that took
    /// no part.
    fn tried(&self, basis: &Basis, first: usize, moves: &DVector<f64>) -> Option<(Vec<f64>, f64)> {
        let model = self.model_at(moves)?;
        let system = self.system_of(&model)?;
        let misfit = sample::opening(&system, basis, first..first + TRIED)?;
        let bends = self.bends_of(&model);
        let misfit = bends.iter().fold(misfit, |most, bend| most.max(bend.abs()));
        Some((self.values(moves), misfit))
    }

    /// The bends of the rails of a model.
    fn bends_of(&self, model: &Model) -> DVector<f64> {
        self.bends.of(&self.rails.bends(model.geometry()))
    }

    /// Their derivatives by moves.
    fn bends_by_moves(&self, scales: &[f64]) -> DMatrix<f64> {
        scaled(self.bends.rows_of(&self.effects.bends), scales)
    }

    /// What a move of one rounding is of each number.
    fn scales(&self) -> Vec<f64> {
        self.rounded.roundings.to_vec()
    }

    fn values(&self, moves: &DVector<f64>) -> Vec<f64> {
        let both = self.rounded.values.iter().zip(self.rounded.roundings);
        both.zip(moves.iter())
            .map(|((value, h), m)| value + m * h)
            .collect()
    }

    /// The model after these moves.
    fn model_at(&self, moves: &DVector<f64>) -> Option<Model> {
        (self.rounded.model)(&self.values(moves))
    }

    /// The mechanism in another geometry, with the lengths of this one.
    fn system_of(&self, model: &Model) -> Option<System> {
        let home = &self.closure.system;
        Some(System {
            linkage: Linkage::new(model, &home.centre, home.size).ok()?,
            ..home.clone()
        })
    }
}

/// Derivatives by numbers as such by their moves.
fn scaled(mut effect: DMatrix<f64>, scales: &[f64]) -> DMatrix<f64> {
    for (mut column, scale) in effect.column_iter_mut().zip(scales) {
        column *= *scale;
    }
    effect
}

impl Conditions {
    /// `effect · change + misfit = 0` of each of the parts, as conditions on moves from the beginning.
    fn new(parts: &[(&DMatrix<f64>, &DVector<f64>)], moves: &DVector<f64>) -> Self {
        let rows = parts.iter().map(|(effect, _)| effect.nrows()).sum();
        let mut matrix = DMatrix::zeros(rows, moves.len());
        let mut right = DVector::zeros(rows);
        let mut row = 0;
        for (effect, misfit) in parts {
            let count = effect.nrows();
            matrix.rows_mut(row, count).copy_from(effect);
            right
                .rows_mut(row, count)
                .copy_from(&(*effect * moves - *misfit));
            row += count;
        }
        Self { matrix, right }
    }

    /// The least moves that meet them: of min |A m − b|² + λ² |m|², λ as much of A as is not sure, since
    /// the conditions of many configurations say the same.
    fn least(&self, off: f64) -> Option<DVector<f64>> {
        let scale = self.matrix.norm();
        if scale == 0.0 {
            return Some(DVector::zeros(self.matrix.ncols()));
        }
        let damping = (scale * off.max(DAMPING)).powi(2);
        let (rows, columns) = self.matrix.shape();
        if rows <= columns {
            let mut square = &self.matrix * self.matrix.transpose();
            (0..rows).for_each(|k| square[(k, k)] += damping);
            let multipliers = square.cholesky()?.solve(&self.right);
            return Some(self.matrix.tr_mul(&multipliers));
        }
        let mut square = self.matrix.tr_mul(&self.matrix);
        (0..columns).for_each(|k| square[(k, k)] += damping);
        Some(square.cholesky()?.solve(&self.matrix.tr_mul(&self.right)))
    }
}
