//! Points in space and on the page, boxes around them, and the view from one to the other.

use crate::viewpoint::Viewpoint;

/// A point or vector in space, global axes \[m\].
pub(crate) type Point = [f64; 3];

/// A point on the page: pixels to the right and down from its upper left corner.
pub(crate) type PagePoint = [f64; 2];

/// Largest coordinate that can be drawn \[m\]: beyond it, lengths would overflow.
pub(crate) const FARTHEST: f64 = 1e100;

/// The smallest side of a [`Bounds::roomy`] box over its largest one.
const SMALLEST_SIDE: f64 = 0.3;

/// Cosine, and length on the page, below which what has an extent in space has none to see.
const EDGE_ON: f64 = 1e-9;
const END_ON: f64 = 0.12;

/// `point + factor · displacement`.
pub(crate) fn moved(point: Point, displacement: Point, factor: f64) -> Point {
    std::array::from_fn(|axis| point[axis] + factor * displacement[axis])
}

/// Length of a vector, without overflow.
pub(crate) fn length(vector: Point) -> f64 {
    vector[0].hypot(vector[1]).hypot(vector[2])
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The mean of points, of which there is at least one.
pub(crate) fn mean(points: &[Point]) -> Point {
    let count = points.len() as f64;
    std::array::from_fn(|axis| points.iter().map(|point| point[axis] / count).sum())
}

/// A box along the global axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bounds {
    /// The corner of the smallest coordinates \[m\].
    pub(crate) min: Point,
    /// The corner of the largest coordinates \[m\].
    pub(crate) max: Point,
}

impl Bounds {
    /// The smallest box around points; of no size at the origin where there are none.
    pub(crate) fn around(points: impl IntoIterator<Item = Point>) -> Self {
        let mut points = points.into_iter();
        let first = points.next().unwrap_or_default();
        points.fold(
            Self {
                min: first,
                max: first,
            },
            |bounds, point| Self {
                min: std::array::from_fn(|axis| bounds.min[axis].min(point[axis])),
                max: std::array::from_fn(|axis| bounds.max[axis].max(point[axis])),
            },
        )
    }

    /// Lengths of the sides \[m\].
    pub(crate) fn sides(&self) -> Point {
        std::array::from_fn(|axis| self.max[axis] - self.min[axis])
    }

    /// Length of the diagonal \[m\].
    pub(crate) fn diagonal(&self) -> f64 {
        length(self.sides())
    }

    pub(crate) fn center(&self) -> Point {
        std::array::from_fn(|axis| 0.5 * (self.min[axis] + self.max[axis]))
    }

    /// A box with air around this one and no side too short to be seen, for points that lie in
    /// a plane, on a line or all in one place too.
    pub(crate) fn roomy(&self) -> Self {
        let [x, y, z] = self.sides();
        let largest = x.max(y).max(z);
        let farthest = self
            .min
            .iter()
            .chain(&self.max)
            .fold(0.0, |far, c| c.abs().max(far));
        // Sides that drown in the rounding of the coordinates are taken as none.
        let largest = match largest.max(1e-9 * farthest) {
            size if size > 1.0 / FARTHEST => size,
            _ => 1.0,
        };
        let center = self.center();
        let half = self
            .sides()
            .map(|side| 0.5 * (1.08 * side).max(SMALLEST_SIDE * largest));
        Self {
            min: std::array::from_fn(|axis| center[axis] - half[axis]),
            max: std::array::from_fn(|axis| center[axis] + half[axis]),
        }
    }

    /// Corner with the largest coordinate along the axes that say so.
    pub(crate) fn corner(&self, largest: [bool; 3]) -> Point {
        std::array::from_fn(|axis| {
            if largest[axis] {
                self.max[axis]
            } else {
                self.min[axis]
            }
        })
    }

    fn corners(&self) -> impl Iterator<Item = Point> {
        (0..8).map(|k| self.corner([k & 1 != 0, k & 2 != 0, k & 4 != 0]))
    }
}

/// A rectangle on the page.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Area {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) right: f64,
    pub(crate) bottom: f64,
}

/// An orthographic view with the same scale on all three axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct View {
    /// Directions in space, of unit length: to the right and up on the page, and towards the eye.
    right: Point,
    up: Point,
    towards: Point,
    /// The point in space that is drawn at `center`.
    target: Point,
    center: PagePoint,
    /// Pixels per metre.
    scale: f64,
}

impl View {
    /// The view that fills `area` with `bounds`, which has three sides above zero.
    pub(crate) fn fit(bounds: &Bounds, area: Area, eye: Viewpoint) -> Self {
        let (sin_a, cos_a) = eye.azimuth.to_radians().sin_cos();
        let (sin_e, cos_e) = eye.elevation.to_radians().sin_cos();
        let unit = Self {
            right: [-sin_a, cos_a, 0.0],
            up: [-sin_e * cos_a, -sin_e * sin_a, cos_e],
            towards: [cos_e * cos_a, cos_e * sin_a, sin_e],
            target: bounds.center(),
            center: [
                0.5 * (area.left + area.right),
                0.5 * (area.top + area.bottom),
            ],
            scale: 1.0,
        };
        // A box is drawn symmetric about its centre: half of its extents is enough.
        let half = bounds.corners().fold([0.0_f64; 2], |half, corner| {
            let [x, y] = unit.across(corner);
            [half[0].max(x.abs()), half[1].max(y.abs())]
        });
        let (width, height) = (area.right - area.left, area.bottom - area.top);
        Self {
            scale: (0.5 * width / half[0]).min(0.5 * height / half[1]),
            ..unit
        }
    }

