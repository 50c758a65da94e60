//! Names, loads, masses and frames in the figure of a mechanism.

use hyperstat_assembly::{Axes, Load, Model};
use hyperstat_figures::{Arrow, DeformedFigure, Frame, Mass, Name, Named, Viewpoint};
use hyperstat_mechanisms::{Look, Noted, View};
use nalgebra::Vector3;

use super::deformed::position;

/// Sets how a figure of a model looks; the loads are those of a case where one is named.
pub(super) fn add(figure: &mut DeformedFigure, model: &Model, case: Option<&str>, look: &Look) {
    figure.view = viewpoint(look.view);
    for noted in &look.shown {
        match noted {
            Noted::Names => figure.notes.names = names(model),
            Noted::Loads => figure.notes.loads = loads(model, case),
            Noted::Masses => figure.notes.masses = masses(model),
            Noted::Frames => figure.notes.frames = frames(model),
            // That is told by who knows the job.
            Noted::Pose => {}
        }
    }
}

/// Where a figure is seen from.
pub fn viewpoint(view: Option<View>) -> Viewpoint {
    view.map_or_else(Viewpoint::default, |view| Viewpoint {
        azimuth: view.azimuth,
        elevation: view.elevation,
    })
}

/// Names of joints where they are, several at one point together; names of bodies in their middle.
fn names(model: &Model) -> Vec<Name> {
    let mut names: Vec<Name> = Vec::new();
    for joint in model.joints() {
        let Some(node) = joint.between.iter().flatten().next() else {
            continue;
        };
        let at = position(model, node.0);
        match names.iter_mut().find(|name| name.at == at) {
            Some(name) => name.text += &format!(", {}", joint.name),
            None => names.push(Name {
                at,
                text: joint.name.clone(),
                of: Named::Joint,
            }),
        }
    }
    let bodies = model.bodies().iter().filter(|body| !body.nodes.is_empty());
    names.extend(bodies.map(|body| {
        // Of links the middle of the longest segment, of others the middle of all points.
        let span = |ends: [usize; 2]| ends.map(|node| Vector3::from(position(model, node)));
        let segments = body.segments.iter().map(|id| model.segments()[id.0].ends);
        let segments = segments.map(|ends| span(ends.map(|node| node.0)));
        let longest = segments.max_by(|a, b| {
            let length = |[from, to]: &[Vector3<f64>; 2]| (to - from).norm();
            length(a).total_cmp(&length(b))
        });
        let middle = match longest {
            Some([from, to]) => 0.5 * (from + to),
            None => {
                let nodes = body.nodes.iter().map(|node| position(model, node.0));
                nodes.map(Vector3::from).sum::<Vector3<f64>>() / body.nodes.len() as f64
            }
        };
        Name {
            at: middle.into(),
            text: body.name.clone(),
            of: Named::Body,
        }
    }));
    names
}

/// Forces and moments on points, in the axes of the configuration.
fn loads(model: &Model, case: Option<&str>) -> Vec<Arrow> {
    let loads: &[Load] = match case {
        None => model.loads(),
        Some(name) => {
            let found = model.cases().iter().find(|case| case.name == name);
            found.map_or(&[], |case| &case.loads.nodes)
        }
    };
    let arrows = loads.iter().flat_map(|load| {
        let turn = match load.axes {
            Axes::Body { body, home } => model.body_frame(body).map(|now| now * home.inverse()),
            _ => None,
        };
        let turned = move |v: Vector3<f64>| turn.map_or(v, |turn| turn * v);
        let parts = [
            (load.wrench.fixed_rows::<3>(0).into_owned(), false),
            (load.wrench.fixed_rows::<3>(3).into_owned(), true),
        ];
        let at = position(model, load.node.0);
        let acting = parts.into_iter().filter(|(part, _)| part.norm() > 0.0);
        acting.map(move |(part, moment)| Arrow {
            at,
            direction: turned(part).into(),
            moment,
        })
    });
    arrows.collect()
}

fn masses(model: &Model) -> Vec<Mass> {
    let masses = model.masses().iter();
    let shown = masses.map(|own| Mass {
        at: position(model, own.node.0),
        mass: own.mass.mass(),
    });
    shown.collect()
}

/// The frames of all joints.
fn frames(model: &Model) -> Vec<Frame> {
    let frames = model.joints().iter().zip(&model.geometry().frames);
    let shown = frames.filter_map(|(joint, frame)| {
        let node = joint.between.iter().flatten().next()?;
        let axis = |k: usize| frame.matrix().column(k).into_owned().into();
        Some(Frame {
            at: position(model, node.0),
            axes: [axis(0), axis(1), axis(2)],
        })
    });
    shown.collect()
}
