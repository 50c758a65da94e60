//! The mass of what moves.

use hyperstat_elements::{LineMass, Taper};
use hyperstat_model::{BodyId, Geometry, Model, Segment};

use crate::error::SolveError;
use crate::sets::Sets;

/// Mass \[kg\] of the bodies that can move, in a geometry of the model: of all beams and of the masses on
/// nodes, but for bodies that only joints without a free direction hold to the ground, such as a frame that
/// is bolted to it. A structure has none. Members whose length a pose changes, such as a piston in its
/// cylinder, count with the length that they have there.
///
/// # Errors
/// A geometry of another model; a beam among them whose material has no density.
pub fn moving_mass(model: &Model, geometry: &Geometry) -> Result<f64, SolveError> {
    model.check_size(geometry)?;
    let fixed = fixed(model);
    let mut total = 0.0;
    for segment in model.segments() {
        let BodyId(body) = segment.body;
        if !fixed[body] {
            let [a, b] = segment.ends.map(|node| geometry.positions[node.0]);
            total += of_segment(model, segment, (b - a).norm())?;
        }
    }
    let on_nodes = model.masses().iter();
    let moving = on_nodes.filter(|mass| !fixed[model.nodes()[mass.node.0].body.0]);
    Ok(total + moving.map(|mass| mass.mass.mass()).sum::<f64>())
}

fn of_segment(model: &Model, segment: &Segment, length: f64) -> Result<f64, SolveError> {
    let no_density = || SolveError::NoDensity {
        body: model.bodies()[segment.body.0].name.clone(),
    };
    let density = segment.material.density().ok_or_else(no_density)?;
    let taper = segment.change_of_section()?;
    let taper = taper.unwrap_or_else(|| Taper::constant(segment.section.clone()));
    Ok(LineMass::new(density, taper)?.total(length))
}

/// Of every body whether joints without a free direction hold it to the ground.
fn fixed(model: &Model) -> Vec<bool> {
    let bodies = model.bodies().len();
    // The ground is the last.
    let mut sets = Sets::new(bodies + 1);
    for joint in model.joints() {
        if joint.released().is_empty() {
            let [a, b] = (joint.between)
                .map(|node| node.map_or(bodies, |node| model.nodes()[node.0].body.0));
            sets.join(a, b);
        }
    }
    (0..bodies)
        .map(|body| sets.root(body) == sets.root(bodies))
        .collect()
}
