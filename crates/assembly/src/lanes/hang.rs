//! Motions relative to a stiff neighbour.
//!
//! Where a stiff element joins a component to another, eliminating the component in absolute
//! coordinates takes the difference of two large stiffnesses to find a small one: what is soft in
//! series with the stiff element loses its digits. So the component is made to *hang* on its
//! neighbour first: its six coordinates become those relative to the neighbour's rigid motion,
//! and the stiff element, added after that, acts on these alone.

use std::collections::HashMap;

use pulp::Simd;

use super::blocks::arm;
use super::factor::Matrix;
use super::fronts::{Fronts, Part};
use super::inputs::{Inputs, Point};
use super::lane::{Lane, Vec3, add, cross, six, three};
use super::program::{Element, NodeMotion};
use super::scatter::HangPlaces;
use crate::model::NodeId;

/// An element is much stiffer than others below this share of its stiffness.
const DOMINATED: f64 = 0.3;

/// A chain with more free motions than this holds nothing along most directions: what hangs on it
/// would gain the neighbour's stiffness there and lose digits instead of keeping them.
const MOST_FREE: usize = 1;

/// Coordinates of a root.
const ROOT: usize = 6;

/// A component that hangs on a neighbour, within a front.
#[derive(Debug)]
pub(super) struct Hang {
    /// Places of its root's coordinates.
    pub places: [usize; 6],
    /// Places of the neighbour's root's coordinates.
    pub root: [usize; 6],
    /// Its screws, with their places.
    pub screws: Vec<(usize, usize)>,
    /// From the neighbour's reference point to its own, where they differ.
    pub arm: Option<[Point; 2]>,
    /// The element between them, added once it hangs.
    pub part: Part,
    pub part_places: Vec<usize>,
}

/// What the motion of a neighbour is made of.
pub(super) struct Motion<'a, S: Simd> {
    pub inputs: &'a [S::f64s],
    pub screws: &'a [S::f64s],
}

