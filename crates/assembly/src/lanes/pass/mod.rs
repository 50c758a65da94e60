//! One pass through the lanes: as many poses as a register holds, from points and frames to the
//! output stiffness and displacement.

pub(crate) mod assemble;
pub(crate) mod blocks;
pub(crate) mod buffers;
pub(crate) mod compliance;
pub(crate) mod ends;
pub(crate) mod factor;
pub(crate) mod hang;
pub(crate) mod lane;
pub(crate) mod reflections;
pub(crate) mod transmit;

use pulp::{Simd, WithSimd};

use super::pass::assemble::{Assembly, parts};
use super::pass::blocks::{arm, bushing, flexible, vector};
use super::pass::buffers::Buffers;
use super::pass::factor::{Matrix, ROUNDING, eliminate};
use super::pass::hang::{Motion, make_relative};
use super::pass::lane::{Lane, Vec3, add, cross, scaled};
use super::pass::transmit::add_chain;
use super::program::Program;
use super::program::element::{Kind, Screw};
use super::program::fronts::{Front, FrontPart, Moves};

/// Lower triangle of a 6×6 matrix.
const TRIANGLE: usize = 21;
/// Entries of a result for each pose: upper triangle of the stiffness by rows, displacement, and the
/// relative errors of both.
pub(crate) const RESULTS: usize = TRIANGLE + 6 + 2;
pub(crate) const DISPLACEMENT: usize = TRIANGLE;
pub(crate) const ERROR: usize = TRIANGLE + 6;
pub(crate) const DISPLACEMENT_ERROR: usize = TRIANGLE + 7;

/// The whole pass.
pub(crate) struct Pass<'a> {
    pub program: &'a Program,
    pub buffers: &'a mut Buffers,
}

/// The buffers as registers.
struct Registers<'a, S: Simd> {
    inputs: &'a [S::f64s],
    screws: &'a mut [S::f64s],
    errors: &'a mut [S::f64s],
    local_errors: &'a mut [S::f64s],
    load_errors: &'a mut [S::f64s],
    local_load_errors: &'a mut [S::f64s],
    gains: &'a mut [S::f64s],
    front: &'a mut [S::f64s],
    panel: &'a mut [S::f64s],
    rests: &'a mut [S::f64s],
    blocks: &'a mut [S::f64s],
    wrenches: &'a mut [S::f64s],
    results: &'a mut [S::f64s],
}

impl WithSimd for Pass<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Buffers {
            inputs,
            screws,
            errors,
            local_errors,
            load_errors,
            local_load_errors,
            gains,
            front,
            panel,
            rests,
            blocks,
            wrenches,
            results,
            ..
        } = self.buffers;
        let mut registers = Registers::<S> {
            inputs: S::as_simd_f64s(inputs).0,
            screws: S::as_mut_simd_f64s(screws).0,
            errors: S::as_mut_simd_f64s(errors).0,
            local_errors: S::as_mut_simd_f64s(local_errors).0,
            load_errors: S::as_mut_simd_f64s(load_errors).0,
            local_load_errors: S::as_mut_simd_f64s(local_load_errors).0,
            gains: S::as_mut_simd_f64s(gains).0,
            front: S::as_mut_simd_f64s(front).0,
            panel: S::as_mut_simd_f64s(panel).0,
            rests: S::as_mut_simd_f64s(rests).0,
            blocks: S::as_mut_simd_f64s(blocks).0,
            wrenches: S::as_mut_simd_f64s(wrenches).0,
            results: S::as_mut_simd_f64s(results).0,
        };
        for screw in &self.program.screws {
            registers.place_screw(simd, screw);
        }
        registers.errors.fill(simd.splat_f64s(0.0));
        registers.load_errors.fill(simd.splat_f64s(0.0));
        for front in &self.program.fronts.list {
            registers.solve_front(simd, self.program, front);
        }
        registers.finish(simd, self.program);
    }
}

