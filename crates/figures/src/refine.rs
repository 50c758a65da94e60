//! A grid made finer, so that contours of a coarse one are smooth.
//!
//! Along each axis the field is a piecewise cubic with continuous slopes: those of the parabola
//! through three neighbours, made less where the cubic would leave the range of its two ends
//! (Fritsch and Carlson 1980), and none at a largest or least value. It is taken along x and then
//! along y, and the other way round, and the mean of both is the field. So the given values stay
//! as they are, no value inside a cell is beyond those at its four corners, and x and y may be
//! exchanged.

use crate::contours::Field;

/// How steep a monotone cubic may be at its ends, over the slope of its chord.
const STEEPEST: f64 = 3.0;

/// A field over a grid of its own.
#[derive(Debug, Clone)]
pub(crate) struct Refined {
    x: Vec<f64>,
    y: Vec<f64>,
    values: Vec<Option<f64>>,
}

impl Refined {
    /// A field with every cell divided into so many parts along x and along y. Cells without a
    /// value at some corner stay empty.
    pub(crate) fn new(field: &Field<'_>, parts: [usize; 2]) -> Self {
        let [across, up] = parts.map(|parts| parts.max(1));
        let (x, y) = (finer(field.x, across), finer(field.y, up));
        let (columns, rows) = (field.x.len(), field.y.len());
        let along_x = |values: &[Option<f64>]| -> Vec<Option<f64>> {
            let rows = values.chunks(columns);
            rows.flat_map(|row| between(field.x, row, across)).collect()
        };
        let along_y = |values: &[Option<f64>]| -> Vec<Option<f64>> {
            let width = values.len() / rows;
            let columns = (0..width).map(|i| {
                let column: Vec<_> = values.iter().skip(i).step_by(width).copied().collect();
                between(field.y, &column, up)
            });
            let columns: Vec<Vec<_>> = columns.collect();
            (0..y.len())
                .flat_map(|j| columns.iter().map(move |column| column[j]))
                .collect()
        };
        let x_first = along_y(&along_x(field.values));
        let y_first = along_x(&along_y(field.values));
        let mean = |(a, b): (Option<f64>, Option<f64>)| Some(a? + 0.5 * (b? - a?));
        Self {
            values: x_first.into_iter().zip(y_first).map(mean).collect(),
            x,
            y,
        }
    }

    pub(crate) fn field(&self) -> Field<'_> {
        Field {
            x: &self.x,
            y: &self.y,
            values: &self.values,
        }
    }
}

/// Ascending places with each gap divided into so many parts.
fn finer(places: &[f64], parts: usize) -> Vec<f64> {
    let gaps = places.windows(2).flat_map(|gap| {
        (0..parts).map(move |k| gap[0] + (gap[1] - gap[0]) * k as f64 / parts as f64)
    });
    gaps.chain(places.last().copied()).collect()
}

/// Values at the finer places; none between two of which one is missing.
fn between(places: &[f64], values: &[Option<f64>], parts: usize) -> Vec<Option<f64>> {
    let mut finer = Vec::with_capacity((places.len() - 1) * parts + 1);
    for k in 0..places.len() - 1 {
        finer.push(values[k]);
        let ends = values[k].zip(values[k + 1]);
        let step = places[k + 1] - places[k];
        for part in 1..parts {
            let t = part as f64 / parts as f64;
            finer.push(ends.map(|(from, to)| {
                let slopes = [k, k + 1].map(|k| step * slope(places, values, k));
                let value = hermite([from, to], slopes, t);
                // Rounding apart it is there already.
                value.clamp(from.min(to), from.max(to))
            }));
        }
    }
    finer.extend(values.last().copied());
    finer
}

/// The cubic on 0 to 1 with these values and slopes at its ends.
fn hermite([from, to]: [f64; 2], [leaves, arrives]: [f64; 2], t: f64) -> f64 {
    let s = 1.0 - t;
    from + (to - from) * t * t * (3.0 - 2.0 * t) + t * s * (s * leaves - t * arrives)
}

