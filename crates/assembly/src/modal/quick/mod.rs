//! The quick way to the lowest frequencies of a pose of a small mechanism with exact masses, for sweeps:
//! everything that does not depend on the pose once a topology, eight vectors side by side in registers,
//! buffers kept. What it does not vouch for goes the other way ([`lowest`](super::lanczos::lowest)),
//! and so does what it does not take: larger mechanisms, flexible bodies, motions without energy.

// Loops over registers are written by index: an iterator's closure, or a call of memcpy, would not
// be compiled with the instruction set chosen at run time.
#![allow(clippy::needless_range_loop, clippy::manual_memcpy)]

mod assemble;
mod blocks;
mod dense;
mod factor;
mod kinds;
mod krylov;
mod product;
mod rayleigh;
mod ritz;
mod shift;
mod table;

use std::sync::{Mutex, PoisonError};

use hyperstat_model::{Geometry, Model};
use nalgebra::Vector3;
use pulp::Arch;

use self::blocks::ROW;
use self::krylov::{Buffers, Count, Found, MOST_BLOCKS, Search};
use self::shift::Shift;
use self::table::Table;
use crate::modal::member::Members;
use crate::plan::Plan;
use crate::posture::Posture;

/// Frequencies that may be asked for at the most: as many again are found a block beyond them.
const MOST_MODES: usize = 4;
/// The shift is so far above the highest ω² wanted of the topology's own configuration.
const ABOVE: f64 = 1.06;
/// Other shifts are so far from each other.
const STEP: f64 = 1.12;
/// So many of them are below that one and above it.
const BELOW: i32 = 10;
const BEYOND: i32 = 10;
/// Blocks of the smallest basis.
const LEAST_BLOCKS: usize = 3;
/// With more modes below the shift a lower one is tried.
const MANY: usize = MOST_MODES + 2;
/// An ω² below this part of the shift may be of a motion without energy.
const AT_REST: f64 = 1e-6;

/// A topology made ready.
#[derive(Debug)]
pub(super) struct Quick {
    table: Table,
    shifts: Vec<Shift>,
    /// Which shift is tried first.
    first: usize,
    /// Forces that a search begins with.
    start: Vec<f64>,
    /// Blocks of the smallest basis that is looked at: one more than its own configuration asks for.
    blocks: usize,
    count: usize,
    /// About where the wanted ω² are.
    usual: f64,
    arch: Arch,
    buffers: Mutex<Vec<Buffers>>,
}

impl Quick {
    /// Of a divided model, in whose own configuration these are the wanted ω².
    pub fn new(plan: &Plan, model: &Model, members: &Members, wanted: &[f64]) -> Option<Self> {
        let count = wanted.len();
        let (lowest, highest) = (wanted.first()?, wanted.last()?);
        if count > MOST_MODES || *lowest <= 0.0 {
            return None;
        }
        let table = Table::new(plan, model, members)?;
        let squares = (-BELOW..=BEYOND).map(|k| ABOVE * highest * STEP.powi(k));
        let squares = squares.filter(|square| *square <= members.limit);
        let shifts: Vec<Shift> = squares.map(|square| Shift::new(&table, square)).collect();
        let mut seed = 0;
        let start = (0..table.size * ROW).map(|_| super::lanczos::random(&mut seed));
        let mut quick = Self {
            first: BELOW as usize,
            start: start.collect(),
            blocks: MOST_BLOCKS / 2,
            count,
            usual: (lowest + highest) * 0.5,
            arch: Arch::new(),
            buffers: Mutex::new(Vec::new()),
            table,
            shifts,
        };
        if quick.shifts.len() <= quick.first {
            return None;
        }
        let mut buffers = Buffers::new(plan, &quick.table);
        let found = quick.find(plan, model, model.geometry(), &mut buffers)?;
        quick.start = buffers.forces_of(&found);
        quick.blocks = LEAST_BLOCKS;
        let found = quick.find(plan, model, model.geometry(), &mut buffers)?;
        quick.blocks = (found.blocks + 1).min(MOST_BLOCKS);
        Some(quick)
    }

    /// The lowest ω² in a configuration of the divided model, whose members it fits; `None` where another
    /// way has to find them.
    pub fn squares(&self, plan: &Plan, model: &Model, geometry: &Geometry) -> Option<Vec<f64>> {
        let lock = || self.buffers.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = lock().pop();
        let mut buffers = kept.unwrap_or_else(|| Buffers::new(plan, &self.table));
        let found = self.find(plan, model, geometry, &mut buffers);
        lock().push(buffers);
        let mut squares = found?.squares[..self.count].to_vec();
        squares.sort_by(f64::total_cmp);
        Some(squares)
    }

    fn find(
        &self,
        plan: &Plan,
        model: &Model,
        geometry: &Geometry,
        buffers: &mut Buffers,
    ) -> Option<Found> {
        let at = Posture::new(model, geometry);
        let (workspace, locals) = (&mut buffers.workspace, &mut buffers.locals);
        self.table.form(plan, &at, workspace, locals).ok()?;
        buffers.masses.clear();
        let masses = model.masses_at(geometry).into_iter();
        let about = masses.map(|mass| mass.mass.about(&Vector3::zeros()));
        buffers.masses.extend(about);
        let (shift, below) = self.shift(plan, buffers)?;
        let found = self.arch.dispatch(Search {
            plan,
            table: &self.table,
            shift,
            buffers,
            start: &self.start,
            blocks: self.blocks,
            count: self.count,
            below,
            usual: self.usual,
        })?;
        let least = AT_REST * shift.square;
        let moving = found.squares[..self.count]
            .iter()
            .all(|square| *square > least);
        moving.then_some(found)
    }

    /// A shift that the wanted modes, and not many more, are below, with its factor in the buffers.
    fn shift(&self, plan: &Plan, buffers: &mut Buffers) -> Option<(&Shift, usize)> {
        let (mut own, mut raised) = (self.first, false);
        loop {
            let shift = self.shifts.get(own)?;
            let below = self.arch.dispatch(Count {
                plan,
                table: &self.table,
                shift,
                buffers,
            })?;
            if below < self.count {
                (own, raised) = (own + 1, true);
            } else if below > MANY && !raised && own > 0 {
                own -= 1;
            } else {
                return Some((shift, below));
            }
        }
    }
}
