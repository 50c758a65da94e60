//! The rigid mechanism: a spanning tree of its joints, whose coordinates place all bodies, and
//! the joints that close loops.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::sync::atomic::{AtomicU64, Ordering};

use hyperstat_joints::Dof;
use hyperstat_model::Model;
use nalgebra::{DVector, Isometry3, UnitQuaternion, Vector3};

use crate::error::ClosureError;
use crate::motion::JointMotion;
use crate::twist::Twist;

/// Most coordinates of joints, and most conditions of loops: the matrices are dense, and a step takes
/// seconds.
const MOST: usize = 2000;

/// The number of the next linkage.
static NEXT: AtomicU64 = AtomicU64::new(0);

/// A configuration of the mechanism: the values of all joint coordinates, relative to home.
#[derive(Debug, Clone, PartialEq)]
pub struct Configuration {
    /// The linkage that it is one of.
    pub(crate) linkage: u64,
    /// Of every column; m or rad. Those of free rotations are not used.
    pub(crate) values: Vec<f64>,
    /// The free rotation of every joint of the tree that has one.
    pub(crate) balls: Vec<UnitQuaternion<f64>>,
    /// Rotation vector of the output from home, with its whole turns.
    pub(crate) rotation: Vector3<f64>,
}

/// A joint coordinate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Column {
    /// The joint.
    pub joint: usize,
    /// Which of its factors; `None`: of its free rotation.
    pub factor: Option<usize>,
    /// What it is divided by in the equations (m for a travel; 1 for an angle).
    pub unit: f64,
}

/// A joint of the tree.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    pub joint: usize,
    /// The body that it places.
    pub child: usize,
    /// Whether that is the joint's second.
    pub forward: bool,
}

/// The joints of a model as a tree and closings.
#[derive(Debug, Clone)]
pub(crate) struct Linkage {
    /// A number that no other linkage has, clones apart.
    pub id: u64,
    pub joints: Vec<JointMotion>,
    pub columns: Vec<Column>,
    /// The first column of every joint.
    pub starts: Vec<usize>,
    /// Joints that close loops.
    pub closings: Vec<usize>,
    /// Columns that move a body, with the sign of the motion.
    pub chains: Vec<Vec<(usize, f64)>>,
    pub steps: Vec<Step>,
}

/// Where all bodies are, and what every coordinate moves.
#[derive(Debug, Clone)]
pub(crate) struct Posture {
    /// Motion of every body from home.
    pub bodies: Vec<Isometry3<f64>>,
    /// What a coordinate does to the second body relative to the first, in global axes.
    pub twists: Vec<Twist>,
    /// Of every joint, where its first body has its frame after its motion: for a joint of the
    /// tree the frame of the second body.
    pub ends: Vec<Isometry3<f64>>,
}

impl Linkage {
    /// The linkage of a model in its configuration, with `size` (m) as the unit of travels.
    pub fn new(model: &Model, centre: &Vector3<f64>, size: f64) -> Result<Self, ClosureError> {
        let joints = (0..model.joints().len())
            .map(|k| JointMotion::new(model, k, centre))
            .collect::<Result<Vec<_>, _>>()?;
        let count = model.bodies().len();
        let coordinates: usize = joints.iter().map(JointMotion::free).sum();
        // All but those of the tree, which has a joint a body, close loops.
        let conditions = 6 * joints.len().saturating_sub(count);
        if coordinates > MOST || conditions > MOST {
            return Err(ClosureError::TooLarge {
                coordinates,
                conditions,
                limit: MOST,
            });
        }
        let steps = spanning_tree(&joints, count);
        let mut tree = vec![false; joints.len()];
        for step in &steps {
            tree[step.joint] = true;
        }
        let in_tree = |joint: usize| tree[joint];
        let mut columns = Vec::new();
        let mut starts = Vec::new();
        for (joint, motion) in joints.iter().enumerate() {
            starts.push(columns.len());
            for (factor, (_, twist)) in motion.factors.iter().enumerate() {
                columns.push(Column {
                    joint,
                    factor: Some(factor),
                    unit: if twist.is_translation() { size } else { 1.0 },
                });
            }
            if motion.ball && in_tree(joint) {
                let turn = Column {
                    joint,
                    factor: None,
                    unit: 1.0,
                };
                columns.extend([turn; 3]);
            }
        }
        starts.push(columns.len());
        let mut chains: Vec<Vec<(usize, f64)>> = vec![Vec::new(); count];
        for step in &steps {
            let [first, second] = joints[step.joint].bodies;
            let (parent, sign) = if step.forward {
                (first, 1.0)
            } else {
                (second, -1.0)
            };
            let mut chain = parent.map_or(Vec::new(), |body| chains[body].clone());
            chain.extend((starts[step.joint]..starts[step.joint + 1]).map(|c| (c, sign)));
            chains[step.child] = chain;
        }
        let closings = (0..joints.len()).filter(|k| !in_tree(*k)).collect();
        Ok(Self {
            id: NEXT.fetch_add(1, Ordering::Relaxed),
            joints,
            columns,
            starts,
            closings,
            chains,
            steps,
        })
    }

    /// The configuration that the model is in.
    pub fn home(&self) -> Configuration {
        Configuration {
            linkage: self.id,
            values: vec![0.0; self.columns.len()],
            balls: vec![UnitQuaternion::identity(); self.joints.len()],
            rotation: Vector3::zeros(),
        }
    }

    /// The column of a joint's direction.
    pub fn column(&self, joint: usize, dof: Dof) -> Option<usize> {
        let factors = &self.joints.get(joint)?.factors;
        let place = factors.iter().position(|(other, _)| *other == dof)?;
        Some(self.starts[joint] + place)
    }

