//! What acts in a state, as the floor that its numbers are measured by.
//!
//! A displacement or force that is truly zero comes out as the rounding of what cancels in it. Beside
//! the largest number of its own kind that says nothing where all of them are zero: a misfit that
//! nothing holds back leaves wrenches of 1e-27 N, and nothing else. So numbers are measured by what
//! loads, preloads, misfits and heat could make of them: the solver tells results from rounding
//! by it, and all comparisons with another solver have their floor from it.

use hyperstat_model::{Directions, Model};
use nalgebra::{Matrix6, Vector6};

use super::acting::Acting;
use super::preload::spring_misfit;
use crate::error::SolveError;
use crate::posture::Posture;

/// Numbers below this share of what acts are rounding: some tens of a double's last bit.
pub(crate) const ROUNDING: f64 = 1e-14;
/// Numbers below this share of what acts are compared with it, not with each other.
const COMPARED: f64 = 1e-4;
/// Diagonal entries of a stiffness or compliance below this share of the largest of their block
/// are zero: a direction in which the output is free, or held.
const ZERO: f64 = 1e-12;

/// What acts in a state: the displacement and the force that it could make.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Floor {
    /// The mechanism's size \[m\]: rotations and moments count with it.
    pub size: f64,
    /// Stiffness of the stiffest elastic body, of the stiffest spring where there is none; zero
    /// where nothing is elastic \[N/m\].
    pub stiffness: f64,
    /// The largest of the misfits, of the heated beams' growths, and of what the loads give the
    /// stiffest body \[m\].
    pub displacement: f64,
    /// The largest of the loads, of the preloads, of the forces that hold a heated beam to its
    /// length, and of those that hold a misfit back \[N\].
    pub force: f64,
}

impl Floor {
    /// What acts in a model under its own loads.
    ///
    /// # Errors
    /// Loads in axes that are not known, a weight without density.
    pub fn of(model: &Model) -> Result<Self, SolveError> {
        let at = Posture::new(model, model.geometry());
        let acting = Acting::of_model(&at)?;
        let own = acting.first().ok_or(SolveError::NoOutput)?;
        Ok(Self::at_rest(&at).under(&at, own))
    }

    /// Of a model on which nothing acts.
    pub(crate) fn at_rest(at: &Posture<'_>) -> Self {
        Self {
            size: at.size,
            stiffness: stiffest(at),
            displacement: 0.0,
            force: 0.0,
        }
    }

    /// The same mechanism with nothing that acts.
    pub(crate) fn of_nothing(self) -> Self {
        Self {
            displacement: 0.0,
            force: 0.0,
            ..self
        }
    }

    /// With a wrench on a node.
    pub(crate) fn under_wrench(mut self, wrench: &Vector6<f64>) -> Self {
        self.add_force(self.as_force(wrench));
        self
    }

    /// With what acts in a state.
    pub(crate) fn under(mut self, at: &Posture<'_>, acting: &Acting) -> Self {
        let Posture {
            model, geometry, ..
        } = *at;
        for (_, wrench) in &acting.nodes {
            self.add_force(self.as_force(wrench));
        }
        for (id, load) in acting.segments() {
            let segment = &model.segments()[id.0];
            let [a, b] = segment.ends.map(|node| geometry.positions[node.0]);
            let length = (b - a).norm();
            let largest = [0.0, 0.5, 1.0].map(|at| self.as_force(&load.intensity(at)));
            self.add_force(largest.into_iter().fold(0.0, f64::max) * length);
            let strain = load.free_strain().axial.abs();
            self.add_displacement(strain * length);
            self.add_force(segment.material.young() * segment.section.area() * strain);
        }
        if acting.misfits {
            self.add_misfits(model);
        }
        self
    }

