//! A joint as conditions and springs on its relative coordinates `q = basis⁻¹ Tᵀ (u_i − u_j)`, or
//! with a misfit m on `q + m`.
//!
//! A finite-element program states a joint by what its axes keep: of a universal joint `x_i · y_j = 0`
//! (Eq. 67), x fixed in the first body and y in the second. Both turn with their nodes, `x_i = x +
//! φ_i × x` and `y_j = y + φ_j × y`; to first order the condition is
//!
//! ```text
//! (φ_i × x) · y + x · (φ_j × y) = (φ_i − φ_j) · (x × y) = 0
//! ```
//!
//! and with `Δ_i = Δ_j` that is all that a universal joint holds: x, y, z and w of its frame. It is
//! linear in the nodes' rotations, is checked once, at the configuration that is solved, and needs no
//! search for independent rotations.

use hyperstat_joints::Dof;
use hyperstat_model::{Connection, JointStiffness, Misfit};
use nalgebra::{Matrix6, Rotation3, Vector6};

use crate::row::Row;

/// Relative eigenvalue of a full stiffness or compliance, scaled to a unit diagonal, that counts
/// as zero.
const SEMIDEFINITE: f64 = 1e-12;

/// What a joint does along one direction or combination of directions.
#[derive(Debug, Clone)]
pub(crate) struct Hold {
    /// The combination `hᵀ q`.
    pub combination: Vector6<f64>,
    /// Its flexibility; 0 is rigid.
    pub flexibility: f64,
}

impl Hold {
    /// The combination brought to unit length, with its flexibility for that length.
    fn new(combination: Vector6<f64>, flexibility: f64) -> Self {
        let length = combination.norm();
        Self {
            combination: combination / length,
            flexibility: flexibility / (length * length),
        }
    }
}

/// A joint between two nodes of the structure.
#[derive(Debug, Clone)]
pub(crate) struct JointConditions {
    /// First (i) and second (j) node; `None` is the ground.
    between: [Option<usize>; 2],
    /// Takes the relative twist `u_i − u_j` in global axes to q.
    to_coordinates: Matrix6<f64>,
    /// `basis⁻ᵀ`: takes forces on q to a wrench in the joint frame.
    to_wrench: Matrix6<f64>,
    /// All that is rigid or elastic; what is free has no entry.
    pub holds: Vec<Hold>,
    /// What `u_j − u_i` is at rest, along the coordinates.
    misfit: Vector6<f64>,
    /// Forces on the second body along the coordinates, beside those of the holds.
    preload: Vector6<f64>,
}

impl JointConditions {
    /// The conditions of a connection whose joint frame is `frame`, with its misfit and preload;
    /// `None` where the joint's directions are not independent.
    pub fn new(
        connection: &Connection,
        frame: &Rotation3<f64>,
        misfit: Option<&Misfit>,
    ) -> Option<Self> {
        let inverse = connection.joint.basis().try_inverse()?;
        let mut to_frame = Matrix6::zeros();
        for block in [0, 3] {
            to_frame
                .fixed_view_mut::<3, 3>(block, block)
                .copy_from(&frame.matrix().transpose());
        }
        Some(Self {
            between: connection.between.map(|node| node.map(|node| node.0)),
            to_coordinates: inverse * to_frame,
            to_wrench: inverse.transpose(),
            holds: holds(connection),
            misfit: misfit.map_or(Vector6::zeros(), |own| own.misfit),
            preload: misfit.map_or(Vector6::zeros(), |own| own.preload),
        })
    }

    /// The row of `combination · q`; without a node at either side it is empty.
    pub fn row(&self, combination: &Vector6<f64>, flexibility: f64) -> Row {
        let a = self.to_coordinates.tr_mul(combination);
        let signed = self.between.iter().zip([a, -a]);
        let terms = signed.filter_map(|(node, a)| node.map(|node| (node, a)));
        Row {
            terms: terms.collect(),
            flexibility,
        }
    }

    /// What the row of a combination is when its hold bears nothing.
    pub fn at_rest(&self, combination: &Vector6<f64>) -> f64 {
        -combination.dot(&self.misfit)
    }

