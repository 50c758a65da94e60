//! How good eight vectors are: their ω² by the energies of the members as they are, and their residuals,
//! formed in the members' deformations.
//!
//! Between the ends a member does what answers to the ends at the ω² that is known already, so that no
//! residual is left there.

use nalgebra::Matrix6;
use pulp::Simd;

use super::blocks::ROW;
use super::factor::{load, store};
use super::kinds::{FOURS, Kind, PAIRS, Plane};
use super::product::{gather, rigid, scatter};
use super::table::{Bar, Table};
use crate::plan::Plan;
use crate::plan::workspace::Workspace;

/// A topology in one configuration.
pub(super) struct Rayleigh<'a> {
    pub plan: &'a Plan,
    pub table: &'a Table,
    pub workspace: &'a Workspace,
    pub locals: &'a [f64],
    pub masses: &'a [Matrix6<f64>],
}

/// Sums over all members: twice the energies, kinetic at ω = 1.
pub(super) struct Energies {
    pub strain: [f64; ROW],
    pub kinetic: [f64; ROW],
}

impl Rayleigh<'_> {
    /// Energies of vectors whose ω² is near `squares`, and the forces `out = ω² M x − K x` that they lack.
    #[inline(always)]
    pub fn energies<S: Simd>(
        &self,
        simd: S,
        squares: &[f64; ROW],
        x: &[f64],
        out: &mut [f64],
    ) -> Energies {
        let zero = simd.splat_f64s(0.0);
        let mut found = Energies {
            strain: [0.0; ROW],
            kinetic: [0.0; ROW],
        };
        out[..self.table.nodes * ROW].fill(0.0);
        for part in (0..ROW).step_by(S::F64_LANES) {
            let square = load::<S>(squares, part);
            let (mut strain, mut kinetic) = (zero, zero);
            for member in &self.table.members {
                let kind = &self.table.kinds[member.kind];
                let moved = displacements(simd, member, self.locals, x, part);
                let mut force = [zero; 12];
                let mut add = Sums {
                    square,
                    force: &mut force,
                    strain: &mut strain,
                    kinetic: &mut kinetic,
                };
                add.inertia(simd, &kind.pairs[0], PAIRS[0], &moved);
                add.inertia(simd, &kind.pairs[1], PAIRS[1], &moved);
                add.inertia(simd, &kind.fours[0], FOURS[0], &moved);
                add.inertia(simd, &kind.fours[1], FOURS[1], &moved);
                add.stiffness(simd, kind, &moved);
                scatter::<S, 0>(simd, &member.ends[0], self.locals, &force, part, out);
                scatter::<S, 6>(simd, &member.ends[1], self.locals, &force, part, out);
            }
            for (mass, matrix) in self.table.masses.iter().zip(self.masses) {
                let mut moved = [zero; 12];
                gather::<S, 0>(simd, &mass.end, self.locals, x, part, &mut moved);
                let mut force = rigid(simd, matrix, &moved);
                for r in 0..6 {
                    kinetic = simd.mul_add_e_f64s(moved[r], force[r], kinetic);
                    force[r] = simd.mul_f64s(square, force[r]);
                }
                scatter::<S, 0>(simd, &mass.end, self.locals, &force, part, out);
            }
            self.springs(simd, x, out, part, &mut strain);
            store::<S>(&mut found.strain, part, strain);
            store::<S>(&mut found.kinetic, part, kinetic);
        }
        found
    }

    #[inline(always)]
    fn springs<S: Simd>(
        &self,
        simd: S,
        x: &[f64],
        out: &mut [f64],
        part: usize,
        strain: &mut S::f64s,
    ) {
        let zero = simd.splat_f64s(0.0);
        for spring in &self.table.springs {
            let element = &self.plan.elements[spring.element];
            let rows = element.rows.min(6);
            let operator = &self.workspace.operators[element.operator_start..];
            let stiffness = &self.workspace.stiffnesses[element.stiffness_start..];
            let (mut given, mut force) = ([zero; 6], [zero; 6]);
            for (k, place) in spring.places.iter().enumerate() {
                let amount = load::<S>(x, place * ROW + part);
                for r in 0..rows {
                    let entry = simd.splat_f64s(operator[k * rows + r]);
                    given[r] = simd.mul_add_e_f64s(entry, amount, given[r]);
                }
            }
            for a in 0..rows {
                for b in 0..rows {
                    let entry = simd.splat_f64s(stiffness[b * rows + a]);
                    force[a] = simd.mul_add_e_f64s(entry, given[b], force[a]);
                }
                *strain = simd.mul_add_e_f64s(force[a], given[a], *strain);
            }
            for (k, place) in spring.places.iter().enumerate() {
                let mut sum = load::<S>(out, place * ROW + part);
                for r in 0..rows {
                    let entry = simd.splat_f64s(-operator[k * rows + r]);
                    sum = simd.mul_add_e_f64s(entry, force[r], sum);
                }
                store::<S>(out, place * ROW + part, sum);
            }
        }
    }

    /// Twice the kinetic energies at ω = 1 of vectors whose members follow their ends as at rest.
    #[inline(always)]
    pub fn kinetic<S: Simd>(&self, simd: S, x: &[f64]) -> [f64; ROW] {
        let zero = simd.splat_f64s(0.0);
        let mut found = [0.0; ROW];
        for part in (0..ROW).step_by(S::F64_LANES) {
            let (mut strain, mut kinetic) = (zero, zero);
            for member in &self.table.members {
                let kind = &self.table.kinds[member.kind];
                let moved = displacements(simd, member, self.locals, x, part);
                let mut force = [zero; 12];
                let mut add = Sums {
                    square: zero,
                    force: &mut force,
                    strain: &mut strain,
                    kinetic: &mut kinetic,
                };
                add.ends(simd, &kind.pairs[0], PAIRS[0], &moved);
                add.ends(simd, &kind.pairs[1], PAIRS[1], &moved);
                add.ends(simd, &kind.fours[0], FOURS[0], &moved);
                add.ends(simd, &kind.fours[1], FOURS[1], &moved);
            }
            for (mass, matrix) in self.table.masses.iter().zip(self.masses) {
                let mut moved = [zero; 12];
                gather::<S, 0>(simd, &mass.end, self.locals, x, part, &mut moved);
                let force = rigid(simd, matrix, &moved);
                for r in 0..6 {
                    kinetic = simd.mul_add_e_f64s(moved[r], force[r], kinetic);
                }
            }
            store::<S>(&mut found, part, kinetic);
        }
        found
    }
}

