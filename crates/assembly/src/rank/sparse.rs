//! Linear conditions of large mechanisms solved by rank: elimination of sparse rows.
//!
//! It answers what [`Elimination`](crate::elimination::Elimination) answers, for conditions too
//! many for complete pivoting. A pivot is taken from the shortest row, in the shortest column,
//! where it is no smaller than a share of the largest entry of its row and of its column (rook
//! pivoting by threshold); rows with small entries only wait until no others are left, so that
//! the small pivots come last and tell the rank, as with complete pivoting. What cancels is taken
//! out of the pattern: once a loop of bodies is found rigid, its bodies are one, and fill stays
//! local.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

use super::dense::{DOUBTFUL, RANK_TOLERANCE, SPARING};
use crate::error::SolveError;
use crate::room;
use crate::room::MOST_NUMBERS;

/// A pivot is at least this share of the largest entry of its row and of its column.
const THRESHOLD: f64 = 0.25;
/// Entries up to this have cancelled: rounding of entries of about 1.
pub(super) const CANCELLED: f64 = 1e-13;
/// Rows whose largest entry is below one step wait for the next.
const STEP: f64 = 0.1;
/// Columns wait for those of lower levels while these have a pivot this large.
const LOCAL: f64 = 0.1;

/// A vector by its entries that are not zero, ascending.
pub(crate) type SparseVector = Vec<(usize, f64)>;

/// Conditions eliminated: `rows · x = 0`.
#[derive(Debug)]
pub(crate) struct SparseElimination {
    pub(super) columns: usize,
    /// Row and column of every pivot, in their order.
    pub(super) pivots: Vec<(usize, usize)>,
    /// The pivots.
    pub(super) values: Vec<f64>,
    /// Rest of every pivot's row, over the pivot: in columns without a pivot or of later pivots.
    pub(super) upper: Vec<SparseVector>,
    /// What was taken from every row: multiples of the rows of pivots.
    pub(super) lower: Vec<SparseVector>,
    /// Rows that are combinations of those with pivots.
    pub redundant: Vec<usize>,
    /// The largest pivot, taken or left, between zero and not zero.
    pub doubtful: Option<f64>,
}

impl SparseElimination {
    /// Eliminates `rows` over `columns` columns.
    pub fn new(rows: Vec<SparseVector>, columns: usize) -> Self {
        Self::solve(rows, vec![0; columns], RANK_TOLERANCE)
    }

    /// The same, doubtful pivots taken as zero.
    pub fn without_doubtful(rows: Vec<SparseVector>, columns: usize) -> Self {
        Self::solve(rows, vec![0; columns], DOUBTFUL.end)
    }

    /// Eliminates `rows` by the levels of their columns: one takes a pivot only where no column of a
    /// lower level has one that is large enough. So what depends on one another stays near, where
    /// levels are those of a dissection. Columns of the last level are spared where that is possible
    /// at all.
    pub fn by_levels(rows: Vec<SparseVector>, level_of: Vec<usize>) -> Self {
        Self::solve(rows, level_of, RANK_TOLERANCE)
    }

    fn solve(rows: Vec<SparseVector>, level_of: Vec<usize>, tolerance: f64) -> Self {
        let columns = level_of.len();
        let mut front = Front::new(rows, level_of);
        let last = front.level_of.iter().copied().max().unwrap_or(0);
        for level in 0..last {
            front.level = level;
            front.reduce(if level + 1 == last { SPARING } else { LOCAL });
        }
        front.level = last;
        front.reduce(tolerance);
        let left = front.left();
        let largest = left.iter().map(|row| largest(&front.rows[*row]));
        let left_largest = largest.fold(0.0, f64::max);
        let doubtful = DOUBTFUL.contains(&left_largest).then_some(left_largest);
        let doubtful = [front.doubtful, doubtful].into_iter().flatten();
        Self {
            columns,
            pivots: front.pivots,
            values: front.values,
            upper: front.upper,
            lower: front.lower,
            redundant: left,
            doubtful: doubtful.reduce(f64::max),
        }
    }

