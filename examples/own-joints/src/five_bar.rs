//! A planar five-bar: a prebuilt mechanism that solves its own inverse kinematics.

use hyperstat_joints::{Dof, DofSet, Revolute, frame_from_axis};
use hyperstat_mechanisms::prebuilt::{Link, ParameterError, PoseCoordinate, Prebuilt};
use hyperstat_mechanisms::{Arguments, LoadError, PoseError};
use hyperstat_model::{Connection, Geometry, JointId, JointStiffness, Model, NodeId, ValuePlace};
use nalgebra::{Point3, Vector3};

/// Two driven cranks, two rods, and the tool P where the rods meet, all in the plane of x and y.
///
/// ```text
///        P            The cranks turn about A1 and A2, which lie on x at half of `base` to either
///      ╱   ╲          side of the origin. The elbows B1 and B2 stand outward.
///    B1     B2
///     ╲     ╱         A pose is the position x, y (m) of P on the first rod; how the rod is turned
///     A1   A2         follows. All joints are revolute, about z.
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct FiveBar {
    /// Distance of the drives A1 and A2 (m).
    pub base: f64,
    /// Length of the cranks, A to B (m).
    pub crank_length: f64,
    /// Length of the rods, B to P (m).
    pub rod_length: f64,
    /// The cranks.
    pub crank: Link,
    /// The rods.
    pub rod: Link,
    /// Stiffness of the drives (N·m/rad); `None` is locked rigidly.
    pub drive_stiffness: Option<f64>,
    /// Number of beam elements a link is divided into.
    pub elements: usize,
}

/// A1, B1, A2, B2 and P.
type Points = [Point3<f64>; 5];

/// The points of the bodies crank1, crank2, rod1 and rod2, by their places among [`Points`].
const BODIES: [(&str, [(&str, usize); 2]); 4] = [
    ("crank1", [("A1", 0), ("B1", 1)]),
    ("crank2", [("A2", 2), ("B2", 3)]),
    ("rod1", [("B1", 1), ("P", 4)]),
    ("rod2", [("B2", 3), ("P", 4)]),
];

/// The joints, named as their points, and the bodies between which they are; the ground is `None`.
const JOINTS: [(&str, [Option<&str>; 2]); 5] = [
    ("A1", [None, Some("crank1")]),
    ("A2", [None, Some("crank2")]),
    ("B1", [Some("crank1"), Some("rod1")]),
    ("B2", [Some("crank2"), Some("rod2")]),
    ("P", [Some("rod1"), Some("rod2")]),
];

impl FiveBar {
    /// The parameters of `FiveBar(base: …, crank_length: …, …)` in a batch file.
    pub const PARAMETERS: &'static [&'static str] = &[
        "base",
        "crank_length",
        "rod_length",
        "crank",
        "rod",
        "drive_stiffness",
        "elements",
    ];

    /// Reads the mechanism from a batch file.
    ///
    /// # Errors
    /// A parameter that is missing, of another kind or out of its range.
    pub fn read(arguments: &Arguments<'_>) -> Result<Box<dyn Prebuilt>, LoadError> {
        let five_bar = Self {
            base: arguments.number("base")?,
            crank_length: arguments.number("crank_length")?,
            rod_length: arguments.number("rod_length")?,
            crank: arguments.link("crank")?,
            rod: arguments.link("rod")?,
            drive_stiffness: arguments.drive_stiffness()?,
            elements: arguments.elements()?,
        };
        let checked = five_bar.check();
        checked.map_err(|error| arguments.refused(&error))?;
        Ok(Box::new(five_bar))
    }

    fn check(&self) -> Result<(), ParameterError> {
        for (field, length) in [
            ("base", self.base),
            ("crank_length", self.crank_length),
            ("rod_length", self.rod_length),
        ] {
            if !(length.is_finite() && length > 0.0) {
                return Err(ParameterError {
                    field,
                    message: format!("{length:?} m is not a length above zero"),
                    help: None,
                });
            }
        }
        Ok(())
    }

    /// Inverse kinematics.
    fn points(&self, pose: &[f64]) -> Result<Points, PoseError> {
        self.check()?;
        let &[x, y] = pose else {
            return Err(PoseError::Coordinates {
                kind: self.kind().into(),
                expected: 2,
                found: pose.len(),
            });
        };
        let p = Point3::new(x, y, 0.0);
        let [(a1, b1), (a2, b2)] = [self.crank_at(-1.0, &p)?, self.crank_at(1.0, &p)?];
        Ok([a1, b1, a2, b2, p])
    }

    /// Both ends of the crank on one side (−1: of −x).
    fn crank_at(
        &self,
        side: f64,
        p: &Point3<f64>,
    ) -> Result<(Point3<f64>, Point3<f64>), PoseError> {
        let a = Point3::new(side * self.base / 2.0, 0.0, 0.0);
        let reach = p - a;
        let distance = reach.norm();
        let (crank, rod) = (self.crank_length, self.rod_length);
        let along = (distance * distance + crank * crank - rod * rod) / (2.0 * distance);
        let height = crank * crank - along * along;
        if height.is_nan() || height < 0.0 {
            let number = if side < 0.0 { 1 } else { 2 };
            return Err(PoseError::Unreachable {
                what: format!("limb {number}: P is {distance:.6} m from A{number}"),
            });
        }
        let direction = reach / distance;
        let outward = direction.cross(&Vector3::z()) * side;
        Ok((a, a + direction * along + outward * height.sqrt()))
    }

    fn link(&self, body: usize) -> (&'static str, &Link) {
        match body {
            0 | 1 => ("crank", &self.crank),
            _ => ("rod", &self.rod),
        }
    }
}

