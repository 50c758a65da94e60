//! Prebuilt mechanisms: a few numbers and a pose in, a [`Model`] out.
//!
//! A [`Prebuilt`] knows its own topology and solves its own inverse kinematics, so a pose of the
//! output is all that a sweep has to give. The paper's two case studies are drawn below, the other
//! mechanisms on the pages of their types; any other type may implement the trait.
//!
//! # `Delta`: the over-constrained delta of the paper's §4
//!
//! Clavel's delta with revolute joints only. The base carries three equal limbs, limb i being
//! limb 1 turned by 120° (i − 1) about z. A limb is an arm and a parallelogram of two rods
//! between two cross links:
//!
//! ```text
//!   z                          Limb 1 seen along −x. A, B and C are revolute
//!   │                          joints along x; A is the drive, which is locked.
//!   P ─── C                    O–A is base_radius, P–C platform_radius,
//!   │       ╲                  A–B arm_length, B–C rod_length.
//!   │         ╲
//!   │           ╲  rods
//!   │             ╲
//!   │               B
//!   │             ╱
//!   │           ╱  arm
//!   O ──────── A ────── y, outward
//!
//!   Ca ─── C ─── Cb  wrist     The parallelogram seen along the axes of its
//!   │             │            four joints, (C − B) × x; a is the −x side.
//!   │ roda   rodb │            Ba–Bb is rod_spacing. Elbow and wrist are the
//!   │             │            cross links, described by `bar`.
//!   Ba ─── B ─── Bb  elbow
//! ```
//!
//! | body | runs through | local y along |
//! |---|---|---|
//! | `arm` | A, B | the axis of A |
//! | `elbow` | Ba, B, Bb | the parallelogram's axes |
//! | `wrist` | Ca, C, Cb | the parallelogram's axes |
//! | `roda` | Ba, Ca | the parallelogram's axes |
//! | `rodb` | Bb, Cb | the parallelogram's axes |
//!
//! | joint | between | axis (y of its frame) | x of its frame |
//! |---|---|---|---|
//! | `A` | ground, `arm` | the limb's (x in limb 1) | outward |
//! | `B` | `arm`, `elbow` | the limb's | along the arm |
//! | `Ba`, `Ca` | `elbow` or `wrist`, `roda` | the parallelogram's | C − B |
//! | `Bb`, `Cb` | `elbow` or `wrist`, `rodb` | the parallelogram's | C − B |
//! | `C` | `wrist`, `platform` | the limb's | C − B, made normal to the axis |
//!
//! Every name carries the limb's number: `arm1`, `Ba1`. The rigid `platform` holds P, C1, C2 and
//! C3; P is the output. A pose is the position x, y, z of P (m); the orientation is constant.
//! Sixteen bodies and 21 revolute joints give −9 by Grübler's count, yet the platform moves:
//! with the drives released the mobility is 3 and the degree of over-constraint 12.
//!
//! Topology and joints are those of the paper, which prints no lengths, sections or moduli;
//! [`Delta::paper`] holds this project's own. The mechanism was introduced by R. Clavel,
//! *Conception d'un robot parallèle rapide à 4 degrés de liberté*, thesis 925, EPFL, 1991.
//!
//! # `SingleFreedom`: case study 1, the paper's §3
//!
//! ```text
//!   ▒ A ═══════ B ┄┄ O ┄┄ C ═══════ D ▒   ─► x
//!        AB     k_B    BC   k_C   CD
//! ```
//!
//! Two beams held at their outer ends and a rigid body of 0.1 m between them; the joints B and
//! C are elastic along x. The structure does not move: its pose takes no coordinates.

mod construction;
mod delta;
mod error;
mod exechon;
mod frames;
mod gauge;
mod hexapod;
mod limbs;
mod linear_delta;
mod orthoglide;
mod parameter;
mod placing;
mod planar_three_rrr;
mod rail;
mod single_freedom;
mod spherical_three_rrr;
mod telescope;
mod three_prs;
mod three_rps;
mod tilt;
mod tricept;
mod tripteron;
mod two_links;
mod wide;
#[cfg(test)]
mod written_out;
mod zero_torsion;

use std::fmt::Debug;

use hyperstat_closure::Drive;
use hyperstat_elements::{Material, Section};
use hyperstat_model::{Geometry, LANES, Model, ValuePlace};

pub use crate::prebuilt::delta::{Delta, Elbow, RodEnds};
pub use crate::prebuilt::error::{ParameterError, PoseError};
pub use crate::prebuilt::exechon::Exechon;
pub use crate::prebuilt::hexapod::Hexapod;
pub use crate::prebuilt::linear_delta::LinearDelta;
pub use crate::prebuilt::orthoglide::Orthoglide;
pub(crate) use crate::prebuilt::placing::Following;
pub use crate::prebuilt::planar_three_rrr::PlanarThreeRrr;
pub use crate::prebuilt::rail::{CarriageSide, Rails};
pub use crate::prebuilt::single_freedom::SingleFreedom;
pub use crate::prebuilt::spherical_three_rrr::SphericalThreeRrr;
pub use crate::prebuilt::telescope::{FootJoint, TelescopicLeg};
pub use crate::prebuilt::three_prs::ThreePrs;
pub use crate::prebuilt::three_rps::ThreeRps;
pub use crate::prebuilt::tricept::Tricept;
pub use crate::prebuilt::tripteron::Tripteron;
pub use crate::prebuilt::two_links::ElbowSide;

/// A mechanism that builds its own model for a pose of its output.
pub trait Prebuilt: Debug + Send + Sync {
    /// Its name in a batch file, such as `Delta`.
    fn kind(&self) -> &str;

