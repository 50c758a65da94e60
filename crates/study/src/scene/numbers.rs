//! The numbers of a scene: what is where in one configuration, and how it is displaced.

use hyperstat_assembly::{
    Axes, LineLoad, Load, LoadSet, Mode, Model, Segment, SegmentForces, SegmentId, Solution,
    SolveError, section_wrench, segment_displacement,
};
use hyperstat_elements::element_frame;
use hyperstat_elements::stress::section_stress;
use nalgebra::{Rotation3, Vector3, Vector6};
use serde::Serialize;

use super::pieces;

/// Where numbers begin, and how many there are.
pub type Span = [usize; 2];

/// Where the numbers of a scene are.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Layout {
    /// Three a vertex: where it is without load \[m\].
    pub positions: Span,
    /// Six a vertex: displacement \[m\] and rotation \[rad\].
    pub displacements: Span,
    /// One a vertex: the largest equivalent stress of the section there \[Pa\]; NaN where it is not known.
    pub stress: Span,
    /// Nine a segment: its local x, y and z in global axes.
    pub axes: Span,
    /// Nine a joint: its x, y and z in global axes.
    pub frames: Span,
    /// Six a load on a node: force \[N\] and moment \[N·m\], global axes.
    pub loads: Span,
    /// Twelve a load along a segment: the same per length at its first and second node.
    pub lines: Span,
}

/// The loads of no case, then those of every case.
pub(super) fn sets(model: &Model) -> impl Iterator<Item = (Option<&str>, &LoadSet)> {
    let cases = model.cases().iter();
    let cases = cases.map(|case| (Some(&*case.name), &case.loads));
    std::iter::once((None, model.load_set())).chain(cases)
}

/// The numbers of a model's configuration, under the loads of a solution.
///
/// # Errors
/// A segment that cannot be formed, which no segment of a model that was read is.
pub(super) fn of(
    model: &Model,
    loaded: Option<&Solution>,
) -> Result<(Layout, Vec<f64>), SolveError> {
    let curves = Curves::of(model);
    let mut all = Vec::new();
    let mut add = |numbers: &mut dyn FnMut(&mut Vec<f64>) -> Result<(), SolveError>| {
        let first = all.len();
        numbers(&mut all)?;
        Ok::<_, SolveError>([first, all.len() - first])
    };
    let geometry = model.geometry();
    let layout = Layout {
        positions: add(&mut |all| {
            all.extend(
                geometry
                    .positions
                    .iter()
                    .flat_map(|at| <[f64; 3]>::from(*at)),
            );
            curves.each(|id, xi| {
                let ends = model.segments()[id.0].ends;
                let [start, end] = ends.map(|node| geometry.positions[node.0]);
                all.extend(<[f64; 3]>::from(start.lerp(&end, xi)));
                Ok(())
            })
        })?,
        displacements: add(&mut |all| {
            let Some(loaded) = loaded else {
                all.resize(all.len() + 6 * curves.vertices(), 0.0);
                return Ok(());
            };
            let moved = &*loaded.displacements;
            all.extend(moved.iter().flat_map(|u| <[f64; 6]>::from(*u)));
            curves.each(|id, xi| {
                let load = loaded.segments.get(id.0).map(|forces| &forces.load);
                let moved = segment_displacement(model, geometry, moved, id, load, xi)?;
                all.extend(<[f64; 6]>::from(moved));
                Ok(())
            })
        })?,
        stress: add(&mut |all| {
            all.resize(all.len() + model.nodes().len(), f64::NAN);
            curves.each(|id, xi| {
                let forces = loaded.and_then(|loaded| loaded.segments.get(id.0));
                let stress = forces.and_then(|forces| stress(model, id, forces, xi));
                all.push(stress.unwrap_or(f64::NAN));
                Ok(())
            })
        })?,
        axes: add(&mut |all| {
            for (k, segment) in model.segments().iter().enumerate() {
                all.extend(columns(&frame(model, k, segment)?));
            }
            Ok(())
        })?,
        frames: add(&mut |all| {
            all.extend(geometry.frames.iter().flat_map(columns));
            Ok(())
        })?,
        loads: add(&mut |all| {
            let nodes = sets(model).flat_map(|(_, set)| &set.nodes);
            all.extend(nodes.flat_map(|load: &Load| turned(model, &load.axes, &load.wrench)));
            Ok(())
        })?,
        lines: add(&mut |all| {
            let lines = sets(model).flat_map(|(_, set)| &set.lines);
            let both = |load: &'_ LineLoad| load.ends.map(|end| turned(model, &load.axes, &end));
            all.extend(lines.flat_map(both).flatten());
            Ok(())
        })?,
    };
    Ok((layout, all))
}

