//! A model as nodes, elements and rows: every body's every node with six coordinates of its own.

use hyperstat_model::{BodyKind, Geometry, JointId, Model, NodeId};
use nalgebra::{DVector, Point3, Vector3, Vector6};

use crate::beam::{Element, join, segment_frame};
use crate::error::ReferenceError;
use crate::flexible::FlexibleElement;
use crate::joint::JointConditions;
use crate::row::Row;

/// Most displacement coordinates that a dense matrix is made for.
const COORDINATE_LIMIT: usize = 4800;

/// Most conditions of rigid bodies and joints, of which the matrix has a row and column each too.
const CONDITION_LIMIT: usize = 9600;

/// All that the dense solvers need of a model.
#[derive(Debug)]
pub(crate) struct Structure {
    /// Positions [m]: the model's nodes, then the inner nodes of subdivided segments.
    pub positions: Vec<Point3<f64>>,
    /// Beam elements.
    pub elements: Vec<Element>,
    /// Flexible bodies.
    pub flexibles: Vec<FlexibleElement>,
    /// Conditions that make each rigid body move as one (Eq. 37), a row a component.
    pub rigid_bodies: Vec<Row>,
    /// Joints, by `JointId`.
    pub joints: Vec<JointConditions>,
    /// Output node.
    pub output: usize,
    /// Wrenches on all nodes under the joints' preloads.
    pub preloads: DVector<f64>,
    /// Diagonal of the box around all nodes [m]; 1 where they coincide.
    pub size: f64,
}

impl Structure {
    /// Reads a model.
    ///
    /// # Errors
    /// No output, a model that is not one whole, more coordinates or conditions than the limit, a
    /// segment without frame, a joint whose
    /// directions are not independent.
    pub fn new(model: &Model) -> Result<Self, ReferenceError> {
        let NodeId(output) = model.output().ok_or(ReferenceError::NoOutput)?;
        model.check()?;
        check_size(model)?;
        let geometry = model.geometry();
        let (positions, elements) = elements(model, geometry)?;
        let mut joints = Vec::with_capacity(model.joints().len());
        for (k, (connection, frame)) in model.joints().iter().zip(&geometry.frames).enumerate() {
            let joint = JointConditions::new(connection, frame, model.misfit(JointId(k)));
            joints.push(joint.ok_or_else(|| ReferenceError::JointBasis {
                joint: connection.name.clone(),
            })?);
        }
        let mut preloads = DVector::zeros(6 * positions.len());
        for (node, wrench) in joints.iter().flat_map(JointConditions::preloads) {
            let mut block = preloads.fixed_rows_mut::<6>(6 * node);
            block += wrench;
        }
        Ok(Self {
            size: size(&positions),
            positions,
            preloads,
            elements,
            flexibles: flexibles(model)?,
            rigid_bodies: rigid_bodies(model),
            joints,
            output,
        })
    }

    /// Rows of all deformations of elastic bodies.
    pub fn deformations(&self) -> Vec<Row> {
        let beams = self.elements.iter().flat_map(Element::deformations);
        let flexibles = self.flexibles.iter().flat_map(|f| f.deformations.clone());
        beams.chain(flexibles).collect()
    }

    /// The six rows that are the output's displacement.
    pub fn output_rows(&self) -> Vec<Row> {
        let unit = |component| (self.output, Vector6::ith(component, 1.0));
        (0..6).map(|c| Row::rigid(vec![unit(c)])).collect()
    }
}

