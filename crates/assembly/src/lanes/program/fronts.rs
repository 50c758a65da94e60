//! The order of elimination, as a tree of dense fronts.
//!
//! A front gathers all that acts on some coordinates, its pivots, eliminates them, and hands what
//! is left over its other coordinates to its parent. The last front keeps the output's six, so
//! what is left there is the output stiffness (Eq. 45), and no solution is needed for it.

use super::element::{Element, Kind};
use super::inputs::Point;
use super::scatter::{chain, element, entry};
use std::ops::Range;

/// What a coordinate that is better eliminated late adds to its boundary.
const LATER: usize = 2;

/// What adds to a front.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FrontPart {
    Element(usize),
    Spring(usize),
    Load(usize),
}

/// A part and its coordinates, in the part's own order (repeated where nodes share them).
#[derive(Debug)]
pub(crate) struct Group {
    part: FrontPart,
    coordinates: Vec<usize>,
}

impl Group {
    pub fn element(k: usize, coordinates: Vec<usize>) -> Self {
        Self {
            part: FrontPart::Element(k),
            coordinates,
        }
    }

    pub fn spring(k: usize, coordinates: Vec<usize>) -> Self {
        Self {
            part: FrontPart::Spring(k),
            coordinates,
        }
    }

    pub fn load(k: usize, coordinates: Vec<usize>) -> Self {
        Self {
            part: FrontPart::Load(k),
            coordinates,
        }
    }
}

/// A front: a dense symmetric matrix over its variables.
#[derive(Debug)]
pub(crate) struct Front {
    /// Coordinates, the pivots first.
    pub variables: Vec<usize>,
    pub pivots: usize,
    /// Pivots, the last ones, that idle motions leave without stiffness.
    pub idle: usize,
    /// Variables, the last ones, that are rows of what acts.
    pub rows: usize,
    /// Parts with the places of their coordinates among the variables.
    pub parts: Vec<(FrontPart, Vec<usize>)>,
    pub children: Vec<Child>,
    /// Components whose motion is taken relative to a neighbour's before they are eliminated.
    pub hangs: Vec<Hang>,
    /// Where what is left goes, a square by columns of which the lower triangle counts.
    pub rest_start: usize,
    /// Where all that is added goes.
    pub scatter: Scatter,
}

/// What a child left, with the places of its coordinates among the parent's variables.
#[derive(Debug)]
pub(crate) struct Child {
    pub rest_start: usize,
    pub places: Vec<usize>,
}

/// All fronts, children before parents; the last one's variables end with the output's six and,
/// where there is one, the loads' row.
#[derive(Debug)]
pub(crate) struct Fronts {
    pub list: Vec<Front>,
    pub largest: usize,
    pub most_pivots: usize,
    pub rest_len: usize,
    /// Rows of what acts, all of which the last front has.
    pub rows: usize,
}

/// A front while the tree is made.
#[derive(Debug, Default)]
struct Node {
    pivots: Vec<usize>,
    /// The other variables, ascending.
    boundary: Vec<usize>,
    groups: Vec<usize>,
    children: Vec<usize>,
}

/// Coordinates that act on each other.
struct Clique {
    variables: Vec<usize>,
    origin: Origin,
}

#[derive(Clone, Copy)]
enum Origin {
    Group(usize),
    Node(usize),
}

impl Fronts {
    /// Orders the elimination of these `coordinates` by least boundary, `late` ones a little later.
    /// `idle` ones come after all others but the output's, and the `rows` of what acts last. `None`
    /// where nothing acts on some coordinate.
    pub fn new(
        coordinates: Vec<usize>,
        groups: Vec<Group>,
        idle: &[usize],
        output: Range<usize>,
        rows: Range<usize>,
        late: impl Fn(usize) -> bool,
    ) -> Option<Self> {
        let last: Vec<usize> = idle
            .iter()
            .copied()
            .chain(output.clone())
            .chain(rows.clone())
            .collect();
        let (mut nodes, cliques) = eliminate(coordinates, &groups, &last, late)?;
        let mut root = Node {
            pivots: idle.to_vec(),
            boundary: output.chain(rows.clone()).collect(),
            ..Node::default()
        };
        for clique in &cliques {
            root.take(clique.origin);
        }
        nodes.push(root);
        amalgamate(&mut nodes, idle.len());
        let order = postorder(&nodes);
        Some(Self::laid_out(&nodes, &order, &groups, idle.len(), rows))
    }

