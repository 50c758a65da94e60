//! The lowest frequencies of one configuration: block Lanczos with (K − σ M)⁻¹ M, eight vectors a block,
//! which are the lanes of a register.
//!
//! The factor of K − σ M tells how many frequencies lie below σ. So many Ritz values are below it, no
//! fewer; the lowest of them that have converged are then the lowest of all.

use nalgebra::Matrix6;
use pulp::{Simd, WithSimd};

use super::assemble::{Assembly, Scratch};
use super::blocks::ROW;
use super::dense::{Square, add, products, turn, unit};
use super::factor::{factorize, load, solve, store};
use super::product::Mass;
use super::rayleigh::Rayleigh;
use super::ritz::{Amounts, Projected};
use super::shift::Shift;
use super::table::Table;
use crate::plan::Plan;
use crate::plan::blocks::subtract;
use crate::plan::workspace::Workspace;

/// Blocks of a basis at the most.
pub(super) const MOST_BLOCKS: usize = 10;
/// Vectors of unit mass whose residuals another step would turn into changes no larger than this have
/// ω² to its square over the distance of the next, relative.
const SETTLED: f64 = 3e-8;
/// The energy of these changes over that of the vectors, at the most: it is what ω² is off by. Beside soft
/// drives small changes have much of it, in the directions of all that is stiff.
const STRAINED: f64 = 1e-11;
/// So much of the vectors that a search began with is kept beside those that it found.
const BEGUN: f64 = 0.05;
/// The wanted ω² are looked for no nearer to the shift than this part of it.
const NEAR: f64 = 0.02;
/// A vector of whose square no more than this part is left beside the blocks before it lies among them.
const NOTHING_NEW: f64 = 1e-16;

/// One pose's numbers, kept from pose to pose.
#[derive(Debug)]
pub(super) struct Buffers {
    pub workspace: Workspace,
    pub locals: Vec<f64>,
    pub masses: Vec<Matrix6<f64>>,
    scratch: Scratch,
    /// The factor.
    values: Vec<f64>,
    inverses: Vec<f64>,
    panel: Vec<f64>,
    /// Blocks of vectors, orthonormal in the mass, and the mass times each.
    vectors: Vec<f64>,
    forces: Vec<f64>,
    /// The operator among the vectors, blocks by columns of the upper triangle.
    projected: Vec<Square>,
    /// Ritz vectors and what they lack.
    ritz: Vec<f64>,
    rest: Vec<f64>,
}

impl Buffers {
    pub fn new(plan: &Plan, table: &Table) -> Self {
        let zeros = |count: usize| vec![0.0; count];
        let (columns, whole) = (&table.blocks.columns, table.size * ROW);
        let largest = columns.iter().map(|c| c.own.len() * c.below.len()).max();
        Self {
            workspace: plan.workspace(),
            locals: zeros(table.locals),
            masses: Vec::new(),
            scratch: Scratch::default(),
            values: zeros(table.blocks.len * ROW),
            inverses: zeros(table.nodes),
            panel: zeros(largest.unwrap_or(0) * ROW),
            vectors: zeros((MOST_BLOCKS + 1) * whole),
            forces: zeros((MOST_BLOCKS + 1) * whole),
            projected: vec![[[0.0; ROW]; ROW]; MOST_BLOCKS * (MOST_BLOCKS + 1) / 2],
            ritz: zeros(table.nodes * ROW),
            rest: zeros(table.nodes * ROW),
        }
    }
}

impl Buffers {
    /// The forces of the vectors that a search has found, with a little of those that it began with: where
    /// they are modes already, nothing were left for a second block.
    pub fn forces_of(&self, found: &Found) -> Vec<f64> {
        let whole = self.forces.len() / (MOST_BLOCKS + 1);
        let begun = self.forces[..whole].iter();
        let mut sums: Vec<f64> = begun.map(|force| BEGUN * force).collect();
        let blocks = self
            .forces
            .chunks_exact(whole)
            .zip(&found.vectors[..found.blocks]);
        for (forces, amounts) in blocks {
            for (out, own) in sums.chunks_exact_mut(ROW).zip(forces.chunks_exact(ROW)) {
                for (own, amounts) in own.iter().zip(amounts) {
                    subtract(out, -own, amounts);
                }
            }
        }
        sums
    }
}

