//! Loads as a model holds them, and sets of them that act together.

use nalgebra::{Rotation3, Vector6};

use crate::error::NoBodyFrame;
use crate::model::Model;
use crate::orientation::body_frame;
use crate::parts::{BodyId, Geometry, NodeId, SegmentId};

/// Axes that a load is given in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Axes {
    /// The global ones.
    Global,
    /// Axes that turn with a body, and were global where the body's frame
    /// ([`Model::body_frame`]) was `home`.
    Body {
        /// The body.
        body: BodyId,
        /// Its frame where these axes were global.
        home: Rotation3<f64>,
    },
}

/// A wrench on a node, about that node.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// Node it acts on: the body's own node, inside an elastic joint that sits there.
    pub node: NodeId,
    /// Force (N) and moment (N·m).
    pub wrench: Vector6<f64>,
    /// Axes of the wrench.
    pub axes: Axes,
}

/// A wrench per length along a segment, linear between its nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct LineLoad {
    /// The segment.
    pub segment: SegmentId,
    /// Force (N/m) and moment (N·m/m) per length at its first and second node.
    pub ends: [Vector6<f64>; 2],
    /// Axes of both.
    pub axes: Axes,
}

/// Loads that act together.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LoadSet {
    /// On nodes.
    pub nodes: Vec<Load>,
    /// Along segments.
    pub lines: Vec<LineLoad>,
}

/// A set of loads of its own, with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadCase {
    /// Name, unique in the model.
    pub name: String,
    /// Its loads.
    pub loads: LoadSet,
}

impl LoadSet {
    /// One wrench (force (N), moment (N·m), global axes) on a node.
    pub fn on(node: NodeId, wrench: Vector6<f64>) -> Self {
        Self {
            nodes: vec![Load {
                node,
                wrench,
                axes: Axes::Global,
            }],
            lines: Vec::new(),
        }
    }
}

impl Axes {
    /// Their rotation from the global axes in a configuration.
    ///
    /// # Errors
    /// A body of which nothing says how it lies ([`Model::body_frame`]).
    pub fn rotation(
        &self,
        model: &Model,
        geometry: &Geometry,
    ) -> Result<Rotation3<f64>, NoBodyFrame> {
        match self {
            Self::Global => Ok(Rotation3::identity()),
            Self::Body { body, home } => {
                let now = body_frame(model, geometry, *body).ok_or_else(|| NoBodyFrame {
                    body: model.bodies()[body.0].name.clone(),
                })?;
                Ok(now * home.inverse())
            }
        }
    }
}
