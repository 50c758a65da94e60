//! One pass through the lanes: as many poses as a register holds, from points and frames to the
//! output stiffness and displacements.

pub(crate) mod acts;
pub(crate) mod assemble;
pub(crate) mod blocks;
pub(crate) mod buffers;
pub(crate) mod compliance;
pub(crate) mod ends;
pub(crate) mod factor;
pub(crate) mod finish;
pub(crate) mod hang;
pub(crate) mod lane;
pub(crate) mod loaded;
pub(crate) mod loops;
pub(crate) mod reflections;
pub(crate) mod transmit;

use pulp::{Simd, WithSimd};

use super::pass::acts::form;
use super::pass::assemble::Assembly;
use super::pass::blocks::{arm, bushing, flexible, pair, vector, write_pair};
use super::pass::buffers::Buffers;
use super::pass::factor::{Matrix, eliminate};
use super::pass::hang::{Motion, make_relative};
use super::pass::lane::{Lane, TRIANGLE, Vec3, add, cross, scaled};
use super::pass::loops::close;
use super::pass::transmit::{ChainRoom, add_chain};
use super::program::Program;
use super::program::element::{Kind, Screw};
use super::program::fronts::{Front, FrontPart, Moves};

/// Place of the stiffness's relative error among a pose's results, behind the upper triangle of the
/// stiffness by rows. No number where the stiffness is not to be trusted.
pub(crate) const ERROR: usize = TRIANGLE;
/// Of a state: its displacement and its relative error.
const OF_STATE: usize = 7;

/// Place of a state's displacement among a pose's results.
pub(crate) fn displacement(state: usize) -> usize {
    TRIANGLE + 1 + OF_STATE * state
}

/// Place of its relative error.
pub(crate) fn displacement_error(state: usize) -> usize {
    displacement(state) + 6
}

/// Entries of a pose's results.
pub(crate) fn results(states: usize) -> usize {
    displacement(states)
}

/// The whole pass.
pub(crate) struct Pass<'a> {
    pub program: &'a Program,
    pub buffers: &'a mut Buffers,
}

/// The buffers as registers.
struct Registers<'a, S: Simd> {
    inputs: &'a [S::f64s],
    acts: &'a mut [S::f64s],
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
    links: &'a mut [S::f64s],
    conditions: &'a mut [S::f64s],
    scales: &'a mut [S::f64s],
    columns: &'a mut [S::f64s],
    results: &'a mut [S::f64s],
    kept: &'a mut [S::f64s],
}

impl WithSimd for Pass<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Buffers {
            inputs,
            acts,
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
            links,
            conditions,
            scales,
            columns,
            results,
            kept,
            ..
        } = self.buffers;
        let mut registers = Registers::<S> {
            inputs: S::as_simd_f64s(inputs).0,
            acts: S::as_mut_simd_f64s(acts).0,
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
            links: S::as_mut_simd_f64s(links).0,
            conditions: S::as_mut_simd_f64s(conditions).0,
            scales: S::as_mut_simd_f64s(scales).0,
            columns: S::as_mut_simd_f64s(columns).0,
            results: S::as_mut_simd_f64s(results).0,
            kept: S::as_mut_simd_f64s(kept).0,
        };
        form(simd, &self.program.acts, registers.inputs, registers.acts);
        for screw in &self.program.screws {
            registers.place_screw(simd, screw);
        }
        for own in &self.program.loops.list {
            let room = (&mut *registers.conditions, &mut *registers.scales);
            close(simd, own, registers.inputs, registers.screws, room);
        }
        registers.errors.fill(simd.splat_f64s(0.0));
        registers.load_errors.fill(simd.splat_f64s(0.0));
        for (k, front) in self.program.fronts.list.iter().enumerate() {
            registers.solve_front(simd, self.program, front);
            if let Some(recovery) = &self.program.recovery {
                let kept = &mut registers.kept[recovery.panels[k]..];
                let panel = &registers.panel[..front.pivots * front.variables.len()];
                for (kept, entry) in kept.iter_mut().zip(panel) {
                    *kept = *entry;
                }
            }
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
        write_pair(self.screws, screw.coordinate, &(linear, angular));
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
        let columns = size - front.rows;
        for (k, row) in front.variables[columns..].iter().enumerate() {
            let of_row = (row - program.coordinates) * program.coordinates;
            for (i, variable) in front.variables[..columns].iter().enumerate() {
                self.local_load_errors[k * size + i] = self.load_errors[of_row + variable];
            }
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
                    rows: front.rows,
                    load_errors: &mut self.local_load_errors[..front.rows * size],
                };
                let places = &scatter.hangs[k];
                make_relative(simd, &mut matrix, hang, places, &motion, self.gains);
                (hang.part, &hang.part_places, &scatter.hung_parts[k])
            };
            self.add_part(simd, program, [size, columns], part, places, moves);
        }
        let mut matrix = Matrix::<S> {
            entries: self.front,
            size,
            errors: self.local_errors,
            rows: front.rows,
            load_errors: &mut self.local_load_errors[..front.rows * size],
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
        for (k, row) in front.variables[columns..].iter().enumerate() {
            let of_row = (row - program.coordinates) * program.coordinates;
            for i in front.pivots..columns {
                self.load_errors[of_row + front.variables[i]] =
                    self.local_load_errors[k * size + i];
            }
        }
    }

    #[inline(always)]
    fn add_part(
        &mut self,
        simd: S,
        program: &Program,
        [size, columns]: [usize; 2],
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
            columns,
            load_errors: self.local_load_errors,
            acts: self.acts,
        };
        let k = match part {
            FrontPart::Spring(k) => {
                assembly.add_spring(places, program.springs[k].stiffness);
                return;
            }
            FrontPart::Load(k) => {
                let load = &program.loads[k];
                if program.rows[load.column].is_some() {
                    // The row is the last of its coordinates.
                    let row = places[places.len() - 1];
                    let (force, moment) = pair(simd, self.acts, load.act);
                    assembly.add_load(&load.node, places, row, &force, &moment);
                }
                return;
            }
            FrontPart::Element(k) => k,
        };
        let element = &program.elements[k];
        let nodes = &element.nodes;
        let points = match &element.kind {
            Kind::Chain(chain) => {
                let kept = match &program.recovery {
                    Some(recovery) => &mut self.kept[recovery.range(k)],
                    None => &mut [],
                };
                let room = ChainRoom {
                    wrenches: self.wrenches,
                    links: self.links,
                    kept,
                };
                add_chain(
                    &mut assembly,
                    (element, chain),
                    (places, &moves.pairs),
                    room,
                );
                return;
            }
            Kind::Flexible(body) => {
                flexible(simd, body, self.inputs, self.blocks);
                &body.points[..]
            }
            Kind::Bushing {
                point,
                columns,
                stiffness,
            } => {
                bushing(
                    simd,
                    columns,
                    stiffness,
                    nodes.len(),
                    self.inputs,
                    self.blocks,
                );
                std::slice::from_ref(point)
            }
        };
        if !element.columns.is_empty() {
            let rows = &places[places.len() - element.columns.len()..];
            assembly.add_shifts(element, places, rows, self.blocks, points);
        }
        assembly.add_element(nodes, places, self.blocks, moves);
    }
}
