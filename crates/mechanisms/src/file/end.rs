//! The output that a job names in place of the mechanism's own, and a tool: a point that is fixed in the
//! body of the output.

use hyperstat_model::{Geometry, Model, NodeId};
use nalgebra::{Point3, Rotation3, Vector3};

use super::loads::Acting;
use super::nodes;
use crate::error::LoadError;
use crate::text::dimension::Dimension;

/// Name of the tool's point.
pub(crate) const TOOL: &str = "tool";

/// What the poses are of, and where the tool is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct End {
    /// The mechanism's own output, which poses are those of.
    pub(crate) own: NodeId,
    tool: Option<Tool>,
}

/// A point that is the last of the model's, and fixed in a body.
#[derive(Debug, Clone, Copy)]
struct Tool {
    /// The point of the body that it is told from.
    base: NodeId,
    /// From there, in the axes of the body in its home orientation \[m\].
    offset: Vector3<f64>,
}

impl End {
    /// That of a mechanism whose output is its own, here.
    pub(crate) fn at(own: NodeId) -> Self {
        Self { own, tool: None }
    }

    /// Reads the output and the tool of a job. The tool becomes a point of a model whose output's body is
    /// `turned` from its home orientation. Returns the point that is to be the output, once all that is
    /// stated beside the mechanism's own is read.
    pub(crate) fn read(
        &mut self,
        acting: &Acting,
        model: &mut Model,
        turned: &Rotation3<f64>,
    ) -> Result<NodeId, LoadError> {
        let (output, tool) = (acting.output(), acting.tool());
        let named = output
            .map(|at| nodes::on(model, at, "the output"))
            .transpose()?;
        let base = named.unwrap_or(self.own);
        let Some(at) = tool else {
            return Ok(base);
        };
        let body = model.nodes()[base.0].body;
        if body != model.nodes()[self.own.0].body {
            let own = &model.bodies()[model.nodes()[self.own.0].body.0].name;
            return Err(at
                .error("a tool is fixed in the body that the poses are of")
                .with_help(format!(
                    "name a point of `{own}` as the output, or leave `tool` out"
                )));
        }
        let offset = at.vector("a coordinate of `tool`", Dimension::LENGTH)?;
        let position = model.geometry().positions[base.0] + turned * offset;
        let node = model.add_point(body, TOOL, position).map_err(|error| {
            at.error(error.to_string()).with_help(
                "a tool needs a rigid body as output, without a point of the name `tool`",
            )
        })?;
        self.tool = Some(Tool { base, offset });
        Ok(node)
    }

    /// Whether there is a tool.
    pub(crate) fn has_tool(&self) -> bool {
        self.tool.is_some()
    }

    /// Has `place` bring a geometry, without the tool's point, to a whole pose of the mechanism's own
    /// output, and the tool's point with it. Where that fails, all is as it was.
    pub(crate) fn place<E>(
        &self,
        geometry: &mut Geometry,
        place: impl FnOnce(&mut Geometry) -> Result<[f64; 6], E>,
    ) -> Result<[f64; 6], E> {
        let Some(tool) = &self.tool else {
            return place(geometry);
        };
        let before = geometry.positions.pop();
        let placed = place(geometry);
        let now = placed
            .as_ref()
            .ok()
            .and_then(|pose| tool.at(pose, geometry));
        geometry.positions.extend(now.or(before));
        placed
    }

    /// Takes the tool's points out of geometries.
    pub(crate) fn take_out(&self, geometries: &mut [Geometry]) -> Vec<Option<Point3<f64>>> {
        match self.tool {
            Some(_) => geometries
                .iter_mut()
                .map(|own| own.positions.pop())
                .collect(),
            None => Vec::new(),
        }
    }

    /// Puts them back, where they are in whole poses of the mechanism's own output; those of geometries
    /// that are in none are as they were.
    pub(crate) fn put_back<'p>(
        &self,
        geometries: &mut [Geometry],
        before: Vec<Option<Point3<f64>>>,
        pose: impl Fn(usize) -> Option<&'p [f64; 6]>,
    ) {
        for (k, (geometry, before)) in geometries.iter_mut().zip(before).enumerate() {
            let tool = self.tool.as_ref().zip(pose(k));
            let now = tool.and_then(|(tool, pose)| tool.at(pose, geometry));
            geometry.positions.extend(now.or(before));
        }
    }
}

impl Tool {
    /// Where it is in a whole pose of the output.
    fn at(&self, [.., x, y, z]: &[f64; 6], geometry: &Geometry) -> Option<Point3<f64>> {
        let base = geometry.positions.get(self.base.0)?;
        Some(base + Rotation3::new(Vector3::new(*x, *y, *z)) * self.offset)
    }
}
