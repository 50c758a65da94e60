//! Targets that no configuration has, seen at once: what a chain of bodies from the ground spans.

use hyperstat_model::Model;
use nalgebra::{Unit, Vector3};

use crate::equations::{Goal, System};
use crate::error::ClosureError;

/// Joints of a chain at most.
const LONGEST: usize = 16;
/// Chains at most, and steps of the search for them.
const MOST: usize = 64;
const STEPS: usize = 10_000;
/// How far beyond its span (sizes of the mechanism) a chain surely does not come: loops and targets
/// count as met to [`CLOSED`](crate::newton::CLOSED), in each of the chain's joints and in the target.
const SURE: f64 = 1e-4;
/// Sine between two axes that are parallel.
const PARALLEL: f64 = 1e-9;

/// A chain of bodies from a joint on the ground to the output, whose joints turn about points of both
/// their bodies: the output's distance from the first is between two bounds.
#[derive(Debug, Clone)]
pub(crate) struct Span {
    /// The first joint, from the centre (m), and its name.
    foot: Vector3<f64>,
    joint: String,
    bodies: Vec<String>,
    /// The axis that all joints turn about, where all of them are parallel: the distances are those
    /// across it.
    axis: Option<Unit<Vector3<f64>>>,
    /// Coordinates that must be known.
    needed: [bool; 3],
    least: f64,
    most: f64,
    /// By how much the distance must be outside (m).
    sure: f64,
}

impl Span {
    /// Chains from the ground to the output, all of them unless there are very many.
    pub fn all(system: &System, model: &Model) -> Vec<Self> {
        let mut search = Search {
            system,
            model,
            at: vec![Vec::new(); model.bodies().len()],
            joints: Vec::new(),
            bodies: Vec::new(),
            steps: 0,
            found: Vec::new(),
        };
        for (k, joint) in system.linkage.joints.iter().enumerate() {
            let turns = |twist: &crate::twist::Twist| twist.linear == Vector3::zeros();
            if joint.factors.iter().all(|(_, twist)| turns(twist)) {
                for body in joint.bodies.into_iter().flatten() {
                    search.at[body].push(k);
                }
            }
        }
        for (k, joint) in system.linkage.joints.iter().enumerate() {
            if let [None, Some(body)] | [Some(body), None] = joint.bodies
                && search.at[body].contains(&k)
            {
                search.go_on(k, body);
            }
        }
        search.found
    }

    /// Refuses a goal that the chain surely does not reach.
    pub fn check(&self, goal: &Goal) -> Result<(), ClosureError> {
        if (0..3).any(|k| self.needed[k] && goal.output[k].is_none()) {
            return Ok(());
        }
        let place = Vector3::from_fn(|k, _| goal.output[k].unwrap_or(self.foot[k]));
        let mut apart = place - self.foot;
        if let Some(axis) = &self.axis {
            apart -= axis.into_inner() * axis.dot(&apart);
        }
        let distance = apart.norm();
        let (how, bound) = if distance > self.most + self.sure {
            ("no farther than", self.most)
        } else if distance < self.least - self.sure {
            ("no nearer than", self.least)
        } else {
            return Ok(());
        };
        Err(self.unreachable(distance, how, bound))
    }

    #[cold]
    fn unreachable(&self, distance: f64, how: &str, bound: f64) -> ClosureError {
        let bodies = self.bodies.iter().map(|body| format!("`{body}`"));
        let bodies = bodies.collect::<Vec<_>>().join(", ");
        ClosureError::Unreachable {
            what: format!(
                "the output would be {distance:.6} m from `{}`, and {bodies} come {how} {bound:.6} m",
                self.joint
            ),
        }
    }
}

/// The search for chains.
struct Search<'m> {
    system: &'m System,
    model: &'m Model,
    /// Joints of every body that only turn.
    at: Vec<Vec<usize>>,
    joints: Vec<usize>,
    bodies: Vec<usize>,
    steps: usize,
    found: Vec<Span>,
}

impl Search<'_> {
    /// Goes on through a joint to a body.
    fn go_on(&mut self, joint: usize, body: usize) {
        self.steps += 1;
        if self.steps > STEPS || self.found.len() >= MOST || self.joints.len() >= LONGEST {
            return;
        }
        self.joints.push(joint);
        self.bodies.push(body);
        if body == self.system.output.0 {
            self.found.push(self.span());
        } else {
            for k in 0..self.at[body].len() {
                let next = self.at[body][k];
                let bodies = self.system.linkage.joints[next].bodies;
                let others = bodies.into_iter().flatten();
                let other = others.clone().find(|other| *other != body);
                // The ground is the same body everywhere.
                if let Some(other) = other
                    && !self.bodies.contains(&other)
                {
                    self.go_on(next, other);
                }
            }
        }
        self.joints.pop();
        self.bodies.pop();
    }

    fn span(&self) -> Span {
        let joints = &self.system.linkage.joints;
        let place = |joint: &usize| joints[*joint].home.translation.vector;
        let mut places: Vec<_> = self.joints.iter().map(place).collect();
        places.push(self.system.output.1.coords);
        let axis = self.axis();
        let mut bodies = Vec::new();
        let (mut sum, mut longest) = (0.0, 0.0_f64);
        for (pair, body) in places.windows(2).zip(&self.bodies) {
            let mut length = pair[1] - pair[0];
            if let Some(axis) = &axis {
                length -= axis.into_inner() * axis.dot(&length);
            }
            let length = length.norm();
            sum += length;
            longest = longest.max(length);
            if length > 0.0 {
                bodies.push(self.model.bodies()[*body].name.clone());
            }
        }
        Span {
            foot: places[0],
            joint: joints[self.joints[0]].name.clone(),
            bodies,
            needed: [0, 1, 2].map(|k| axis.is_none_or(|axis| axis[k].abs() < 1.0)),
            axis,
            least: (2.0 * longest - sum).max(0.0),
            most: sum,
            sure: SURE * self.system.size,
        }
    }

    /// The axis of all joints of the chain.
    fn axis(&self) -> Option<Unit<Vector3<f64>>> {
        let mut axis: Option<Unit<Vector3<f64>>> = None;
        for joint in &self.joints {
            let motion = &self.system.linkage.joints[*joint];
            if motion.ball {
                return None;
            }
            for (_, twist) in &motion.factors {
                let own = Unit::new_normalize(motion.home.rotation * twist.angular);
                let first = axis.get_or_insert(own);
                if first.cross(&own).norm() > PARALLEL {
                    return None;
                }
            }
        }
        // Rounding of a frame is no component across the axis that it was made of.
        axis.map(|axis| {
            let unit = (0..3).find(|k| axis[*k].abs() > 1.0 - 1e-15);
            unit.map_or(axis, |k| Unit::new_unchecked(Vector3::ith(k, 1.0)))
        })
    }
}