    /// The fronts in order, with the places of everything.
    fn laid_out(
        nodes: &[Node],
        order: &[usize],
        groups: &[Group],
        idle: usize,
        rows: Range<usize>,
    ) -> Self {
        let mut rest_starts = vec![0; nodes.len()];
        let mut fronts = Self {
            list: Vec::with_capacity(order.len()),
            largest: 0,
            most_pivots: 0,
            rest_len: 0,
            rows: rows.len(),
        };
        let mut top = 0;
        for &number in order {
            let node = &nodes[number];
            let variables: Vec<usize> = node.pivots.iter().chain(&node.boundary).copied().collect();
            let place = |c: &usize| {
                let place = variables.iter().position(|v| v == c);
                place.unwrap_or_else(|| unreachable!("coordinate {c} is not in its front"))
            };
            let children: Vec<Child> = node
                .children
                .iter()
                .map(|&child| Child {
                    rest_start: rest_starts[child],
                    places: nodes[child].boundary.iter().map(place).collect(),
                })
                .collect();
            // What children left lies on top of the stack, and is not needed after this front.
            let start = children.iter().map(|c| c.rest_start).min().unwrap_or(top);
            rest_starts[number] = start;
            let left = node.boundary.len();
            top = start + left * left;
            fronts.rest_len = fronts.rest_len.max(top);
            fronts.largest = fronts.largest.max(variables.len());
            fronts.most_pivots = fronts.most_pivots.max(node.pivots.len());
            let parts = node.groups.iter().map(|&g| {
                let group = &groups[g];
                (group.part, group.coordinates.iter().map(place).collect())
            });
            let is_last = fronts.list.len() + 1 == order.len();
            fronts.list.push(Front {
                parts: parts.collect(),
                pivots: node.pivots.len(),
                idle: if is_last { idle } else { 0 },
                rows: variables.iter().filter(|v| rows.contains(v)).count(),
                variables,
                children,
                hangs: Vec::new(),
                rest_start: start,
                scatter: Scatter::default(),
            });
        }
        fronts
    }

    /// Targets of the hang that has most.
    pub fn most_targets(&self) -> usize {
        let hangs = self.list.iter().flat_map(|f| &f.scatter.hangs);
        hangs.map(|h| h.targets.len()).max().unwrap_or(0)
    }

    /// Multiplications (each with an addition) that factoring all fronts takes.
    pub fn operations(&self) -> usize {
        let between_rows = |f: &Front| f.pivots * f.rows * (f.rows + 1) / 2;
        let of = |f: &Front| work(f.variables.len(), f.pivots) - between_rows(f);
        self.list.iter().map(of).sum()
    }
}

impl Node {
    fn take(&mut self, origin: Origin) {
        match origin {
            Origin::Group(group) => self.groups.push(group),
            Origin::Node(node) => self.children.push(node),
        }
    }
}

