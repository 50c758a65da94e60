//! A batch: jobs, each a mechanism in one or many poses.

use std::collections::HashMap;

use hyperstat_assembly::{Geometry, Model};

use crate::error::{LoadError, Location};
use crate::fields::Fields;
use crate::figures::{self, Figure};
use crate::fragment::{Fragment, first_at};
use crate::mechanism::Mechanism;
use crate::poses::{Given, Poses};
use crate::prebuilt::{PoseError, Prebuilt};
use crate::registry::Registry;
use crate::source::Place;
use crate::{load, loads, names, parameters};

/// The jobs of a batch file, in its order, all of them checked.
#[derive(Debug)]
#[non_exhaustive]
pub struct Batch {
    /// The jobs, at least one; their names are unique.
    pub jobs: Vec<Job>,
}

/// One job: a mechanism, its poses and the figures to draw.
#[derive(Debug)]
#[non_exhaustive]
pub struct Job {
    /// Name, the stem of its output files: letters, digits, `_`, `-` and `.`, not starting
    /// with `.`.
    pub name: String,
    /// Figures to draw, in the order of the file.
    pub figures: Vec<Figure>,
    subject: Subject,
    poses: Poses,
    place: Place,
}

#[derive(Debug)]
enum Subject {
    File(Mechanism),
    Prebuilt {
        mechanism: Box<dyn Prebuilt>,
        /// The model with its loads in the first pose that can be reached.
        template: Result<Model, PoseError>,
    },
}

impl Batch {
    /// Reads the value of a batch file.
    pub(crate) fn read(fragment: Fragment<'_>, registry: &Registry) -> Result<Self, LoadError> {
        let fields = Fields::read(fragment, "the batch", &["jobs"], &[])?;
        let list = fields.required("jobs")?;
        let mut seen = HashMap::new();
        let mut jobs = Vec::new();
        for fragment in list.list("a list of jobs, `[(name: …, mechanism: …)]`")? {
            let known = ["name", "mechanism", "poses", "loads", "figures"];
            let fields = Fields::read(fragment, "a job", &known, &[])?;
            let at = fields.required("name")?;
            let name = job_name(at)?;
            if let Some(first) = seen.insert(name.clone(), at) {
                return Err(at
                    .error(format!("two jobs have the name `{name}`"))
                    .with_help(first_at(first)));
            }
            jobs.push(Job::read(name, &fields, at.place(), registry)?);
        }
        if jobs.is_empty() {
            return Err(list.error("the batch has no jobs"));
        }
        Ok(Self { jobs })
    }
}

/// Reads a name that can be the stem of a file's name.
fn job_name(fragment: Fragment<'_>) -> Result<String, LoadError> {
    let name = fragment.string()?;
    let allowed = |c: char| c.is_alphanumeric() || "_-.".contains(c);
    if name.is_empty() || name.starts_with('.') || !name.chars().all(allowed) {
        return Err(fragment
            .error(format!("`{name}` cannot be the name of a job"))
            .with_help("a name is of letters, digits, `_`, `-` and `.`, not starting with `.`"));
    }
    Ok(name)
}

impl Job {
    fn read(
        name: String,
        fields: &Fields<'_>,
        place: Place,
        registry: &Registry,
    ) -> Result<Self, LoadError> {
        let (subject, poses) = subject(fields, registry)?;
        let figures = match fields.get("figures") {
            Some(list) => figures::read(list, poses.len())?,
            None => Vec::new(),
        };
        Ok(Self {
            name,
            figures,
            subject,
            poses,
            place,
        })
    }

