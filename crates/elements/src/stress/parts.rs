//! The parts of a section's stresses.

use nalgebra::Vector6;

use super::section_stress;
use crate::section::{Section, SectionShape};

/// Stresses of a section by what makes them \[Pa\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StressParts {
    /// Normal stress of the normal force, N/A, positive in tension.
    pub axial: f64,
    /// Largest |normal stress| of both bending moments.
    pub bending: f64,
    /// Largest shear stress of torsion.
    pub torsional: f64,
    /// Largest shear stress of the shear forces, by elementary beam theory (Roark, §8.1): at the
    /// neutral axis, 4/3 V/A in a circle, 4/3 V/A (D² + D d + d²)/(D² + d²) in a tube, 3/2 V/A in
    /// a rectangle. `None` for a general section, whose outline is not known.
    pub transverse: Option<f64>,
    /// Largest |normal stress|, |axial| + bending.
    pub normal: f64,
    /// Von Mises stress of normal and torsional stress, as
    /// [`SectionStress`](super::SectionStress) has it, without that of the shear forces.
    pub von_mises: f64,
    /// Bound from above of the von Mises stress with the shear forces, as if all parts were
    /// largest at one point: √(σ² + 3 (τ_torsion + τ_transverse)²). `None` for a general section.
    pub von_mises_bound: Option<f64>,
    /// The point (y, z) \[m\] of the outline with the largest |normal stress|; of a general
    /// section the corner (±y_max, ±z_max) of the bound.
    pub point: [f64; 2],
}

/// The parts of the stresses of a section under a section wrench (N Vy Vz T My Mz, element
/// frame); `None` for a general section without `y_max`, `z_max` and `torsion_modulus`.
pub fn stress_parts(section: &Section, wrench: &Vector6<f64>) -> Option<StressParts> {
    let whole = section_stress(section, wrench)?;
    let axial = wrench[0] / section.area();
    let without_force = Vector6::new(0.0, 0.0, 0.0, wrench[3], wrench[4], wrench[5]);
    let bending = section_stress(section, &without_force)?.normal;
    let transverse = transverse_stress(section, wrench[1], wrench[2]);
    let bound = |transverse: f64| whole.normal.hypot(3f64.sqrt() * (whole.shear + transverse));
    Some(StressParts {
        axial,
        bending,
        torsional: whole.shear,
        transverse,
        normal: whole.normal,
        von_mises: whole.von_mises,
        von_mises_bound: transverse.map(bound),
        point: worst_point(section, wrench)?,
    })
}

/// Largest shear stress of the shear forces Vy and Vz. In a rectangle both are largest at the
/// centroid; a round section has one shear force.
fn transverse_stress(section: &Section, along_y: f64, along_z: f64) -> Option<f64> {
    let factor = match *section.shape() {
        SectionShape::Circle { .. } => 4.0 / 3.0,
        SectionShape::Tube { outer, inner } => {
            let part = inner / outer;
            4.0 / 3.0 * (1.0 + part + part * part) / (1.0 + part * part)
        }
        SectionShape::Rectangle { .. } => 1.5,
        SectionShape::General { .. } => return None,
    };
    Some(factor * along_y.hypot(along_z) / section.area())
}

/// The point of the outline where the normal stress of bending has the sign of the normal force
/// (tension, where there is none) and is largest.
fn worst_point(section: &Section, wrench: &Vector6<f64>) -> Option<[f64; 2]> {
    let (y, z) = (section.y_max()?, section.z_max()?);
    let sign = if wrench[0] < 0.0 { -1.0 } else { 1.0 };
    let (towards_y, towards_z) = (-sign * wrench[5], sign * wrench[4]);
    let reach = towards_y.hypot(towards_z);
    Some(match section.shape() {
        _ if reach == 0.0 => [0.0, 0.0],
        SectionShape::Circle { .. } | SectionShape::Tube { .. } => {
            [y * towards_y / reach, z * towards_z / reach]
        }
        SectionShape::Rectangle { .. } | SectionShape::General { .. } => {
            [y.copysign(towards_y), z.copysign(towards_z)]
        }
    })
}

#[cfg(test)]
mod tests {
    use super::super::normal_stress;
    use super::*;

    const WRENCH: [f64; 6] = [-900.0, 55.0, -20.0, 14.0, 33.0, -71.0];

    fn shapes() -> [SectionShape; 3] {
        [
            SectionShape::Circle { diameter: 0.03 },
            SectionShape::Tube {
                outer: 0.03,
                inner: 0.024,
            },
            SectionShape::Rectangle {
                width: 0.02,
                height: 0.04,
            },
        ]
    }

    #[test]
    fn parts_make_the_whole_and_the_point_has_it() {
        for (shape, sign) in shapes().into_iter().zip([1.0, -1.0, 1.0]) {
            let section = Section::new(shape, None, None).unwrap();
            let wrench = Vector6::from(WRENCH) * sign;
            let parts = stress_parts(&section, &wrench).unwrap();
            let whole = section_stress(&section, &wrench).unwrap();
            assert_eq!((parts.normal, parts.torsional), (whole.normal, whole.shear));
            assert_eq!(parts.axial, sign * -900.0 / section.area());
            let sum = parts.axial.abs() + parts.bending;
            assert!((sum / whole.normal - 1.0).abs() < 1e-15);
            let [y, z] = parts.point;
            let there = normal_stress(&section, &wrench, y, z);
            assert!(
                (there / (-sign * whole.normal) - 1.0).abs() < 1e-14,
                "{there}"
            );
            assert!(parts.von_mises_bound.unwrap() > parts.von_mises);
        }
    }

    /// τ = V Q / (I b) at the neutral axis, with Q the first moment of half the section.
    #[test]
    fn shear_stress_follows_from_the_first_moment() {
        let force = 700.0;
        let wrench = Vector6::new(0.0, 0.0, force, 0.0, 0.0, 0.0);
        let half_disc = |d: f64| d.powi(3) / 12.0;
        let firsts = [
            (half_disc(0.03), 0.03),
            (half_disc(0.03) - half_disc(0.024), 0.03 - 0.024),
            (0.02 * 0.04 * 0.04 / 8.0, 0.02),
        ];
        for (shape, (first, width)) in shapes().into_iter().zip(firsts) {
            let section = Section::new(shape, None, None).unwrap();
            let found = stress_parts(&section, &wrench).unwrap().transverse.unwrap();
            let expected = force * first / (section.iy() * width);
            assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
        }
    }
}
