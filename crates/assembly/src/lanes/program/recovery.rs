//! Where forces come from: what the pass keeps of its fronts and chains, and which parts meet at a joint.
//!
//! A chain's wrench is known once its ends' displacements are, and with the loads on its way that of
//! every link. A joint that ties carriers into a tree carries what all that is fastened beyond it asks
//! for; an elastic joint between trees is a link itself. So a pose needs no equations for its forces.

use std::ops::Range;

use hyperstat_model::{Geometry, JointId, Misfit, Model, NodeId, SegmentId};
use nalgebra::Vector6;

use super::acts::Act;
use super::chain::{Chain, Item, LinkSource};
use super::element::{Element, Kind, NodeMotion, Screw};
use super::fronts::{FrontPart, Fronts};
use super::inputs::{Inputs, Point};
use crate::plan::roles::JointRole;
use crate::plan::topology::Topology;
use crate::posture::Posture;
use crate::state::acting::Acting;
use crate::state::floor::Floor;
use crate::state::preload::loose_wrench;

/// What is needed for the forces of a pose, worked out once a topology.
#[derive(Debug)]
pub(crate) struct Recovery {
    /// By fronts: where its panel is kept.
    pub panels: Vec<usize>,
    /// By elements, all of them chains.
    pub chains: Vec<KeptChain>,
    /// Numbers that are kept of a pose.
    pub len: usize,
    /// Places in chains where a wrench is taken, of all chains.
    pub cuts: usize,
    /// By segments.
    pub segments: Vec<SegmentAt>,
    /// By joints.
    pub joints: Vec<JointAt>,
    /// Wrenches on nodes.
    pub loads: Vec<NodeWrench>,
    /// Preloads that count with the joints' wrenches, in the joints' frames.
    pub preloads: Vec<(JointId, Vector6<f64>)>,
    /// Whether anything acts along segments.
    pub along: bool,
    /// By states: what acts, in the plan's configuration.
    pub floors: Vec<Floor>,
    /// Of nothing that acts.
    pub at_rest: Floor,
    /// By coordinates: whether it is a translation.
    pub slides: Vec<bool>,
}

/// What is kept of a chain.
#[derive(Debug)]
pub(crate) struct KeptChain {
    pub layout: Layout,
    pub start: usize,
    /// Of its ends, in the order of their works.
    pub coordinates: Vec<usize>,
    /// The front and its hang by which it acts on relative coordinates.
    pub hang: Option<[usize; 2]>,
    /// The first of its cuts, one an item of its order.
    pub first_cut: usize,
}

/// The order in which a chain's numbers are kept: its frame's origin, its axes by rows, and then what
/// follows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Layout {
    /// Wrenches that it transmits.
    pub wrenches: usize,
    /// Coordinates of its ends.
    pub coordinates: usize,
}

/// Where the axes are.
pub(crate) const AXES: usize = 3;

impl Layout {
    /// Six numbers a wrench: its directions.
    pub const fn directions(self) -> usize {
        AXES + 9
    }

    /// Stiffnesses, one a wrench, then their relative errors.
    pub const fn stiffness(self) -> usize {
        self.directions() + 6 * self.wrenches
    }

    pub const fn trust(self) -> usize {
        self.stiffness() + self.wrenches
    }

    /// Works of the wrenches, all of them a coordinate.
    pub const fn works(self) -> usize {
        self.trust() + self.wrenches
    }

    /// What a column of what acts does, by the number that it has in the chain.
    pub const fn column(self, number: usize) -> usize {
        self.works() + self.wrenches * self.coordinates + number * self.of_column()
    }

    /// Numbers of a column: the wrench with both ends held but for the transmitted ones, the transmitted
    /// ones reversed, squares of their errors, and what all of these do on the coordinates.
    pub const fn of_column(self) -> usize {
        6 + 2 * self.wrenches + self.coordinates
    }
}

/// A segment in a chain.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SegmentAt {
    pub element: usize,
    pub cut: usize,
    /// Whether its second node is towards the chain's end 0.
    pub flipped: bool,
    pub points: [Point; 2],
    /// Direction of local y.
    pub y_axis: usize,
}