/// Translations of all vertices in a mode, the largest of which is 1.
pub(super) fn of_mode(model: &Model, mode: &Mode) -> Result<Vec<f64>, SolveError> {
    let curves = Curves::of(model);
    let mut all = Vec::with_capacity(3 * curves.vertices());
    let mut largest = 0.0_f64;
    let mut add = |moved: &Vector6<f64>| {
        let own: Vector3<f64> = moved.fixed_rows::<3>(0).into();
        largest = largest.max(own.norm());
        all.extend(<[f64; 3]>::from(own));
    };
    mode.displacements.iter().for_each(&mut add);
    curves.each(|id, xi| {
        add(&mode.segment_displacement(model, id, xi)?);
        Ok(())
    })?;
    if largest > 0.0 {
        all.iter_mut().for_each(|own| *own /= largest);
    }
    Ok(all)
}

/// The places that segments are drawn at.
struct Curves {
    nodes: usize,
    pieces: Vec<usize>,
}

impl Curves {
    fn of(model: &Model) -> Self {
        Self {
            nodes: model.nodes().len(),
            pieces: (0..model.segments().len()).map(pieces(model)).collect(),
        }
    }

    fn vertices(&self) -> usize {
        self.nodes + self.pieces.iter().map(|pieces| pieces + 1).sum::<usize>()
    }

    /// Every place along every segment, in the order of the vertices.
    fn each(
        &self,
        mut found: impl FnMut(SegmentId, f64) -> Result<(), SolveError>,
    ) -> Result<(), SolveError> {
        for (segment, pieces) in self.pieces.iter().enumerate() {
            for k in 0..=*pieces {
                found(SegmentId(segment), k as f64 / *pieces as f64)?;
            }
        }
        Ok(())
    }
}

/// The largest equivalent stress of a section \[Pa\].
fn stress(model: &Model, id: SegmentId, forces: &SegmentForces, xi: f64) -> Option<f64> {
    let wrench = section_wrench(model, id, forces, xi)?;
    let segment = &model.segments()[id.0];
    let found = match segment.change_of_section() {
        Ok(Some(taper)) => section_stress(&taper.at(xi), &wrench),
        _ => section_stress(&segment.section, &wrench),
    };
    Some(found?.von_mises)
}

fn frame(model: &Model, place: usize, segment: &Segment) -> Result<Rotation3<f64>, SolveError> {
    let geometry = model.geometry();
    let [start, end] = segment.ends.map(|node| geometry.positions[node.0]);
    Ok(element_frame(
        &(end - start),
        geometry.y_axes[place].as_ref(),
    )?)
}

/// The axes of a frame, one after the other.
fn columns(frame: &Rotation3<f64>) -> [f64; 9] {
    let matrix = frame.matrix();
    std::array::from_fn(|k| matrix[(k % 3, k / 3)])
}

/// A wrench in global axes.
fn turned(model: &Model, axes: &Axes, wrench: &Vector6<f64>) -> [f64; 6] {
    let turn = axes.rotation(model, model.geometry()).unwrap_or_default();
    let part = |first: usize| turn * wrench.fixed_rows::<3>(first).into_owned();
    let (force, moment) = (part(0), part(3));
    [force.x, force.y, force.z, moment.x, moment.y, moment.z]
}
