//! What segments do in a mode, between their nodes.

use std::sync::Arc;

use nalgebra::Vector6;

use crate::modal::member::Member;

/// What a segment does in a mode, part by part.
#[derive(Debug, Clone)]
pub(super) struct Curve(pub Vec<Part>);

/// What a part of a segment does in a mode.
#[derive(Debug, Clone)]
pub(super) struct Part {
    pub member: Arc<Member>,
    /// Displacements of its ends, element frame.
    pub ends: [Vector6<f64>; 2],
    /// Amounts of its inner shapes.
    pub amounts: Vec<f64>,
}

impl Part {
    /// Displacement at `xi` (0 to 1) along it, element frame.
    fn at(&self, xi: f64) -> Vector6<f64> {
        let (member, [first, second]) = (&self.member, &self.ends);
        let moved = member.beam.displacement(xi, first, second, None);
        if self.amounts.is_empty() || xi == 0.0 || xi == 1.0 {
            return moved;
        }
        let inner = &member.inner;
        moved + inner.displacement(member.beam.straight(), xi, &self.amounts)
    }
}

impl Curve {
    /// Displacement at `xi` (0 to 1) along the segment, element frame.
    pub fn at(&self, xi: f64) -> Vector6<f64> {
        let along = xi * self.0.len() as f64;
        let part = (along.floor().max(0.0) as usize).min(self.0.len() - 1);
        self.0[part].at(along - part as f64)
    }
}
