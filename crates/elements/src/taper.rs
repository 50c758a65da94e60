//! Sections that change along a beam.

use crate::error::ElementError;
use crate::section::{Section, SectionShape};

/// On an interval of a [`Taper`] no dimension changes by more than this factor.
const LARGEST_RATIO: f64 = 2.0;

/// A section that changes along a beam, from one to another of the same kind.
///
/// The dimensions of circles, tubes and rectangles change linearly. The properties of a general
/// section change as those of a shape that is scaled: the square root of the area, the fourth
/// root of the second moments and of the torsion constant, the cube root of the torsion modulus
/// and `y_max`, `z_max` themselves change linearly. A shear area keeps its ratio to the area
/// where both ends have the same; else the ratio changes linearly.
#[derive(Debug, Clone, PartialEq)]
pub struct Taper {
    from: Section,
    to: Section,
}

impl Taper {
    /// A section that is `from` at a beam's first node and `to` at its second.
    ///
    /// # Errors
    /// [`ElementError::DifferentKinds`] for a tube and a circle, say (a circle is a tube with
    /// `inner` 0); [`ElementError::OneEnd`] for an optional property that only one of them has.
    pub fn new(from: Section, to: Section) -> Result<Self, ElementError> {
        let (kind, other) = (from.shape().kind(), to.shape().kind());
        if kind != other {
            return Err(ElementError::DifferentKinds {
                from: kind,
                to: other,
            });
        }
        let optional = |section: &Section| {
            let of_shape = match section.shape() {
                SectionShape::General {
                    y_max,
                    z_max,
                    torsion_modulus,
                    ..
                } => [*y_max, *z_max, *torsion_modulus],
                _ => [None; 3],
            };
            let [y_max, z_max, torsion_modulus] = of_shape.map(|v| v.is_some());
            [
                ("shear_y", section.shear_y().is_some()),
                ("shear_z", section.shear_z().is_some()),
                ("y_max", y_max),
                ("z_max", z_max),
                ("torsion_modulus", torsion_modulus),
            ]
        };
        for (one, other) in optional(&from).into_iter().zip(optional(&to)) {
            if one != other {
                return Err(ElementError::OneEnd { field: one.0 });
            }
        }
        Ok(Self { from, to })
    }

    /// A section that stays the same along the beam.
    pub fn constant(section: Section) -> Self {
        Self {
            from: section.clone(),
            to: section,
        }
    }

    /// Whether the section stays the same along the beam.
    pub fn is_constant(&self) -> bool {
        self.from == self.to
    }

    /// The section at the first node.
    pub fn from(&self) -> &Section {
        &self.from
    }

    /// The section at the second node.
    pub fn to(&self) -> &Section {
        &self.to
    }

    /// The section at `xi` (0 at the first node, 1 at the second).
    pub fn at(&self, xi: f64) -> Section {
        let mix = |from: f64, to: f64| mix(from, to, xi);
        let mix_option = |from: Option<f64>, to: Option<f64>| Some(mix(from?, to?));
        let shape = match (*self.from.shape(), *self.to.shape()) {
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
            _ => {
                let root_mix = |power: i32, from: f64, to: f64| {
                    let root = 1.0 / f64::from(power);
                    mix(from.powf(root), to.powf(root)).powi(power)
                };
                let (from, to) = (&self.from, &self.to);
                SectionShape::General {
                    area: root_mix(2, from.area(), to.area()),
                    iy: root_mix(4, from.iy(), to.iy()),
                    iz: root_mix(4, from.iz(), to.iz()),
                    torsion: root_mix(4, from.torsion(), to.torsion()),
                    y_max: mix_option(from.y_max(), to.y_max()),
                    z_max: mix_option(from.z_max(), to.z_max()),
                    torsion_modulus: from
                        .torsion_modulus()
                        .zip(to.torsion_modulus())
                        .map(|(from, to)| root_mix(3, from, to)),
                }
            }
        };
        let section = Section::unchecked(shape, None, None);
        let shear = |area: fn(&Section) -> Option<f64>| {
            let ratio = |end: &Section| area(end).map(|a| a / end.area());
            mix_option(ratio(&self.from), ratio(&self.to)).map(|ratio| ratio * section.area())
        };
        let (shear_y, shear_z) = (shear(Section::shear_y), shear(Section::shear_z));
        Section::unchecked(shape, shear_y, shear_z)
    }