/// What a joint's wrench is the sum of.
#[derive(Debug)]
pub(crate) struct JointAt {
    pub point: Point,
    /// Columns of its frame.
    pub frame: [usize; 3],
    /// Elements and cuts, with the sign by which they count on the joint's second body.
    pub cuts: Vec<(usize, usize, f64)>,
    /// Loads, likewise.
    pub loads: Vec<(usize, f64)>,
}

/// A wrench on a node, of one of the columns of what acts.
#[derive(Debug, Clone)]
pub(crate) struct NodeWrench {
    pub node: NodeId,
    pub point: Point,
    pub act: Act,
    pub column: usize,
}

/// A link and the carriers at its ends.
struct Placed {
    element: usize,
    cut: usize,
    carriers: [Option<usize>; 2],
}

impl Recovery {
    /// That of a mechanism of chains and trees; `None` of any other: with flexible bodies, joints of
    /// singular stiffness, loops of rigid bodies, and segments that nothing moves. Budgets lean on that:
    /// the deflection of every joint follows from its wrench.
    pub fn new(
        model: &Model,
        geometry: &Geometry,
        topology: &Topology,
        (elements, screws, fronts): (&[Element], &[Screw], &Fronts),
        loads: Vec<NodeWrench>,
        inputs: &mut Inputs,
    ) -> Option<Self> {
        let is_singular = |joint: &JointRole| {
            !joint.directions.elastic.is_empty() && joint.directions.compliance.is_none()
        };
        if topology.components.iter().any(|c| !c.closings.is_empty())
            || topology.joints.iter().any(is_singular)
        {
            return None;
        }
        let at = Posture::new(model, geometry);
        let acting = Acting::of_model(&at).ok()?;
        let at_rest = Floor::at_rest(&at);
        let mut recovery = Self {
            panels: Vec::with_capacity(fronts.list.len()),
            chains: Vec::with_capacity(elements.len()),
            len: 0,
            cuts: 0,
            segments: Vec::new(),
            joints: Vec::new(),
            loads,
            preloads: preloads(model),
            along: acting.iter().any(|a| !a.segments().is_empty()),
            floors: acting.iter().map(|a| at_rest.under(&at, a)).collect(),
            at_rest,
            slides: vec![false; topology.coordinates],
        };
        for component in &topology.components {
            if let Some(root) = component.root {
                let first = topology.carriers[root].coordinates[0];
                recovery.slides[first..first + 3].fill(true);
            }
        }
        for screw in screws {
            let turns = screw.motion.axes.iter().any(|(_, _, about)| *about != 0.0);
            recovery.slides[screw.coordinate] = !turns;
        }
        for front in &fronts.list {
            recovery.panels.push(recovery.len);
            recovery.len += front.pivots * front.variables.len();
        }
        for (k, element) in elements.iter().enumerate() {
            let Kind::Chain(chain) = &element.kind else {
                return None;
            };
            recovery.add_chain(k, element, chain, fronts);
        }
        recovery.place(model, topology, elements, inputs)?;
        Some(recovery)
    }

    fn add_chain(&mut self, k: usize, element: &Element, chain: &Chain, fronts: &Fronts) {
        let coordinates = element.nodes.iter().flat_map(NodeMotion::coordinates);
        let coordinates: Vec<usize> = coordinates.collect();
        let layout = Layout {
            wrenches: 6 - chain.releases.len(),
            coordinates: coordinates.len(),
        };
        let hangs = fronts.list.iter().enumerate().flat_map(|(front, own)| {
            let hangs = own.hangs.iter().enumerate();
            hangs.map(move |(hang, own)| ([front, hang], own.part))
        });
        let mut hangs = hangs.filter(|(_, part)| *part == FrontPart::Element(k));
        self.chains.push(KeptChain {
            layout,
            start: self.len,
            coordinates,
            hang: hangs.next().map(|(place, _)| place),
            first_cut: self.cuts,
        });
        self.len += layout.column(element.columns.len());
        self.cuts += chain.order.len();
    }

    /// Where the numbers of an element are kept.
    pub fn range(&self, element: usize) -> Range<usize> {
        let next = self.chains.get(element + 1).map_or(self.len, |c| c.start);
        self.chains[element].start..next
    }

