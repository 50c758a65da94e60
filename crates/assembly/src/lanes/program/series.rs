//! Which elements are in series, so that nothing between them needs coordinates.

use std::ops::Range;

use nalgebra::Vector3;

use super::chain::{Idle, MOST_IDLE, MOST_RELEASES, Release};
use super::element::{Element, Kind, NodeLoad, NodeMotion, Screw, Shift, Spring};
use super::parts::drop_shared;

/// What a mechanism is made of, while elements are joined.
#[derive(Clone)]
pub(crate) struct Series {
    pub elements: Vec<Element>,
    pub springs: Vec<Spring>,
    /// Loads on what has coordinates.
    pub loads: Vec<NodeLoad>,
    /// Coordinates that idle motions are told by.
    pub idle: Vec<usize>,
    /// Those of them that a chain may take in, if they move nothing else.
    pub private: Vec<usize>,
    /// Coordinates that nothing needs any more.
    pub gone: Vec<bool>,
}

impl Series {
    /// Joins all that can be joined; idle motions go into chains that contain them, where `at` are
    /// the inputs' vectors. `screws`: all of them; `components`: the coordinates of those
    /// that have six of their own, these first, but for the output's.
    pub fn joined(
        mut self,
        screws: &[Screw],
        components: &[Range<usize>],
        at: impl Fn(usize) -> Vector3<f64>,
    ) -> Self {
        loop {
            let mut series = self.clone();
            series.join(screws, components);
            let strange = series.elements.iter().flat_map(|e| match &e.kind {
                Kind::Chain(chain) => chain.strange_idle(&at),
                _ => Vec::new(),
            });
            let strange: Vec<usize> = strange.collect();
            if strange.is_empty() {
                // What nothing moves any more stands between parts of the ground.
                series.elements.retain(Element::counts);
                return series;
            }
            self.private.retain(|c| !strange.contains(c));
        }
    }

    fn join(&mut self, screws: &[Screw], components: &[Range<usize>]) {
        let mut motions: Vec<Option<&Release>> = vec![None; self.gone.len()];
        // What moves bodies of a loop moves several of them.
        for screw in screws.iter().filter(|screw| !screw.in_loop) {
            motions[screw.coordinate] = Some(&screw.motion);
        }
        self.take_in(&motions);
        let mut left: Vec<&Range<usize>> = components.iter().collect();
        loop {
            let before = left.len();
            left.retain(|component| !self.close(component));
            if left.len() == before {
                return;
            }
            self.take_in(&motions);
        }
    }

    /// Takes joints' coordinates that move one end of one chain, and loads there, into the chain.
    fn take_in(&mut self, motions: &[Option<&Release>]) {
        let mut uses = vec![0usize; self.gone.len()];
        for element in &self.elements {
            for coordinate in element.nodes.iter().flat_map(NodeMotion::coordinates) {
                uses[coordinate] += 1;
            }
        }
        for k in 0..self.elements.len() {
            for end in 0..self.elements[k].nodes.len() {
                // What is nearest to the chain first.
                for own in self.elements[k].nodes[end].screws.clone().into_iter().rev() {
                    let screw = own.coordinate;
                    if let (Some(motion), 1) = (motions[screw], uses[screw]) {
                        self.take_in_screw([k, end], screw, motion);
                    }
                }
            }
        }
    }

    /// Takes a joint's coordinate that moves one end of a chain and no other element into it.
    fn take_in_screw(&mut self, [k, end]: [usize; 2], screw: usize, motion: &Release) {
        let own = |s: &Spring| s.coordinates.contains(&screw);
        let alone = |s: &Spring| s.coordinates == [screw; 2];
        if self.springs.iter().any(|s| own(s) && !alone(s)) {
            return;
        }
        let stiffness = self.springs.iter().filter(|s| own(s)).map(|s| s.stiffness);
        let stiffness: f64 = stiffness.sum();
        let is_idle = self.idle.contains(&screw);
        let Element { kind, nodes, .. } = &mut self.elements[k];
        let Kind::Chain(chain) = kind else {
            return;
        };
        let has_room = if is_idle {
            self.private.contains(&screw) && chain.idle.len() < MOST_IDLE
        } else {
            stiffness > 0.0 || chain.releases.len() < MOST_RELEASES
        };
        // What the coordinate moves beside the chain must move just as the chain's end does.
        let node = &mut nodes[end];
        let moved = |l: &NodeLoad| l.node.is_moved_by(screw);
        let like_node = |l: &NodeLoad| l.node.root == node.root && l.node.screws == node.screws;
        if !has_room || self.loads.iter().any(|l| moved(l) && !like_node(l)) {
            return;
        }
        for load in self.loads.extract_if(.., |l| moved(l)) {
            chain.add_load(end, load.inner());
        }
        if is_idle {
            let (coordinate, along) = (screw, motion.clone());
            chain.add_idle(end, Idle { coordinate, along });
            self.idle.retain(|c| *c != screw);
        } else if stiffness > 0.0 {
            chain.add_spring(end, motion.clone(), stiffness);
        } else {
            chain.add_release(end, motion.clone());
        }
        node.screws.retain(|s| s.coordinate != screw);
        self.springs.retain(|s| !own(s));
        self.gone[screw] = true;
    }