    /// The part of the taper from `first` to `last` (0 to 1).
    pub fn part(&self, first: f64, last: f64) -> Self {
        let end = |xi: f64| match xi {
            0.0 => self.from.clone(),
            1.0 => self.to.clone(),
            _ => self.at(xi),
        };
        Self {
            from: end(first),
            to: end(last),
        }
    }

    /// The taper from `to` to `from`.
    pub fn reversed(&self) -> Self {
        Self {
            from: self.to.clone(),
            to: self.from.clone(),
        }
    }

    /// The area \[m²\] along the taper, (1 − ξ)² a₀ + 2 ξ (1 − ξ) a₁ + ξ² a₂: of every kind of
    /// section it is exactly quadratic.
    pub(crate) fn area_controls(&self) -> [f64; 3] {
        controls([self.from.area(), self.at(0.5).area(), self.to.area()])
    }

    /// Calls `visit` on intervals (first, last) that together make up 0 to `end`. On each of
    /// them the section's flexibility is a smooth function, far from a pole: no dimension changes
    /// by more than a factor of two, and a rectangle's longer side stays the longer one.
    pub(crate) fn intervals(&self, end: f64, mut visit: impl FnMut(f64, f64)) {
        let turn = self.square().filter(|turn| *turn < end);
        self.bisect(0.0, turn.unwrap_or(end), &mut visit);
        if let Some(turn) = turn {
            self.bisect(turn, end, &mut visit);
        }
    }

    fn bisect(&self, first: f64, last: f64, visit: &mut impl FnMut(f64, f64)) {
        let ends = dimensions(&self.from).into_iter().zip(dimensions(&self.to));
        let ratio = ends.fold(1.0_f64, |most, (from, to)| {
            let [a, b] = [first, last].map(|xi| mix(from, to, xi));
            most.max(a / b).max(b / a)
        });
        let middle = first + (last - first) / 2.0;
        if ratio <= LARGEST_RATIO || middle <= first || middle >= last {
            visit(first, last);
        } else {
            self.bisect(first, middle, visit);
            self.bisect(middle, last, visit);
        }
    }

    /// Where a rectangle is a square on its way from high to wide: Roark's torsion constant has a
    /// kink there.
    fn square(&self) -> Option<f64> {
        let SectionShape::Rectangle { width, height } = *self.from.shape() else {
            return None;
        };
        let SectionShape::Rectangle {
            width: width_to,
            height: height_to,
        } = *self.to.shape()
        else {
            return None;
        };
        let (before, after) = (width - height, width_to - height_to);
        (before * after < 0.0).then(|| before / (before - after))
    }
}

/// The controls c of (1 − ξ)² c₀ + 2 ξ (1 − ξ) c₁ + ξ² c₂ that has these values at 0, ½ and 1.
pub(crate) fn controls([first, middle, last]: [f64; 3]) -> [f64; 3] {
    [first, 2.0 * middle - (first + last) / 2.0, last]
}

/// The value at `xi` of what changes linearly; positive where both ends are.
fn mix(from: f64, to: f64, xi: f64) -> f64 {
    (1.0 - xi) * from + xi * to
}

/// What changes linearly along a taper: the lengths at whose zeros the flexibility has poles, and
/// the shear areas' ratios to the area.
fn dimensions(section: &Section) -> [f64; 6] {
    let ratio = |area: Option<f64>| area.map_or(1.0, |a| a / section.area());
    let [a, b, c, d] = match *section.shape() {
        SectionShape::Circle { diameter } => [diameter, 1.0, 1.0, 1.0],
        SectionShape::Tube { outer, inner } => [outer, outer - inner, 1.0, 1.0],
        SectionShape::Rectangle { width, height } => [width, height, 1.0, 1.0],
        SectionShape::General { .. } => [
            section.area().sqrt(),
            section.iy().sqrt().sqrt(),
            section.iz().sqrt().sqrt(),
            section.torsion().sqrt().sqrt(),
        ],
    };
    let [shear_y, shear_z] = [section.shear_y(), section.shear_z()].map(ratio);
    [a, b, c, d, shear_y, shear_z]
}
