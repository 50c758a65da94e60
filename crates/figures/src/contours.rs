//! Contours of a field over a grid: marching squares, linear along the sides of the cells.
//!
//! A cell counts where all four of its corners have a value. Where two opposite corners of a cell
//! are above a level and the others below, the mean of the four says which two belong together.

use std::collections::BTreeMap;

use crate::geometry::PagePoint;

/// A field over a grid: a value at every (x, y), or none.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Field<'a> {
    /// Ascending.
    pub(crate) x: &'a [f64],
    /// Ascending.
    pub(crate) y: &'a [f64],
    /// x fastest.
    pub(crate) values: &'a [Option<f64>],
}

/// A point where a contour starts or ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum EndPoint {
    /// A point of the grid.
    Node(usize, usize),
    /// On the side from a point to the next one along x.
    AlongX(usize, usize),
    /// On the side from a point to the next one along y.
    AlongY(usize, usize),
}

/// Directed ways, with what is above the level on their left.
#[derive(Debug, Default)]
struct Ways(BTreeMap<EndPoint, Vec<EndPoint>>);

impl Ways {
    fn add(&mut self, from: EndPoint, to: EndPoint) {
        self.0.entry(from).or_default().push(to);
    }

    /// Takes one of the ways that start at a place.
    fn take(&mut self, from: EndPoint) -> Option<EndPoint> {
        let all = self.0.get_mut(&from)?;
        let to = all.pop();
        if all.is_empty() {
            self.0.remove(&from);
        }
        to
    }

    /// Joins the ways end to end: those with two ends first, then those that close.
    fn chains(mut self) -> Vec<Vec<EndPoint>> {
        let ends: Vec<EndPoint> = self.0.values().flatten().copied().collect();
        let open: Vec<EndPoint> = {
            let ends: std::collections::BTreeSet<_> = ends.into_iter().collect();
            let starts = self.0.keys().copied();
            starts.filter(|start| !ends.contains(start)).collect()
        };
        let mut chains: Vec<_> = open.into_iter().map(|start| self.chain(start)).collect();
        while let Some(start) = self.0.keys().next().copied() {
            chains.push(self.chain(start));
        }
        chains
    }

    fn chain(&mut self, start: EndPoint) -> Vec<EndPoint> {
        let mut chain = vec![start];
        let mut at = start;
        while let Some(next) = self.take(at) {
            chain.push(next);
            at = next;
            if at == start {
                break;
            }
        }
        chain
    }
}

impl Field<'_> {
    /// The regions where the field is at `level` or above: closed lines around them.
    pub(crate) fn region(&self, level: f64) -> Vec<Vec<PagePoint>> {
        self.traced(level, true)
    }

    /// The lines on which the field is at `level`.
    pub(crate) fn lines(&self, level: f64) -> Vec<Vec<PagePoint>> {
        self.traced(level, false)
    }

    fn traced(&self, level: f64, closed: bool) -> Vec<Vec<PagePoint>> {
        let mut ways = Ways::default();
        for j in 0..self.y.len().saturating_sub(1) {
            for i in 0..self.x.len().saturating_sub(1) {
                self.cross(i, j, level, &mut ways);
                if closed {
                    self.border(i, j, level, &mut ways);
                }
            }
        }
        let chains = ways.chains();
        let points = |chain: Vec<EndPoint>| -> Vec<PagePoint> {
            chain.into_iter().map(|at| self.point(at, level)).collect()
        };
        chains.into_iter().map(points).collect()
    }

    fn value(&self, (i, j): (usize, usize)) -> Option<f64> {
        self.values[i + j * self.x.len()]
    }

    /// The values at the corners of a cell, counterclockwise, where it counts.
    pub(crate) fn cell(&self, i: usize, j: usize) -> Option<[f64; 4]> {
        if i + 1 >= self.x.len() || j + 1 >= self.y.len() {
            return None;
        }
        let corners = corners(i, j).map(|corner| self.value(corner));
        let [Some(a), Some(b), Some(c), Some(d)] = corners else {
            return None;
        };
        Some([a, b, c, d])
    }

    /// Adds the ways of a level through a cell.
    fn cross(&self, i: usize, j: usize, level: f64, ways: &mut Ways) {
        let Some(values) = self.cell(i, j) else {
            return;
        };
        let above = values.map(|value| value >= level);
        // Sides at which a walk counterclockwise round the cell leaves, or enters, what is above.
        let exits = |k: &usize| above[*k] && !above[(k + 1) % 4];
        let enters = |k: &usize| !above[*k] && above[(k + 1) % 4];
        let joined = values.iter().sum::<f64>() / 4.0 >= level;
        for exit in (0..4).filter(exits) {
            // Around what is below where what is above is joined, else around what is above.
            let mut others = (1..4).map(|step| (exit + step) % 4);
            let entry = if joined {
                others.find(enters)
            } else {
                others.rfind(enters)
            };
            if let Some(entry) = entry {
                ways.add(side(i, j, exit), side(i, j, entry));
            }
        }
    }

    /// Adds the ways along the sides of a cell at which no other cell is.
    fn border(&self, i: usize, j: usize, level: f64, ways: &mut Ways) {
        let Some(values) = self.cell(i, j) else {
            return;
        };
        let neighbours = [
            j.checked_sub(1).and_then(|j| self.cell(i, j)),
            self.cell(i + 1, j),
            self.cell(i, j + 1),
            i.checked_sub(1).and_then(|i| self.cell(i, j)),
        ];
        for (k, neighbour) in neighbours.iter().enumerate() {
            if neighbour.is_some() {
                continue;
            }
            let next = (k + 1) % 4;
            let ends = [k, next].map(|k| {
                let (i, j) = corners(i, j)[k];
                EndPoint::Node(i, j)
            });
            match [values[k] >= level, values[next] >= level] {
                [true, true] => ways.add(ends[0], ends[1]),
                [true, false] => ways.add(ends[0], side(i, j, k)),
                [false, true] => ways.add(side(i, j, k), ends[1]),
                [false, false] => {}
            }
        }
    }

    /// Where a place is, for a level that lies between the values of the side's ends.
    fn point(&self, place: EndPoint, level: f64) -> PagePoint {
        let part = |from, to| match (self.value(from), self.value(to)) {
            (Some(from), Some(to)) => (level - from) / (to - from),
            _ => 0.0,
        };
        match place {
            EndPoint::Node(i, j) => [self.x[i], self.y[j]],
            EndPoint::AlongX(i, j) => {
                let part = part((i, j), (i + 1, j));
                [self.x[i] + part * (self.x[i + 1] - self.x[i]), self.y[j]]
            }
            EndPoint::AlongY(i, j) => {
                let part = part((i, j), (i, j + 1));
                [self.x[i], self.y[j] + part * (self.y[j + 1] - self.y[j])]
            }
        }
    }
}