/// Lets components hang on the neighbour that their stiffest element (by `weights`) joins them to,
/// in the fronts that eliminate them. `references`: reference points of the components by their
/// roots' first coordinates.
pub(super) fn hang(
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
                .position(|(p, _)| *p == Part::Element(stiffest))
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
            let screws = other.screws.iter().map(|s| Some((*s, place(*s)?)));
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
pub(super) fn late_roots(
    elements: &[Element],
    weights: &[f64],
    references: &HashMap<usize, NodeId>,
) -> Vec<usize> {
    let roots = references.keys().copied();
    let is_late = |root: &usize| {
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
    roots.filter(is_late).collect()
}

/// Places of six coordinates in a row.
fn six_places(first: usize, place: impl Fn(usize) -> Option<usize>) -> Option<[usize; 6]> {
    let places: Option<Vec<usize>> = (first..first + 6).map(place).collect();
    places?.try_into().ok()
}

/// Makes the coordinates of a component relative: `u = v + T w` with the neighbour's coordinates
/// w. Every column of w gains `A_P T`, every row likewise. `gains`: an entry for every row and
/// target.
#[inline(always)]
pub(super) fn make_relative<S: Simd>(
    simd: S,
    matrix: &mut Matrix<'_, S>,
    hang: &Hang,
    places: &HangPlaces,
    motion: &Motion<'_, S>,
    gains: &mut [S::f64s],
) {
    let count = places.targets.len();
    let arm = match hang.arm {
        Some(points) => Some(arm(simd, motion.inputs, points)),
        None => None,
    };
    // Gains of every row and target: A_P T.
    for (own, gains) in places.own.iter().zip(gains.chunks_exact_mut(count)) {
        let row: Column<S> = six!(q => Lane::new(simd, matrix.entries[own[q] as usize]));
        let turned = turned(&row, &arm);
        let (root, screws) = gains.split_at_mut(6);
        for k in 0..3 {
            root[k] = row[k].value;
            root[3 + k] = turned[k].value;
        }
        for ((screw, _), gain) in hang.screws.iter().zip(screws) {
            *gain = work_of(&twist(simd, *screw, motion, &arm), &row).value;
        }
    }
    // Between targets: A_CP T and its transpose, and Tᵀ A_PP T.
    for (b, &column) in places.targets.iter().enumerate() {
        let inner: Column<S> = six!(q => Lane::new(simd, gains[hang.places[q] * count + b]));
        let turned = turned(&inner, &arm);
        for (a, &row) in places.targets.iter().enumerate().skip(b) {
            let energy = if a >= ROOT {
                let (screw, _) = hang.screws[a - ROOT];
                work_of(&twist(simd, screw, motion, &arm), &inner)
            } else if a < 3 {
                inner[a]
            } else {
                turned[a - 3]
            };
            let crossed = Lane::new(simd, gains[row * count + b])
                + Lane::new(simd, gains[column * count + a]);
            let entry = &mut matrix.entries[places.entries[row * count + b] as usize];
            *entry = simd.add_f64s(*entry, (energy + crossed).value);
        }
        // The entries' errors, as if the component's were the target's own.
        relative_error(simd, &mut *matrix.errors, column, b, hang, motion, &arm);
        if !matrix.load_errors.is_empty() {
            relative_error(
                simd,
                &mut *matrix.load_errors,
                column,
                b,
                hang,
                motion,
                &arm,
            );
        }
    }
    for &row in &places.others {
        let gains = &gains[row * count..(row + 1) * count];
        let entries = &places.entries[row * count..(row + 1) * count];
        for (gain, place) in gains.iter().zip(entries) {
            let entry = &mut matrix.entries[*place as usize];
            *entry = simd.add_f64s(*entry, *gain);
        }
    }
}

/// Adds the errors of a component's coordinates to that of target `b`.
#[inline(always)]
fn relative_error<S: Simd>(
    simd: S,
    errors: &mut [S::f64s],
    column: usize,
    b: usize,
    hang: &Hang,
    motion: &Motion<'_, S>,
    arm: &Option<Vec3<S>>,
) {
    let mut error = Lane::new(simd, errors[column]);
    let own: Column<S> = six!(q => Lane::new(simd, errors[hang.places[q]]));
    if b >= ROOT {
        let (screw, _) = hang.screws[b - ROOT];
        let twist = twist(simd, screw, motion, arm);
        for q in 0..6 {
            error = (twist[q] * twist[q]).mul_add(own[q], error);
        }
    } else {
        error += own[b];
        if let (Some(arm), Some(axis)) = (arm, b.checked_sub(3)) {
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            error = (arm[j] * arm[j]).mul_add(own[i], error);
            error = (arm[i] * arm[i]).mul_add(own[j], error);
        }
    }
    errors[column] = error.value;
}

/// Six numbers of one row, or of one twist.
type Column<S> = [Lane<S>; 6];

/// The angular part of a row, for turns about the neighbour's reference point.
#[inline(always)]
fn turned<S: Simd>(row: &Column<S>, arm: &Option<Vec3<S>>) -> Vec3<S> {
    let angular = [row[3], row[4], row[5]];
    match arm {
        Some(arm) => add(&angular, &cross(arm, &[row[0], row[1], row[2]])),
        None => angular,
    }
}

/// A screw of the neighbour at the component's reference point.
#[inline(always)]
fn twist<S: Simd>(
    simd: S,
    screw: usize,
    motion: &Motion<'_, S>,
    arm: &Option<Vec3<S>>,
) -> Column<S> {
    let at = &motion.screws[6 * screw..6 * screw + 6];
    let mut linear: Vec3<S> = three!(k => Lane::new(simd, at[k]));
    let angular: Vec3<S> = three!(k => Lane::new(simd, at[3 + k]));
    if let Some(arm) = arm {
        linear = add(&linear, &cross(&angular, arm));
    }
    six!(k => if k < 3 { linear[k] } else { angular[k - 3] })
}

#[inline(always)]
fn work_of<S: Simd>(twist: &Column<S>, row: &Column<S>) -> Lane<S> {
    let mut sum = twist[0] * row[0];
    for k in 1..6 {
        sum = twist[k].mul_add(row[k], sum);
    }
    sum
}