impl<S: Simd> Registers<'_, S> {
    /// The twist of a joint's coordinate at the reference point.
    #[inline(always)]
    fn place_screw(&mut self, simd: S, screw: &Screw) {
        let zero = Lane::splat(simd, 0.0);
        let (mut linear, mut angular): (Vec3<S>, Vec3<S>) = ([zero; 3], [zero; 3]);
        for (column, along, about) in &screw.motion.axes {
            let axis = vector(simd, self.inputs, *column);
            if *along != 0.0 {
                linear = add(&linear, &scaled(&axis, Lane::splat(simd, *along)));
            }
            if *about != 0.0 {
                angular = add(&angular, &scaled(&axis, Lane::splat(simd, *about)));
            }
        }
        if let Some(points) = screw.arm {
            linear = add(&linear, &cross(&angular, &arm(simd, self.inputs, points)));
        }
        let out = &mut self.screws[6 * screw.coordinate..6 * screw.coordinate + 6];
        for k in 0..3 {
            out[k] = linear[k].value;
            out[3 + k] = angular[k].value;
        }
    }

    /// Assembles a front, eliminates its pivots, and keeps what is left.
    #[inline(always)]
    fn solve_front(&mut self, simd: S, program: &Program, front: &Front) {
        let size = front.variables.len();
        let scatter = &front.scatter;
        let zero = simd.splat_f64s(0.0);
        for place in &scatter.zeros {
            self.front[*place as usize] = zero;
        }
        for moves in &scatter.children {
            for [from, to] in &moves.stored {
                self.front[*to as usize] = self.rests[*from as usize];
            }
            for [from, to] in &moves.added {
                let entry = &mut self.front[*to as usize];
                *entry = simd.add_f64s(*entry, self.rests[*from as usize]);
            }
        }
        for (local, variable) in self.local_errors.iter_mut().zip(&front.variables) {
            *local = self.errors[*variable];
        }
        for (local, variable) in self.local_load_errors.iter_mut().zip(&front.variables) {
            *local = self.load_errors[*variable];
        }
        for k in 0..front.parts.len() + front.hangs.len() {
            let (part, places, moves) = if let Some((part, places)) = front.parts.get(k) {
                (*part, places, &scatter.parts[k])
            } else {
                let k = k - front.parts.len();
                let hang = &front.hangs[k];
                let motion = Motion::<S> {
                    inputs: self.inputs,
                    screws: self.screws,
                };
                let mut matrix = Matrix::<S> {
                    entries: self.front,
                    size,
                    errors: self.local_errors,
                    load_errors: self.local_load_errors,
                };
                let places = &scatter.hangs[k];
                make_relative(simd, &mut matrix, hang, places, &motion, self.gains);
                (hang.part, &hang.part_places, &scatter.hung_parts[k])
            };
            self.add_part(simd, program, size, part, places, moves);
        }
        let mut matrix = Matrix::<S> {
            entries: self.front,
            size,
            errors: self.local_errors,
            load_errors: self.local_load_errors,
        };
        let left = size - front.pivots;
        let rest = &mut self.rests[front.rest_start..][..left * left];
        eliminate(
            simd,
            &mut matrix,
            front.pivots,
            front.idle,
            self.panel,
            rest,
        );
        let boundary = self.local_errors[front.pivots..].iter();
        for (local, variable) in boundary.zip(&front.variables[front.pivots..]) {
            self.errors[*variable] = *local;
        }
        if program.fronts.loaded {
            let boundary = self.local_load_errors[front.pivots..].iter();
            for (local, variable) in boundary.zip(&front.variables[front.pivots..]) {
                self.load_errors[*variable] = *local;
            }
        }
    }

    #[inline(always)]
    fn add_part(
        &mut self,
        simd: S,
        program: &Program,
        size: usize,
        part: FrontPart,
        places: &[usize],
        moves: &Moves,
    ) {
        let mut assembly = Assembly::<S> {
            simd,
            entries: self.front,
            size,
            errors: self.local_errors,
            screws: self.screws,
            inputs: self.inputs,
            idle: &program.idle,
            load_errors: self.local_load_errors,
        };
        // The loads' row is the last coordinate of those that have it.
        let row = places[places.len() - 1];
        match part {
            FrontPart::Spring(k) => assembly.add_spring(places, program.springs[k].stiffness),
            FrontPart::Load(k) => {
                if program.fronts.loaded {
                    let load = &program.loads[k];
                    let (force, moment) = parts(simd, &load.wrench);
                    assembly.add_load(&load.node, places, row, &force, &moment);
                }
            }
            FrontPart::Element(k) => {
                let element = &program.elements[k];
                let nodes = &element.nodes;
                match &element.kind {
                    Kind::Chain(chain) => {
                        let wrenches = &mut *self.wrenches;
                        add_chain(&mut assembly, chain, nodes, places, &moves.pairs, wrenches);
                        return;
                    }
                    Kind::Flexible(body) => flexible(simd, body, self.inputs, self.blocks),
                    Kind::Bushing { columns, stiffness } => {
                        let count = nodes.len();
                        bushing(simd, columns, stiffness, count, self.inputs, self.blocks);
                    }
                }
                assembly.add_element(nodes, places, self.blocks, moves);
            }
        }
    }

    /// Stiffness and displacement from what the last front left.
    #[inline(always)]
    fn finish(&mut self, simd: S, program: &Program) {
        let Some(last) = program.fronts.list.last() else {
            return;
        };
        let zero = Lane::splat(simd, 0.0);
        let height = 6 + usize::from(program.fronts.loaded);
        let mut k = [[zero; 6]; 6];
        let mut force: [Lane<S>; 6] = [zero; 6];
        for column in 0..6 {
            for row in column..height {
                let entry = Lane::new(simd, self.rests[last.rest_start + column * height + row]);
                if row < 6 {
                    k[row][column] = entry;
                } else {
                    force[column] = entry;
                }
            }
        }
        if !program.fronts.loaded {
            for load in &program.loads {
                let (linear, mut angular) = parts(simd, &load.wrench);
                if let Some(points) = load.node.arm {
                    angular = add(&angular, &cross(&arm(simd, self.inputs, points), &linear));
                }
                for c in 0..3 {
                    force[c] += linear[c];
                    force[3 + c] += angular[c];
                }
            }
        }
        let mut error = zero;
        for c in 0..6 {
            let variable = last.variables[last.pivots + c];
            error = error.max(Lane::new(simd, self.errors[variable]) / k[c][c]);
        }
        let error = error * Lane::splat(simd, ROUNDING);
        let (displacement, gain) = solve_six(&k, force);
        let mut place = 0;
        for row in 0..6 {
            for column in row..6 {
                self.results[place] = k[column][row].value;
                place += 1;
            }
        }
        for c in 0..6 {
            self.results[DISPLACEMENT + c] = displacement[c].value;
        }
        self.results[ERROR] = error.value;
        let mut lost = error + Lane::splat(simd, ROUNDING);
        if program.fronts.loaded {
            // A pivot's error acts on the forces handed on to the output as on the stiffness: by the
            // geometric mean of what it does to the two diagonals.
            let row = Lane::new(simd, self.errors[last.variables[last.pivots + 6]]);
            let mut energy = zero;
            for c in 0..6 {
                energy = energy.max(displacement[c] * displacement[c] * k[c][c]);
            }
            let rounding = Lane::splat(simd, ROUNDING);
            let mut by_loads = row * rounding * error;
            for c in 0..6 {
                let own = Lane::new(simd, self.load_errors[last.variables[last.pivots + c]]);
                by_loads = by_loads.max(own * rounding * rounding / k[c][c]);
            }
            let by_loads = by_loads / energy;
            lost += by_loads.if_above(zero, by_loads, zero).sqrt();
        }
        self.results[DISPLACEMENT_ERROR] = (lost * gain).value;
    }
}

