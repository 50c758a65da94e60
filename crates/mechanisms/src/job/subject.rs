//! What a job is about: a mechanism of a file or a prebuilt one, with the job's loads.

use std::ops::Range;
use std::sync::OnceLock;

use hyperstat_closure::Target;
use hyperstat_model::{Geometry, LANES, Model, NodeId, ValuePlace};
use nalgebra::{Rotation3, Vector3};

use super::mover::{Mover, Placing};
use super::poses::Poses;
use super::targets::{Asked, Targets};
use crate::error::LoadError;
use crate::file::home::Home;
use crate::file::include;
use crate::file::loads::Acting;
use crate::file::mechanism::Mechanism;
use crate::file::registry::{PrebuiltKind, Registry};
use crate::prebuilt::{PoseCoordinate, PoseError, Prebuilt};
use crate::text::columns::Given;
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;
use crate::text::scope::Scope;
use crate::text::source::Place;
use crate::text::tree::Node;
use crate::text::{csv, named, names};

/// Where a job's mechanism and loads are written, and how they are read.
#[derive(Debug, Clone)]
pub(crate) struct Recipe {
    /// The mechanism: the value of its file, or the prebuilt one in the job, with the parameters of the
    /// batch and of the job.
    pub(super) root: Node,
    /// The same without them.
    pub(super) own: Node,
    /// The parameters of the batch, and of the job.
    pub(super) shared: Option<Node>,
    pub(super) given: Option<Node>,
    /// Kind of a prebuilt mechanism; `None` is a file.
    pub(super) kind: Option<PrebuiltKind>,
    pub(super) acting: Acting,
    pub(super) registry: Registry,
}

/// A mechanism that is read and checked.
#[derive(Debug)]
pub(crate) enum Checked {
    /// Of a file, with the job's loads.
    File(Box<Mechanism>),
    /// Prebuilt, not yet built.
    Prebuilt(Box<dyn Prebuilt>, Box<Acting>),
}

/// A mechanism with its loads.
#[derive(Debug)]
pub(crate) enum Subject {
    File {
        mechanism: Box<Mechanism>,
        /// Made for the first pose that is asked.
        mover: OnceLock<Box<Mover>>,
    },
    Prebuilt {
        mechanism: Box<dyn Prebuilt>,
        /// The model with its loads in a pose that can be reached.
        template: Result<Box<Template>, PoseError>,
    },
}

/// A model in a pose that can be reached.
#[derive(Debug)]
pub(crate) struct Template {
    model: Model,
    pose: [f64; 6],
}

impl Recipe {
    /// Finds the mechanism and the loads of a job.
    pub(crate) fn find(
        fields: &Fields<'_>,
        shared: Option<&Node>,
        registry: &Registry,
    ) -> Result<Self, LoadError> {
        let whole = fields.required("mechanism")?;
        let expected = "a mechanism, `File(\"file.ron\")` or a prebuilt one";
        let (name, arguments) = whole.variant(expected)?;
        let (root, kind) = if name.text() == "File" {
            let expected = "one path, `File(\"file.ron\")`";
            let arguments = arguments.ok_or_else(|| whole.expected(expected))?;
            let [path] = arguments.array(expected)?;
            let place = named::mechanism_at(path)?;
            (include::mechanism(Fragment::at(&place))?, None)
        } else {
            let Some(kind) = registry.prebuilt(name.text()) else {
                let known = std::iter::once("File").chain(registry.prebuilts());
                return Err(name
                    .error(format!("unknown mechanism `{}`", name.text()))
                    .with_help(names::help(name.text(), "mechanisms", known)));
            };
            (Node::of(whole), Some(kind.clone()))
        };
        let recipe = Self {
            own: root.clone(),
            root,
            shared: shared.cloned(),
            given: None,
            kind,
            acting: Acting::find(fields),
            registry: registry.clone(),
        };
        recipe.with_fields(fields)
    }

    /// A mechanism that a program hands in, of a `kind` if it is prebuilt, and what acts on it.
    pub(crate) fn of(
        root: Node,
        kind: Option<PrebuiltKind>,
        fields: &Fields<'_>,
        registry: &Registry,
    ) -> Self {
        Self {
            own: root.clone(),
            root,
            shared: None,
            given: None,
            kind,
            acting: Acting::find(fields),
            registry: registry.clone(),
        }
    }

    /// The mechanism as it is written.
    pub(crate) fn root(&self) -> &Node {
        &self.root
    }

