//! Draws the book's sketches anew: `cargo run -p hyperstat-tests --example sketches`, from anywhere.

use std::fs;
use std::path::Path;

fn main() -> std::io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/src/images");
    for (name, document) in hyperstat_tests::sketches::sketches() {
        fs::write(folder.join(name), document)?;
        println!("wrote docs/src/images/{name}");
    }
    Ok(())
}
