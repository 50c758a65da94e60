//! What gives at a pose whose forces are known: segments and joints with all of theirs that is the same at every
//! pose, and the work that the forces under a wrench do on what they give in a state.

use hyperstat_elements::BeamLoad;
use hyperstat_joints::DofSet;
use hyperstat_model::{Directions, Geometry, JointId, Model, SegmentId, segment_beam};
use nalgebra::{Matrix6, Vector6};

use crate::answer::forces::Forces;
use crate::answer::solution::SegmentForces;
use crate::error::SolveError;
use crate::state::preload::along;

/// All segments and joints of a model.
#[derive(Debug)]
pub(crate) struct Gives {
    pub segments: Vec<SegmentGive>,
    pub joints: Vec<JointGive>,
}

/// How a segment gives.
#[derive(Debug)]
pub(crate) struct SegmentGive {
    id: SegmentId,
    /// Compliance of its section, where that is the same all along.
    alike: Option<Vector6<f64>>,
}

/// How a joint gives along its directions.
#[derive(Debug)]
pub(crate) struct JointGive {
    id: JointId,
    pub directions: Directions,
    /// Those that are free by its kind.
    pub free: DofSet,
    to_directions: Matrix6<f64>,
    compliance: Matrix6<f64>,
    preload: Vector6<f64>,
}

impl Gives {
    /// Those of a model whose joints' stiffnesses all have an inverse.
    ///
    /// # Errors
    /// A section that cannot be formed, which no segment of a model has.
    pub fn of(model: &Model) -> Result<Self, SolveError> {
        let segments = (0..model.segments().len()).map(|k| SegmentGive::of(model, SegmentId(k)));
        let joints = (0..model.joints().len()).map(|k| JointGive::of(model, JointId(k)));
        Ok(Self {
            segments: segments.collect::<Result<_, _>>()?,
            joints: joints.collect(),
        })
    }
}

impl SegmentGive {
    pub fn of(model: &Model, id: SegmentId) -> Result<Self, SolveError> {
        let constant = model.segments()[id.0].sections_along()?.is_constant();
        let alike = match constant {
            true => {
                let (beam, ..) = segment_beam(model, model.geometry(), id)?;
                Some(beam.straight().section_compliance_at(0.0))
            }
            false => None,
        };
        Ok(Self { id, alike })
    }

    /// Work of the forces in `unit`, of a wrench on the output alone, on what the segment gives in another
    /// state, by parts: tension, shear along y and z, torsion, bending about y and z. `None` where its section
    /// changes or anything acts along it.
    pub fn work(&self, unit: &Forces, loaded: &Forces) -> Option<Vector6<f64>> {
        let give = self.alike?;
        let [unit, loaded] = [unit, loaded].map(|own| &own.segments[self.id.0]);
        if !loaded.load.is_forceless() {
            return None;
        }
        // ∫ W̄ c W dx with both wrenches linear along it.
        let ([a, b], [p, q]) = (section_wrenches(unit), section_wrenches(loaded));
        let both = a.component_mul(&(p * 2.0 + q)) + b.component_mul(&(p + q * 2.0));
        Some(both.component_mul(&give) * (unit.length / 6.0))
    }

    /// The same of any segment, and the work on strains that no force makes.
    ///
    /// # Errors
    /// A segment that cannot be formed, which none of a solved model is.
    pub fn works(
        &self,
        (model, geometry): (&Model, &Geometry),
        unit: &Forces,
        loaded: &Forces,
    ) -> Result<(Vector6<f64>, f64), SolveError> {
        let [own, other] = [unit, loaded].map(|own| &own.segments[self.id.0]);
        let elastic = self.work(unit, loaded);
        if let (Some(elastic), true) = (elastic, other.load == BeamLoad::none()) {
            return Ok((elastic, 0.0));
        }
        let (beam, ..) = segment_beam(model, geometry, self.id)?;
        let beam = beam.straight();
        let elastic = elastic.unwrap_or_else(|| {
            let all = |_| Vector6::repeat(1.0);
            beam.elastic_work(&other.ends[1], &other.load, &own.ends[1], &all)
        });
        Ok((elastic, beam.free_work(&other.load, &own.ends[1]).sum()))
    }
}

/// The section wrenches at both ends of a segment that nothing acts along.
fn section_wrenches(own: &SegmentForces) -> [Vector6<f64>; 2] {
    let [_, last] = own.ends;
    let mut first = last;
    first[4] -= own.length * last[2];
    first[5] += own.length * last[1];
    [first, last]
}

impl JointGive {
    pub fn of(model: &Model, id: JointId) -> Self {
        let joint = &model.joints()[id.0];
        let directions = Directions::of(joint);
        let entry = model.misfit(id);
        let preload = entry.map(|entry| along(&entry.preload, directions.elastic));
        Self {
            id,
            free: joint.joint.free(),
            to_directions: joint.joint.basis().transpose(),
            compliance: directions.compliance.unwrap_or_else(Matrix6::zeros),
            preload: preload.unwrap_or_else(Vector6::zeros),
            directions,
        }
    }

    /// The force on its second body along every direction.
    pub fn force(&self, own: &Forces) -> Option<Vector6<f64>> {
        Some(self.to_directions * own.joint_wrenches[self.id.0]?)
    }

    /// Work of the forces in `unit`, of a wrench on the output alone, on what its springs give in another
    /// state, along every direction; `preloaded`: whether that is one of the model's own, with its preloads.
    pub fn work(&self, unit: &Forces, loaded: &Forces, preloaded: bool) -> Vector6<f64> {
        let elastic = self.directions.elastic;
        if elastic.is_empty() {
            return Vector6::zeros();
        }
        let force = |own: &Forces| along(&self.force(own).unwrap_or_else(Vector6::zeros), elastic);
        let mut other = force(loaded);
        if preloaded {
            other -= self.preload;
        }
        force(unit).component_mul(&(self.compliance * other))
    }
}
