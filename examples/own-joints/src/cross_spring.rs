//! A flexure pivot of two crossed leaf springs.

use std::f64::consts::FRAC_PI_2;

use hyperstat_elements::{Beam, Elasticity, ElementError, Material, Section, SectionShape};
use hyperstat_joints::{Dof, DofSet, Joint, rigid_motion};
use hyperstat_mechanisms::{Arguments, LoadError, Orientation, ParsedJoint};
use nalgebra::{Matrix3, Matrix6, Vector3};

/// A hinge without play or friction: two blades side by side along the axis that cross in its
/// middle, each clamped to one body at one end and to the other body at the other.
///
/// The axis is y of the joint's frame. The blades lie at `angle` to either side of x, so that x
/// halves the angle between them; their middles are `spacing` apart along y. The joint's point is
/// midway between the two.
#[derive(Debug, Clone)]
pub struct CrossSpring {
    compliance: Matrix6<f64>,
}

/// One blade of a [`CrossSpring`] and how the two are placed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blades {
    /// Free length of a blade \[m\].
    pub length: f64,
    /// Width of a blade, along the axis \[m\].
    pub width: f64,
    /// Thickness of a blade \[m\].
    pub thickness: f64,
    /// Half of the angle between the blades \[rad\].
    pub angle: f64,
    /// Distance of the blades' middles along the axis \[m\].
    pub spacing: f64,
}

impl Blades {
    fn check(&self) -> Result<(), ElementError> {
        let lengths = [
            ("length", self.length, f64::MIN_POSITIVE, "above zero"),
            ("width", self.width, f64::MIN_POSITIVE, "above zero"),
            ("thickness", self.thickness, f64::MIN_POSITIVE, "above zero"),
            ("spacing", self.spacing, 0.0, "zero or more"),
        ];
        for (field, value, least, wanted) in lengths {
            if !(value.is_finite() && value >= least) {
                return Err(ElementError::OutOfRange {
                    field,
                    value,
                    wanted,
                });
            }
        }
        if self.angle > 0.0 && self.angle < FRAC_PI_2 {
            return Ok(());
        }
        Err(ElementError::OutOfRange {
            field: "angle",
            value: self.angle,
            wanted: "between 0 and π/2 (radians)",
        })
    }
}

impl CrossSpring {
    /// The arguments of `CrossSpring(axis: …, length: …, …)` in a file.
    pub const ARGUMENTS: &'static [&'static str] = &[
        "axis",
        "length",
        "width",
        "thickness",
        "angle",
        "spacing",
        "young",
        "poisson",
    ];

    /// A pivot of two blades of `material`.
    ///
    /// # Errors
    /// A dimension that is not above zero (`spacing`: below zero), an `angle` that is not between
    /// 0 and π/2, blades so nearly parallel that their stiffness has no inverse.
    pub fn new(blades: &Blades, material: &Material) -> Result<Self, ElementError> {
        blades.check()?;
        let shape = SectionShape::Rectangle {
            width: blades.width,
            height: blades.thickness,
        };
        let blade = Beam::new(material, &Section::new(shape, None, None)?, blades.length)?;
        let mut stiffness = Matrix6::zeros();
        for side in [-1.0, 1.0] {
            let (sin, cos) = (side * blades.angle).sin_cos();
            let along = Vector3::new(cos, 0.0, sin);
            // Local x along the blade, y along its width, z through its thickness.
            let axes = Matrix3::from_columns(&[along, Vector3::y(), along.cross(&Vector3::y())]);
            let mut turn = Matrix6::zeros();
            turn.fixed_view_mut::<3, 3>(0, 0).copy_from(&axes);
            turn.fixed_view_mut::<3, 3>(3, 3).copy_from(&axes);
            let end = along * (blades.length / 2.0) + Vector3::y() * (side * blades.spacing / 2.0);
            let to_end = turn.transpose() * rigid_motion(&end);
            stiffness += to_end.transpose() * blade.cantilever_stiffness() * to_end;
        }
        let stiffness = (stiffness + stiffness.transpose()) * 0.5;
        let compliance = stiffness.cholesky().map(|factor| factor.inverse());
        let compliance = compliance.ok_or(ElementError::OutOfRange {
            field: "angle",
            value: blades.angle,
            wanted: "farther from 0 and π/2: the blades are nearly parallel",
        })?;
        Ok(Self {
            compliance: (compliance + compliance.transpose()) * 0.5,
        })
    }

    /// Reads the joint from a file.
    ///
    /// # Errors
    /// An argument that is missing, no number or out of its range.
    pub fn read(arguments: &Arguments<'_>) -> Result<ParsedJoint, LoadError> {
        let blades = Blades {
            length: arguments.number("length")?,
            width: arguments.number("width")?,
            thickness: arguments.number("thickness")?,
            angle: arguments.number("angle")?,
            spacing: arguments.number("spacing")?,
        };
        let poisson = Elasticity::Poisson(arguments.number("poisson")?);
        let joint = Material::new(arguments.number("young")?, poisson, None)
            .and_then(|material| Self::new(&blades, &material))
            .map_err(|error| arguments.error(argument(&error), error.to_string()))?;
        Ok(ParsedJoint {
            joint: Box::new(joint),
            orientation: Orientation::Axis(arguments.direction("axis")?),
        })
    }
}