    /// Finds every segment and joint; `None` where one has no place.
    fn place(
        &mut self,
        model: &Model,
        topology: &Topology,
        elements: &[Element],
        inputs: &mut Inputs,
    ) -> Option<()> {
        let mut segments: Vec<Option<SegmentAt>> = vec![None; model.segments().len()];
        let mut links: Vec<Option<(usize, usize, f64)>> = vec![None; model.joints().len()];
        let mut placed = Vec::new();
        let carrier = |node: NodeId| topology.carrier_of[node.0];
        for (element, own) in elements.iter().enumerate() {
            let Kind::Chain(chain) = &own.kind else {
                return None;
            };
            for (item, place) in chain.order.iter().zip(self.chains[element].first_cut..) {
                let Item::Link(k) = item else { continue };
                let link = &chain.links[*k];
                let mut carriers = match link.source {
                    LinkSource::Segment(SegmentId(id)) => {
                        let ends = model.segments()[id].ends;
                        segments[id] = Some(SegmentAt {
                            element,
                            cut: place,
                            flipped: link.flipped,
                            points: ends.map(|node| inputs.point(node)),
                            y_axis: inputs.y_axis(SegmentId(id), ends),
                        });
                        ends.map(|node| Some(carrier(node)))
                    }
                    LinkSource::Joint(JointId(id)) => {
                        let between = model.joints()[id].between;
                        // A joint to the ground has the ground at its second end.
                        let turned = between[0].is_none();
                        let sign = if turned == link.flipped { -1.0 } else { 1.0 };
                        links[id] = Some((element, place, sign));
                        let mut carriers = between.map(|node| node.map(carrier));
                        if turned {
                            carriers.reverse();
                        }
                        carriers
                    }
                    LinkSource::Coordinate => continue,
                };
                if link.flipped {
                    carriers.reverse();
                }
                placed.push(Placed {
                    element,
                    cut: place,
                    carriers,
                });
            }
        }
        self.segments = segments.into_iter().collect::<Option<_>>()?;
        for (joint, link) in links.into_iter().enumerate() {
            let ties = topology.components.iter().flat_map(|c| &c.ties);
            let tie = ties.into_iter().find(|tie| tie.joint.0 == joint);
            let node = model.joints()[joint].between.into_iter().flatten().next()?;
            let mut own = JointAt {
                point: inputs.point(node),
                frame: [0, 1, 2].map(|c| inputs.frame_column(JointId(joint), c)),
                cuts: Vec::new(),
                loads: Vec::new(),
            };
            match (tie, link) {
                (Some(tie), _) => {
                    let is_second = model.joints()[joint].between[1] == Some(tie.child_node);
                    let sign = if is_second { 1.0 } else { -1.0 };
                    let beyond = subtree(topology, tie.child);
                    self.add_beyond(&mut own, &beyond, sign, &placed, carrier);
                }
                (None, Some(link)) => own.cuts.push(link),
                (None, None) if topology.joints[joint].springs.is_empty() => {}
                (None, None) => return None,
            }
            self.joints.push(own);
        }
        Some(())
    }

    /// Adds what the links and loads at some carriers ask of what holds these.
    fn add_beyond(
        &self,
        own: &mut JointAt,
        carriers: &[usize],
        sign: f64,
        links: &[Placed],
        carrier: impl Fn(NodeId) -> usize,
    ) {
        for link in links {
            let [first, second] = link
                .carriers
                .map(|c| c.is_some_and(|c| carriers.contains(&c)));
            let sign = match (first, second) {
                (true, false) => -sign,
                (false, true) => sign,
                _ => continue,
            };
            own.cuts.push((link.element, link.cut, sign));
        }
        let loads = self.loads.iter().enumerate();
        let held = loads.filter(|(_, load)| carriers.contains(&carrier(load.node)));
        own.loads = held.map(|(k, _)| (k, -sign)).collect();
    }
}

/// A carrier with all that hang from it.
fn subtree(topology: &Topology, carrier: usize) -> Vec<usize> {
    let mut found = vec![carrier];
    let mut next = 0;
    while let Some(&parent) = found.get(next) {
        let ties = topology.components.iter().flat_map(|c| &c.ties);
        let children = ties.filter(|tie| tie.parent == Some(parent));
        found.extend(children.map(|tie| tie.child));
        next += 1;
    }
    found
}

fn preloads(model: &Model) -> Vec<(JointId, Vector6<f64>)> {
    let own = |entry: &Misfit| (entry.joint, loose_wrench(model, entry));
    model.misfits().iter().map(own).collect()
}