    /// Rank of the conditions.
    pub fn rank(&self) -> usize {
        self.pivots.len()
    }

    /// The columns that have a pivot, in the order of the pivots.
    pub fn pivot_columns(&self) -> impl Iterator<Item = usize> {
        self.pivots.iter().map(|(_, column)| *column)
    }

    /// A basis of the null space: one vector for each column without a pivot, 1 there.
    ///
    /// # Errors
    /// Vectors that together have too many entries.
    pub fn null_space(&self) -> Result<Vec<SparseVector>, SolveError> {
        let mut has_pivot = vec![false; self.columns];
        let mut users: Vec<Vec<usize>> = vec![Vec::new(); self.columns];
        for (k, (&(_, column), upper)) in self.pivots.iter().zip(&self.upper).enumerate() {
            has_pivot[column] = true;
            for (c, _) in upper {
                users[*c].push(k);
            }
        }
        let mut values = vec![0.0; self.columns];
        let mut basis = Vec::new();
        let mut held = 0;
        for start in (0..self.columns).filter(|c| !has_pivot[*c]) {
            let mut reached = Reached::new();
            values[start] = 1.0;
            let mut entries = vec![start];
            reached.push_all(&users[start]);
            while let Some(k) = reached.pop() {
                let column = self.pivots[k].1;
                let sum: f64 = self.upper[k].iter().map(|(c, v)| v * values[*c]).sum();
                if sum.abs() > CANCELLED {
                    values[column] = -sum;
                    entries.push(column);
                    reached.push_all(&users[column]);
                }
            }
            held += entries.len();
            room::check("its motions without energy", held, MOST_NUMBERS / 4)?;
            entries.sort_unstable();
            let take = |c| (c, std::mem::take(&mut values[c]));
            basis.push(entries.into_iter().map(take).collect());
        }
        Ok(basis)
    }

    /// The combination of rows that is zero: 1 on a redundant row, the rest on rows with pivots.
    pub fn dependence(&self, redundant: usize) -> SparseVector {
        let mut entries = vec![(redundant, 1.0)];
        let mut reached = Reached::new();
        let mut weights: HashMap<usize, f64> = HashMap::new();
        let mut last = Some((redundant, 1.0));
        while let Some((row, weight)) = last {
            for (k, multiple) in &self.lower[row] {
                *weights.entry(*k).or_insert(0.0) -= weight * multiple;
                reached.push_all(&[*k]);
            }
            last = None;
            while let Some(k) = reached.pop() {
                let weight = weights.remove(&k).unwrap_or_default();
                if weight.abs() > CANCELLED {
                    last = Some((self.pivots[k].0, weight));
                    entries.extend(last);
                    break;
                }
            }
        }
        entries.sort_unstable_by_key(|(row, _)| *row);
        entries
    }
}

/// Pivots reached by a vector, to be taken from the last to the first, each once.
struct Reached(BinaryHeap<usize>);

impl Reached {
    fn new() -> Self {
        Self(BinaryHeap::new())
    }

    fn push_all(&mut self, pivots: &[usize]) {
        self.0.extend(pivots);
    }

    fn pop(&mut self) -> Option<usize> {
        let last = self.0.pop()?;
        while self.0.peek() == Some(&last) {
            self.0.pop();
        }
        Some(last)
    }
}

/// Rows under elimination.
struct Front {
    rows: Vec<SparseVector>,
    /// Rows with an entry in each column; some may have lost it, some stand there twice.
    users: Vec<Vec<usize>>,
    /// Whether a row has no pivot yet.
    active: Vec<bool>,
    /// Active rows by length; entries of another length are out of date.
    queue: BinaryHeap<Reverse<(usize, usize)>>,
    /// Levels of the columns, and the last one that takes pivots.
    level_of: Vec<usize>,
    level: usize,
    pivots: Vec<(usize, usize)>,
    values: Vec<f64>,
    upper: Vec<SparseVector>,
    lower: Vec<SparseVector>,
    doubtful: Option<f64>,
    /// The row that is being formed.
    formed: SparseVector,
}

