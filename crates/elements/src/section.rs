//! Cross sections of beams and their properties.

use std::f64::consts::PI;

use crate::error::{ElementError, check, positive};

/// The shape of a section, in the element's local y and z axes through its centroid; these are
/// its principal axes. Lengths in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SectionShape {
    /// Solid circle.
    Circle {
        /// Diameter.
        diameter: f64,
    },
    /// Circular tube.
    Tube {
        /// Outer diameter.
        outer: f64,
        /// Inner diameter, zero or more and below the outer.
        inner: f64,
    },
    /// Solid rectangle.
    Rectangle {
        /// Side along local y.
        width: f64,
        /// Side along local z.
        height: f64,
    },
    /// Any section, by its properties.
    General {
        /// Area \[m²\].
        area: f64,
        /// Second moment of area about local y, ∫ z² dA \[m⁴\]: resists deflection along z.
        iy: f64,
        /// Second moment of area about local z, ∫ y² dA \[m⁴\]: resists deflection along y.
        iz: f64,
        /// Saint-Venant's torsion constant \[m⁴\].
        torsion: f64,
        /// Largest |y| of the section \[m\], for stresses.
        y_max: Option<f64>,
        /// Largest |z| of the section \[m\], for stresses.
        z_max: Option<f64>,
        /// Torsion modulus \[m³\]: torque over largest shear stress.
        torsion_modulus: Option<f64>,
    },
}

impl SectionShape {
    /// The kind of shape in words, such as "circle".
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Circle { .. } => "circle",
            Self::Tube { .. } => "tube",
            Self::Rectangle { .. } => "rectangle",
            Self::General { .. } => "general section",
        }
    }
}

/// A section: a shape, and the effective shear areas that make its beams Timoshenko beams.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    shape: SectionShape,
    area: f64,
    iy: f64,
    iz: f64,
    torsion: f64,
    shear_y: Option<f64>,
    shear_z: Option<f64>,
}

impl Section {
    /// A section of this shape. `shear_y`, `shear_z`: effective shear areas κA \[m²\] along local
    /// y and z; without one, bending in that plane is Euler–Bernoulli's.
    ///
    /// # Errors
    /// [`ElementError::OutOfRange`] for a dimension that is not finite and positive, a tube
    /// whose inner diameter is not below its outer one, or dimensions so small or large that a
    /// property of the section leaves the range of a double.
    pub fn new(
        shape: SectionShape,
        shear_y: Option<f64>,
        shear_z: Option<f64>,
    ) -> Result<Self, ElementError> {
        check_dimensions(&shape)?;
        for (field, value) in [("shear_y", shear_y), ("shear_z", shear_z)] {
            if let Some(value) = value {
                positive(field, value)?;
            }
        }
        let section = Self::unchecked(shape, shear_y, shear_z);
        let derived = [
            ("area", section.area),
            ("iy", section.iy),
            ("iz", section.iz),
            ("torsion", section.torsion),
        ];
        for (field, value) in derived {
            let wanted = "within the range of double precision (check the unit, m)";
            check(value.is_normal() && value > 0.0, field, value, wanted)?;
        }
        Ok(section)
    }

    /// A section whose dimensions are known to be right.
    pub(crate) fn unchecked(
        shape: SectionShape,
        shear_y: Option<f64>,
        shear_z: Option<f64>,
    ) -> Self {
        let [area, iy, iz, torsion] = properties(&shape);
        Self {
            shape,
            area,
            iy,
            iz,
            torsion,
            shear_y,
            shear_z,
        }
    }

    /// The shape.
    pub fn shape(&self) -> &SectionShape {
        &self.shape
    }

    /// Area \[m²\].
    pub fn area(&self) -> f64 {
        self.area
    }

    /// Second moment of area about local y \[m⁴\]: resists deflection along z.
    pub fn iy(&self) -> f64 {
        self.iy
    }

    /// Second moment of area about local z \[m⁴\]: resists deflection along y.
    pub fn iz(&self) -> f64 {
        self.iz
    }

    /// Torsion constant \[m⁴\].
    pub fn torsion(&self) -> f64 {
        self.torsion
    }

    /// Effective shear area along local y \[m²\]; `None`: no shear deformation along y.
    pub fn shear_y(&self) -> Option<f64> {
        self.shear_y
    }

    /// Effective shear area along local z \[m²\]; `None`: no shear deformation along z.
    pub fn shear_z(&self) -> Option<f64> {
        self.shear_z
    }

    /// Largest |y| of the section \[m\]; `None` for a general section that does not state it.
    pub fn y_max(&self) -> Option<f64> {
        match self.shape {
            SectionShape::Circle { diameter } => Some(diameter / 2.0),
            SectionShape::Tube { outer, .. } => Some(outer / 2.0),
            SectionShape::Rectangle { width, .. } => Some(width / 2.0),
            SectionShape::General { y_max, .. } => y_max,
        }
    }

