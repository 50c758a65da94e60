//! The order in which a mechanism is written down changes nothing: random mechanisms with their
//! bodies, points, members, joints, loads and `between` in another order. A swapped `between`
//! turns the sign of the reported wrench, which acts on the second body.

use std::hash::{DefaultHasher, Hash, Hasher};

use hyperstat_assembly::{BodyKind, Member, Model, NodeId, Solution, solve};
use hyperstat_tests::agreement::{
    compliances_agree, displacements_agree, nearly_singular, stiffnesses_agree, wrenches_agree,
};
use hyperstat_tests::build::node;
use hyperstat_tests::random::check_random_mechanisms;
use nalgebra::{Point3, Vector6};
use proptest::prelude::*;

/// A seed for the order of everything.
#[derive(Debug, Clone, Copy)]
struct Shuffle(u64);

impl Shuffle {
    /// The numbers 0..count in an order of their own for every `what`.
    fn order(&self, what: usize, count: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|k| self.key(what, *k));
        order
    }

    fn coin(&self, what: usize, k: usize) -> bool {
        self.key(what, k).is_multiple_of(2)
    }

    fn key(&self, what: usize, k: usize) -> u64 {
        let mut hasher = DefaultHasher::new();
        (self.0, what, k).hash(&mut hasher);
        hasher.finish()
    }
}

/// The same mechanism in another order, and for every one of its joints whether `between` is
/// swapped. Names stay, so that nodes and joints are found again by them.
fn reordered(model: &Model, shuffle: &Shuffle) -> (Model, Vec<bool>) {
    let mut new = Model::new(model.name.clone());
    for body in shuffle.order(0, model.bodies().len()) {
        add_body(&mut new, model, body, shuffle);
    }
    let same = |id: NodeId| {
        let old = &model.nodes()[id.0];
        node(&new, &model.bodies()[old.body.0].name, &old.point)
    };
    let (joints, loads) = (model.joints(), model.loads());
    let ends: Vec<_> = joints
        .iter()
        .map(|j| j.between.map(|n| n.map(same)))
        .collect();
    let loads: Vec<_> = loads.iter().map(|l| (same(l.node), l.wrench)).collect();
    let output = model.output().map(same).expect("an output");
    let mut swaps = Vec::new();
    for joint in shuffle.order(1, joints.len()) {
        let mut connection = joints[joint].clone();
        connection.between = ends[joint];
        let swap = shuffle.coin(2, joint);
        if swap {
            connection.between.swap(0, 1);
        }
        swaps.push(swap);
        new.add_joint(connection, model.geometry().frames[joint])
            .expect("a joint");
    }
    for load in shuffle.order(3, loads.len()) {
        new.add_load(loads[load].0, loads[load].1).expect("a load");
    }
    new.set_output(output);
    (new, swaps)
}

/// Adds the body `index` of `model` with its points and members in another order, and some members
/// from their second end to their first, their sections turned with them. Random mechanisms have
/// neither tapers nor flexible bodies.
fn add_body(new: &mut Model, model: &Model, index: usize, shuffle: &Shuffle) {
    let (body, geometry) = (&model.bodies()[index], model.geometry());
    let order = shuffle.order(10 + index, body.nodes.len());
    let points: Vec<(&str, Point3<f64>)> = order
        .iter()
        .map(|k| body.nodes[*k].0)
        .map(|n| (model.nodes()[n].point.as_str(), geometry.positions[n]))
        .collect();
    if body.kind == BodyKind::Rigid {
        new.add_rigid(&body.name, &points).expect("a rigid body");
        return;
    }
    let place = |node: NodeId| order.iter().position(|k| body.nodes[*k] == node);
    let members: Vec<Member> = shuffle
        .order(20 + index, body.segments.len())
        .into_iter()
        .map(|k| {
            let id = body.segments[k].0;
            let segment = &model.segments()[id];
            let mut ends = segment.ends.map(|n| place(n).expect("a node of the body"));
            if shuffle.coin(30 + index, k) {
                ends.swap(0, 1);
            }
            Member {
                ends,
                material: segment.material.clone(),
                section: segment.section.clone(),
                taper: None,
                y_axis: geometry.y_axes[id],
                elements: segment.elements,
            }
        })
        .collect();
    new.add_elastic(&body.name, &points, &members)
        .expect("an elastic body");
}

/// Whether two solutions of one mechanism in different orders say the same.
fn same_results(
    (model, first): (&Model, &Solution),
    (other, second, swaps): (&Model, &Solution, &[bool]),
) -> Result<(), TestCaseError> {
    prop_assert_eq!(first.mobility, second.mobility);
    prop_assert_eq!(first.overconstraint, second.overconstraint);
    prop_assert_eq!(first.idle.len(), second.idle.len());
    let (one, two) = (&first.output, &second.output);
    prop_assert_eq!(one.free_motions.len(), two.free_motions.len());
    prop_assert_eq!(one.rigid_directions.len(), two.rigid_directions.len());
    let floor = &first.floor;
    stiffnesses_agree(two.stiffness.as_ref(), one.stiffness.as_ref(), floor)?;
    compliances_agree(two.compliance.as_ref(), one.compliance.as_ref(), floor)?;
    if first.idle.is_empty() && one.free_motions.is_empty() {
        let displacement = |node: &_| second.displacements[same_node(model, other, node).0];
        let nodes: Vec<_> = (0..model.nodes().len()).map(NodeId).collect();
        let found: Vec<Vector6<f64>> = nodes.iter().map(displacement).collect();
        let pairs = found.iter().zip(&first.displacements);
        displacements_agree(pairs, floor)?;
    }
    let mut found = vec![None; model.joints().len()];
    for (k, joint) in other.joints().iter().enumerate() {
        let name = |j: &hyperstat_assembly::Connection| j.name == joint.name;
        let old = model.joints().iter().position(name).expect("a joint");
        let sign = if swaps[k] { -1.0 } else { 1.0 };
        found[old] = second.joint_wrenches[k].map(|w| w * sign);
    }
    wrenches_agree(found.iter().zip(&first.joint_wrenches), floor)
}

fn same_node(model: &Model, other: &Model, old: &NodeId) -> NodeId {
    let old = &model.nodes()[old.0];
    node(other, &model.bodies()[old.body.0].name, &old.point)
}

#[test]
fn order_changes_nothing() {
    let shuffles = any::<u64>().prop_map(Shuffle).no_shrink();
    check_random_mechanisms(shuffles, |model, shuffle| {
        let (other, swaps) = reordered(model, &shuffle);
        match (solve(model), solve(&other)) {
            (Ok(first), Ok(second)) => {
                if nearly_singular(&first) || nearly_singular(&second) {
                    return Ok(false);
                }
                same_results((model, &first), (&other, &second, &swaps))?;
                Ok(true)
            }
            (Err(first), Err(second)) => {
                let kind = std::mem::discriminant;
                prop_assert_eq!(kind(&first), kind(&second), "{} / {}", first, second);
                Ok(false)
            }
            (first, second) => Err(TestCaseError::fail(format!(
                "one order is solved, the other is not: {:?} / {:?}",
                first.err(),
                second.err()
            ))),
        }
    });
}
