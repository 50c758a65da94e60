//! What acts on a beam between its nodes: distributed forces and moments, and temperature.

use std::ops::{Add, Mul};

use nalgebra::Vector6;

use crate::beam::SectionStrain;
use crate::bernstein::Bernstein;

/// Distributed forces and moments along a straight beam, and strains that no force makes, such as
/// those of temperature. Everything is in the element frame.
///
/// The intensity, a wrench per length about the centroid of the section (N/m, N·m/m), is
/// quadratic along the beam: that holds constant and linear loads and, exactly, the weight of a
/// beam whose section changes. Loads add and scale; [`StraightBeam`](crate::StraightBeam) has
/// what they do to a beam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamLoad {
    intensity: Bernstein<3>,
    strain: Vector6<f64>,
}

/// A change of temperature over a section, ΔT(y, z) = uniform + y gradient_y + z gradient_z, the
/// same all along the beam.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TemperatureChange {
    /// At the centroid \[K\].
    pub uniform: f64,
    /// Along local y \[K/m\].
    pub gradient_y: f64,
    /// Along local z \[K/m\].
    pub gradient_z: f64,
}

impl BeamLoad {
    /// No load.
    pub fn none() -> Self {
        Self::quadratic([Vector6::zeros(); 3])
    }

    /// The same wrench per length all along \[N/m, N·m/m\].
    pub fn uniform(intensity: Vector6<f64>) -> Self {
        Self::quadratic([intensity; 3])
    }

    /// A wrench per length that changes linearly from `first` at node 1 to `second` at node 2
    /// \[N/m, N·m/m\].
    pub fn linear(first: Vector6<f64>, second: Vector6<f64>) -> Self {
        Self::quadratic([first, (first + second) / 2.0, second])
    }

    /// The wrench per length (1 − ξ)² c₀ + 2 ξ (1 − ξ) c₁ + ξ² c₂ at ξ from 0 at node 1 to 1 at
    /// node 2 \[N/m, N·m/m\].
    pub fn quadratic(controls: [Vector6<f64>; 3]) -> Self {
        Self {
            intensity: Bernstein(controls),
            strain: Vector6::zeros(),
        }
    }

    /// A change of temperature in a material with this coefficient of linear expansion \[1/K\]:
    /// the axial strain α ΔT and, by the gradients, the curvatures α dT/dz about y and −α dT/dy
    /// about z. A change that is linear over the section makes no stress of its own.
    pub fn temperature(expansion: f64, change: &TemperatureChange) -> Self {
        let TemperatureChange {
            uniform,
            gradient_y,
            gradient_z,
        } = *change;
        let strain = Vector6::new(uniform, 0.0, 0.0, 0.0, gradient_z, -gradient_y);
        Self {
            strain: strain * expansion,
            ..Self::none()
        }
    }

    /// The wrench per length at `xi` (0 at node 1, 1 at node 2) \[N/m, N·m/m\].
    pub fn intensity(&self, xi: f64) -> Vector6<f64> {
        self.intensity.at(xi)
    }

    /// Whether no force acts between the nodes, whatever the strain.
    pub fn is_forceless(&self) -> bool {
        self.intensity.0.iter().all(|own| *own == Vector6::zeros())
    }

    /// The strain that no force makes, the same all along.
    pub fn free_strain(&self) -> SectionStrain {
        SectionStrain::from(self.strain)
    }

    /// The load on the part of the beam from `first` to `last` (0 to 1), over that part's own
    /// length.
    pub fn part(&self, first: f64, last: f64) -> Self {
        let (head, _) = self.intensity.split(last);
        let kept = if last == 0.0 { 0.0 } else { first / last };
        Self {
            intensity: head.split(kept).1,
            strain: self.strain,
        }
    }

    /// The wrench of the whole load about node 1, of a beam of this length \[m\].
    pub fn resultant(&self, length: f64) -> Vector6<f64> {
        self.section_wrench(0.0, length)
    }

    /// Section wrench at `xi` of a beam of this length \[m\] that is held at node 1 and free at
    /// node 2: the wrench of the load beyond `xi` about the centroid of that section
    /// (N Vy Vz T My Mz).
    pub fn section_wrench(&self, xi: f64, length: f64) -> Vector6<f64> {
        self.section_wrenches(length, &Vector6::zeros()).at(xi)
    }

    /// Section wrench along a beam of this length \[m\] under this load and `end`, the wrench on
    /// it at node 2: −dF/dx = f and −dM/dx = m + x × F.
    pub(crate) fn section_wrenches(&self, length: f64, end: &Vector6<f64>) -> Bernstein<5> {
        let mut per_span = self.intensity;
        for control in &mut per_span.0 {
            *control *= length;
        }
        let forces: Bernstein<4> = per_span.integral_to_end(end);
        let mut turning: Bernstein<4> = per_span.raised();
        for (turning, force) in turning.0.iter_mut().zip(&forces.0) {
            turning[4] -= length * force[2];
            turning[5] += length * force[1];
        }
        let moments: Bernstein<5> = turning.integral_to_end(end);
        let mut wrenches: Bernstein<5> = forces.raised();
        for (wrench, moment) in wrenches.0.iter_mut().zip(&moments.0) {
            wrench
                .fixed_rows_mut::<3>(3)
                .copy_from(&moment.fixed_rows::<3>(3));
        }
        wrenches
    }

    /// The strain that no force makes, as a vector.
    pub(crate) fn strain(&self) -> &Vector6<f64> {
        &self.strain
    }
}

impl Add for BeamLoad {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (a, b) = (self.intensity.0, other.intensity.0);
        Self {
            intensity: Bernstein([a[0] + b[0], a[1] + b[1], a[2] + b[2]]),
            strain: self.strain + other.strain,
        }
    }
}

impl Mul<f64> for BeamLoad {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self {
            intensity: Bernstein(self.intensity.0.map(|control| control * factor)),
            strain: self.strain * factor,
        }
    }
}
