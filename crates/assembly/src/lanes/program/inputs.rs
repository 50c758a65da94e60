//! What the lanes read of a geometry, three numbers at a time.

use hyperstat_elements::element_frame;
use hyperstat_model::{
    Axes, FlexibleId, Geometry, JointId, Model, NodeId, SegmentId, characteristic_length,
};
use nalgebra::{Rotation3, Vector3};

use crate::sets::Sets;

/// Place of a point among the inputs.
pub(crate) type Point = usize;

/// Where three numbers of a geometry come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Wanted {
    Position(NodeId),
    FrameColumn(JointId, usize),
    YAxis(SegmentId, [NodeId; 2]),
    RotationColumn(FlexibleId, usize),
    /// By its number among those that turn.
    Turned(usize),
}

/// What turns a constant vector from pose to pose.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Turned {
    /// A joint's frame.
    Joint(JointId),
    /// Axes of loads.
    Axes(Axes),
}

impl Turned {
    /// Axes of loads; `None` for the global ones.
    pub fn by_axes(axes: &Axes) -> Option<Self> {
        (*axes != Axes::Global).then_some(Self::Axes(*axes))
    }
}

/// The vectors that a program reads, each by its place.
#[derive(Debug)]
pub(crate) struct Inputs {
    sources: Vec<Wanted>,
    /// Vectors in axes that turn.
    turned: Vec<(Turned, Vector3<f64>)>,
    /// One node for all nodes at the same point.
    same: Vec<NodeId>,
}

impl Inputs {
    /// None yet. `None` where the nodes of a joint are apart by more than `apart` of the
    /// mechanism's size: such a joint is no point.
    pub fn new(model: &Model, geometry: &Geometry, apart: f64) -> Option<Self> {
        let count = geometry.positions.len();
        let mut same = Sets::new(count);
        let bound = apart * characteristic_length(geometry);
        for joint in model.joints() {
            if let [Some(a), Some(b)] = joint.between {
                if (geometry.positions[a.0] - geometry.positions[b.0]).norm() > bound {
                    return None;
                }
                let (a, b) = (same.root(a.0), same.root(b.0));
                same.join(a.min(b), a.max(b));
            }
        }
        let same = (0..count).map(|k| NodeId(same.root(k))).collect();
        Some(Self {
            sources: Vec::new(),
            turned: Vec::new(),
            same,
        })
    }

    /// Number of vectors.
    pub fn len(&self) -> usize {
        self.sources.len()
    }

    fn place(&mut self, source: Wanted) -> usize {
        match self.sources.iter().position(|s| *s == source) {
            Some(place) => place,
            None => {
                self.sources.push(source);
                self.sources.len() - 1
            }
        }
    }

    /// Places of all nodes' positions, each once.
    pub fn all_points(&mut self) -> Vec<Point> {
        let count = self.same.len();
        let mut points: Vec<Point> = (0..count).map(|k| self.point(NodeId(k))).collect();
        points.sort_unstable();
        points.dedup();
        points
    }

    /// Place of a node's position.
    pub fn point(&mut self, node: NodeId) -> Point {
        self.place(Wanted::Position(self.same[node.0]))
    }

    /// Places of two points, from and to; `None` where they are one.
    pub fn arm(&mut self, from: NodeId, to: NodeId) -> Option<[Point; 2]> {
        let apart = self.same[from.0] != self.same[to.0];
        apart.then(|| [self.point(from), self.point(to)])
    }

    /// Place of a column of a joint's frame.
    pub fn frame_column(&mut self, joint: JointId, column: usize) -> usize {
        self.place(Wanted::FrameColumn(joint, column))
    }

    /// Place of the direction of local y of a segment, run through from one node to the other.
    pub fn y_axis(&mut self, segment: SegmentId, ends: [NodeId; 2]) -> usize {
        self.place(Wanted::YAxis(segment, ends))
    }

    /// Place of a column of a flexible body's rotation.
    pub fn rotation(&mut self, body: FlexibleId, column: usize) -> usize {
        self.place(Wanted::RotationColumn(body, column))
    }

    /// Place of a constant vector in axes that turn.
    pub fn turned(&mut self, by: Turned, vector: Vector3<f64>) -> usize {
        let entry = (by, vector);
        let known = self.turned.iter().position(|own| *own == entry);
        let number = known.unwrap_or_else(|| {
            self.turned.push(entry);
            self.turned.len() - 1
        });
        self.place(Wanted::Turned(number))
    }

