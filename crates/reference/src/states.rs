//! The states of a model: its own loads and each of its cases, with the weight and the
//! temperatures that act in all of them.

use hyperstat_model::{Axes, LoadSet, Model, SegmentId};
use nalgebra::{DVector, Rotation3, Vector3, Vector6};

use crate::along::Along;
use crate::beam::{Element, join};
use crate::error::ReferenceError;
use crate::structure::Structure;

/// What acts in one state.
#[derive(Debug, Clone)]
pub(crate) struct State {
    /// Wrenches on all nodes, the shares of loads along elements among them.
    pub loads: DVector<f64>,
    /// Deformations of the elements' rows without a force in them.
    pub deformations: DVector<f64>,
}

/// The model's own loads, then its cases.
///
/// # Errors
/// A load in axes of a body whose turn is not known, a beam without density that has weight.
pub(crate) fn states(model: &Model, structure: &Structure) -> Result<Vec<State>, ReferenceError> {
    let elements = &structure.elements;
    let mut always = State {
        loads: DVector::zeros(6 * structure.positions.len()),
        deformations: DVector::zeros(6 * elements.len()),
    };
    always.add_temperatures(model, elements);
    always.add_weight(model, elements)?;
    let sets = std::iter::once(model.load_set()).chain(model.cases().iter().map(|c| &c.loads));
    sets.map(|set| {
        let mut state = always.clone();
        state.add(model, elements, set)?;
        Ok(state)
    })
    .collect()
}

impl State {
    fn add(
        &mut self,
        model: &Model,
        elements: &[Element],
        set: &LoadSet,
    ) -> Result<(), ReferenceError> {
        for load in &set.nodes {
            let turn = rotation(model, &load.axes)?;
            self.add_on_node(load.node.0, &turned(&turn, &load.wrench));
        }
        for load in &set.lines {
            let turn = rotation(model, &load.axes)?;
            let [first, last] = load.ends.map(|end| turned(&turn, &end));
            self.add_along(model, elements, load.segment, |element| {
                let segment = &model.segments()[load.segment.0];
                Along::load(element, segment, |_, at| first * (1.0 - at) + last * at)
            });
        }
        Ok(())
    }

    fn add_temperatures(&mut self, model: &Model, elements: &[Element]) {
        for (k, segment) in model.segments().iter().enumerate() {
            let change = model.bodies()[segment.body.0].temperature;
            // A body has a temperature only where its materials expand.
            let strain = segment.material.expansion().unwrap_or(0.0) * change;
            if strain != 0.0 {
                self.add_along(model, elements, SegmentId(k), |element| {
                    Along::stretch(element, segment, strain)
                });
            }
        }
    }

    fn add_weight(&mut self, model: &Model, elements: &[Element]) -> Result<(), ReferenceError> {
        let gravity = model.gravity();
        if *gravity == Vector3::zeros() {
            return Ok(());
        }
        for mass in model.masses() {
            let weight = join(&(gravity * mass.mass.mass()), &Vector3::zeros());
            self.add_on_node(mass.node.0, &weight);
        }
        for (k, segment) in model.segments().iter().enumerate() {
            let Some(density) = segment.material.density() else {
                let body = model.bodies()[segment.body.0].name.clone();
                return Err(ReferenceError::NoDensity { body });
            };
            let weight = join(&(gravity * density), &Vector3::zeros());
            self.add_along(model, elements, SegmentId(k), |element| {
                Along::load(element, segment, |section, _| weight * section.area())
            });
        }
        Ok(())
    }

    /// What acts along every element of a segment.
    fn add_along(
        &mut self,
        model: &Model,
        elements: &[Element],
        SegmentId(segment): SegmentId,
        along: impl Fn(&Element) -> Along,
    ) {
        let before = model.segments()[..segment].iter();
        let first: usize = before.map(|s| s.elements.max(1)).sum();
        let count = model.segments()[segment].elements.max(1);
        for (k, element) in elements.iter().enumerate().skip(first).take(count) {
            let along = along(element);
            for (node, share) in element.nodes.iter().zip(&along.shares) {
                self.add_on_node(*node, share);
            }
            for (row, deformation) in along.deformations.iter().enumerate() {
                self.deformations[6 * k + row] += deformation;
            }
        }
    }

    fn add_on_node(&mut self, node: usize, wrench: &Vector6<f64>) {
        let mut block = self.loads.fixed_rows_mut::<6>(6 * node);
        block += wrench;
    }
}

/// Turn of a load's axes from the global ones. `home` means what [`Model::body_frame`] gave there,
/// so that the frame now is asked of it too.
fn rotation(model: &Model, axes: &Axes) -> Result<Rotation3<f64>, ReferenceError> {
    match axes {
        Axes::Global => Ok(Rotation3::identity()),
        Axes::Body { body, home } => match model.body_frame(*body) {
            Some(now) => Ok(now * home.inverse()),
            None => Err(ReferenceError::NoBodyFrame {
                body: model.bodies()[body.0].name.clone(),
            }),
        },
    }
}

fn turned(rotation: &Rotation3<f64>, wrench: &Vector6<f64>) -> Vector6<f64> {
    let part = |k: usize| -> Vector3<f64> { rotation * wrench.fixed_rows::<3>(k).into_owned() };
    join(&part(0), &part(3))
}
