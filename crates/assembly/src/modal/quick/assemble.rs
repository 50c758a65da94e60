//! K − σ M over the coordinates of one configuration.

use nalgebra::Matrix6;
use pulp::Simd;

use super::factor::{load, store};
use super::kinds::{FOURS, Kind, PAIRS, Plane};
use super::table::{End, Entries, Table};
use crate::plan::Plan;
use crate::plan::blocks::{dot, multiply};
use crate::plan::workspace::Workspace;

/// Room for one element.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    /// Displacements by coordinates, by rows, and forces likewise.
    displacements: Vec<f64>,
    forces: Vec<f64>,
    products: Vec<f64>,
}

/// What is assembled: a topology, its members at a shift, and one configuration.
pub(super) struct Assembly<'a> {
    pub plan: &'a Plan,
    pub table: &'a Table,
    pub kinds: &'a [Kind],
    pub shift: f64,
    pub workspace: &'a Workspace,
    pub locals: &'a [f64],
    /// Mass matrices of nodes.
    pub masses: &'a [Matrix6<f64>],
}

impl Assembly<'_> {
    #[inline(always)]
    pub fn assemble<S: Simd>(&self, simd: S, scratch: &mut Scratch, values: &mut [f64]) {
        values.fill(0.0);
        for member in &self.table.members {
            let width = member.entries.width();
            scratch.make_room(12 * width, member.entries.count * width);
            for (k, end) in member.ends.iter().enumerate() {
                add_end(end, self.locals, 6 * k, width, &mut scratch.displacements);
            }
            let kind = &self.kinds[member.kind];
            scratch.force(simd, &kind.pairs[0], PAIRS[0], width);
            scratch.force(simd, &kind.pairs[1], PAIRS[1], width);
            scratch.force(simd, &kind.fours[0], FOURS[0], width);
            scratch.force(simd, &kind.fours[1], FOURS[1], width);
            scratch.add::<S, 12>(simd, &member.entries, values);
        }
        for (mass, matrix) in self.table.masses.iter().zip(self.masses) {
            let width = mass.entries.width();
            scratch.make_room(6 * width, mass.entries.count * width);
            add_end(&mass.end, self.locals, 0, width, &mut scratch.displacements);
            let plane = Plane {
                stiffness: matrix * -self.shift,
                mass: *matrix,
                shapes: Vec::new(),
            };
            scratch.force(simd, &plane, [0, 1, 2, 3, 4, 5], width);
            scratch.add::<S, 6>(simd, &mass.entries, values);
        }
        for spring in &self.table.springs {
            let element = &self.plan.elements[spring.element];
            let (rows, count) = (element.rows, element.columns.len());
            let operator = &self.workspace.operators[element.operator_start..][..rows * count];
            let stiffness = &self.workspace.stiffnesses[element.stiffness_start..][..rows * rows];
            scratch.make_room(0, rows * count);
            multiply(stiffness, operator, rows, &mut scratch.products);
            let mut indices = spring.entries.indices.iter();
            for (b, product) in scratch.products.chunks_exact(rows).enumerate() {
                let columns = operator.chunks_exact(rows).take(b + 1);
                for (column, index) in columns.zip(&mut indices) {
                    values[*index] += dot(column, product);
                }
            }
        }
    }
}

/// Adds a node's displacements by an element's coordinates.
#[inline(always)]
fn add_end(end: &End, locals: &[f64], first: usize, width: usize, out: &mut [f64]) {
    for (k, column) in end.columns.iter().enumerate() {
        let own = &locals[end.start + 6 * k..end.start + 6 * k + 6];
        for r in 0..6 {
            out[(first + r) * width + column] += own[r];
        }
    }
}

impl Scratch {
    #[inline(always)]
    fn make_room(&mut self, numbers: usize, products: usize) {
        self.displacements.clear();
        self.displacements.resize(numbers, 0.0);
        self.forces.resize(numbers, 0.0);
        self.products.resize(products, 0.0);
    }

    /// Forces of a direction.
    #[inline(always)]
    fn force<S: Simd, const N: usize>(
        &mut self,
        simd: S,
        plane: &Plane<N>,
        rows: [usize; N],
        width: usize,
    ) {
        for part in (0..width).step_by(S::F64_LANES) {
            for a in 0..N {
                let mut sum = simd.splat_f64s(0.0);
                for b in 0..N {
                    let entry = simd.splat_f64s(plane.stiffness[(a, b)]);
                    let moved = load::<S>(&self.displacements, rows[b] * width + part);
                    sum = simd.mul_add_e_f64s(entry, moved, sum);
                }
                store::<S>(&mut self.forces, rows[a] * width + part, sum);
            }
        }
    }

    /// Adds the products of displacements and forces.
    #[inline(always)]
    fn add<S: Simd, const N: usize>(&mut self, simd: S, entries: &Entries, values: &mut [f64]) {
        let width = entries.width();
        for part in (0..width).step_by(S::F64_LANES) {
            for i in part..entries.count {
                let mut sum = simd.splat_f64s(0.0);
                for r in 0..N {
                    let moved = simd.splat_f64s(self.displacements[r * width + i]);
                    let force = load::<S>(&self.forces, r * width + part);
                    sum = simd.mul_add_e_f64s(moved, force, sum);
                }
                store::<S>(&mut self.products, i * width + part, sum);
            }
        }
        let mut next = 0;
        for i in 0..entries.count {
            for j in 0..=i {
                values[entries.indices[next]] += self.products[i * width + j];
                next += 1;
            }
        }
    }
}
