# What CI runs, by parts. `just --list` shows all.

# All tests
test:
    cargo test --workspace

# Tests of one crate: just test-crate joints
test-crate name:
    cargo test -p hyperstat-{{name}}

# Formatting and lints, warnings are errors
lint:
    cargo fmt --all --check
    cargo clippy --workspace --all-targets -- -D warnings

# Put formatting right
fmt:
    cargo fmt --all

# Rustdoc, warnings are errors
doc:
    RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps

# The book as pages, in target/book (needs mdbook), with the playground where `just web` has made it
book:
    mdbook build docs
    test ! -f web/dist/playground.html || cp web/dist/playground.html target/book/

# Benches, each beside its baseline, and what they measured as tables
bench:
    cargo bench -p hyperstat-benches
    cargo run --release -p hyperstat-benches --bin ratios

# What one core of this machine can do at most
peak:
    cargo run --release -p hyperstat-benches --bin peak

# The Python package with its tests, in a folder of packages of its own (target/python)
python:
    python3 -m venv target/python
    CARGO_TARGET_DIR="$PWD/target" target/python/bin/pip -q install "./crates/python[test]"
    target/python/bin/python -m pytest crates/python/tests

# The page of `hyperstat view` and the core that answers in it, in web/dist (needs Node; says what it misses)
web:
    bash crates/web/build

# What browsers are shown, tested in one (needs `just web` and Chromium)
web-test:
    npm test --prefix web

# The README's main command
paper:
    cargo run --release -- run examples/paper.ron --out out

# All fuzz targets, for so many seconds in total (needs nightly Rust and cargo-fuzz)
fuzz seconds="3600":
    bash fuzz/run.sh {{seconds}}

# Everything that CI runs
ci:
    bash .ci/run
