//! The single-freedom structure (paper §3, case study 1).

use hyperstat_elements::{Elasticity, ElementError, Material, Section, SectionShape};
use hyperstat_joints::{Dof, DofSet, Fixed};
use hyperstat_model::{Connection, Geometry, JointStiffness, Model, NodeId, ValuePlace};
use nalgebra::{Point3, Rotation3};

use crate::prebuilt::{
    ParameterError, PoseCoordinate, PoseError, Prebuilt, check_numbering, coordinates, parameter,
};

/// Length of the rigid body BC (m).
const RIGID_LENGTH: f64 = 0.1;

/// Numbers of nodes, segments and joints.
const COUNTS: [usize; 3] = [7, 2, 4];

/// The single-freedom structure; the [module](super) draws it. It does not move, so its pose
/// takes no coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct SingleFreedom {
    /// Lengths of AB and CD (m).
    pub lengths: (f64, f64),
    /// Sections of AB and CD.
    pub sections: (Section, Section),
    /// Material of AB and CD.
    pub material: Material,
    /// Stiffness of the joints B and C along x (N/m); `None` is rigid, zero leaves the
    /// direction free. All their other directions are rigid.
    pub joint_stiffness: (Option<f64>, Option<f64>),
}

impl SingleFreedom {
    /// The structure of this project's examples and reference results: steel, lengths 0.4 m and
    /// 0.3 m, round sections of 20 mm and 25 mm, joints of 2·10⁷ N/m and 3·10⁷ N/m. The paper
    /// prints no numbers for it.
    pub fn paper() -> Self {
        let parts = || -> Result<_, ElementError> {
            let round = |diameter| Section::new(SectionShape::Circle { diameter }, None, None);
            Ok((
                (round(0.020)?, round(0.025)?),
                Material::new(2.1e11, Elasticity::Poisson(0.3), Some(7850.0))?,
            ))
        };
        let (sections, material) = parts().expect("steel and positive diameters are valid");
        Self {
            lengths: (0.4, 0.3),
            sections,
            material,
            joint_stiffness: (Some(2e7), Some(3e7)),
        }
    }

    /// Looks whether every parameter is in its physical range.
    ///
    /// # Errors
    /// The first that is not: a length that is not above zero, a negative stiffness, a number
    /// that is not finite.
    pub fn check(&self) -> Result<(), ParameterError> {
        parameter::positive_length("lengths", self.lengths.0)?;
        parameter::positive_length("lengths", self.lengths.1)?;
        parameter::stiffness("joint_stiffness", self.joint_stiffness.0)?;
        parameter::stiffness("joint_stiffness", self.joint_stiffness.1)
    }

    /// Checks parameters and pose; the points A, B, O, C and D.
    fn points(&self, pose: &[f64]) -> Result<[Point3<f64>; 5], PoseError> {
        self.check()?;
        coordinates::<0>(self.kind(), pose)?;
        let b = self.lengths.0;
        let c = b + RIGID_LENGTH;
        let along = [0.0, b, b + 0.5 * RIGID_LENGTH, c, c + self.lengths.1];
        Ok(along.map(|x| Point3::new(x, 0.0, 0.0)))
    }
}

impl Default for SingleFreedom {
    /// [`SingleFreedom::paper`].
    fn default() -> Self {
        Self::paper()
    }
}

impl Prebuilt for SingleFreedom {
    fn kind(&self) -> &str {
        "SingleFreedom"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[]
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        let [a, b, o, c, d] = self.points(pose)?;
        let mut model = Model::new("single freedom structure");
        let (section_ab, section_cd) = &self.sections;
        let ab = [("A", a), ("B", b)];
        let ab = model.add_beam("AB", &ab, &self.material, section_ab, None, 1)?;
        let bc = model.add_rigid("BC", &[("B", b), ("O", o), ("C", c)])?;
        let cd = [("C", c), ("D", d)];
        let cd = model.add_beam("CD", &cd, &self.material, section_cd, None, 1)?;

        let nodes = [ab, bc, cd].map(|body| model.bodies()[body.0].nodes.clone());
        let [ab, bc, cd] = &nodes;
        let joints = [
            ("A", [None, Some(ab[0])], None),
            ("D", [Some(cd[1]), None], None),
            ("B", [Some(ab[1]), Some(bc[0])], self.joint_stiffness.0),
            ("C", [Some(bc[2]), Some(cd[0])], self.joint_stiffness.1),
        ];
        for (name, between, stiffness_x) in joints {
            model.add_joint(fixed(name, between, stiffness_x), Rotation3::identity())?;
        }
        model.set_output(bc[1]);
        Ok(model)
    }

