//! Sparse symmetric factorization: the only module that names faer.
//!
//! [`Pattern`] is worked out once a topology: structure, fill-reducing order (minimum degree, or
//! nested dissection where that takes fewer operations) and symbolic Cholesky. [`Factor`] holds
//! the buffers of one thread; factoring and solving allocate nothing.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLdltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side, Spec};
use nalgebra::Point3;

use crate::error::SolveError;
use crate::rank::dissection::nested_dissection;
use crate::room;
use crate::room::MOST_FACTORED;

/// What asks for too much room where the factor fills.
const FACTOR: &str = "the factors of its stiffness matrix";

/// From this number of coordinates on, nested dissection is tried too.
const LARGE: usize = 5_000;

/// Structure of a symmetric matrix (lower triangle by columns) and of its factor.
#[derive(Debug)]
pub(crate) struct Pattern {
    size: usize,
    column_starts: Vec<usize>,
    rows: Vec<usize>,
    symbolic: Option<SymbolicCholesky<usize>>,
}

/// Factor and scratch memory of one thread.
pub(crate) struct Factor {
    values: Vec<f64>,
    scratch: MemBuffer,
}

impl std::fmt::Debug for Factor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Factor")
            .field("values", &self.values.len())
            .finish_non_exhaustive()
    }
}

/// The matrix is not positive definite to working precision.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct NotPositive;

impl Pattern {
    /// The pattern that couples all coordinates within each of `groups` (indices below `size`,
    /// ascending within a group); every diagonal entry is present. `places`, where they
    /// are known: the node that each coordinate belongs to, and the nodes' positions.
    ///
    /// # Errors
    /// A factor too large for memory.
    pub fn new<'a>(
        size: usize,
        groups: impl Iterator<Item = &'a [usize]>,
        places: Option<(&[usize], &[Point3<f64>])>,
    ) -> Result<Self, SolveError> {
        let mut columns: Vec<Vec<usize>> = (0..size).map(|k| vec![k]).collect();
        for group in groups {
            for (k, &column) in group.iter().enumerate() {
                columns[column].extend_from_slice(&group[k + 1..]);
            }
        }
        let mut column_starts = Vec::with_capacity(size + 1);
        let mut rows = Vec::new();
        column_starts.push(0);
        for mut column in columns {
            column.sort_unstable();
            column.dedup();
            rows.append(&mut column);
            column_starts.push(rows.len());
        }
        let symbolic = if size == 0 {
            None
        } else {
            let structure =
                SymbolicSparseColMatRef::new_checked(size, size, &column_starts, None, &rows);
            let factor = |order: SymmetricOrdering<'_, usize>| {
                let params = CholeskySymbolicParams::default();
                let found = factorize_symbolic_cholesky(structure, Side::Lower, order, params);
                // It overflows, or there is no room for the structure alone.
                found.map_err(|_| SolveError::TooLarge {
                    what: FACTOR,
                    numbers: usize::MAX,
                    limit: MOST_FACTORED,
                })
            };
            let mut best = factor(SymmetricOrdering::Amd)?;
            if let Some((nodes, positions)) = places.filter(|_| size >= LARGE) {
                let order = dissected(&column_starts, &rows, nodes, positions);
                let mut inverse = vec![0; size];
                for (place, &coordinate) in order.iter().enumerate() {
                    inverse[coordinate] = place;
                }
                let order = PermRef::new_checked(&order, &inverse, size);
                let other = factor(SymmetricOrdering::Custom(order))?;
                if operations(&other) < operations(&best) {
                    best = other;
                }
            }
            room::check(FACTOR, best.len_val(), MOST_FACTORED)?;
            Some(best)
        };
        Ok(Self {
            size,
            column_starts,
            rows,
            symbolic,
        })
    }

    /// Number of stored values (lower triangle).
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Place of entry (row, column), row ≥ column, in the values; it must be in the pattern.
    pub fn place(&self, row: usize, column: usize) -> usize {
        let range = self.column_starts[column]..self.column_starts[column + 1];
        match self.rows[range.clone()].binary_search(&row) {
            Ok(k) => range.start + k,
            Err(_) => unreachable!("entry ({row}, {column}) is not in the pattern"),
        }
    }

    /// Diagonal entry of column `k`.
    pub fn diagonal(&self, k: usize, values: &[f64]) -> f64 {
        values[self.column_starts[k]]
    }

    /// Makes row and column `k` of `values` those of `scale` times the identity.
    pub fn pin(&self, k: usize, scale: f64, values: &mut [f64]) {
        for column in 0..=k {
            let range = self.column_starts[column]..self.column_starts[column + 1];
            if let Ok(place) = self.rows[range.clone()].binary_search(&k) {
                values[range.start + place] = 0.0;
            }
        }
        let own = self.column_starts[k];
        values[own..self.column_starts[k + 1]].fill(0.0);
        values[own] = scale;
    }

    /// Buffers for one thread and up to `columns` right-hand sides.
    pub fn factor_buffers(&self, columns: usize) -> Factor {
        let length = self.symbolic.as_ref().map_or(0, |s| s.len_val());
        Factor {
            values: vec![0.0; length],
            scratch: self.scratch(columns),
        }
    }

    /// Makes room for up to `columns` right-hand sides; what is factored stays.
    pub fn make_room(&self, factor: &mut Factor, columns: usize) {
        factor.scratch = self.scratch(columns);
    }

    fn scratch(&self, columns: usize) -> MemBuffer {
        MemBuffer::new(match &self.symbolic {
            None => faer::dyn_stack::StackReq::EMPTY,
            Some(symbolic) => symbolic
                .factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default())
                .or(symbolic.solve_in_place_scratch::<f64>(columns, Par::Seq)),
        })
    }

    /// Cholesky factorization of `values`.
    pub fn factorize(&self, values: &[f64], factor: &mut Factor) -> Result<(), NotPositive> {
        let Some(symbolic) = &self.symbolic else {
            return Ok(());
        };
        let structure = SymbolicSparseColMatRef::new_checked(
            self.size,
            self.size,
            &self.column_starts,
            None,
            &self.rows,
        );
        symbolic
            .factorize_numeric_llt(
                &mut factor.values,
                SparseColMatRef::new(structure, values),
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut factor.scratch),
                Spec::default(),
            )
            .map(|_| ())
            .map_err(|_| NotPositive)
    }

    /// Solves in place for the columns of `rhs` (column-major, `size` rows).
    pub fn solve(&self, factor: &mut Factor, rhs: &mut [f64]) {
        let Some(symbolic) = &self.symbolic else {
            return;
        };
        let columns = rhs.len() / self.size;
        LltRef::new(symbolic, &factor.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(rhs, self.size, columns),
            Par::Seq,
            MemStack::new(&mut factor.scratch),
        );
    }

    /// Adds the symmetric matrix of these values times `x` to `out`.
    pub fn add_product(&self, values: &[f64], x: &[f64], out: &mut [f64]) {
        for (column, x_column) in x.iter().enumerate() {
            let range = self.column_starts[column]..self.column_starts[column + 1];
            let mut sum = 0.0;
            for (row, value) in self.rows[range.clone()].iter().zip(&values[range]) {
                sum += value * x[*row];
                if *row != column {
                    out[*row] += value * x_column;
                }
            }
            out[column] += sum;
        }
    }

    /// Number of negative eigenvalues of a matrix, by the signs of the pivots of L D Lᵀ
    /// (Sylvester's law of inertia); `None` where a pivot is zero.
    pub fn negative_eigenvalues(&self, values: &[f64]) -> Option<usize> {
        let Some(symbolic) = &self.symbolic else {
            return Some(0);
        };
        let structure = SymbolicSparseColMatRef::new_checked(
            self.size,
            self.size,
            &self.column_starts,
            None,
            &self.rows,
        );
        let need = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Spec::default());
        let mut scratch = MemBuffer::new(need);
        let mut factor = vec![0.0; symbolic.len_val()];
        symbolic
            .factorize_numeric_ldlt(
                &mut factor,
                SparseColMatRef::new(structure, values),
                Side::Lower,
                LdltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut scratch),
                Spec::default(),
            )
            .ok()?;
        let pivots: Vec<f64> = match symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(columns) => {
                let starts = &columns.col_ptr()[..self.size];
                starts.iter().map(|start| factor[*start]).collect()
            }
            SymbolicCholeskyRaw::Supernodal(nodes) => {
                let whole = SupernodalLdltRef::new(nodes, &factor);
                let blocks = (0..nodes.n_supernodes()).map(|k| whole.supernode(k).val());
                blocks
                    .flat_map(|block| (0..block.ncols()).map(move |k| block[(k, k)]))
                    .collect()
            }
        };
        let sound = pivots
            .iter()
            .all(|pivot| pivot.is_finite() && *pivot != 0.0);
        sound.then(|| pivots.iter().filter(|pivot| **pivot < 0.0).count())
    }
}