    /// Largest |z| of the section \[m\]; `None` for a general section that does not state it.
    pub fn z_max(&self) -> Option<f64> {
        match self.shape {
            SectionShape::Circle { diameter } => Some(diameter / 2.0),
            SectionShape::Tube { outer, .. } => Some(outer / 2.0),
            SectionShape::Rectangle { height, .. } => Some(height / 2.0),
            SectionShape::General { z_max, .. } => z_max,
        }
    }

    /// Torsion modulus \[m³\], torque over largest torsional shear stress: J/c of a circle or
    /// tube, Roark's formula for a rectangle (within 0.5 %); `None` for a general section that
    /// does not state it.
    pub fn torsion_modulus(&self) -> Option<f64> {
        match self.shape {
            SectionShape::Circle { diameter } => Some(self.torsion / (diameter / 2.0)),
            SectionShape::Tube { outer, .. } => Some(self.torsion / (outer / 2.0)),
            SectionShape::Rectangle { width, height } => {
                let (a, b) = half_sides(width, height);
                let r = b / a;
                let series = 1.0 + r * (0.6095 + r * (0.8865 + r * (-1.8023 + r * 0.9100)));
                Some(8.0 * a * b * b / (3.0 * series))
            }
            SectionShape::General {
                torsion_modulus, ..
            } => torsion_modulus,
        }
    }
}

/// Half of the longer and of the shorter side.
fn half_sides(width: f64, height: f64) -> (f64, f64) {
    (width.max(height) / 2.0, width.min(height) / 2.0)
}

/// Checks the dimensions of a shape.
fn check_dimensions(shape: &SectionShape) -> Result<(), ElementError> {
    match *shape {
        SectionShape::Circle { diameter } => {
            positive("diameter", diameter)?;
        }
        SectionShape::Tube { outer, inner } => {
            positive("outer", outer)?;
            let wanted = "zero or more and below `outer`";
            check(inner >= 0.0 && inner < outer, "inner", inner, wanted)?;
        }
        SectionShape::Rectangle { width, height } => {
            positive("width", width)?;
            positive("height", height)?;
        }
        SectionShape::General {
            area,
            iy,
            iz,
            torsion,
            y_max,
            z_max,
            torsion_modulus,
        } => {
            let optional = [
                ("y_max", y_max),
                ("z_max", z_max),
                ("torsion_modulus", torsion_modulus),
            ];
            for (field, value) in optional {
                if let Some(value) = value {
                    positive(field, value)?;
                }
            }
            for (field, value) in [("area", area), ("iy", iy), ("iz", iz), ("torsion", torsion)] {
                positive(field, value)?;
            }
        }
    }
    Ok(())
}

