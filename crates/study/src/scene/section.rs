//! Outlines of sections.

use std::f64::consts::TAU;

use hyperstat_assembly::Segment;
use hyperstat_elements::{Section, SectionShape};
use serde::Serialize;

use crate::number::number;

/// Corners that a circle is drawn with.
const CORNERS: usize = 20;

/// A section as it is drawn.
#[derive(Debug, Clone, Serialize)]
pub struct SceneSection {
    /// `circle`, `tube`, `rectangle` or `general`.
    pub shape: &'static str,
    /// Its outline in local y and z \[m\], counter-clockwise seen from the end of local x, closed by its first
    /// point; of a general section the ellipse that is as wide as its moments of area say.
    pub outline: Vec<[f64; 2]>,
    /// The same of its hole, where it has one.
    pub hole: Option<Vec<[f64; 2]>>,
    /// What it is, in words.
    pub words: String,
}

/// The sections at the ends of a segment, whose outlines have the same number of points.
pub(super) fn sections(segment: &Segment) -> [SceneSection; 2] {
    let taper = segment.change_of_section().ok().flatten();
    let ends = match &taper {
        Some(taper) => [taper.from(), taper.to()],
        None => [&segment.section; 2],
    };
    ends.map(SceneSection::new)
}

impl SceneSection {
    fn new(section: &Section) -> Self {
        let ellipse = |y: f64, z: f64| -> Vec<[f64; 2]> {
            let corners = (0..CORNERS).map(|k| TAU * k as f64 / CORNERS as f64);
            let corner = |angle: f64| [y * angle.cos(), z * angle.sin()];
            corners.map(corner).collect()
        };
        let (shape, outline, hole, words) = match *section.shape() {
            SectionShape::Circle { diameter } => {
                let outline = ellipse(diameter / 2.0, diameter / 2.0);
                let words = format!("circle, diameter {} m", number(diameter));
                ("circle", outline, None, words)
            }
            SectionShape::Tube { outer, inner } => {
                let hole = (inner > 0.0).then(|| ellipse(inner / 2.0, inner / 2.0));
                let words = format!(
                    "tube, diameters {} m and {} m",
                    number(outer),
                    number(inner)
                );
                ("tube", ellipse(outer / 2.0, outer / 2.0), hole, words)
            }
            SectionShape::Rectangle { width, height } => {
                let (y, z) = (width / 2.0, height / 2.0);
                let words = format!("rectangle, {} m by {} m", number(width), number(height));
                let outline = vec![[y, -z], [y, z], [-y, z], [-y, -z]];
                ("rectangle", outline, None, words)
            }
            _ => {
                // A full ellipse of half axes a, b has I = A b²/4.
                let half = |moment: f64| 2.0 * (moment / section.area()).sqrt();
                let outline = ellipse(half(section.iz()), half(section.iy()));
                let words = format!("general section, area {} m²", number(section.area()));
                ("general", outline, None, words)
            }
        };
        Self {
            shape,
            outline,
            hole,
            words,
        }
    }
}
