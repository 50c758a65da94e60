//! The loop closure of a model.

use std::sync::OnceLock;

use hyperstat_joints::Dof;
use hyperstat_model::{Geometry, JointId, Model, NodeId};
use nalgebra::{DMatrix, IsometryMatrix3, Point3, Vector3};

use crate::equations::{Goal, System};
use crate::error::ClosureError;
use crate::linkage::{Configuration, Linkage};
use crate::newton::{RANK_TOLERANCE, null_space};
use crate::path::{NAMES, shown};
use crate::place::{Parts, Room};
use crate::span::Span;
use crate::target::{Drive, Target};

/// How much more a position counts than a rotation where more is asked of the output than it can
/// follow, and some of it is only compared.
const POSITION_FIRST: f64 = 10.0;
/// How far a coordinate that is only compared may be off (sizes of the mechanism, or rad).
const SAME: f64 = 1e-6;

/// A rigid mechanism that can be moved: its home is the configuration of the model it is made
/// from.
///
/// Every body is rigid. The directions of a joint that are free by its kind are released, whether
/// locked, elastic or not, and so are those that a stiffness of zero frees; all others are held
/// where they are at home.
#[derive(Debug, Clone)]
pub struct LoopClosure {
    pub(crate) parts: Parts,
    pub(crate) system: System,
    /// What the output can do at home: six rows, translations over the size.
    freedom: DMatrix<f64>,
    /// Which coordinates are followed where those of a number's bits are asked.
    prescribed: Vec<OnceLock<[bool; 6]>>,
    /// The output's coordinates at home.
    at_home: [f64; 6],
    /// What shows at once that a target is out of reach.
    pub(crate) spans: Vec<Span>,
}

impl LoopClosure {
    /// The rigid mechanism of a model, at home in the model's configuration.
    ///
    /// # Errors
    /// No output, a model that is not one whole ([`Model::check`]) or too large, a segment without a
    /// frame, a kind of joint whose basis does not say how it moves.
    pub fn new(model: &Model) -> Result<Self, ClosureError> {
        Self::of_node(model, model.output().ok_or(ClosureError::NoOutput)?)
    }

    /// The same, whose poses are those of a node of the model, be it the output or not.
    ///
    /// # Errors
    /// As [`LoopClosure::new`].
    pub fn of_node(model: &Model, node: NodeId) -> Result<Self, ClosureError> {
        model.check()?;
        let (centre, size) = middle_and_size(model.geometry());
        let place = model.geometry().positions[node.0].coords - centre;
        let system = System {
            linkage: Linkage::new(model, &centre, size)?,
            size,
            centre,
            output: (model.nodes()[node.0].body.0, Point3::from(place)),
        };
        let home = system.linkage.home();
        let loops = system.equations(&home, &Goal::default()).jacobian;
        let freedom = system.output_rates(&home) * null_space(&loops);
        let at_home = system.coordinates(&home);
        let spans = Span::all(&system, model);
        Ok(Self {
            parts: Parts::new(model, node, centre, size)?,
            system,
            freedom,
            prescribed: vec![OnceLock::new(); 64],
            at_home,
            spans,
        })
    }

    /// The configuration of the model it is made from.
    pub fn home(&self) -> Configuration {
        self.system.linkage.home()
    }

    /// Where all parts are at home.
    pub(crate) fn geometry(&self) -> &Geometry {
        self.parts.model.geometry()
    }

    /// Freedoms of the output at home, all bodies rigid and the drives released.
    pub fn output_mobility(&self) -> usize {
        self.prescribed(&[false; 6]).iter().filter(|p| **p).count()
    }

    /// Coordinates of the output (x y z, rx ry rz) that are independent at home: as many as it has freedoms.
    pub fn coordinates(&self) -> [bool; 6] {
        self.prescribed(&[false; 6])
    }

    /// The configuration at `target` that a straight way leads to from the configuration `from`:
    /// Newton's method in steps that are halved where it does not converge, or could change to
    /// another assembly mode.
    ///
    /// More coordinates of the output than it has freedoms may be asked, if they agree to 1e-6 of
    /// the mechanism's size (or rad): as many as there are freedoms are followed, the others
    /// compared.
    ///
    /// # Errors
    /// A configuration of another mechanism; a target that is not finite or is no drive's, that is out of reach, singular, reached only
    /// in another assembly mode, or that the output cannot follow.
    pub fn reach(
        &self,
        from: &Configuration,
        target: &Target<'_>,
    ) -> Result<Configuration, ClosureError> {
        self.check(from)?;
        let reached = self.system.follow(from, &self.goal(target)?)?;
        if let Target::Output(asked) = target {
            self.compare(&self.pose_of(&reached), asked)?;
        }
        Ok(reached)
    }

