//! The poses of a mechanism: where all parts of it are, its tool too, and the values of its drives.

use std::ops::Range;
use std::sync::OnceLock;

use hyperstat_closure::{LoopClosure, Target};
use hyperstat_joints::Dof;
use hyperstat_model::{Geometry, JointId, LANES, Model, NodeId};

use super::mover::{Mover, Placed, Placing};
use super::poses::Poses;
use super::subject::Subject;
use super::template::given;
use crate::file::end::End;
use crate::file::mechanism::Mechanism;
use crate::prebuilt::{Following, PoseCoordinate, PoseError, Prebuilt};
use crate::text::csv;

impl Subject {
    /// Brings a geometry of its model to pose `number` (from 0); returns the whole pose.
    pub(crate) fn place(
        &self,
        poses: &Poses,
        number: usize,
        geometry: &mut Geometry,
    ) -> Result<[f64; 6], PoseError> {
        match self {
            Self::File { mechanism, mover } => {
                if let Poses::Asked(targets) = poses {
                    return moved(mechanism, mover).place(targets, number, geometry);
                }
                let model = &mechanism.model;
                let own = model.geometry();
                geometry.positions.clone_from(&own.positions);
                geometry.y_axes.clone_from(&own.y_axes);
                geometry.frames.clone_from(&own.frames);
                geometry.rotations.clone_from(&own.rotations);
                Ok(own_pose(model, mechanism.own_output()))
            }
            Self::Prebuilt { mechanism, .. } => {
                let (target, count) = given(mechanism.as_ref(), &poses.get(number));
                self.place_tool(geometry, |own| mechanism.place(&target[..count], own))
            }
        }
    }

    /// Places a prebuilt mechanism, and its tool where it has one.
    fn place_tool(
        &self,
        geometry: &mut Geometry,
        place: impl FnOnce(&mut Geometry) -> Result<[f64; 6], PoseError>,
    ) -> Result<[f64; 6], PoseError> {
        match self.end() {
            Some(end) => end.place(geometry, place),
            None => place(geometry),
        }
    }

    /// What the poses of a prebuilt mechanism are of, and its tool.
    fn end(&self) -> Option<&End> {
        match self {
            Self::Prebuilt {
                template: Ok(template),
                ..
            } => Some(&template.end),
            _ => None,
        }
    }

    /// The same for several geometries, each with a pose of its own.
    pub(crate) fn place_lanes(
        &self,
        poses: &Poses,
        range: Range<usize>,
        geometries: &mut [Geometry],
        placing: &mut Placing,
    ) -> Placed {
        placing.forget_drives();
        match self {
            Self::File { mechanism, mover } => {
                if let Poses::Asked(targets) = poses {
                    let mover = moved(mechanism, mover);
                    let placed = mover.place_lanes(targets, range, geometries, placing);
                    placing.keep_found(&placed);
                    return placed;
                }
                let mut placed = [const { None }; LANES];
                for (lane, pose) in range.enumerate() {
                    placed[lane] = Some(self.place(poses, pose, &mut geometries[lane]));
                }
                if placing.keeps_drives() {
                    placing.keep_home(&placed, mechanism.model.drives().count());
                }
                placed
            }
            Self::Prebuilt { mechanism, .. } => {
                let mut targets = [[0.0; 6]; LANES];
                for (target, pose) in targets.iter_mut().zip(range.clone()) {
                    *target = given(mechanism.as_ref(), &poses.get(pose)).0;
                }
                let targets = &targets[..range.len()];
                let placed = match self.end().filter(|end| end.has_tool()) {
                    None => mechanism.place_lanes(targets, geometries),
                    Some(end) => {
                        let before = end.take_out(geometries);
                        let placed = mechanism.place_lanes(targets, geometries);
                        end.put_back(geometries, before, |lane| {
                            placed.get(lane)?.as_ref()?.as_ref().ok()
                        });
                        placed
                    }
                };
                self.keep_followed(&placed, geometries, placing);
                placed
            }
        }
    }