/// Eliminates all coordinates but the `last`; returns the fronts so far and what is left.
fn eliminate(
    coordinates: Vec<usize>,
    groups: &[Group],
    last: &[usize],
    late: impl Fn(usize) -> bool,
) -> Option<(Vec<Node>, Vec<Clique>)> {
    let mut cliques: Vec<Clique> = Vec::with_capacity(groups.len());
    for (k, group) in groups.iter().enumerate() {
        let mut variables = group.coordinates.clone();
        variables.sort_unstable();
        variables.dedup();
        cliques.push(Clique {
            variables,
            origin: Origin::Group(k),
        });
    }
    let count = cliques.iter().flat_map(|c| &c.variables).max();
    let count = 1 + count
        .into_iter()
        .chain(&coordinates)
        .max()
        .copied()
        .unwrap_or(0);
    let mut cliques_of: Vec<Vec<usize>> = vec![Vec::new(); count];
    for (k, clique) in cliques.iter().enumerate() {
        for &v in &clique.variables {
            cliques_of[v].push(k);
        }
    }
    let mut left = coordinates;
    left.retain(|v| !last.contains(v));
    if left.iter().any(|v| cliques_of[*v].is_empty()) {
        return None;
    }
    let mut nodes = Vec::new();
    let mut alive = vec![true; cliques.len()];
    // Boundary and size of the front of every coordinate, kept until a neighbour changes.
    let mut costs: Vec<Option<(usize, usize)>> = vec![None; count];
    while !left.is_empty() {
        let mut best = (usize::MAX, usize::MAX, usize::MAX);
        for &v in &left {
            let cost = *costs[v].get_or_insert_with(|| {
                let union = union_of(&cliques, &cliques_of[v]);
                let inside = union.iter().filter(|u| {
                    let is_pivot = !last.contains(u);
                    is_pivot && cliques_of[**u].iter().all(|c| cliques_of[v].contains(c))
                });
                let boundary = union.len() - inside.count();
                (boundary + if late(v) { LATER } else { 0 }, union.len())
            });
            best = best.min((cost.0, cost.1, v));
        }
        let merged = cliques_of[best.2].clone();
        let union = union_of(&cliques, &merged);
        let mut node = Node::default();
        for &u in &union {
            let inside = cliques_of[u].iter().all(|c| merged.contains(c));
            if inside && !last.contains(&u) {
                node.pivots.push(u);
            } else {
                node.boundary.push(u);
            }
        }
        for &c in &merged {
            node.take(cliques[c].origin);
            alive[c] = false;
        }
        left.retain(|v| !node.pivots.contains(v));
        let new = cliques.len();
        for &u in &node.boundary {
            cliques_of[u].retain(|c| !merged.contains(c));
            cliques_of[u].push(new);
        }
        for &u in &node.boundary {
            for &c in &cliques_of[u] {
                let variables = cliques.get(c).map_or(&node.boundary, |c| &c.variables);
                for &near in variables {
                    costs[near] = None;
                }
            }
        }
        cliques.push(Clique {
            variables: node.boundary.clone(),
            origin: Origin::Node(nodes.len()),
        });
        alive.push(true);
        nodes.push(node);
    }
    let rest = cliques.into_iter().zip(alive);
    let rest = rest.filter_map(|(clique, alive)| alive.then_some(clique));
    Some((nodes, rest.collect()))
}

fn union_of(cliques: &[Clique], which: &[usize]) -> Vec<usize> {
    let mut union: Vec<usize> = which
        .iter()
        .flat_map(|c| cliques[*c].variables.iter().copied())
        .collect();
    union.sort_unstable();
    union.dedup();
    union
}

/// Multiplications of a front of this size.
fn work(size: usize, pivots: usize) -> usize {
    (0..pivots).map(|k| (size - k) * (size - k + 1) / 2).sum()
}

/// What a front costs: its multiplications, and what is left is written and read once.
fn cost(size: usize, pivots: usize) -> usize {
    let left = size - pivots;
    work(size, pivots) + 3 * left * (left + 1) / 2
}

/// Joins children to their parents where the larger front costs less than moving what is left.
/// The last node is the root, whose last `idle` pivots stay last.
fn amalgamate(nodes: &mut [Node], idle: usize) {
    for parent in 0..nodes.len() {
        let is_root = parent + 1 == nodes.len();
        loop {
            let size_of = |n: &Node| n.pivots.len() + n.boundary.len();
            let own = &nodes[parent];
            let gain = |child: &usize| {
                let c = &nodes[*child];
                let (p, n) = (
                    own.pivots.len() + c.pivots.len(),
                    size_of(own) + c.pivots.len(),
                );
                let apart = cost(size_of(own), own.pivots.len()) + cost(size_of(c), c.pivots.len());
                apart.saturating_sub(cost(n, p))
            };
            let children = own.children.iter().copied();
            let Some((gained, child)) = children.map(|c| (gain(&c), c)).max() else {
                break;
            };
            if gained == 0 {
                break;
            }
            let joined = std::mem::take(&mut nodes[child]);
            let own = &mut nodes[parent];
            own.children.retain(|c| *c != child);
            own.children.extend(joined.children);
            own.groups.extend(joined.groups);
            let kept = if is_root { own.pivots.len() - idle } else { 0 };
            own.pivots.splice(kept..kept, joined.pivots);
        }
    }
}

/// Children before parents, from the last node down.
fn postorder(nodes: &[Node]) -> Vec<usize> {
    let mut order = Vec::new();
    let mut stack = vec![(nodes.len() - 1, false)];
    while let Some((node, ready)) = stack.pop() {
        if ready {
            order.push(node);
            continue;
        }
        stack.push((node, true));
        stack.extend(nodes[node].children.iter().rev().map(|c| (*c, false)));
    }
    order
}

