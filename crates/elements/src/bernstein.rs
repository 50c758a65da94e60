//! Polynomials along a beam in Bernstein form: values between the control points, without
//! cancellation.

use nalgebra::Vector6;

/// Σ c_k B_k(ξ) over 0 ≤ ξ ≤ 1, of degree N − 1. Its ends are the first and the last control
/// point; everything between lies in the convex hull of the control points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bernstein<const N: usize>(pub [Vector6<f64>; N]);

impl<const N: usize> Bernstein<N> {
    /// The value at `xi`.
    pub fn at(&self, xi: f64) -> Vector6<f64> {
        self.split(xi).1.0[0]
    }

    /// The polynomial from 0 to `xi` and from `xi` to 1, each again over 0 to 1 (de Casteljau).
    pub fn split(&self, xi: f64) -> (Self, Self) {
        let (mut left, mut right) = (*self, *self);
        for level in 1..N {
            left.0[level - 1] = right.0[0];
            for k in 0..N - level {
                right.0[k] = right.0[k] * (1.0 - xi) + right.0[k + 1] * xi;
            }
        }
        left.0[N - 1] = right.0[0];
        (left, right)
    }

    /// The same polynomial with one more control point; `M` is N + 1.
    pub fn raised<const M: usize>(&self) -> Bernstein<M> {
        debug_assert_eq!(M, N + 1);
        Bernstein(std::array::from_fn(|k| {
            let part = k as f64 / N as f64;
            if k == 0 {
                self.0[0]
            } else if k == N {
                self.0[N - 1]
            } else {
                self.0[k - 1] * part + self.0[k] * (1.0 - part)
            }
        }))
    }

    /// `end` plus the integral from ξ to 1; `M` is N + 1.
    pub fn integral_to_end<const M: usize>(&self, end: &Vector6<f64>) -> Bernstein<M> {
        debug_assert_eq!(M, N + 1);
        let mut out = Bernstein([*end; M]);
        for k in (0..N).rev() {
            out.0[k] = out.0[k + 1] + self.0[k] / N as f64;
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1 − 3 ξ + 5 ξ², in Bernstein form, in every component.
    fn quadratic() -> Bernstein<3> {
        Bernstein([1.0, -0.5, 3.0].map(Vector6::repeat))
    }

    fn value(xi: f64) -> f64 {
        1.0 - 3.0 * xi + 5.0 * xi * xi
    }

    #[test]
    fn values_parts_and_raised_degree_agree() {
        let (left, right) = quadratic().split(0.3);
        for xi in [0.0, 0.2, 0.7, 1.0] {
            let found = [
                (quadratic().at(xi), xi),
                (quadratic().raised::<4>().at(xi), xi),
                (left.at(xi), 0.3 * xi),
                (right.at(xi), 0.3 + 0.7 * xi),
            ];
            for (found, at) in found {
                assert!((found[2] - value(at)).abs() < 1e-15, "{xi}");
            }
        }
    }

    #[test]
    fn integral_runs_to_the_end() {
        let integral = quadratic().integral_to_end::<4>(&Vector6::repeat(2.0));
        for xi in [0.0, 0.4, 1.0] {
            let primitive = |x: f64| x - 1.5 * x * x + 5.0 / 3.0 * x * x * x;
            let expected = 2.0 + primitive(1.0) - primitive(xi);
            assert!((integral.at(xi)[4] - expected).abs() < 1e-15);
        }
    }
}
