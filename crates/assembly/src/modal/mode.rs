//! Natural modes as they are told.

use hyperstat_elements::{element_frame, rotate_vector6};
use hyperstat_model::{BodyId, Model, SegmentId};
use nalgebra::Vector6;

use crate::error::SolveError;
use crate::modal::shape::Curve;

/// A natural mode.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Mode {
    /// Natural frequency \[Hz\]; zero for a motion of the output that nothing resists.
    pub frequency: f64,
    /// Displacement of every node by `NodeId`, global axes \[m/√kg, rad/√kg\]: of unit modal mass,
    /// φᵀ M φ = 1. Of equal frequencies any orthonormal combination is as good.
    pub displacements: Vec<Vector6<f64>>,
    /// The same of the nodes inside every segment, by `SegmentId`, from its first end on.
    pub inner: Vec<Vec<Vector6<f64>>>,
    /// Effective mass in a translation of the ground along x, y and z \[kg\]; over all modes they
    /// add to the mass that can move.
    pub effective_mass: [f64; 3],
    /// Share of every body in the kinetic energy, by `BodyId`; they add to 1.
    pub kinetic: Vec<f64>,
    /// ‖ω² K⁻¹ M φ − φ‖ in the mass, φ having length 1: ω² is good to about its square.
    pub residual: f64,
    /// What every segment does along it.
    pub(super) curves: Vec<Curve>,
}

impl Mode {
    /// The bodies that have most of the kinetic energy, largest first.
    pub fn most_moved(&self) -> Vec<(BodyId, f64)> {
        let bodies = self.kinetic.iter().enumerate();
        let mut shares: Vec<_> = bodies.map(|(k, share)| (BodyId(k), *share)).collect();
        shares.sort_by(|a, b| b.1.total_cmp(&a.1));
        shares
    }

    /// Displacement of the axis of a segment at `xi` (0 to 1) along it, global axes
    /// \[m/√kg, rad/√kg\]: the mode's own shape where masses are exact; else between the nodes of its
    /// elements the beam's own static curve, which are the shapes that the masses are made with
    /// (cubic for a prismatic beam without shear).
    ///
    /// `model` is the one whose mode it is, in its own configuration.
    ///
    /// # Errors
    /// A segment or model that is not the mode's.
    pub fn segment_displacement(
        &self,
        model: &Model,
        id: SegmentId,
        xi: f64,
    ) -> Result<Vector6<f64>, SolveError> {
        model.check_segment(id)?;
        if self.displacements.len() != model.nodes().len()
            || self.curves.len() != model.segments().len()
        {
            return Err(SolveError::ForeignModel);
        }
        let (segment, geometry) = (&model.segments()[id.0], model.geometry());
        let [start, end] = segment.ends.map(|node| geometry.positions[node.0]);
        let frame = element_frame(&(end - start), geometry.y_axes[id.0].as_ref())?;
        Ok(rotate_vector6(&self.curves[id.0].at(xi), &frame))
    }
}

/// Natural frequencies and modes of one configuration.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Modes {
    /// The modes, lowest first.
    pub modes: Vec<Mode>,
    /// Mass of all beams and nodes \[kg\].
    pub mass: f64,
    /// Motions without energy that leave the output where it is, and have mass: their frequency is
    /// zero, and they are not among the modes.
    pub idle: usize,
    /// Whether a count of all frequencies below the last one (Sylvester's law of inertia) says
    /// that none is missing.
    pub complete: bool,
    /// How many there are below which frequency, by that count.
    pub counted: Option<Counted>,
}

/// A count of frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Counted {
    /// The frequency \[Hz\] below which they were counted: in the gap after the last that was asked
    /// for, or after those that equal it.
    pub below: f64,
    /// Their number, with those of the output's free motions, which are zero, and without the idle
    /// ones.
    pub modes: usize,
    /// How many of them were found: the same where none is missing.
    pub found: usize,
}
