//! The parts of a model, as plain data.
//!
//! Names are kept for reports; everything refers to everything else by index. What a pose
//! changes stands apart in [`Geometry`].

use hyperstat_elements::{ElementError, FlexibleBody, Material, RigidMass, Section, Taper};
use hyperstat_joints::{Dof, DofSet, Joint};
use nalgebra::{Matrix6, Point3, Rotation3, Vector3, Vector6};

macro_rules! index {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub usize);
    };
}
index!(
    /// Index of a body in [`Model::bodies`](crate::Model::bodies).
    BodyId
);
index!(
    /// Index of a node in [`Model::nodes`](crate::Model::nodes).
    NodeId
);
index!(
    /// Index of a segment in [`Model::segments`](crate::Model::segments).
    SegmentId
);
index!(
    /// Index of a flexible body in [`Model::flexibles`](crate::Model::flexibles).
    FlexibleId
);
index!(
    /// Index of a joint in [`Model::joints`](crate::Model::joints).
    JointId
);

/// Whether a body deforms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodyKind {
    /// One rigid body: its nodes move together (Eq. 37).
    Rigid,
    /// Beam segments, welded at the nodes they share.
    Elastic,
    /// An elastic body given by its stiffness over its nodes.
    Flexible,
}

/// A body: a name, its nodes and, where it is elastic, its segments.
#[derive(Debug, Clone)]
pub struct Body {
    /// Name, unique in the model.
    pub name: String,
    /// Rigid, of beams, or given by its stiffness.
    pub kind: BodyKind,
    /// Nodes in the order of the body's points.
    pub nodes: Vec<NodeId>,
    /// Segments in their order along the body; none where it is not made of beams.
    pub segments: Vec<SegmentId>,
    /// Its stiffness, where it is given by one.
    pub flexible: Option<FlexibleId>,
    /// Change of its temperature (K).
    pub temperature: f64,
}

/// A node: one point of one body.
#[derive(Debug, Clone)]
pub struct Node {
    /// The body it belongs to.
    pub body: BodyId,
    /// Name of the point.
    pub point: String,
}

/// A straight beam between two nodes of an elastic body.
#[derive(Debug, Clone)]
pub struct Segment {
    /// The body it belongs to.
    pub body: BodyId,
    /// First and second node; local x runs from the first to the second.
    pub ends: [NodeId; 2],
    /// Material.
    pub material: Material,
    /// Section; where the segment tapers, the one that the change begins with.
    pub section: Section,
    /// How the section changes along the segment; `None`: the segment is prismatic.
    pub taper: Option<Tapering>,
    /// Number of equal beam elements it is divided into.
    pub elements: usize,
    /// Whether its local y was given. A default one stands upright wherever nothing else says how
    /// it lies, so that it does not tell how its body is turned.
    pub y_axis_given: bool,
}

impl Segment {
    /// The change of section along it; `None` where it is prismatic.
    ///
    /// # Errors
    /// Sections that no taper joins, which no segment of a model has.
    pub fn change_of_section(&self) -> Result<Option<Taper>, ElementError> {
        change_of_section(&self.section, self.taper.as_ref())
    }

    /// The sections along it, be they all the same.
    ///
    /// # Errors
    /// As [`Segment::change_of_section`].
    pub fn sections_along(&self) -> Result<Taper, ElementError> {
        let taper = self.change_of_section()?;
        Ok(taper.unwrap_or_else(|| Taper::constant(self.section.clone())))
    }
}

/// A segment to be added to a body, by the places of its ends in the body's list of points.
#[derive(Debug, Clone)]
pub struct Member {
    /// Places of its ends.
    pub ends: [usize; 2],
    /// Material.
    pub material: Material,
    /// Section; where the segment tapers, the one that the change begins with.
    pub section: Section,
    /// How the section changes along the segment; `None`: the segment is prismatic.
    pub taper: Option<Tapering>,
    /// Direction of local y (made normal to x); `None`: the section stands upright.
    pub y_axis: Option<Vector3<f64>>,
    /// Number of equal beam elements it is divided into (at least 1).
    pub elements: usize,
}

impl Member {
    /// The change of section along it; `None` where it is prismatic.
    ///
    /// # Errors
    /// Sections that no taper joins, a part that is none.
    pub fn change_of_section(&self) -> Result<Option<Taper>, ElementError> {
        change_of_section(&self.section, self.taper.as_ref())
    }
}

/// How the section of a segment changes along it: from the segment's own to another one, or a part
/// of that change where several segments taper as one.
#[derive(Debug, Clone, PartialEq)]
pub struct Tapering {
    /// The section that the change ends with.
    pub to: Section,
    /// Where along the change the segment begins and ends: 0 ≤ first ≤ last ≤ 1.
    pub part: [f64; 2],
}