/// Factors K − σ M of the configuration that the buffers are at; how many frequencies are below.
pub(super) struct Count<'a> {
    pub plan: &'a Plan,
    pub table: &'a Table,
    pub shift: &'a Shift,
    pub buffers: &'a mut Buffers,
}

impl WithSimd for Count<'_> {
    type Output = Option<usize>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Option<usize> {
        let buffers = self.buffers;
        let assembly = Assembly {
            plan: self.plan,
            table: self.table,
            kinds: &self.shift.kinds,
            shift: self.shift.square,
            workspace: &buffers.workspace,
            locals: &buffers.locals,
            masses: &buffers.masses,
        };
        assembly.assemble(simd, &mut buffers.scratch, &mut buffers.values);
        factorize(
            simd,
            &self.table.blocks,
            &mut buffers.values,
            &mut buffers.inverses,
            &mut buffers.panel,
        )
    }
}

/// Finds the lowest `count` ω² with the factor that [`Count`] left.
pub(super) struct Search<'a> {
    pub plan: &'a Plan,
    pub table: &'a Table,
    pub shift: &'a Shift,
    pub buffers: &'a mut Buffers,
    /// Forces to begin with.
    pub start: &'a [f64],
    /// Blocks of the smallest basis that is looked at.
    pub blocks: usize,
    /// How many are wanted, and how many are below the shift.
    pub count: usize,
    pub below: usize,
    /// About where they are.
    pub usual: f64,
}

/// What was found, with so many blocks.
pub(super) struct Found {
    pub squares: [f64; ROW],
    pub blocks: usize,
    /// The vectors of eight Ritz values, by amounts of the basis.
    pub vectors: Amounts,
}

impl WithSimd for Search<'_> {
    type Output = Option<Found>;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> Option<Found> {
        let whole = self.table.size * ROW;
        self.solve(simd, None);
        self.append(simd, 0)?;
        for own in 0..MOST_BLOCKS {
            self.solve(simd, Some(own));
            let next = whole * (own + 1)..whole * (own + 2);
            let first = own * (own + 1) / 2;
            for k in 0..=own {
                let forces = &self.buffers.forces[whole * k..whole * (k + 1)];
                let vectors = &self.buffers.vectors[next.clone()];
                self.buffers.projected[first + k] = products(simd, forces, vectors);
            }
            if own + 1 >= self.blocks
                && let Some(found) = self.settled(simd, own + 1)
            {
                return Some(found);
            }
            if own + 1 == MOST_BLOCKS {
                break;
            }
            for k in 0..=own {
                let (before, vectors) = self.buffers.vectors.split_at_mut(next.start);
                let before = &before[whole * k..whole * (k + 1)];
                let shares = &self.buffers.projected[first + k];
                add(simd, &mut vectors[..whole], before, shares, -1.0);
            }
            self.append(simd, own + 1)?;
        }
        None
    }
}

