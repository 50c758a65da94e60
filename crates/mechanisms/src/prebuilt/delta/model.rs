//! The delta as a [`Prebuilt`]: its model, built by the table of the topology, and its poses,
//! written into a geometry by the same table.

use std::iter::once;

use hyperstat_assembly::{BodyId, Connection, Geometry, JointStiffness, Model, ModelError, NodeId};
use hyperstat_joints::{Dof, DofSet, Joint, Revolute, Spherical};
use nalgebra::Point3;

use super::limb::Limb;
use super::topology::{BODIES, COUNTS, JOINTS, JointRole, LIMBS, LimbJoint, Part, Point, Side};
use super::{Delta, RodEnds};
use crate::prebuilt::{Link, PoseCoordinate, PoseError, Prebuilt, check_numbering, coordinates};

impl Prebuilt for Delta {
    fn kind(&self) -> &str {
        "Delta"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::X, PoseCoordinate::Y, PoseCoordinate::Z]
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        let (centre, limbs) = self.configuration(pose)?;
        let mut model = Model::new("delta");
        let mut bodies = Vec::with_capacity(LIMBS);
        for (limb, number) in limbs.iter().zip(1..) {
            bodies.push(self.add_bodies(&mut model, limb, number)?);
        }
        let platform = add_platform(&mut model, centre, &limbs)?;
        for (index, limb) in limbs.iter().enumerate() {
            for joint in &JOINTS {
                let number = index + 1;
                let at = format!("{}{number}", joint.point.name());
                let node = |side| match side {
                    Side::Ground => None,
                    Side::Limb(body) => node_at(&model, bodies[index][body], &at),
                    Side::Platform => node_at(&model, platform, &at),
                };
                let connection = self.connection(joint, at.clone(), joint.between.map(node));
                model.add_joint(connection, limb.frame(joint.role))?;
            }
        }
        if let Some(output) = node_at(&model, platform, "P") {
            model.set_output(output);
        }
        Ok(model)
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        check_numbering(geometry, COUNTS)?;
        let (centre, limbs) = self.configuration(pose)?;
        let nodes = limbs
            .iter()
            .flat_map(|limb| {
                let points = BODIES.iter().flat_map(|body| body.points);
                points.map(|&point| limb.point(point))
            })
            .chain(once(centre))
            .chain(limbs.iter().map(|limb| limb.point(Point::C)));
        let segments = limbs.iter().flat_map(|limb| {
            let parts = BODIES.iter().flat_map(|body| {
                let segments = body.points.len() - 1;
                std::iter::repeat_n(body.part, segments)
            });
            parts.map(|part| Some(limb.y_axis(part)))
        });
        let joints = limbs
            .iter()
            .flat_map(|limb| JOINTS.iter().map(|joint| limb.frame(joint.role)));
        fill(&mut geometry.positions, nodes);
        fill(&mut geometry.y_axes, segments);
        fill(&mut geometry.frames, joints);
        Ok([centre.x, centre.y, centre.z, 0.0, 0.0, 0.0])
    }
}

/// Writes `values` into `places`, which are as many.
fn fill<T>(places: &mut [T], values: impl Iterator<Item = T>) {
    for (place, value) in places.iter_mut().zip(values) {
        *place = value;
    }
}

/// The node of `body` at the point of this name.
fn node_at(model: &Model, body: BodyId, point: &str) -> Option<NodeId> {
    let nodes = &model.bodies()[body.0].nodes;
    nodes
        .iter()
        .copied()
        .find(|n| model.nodes()[n.0].point == point)
}

fn add_platform(
    model: &mut Model,
    centre: Point3<f64>,
    limbs: &[Limb],
) -> Result<BodyId, ModelError> {
    let wrists = limbs.iter().zip(1..);
    let wrists = wrists.map(|(limb, number)| (format!("C{number}"), limb.point(Point::C)));
    let points: Vec<_> = once(("P".to_owned(), centre)).chain(wrists).collect();
    model.add_rigid("platform", &borrowed(&points))
}

fn borrowed(points: &[(String, Point3<f64>)]) -> Vec<(&str, Point3<f64>)> {
    points
        .iter()
        .map(|(name, at)| (name.as_str(), *at))
        .collect()
}

impl Delta {
    /// Checks parameters and pose; the platform's centre and the limbs there.
    fn configuration(&self, pose: &[f64]) -> Result<(Point3<f64>, [Limb; LIMBS]), PoseError> {
        self.check()?;
        let centre = Point3::from(coordinates::<3>(self.kind(), pose)?);
        let limbs = [
            Limb::new(self, 0, &centre)?,
            Limb::new(self, 1, &centre)?,
            Limb::new(self, 2, &centre)?,
        ];
        Ok((centre, limbs))
    }

    fn link(&self, part: Part) -> &Link {
        match part {
            Part::Arm => &self.arm,
            Part::Bar => &self.bar,
            Part::Rod => &self.rod,
        }
    }

    /// Adds the elastic bodies of a limb.
    fn add_bodies(
        &self,
        model: &mut Model,
        limb: &Limb,
        number: usize,
    ) -> Result<[BodyId; BODIES.len()], ModelError> {
        let mut ids = [BodyId(0); BODIES.len()];
        for (id, body) in ids.iter_mut().zip(&BODIES) {
            let points = body.points.iter();
            let points: Vec<_> = points
                .map(|&point| (format!("{}{number}", point.name()), limb.point(point)))
                .collect();
            let link = self.link(body.part);
            *id = model.add_beam(
                &format!("{}{number}", body.name),
                &borrowed(&points),
                &link.material,
                &link.section,
                Some(limb.y_axis(body.part)),
                self.elements,
            )?;
        }
        Ok(ids)
    }

    /// A joint with its kind, drive and stiffness.
    fn connection(
        &self,
        joint: &LimbJoint,
        name: String,
        between: [Option<NodeId>; 2],
    ) -> Connection {
        if joint.role == JointRole::RodEnd && self.rod_ends == RodEnds::Spherical {
            return Connection {
                name,
                between,
                joint: Box::new(Spherical),
                locked: DofSet::EMPTY,
                stiffness: JointStiffness::default(),
            };
        }
        let mut stiffness = self.joint_stiffness;
        let mut locked = DofSet::EMPTY;
        if joint.role == JointRole::Drive {
            stiffness[Dof::V.index()] = self.drive_stiffness;
            locked = Revolute.free();
        }
        Connection {
            name,
            between,
            joint: Box::new(Revolute),
            locked,
            stiffness: JointStiffness::Directions(stiffness),
        }
    }
}
