//! Writes a lattice of NX × NY × NZ nodes as a mechanism file to standard output:
//! `cargo run --release -p hyperstat-tests --example lattice -- 20 20 20 > lattice.ron`; with
//! `--joints` one of many bodies, joined by hinges and bushings.

use std::error::Error;

use hyperstat_mechanisms::{Registry, write};
use hyperstat_tests::lattice::{jointed_lattice, lattice};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let joints = arguments.iter().any(|a| a == "--joints");
    arguments.retain(|a| a != "--joints");
    let counts: Vec<usize> = arguments
        .iter()
        .map(|a| a.parse())
        .collect::<Result<_, _>>()?;
    let [nx, ny, nz] = counts[..] else {
        return Err("usage: lattice NX NY NZ [--joints]".into());
    };
    if nx == 0 || ny == 0 || nz < 2 {
        return Err("a lattice has a node along x and y and two along z at least".into());
    }
    let model = if joints {
        jointed_lattice(nx, ny, nz)
    } else {
        lattice(nx, ny, nz)
    };
    print!("{}", write(&model, &Registry::builtin())?);
    Ok(())
}
