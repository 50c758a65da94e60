//! Eight poses' frames, misfits and Jacobians.

// Loops over registers are written by index, as in `lane.rs`.
#![allow(clippy::needless_range_loop)]

use hyperstat_model::LANES;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

use crate::lanes::lane::{
    Lane, Matrix, Vector, cross, dot, largest, minus, plus, scaled, sin_cos, times, times_fixed,
};
use crate::lanes::program::{Closing, Program};
use crate::twist::{rotation_vector, rotation_vector_rate};

/// Where a body is, from home: a rotation, and where the centre goes (sizes).
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub turn: Matrix,
    pub place: Vector,
}

/// What a coordinate does to what comes after it.
#[derive(Debug, Clone, Copy)]
struct Motion {
    linear: Vector,
    angular: Vector,
}

/// What is asked of eight poses, in the program's order.
#[derive(Debug, Clone, Default)]
pub(super) struct Wanted {
    /// The output's position from the centre (sizes) and rotation vector (rad).
    pub output: [Lane; 6],
    /// The rotation, where all of it is asked.
    pub turn: Matrix,
    pub drives: Vec<Lane>,
}

/// Numbers of eight poses.
#[derive(Debug, Clone)]
pub(super) struct Numbers {
    pub frames: Vec<Frame>,
    motions: Vec<Motion>,
    /// Misfits of the conditions.
    pub misfits: Vec<Lane>,
    pub jacobian: Vec<Lane>,
    /// Change of the rotation vector by the angular velocity, where single coordinates of it are asked.
    rate: Matrix,
}

const NOTHING: Vector = [Lane::ZERO; 3];
const UNIT: Matrix = [
    [Lane::ONE, Lane::ZERO, Lane::ZERO],
    [Lane::ZERO, Lane::ONE, Lane::ZERO],
    [Lane::ZERO, Lane::ZERO, Lane::ONE],
];
const HOME: Frame = Frame {
    turn: UNIT,
    place: NOTHING,
};

impl Default for Lane {
    fn default() -> Self {
        Self::ZERO
    }
}

impl Frame {
    /// Where a point is that is at `place` at home.
    #[inline(always)]
    fn of(&self, place: &[f64; 3]) -> Vector {
        plus(&times_fixed(&self.turn, place), &self.place)
    }

    /// The rotation of one pose.
    pub fn rotation(&self, lane: usize) -> Rotation3<f64> {
        Rotation3::from_matrix_unchecked(Matrix3::from_fn(|r, c| self.turn[c][r].0[lane]))
    }

    /// Where the centre goes in one pose (sizes).
    pub fn translation(&self, lane: usize) -> Vector3<f64> {
        Vector3::from_fn(|k, _| self.place[k].0[lane])
    }
}

impl Numbers {
    pub fn new(program: &Program) -> Self {
        let still = Motion {
            linear: NOTHING,
            angular: NOTHING,
        };
        Self {
            frames: vec![HOME; program.frames],
            motions: vec![still; program.columns],
            misfits: vec![Lane::ZERO; program.rows],
            jacobian: vec![Lane::ZERO; program.entries],
            rate: UNIT,
        }
    }

    /// Position (sizes) and rotation vector of the output in one pose.
    pub fn output(&self, program: &Program, lane: usize) -> [f64; 6] {
        let frame = &self.frames[program.output.frame];
        let place = Vector3::from(program.output.place);
        let place = frame.rotation(lane) * place + frame.translation(lane);
        let turn = vector_of(&frame.rotation(lane));
        [place.x, place.y, place.z, turn.x, turn.y, turn.z]
    }

    /// Where everything is, and what every coordinate moves.
    #[inline(always)]
    pub fn pose(&mut self, program: &Program, x: &[Lane]) {
        for step in &program.moves {
            let from = &self.frames[step.from];
            let angular = times_fixed(&from.turn, &step.angular);
            let along = times_fixed(&from.turn, &step.linear);
            let amount = x[step.column];
            let to = match &step.turn {
                None => {
                    let amount = amount * step.sign;
                    Frame {
                        turn: from.turn,
                        place: plus(&from.place, &scaled(&along, amount)),
                    }
                }
                Some(turn) => {
                    let angle = amount * turn.rate;
                    let (sine, cosine) = sin_cos(angle);
                    let rest = Lane::ONE - cosine;
                    let mut own = UNIT;
                    let mut moved = NOTHING;
                    for c in 0..3 {
                        for r in 0..3 {
                            own[c][r] += sine * turn.once[c][r] + rest * turn.twice[c][r];
                        }
                        moved[c] = angle * turn.t[c] - (sine * turn.u[c] + rest * turn.v[c]);
                    }
                    Frame {
                        turn: [
                            times(&from.turn, &own[0]),
                            times(&from.turn, &own[1]),
                            times(&from.turn, &own[2]),
                        ],
                        place: plus(&times(&from.turn, &moved), &from.place),
                    }
                }
            };
            self.motions[step.column] = Motion {
                linear: plus(&along, &cross(&from.place, &angular)),
                angular,
            };
            self.frames[step.to] = to;
        }
    }