    /// The wrenches of its preload on its nodes, global axes.
    pub fn preloads(&self) -> impl Iterator<Item = (usize, Vector6<f64>)> {
        let on_second = self.to_coordinates.tr_mul(&self.preload);
        let sides = self.between.into_iter().zip([-on_second, on_second]);
        sides.filter_map(|(node, wrench)| node.map(|node| (node, wrench)))
    }

    /// Wrench on the second body, in the joint frame, from the force along each hold: its springs
    /// and conditions with its preload.
    pub fn wrench(&self, forces: impl IntoIterator<Item = f64>) -> Vector6<f64> {
        let pairs = self.holds.iter().zip(forces);
        let held: Vector6<f64> = pairs.map(|(hold, force)| hold.combination * force).sum();
        self.to_wrench * (held + self.preload)
    }

    /// The stiffness between the two nodes of `stiffness`, given over q, in global axes.
    pub fn global_stiffness(&self, stiffness: &Matrix6<f64>) -> Matrix6<f64> {
        self.to_coordinates.transpose() * stiffness * self.to_coordinates
    }

    /// First and second node.
    pub fn between(&self) -> [Option<usize>; 2] {
        self.between
    }
}

/// Whether a direction is open: free by the joint's kind and not locked.
pub(crate) fn is_open(connection: &Connection, dof: Dof) -> bool {
    connection.joint.free().contains(dof) && !connection.locked.contains(dof)
}

/// Whether a direction counts as free with the drives released: by the joint's kind, or because a
/// stiffness of zero frees it.
pub(crate) fn is_released(connection: &Connection, dof: Dof) -> bool {
    let zero = match &connection.stiffness {
        JointStiffness::Directions(given) => given[dof.index()].is_some_and(is_none),
        JointStiffness::Matrix(stiffness) => stiffness[(dof.index(), dof.index())] == 0.0,
    };
    connection.joint.free().contains(dof) || zero && !connection.locked.contains(dof)
}

/// Whether a stiffness is none: zero, or too small to have a flexibility.
fn is_none(stiffness: f64) -> bool {
    !(1.0 / stiffness).is_finite()
}

/// Rules of the file format: a stiffness that is given makes a direction elastic; zero frees a
/// constrained direction and leaves a locked or free one as it is; one that is not given is rigid
/// unless it is open. The joint's own compliance counts where the file gives nothing.
fn holds(connection: &Connection) -> Vec<Hold> {
    match (&connection.stiffness, connection.joint.compliance()) {
        (JointStiffness::Directions(given), Some(own)) if given.iter().all(Option::is_none) => {
            own_compliance(connection, &own)
        }
        (JointStiffness::Directions(given), _) => Dof::ALL
            .into_iter()
            .filter_map(|dof| direction(connection, dof, given[dof.index()]))
            .collect(),
        (JointStiffness::Matrix(stiffness), _) => full_stiffness(connection, stiffness),
    }
}

fn direction(connection: &Connection, dof: Dof, given: Option<f64>) -> Option<Hold> {
    match given {
        Some(k) if !is_none(k) => Some(unit(dof, 1.0 / k)),
        _ if is_open(connection, dof) => None,
        Some(_) if is_released(connection, dof) && !connection.locked.contains(dof) => None,
        _ => Some(unit(dof, 0.0)),
    }
}

fn unit(dof: Dof, flexibility: f64) -> Hold {
    Hold {
        combination: Vector6::ith(dof.index(), 1.0),
        flexibility,
    }
}

fn full_stiffness(connection: &Connection, stiffness: &Matrix6<f64>) -> Vec<Hold> {
    let mut holds: Vec<Hold> = (modes(stiffness).into_iter())
        .filter(|mode| mode.value > SEMIDEFINITE)
        .map(|mode| Hold::new(mode.vector.component_mul(&mode.scale), 1.0 / mode.value))
        .collect();
    let locked = connection.locked;
    let rigid = |dof: &Dof| stiffness[(dof.index(), dof.index())] == 0.0;
    holds.extend(locked.iter().filter(rigid).map(|dof| unit(dof, 0.0)));
    holds
}

