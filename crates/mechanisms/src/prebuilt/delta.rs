//! The over-constrained delta (paper §4): its parameters, its model and its poses.

mod limb;
mod model;
#[cfg(test)]
mod tests;
mod topology;

use hyperstat_elements::{Elasticity, ElementError, Material, Section, SectionShape};
use serde::Deserialize;

use crate::prebuilt::{Link, ParameterError, parameter};

/// The over-constrained delta; the [module](super) draws it. A pose is the position x, y, z (m)
/// of the platform's centre P.
#[derive(Debug, Clone, PartialEq)]
pub struct Delta {
    /// Distance of the drives' axes A from z (m).
    pub base_radius: f64,
    /// Distance of the wrists' axes C from the platform's centre P (m).
    pub platform_radius: f64,
    /// Length of the arms, A to B (m).
    pub arm_length: f64,
    /// Length of the rods, B to C (m).
    pub rod_length: f64,
    /// Distance between the two rods of a limb (m).
    pub rod_spacing: f64,
    /// On which side of the line from shoulder to wrist the elbows stand.
    pub elbow: Elbow,
    /// The joints at the ends of the rods.
    pub rod_ends: RodEnds,
    /// Arm, A to B.
    pub arm: Link,
    /// Cross links, Ba to Bb and Ca to Cb.
    pub bar: Link,
    /// Rods, Ba to Ca and Bb to Cb.
    pub rod: Link,
    /// Stiffness of every revolute joint in its directions x y z (N/m), u v w (N·m/rad):
    /// `None` is rigid, zero frees a direction. v, the axis, must be `None`. Spherical rod ends
    /// are rigid whatever is given here.
    pub joint_stiffness: [Option<f64>; 6],
    /// Stiffness of the drives about their axes (N·m/rad); `None` or zero is locked rigidly.
    pub drive_stiffness: Option<f64>,
    /// Number of beam elements a segment is divided into.
    pub elements: usize,
}

/// Which of the two places that an elbow B may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
pub enum Elbow {
    /// The one farther along the limb's outward direction. Where both are equally far (C at the
    /// height of A), the one that follows from poses just above.
    #[default]
    Out,
    /// The other one.
    In,
}

/// The joints at the ends of the rods.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
pub enum RodEnds {
    /// Revolute joints along the parallelogram's axis: the paper's delta.
    #[default]
    Revolute,
    /// Rigid ball joints; every rod may then spin about itself.
    Spherical,
}

impl Delta {
    /// The delta of this project's examples and reference results, with rigid joints: the
    /// paper's topology in steel, base and platform radius 0.25 m and 0.06 m, arms 0.3 m, rods
    /// 0.6 m long and 0.12 m apart, round sections of 30 mm (arms), 20 mm (bars), 14 mm (rods).
    pub fn paper() -> Self {
        let link = |diameter| -> Result<Link, ElementError> {
            Ok(Link {
                section: Section::new(SectionShape::Circle { diameter }, None, None)?,
                material: Material::new(2.1e11, Elasticity::Poisson(0.3), Some(7850.0))?,
            })
        };
        let link = |diameter| link(diameter).expect("steel and a positive diameter are valid");
        Self {
            base_radius: 0.25,
            platform_radius: 0.06,
            arm_length: 0.30,
            rod_length: 0.60,
            rod_spacing: 0.12,
            elbow: Elbow::Out,
            rod_ends: RodEnds::Revolute,
            arm: link(0.030),
            bar: link(0.020),
            rod: link(0.014),
            joint_stiffness: [None; 6],
            drive_stiffness: None,
            elements: 1,
        }
    }

    /// Looks whether every parameter is in its physical range.
    ///
    /// # Errors
    /// The first that is not: a length that is not above zero, a negative radius or stiffness,
    /// a number that is not finite, a stiffness about the joints' axes, no element.
    pub fn check(&self) -> Result<(), ParameterError> {
        parameter::radius("base_radius", self.base_radius)?;
        parameter::radius("platform_radius", self.platform_radius)?;
        parameter::positive_length("arm_length", self.arm_length)?;
        parameter::positive_length("rod_length", self.rod_length)?;
        parameter::positive_length("rod_spacing", self.rod_spacing)?;
        parameter::joint_stiffness("joint_stiffness", &self.joint_stiffness)?;
        parameter::stiffness("drive_stiffness", self.drive_stiffness)?;
        parameter::elements("elements", self.elements)
    }
}

impl Default for Delta {
    /// [`Delta::paper`].
    fn default() -> Self {
        Self::paper()
    }
}
