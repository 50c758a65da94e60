//! What one core can do at most: fused multiply-adds of doubles in independent chains, for every
//! vector width that the processor has.
//!
//! `cargo run --release -p hyperstat-benches --bin peak`

use std::hint::black_box;
use std::time::{Duration, Instant};

use pulp::{Scalar128b, Simd, WithSimd};

/// Chains that do not wait for each other: more than a core has in flight (two units, four cycles
/// each), few enough for sixteen registers.
const CHAINS: usize = 12;
/// Links of every chain in one run, about a millisecond.
const LINKS: u32 = 200_000;
/// The fastest of so many runs counts: what disturbs a run makes it slower, never faster.
const RUNS: usize = 200;

/// All links of all chains, once.
type Run = Box<dyn Fn() -> f64>;

/// Every chain is x ← a x + b, again and again.
struct Chains {
    /// Multiplication and addition in one instruction.
    fused: bool,
}

impl WithSimd for Chains {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let a = simd.splat_f64s(black_box(0.999_999));
        let b = simd.splat_f64s(black_box(1e-6));
        let mut chains: [S::f64s; CHAINS] =
            std::array::from_fn(|k| simd.splat_f64s(1.0 + k as f64));
        for _ in 0..LINKS {
            for x in &mut chains {
                *x = if self.fused {
                    simd.mul_add_f64s(*x, a, b)
                } else {
                    simd.add_f64s(simd.mul_f64s(*x, a), b)
                };
            }
        }
        chains.into_iter().map(|x| simd.reduce_sum_f64s(x)).sum()
    }
}

fn main() {
    let mut widths: Vec<(&str, usize, Run)> = vec![(
        "without vector instructions beyond the target's, × and +",
        2,
        Box::new(|| Simd::vectorize(Scalar128b, Chains { fused: false })),
    )];
    #[cfg(target_arch = "x86_64")]
    {
        if let Some(simd) = pulp::x86::V3::try_new() {
            let run = move || Simd::vectorize(simd, Chains { fused: true });
            widths.push(("AVX2, FMA", 4, Box::new(run)));
        }
        if let Some(simd) = pulp::x86::V4::try_new() {
            let run = move || Simd::vectorize(simd, Chains { fused: true });
            widths.push(("AVX-512, FMA", 8, Box::new(run)));
        }
    }
    for (name, lanes, run) in widths {
        let times = (0..RUNS).map(|_| {
            let start = Instant::now();
            black_box(run());
            start.elapsed()
        });
        let fastest = times.min().unwrap_or(Duration::MAX);
        let operations = (2 * lanes * CHAINS) as f64 * f64::from(LINKS);
        println!(
            "{name}: {:.1} GFLOP/s",
            operations / fastest.as_secs_f64() / 1e9
        );
    }
}