    /// Whether the eye is on the side of an axis's largest coordinates.
    pub(crate) fn is_from_max(&self, axis: usize) -> bool {
        self.towards[axis] > EDGE_ON
    }

    /// Whether a plane normal to this axis is seen as a line.
    pub(crate) fn is_edge_on(&self, normal: usize) -> bool {
        self.towards[normal].abs() <= EDGE_ON
    }

    /// Whether this axis points so nearly to the eye that it is seen as a point.
    pub(crate) fn is_end_on(&self, axis: usize) -> bool {
        self.right[axis].hypot(self.up[axis]) < END_ON
    }

    /// Where a point in space is on the page.
    pub(crate) fn project(&self, point: Point) -> PagePoint {
        let [right, up] = self.across(point);
        [
            self.center[0] + self.scale * right,
            self.center[1] - self.scale * up,
        ]
    }

    /// Distances to the right and up from the target \[m\].
    fn across(&self, point: Point) -> [f64; 2] {
        let offset = self.offset(point);
        [dot(offset, self.right), dot(offset, self.up)]
    }

    fn offset(&self, point: Point) -> Point {
        std::array::from_fn(|axis| point[axis] - self.target[axis])
    }
}

/// The convex polygon around points on the page, from the leftmost on; fewer than three corners
/// where they lie on a line.
pub(crate) fn hull(points: &[PagePoint]) -> Vec<PagePoint> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.dedup();
    let reversed = sorted.iter().rev().copied().collect();
    let mut corners: Vec<PagePoint> = Vec::new();
    // One chain from left to right, then the other one back (Andrew's monotone chain).
    for chain in [&sorted, &reversed] {
        let start = corners.len();
        for &point in chain {
            while corners.len() >= start + 2 && !turns_left(&corners, point) {
                corners.pop();
            }
            corners.push(point);
        }
        corners.pop();
    }
    corners
}

/// Whether the way along the last two corners turns to one side at the last, on to `next`.
fn turns_left(corners: &[PagePoint], next: PagePoint) -> bool {
    let [.., a, b] = corners else {
        return true;
    };
    (b[0] - a[0]) * (next[1] - a[1]) > (b[1] - a[1]) * (next[0] - a[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    const AREA: Area = Area {
        left: 10.0,
        top: 20.0,
        right: 410.0,
        bottom: 320.0,
    };

    #[test]
    fn a_view_has_equal_scales_and_stays_in_its_area() {
        let bounds = Bounds {
            min: [-1.0, 2.0, 0.0],
            max: [3.0, 4.0, 0.5],
        };
        let view = View::fit(&bounds, AREA, Viewpoint::default());
        let [left, top] = [0, 1].map(|k| {
            let along = bounds.corners().map(|corner| view.project(corner)[k]);
            along.fold(f64::INFINITY, f64::min)
        });
        assert!(
            left >= AREA.left - 1e-9 && top >= AREA.top - 1e-9,
            "{left} {top}"
        );
        // The images of the three unit vectors have squared lengths that sum to twice the
        // squared scale in an orthographic view with equal scales.
        let origin = view.project([0.0; 3]);
        let images = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|unit| {
            let [x, y] = view.project(unit);
            [x - origin[0], y - origin[1]]
        });
        let sum: f64 = images.iter().flatten().map(|c| c * c).sum();
        assert!((sum - 2.0 * view.scale.powi(2)).abs() < 1e-9 * sum);
        assert!(images[0][0] > 0.0 && images[1][0] > 0.0 && images[2][1] < 0.0);
    }

    #[test]
    fn roomy_boxes_have_sides_to_see() {
        for points in [
            vec![[0.0; 3]],
            vec![[1e6, -2.0, 3.0]],
            vec![[0.0; 3], [1e-300, 0.0, 0.0]],
            vec![[0.0; 3], [5.0, 0.0, 0.0]],
            vec![[FARTHEST, 0.0, 0.0], [-FARTHEST, 0.0, 0.0]],
        ] {
            let sides = Bounds::around(points.clone()).roomy().sides();
            let largest = sides.into_iter().fold(0.0, f64::max);
            assert!(
                sides.iter().all(|side| *side > 0.25 * largest),
                "{points:?}: {sides:?}"
            );
        }
    }

    #[test]
    fn the_hull_leaves_out_inner_points() {
        let square = [
            [0.0, 0.0],
            [2.0, 0.0],
            [1.0, 1.0],
            [2.0, 2.0],
            [0.0, 2.0],
            [1.0, 0.0],
        ];
        assert_eq!(
            hull(&square),
            [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]
        );
        assert!(hull(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]).len() < 3);
        assert!(hull(&[[1.0, 1.0]; 3]).len() < 3);
        assert!(hull(&[]).is_empty());
    }
}