    /// The conditions that a target makes.
    pub(crate) fn goal(&self, target: &Target<'_>) -> Result<Goal, ClosureError> {
        match target {
            Target::Output(asked) => {
                finite(asked.iter().flatten())?;
                let goal = self.output_goal(asked);
                self.spans.iter().try_for_each(|span| span.check(&goal))?;
                Ok(goal)
            }
            Target::Drives(drives) => {
                finite(drives.iter().map(|drive| &drive.value))?;
                self.drive_goal(drives)
            }
        }
    }

    /// The output's position x y z (m) and rotation vector rx ry rz (rad) from home, in global
    /// axes.
    ///
    /// # Errors
    /// A configuration of another mechanism.
    pub fn pose(&self, configuration: &Configuration) -> Result<[f64; 6], ClosureError> {
        self.check(configuration)?;
        Ok(self.pose_of(configuration))
    }

    /// The pose of a configuration of this mechanism.
    fn pose_of(&self, configuration: &Configuration) -> [f64; 6] {
        let mut pose = self.system.coordinates(configuration);
        for (k, coordinate) in pose.iter_mut().enumerate() {
            *coordinate += self.system.shift(k);
        }
        pose
    }

    /// The value of a joint's free direction relative to home (m or rad, whole turns included):
    /// of the second body relative to the first. `None` where the direction does not move, or
    /// has no value of its own (a ball joint's rotation), and of what is not of this mechanism.
    pub fn value(
        &self,
        configuration: &Configuration,
        joint: JointId,
        direction: Dof,
    ) -> Option<f64> {
        self.check(configuration).ok()?;
        let column = self.system.linkage.column(joint.0, direction)?;
        Some(configuration.values[column])
    }

    /// The drives: directions that are free by their joint's kind, and locked or elastic.
    pub fn drives(&self) -> impl Iterator<Item = (JointId, Dof)> {
        let joints = self.system.linkage.joints.iter().enumerate();
        joints.flat_map(|(k, joint)| joint.drives.iter().map(move |dof| (JointId(k), dof)))
    }

    /// Whether a direction of a joint can be given a value.
    ///
    /// # Errors
    /// Why not.
    pub fn check_drive(&self, joint: JointId, direction: Dof) -> Result<(), ClosureError> {
        let joints = self.parts.model.joints();
        let connection = joints.get(joint.0).ok_or(ClosureError::ForeignJoint {
            joint: joint.0,
            count: joints.len(),
        })?;
        if self.system.linkage.joints[joint.0]
            .drives
            .contains(direction)
        {
            return Ok(());
        }
        Err(ClosureError::NotADrive {
            joint: connection.name.clone(),
            direction,
            why: if connection.released().contains(direction) {
                "it is free; a drive is locked or has a stiffness"
            } else {
                "the joint does not move in it"
            },
        })
    }

    /// By how much the loops of a configuration stay open, over the mechanism's size (and in rad):
    /// rounding, or as much as redundant conditions in the file contradict each other.
    ///
    /// # Errors
    /// A configuration of another mechanism.
    pub fn misfit(&self, configuration: &Configuration) -> Result<f64, ClosureError> {
        self.check(configuration)?;
        let misfit = self.system.misfit(configuration, &Goal::default());
        Ok(if misfit.is_empty() {
            0.0
        } else {
            misfit.amax()
        })
    }

    /// Refuses a configuration of another mechanism.
    fn check(&self, configuration: &Configuration) -> Result<(), ClosureError> {
        if configuration.linkage == self.system.linkage.id {
            Ok(())
        } else {
            Err(ClosureError::ForeignConfiguration)
        }
    }

    /// Writes a configuration into a geometry of the model (m, global axes).
    ///
    /// Points, directions of sections and flexible bodies turn with their bodies, a section
    /// without a given `y_axis` too: from the direction that it has at home. A joint's frame turns
    /// with its first body; that of a universal joint keeps x in the first body and y in the
    /// second. Where a joint slides, its two nodes part; the joint then stands on the first
    /// body's, and the second's slides along its beam, or moves on its rigid body. A beam that
    /// runs on straight on both sides of the joint is a rail: the joint stays with the other
    /// body, whichever is first. A joint with the ground stands on the body, if that is no rail.
    ///
    /// # Errors
    /// A configuration or a geometry of another model; a sliding joint between two bodies of which neither can give
    /// way. The geometry is then as it was.
    pub fn write(
        &self,
        configuration: &Configuration,
        geometry: &mut Geometry,
    ) -> Result<(), ClosureError> {
        self.check(configuration)?;
        let linkage = &self.system.linkage;
        let bodies = linkage.posture(configuration).bodies;
        let matrix = |body: nalgebra::Isometry3<f64>| {
            IsometryMatrix3::from_parts(body.translation, body.rotation.to_rotation_matrix())
        };
        let bodies: Vec<_> = bodies.into_iter().map(matrix).collect();
        let mut room = Room::default();
        self.parts
            .write(linkage, &bodies, &configuration.values, &mut room, geometry)
    }

