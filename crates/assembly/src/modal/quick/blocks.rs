//! The order in which a small mechanism's coordinates are eliminated, in blocks of up to eight: what a
//! topology asks for once.
//!
//! Coordinates that the same elements hold are eliminated together, by minimum degree; a block is put
//! together with the one that it hands its remainder to where both fit into eight, so that every step of
//! the factorization is a product of small dense blocks.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// Numbers in a row, which is a register or a few.
pub(super) const ROW: usize = 8;

/// Structure of the factor of a symmetric matrix, lower triangle, by columns of blocks. A block is as
/// many rows of eight as its column has coordinates, each row along the coordinates of the row block.
#[derive(Debug)]
pub(super) struct Blocks {
    /// Place of every coordinate in the order of elimination.
    pub places: Vec<usize>,
    pub columns: Vec<Column>,
    /// Rows of eight of all blocks.
    pub len: usize,
    /// The block column of every place.
    column_of: Vec<usize>,
}

/// A column of blocks.
#[derive(Debug)]
pub(super) struct Column {
    /// Its coordinates' places.
    pub own: Range<usize>,
    /// First row of its diagonal block.
    pub diagonal: usize,
    /// Columns of the blocks below it, ascending, and their first rows.
    pub below: Vec<(usize, usize)>,
    /// First rows of the blocks that two of these change, the one nearer to the diagonal first: (0, 0),
    /// (0, 1), …, (1, 1), …
    pub changed: Vec<usize>,
}

impl Blocks {
    /// Of a matrix that couples the coordinates within each of these groups.
    pub fn new(size: usize, groups: &[&[usize]]) -> Self {
        let (sets, neighbours) = indistinguishable(size, groups);
        let order = merged(&sets, eliminated(&sets, neighbours.clone()));
        Self::of_order(size, &sets, &neighbours, &order)
    }

    /// `order`: sets of coordinates, block by block.
    fn of_order(
        size: usize,
        sets: &[Vec<usize>],
        neighbours: &[BTreeSet<usize>],
        order: &[Vec<usize>],
    ) -> Self {
        let mut places = vec![0; size];
        let mut block_of = vec![0; sets.len()];
        let mut column_of = Vec::with_capacity(size);
        let mut owns = Vec::with_capacity(order.len());
        for (block, members) in order.iter().enumerate() {
            let first = column_of.len();
            for &set in members {
                block_of[set] = block;
                for &coordinate in &sets[set] {
                    places[coordinate] = column_of.len();
                    column_of.push(block);
                }
            }
            owns.push(first..column_of.len());
        }
        let mut below: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); order.len()];
        for (set, neighbours) in neighbours.iter().enumerate() {
            let own = block_of[set];
            let others = neighbours.iter().map(|other| block_of[*other]);
            below[own].extend(others.filter(|other| *other > own));
        }
        for k in 0..order.len() {
            let own = below[k].clone();
            if let Some(parent) = own.first() {
                below[*parent].extend(own.iter().filter(|other| *other > parent));
            }
        }
        let mut len = 0;
        let mut columns: Vec<Column> = Vec::with_capacity(order.len());
        for (own, below) in owns.into_iter().zip(&below) {
            let height = own.len();
            let mut next = || {
                len += height;
                len - height
            };
            let diagonal = next();
            let below = below.iter().map(|row| (*row, next())).collect();
            columns.push(Column {
                own,
                diagonal,
                below,
                changed: Vec::new(),
            });
        }
        let mut blocks = Self {
            places,
            columns,
            len,
            column_of,
        };
        for k in 0..blocks.columns.len() {
            let below = &blocks.columns[k].below;
            let pairs = below.iter().enumerate();
            let changed = pairs.flat_map(|(j, (column, _))| {
                let blocks = &blocks;
                below[j..]
                    .iter()
                    .map(move |(row, _)| blocks.block(*row, *column))
            });
            blocks.columns[k].changed = changed.collect();
        }
        blocks
    }

    /// First row of a block.
    fn block(&self, row: usize, column: usize) -> usize {
        let own = &self.columns[column];
        if row == column {
            return own.diagonal;
        }
        match own.below.binary_search_by_key(&row, |(row, _)| *row) {
            Ok(k) => own.below[k].1,
            Err(_) => unreachable!("block ({row}, {column}) is not in the pattern"),
        }
    }

    /// Index of the entry of two places that a group couples.
    pub fn entry(&self, a: usize, b: usize) -> usize {
        let (first, last) = (a.min(b), a.max(b));
        let (column, row) = (self.column_of[first], self.column_of[last]);
        let line = self.block(row, column) + first - self.columns[column].own.start;
        line * ROW + last - self.columns[row].own.start
    }
}

