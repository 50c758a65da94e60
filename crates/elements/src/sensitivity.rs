//! How the rigidities of a beam change with the dimensions of its section and the constants of its
//! material.
//!
//! Derivatives are logarithmic, ∂ ln r/∂p: of the rigidities r = (EA, GA_y, GA_z, GJ, EI_y, EI_z)
//! for [`StraightBeam::elastic_work`](crate::StraightBeam::elastic_work).

use nalgebra::Vector6;

use crate::error::ElementError;
use crate::material::{Elasticity, Material};
use crate::section::{Section, SectionShape};
use crate::taper::Taper;

impl Section {
    /// The dimensions and properties that stiffness depends on, by their names in files, with
    /// their values \[m, m², m⁴\].
    pub fn dimensions(&self) -> Vec<(&'static str, f64)> {
        let mut dimensions = match *self.shape() {
            SectionShape::Circle { diameter } => vec![("diameter", diameter)],
            SectionShape::Tube { outer, inner } => vec![("outer", outer), ("inner", inner)],
            SectionShape::Rectangle { width, height } => {
                vec![("width", width), ("height", height)]
            }
            SectionShape::General {
                area,
                iy,
                iz,
                torsion,
                ..
            } => vec![("area", area), ("iy", iy), ("iz", iz), ("torsion", torsion)],
        };
        let shear = [("shear_y", self.shear_y()), ("shear_z", self.shear_z())];
        dimensions.extend(
            shear
                .iter()
                .filter_map(|(name, value)| Some((*name, (*value)?))),
        );
        dimensions
    }

    /// The section with one of its [dimensions](Section::dimensions) at another value; as it is
    /// where it has no dimension of this name.
    ///
    /// # Errors
    /// As [`Section::new`].
    pub fn with_dimension(&self, name: &str, value: f64) -> Result<Self, ElementError> {
        let mut shape = *self.shape();
        match &mut shape {
            SectionShape::Circle { diameter } => set(name, value, [("diameter", diameter)]),
            SectionShape::Tube { outer, inner } => {
                set(name, value, [("outer", outer), ("inner", inner)]);
            }
            SectionShape::Rectangle { width, height } => {
                set(name, value, [("width", width), ("height", height)]);
            }
            SectionShape::General {
                area,
                iy,
                iz,
                torsion,
                ..
            } => set(
                name,
                value,
                [("area", area), ("iy", iy), ("iz", iz), ("torsion", torsion)],
            ),
        }
        let shear =
            |own: &str, area: Option<f64>| area.map(|a| if own == name { value } else { a });
        let (shear_y, shear_z) = (self.shear_y(), self.shear_z());
        Self::new(shape, shear("shear_y", shear_y), shear("shear_z", shear_z))
    }

    /// ∂ ln (A, A_y, A_z, J, I_y, I_z)/∂p for the dimension p of this name \[1 over its unit\]; zero
    /// where the section has no such dimension, or no shear area. Shear areas that are given stay
    /// as they are. At a square, where Roark's torsion constant has a kink, the mean of both sides.
    pub fn logarithmic_derivative(&self, name: &str) -> Vector6<f64> {
        let of_area = |area: f64| Vector6::new(area, 0.0, 0.0, 0.0, 0.0, 0.0);
        let round =
            |area: f64, inertia: f64| Vector6::new(area, 0.0, 0.0, inertia, inertia, inertia);
        match (name, *self.shape()) {
            ("shear_y", _) => self.shear_y().map_or(Vector6::zeros(), |a| {
                Vector6::new(0.0, 1.0 / a, 0.0, 0.0, 0.0, 0.0)
            }),
            ("shear_z", _) => self.shear_z().map_or(Vector6::zeros(), |a| {
                Vector6::new(0.0, 0.0, 1.0 / a, 0.0, 0.0, 0.0)
            }),
            ("diameter", SectionShape::Circle { diameter: d }) => round(2.0 / d, 4.0 / d),
            ("outer", SectionShape::Tube { outer, inner }) => {
                round(difference(outer, inner, 2), difference(outer, inner, 4))
            }
            // d ln (Dⁿ − dⁿ)/dd = −(d/D)ⁿ⁻¹ d ln (Dⁿ − dⁿ)/dD
            ("inner", SectionShape::Tube { outer, inner }) => {
                let part = |n: i32| -difference(outer, inner, n) * (inner / outer).powi(n - 1);
                round(part(2), part(4))
            }
            ("width", SectionShape::Rectangle { width, height }) => {
                let torsion = roark(width, height) / self.torsion();
                Vector6::new(1.0 / width, 0.0, 0.0, torsion, 1.0 / width, 3.0 / width)
            }
            ("height", SectionShape::Rectangle { width, height }) => {
                let torsion = roark(height, width) / self.torsion();
                Vector6::new(1.0 / height, 0.0, 0.0, torsion, 3.0 / height, 1.0 / height)
            }
            ("area", SectionShape::General { area, .. }) => of_area(1.0 / area),
            ("torsion", SectionShape::General { torsion, .. }) => Vector6::ith(3, 1.0 / torsion),
            ("iy", SectionShape::General { iy, .. }) => Vector6::ith(4, 1.0 / iy),
            ("iz", SectionShape::General { iz, .. }) => Vector6::ith(5, 1.0 / iz),
            _ => Vector6::zeros(),
        }
    }