/// A direction with no compliance of its own is held, or free where it is open; a combination
/// without compliance among compliant directions is rigid.
fn own_compliance(connection: &Connection, compliance: &Matrix6<f64>) -> Vec<Hold> {
    let mut holds: Vec<Hold> = (modes(compliance).into_iter())
        .map(|mode| {
            let unscaled = |v: f64, s: f64| if s > 0.0 { v / s } else { 0.0 };
            let flexibility = if mode.value > SEMIDEFINITE {
                mode.value
            } else {
                0.0
            };
            Hold::new(mode.vector.zip_map(&mode.scale, unscaled), flexibility)
        })
        .collect();
    let rigid =
        |dof: &Dof| compliance[(dof.index(), dof.index())] == 0.0 && !is_open(connection, *dof);
    holds.extend(Dof::ALL.into_iter().filter(rigid).map(|dof| unit(dof, 0.0)));
    holds
}

/// An eigenvector of `S M S`, S scaling the diagonal of M to one.
struct Mode {
    value: f64,
    vector: Vector6<f64>,
    /// Square roots of M's diagonal.
    scale: Vector6<f64>,
}

/// The modes over the directions with a diagonal entry.
fn modes(matrix: &Matrix6<f64>) -> Vec<Mode> {
    let scale = matrix.diagonal().map(f64::sqrt);
    let scaled = Matrix6::from_fn(|r, c| {
        let product = scale[r] * scale[c];
        // An isolated −1 keeps directions without an entry apart from all others.
        let absent = if r == c { -1.0 } else { 0.0 };
        if product > 0.0 {
            0.5 * (matrix[(r, c)] + matrix[(c, r)]) / product
        } else {
            absent
        }
    });
    let eigen = scaled.symmetric_eigen();
    (0..6)
        .map(|k| Mode {
            value: eigen.eigenvalues[k],
            vector: eigen.eigenvectors.column(k).into_owned(),
            scale,
        })
        .filter(|mode| mode.value > -0.5)
        .collect()
}

#[cfg(test)]
mod tests {
    use hyperstat_joints::{DofSet, Universal};
    use hyperstat_model::{Model, NodeId};
    use nalgebra::{Point3, Vector3};

    use super::*;

    /// Eq. 67, `x_i · y_j`, differentiated by central differences of finite rotations of both nodes,
    /// is the row of the universal joint's w; the first three rows are `Δ_i − Δ_j`.
    #[test]
    fn the_row_of_a_universal_joint_is_the_linearised_condition() {
        let mut model = Model::new("universal");
        let (a, b) = (Point3::origin(), Point3::new(1.0, 0.0, 0.0));
        model.add_rigid("first", &[("A", a), ("B", b)]).unwrap();
        model.add_rigid("second", &[("B", b)]).unwrap();
        let between = [model.node("first", "B"), model.node("second", "B")];
        let frame = Rotation3::from_euler_angles(0.7, -0.3, 1.2);
        let connection = Connection {
            name: "joint".into(),
            between,
            joint: Box::new(Universal),
            locked: DofSet::EMPTY,
            stiffness: JointStiffness::default(),
        };
        let conditions = JointConditions::new(&connection, &frame, None).unwrap();
        assert_eq!(conditions.holds.len(), 4);
        let rows = conditions.holds.iter();
        let rows: Vec<Row> = rows
            .map(|hold| conditions.row(&hold.combination, hold.flexibility))
            .collect();
        let term = |row: &Row, node: Option<NodeId>| {
            let found = row.terms.iter().find(|(n, _)| Some(NodeId(*n)) == node);
            found.map(|(_, a)| *a).unwrap()
        };
        let (x, y) = (frame * Vector3::x(), frame * Vector3::y());
        let condition = |turns: [Vector3<f64>; 2]| {
            let [i, j] = turns.map(Rotation3::new);
            (i * x).dot(&(j * y))
        };
        let step = 1e-4;
        for (side, node) in between.into_iter().enumerate() {
            for axis in 0..3 {
                let at = |size: f64| {
                    let mut turns = [Vector3::zeros(); 2];
                    turns[side][axis] = size;
                    condition(turns)
                };
                let slope = (at(step) - at(-step)) / (2.0 * step);
                // The difference of cubes: a sixth of the square of the step.
                let found = term(&rows[3], node)[3 + axis];
                assert!((found - slope).abs() < step * step, "{found} {slope}");
            }
        }
        for row in &rows[..3] {
            let [i, j] = between.map(|node| term(row, node));
            assert_eq!(i, -j);
            assert_eq!(i.fixed_rows::<3>(3).amax(), 0.0);
        }
    }
}
