//! A solver in about 32 digits, to measure what conditioning costs in doubles.
//!
//! Every node has six displacements, every rigid direction of a joint and every rigid body its
//! conditions with Lagrange multipliers; beams by their closed form along the members. No
//! independent coordinates, no absorbed joints, no trees. The model's numbers (positions, frames,
//! stiffnesses) are taken as the exact ones. It knows straight beams of round sections, rigid bodies
//! and joints with plain stiffnesses and misfits, none of whose rigid conditions is redundant.

#[path = "../../crates/elements/tests/all/support/double_double.rs"]
mod double_double;

use std::ops::Range;

use double_double::DoubleDouble;
use hyperstat_assembly::{BodyKind, Connection, JointStiffness, Model, NodeId, Segment};
use hyperstat_joints::Dof;
use nalgebra::{Matrix6, Point3, Rotation3, Vector6};

/// What is found, rounded to doubles.
#[derive(Debug, Clone)]
pub struct Extended {
    /// The output's stiffness.
    pub stiffness: Matrix6<f64>,
    /// The output's compliance.
    pub compliance: Matrix6<f64>,
    /// Displacement of every node under the model's own loads on nodes and misfits, global axes.
    pub displacements: Vec<Vector6<f64>>,
    /// Wrench on the second body of every joint in that state, at the joint, in its frame.
    pub joint_wrenches: Vec<Vector6<f64>>,
}

type Number = DoubleDouble;
type Six = [Number; 6];
type Block = [Six; 6];

const ZERO: Number = Number::ZERO;
/// Pivots of the scaled system below this leave fewer than 14 digits of the 32.
const ROUNDING: f64 = 1e-18;

fn number(value: f64) -> Number {
    value.into()
}

fn cross(a: [Number; 3], b: [Number; 3]) -> [Number; 3] {
    let part = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [part(1, 2), part(2, 0), part(0, 1)]
}

