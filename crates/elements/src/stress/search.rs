//! Where along a beam a stress is largest.

use nalgebra::Vector6;

use super::along::Peak;
use crate::bernstein::Bernstein;

/// Places along a beam of changing section that are looked at first.
const PLACES: usize = 256;
/// Steps of the search about the best of them, each of which leaves 0.62 of the interval.
const STEPS: usize = 40;
/// The largest value along a prismatic beam is found to this part of itself.
const PART: f64 = 1e-12;
/// Intervals looked at before the search of a prismatic beam ends in any case.
const INTERVALS: usize = 20_000;

/// The largest value of a function on 0 to 1: every place of many that none of its neighbours
/// exceeds, refined by golden section. Of equal values the first.
pub(super) fn maximum(value: impl Fn(f64) -> f64) -> Peak {
    let place = |k: usize| k as f64 / PLACES as f64;
    let sampled: Vec<f64> = (0..=PLACES).map(|k| value(place(k))).collect();
    let mut best = Peak {
        value: sampled[0],
        xi: 0.0,
    };
    for (k, at_place) in sampled.iter().enumerate() {
        best.improve(*at_place, place(k));
    }
    for k in 0..=PLACES {
        let (before, after) = (k.saturating_sub(1), (k + 1).min(PLACES));
        // A flat function is at its largest already.
        let flat = sampled[before] == sampled[k] && sampled[after] == sampled[k];
        if flat || sampled[before] > sampled[k] || sampled[after] > sampled[k] {
            continue;
        }
        refine(&value, place(before), place(after), &mut best);
    }
    best
}

/// Golden section on `low` to `high`.
fn refine(value: impl Fn(f64) -> f64, mut low: f64, mut high: f64, best: &mut Peak) {
    let golden = (5f64.sqrt() - 1.0) / 2.0;
    for _ in 0..STEPS {
        let width = golden * (high - low);
        let (left, right) = (high - width, low + width);
        let (at_left, at_right) = (value(left), value(right));
        best.improve(at_left, left);
        best.improve(at_right, right);
        if at_left > at_right {
            high = right;
        } else {
            low = left;
        }
    }
}

/// The largest value along a beam of a stress that is a convex function of the section wrench.
///
/// On an interval such a function is nowhere larger than at the largest of the interval's control
/// points, of which the first and the last are on the curve. An interval whose bound is not above
/// the best value found is done, any other is halved: no peak is missed, however narrow.
pub(super) fn convex_maximum(
    wrenches: &Bernstein<5>,
    stress: impl Fn(&Vector6<f64>) -> f64,
) -> Peak {
    let mut best = Peak {
        value: stress(&wrenches.0[0]),
        xi: 0.0,
    };
    best.improve(stress(&wrenches.0[4]), 1.0);
    let mut waiting = vec![(*wrenches, 0.0, 1.0)];
    for _ in 0..INTERVALS {
        let Some((piece, first, last)) = waiting.pop() else {
            break;
        };
        let bound = piece.0.iter().map(&stress).fold(0.0, f64::max);
        let middle = first + (last - first) / 2.0;
        let promising = bound > best.value * (1.0 + PART);
        if !promising || middle <= first || middle >= last {
            continue;
        }
        let (left, right) = piece.split(0.5);
        best.improve(stress(&right.0[0]), middle);
        waiting.push((right, middle, last));
        waiting.push((left, first, middle));
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A narrow peak beside a broad one that is nearly as high.
    #[test]
    fn the_higher_of_two_peaks_is_found() {
        let value = |x: f64| {
            let peak = |at: f64, width: f64| (-((x - at) / width).powi(2)).exp();
            peak(0.2, 0.1) + 1.001 * peak(0.7009, 0.004)
        };
        let found = maximum(value);
        assert!((found.value - 1.001).abs() < 1e-8, "{found:?}");
        assert!((found.xi - 0.7009).abs() < 1e-6, "{found:?}");
    }

    /// |4 x (1 − x)| and a function that is the same everywhere.
    #[test]
    fn peaks_between_the_ends_and_flat_ones() {
        let parabola = Bernstein([0.0, 2.0, 0.0].map(Vector6::repeat));
        let raised = parabola.raised::<4>().raised::<5>();
        let found = convex_maximum(&raised, |w| w[3].abs());
        assert_eq!((found.value, found.xi), (1.0, 0.5));
        let found = convex_maximum(&Bernstein([Vector6::repeat(-2.0); 5]), |w| w[0].abs());
        assert_eq!((found.value, found.xi), (2.0, 0.0));
        assert_eq!(
            maximum(|_| 3.0),
            Peak {
                value: 3.0,
                xi: 0.0
            }
        );
    }

    /// The maximum of √(p² + q²) against a scan of 2·10⁵ places, where the two quartics peak apart.
    #[test]
    fn convex_search_agrees_with_a_fine_scan() {
        let control = |k: usize| {
            let [a, b] = [[1.0, -7.0, 11.0, -6.0, 0.5], [0.2, 5.0, -9.0, 8.0, -1.0]];
            Vector6::new(a[k], b[k], 0.0, 0.0, 0.0, 0.0)
        };
        let curve = Bernstein(std::array::from_fn(control));
        let size = |w: &Vector6<f64>| w[0].hypot(w[1]);
        let found = convex_maximum(&curve, size);
        let scan = (0..=200_000).map(|k| size(&curve.at(f64::from(k) / 2e5)));
        let scanned = scan.fold(0.0, f64::max);
        assert!(found.value >= scanned, "{found:?} {scanned}");
        assert!(found.value - scanned < 1e-8, "{found:?} {scanned}");
        assert!((size(&curve.at(found.xi)) / found.value - 1.0).abs() < 1e-15);
    }
}
