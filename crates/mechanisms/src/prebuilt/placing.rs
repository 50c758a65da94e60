//! By how much the drives of a prebuilt mechanism move between two poses.

use hyperstat_closure::{Drive, LoopClosure, Target};
use hyperstat_model::{Model, characteristic_length};
use nalgebra::{Rotation3, Vector3};

use crate::prebuilt::{Placed, PoseError};

/// How far (sizes of the mechanism) a point may be from where inverse kinematics has it: loop closure ends
/// where its loops are closed to rounding.
const SAME: f64 = 1e-6;

/// The values of the drives of `to`, relative to those of `home`, a model of the same mechanism whose
/// output has the whole pose `from`.
pub(super) fn drives_between(
    home: &Model,
    from: &[f64; 6],
    to: &Placed,
) -> Result<Vec<Drive>, PoseError> {
    let turned = |[.., x, y, z]: &[f64; 6]| Rotation3::new(Vector3::new(*x, *y, *z));
    // Loop closure counts rotations from the configuration that it begins in.
    let rotation = (turned(&to.pose) * turned(from).inverse()).scaled_axis();
    let [x, y, z, ..] = to.pose;
    let target = [x, y, z, rotation.x, rotation.y, rotation.z].map(Some);
    let reached = LoopClosure::new(home)?.place_at(&Target::Output(target))?;
    let pairs = reached
        .geometry
        .positions
        .iter()
        .zip(&to.geometry.positions);
    let off = pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    if off > SAME * characteristic_length(&to.geometry) {
        return Err(PoseError::Branch {
            what: format!("a point is {off:.6} m from where inverse kinematics has it"),
        });
    }
    Ok(reached.drives)
}