    /// Names of the cases, which do not depend on what varies; `subject` is any design.
    pub(crate) fn cases(&self, subject: &Subject) -> Result<Vec<String>, LoadError> {
        let of_file = || {
            let model = subject.mechanism().map(|mechanism| &mechanism.model);
            let cases = model.map_or(&[][..], Model::cases).iter();
            cases.map(|case| case.name.clone()).collect()
        };
        Ok(self.acting.cases()?.unwrap_or_else(of_file))
    }

    /// Reads and checks the mechanism: [`Recipe::root`], or that with other values in some places.
    pub(crate) fn read(&self, root: &Node) -> Result<Checked, LoadError> {
        match &self.kind {
            None => {
                let mut mechanism = Mechanism::read(root.clone(), &self.registry)?;
                mechanism.replace(&self.acting)?;
                Ok(Checked::File(Box::new(mechanism)))
            }
            Some(kind) => {
                let tree = Scope::tree(root)?;
                let mechanism = kind.read(Fragment::of_node(&tree))?;
                let acting = Box::new(self.acting.in_scope(root)?);
                Ok(Checked::Prebuilt(mechanism, acting))
            }
        }
    }

    /// Puts the loads on a mechanism, in a pose that it reaches: one of `poses` or, if it can, the
    /// pose of `similar`.
    pub(crate) fn load(
        &self,
        checked: Checked,
        poses: &Poses,
        similar: Option<&Subject>,
    ) -> Result<Subject, LoadError> {
        match checked {
            Checked::File(mechanism) => Ok(Subject::of(mechanism)),
            Checked::Prebuilt(mechanism, acting) => {
                let mut template = template(mechanism.as_ref(), poses, similar);
                if let Ok(template) = &mut template {
                    let home = Home::Output(template.turned(mechanism.as_ref()));
                    acting.read(&mut template.model, &home)?;
                }
                Ok(Subject::Prebuilt {
                    mechanism,
                    template,
                })
            }
        }
    }
}

impl Template {
    /// The rotation of the output from its home orientation.
    fn turned(&self, mechanism: &dyn Prebuilt) -> Rotation3<f64> {
        let (target, count) = given(mechanism, &self.pose);
        let mut geometry = self.model.geometry().clone();
        // It has been reached before.
        let pose = mechanism.place(&target[..count], &mut geometry);
        let [.., x, y, z] = pose.unwrap_or(self.pose);
        Rotation3::new(Vector3::new(x, y, z))
    }
}

impl Checked {
    /// Reads the poses of a job of this mechanism.
    pub(crate) fn poses(&self, fields: &Fields<'_>) -> Result<Poses, LoadError> {
        let mechanism = match self {
            Self::Prebuilt(mechanism, _) => mechanism,
            Self::File(mechanism) => {
                return match fields.get("poses") {
                    None => Ok(Poses::Own),
                    Some(poses) => Targets::read(poses, &mechanism.model).map(Poses::Asked),
                };
            }
        };
        let given = Given {
            kind: mechanism.kind(),
            coordinates: mechanism.coordinates(),
        };
        match (fields.get("poses"), given.coordinates.len()) {
            (None, 0) => Ok(Poses::Own),
            (Some(poses), 0) => Err(given.takes_none(&poses.place())),
            (Some(poses), _) => Poses::read(poses, &given),
            (None, _) => Err(given.needs_some(&fields.required("mechanism")?.place())),
        }
    }

    /// The poses that a program asks of it: `columns` of `rows`; `whole` is the argument, `at` names a
    /// part of it.
    pub(crate) fn poses_of(
        &self,
        columns: &[String],
        rows: &[f64],
        whole: &Place,
        at: impl Fn(&str) -> Place,
    ) -> Result<Poses, LoadError> {
        match self {
            Self::File(mechanism) => {
                Targets::table(columns, rows, &mechanism.model, whole, at).map(Poses::Asked)
            }
            Self::Prebuilt(mechanism, _) => {
                let given = Given {
                    kind: mechanism.kind(),
                    coordinates: mechanism.coordinates(),
                };
                if given.coordinates.is_empty() {
                    return Err(given.takes_none(whole));
                }
                Poses::table(columns, rows, &given, whole, at)
            }
        }
    }

    /// The mechanism's own configuration as its only pose; `mechanism` is where it stands.
    pub(crate) fn own_pose(&self, mechanism: &Place) -> Result<Poses, LoadError> {
        match self {
            Self::Prebuilt(own, _) if !own.coordinates().is_empty() => {
                let given = Given {
                    kind: own.kind(),
                    coordinates: own.coordinates(),
                };
                Err(given.needs_some(mechanism))
            }
            _ => Ok(Poses::Own),
        }
    }
}

impl Subject {
    /// A mechanism of a file.
    pub(crate) fn of(mechanism: Box<Mechanism>) -> Self {
        Self::File {
            mechanism,
            mover: OnceLock::new(),
        }
    }

