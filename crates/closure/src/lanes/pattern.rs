//! Where the normal equations have numbers, in an order that leaves few of them: worked out once.

use std::collections::BTreeSet;

use crate::lanes::program::Program;

/// A number of the triangle: what of the Jacobian and of the triangle itself makes it.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub row: usize,
    pub column: usize,
    /// Products of the Jacobian: first numbers of both blocks, and how many there are.
    pub products: Vec<(usize, usize, usize)>,
    /// 1 where a drive's condition adds to the diagonal.
    pub drive: f64,
    /// Products of numbers of the triangle that are taken off.
    pub taken: Vec<(usize, usize)>,
}

/// The triangle of JᵀJ, column by column in the order of elimination, the diagonal first in each.
#[derive(Debug, Clone, Default)]
pub(super) struct Pattern {
    pub entries: Vec<Entry>,
    /// First number of every column; one more at the end.
    pub starts: Vec<usize>,
    /// The unknown that every place stands for.
    pub order: Vec<usize>,
}

impl Pattern {
    pub fn new(program: &Program) -> Self {
        let count = program.columns;
        let mut near: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); count];
        for (blocks, _, _) in program.conditions() {
            for one in blocks {
                near[one.column].extend(blocks.iter().map(|other| other.column));
            }
        }
        let (order, columns) = eliminate(near);
        let mut place = vec![0; count];
        for (k, unknown) in order.iter().enumerate() {
            place[*unknown] = k;
        }
        let mut pattern = Self {
            order,
            ..Self::default()
        };
        for (column, below) in columns.iter().enumerate() {
            pattern.starts.push(pattern.entries.len());
            let mut rows: Vec<usize> = below.iter().map(|unknown| place[*unknown]).collect();
            rows.sort_unstable();
            for row in std::iter::once(column).chain(rows) {
                pattern.entries.push(Entry {
                    row,
                    column,
                    products: Vec::new(),
                    drive: 0.0,
                    taken: Vec::new(),
                });
            }
        }
        pattern.starts.push(pattern.entries.len());
        for (blocks, rows, _) in program.conditions() {
            for one in blocks {
                for other in blocks {
                    let (row, column) = (place[one.column], place[other.column]);
                    if row >= column
                        && let Some(entry) = pattern.find(row, column)
                    {
                        let product = (one.first, other.first, rows);
                        pattern.entries[entry].products.push(product);
                    }
                }
            }
        }
        for drive in &program.drives {
            let first = pattern.starts[place[*drive]];
            pattern.entries[first].drive += 1.0;
        }
        for k in 0..count {
            let column = pattern.starts[k] + 1..pattern.starts[k + 1];
            for lower in column.clone() {
                for upper in column.start..=lower {
                    let [row, column] = [lower, upper].map(|entry| pattern.entries[entry].row);
                    if let Some(entry) = pattern.find(row, column) {
                        pattern.entries[entry].taken.push((lower, upper));
                    }
                }
            }
        }
        pattern
    }

    /// Where a number stands.
    fn find(&self, row: usize, column: usize) -> Option<usize> {
        let range = self.starts[column]..*self.starts.get(column + 1)?;
        let place = self.entries[range.clone()].binary_search_by_key(&row, |entry| entry.row);
        place.ok().map(|place| range.start + place)
    }
}

/// An order of elimination in which always one with the fewest neighbours comes next, and the
/// neighbours that each has then.
fn eliminate(mut near: Vec<BTreeSet<usize>>) -> (Vec<usize>, Vec<BTreeSet<usize>>) {
    for (k, near) in near.iter_mut().enumerate() {
        near.remove(&k);
    }
    let mut left: BTreeSet<usize> = (0..near.len()).collect();
    let (mut order, mut columns) = (Vec::new(), Vec::new());
    while let Some(next) = left.iter().copied().min_by_key(|k| near[*k].len()) {
        left.remove(&next);
        let neighbours = std::mem::take(&mut near[next]);
        for k in &neighbours {
            near[*k].extend(neighbours.iter().copied().filter(|other| other != k));
            near[*k].remove(&next);
        }
        order.push(next);
        columns.push(neighbours);
    }
    (order, columns)
}
