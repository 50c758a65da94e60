//! Elastic parts in series, with the free motions of the joints between them: what transmits a
//! wrench from one component to another.
//!
//! Compliances in series add, at one point and in the same axes; a free motion takes out the
//! wrenches that would work on it. So a chain needs no coordinates for what lies between its ends,
//! and no difference of large stiffnesses is taken. This is the subassembly element of paper §2.1
//! carried on over any number of links and joints.

use hyperstat_elements::PlaneFlexibility;
use hyperstat_model::{Geometry, JointId, Model, NodeId, SegmentBeam, SegmentId, unit_beam};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use super::acts::Act;
use super::inputs::{Inputs, Point};
use crate::lanes::pass::lane::TRIANGLE;

/// Most free motions within a chain: with six it would transmit nothing.
pub(crate) const MOST_RELEASES: usize = 5;

/// Most idle motions within a chain.
pub(crate) const MOST_IDLE: usize = 3;

/// Of an idle motion, what the free ones of its chain leave of it is below this share (squared).
pub(crate) const DEPENDENT: f64 = 1e-20;

/// Parts in series between two nodes.
#[derive(Debug, Clone)]
pub(crate) struct Chain {
    /// The softest one first: in its axes and about its centre all are added up, so that its
    /// bending does not swallow the digits of its tension.
    pub links: Vec<Link>,
    pub releases: Vec<Release>,
    /// Motions that the releases contain: what lies between turns or slides without energy.
    pub idle: Vec<Idle>,
    /// Loads on what lies between the ends.
    pub loads: Vec<InnerLoad>,
    /// All of these as they follow each other from end 0 to end 1.
    pub order: Vec<Item>,
    /// Length that makes rotations comparable with translations \[m\], a power of two.
    pub size: f64,
    /// In which order the free motions take the six coordinates of motions and wrenches.
    pub sequence: Sequence,
    /// By ends: reference points of the components there.
    pub origins: [Point; 2],
}

/// An order of six coordinates.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sequence {
    /// The coordinate at each place.
    pub coordinates: [usize; 6],
    /// The place of each coordinate.
    pub places: [u8; 6],
    /// Of a symmetric matrix in this order, its lower triangle by rows: where each entry is in the lower
    /// triangle of the matrix itself, six entries a row.
    pub entries: [u8; TRIANGLE],
}

impl Sequence {
    pub fn new(coordinates: [usize; 6]) -> Self {
        let (mut places, mut entries) = ([0; 6], [0; TRIANGLE]);
        let mut next = 0;
        for (i, &row) in coordinates.iter().enumerate() {
            places[row] = i as u8;
            for &column in &coordinates[..=i] {
                entries[next] = (6 * row.max(column) + row.min(column)) as u8;
                next += 1;
            }
        }
        Self {
            coordinates,
            places,
            entries,
        }
    }
}

/// What a chain is made of, by its place in the list of its kind.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Item {
    Link(usize),
    Release(usize),
    Idle(usize),
    Load(usize),
}

/// An idle motion.
#[derive(Debug, Clone)]
pub(crate) struct Idle {
    /// The coordinate that told it.
    pub coordinate: usize,
    pub along: Release,
}

/// A wrench on a point.
#[derive(Debug, Clone)]
pub(crate) struct InnerLoad {
    pub point: Point,
    pub act: Act,
    pub column: usize,
}

/// A part that gives way.
#[derive(Debug, Clone)]
pub(crate) struct Link {
    pub kind: LinkKind,
    pub source: LinkSource,
    /// Whether its own second end is towards the chain's end 0.
    pub flipped: bool,
    /// Largest deflection per force in the plan's configuration \[m/N\].
    softness: f64,
    /// Stiffness against translations there, all directions together \[N/m\].
    weight: f64,
    /// Length by which its rotations count beside its translations \[m\].
    length: f64,
}

/// What a link is of the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LinkSource {
    Segment(SegmentId),
    Joint(JointId),
    /// A joint's coordinate, by a spring of its own.
    Coordinate,
}

#[derive(Debug, Clone)]
pub(crate) enum LinkKind {
    Beam(BeamLink),
    Joint(JointLink),
    /// A spring along one motion.
    Spring {
        along: Release,
        compliance: f64,
    },
}

/// A straight beam by its flexibilities at unit length.
#[derive(Debug, Clone)]
pub(crate) struct BeamLink {
    pub ends: [Point; 2],
    /// Direction of local y (a place in the inputs); `None` where it bends alike in all directions.
    pub y_axis: Option<usize>,
    pub axial: f64,
    pub torsional: f64,
    /// Bending with deflection along y and along z.
    pub planes: [PlaneFlexibility; 2],
}

