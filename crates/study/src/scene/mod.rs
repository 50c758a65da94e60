//! A mechanism as it is drawn in space: bodies, joints, loads and masses with names, and the numbers of one
//! configuration, places and displacements, that change while the rest stays.

mod numbers;
mod parts;
mod section;

use hyperstat_assembly::{Floor, Mode, Model, Solution};
use serde::Serialize;

pub use numbers::{Layout, Span};
pub use parts::{
    SceneBody, SceneJoint, SceneLineLoad, SceneLoad, SceneMass, SceneNode, SceneSegment,
};
pub use section::SceneSection;

use crate::error::StudyError;
use crate::study::Study;

/// Pieces that the curve of a segment is drawn in, and vertices of all curves above which there are fewer.
const PIECES: usize = 12;
const MOST_VERTICES: usize = 60_000;

/// A mechanism as it is drawn. Field names are those of the JSON output. What lies at a node lies at the vertex
/// of its number: the nodes are the first vertices, the curves of the segments follow.
#[derive(Debug, Serialize)]
pub struct Scene {
    /// Name of the mechanism.
    pub name: String,
    /// Title of a figure of it.
    pub title: String,
    /// Its size \[m\].
    pub size: f64,
    /// Number of vertices.
    pub vertices: usize,
    /// Its nodes.
    pub nodes: Vec<SceneNode>,
    /// Its bodies.
    pub bodies: Vec<SceneBody>,
    /// Its beams.
    pub segments: Vec<SceneSegment>,
    /// Its joints.
    pub joints: Vec<SceneJoint>,
    /// Loads on nodes, those of all cases.
    pub loads: Vec<SceneLoad>,
    /// Loads along segments, those of all cases.
    pub lines: Vec<SceneLineLoad>,
    /// Masses on nodes.
    pub masses: Vec<SceneMass>,
    /// Acceleration of gravity \[m/s²\], where there is one.
    pub gravity: Option<[f64; 3]>,
    /// Node of the output.
    pub output: Option<usize>,
    /// Names of the cases.
    pub cases: Vec<String>,
    /// The case that the displacements are of; `None`: the loads of no case.
    pub case: Option<String>,
    /// Where the numbers are.
    pub layout: Layout,
}

/// How large a mechanism is \[m\].
pub(crate) fn size(model: &Model) -> f64 {
    Floor::of(model).map_or(1.0, |floor| floor.size)
}

impl Study {
    /// The mechanism as it is drawn, with its numbers: displaced under its loads, or those of a case, as
    /// in its solution; at rest without one.
    ///
    /// # Errors
    /// There is no such case.
    pub fn scene(
        &self,
        solution: Option<&Solution>,
        case: Option<&str>,
    ) -> Result<(Scene, Vec<f64>), StudyError> {
        let model = self.model();
        let loaded = solution.map(|solution| self.under(solution, case));
        let loaded = loaded.transpose()?;
        let (layout, numbers) = self.scene_numbers(loaded.as_deref())?;
        let pieces = pieces(model);
        let scene = Scene {
            name: model.name.clone(),
            title: self.title(case),
            size: size(model),
            vertices: vertices(model),
            nodes: parts::nodes(model),
            bodies: parts::bodies(model),
            segments: parts::segments(model, pieces),
            joints: parts::joints(model),
            loads: parts::loads(model),
            lines: parts::lines(model),
            masses: parts::masses(model),
            gravity: Some((*model.gravity()).into()).filter(|gravity| *gravity != [0.0; 3]),
            output: model.output().map(|node| node.0),
            cases: model.cases().iter().map(|case| case.name.clone()).collect(),
            case: case.map(Into::into),
            layout,
        };
        Ok((scene, numbers))
    }

    /// The numbers of the scene alone, of a solution that a case's displacements are taken from.
    pub(crate) fn scene_numbers(
        &self,
        loaded: Option<&Solution>,
    ) -> Result<(Layout, Vec<f64>), StudyError> {
        numbers::of(self.model(), loaded).map_err(|error| self.unsolvable(error))
    }

    /// Translations of all vertices of its scene in a natural mode, the largest of which is 1.
    pub(crate) fn mode_shape(&self, mode: &Mode) -> Result<Vec<f64>, StudyError> {
        numbers::of_mode(self.model(), mode).map_err(|error| self.unsolvable(error))
    }
}

/// Pieces of each segment: as many in each element, so that the nodes between them are vertices, as far as
/// there are not too many.
fn pieces(model: &Model) -> impl Fn(usize) -> usize {
    let segments = model.segments();
    let most = (MOST_VERTICES / segments.len().max(1)).clamp(1, PIECES);
    let counts: Vec<usize> = (segments.iter())
        .map(|segment| match segment.elements {
            elements if elements <= most => elements * (most / elements),
            _ => most,
        })
        .collect();
    move |segment| counts[segment]
}

/// Number of vertices of the scene of a model.
pub(crate) fn vertices(model: &Model) -> usize {
    let pieces = pieces(model);
    let curves = (0..model.segments().len()).map(|segment| pieces(segment) + 1);
    model.nodes().len() + curves.sum::<usize>()
}
