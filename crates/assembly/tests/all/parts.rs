//! What several tests build with.

use hyperstat_elements::{Section, SectionShape};

/// A bar of 20 × 30 mm.
pub fn flat() -> Section {
    let shape = SectionShape::Rectangle {
        width: 0.02,
        height: 0.03,
    };
    Section::new(shape, None, None).expect("a section")
}
