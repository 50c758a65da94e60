//! The worst point of a body: where along its segments and where in their sections the stress is
//! largest.

use hyperstat_elements::stress::{
    BeamStress, Peak, normal_stress, stress_along, stress_parts, von_mises_along,
};
use hyperstat_elements::{SectionStrain, Taper};
use hyperstat_model::{BodyId, Model, Segment, SegmentId, segment_beam};
use nalgebra::Vector6;

use super::solution::{SegmentForces, Solution, State};

/// The point of a body with the largest von Mises stress, of normal and torsional stress (Eq. 47);
/// the shear forces' own stress is not in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorstPoint {
    /// The segment.
    pub segment: SegmentId,
    /// Place along it, 0 at its first node and 1 at its second.
    pub xi: f64,
    /// Section wrench there (N Vy Vz T My Mz, element frame).
    pub section_wrench: Vector6<f64>,
    /// The point (y, z) \[m\] of the section's outline with the largest normal stress.
    pub point: [f64; 2],
    /// Normal stress there \[Pa\], positive in tension.
    pub normal: f64,
    /// Largest shear stress of torsion in the section \[Pa\].
    pub shear: f64,
    /// Von Mises stress of the two \[Pa\].
    pub von_mises: f64,
    /// That over the material's yield strength; `None` where it has none.
    pub utilisation: Option<f64>,
    /// Strains of the section there (Eq. 46), those of temperature included.
    pub section_strain: SectionStrain,
    /// Normal strain at the point, positive in tension, that of temperature included.
    pub normal_strain: f64,
    /// Largest shear strain of torsion in the section.
    pub shear_strain: f64,
}

impl Solution {
    /// The worst point of a body of the model that was solved: that of the largest utilisation
    /// where all its materials have a yield strength, else of the largest von Mises stress. `None`
    /// for a body without beams or of another model, and where no section has stresses.
    pub fn worst_point(&self, model: &Model, body: BodyId) -> Option<WorstPoint> {
        worst_of_body(model, body, &self.segments)
    }
}

impl State {
    /// The worst point of a body in this state, as [`Solution::worst_point`] says.
    pub fn worst_point(&self, model: &Model, body: BodyId) -> Option<WorstPoint> {
        worst_of_body(model, body, &self.segments)
    }
}

/// The worst point of a body, where these are the forces of all segments.
fn worst_of_body(model: &Model, body: BodyId, forces: &[SegmentForces]) -> Option<WorstPoint> {
    let segments = &model.bodies().get(body.0)?.segments;
    let points: Vec<_> = (segments.iter())
        .filter_map(|id| worst_of(model, *id, forces.get(id.0)?))
        .collect();
    let by_utilisation = points.iter().all(|point| point.utilisation.is_some());
    let measure = |point: &WorstPoint| match point.utilisation {
        Some(utilisation) if by_utilisation => utilisation,
        _ => point.von_mises,
    };
    points
        .into_iter()
        .reduce(|a, b| if measure(&b) > measure(&a) { b } else { a })
}

/// The largest stresses along a segment under these forces, each with its place; `None` where its section has
/// no stresses.
pub fn worst_stress(segment: &Segment, forces: &SegmentForces) -> Option<BeamStress> {
    let taper = segment.sections_along().ok()?;
    stress_along(&taper, forces.length, &forces.ends[1], &forces.load)
}

/// The largest von Mises stress along a segment under these forces, with its place; `sections`: those along it.
/// `None` where they have no stresses.
pub fn worst_von_mises(sections: &Taper, forces: &SegmentForces) -> Option<Peak> {
    von_mises_along(sections, forces.length, &forces.ends[1], &forces.load)
}

/// The worst point of a segment.
fn worst_of(model: &Model, id: SegmentId, forces: &SegmentForces) -> Option<WorstPoint> {
    let segment = &model.segments()[id.0];
    let taper = segment.sections_along().ok()?;
    let peak = worst_von_mises(&taper, forces)?;
    let section_wrench = section_wrench(model, id, forces, peak.xi)?;
    let section_strain = section_strain(model, id, forces, peak.xi)?;
    let section = if taper.is_constant() {
        taper.from().clone()
    } else {
        taper.at(peak.xi)
    };
    let parts = stress_parts(&section, &section_wrench)?;
    let [y, z] = parts.point;
    let yields = segment.material.yield_strength();
    Some(WorstPoint {
        segment: id,
        xi: peak.xi,
        section_wrench,
        point: parts.point,
        normal: normal_stress(&section, &section_wrench, y, z),
        shear: parts.torsional,
        von_mises: parts.von_mises,
        utilisation: yields.map(|limit| parts.von_mises / limit),
        section_strain,
        normal_strain: section_strain.normal(y, z),
        shear_strain: parts.torsional / segment.material.shear(),
    })
}

/// Section wrench (N Vy Vz T My Mz, element frame) at `xi` along a segment of the model, 0 at its
/// first node and 1 at its second: what the part beyond exerts on the part before, about the
/// centroid. `None` for a segment that cannot be formed, which none of a solved model is, and for one
/// of another model.
pub fn section_wrench(
    model: &Model,
    segment: SegmentId,
    forces: &SegmentForces,
    xi: f64,
) -> Option<Vector6<f64>> {
    model.check_segment(segment).ok()?;
    let (beam, _, _) = segment_beam(model, model.geometry(), segment).ok()?;
    let beam = beam.straight();
    Some(beam.loaded_section_wrench(xi, &forces.ends[1], &forces.load))
}

/// Strains of the section (Eq. 46) at `xi` along a segment of the model, as [`section_wrench`] has
/// its wrench; those that no force makes, such as those of temperature, are in them.
pub fn section_strain(
    model: &Model,
    segment: SegmentId,
    forces: &SegmentForces,
    xi: f64,
) -> Option<SectionStrain> {
    let (beam, _, _) = segment_beam(model, model.geometry(), segment).ok()?;
    let beam = beam.straight();
    Some(beam.loaded_strain(xi, &forces.ends[1], &forces.load))
}

/// Places along a segment, 0 to 1, at which its section forces are told: its ends, which say it all
/// where no load acts between them, else eighths too.
pub fn stations(forces: &SegmentForces) -> Vec<f64> {
    let load = forces.load;
    let loaded = [0.0, 0.5, 1.0]
        .iter()
        .any(|xi| load.intensity(*xi) != Vector6::zeros());
    let count = if loaded { 8 } else { 1 };
    (0..=count)
        .map(|k| f64::from(k) / f64::from(count))
        .collect()
}
