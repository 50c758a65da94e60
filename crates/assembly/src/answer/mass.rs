//! The mass of what moves.

use hyperstat_elements::LineMass;
use hyperstat_model::{BodyId, Geometry, Model, NodeId, Segment};

use crate::error::SolveError;
use crate::sets::Sets;

/// What moves of a mechanism, and its mass: all beams and the masses on nodes, but for bodies that only joints
/// without a free direction hold to the ground, such as a frame that is bolted to it. A structure has none.
#[derive(Debug, Clone)]
pub struct MovingMass {
    /// Masses on nodes \[kg\].
    on_nodes: f64,
    /// Ends of the segments, and their mass per length \[kg/m\].
    segments: Vec<([NodeId; 2], f64)>,
}

impl MovingMass {
    /// Of a mechanism, in every configuration of it.
    ///
    /// # Errors
    /// A beam that moves, whose material has no density.
    pub fn new(model: &Model) -> Result<Self, SolveError> {
        let fixed = fixed(model);
        let moves = |body: BodyId| !fixed[body.0];
        let segments = model
            .segments()
            .iter()
            .filter(|segment| moves(segment.body));
        let segments = segments.map(|segment| Ok((segment.ends, per_length(model, segment)?)));
        let masses = model.masses().iter();
        let moving = masses.filter(|mass| moves(model.nodes()[mass.node.0].body));
        Ok(Self {
            on_nodes: moving.map(|mass| mass.mass.mass()).sum(),
            segments: segments.collect::<Result<_, SolveError>>()?,
        })
    }

    /// It in a geometry of the model \[kg\]. Members whose length a pose changes, such as a piston in its
    /// cylinder, count with the length that they have there.
    pub fn at(&self, geometry: &Geometry) -> f64 {
        let mass = |(ends, per_length): &([NodeId; 2], f64)| {
            let [a, b] = ends.map(|node| geometry.positions[node.0]);
            per_length * (b - a).norm()
        };
        self.on_nodes + self.segments.iter().map(mass).sum::<f64>()
    }
}

/// Mean mass per length of a segment \[kg/m\].
fn per_length(model: &Model, segment: &Segment) -> Result<f64, SolveError> {
    let no_density = || SolveError::NoDensity {
        body: model.bodies()[segment.body.0].name.clone(),
    };
    let density = segment.material.density().ok_or_else(no_density)?;
    Ok(LineMass::new(density, segment.sections_along()?)?.total(1.0))
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