impl Search<'_> {
    /// Solves for the forces of a block, or those to begin with, and writes the vectors of the next.
    #[inline(always)]
    fn solve<S: Simd>(&mut self, simd: S, block: Option<usize>) {
        let whole = self.table.size * ROW;
        let nodes = self.table.nodes * ROW;
        let buffers = &mut *self.buffers;
        let (forces, next) = match block {
            None => (self.start, 0),
            Some(block) => (
                &buffers.forces[whole * block..whole * (block + 1)],
                block + 1,
            ),
        };
        let vectors = &mut buffers.vectors[whole * next..whole * (next + 1)];
        for at in (0..nodes).step_by(S::F64_LANES) {
            store::<S>(vectors, at, load::<S>(forces, at));
        }
        let (values, inverses) = (&buffers.values, &buffers.inverses);
        solve(
            simd,
            &self.table.blocks,
            values,
            inverses,
            &mut vectors[..nodes],
        );
        for (k, inverse) in self.shift.inverses.iter().enumerate() {
            let inverse = simd.splat_f64s(*inverse);
            let row = nodes + k * ROW;
            for at in (row..row + ROW).step_by(S::F64_LANES) {
                let given = simd.mul_f64s(inverse, load::<S>(forces, at));
                store::<S>(vectors, at, given);
            }
        }
    }

    /// Makes a block of vectors orthonormal, and finds its forces.
    #[inline(always)]
    fn append<S: Simd>(&mut self, simd: S, block: usize) -> Option<()> {
        let whole = self.table.size * ROW;
        let buffers = &mut *self.buffers;
        let vectors = &mut buffers.vectors[whole * block..whole * (block + 1)];
        let forces = &mut buffers.forces[whole * block..whole * (block + 1)];
        let mass = Mass {
            table: self.table,
            kinds: &self.shift.kinds,
            locals: &buffers.locals,
            masses: &buffers.masses,
        };
        mass.times(simd, vectors, forces);
        let gram = products(simd, forces, vectors);
        for c in 0..ROW {
            let mut taken = 0.0;
            for shares in &buffers.projected[block * block.saturating_sub(1) / 2..][..block] {
                for r in 0..ROW {
                    taken += shares[r][c] * shares[r][c];
                }
            }
            if gram[c][c] <= NOTHING_NEW * taken {
                return None;
            }
        }
        let turned = unit(&gram)?;
        turn(simd, vectors, &turned);
        turn(simd, forces, &turned);
        Some(())
    }

    /// The lowest Ritz pairs of so many blocks, where they are modes so closely that ω² is right to
    /// rounding.
    #[inline(always)]
    fn settled<S: Simd>(&mut self, simd: S, blocks: usize) -> Option<Found> {
        let projected = Projected {
            entries: &self.buffers.projected,
            blocks,
        };
        let place = (self.usual - self.shift.square).min(-NEAR * self.shift.square);
        let pairs = projected.pairs(simd, place, self.count)?;
        if pairs.below != self.below {
            return None;
        }
        let mut squares = [0.0; ROW];
        for k in 0..self.count {
            squares[k] = self.shift.square + 1.0 / pairs.values[k];
        }
        let whole = self.table.size * ROW;
        let buffers = &mut *self.buffers;
        buffers.ritz.fill(0.0);
        for (k, amounts) in pairs.vectors[..blocks].iter().enumerate() {
            let vectors = &buffers.vectors[whole * k..][..self.table.nodes * ROW];
            add(simd, &mut buffers.ritz, vectors, amounts, 1.0);
        }
        let rayleigh = Rayleigh {
            plan: self.plan,
            table: self.table,
            workspace: &buffers.workspace,
            locals: &buffers.locals,
            masses: &buffers.masses,
        };
        let found = rayleigh.energies(simd, &squares, &buffers.ritz, &mut buffers.rest);
        let (values, inverses) = (&buffers.values, &buffers.inverses);
        // The vectors have been looked at: room for what they lack.
        buffers.ritz.copy_from_slice(&buffers.rest);
        solve(
            simd,
            &self.table.blocks,
            values,
            inverses,
            &mut buffers.rest,
        );
        let changes = rayleigh.kinetic(simd, &buffers.rest);
        let works = works(&buffers.ritz, &buffers.rest);
        for k in 0..self.count {
            squares[k] = found.strain[k] / found.kinetic[k];
            let change = changes[k] / found.kinetic[k];
            // Twice their energy: of what lies below the shift the work is negative.
            let strained = works[k].abs() + self.shift.square * changes[k];
            // What is not a number has not settled.
            let settled = change <= SETTLED * SETTLED && strained <= STRAINED * found.strain[k];
            if !(settled && squares[k].is_finite()) {
                return None;
            }
        }
        Some(Found {
            squares,
            blocks,
            vectors: pairs.vectors,
        })
    }
}

/// Works of eight forces on eight vectors.
#[inline(always)]
fn works(forces: &[f64], vectors: &[f64]) -> [f64; ROW] {
    let mut works = [0.0; ROW];
    for (force, vector) in forces.chunks_exact(ROW).zip(vectors.chunks_exact(ROW)) {
        for k in 0..ROW {
            works[k] += force[k] * vector[k];
        }
    }
    works
}
