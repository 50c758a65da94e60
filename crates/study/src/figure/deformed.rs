//! The figure of a mechanism that is displaced, by loads (Fig. 9) or in a natural mode.

use hyperstat_assembly::{
    BodyKind, Connection, Mode, Model, SegmentForces, SegmentId, Solution, SolveError,
    segment_displacement,
};
use hyperstat_figures::{
    Axis, Curve, DeformedFigure, Notes, RigidBody, Scale, SecondPoints, Shown, Viewpoint,
};
use hyperstat_joints::Dof;
use hyperstat_reference::ReferenceSolution;
use nalgebra::Vector6;

use super::second::{SECOND, difference};
use crate::answer::linear;

/// Pieces in which an elastic curve is drawn, at the least and at the most: four an element.
const PIECES: [usize; 2] = [24, 240];

/// The mechanism under its loads.
///
/// # Errors
/// A segment that cannot be formed, which no segment of a solved model is.
pub fn deformed(
    model: &Model,
    solution: &Solution,
    title: String,
    scale: Scale,
) -> Result<DeformedFigure, SolveError> {
    let displacements = &*solution.displacements;
    let along = |segment: SegmentId, xi| {
        let load = (solution.segments)
            .get(segment.0)
            .map(|forces: &SegmentForces| &forces.load);
        segment_displacement(model, model.geometry(), displacements, segment, load, xi)
    };
    let mut figure = figure(model, displacements, along, Shown::Deflection)?;
    (figure.title, figure.scale) = (title, scale);
    Ok(figure)
}

/// The mechanism in a natural mode, of this number from 1.
///
/// # Errors
/// As [`deformed`].
pub fn mode(
    model: &Model,
    mode: &Mode,
    number: usize,
    title: String,
    scale: Scale,
) -> Result<DeformedFigure, SolveError> {
    let along = |segment, xi| mode.segment_displacement(model, segment, xi);
    let frequency = mode.frequency;
    let shown = Shown::Mode { number, frequency };
    let mut figure = figure(model, &mode.displacements, along, shown)?;
    (figure.title, figure.scale) = (title, scale);
    Ok(figure)
}

/// The mechanism with its nodes displaced, and the axes of its segments as `along` says.
fn figure(
    model: &Model,
    displacements: &[Vector6<f64>],
    along: impl Fn(SegmentId, f64) -> Result<Vector6<f64>, SolveError>,
    shown: Shown,
) -> Result<DeformedFigure, SolveError> {
    let segments = (0..model.segments().len()).map(SegmentId);
    let curves = segments.map(|segment| curve(model, segment, |xi| along(segment, xi)));
    let joints = model.joints().iter().enumerate();
    Ok(DeformedFigure {
        title: String::new(),
        shown,
        curves: curves.collect::<Result<_, _>>()?,
        rigid: rigid_bodies(model, displacements),
        axes: joints
            .flat_map(|(k, joint)| axes(model, k, joint))
            .collect(),
        ground: grounded(model),
        second: None,
        scale: Scale::Auto,
        notes: Notes::default(),
        view: Viewpoint::default(),
        axis_names: None,
        pose: None,
    })
}

/// A segment as its elastic curve.
fn curve(
    model: &Model,
    id: SegmentId,
    along: impl Fn(f64) -> Result<Vector6<f64>, SolveError>,
) -> Result<Curve, SolveError> {
    let segment = &model.segments()[id.0];
    let [start, end] = segment.ends.map(|node| model.geometry().positions[node.0]);
    let pieces = segment
        .elements
        .saturating_mul(4)
        .clamp(PIECES[0], PIECES[1]);
    let places = || (0..=pieces).map(|k| k as f64 / pieces as f64);
    let displacement = places().map(|xi| along(xi).map(|u| linear(&u)));
    Ok(Curve {
        points: places().map(|xi| start.lerp(&end, xi).into()).collect(),
        displacement: displacement.collect::<Result<_, _>>()?,
    })
}

/// Bodies that are not drawn as elastic curves: rigid ones, and flexible ones, of which only the
/// nodes are known.
fn rigid_bodies(model: &Model, displacements: &[Vector6<f64>]) -> Vec<RigidBody> {
    let rigid = model
        .bodies()
        .iter()
        .filter(|body| body.kind != BodyKind::Elastic);
    rigid
        .map(|body| RigidBody {
            points: body
                .nodes
                .iter()
                .map(|node| position(model, node.0))
                .collect(),
            displacement: body
                .nodes
                .iter()
                .map(|node| linear(&displacements[node.0]))
                .collect(),
        })
        .collect()
}

/// The axes of a joint: those it turns about, or slides along where it does not turn. Where all
/// directions are alike there is none to show.
fn axes(model: &Model, place: usize, joint: &Connection) -> Vec<Axis> {
    let Some(node) = joint.between.iter().flatten().next() else {
        return Vec::new();
    };
    let frame = model.geometry().frames[place];
    let free = joint.released();
    let free_of = |dofs: [Dof; 3]| -> Vec<usize> {
        let is_free = |axis: &usize| free.contains(dofs[*axis]);
        (0..3).filter(is_free).collect()
    };
    let turns = free_of([Dof::U, Dof::V, Dof::W]);
    let shown = if turns.is_empty() {
        free_of([Dof::X, Dof::Y, Dof::Z])
    } else {
        turns
    };
    if shown.len() == 3 {
        return Vec::new();
    }
    shown
        .into_iter()
        .map(|axis| Axis {
            at: position(model, node.0),
            direction: frame.matrix().column(axis).into_owned().into(),
        })
        .collect()
}

/// Where joints hold bodies to the ground.
fn grounded(model: &Model) -> Vec<[f64; 3]> {
    let nodes = model
        .joints()
        .iter()
        .filter_map(|joint| match joint.between {
            [None, Some(node)] | [Some(node), None] => Some(node),
            _ => None,
        });
    nodes.map(|node| position(model, node.0)).collect()
}

/// Adds the independent solver's displacements of all nodes but those of idle bodies, which both
/// methods leave open. Both solutions are under the model's own loads.
pub fn compare(
    figure: &mut DeformedFigure,
    model: &Model,
    solution: &Solution,
    second: &ReferenceSolution,
) {
    let is_idle = |node: &usize| {
        let body = model.nodes()[*node].body;
        let mut twists = solution.idle.iter().flat_map(|motion| &motion.twists);
        twists.any(|(moving, _)| *moving == body)
    };
    let nodes: Vec<usize> = (0..model.nodes().len())
        .filter(|node| !is_idle(node))
        .collect();
    let of = |displacements: &[Vector6<f64>]| -> Vec<[f64; 3]> {
        nodes
            .iter()
            .map(|node| linear(&displacements[*node]))
            .collect()
    };
    let displacement = of(&second.displacements);
    figure.second = Some(SecondPoints {
        name: SECOND.into(),
        points: nodes.iter().map(|node| position(model, *node)).collect(),
        difference: difference(
            &of(&solution.displacements),
            &displacement,
            solution.floor.least_displacement(),
        ),
        displacement,
    });
}

pub(super) fn position(model: &Model, node: usize) -> [f64; 3] {
    model.geometry().positions[node].into()
}