impl Front {
    fn new(rows: Vec<SparseVector>, level_of: Vec<usize>) -> Self {
        let mut users = vec![Vec::new(); level_of.len()];
        for (r, row) in rows.iter().enumerate() {
            for (c, _) in row {
                users[*c].push(r);
            }
        }
        Self {
            users,
            active: vec![true; rows.len()],
            queue: BinaryHeap::new(),
            level_of,
            level: 0,
            pivots: Vec::new(),
            values: Vec::new(),
            upper: Vec::new(),
            lower: vec![Vec::new(); rows.len()],
            doubtful: None,
            formed: Vec::new(),
            rows,
        }
    }

    /// Takes all pivots above a size that the level allows, larger ones first.
    fn reduce(&mut self, least: f64) {
        let mut step = 1.0;
        while step > least {
            step = f64::max(step * STEP, least);
            self.refill();
            while let Some(row) = self.shortest(step) {
                let (row, column) = self.rook(row);
                self.eliminate(row, column);
            }
        }
    }

    /// Active rows, ascending.
    fn left(&self) -> Vec<usize> {
        (0..self.rows.len()).filter(|r| self.active[*r]).collect()
    }

    /// Puts all active rows in the queue.
    fn refill(&mut self) {
        let rows = self.left().into_iter();
        self.queue = rows.map(|r| Reverse((self.rows[r].len(), r))).collect();
    }

    /// Takes the shortest active row with an entry above `least` from the queue; rows with
    /// smaller entries only leave it until they change, or it is filled again.
    fn shortest(&mut self, least: f64) -> Option<usize> {
        while let Some(Reverse((length, row))) = self.queue.pop() {
            let current = self.active[row] && self.rows[row].len() == length;
            if current && self.largest(row) > least {
                return Some(row);
            }
        }
        None
    }

    /// A pivot in `row`, in the shortest column that allows one, or in a row that has a larger
    /// entry in one of its columns.
    fn rook(&mut self, mut row: usize) -> (usize, usize) {
        loop {
            let least = THRESHOLD * self.largest(row);
            let large = self.open(row).filter(|(_, v)| v.abs() >= least);
            let mut candidates: Vec<(usize, usize, f64)> = large
                .map(|(column, value)| (self.users[column].len(), column, value.abs()))
                .collect();
            candidates.sort_unstable_by_key(|&(count, column, _)| (count, column));
            let mut other = (row, 0.0);
            for (_, column, size) in candidates {
                self.tidy(column);
                let (larger, most) = self.largest_in(column);
                if size >= THRESHOLD * most {
                    return (row, column);
                }
                if most > other.1 {
                    other = (larger, most);
                }
            }
            // Sizes grow from step to step, so that this ends.
            self.queue.push(Reverse((self.rows[row].len(), row)));
            row = other.0;
        }
    }

    /// The entries of a row that may be pivots.
    fn open(&self, row: usize) -> impl Iterator<Item = (usize, f64)> {
        let entries = self.rows[row].iter().copied();
        entries.filter(|(column, _)| self.level_of[*column] <= self.level)
    }

    /// Size of the largest entry of a row that may be a pivot.
    fn largest(&self, row: usize) -> f64 {
        self.open(row).fold(0.0, |most, (_, v)| v.abs().max(most))
    }

    /// Drops the rows that have no entry in a column any more.
    fn tidy(&mut self, column: usize) {
        let mut users = std::mem::take(&mut self.users[column]);
        users.sort_unstable();
        users.dedup();
        users.retain(|r| self.active[*r] && entry(&self.rows[*r], column).is_some());
        self.users[column] = users;
    }