/// Area, second moments about y and z, torsion constant.
fn properties(shape: &SectionShape) -> [f64; 4] {
    match *shape {
        SectionShape::Circle { diameter } => {
            let i = PI * diameter.powi(4) / 64.0;
            [PI * diameter.powi(2) / 4.0, i, i, 2.0 * i]
        }
        SectionShape::Tube { outer, inner } => {
            // Factored differences: a thin wall keeps its digits.
            let area = PI / 4.0 * (outer - inner) * (outer + inner);
            let i = area * (outer.powi(2) + inner.powi(2)) / 16.0;
            [area, i, i, 2.0 * i]
        }
        SectionShape::Rectangle { width, height } => {
            let (a, b) = half_sides(width, height);
            let r = b / a;
            let torsion = a * b.powi(3) * (16.0 / 3.0 - 3.36 * r * (1.0 - r.powi(4) / 12.0));
            [
                width * height,
                width * height.powi(3) / 12.0,
                height * width.powi(3) / 12.0,
                torsion,
            ]
        }
        SectionShape::General {
            area,
            iy,
            iz,
            torsion,
            ..
        } => [area, iy, iz, torsion],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn section(shape: SectionShape) -> Section {
        Section::new(shape, None, None).unwrap()
    }

    fn field(shape: SectionShape) -> &'static str {
        match Section::new(shape, None, None) {
            Err(ElementError::OutOfRange { field, .. }) => field,
            other => panic!("{other:?}"),
        }
    }

    fn near(value: f64, expected: f64) -> bool {
        (value / expected - 1.0).abs() < 1e-14
    }

    #[test]
    fn circle_and_tube() {
        let circle = section(SectionShape::Circle { diameter: 0.02 });
        assert!(near(circle.area(), PI * 1e-4));
        assert!(near(circle.iy(), PI * 1e-8 / 4.0) && circle.iy() == circle.iz());
        assert!(near(circle.torsion(), PI * 1e-8 / 2.0));
        assert!(near(circle.torsion_modulus().unwrap(), PI * 1e-6 / 2.0));
        let inner = section(SectionShape::Circle { diameter: 0.014 });
        let tube = section(SectionShape::Tube {
            outer: 0.02,
            inner: 0.014,
        });
        assert!(near(tube.area(), circle.area() - inner.area()));
        assert!(near(tube.iy(), circle.iy() - inner.iy()));
        assert!(near(tube.torsion(), circle.torsion() - inner.torsion()));
        let solid = section(SectionShape::Tube {
            outer: 0.02,
            inner: 0.0,
        });
        assert!(near(solid.iz(), circle.iz()));
    }

    #[test]
    fn thin_tube_keeps_its_digits() {
        let (radius, wall) = (0.05, 1e-9);
        let tube = section(SectionShape::Tube {
            outer: 2.0 * radius + wall,
            inner: 2.0 * radius - wall,
        });
        // The given diameters carry rounding of 1e-17 m, 1e-8 of the wall.
        assert!((tube.iy() / (PI * radius.powi(3) * wall) - 1.0).abs() < 1e-7);
    }

    #[test]
    fn rectangle_is_wide_along_y_and_high_along_z() {
        let flat = section(SectionShape::Rectangle {
            width: 0.02,
            height: 0.04,
        });
        assert!(near(flat.iy(), 0.02 * 0.04f64.powi(3) / 12.0));
        assert!(near(flat.iz(), 0.04 * 0.02f64.powi(3) / 12.0));
        assert_eq!((flat.y_max(), flat.z_max()), (Some(0.01), Some(0.02)));
    }

    /// Saint-Venant's series (Timoshenko and Goodier, table of k and k₂): J = k h b³,
    /// T/τ = k₂ h b² with the sides h ≥ b.
    #[test]
    fn torsion_of_rectangles_is_near_the_exact_series() {
        for (ratio, k, k2) in [
            (1.0, 0.1406, 0.208),
            (1.5, 0.196, 0.231),
            (2.0, 0.229, 0.246),
            (5.0, 0.291, 0.291),
            (10.0, 0.312, 0.312),
        ] {
            let (b, h) = (0.01, 0.01 * ratio);
            for (width, height) in [(b, h), (h, b)] {
                let bar = section(SectionShape::Rectangle { width, height });
                let constant = bar.torsion() / (h * b.powi(3));
                let modulus = bar.torsion_modulus().unwrap() / (h * b * b);
                assert!((constant / k - 1.0).abs() < 0.004, "{ratio}: {constant}");
                assert!((modulus / k2 - 1.0).abs() < 0.006, "{ratio}: {modulus}");
            }
        }
    }

    #[test]
    fn dimensions_out_of_range_are_named() {
        for bad in [0.0, -0.01, f64::NAN, f64::INFINITY] {
            assert_eq!(field(SectionShape::Circle { diameter: bad }), "diameter");
            let tube = |outer, inner| SectionShape::Tube { outer, inner };
            assert_eq!(field(tube(bad, 0.01)), "outer");
            let rectangle = |width, height| SectionShape::Rectangle { width, height };
            assert_eq!(field(rectangle(bad, 0.01)), "width");
            assert_eq!(field(rectangle(0.01, bad)), "height");
            let shear = Section::new(SectionShape::Circle { diameter: 0.01 }, Some(bad), None);
            assert!(shear.unwrap_err().to_string().starts_with("`shear_y` is"));
            let shear = Section::new(SectionShape::Circle { diameter: 0.01 }, None, Some(bad));
            assert!(shear.unwrap_err().to_string().starts_with("`shear_z` is"));
        }
        for inner in [-0.001, 0.02, 0.03, f64::NAN] {
            assert_eq!(field(SectionShape::Tube { outer: 0.02, inner }), "inner");
        }
        let tiny = field(SectionShape::Circle { diameter: 1e-90 });
        assert!(["iy", "iz"].contains(&tiny));
    }

    #[test]
    fn properties_of_a_general_section_are_named() {
        let names = [
            "area",
            "iy",
            "iz",
            "torsion",
            "y_max",
            "z_max",
            "torsion_modulus",
        ];
        for (place, name) in names.iter().enumerate() {
            let value = |k: usize| if k == place { -1.0 } else { 1e-4 };
            let shape = SectionShape::General {
                area: value(0),
                iy: value(1),
                iz: value(2),
                torsion: value(3),
                y_max: Some(value(4)),
                z_max: Some(value(5)),
                torsion_modulus: Some(value(6)),
            };
            assert_eq!(field(shape), *name);
        }
    }
}
