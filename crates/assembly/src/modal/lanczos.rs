//! The lowest modes of a large sparse pair of matrices: block Lanczos with the inverse of the
//! stiffness and full reorthogonalization in the mass (Golub and Underwood 1977; Ericsson and
//! Ruhe 1980).
//!
//! All vectors of the basis are made by the inverse of the stiffness from masses times vectors, so
//! that coordinates without mass follow the others and infinite frequencies never appear.

use nalgebra::{DMatrix, SymmetricEigen};

use super::mode::Counted;
use super::system::{EQUAL, Mode, System};
use crate::error::SolveError;
use crate::plan::blocks::{dot, subtract};

/// Vectors of a block.
pub(super) const BLOCK: usize = 4;
/// A Ritz pair has converged whose residual is below this part of it; its eigenvalue is then good
/// to about the square.
const CONVERGED: f64 = 1e-11;
/// The same where nothing but eigenvalues is asked for.
const SETTLED: f64 = 2e-9;
/// The same for those beyond, which only tell where there is room to count.
const ROUGH: f64 = 1e-2;
/// A vector of which no more than this part is left beside the basis lies in it.
const DEPENDENT: f64 = 1e-12;
/// Ritz values below this part of the largest are rounding.
const ROUNDING: f64 = 1e-14;
/// Eigenvalues that differ by no more than this part leave no room to count between them.
const NO_ROOM: f64 = 1e-5;
/// It is counted no farther than this factor above the last of them, which is room enough.
const ROOM: f64 = 1.1;
/// Vectors of a basis at the most, beside ten for every mode.
const MOST_VECTORS: usize = 500;
/// Times that modes are looked for again.
const MOST_ROUNDS: usize = 8;

/// The lowest modes, lowest first.
pub(super) struct Lowest {
    pub modes: Vec<Mode>,
    /// Whether the number of eigenvalues below says that none is missing.
    pub complete: bool,
    /// How many there are below which eigenvalue.
    pub counted: Option<Counted>,
}

/// Finds the `count` lowest modes; fewer where there are no more. `shapes`: vectors to rounding, and those
/// modes too that equal the last; else only so closely that eigenvalues are, by solutions that are not
/// refined. `start`: vectors that are near them, if any are known.
pub(super) fn lowest(
    system: &mut System<'_>,
    count: usize,
    shapes: bool,
    start: &[Vec<f64>],
) -> Result<Lowest, SolveError> {
    let mut basis = Basis {
        count,
        shapes,
        start,
        ..Basis::default()
    };
    if system.size() == 0 {
        return Ok(Lowest {
            modes: Vec::new(),
            complete: true,
            counted: None,
        });
    }
    // No more than there are.
    let count = count.min(system.size());
    let mut wanted = count + 2;
    let (mut complete, mut of_count) = (false, None);
    for _ in 0..MOST_ROUNDS {
        let all = basis.grow(system, wanted)?;
        if all {
            complete = true;
            break;
        }
        let values = basis.eigenvalues(wanted);
        // Counted is after the last that is wanted, where there is room enough; else where the most is.
        let room = |k: usize| (values[k] / values[k - 1]).min(ROOM * ROOM) - 1.0;
        let places = (count..values.len()).rev();
        let best = places.max_by(|a, b| room(*a).total_cmp(&room(*b)));
        let Some(below) = best.filter(|k| room(*k) > NO_ROOM) else {
            wanted += count + BLOCK;
            continue;
        };
        let limit = values[below - 1] * (1.0 + room(below)).sqrt();
        match system.count_below(limit) {
            // One of several equal modes that no vector so far had a part in.
            Some(counted) if counted > below => {
                wanted += counted - below;
                basis.add_random(system);
            }
            counted => {
                complete = counted == Some(below);
                of_count = counted.map(|modes| Counted {
                    below: limit,
                    modes,
                    found: below,
                });
                break;
            }
        }
    }
    let modes = basis.modes(system, count, wanted);
    Ok(Lowest {
        modes,
        complete,
        counted: of_count,
    })
}

/// A basis, orthonormal in the mass, and the inverse of the stiffness times mass in it.
#[derive(Default)]
struct Basis<'a> {
    vectors: Vec<Vec<f64>>,
    /// Mass times each of them.
    mass_vectors: Vec<Vec<f64>>,
    /// Inverse of the stiffness times mass times each of the first of them.
    images: Vec<Vec<f64>>,
    /// What of the last images is outside the vectors of their time.
    outside: Vec<f64>,
    /// The operator among the vectors that have images, by rows of the lower triangle.
    projected: Vec<Vec<f64>>,
    /// Ritz values and vectors of the basis as it is, largest first.
    pairs: Vec<(f64, Vec<f64>)>,
    seed: u64,
    /// Number of modes that are wanted, and whether their vectors are.
    count: usize,
    shapes: bool,
    /// What is begun with in place of random vectors.
    start: &'a [Vec<f64>],
}

