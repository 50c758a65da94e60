//! Stresses of a section from its section wrench (Eq. 47).
//!
//! Included are the normal stress of the normal force and both bending moments, N/A + My z/Iy −
//! Mz y/Iz, and the shear stress of torsion. Left out are the shear stress of the shear forces Vy
//! and Vz (of the order of V/A, largest at the neutral axis where bending gives no stress; small
//! in slender beams), warping, and stress concentrations at joints.
//!
//! | shape | normal | shear | von Mises |
//! |---|---|---|---|
//! | circle, tube | \|N\|/A + √(My² + Mz²) c/I, exact | \|T\| c/J, exact | exact: both peak at the same point of the outer fibre |
//! | rectangle | at a corner, exact | middle of a long side, Roark's series | bound from above: the two peak at different points |
//! | general | bound from above, as if a corner lay at (y_max, z_max) | \|T\| / torsion modulus | bound from above |
//!
//! [`stress_parts`] has the parts of these stresses apart, and the shear stress of the shear
//! forces too.
//!
//! Without loads between its nodes a beam's section wrench is linear along it, so the largest
//! stresses of a prismatic beam are at its ends; where the section changes they may be anywhere,
//! and with distributed loads too: [`stress_along`] finds the largest and where they are.

mod along;
mod parts;
mod search;

pub use along::{BeamStress, Peak, stress_along, von_mises_along};
pub use parts::{StressParts, stress_parts};

use nalgebra::Vector6;

use crate::load::BeamLoad;
use crate::section::{Section, SectionShape};
use crate::taper::Taper;

/// Largest stresses over a section \[Pa\], all positive or zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionStress {
    /// Largest |normal stress| σ, of normal force and bending.
    pub normal: f64,
    /// Largest shear stress τ of torsion; the shear forces' own is not in it.
    pub shear: f64,
    /// Von Mises stress √(σ² + 3τ²) of the two.
    pub von_mises: f64,
}

/// Normal stress \[Pa\] at the point (y, z) \[m\] of a section, positive in tension:
/// N/A + My z/Iy − Mz y/Iz. `wrench` as given by
/// [`Beam::section_wrench`](crate::Beam::section_wrench).
pub fn normal_stress(section: &Section, wrench: &Vector6<f64>, y: f64, z: f64) -> f64 {
    wrench[0] / section.area() + wrench[4] * z / section.iy() - wrench[5] * y / section.iz()
}

/// Largest stresses over a section under a section wrench (N Vy Vz T My Mz, element frame);
/// `None` for a general section without `y_max`, `z_max` and `torsion_modulus`.
pub fn section_stress(section: &Section, wrench: &Vector6<f64>) -> Option<SectionStress> {
    let (y, z) = (section.y_max()?, section.z_max()?);
    let bending_y = wrench[4].abs() * z / section.iy();
    let bending_z = wrench[5].abs() * y / section.iz();
    let bending = match section.shape() {
        SectionShape::Circle { .. } | SectionShape::Tube { .. } => bending_y.hypot(bending_z),
        SectionShape::Rectangle { .. } | SectionShape::General { .. } => bending_y + bending_z,
    };
    let normal = wrench[0].abs() / section.area() + bending;
    let shear = wrench[3].abs() / section.torsion_modulus()?;
    Some(SectionStress {
        normal,
        shear,
        von_mises: normal.hypot(3f64.sqrt() * shear),
    })
}

