//! The traditional method (Eqs. 48–50, 66) beside this one, on both case studies, for joint
//! stiffness from 10³ to 10¹⁸: prints the book's tables and draws its figure.
//!
//! `cargo run --release -p hyperstat-benches --bin traditional`, from anywhere.

mod figure;
mod measure;
mod number;
mod table;

use std::error::Error;
use std::fs;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let cases = [measure::single_freedom(), measure::delta()];
    for case in &cases {
        println!("{}", table::markdown(case));
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/src/images");
    fs::create_dir_all(&folder)?;
    fs::write(folder.join("traditional.svg"), figure::svg(&cases))?;
    eprintln!("wrote docs/src/images/traditional.svg");
    Ok(())
}
