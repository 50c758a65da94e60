//! Networks of any number of rigid bars on hinges: rings, ladders, grids, all nearly in one plane.

use hyperstat_assembly::{Connection, JointStiffness, Model};
use hyperstat_joints::{DofSet, Fixed, Joint, Revolute, Spherical, frame_from_axis};
use nalgebra::{Point3, Rotation3, Vector3, Vector6};

use crate::build::{connection, node};

/// What the bars of a network turn on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hinge {
    /// A revolute about z that nothing holds.
    Free,
    /// A locked revolute about z.
    Locked,
    /// A revolute about z with a spring (N·m/rad).
    Elastic(f64),
    /// A weld.
    Weld,
    /// A ball joint with springs about its three axes (N·m/rad).
    Ball(f64),
}

impl Hinge {
    fn joint(self) -> (Box<dyn Joint>, DofSet, JointStiffness) {
        let rigid = JointStiffness::default();
        let about = |axes: [Option<f64>; 3]| {
            let [u, v, w] = axes;
            JointStiffness::Directions([None, None, None, u, v, w])
        };
        match self {
            Self::Free => (Box::new(Revolute), DofSet::EMPTY, rigid),
            Self::Locked => (Box::new(Revolute), Revolute.free(), rigid),
            Self::Elastic(k) => (
                Box::new(Revolute),
                DofSet::EMPTY,
                about([None, Some(k), None]),
            ),
            Self::Weld => (Box::new(Fixed), DofSet::EMPTY, rigid),
            Self::Ball(k) => (Box::new(Spherical), DofSet::EMPTY, about([Some(k); 3])),
        }
    }
}

/// Points, and the bars between them.
#[derive(Debug, Clone)]
pub struct Sketch {
    /// Places of the points (m).
    pub points: Vec<Point3<f64>>,
    /// Ends of the bars; the first is welded to the ground at its first point.
    pub bars: Vec<[usize; 2]>,
}

impl Sketch {
    /// A closed chain of `count` bars of about 1 m around a circle; every other point is `offset` (m)
    /// further out.
    pub fn ring(count: usize, offset: f64) -> Self {
        let turn = std::f64::consts::TAU / count as f64;
        let place = |k: usize| {
            let radius = 1.0 / turn + offset * (k % 2) as f64;
            let angle = turn * k as f64;
            Point3::new(radius * angle.cos(), radius * angle.sin(), 0.0)
        };
        Self {
            points: (0..count).map(place).collect(),
            bars: (0..count).map(|k| [k, (k + 1) % count]).collect(),
        }
    }

    /// An open zigzag of `count` bars, each `rise` (m) up or down.
    pub fn chain(count: usize, rise: f64) -> Self {
        let place = |k: usize| Point3::new(k as f64, rise * (k % 2) as f64, 0.0);
        Self {
            points: (0..=count).map(place).collect(),
            bars: (0..count).map(|k| [k, k + 1]).collect(),
        }
    }

    /// A grid of `columns` × `rows` cells with bars along their sides, its points a little off the
    /// squares' corners. One row is a ladder.
    pub fn grid(columns: usize, rows: usize) -> Self {
        let at = |x: usize, y: usize| y * (columns + 1) + x;
        let mut points = Vec::new();
        let mut bars = Vec::new();
        for y in 0..=rows {
            for x in 0..=columns {
                let [a, b] = [x as f64, y as f64];
                let [dx, dy] = [(2.3 * a + 1.7 * b).sin(), (1.1 * a - 2.9 * b).cos()];
                points.push(Point3::new(a + 0.1 * dx, b + 0.1 * dy, 0.0));
                bars.extend((x < columns).then(|| [at(x, y), at(x + 1, y)]));
                bars.extend((y < rows).then(|| [at(x, y), at(x, y + 1)]));
            }
        }
        Self { points, bars }
    }

    /// The points moved out of the plane, up to `height` (m).
    #[must_use]
    pub fn warped(mut self, height: f64) -> Self {
        for (k, point) in self.points.iter_mut().enumerate() {
            point.z = height * (1.9 * k as f64).sin();
        }
        self
    }

    /// The model: at every point each further bar is joined to the first one there. The output is the
    /// end of the bar in the middle of the list, with a force and a moment on it.
    ///
    /// # Panics
    /// With a bar that has no length.
    pub fn model(&self, hinge: Hinge) -> Model {
        let mut model = Model::new("network");
        let z = frame_from_axis(Some(&Vector3::z()), None).expect("an axis");
        let mut first = vec![None; self.points.len()];
        for (k, ends) in self.bars.iter().enumerate() {
            let body = format!("b{k}");
            let points = [("A", self.points[ends[0]]), ("B", self.points[ends[1]])];
            model.add_rigid(&body, &points).expect("a bar");
            for (end, point) in ends.iter().zip(["A", "B"]) {
                let own = node(&model, &body, point);
                let Some(other) = first[*end] else {
                    first[*end] = Some(own);
                    continue;
                };
                let (joint, locked, stiffness) = hinge.joint();
                let joint = Connection {
                    name: format!("{body}{point}"),
                    between: [Some(other), Some(own)],
                    joint,
                    locked,
                    stiffness,
                };
                model.add_joint(joint, z).expect("a joint");
            }
        }
        let weld = connection("ground", [None, Some(node(&model, "b0", "A"))], Fixed);
        model
            .add_joint(weld, Rotation3::identity())
            .expect("a weld");
        let output = node(&model, &format!("b{}", self.bars.len() / 2), "B");
        model.set_output(output);
        let wrench = Vector6::new(10.0, -20.0, 5.0, 0.3, 0.2, -0.1);
        model.add_load(output, wrench).expect("a load");
        model
    }

    /// Loops that the bars close: Euler's count.
    pub fn loops(&self) -> usize {
        self.bars.len() + 1 - self.points.len()
    }
}