/// Largest stresses along a beam of this length \[m\] whose section changes, under the wrench
/// `end_wrench` on it at node 2 (element frame) with no load between its nodes; the three may be
/// largest at different places. `None` as for [`section_stress`].
pub fn largest_stress(
    taper: &Taper,
    length: f64,
    end_wrench: &Vector6<f64>,
) -> Option<SectionStress> {
    let found = stress_along(taper, length, end_wrench, &BeamLoad::none())?;
    Some(SectionStress {
        normal: found.normal.value,
        shear: found.torsional.value,
        von_mises: found.von_mises.value,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A round console whose diameter grows linearly from the loaded end: σ = 32 F x / (π d³) is
    /// largest where d is 1.5 times that of the end.
    #[test]
    fn a_tapered_console_is_stressed_most_where_it_is_half_as_thick_again() {
        let circle = |diameter| section(SectionShape::Circle { diameter });
        let taper = Taper::new(circle(0.05), circle(0.02)).unwrap();
        let (length, force) = (0.9, 400.0);
        let load = Vector6::new(0.0, force, 0.0, 0.0, 0.0, 0.0);
        let stress = largest_stress(&taper, length, &load).unwrap();
        let arm = 0.01 / 0.03 * length;
        let expected = 32.0 * force * arm / (std::f64::consts::PI * 0.03f64.powi(3));
        assert!((stress.normal / expected - 1.0).abs() < 1e-14);
        assert_eq!(stress.shear, 0.0);
        assert_eq!(stress.von_mises, stress.normal);
        // Torsion is hardest on the thin end.
        let torque = Vector6::new(0.0, 0.0, 0.0, 7.0, 0.0, 0.0);
        let thin = section_stress(taper.to(), &torque).unwrap().shear;
        let found = largest_stress(&taper, length, &torque).unwrap().shear;
        assert!((found / thin - 1.0).abs() < 1e-14);
    }

    fn section(shape: SectionShape) -> Section {
        Section::new(shape, None, None).unwrap()
    }

    fn general(y_max: Option<f64>, torsion_modulus: Option<f64>) -> Section {
        section(SectionShape::General {
            area: 4e-4,
            iy: 1e-8,
            iz: 2e-8,
            torsion: 2.5e-8,
            y_max,
            z_max: Some(0.01),
            torsion_modulus,
        })
    }

    const WRENCH: [f64; 6] = [-900.0, 55.0, -20.0, 14.0, 33.0, -71.0];

    /// The largest |normal stress| over points of the boundary.
    fn searched(section: &Section, boundary: impl Fn(f64) -> (f64, f64)) -> f64 {
        let at = |k: i32| boundary(f64::from(k) / 20_000.0 * std::f64::consts::TAU);
        (0..20_000)
            .map(at)
            .map(|(y, z)| normal_stress(section, &WRENCH.into(), y, z).abs())
            .fold(0.0, f64::max)
    }

    #[test]
    fn round_sections_are_exact() {
        for shape in [
            SectionShape::Circle { diameter: 0.03 },
            SectionShape::Tube {
                outer: 0.03,
                inner: 0.024,
            },
        ] {
            let section = section(shape);
            let stress = section_stress(&section, &WRENCH.into()).unwrap();
            let found = searched(&section, |t| (0.015 * t.cos(), 0.015 * t.sin()));
            assert!((stress.normal / found - 1.0).abs() < 1e-7);
            let tau = 14.0 * 0.015 / section.torsion();
            assert!((stress.shear / tau - 1.0).abs() < 1e-14);
            let mises = (stress.normal.powi(2) + 3.0 * tau * tau).sqrt();
            assert!((stress.von_mises / mises - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn a_rectangle_is_stressed_most_at_a_corner() {
        let section = section(SectionShape::Rectangle {
            width: 0.02,
            height: 0.04,
        });
        let stress = section_stress(&section, &WRENCH.into()).unwrap();
        let corners = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
        let found = corners
            .map(|(y, z)| normal_stress(&section, &WRENCH.into(), 0.01 * y, 0.02 * z).abs())
            .into_iter()
            .fold(0.0, f64::max);
        assert!((stress.normal / found - 1.0).abs() < 1e-14);
    }

    #[test]
    fn a_general_section_needs_its_outline() {
        assert!(section_stress(&general(None, Some(1e-6)), &WRENCH.into()).is_none());
        assert!(section_stress(&general(Some(0.02), None), &WRENCH.into()).is_none());
        let stress = section_stress(&general(Some(0.02), Some(1e-6)), &WRENCH.into()).unwrap();
        let normal = 900.0 / 4e-4 + 33.0 * 0.01 / 1e-8 + 71.0 * 0.02 / 2e-8;
        assert!((stress.normal / normal - 1.0).abs() < 1e-14);
        assert!((stress.shear / 1.4e7 - 1.0).abs() < 1e-14);
    }
}
