//! Which elements are in series, so that nothing between them needs coordinates.

use std::collections::HashSet;
use std::ops::Range;

use super::chain::{MOST_RELEASES, Release};
use super::program::{Element, Kind, NodeLoad, NodeMotion, Screw, Spring, drop_shared};

/// What a mechanism is made of, while elements are joined.
pub(super) struct Series<'a> {
    pub elements: Vec<Element>,
    pub springs: Vec<Spring>,
    pub loads: &'a [NodeLoad],
    /// Coordinates that idle motions are told by.
    pub idle: Vec<usize>,
    /// Whether no load could work on an idle motion.
    pub still: bool,
    /// Coordinates that nothing needs any more.
    pub gone: Vec<bool>,
}

impl Series<'_> {
    /// Joins all that can be joined. `screws`: all of them; `components`: the coordinates of those
    /// that have six of their own, these first, but for the output's.
    pub fn join(&mut self, screws: &[Screw], components: &[Range<usize>]) {
        let mut motions: Vec<Option<&Release>> = vec![None; self.gone.len()];
        for screw in screws {
            motions[screw.coordinate] = Some(&screw.motion);
        }
        let loaded: HashSet<usize> = self
            .loads
            .iter()
            .flat_map(|l| l.node.coordinates())
            .collect();
        self.take_in(&motions, &loaded);
        let mut left: Vec<&Range<usize>> = components.iter().collect();
        loop {
            let before = left.len();
            left.retain(|component| !self.close(component, &loaded));
            if left.len() == before {
                return;
            }
            self.take_in(&motions, &loaded);
        }
    }

    /// Takes joints' coordinates that move one end of one chain, and nothing else, into the chain.
    fn take_in(&mut self, motions: &[Option<&Release>], loaded: &HashSet<usize>) {
        let mut uses = vec![0usize; self.gone.len()];
        for element in &self.elements {
            for coordinate in element.nodes.iter().flat_map(NodeMotion::coordinates) {
                uses[coordinate] += 1;
            }
        }
        for element in &mut self.elements {
            let Kind::Chain(chain) = &mut element.kind else {
                continue;
            };
            for node in &mut element.nodes {
                let springs = &mut self.springs;
                let (idle, still, gone) = (&mut self.idle, self.still, &mut self.gone);
                node.screws.retain(|&screw| {
                    let Some(motion) = motions[screw] else {
                        return true;
                    };
                    let own = |s: &Spring| s.coordinates.contains(&screw);
                    let alone = |s: &Spring| s.coordinates == [screw; 2];
                    let is_idle = idle.contains(&screw);
                    if uses[screw] != 1
                        || loaded.contains(&screw)
                        || (is_idle && !still)
                        || springs.iter().any(|s| own(s) && !alone(s))
                    {
                        return true;
                    }
                    let stiffness: f64 =
                        springs.iter().filter(|s| own(s)).map(|s| s.stiffness).sum();
                    if is_idle {
                        // It moves with others without energy, so it may as well stand still.
                        idle.retain(|c| *c != screw);
                    } else if stiffness > 0.0 {
                        chain.add_spring(motion.clone(), stiffness);
                    } else if chain.releases.len() < MOST_RELEASES {
                        chain.releases.push(motion.clone());
                    } else {
                        return true;
                    }
                    springs.retain(|s| !own(s));
                    gone[screw] = true;
                    false
                });
            }
        }
    }

    /// Joins the two chains that meet at a component, where there are two and nothing else does.
    fn close(&mut self, component: &Range<usize>, loaded: &HashSet<usize>) -> bool {
        let root = component.start;
        let mut screws = component.clone().skip(6);
        if screws.any(|c| !self.gone[c])
            || (root..root + 6).any(|c| loaded.contains(&c) || self.idle.contains(&c))
        {
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
        let releases = |k: usize| match &self.elements[k].kind {
            Kind::Chain(chain) => Some(chain.releases.len()),
            _ => None,
        };
        let (Some(a), Some(b)) = (releases(first), releases(second)) else {
            return false;
        };
        let outer = [
            self.elements[first].nodes[1 - inner_first].root,
            self.elements[second].nodes[1 - inner_second].root,
        ];
        let is_ring = outer[0].is_some() && outer[0] == outer[1];
        if first == second || is_ring || a + b > MOST_RELEASES {
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
        if let (Kind::Chain(chain), Kind::Chain(following)) = (own.kind, next.kind) {
            let mut nodes = vec![own.nodes[own_end].clone(), next.nodes[next_end].clone()];
            drop_shared(&mut nodes);
            let chain = chain.followed_by(following, [own_end, next_end]);
            if nodes.iter().any(NodeMotion::moves) {
                let kind = Kind::Chain(chain);
                self.elements.insert(low, Element { kind, nodes });
            }
        }
        for coordinate in component.clone() {
            self.gone[coordinate] = true;
        }
        true
    }
}