    fn add_misfits(&mut self, model: &Model) {
        for entry in model.misfits() {
            let joint = &model.joints()[entry.joint.0];
            let directions = Directions::of(joint);
            let basis = joint.joint.basis();
            self.add_force(self.as_force(&entry.preload));
            let apart = basis * (entry.misfit + spring_misfit(&directions, entry));
            self.displacement = self.displacement.max(self.as_displacement(&apart));
            for k in 0..6 {
                let own = directions.stiffness[(k, k)];
                let own = if k < 3 { own } else { own / self.size.powi(2) };
                // The spring and what it is fastened to give one after the other.
                let holds = match (own > 0.0, self.stiffness > 0.0) {
                    (true, true) => own.min(self.stiffness),
                    (true, false) => own,
                    (false, _) => self.stiffness,
                };
                let mut along = Vector6::zeros();
                along[k] = entry.misfit[k];
                self.force = self
                    .force
                    .max(holds * self.as_displacement(&(basis * along)));
            }
        }
    }

    fn add_force(&mut self, force: f64) {
        self.force = self.force.max(force);
        if self.stiffness > 0.0 {
            self.displacement = self.displacement.max(force / self.stiffness);
        }
    }

    fn add_displacement(&mut self, displacement: f64) {
        self.displacement = self.displacement.max(displacement);
    }

    /// The size of a displacement \[m\]: its rotation counts with the mechanism's size.
    pub fn as_displacement(&self, displacement: &Vector6<f64>) -> f64 {
        let [linear, angular] = largest(displacement);
        linear.max(angular * self.size)
    }

    /// The size of a wrench \[N\]: its moment counts over the mechanism's size.
    pub fn as_force(&self, wrench: &Vector6<f64>) -> f64 {
        let [force, moment] = largest(wrench);
        force.max(moment / self.size)
    }

    /// What differences of displacements are measured by where all of them are smaller \[m\].
    pub fn least_displacement(&self) -> f64 {
        COMPARED * self.displacement
    }

    /// What differences of forces are measured by where all of them are smaller \[N\].
    pub fn least_force(&self) -> f64 {
        COMPARED * self.force
    }

    /// What a work is measured by where it is smaller \[J\].
    pub(crate) fn least_work(&self) -> f64 {
        self.least_displacement() * self.least_force()
    }

    /// Translations \[m\] and rotations \[rad\] below these are rounding.
    pub fn rounding(&self) -> [f64; 2] {
        let linear = ROUNDING * self.displacement;
        [linear, linear / self.size]
    }

    /// What is rounding in the part of a displacement along a unit wrench.
    pub fn rounding_along(&self, displacement: &Vector6<f64>, along: &Vector6<f64>) -> f64 {
        let [linear, angular] = self.rounding();
        let terms = displacement.component_mul(along).abs();
        let own = Vector6::from_fn(|k, _| if k < 3 { linear } else { angular });
        ROUNDING * terms.sum() + own.dot(&along.abs())
    }

    /// Sets what is rounding in a displacement to zero.
    pub(crate) fn clear_displacement(&self, displacement: &mut Vector6<f64>) {
        clear(displacement, self.rounding());
    }

    /// A displacement without what is rounding in it.
    pub(crate) fn cleared(&self, displacement: &Vector6<f64>) -> Vector6<f64> {
        let mut own = *displacement;
        self.clear_displacement(&mut own);
        own
    }

    /// Sets what is rounding in a wrench to zero.
    pub(crate) fn clear_wrench(&self, wrench: &mut Vector6<f64>) {
        let force = ROUNDING * self.force;
        clear(wrench, [force, force * self.size]);
    }

    /// What a difference of two stiffnesses of the output is measured by, by rows and columns:
    /// |ΔK_ij| over √(s_i s_j). It is K_ii, and where the output is free the largest of its block.
    pub fn stiffness_scales(&self, stiffness: &Matrix6<f64>) -> [f64; 6] {
        block_scales(stiffness, self.size, COMPARED * self.stiffness)
    }

    /// The same of two compliances, the output being held in place of free.
    pub fn compliance_scales(&self, compliance: &Matrix6<f64>) -> [f64; 6] {
        let least = if self.stiffness > 0.0 {
            COMPARED / self.stiffness
        } else {
            // Nothing gives: it is zero whatever rounding says.
            f64::INFINITY
        };
        block_scales(compliance, 1.0 / self.size, least)
    }
}