/// An elastic joint by its compliance in its own frame.
#[derive(Debug, Clone)]
pub(crate) struct JointLink {
    pub point: Point,
    /// Columns of its frame (places in the inputs).
    pub columns: [usize; 3],
    pub translation: ComplianceBlock,
    pub rotation: ComplianceBlock,
    /// Translations per moments, where there are any.
    pub coupling: Option<Matrix3<f64>>,
}

/// A symmetric 3×3 part of a compliance.
#[derive(Debug, Clone)]
pub(crate) enum ComplianceBlock {
    Diagonal([f64; 3]),
    Full(Matrix3<f64>),
}

/// A motion that a joint leaves free.
#[derive(Debug, Clone)]
pub(crate) struct Release {
    pub point: Point,
    /// Columns of the joint's frame (places in the inputs), with what each gives to the translation
    /// and to the rotation.
    pub axes: Vec<(usize, f64, f64)>,
}

impl Chain {
    /// One link between two nodes whose components have these reference points.
    pub fn new(link: Link, releases: Vec<Release>, origins: [Point; 2]) -> Self {
        let free = (0..releases.len()).map(Item::Release);
        let mut chain = Self {
            order: free.chain([Item::Link(0)]).collect(),
            links: vec![link],
            releases,
            idle: Vec::new(),
            loads: Vec::new(),
            size: 1.0,
            sequence: Sequence::new([0, 1, 2, 3, 4, 5]),
            origins,
        };
        chain.settle();
        chain
    }

    /// The chain that goes on with `next`; `ends`: of either, the end that stays one.
    pub fn followed_by(mut self, mut next: Self, ends: [usize; 2]) -> Self {
        if ends[0] == 1 {
            self.reverse();
        }
        if ends[1] == 0 {
            next.reverse();
        }
        let (links, releases) = (self.links.len(), self.releases.len());
        let (idle, loads) = (self.idle.len(), self.loads.len());
        self.order
            .extend(next.order.into_iter().map(|item| match item {
                Item::Link(k) => Item::Link(links + k),
                Item::Release(k) => Item::Release(releases + k),
                Item::Idle(k) => Item::Idle(idle + k),
                Item::Load(k) => Item::Load(loads + k),
            }));
        self.links.extend(next.links);
        self.releases.extend(next.releases);
        self.idle.extend(next.idle);
        self.loads.extend(next.loads);
        self.origins = [self.origins[ends[0]], next.origins[ends[1]]];
        self.settle();
        self
    }

    fn reverse(&mut self) {
        self.order.reverse();
        for link in &mut self.links {
            link.flipped = !link.flipped;
        }
    }

    /// Adds a spring along a motion at an end.
    pub fn add_spring(&mut self, end: usize, along: Release, stiffness: f64) {
        let compliance = 1.0 / stiffness;
        let slides = along.axes.iter().any(|(_, linear, _)| *linear != 0.0);
        self.put(end, Item::Link(self.links.len()));
        self.links.push(Link {
            kind: LinkKind::Spring { along, compliance },
            source: LinkSource::Coordinate,
            flipped: false,
            softness: 0.0,
            weight: if slides { stiffness } else { f64::INFINITY },
            length: 0.0,
        });
    }

    /// Adds a free motion at an end.
    pub fn add_release(&mut self, end: usize, along: Release) {
        self.put(end, Item::Release(self.releases.len()));
        self.releases.push(along);
    }

    /// Adds an idle motion at an end.
    pub fn add_idle(&mut self, end: usize, idle: Idle) {
        self.put(end, Item::Idle(self.idle.len()));
        self.idle.push(idle);
    }

    /// Adds a load at an end.
    pub fn add_load(&mut self, end: usize, load: InnerLoad) {
        self.put(end, Item::Load(self.loads.len()));
        self.loads.push(load);
    }

    fn put(&mut self, end: usize, item: Item) {
        let place = if end == 0 { 0 } else { self.order.len() };
        self.order.insert(place, item);
    }

    fn settle(&mut self) {
        let is_softer = |a: &&usize, b: &&usize| {
            let softness = |k: usize| self.links[k].softness;
            softness(**a).total_cmp(&softness(**b))
        };
        let numbers: Vec<usize> = (0..self.links.len()).rev().collect();
        let softest = numbers.iter().max_by(is_softer).copied().unwrap_or(0);
        self.links.swap(0, softest);
        for item in &mut self.order {
            match item {
                Item::Link(k) if *k == softest => *k = 0,
                Item::Link(k) if *k == 0 => *k = softest,
                _ => {}
            }
        }
        self.size = (self.links[0].length.log2() - 1.0).round().exp2();
    }