/// Displacements of a member's ends.
#[inline(always)]
fn displacements<S: Simd>(
    simd: S,
    member: &Bar,
    locals: &[f64],
    x: &[f64],
    part: usize,
) -> [S::f64s; 12] {
    let mut moved = [simd.splat_f64s(0.0); 12];
    gather::<S, 0>(simd, &member.ends[0], locals, x, part, &mut moved);
    gather::<S, 6>(simd, &member.ends[1], locals, x, part, &mut moved);
    moved
}

/// What a member's directions add to.
struct Sums<'a, S: Simd> {
    square: S::f64s,
    force: &'a mut [S::f64s; 12],
    strain: &'a mut S::f64s,
    kinetic: &'a mut S::f64s,
}

impl<S: Simd> Sums<'_, S> {
    /// Inertia of the ends' static curve; returns it without the factor ω².
    #[inline(always)]
    fn ends<const N: usize>(
        &mut self,
        simd: S,
        plane: &Plane<N>,
        rows: [usize; N],
        moved: &[S::f64s; 12],
    ) -> [S::f64s; N] {
        let mut sums = [simd.splat_f64s(0.0); N];
        for a in 0..N {
            for b in 0..N {
                let entry = simd.splat_f64s(plane.mass[(a, b)]);
                sums[a] = simd.mul_add_e_f64s(entry, moved[rows[b]], sums[a]);
            }
            *self.kinetic = simd.mul_add_e_f64s(sums[a], moved[rows[a]], *self.kinetic);
        }
        sums
    }

    /// Inertia, with what is between the ends.
    #[inline(always)]
    fn inertia<const N: usize>(
        &mut self,
        simd: S,
        plane: &Plane<N>,
        rows: [usize; N],
        moved: &[S::f64s; 12],
    ) {
        let zero = simd.splat_f64s(0.0);
        let mut sums = self.ends(simd, plane, rows, moved);
        for shape in &plane.shapes {
            let mut coupled = zero;
            for a in 0..N {
                let entry = simd.splat_f64s(shape.coupling[a]);
                coupled = simd.mul_add_e_f64s(entry, moved[rows[a]], coupled);
            }
            let own = simd.splat_f64s(shape.square);
            let follows = simd.div_f64s(self.square, simd.sub_f64s(own, self.square));
            let amount = simd.mul_f64s(follows, coupled);
            for a in 0..N {
                let entry = simd.splat_f64s(shape.coupling[a]);
                sums[a] = simd.mul_add_e_f64s(entry, amount, sums[a]);
            }
            let both = simd.add_f64s(coupled, simd.add_f64s(coupled, amount));
            *self.kinetic = simd.mul_add_e_f64s(both, amount, *self.kinetic);
            let force = simd.mul_f64s(own, amount);
            *self.strain = simd.mul_add_e_f64s(force, amount, *self.strain);
        }
        for a in 0..N {
            let sum = simd.mul_add_e_f64s(self.square, sums[a], self.force[rows[a]]);
            self.force[rows[a]] = sum;
        }
    }

    /// Takes off the forces of the ends' deformation.
    #[inline(always)]
    fn stiffness(&mut self, simd: S, kind: &Kind, moved: &[S::f64s; 12]) {
        let length = simd.splat_f64s(kind.length);
        let mut given = [simd.splat_f64s(0.0); 6];
        for r in 0..6 {
            given[r] = simd.sub_f64s(moved[6 + r], moved[r]);
        }
        given[1] = simd.sub_f64s(given[1], simd.mul_f64s(length, moved[5]));
        given[2] = simd.mul_add_e_f64s(length, moved[4], given[2]);
        let mut forces = [simd.splat_f64s(0.0); 6];
        for (a, b) in [
            (0, 0),
            (3, 3),
            (1, 1),
            (1, 5),
            (5, 1),
            (5, 5),
            (2, 2),
            (2, 4),
            (4, 2),
            (4, 4),
        ] {
            let entry = simd.splat_f64s(kind.held[(a, b)]);
            forces[a] = simd.mul_add_e_f64s(entry, given[b], forces[a]);
        }
        for r in 0..6 {
            *self.strain = simd.mul_add_e_f64s(forces[r], given[r], *self.strain);
            self.force[6 + r] = simd.sub_f64s(self.force[6 + r], forces[r]);
            self.force[r] = simd.add_f64s(self.force[r], forces[r]);
        }
        self.force[5] = simd.mul_add_e_f64s(length, forces[1], self.force[5]);
        let turn = simd.mul_f64s(length, forces[2]);
        self.force[4] = simd.sub_f64s(self.force[4], turn);
    }
}