/// The argument that an error is about.
fn argument(error: &ElementError) -> &'static str {
    match error {
        ElementError::OutOfRange { field, .. } if CrossSpring::ARGUMENTS.contains(field) => field,
        // A property of the section, out of the range of double precision.
        _ => "thickness",
    }
}

impl Joint for CrossSpring {
    fn kind(&self) -> &str {
        "CrossSpring"
    }

    /// A hinge about y, for the count of mobility; its stiffness is in the compliance.
    fn free(&self) -> DofSet {
        DofSet::new(&[Dof::V])
    }

    fn compliance(&self) -> Option<Matrix6<f64>> {
        Some(self.compliance)
    }

    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(self.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLADES: Blades = Blades {
        length: 0.05,
        width: 0.01,
        thickness: 0.0005,
        angle: 0.7,
        spacing: 0.012,
    };

    fn steel() -> Material {
        Material::new(2.1e11, Elasticity::Poisson(0.3), None).unwrap()
    }

    fn stiffness(blades: &Blades) -> Matrix6<f64> {
        let compliance = CrossSpring::new(blades, &steel()).unwrap().compliance;
        compliance.try_inverse().unwrap()
    }

    #[test]
    fn it_keeps_the_rules_of_a_joint() {
        let joint = CrossSpring::new(&BLADES, &steel()).unwrap();
        hyperstat_joints::testing::assert_conforms(&joint);
    }

    /// Two blades that cross in their middles turn with `2 E I / L` (J. A. Haringx, The
    /// cross-spring pivot as a constructional element, Applied Scientific Research A1, 1949,
    /// without load), at any angle.
    #[test]
    fn the_stiffness_about_the_axis_is_haringx_s() {
        let second_moment = BLADES.width * BLADES.thickness.powi(3) / 12.0;
        let expected = 2.0 * 2.1e11 * second_moment / BLADES.length;
        for angle in [0.3, std::f64::consts::FRAC_PI_4, 1.2] {
            let blades = Blades { angle, ..BLADES };
            let found = stiffness(&blades)[(4, 4)];
            assert!((found / expected - 1.0).abs() < 1e-9, "{angle}: {found:e}");
        }
    }

    /// In the plane of the blades' crossing each is a bar along itself and a guided beam across:
    /// `K_xx = 2 (cos² EA/L + sin² 12EI/L³)`.
    #[test]
    fn the_stiffness_across_the_axis_is_that_of_bars_and_guided_beams() {
        let (sin, cos) = BLADES.angle.sin_cos();
        let axial = 2.1e11 * BLADES.width * BLADES.thickness / BLADES.length;
        let second_moment = BLADES.width * BLADES.thickness.powi(3) / 12.0;
        let guided = 12.0 * 2.1e11 * second_moment / BLADES.length.powi(3);
        let found = stiffness(&BLADES);
        for (d, bar, beam) in [(0, cos, sin), (2, sin, cos)] {
            let expected = 2.0 * (bar * bar * axial + beam * beam * guided);
            assert!((found[(d, d)] / expected - 1.0).abs() < 1e-9, "{d}");
        }
    }

    /// A pull along the crossed blades' z, one on either side of the middle, turns the pivot
    /// about x: a coupling that a diagonal stiffness could not have.
    #[test]
    fn spacing_couples_pull_and_twist() {
        let coupled = stiffness(&BLADES);
        let scale = (coupled[(0, 0)] * coupled[(3, 3)]).sqrt();
        assert!(coupled[(0, 3)].abs() > 1e-2 * scale);
        let in_line = stiffness(&Blades {
            spacing: 0.0,
            ..BLADES
        });
        assert!(in_line[(0, 3)].abs() < 1e-9 * scale);
    }

    #[test]
    fn blades_that_are_none_are_refused() {
        let cases = [
            (
                Blades {
                    length: 0.0,
                    ..BLADES
                },
                "length",
            ),
            (
                Blades {
                    width: -1.0,
                    ..BLADES
                },
                "width",
            ),
            (
                Blades {
                    thickness: f64::NAN,
                    ..BLADES
                },
                "thickness",
            ),
            (
                Blades {
                    spacing: -0.01,
                    ..BLADES
                },
                "spacing",
            ),
            (
                Blades {
                    angle: 45.0,
                    ..BLADES
                },
                "angle",
            ),
            (
                Blades {
                    angle: 0.0,
                    ..BLADES
                },
                "angle",
            ),
        ];
        for (blades, field) in cases {
            let error = CrossSpring::new(&blades, &steel()).unwrap_err();
            assert_eq!(argument(&error), field, "{error}");
        }
    }
}
