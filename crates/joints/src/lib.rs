//! Joints as independent displacement coordinates: what two bodies share where they meet.
//!
//! A joint between body i and body j ties the displacements `u_i` and `u_j` of the point where
//! they meet. This crate states the tie without a constraint equation: it picks the components
//! of `u_i` that stay independent, the *independent displacement coordinates* (IDCs), and
//! gives the matrix N that makes `u_i` of them and of `u_j`:
//!
//! ```text
//! u_i = N [u_i at the IDCs; u_j]        N = [n_i | n_j]        6×(f + 6)
//! ```
//!
//! for a joint that leaves f motions. It is §2.2 and the Appendix of *Systematic Elastostatic
//! Stiffness Model of Over-Constrained Parallel Manipulators Without Additional Constraint
//! Equations*; the equation numbers in this crate are that paper's, with its misprints
//! corrected. It knows nothing of beams, elements or solvers and can be used with any of them:
//! with K the stiffness of the element at body i, `Nᵀ K N` is its stiffness on the
//! independent coordinates.
//!
//! # Shortest use
//!
//! ```
//! use hyperstat_joints::{Joint, Universal, frame_from_axes};
//! use nalgebra::{Matrix6, Vector3};
//!
//! // The joint's frame: x along the first axis, y along the second.
//! let frame = frame_from_axes(&Vector3::new(1.0, 1.0, 0.0), &Vector3::z())?;
//! let mapping = Universal.mapping(&frame, Universal.free())?;
//! assert_eq!(mapping.idcs().to_string(), "u w");   // φx and φz of body i
//!
//! let k = Matrix6::identity();                     // of whatever holds body i
//! let n = mapping.matrix();                        // 6×8
//! assert_eq!((n.transpose() * k * n).shape(), (8, 8));
//! # Ok::<(), hyperstat_joints::JointError>(())
//! ```
//!
//! # Vectors and units
//!
//! A displacement is `u = [Δ; φ]`: Δx Δy Δz \[m\], then φx φy φz \[rad\], small. A wrench is
//! Fx Fy Fz \[N\], Mx My Mz \[N·m\]. Both are taken at the joint's point, along the global axes
//! unless a joint's own frame is named. A [`Dof`] names one of the six, `x y z u v w`, in the
//! joint's frame (a direction of motion) or globally (a component of a displacement).
//!
//! # The joints
//!
//! The paper's Appendix, for every orientation. x, y, z are the unit vectors of the joint's
//! frame in global axes; k is the global axis along which y is largest (m the one along which
//! the universal joint's z, or the planar joint's y, is), `e` are the unit vectors of the global
//! axes; `ρ = y / y_k`, `ν = z / z_m` (planar: `ν = y / y_m`); E is the 3×3 identity. The
//! pages of the structs show N as a matrix.
//!
//! | joint | free motions | IDCs | body to body | body to ground |
//! |---|---|---|---|---|
//! | [`Fixed`] | – | `u_j` (6) | `Δ_i = Δ_j`<br>`φ_i = φ_j` | `u_i = 0` |
//! | [`Revolute`] | v: rotation about y | `φ_ik`, `u_j` (7) | `Δ_i = Δ_j`<br>`φ_i = ρ φ_ik + (E − ρ e_kᵀ) φ_j` | `Δ_i = 0`<br>`φ_i = ρ φ_ik` |
//! | [`Prismatic`] | y: translation along y | `Δ_ik`, `u_j` (7) | `Δ_i = ρ Δ_ik + (E − ρ e_kᵀ) Δ_j`<br>`φ_i = φ_j` | `Δ_i = ρ Δ_ik`<br>`φ_i = 0` |
//! | [`Cylindrical`] | y, v | `Δ_ik`, `φ_ik`, `u_j` (8) | `Δ_i = ρ Δ_ik + (E − ρ e_kᵀ) Δ_j`<br>`φ_i = ρ φ_ik + (E − ρ e_kᵀ) φ_j` | `Δ_i = ρ Δ_ik`<br>`φ_i = ρ φ_ik` |
//! | [`Screw`], pitch p | v, with travel p v along y | `φ_ik`, `u_j` (7) | `Δ_i = Δ_j + p ρ (φ_ik − φ_jk)`<br>`φ_i = ρ φ_ik + (E − ρ e_kᵀ) φ_j` | `Δ_i = p ρ φ_ik`<br>`φ_i = ρ φ_ik` |
//! | [`Universal`] | u, v: rotations about x, y | `φ_ik`, `φ_il` (k, l ≠ m), `u_j` (8) | `Δ_i = Δ_j`<br>`φ_im = νᵀ φ_j − ν_k φ_ik − ν_l φ_il` | `Δ_i = 0`<br>`φ_im = −ν_k φ_ik − ν_l φ_il` |
//! | [`Spherical`] | u, v, w | `φ_ix`, `φ_iy`, `φ_iz`, `u_j` (9) | `Δ_i = Δ_j` | `Δ_i = 0` |
//! | [`Planar`] | x, z, v: in the plane normal to y | `Δ_ik`, `Δ_il` (k, l ≠ m), `φ_im`, `u_j` (9) | `Δ_im = νᵀ Δ_j − ν_k Δ_ik − ν_l Δ_il`<br>`φ_i = ν φ_im + (E − ν e_mᵀ) φ_j` | `Δ_im = −ν_k Δ_ik − ν_l Δ_il`<br>`φ_i = ν φ_im` |
//!
//! # No orientation is singular
//!
//! The paper prints the form for one choice of axes and warns that it is singular elsewhere.
//! Here [`Mapping::of`] takes, for every frame, the axes with the largest minor: it divides by
//! nothing smaller than 1/√3, so N is bounded in every orientation and loses no digit near
//! an axis. The choice may change from pose to pose; the number of IDCs does not.
//!
//! # Locked and elastic directions
//!
//! [`Joint::mapping`] takes the set of directions that move: the free ones, less the locked,
//! and with the elastic ones that keep a coordinate of their own.
//!
//! # A joint of your own
//!
//! Implement [`Joint`]: three methods, and [`basis`](Joint::basis) where the motions are not
//! those of the frame's axes. Then run it through [`testing::assert_conforms`]. The example
//! `offset_universal` is a universal joint whose axes do not meet.

mod dof;
mod error;
mod frame;
mod joint;
mod joints;
mod mapping;
mod motions;
mod rigid_motion;
mod subspace;
pub mod testing;

pub use dof::{Dof, DofSet};
pub use error::JointError;
pub use frame::{frame_from_axes, frame_from_axis};
pub use joint::Joint;
pub use joints::{Cylindrical, Fixed, Planar, Prismatic, Revolute, Screw, Spherical, Universal};
pub use mapping::Mapping;
pub use rigid_motion::{rigid_motion, wrench_transport};

/// The README's code, compiled and run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
