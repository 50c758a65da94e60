//! Elements as the lanes take them.

use nalgebra::{Matrix6, Vector6};

use super::chain::{Chain, InnerLoad, Release};
use super::inputs::Point;

/// The relative motion that a joint's coordinate stands for: a twist at the joint, carried to the
/// component's reference point.
#[derive(Debug, Clone)]
pub(crate) struct Screw {
    pub coordinate: usize,
    pub motion: Release,
    /// From the joint to the reference point, where they differ.
    pub arm: Option<[Point; 2]>,
}

/// How a node of an element moves.
#[derive(Debug, Clone, Default)]
pub(crate) struct NodeMotion {
    /// First of the six coordinates of its component's root.
    pub root: Option<usize>,
    /// Coordinates of the joints between root and node.
    pub screws: Vec<usize>,
    /// From the component's reference point to the node, where they differ.
    pub arm: Option<[Point; 2]>,
}

impl NodeMotion {
    /// Whether it moves at all.
    pub fn moves(&self) -> bool {
        self.root.is_some() || !self.screws.is_empty()
    }

    pub fn coordinates(&self) -> impl Iterator<Item = usize> {
        let root = self.root.into_iter().flat_map(|start| start..start + 6);
        root.chain(self.screws.iter().copied())
    }
}

/// An element: what it is, and how its nodes move.
#[derive(Debug, Clone)]
pub(crate) struct Element {
    pub kind: Kind,
    pub nodes: Vec<NodeMotion>,
}

/// Where an element's stiffness comes from.
#[derive(Debug, Clone)]
pub(crate) enum Kind {
    /// Beams and elastic joints in series between two nodes.
    Chain(Chain),
    /// A flexible body.
    Flexible(FlexibleElement),
    /// A stiffness between two nodes at one point, in a joint's frame (its columns' places).
    Bushing {
        columns: [usize; 3],
        stiffness: Box<Matrix6<f64>>,
    },
}

/// A flexible body: a stiffness over nodes 1..=m with node 0 held, in axes that turn with it.
#[derive(Debug, Clone)]
pub(crate) struct FlexibleElement {
    pub points: Vec<Point>,
    /// Columns of its rotation (places in the inputs).
    pub axes: [usize; 3],
    /// Column-major.
    pub stiffness: Vec<f64>,
}

/// A constant entry of the stiffness.
#[derive(Debug, Clone)]
pub(crate) struct Spring {
    pub coordinates: [usize; 2],
    pub stiffness: f64,
}

/// A load on a node.
#[derive(Debug, Clone)]
pub(crate) struct NodeLoad {
    pub node: NodeMotion,
    pub point: Point,
    pub wrench: Vector6<f64>,
}

impl NodeLoad {
    /// The same within a chain.
    pub fn inner(self) -> InnerLoad {
        InnerLoad {
            point: self.point,
            wrench: self.wrench,
        }
    }
}

impl Element {
    /// Stiffness against translations in the plan's configuration, as a measure \[N/m\].
    pub(crate) fn weight(&self) -> f64 {
        match &self.kind {
            Kind::Chain(chain) => chain.weight(),
            Kind::Flexible(flexible) => {
                let rows = 6 * (flexible.points.len() - 1);
                (0..3).map(|k| flexible.stiffness[k * (rows + 1)]).sum()
            }
            Kind::Bushing { stiffness, .. } => (0..3).map(|k| stiffness[(k, k)]).sum(),
        }
    }

    /// Blocks that it needs, 36 entries each.
    pub(crate) fn blocks(&self) -> usize {
        match self.kind {
            Kind::Chain(_) => 0,
            _ => self.nodes.len() * (self.nodes.len() + 1) / 2,
        }
    }

    /// Free motions within a chain.
    pub fn releases(&self) -> usize {
        match &self.kind {
            Kind::Chain(chain) => chain.releases.len(),
            _ => 0,
        }
    }

    /// Whether anything moves it, or loads within could work on an idle motion of its own.
    pub fn counts(&self) -> bool {
        let has_idle = matches!(&self.kind, Kind::Chain(chain) if !chain.idle.is_empty());
        self.moves() || (has_idle && self.is_loaded())
    }

    /// Whether anything moves it.
    pub fn moves(&self) -> bool {
        self.nodes.iter().any(NodeMotion::moves)
    }

    /// Whether loads act on what lies within it.
    pub fn is_loaded(&self) -> bool {
        matches!(&self.kind, Kind::Chain(chain) if !chain.loads.is_empty())
    }

    /// Coordinates of a chain.
    pub fn ends(&self) -> usize {
        match self.kind {
            Kind::Chain(_) => self.nodes.iter().flat_map(NodeMotion::coordinates).count(),
            _ => 0,
        }
    }
}
