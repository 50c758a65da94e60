//! Which coordinates the ends of members, springs and masses of nodes depend on, worked out once a
//! topology; and by how much, in one configuration.

use std::sync::Arc;

use hyperstat_model::{Geometry, Model, NodeId, SegmentId};
use nalgebra::Vector6;

use super::blocks::{Blocks, ROW};
use super::kinds::Kind;
use crate::modal::member::{Member, Members};
use crate::plan::Plan;
use crate::plan::blocks::{read, shift};
use crate::plan::elements::Source;
use crate::plan::fault::Fault;
use crate::plan::workspace::Workspace;
use crate::pose::carry;
use crate::pose::spring::spring_element;
use crate::posture::Posture;

/// Coordinates of a mechanism that goes this way at the most.
const MOST_COORDINATES: usize = 1_000;

/// A mechanism's coordinates and what stands on them.
#[derive(Debug)]
pub(super) struct Table {
    pub blocks: Blocks,
    pub kinds: Vec<Kind>,
    pub members: Vec<Bar>,
    pub springs: Vec<Spring>,
    /// In the order of the model's masses.
    pub masses: Vec<PointMass>,
    /// Number of coordinates, and the same with those of the inner shapes.
    pub nodes: usize,
    pub size: usize,
    /// Numbers of all ends' displacements.
    pub locals: usize,
}

/// A member between two nodes.
#[derive(Debug)]
pub(super) struct Bar {
    segment: SegmentId,
    pub kind: usize,
    pub ends: [End; 2],
    /// First of its inner shapes' coordinates.
    pub inner: usize,
    pub entries: Entries,
}

/// Elastic directions of a joint.
#[derive(Debug)]
pub(super) struct Spring {
    /// In the plan.
    pub element: usize,
    /// Places of the element's columns.
    pub places: Vec<usize>,
    pub entries: Entries,
}

/// A mass of a node.
#[derive(Debug)]
pub(super) struct PointMass {
    pub end: End,
    pub entries: Entries,
}

/// A node's displacement by coordinates.
#[derive(Debug)]
pub(super) struct End {
    node: NodeId,
    /// Places of its coordinates.
    pub places: Vec<usize>,
    /// Which of its element's coordinates each is.
    pub columns: Vec<usize>,
    /// First of its displacement's numbers, six a coordinate.
    pub start: usize,
}

/// Where the products of an element's coordinates go.
#[derive(Debug)]
pub(super) struct Entries {
    /// Number of its coordinates.
    pub count: usize,
    /// Lower triangle by rows.
    pub indices: Vec<usize>,
}

impl Entries {
    fn new(blocks: &Blocks, places: &[usize]) -> Self {
        let rows = places.iter().enumerate();
        let indices = rows.flat_map(|(k, a)| places[..=k].iter().map(|b| blocks.entry(*a, *b)));
        Self {
            count: places.len(),
            indices: indices.collect(),
        }
    }

    /// Numbers in a row of a matrix of these coordinates.
    pub fn width(&self) -> usize {
        self.count.next_multiple_of(ROW)
    }
}

