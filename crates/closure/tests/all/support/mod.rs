//! What the tests share: models put together in few words.

use hyperstat_closure::{ClosureError, Configuration, Drive, LoopClosure, Target};
use hyperstat_joints::{Dof, DofSet, Joint, frame_from_axis};
use hyperstat_model::{Connection, Geometry, JointId, JointStiffness, Model, NodeId};
use nalgebra::{Point3, Rotation3, Vector3};

/// A model of rigid bodies that grows joint by joint.
pub struct Builder(pub Model);

impl Builder {
    pub fn new() -> Self {
        Self(Model::new("test"))
    }

    pub fn body(&mut self, name: &str, points: &[(&str, [f64; 3])]) {
        let points: Vec<_> = points.iter().map(|(n, p)| (*n, Point3::from(*p))).collect();
        self.0.add_rigid(name, &points).expect("a body");
    }

    /// A joint named as the point where it is; the body `ground` is the ground.
    pub fn joint(
        &mut self,
        name: &str,
        at: &str,
        bodies: [&str; 2],
        joint: impl Joint + 'static,
        axis: [f64; 3],
        locked: bool,
    ) -> JointId {
        let frame = frame_from_axis(Some(&Vector3::from(axis)), None).expect("a frame");
        self.framed(name, at, bodies, joint, frame, locked)
    }

    pub fn framed(
        &mut self,
        name: &str,
        at: &str,
        bodies: [&str; 2],
        joint: impl Joint + 'static,
        frame: Rotation3<f64>,
        locked: bool,
    ) -> JointId {
        let node = |body: &str| -> Option<NodeId> {
            (body != "ground").then(|| self.0.node(body, at).expect("a node"))
        };
        let connection = Connection {
            name: name.into(),
            between: bodies.map(node),
            locked: if locked { joint.free() } else { DofSet::EMPTY },
            joint: Box::new(joint),
            stiffness: JointStiffness::default(),
        };
        self.0.add_joint(connection, frame).expect("a joint")
    }

    pub fn output(&mut self, body: &str, point: &str) {
        let node = self.0.node(body, point).expect("a node");
        self.0.set_output(node);
    }
}

pub fn drive(joint: JointId, direction: Dof, value: f64) -> Drive {
    Drive {
        joint,
        direction,
        value,
    }
}

/// From home to values of drives.
pub fn driven(closure: &LoopClosure, drives: &[Drive]) -> Result<Configuration, ClosureError> {
    closure.reach(&closure.home(), &Target::Drives(drives))
}

/// From home to a position of the output.
pub fn placed(closure: &LoopClosure, place: [f64; 3]) -> Result<Configuration, ClosureError> {
    let [x, y, z] = place.map(Some);
    closure.reach(
        &closure.home(),
        &Target::Output([x, y, z, None, None, None]),
    )
}

/// The geometry of a configuration.
pub fn geometry(model: &Model, closure: &LoopClosure, at: &Configuration) -> Geometry {
    let mut geometry = model.geometry().clone();
    closure.write(at, &mut geometry).expect("a geometry");
    geometry
}

/// Position of a body's point.
pub fn position(model: &Model, geometry: &Geometry, body: &str, point: &str) -> Point3<f64> {
    geometry.positions[model.node(body, point).expect("a node").0]
}

/// How a body has turned from home, from its first point and three others that span space.
pub fn turned(model: &Model, geometry: &Geometry, body: &str) -> nalgebra::Matrix3<f64> {
    let nodes = &model.bodies()[model.body(body).expect("a body").0].nodes;
    let arms = |g: &Geometry| {
        let at = |k: usize| g.positions[nodes[k].0] - g.positions[nodes[0].0];
        nalgebra::Matrix3::from_columns(&[at(1), at(2), at(3)])
    };
    let home = arms(model.geometry());
    arms(geometry) * home.try_inverse().expect("points that span space")
}
