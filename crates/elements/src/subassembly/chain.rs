//! Chains of elastic segments without joints: their flexibility and their stiffness.

use nalgebra::{Matrix6, Vector3};

use super::blocks::{add_block, set_block};
use crate::frame::transport;

/// One elastic segment of a chain, by its compliance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChainSegment {
    /// Compliance at the segment's second node with its first held, in the chain's axes.
    pub compliance: Matrix6<f64>,
    /// From the segment's first node to its second, in the chain's axes \[m\].
    pub span: Vector3<f64>,
}

/// Flexibility of a chain of segments with node 0 held: displacements of nodes 1..=n per wrenches
/// on them, with n the number of segments. It is the sum of the segments' compliances carried
/// along the chain, so nothing cancels.
///
/// `out`: column-major, (6n)×(6n), overwritten.
///
/// # Panics
/// If `out` has not (6n)² entries.
pub fn chain_flexibility(segments: &[ChainSegment], out: &mut [f64]) {
    let size = 6 * segments.len();
    assert_eq!(out.len(), size * size, "a flexibility of 6n rows");
    let mut at_node = Matrix6::zeros();
    for (node, segment) in segments.iter().enumerate() {
        let carry = transport(&segment.span);
        at_node = carry * at_node * carry.transpose() + segment.compliance;
        at_node = (at_node + at_node.transpose()) * 0.5;
        set_block(out, size, node, node, &at_node);
        // What lies beyond follows this node as a rigid body.
        let mut arm = Vector3::zeros();
        for (beyond, next) in segments.iter().enumerate().skip(node + 1) {
            arm += next.span;
            let block = transport(&arm) * at_node;
            set_block(out, size, beyond, node, &block);
            set_block(out, size, node, beyond, &block.transpose());
        }
    }
}

/// One elastic segment of a chain, by its stiffness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StiffSegment {
    /// Stiffness at the segment's second node with its first held, in the chain's axes.
    pub stiffness: Matrix6<f64>,
    /// From the segment's first node to its second, in the chain's axes \[m\].
    pub span: Vector3<f64>,
}

/// Stiffness over nodes 1..=n of a chain of segments with node 0 held, the inverse of
/// [`chain_flexibility`](super::chain_flexibility) without an inversion: it keeps its digits where
/// slender segments meet stout ones.
///
/// `out`: column-major, (6n)×(6n) with n the number of segments, overwritten.
///
/// # Panics
/// If `out` has not (6n)² entries.
pub fn chain_stiffness(segments: &[StiffSegment], out: &mut [f64]) {
    let size = 6 * segments.len();
    assert_eq!(out.len(), size * size, "a stiffness of 6n rows");
    out.fill(0.0);
    for (far, segment) in segments.iter().enumerate() {
        let stiffness = (segment.stiffness + segment.stiffness.transpose()) * 0.5;
        add_block(out, size, far, far, &stiffness);
        let Some(near) = far.checked_sub(1) else {
            continue;
        };
        let carry = transport(&segment.span);
        let coupling = -stiffness * carry;
        let own = -carry.transpose() * coupling;
        add_block(out, size, near, near, &((own + own.transpose()) * 0.5));
        set_block(out, size, far, near, &coupling);
        set_block(out, size, near, far, &coupling.transpose());
    }
}