    /// A, A_y, A_z, J, I_y, I_z; 1 for a shear area that is not given.
    fn properties(&self) -> Vector6<f64> {
        let (shear_y, shear_z) = (self.shear_y(), self.shear_z());
        Vector6::new(
            self.area(),
            shear_y.unwrap_or(1.0),
            shear_z.unwrap_or(1.0),
            self.torsion(),
            self.iy(),
            self.iz(),
        )
    }
}

/// Puts `value` where the name is.
fn set<const N: usize>(name: &str, value: f64, places: [(&str, &mut f64); N]) {
    for (own, place) in places {
        if own == name {
            *place = value;
        }
    }
}

/// d ln (Dⁿ − dⁿ)/dD of n = 2 or 4, by factors: a thin wall keeps its digits.
fn difference(outer: f64, inner: f64, n: i32) -> f64 {
    let part = inner / outer;
    let sums = if n == 2 {
        1.0 + part
    } else {
        (1.0 + part) * (1.0 + part * part)
    };
    f64::from(n) / ((outer - inner) * sums)
}

/// Derivative of Roark's torsion constant of a rectangle by `side`, J = 16/3 a b³ − 3.36 b⁴ +
/// 0.28 b⁸/a⁴ with the half sides a ≥ b.
fn roark(side: f64, other: f64) -> f64 {
    let (a, b) = (side.max(other) / 2.0, side.min(other) / 2.0);
    let by_longer = 16.0 / 3.0 * b.powi(3) - 1.12 * b.powi(8) / a.powi(5);
    let by_shorter = 16.0 * a * b * b - 13.44 * b.powi(3) + 2.24 * b.powi(7) / a.powi(4);
    let both = if side > other {
        by_longer
    } else if side < other {
        by_shorter
    } else {
        (by_longer + by_shorter) / 2.0
    };
    both / 2.0
}

impl Taper {
    /// ∂ ln (A, A_y, A_z, J, I_y, I_z)/∂p at `xi` for the dimension p of this name at the first
    /// node, or at the second; zero where the sections have no such dimension, or no shear area.
    pub fn logarithmic_derivative(&self, at_second: bool, name: &str, xi: f64) -> Vector6<f64> {
        let (end, share) = match at_second {
            true => (self.to(), xi),
            false => (self.from(), 1.0 - xi),
        };
        let here = self.at(xi);
        let of_end = end.logarithmic_derivative(name);
        let mut change = match end.shape() {
            // P^(1/n) changes linearly, hence ∂ ln P/∂p = share (P_end/P)^(1/n) ∂ ln P_end/∂p.
            SectionShape::General { .. } => {
                let mut ratios = end.properties().component_div(&here.properties());
                ratios[0] = ratios[0].sqrt();
                for of_fourth_power in [3, 4, 5] {
                    ratios[of_fourth_power] = ratios[of_fourth_power].sqrt().sqrt();
                }
                of_end.component_mul(&ratios)
            }
            // The dimension itself changes linearly.
            _ => here.logarithmic_derivative(name),
        } * share;
        // A shear area is the area times a ratio that changes linearly.
        for (k, area) in [
            (1, Section::shear_y as fn(&Section) -> _),
            (2, Section::shear_z),
        ] {
            let ratio = |section: &Section| area(section).map(|a| a / section.area());
            change[k] = match (ratio(end), ratio(&here)) {
                (Some(at_end), Some(own)) => {
                    change[0] + share * at_end / own * (of_end[k] - of_end[0])
                }
                _ => 0.0,
            };
        }
        change
    }
}

