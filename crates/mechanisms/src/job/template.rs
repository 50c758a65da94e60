//! A prebuilt mechanism in a pose that it reaches, from which a job's models are made.

use hyperstat_model::{Model, NodeId};
use nalgebra::{Rotation3, Vector3};

use super::poses::Poses;
use crate::error::LoadError;
use crate::file::end::End;
use crate::file::home::Home;
use crate::file::loads::Acting;
use crate::prebuilt::{PoseCoordinate, PoseError, Prebuilt};

/// A model in a pose that can be reached.
#[derive(Debug)]
pub(crate) struct Template {
    pub(super) model: Model,
    pub(super) pose: [f64; 6],
    /// The whole pose of the mechanism's own output.
    pub(super) whole: [f64; 6],
    pub(super) end: End,
}

impl Template {
    fn new(model: Model, pose: [f64; 6], mechanism: &dyn Prebuilt) -> Self {
        let (target, count) = given(mechanism, &pose);
        // It has been reached before.
        let whole = mechanism.place(&target[..count], &mut model.geometry().clone());
        Self {
            whole: whole.unwrap_or(pose),
            end: End::at(model.output().unwrap_or(NodeId(0))),
            model,
            pose,
        }
    }

    /// Reads what a job says of what acts on it, and of its output.
    pub(super) fn act(&mut self, acting: &Acting) -> Result<(), LoadError> {
        let [.., x, y, z] = self.whole;
        let turned = Rotation3::new(Vector3::new(x, y, z));
        let output = self.end.read(acting, &mut self.model, &turned)?;
        acting.read(&mut self.model, &Home::Output(turned))?;
        if acting.output().or(acting.tool()).is_some() {
            self.model.set_output(output);
        }
        Ok(())
    }
}

/// Of a whole pose the coordinates that `mechanism` is given, first, and their number.
pub(super) fn given(mechanism: &dyn Prebuilt, pose: &[f64; 6]) -> ([f64; 6], usize) {
    let coordinates = mechanism.coordinates();
    let mut target = [0.0; 6];
    for (value, coordinate) in target.iter_mut().zip(coordinates) {
        *value = pose[coordinate.index()];
    }
    (target, coordinates.len())
}

/// The model in the first of these poses that can be reached: the job's first [`TRIED`] poses, that
/// of a `similar` design, the poses of [`probes`], the rest of the job's; the first pose's error
/// where none can. The loads are checked in a pose that the job does not have, too: the names of a
/// mechanism are the same in every pose.
pub(super) fn template(
    mechanism: &dyn Prebuilt,
    poses: &Poses,
    similar: Option<[f64; 6]>,
) -> Result<Box<Template>, PoseError> {
    let build = |pose: [f64; 6]| {
        let (target, count) = given(mechanism, &pose);
        let model = mechanism.model(&target[..count])?;
        Ok(Box::new(Template::new(model, pose, mechanism)))
    };
    let first = poses.len().min(TRIED);
    let tried = (1..first).map(|pose| poses.get(pose)).chain(similar);
    let rest = (first..poses.len()).map(|pose| poses.get(pose));
    let mut others = tried.chain(probes(mechanism.coordinates())).chain(rest);
    build(poses.get(0)).or_else(|error| others.find_map(|pose| build(pose).ok()).ok_or(error))
}

/// Number of poses of a job that are tried before any other: a large grid may be out of reach.
const TRIED: usize = 1000;

/// Poses of which a mechanism of any size between a millimetre and a kilometre is likely to reach
/// one: home, and one coordinate at a time on either side of it, by steps of 3 %.
fn probes(coordinates: &[PoseCoordinate]) -> impl Iterator<Item = [f64; 6]> {
    let values = || (0..=468).flat_map(|k| [1.0, -1.0].map(|sign| sign * 1e-3 * 1.03_f64.powi(k)));
    let moved = coordinates.iter().flat_map(move |coordinate| {
        values().map(|value| {
            let mut pose = [0.0; 6];
            pose[coordinate.index()] = value;
            pose
        })
    });
    std::iter::once([0.0; 6]).chain(moved)
}