    /// The coordinates of the output's pose that it takes, in their order in a pose. The others
    /// follow from its kinematics.
    fn coordinates(&self) -> &'static [PoseCoordinate];

    /// Those of the others that are zero in every pose.
    fn zero_coordinates(&self) -> &'static [PoseCoordinate] {
        &[]
    }

    /// The model at `pose`, without loads.
    ///
    /// # Errors
    /// A parameter out of its range, a pose of another number of coordinates, not finite, out
    /// of reach or singular.
    fn model(&self, pose: &[f64]) -> Result<Model, PoseError>;

    /// Which parameter each value of the model at `pose` comes from, by the path that it has in a
    /// batch file, such as `rod.section.diameter`. By these sensitivities and budgets name what they
    /// are about. Values that are not a parameter as it is written have no origin; none by default.
    ///
    /// # Errors
    /// As [`Prebuilt::model`].
    fn origins(&self, _pose: &[f64]) -> Result<Vec<(ValuePlace, String)>, PoseError> {
        Ok(Vec::new())
    }

    /// Brings `geometry`, which has the numbering of [`Prebuilt::model`]'s, to `pose`, and
    /// returns the whole pose x y z (m) rx ry rz (rad) of the output. Allocates nothing unless
    /// it fails; where it fails it leaves `geometry` as it was.
    ///
    /// # Errors
    /// As [`Prebuilt::model`]; a geometry of another model.
    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError>;

    /// Brings each of these geometries to a pose of its own, at most [`LANES`] together: the first
    /// coordinates of `poses[k]` are those that [`Prebuilt::place`] takes for `geometries[k]`. What is
    /// found at a pose does not depend on the others, and a pose that fails leaves its geometry as it
    /// was. One by one by default.
    ///
    /// # Panics
    /// If there are more poses than geometries or [`LANES`].
    fn place_lanes(
        &self,
        poses: &[[f64; 6]],
        geometries: &mut [Geometry],
    ) -> [Option<Result<[f64; 6], PoseError>>; LANES] {
        let count = self.coordinates().len();
        let mut placed = [const { None }; LANES];
        for (k, pose) in poses.iter().enumerate() {
            placed[k] = Some(self.place(&pose[..count], &mut geometries[k]));
        }
        placed
    }

    /// Where all parts are at `pose`, in a geometry of its own.
    ///
    /// # Errors
    /// As [`Prebuilt::model`].
    fn place_at(&self, pose: &[f64]) -> Result<Placed, PoseError> {
        let mut geometry = self.model(pose)?.geometry().clone();
        let pose = self.place(pose, &mut geometry)?;
        Ok(Placed { geometry, pose })
    }

    /// By how much every drive moves (m, rad) from the pose `from` to the pose `to`: the locked or elastic
    /// directions that are free by their joints' kinds, of the second body relative to the first. Ball
    /// joints' directions have no values and are left out. Whole turns are counted where loop closure finds
    /// a way from one pose to the other; elsewhere a turn is one of −π to π.
    ///
    /// # Errors
    /// As [`Prebuilt::model`] of either pose; a mechanism that loop closure cannot move; one with drives
    /// other than slides and cranks, where the way between the two is singular or changes the assembly mode.
    fn drives_between(&self, from: &[f64], to: &[f64]) -> Result<Vec<Drive>, PoseError> {
        let model = self.model(from)?;
        let from = self.place(from, &mut model.geometry().clone())?;
        placing::drives_between(&model, &from, &self.place_at(to)?)
    }
}

/// A prebuilt mechanism at a pose.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// Where all parts are: a geometry of the mechanism's models.
    pub geometry: Geometry,
    /// The output's whole pose x y z (m) rx ry rz (rad).
    pub pose: [f64; 6],
}

/// A coordinate of the output's pose: its position (m), and the rotation vector (rad) from its
/// home orientation, in global axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PoseCoordinate {
    /// Position along x.
    X,
    /// Position along y.
    Y,
    /// Position along z.
    Z,
    /// Rotation vector along x.
    Rx,
    /// Rotation vector along y.
    Ry,
    /// Rotation vector along z.
    Rz,
}

impl PoseCoordinate {
    /// Its place among x, y, z, rx, ry, rz, from 0.
    pub fn index(self) -> usize {
        self as usize
    }
}

/// Section and material of a link.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Section.
    pub section: Section,
    /// Material.
    pub material: Material,
}

/// The rotation of the output.
const ROTATION: &[PoseCoordinate] = &[PoseCoordinate::Rx, PoseCoordinate::Ry, PoseCoordinate::Rz];

/// Takes exactly `N` finite coordinates from a pose.
fn coordinates<const N: usize>(kind: &str, pose: &[f64]) -> Result<[f64; N], PoseError> {
    let given = <[f64; N]>::try_from(pose).map_err(|_| PoseError::Coordinates {
        kind: kind.into(),
        expected: N,
        found: pose.len(),
    })?;
    match given.iter().position(|c| !c.is_finite()) {
        None => Ok(given),
        Some(index) => Err(PoseError::NotFinite {
            index,
            value: given[index],
        }),
    }
}

/// Refuses a geometry that has other numbers of nodes, segments and joints than `expected`.
fn check_numbering(geometry: &Geometry, expected: [usize; 3]) -> Result<(), PoseError> {
    let found = [
        geometry.positions.len(),
        geometry.y_axes.len(),
        geometry.frames.len(),
    ];
    if found == expected {
        return Ok(());
    }
    Err(PoseError::ForeignGeometry { expected, found })
}
