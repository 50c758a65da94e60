//! Property tests over the same random cases in every run.

use proptest::strategy::Strategy;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestRng, TestRunner};

/// Runs `check` over this many cases; returns how many of them count, as `check` says.
///
/// # Panics
/// With the smallest case that `check` found an error in.
pub fn check_all<S: Strategy>(
    cases: u32,
    strategy: S,
    check: impl Fn(S::Value) -> Result<bool, TestCaseError>,
) -> u32 {
    let config = Config {
        cases,
        max_global_rejects: 100_000 + 10 * cases,
        failure_persistence: None,
        ..Config::default()
    };
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(config, rng);
    let counted = std::cell::Cell::new(0u32);
    let outcome = runner.run(&strategy, |case| {
        counted.set(counted.get() + u32::from(check(case)?));
        Ok(())
    });
    if let Err(error) = outcome {
        panic!("{error}");
    }
    counted.get()
}
