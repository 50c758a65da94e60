//! Runs of segments that form one subassembly element.

use hyperstat_model::{FlexibleId, JointId, Model, NodeId, SegmentId};

use super::roles::JointRole;

/// Most segments that absorbed joints join into one run.
pub(crate) const LONGEST_CLUSTER: usize = 8;

/// What forms one subassembly element: a run of segments, or a flexible body.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Subassembly {
    /// Nodes along the run, or of the flexible body.
    pub nodes: Vec<NodeId>,
    /// Segments along the run; `true` where it is run through from its second node.
    pub segments: Vec<(SegmentId, bool)>,
    /// The flexible body, which has no segments.
    pub flexible: Option<FlexibleId>,
    /// Absorbed joint at each node.
    pub joints: Vec<Option<JointId>>,
}

/// Runs of segments through absorbed middle joints; every other segment is a run of its own, as
/// is every flexible body.
pub(crate) fn subassemblies(model: &Model, roles: &[JointRole]) -> Vec<Subassembly> {
    let mut absorbed_at = vec![None; model.nodes().len()];
    for (k, role) in roles.iter().enumerate() {
        if let Some(node) = role.absorbed {
            absorbed_at[node.0] = Some(JointId(k));
        }
    }
    let mut segments_at: Vec<Vec<usize>> = vec![Vec::new(); model.nodes().len()];
    for (k, segment) in model.segments().iter().enumerate() {
        for end in segment.ends {
            segments_at[end.0].push(k);
        }
    }
    let inner = |node: NodeId| absorbed_at[node.0].is_some() && segments_at[node.0].len() == 2;
    let mut seen = vec![false; model.segments().len()];
    let mut subassemblies = Vec::new();
    for start in 0..model.segments().len() {
        if seen[start] {
            continue;
        }
        // Walk back to the run's beginning, then forward along it.
        let (mut segment, mut first) = (start, model.segments()[start].ends[0]);
        while inner(first) {
            let Some(&before) = segments_at[first.0].iter().find(|s| **s != segment) else {
                break;
            };
            segment = before;
            first = other_end(model, segment, first);
        }
        let mut nodes = vec![first];
        let mut segments = Vec::new();
        loop {
            seen[segment] = true;
            let last = nodes[nodes.len() - 1];
            segments.push((
                SegmentId(segment),
                model.segments()[segment].ends[0] != last,
            ));
            let next = other_end(model, segment, last);
            nodes.push(next);
            match segments_at[next.0].iter().find(|s| **s != segment) {
                Some(&after) if inner(next) => segment = after,
                _ => break,
            }
        }
        let joints = nodes.iter().map(|n| absorbed_at[n.0]).collect();
        // An end node shared by two runs carries no absorbed joint (it would be inside a run).
        subassemblies.push(Subassembly {
            nodes,
            segments,
            flexible: None,
            joints,
        });
    }
    subassemblies.extend(model.bodies().iter().filter_map(|body| {
        let id = body.flexible?;
        Some(Subassembly {
            nodes: body.nodes.clone(),
            segments: Vec::new(),
            flexible: Some(id),
            joints: body.nodes.iter().map(|n| absorbed_at[n.0]).collect(),
        })
    }));
    subassemblies
}

pub(crate) fn other_end(model: &Model, segment: usize, node: NodeId) -> NodeId {
    let [a, b] = model.segments()[segment].ends;
    if a == node { b } else { a }
}