#[cfg(test)]
mod tests {
    use hyperstat_joints::{DofSet, Joint, Revolute, Universal, frame_from_axis};
    use hyperstat_model::{Connection, JointStiffness, Model};
    use nalgebra::{Point3, Vector3};

    /// A link's points, each with its place.
    type Ends<'a> = [(&'a str, [f64; 3]); 2];

    use super::*;
    use crate::closure::LoopClosure;

    /// A model of rigid links between points, each joint a revolute about z but where it is given.
    fn linkage(
        links: &[(&str, Ends<'_>)],
        joints: &[(&str, [&str; 2], bool)],
        output: (&str, &str),
    ) -> Model {
        let mut model = Model::new("test");
        for (name, points) in links {
            let points = points.map(|(name, place)| (name, Point3::from(place)));
            model.add_rigid(name, &points).expect("a body");
        }
        for (at, bodies, universal) in joints {
            let between = bodies.map(|body| model.node(body, at));
            let joint: Box<dyn Joint> = match universal {
                true => Box::new(Universal),
                false => Box::new(Revolute),
            };
            let connection = Connection {
                name: (*at).into(),
                between,
                joint,
                locked: DofSet::EMPTY,
                stiffness: JointStiffness::default(),
            };
            let frame = frame_from_axis(Some(&Vector3::z()), None).expect("a frame");
            model.add_joint(connection, frame).expect("a joint");
        }
        model.set_output(model.node(output.0, output.1).expect("a node"));
        model
    }

    /// Of targets on a grid those that a span refuses, and those that the way to them does not reach;
    /// whatever the first says, the second has to say.
    fn compared(model: &Model, step: f64, deep: i32) -> [usize; 2] {
        let closure = LoopClosure::new(model).expect("a linkage");
        let mut found = [0, 0];
        for i in -9..=9 {
            for j in -9..=9 {
                for k in -deep..=deep {
                    let [x, y, z] = [i, j, k].map(|n| Some(0.013 + step * f64::from(n)));
                    let z = if deep > 0 { z } else { None };
                    let goal = closure.output_goal(&[x, y, z, None, None, None]);
                    let refused = closure.spans.iter().any(|span| span.check(&goal).is_err());
                    let way = closure.system.follow(&closure.home(), &goal);
                    let unreachable = matches!(way, Err(ClosureError::Unreachable { .. }));
                    assert!(unreachable || !refused, "{goal:?}: {way:?}");
                    found[0] += usize::from(refused);
                    found[1] += usize::from(unreachable);
                }
            }
        }
        found
    }

    #[test]
    fn what_a_span_refuses_has_no_way() {
        // A five-bar with a hole around each foot: in the plane both spans are exact.
        let [a, b, c] = [[-0.15, 0.0, 0.0], [-0.25, 0.2, 0.0], [0.0, 0.42, 0.0]];
        let [d, e] = [[0.15, 0.0, 0.0], [0.25, 0.2, 0.0]];
        let links = [
            ("crank1", [("A1", a), ("B1", b)]),
            ("crank2", [("A2", d), ("B2", e)]),
            ("rod1", [("B1", b), ("P", c)]),
            ("rod2", [("B2", e), ("P", c)]),
        ];
        let joints = [
            ("A1", ["", "crank1"], false),
            ("A2", ["", "crank2"], false),
            ("B1", ["crank1", "rod1"], false),
            ("B2", ["crank2", "rod2"], false),
            ("P", ["rod1", "rod2"], false),
        ];
        let [refused, missed] = compared(&linkage(&links, &joints, ("rod1", "P")), 0.07, 0);
        assert!(refused > 100 && refused <= missed, "{refused} of {missed}");
        // An arm in space, whose shoulder turns about two axes.
        let links = [
            ("upper", [("A", [0.0, 0.0, 0.0]), ("B", [0.5, 0.1, 0.1])]),
            ("lower", [("B", [0.5, 0.1, 0.1]), ("P", [0.6, 0.4, 0.2])]),
        ];
        let joints = [("A", ["", "upper"], true), ("B", ["upper", "lower"], false)];
        let [refused, missed] = compared(&linkage(&links, &joints, ("lower", "P")), 0.12, 2);
        assert!(refused > 100 && refused <= missed, "{refused} of {missed}");
    }
}