    /// Writes the vectors of as many geometries as there are lanes into `out`, where entry k of vector v of
    /// lane l is at `(3 v + k) · lanes + l`.
    /// What has no axes there is no number.
    pub fn read(&self, model: &Model, geometries: &[&Geometry], out: &mut [f64]) {
        if let Ok(own) = <&[&Geometry; 8]>::try_from(geometries) {
            self.read_lanes(model, own, out);
        } else if let Ok(own) = <&[&Geometry; 4]>::try_from(geometries) {
            self.read_lanes(model, own, out);
        } else if let Ok(own) = <&[&Geometry; 2]>::try_from(geometries) {
            self.read_lanes(model, own, out);
        } else if let Ok(own) = <&[&Geometry; 1]>::try_from(geometries) {
            self.read_lanes(model, own, out);
        }
    }

    fn read_lanes<const W: usize>(
        &self,
        model: &Model,
        geometries: &[&Geometry; W],
        out: &mut [f64],
    ) {
        // Forces and moments of a load follow each other, in the same axes.
        let mut last = [const { None }; W];
        let (out, _) = out.as_chunks_mut::<W>();
        let (out, _) = out.as_chunks_mut::<3>();
        for (source, out) in self.sources.iter().zip(out) {
            match source {
                Wanted::Position(node) => {
                    for lane in 0..W {
                        put(out, lane, &geometries[lane].positions[node.0].coords);
                    }
                }
                Wanted::FrameColumn(joint, column) => {
                    for lane in 0..W {
                        let frame = geometries[lane].frames[joint.0].matrix();
                        let axis = &frame.data.0[*column];
                        for k in 0..3 {
                            out[k][lane] = axis[k];
                        }
                    }
                }
                Wanted::Turned(number) => {
                    for lane in 0..W {
                        let vector = self.turn(*number, model, geometries[lane], &mut last[lane]);
                        put(out, lane, &vector);
                    }
                }
                _ => {
                    for lane in 0..W {
                        put(out, lane, &source.at(geometries[lane]));
                    }
                }
            }
        }
    }

    /// A vector in axes that turn; `last`: those that were looked at last, with their rotation, `None`
    /// where they have none.
    fn turn<'a>(
        &'a self,
        number: usize,
        model: &Model,
        geometry: &Geometry,
        last: &mut Option<(&'a Axes, Option<Rotation3<f64>>)>,
    ) -> Vector3<f64> {
        let (by, vector) = &self.turned[number];
        let axes = match by {
            Turned::Joint(joint) => return geometry.frames[joint.0] * vector,
            Turned::Axes(axes) => axes,
        };
        let rotation = match last {
            Some((own, rotation)) if *own == axes => *rotation,
            _ => last.insert((axes, axes.rotation(model, geometry).ok())).1,
        };
        rotation.map_or(Vector3::repeat(f64::NAN), |rotation| rotation * vector)
    }

    /// The vector at a place, but for those in axes of loads.
    pub fn at(&self, geometry: &Geometry, place: usize) -> Vector3<f64> {
        self.sources[place].at(geometry)
    }
}

impl Wanted {
    #[inline(always)]
    fn at(self, geometry: &Geometry) -> Vector3<f64> {
        let column = |rotation: &Rotation3<f64>, c: usize| -> Vector3<f64> {
            rotation.matrix().column(c).into_owned()
        };
        match self {
            Self::Position(node) => geometry.positions[node.0].coords,
            Self::FrameColumn(joint, c) => column(&geometry.frames[joint.0], c),
            Self::YAxis(segment, ends) => match geometry.y_axes[segment.0] {
                Some(given) => given,
                None => upright(geometry, ends),
            },
            Self::RotationColumn(body, c) => column(&geometry.rotations[body.0], c),
            // Nothing that moves is told by what acts.
            Self::Turned(_) => Vector3::repeat(f64::NAN),
        }
    }
}

/// Puts the vector of one lane beside those of the others.
#[inline(always)]
fn put<const W: usize>(out: &mut [[f64; W]; 3], lane: usize, vector: &Vector3<f64>) {
    out[0][lane] = vector.x;
    out[1][lane] = vector.y;
    out[2][lane] = vector.z;
}

/// Local y of a segment whose section stands upright; zero, which no lane takes, where it has none.
fn upright(geometry: &Geometry, [from, to]: [NodeId; 2]) -> Vector3<f64> {
    let span = geometry.positions[to.0] - geometry.positions[from.0];
    let frame = element_frame(&span, None);
    frame.map_or(Vector3::zeros(), |frame| {
        frame.matrix().column(1).into_owned()
    })
}
