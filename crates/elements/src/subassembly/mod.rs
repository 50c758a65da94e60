//! Subassembly elements: an elastic body together with the elastic joints at its nodes (§2.1).
//!
//! One stiffness, four ways to it:
//!
//! | form | nodes | for |
//! |---|---|---|
//! | [`two_node_stiffness`] | 2 | the paper's Eqs. 3–12 |
//! | [`softened_stiffness`] | any | `K (I + C K)⁻¹`; joints not much softer than the body |
//! | [`chain_flexibility`], [`add_joint_compliance`], [`invert_flexibility`] | any | flexibilities summed with node 0 held, as in Eq. 5; no allocation |
//! | [`chain_stiffness`], [`absorb_joints`] | any | joints of any softness, no inversion; no allocation |
//!
//! The first two test the others. All are exact for rigid joints, whose compliance is zero, and
//! none needs the inverse of a joint's stiffness.
//!
//! Matrices of any number of nodes are column-major slices of the caller's. Where node 0 is held,
//! node r of 1..=n has the rows and columns 6(r−1)..6r.
//!
//! # Soft joints
//!
//! Let a joint be softer than the body by a factor s in one direction, and measure errors of K_ij
//! against √(K_ii K_jj). Where the soft direction lies across the axes, the flexibility holds the
//! joint's large numbers in the same entries as the body's small ones: its inverse is off by up to
//! s · 1e-16, at s = 1e11 by 1e-5 and, in chains of several segments, more. [`absorb_joints`]
//! stays at 1e-10 up to s = 1e9 and at 1e-9 up to s = 1e13.
//!
//! The soft direction's own stiffness is another matter: across the axes no matrix of doubles
//! holds it better than to s · 1e-16 of itself, whatever formed it. Where it matters and s is
//! above 1e4, the soft direction is better kept as a coordinate of its own.

mod absorption;
mod blocks;
mod chain;
mod deformation;
mod elastic_joint;
mod flexibility;
mod general;
mod two_node;

pub use absorption::{JointFactor, absorb_joints, absorption_workspace};
pub use chain::{ChainSegment, StiffSegment, chain_flexibility, chain_stiffness};
pub use deformation::{deformation_operator, relative_displacements, unheld_stiffness};
pub use elastic_joint::ElasticJoint;
pub use flexibility::{add_joint_compliance, invert_flexibility};
pub use general::softened_stiffness;
pub use two_node::two_node_stiffness;