impl Material {
    /// The constants that deformation, mass and free strain depend on, by their names in files,
    /// with their values: `young` \[Pa\], `poisson` or `shear` \[Pa\], whichever was given,
    /// and `density` \[kg/m³\] and `expansion` \[1/K\] where they are given.
    pub fn constants(&self) -> Vec<(&'static str, f64)> {
        let second = match self.elasticity() {
            Elasticity::Poisson(poisson) => ("poisson", poisson),
            Elasticity::Shear(shear) => ("shear", shear),
        };
        let density = self.density().map(|density| ("density", density));
        let expansion = self.expansion().map(|expansion| ("expansion", expansion));
        [("young", self.young()), second]
            .into_iter()
            .chain(density)
            .chain(expansion)
            .collect()
    }

    /// ∂ ln (E, G, G, G, E, E)/∂p for the constant p of this name, the others as they are.
    pub fn logarithmic_derivative(&self, name: &str) -> Vector6<f64> {
        let [young, shear] = match (name, self.elasticity()) {
            ("young", Elasticity::Poisson(_)) => [1.0 / self.young(); 2],
            ("young", Elasticity::Shear(_)) => [1.0 / self.young(), 0.0],
            ("poisson", Elasticity::Poisson(poisson)) => [0.0, -1.0 / (1.0 + poisson)],
            ("shear", Elasticity::Shear(shear)) => [0.0, 1.0 / shear],
            _ => [0.0; 2],
        };
        Vector6::new(young, shear, shear, shear, young, young)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shapes() -> Vec<SectionShape> {
        vec![
            SectionShape::Circle { diameter: 0.03 },
            SectionShape::Tube {
                outer: 0.03,
                inner: 0.024,
            },
            SectionShape::Rectangle {
                width: 0.02,
                height: 0.04,
            },
            SectionShape::Rectangle {
                width: 0.05,
                height: 0.03,
            },
            SectionShape::Rectangle {
                width: 0.03,
                height: 0.03,
            },
            SectionShape::General {
                area: 4e-4,
                iy: 1e-8,
                iz: 2e-8,
                torsion: 2.5e-8,
                y_max: None,
                z_max: None,
                torsion_modulus: None,
            },
        ]
    }

    #[test]
    fn derivatives_of_sections_agree_with_differences() {
        for shape in shapes() {
            let section = Section::new(shape, Some(3e-4), Some(2e-4)).unwrap();
            for (name, value) in section.dimensions() {
                let at = |factor: f64| {
                    let changed = section.with_dimension(name, value * factor).unwrap();
                    changed.properties().map(f64::ln)
                };
                let difference = (at(1.0 + 1e-5) - at(1.0 - 1e-5)) / (2e-5 * value);
                let found = section.logarithmic_derivative(name);
                let tolerance = if matches!(shape, SectionShape::Rectangle { width, height } if width == height)
                {
                    1e-5 // of the kink's second derivatives, which differ
                } else {
                    1e-8
                };
                assert!(
                    (found - difference).amax() < tolerance * found.amax(),
                    "{shape:?} {name}: {found} {difference}"
                );
            }
        }
    }

    /// A taper between two equal sections has the derivative of the section shared by its ends.
    #[test]
    fn derivatives_of_a_constant_taper_are_the_sections() {
        for shape in shapes() {
            if matches!(shape, SectionShape::Rectangle { width, height } if width == height) {
                continue;
            }
            let section = Section::new(shape, None, None).unwrap();
            let taper = Taper::constant(section.clone());
            for (name, _) in section.dimensions() {
                let expected = section.logarithmic_derivative(name);
                for xi in [0.0, 0.3, 1.0] {
                    let [first, second] =
                        [false, true].map(|end| taper.logarithmic_derivative(end, name, xi));
                    let whole = expected.amax();
                    assert!((first - expected * (1.0 - xi)).amax() < 1e-14 * whole);
                    assert!((second - expected * xi).amax() < 1e-14 * whole);
                }
            }
        }
    }

    /// The same shape `scale` times as large, with shear areas of these parts of its area.
    fn scaled(shape: SectionShape, scale: f64, parts: [f64; 2]) -> Section {
        let (square, fourth) = (scale.powi(2), scale.powi(4));
        let shape = match shape {
            SectionShape::Circle { diameter } => SectionShape::Circle {
                diameter: diameter * scale,
            },
            SectionShape::Tube { outer, inner } => SectionShape::Tube {
                outer: outer * scale,
                inner: inner * scale,
            },
            SectionShape::Rectangle { width, height } => SectionShape::Rectangle {
                width: width * scale,
                height: height * scale,
            },
            SectionShape::General {
                area,
                iy,
                iz,
                torsion,
                ..
            } => SectionShape::General {
                area: area * square,
                iy: iy * fourth,
                iz: iz * fourth,
                torsion: torsion * fourth,
                y_max: None,
                z_max: None,
                torsion_modulus: None,
            },
        };
        let area = Section::new(shape, None, None).unwrap().area();
        Section::new(shape, Some(area * parts[0]), Some(area * parts[1])).unwrap()
    }

    /// Against differences, and in any unit of length: p ∂ ln P/∂p has none.
    #[test]
    fn derivatives_of_tapers_agree_with_differences_at_every_size() {
        for shape in shapes() {
            for size in [1.0, 1e-2, 1e-5, 1e4] {
                let from = scaled(shape, size, [0.9, 0.8]);
                let to = scaled(shape, 0.6 * size, [0.5, 0.7]);
                let taper = Taper::new(from.clone(), to.clone()).unwrap();
                for (at_second, end) in [(false, &from), (true, &to)] {
                    for (name, value) in end.dimensions() {
                        let at = |factor: f64, xi: f64| {
                            let changed = end.with_dimension(name, value * factor).unwrap();
                            let taper = match at_second {
                                true => Taper::new(from.clone(), changed),
                                false => Taper::new(changed, to.clone()),
                            };
                            taper.unwrap().at(xi).properties().map(f64::ln)
                        };
                        for xi in [0.0, 0.3, 1.0] {
                            let found = taper.logarithmic_derivative(at_second, name, xi) * value;
                            let slope = (at(1.0 + 1e-5, xi) - at(1.0 - 1e-5, xi)) / 2e-5;
                            // Third derivatives times 1e-10/6: a tube's are 2 (D/(D − d))³ = 250. Of
                            // the kink of a square's torsion constant the second ones.
                            let off = (found - slope).amax();
                            let square = matches!(shape, SectionShape::Rectangle { width, height } if width == height);
                            let tolerance = if square { 2e-5 } else { 1e-8 };
                            assert!(
                                off < tolerance,
                                "{shape:?} {size} {name} {xi}: {found} {slope}"
                            );
                        }
                    }
                }
            }
        }
    }

    /// d ln A/dD = 2D/(D² − d²) of a wall of 1e-9 of the diameter, to the digits of the diameters.
    #[test]
    fn a_thin_wall_keeps_its_digits() {
        let (outer, inner) = (1.0 + 2_f64.powi(-30), 1.0);
        let section = Section::new(SectionShape::Tube { outer, inner }, None, None).unwrap();
        let change = section.logarithmic_derivative("outer");
        let wall = 2_f64.powi(-30);
        let area = 2.0 * outer / (wall * (2.0 + wall));
        let inertia = 4.0 * outer.powi(3) / (wall * (2.0 + wall) * (outer * outer + 1.0));
        assert!((change[0] / area - 1.0).abs() < 1e-15, "{change}");
        assert!((change[4] / inertia - 1.0).abs() < 1e-15, "{change}");
    }

    #[test]
    fn derivatives_of_materials_agree_with_differences() {
        for elasticity in [Elasticity::Poisson(0.3), Elasticity::Shear(5e10)] {
            let material = |young: f64, factor: f64| {
                let second = match elasticity {
                    Elasticity::Poisson(p) => Elasticity::Poisson(p * factor),
                    Elasticity::Shear(g) => Elasticity::Shear(g * factor),
                };
                Material::new(young, second, None).unwrap()
            };
            let logs = |m: Material| [m.young().ln(), m.shear().ln()];
            let own = material(2.1e11, 1.0);
            for (name, value) in own.constants() {
                let at = |factor: f64| match name {
                    "young" => logs(material(2.1e11 * factor, 1.0)),
                    _ => logs(material(2.1e11, factor)),
                };
                let (high, low) = (at(1.0 + 1e-5), at(1.0 - 1e-5));
                let found = own.logarithmic_derivative(name);
                for (k, d) in [(0, 0), (1, 3)] {
                    let difference = (high[k] - low[k]) / (2e-5 * value);
                    assert!((found[d] - difference).abs() * value < 1e-8, "{name}");
                }
            }
        }
    }
}
