//! A batch: jobs, each a mechanism in one or many poses.

use std::collections::HashMap;

use hyperstat_assembly::{Geometry, Model};

use crate::error::{LoadError, Location};
use crate::fields::Fields;
use crate::figures::{self, Figure};
use crate::fragment::{Fragment, first_at};
use crate::mechanism::Mechanism;
use crate::poses::{Given, Poses};
use crate::prebuilt::{PoseCoordinate, PoseError, Prebuilt};
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
    /// Name, the stem of its output files: ASCII letters, digits, `_`, `-` and `.`, not starting
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
        /// The model with its loads in a pose that can be reached.
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
            if let Some((first, other)) = seen.insert(name.to_lowercase(), (at, name.clone())) {
                return Err(same_name(at, &name, first, &other));
            }
            jobs.push(Job::read(name, &fields, at.place(), registry)?);
        }
        if jobs.is_empty() {
            return Err(list
                .error("the batch has no jobs")
                .with_help("give at least one, `[(name: \"…\", mechanism: File(\"file.ron\"))]`"));
        }
        Ok(Self { jobs })
    }
}

/// The error of the name `at`, which makes the same files as the one `first`.
fn same_name(at: Fragment<'_>, name: &str, first: Fragment<'_>, other: &str) -> LoadError {
    if name == other {
        return at
            .error(format!("two jobs have the name `{name}`"))
            .with_help(first_at(first));
    }
    at.error(format!(
        "the names `{other}` and `{name}` differ only in case"
    ))
    .with_help("give one of them another name: some file systems take them for the same file")
}

/// Reads a name that can be the stem of a file's name.
fn job_name(fragment: Fragment<'_>) -> Result<String, LoadError> {
    let name = fragment.string()?;
    let allowed = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
    if name.is_empty() || name.starts_with('.') || !name.chars().all(allowed) {
        return Err(fragment
            .error(format!("`{name}` cannot be the name of a job"))
            .with_help(
                "a name is of the letters a to z and A to Z, digits, `_`, `-` and `.`, not starting \
                 with `.`",
            ));
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

    /// The model with the job's loads, in pose 0 or, where that cannot be reached, in another pose
    /// that can, which need not be one of the job's.
    ///
    /// # Errors
    /// Why pose 0 cannot be reached, where no other pose was found.
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
                geometry.rotations.clone_from(&own.rotations);
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
        name => {
            let Some(prebuilt) = parameters::find(name) else {
                let known = parameters::KINDS.iter().map(|kind| kind.name);
                let known = std::iter::once("File").chain(known);
                return Err(kind
                    .error(format!("unknown mechanism `{name}`"))
                    .with_help(names::help(name, "mechanisms", known)));
            };
            let mechanism = parameters::read(prebuilt, whole, arguments)?;
            let poses = prebuilt_poses(poses, mechanism.as_ref(), whole)?;
            let template = template(mechanism.as_ref(), &poses, fields.get("loads"))?;
            let subject = Subject::Prebuilt {
                mechanism,
                template,
            };
            Ok((subject, poses))
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

/// The model with its loads in the first of these poses that can be reached: the job's first
/// [`TRIED`] poses, the poses of [`probes`], the rest of the job's; the first pose's error where
/// none can. The loads are checked in a pose that the job does not have, too: the names of a
/// mechanism are the same in every pose.
fn template(
    mechanism: &dyn Prebuilt,
    poses: &Poses,
    loads: Option<Fragment<'_>>,
) -> Result<Result<Model, PoseError>, LoadError> {
    let build = |pose: [f64; 6]| {
        let (target, count) = given(mechanism, &pose);
        mechanism.model(&target[..count])
    };
    let first = poses.len().min(TRIED);
    let tried = (1..first).map(|pose| poses.get(pose));
    let rest = (first..poses.len()).map(|pose| poses.get(pose));
    let mut others = tried.chain(probes(mechanism.coordinates())).chain(rest);
    let mut template =
        build(poses.get(0)).or_else(|error| others.find_map(|pose| build(pose).ok()).ok_or(error));
    if let (Ok(model), Some(list)) = (&mut template, loads) {
        loads::read(list, model)?;
    }
    Ok(template)
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