    /// By how much the conditions are missed.
    #[inline(always)]
    pub fn miss(&mut self, program: &Program, x: &[Lane], wanted: &Wanted) {
        for closing in &program.closings {
            self.miss_closing(closing);
        }
        self.miss_target(program, x, wanted);
    }

    #[inline(always)]
    fn miss_closing(&mut self, closing: &Closing) {
        let [second, end] = [&self.frames[closing.second], &self.frames[closing.end]];
        let gap = minus(&second.of(&closing.place), &end.of(&closing.place));
        let row = closing.row;
        self.misfits[row..row + 3].copy_from_slice(&gap);
        if closing.rows == 6 {
            let turned = between(&end.turn, &second.turn);
            self.misfits[row + 3..row + 6].copy_from_slice(&turned);
        }
    }

    /// The misfits of what is asked of the output and the drives alone.
    #[inline(always)]
    pub fn miss_target(&mut self, program: &Program, x: &[Lane], wanted: &Wanted) {
        let output = &program.output;
        let frame = &self.frames[output.frame];
        let place = frame.of(&output.place);
        let turned = if output.whole {
            between(&wanted.turn, &frame.turn)
        } else if output.turns {
            let (vector, rate) = rotation_vectors(frame);
            self.rate = rate;
            let [.., rx, ry, rz] = wanted.output;
            minus(&vector, &[rx, ry, rz])
        } else {
            NOTHING
        };
        for (row, k) in output.coordinates.iter().enumerate() {
            self.misfits[output.row + row] = match k {
                0..3 => place[*k] - wanted.output[*k],
                _ => turned[*k - 3],
            };
        }
        let first = output.row + output.coordinates.len();
        for (row, (column, wanted)) in program.drives.iter().zip(&wanted.drives).enumerate() {
            self.misfits[first + row] = x[*column] - *wanted;
        }
    }

    /// The derivatives of all conditions but the drives'.
    #[inline(always)]
    pub fn differentiate(&mut self, program: &Program) {
        for closing in &program.closings {
            let place = self.frames[closing.second].of(&closing.place);
            for block in &closing.blocks {
                let Motion { linear, angular } = &self.motions[block.column];
                let linear = plus(linear, &cross(angular, &place));
                for (k, linear) in linear.iter().enumerate() {
                    self.jacobian[block.first + k] = *linear * block.sign;
                }
                if closing.rows == 6 {
                    for (k, angular) in angular.iter().enumerate() {
                        self.jacobian[block.first + 3 + k] = *angular * block.sign;
                    }
                }
            }
        }
        let output = &program.output;
        let place = self.frames[output.frame].of(&output.place);
        for block in &output.blocks {
            let Motion { linear, angular } = &self.motions[block.column];
            let linear = plus(linear, &cross(angular, &place));
            let turned = match output.turns && !output.whole {
                true => times(&self.rate, angular),
                false => *angular,
            };
            for (row, k) in output.coordinates.iter().enumerate() {
                let rate = match k {
                    0..3 => linear[*k],
                    _ => turned[*k - 3],
                };
                self.jacobian[block.first + row] = rate * block.sign;
            }
        }
    }

    /// The largest misfit of every pose.
    #[inline(always)]
    pub fn largest_misfit(&self) -> Lane {
        largest(&self.misfits)
    }
}

/// The rotation vector from the axes `a` to the axes `b`, to the fifth power of its size; infinite from
/// 90° on.
#[inline(always)]
fn between(a: &Matrix, b: &Matrix) -> Vector {
    let mut sine = NOTHING;
    let mut trace = Lane::ZERO;
    for k in 0..3 {
        sine = plus(&sine, &cross(&a[k], &b[k]));
        trace += dot(&a[k], &b[k]);
    }
    let sine = scaled(&sine, Lane::of(0.5));
    let square = dot(&sine, &sine);
    let factor = Lane::ONE + square * (Lane::of(1.0 / 6.0) + square * (3.0 / 40.0));
    let factor = factor.zip(
        trace,
        |f, trace| if trace > 1.0 { f } else { f64::INFINITY },
    );
    scaled(&sine, factor)
}

/// The rotation vectors of eight poses, each of half a turn at most, and how they change.
fn rotation_vectors(frame: &Frame) -> (Vector, Matrix) {
    let mut vectors = NOTHING;
    let mut rates = UNIT;
    for lane in 0..LANES {
        let vector = vector_of(&frame.rotation(lane));
        for k in 0..3 {
            vectors[k].0[lane] = vector[k];
            let rate = rotation_vector_rate(&vector, &Vector3::ith(k, 1.0));
            for r in 0..3 {
                rates[k][r].0[lane] = rate[r];
            }
        }
    }
    (vectors, rates)
}

/// The rotation vector of a rotation, of half a turn at most.
fn vector_of(rotation: &Rotation3<f64>) -> Vector3<f64> {
    let rotation = UnitQuaternion::from_rotation_matrix(rotation);
    rotation_vector(&rotation, &Vector3::zeros())
}
