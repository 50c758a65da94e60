//! What joints and segments carry in a state, of as many poses as went through the pass together, from what
//! the pass kept.
//!
//! The fronts give the displacements of all coordinates from those of the output ([`displace`]), a chain's
//! works on these the wrenches that it transmits, and with the loads on its way the wrench in every link
//! ([`transmit`]); a joint's is a sum of these ([`gather`], [`Recovery`]). Whether the coordinates are in
//! balance says whether the numbers are to be trusted.

pub(crate) mod displace;
pub(crate) mod gather;
pub(crate) mod room;
pub(crate) mod transmit;

use pulp::{Simd, WithSimd};

use super::carry::room::Room;
use super::pass::blocks::arm;
use super::pass::buffers::Buffers;
use super::pass::lane::{Lane, Vec3};
use super::program::Program;
use super::program::inputs::Point;
use super::program::recovery::Recovery;

/// One state; what it moves the output by, and which wrench it puts there, is in the room.
pub(crate) struct Carry<'a> {
    pub program: &'a Program,
    pub recovery: &'a Recovery,
    pub buffers: &'a Buffers,
    pub room: &'a mut Room,
    /// Columns of what acts in it.
    pub columns: &'a [usize],
}

/// What is the same in every state of a pose.
pub(crate) struct Place<'a> {
    pub recovery: &'a Recovery,
    pub buffers: &'a Buffers,
    pub room: &'a mut Room,
}

/// The buffers as registers.
struct State<'a, S: Simd> {
    simd: S,
    program: &'a Program,
    recovery: &'a Recovery,
    columns: &'a [usize],
    rows: &'a [bool],
    inputs: &'a [S::f64s],
    acts: &'a [S::f64s],
    screws: &'a [S::f64s],
    kept: &'a [S::f64s],
    asked: &'a [S::f64s],
    size: Lane<S>,
    moved: &'a mut [S::f64s],
    relative: &'a mut [S::f64s],
    balance: &'a mut [S::f64s],
    origins: &'a mut [S::f64s],
    cuts: &'a mut [S::f64s],
    segments: &'a [S::f64s],
    carried: &'a mut [S::f64s],
}

impl WithSimd for Carry<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            program,
            recovery,
            buffers,
            room,
            columns,
        } = self;
        room.rows.fill(false);
        for column in columns {
            if let Some(row) = program.rows[*column] {
                room.rows[row] = true;
            }
        }
        let size = S::as_simd_f64s(&room.size).0;
        let mut state = State::<S> {
            simd,
            program,
            recovery,
            columns,
            rows: &room.rows,
            inputs: S::as_simd_f64s(&buffers.inputs).0,
            acts: S::as_simd_f64s(&buffers.acts).0,
            screws: S::as_simd_f64s(&buffers.screws).0,
            kept: S::as_simd_f64s(&buffers.kept).0,
            asked: S::as_simd_f64s(&room.asked).0,
            size: Lane::new(simd, size[0]),
            moved: S::as_mut_simd_f64s(&mut room.moved).0,
            relative: S::as_mut_simd_f64s(&mut room.relative).0,
            balance: S::as_mut_simd_f64s(&mut room.balance).0,
            origins: S::as_mut_simd_f64s(&mut room.origins).0,
            cuts: S::as_mut_simd_f64s(&mut room.cuts).0,
            segments: S::as_simd_f64s(&room.segments).0,
            carried: S::as_mut_simd_f64s(&mut room.carried).0,
        };
        state.displace();
        let doubt = state.transmit();
        state.gather();
        S::as_mut_simd_f64s(&mut room.doubt).0[0] = doubt.value;
    }
}

impl<S: Simd> State<'_, S> {
    /// From one point to another; `None` where they are one.
    #[inline(always)]
    fn arm(&self, points: Option<[Point; 2]>) -> Vec3<S> {
        match points {
            Some(points) => arm(self.simd, self.inputs, points),
            None => [self.zero(); 3],
        }
    }

    #[inline(always)]
    fn zero(&self) -> Lane<S> {
        Lane::splat(self.simd, 0.0)
    }

    #[inline(always)]
    fn is_acting(&self, column: usize) -> bool {
        for own in self.columns {
            if *own == column {
                return true;
            }
        }
        false
    }
}