    /// Values of a joint's factors.
    pub fn values<'c>(&self, joint: usize, configuration: &'c Configuration) -> &'c [f64] {
        let start = self.starts[joint];
        &configuration.values[start..start + self.joints[joint].len()]
    }

    /// Where everything is. Bodies that no joint connects with the ground stay at home.
    pub fn posture(&self, configuration: &Configuration) -> Posture {
        let mut posture = Posture {
            bodies: Vec::new(),
            twists: vec![Twist::turn(Vector3::zeros()); self.columns.len()],
            ends: Vec::new(),
        };
        posture
            .bodies
            .resize(self.chains.len(), Isometry3::identity());
        posture
            .ends
            .resize(self.joints.len(), Isometry3::identity());
        for step in &self.steps {
            let joint = &self.joints[step.joint];
            let [first, second] = joint.bodies;
            let at_home = joint.home;
            let body =
                |body: Option<usize>| body.map_or(Isometry3::identity(), |b| posture.bodies[b]);
            let start = if step.forward {
                body(first) * at_home
            } else {
                let own = self.prefixes(step.joint, &Isometry3::identity(), configuration);
                let relative = own[own.len() - 1];
                body(second) * at_home * relative.inverse()
            };
            self.advance(step.joint, &start, configuration, &mut posture);
            posture.bodies[step.child] = if step.forward {
                posture.ends[step.joint] * at_home.inverse()
            } else {
                start * at_home.inverse()
            };
        }
        for &closing in &self.closings {
            let joint = &self.joints[closing];
            let body = joint.bodies[0].map_or(Isometry3::identity(), |b| posture.bodies[b]);
            let start = body * joint.home;
            self.advance(closing, &start, configuration, &mut posture);
        }
        posture
    }

    /// The frames along a joint's motion from that of its first body, the free rotation of a
    /// joint of the tree included.
    fn prefixes(
        &self,
        joint: usize,
        first: &Isometry3<f64>,
        configuration: &Configuration,
    ) -> Vec<Isometry3<f64>> {
        let motion = &self.joints[joint];
        let mut frames = motion.prefixes(first, self.values(joint, configuration));
        if motion.ball {
            let last = frames[frames.len() - 1];
            frames.push(last * configuration.balls[joint]);
        }
        frames
    }

    /// Writes the twists and the end of a joint whose first body has its frame at `first`.
    fn advance(
        &self,
        joint: usize,
        first: &Isometry3<f64>,
        configuration: &Configuration,
        posture: &mut Posture,
    ) {
        let motion = &self.joints[joint];
        let frames = self.prefixes(joint, first, configuration);
        let start = self.starts[joint];
        for (k, (_, twist)) in motion.factors.iter().enumerate() {
            posture.twists[start + k] = twist.seen_through(&frames[k]);
        }
        let turns = start + motion.len()..self.starts[joint + 1];
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        for (column, axis) in turns.zip(axes) {
            posture.twists[column] = Twist::turn(axis).seen_through(&frames[motion.len()]);
        }
        posture.ends[joint] = frames[frames.len() - 1];
    }

    /// The configuration `step` (in the columns' units) farther on.
    pub fn advanced(&self, from: &Configuration, step: &DVector<f64>) -> Configuration {
        let mut next = from.clone();
        for (k, column) in self.columns.iter().enumerate() {
            if column.factor.is_some() {
                next.values[k] += step[k] * column.unit;
            }
        }
        for (joint, motion) in self.joints.iter().enumerate() {
            let turns = self.starts[joint] + motion.len();
            if turns < self.starts[joint + 1] {
                let turn = Vector3::new(step[turns], step[turns + 1], step[turns + 2]);
                next.balls[joint] = UnitQuaternion::from_scaled_axis(turn) * next.balls[joint];
            }
        }
        next
    }
}

/// Joints that place all bodies from the ground: of those at hand always the one with the fewest
/// freedoms, so that free rotations are left for the closings, where they make no equation.
fn spanning_tree(joints: &[JointMotion], count: usize) -> Vec<Step> {
    let mut joints_at: Vec<Vec<usize>> = vec![Vec::new(); count];
    let mut at_hand = BinaryHeap::new();
    let key = |joint: usize| Reverse((joints[joint].ball, joints[joint].len(), joint));
    for (joint, motion) in joints.iter().enumerate() {
        for body in motion.bodies.into_iter().flatten() {
            joints_at[body].push(joint);
        }
        if motion.bodies.contains(&None) {
            at_hand.push(key(joint));
        }
    }
    let mut placed = vec![false; count];
    let mut steps: Vec<Step> = Vec::new();
    let mut loose = 0;
    loop {
        let Some(Reverse((_, _, joint))) = at_hand.pop() else {
            // Nothing holds it: it stays where it is, and others may hang on it.
            let Some(next) = (loose..count).find(|body| !placed[*body]) else {
                return steps;
            };
            placed[next] = true;
            loose = next + 1;
            at_hand.extend(joints_at[next].iter().map(|joint| key(*joint)));
            continue;
        };
        let is_placed = |body: Option<usize>| body.is_none_or(|b| placed[b]);
        let (child, forward) = match joints[joint].bodies {
            [first, Some(child)] if is_placed(first) && !placed[child] => (child, true),
            [Some(child), second] if is_placed(second) && !placed[child] => (child, false),
            _ => continue,
        };
        placed[child] = true;
        steps.push(Step {
            joint,
            child,
            forward,
        });
        at_hand.extend(joints_at[child].iter().map(|joint| key(*joint)));
    }
}