    fn origins(&self, pose: &[f64]) -> Result<Vec<(ValuePlace, String)>, PoseError> {
        let model = self.model(pose)?;
        let origin = |(place, _)| {
            let path = match place {
                ValuePlace::Dimension {
                    segment, dimension, ..
                } => {
                    format!("sections.{}.{dimension}", segment.0)
                }
                ValuePlace::Constant { constant, .. } => format!("material.{constant}"),
                ValuePlace::Stiffness { joint, .. } => {
                    let first = model.joints()[joint.0].name == "B";
                    format!("joint_stiffness.{}", if first { 0 } else { 1 })
                }
                _ => return None,
            };
            Some((place, path))
        };
        Ok(model.values().into_iter().filter_map(origin).collect())
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        check_numbering(geometry, COUNTS)?;
        let [a, b, o, c, d] = self.points(pose)?;
        geometry.positions.copy_from_slice(&[a, b, b, o, c, c, d]);
        geometry.y_axes.fill(None);
        geometry.frames.fill(Rotation3::identity());
        Ok([o.x, o.y, o.z, 0.0, 0.0, 0.0])
    }
}

/// A weld, elastic along x where `stiffness_x` (N/m) is given.
fn fixed(name: &str, between: [Option<NodeId>; 2], stiffness_x: Option<f64>) -> Connection {
    let mut stiffness = [None; 6];
    stiffness[Dof::X.index()] = stiffness_x;
    Connection {
        name: name.into(),
        between,
        joint: Box::new(Fixed),
        locked: DofSet::EMPTY,
        stiffness: JointStiffness::Directions(stiffness),
    }
}

#[cfg(test)]
mod tests {
    //! Against the written-out mechanisms, and every parameter that is refused.

    use super::*;
    use crate::prebuilt::written_out::WrittenOut;

    #[test]
    fn models_are_the_written_out_mechanisms() {
        let rigid = SingleFreedom {
            joint_stiffness: (None, None),
            ..SingleFreedom::paper()
        };
        for (file, structure) in [
            ("single_freedom_elastic", SingleFreedom::paper()),
            ("single_freedom_rigid", rigid),
        ] {
            let model = structure.model(&[]).expect("valid parameters");
            WrittenOut::read(file).assert_same(&model);
        }
    }

    #[test]
    fn place_gives_the_geometry_of_model_and_the_place_of_the_output() {
        let structure = SingleFreedom {
            lengths: (0.7, 0.2),
            ..SingleFreedom::paper()
        };
        let model = structure.model(&[]).expect("valid parameters");
        let paper = SingleFreedom::paper().model(&[]).expect("valid parameters");
        let mut geometry = paper.geometry().clone();
        let pose = structure
            .place(&[], &mut geometry)
            .expect("it does not move");
        assert_eq!(&geometry, model.geometry());
        assert_eq!(pose, [0.75, 0.0, 0.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn a_pose_is_refused() {
        let structure = SingleFreedom::paper();
        assert_eq!(
            structure.model(&[0.0]).map(|_| ()),
            Err(PoseError::Coordinates {
                kind: "SingleFreedom".into(),
                expected: 0,
                found: 1,
            })
        );
    }

    #[test]
    fn parameters_out_of_range_are_named() {
        type Spoil = fn(&mut SingleFreedom);
        let cases: [(&str, Spoil); 5] = [
            ("lengths", |s| s.lengths.0 = 0.0),
            ("lengths", |s| s.lengths.1 = -0.3),
            ("lengths", |s| s.lengths.0 = f64::NAN),
            ("joint_stiffness", |s| s.joint_stiffness.0 = Some(-1.0)),
            ("joint_stiffness", |s| {
                s.joint_stiffness.1 = Some(f64::INFINITY)
            }),
        ];
        for (field, spoil) in cases {
            let mut structure = SingleFreedom::paper();
            spoil(&mut structure);
            let error = structure.check().expect_err(field);
            assert_eq!(error.field, field);
            assert_eq!(
                structure.model(&[]).map(|_| ()),
                Err(PoseError::Parameter(error))
            );
        }
    }
}