fn norm(v: [Number; 3]) -> Number {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

fn span(from: &Point3<f64>, to: &Point3<f64>) -> [Number; 3] {
    [0, 1, 2].map(|k| number(to[k]) - number(from[k]))
}

fn identity() -> Block {
    let mut block = [[ZERO; 6]; 6];
    for (k, row) in block.iter_mut().enumerate() {
        row[k] = number(1.0);
    }
    block
}

/// u(p + r) = M u(p).
fn transport(r: [Number; 3]) -> Block {
    let mut out = identity();
    for (row, column, value) in [
        (0, 4, r[2]),
        (0, 5, -r[1]),
        (1, 3, -r[2]),
        (1, 5, r[0]),
        (2, 3, r[1]),
        (2, 4, -r[0]),
    ] {
        out[row][column] = value;
    }
    out
}

fn product(a: &Block, b: &Block) -> Block {
    let mut out = [[ZERO; 6]; 6];
    for (out_row, row) in out.iter_mut().zip(a) {
        for (factor, b_row) in row.iter().zip(b) {
            for (entry, value) in out_row.iter_mut().zip(b_row) {
                *entry = *entry + *factor * *value;
            }
        }
    }
    out
}

/// A dense square system with columns of right sides.
struct System {
    matrix: Vec<Vec<Number>>,
    right: Vec<Vec<Number>>,
}

impl System {
    fn new(size: usize, columns: usize) -> Self {
        Self {
            matrix: vec![vec![ZERO; size]; size],
            right: vec![vec![ZERO; columns]; size],
        }
    }

    fn add(&mut self, row: usize, column: usize, value: Number) {
        self.matrix[row][column] = self.matrix[row][column] + value;
    }

    /// Puts `a · u = c λ + apart`, λ being the force along a, in the row and column `place`; what is
    /// apart in the column `state`.
    fn add_row(&mut self, place: usize, row: &Row, state: usize) {
        for (k, value) in &row.terms {
            self.add(place, *k, *value);
            self.add(*k, place, *value);
        }
        self.add(place, place, -row.flexibility);
        self.right[place][state] = row.apart;
    }

    /// Scales rows and columns to largest entries near one, by powers of two; `None` where a row is
    /// empty.
    fn equilibrate(&mut self) -> Option<Vec<f64>> {
        let size = self.matrix.len();
        let mut scale = vec![1.0; size];
        for _ in 0..8 {
            let factor = (0..size).map(|row| {
                let own = self.matrix[row].iter();
                let most = own.map(|v| v.to_f64().abs()).fold(0.0, f64::max);
                (most > 0.0).then(|| (-0.5 * most.log2()).round().exp2())
            });
            let factor = factor.collect::<Option<Vec<f64>>>()?;
            for row in 0..size {
                for column in 0..size {
                    let entry = &mut self.matrix[row][column];
                    *entry = *entry * number(factor[row] * factor[column]);
                }
                scale[row] *= factor[row];
            }
        }
        Some(scale)
    }

    /// Solves by elimination with partial pivoting; `None` where a pivot is rounding.
    fn solve(mut self) -> Option<Vec<Vec<Number>>> {
        let scale = self.equilibrate()?;
        for (row, factor) in self.right.iter_mut().zip(&scale) {
            for entry in row {
                *entry = *entry * number(*factor);
            }
        }
        let size = self.matrix.len();
        for column in 0..size {
            let at = |row: &usize| self.matrix[*row][column].to_f64().abs();
            let pivot = (column..size)
                .max_by(|a, b| at(a).total_cmp(&at(b)))
                .unwrap_or(column);
            if at(&pivot) < ROUNDING {
                return None;
            }
            self.matrix.swap(column, pivot);
            self.right.swap(column, pivot);
            let (above, below) = self.matrix.split_at_mut(column + 1);
            let (right_above, right_below) = self.right.split_at_mut(column + 1);
            for (row, right) in below.iter_mut().zip(right_below) {
                if row[column] == ZERO {
                    continue;
                }
                let factor = row[column] / above[column][column];
                for k in column + 1..size {
                    row[k] = row[k] - factor * above[column][k];
                }
                for (entry, value) in right.iter_mut().zip(&right_above[column]) {
                    *entry = *entry - factor * *value;
                }
            }
        }
        for row in (0..size).rev() {
            for k in 0..self.right[row].len() {
                let known = (row + 1..size).fold(ZERO, |sum, column| {
                    sum + self.matrix[row][column] * self.right[column][k]
                });
                self.right[row][k] = (self.right[row][k] - known) / self.matrix[row][row];
            }
        }
        for (row, factor) in self.right.iter_mut().zip(&scale) {
            for entry in row {
                *entry = *entry * number(*factor);
            }
        }
        Some(self.right)
    }
}

/// Solves a model of the kinds named above; `None` where it moves freely, rigid conditions are
/// redundant, or it is so near to either that 32 digits are not enough.
///
/// # Panics
/// With a model of another kind.
pub fn solve(model: &Model) -> Option<Extended> {
    let NodeId(output) = model.output().expect("an output");
    let mut rows = rigid_bodies(model);
    let mut joint_places = Vec::with_capacity(model.joints().len());
    for (k, (joint, frame)) in (model.joints().iter().zip(&model.geometry().frames)).enumerate() {
        let start = rows.len();
        let misfit = model.misfits().iter().find(|entry| entry.joint.0 == k);
        rows.extend(joint_rows(joint, frame, misfit.map(|entry| entry.misfit)));
        joint_places.push(start..rows.len());
    }
    let coordinates = 6 * model.nodes().len();
    let mut system = System::new(coordinates + rows.len(), 7);
    for segment in model.segments() {
        add_beam(model, segment, &mut system);
    }
    for (k, row) in rows.iter().enumerate() {
        system.add_row(coordinates + k, row, 6);
    }
    for k in 0..6 {
        system.right[6 * output + k][k] = number(1.0);
    }
    for load in model.loads() {
        for k in 0..6 {
            let entry = &mut system.right[6 * load.node.0 + k][6];
            *entry = *entry + number(load.wrench[k]);
        }
    }
    let found = system.solve()?;
    let wrench = |(joint, places): (usize, &Range<usize>)| {
        let forces = places.clone().map(|k| found[coordinates + k][6]);
        let frame = &model.geometry().frames[joint];
        wrench_on_second(&model.joints()[joint], frame, &rows[places.clone()], forces)
    };
    let joint_wrenches = joint_places.iter().enumerate().map(wrench).collect();
    let mut compliance = System::new(6, 6);
    for row in 0..6 {
        compliance.matrix[row].copy_from_slice(&found[6 * output + row][..6]);
        compliance.right[row][row] = number(1.0);
    }
    let rounded = |m: &[Vec<Number>]| Matrix6::from_fn(|r, c| m[r][c].to_f64());
    let node = |n: usize| Vector6::from_fn(|k, _| found[6 * n + k][6].to_f64());
    Some(Extended {
        compliance: rounded(&compliance.matrix),
        stiffness: rounded(&compliance.solve()?),
        displacements: (0..model.nodes().len()).map(node).collect(),
        joint_wrenches,
    })
}

/// The wrench on a joint's second body that the forces along its rows make, in its frame.
fn wrench_on_second(
    joint: &Connection,
    frame: &Rotation3<f64>,
    rows: &[Row],
    forces: impl Iterator<Item = Number>,
) -> Vector6<f64> {
    let (node, sign) = match joint.between {
        [_, Some(NodeId(second))] => (second, number(-1.0)),
        [Some(NodeId(first)), None] => (first, number(1.0)),
        [None, None] => panic!("a joint between nothing"),
    };
    let mut wrench = [ZERO; 6];
    for (row, force) in rows.iter().zip(forces) {
        for (place, value) in &row.terms {
            if place / 6 == node {
                wrench[place % 6] = wrench[place % 6] + sign * *value * force;
            }
        }
    }
    Vector6::from_fn(|k, _| {
        let turned = (0..3).fold(ZERO, |sum, axis| {
            sum + number(frame.matrix()[(axis, k % 3)]) * wrench[3 * (k / 3) + axis]
        });
        turned.to_f64()
    })
}

/// Coefficients on displacement coordinates.
type Terms = Vec<(usize, Number)>;

/// A combination of displacements that is held.
struct Row {
    terms: Terms,
    /// Zero where it is rigid.
    flexibility: Number,
    /// What it is without force: a misfit.
    apart: Number,
}

/// Rows of the joint's coordinates `basis⁻¹ Tᵀ (u_i − u_j)` that are rigid or elastic.
fn joint_rows(
    joint: &Connection,
    frame: &Rotation3<f64>,
    misfit: Option<Vector6<f64>>,
) -> Vec<Row> {
    let mut rows = Vec::new();
    let JointStiffness::Directions(given) = &joint.stiffness else {
        panic!("a full stiffness");
    };
    assert!(joint.joint.compliance().is_none(), "an own compliance");
    let basis = joint.joint.basis();
    let mut inverse = System::new(6, 6);
    for row in 0..6 {
        for column in 0..6 {
            inverse.matrix[row][column] = number(basis[(row, column)]);
        }
        inverse.right[row][row] = number(1.0);
    }
    let inverse = inverse.solve().expect("a basis");
    for dof in Dof::ALL {
        let open = joint.joint.free().contains(dof) && !joint.locked.contains(dof);
        let flexibility = match given[dof.index()] {
            Some(k) if k > 0.0 => number(1.0) / number(k),
            Some(_) => panic!("a stiffness of zero"),
            None if open => continue,
            None => ZERO,
        };
        let mut terms = Terms::new();
        for (node, sign) in joint.between.iter().zip([1.0, -1.0]) {
            let Some(NodeId(node)) = node else { continue };
            for k in 0..6 {
                let block = 3 * (k / 3);
                let own = (0..3).fold(ZERO, |sum, local| {
                    let turned = number(sign * frame.matrix()[(k % 3, local)]);
                    sum + inverse[dof.index()][block + local] * turned
                });
                if own != ZERO {
                    terms.push((6 * node + k, own));
                }
            }
        }
        // The second body stands off from the first.
        let apart = number(-misfit.map_or(0.0, |misfit| misfit[dof.index()]));
        rows.push(Row {
            terms,
            flexibility,
            apart,
        });
    }
    rows
}

/// Conditions that make each rigid body move as one.
fn rigid_bodies(model: &Model) -> Vec<Row> {
    let positions = &model.geometry().positions;
    let mut rows = Vec::new();
    for body in model.bodies() {
        assert!(body.kind != BodyKind::Flexible, "a flexible body");
        if body.kind != BodyKind::Rigid {
            continue;
        }
        let NodeId(first) = body.nodes[0];
        for NodeId(other) in &body.nodes[1..] {
            let carried = transport(span(&positions[first], &positions[*other]));
            for (k, carried) in carried.iter().enumerate() {
                let mut terms = vec![(6 * other + k, number(1.0))];
                for (c, value) in carried.iter().enumerate() {
                    if *value != ZERO {
                        terms.push((6 * first + c, -*value));
                    }
                }
                rows.push(Row {
                    terms,
                    flexibility: ZERO,
                    apart: ZERO,
                });
            }
        }
    }
    rows
}

/// Adds the stiffness `Bᵀ k B` of a beam, B taking the rigid motion of its first node off.
fn add_beam(model: &Model, segment: &Segment, system: &mut System) {
    let [NodeId(first), NodeId(second)] = segment.ends;
    let positions = &model.geometry().positions;
    let arm = span(&positions[first], &positions[second]);
    let length = norm(arm);
    let (material, section) = (&segment.material, &segment.section);
    assert!(
        segment.taper.is_none() && section.iy() == section.iz(),
        "a round beam"
    );
    assert!(
        section.shear_y().is_none() && section.shear_z().is_none(),
        "no shear"
    );
    // The section is round: any axes across it will do.
    let x = arm.map(|c| c / length);
    let mut helper = [ZERO; 3];
    let least = (0..3).min_by(|a, b| x[*a].to_f64().abs().total_cmp(&x[*b].to_f64().abs()));
    helper[least.unwrap_or(0)] = number(1.0);
    let across = cross(x, helper);
    let y = across.map(|c| c / norm(across));
    let axes = [x, y, cross(x, y)];
    let bending = number(material.young()) * number(section.iz());
    let over = |times: f64, power: usize| {
        let divided = (0..power).fold(bending, |sum, _| sum / length);
        number(times) * divided
    };
    let mut local = [[ZERO; 6]; 6];
    local[0][0] = number(material.young()) * number(section.area()) / length;
    local[3][3] = number(material.shear()) * number(section.torsion()) / length;
    for (deflection, turn, sign) in [(1, 5, -1.0), (2, 4, 1.0)] {
        local[deflection][deflection] = over(12.0, 3);
        local[turn][turn] = over(4.0, 1);
        local[deflection][turn] = over(sign * 6.0, 2);
        local[turn][deflection] = over(sign * 6.0, 2);
    }
    // Rows: local components of u₂ − M u₁.
    let mut turn = [[ZERO; 6]; 6];
    for (row, axis) in axes.iter().enumerate() {
        for (column, value) in axis.iter().enumerate() {
            turn[row][column] = *value;
            turn[3 + row][3 + column] = *value;
        }
    }
    let near = product(&turn, &transport(arm));
    let rows: Vec<Terms> = (0..6)
        .map(|k| {
            let far = turn[k]
                .iter()
                .enumerate()
                .map(|(c, v)| (6 * second + c, *v));
            let near = near[k]
                .iter()
                .enumerate()
                .map(|(c, v)| (6 * first + c, -*v));
            far.chain(near).collect()
        })
        .collect();
    for (row, left) in rows.iter().enumerate() {
        for (column, right) in rows.iter().enumerate() {
            if local[row][column] == ZERO {
                continue;
            }
            for (i, a) in left {
                for (j, b) in right {
                    system.add(*i, *j, *a * local[row][column] * *b);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::build::{circle, node, steel, weld_to_ground};

    /// A cantilever askew: L³/3EI across, L/EA along.
    #[test]
    fn a_cantilever_is_as_in_the_textbook() {
        let mut model = Model::new("cantilever");
        let along = Vector3::new(2.0, -1.0, 2.0) / 3.0;
        let points = [("A", Point3::origin()), ("B", Point3::from(along * 0.5))];
        model
            .add_beam("beam", &points, &steel(), &circle(0.02), None, 1)
            .expect("a beam");
        weld_to_ground(&mut model, "beam", "A");
        let tip = node(&model, "beam", "B");
        model.set_output(tip);
        let across = Vector3::new(1.0, 2.0, 0.0) / 5.0_f64.sqrt();
        let force = (along + across) * 100.0;
        let wrench = Vector6::new(force.x, force.y, force.z, 0.0, 0.0, 0.0);
        model.add_load(tip, wrench).expect("a load");
        let found = solve(&model).expect("held");
        let moved = found.displacements[tip.0].fixed_rows::<3>(0).into_owned();
        let section = circle(0.02);
        let stretch = 100.0 * 0.5 / (2.1e11 * section.area());
        let deflection = 100.0 * 0.125 / (3.0 * 2.1e11 * section.iz());
        assert!((moved.dot(&along) / stretch - 1.0).abs() < 1e-12);
        assert!((moved.dot(&across) / deflection - 1.0).abs() < 1e-14);
        let unit = found.stiffness * found.compliance;
        assert!((unit - Matrix6::identity()).amax() < 1e-9);
    }
}