    /// The row with the largest entry of a tidy column, and the entry's size.
    fn largest_in(&self, column: usize) -> (usize, f64) {
        let mut best = (0, 0.0);
        for &row in &self.users[column] {
            let size = entry(&self.rows[row], column).unwrap_or_default().abs();
            if size > best.1 {
                best = (row, size);
            }
        }
        best
    }

    /// Takes a pivot: eliminates its column from all other active rows.
    fn eliminate(&mut self, row: usize, column: usize) {
        self.active[row] = false;
        let mut own = std::mem::take(&mut self.rows[row]);
        let place = own.partition_point(|(c, _)| *c < column);
        let (_, pivot) = own.remove(place);
        if pivot.abs() < DOUBTFUL.end {
            self.doubtful = Some(self.doubtful.map_or(pivot.abs(), |d| d.max(pivot.abs())));
        }
        let k = self.pivots.len();
        for user in std::mem::take(&mut self.users[column]) {
            if user == row {
                continue;
            }
            let Some(value) = entry(&self.rows[user], column) else {
                continue;
            };
            let multiple = value / pivot;
            self.lower[user].push((k, multiple));
            self.subtract(user, column, &own, multiple);
            self.queue.push(Reverse((self.rows[user].len(), user)));
        }
        for (_, value) in &mut own {
            *value /= pivot;
        }
        self.pivots.push((row, column));
        self.values.push(pivot);
        self.upper.push(own);
    }

    /// Takes a multiple of a pivot's row from a row, which loses the pivot's column.
    fn subtract(&mut self, row: usize, column: usize, other: &[(usize, f64)], multiple: f64) {
        let mut others = other.iter().peekable();
        self.formed.clear();
        let own = std::mem::take(&mut self.rows[row]);
        for &(c, value) in &own {
            while let Some(&(fill, v)) = others.next_if(|(o, _)| *o < c) {
                self.fill(row, fill, -multiple * v);
            }
            let value = match others.next_if(|(o, _)| *o == c) {
                Some((_, v)) => value - multiple * v,
                None => value,
            };
            if c != column && value.abs() > CANCELLED {
                self.formed.push((c, value));
            }
        }
        for &(fill, v) in others {
            self.fill(row, fill, -multiple * v);
        }
        let formed = std::mem::replace(&mut self.formed, own);
        self.rows[row] = formed;
    }

    /// Adds an entry that the formed row did not have.
    fn fill(&mut self, row: usize, column: usize, value: f64) {
        if value.abs() > CANCELLED {
            self.users[column].push(row);
            self.formed.push((column, value));
        }
    }
}

/// Size of the largest entry of a row.
fn largest(row: &[(usize, f64)]) -> f64 {
    row.iter().fold(0.0, |largest, (_, v)| v.abs().max(largest))
}