    /// The model in a pose that can be reached.
    pub(crate) fn model(&self) -> Result<Model, PoseError> {
        match self {
            Self::File { mechanism, .. } => Ok(mechanism.model.clone()),
            Self::Prebuilt { template, .. } => match template {
                Ok(template) => Ok(template.model.clone()),
                Err(error) => Err(error.clone()),
            },
        }
    }

    /// Which parameter every value of a prebuilt mechanism's model comes from; nothing is known of one
    /// that reaches no pose, and of a file here.
    pub(crate) fn origins(&self) -> Vec<(ValuePlace, String)> {
        let Self::Prebuilt {
            mechanism,
            template: Ok(template),
        } = self
        else {
            return Vec::new();
        };
        let (target, count) = given(mechanism.as_ref(), &template.pose);
        mechanism.origins(&target[..count]).unwrap_or_default()
    }

    /// The coordinates of pose `number` (from 0) that are known of every design before it is reached:
    /// those that are asked for, and those that are zero in all poses.
    pub(crate) fn target(&self, poses: &Poses, number: usize) -> [Option<f64>; 6] {
        match (self, poses) {
            (_, Poses::Asked(targets)) => match targets.get(number) {
                Asked::Output(asked) => asked,
                Asked::Drives(_) => [None; 6],
            },
            (Self::File { .. }, _) => [None; 6],
            (Self::Prebuilt { mechanism, .. }, _) => {
                let given = poses.get(number);
                let mut known = [None; 6];
                for coordinate in mechanism.zero_coordinates() {
                    known[coordinate.index()] = Some(0.0);
                }
                for coordinate in mechanism.coordinates() {
                    known[coordinate.index()] = Some(given[coordinate.index()]);
                }
                known
            }
        }
    }

    /// Brings a geometry of its model to pose `number` (from 0); returns the whole pose.
    pub(crate) fn place(
        &self,
        poses: &Poses,
        number: usize,
        geometry: &mut Geometry,
    ) -> Result<[f64; 6], PoseError> {
        match self {
            Self::File { mechanism, mover } => {
                if let Poses::Asked(targets) = poses {
                    return moved(mechanism, mover).place(targets, number, geometry);
                }
                let model = &mechanism.model;
                let own = model.geometry();
                geometry.positions.clone_from(&own.positions);
                geometry.y_axes.clone_from(&own.y_axes);
                geometry.frames.clone_from(&own.frames);
                geometry.rotations.clone_from(&own.rotations);
                Ok(own_pose(model))
            }
            Self::Prebuilt { mechanism, .. } => {
                let (target, count) = given(mechanism.as_ref(), &poses.get(number));
                mechanism.place(&target[..count], geometry)
            }
        }
    }

    /// The same for several geometries, each with a pose of its own.
    pub(crate) fn place_lanes(
        &self,
        poses: &Poses,
        range: Range<usize>,
        geometries: &mut [Geometry],
        placing: &mut Placing,
    ) -> [Option<Result<[f64; 6], PoseError>>; LANES] {
        match self {
            Self::File { mechanism, mover } => {
                if let Poses::Asked(targets) = poses {
                    let mover = moved(mechanism, mover);
                    return mover.place_lanes(targets, range, geometries, placing);
                }
                let mut placed = [const { None }; LANES];
                for (lane, pose) in range.enumerate() {
                    placed[lane] = Some(self.place(poses, pose, &mut geometries[lane]));
                }
                placed
            }
            Self::Prebuilt { mechanism, .. } => {
                let mut targets = [[0.0; 6]; LANES];
                for (target, pose) in targets.iter_mut().zip(range.clone()) {
                    *target = given(mechanism.as_ref(), &poses.get(pose)).0;
                }
                mechanism.place_lanes(&targets[..range.len()], geometries)
            }
        }
    }

    /// Brings a geometry of its model to a target; returns the whole pose.
    pub(crate) fn bring(
        &self,
        target: &Target<'_>,
        geometry: &mut Geometry,
        placing: &mut Placing,
    ) -> Result<[f64; 6], PoseError> {
        match (self, target) {
            (Self::File { mechanism, mover }, _) => {
                moved(mechanism, mover).bring(target, geometry, placing)
            }
            (Self::Prebuilt { mechanism, .. }, Target::Output(asked)) => {
                let (target, count) = followed(mechanism.as_ref(), asked)?;
                mechanism.place(&target[..count], geometry)
            }
            (Self::Prebuilt { mechanism, .. }, Target::Drives(_)) => Err(PoseError::Drives {
                kind: mechanism.kind().into(),
            }),
        }
    }

