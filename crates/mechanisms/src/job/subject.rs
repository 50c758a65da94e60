//! What a job is about: a mechanism of a file or a prebuilt one, with the job's loads.

use std::sync::OnceLock;

use hyperstat_model::{Model, ValuePlace};

use super::mover::Mover;
use super::poses::Poses;
use super::targets::{Asked, Targets};
use super::template::{Template, given, template};
use crate::error::LoadError;
use crate::file::include;
use crate::file::loads::Acting;
use crate::file::mechanism::Mechanism;
use crate::file::registry::{PrebuiltKind, Registry};
use crate::prebuilt::{Following, PoseCoordinate, PoseError, Prebuilt};
use crate::text::columns::Given;
use crate::text::fields::Fields;
use crate::text::fragment::Fragment;
use crate::text::scope::Scope;
use crate::text::source::Place;
use crate::text::tree::Node;
use crate::text::{named, names};

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
        /// Made for the first pose whose drives are asked for; none where loop closure cannot follow.
        following: OnceLock<Option<Box<Following>>>,
    },
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
        self.read_under([root; 2], [&self.acting; 2])
    }

    /// The same with what acts. Each as it is written, and with those of its values that are known in the
    /// places of expressions.
    pub(super) fn read_under(
        &self,
        [root, settled]: [&Node; 2],
        [acting, settled_acting]: [&Acting; 2],
    ) -> Result<Checked, LoadError> {
        match &self.kind {
            None => {
                let root = root.clone();
                let mut mechanism = Mechanism::read_settled(root, settled, &self.registry)?;
                mechanism.replace_settled(acting, settled_acting)?;
                Ok(Checked::File(Box::new(mechanism)))
            }
            Some(kind) => {
                let tree = Scope::tree(settled)?;
                let mechanism = kind.read(Fragment::of_node(&tree))?;
                let acting = Box::new(settled_acting.in_scope(root)?);
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
                let similar = similar.and_then(Subject::template_pose);
                let mut template = template(mechanism.as_ref(), poses, similar);
                if let Ok(template) = &mut template {
                    template.act(&acting)?;
                }
                Ok(Subject::Prebuilt {
                    mechanism,
                    template,
                    following: OnceLock::new(),
                })
            }
        }
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

    /// A pose that stands for those that are given later.
    pub(crate) fn no_pose(&self) -> Poses {
        match self {
            Self::Prebuilt(own, _) if !own.coordinates().is_empty() => Poses::List(vec![[0.0; 6]]),
            _ => Poses::Own,
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

    /// The pose of a prebuilt mechanism's model.
    fn template_pose(&self) -> Option<[f64; 6]> {
        match self {
            Self::Prebuilt {
                template: Ok(template),
                ..
            } => Some(template.pose),
            _ => None,
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
            ..
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