    /// Keeps the drives of a prebuilt mechanism in these poses, where they are asked for.
    fn keep_followed(&self, placed: &Placed, geometries: &[Geometry], placing: &mut Placing) {
        let Self::Prebuilt {
            template: Ok(template),
            following,
            ..
        } = self
        else {
            return;
        };
        if !placing.keeps_drives() {
            return;
        }
        let following = following.get_or_init(|| {
            let mut home = template.model.clone();
            home.set_output(template.end.own);
            Following::new(&home, &template.whole).ok().map(Box::new)
        });
        if let Some(following) = following {
            placing.keep_followed(placed, geometries, following);
        }
    }

    /// Brings a geometry of its model to a target; returns the whole pose.
    pub(crate) fn bring(
        &self,
        target: &Target<'_>,
        geometry: &mut Geometry,
        placing: &mut Placing,
    ) -> Result<[f64; 6], PoseError> {
        placing.forget_drives();
        match (self, target) {
            (Self::File { mechanism, mover }, _) => {
                let pose = moved(mechanism, mover).bring(target, geometry, placing)?;
                placing.keep_found(&alone(pose));
                Ok(pose)
            }
            (Self::Prebuilt { mechanism, .. }, Target::Output(asked)) => {
                let (target, count) = followed(mechanism.as_ref(), asked)?;
                let place = |own: &mut Geometry| mechanism.place(&target[..count], own);
                let pose = self.place_tool(geometry, place)?;
                self.keep_followed(&alone(pose), std::slice::from_ref(geometry), placing);
                Ok(pose)
            }
            (Self::Prebuilt { mechanism, .. }, Target::Drives(_)) => Err(PoseError::Drives {
                kind: mechanism.kind().into(),
            }),
        }
    }
}

impl Subject {
    /// Coordinates of the output that poses are given by.
    pub(crate) fn independent(&self) -> [bool; 6] {
        match self {
            Self::File { mechanism, mover } => {
                let closure = moved(mechanism, mover).closure();
                closure.map_or([false; 6], LoopClosure::coordinates)
            }
            Self::Prebuilt { mechanism, .. } => {
                let mut taken = [false; 6];
                for coordinate in mechanism.coordinates() {
                    taken[coordinate.index()] = true;
                }
                taken
            }
        }
    }

    /// Drives that poses are given by.
    pub(crate) fn driven(&self) -> Vec<(JointId, Dof)> {
        match self {
            Self::File { mechanism, mover } => {
                let closure = moved(mechanism, mover).closure();
                closure.map_or_else(Vec::new, |closure| closure.drives().collect())
            }
            Self::Prebuilt { .. } => Vec::new(),
        }
    }
}

/// One pose that was reached.
fn alone(pose: [f64; 6]) -> Placed {
    let mut placed = [const { None }; LANES];
    placed[0] = Some(Ok(pose));
    placed
}

/// The pose of the mechanism's own output in a model's own configuration.
fn own_pose(model: &Model, own: NodeId) -> [f64; 6] {
    let [x, y, z] = model.geometry().positions[own.0].into();
    [x, y, z, 0.0, 0.0, 0.0]
}

/// What moves a mechanism of a file.
fn moved<'m>(mechanism: &Mechanism, mover: &'m OnceLock<Box<Mover>>) -> &'m Mover {
    mover.get_or_init(|| Box::new(Mover::new(mechanism)))
}

/// Of what is asked of the output the coordinates that `mechanism` is given, first, and their number:
/// all that it takes, and zeros alone of the others, as in a table of poses.
fn followed(
    mechanism: &dyn Prebuilt,
    asked: &[Option<f64>; 6],
) -> Result<([f64; 6], usize), PoseError> {
    let coordinates = mechanism.coordinates();
    let asks = |coordinate: &&PoseCoordinate| asked[coordinate.index()].is_some();
    let found = coordinates.iter().filter(asks).count();
    if found < coordinates.len() {
        return Err(PoseError::Coordinates {
            kind: mechanism.kind().into(),
            expected: coordinates.len(),
            found,
        });
    }
    let follows = |index| coordinates.iter().any(|own| own.index() == index);
    for (index, name) in csv::COLUMNS.iter().enumerate() {
        if asked[index].is_some_and(|value| value != 0.0) && !follows(index) {
            return Err(PoseError::Unreachable {
                what: format!("`{}` cannot follow {name}", mechanism.kind()),
            });
        }
    }
    Ok(given(mechanism, &asked.map(Option::unwrap_or_default)))
}
