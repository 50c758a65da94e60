//! Where everything that is added to a front goes, worked out once: the first to come to an entry
//! is stored there, what follows is added, and only entries that nothing is stored in are zeroed.

use super::blocks::place;
use super::fronts::{Front, Part};
use super::program::{Element, Kind, NodeMotion};

/// From one place to another.
pub(super) type Move = [u32; 2];

/// Moves of one source.
#[derive(Debug, Default)]
pub(super) struct Moves {
    pub stored: Vec<Move>,
    pub added: Vec<Move>,
    /// Diagonal entries: from their places to their variables', for the errors.
    pub diagonal: Vec<Move>,
    /// Of a chain: entries of its coordinates, column by column of the lower triangle.
    pub pairs: Vec<u32>,
}

/// Everything that is added to a front.
#[derive(Debug, Default)]
pub(super) struct Scatter {
    pub zeros: Vec<u32>,
    /// By children, parts, and parts of components that hang.
    pub children: Vec<Moves>,
    pub parts: Vec<Moves>,
    pub hung_parts: Vec<Moves>,
    /// By hangs: places of every row's entries in the component's six columns, and in the
    /// targets' columns (root first, then screws).
    pub hangs: Vec<HangPlaces>,
}

/// Places that a hang reads and writes, row by row.
#[derive(Debug, Default)]
pub(super) struct HangPlaces {
    pub own: Vec<[u32; 6]>,
    /// Variables of the targets, and all others.
    pub targets: Vec<usize>,
    pub others: Vec<usize>,
    /// Entries (row, target) by rows.
    pub entries: Vec<u32>,
}

impl Scatter {
    /// Of a front whose hangs are settled.
    pub fn new(front: &Front, elements: &[Element]) -> Self {
        let size = front.variables.len();
        let mut stored = vec![false; size * size];
        let mut scatter = Self::default();
        for child in &front.children {
            let count = child.places.len();
            let mut moves = Moves::default();
            for (c, &column) in child.places.iter().enumerate() {
                for (r, &row) in child.places.iter().enumerate().skip(c) {
                    let from = child.rest_start + c * count + r;
                    moves.push(from, entry(size, row, column), &mut stored);
                }
            }
            scatter.children.push(moves);
        }
        let mut zeros = Vec::new();
        let mut of = |part: Part, places: &[usize], stored: &mut [bool]| match part {
            Part::Element(k) => match elements[k].kind {
                Kind::Chain(_) => chain(&places[..elements[k].ends()], size, stored, &mut zeros),
                _ => element(&elements[k].nodes, places, size, stored),
            },
            Part::Spring(_) | Part::Load(_) => Moves::default(),
        };
        for (part, places) in &front.parts {
            scatter.parts.push(of(*part, places, &mut stored));
        }
        for hang in &front.hangs {
            let own = (0..size).map(|i| hang.places.map(|p| entry(size, i, p) as u32));
            let targets: Vec<usize> = hang
                .root
                .into_iter()
                .chain(hang.screws.iter().map(|(_, p)| *p))
                .collect();
            let entries = (0..size).flat_map(|i| targets.iter().map(move |t| (i, *t)));
            scatter.hangs.push(HangPlaces {
                own: own.collect(),
                entries: entries.map(|(i, t)| entry(size, i, t) as u32).collect(),
                others: (0..size).filter(|i| !targets.contains(i)).collect(),
                targets,
            });
            // What hangs is added after its motion was made relative: it is never first.
            let mut all = vec![true; size * size];
            scatter
                .hung_parts
                .push(of(hang.part, &hang.part_places, &mut all));
        }
        let lower = (0..size).flat_map(|c| (c..size).map(move |r| c * size + r));
        zeros.extend(lower.filter(|p| !stored[*p]).map(|p| p as u32));
        scatter.zeros = zeros;
        scatter
    }
}

impl Moves {
    fn push(&mut self, from: usize, to: usize, stored: &mut [bool]) {
        let list = if stored[to] {
            &mut self.added
        } else {
            &mut self.stored
        };
        list.push([from as u32, to as u32]);
        stored[to] = true;
    }
}

/// Place of entry (i, j) or (j, i).
fn entry(size: usize, i: usize, j: usize) -> usize {
    i.min(j) * size + i.max(j)
}

/// The entries of a chain, which are only added to: those that nothing was stored in go to `zeros`.
fn chain(places: &[usize], size: usize, stored: &mut [bool], zeros: &mut Vec<u32>) -> Moves {
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
fn element(nodes: &[NodeMotion], places: &[usize], size: usize, stored: &mut [bool]) -> Moves {
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