    /// The coordinates that a prebuilt mechanism takes; none of a file.
    pub(crate) fn coordinates(&self) -> &[PoseCoordinate] {
        match self {
            Self::File { .. } => &[],
            Self::Prebuilt { mechanism, .. } => mechanism.coordinates(),
        }
    }

    /// The mechanism, where it comes from a file.
    pub(crate) fn mechanism(&self) -> Option<&Mechanism> {
        match self {
            Self::File { mechanism, .. } => Some(mechanism),
            Self::Prebuilt { .. } => None,
        }
    }
}

/// The output's pose in a model's own configuration.
fn own_pose(model: &Model) -> [f64; 6] {
    let position = |node: NodeId| model.geometry().positions[node.0];
    let [x, y, z] = model.output().map(position).unwrap_or_default().into();
    [x, y, z, 0.0, 0.0, 0.0]
}

/// What moves a mechanism of a file.
fn moved<'m>(mechanism: &Mechanism, mover: &'m OnceLock<Box<Mover>>) -> &'m Mover {
    mover.get_or_init(|| Box::new(Mover::new(&mechanism.model)))
}

/// Of what is asked of the output the coordinates that `mechanism` is given, first, and their number:
/// all that it takes, and zeros alone of the others, as in a table of poses.
fn followed(
    mechanism: &dyn Prebuilt,
    asked: &[Option<f64>; 6],
) -> Result<([f64; 6], usize), PoseError> {
    let coordinates = mechanism.coordinates();
    let asks = |coordinate: &&PoseCoordinate| asked[coordinate.index()].is_some();
    let found = coordinates.iter().filter(asks).count();
    if found < coordinates.len() {
        return Err(PoseError::Coordinates {
            kind: mechanism.kind().into(),
            expected: coordinates.len(),
            found,
        });
    }
    let follows = |index| coordinates.iter().any(|own| own.index() == index);
    for (index, name) in csv::COLUMNS.iter().enumerate() {
        if asked[index].is_some_and(|value| value != 0.0) && !follows(index) {
            return Err(PoseError::Unreachable {
                what: format!("`{}` cannot follow {name}", mechanism.kind()),
            });
        }
    }
    Ok(given(mechanism, &asked.map(Option::unwrap_or_default)))
}

/// Of a whole pose the coordinates that `mechanism` is given, first, and their number.
fn given(mechanism: &dyn Prebuilt, pose: &[f64; 6]) -> ([f64; 6], usize) {
    let coordinates = mechanism.coordinates();
    let mut target = [0.0; 6];
    for (value, coordinate) in target.iter_mut().zip(coordinates) {
        *value = pose[coordinate.index()];
    }
    (target, coordinates.len())
}

/// The model in the first of these poses that can be reached: the job's first [`TRIED`] poses, that
/// of a `similar` design, the poses of [`probes`], the rest of the job's; the first pose's error
/// where none can. The loads are checked in a pose that the job does not have, too: the names of a
/// mechanism are the same in every pose.
fn template(
    mechanism: &dyn Prebuilt,
    poses: &Poses,
    similar: Option<&Subject>,
) -> Result<Box<Template>, PoseError> {
    let build = |pose: [f64; 6]| {
        let (target, count) = given(mechanism, &pose);
        let model = mechanism.model(&target[..count])?;
        Ok(Box::new(Template { model, pose }))
    };
    let reached = match similar {
        Some(Subject::Prebuilt { template, .. }) => template.as_ref().ok().map(|t| t.pose),
        _ => None,
    };
    let first = poses.len().min(TRIED);
    let tried = (1..first).map(|pose| poses.get(pose)).chain(reached);
    let rest = (first..poses.len()).map(|pose| poses.get(pose));
    let mut others = tried.chain(probes(mechanism.coordinates())).chain(rest);
    build(poses.get(0)).or_else(|error| others.find_map(|pose| build(pose).ok()).ok_or(error))
}

/// Number of poses of a job that are tried before any other: a large grid may be out of reach.
const TRIED: usize = 1000;

/// Poses of which a mechanism of any size between a millimetre and a kilometre is likely to reach
/// one: home, and one coordinate at a time on either side of it, by steps of 3 %.
fn probes(coordinates: &[PoseCoordinate]) -> impl Iterator<Item = [f64; 6]> {
    let values = || (0..=468).flat_map(|k| [1.0, -1.0].map(|sign| sign * 1e-3 * 1.03_f64.powi(k)));
    let moved = coordinates.iter().flat_map(move |coordinate| {
        values().map(|value| {
            let mut pose = [0.0; 6];
            pose[coordinate.index()] = value;
            pose
        })
    });
    std::iter::once([0.0; 6]).chain(moved)
}
