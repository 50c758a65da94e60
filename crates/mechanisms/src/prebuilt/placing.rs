//! By how much the drives of a prebuilt mechanism move between two poses.

use hyperstat_closure::{ClosureError, Drive, LANES, Lanes, LoopClosure, Target};
use hyperstat_model::{Connection, Geometry, Model, NodeId, characteristic_length};
use nalgebra::{Rotation3, Vector3};

use super::gauge::Gauge;
use crate::prebuilt::{Placed, PoseError};

/// How far (sizes of the mechanism) a point may be from where inverse kinematics has it: loop closure ends
/// where its loops are closed to rounding.
pub(super) const SAME: f64 = 1e-6;

/// The values of the drives of `to`, relative to those of `home`, a model of the same mechanism whose
/// output has the whole pose `from`.
pub(super) fn drives_between(
    home: &Model,
    from: &[f64; 6],
    to: &Placed,
) -> Result<Vec<Drive>, PoseError> {
    let following = Following::new(home, from)?;
    let missed = match following.closure.place_at(&following.target(&to.pose)) {
        Ok(reached) => {
            let off = following.farthest(&reached.geometry, &to.geometry);
            if off <= SAME * characteristic_length(&to.geometry) {
                return Ok(reached.drives);
            }
            PoseError::Branch {
                what: format!("a point is {off:.6} m from where inverse kinematics has it"),
            }
        }
        Err(error) => error.into(),
    };
    let measured = following.measured(&to.geometry).ok_or(missed)?;
    let drive = |((joint, direction), value)| Drive {
        joint,
        direction,
        value,
    };
    Ok(home.drives().zip(measured).map(drive).collect())
}

/// Loop closure that follows a prebuilt mechanism from a pose of it.
#[derive(Debug)]
pub(crate) struct Following {
    closure: LoopClosure,
    /// Where all parts are in that pose.
    home: Geometry,
    /// The output's rotation there.
    turned: Rotation3<f64>,
    /// The nodes that no joint slides along: where on a leg a slide is, inverse kinematics may choose anew
    /// in every pose.
    fixed: Vec<NodeId>,
    /// What shows the drives where no way leads; none where one cannot be seen.
    gauges: Option<Vec<Gauge>>,
}

impl Following {
    /// From the configuration of a model, whose output has this whole pose.
    pub(crate) fn new(home: &Model, pose: &[f64; 6]) -> Result<Self, ClosureError> {
        let fixed = unslid(home);
        Ok(Self {
            closure: LoopClosure::new(home)?,
            home: home.geometry().clone(),
            turned: turned(pose),
            gauges: Gauge::all(home, &fixed),
            fixed,
        })
    }

    /// Values of the drives by where inverse kinematics has brought the parts; turns of −π to π.
    pub(crate) fn measured(&self, there: &Geometry) -> Option<Vec<f64>> {
        let gauges = self.gauges.as_ref()?.iter();
        gauges.map(|gauge| gauge.value(&self.home, there)).collect()
    }

    /// How far a point of one geometry is from where the other has it \[m\].
    fn farthest(&self, one: &Geometry, other: &Geometry) -> f64 {
        let apart = |node: &NodeId| {
            Some((one.positions.get(node.0)? - other.positions.get(node.0)?).norm())
        };
        self.fixed.iter().filter_map(apart).fold(0.0, f64::max)
    }

    /// The target at a whole pose: loop closure counts rotations from the configuration that it begins in.
    fn target(&self, pose: &[f64; 6]) -> Target<'static> {
        let rotation = (turned(pose) * self.turned.inverse()).scaled_axis();
        let [x, y, z, ..] = *pose;
        Target::Output([x, y, z, rotation.x, rotation.y, rotation.z].map(Some))
    }

    /// Follows to at most [`LANES`] poses, to which inverse kinematics has brought these geometries;
    /// `lanes` then has the values of the drives. Says which poses were reached as they are.
    pub(crate) fn follow(
        &self,
        poses: &[[f64; 6]],
        geometries: &[&Geometry],
        lanes: &mut Lanes,
        room: &mut Vec<Geometry>,
    ) -> [bool; LANES] {
        let counts = |geometry: &Geometry| (geometry.positions.len(), geometry.frames.len());
        if room
            .first()
            .is_none_or(|own| counts(own) != counts(&self.home))
        {
            *room = vec![self.home.clone(); LANES];
        }
        let targets: Vec<Target<'_>> = poses.iter().map(|pose| self.target(pose)).collect();
        let reached = self.closure.place_lanes(&targets, room, lanes);
        let mut same = [false; LANES];
        for (k, geometry) in geometries.iter().enumerate() {
            same[k] = matches!(reached[k], Some(Ok(_)))
                && self.farthest(&room[k], geometry) <= SAME * characteristic_length(geometry);
        }
        same
    }
}

/// The nodes that no joint slides along.
fn unslid(model: &Model) -> Vec<NodeId> {
    let slides = |joint: &&Connection| {
        let mut free = joint.joint.free().iter();
        free.any(|dof| !dof.is_rotation())
    };
    let joints = model.joints().iter().filter(slides);
    let slid: Vec<NodeId> = joints.flat_map(|joint| joint.between).flatten().collect();
    let nodes = (0..model.nodes().len()).map(NodeId);
    nodes.filter(|node| !slid.contains(node)).collect()
}

/// The rotation of a whole pose.
fn turned([.., x, y, z]: &[f64; 6]) -> Rotation3<f64> {
    Rotation3::new(Vector3::new(*x, *y, *z))
}