/// The entry of a row in a column.
fn entry(row: &[(usize, f64)], column: usize) -> Option<f64> {
    let place = row.binary_search_by_key(&column, |(c, _)| *c).ok()?;
    Some(row[place].1)
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::rank::dense::Elimination;

    /// Numbers between −1 and 1, the same in every run.
    struct Numbers(u64);

    impl Numbers {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
            self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }

        fn below(&mut self, count: usize) -> usize {
            ((self.next() + 1.0) / 2.0 * count as f64) as usize % count
        }
    }

    fn sparse(matrix: &DMatrix<f64>) -> Vec<SparseVector> {
        let rows = matrix.row_iter();
        rows.map(|row| {
            let entries = row.iter().copied().enumerate();
            entries.filter(|(_, v)| *v != 0.0).collect()
        })
        .collect()
    }

    fn full(vector: &[(usize, f64)], length: usize) -> DVector<f64> {
        let mut full = DVector::zeros(length);
        for (k, v) in vector {
            full[*k] = *v;
        }
        full
    }

    /// Unit rows of few entries, many of them combinations of others.
    fn conditions(numbers: &mut Numbers, rows: usize, columns: usize) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(rows, columns);
        for r in 0..rows {
            if r > 3 && numbers.next() > 0.0 {
                for _ in 0..3 {
                    let (other, factor) = (numbers.below(r), numbers.next());
                    let share = matrix.row(other) * factor;
                    let mut row = matrix.row_mut(r);
                    row += share;
                }
            } else {
                for _ in 0..4 {
                    let value = [1.0, -1.0, numbers.next()][numbers.below(3)];
                    matrix[(r, numbers.below(columns))] = value;
                }
            }
            let norm = matrix.row(r).norm();
            if norm > 1e-3 {
                matrix.row_mut(r).unscale_mut(norm);
            } else {
                matrix.row_mut(r).fill(0.0);
            }
        }
        matrix
    }

    #[test]
    fn it_finds_what_complete_pivoting_finds() {
        let mut numbers = Numbers(7);
        for case in 0..200 {
            let (rows, columns) = (1 + numbers.below(60), 1 + numbers.below(60));
            let matrix = conditions(&mut numbers, rows, columns);
            let dense = Elimination::new(matrix.clone(), 0);
            let found = SparseElimination::new(sparse(&matrix), columns);
            if dense.doubtful.is_some() || found.doubtful.is_some() {
                continue;
            }
            assert_eq!(found.rank(), dense.rank(), "case {case}");
            let basis = found.null_space().expect("few entries");
            assert_eq!(basis.len(), columns - found.rank());
            for vector in &basis {
                let left = &matrix * full(vector, columns);
                assert!(left.amax() < 1e-10, "case {case}: {}", left.amax());
            }
            assert_eq!(found.redundant.len(), rows - found.rank());
            for &row in &found.redundant {
                let weights = found.dependence(row);
                assert!(weights.contains(&(row, 1.0)));
                let left = matrix.transpose() * full(&weights, rows);
                assert!(left.amax() < 1e-10, "case {case}: {}", left.amax());
            }
        }
    }

    #[test]
    fn basis_vectors_are_independent() {
        let mut numbers = Numbers(11);
        let matrix = conditions(&mut numbers, 20, 40);
        let found = SparseElimination::new(sparse(&matrix), 40);
        let columns: Vec<usize> = found.pivot_columns().collect();
        for vector in found.null_space().expect("few entries") {
            let free = vector.iter().filter(|(c, _)| !columns.contains(c));
            assert_eq!(free.count(), 1);
        }
    }

    #[test]
    fn small_pivots_come_last_and_are_doubtful() {
        let rows = vec![vec![(0, 3e-8), (1, 3e-8)], vec![(0, 1.0), (1, -1.0)]];
        let found = SparseElimination::new(rows.clone(), 2);
        assert_eq!((found.rank(), found.redundant.clone()), (1, vec![0]));
        assert!(found.doubtful.is_some_and(|d| (d - 6e-8).abs() < 1e-9));
        let rows = vec![vec![(0, 3e-5), (1, 3e-5)], rows[1].clone()];
        let found = SparseElimination::new(rows.clone(), 2);
        assert_eq!(found.rank(), 2);
        assert!(found.doubtful.is_some());
        let without = SparseElimination::without_doubtful(rows, 2);
        assert_eq!(
            without.null_space().expect("few entries"),
            [vec![(0, 1.0), (1, 1.0)]]
        );
    }

    #[test]
    fn a_chain_of_a_hundred_thousand_is_eliminated_without_fill() {
        let count = 100_000;
        let links = (1..count).map(|k| vec![(k - 1, 0.6), (k, -0.8)]);
        let twice = links.clone().chain(links).collect();
        let found = SparseElimination::new(twice, count);
        assert_eq!(found.rank(), count - 1);
        assert_eq!(found.redundant.len(), count - 1);
        assert!(found.upper.iter().all(|row| row.len() <= 1));
        assert_eq!(found.dependence(found.redundant[7]).len(), 2);
    }
}
