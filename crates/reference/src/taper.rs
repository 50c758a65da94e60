//! The flexibility of beams whose section changes along them, by double-exponential quadrature.
//!
//! Formed here anew: `hyperstat-elements` interpolates the section and integrates in other ways.

use hyperstat_elements::{Section, SectionShape};
use hyperstat_model::{Segment, Tapering};

/// Step of the quadrature in its own variable.
const STEP: f64 = 1.0 / 32.0;
/// Points on each side of the middle; beyond them weights are below rounding.
const POINTS: i32 = 110;

/// Flexibility of an element whose section changes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TaperFlexibility {
    /// ∫ dx/EA [m/N].
    pub axial: f64,
    /// ∫ dx/GJ [rad/(N·m)].
    pub torsion: f64,
    /// Deflection along local y and along local z.
    pub bending: [TaperBending; 2],
}

/// Bending in one plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TaperBending {
    /// ∫ dx/EI [rad/(N·m)].
    pub turn: f64,
    /// Where a force across the element gives no rotation: distance from its first node [m].
    pub centre: f64,
    /// Deflection per force there [m/N].
    pub deflection: f64,
}

impl TaperFlexibility {
    /// Of the part of a segment of length `length` [m] between two places (0 to 1) along it, where
    /// its section runs from its own to another.
    pub fn new(segment: &Segment, change: &Tapering, part: [f64; 2], length: f64) -> Self {
        let (young, shear) = (segment.material.young(), segment.material.shear());
        // From here on all along the whole change.
        let to = &change.to;
        let part = part.map(|place| along_change(change, place));
        let length = length / (change.part[1] - change.part[0]);
        let at = |xi: f64| section(&segment.section, to, xi);
        let places = points(&segment.section, to, part);
        let integral = |value: &dyn Fn(&Section, f64) -> f64| -> f64 {
            let term = |(xi, weight): &(f64, f64)| weight * value(&at(*xi), xi * length);
            places.iter().map(term).sum::<f64>() * length
        };
        type Property<T> = fn(&Section) -> T;
        let planes: [(Property<f64>, Property<Option<f64>>); 2] = [
            (Section::iz, Section::shear_y),
            (Section::iy, Section::shear_z),
        ];
        let bending = planes.map(|(inertia, area)| {
            let start = part[0] * length;
            let turn = integral(&|s, _| 1.0 / (young * inertia(s)));
            let centre = integral(&|s, x| (x - start) / (young * inertia(s))) / turn;
            let bent = integral(&|s, x| (x - start - centre).powi(2) / (young * inertia(s)));
            let sheared = integral(&|s, _| area(s).map_or(0.0, |a| 1.0 / (shear * a)));
            TaperBending {
                turn,
                centre,
                deflection: bent + sheared,
            }
        });
        Self {
            axial: integral(&|s, _| 1.0 / (young * s.area())),
            torsion: integral(&|s, _| 1.0 / (shear * s.torsion())),
            bending,
        }
    }
}

/// The place along a change of section, of a place along a segment that has a part of it.
pub(crate) fn along_change(change: &Tapering, place: f64) -> f64 {
    let [first, last] = change.part;
    first + (last - first) * place
}

/// The section at `xi`: dimensions linear, general properties as those of a scaled shape, shear
/// areas by their ratio to the area.
pub(crate) fn section(from: &Section, to: &Section, xi: f64) -> Section {
    let mix = |a: f64, b: f64| (1.0 - xi) * a + xi * b;
    let scaled =
        |a: f64, b: f64, power: f64| mix(a.powf(1.0 / power), b.powf(1.0 / power)).powf(power);
    let shape = match (*from.shape(), *to.shape()) {
        (SectionShape::Circle { diameter: a }, SectionShape::Circle { diameter: b }) => {
            SectionShape::Circle {
                diameter: mix(a, b),
            }
        }
        (
            SectionShape::Tube { outer, inner },
            SectionShape::Tube {
                outer: outer_to,
                inner: inner_to,
            },
        ) => SectionShape::Tube {
            outer: mix(outer, outer_to),
            inner: mix(inner, inner_to),
        },
        (
            SectionShape::Rectangle { width, height },
            SectionShape::Rectangle {
                width: width_to,
                height: height_to,
            },
        ) => SectionShape::Rectangle {
            width: mix(width, width_to),
            height: mix(height, height_to),
        },
        _ => SectionShape::General {
            area: scaled(from.area(), to.area(), 2.0),
            iy: scaled(from.iy(), to.iy(), 4.0),
            iz: scaled(from.iz(), to.iz(), 4.0),
            torsion: scaled(from.torsion(), to.torsion(), 4.0),
            y_max: None,
            z_max: None,
            torsion_modulus: None,
        },
    };
    let plain = Section::new(shape, None, None).unwrap_or_else(|_| from.clone());
    let shear =
        |a: Option<f64>, b: Option<f64>| Some(mix(a? / from.area(), b? / to.area()) * plain.area());
    let shear_y = shear(from.shear_y(), to.shear_y());
    let shear_z = shear(from.shear_z(), to.shear_z());
    Section::new(shape, shear_y, shear_z).unwrap_or(plain)
}

/// Places and weights between two places along a segment, apart where a rectangle is a square (the
/// formula of its torsion constant has a kink there).
pub(crate) fn points(from: &Section, to: &Section, part: [f64; 2]) -> Vec<(f64, f64)> {
    let mut ends = vec![part[0], part[1]];
    if let (
        SectionShape::Rectangle { width, height },
        SectionShape::Rectangle {
            width: width_to,
            height: height_to,
        },
    ) = (*from.shape(), *to.shape())
    {
        let square = (height - width) / (height - width + width_to - height_to);
        if square > part[0] && square < part[1] {
            ends.insert(1, square);
        }
    }
    let pieces = ends.windows(2);
    pieces
        .flat_map(|w| double_exponential(w[0], w[1]))
        .collect()
}

/// x = tanh(π/2 sinh t) on −1 to 1: smooth functions are integrated to rounding.
fn double_exponential(first: f64, last: f64) -> Vec<(f64, f64)> {
    let half_pi = std::f64::consts::FRAC_PI_2;
    let (middle, half) = ((first + last) / 2.0, (last - first) / 2.0);
    (-POINTS..=POINTS)
        .map(|k| {
            let t = f64::from(k) * STEP;
            let reach = half_pi * t.sinh();
            let weight = STEP * half_pi * t.cosh() / reach.cosh().powi(2);
            (middle + half * reach.tanh(), half * weight)
        })
        .collect()
}
