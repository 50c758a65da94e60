//! Subspaces of three-dimensional space, and the axes that are independent in them.

use nalgebra::{Matrix3, Rotation3, Vector3};

/// Minors that differ by less tie; the first of them in order is taken.
const TIE: f64 = 1e-9;

/// A subspace of three-dimensional space.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Subspace {
    /// The zero vector alone.
    Point,
    /// The multiples of a unit vector.
    Line(Vector3<f64>),
    /// The vectors normal to a unit vector.
    Plane(Vector3<f64>),
    /// All vectors.
    Space,
}

/// The global axes along which the components of a vector of a subspace are independent.
#[derive(Debug)]
pub(crate) struct AxisChoice {
    /// Whether x, y, z are independent.
    pub independent: [bool; 3],
    /// `v = projection · v` for every vector `v` of the subspace; only the columns of the
    /// independent axes are not zero, and no entry is larger than 1 (by more than the tie).
    pub projection: Matrix3<f64>,
}

impl Subspace {
    /// The subspace spanned by orthonormal vectors.
    pub fn spanned_by(orthonormal: &[Vector3<f64>]) -> Self {
        match orthonormal {
            [] => Self::Point,
            [a] => Self::Line(*a),
            [a, b] => Self::Plane(a.cross(b)),
            _ => Self::Space,
        }
    }

    /// The same subspace in the axes that `frame` turns into.
    pub fn turned(&self, frame: &Rotation3<f64>) -> Self {
        match self {
            Self::Point => Self::Point,
            Self::Line(along) => Self::Line(frame * along),
            Self::Plane(normal) => Self::Plane(frame * normal),
            Self::Space => Self::Space,
        }
    }

    /// The axes with the largest minor of any basis of the subspace.
    ///
    /// With an orthonormal basis the minors of a line are its components, those of a plane are
    /// its normal's: the one of two axes is the normal's component along the third. The order
    /// of the pairs is x y, x z, y z.
    pub fn axis_choice(&self) -> AxisChoice {
        match self {
            Self::Point => AxisChoice {
                independent: [false; 3],
                projection: Matrix3::zeros(),
            },
            Self::Line(along) => {
                let k = first_largest(along, [0, 1, 2]);
                let mut choice = Self::Point.axis_choice();
                choice.independent[k] = true;
                choice.projection.set_column(k, &(along / along[k]));
                choice
            }
            Self::Plane(normal) => {
                let k = first_largest(normal, [2, 1, 0]);
                let mut choice = Self::Space.axis_choice();
                choice.independent[k] = false;
                choice
                    .projection
                    .set_row(k, &(-normal.transpose() / normal[k]));
                choice.projection[(k, k)] = 0.0;
                choice
            }
            Self::Space => AxisChoice {
                independent: [true; 3],
                projection: Matrix3::identity(),
            },
        }
    }
}

/// The place of the largest component, the first in `order` where they tie.
fn first_largest(v: &Vector3<f64>, order: [usize; 3]) -> usize {
    let least = v.amax() - TIE;
    let [first, second, third] = order;
    if v[first].abs() >= least {
        first
    } else if v[second].abs() >= least {
        second
    } else {
        third
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ties_take_the_first_axes_in_order() {
        let diagonal = Vector3::new(1.0, -1.0, 1.0).normalize();
        for off in [0.0, 1e-16, -1e-12, 4e-10, -4e-10] {
            let v = diagonal + Vector3::new(0.0, off, 0.0);
            let line = Subspace::Line(v).axis_choice();
            assert_eq!(line.independent, [true, false, false], "{off}");
            let plane = Subspace::Plane(v).axis_choice();
            assert_eq!(plane.independent, [true, true, false], "{off}");
        }
        let v = diagonal - Vector3::new(0.0, 1e-6, 0.0);
        assert_eq!(
            Subspace::Line(v).axis_choice().independent,
            [false, true, false]
        );
        assert_eq!(
            Subspace::Plane(v).axis_choice().independent,
            [true, false, true]
        );
    }

    #[test]
    fn projection_gives_back_the_vectors_of_the_subspace() {
        let n = Vector3::new(-0.2, 0.9, 0.3).normalize();
        let line = Subspace::Line(n).axis_choice().projection;
        assert!((line * n - n).amax() < 1e-15);
        let plane = Subspace::Plane(n).axis_choice().projection;
        for v in [n.cross(&Vector3::x()), n.cross(&Vector3::z())] {
            assert!((plane * v - v).amax() < 1e-15);
        }
    }
}
