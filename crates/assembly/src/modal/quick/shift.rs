//! The shifts that a topology's poses are counted and solved at.

use super::kinds::{Kind, Plane};
use super::table::Table;

/// A shift σ, and all members at it.
#[derive(Debug)]
pub(super) struct Shift {
    /// σ \[rad²/s²\].
    pub square: f64,
    pub kinds: Vec<Kind>,
    /// 1/(ω² − σ) of all inner shapes, member by member.
    pub inverses: Vec<f64>,
}

impl Shift {
    pub fn new(table: &Table, square: f64) -> Self {
        let kinds: Vec<Kind> = table.kinds.iter().map(|kind| kind.at(square)).collect();
        let mut inverses = Vec::with_capacity(table.size - table.nodes);
        for member in &table.members {
            let kind = &kinds[member.kind];
            for plane in &kind.pairs {
                add(plane, &mut inverses);
            }
            for plane in &kind.fours {
                add(plane, &mut inverses);
            }
        }
        Self {
            square,
            kinds,
            inverses,
        }
    }
}

fn add<const N: usize>(plane: &Plane<N>, inverses: &mut Vec<f64>) {
    inverses.extend(plane.shapes.iter().map(|shape| shape.square));
}
