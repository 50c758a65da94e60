//! The conditions of a configuration: closed loops, and what is asked of the output or the
//! drives. Lengths are over the mechanism's size, so that all rows are of one kind.

use nalgebra::{DMatrix, DVector, Isometry3, Matrix3, Point3, UnitQuaternion, Vector3};

use crate::linkage::{Configuration, Linkage, Posture};
use crate::twist::{rotation_vector, rotation_vector_rate};

/// What is asked of a configuration.
#[derive(Debug, Clone, Default)]
pub(crate) struct Goal {
    /// Coordinates of the output: position (m) from the centre, rotation vector (rad) from home.
    pub output: [Option<f64>; 6],
    /// Columns and their values (m or rad).
    pub drives: Vec<(usize, f64)>,
}

impl Goal {
    fn rows(&self) -> usize {
        self.output.iter().flatten().count() + self.drives.len()
    }
}

/// The mechanism with its output and scale.
#[derive(Debug, Clone)]
pub(crate) struct System {
    pub linkage: Linkage,
    /// Length (m) that others are divided by.
    pub size: f64,
    /// Middle of the mechanism at home: positions are taken from it.
    pub centre: Vector3<f64>,
    /// The output's body, and its node at home from the centre.
    pub output: (usize, Point3<f64>),
}

/// Misfits of the conditions at a configuration, and their derivatives.
#[derive(Debug, Clone)]
pub(crate) struct Equations {
    pub misfit: DVector<f64>,
    pub jacobian: DMatrix<f64>,
}

impl System {
    /// Position of the output from the centre (m), and its rotation from home.
    pub fn output(&self, posture: &Posture) -> (Vector3<f64>, UnitQuaternion<f64>) {
        let (body, place) = self.output;
        let moved = posture.bodies[body];
        ((moved * place).coords, moved.rotation)
    }

    /// The output's six coordinates, in the branch of the rotation vector nearest to the last.
    pub fn coordinates(&self, configuration: &Configuration) -> [f64; 6] {
        let posture = self.linkage.posture(configuration);
        let (place, rotation) = self.output(&posture);
        let r = rotation_vector(&rotation, &configuration.rotation);
        [place.x, place.y, place.z, r.x, r.y, r.z]
    }

    /// What is added to a coordinate of the output to make it global.
    pub fn shift(&self, coordinate: usize) -> f64 {
        self.centre.get(coordinate).copied().unwrap_or(0.0)
    }

    /// Misfits alone.
    pub fn misfit(&self, configuration: &Configuration, goal: &Goal) -> DVector<f64> {
        let posture = self.linkage.posture(configuration);
        let mut misfit = DVector::zeros(self.closing_rows() + goal.rows());
        let mut row = 0;
        for &closing in &self.linkage.closings {
            let (place, turn, axes) = self.gap(closing, &posture);
            let place = axes.tr_mul(&place) / self.size;
            misfit.fixed_rows_mut::<3>(row).copy_from(&place);
            row += 3;
            if let Some(turn) = turn {
                misfit
                    .fixed_rows_mut::<3>(row)
                    .copy_from(&axes.tr_mul(&turn));
                row += 3;
            }
        }
        let (place, rotation) = self.output(&posture);
        let turned = self.turned(configuration, goal, &rotation);
        for (k, wanted) in goal.output.iter().enumerate() {
            let Some(wanted) = wanted else { continue };
            misfit[row] = match k {
                0..3 => (place[k] - wanted) / self.size,
                _ => turned[k - 3],
            };
            row += 1;
        }
        for (column, wanted) in &goal.drives {
            let unit = self.linkage.columns[*column].unit;
            misfit[row] = (configuration.values[*column] - wanted) / unit;
            row += 1;
        }
        misfit
    }

    /// Misfits and derivatives by the columns.
    pub fn equations(&self, configuration: &Configuration, goal: &Goal) -> Equations {
        let linkage = &self.linkage;
        let posture = linkage.posture(configuration);
        let misfit = self.misfit(configuration, goal);
        let mut jacobian = DMatrix::zeros(misfit.len(), linkage.columns.len());
        let mut row = 0;
        for &closing in &linkage.closings {
            row += self.closing_jacobian(closing, &posture, row, &mut jacobian);
        }
        let (place, _) = self.output(&posture);
        let whole = is_whole(goal);
        let r = Vector3::from(
            self.coordinates(configuration)
                .last_chunk::<3>()
                .copied()
                .unwrap_or_default(),
        );
        let first = row;
        for &(column, sign) in &linkage.chains[self.output.0] {
            let twist = &posture.twists[column];
            let unit = linkage.columns[column].unit * sign;
            let linear = twist.velocity(&place) * (unit / self.size);
            let angular = twist.angular * unit;
            let turned = if whole {
                angular
            } else {
                rotation_vector_rate(&r, &angular)
            };
            row = first;
            for (k, _) in goal.output.iter().enumerate().filter(|(_, w)| w.is_some()) {
                jacobian[(row, column)] = if k < 3 { linear[k] } else { turned[k - 3] };
                row += 1;
            }
        }
        row = first + goal.output.iter().flatten().count();
        for (column, _) in &goal.drives {
            jacobian[(row, *column)] = 1.0;
            row += 1;
        }
        Equations { misfit, jacobian }
    }

