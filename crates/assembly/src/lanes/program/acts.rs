//! What acts, as the lanes form it at every pose: wrenches and displacements of six numbers each, in
//! global axes.

use hyperstat_elements::LoadFlexibility;
use hyperstat_model::{Model, SegmentId, to_directions, unit_beam};
use nalgebra::{Rotation3, Vector3, Vector6};

use super::inputs::{Inputs, Point, Turned};
use crate::state::sources::{Along, Wrench, WrenchAxes};

/// Place of six numbers among all that acts.
pub(crate) type Act = usize;

/// What is formed at every pose.
#[derive(Debug, Default)]
pub(crate) struct Acts {
    pub list: Vec<Formed>,
    /// Sixes in all.
    pub count: usize,
}

/// What forms sixes, with the place of the first of them.
#[derive(Debug)]
pub(crate) struct Formed {
    pub first: Act,
    pub kind: FormedKind,
}

#[derive(Debug)]
pub(crate) enum FormedKind {
    /// The same at all poses.
    Constant(Vector6<f64>),
    /// Two vectors of the inputs; none is zero.
    Turned([Option<usize>; 2]),
    /// What acts along a beam: the resultant about its first node, and the displacement of its second
    /// one with the first held.
    Beam(LoadedBeam),
}

/// A beam with what acts along it.
#[derive(Debug)]
pub(crate) struct LoadedBeam {
    pub ends: [Point; 2],
    /// Direction of local y (a place in the inputs); `None` where it bends alike in all directions.
    pub y_axis: Option<usize>,
    pub parts: Vec<LoadPart>,
    /// Strain along it that no force makes.
    pub strain: f64,
}

/// A load that keeps its direction along a beam.
#[derive(Debug)]
pub(crate) struct LoadPart {
    /// Force per length.
    pub force: Direction,
    /// Moment per length, where there is any.
    pub moment: Option<Direction>,
    pub flexibility: LoadFlexibility,
}

/// A vector in global axes.
#[derive(Debug)]
pub(crate) enum Direction {
    Constant(Vector3<f64>),
    /// A vector of the inputs.
    Input(usize),
}

impl Acts {
    fn push(&mut self, kind: FormedKind) -> Act {
        let first = self.count;
        self.count += match kind {
            FormedKind::Beam(_) => 2,
            _ => 1,
        };
        self.list.push(Formed { first, kind });
        first
    }

    /// A wrench on a node.
    pub fn wrench(&mut self, model: &Model, source: &Wrench<'_>, inputs: &mut Inputs) -> Act {
        let turned = match source.axes {
            WrenchAxes::Load(axes) => Turned::by_axes(axes),
            WrenchAxes::Preload(joint) => Some(Turned::Joint(joint)),
        };
        let Some(turned) = turned else {
            return self.push(FormedKind::Constant(source.wrench));
        };
        let wrench = match source.axes {
            WrenchAxes::Load(_) => source.wrench,
            WrenchAxes::Preload(joint) => {
                let basis = model.joints()[joint.0].joint.basis();
                let to_directions = to_directions(&basis, &Rotation3::identity());
                to_directions.transpose() * source.wrench
            }
        };
        self.turned(turned, &wrench, inputs)
    }

    /// Six numbers in axes that turn.
    pub fn turned(&mut self, by: Turned, six: &Vector6<f64>, inputs: &mut Inputs) -> Act {
        let parts = [six.fixed_rows::<3>(0), six.fixed_rows::<3>(3)];
        let places = parts.map(|part| {
            let part = part.into_owned();
            (part != Vector3::zeros()).then(|| inputs.turned(by.clone(), part))
        });
        self.push(FormedKind::Turned(places))
    }

    /// What acts along a segment: the resultant about its first node (`None` where it is none for
    /// certain), and the displacement of its second one. `None` where it is no beam.
    pub fn along(
        &mut self,
        model: &Model,
        id: SegmentId,
        sources: &[&Along<'_>],
        inputs: &mut Inputs,
    ) -> Option<(Option<Act>, Act)> {
        let unit = unit_beam(model, id)?;
        let ends = model.segments()[id.0].ends;
        let mut beam = LoadedBeam {
            ends: ends.map(|node| inputs.point(node)),
            y_axis: None,
            parts: Vec::new(),
            strain: 0.0,
        };
        for source in sources {
            match source {
                Along::Heat(load) => beam.strain += load.free_strain().axial,
                Along::Weight(mass) => beam.parts.push(LoadPart {
                    force: Direction::Constant(*model.gravity()),
                    moment: None,
                    flexibility: LoadFlexibility::of(unit.straight(), mass.distribution()),
                }),
                Along::Line(load) => {
                    for (end, distribution) in [[1.0, 0.5, 0.0], [0.0, 0.5, 1.0]].iter().enumerate()
                    {
                        let own = load.ends[end];
                        let [force, moment] = [0, 3].map(|k| own.fixed_rows::<3>(k).into_owned());
                        let mut direction = |v: Vector3<f64>| match Turned::by_axes(&load.axes) {
                            None => Direction::Constant(v),
                            Some(by) => Direction::Input(inputs.turned(by, v)),
                        };
                        if own != Vector6::zeros() {
                            beam.parts.push(LoadPart {
                                force: direction(force),
                                moment: (moment != Vector3::zeros()).then(|| direction(moment)),
                                flexibility: LoadFlexibility::of(unit.straight(), *distribution),
                            });
                        }
                    }
                }
            }
        }
        let round = |part: &LoadPart| part.flexibility.planes[0] == part.flexibility.planes[1];
        if !beam.parts.iter().all(round) {
            beam.y_axis = Some(inputs.y_axis(id, ends));
        }
        let pulls = !beam.parts.is_empty();
        let first = self.push(FormedKind::Beam(beam));
        Some((pulls.then_some(first), first + 1))
    }
}