/// The coordinates of a lower triangle in an order of nested dissection, those of a node together.
fn dissected(
    column_starts: &[usize],
    rows: &[usize],
    nodes: &[usize],
    positions: &[Point3<f64>],
) -> Vec<usize> {
    // The nodes that have coordinates are the vertices, in order of their first coordinate.
    let mut vertex_of = vec![usize::MAX; positions.len()];
    let mut coordinates: Vec<Vec<usize>> = Vec::new();
    let mut places = Vec::new();
    for (coordinate, &node) in nodes.iter().enumerate() {
        if vertex_of[node] == usize::MAX {
            vertex_of[node] = coordinates.len();
            coordinates.push(Vec::new());
            places.push(positions[node]);
        }
        coordinates[vertex_of[node]].push(coordinate);
    }
    let mut graph = vec![Vec::new(); coordinates.len()];
    for (column, range) in column_starts.windows(2).enumerate() {
        let vertex = vertex_of[nodes[column]];
        for &row in &rows[range[0]..range[1]] {
            let other = vertex_of[nodes[row]];
            if other != vertex {
                graph[vertex].push(other);
                graph[other].push(vertex);
            }
        }
    }
    for neighbours in &mut graph {
        neighbours.sort_unstable();
        neighbours.dedup();
    }
    let order = nested_dissection(&graph, &places).into_iter();
    order
        .flat_map(|vertex| std::mem::take(&mut coordinates[vertex]))
        .collect()
}

/// Multiplications, each with an addition, that a factorization takes, to leading order.
fn operations(symbolic: &SymbolicCholesky<usize>) -> f64 {
    match symbolic.raw() {
        SymbolicCholeskyRaw::Simplicial(factor) => {
            let starts = factor.col_ptr().windows(2);
            starts
                .map(|s| (s[1] - s[0]) as f64)
                .map(|h| h * h / 2.0)
                .sum()
        }
        SymbolicCholeskyRaw::Supernodal(factor) => {
            let widths = factor.supernode_begin().iter().zip(factor.supernode_end());
            let heights = factor.col_ptr_for_row_idx().windows(2);
            let blocks = widths.zip(heights);
            blocks
                .map(|((begin, end), starts)| {
                    let width = (end - begin) as f64;
                    let below = (starts[1] - starts[0]) as f64;
                    width * (width * width / 6.0 + width * below / 2.0 + below * below / 2.0)
                })
                .sum()
        }
    }
}