impl Tapering {
    /// The whole change, from the segment's section at its first node to this one at its second.
    pub fn whole(to: Section) -> Self {
        Self {
            to,
            part: [0.0, 1.0],
        }
    }

    /// Place along the change (0 to 1) at `xi` along the segment.
    pub fn along(&self, xi: f64) -> f64 {
        let [first, last] = self.part;
        (1.0 - xi) * first + xi * last
    }
}

/// A flexible body: an elastic body given by its stiffness.
#[derive(Debug, Clone)]
pub struct Flexible {
    /// The body.
    pub body: BodyId,
    /// Its stiffness over its nodes, in axes that turn with it.
    pub element: FlexibleBody,
}

/// Elasticity of a joint, by directions of the joint.
#[derive(Debug, Clone, PartialEq)]
pub enum JointStiffness {
    /// Per direction x y z (N/m), u v w (N·m/rad); `None`: rigid where constrained or locked,
    /// free where free. Zero frees a constrained direction and leaves a free or locked one as it is.
    Directions([Option<f64>; 6]),
    /// Full symmetric positive semidefinite matrix over all six directions.
    Matrix(Matrix6<f64>),
}

impl Default for JointStiffness {
    fn default() -> Self {
        Self::Directions([None; 6])
    }
}

/// A joint of the mechanism: where it sits, between which nodes, and how stiff it is.
#[derive(Debug, Clone)]
pub struct Connection {
    /// Name, unique in the model.
    pub name: String,
    /// First (i) and second (j) node; `None` is the ground.
    pub between: [Option<NodeId>; 2],
    /// The joint's kind.
    pub joint: Box<dyn Joint>,
    /// Directions that are held (drives).
    pub locked: DofSet,
    /// Elasticity from the file; where it is given it replaces the joint's own.
    pub stiffness: JointStiffness,
}

/// How a joint's two bodies stand to each other when no force acts, and what presses them on each
/// other, by directions of the joint: x y z (m; N), u v w (rad; N·m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Misfit {
    /// The joint.
    pub joint: JointId,
    /// What the second body stands off from the first: their difference `Δ_second − Δ_first` along
    /// rigid and locked directions, and that at which the springs of elastic ones are at rest.
    pub misfit: Vector6<f64>,
    /// Wrench on the second body, its opposite on the first, along elastic and free directions.
    pub preload: Vector6<f64>,
}

/// Mass and inertia at a node, in global axes at the model's configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeMass {
    /// Node that is the centre of mass; the mass moves with the node's body.
    pub node: NodeId,
    /// Mass and inertia about the node.
    pub mass: RigidMass,
}

/// Poses that go side by side, from a pose's place to its result.
pub const LANES: usize = 8;

/// What a pose changes: positions, section directions and joint frames, in global axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// Position of every node (m).
    pub positions: Vec<Point3<f64>>,
    /// Direction of every segment's local y; `None`: the default of
    /// [`element_frame`](hyperstat_elements::element_frame).
    pub y_axes: Vec<Option<Vector3<f64>>>,
    /// Joint frame of every joint: columns are its x, y and z.
    pub frames: Vec<Rotation3<f64>>,
    /// Rotation of every flexible body, by [`FlexibleId`]: its columns are the axes that the
    /// body's stiffness is given in. Its nodes' positions must have moved with it.
    pub rotations: Vec<Rotation3<f64>>,
}

/// The change of section of a segment; `None` where there is none.
fn change_of_section(
    from: &Section,
    tapering: Option<&Tapering>,
) -> Result<Option<Taper>, ElementError> {
    let Some(Tapering {
        to,
        part: [first, last],
    }) = tapering
    else {
        return Ok(None);
    };
    if !(*first >= 0.0 && first <= last && *last <= 1.0) {
        return Err(ElementError::OutOfRange {
            field: "part",
            value: *first,
            wanted: "0 or more and not beyond the end of the part, which is 1 or less",
        });
    }
    let whole = Taper::new(from.clone(), to.clone())?;
    Ok(Some(whole.part(*first, *last)))
}

/// Where a value of a model stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ValuePlace {
    /// A dimension of a segment's section, by its name in files.
    Dimension {
        /// The segment.
        segment: SegmentId,
        /// Whether the section is the one that the segment's change of section ends with.
        second: bool,
        /// The dimension.
        dimension: &'static str,
    },
    /// A constant of a segment's material, by its name in files.
    Constant {
        /// The segment.
        segment: SegmentId,
        /// The constant.
        constant: &'static str,
    },
    /// A stiffness of a joint that is given by directions.
    Stiffness {
        /// The joint.
        joint: JointId,
        /// The direction.
        direction: Dof,
    },
    /// The mass of a node.
    Mass {
        /// Its place among [`Model::masses`](crate::Model::masses).
        mass: usize,
    },
}