fn check_size(model: &Model) -> Result<(), ReferenceError> {
    let inner = |total: usize, elements: usize| total.saturating_add(elements.saturating_sub(1));
    let segments = model.segments().iter();
    let nodes = (segments.map(|s| s.elements)).fold(model.nodes().len(), inner);
    let coordinates = nodes.saturating_mul(6);
    if coordinates > COORDINATE_LIMIT {
        return Err(ReferenceError::TooLarge {
            coordinates,
            limit: COORDINATE_LIMIT,
        });
    }
    // A rigid body with n nodes has 6 (n − 1), a joint 6 at the most.
    let bodies = model.bodies().iter();
    let rigid = bodies.filter(|body| body.kind == BodyKind::Rigid);
    let followers: usize = rigid.map(|body| body.nodes.len().saturating_sub(1)).sum();
    let conditions = 6 * (followers + model.joints().len());
    if conditions > CONDITION_LIMIT {
        return Err(ReferenceError::TooManyConditions {
            conditions,
            limit: CONDITION_LIMIT,
        });
    }
    Ok(())
}

fn elements(
    model: &Model,
    geometry: &Geometry,
) -> Result<(Vec<Point3<f64>>, Vec<Element>), ReferenceError> {
    let mut positions = geometry.positions.clone();
    let mut elements = Vec::new();
    for (k, segment) in model.segments().iter().enumerate() {
        let [first, last] = segment.ends.map(|node| node.0);
        let span = positions[last] - positions[first];
        let frame = segment_frame(&span, geometry.y_axes[k].as_ref());
        let frame = frame.ok_or_else(|| segment_error(model, k))?;
        let count = segment.elements.max(1);
        let along = |step: usize| step as f64 / count as f64;
        let mut from = first;
        for step in 1..=count {
            let to = if step == count {
                last
            } else {
                positions.push(positions[first] + span * along(step));
                positions.len() - 1
            };
            let part = [along(step - 1), along(step)];
            elements.push(Element::new([from, to], segment, frame, span.norm(), part));
            from = to;
        }
    }
    Ok((positions, elements))
}

fn segment_error(model: &Model, segment: usize) -> ReferenceError {
    let body = &model.bodies()[model.segments()[segment].body.0];
    let first = body.segments.first().map_or(segment, |first| first.0);
    ReferenceError::Segment {
        body: body.name.clone(),
        segment: segment - first,
    }
}

fn flexibles(model: &Model) -> Result<Vec<FlexibleElement>, ReferenceError> {
    let elements = model.flexibles().iter().map(|flexible| {
        let body = &model.bodies()[flexible.body.0];
        let element = FlexibleElement::new(model, flexible);
        element.ok_or_else(|| ReferenceError::Flexible {
            body: body.name.clone(),
        })
    });
    elements.collect()
}

fn rigid_bodies(model: &Model) -> Vec<Row> {
    let positions = &model.geometry().positions;
    let mut rows = Vec::new();
    let rigid = |kind| kind == BodyKind::Rigid;
    for body in model.bodies().iter().filter(|body| rigid(body.kind)) {
        let Some((NodeId(first), others)) = body.nodes.split_first() else {
            continue;
        };
        for NodeId(node) in others {
            let arm = positions[*node] - positions[*first];
            rows.extend((0..6).map(|component| {
                let held = Vector6::ith(component, 1.0);
                Row::rigid(vec![(*node, held), (*first, -carried(&arm, &held))])
            }));
        }
    }
    rows
}

/// Coefficients on the displacement of a rigid body's reference node that equal the coefficients
/// `at_node` on a node at `arm` from it: `u = [E, −[arm×]; 0, E] u_reference`.
pub(crate) fn carried(arm: &Vector3<f64>, at_node: &Vector6<f64>) -> Vector6<f64> {
    let (linear, angular) = (at_node.fixed_rows::<3>(0), at_node.fixed_rows::<3>(3));
    let moment: Vector3<f64> = arm.cross(&linear);
    join(&linear.into_owned(), &(angular + moment))
}

fn size(positions: &[Point3<f64>]) -> f64 {
    let Some(first) = positions.first() else {
        return 1.0;
    };
    let (low, high) = positions
        .iter()
        .fold((*first, *first), |(low, high), p| (low.inf(p), high.sup(p)));
    let diagonal = (high - low).norm();
    if diagonal > 0.0 { diagonal } else { 1.0 }
}