impl Prebuilt for FiveBar {
    fn kind(&self) -> &str {
        "FiveBar"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::X, PoseCoordinate::Y]
    }

    fn zero_coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::Z, PoseCoordinate::Rx, PoseCoordinate::Ry]
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        let points = self.points(pose)?;
        let mut model = Model::new("five-bar");
        for (body, (name, ends)) in BODIES.into_iter().enumerate() {
            let ends = ends.map(|(point, k)| (point, points[k]));
            let (_, link) = self.link(body);
            model.add_beam(
                name,
                &ends,
                &link.material,
                &link.section,
                None,
                self.elements,
            )?;
        }
        let frame = frame_from_axis(Some(&Vector3::z()), None)?;
        for (name, between) in JOINTS {
            let driven = between[0].is_none();
            let node = |body: Option<&str>| -> Option<NodeId> { model.node(body?, name) };
            let mut stiffness = [None; 6];
            if driven {
                stiffness[Dof::V.index()] = self.drive_stiffness;
            }
            let connection = Connection {
                name: name.into(),
                between: between.map(node),
                joint: Box::new(Revolute),
                locked: DofSet::new(if driven { &[Dof::V] } else { &[] }),
                stiffness: JointStiffness::Directions(stiffness),
            };
            model.add_joint(connection, frame)?;
        }
        if let Some(output) = model.node("rod1", "P") {
            model.set_output(output);
        }
        Ok(model)
    }

    fn origins(&self, pose: &[f64]) -> Result<Vec<(ValuePlace, String)>, PoseError> {
        let origin = |(place, _)| {
            let path = match place {
                // Every body is one segment.
                ValuePlace::Dimension {
                    segment, dimension, ..
                } => format!("{}.section.{dimension}", self.link(segment.0).0),
                ValuePlace::Constant { segment, constant } => {
                    format!("{}.material.{constant}", self.link(segment.0).0)
                }
                ValuePlace::Stiffness {
                    joint: JointId(0 | 1),
                    ..
                } => "drive_stiffness".into(),
                _ => return None,
            };
            Some((place, path))
        };
        let values = self.model(pose)?.values().into_iter();
        Ok(values.filter_map(origin).collect())
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        let expected = [2 * BODIES.len(), BODIES.len(), JOINTS.len()];
        let found = [
            geometry.positions.len(),
            geometry.y_axes.len(),
            geometry.frames.len(),
        ];
        if found != expected {
            return Err(PoseError::ForeignGeometry { expected, found });
        }
        let points = self.points(pose)?;
        let nodes = BODIES.iter().flat_map(|(_, ends)| ends);
        for (position, (_, k)) in geometry.positions.iter_mut().zip(nodes) {
            *position = points[*k];
        }
        geometry.y_axes.fill(None);
        geometry
            .frames
            .fill(frame_from_axis(Some(&Vector3::z()), None)?);
        let [_, b1, _, _, p] = points;
        let rod = p - b1;
        Ok([p.x, p.y, 0.0, 0.0, 0.0, rod.y.atan2(rod.x)])
    }
}
