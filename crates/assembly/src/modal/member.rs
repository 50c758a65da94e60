//! The members of a model: its segments in as many parts as their masses ask for, with what does not
//! change from pose to pose.

use std::sync::Arc;

use hyperstat_elements::{InnerShapes, MassShape, Material, Matrix12, Section, Taper};
use hyperstat_model::{BeamMass, Geometry, ModalOptions, Model, Segment, SegmentBeam};

use crate::error::SolveError;
use crate::response::parameters::line_mass;
use crate::room;

/// What the inner nodes of too many elements ask for.
const COORDINATES: &str = "the coordinates of its elements";
/// Elements of a model at the most.
const MOST_ELEMENTS: usize = 200_000;
/// Segments looked back at for an equal one.
const LOOKED_BACK: usize = 16;
/// Lengths that differ by more than this part make other members.
const SAME_LENGTH: f64 = 1e-10;

/// A part of a segment.
#[derive(Debug)]
pub(crate) struct Member {
    pub beam: SegmentBeam,
    /// Mass matrix over both nodes, element frame.
    pub mass: Matrix12,
    /// What moves between them; none where masses are not exact.
    pub inner: InnerShapes,
}

/// All members, and the parts that every segment has.
#[derive(Debug)]
pub(crate) struct Members {
    /// How many of `all` are those of each segment.
    pub parts: Vec<usize>,
    pub all: Vec<Arc<Member>>,
    /// The lengths (m) of the segments that they were made for.
    lengths: Vec<f64>,
    /// Up to which ω² they are right; infinite where the elements are those that are given.
    pub limit: f64,
}

/// What makes two segments' members the same.
struct Kind<'a> {
    material: &'a Material,
    section: &'a Section,
    taper: Option<Taper>,
    length: f64,
    elements: usize,
}

impl Members {
    /// Of the segments in a configuration, exact up to `limit`; without one up to where no segment needs
    /// a node between its ends.
    pub fn new(
        model: &Model,
        geometry: &Geometry,
        options: &ModalOptions,
        limit: Option<f64>,
    ) -> Result<Self, SolveError> {
        let mut found = Self {
            parts: Vec::new(),
            all: Vec::new(),
            lengths: lengths(model, geometry).collect(),
            limit: f64::INFINITY,
        };
        if options.mass == BeamMass::Exact {
            found.limit = match limit {
                Some(limit) => limit,
                None => {
                    let whole = found.of_segments(model, options, 0.0)?;
                    let resolved = whole.iter().flatten().map(|m| m.inner.resolved());
                    resolved.fold(f64::INFINITY, f64::min)
                }
            };
        } else {
            let sizes = model.segments().iter().map(|segment| segment.elements);
            check(sizes.fold(0, usize::saturating_add))?;
        }
        for members in found.of_segments(model, options, found.limit)? {
            found.parts.push(members.len());
            found.all.extend(members);
        }
        check(found.all.len())?;
        Ok(found)
    }

    /// Whether these are the members in this configuration, too.
    pub fn fit(&self, model: &Model, geometry: &Geometry) -> bool {
        let mut both = lengths(model, geometry).zip(&self.lengths);
        both.all(|(length, own)| (length - own).abs() <= SAME_LENGTH * own)
    }

    /// The members of every segment.
    fn of_segments(
        &self,
        model: &Model,
        options: &ModalOptions,
        limit: f64,
    ) -> Result<Vec<Vec<Arc<Member>>>, SolveError> {
        let mut kinds: Vec<(Kind<'_>, usize)> = Vec::new();
        let mut all: Vec<Vec<Arc<Member>>> = Vec::with_capacity(self.lengths.len());
        for (k, (segment, &length)) in model.segments().iter().zip(&self.lengths).enumerate() {
            let kind = Kind {
                material: &segment.material,
                section: &segment.section,
                taper: segment.change_of_section()?,
                length,
                elements: segment.elements,
            };
            let same = |other: &&(Kind<'_>, usize)| {
                let other = &other.0;
                other.length == kind.length
                    && other.elements == kind.elements
                    && other.section == kind.section
                    && other.material == kind.material
                    && other.taper == kind.taper
            };
            match kinds.iter().rev().take(LOOKED_BACK).find(same) {
                Some((_, before)) => all.push(all[*before].clone()),
                None => {
                    all.push(of_segment(model, segment, &kind, options, limit)?);
                    kinds.push((kind, k));
                }
            }
        }
        Ok(all)
    }
}

/// Lengths (m) of all segments.
fn lengths<'a>(model: &'a Model, geometry: &'a Geometry) -> impl Iterator<Item = f64> + 'a {
    let ends = model.segments().iter().map(|segment| segment.ends);
    ends.map(|[a, b]| (geometry.positions[b.0] - geometry.positions[a.0]).norm())
}

/// Refuses too many elements.
fn check(elements: usize) -> Result<(), SolveError> {
    room::check(COORDINATES, elements.saturating_mul(6), 6 * MOST_ELEMENTS)
}

/// The members of a segment: its elements, or where masses are exact as few as are right up to `limit`.
fn of_segment(
    model: &Model,
    segment: &Segment,
    kind: &Kind<'_>,
    options: &ModalOptions,
    limit: f64,
) -> Result<Vec<Arc<Member>>, SolveError> {
    let density = segment.material.density();
    let density = density.ok_or_else(|| SolveError::NoDensity {
        body: model.bodies()[segment.body.0].name.clone(),
    })?;
    let whole = line_mass(segment, density)?;
    let exact = options.mass == BeamMass::Exact;
    let rotary = options.rotary_inertia;
    let mut count = if exact { 1 } else { segment.elements };
    loop {
        check(count)?;
        let place = |k: usize| k as f64 / count as f64;
        let member = |k: usize| -> Result<_, SolveError> {
            let part = |taper: &Taper| taper.part(place(k), place(k + 1));
            let taper = kind.taper.as_ref().map(part);
            let (material, section) = (kind.material, kind.section);
            let length = kind.length / count as f64;
            let beam = SegmentBeam::new(material, section, taper.as_ref(), length)?;
            let line = whole.part(place(k), place(k + 1));
            let straight = beam.straight();
            let mass = match options.mass {
                BeamMass::Lumped => line.lumped(length),
                BeamMass::Consistent => line.consistent(straight, options.shape, rotary),
                BeamMass::Exact => line.consistent(straight, MassShape::Exact, rotary),
            };
            let inner = match exact {
                true => line.inner_shapes(straight, rotary, limit),
                false => InnerShapes::default(),
            };
            Ok(Arc::new(Member { beam, mass, inner }))
        };
        // Equal parts of a segment that does not change are the same.
        let members = match kind.taper {
            None => vec![member(0)?; count],
            Some(_) => (0..count).map(member).collect::<Result<_, _>>()?,
        };
        let resolved = members.iter().map(|m: &Arc<Member>| m.inner.resolved());
        let resolved = resolved.fold(f64::INFINITY, f64::min);
        if !exact || resolved >= limit || resolved <= 0.0 {
            return Ok(members);
        }
        // The waves of bending are as short as the fourth root says.
        let more = count as f64 * (limit / resolved).sqrt().sqrt();
        count = (more.ceil() as usize).max(count + 1);
    }
}
