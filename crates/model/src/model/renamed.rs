//! The same model under other names.

use super::Model;

impl Model {
    /// The same model, whose bodies, joints and points are called as `name` makes of their names; `None` where two of
    /// a kind would have one name.
    pub fn renamed(&self, name: impl Fn(&str) -> String) -> Option<Self> {
        let mut new = self.clone();
        new.body_names.clear();
        for (id, body) in new.bodies.iter_mut().enumerate() {
            body.name = name(&body.name);
            if new
                .body_names
                .insert(body.name.clone(), crate::BodyId(id))
                .is_some()
            {
                return None;
            }
        }
        new.joint_names.clear();
        for joint in &mut new.joints {
            joint.name = name(&joint.name);
            if !new.joint_names.insert(joint.name.clone()) {
                return None;
            }
        }
        for node in &mut new.nodes {
            node.point = name(&node.point);
        }
        for nodes in &mut new.by_point {
            nodes.sort_by(|a, b| new.nodes[a.0].point.cmp(&new.nodes[b.0].point));
            let same =
                |pair: &[crate::NodeId]| new.nodes[pair[0].0].point == new.nodes[pair[1].0].point;
            if nodes.windows(2).any(same) {
                return None;
            }
        }
        Some(new)
    }
}
