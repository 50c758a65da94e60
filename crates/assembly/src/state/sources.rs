//! What acts in one state, as it is before any configuration: the one description that both passes
//! read.

use hyperstat_elements::{BeamLoad, LineMass, TemperatureChange};
use hyperstat_model::{Axes, Directions, JointId, LineLoad, LoadSet, Model, NodeId, SegmentId};
use nalgebra::{Vector3, Vector6};

use super::preload::loose_preload;
use crate::error::SolveError;

/// What acts together.
#[derive(Debug, Default)]
pub(crate) struct Sources<'m> {
    /// On nodes, preloads first.
    pub wrenches: Vec<Wrench<'m>>,
    /// Along segments.
    pub along: Vec<(SegmentId, Along<'m>)>,
    /// Whether the misfits of the model's joints act.
    pub misfits: bool,
}

/// A wrench on a node, about that node.
#[derive(Debug)]
pub(crate) struct Wrench<'m> {
    pub node: NodeId,
    /// Force (N) and moment (N·m).
    pub wrench: Vector6<f64>,
    pub axes: WrenchAxes<'m>,
}

/// What the components of a wrench are along.
#[derive(Debug, Clone, Copy)]
pub(crate) enum WrenchAxes<'m> {
    /// Axes of a load.
    Load(&'m Axes),
    /// Directions of a joint, whose preload it is.
    Preload(JointId),
}

/// What acts along a segment.
#[derive(Debug)]
pub(crate) enum Along<'m> {
    Line(&'m LineLoad),
    /// The mass that the model's gravity acts on.
    Weight(LineMass),
    /// A change of temperature, the same in all axes.
    Heat(BeamLoad),
}

impl<'m> Sources<'m> {
    /// A set of loads alone.
    pub fn of_set(set: &'m LoadSet) -> Self {
        let wrench = |load: &'m hyperstat_model::Load| Wrench {
            node: load.node,
            wrench: load.wrench,
            axes: WrenchAxes::Load(&load.axes),
        };
        let line = |load: &'m LineLoad| (load.segment, Along::Line(load));
        Self {
            wrenches: set.nodes.iter().map(wrench).collect(),
            along: set.lines.iter().map(line).collect(),
            misfits: false,
        }
    }

    /// What acts in every state: misfits and preloads, weight and temperatures.
    ///
    /// # Errors
    /// A weight without density.
    pub fn always(model: &'m Model) -> Result<Self, SolveError> {
        let mut sources = Self {
            misfits: !model.misfits().is_empty(),
            ..Self::default()
        };
        for entry in model.misfits() {
            let joint = &model.joints()[entry.joint.0];
            let preload = loose_preload(&Directions::of(joint), entry);
            if preload == Vector6::zeros() {
                continue;
            }
            let sides = joint.between.iter().zip([-preload, preload]);
            let sides = sides.filter_map(|(node, wrench)| Some(((*node)?, wrench)));
            sources.wrenches.extend(sides.map(|(node, wrench)| Wrench {
                node,
                wrench,
                axes: WrenchAxes::Preload(entry.joint),
            }));
        }
        let gravity = model.gravity();
        let heavy = *gravity != Vector3::zeros();
        for mass in model.masses().iter().filter(|_| heavy) {
            let force = gravity * mass.mass.mass();
            sources.wrenches.push(Wrench {
                node: mass.node,
                wrench: Vector6::new(force.x, force.y, force.z, 0.0, 0.0, 0.0),
                axes: WrenchAxes::Load(&Axes::Global),
            });
        }
        for (k, segment) in model.segments().iter().enumerate() {
            let id = SegmentId(k);
            let temperature = model.bodies()[segment.body.0].temperature;
            if temperature != 0.0 {
                let expansion = segment.material.expansion().unwrap_or(0.0);
                let change = TemperatureChange {
                    uniform: temperature,
                    ..TemperatureChange::default()
                };
                let heat = BeamLoad::temperature(expansion, &change);
                sources.along.push((id, Along::Heat(heat)));
            }
            if heavy {
                let density = segment.material.density();
                let density = density.ok_or_else(|| SolveError::NoDensity {
                    body: model.bodies()[segment.body.0].name.clone(),
                })?;
                let mass = LineMass::new(density, segment.sections_along()?)?;
                sources.along.push((id, Along::Weight(mass)));
            }
        }
        Ok(sources)
    }

    /// Whether nothing acts.
    pub fn is_empty(&self) -> bool {
        self.wrenches.is_empty() && self.along.is_empty() && !self.misfits
    }
}