/// Solves `K u = f` by L D Lᵀ (lower triangle); also the largest `K_ii (K⁻¹)_ii`: what an error of K
/// is multiplied by.
#[inline(always)]
fn solve_six<S: Simd>(k: &[[Lane<S>; 6]; 6], f: [Lane<S>; 6]) -> ([Lane<S>; 6], Lane<S>) {
    let (zero, one) = (k[0][0].constant(0.0), k[0][0].constant(1.0));
    let mut l = *k;
    let mut u = f;
    let mut inverses = [zero; 6];
    // Rows of L⁻¹.
    let mut rows = [[zero; 6]; 6];
    for c in 0..6 {
        rows[c][c] = one;
    }
    for c in 0..6 {
        inverses[c] = l[c][c].recip();
        for r in c + 1..6 {
            let minus = -(l[r][c] * inverses[c]);
            for i in r..6 {
                l[i][r] = l[i][c].mul_add(minus, l[i][r]);
            }
            u[r] = u[c].mul_add(minus, u[r]);
            for i in 0..=c {
                rows[r][i] = rows[c][i].mul_add(minus, rows[r][i]);
            }
        }
    }
    let mut gain = one;
    for i in 0..6 {
        let mut own = zero;
        for r in i..6 {
            own = (rows[r][i] * rows[r][i]).mul_add(inverses[r], own);
        }
        gain = gain.max((k[i][i] * own).abs());
    }
    for c in (0..6).rev() {
        let mut sum = u[c];
        for r in c + 1..6 {
            sum = (-l[r][c]).mul_add(u[r], sum);
        }
        u[c] = sum * inverses[c];
    }
    (u, gain)
}