    /// Which coordinates are followed where those of `asked` are: of these as many as are
    /// independent, of the others those that the mechanism leaves open.
    fn prescribed(&self, asked: &[bool; 6]) -> [bool; 6] {
        let bits = (0..6).filter(|k| asked[*k]).map(|k| 1 << k).sum::<usize>();
        *self.prescribed[bits].get_or_init(|| self.independent(asked))
    }

    fn independent(&self, asked: &[bool; 6]) -> [bool; 6] {
        let mut left: Vec<_> = (0..6)
            .map(|k| {
                let weight = if k < 3 { POSITION_FIRST } else { 1.0 };
                self.freedom.row(k).transpose() * weight
            })
            .collect();
        let mut prescribed = [false; 6];
        for wanted in [true, false] {
            loop {
                let candidates = (0..6).filter(|k| asked[*k] == wanted && !prescribed[*k]);
                let largest = candidates.max_by(|a, b| {
                    // Of equals the first.
                    let order = left[*a].norm().total_cmp(&left[*b].norm());
                    order.then(b.cmp(a))
                });
                let Some(k) = largest.filter(|k| left[*k].norm() > 10.0 * RANK_TOLERANCE) else {
                    break;
                };
                prescribed[k] = true;
                let direction = left[k].normalize();
                for row in &mut left {
                    let part = row.dot(&direction);
                    *row -= &direction * part;
                }
            }
        }
        prescribed
    }

    /// What is followed for these coordinates.
    pub(crate) fn output_goal(&self, asked: &[Option<f64>; 6]) -> Goal {
        let prescribed = self.prescribed(&asked.map(|value| value.is_some()));
        let mut goal = Goal::default();
        for k in 0..6 {
            if prescribed[k] {
                let asked = asked[k].map(|value| value - self.system.shift(k));
                goal.output[k] = Some(asked.unwrap_or(self.at_home[k]));
            }
        }
        goal
    }

    /// Refuses a pose of the output that does not have the asked coordinates.
    pub(crate) fn compare(
        &self,
        found: &[f64; 6],
        asked: &[Option<f64>; 6],
    ) -> Result<(), ClosureError> {
        let whole = asked[3..].iter().all(Option::is_some);
        let mut wrong = Vec::new();
        for (k, wanted) in asked.iter().enumerate() {
            let Some(wanted) = wanted else { continue };
            let unit = if k < 3 { self.system.size } else { 1.0 };
            if (found[k] - wanted).abs() > SAME * unit && !(whole && k >= 3) {
                let [found, wanted] = [found[k], *wanted].map(shown);
                wrong.push(format!("{} is {found}, not {wanted}", NAMES[k]));
            }
        }
        if whole {
            let turn = |r: &[f64]| {
                nalgebra::UnitQuaternion::from_scaled_axis(Vector3::from_column_slice(r))
            };
            let wanted = asked.map(Option::unwrap_or_default);
            if turn(&found[3..]).angle_to(&turn(&wanted[3..])) > SAME {
                let vector = |pose: &[f64; 6]| {
                    let [.., x, y, z] = pose.map(shown);
                    format!("({x}, {y}, {z})")
                };
                wrong.push(format!(
                    "the orientation is {}, not {}",
                    vector(found),
                    vector(&wanted)
                ));
            }
        }
        if wrong.is_empty() {
            return Ok(());
        }
        Err(ClosureError::CannotFollow {
            what: format!(
                "it has {} freedoms, and {}",
                self.output_mobility(),
                wrong.join("; ")
            ),
        })
    }

    /// The named drives at their values, the other locked directions at home.
    fn drive_goal(&self, drives: &[Drive]) -> Result<Goal, ClosureError> {
        let mut goal = Goal::default();
        for drive in drives {
            self.check_drive(drive.joint, drive.direction)?;
            if let Some(column) = self.system.linkage.column(drive.joint.0, drive.direction) {
                goal.drives.push((column, drive.value));
            }
        }
        for (k, connection) in self.parts.model.joints().iter().enumerate() {
            for dof in connection.locked.iter() {
                let Some(column) = self.system.linkage.column(k, dof) else {
                    continue;
                };
                if goal.drives.iter().all(|(named, _)| *named != column) {
                    goal.drives.push((column, 0.0));
                }
            }
        }
        Ok(goal)
    }
}

fn finite<'v>(mut values: impl Iterator<Item = &'v f64>) -> Result<(), ClosureError> {
    match values.find(|value| !value.is_finite()) {
        None => Ok(()),
        Some(value) => Err(ClosureError::NotFinite { value: *value }),
    }
}

/// Middle and diagonal of the box around all nodes (m); 1 where they coincide.
fn middle_and_size(geometry: &Geometry) -> (Vector3<f64>, f64) {
    let mut positions = geometry.positions.iter().map(|p| p.coords);
    let first = positions.next().unwrap_or_default();
    let (low, high) = positions.fold((first, first), |(low, high), p| (low.inf(&p), high.sup(&p)));
    let diagonal = (high - low).norm();
    let size = if diagonal > 0.0 { diagonal } else { 1.0 };
    ((low + high) * 0.5, size)
}
