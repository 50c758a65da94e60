//! The finite motions of a joint, from its kind's free directions and basis.

use hyperstat_joints::{Dof, DofSet};
use hyperstat_model::{Connection, Geometry, Model, NodeId};
use nalgebra::{
    DMatrix, DVector, Isometry3, IsometryMatrix3, Matrix6, Translation3, UnitQuaternion, Vector3,
};

use crate::error::ClosureError;
use crate::twist::Twist;

/// How far, relative to its size, a motion may be from those of the basis.
const SAME: f64 = 1e-9;

/// How the second body of a joint moves relative to the first.
///
/// In the joint frame that is fixed to the first body, the finite motion is
/// `h = exp(q₁ S₁) exp(q₂ S₂) …` over the free directions in the order x y z u v w, S the columns
/// of the basis. This is exact for every built-in kind: a universal joint turns about x, which
/// is fixed to its first body, and then about y, which is fixed to its second. Three rotations
/// about axes through one point are one rotation instead, which has no singular position.
#[derive(Debug, Clone)]
pub(crate) struct JointMotion {
    pub name: String,
    /// The joint frame at home.
    pub home: Isometry3<f64>,
    /// First and second body; `None` is the ground.
    pub bodies: [Option<usize>; 2],
    pub nodes: [Option<NodeId>; 2],
    /// The factors of h, in their order.
    pub factors: Vec<(Dof, Twist)>,
    /// Whether h ends with a free rotation.
    pub ball: bool,
    /// Directions that a target may give values: free by kind, and locked or elastic.
    pub drives: DofSet,
    /// All free motions, at the joint's point.
    free: Vec<Twist>,
    /// After so many factors stands the frame in which the free motions are those of the basis.
    standing: usize,
}

impl JointMotion {
    /// The motions of joint `index` of `model`; positions are taken from `centre`.
    pub fn new(model: &Model, index: usize, centre: &Vector3<f64>) -> Result<Self, ClosureError> {
        let connection = &model.joints()[index];
        let geometry = model.geometry();
        let free = connection.released();
        let basis = connection.joint.basis();
        let drives = connection.drives();
        let turns = DofSet::new(&[Dof::U, Dof::V, Dof::W]);
        let ball = free.intersection(turns) == turns
            && drives.intersection(turns).is_empty()
            && is_ball(&basis);
        let factors = free
            .iter()
            .filter(|dof| !(ball && dof.is_rotation()))
            .map(|dof| (dof, column(&basis, dof)))
            .collect();
        let mut motion = Self {
            name: connection.name.clone(),
            home: home_frame(connection, geometry, index, centre),
            bodies: connection
                .between
                .map(|node| node.map(|n| model.nodes()[n.0].body.0)),
            nodes: connection.between,
            factors,
            ball,
            drives,
            free: free.iter().map(|dof| column(&basis, dof)).collect(),
            standing: 0,
        };
        let factors = motion.factors.len();
        let standing = (0..=factors).find(|k| motion.stands_after(*k));
        motion.standing = standing.ok_or_else(|| ClosureError::Motions {
            joint: connection.name.clone(),
            kind: connection.joint.kind().into(),
        })?;
        Ok(motion)
    }

    /// Number of coordinates, without those of a free rotation.
    pub fn len(&self) -> usize {
        self.factors.len()
    }

    /// Number of free directions.
    pub fn free(&self) -> usize {
        self.free.len()
    }

    /// Frames before and after every factor of h, from that of the first body.
    pub fn prefixes(&self, first: &Isometry3<f64>, values: &[f64]) -> Vec<Isometry3<f64>> {
        let mut frames = vec![*first];
        for ((_, twist), value) in self.factors.iter().zip(values) {
            let last = frames[frames.len() - 1];
            frames.push(last * twist.exp(*value));
        }
        frames
    }

    /// Where the joint stands for its basis to hold, from the frame of its first body.
    pub fn standing(&self, first: &IsometryMatrix3<f64>, values: &[f64]) -> IsometryMatrix3<f64> {
        let factors = self.factors[..self.standing].iter().zip(values);
        factors.fold(*first, |frame, ((_, twist), value)| {
            let moved = twist.exp(*value);
            let turn = moved.rotation.to_rotation_matrix();
            frame * IsometryMatrix3::from_parts(moved.translation, turn)
        })
    }

    /// Whether the basis holds about another point of the frame where the joint stands.
    pub fn holds_about(&self, offset: &Vector3<f64>) -> bool {
        // It changes no motion by more than that.
        if offset.norm() <= 0.5 * SAME {
            return true;
        }
        let shift = Isometry3::from_parts(Translation3::from(-offset), UnitQuaternion::identity());
        self.free
            .iter()
            .all(|twist| self.is_free(&twist.seen_through(&shift)))
    }

    /// Whether, after `k` factors, the free motions are those of the basis; seen at values of no
    /// special kind.
    fn stands_after(&self, k: usize) -> bool {
        let values: Vec<f64> = (0..self.len()).map(|c| 0.37 + 0.21 * c as f64).collect();
        let frames = self.prefixes(&Isometry3::identity(), &values);
        let back = frames[k].inverse();
        let own = self.factors.iter().zip(&frames);
        let mut motions: Vec<Twist> = own
            .map(|((_, twist), frame)| twist.seen_through(&(back * frame)))
            .collect();
        if self.ball {
            let frame = back * frames[self.len()];
            let turns = [Vector3::x(), Vector3::y(), Vector3::z()];
            motions.extend(turns.map(|axis| Twist::turn(axis).seen_through(&frame)));
        }
        motions.iter().all(|motion| self.is_free(motion))
    }

    /// Whether a motion is one of the free ones, put together.
    fn is_free(&self, motion: &Twist) -> bool {
        let free = DMatrix::from_fn(6, self.free.len(), |r, c| self.free[c].column()[r]);
        let wanted = DVector::from_column_slice(motion.column().as_slice());
        let normal = free.tr_mul(&free);
        let Some(shares) = normal.cholesky().map(|f| f.solve(&free.tr_mul(&wanted))) else {
            return false;
        };
        (free * shares - &wanted).amax() <= SAME * wanted.amax().max(1.0)
    }
}

/// A column of the basis.
fn column(basis: &Matrix6<f64>, dof: Dof) -> Twist {
    Twist::new(&basis.column(dof.index()).into_owned())
}

/// Whether u v w are rotations about the joint's own point.
fn is_ball(basis: &Matrix6<f64>) -> bool {
    let unit = Matrix6::identity();
    (3..6).all(|c| basis.column(c) == unit.column(c))
}

/// The joint's frame at its first node (the second where the first is the ground).
fn home_frame(
    connection: &Connection,
    geometry: &Geometry,
    index: usize,
    centre: &Vector3<f64>,
) -> Isometry3<f64> {
    let node = connection.between.into_iter().flatten().next();
    let place = node.map_or(Vector3::zeros(), |n| {
        geometry.positions[n.0].coords - centre
    });
    Isometry3::from_parts(
        Translation3::from(place),
        UnitQuaternion::from_rotation_matrix(&geometry.frames[index]),
    )
}
