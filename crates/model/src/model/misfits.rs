//! Misfits and preloads of a model's joints.

use hyperstat_joints::DofSet;
use nalgebra::Vector6;

use crate::directions::Directions;
use crate::error::ModelError;
use crate::model::Model;
use crate::parts::{JointId, Misfit};
use crate::revision::fresh_revision;

impl Model {
    /// Makes the second body of a joint stand off from the first by `misfit` when no force acts:
    /// by directions of the joint, x y z (m), u v w (rad). Along rigid and locked directions
    /// `Δ_second − Δ_first` is the misfit, in elastic ones their springs are at rest there. It acts
    /// in every case. A misfit of a joint with the ground is a support that settles.
    ///
    /// # Errors
    /// One that is not finite, or not zero along a free direction; a joint that is not one of this
    /// model.
    pub fn set_misfit(&mut self, joint: JointId, misfit: &Vector6<f64>) -> Result<(), ModelError> {
        let what = "a misfit";
        self.check_entry(
            joint,
            misfit,
            what,
            |own| own.free,
            |joint, direction| ModelError::FreeMisfit { joint, direction },
        )?;
        self.change_misfit(joint, |entry| entry.misfit = *misfit);
        Ok(())
    }

    /// Presses the two bodies of a joint on each other: with the wrench `preload` on the second
    /// and its opposite on the first, by directions of the joint, x y z (N), u v w (N·m). It acts
    /// in every case.
    ///
    /// # Errors
    /// One that is not finite, or not zero along a rigid direction; a joint that is not one of this
    /// model.
    pub fn set_preload(
        &mut self,
        joint: JointId,
        preload: &Vector6<f64>,
    ) -> Result<(), ModelError> {
        let what = "a preload";
        self.check_entry(
            joint,
            preload,
            what,
            |own| own.rigid,
            |joint, direction| ModelError::RigidPreload { joint, direction },
        )?;
        self.change_misfit(joint, |entry| entry.preload = *preload);
        Ok(())
    }

    /// The joints that have a misfit or a preload, in their order.
    pub fn misfits(&self) -> &[Misfit] {
        &self.misfits
    }

    /// The misfit and preload of a joint; `None` where it has neither.
    pub fn misfit(&self, joint: JointId) -> Option<&Misfit> {
        let place = self
            .misfits
            .binary_search_by_key(&joint, |e| e.joint)
            .ok()?;
        Some(&self.misfits[place])
    }

    /// Refuses numbers that are not finite, and any along directions without meaning for them.
    fn check_entry(
        &self,
        joint: JointId,
        values: &Vector6<f64>,
        what: &'static str,
        senseless: impl Fn(&Directions) -> DofSet,
        refuse: impl Fn(String, hyperstat_joints::Dof) -> ModelError,
    ) -> Result<(), ModelError> {
        if !values.iter().all(|value| value.is_finite()) {
            return Err(ModelError::NotFinite { what });
        }
        self.check_joint(joint)?;
        let connection = &self.joints[joint.0];
        let mut wrong = senseless(&Directions::of(connection)).iter();
        match wrong.find(|direction| values[direction.index()] != 0.0) {
            Some(direction) => Err(refuse(connection.name.clone(), direction)),
            None => Ok(()),
        }
    }

    /// Changes the entry of a joint; there is none that says nothing.
    fn change_misfit(&mut self, joint: JointId, change: impl Fn(&mut Misfit)) {
        self.acting = fresh_revision();
        let place = self.misfits.partition_point(|entry| entry.joint < joint);
        if self.misfits.get(place).is_none_or(|e| e.joint != joint) {
            let none = Misfit {
                joint,
                misfit: Vector6::zeros(),
                preload: Vector6::zeros(),
            };
            self.misfits.insert(place, none);
        }
        let entry = &mut self.misfits[place];
        change(entry);
        if entry.misfit == Vector6::zeros() && entry.preload == Vector6::zeros() {
            self.misfits.remove(place);
        }
    }
}