    /// Coordinates of idle motions that its free ones do not contain, where `at` are the inputs'
    /// vectors.
    pub fn strange_idle(&self, at: impl Fn(usize) -> Vector3<f64>) -> Vec<usize> {
        let about = self.releases.first().map(|r| at(r.point));
        let twist = |release: &Release| {
            let twist = release.twist(&at, &about.unwrap_or_default(), self.size);
            twist.normalize()
        };
        let mut span: Vec<Vector6<f64>> = Vec::new();
        let left = |mut twist: Vector6<f64>, span: &[Vector6<f64>]| {
            for other in span.iter().chain(span) {
                twist -= other * other.dot(&twist);
            }
            twist
        };
        for release in &self.releases {
            let new = left(twist(release), &span);
            span.push(new.normalize());
        }
        let is_strange = |idle: &&Idle| left(twist(&idle.along), &span).norm_squared() > DEPENDENT;
        let strange = self.idle.iter().filter(is_strange);
        strange.map(|idle| idle.coordinate).collect()
    }

    /// Stiffness against translations in the plan's configuration, all directions together, free
    /// motions apart \[N/m\].
    pub fn weight(&self) -> f64 {
        1.0 / self.links.iter().map(|l| 1.0 / l.weight).sum::<f64>()
    }
}

impl Release {
    /// The twist at a point, its translations over `size`.
    pub fn twist(
        &self,
        at: impl Fn(usize) -> Vector3<f64>,
        about: &Vector3<f64>,
        size: f64,
    ) -> Vector6<f64> {
        let (mut linear, mut angular) = (Vector3::zeros(), Vector3::zeros());
        for (column, along, turning) in &self.axes {
            linear += at(*column) * *along;
            angular += at(*column) * *turning;
        }
        linear += angular.cross(&(about - at(self.point)));
        let [v, w] = [linear / size, angular];
        Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z)
    }
}

impl Link {
    /// The beam of a segment.
    pub fn beam(
        model: &Model,
        geometry: &Geometry,
        id: SegmentId,
        inputs: &mut Inputs,
    ) -> Option<Self> {
        let ends = model.segments()[id.0].ends;
        let (axial, torsional, planes, round);
        match unit_beam(model, id)? {
            SegmentBeam::Prismatic(beam) => {
                let section = beam.section_compliance();
                let plane = |rigidity: f64, shear: f64| PlaneFlexibility {
                    turn: 1.0 / rigidity,
                    centre: 0.5,
                    bending: 1.0 / (12.0 * rigidity),
                    shear,
                };
                (axial, torsional) = (section[0], section[3]);
                planes = [
                    plane(beam.bending_rigidity_z(), section[1]),
                    plane(beam.bending_rigidity_y(), section[2]),
                ];
                round = planes[0] == planes[1];
            }
            SegmentBeam::Tapered(beam) => {
                [axial, torsional] = beam.axial_and_torsional_flexibility();
                planes = beam.plane_flexibilities();
                round = false;
            }
        }
        let length = (geometry.positions[ends[1].0] - geometry.positions[ends[0].0]).norm();
        let deflection = planes.map(|p| (p.bending * length * length + p.shear) * length);
        Some(Self {
            softness: deflection[0].max(deflection[1]).max(axial * length),
            weight: 1.0 / (axial * length) + 1.0 / deflection[0] + 1.0 / deflection[1],
            length,
            source: LinkSource::Segment(id),
            flipped: false,
            kind: LinkKind::Beam(BeamLink {
                y_axis: (!round).then(|| inputs.y_axis(id, ends)),
                ends: ends.map(|n| inputs.point(n)),
                axial,
                torsional,
                planes,
            }),
        })
    }

    /// A joint at a node by its compliance in its own frame (its columns' places); `size` of the
    /// mechanism.
    pub fn joint(
        joint: JointId,
        compliance: &Matrix6<f64>,
        node: NodeId,
        columns: [usize; 3],
        size: f64,
        inputs: &mut Inputs,
    ) -> Self {
        let block = |i: usize, j: usize| compliance.fixed_view::<3, 3>(i, j).into_owned();
        let part = |block: Matrix3<f64>| {
            if block == Matrix3::from_diagonal(&block.diagonal()) {
                ComplianceBlock::Diagonal(block.diagonal().into())
            } else {
                ComplianceBlock::Full(block)
            }
        };
        let give = compliance.diagonal();
        let linear = give.fixed_rows::<3>(0);
        let stiffness = linear.iter().filter(|c| **c > 0.0).map(|c| 1.0 / c);
        let coupling = block(0, 3);
        Self {
            softness: linear.max(),
            weight: if linear.max() > 0.0 {
                stiffness.sum()
            } else {
                f64::INFINITY
            },
            length: size,
            source: LinkSource::Joint(joint),
            flipped: false,
            kind: LinkKind::Joint(JointLink {
                point: inputs.point(node),
                columns,
                translation: part(block(0, 0)),
                rotation: part(block(3, 3)),
                coupling: (coupling != Matrix3::zeros()).then_some(coupling),
            }),
        }
    }
}