/// The slope at a place that has a value.
fn slope(places: &[f64], values: &[Option<f64>], k: usize) -> f64 {
    // Length and slope of the gap from place k to the next.
    let gap = |k: usize| {
        let (from, to) = ((*values.get(k)?)?, (*values.get(k + 1)?)?);
        let step = places[k + 1] - places[k];
        Some((step, (to - from) / step))
    };
    // At the end of a row: of the parabola through three.
    let end = |near: (f64, f64), far: Option<(f64, f64)>| {
        let (h, d) = near;
        let Some((h2, d2)) = far else {
            return d;
        };
        let slope = d + h * (d - d2) / (h + h2);
        if slope * d <= 0.0 {
            0.0
        } else {
            d.signum() * slope.abs().min(STEEPEST * d.abs())
        }
    };
    let before = k.checked_sub(1).and_then(gap);
    match (before, gap(k)) {
        (None, None) => 0.0,
        (None, Some(near)) => end(near, gap(k + 1)),
        (Some(near), None) => end(near, k.checked_sub(2).and_then(gap)),
        (Some((h0, d0)), Some((h1, d1))) => {
            if d0 * d1 <= 0.0 {
                return 0.0;
            }
            let slope = (h1 * d0 + h0 * d1) / (h0 + h1);
            let steepest = STEEPEST * d0.abs().min(d1.abs());
            slope.clamp(-steepest, steepest)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values over a grid of n×n points from −1 to 1, and the grid made finer.
    fn refined(
        n: usize,
        parts: usize,
        of: impl Fn(f64, f64) -> Option<f64>,
    ) -> (Vec<f64>, Refined) {
        let ticks: Vec<f64> = (0..n)
            .map(|k| -1.0 + 2.0 * k as f64 / (n - 1) as f64)
            .collect();
        let values: Vec<_> = (ticks.iter())
            .flat_map(|y| ticks.iter().map(|x| of(*x, *y)).collect::<Vec<_>>())
            .collect();
        let field = Field {
            x: &ticks,
            y: &ticks,
            values: &values,
        };
        let refined = Refined::new(&field, [parts; 2]);
        (ticks, refined)
    }

    #[test]
    fn a_plane_stays_a_plane() {
        let plane = |x: f64, y: f64| 3.0 + 2.0 * x - 0.5 * y;
        let (_, fine) = refined(4, 5, |x, y| Some(plane(x, y)));
        assert_eq!((fine.x.len(), fine.y.len()), (16, 16));
        for (k, value) in fine.values.iter().enumerate() {
            let expected = plane(fine.x[k % 16], fine.y[k / 16]);
            assert!((value.unwrap() - expected).abs() < 1e-14);
        }
    }

    #[test]
    fn given_values_stay_and_no_cell_leaves_the_range_of_its_corners() {
        // Steep, with a spike and a pit: what an ordinary bicubic overshoots.
        let field = |x: f64, y: f64| {
            let spike = if x.hypot(y) < 0.1 { 50.0 } else { 0.0 };
            let pit = if (x - 0.5).hypot(y + 0.5) < 0.1 {
                -30.0
            } else {
                0.0
            };
            (6.0 * (x - 0.3 * y)).tanh() + spike + pit
        };
        let (n, parts) = (9, 6);
        let (ticks, fine) = refined(n, parts, |x, y| Some(field(x, y)));
        let width = fine.x.len();
        let at = |i: usize, j: usize| fine.values[i + j * width].unwrap();
        for j in 0..n - 1 {
            for i in 0..n - 1 {
                let corner = |i: usize, j: usize| field(ticks[i], ticks[j]);
                let corners = [
                    corner(i, j),
                    corner(i + 1, j),
                    corner(i, j + 1),
                    corner(i + 1, j + 1),
                ];
                assert_eq!(at(i * parts, j * parts), corners[0]);
                let least = corners.iter().copied().fold(f64::INFINITY, f64::min);
                let most = corners.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                for b in 0..=parts {
                    for a in 0..=parts {
                        let value = at(i * parts + a, j * parts + b);
                        assert!((least..=most).contains(&value), "{i} {j}: {value}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_smooth_field_is_met_better_than_by_straight_lines() {
        let field = |x: f64, y: f64| (1.3 * x + 0.4 * y).exp();
        // Error at the middles of the cells' sides, of the finer field and of the mean of two ends.
        let (ticks, fine) = refined(9, 2, |x, y| Some(field(x, y)));
        let width = fine.x.len();
        let (mut smooth, mut straight) = (0.0_f64, 0.0_f64);
        for j in 0..9 {
            for i in 0..8 {
                let (x, y) = (0.5 * (ticks[i] + ticks[i + 1]), ticks[j]);
                let mean = 0.5 * (field(ticks[i], y) + field(ticks[i + 1], y));
                let found = fine.values[2 * i + 1 + 2 * j * width].unwrap();
                smooth = smooth.max((found - field(x, y)).abs());
                straight = straight.max((mean - field(x, y)).abs());
            }
        }
        assert!(smooth < 0.2 * straight, "{smooth} {straight}");
    }

    #[test]
    fn x_and_y_may_be_exchanged() {
        let field = |x: f64, y: f64| 1.0 / (1.1 + x * y + 0.3 * x);
        let (_, fine) = refined(6, 4, |x, y| Some(field(x, y)));
        let (_, turned) = refined(6, 4, |x, y| Some(field(y, x)));
        let width = fine.x.len();
        for k in 0..fine.values.len() {
            let exchanged = turned.values[k / width + k % width * width];
            assert!((fine.values[k].unwrap() - exchanged.unwrap()).abs() < 1e-15);
        }
    }

    #[test]
    fn cells_with_a_missing_corner_stay_empty() {
        let hole = |x: f64, y: f64| (x.hypot(y) > 0.1).then_some(1.0 + x);
        let (_, fine) = refined(5, 3, hole);
        let field = fine.field();
        for j in 0..12 {
            for i in 0..12 {
                let beside_the_hole = (3..9).contains(&i) && (3..9).contains(&j);
                assert_eq!(field.cell(i, j).is_none(), beside_the_hole, "{i} {j}");
            }
        }
    }
}
