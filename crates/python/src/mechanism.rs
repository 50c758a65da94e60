//! A mechanism as Python holds it: of a file, or of a job in one of its designs.

use std::path::PathBuf;

use hyperstat_study::{
    Asked, Disk, Input, Job, JobMechanism, JobPoses, Mechanism, Question, Registry, Selection,
    Study,
};
use numpy::{PyArrayDyn, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::arrays::array;
use crate::error::{Ended, apart};
use crate::given::{self, Given};
use crate::gradient;
use crate::joint::{self, JointKind};
use crate::kept::{Kept, unforked};
use crate::pose::{Pose, PoseGiven, Ready};
use crate::sweep::{Asking, Found, Varied};
use crate::watched::watched;

/// A mechanism.
#[pyclass(frozen, module = "hyperstat._hyperstat")]
pub(crate) struct Core {
    subject: Subject,
    /// The file that it is from, in messages.
    path: PathBuf,
    /// Kinds of joints and mechanisms that it may be of.
    pub(crate) registry: Registry,
    /// Whether it is a design of a job as it was read.
    design_of_job: bool,
    /// What was worked out of it.
    study: Kept<Study>,
    ready: Kept<Ready>,
}

enum Subject {
    File(Box<Mechanism>),
    Job {
        job: Box<Job>,
        design: usize,
        /// One of its poses; none yet of a mechanism that has none.
        pose: Option<usize>,
    },
}

/// Reads a file.
#[pyfunction]
pub(crate) fn load(
    py: Python<'_>,
    path: PathBuf,
    job: Option<String>,
    design: Option<usize>,
    pose: Option<usize>,
    joints: Vec<Bound<'_, JointKind>>,
) -> PyResult<Core> {
    let registry = joint::registry(&joints);
    apart(py, || {
        let read = hyperstat_study::load(&path, &Disk, &registry)?;
        Core::of(read, path, Selection { job, design, pose }, registry)
    })
}

/// Reads a text, which messages call `path`.
#[pyfunction]
pub(crate) fn parse(
    py: Python<'_>,
    text: &str,
    path: PathBuf,
    job: Option<String>,
    design: Option<usize>,
    pose: Option<usize>,
    joints: Vec<Bound<'_, JointKind>>,
) -> PyResult<Core> {
    let registry = joint::registry(&joints);
    apart(py, || {
        let read = hyperstat_study::load_str(text, &path, &Disk, &registry)?;
        Core::of(read, path, Selection { job, design, pose }, registry)
    })
}

/// A prebuilt mechanism, as it is written in a job, without a pose.
#[pyfunction]
pub(crate) fn prebuilt(py: Python<'_>, text: String, name: String) -> PyResult<Core> {
    apart(py, || {
        let written = JobMechanism::Written(text);
        let registry = Registry::builtin();
        let job = Job::new(&name, written, JobPoses::Later, &registry)?;
        let own = job.commanded().is_empty().then_some(0);
        Ok(Core::of_job(job, 0, own, name.into(), registry))
    })
}

#[pymethods]
impl Core {
    /// The JSON of `solve`.
    #[allow(clippy::too_many_arguments)]
    fn solve(
        slf: &Bound<'_, Self>,
        verify: bool,
        all_nodes: bool,
        modes: Option<usize>,
        mass: Option<&str>,
        why: bool,
        case: Option<String>,
        along: Option<&str>,
        direction: Option<[f64; 3]>,
        allow_free: bool,
    ) -> PyResult<String> {
        let (own, py) = (slf.clone().unbind(), slf.py());
        let along = given::along(along, direction).map_err(|error| error.raised(py))?;
        let mass = mass.map(given::mass).transpose();
        let mass = mass.map_err(|error| error.raised(py))?;
        watched(py, None, move |_| {
            let question = Question {
                verify,
                all_nodes,
                modes,
                mass,
                why: why.then_some(Asked { case, along }),
            };
            own.get().asked(|study| {
                let answered = study.answer(&question)?;
                let free = study.free_output(&answered.solution);
                if let Some(error) = free.filter(|_| !allow_free) {
                    return Err(error.into());
                }
                json(&answered.report)
            })
        })
    }

    /// The JSON of `check`.
    fn check(slf: &Bound<'_, Self>) -> PyResult<String> {
        let own = slf.clone().unbind();
        watched(slf.py(), None, move |_| {
            own.get().asked(|study| json(&study.check().0))
        })
    }

    /// VTU, for ParaView and pyvista.
    fn vtu(slf: &Bound<'_, Self>) -> PyResult<String> {
        let own = slf.clone().unbind();
        watched(slf.py(), None, move |_| {
            own.get().asked(|study| {
                let solution = study.solve()?;
                Ok(study.vtu(&solution, None)?)
            })
        })
    }

    /// As a mechanism file, in RON or JSON.
    fn written(&self, py: Python<'_>, as_json: bool) -> PyResult<String> {
        apart(py, || {
            self.asked(|study| {
                Ok(match as_json {
                    true => study.mechanism_file_json(&self.registry)?,
                    false => study.mechanism_file(&self.registry)?,
                })
            })
        })
    }

    /// The same with other values in some places.
    fn with_values(&self, py: Python<'_>, values: Vec<(String, Given)>) -> PyResult<Self> {
        let values = given::values(values);
        apart(py, || {
            Ok(match &self.subject {
                Subject::File(mechanism) => Self::new(
                    Subject::File(Box::new(mechanism.with_values(&values)?)),
                    self,
                ),
                Subject::Job { job, design, pose } => {
                    let job = job.with_values(*design, &values)?;
                    self.with_job(job, *pose)
                }
            })
        })
    }

    /// The same with other fields of a job, in JSON.
    fn with_fields(&self, py: Python<'_>, fields: Vec<(String, String)>) -> PyResult<Self> {
        apart(py, || {
            let job = self.job_with(&fields)?;
            Ok(self.with_job(job, self.pose()))
        })
    }

    /// The same in another pose.
    fn in_pose(&self, py: Python<'_>, pose: PoseGiven<'_>) -> PyResult<Self> {
        let pose = pose.owned();
        apart(py, || {
            pose.check()?;
            let mut job = self.job()?;
            job.set_poses(pose.poses())?;
            Ok(self.with_job(job, Some(0)))
        })
    }

    /// One pose, as a row of a sweep.
    fn at(&self, py: Python<'_>, pose: PoseGiven<'_>) -> PyResult<Pose> {
        let pose = pose.owned();
        apart(py, || {
            pose.check()?;
            let mut own = match self.ready.take() {
                Some(own) => own,
                None => {
                    let of_file = matches!(self.subject, Subject::File(_));
                    let job = self.job()?;
                    match unforked(|| Ready::new(job, &pose, of_file))? {
                        Ok(own) => own,
                        Err(unreached) => return Ok(unreached),
                    }
                }
            };
            let found = own.at(&pose);
            self.ready.put(own);
            found
        })
    }

    /// A sweep over these poses, or over its own, of these designs.
    #[allow(clippy::too_many_arguments)]
    fn sweep(
        slf: &Bound<'_, Self>,
        poses: Option<(Vec<String>, PyReadonlyArray2<'_, f64>)>,
        fields: Vec<(String, String)>,
        designs: Option<Vec<(String, Vec<Given>)>>,
        rows: Option<(usize, usize)>,
        threads: usize,
        one_by_one: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Found> {
        let poses = poses.map(|(columns, rows)| given::poses(columns, &rows));
        let designs = designs.map(|designs| {
            let each = |(path, values): (String, Vec<Given>)| {
                (path, values.into_iter().map(Into::into).collect())
            };
            designs.into_iter().map(each).collect::<Vec<_>>()
        });
        let own = slf.clone().unbind();
        let found = watched(slf.py(), progress.as_ref(), move |watch| {
            let own = own.get();
            let asking = Asking {
                rows,
                threads,
                one_by_one,
            };
            match (&own.subject, poses, &designs) {
                (Subject::Job { job, design, pose }, None, None) if fields.is_empty() => {
                    pose.ok_or_else(Ended::unposed)?;
                    let first = design * job.len();
                    asking.run(job, first..first + job.len(), own.varied(), watch)
                }
                (_, poses, designs) => {
                    let mut job = own.job_with(&fields)?;
                    match poses {
                        Some(poses) => job.set_poses(poses)?,
                        None => {
                            own.posed()?;
                        }
                    }
                    let varied = match designs {
                        Some(designs) => {
                            let designs: Vec<_> = (designs.iter())
                                .map(|(path, values): &(String, Vec<_>)| (&**path, values.clone()))
                                .collect();
                            job.set_vary(&designs, true)?;
                            Varied::of(&job, 0..job.designs())
                        }
                        None => own.varied(),
                    };
                    let rows = 0..job.designs() * job.len();
                    asking.run(&job, rows, varied, watch)
                }
            }
        })?;
        found.handed_over(slf.py())
    }

    /// A quantity and its derivatives by the values at these paths, in these poses or in its own; NaN where
    /// a pose has no result.
    #[allow(clippy::type_complexity)]
    fn value_and_gradient<'py>(
        slf: &Bound<'py, Self>,
        quantity: String,
        paths: Vec<String>,
        poses: Option<(Vec<String>, PyReadonlyArray2<'_, f64>)>,
        case: Option<String>,
        threads: usize,
    ) -> PyResult<(Bound<'py, PyArrayDyn<f64>>, Bound<'py, PyArrayDyn<f64>>)> {
        let poses = poses.map(|(columns, rows)| given::poses(columns, &rows));
        let (own, py) = (slf.clone().unbind(), slf.py());
        let count = paths.len();
        let (values, slopes) = watched(py, None, move |watch| {
            let own = own.get();
            let job = match poses {
                Some(poses) => {
                    let mut job = own.job()?;
                    job.set_poses(poses)?;
                    job
                }
                None => {
                    own.posed()?;
                    own.job()?
                }
            };
            gradient::of(&job, &quantity, &paths, case.as_deref(), threads, watch)
        })?;
        let shape = [values.len(), count];
        Ok((array(py, values, &shape[..1])?, array(py, slopes, &shape)?))
    }

    /// The numbers at these paths, as `vary` names them.
    fn numbers(&self, py: Python<'_>, paths: Vec<String>) -> PyResult<Vec<f64>> {
        apart(py, || {
            let job = self.job()?;
            let number = |path: &String| Ok(job.number_at(0, path)?);
            paths.iter().map(number).collect()
        })
    }

    /// Name, job, design and pose.
    fn called(&self) -> (String, Option<String>, Option<usize>, Option<usize>) {
        match &self.subject {
            Subject::File(mechanism) => (mechanism.model.name.clone(), None, None, None),
            Subject::Job { job, design, pose } => {
                let model = job.model().ok();
                let name = model.map_or_else(|| job.name.clone(), |model| model.name);
                let design = (job.designs() > 1).then_some(*design);
                (name, Some(job.name.clone()), design, *pose)
            }
        }
    }

    /// Numbers of designs and of poses that it has of its own, and names of its cases.
    fn counts(&self) -> (usize, usize, Vec<String>) {
        match &self.subject {
            Subject::File(mechanism) => {
                let cases = mechanism.model.cases().iter();
                (1, 1, cases.map(|case| case.name.clone()).collect())
            }
            Subject::Job { job, pose, .. } => {
                let poses = pose.map_or(0, |_| job.len());
                (job.designs(), poses, job.cases().to_vec())
            }
        }
    }

    /// The file that it is from.
    fn path(&self) -> PathBuf {
        self.path.clone()
    }
}

impl Core {
    fn of(
        read: Input,
        path: PathBuf,
        selection: Selection,
        registry: Registry,
    ) -> Result<Self, Ended> {
        match read {
            Input::Batch(batch) => {
                let job = selection.job_of(batch, &path)?;
                let (design, pose) = (selection.design.unwrap_or(0), selection.pose.unwrap_or(0));
                // What is out of range is told at once, what is out of reach when it is asked for.
                if design >= job.designs() || pose >= job.len() {
                    Study::of_job(job.clone(), design, pose)?;
                }
                Ok(Self {
                    design_of_job: true,
                    ..Self::of_job(job, design, Some(pose), path, registry)
                })
            }
            // It says what of a selection a mechanism file does not have.
            mechanism => {
                let study = Study::of(mechanism, &path, &selection)?;
                let own = study.mechanism().cloned().ok_or_else(Ended::unposed)?;
                Ok(Self {
                    subject: Subject::File(Box::new(own)),
                    path,
                    registry,
                    design_of_job: false,
                    study: Kept::of(study),
                    ready: Kept::none(),
                })
            }
        }
    }

    fn of_job(
        job: Job,
        design: usize,
        pose: Option<usize>,
        path: PathBuf,
        registry: Registry,
    ) -> Self {
        let job = Box::new(job);
        Self {
            subject: Subject::Job { job, design, pose },
            path,
            registry,
            design_of_job: false,
            study: Kept::none(),
            ready: Kept::none(),
        }
    }

    fn new(subject: Subject, like: &Self) -> Self {
        Self {
            subject,
            path: like.path.clone(),
            registry: like.registry.clone(),
            design_of_job: false,
            study: Kept::none(),
            ready: Kept::none(),
        }
    }

    /// The first design of a job that was made of it.
    fn with_job(&self, job: Job, pose: Option<usize>) -> Self {
        let (path, registry) = (self.path.clone(), self.registry.clone());
        Self::of_job(job, 0, pose, path, registry)
    }

    /// What its job varies, in its design.
    fn varied(&self) -> Varied {
        match &self.subject {
            Subject::Job { job, design, .. } if self.design_of_job => {
                Varied::of(job, *design..*design + 1)
            }
            _ => Varied::default(),
        }
    }

    fn pose(&self) -> Option<usize> {
        match &self.subject {
            Subject::File(_) => Some(0),
            Subject::Job { pose, .. } => *pose,
        }
    }

    fn posed(&self) -> Result<usize, Ended> {
        self.pose().ok_or_else(Ended::unposed)
    }

    /// A job of it alone, in the poses that it has.
    fn job(&self) -> Result<Job, Ended> {
        Ok(match &self.subject {
            Subject::File(mechanism) => {
                let own = JobMechanism::Loaded(mechanism.clone());
                Job::new("mechanism", own, JobPoses::Own, &self.registry)?
            }
            Subject::Job { job, design, .. } => match job.varied() {
                [] => (**job).clone(),
                _ => job.with_values(*design, &[] as &[(&str, f64)])?,
            },
        })
    }

    pub(crate) fn job_with(&self, fields: &[(String, String)]) -> Result<Job, Ended> {
        let mut job = self.job()?;
        for (field, value) in fields {
            job.set_json(field, value)?;
        }
        Ok(job)
    }

    /// Asks the study of it, which is made when it is first asked.
    pub(crate) fn asked<T>(
        &self,
        ask: impl FnOnce(&mut Study) -> Result<T, Ended>,
    ) -> Result<T, Ended> {
        let mut study = match self.study.take() {
            Some(study) => study,
            None => unforked(|| match &self.subject {
                Subject::File(mechanism) => {
                    let mechanism = Input::Mechanism((**mechanism).clone());
                    Ok(Study::of(mechanism, &self.path, &Selection::default())?)
                }
                Subject::Job { job, design, .. } => {
                    let study = Study::of_job((**job).clone(), *design, self.posed()?)?;
                    Ok::<_, Ended>(study)
                }
            })?,
        };
        let answer = ask(&mut study);
        self.study.put(study);
        answer
    }
}

fn json(report: &impl serde::Serialize) -> Result<String, Ended> {
    serde_json::to_string(report)
        .map_err(|error| Ended::argument(error.to_string(), "ask for less"))
}