/// Coordinates that the same groups hold, eight in a set at the most, and which sets are coupled.
fn indistinguishable(size: usize, groups: &[&[usize]]) -> (Vec<Vec<usize>>, Vec<BTreeSet<usize>>) {
    let mut held_by: Vec<Vec<usize>> = vec![Vec::new(); size];
    for (k, group) in groups.iter().enumerate() {
        for &coordinate in *group {
            held_by[coordinate].push(k);
        }
    }
    let mut by_groups: BTreeMap<&[usize], Vec<usize>> = BTreeMap::new();
    for (coordinate, held_by) in held_by.iter().enumerate() {
        by_groups.entry(held_by).or_default().push(coordinate);
    }
    let mut sets: Vec<Vec<usize>> = Vec::new();
    for coordinates in by_groups.values() {
        sets.extend(coordinates.chunks(ROW).map(<[usize]>::to_vec));
    }
    let mut set_of = vec![0; size];
    for (k, set) in sets.iter().enumerate() {
        for &coordinate in set {
            set_of[coordinate] = k;
        }
    }
    let mut neighbours = vec![BTreeSet::new(); sets.len()];
    for group in groups {
        let own: BTreeSet<usize> = group.iter().map(|c| set_of[*c]).collect();
        for &set in &own {
            neighbours[set].extend(own.iter().filter(|other| **other != set));
        }
    }
    (sets, neighbours)
}

/// The order of minimum degree; each set with what it is coupled to when its turn comes.
fn eliminated(
    sets: &[Vec<usize>],
    mut neighbours: Vec<BTreeSet<usize>>,
) -> Vec<(usize, BTreeSet<usize>)> {
    let mut left: BTreeSet<usize> = (0..sets.len()).collect();
    let mut order = Vec::with_capacity(sets.len());
    let degree = |of: &BTreeSet<usize>| of.iter().map(|k| sets[*k].len()).sum::<usize>();
    while let Some(next) = left.iter().copied().min_by_key(|k| degree(&neighbours[*k])) {
        left.remove(&next);
        let own = std::mem::take(&mut neighbours[next]);
        for &other in &own {
            neighbours[other].extend(own.iter().filter(|k| **k != other));
            neighbours[other].remove(&next);
        }
        order.push((next, own));
    }
    order
}

/// The same in blocks: a set goes with the first that it hands its remainder to, where there is room.
fn merged(sets: &[Vec<usize>], order: Vec<(usize, BTreeSet<usize>)>) -> Vec<Vec<usize>> {
    let mut turn = vec![0; sets.len()];
    for (k, (set, _)) in order.iter().enumerate() {
        turn[*set] = k;
    }
    let mut blocks: Vec<Vec<usize>> = order.iter().map(|(set, _)| vec![*set]).collect();
    let room = |block: &[usize]| block.iter().map(|set| sets[*set].len()).sum::<usize>();
    for (k, (_, own)) in order.iter().enumerate() {
        let Some(parent) = own.iter().map(|set| turn[*set]).min() else {
            continue;
        };
        if room(&blocks[k]) + room(&blocks[parent]) <= ROW {
            let mut both = std::mem::take(&mut blocks[k]);
            both.append(&mut blocks[parent]);
            blocks[parent] = both;
        }
    }
    blocks.retain(|block| !block.is_empty());
    blocks
}
