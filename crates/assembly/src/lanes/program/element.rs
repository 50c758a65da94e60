//! Elements as the lanes take them.

use nalgebra::Matrix6;

use super::acts::Act;
use super::chain::{Chain, InnerLoad, Release};
use super::inputs::Point;

/// The relative motion that a joint's coordinate stands for: a twist at the joint, carried to the
/// component's reference point.
#[derive(Debug, Clone)]
pub(crate) struct Screw {
    /// Its coordinate, and its place among the screws.
    pub coordinate: usize,
    /// Whether its joint is in a loop of rigid bodies.
    pub in_loop: bool,
    pub motion: Release,
    /// From the joint to the reference point, where they differ.
    pub arm: Option<[Point; 2]>,
}

/// A coordinate that moves something, with the place of the screw that it moves it along.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Moving {
    pub coordinate: usize,
    pub screw: usize,
}

/// How a node of an element moves.
#[derive(Debug, Clone, Default)]
pub(crate) struct NodeMotion {
    /// First of the six coordinates of its component's root.
    pub root: Option<usize>,
    /// Coordinates of the joints between root and node.
    pub screws: Vec<Moving>,
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
        root.chain(self.screws.iter().map(|moving| moving.coordinate))
    }

    /// Whether a joint's coordinate moves it.
    pub fn is_moved_by(&self, coordinate: usize) -> bool {
        self.screws.iter().any(|s| s.coordinate == coordinate)
    }
}

/// An element: what it is, and how its nodes move.
#[derive(Debug, Clone)]
pub(crate) struct Element {
    pub kind: Kind,
    pub nodes: Vec<NodeMotion>,
    /// Where its nodes stand when no force is on it.
    pub shifts: Vec<Shift>,
    /// Columns of what acts on it; filled in once all elements are joined.
    pub columns: Vec<usize>,
    /// Of a chain whose ends one coordinate moves: its places among the ends' coordinates, two by two.
    pub shared: Vec<[usize; 2]>,
}

/// What a node of an element stands off by when no force is on the element, in one of the columns of
/// what acts.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shift {
    /// Of the element's nodes.
    pub node: usize,
    /// Displacement, at a point that the node moves as one with.
    pub act: Act,
    pub point: Point,
    /// 1, or −1 for the opposite.
    pub sign: f64,
    pub column: usize,
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
        point: Point,
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
    /// Wrench, about the point.
    pub act: Act,
    pub column: usize,
}

impl NodeLoad {
    /// The same within a chain.
    pub fn inner(self) -> InnerLoad {
        InnerLoad {
            point: self.point,
            act: self.act,
            column: self.column,
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
        let works = |chain: &Chain| !chain.idle.is_empty() && !chain.loads.is_empty();
        self.moves() || matches!(&self.kind, Kind::Chain(chain) if works(chain))
    }

    /// Whether anything moves it.
    pub fn moves(&self) -> bool {
        self.nodes.iter().any(NodeMotion::moves)
    }

    /// Whether anything acts on what lies within it.
    pub fn is_loaded(&self) -> bool {
        !self.shifts.is_empty()
            || matches!(&self.kind, Kind::Chain(chain) if !chain.loads.is_empty())
    }

    /// Links of a chain that something acts on.
    pub fn loaded_links(&self) -> usize {
        match &self.kind {
            Kind::Chain(chain) if self.is_loaded() => chain.links.len(),
            _ => 0,
        }
    }

    /// Finds the columns of what acts on it, and coordinates that move two of its nodes.
    pub fn settle(&mut self) {
        let all: Vec<usize> = self
            .nodes
            .iter()
            .flat_map(NodeMotion::coordinates)
            .collect();
        let first = |k: usize| all.iter().position(|c| *c == all[k]);
        let shared = (0..all.len()).filter_map(|k| Some([k, first(k).filter(|f| *f < k)?]));
        self.shared = shared.collect();
        let own = self.shifts.iter().map(|shift| shift.column);
        self.columns = own.collect();
        if let Kind::Chain(chain) = &self.kind {
            self.columns
                .extend(chain.loads.iter().map(|load| load.column));
        }
        self.columns.sort_unstable();
        self.columns.dedup();
    }

    /// Coordinates of a chain.
    pub fn ends(&self) -> usize {
        match self.kind {
            Kind::Chain(_) => self.nodes.iter().flat_map(NodeMotion::coordinates).count(),
            _ => 0,
        }
    }
}
