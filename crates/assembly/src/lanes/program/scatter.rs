//! Where everything that is added to a front goes, worked out once: the first to come to an entry
//! is stored there, what follows is added, and only entries that nothing is stored in are zeroed.

use super::element::NodeMotion;
use super::fronts::Moves;
use crate::lanes::pass::blocks::place;

/// Place of entry (i, j) or (j, i).
pub(crate) fn entry(size: usize, i: usize, j: usize) -> usize {
    i.min(j) * size + i.max(j)
}

/// The entries of a chain, which are only added to: those that nothing was stored in go to `zeros`.
pub(crate) fn chain(
    places: &[usize],
    size: usize,
    stored: &mut [bool],
    zeros: &mut Vec<u32>,
) -> Moves {
    let mut moves = Moves::default();
    for (j, &column) in places.iter().enumerate() {
        for &row in &places[j..] {
            let entry = entry(size, row, column);
            moves.pairs.push(entry as u32);
            if !std::mem::replace(&mut stored[entry], true) {
                zeros.push(entry as u32);
            }
        }
    }
    moves
}

/// The entries between the roots of an element's nodes.
pub(crate) fn element(
    nodes: &[NodeMotion],
    places: &[usize],
    size: usize,
    stored: &mut [bool],
) -> Moves {
    let mut roots: Vec<Option<&[usize]>> = Vec::new();
    let mut start = 0;
    for node in nodes {
        let own = if node.root.is_some() { 6 } else { 0 };
        roots.push((own > 0).then(|| &places[start..start + own]));
        start += own + node.screws.len();
    }
    let mut moves = Moves::default();
    for (s, root_s) in roots.iter().enumerate() {
        for (r, root_r) in roots[..=s].iter().enumerate() {
            let (Some(rows), Some(columns)) = (root_r, root_s) else {
                continue;
            };
            for (i, &row) in rows.iter().enumerate() {
                for (j, &column) in columns.iter().enumerate() {
                    let from = place(r, s) + 6 * i + j;
                    if r == s && j > i {
                        continue;
                    }
                    moves.push(from, entry(size, row, column), stored);
                    if r == s && i == j {
                        moves.diagonal.push([from as u32, row as u32]);
                    }
                    // Entries (i, j) and (j, i) of a coupling of one root with itself fall together.
                    if r != s && row == column {
                        moves.push(from, entry(size, row, column), stored);
                    }
                }
            }
        }
    }
    moves
}
