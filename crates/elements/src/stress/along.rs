//! The largest stresses along a beam, with distributed loads, and where they are.

use nalgebra::Vector6;

use super::parts::{StressParts, stress_parts};
use super::search::{convex_maximum, maximum};
use super::section_stress;
use crate::bernstein::Bernstein;
use crate::load::BeamLoad;
use crate::material::Material;
use crate::section::Section;
use crate::taper::Taper;

/// The largest of a stress along a beam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// The stress \[Pa\], positive or zero.
    pub value: f64,
    /// Where it is, 0 at node 1 and 1 at node 2; where it is as large in several places, one of
    /// them.
    pub xi: f64,
}

impl Peak {
    /// This or the other, whichever is larger.
    pub(super) fn improve(&mut self, value: f64, xi: f64) {
        if value > self.value {
            *self = Self { value, xi };
        }
    }
}

/// The largest stresses along a beam, each of its own place; see [`StressParts`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamStress {
    /// |N|/A.
    pub axial: Peak,
    /// Normal stress of both bending moments.
    pub bending: Peak,
    /// Shear stress of torsion.
    pub torsional: Peak,
    /// Shear stress of the shear forces; `None` for a general section.
    pub transverse: Option<Peak>,
    /// Normal stress of normal force and bending.
    pub normal: Peak,
    /// Von Mises stress of normal and torsional stress.
    pub von_mises: Peak,
    /// Bound of the von Mises stress with the shear forces; `None` for a general section.
    pub von_mises_bound: Option<Peak>,
}

impl BeamStress {
    /// The largest von Mises stress as a part of the material's yield strength: 1 where yielding
    /// begins. The bound with the shear forces where there is one. `None` where the material has
    /// no yield strength.
    pub fn utilisation(&self, material: &Material) -> Option<f64> {
        let stress = self.von_mises_bound.unwrap_or(self.von_mises).value;
        Some(stress / material.yield_strength()?)
    }
}

/// The largest stresses along a beam of this length \[m\] under `load` and `end_wrench`, the wrench
/// on it at node 2 (element frame). `taper`: its sections, [`Taper::constant`] for a prismatic
/// beam. `None` for a general section without `y_max`, `z_max` and `torsion_modulus`.
///
/// Along a prismatic beam the values are right to 1e-12 of themselves, by a search with bounds that
/// misses no peak. Along a tapered one the peaks are found among 257 places and refined: one
/// narrower than 1/128 of the length could be missed.
pub fn stress_along(
    taper: &Taper,
    length: f64,
    end_wrench: &Vector6<f64>,
    load: &BeamLoad,
) -> Option<BeamStress> {
    let wrenches = load.section_wrenches(length, end_wrench);
    // A section without its outline has no stresses anywhere.
    let sample = stress_parts(taper.from(), end_wrench)?;
    let find = |stress: fn(&StressParts) -> f64| {
        largest(taper, &wrenches, |section, wrench| {
            stress_parts(section, wrench).map_or(0.0, |parts| stress(&parts))
        })
    };
    let find_optional = |stress: fn(&StressParts) -> f64| sample.transverse.map(|_| find(stress));
    Some(BeamStress {
        axial: find(|s| s.axial.abs()),
        bending: find(|s| s.bending),
        torsional: find(|s| s.torsional),
        transverse: find_optional(|s| s.transverse.unwrap_or(0.0)),
        normal: find(|s| s.normal),
        von_mises: find(|s| s.von_mises),
        von_mises_bound: find_optional(|s| s.von_mises_bound.unwrap_or(0.0)),
    })
}

/// The largest von Mises stress of normal and torsional stress along a beam: that of [`stress_along`], without
/// the others.
pub fn von_mises_along(
    taper: &Taper,
    length: f64,
    end_wrench: &Vector6<f64>,
    load: &BeamLoad,
) -> Option<Peak> {
    let value = |section: &Section, wrench: &Vector6<f64>| {
        section_stress(section, wrench).map_or(0.0, |stress| stress.von_mises)
    };
    section_stress(taper.from(), end_wrench)?;
    let wrenches = load.section_wrenches(length, end_wrench);
    if load.is_forceless() && taper.is_constant() {
        // A convex function of what is linear is largest at an end.
        let [first, .., last] = wrenches.0;
        let mut peak = Peak {
            value: value(taper.from(), &first),
            xi: 0.0,
        };
        peak.improve(value(taper.from(), &last), 1.0);
        return Some(peak);
    }
    Some(largest(taper, &wrenches, value))
}

/// The largest value along a beam of a stress of a section, a convex function of the section wrench.
fn largest(
    taper: &Taper,
    wrenches: &Bernstein<5>,
    stress: impl Fn(&Section, &Vector6<f64>) -> f64,
) -> Peak {
    match taper.is_constant() {
        true => convex_maximum(wrenches, |wrench| stress(taper.from(), wrench)),
        false => maximum(|xi| stress(&taper.at(xi), &wrenches.at(xi))),
    }
}