/// The corners of a cell, counterclockwise from the one of the smallest coordinates.
fn corners(i: usize, j: usize) -> [(usize, usize); 4] {
    [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
}

/// The side of a cell from corner k to the next.
fn side(i: usize, j: usize, k: usize) -> EndPoint {
    match k {
        0 => EndPoint::AlongX(i, j),
        1 => EndPoint::AlongY(i + 1, j),
        2 => EndPoint::AlongX(i, j + 1),
        _ => EndPoint::AlongY(i, j),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(loops: &[Vec<PagePoint>]) -> f64 {
        let of = |line: &Vec<PagePoint>| -> f64 {
            line.windows(2)
                .map(|p| 0.5 * (p[0][0] * p[1][1] - p[1][0] * p[0][1]))
                .sum()
        };
        loops.iter().map(of).sum()
    }

    fn grid(count: usize) -> Vec<f64> {
        (0..count)
            .map(|k| -1.0 + 2.0 * k as f64 / (count - 1) as f64)
            .collect()
    }

    #[test]
    fn a_plane_has_straight_contours_where_its_equation_says() {
        let (x, y) = (grid(7), grid(5));
        let values: Vec<_> = (y.iter())
            .flat_map(|y| x.iter().map(move |x| Some(2.0 * x + y)))
            .collect();
        let field = Field {
            x: &x,
            y: &y,
            values: &values,
        };
        let lines = field.lines(0.3);
        assert_eq!(lines.len(), 1);
        for [x, y] in &lines[0] {
            assert!((2.0 * x + y - 0.3).abs() < 1e-14, "{x} {y}");
        }
        let ends = [lines[0][0], lines[0][lines[0].len() - 1]];
        assert!(ends.iter().all(|end| end[1].abs() == 1.0), "{ends:?}");
        // Above 2x + y = 0.3 in a square of side 2: half of it, less a strip of 0.15 by 2.
        assert!((area(&field.region(0.3)) - (2.0 - 0.3)).abs() < 1e-14);
        assert!((area(&field.region(-9.0)) - 4.0).abs() < 1e-14);
        assert!(field.region(9.0).is_empty());
    }

    #[test]
    fn the_contours_of_a_cone_close_around_it() {
        let x = grid(81);
        let values: Vec<_> = (x.iter())
            .flat_map(|y| x.iter().map(move |x| Some(1.0 - x.hypot(*y))))
            .collect();
        let field = Field {
            x: &x,
            y: &x,
            values: &values,
        };
        let lines = field.lines(0.4);
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].first(), lines[0].last());
        for [x, y] in &lines[0] {
            // Linear interpolation over a cell of 0.025 at the curvature 1/0.6.
            assert!((x.hypot(*y) - 0.6).abs() < 0.025_f64.powi(2) / 8.0 / 0.6);
        }
        // What is above lies on the left: counterclockwise.
        let exact = std::f64::consts::PI * 0.36;
        assert!((area(&field.region(0.4)) / exact - 1.0).abs() < 1e-3);
    }

    #[test]
    fn a_hole_is_left_out() {
        let x = grid(5);
        let mut values = vec![Some(1.0); 25];
        values[12] = None;
        let field = Field {
            x: &x,
            y: &x,
            values: &values,
        };
        // The four cells around the missing value are gone.
        assert!((area(&field.region(0.0)) - 3.0).abs() < 1e-14);
        assert!(field.lines(0.0).is_empty());
    }

    #[test]
    fn a_saddle_is_joined_where_its_mean_is_above() {
        let x = [0.0, 1.0];
        for (level, lines) in [(0.4, 2), (0.6, 2)] {
            let values = [1.0, 0.0, 1.0, 0.0].map(Some);
            // Corners by rows: (0,0) and (1,1) are high.
            let values = [values[0], values[1], values[3], values[2]];
            let field = Field {
                x: &x,
                y: &x,
                values: &values,
            };
            assert_eq!(field.lines(level).len(), lines);
            // Two triangles of legs 0.4 cut off from the square, or two of legs 0.4 left of it.
            let expected = if level < 0.5 { 1.0 - 0.16 } else { 0.16 };
            assert!((area(&field.region(level)) - expected).abs() < 1e-14);
        }
    }
}
