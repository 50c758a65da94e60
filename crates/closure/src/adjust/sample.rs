//! Configurations some way along the freedoms of a mechanism whose loops close only nearly.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::equations::{Goal, System};
use crate::linkage::Configuration;

/// Most that a coordinate of a joint moves on the way to a configuration (rad, or sizes of the mechanism).
const FAR: f64 = 0.3;
/// Parts of that way.
const PARTS: usize = 4;
/// Corrections after each part, and after the last one.
const STEPS: usize = 3;
const LAST_STEPS: usize = 8;

/// The motions of a mechanism at home: those along its freedoms, and those across.
#[derive(Debug)]
pub(super) struct Basis {
    pub along: DMatrix<f64>,
    pub across: DMatrix<f64>,
}

impl Basis {
    /// The first `count` of these motions are the freedoms.
    pub fn new(motions: &DMatrix<f64>, count: usize) -> Self {
        Self {
            along: motions.columns(0, count).into_owned(),
            across: motions.columns(count, motions.ncols() - count).into_owned(),
        }
    }

    /// A way along the freedoms, another one for every number.
    fn way(&self, number: usize) -> DVector<f64> {
        let shares = DVector::from_fn(self.along.ncols(), |k, _| scattered(number, k));
        let way = &self.along * shares;
        let most = way.amax();
        // Nearer and farther ones.
        let far = FAR * (0.5 + 0.5 * scattered(number, self.along.ncols()).abs());
        if most > 0.0 { way * (far / most) } else { way }
    }
}

/// Numbers from −1 to 1 that fill the cube of any dimension evenly (Kronecker's sequences of square
/// roots of primes).
fn scattered(number: usize, dimension: usize) -> f64 {
    const PRIMES: [f64; 12] = [2., 3., 5., 7., 11., 13., 17., 19., 23., 29., 31., 37.];
    let root = (PRIMES[dimension % 12] + 41.0 * (dimension / 12) as f64).sqrt();
    2.0 * ((number + 1) as f64 * root).fract() - 1.0
}

/// By how much loops stay open at the configurations of these numbers; `None` where one is not reached.
pub(super) fn opening(system: &System, basis: &Basis, numbers: Range<usize>) -> Option<f64> {
    let mut open: f64 = 0.0;
    for number in numbers {
        let misfit = Sample::placed(system, basis, number)?.misfit(system);
        open = misfit.iter().fold(open, |most, gap| most.max(gap.abs()));
    }
    Some(open)
}

/// A configuration whose place along the freedoms is given.
#[derive(Debug, Clone)]
pub(super) struct Sample {
    pub configuration: Configuration,
}

impl Sample {
    /// The configuration on the way of this number whose loops close as well as they do; `None` where
    /// they hold no way to it.
    pub fn placed(system: &System, basis: &Basis, number: usize) -> Option<Self> {
        let way = basis.way(number) / PARTS as f64;
        let mut sample = Self {
            configuration: system.linkage.home(),
        };
        for part in 1..=PARTS {
            sample.configuration = system.linkage.advanced(&sample.configuration, &way);
            let steps = if part == PARTS { LAST_STEPS } else { STEPS };
            for _ in 0..steps {
                let step = sample.least(system, basis)?;
                sample.configuration = system.linkage.advanced(&sample.configuration, &step);
                if step.amax() <= 1e-13 {
                    break;
                }
            }
        }
        let moved = sample.configuration.values.iter();
        moved.copied().all(f64::is_finite).then_some(sample)
    }

    /// The misfits of the loops.
    pub fn misfit(&self, system: &System) -> DVector<f64> {
        system.misfit(&self.configuration, &Goal::default())
    }

    /// The step across the freedoms after which the loops are closed best.
    fn least(&self, system: &System, basis: &Basis) -> Option<DVector<f64>> {
        let split = self.split(system, basis, &DMatrix::zeros(system.closing_rows(), 0))?;
        Some(split.step(basis, &DVector::zeros(0)))
    }

    /// The conditions of the loops, of which the derivatives by the geometry are `by_geometry`, split
    /// into those that the joints meet and those that the geometry alone can meet.
    pub fn split(
        &self,
        system: &System,
        basis: &Basis,
        by_geometry: &DMatrix<f64>,
    ) -> Option<Split> {
        let equations = system.equations(&self.configuration, &Goal::default());
        let across = &equations.jacobian * &basis.across;
        let (rows, columns) = across.shape();
        if rows < columns {
            return None;
        }
        let mut misfit = equations.misfit;
        let mut effect = by_geometry.clone();
        if columns == 0 {
            // Nothing moves across, and there is no decomposition of nothing.
            return Some(Split {
                shift: DVector::zeros(0),
                moved: DMatrix::zeros(0, effect.ncols()),
                misfit,
                effect,
            });
        }
        let factor = across.qr();
        factor.q_tr_mul(&mut misfit);
        factor.q_tr_mul(&mut effect);
        let inverse = factor.unpack_r().try_inverse()?;
        Some(Split {
            shift: -(&inverse * misfit.rows(0, columns)),
            moved: -(inverse * effect.rows(0, columns)),
            misfit: misfit.rows(columns, rows - columns).into_owned(),
            effect: effect.rows(columns, rows - columns).into_owned(),
        })
    }
}

/// Conditions of the loops at a configuration, the joints' coordinates eliminated.
#[derive(Debug)]
pub(super) struct Split {
    /// The step of the joints that closes the loops, and what the geometry adds to it.
    shift: DVector<f64>,
    moved: DMatrix<f64>,
    /// What no step of the joints closes, and what the geometry changes of it.
    pub misfit: DVector<f64>,
    pub effect: DMatrix<f64>,
}

impl Split {
    /// The step of the joints beside a change of the geometry.
    pub fn step(&self, basis: &Basis, change: &DVector<f64>) -> DVector<f64> {
        &basis.across * (&self.shift + &self.moved * change)
    }
}