/// A component that hangs on a neighbour, within a front.
#[derive(Debug)]
pub(crate) struct Hang {
    /// Places of its root's coordinates.
    pub places: [usize; 6],
    /// Places of the neighbour's root's coordinates.
    pub root: [usize; 6],
    /// Its screws, with their places.
    pub screws: Vec<(usize, usize)>,
    /// From the neighbour's reference point to its own, where they differ.
    pub arm: Option<[Point; 2]>,
    /// The element between them, added once it hangs.
    pub part: FrontPart,
    pub part_places: Vec<usize>,
}

/// From one place to another.
pub(crate) type Move = [u32; 2];

/// Moves of one source.
#[derive(Debug, Default)]
pub(crate) struct Moves {
    pub stored: Vec<Move>,
    pub added: Vec<Move>,
    /// Diagonal entries: from their places to their variables', for the errors.
    pub diagonal: Vec<Move>,
    /// Of a chain: entries of its coordinates, column by column of the lower triangle.
    pub pairs: Vec<u32>,
}

/// Everything that is added to a front.
#[derive(Debug, Default)]
pub(crate) struct Scatter {
    pub zeros: Vec<u32>,
    /// By children, parts, and parts of components that hang.
    pub children: Vec<Moves>,
    pub parts: Vec<Moves>,
    pub hung_parts: Vec<Moves>,
    /// By hangs: places of every row's entries in the component's six columns, and in the
    /// targets' columns (root first, then screws).
    pub hangs: Vec<HangPlaces>,
}

/// Places that a hang reads and writes, row by row.
#[derive(Debug, Default)]
pub(crate) struct HangPlaces {
    pub own: Vec<[u32; 6]>,
    /// Variables of the targets, and all others.
    pub targets: Vec<usize>,
    pub others: Vec<usize>,
    /// Entries (row, target) by rows.
    pub entries: Vec<u32>,
}

impl Scatter {
    /// Of a front whose hangs are settled.
    pub fn new(front: &Front, elements: &[Element]) -> Self {
        let size = front.variables.len();
        let columns = size - front.rows;
        let mut stored = vec![false; size * size];
        let mut scatter = Self::default();
        for child in &front.children {
            let count = child.places.len();
            let mut moves = Moves::default();
            for (c, &column) in child.places.iter().enumerate() {
                // Nothing is needed between rows of what acts.
                if column >= columns {
                    continue;
                }
                for (r, &row) in child.places.iter().enumerate().skip(c) {
                    let from = child.rest_start + c * count + r;
                    moves.push(from, entry(size, row, column), &mut stored);
                }
            }
            scatter.children.push(moves);
        }
        let mut zeros = Vec::new();
        let mut of = |part: FrontPart, places: &[usize], stored: &mut [bool]| match part {
            FrontPart::Element(k) => match elements[k].kind {
                Kind::Chain(_) => chain(&places[..elements[k].ends()], size, stored, &mut zeros),
                _ => element(&elements[k].nodes, places, size, stored),
            },
            FrontPart::Spring(_) | FrontPart::Load(_) => Moves::default(),
        };
        for (part, places) in &front.parts {
            scatter.parts.push(of(*part, places, &mut stored));
        }
        for hang in &front.hangs {
            let own = (0..size).map(|i| hang.places.map(|p| entry(size, i, p) as u32));
            let targets: Vec<usize> = hang
                .root
                .into_iter()
                .chain(hang.screws.iter().map(|(_, p)| *p))
                .collect();
            let entries = (0..size).flat_map(|i| targets.iter().map(move |t| (i, *t)));
            scatter.hangs.push(HangPlaces {
                own: own.collect(),
                entries: entries.map(|(i, t)| entry(size, i, t) as u32).collect(),
                others: (0..size).filter(|i| !targets.contains(i)).collect(),
                targets,
            });
            // What hangs is added after its motion was made relative: it is never first.
            let mut all = vec![true; size * size];
            scatter
                .hung_parts
                .push(of(hang.part, &hang.part_places, &mut all));
        }
        let lower = (0..columns).flat_map(|c| (c..size).map(move |r| c * size + r));
        zeros.extend(lower.filter(|p| !stored[*p]).map(|p| p as u32));
        scatter.zeros = zeros;
        scatter
    }
}

impl Moves {
    pub(crate) fn push(&mut self, from: usize, to: usize, stored: &mut [bool]) {
        let list = if stored[to] {
            &mut self.added
        } else {
            &mut self.stored
        };
        list.push([from as u32, to as u32]);
        stored[to] = true;
    }
}