impl Table {
    /// Of a divided model with exact masses; `None` where something is not what this way takes.
    pub fn new(plan: &Plan, model: &Model, members: &Members) -> Option<Self> {
        if plan.unknowns == 0 || plan.unknowns > MOST_COORDINATES || plan.has_idle {
            return None;
        }
        let on_node = |node: NodeId| &plan.columns[plan.topology.carrier_of[node.0]][..];
        let elements = plan.elements.iter().map(|element| &element.columns[..]);
        let masses = model.masses().iter().map(|mass| on_node(mass.node));
        let groups: Vec<&[usize]> = elements.chain(masses).collect();
        let blocks = Blocks::new(plan.unknowns, &groups);
        let mut table = Self {
            blocks,
            kinds: Vec::new(),
            members: Vec::new(),
            springs: Vec::new(),
            masses: Vec::new(),
            nodes: plan.unknowns,
            size: plan.unknowns,
            locals: 0,
        };
        let mut known: Vec<(*const Member, usize)> = Vec::new();
        for (k, element) in plan.elements.iter().enumerate() {
            let places = table.places(&element.columns);
            let entries = Entries::new(&table.blocks, &places);
            let Source::Subassembly(subassembly) = element.source else {
                let own = element.columns.iter().map(|c| table.blocks.places[*c]);
                let places: Vec<usize> = own.collect();
                table.springs.push(Spring {
                    element: k,
                    entries: Entries::new(&table.blocks, &places),
                    places,
                });
                continue;
            };
            let subassembly = &plan.topology.subassemblies[subassembly];
            let ([(segment, _)], None) = (&subassembly.segments[..], subassembly.flexible) else {
                return None;
            };
            let member = members.all.get(segment.0)?;
            let kind = match known.iter().find(|(own, _)| *own == Arc::as_ptr(member)) {
                Some((_, kind)) => *kind,
                None => {
                    table.kinds.push(Kind::new(member)?);
                    known.push((Arc::as_ptr(member), table.kinds.len() - 1));
                    table.kinds.len() - 1
                }
            };
            let ends = model.segments()[segment.0].ends;
            let ends = ends.map(|node| table.end(node, on_node(node), &places));
            table.members.push(Bar {
                segment: *segment,
                kind,
                ends,
                inner: table.size,
                entries,
            });
            table.size += table.kinds[kind].inner();
        }
        for mass in model.masses() {
            let columns = on_node(mass.node);
            let places = table.places(columns);
            let entries = Entries::new(&table.blocks, &places);
            let end = table.end(mass.node, columns, &places);
            table.masses.push(PointMass { end, entries });
        }
        Some(table)
    }

    /// Places of some coordinates, ascending.
    fn places(&self, columns: &[usize]) -> Vec<usize> {
        let mut places: Vec<usize> = columns.iter().map(|c| self.blocks.places[*c]).collect();
        places.sort_unstable();
        places.dedup();
        places
    }

    /// A node of an element with these places.
    fn end(&mut self, node: NodeId, columns: &[usize], places: &[usize]) -> End {
        let own: Vec<usize> = columns.iter().map(|c| self.blocks.places[*c]).collect();
        let start = self.locals;
        self.locals += 6 * own.len();
        End {
            node,
            columns: own
                .iter()
                .map(|p| places.partition_point(|other| other < p))
                .collect(),
            places: own,
            start,
        }
    }

    /// Brings the ends' displacements, and the springs of the workspace, to a configuration.
    pub fn form(
        &self,
        plan: &Plan,
        at: &Posture<'_>,
        workspace: &mut Workspace,
        locals: &mut [f64],
    ) -> Result<(), Fault> {
        carry(plan, at, workspace)?;
        for Spring { element, .. } in &self.springs {
            let element = &plan.elements[*element];
            if let Source::Spring(joint) = element.source {
                spring_element(plan, element, joint, at, workspace);
            }
        }
        for member in &self.members {
            let frame = at.segment_frame(member.segment)?;
            let to_local = frame.matrix().transpose();
            for end in &member.ends {
                end.form(plan, at.geometry, workspace, locals, |moved| {
                    let linear = to_local * moved.fixed_rows::<3>(0);
                    let angular = to_local * moved.fixed_rows::<3>(3);
                    [
                        linear[0], linear[1], linear[2], angular[0], angular[1], angular[2],
                    ]
                });
            }
        }
        for PointMass { end, .. } in &self.masses {
            end.form(plan, at.geometry, workspace, locals, |moved| {
                (*moved).into()
            });
        }
        Ok(())
    }
}

impl End {
    fn form(
        &self,
        plan: &Plan,
        geometry: &Geometry,
        workspace: &Workspace,
        locals: &mut [f64],
        seen: impl Fn(&Vector6<f64>) -> [f64; 6],
    ) {
        let carrier = plan.topology.carrier_of[self.node.0];
        let block = plan.block(workspace, carrier);
        let reference = plan.topology.carriers[carrier].reference;
        let own = locals[self.start..].chunks_exact_mut(6);
        let to_node = (reference != self.node).then(|| shift(geometry, reference, self.node));
        for (k, out) in own.take(self.places.len()).enumerate() {
            let column = read(block, 6 * k);
            let moved = to_node.map_or(column, |shift| shift * column);
            out.copy_from_slice(&seen(&moved));
        }
    }
}
