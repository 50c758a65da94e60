//! The book's sketches, this project's own drawing of the paper's Figs. 1–7: SVG documents by name.
//!
//! `cargo run -p hyperstat-tests --example sketches` writes them to `docs/src/images`; a test holds the
//! files to them.

mod canvas;
mod element;
mod joints;
mod mechanisms;

/// All sketches: the name of the file, and the document.
pub fn sketches() -> Vec<(&'static str, String)> {
    vec![
        ("sketch-general.svg", mechanisms::general()),
        ("sketch-method.svg", element::method()),
        ("sketch-subassembly.svg", element::subassembly()),
        ("sketch-joints.svg", joints::joints()),
        ("sketch-single-freedom.svg", mechanisms::single_freedom()),
        ("sketch-delta.svg", mechanisms::delta()),
        ("sketch-delta-open.svg", mechanisms::delta_open()),
    ]
}