/// Diagonal entries; of the largest of its block (translations, rotations) where one is zero; where the
/// whole block is, that of the other block, rotations being translations over a length squared;
/// where both are rounding beside `least`, that, of a translation.
fn block_scales(matrix: &Matrix6<f64>, length: f64, least: f64) -> [f64; 6] {
    let most = |kind: usize| (3 * kind..3 * kind + 3).fold(0.0_f64, |m, k| m.max(matrix[(k, k)]));
    let square = length * length;
    let mut blocks = [most(0), most(1)];
    let [linear, angular] = blocks;
    let rounding = ROUNDING / COMPARED * least;
    if linear <= rounding && angular <= rounding * square {
        return std::array::from_fn(|k| if k < 3 { least } else { least * square });
    }
    if linear <= ZERO * angular / square {
        blocks[0] = angular / square;
    }
    if angular <= ZERO * linear * square {
        blocks[1] = linear * square;
    }
    std::array::from_fn(|k| {
        let (own, block) = (matrix[(k, k)], blocks[k / 3]);
        if own > ZERO * block { own } else { block }
    })
}

/// Largest of the linear and of the angular components.
fn largest(vector: &Vector6<f64>) -> [f64; 2] {
    [0, 3].map(|start| vector.fixed_rows::<3>(start).amax())
}

fn clear(vector: &mut Vector6<f64>, below: [f64; 2]) {
    for (k, entry) in vector.iter_mut().enumerate() {
        if entry.abs() <= below[k / 3] {
            *entry = 0.0;
        }
    }
}

/// Stiffness of the stiffest elastic body of a mechanism \[N/m\], of the stiffest spring where it has
/// none.
fn stiffest(at: &Posture<'_>) -> f64 {
    let Posture {
        model,
        geometry,
        size,
        ..
    } = *at;
    let beams = model.segments().iter().map(|segment| {
        let [a, b] = segment.ends.map(|node| geometry.positions[node.0]);
        segment.material.young() * segment.section.area() / (b - a).norm()
    });
    let flexibles = model.flexibles().iter().flat_map(|flexible| {
        let nodes = 0..model.bodies()[flexible.body.0].nodes.len();
        nodes.map(|node| diagonal(&flexible.element.node_stiffness(node), size))
    });
    let bodies = beams.chain(flexibles).fold(0.0, f64::max);
    if bodies > 0.0 {
        return bodies;
    }
    let springs = model.joints().iter();
    let springs = springs.map(|joint| diagonal(&Directions::of(joint).stiffness, size));
    springs.fold(0.0, f64::max)
}

/// The largest diagonal entry of a stiffness, rotations over the size squared.
fn diagonal(stiffness: &Matrix6<f64>, size: f64) -> f64 {
    let [linear, angular] = largest(&stiffness.diagonal());
    linear.max(angular / (size * size))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_free_or_held_direction_is_measured_by_its_block() {
        let of = |values: [f64; 6]| Matrix6::from_diagonal(&Vector6::from(values));
        let free = of([1e8, 0.0, 1e4, 1e5, 1e5, 10.0]);
        let expected = [1e8, 1e8, 1e4, 1e5, 1e5, 10.0];
        assert_eq!(block_scales(&free, 1.0, 1.0), expected);
        // A whole block: that of the other one, by the length.
        let turns = of([1e8, 1e8, 1e4, 0.0, 0.0, 0.0]);
        // To the rounding of a product and a root.
        let near = |found: f64, wanted: f64| (found / wanted - 1.0).abs() < 1e-15;
        let of_turns = block_scales(&turns, 0.1, 1.0);
        assert!(
            of_turns[3..].iter().all(|k| near(*k, 1e8 * 0.1 * 0.1)),
            "{of_turns:?}"
        );
        let stands = of([0.0, 0.0, 0.0, 1e5, 1e5, 10.0]);
        let of_stands = block_scales(&stands, 0.1, 1.0);
        assert!(
            of_stands[..3].iter().all(|k| near(*k, 1e5 / (0.1 * 0.1))),
            "{of_stands:?}"
        );
        let none = [3.0, 3.0, 3.0, 12.0, 12.0, 12.0];
        assert_eq!(block_scales(&Matrix6::zeros(), 2.0, 3.0), none);
        let rounding = of([1e-11, 2e-10, 0.0, 1e-12, 0.0, 0.0]);
        assert_eq!(block_scales(&rounding, 2.0, 3.0), none);
    }
}