    /// Joins the two chains that meet at a component, where there are two and nothing else does.
    fn close(&mut self, component: &Range<usize>) -> bool {
        let root = component.start;
        let mut screws = component.clone().skip(6);
        if screws.any(|c| !self.gone[c]) || (root..root + 6).any(|c| self.idle.contains(&c)) {
            return false;
        }
        let ends = self.elements.iter().enumerate().flat_map(|(k, element)| {
            let nodes = element.nodes.iter().enumerate();
            nodes.filter_map(move |(end, node)| (node.root == Some(root)).then_some([k, end]))
        });
        let ends: Vec<[usize; 2]> = ends.collect();
        let [[first, inner_first], [second, inner_second]] = ends[..] else {
            return false;
        };
        let free = |k: usize| match &self.elements[k].kind {
            Kind::Chain(chain) => Some([chain.releases.len(), chain.idle.len(), chain.loads.len()]),
            _ => None,
        };
        let (Some(a), Some(b)) = (free(first), free(second)) else {
            return false;
        };
        let outer = [
            &self.elements[first].nodes[1 - inner_first],
            &self.elements[second].nodes[1 - inner_second],
        ];
        let is_ring = outer[0].root.is_some() && outer[0].root == outer[1].root;
        // A motion that the ends share does no work on the chain, but it does on loads within.
        let shares = outer[0]
            .screws
            .iter()
            .any(|s| outer[1].is_moved_by(s.coordinate));
        let is_loaded = self.loads.iter().any(|l| l.node.root == Some(root));
        let has_room = a[0] + b[0] <= MOST_RELEASES && a[1] + b[1] <= MOST_IDLE;
        let would_lose = shares && (is_loaded || a[2] + b[2] > 0);
        if first == second || is_ring || would_lose || !has_room {
            return false;
        }
        let (low, high) = (first.min(second), first.max(second));
        let next = self.elements.remove(high);
        let own = self.elements.remove(low);
        let (own_end, next_end) = if low == first {
            (1 - inner_first, 1 - inner_second)
        } else {
            (1 - inner_second, 1 - inner_first)
        };
        if let (Kind::Chain(mut chain), Kind::Chain(following)) = (own.kind, next.kind) {
            for load in self.loads.extract_if(.., |l| l.node.root == Some(root)) {
                chain.add_load(1 - own_end, load.inner());
            }
            let mut nodes = vec![own.nodes[own_end].clone(), next.nodes[next_end].clone()];
            drop_shared(&mut nodes);
            let chain = chain.followed_by(following, [own_end, next_end]);
            let mut shifts = as_second(own.shifts, own_end == 0);
            shifts.extend(as_second(next.shifts, next_end == 1));
            let joined = Element {
                kind: Kind::Chain(chain),
                nodes,
                shifts,
                columns: Vec::new(),
                shared: Vec::new(),
            };
            self.elements.insert(low, joined);
        }
        for coordinate in component.clone() {
            self.gone[coordinate] = true;
        }
        true
    }
}

/// Shifts of a chain's ends, all at its second one; of a chain that is run through backwards, all
/// the other way.
fn as_second(mut shifts: Vec<Shift>, forwards: bool) -> Vec<Shift> {
    for shift in &mut shifts {
        if (shift.node == 1) != forwards {
            shift.sign = -shift.sign;
        }
        shift.node = 1;
    }
    shifts
}