    /// Number of poses, at least 1.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.poses.len()
    }

    /// The model with the job's loads, in the first pose that can be reached.
    ///
    /// # Errors
    /// Why pose 0 cannot be reached, where none can.
    pub fn model(&self) -> Result<Model, PoseError> {
        match &self.subject {
            Subject::File(mechanism) => Ok(mechanism.model.clone()),
            Subject::Prebuilt { template, .. } => template.clone(),
        }
    }

    /// Brings `geometry`, which belongs to a model of [`Job::model`], to `pose` (from 0);
    /// returns the output's whole pose x y z \[m\] and rotation vector rx ry rz \[rad\] from its
    /// home orientation.
    ///
    /// # Errors
    /// The pose cannot be reached; `geometry` is then as it was.
    ///
    /// # Panics
    /// If `pose` is not below [`Job::len`].
    pub fn place(&self, pose: usize, geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        match &self.subject {
            Subject::File(Mechanism { model, .. }) => {
                let own = model.geometry();
                geometry.positions.clone_from(&own.positions);
                geometry.y_axes.clone_from(&own.y_axes);
                geometry.frames.clone_from(&own.frames);
                let output = model.output().map(|node| own.positions[node.0]);
                let [x, y, z] = output.unwrap_or_default().into();
                Ok([x, y, z, 0.0, 0.0, 0.0])
            }
            Subject::Prebuilt { mechanism, .. } => {
                let (target, count) = given(mechanism.as_ref(), &self.poses.get(pose));
                mechanism.place(&target[..count], geometry)
            }
        }
    }

    /// The numbers given for a pose (from 0), x y z \[m\] and rotation vector \[rad\]; zero where
    /// none is given.
    ///
    /// # Panics
    /// If `pose` is not below [`Job::len`].
    pub fn target(&self, pose: usize) -> [f64; 6] {
        self.poses.get(pose)
    }

    /// The mechanism, where it comes from a file; its loads are the job's.
    pub fn mechanism(&self) -> Option<&Mechanism> {
        match &self.subject {
            Subject::File(mechanism) => Some(mechanism),
            Subject::Prebuilt { .. } => None,
        }
    }

    /// Place of the job's name in the batch file.
    pub fn location(&self) -> Location {
        self.place.location()
    }
}

/// Reads the mechanism of a job with its loads, and its poses.
fn subject(fields: &Fields<'_>, registry: &Registry) -> Result<(Subject, Poses), LoadError> {
    let whole = fields.required("mechanism")?;
    let poses = fields.get("poses");
    let expected = "a mechanism, `File(\"file.ron\")` or a prebuilt one";
    let (kind, arguments) = whole.variant(expected)?;
    match kind.text() {
        "File" => {
            let expected = "one path, `File(\"file.ron\")`";
            let arguments = arguments.ok_or_else(|| whole.expected(expected))?;
            let [path] = arguments.array(expected)?;
            if let Some(poses) = poses {
                return Err(poses
                    .error("a mechanism of a file takes no poses")
                    .with_help("leave `poses` out: the job has the configuration in the file"));
            }
            let mut mechanism = load::mechanism_of(path, registry)?;
            if let Some(list) = fields.get("loads") {
                mechanism.replace_loads(list)?;
            }
            Ok((Subject::File(mechanism), Poses::Own))
        }
        name if parameters::KINDS.contains(&name) => {
            let mechanism = parameters::read(name, whole, arguments)?;
            let poses = prebuilt_poses(poses, mechanism.as_ref(), whole)?;
            let template = template(mechanism.as_ref(), &poses, fields.get("loads"))?;
            let subject = Subject::Prebuilt {
                mechanism,
                template,
            };
            Ok((subject, poses))
        }
        other => {
            let known = std::iter::once("File").chain(parameters::KINDS);
            Err(kind
                .error(format!("unknown mechanism `{other}`"))
                .with_help(names::help(other, "mechanisms", known)))
        }
    }
}

fn prebuilt_poses(
    poses: Option<Fragment<'_>>,
    mechanism: &dyn Prebuilt,
    whole: Fragment<'_>,
) -> Result<Poses, LoadError> {
    let given = Given {
        kind: mechanism.kind(),
        coordinates: mechanism.coordinates(),
    };
    match (poses, given.coordinates.len()) {
        (None, 0) => Ok(Poses::Own),
        (Some(poses), 0) => Err(poses
            .error(format!("`{}` takes no poses", given.kind))
            .with_help("leave `poses` out")),
        (Some(poses), _) => Poses::read(poses, &given),
        (None, _) => Err(whole
            .error(format!("`{}` needs `poses`", given.kind))
            .with_help("add `poses: List([(x, y, z)])`, `Csv(\"file.csv\")` or `Grid(…)`")),
    }
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

/// The model of the first pose that can be reached, with its loads; the first pose's error
/// where none can.
fn template(
    mechanism: &dyn Prebuilt,
    poses: &Poses,
    loads: Option<Fragment<'_>>,
) -> Result<Result<Model, PoseError>, LoadError> {
    let build = |pose| {
        let (target, count) = given(mechanism, &poses.get(pose));
        mechanism.model(&target[..count])
    };
    let mut template = build(0);
    for pose in 1..poses.len() {
        if template.is_ok() {
            break;
        }
        template = build(pose).or(template);
    }
    if let (Ok(model), Some(list)) = (&mut template, loads) {
        loads::read(list, model)?;
    }
    Ok(template)
}
