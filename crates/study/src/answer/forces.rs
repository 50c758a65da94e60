//! Forces along segments and the worst point of every body.

use hyperstat_assembly::{
    BodyId, Model, SegmentForces, SegmentId, WorstPoint, section_wrench, stations,
};
use serde::Serialize;

use super::numbers;
use crate::entries::Entries;

/// Forces on a section of a segment.
#[derive(Debug, Serialize)]
pub struct SectionForces {
    /// Place along the segment, 0 at its first node and 1 at its second.
    pub at: f64,
    /// N Vy Vz T My Mz, element frame.
    pub wrench: [f64; 6],
}

/// What is found of a body.
#[derive(Debug, Serialize)]
pub struct BodyReport {
    /// The point with the largest stress; none of a body without beams.
    pub worst: Option<WorstReport>,
}

/// A point of a body and its stresses.
#[derive(Debug, Serialize)]
pub struct WorstReport {
    /// Names of the points at the segment's first and second node.
    pub segment: [String; 2],
    /// Place along the segment, 0 to 1.
    pub at: f64,
    /// The point of the section, element frame \[m\].
    pub y: f64,
    /// Its other coordinate \[m\].
    pub z: f64,
    /// Normal stress \[Pa\].
    pub normal: f64,
    /// Largest shear stress of torsion \[Pa\].
    pub shear: f64,
    /// Equivalent stress \[Pa\].
    pub von_mises: f64,
    /// Equivalent stress over the limit of the material, where it has one.
    pub utilisation: Option<f64>,
    /// Strains there.
    pub strain: StrainReport,
}

/// Strains at a point of a section (Eq. 46), those of temperature included.
#[derive(Debug, Serialize)]
pub struct StrainReport {
    /// At the point, positive in tension.
    pub normal: f64,
    /// The largest of torsion in the section.
    pub shear: f64,
    /// ε γ_y γ_z κ_x κ_y κ_z of the section, element frame [–, 1/m].
    pub section: [f64; 6],
}

/// Section forces of a segment at the places where they are told.
pub(super) fn section_forces(
    model: &Model,
    segment: SegmentId,
    forces: &SegmentForces,
) -> Vec<SectionForces> {
    let stations = stations(forces).into_iter();
    let at = |at: f64| {
        let wrench = section_wrench(model, segment, forces, at)?;
        let wrench = numbers(&wrench);
        Some(SectionForces { at, wrench })
    };
    stations.filter_map(at).collect()
}

/// What is found of every body, by its worst point.
pub(super) fn bodies(
    model: &Model,
    worst_point: impl Fn(BodyId) -> Option<WorstPoint>,
) -> Entries<BodyReport> {
    let bodies = model.bodies().iter().enumerate();
    bodies
        .map(|(k, body)| {
            let worst = worst_point(BodyId(k)).map(|found| {
                let ends = model.segments()[found.segment.0].ends;
                WorstReport {
                    segment: ends.map(|node| model.nodes()[node.0].point.clone()),
                    at: found.xi,
                    y: found.point[0],
                    z: found.point[1],
                    normal: found.normal,
                    shear: found.shear,
                    von_mises: found.von_mises,
                    utilisation: found.utilisation,
                    strain: StrainReport {
                        normal: found.normal_strain,
                        shear: found.shear_strain,
                        section: found.section_strain.into(),
                    },
                }
            });
            (body.name.clone(), BodyReport { worst })
        })
        .collect()
}

impl WorstReport {}
