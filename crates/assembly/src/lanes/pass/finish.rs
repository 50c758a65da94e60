//! Stiffness and displacements of the output from what the last front left, and whether they are to be
//! trusted.

use pulp::Simd;

use super::blocks::{arm, pair, vector};
use super::factor::ROUNDING;
use super::lane::{Lane, add, cross, dot, six, sub};
use super::{OF_STATE, Registers, displacement};
use crate::lanes::program::Program;
use crate::pose::restraint::SUSPICIOUS_PIVOT;

impl<S: Simd> Registers<'_, S> {
    /// Stiffness and displacements from what the last front left.
    #[inline(always)]
    pub fn finish(&mut self, simd: S, program: &Program) {
        let Some(last) = program.fronts.list.last() else {
            return;
        };
        let zero = Lane::splat(simd, 0.0);
        let rounding = Lane::splat(simd, ROUNDING);
        let height = 6 + program.fronts.rows;
        let rest = &self.rests[last.rest_start..];
        let variables = &last.variables[last.pivots..];
        let mut k = [[zero; 6]; 6];
        let mut error = zero;
        let mut place = 0;
        for column in 0..6 {
            for row in column..6 {
                k[row][column] = Lane::new(simd, rest[column * height + row]);
                self.results[place] = k[row][column].value;
                place += 1;
            }
            let own = Lane::new(simd, self.errors[variables[column]]);
            error = error.max(own / k[column][column]);
        }
        let error = error * rounding + self.unsound(simd, program, &k);
        self.results[place] = error.value;
        let solver = Solver::new(&k);
        for (column, row) in program.rows.iter().enumerate() {
            let mut force = [zero; 6];
            match row {
                Some(row) => {
                    for c in 0..6 {
                        force[c] = Lane::new(simd, rest[c * height + 6 + row]);
                    }
                }
                None => {
                    for load in &program.loads {
                        if load.column != column {
                            continue;
                        }
                        let (linear, mut angular) = pair(simd, self.acts, load.act);
                        if let Some(points) = load.node.arm {
                            let arm = arm(simd, self.inputs, points);
                            angular = add(&angular, &cross(&arm, &linear));
                        }
                        for c in 0..3 {
                            force[c] += linear[c];
                            force[3 + c] += angular[c];
                        }
                    }
                }
            }
            let displacement = solver.solve(force);
            // Its size: the largest component, measured as its stiffness measures it.
            let mut energy = zero;
            let mut lost = error + rounding;
            for c in 0..6 {
                energy = energy.max(displacement[c] * displacement[c] * k[c][c]);
                // What is not a finite number stays so.
                lost = displacement[c].mul_add(zero, lost);
            }
            if let Some(row) = row {
                // A pivot's error acts on the forces handed on to the output as on the stiffness: by
                // the geometric mean of what it does to the two diagonals.
                let own = Lane::new(simd, self.errors[program.coordinates + row]);
                let mut by_loads = own * rounding * error;
                for c in 0..6 {
                    let place = row * program.coordinates + variables[c];
                    let own = Lane::new(simd, self.load_errors[place]);
                    by_loads = by_loads.max(own * rounding * rounding / k[c][c]);
                }
                let by_loads = by_loads / energy;
                lost += by_loads.if_above(zero, by_loads, zero).sqrt();
                // What is not a number stays so.
                lost += own * zero;
            }
            let out = &mut self.columns[8 * column..8 * column + 8];
            for c in 0..6 {
                out[c] = displacement[c].value;
            }
            out[6] = (lost * solver.gain).value;
            out[7] = energy.value;
        }
        for (state, columns) in program.states.iter().enumerate() {
            let out = &mut self.results[displacement(state)..][..OF_STATE];
            if let [column] = columns[..] {
                out.copy_from_slice(&self.columns[8 * column..8 * column + OF_STATE]);
                continue;
            }
            let mut sum = [zero; 6];
            let mut lost = zero;
            for column in columns {
                let own = &self.columns[8 * column..8 * column + 8];
                for c in 0..6 {
                    sum[c] += Lane::new(simd, own[c]);
                }
                lost = Lane::new(simd, own[6]).mul_add(Lane::new(simd, own[7]).sqrt(), lost);
            }
            let mut energy = zero;
            for c in 0..6 {
                out[c] = sum[c].value;
                energy = energy.max(sum[c] * sum[c] * k[c][c]);
                lost = sum[c].mul_add(zero, lost);
            }
            // Where nothing moves it, what the stiffness itself has lost; what is not a number stays so.
            let of_stiffness = (error + rounding) * solver.gain;
            let relative = lost.if_above(zero, lost / energy.sqrt(), of_stiffness);
            out[6] = (relative + lost * zero).value;
        }
    }

    /// Zero; no number where the output's stiffness is none, or next to nothing along or about an axis, as
    /// [`is_nearly_free`](crate::pose::restraint::is_nearly_free) tells it.
    #[inline(always)]
    fn unsound(&self, simd: S, program: &Program, k: &[[Lane<S>; 6]; 6]) -> Lane<S> {
        let (zero, one) = (Lane::splat(simd, 0.0), Lane::splat(simd, 1.0));
        let nan = Lane::splat(simd, f64::NAN);
        let square = self.square_of_size(simd, program);
        let square = square.if_above(zero, square, one);
        let mut along = six!(c => k[c][c]);
        for c in 0..3 {
            along[c] = along[c] * square;
        }
        let mut largest = zero;
        for c in 0..6 {
            largest = along[c].max(largest);
        }
        let least = largest * Lane::splat(simd, SUSPICIOUS_PIVOT);
        let mut unsound = zero;
        for c in 0..6 {
            unsound += along[c].if_above(least, zero, nan);
            for r in c..6 {
                unsound = k[r][c].mul_add(zero, unsound);
            }
        }
        unsound
    }

    /// The square of the mechanism's size, the diagonal of the box around all points; what is no number
    /// is left out.
    #[inline(always)]
    fn square_of_size(&self, simd: S, program: &Program) -> Lane<S> {
        let first = vector(simd, self.inputs, program.points[0]);
        let (mut low, mut high) = (first, first);
        for point in &program.points {
            let own = vector(simd, self.inputs, *point);
            for c in 0..3 {
                low[c] = own[c].min(low[c]);
                high[c] = own[c].max(high[c]);
            }
        }
        let diagonal = sub(&high, &low);
        dot(&diagonal, &diagonal)
    }
}

/// `L D Lᵀ` of the output's stiffness.
struct Solver<S: Simd> {
    /// Lower triangle.
    l: [[Lane<S>; 6]; 6],
    inverses: [Lane<S>; 6],
    /// The largest `K_ii (K⁻¹)_ii`: what an error of K is multiplied by.
    gain: Lane<S>,
}

impl<S: Simd> Solver<S> {
    #[inline(always)]
    fn new(k: &[[Lane<S>; 6]; 6]) -> Self {
        let (zero, one) = (k[0][0].constant(0.0), k[0][0].constant(1.0));
        let mut l = *k;
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
        Self { l, inverses, gain }
    }

    /// `K u = f`.
    #[inline(always)]
    fn solve(&self, mut u: [Lane<S>; 6]) -> [Lane<S>; 6] {
        for c in 0..6 {
            for r in c + 1..6 {
                let minus = -(self.l[r][c] * self.inverses[c]);
                u[r] = u[c].mul_add(minus, u[r]);
            }
        }
        for c in (0..6).rev() {
            let mut sum = u[c];
            for r in c + 1..6 {
                sum = (-self.l[r][c]).mul_add(u[r], sum);
            }
            u[c] = sum * self.inverses[c];
        }
        u
    }
}
