//! Subtrees that hang from a node and are solved with it.

use std::collections::HashMap;

use super::element::{Element, NodeMotion};
use super::fronts::{FrontPart, Fronts, Hang};
use super::inputs::Inputs;
use crate::lanes::pass::hang::{DOMINATED, MOST_FREE};
use hyperstat_model::NodeId;

/// Lets components hang on the neighbour that their stiffest element (by `weights`) joins them to,
/// in the fronts that eliminate them. `references`: reference points of the components by their
/// roots' first coordinates.
pub(crate) fn hang(
    fronts: &mut Fronts,
    elements: &mut [Element],
    weights: &[f64],
    references: &HashMap<usize, NodeId>,
    inputs: &mut Inputs,
) {
    let mut hung_elements = vec![false; elements.len()];
    // What was stiffest at components eliminated before, by the roots that it acts on since.
    let mut inherited: HashMap<usize, f64> = HashMap::new();
    for front in &mut fronts.list {
        let mut hung_roots: Vec<usize> = Vec::new();
        let place = |c: usize| front.variables.iter().position(|v| *v == c);
        let is_root = |c: &&usize| references.contains_key(c);
        let all_roots: Vec<usize> = front.variables.iter().filter(is_root).copied().collect();
        let own = front.pivots - front.idle;
        let roots: Vec<usize> = all_roots
            .iter()
            .copied()
            .filter(|c| (*c..*c + 6).all(|c| place(c).is_some_and(|p| p < own)))
            .collect();
        for root in roots {
            let joins = |e: &Element| e.nodes.iter().any(|n| n.root == Some(root));
            let mut attached: Vec<usize> = (0..elements.len())
                .filter(|k| !hung_elements[*k] && joins(&elements[*k]))
                .collect();
            attached.sort_by(|a, b| weights[*b].total_cmp(&weights[*a]));
            let before = inherited.get(&root).copied().unwrap_or(0.0);
            let weight = |place: usize| attached.get(place).map_or(0.0, |k| weights[*k]);
            let others = weight(1).max(before);
            for other in all_roots.iter().filter(|r| **r != root) {
                let entry = inherited.entry(*other).or_insert(0.0);
                *entry = entry.max(others);
            }
            let Some(&stiffest) = attached.first() else {
                continue;
            };
            if weights[stiffest] < others {
                continue;
            }
            if elements[stiffest].releases() > MOST_FREE {
                continue;
            }
            let nodes = &elements[stiffest].nodes;
            let Some(part) = front
                .parts
                .iter()
                .position(|(p, _)| *p == FrontPart::Element(stiffest))
            else {
                continue;
            };
            let [a, b] = nodes.as_slice() else { continue };
            let (own, other) = if a.root == Some(root) { (0, b) } else { (1, a) };
            // The loads' row of an element with loads inside needs both nodes.
            let coordinates = |n: &NodeMotion| n.screws.len() + n.root.map_or(0, |_| 6);
            let is_loaded = front.parts[part].1.len() != coordinates(a) + coordinates(b);
            let target = other
                .root
                .and_then(|r| references.get(&r).map(|at| (r, *at)));
            let Some((target, reference)) = target else {
                continue;
            };
            if is_loaded || target == root || hung_roots.contains(&target) {
                continue;
            }
            let (Some(places), Some(target_places)) =
                (six_places(root, place), six_places(target, place))
            else {
                continue;
            };
            let screws = other
                .screws
                .iter()
                .map(|s| Some((s.screw, place(s.coordinate)?)));
            let Some(screws) = screws.collect::<Option<Vec<_>>>() else {
                continue;
            };
            let (part, all_places) = front.parts.remove(part);
            let first = coordinates(a);
            let part_places = if own == 0 {
                &all_places[..first]
            } else {
                &all_places[first..]
            };
            hung_roots.push(root);
            hung_elements[stiffest] = true;
            front.hangs.push(Hang {
                places,
                root: target_places,
                screws,
                arm: inputs.arm(reference, references[&root]),
                part,
                part_places: part_places.to_vec(),
            });
            elements[stiffest].nodes[1 - own] = NodeMotion::default();
        }
    }
}

/// Roots that no one element holds much more stiffly than all others: a component that one does
/// can hang on its neighbour, and should be eliminated before it.
pub(crate) fn last_roots(
    elements: &[Element],
    weights: &[f64],
    references: &HashMap<usize, NodeId>,
) -> Vec<usize> {
    let roots = references.keys().copied();
    let is_last = |root: &usize| {
        let joins = |e: &Element| e.nodes.iter().any(|n| n.root == Some(*root));
        let attached = elements.iter().zip(weights).filter(|(e, _)| joins(e));
        let (mut first, mut second) = (0.0, 0.0);
        for (_, &weight) in attached {
            if weight > first {
                second = first;
                first = weight;
            } else if weight > second {
                second = weight;
            }
        }
        second > DOMINATED * first
    };
    roots.filter(is_last).collect()
}

/// Places of six coordinates in a row.
pub(crate) fn six_places(
    first: usize,
    place: impl Fn(usize) -> Option<usize>,
) -> Option<[usize; 6]> {
    let places: Option<Vec<usize>> = (first..first + 6).map(place).collect();
    places?.try_into().ok()
}
