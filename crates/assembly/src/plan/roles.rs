//! What every joint is to the model: absorbed, a tie, a spring, a condition.

use hyperstat_joints::DofSet;
use hyperstat_model::{Directions, Geometry, Model, NodeId, SegmentId, segment_beam};
use nalgebra::{Matrix6, Vector6};

use super::subassemblies::LONGEST_CLUSTER;
use crate::sets::Sets;

/// A joint softer than this share of the beam's own stiffness keeps coordinates of its own: across the
/// beam's axes a matrix of doubles holds its stiffness to 1e-16 over this share, whatever formed
/// it, which no refinement brings back.
pub(crate) const SOFTEST_ABSORBED: f64 = 1e-4;

/// What the model makes of a joint.
#[derive(Debug, Clone)]
pub(crate) struct JointRole {
    pub directions: Directions,
    /// Node inside whose subassembly elastic directions are absorbed.
    pub absorbed: Option<NodeId>,
    /// Compliance of the absorbed directions, zero elsewhere.
    pub compliance: Matrix6<f64>,
    /// Elastic directions with coordinates of their own.
    pub springs: DofSet,
    /// All directions with coordinates of their own: these springs and the free ones.
    pub moving: DofSet,
}

impl JointRole {
    /// Whether every direction has the same role in both.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        let sets = |role: &Self| {
            let own = &role.directions;
            let sets = [own.rigid, own.elastic, own.free, role.springs, role.moving];
            (role.absorbed, sets)
        };
        sets(self) == sets(other)
    }
}

/// Roles of all joints: which are absorbed, and which directions keep coordinates.
pub(crate) fn roles(
    model: &Model,
    geometry: &Geometry,
    output: NodeId,
    absorbs: bool,
) -> Vec<JointRole> {
    let mut joints_at = vec![0usize; model.nodes().len()];
    for joint in model.joints() {
        for node in joint.between.iter().flatten() {
            joints_at[node.0] += 1;
        }
    }
    let mut segments_at: Vec<Vec<SegmentId>> = vec![Vec::new(); model.nodes().len()];
    for (k, segment) in model.segments().iter().enumerate() {
        for end in segment.ends {
            segments_at[end.0].push(SegmentId(k));
        }
    }
    let mut flexible_nodes: Vec<Option<Matrix6<f64>>> = vec![None; model.nodes().len()];
    for flexible in model.flexibles() {
        for (k, node) in model.bodies()[flexible.body.0].nodes.iter().enumerate() {
            flexible_nodes[node.0] = Some(flexible.element.node_stiffness(k));
        }
    }
    let mut run = Runs::new(model.segments().len());
    let mut roles = Vec::with_capacity(model.joints().len());
    for joint in model.joints() {
        let directions = Directions::of(joint);
        let absorbable = |node: NodeId| {
            if !absorbs || node == output || joints_at[node.0] != 1 {
                return DofSet::EMPTY;
            }
            match &flexible_nodes[node.0] {
                Some(own) => stiff_directions(&directions, &own.diagonal()),
                None => {
                    let segments = &segments_at[node.0];
                    if !(1..=2).contains(&segments.len()) {
                        return DofSet::EMPTY;
                    }
                    stiff_directions(&directions, &stiffest(segments, model, geometry))
                }
            }
        };
        let nodes = joint.between.iter().rev().flatten();
        let mut sides: Vec<(NodeId, DofSet)> = nodes
            .map(|n| (*n, absorbable(*n)))
            .filter(|(_, set)| !set.is_empty())
            .collect();
        let nodes_on_body = |n: NodeId| model.bodies()[model.nodes()[n.0].body.0].nodes.len();
        sides.sort_by_key(|(n, _)| (segments_at[n.0].len(), nodes_on_body(*n)));
        let absorbed = sides
            .into_iter()
            .find(|(n, _)| match segments_at[n.0].as_slice() {
                [a, b] => run.join(a.0, b.0),
                _ => true,
            });
        let inside = absorbed.map_or(DofSet::EMPTY, |(_, set)| set);
        let springs = directions.elastic.difference(inside);
        roles.push(JointRole {
            absorbed: absorbed.map(|(node, _)| node),
            compliance: directions.compliance_of(inside),
            springs,
            moving: directions.free.union(springs),
            directions,
        });
    }
    roles
}

/// Largest stiffness of the beams at a node by direction, element frame.
pub(crate) fn stiffest(segments: &[SegmentId], model: &Model, geometry: &Geometry) -> Vector6<f64> {
    let mut stiffest = Vector6::zeros();
    for id in segments {
        if let Ok((beam, _, _)) = segment_beam(model, geometry, *id) {
            stiffest = stiffest.sup(&beam.cantilever_stiffness().diagonal());
        }
    }
    stiffest
}

/// Elastic directions stiff enough beside the `own` stiffness of the body at a joint's node, by
/// direction in any axes, to be absorbed; coupled directions all or none.
pub(crate) fn stiff_directions(directions: &Directions, own: &Vector6<f64>) -> DofSet {
    let Some(compliance) = &directions.compliance else {
        return DofSet::EMPTY;
    };
    let stiffest = [own.fixed_rows::<3>(0).max(), own.fixed_rows::<3>(3).max()];
    let stiff: DofSet = directions
        .elastic
        .iter()
        .filter(|dof| {
            let d = dof.index();
            compliance[(d, d)] * stiffest[d / 3] * SOFTEST_ABSORBED <= 1.0
        })
        .collect();
    if stiff == directions.elastic || !directions.is_coupled() {
        stiff
    } else {
        DofSet::EMPTY
    }
}

/// Sets of segments joined at absorbed joints, kept short.
pub(crate) struct Runs {
    sets: Sets,
    /// Segments in the run of each root.
    length: Vec<usize>,
}

impl Runs {
    fn new(count: usize) -> Self {
        Self {
            sets: Sets::new(count),
            length: vec![1; count],
        }
    }

    /// Joins two runs unless they are one already (a ring) or would grow too long.
    fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.sets.root(a), self.sets.root(b));
        let length = self.length[a] + self.length[b];
        if a == b || length > LONGEST_CLUSTER {
            return false;
        }
        self.sets.join(a, b);
        self.length[a] = length;
        true
    }
}