impl Basis<'_> {
    /// Grows until `wanted` Ritz pairs have converged; returns whether the basis has come to hold
    /// all modes of finite frequency.
    fn grow(&mut self, system: &mut System<'_>, wanted: usize) -> Result<bool, SolveError> {
        loop {
            if self.images.len() == self.vectors.len() && !self.add_random(system) {
                return Ok(true);
            }
            if self.vectors.len() > MOST_VECTORS + 10 * wanted {
                return Err(SolveError::ModesNotFound {
                    found: self.converged(wanted),
                });
            }
            self.step(system)?;
            if self.images.len() >= wanted && self.converged(wanted) >= wanted {
                return Ok(false);
            }
        }
    }

    /// Finds the images of the vectors that have none, and appends what is new in them.
    fn step(&mut self, system: &mut System<'_>) -> Result<(), SolveError> {
        let block = self.images.len()..self.vectors.len();
        let images = system.solve(&self.mass_vectors[block.clone()], self.shapes)?;
        self.outside.clear();
        let mut rests = Vec::with_capacity(images.len());
        for (row, mut image) in block.clone().zip(images) {
            system.remove_free(&mut image);
            let entries = self.mass_vectors[..=row].iter();
            self.projected
                .push(entries.map(|vector| dot(vector, &image)).collect());
            rests.push(image.clone());
            self.images.push(image);
        }
        for rest in rests {
            let outside = self.append(system, rest);
            self.outside.push(outside);
        }
        // Those of a small basis do not tell much yet.
        if self.images.len() >= self.count + 3 * BLOCK || self.images.len() == self.vectors.len() {
            self.pairs = self.ritz();
        }
        Ok(())
    }

    /// Appends a vector without its part in the basis, unless nothing is left; returns the length
    /// of what is left.
    fn append(&mut self, system: &System<'_>, mut vector: Vec<f64>) -> f64 {
        // The length of the whole; where there are no motions without energy, parts add to it as well.
        let whole = match self.shapes || system.has_free() {
            true => system.length(&vector),
            false => 0.0,
        };
        let mut inside = 0.0;
        for _ in 0..if self.shapes { 2 } else { 1 } {
            system.remove_free(&mut vector);
            for (own, mass_own) in self.vectors.iter().zip(&self.mass_vectors) {
                let share = dot(mass_own, &vector);
                inside += share * share;
                subtract(&mut vector, share, own);
            }
        }
        let mut mass_vector = system.mass_times(&vector);
        let length = dot(&vector, &mass_vector).max(0.0).sqrt();
        if length > DEPENDENT * whole.max(length.hypot(inside.sqrt())) {
            for value in vector.iter_mut().chain(&mut mass_vector) {
                *value /= length;
            }
            self.mass_vectors.push(mass_vector);
            self.vectors.push(vector);
        }
        length
    }

    /// Appends a random block; returns whether there was anything new in it.
    fn add_random(&mut self, system: &mut System<'_>) -> bool {
        let before = self.vectors.len();
        let near = std::mem::take(&mut self.start);
        let random = (0..BLOCK).map(|k| match near.get(k) {
            Some(near) => system.mass_times(near),
            None => {
                let free = (0..system.size()).map(|_| random(&mut self.seed));
                system.mass_times(&free.collect::<Vec<f64>>())
            }
        });
        let random: Vec<Vec<f64>> = random.collect();
        // Numbers that overflow end in a basis that grows no more.
        let Ok(images) = system.solve(&random, self.shapes) else {
            return false;
        };
        for image in images {
            self.append(system, image);
        }
        self.vectors.len() > before
    }

    /// Ritz values and vectors, largest first.
    fn ritz(&self) -> Vec<(f64, Vec<f64>)> {
        let count = self.projected.len();
        if count == 0 {
            return Vec::new();
        }
        let entry = |r: usize, c: usize| self.projected[r.max(c)][r.min(c)];
        let eigen = SymmetricEigen::new(DMatrix::from_fn(count, count, entry));
        let columns = eigen.eigenvectors.column_iter();
        let mut pairs: Vec<(f64, Vec<f64>)> = eigen
            .eigenvalues
            .iter()
            .zip(columns)
            .map(|(value, column)| (*value, column.iter().copied().collect()))
            .collect();
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
        let least = pairs.first().map_or(0.0, |first| ROUNDING * first.0);
        pairs.retain(|(value, _)| *value > least);
        pairs
    }

    /// How many of the first `wanted` Ritz pairs have converged, up to the first that has not.
    fn converged(&self, wanted: usize) -> usize {
        let last = self.images.len() - self.outside.len();
        let pairs = self.pairs.iter().take(wanted).enumerate();
        let converged = pairs.take_while(|(k, (value, weights))| {
            if weights.len() != self.images.len() {
                return false;
            }
            let parts = weights[last..].iter().zip(&self.outside);
            let residual: f64 = parts.map(|(weight, rest)| weight.abs() * rest).sum();
            let enough = match self.shapes {
                true => CONVERGED,
                false if *k < self.count => SETTLED,
                false => ROUGH,
            };
            residual <= enough * value
        });
        converged.count()
    }

    /// The lowest eigenvalues of stiffness and mass.
    fn eigenvalues(&self, wanted: usize) -> Vec<f64> {
        self.pairs.iter().take(wanted).map(|p| 1.0 / p.0).collect()
    }

    /// The lowest modes; with shapes also those of the first `converged` that equal the last.
    fn modes(&self, system: &System<'_>, mut count: usize, converged: usize) -> Vec<Mode> {
        let is_equal = |k: usize| match self.pairs.get(k - 1..=k) {
            Some([(last, _), (next, _)]) => last - next <= EQUAL * last,
            _ => false,
        };
        while self.shapes && count > 0 && count < converged && is_equal(count) {
            count += 1;
        }
        let modes = self.pairs.iter().take(count).map(|(_, weights)| {
            let mut vector = vec![0.0; system.size()];
            let mut image = vector.clone();
            for (k, weight) in weights.iter().enumerate() {
                subtract(&mut vector, -weight, &self.vectors[k]);
                subtract(&mut image, -weight, &self.images[k]);
            }
            system.mode(vector, &image)
        });
        let mut modes: Vec<Mode> = modes.collect();
        modes.sort_by(|a, b| a.eigenvalue.total_cmp(&b.eigenvalue));
        modes
    }
}

/// A number from −1 to 1 (Steele, Lea and Flood 2014, SplitMix64): the same in every run.
pub(super) fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *seed;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}
