//! The figure of a deformed mechanism, from its solution (Fig. 9).

use hyperstat_assembly::{
    BodyKind, Connection, Model, SegmentId, Solution, SolveError, segment_displacement,
};
use hyperstat_figures::{Axis, Curve, DeformedFigure, RigidBody, SecondPoints};
use hyperstat_joints::Dof;
use hyperstat_mechanisms::{Job, Scale};
use nalgebra::Vector6;

use super::{SECOND, difference, figure_scale, linear};
use crate::case::job_model;

/// Points at which an elastic curve is sampled, ends included.
const SAMPLES: usize = 25;

/// The deformed mechanism at a pose; `None` where the pose has no result.
pub(super) fn figure(job: &Job, pose: usize, scale: Scale) -> Option<DeformedFigure> {
    let model = job_model(job, pose).ok()?;
    let solution = hyperstat_assembly::solve(&model).ok()?;
    if !solution.output.free_motions.is_empty() {
        return None;
    }
    let segments = (0..model.segments().len()).map(SegmentId);
    let curves = segments.map(|segment| curve(&model, &solution, segment));
    let joints = model.joints().iter().enumerate();
    Some(DeformedFigure {
        title: format!("{}, pose {pose}", job.name),
        curves: curves.collect::<Result<_, _>>().ok()?,
        rigid: rigid_bodies(&model, &solution),
        axes: joints
            .flat_map(|(k, joint)| axes(&model, k, joint))
            .collect(),
        ground: grounded(&model),
        second: second_points(&model, &solution),
        scale: figure_scale(scale),
    })
}

/// A segment as its elastic curve: the beam's own shape between the displacements of its ends.
fn curve(model: &Model, solution: &Solution, segment: SegmentId) -> Result<Curve, SolveError> {
    let geometry = model.geometry();
    let ends = model.segments()[segment.0].ends;
    let [start, end] = ends.map(|node| geometry.positions[node.0]);
    let at = |k: usize| k as f64 / (SAMPLES - 1) as f64;
    let load = solution.segments.get(segment.0).map(|forces| &forces.load);
    let displacement = |k| {
        let displacements = &solution.displacements;
        segment_displacement(model, geometry, displacements, segment, load, at(k))
            .map(|u| linear(&u))
    };
    Ok(Curve {
        points: (0..SAMPLES)
            .map(|k| start.lerp(&end, at(k)).into())
            .collect(),
        displacement: (0..SAMPLES).map(displacement).collect::<Result<_, _>>()?,
    })
}

/// Bodies that are not drawn as elastic curves: rigid ones, and flexible ones, of which only the
/// nodes are known.
fn rigid_bodies(model: &Model, solution: &Solution) -> Vec<RigidBody> {
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
                .map(|node| linear(&solution.displacements[node.0]))
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
    let free = joint.joint.free();
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

/// The reference solver's displacements of all nodes but those of idle bodies, which both
/// methods leave open; `None` where it has no answer.
fn second_points(model: &Model, solution: &Solution) -> Option<SecondPoints> {
    let second = hyperstat_reference::solve(model).ok()?;
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
    Some(SecondPoints {
        name: SECOND.into(),
        points: nodes.iter().map(|node| position(model, *node)).collect(),
        difference: difference(&of(&solution.displacements), &displacement),
        displacement,
    })
}

fn position(model: &Model, node: usize) -> [f64; 3] {
    model.geometry().positions[node].into()
}
