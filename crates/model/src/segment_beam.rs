//! The beam of a segment, made from the segment's data and a configuration.

use hyperstat_elements::{
    Beam, BeamLoad, ElementError, Material, Section, StraightBeam, Taper, TaperedBeam,
    element_frame,
};
use nalgebra::{Matrix6, Rotation3, Vector3, Vector6};

use crate::model::Model;
use crate::parts::{Geometry, SegmentId};

/// The beam of a segment.
#[allow(clippy::large_enum_variant)] // In a box, each pose would allocate.
#[derive(Debug, Clone)]
pub enum SegmentBeam {
    /// Of one section.
    Prismatic(Beam),
    /// Of a section that changes along it.
    Tapered(TaperedBeam),
}

impl SegmentBeam {
    /// A beam of constant section, or of the one that `taper` says.
    pub fn new(
        material: &Material,
        section: &Section,
        taper: Option<&Taper>,
        length: f64,
    ) -> Result<Self, ElementError> {
        Ok(match taper {
            None => Self::Prismatic(Beam::new(material, section, length)?),
            Some(taper) => Self::Tapered(TaperedBeam::new(material, taper, length)?),
        })
    }

    /// Stiffness at its second node with the first held, element frame.
    pub fn cantilever_stiffness(&self) -> Matrix6<f64> {
        match self {
            Self::Prismatic(beam) => beam.cantilever_stiffness(),
            Self::Tapered(beam) => beam.cantilever_stiffness(),
        }
    }

    /// The same for the beam run through backwards, in the element frame turned by π about z: its
    /// stiffness at the first node with the second held (Eq. 11).
    pub fn reversed_stiffness(&self) -> Matrix6<f64> {
        match self {
            Self::Prismatic(beam) => beam.cantilever_stiffness(),
            Self::Tapered(beam) => beam.reversed().cantilever_stiffness(),
        }
    }

    /// What prismatic and tapered beams have in common.
    pub fn straight(&self) -> &dyn StraightBeam {
        match self {
            Self::Prismatic(beam) => beam,
            Self::Tapered(beam) => beam,
        }
    }

    /// Displacement at `xi` for the displacements of its nodes under the load between them, element
    /// frame.
    pub fn displacement(
        &self,
        xi: f64,
        u1: &Vector6<f64>,
        u2: &Vector6<f64>,
        load: Option<&BeamLoad>,
    ) -> Vector6<f64> {
        match (self, load) {
            (_, Some(load)) => self.straight().loaded_displacement(xi, u1, u2, load),
            (Self::Prismatic(beam), None) => beam.displacement(xi, u1, u2),
            (Self::Tapered(beam), None) => beam.displacement(xi, u1, u2),
        }
    }
}

/// Beam of a segment, its frame and span in a configuration.
pub fn segment_beam(
    model: &Model,
    geometry: &Geometry,
    id: SegmentId,
) -> Result<(SegmentBeam, Rotation3<f64>, Vector3<f64>), ElementError> {
    let segment = &model.segments()[id.0];
    let [a, b] = segment.ends.map(|n| geometry.positions[n.0]);
    let span = b - a;
    let frame = element_frame(&span, geometry.y_axes[id.0].as_ref())?;
    let taper = segment.change_of_section()?;
    let (material, section) = (&segment.material, &segment.section);
    let beam = SegmentBeam::new(material, section, taper.as_ref(), span.norm())?;
    Ok((beam, frame, span))
}

/// The beam of a segment as if it were of unit length.
pub fn unit_beam(model: &Model, id: SegmentId) -> Option<SegmentBeam> {
    let segment = &model.segments()[id.0];
    let material = &segment.material;
    match segment.change_of_section().ok()? {
        None => Beam::new(material, &segment.section, 1.0)
            .ok()
            .map(SegmentBeam::Prismatic),
        Some(taper) => TaperedBeam::new(material, &taper, 1.0)
            .ok()
            .map(SegmentBeam::Tapered),
    }
}