    /// What all columns do to the output: 6 rows, translations over the size.
    pub fn output_rates(&self, configuration: &Configuration) -> DMatrix<f64> {
        let goal = Goal {
            output: [Some(0.0); 6],
            drives: Vec::new(),
        };
        let jacobian = self.equations(configuration, &goal).jacobian;
        jacobian.rows(self.closing_rows(), 6).into_owned()
    }

    /// Number of rows of the closed loops.
    pub fn closing_rows(&self) -> usize {
        let rows = |k: &usize| if self.linkage.joints[*k].ball { 3 } else { 6 };
        self.linkage.closings.iter().map(rows).sum()
    }

    /// By how much the second body's frame of a closing joint is off where the joint's
    /// coordinates put it: in place (m) and, unless the joint turns freely, rotation vector; with
    /// the axes of the first body's frame.
    fn gap(
        &self,
        closing: usize,
        posture: &Posture,
    ) -> (Vector3<f64>, Option<Vector3<f64>>, Matrix3<f64>) {
        let joint = &self.linkage.joints[closing];
        let frame = |body: Option<usize>| -> Isometry3<f64> {
            body.map_or(joint.home, |b| posture.bodies[b] * joint.home)
        };
        let [first, second] = joint.bodies.map(frame);
        let end = &posture.ends[closing];
        let place = second.translation.vector - end.translation.vector;
        let turn = (!joint.ball).then(|| (second.rotation / end.rotation).scaled_axis());
        (place, turn, *first.rotation.to_rotation_matrix().matrix())
    }

    fn closing_jacobian(
        &self,
        closing: usize,
        posture: &Posture,
        row: usize,
        jacobian: &mut DMatrix<f64>,
    ) -> usize {
        let linkage = &self.linkage;
        let joint = &linkage.joints[closing];
        let rows = if joint.ball { 3 } else { 6 };
        let second = joint.bodies[1].map_or(joint.home, |b| posture.bodies[b] * joint.home);
        let place = second.translation.vector;
        let (_, _, axes) = self.gap(closing, posture);
        let chain = |body: Option<usize>| body.map_or(&[][..], |b| &linkage.chains[b][..]);
        let [to_first, to_second] = joint.bodies.map(chain);
        let own = linkage.starts[closing]..linkage.starts[closing + 1];
        let moved = (to_second.iter().copied())
            .chain(to_first.iter().map(|(c, sign)| (*c, -sign)))
            .chain(own.map(|c| (c, -1.0)));
        for (column, sign) in moved {
            let twist = &posture.twists[column];
            let unit = linkage.columns[column].unit * sign;
            let linear = axes.tr_mul(&twist.velocity(&place)) * (unit / self.size);
            let angular = axes.tr_mul(&twist.angular) * unit;
            for k in 0..3 {
                jacobian[(row + k, column)] += linear[k];
                if rows == 6 {
                    jacobian[(row + 3 + k, column)] += angular[k];
                }
            }
        }
        rows
    }

    /// Misfit of the output's rotation: of a whole rotation that of the rotations themselves, of
    /// single coordinates that of the rotation vector.
    fn turned(
        &self,
        configuration: &Configuration,
        goal: &Goal,
        rotation: &UnitQuaternion<f64>,
    ) -> Vector3<f64> {
        let wanted = Vector3::from_fn(|k, _| goal.output[k + 3].unwrap_or(0.0));
        if is_whole(goal) {
            (rotation / UnitQuaternion::from_scaled_axis(wanted)).scaled_axis()
        } else {
            rotation_vector(rotation, &configuration.rotation) - wanted
        }
    }
}

/// Whether all three coordinates of the rotation are asked.
fn is_whole(goal: &Goal) -> bool {
    goal.output[3..].iter().all(Option::is_some)
}
