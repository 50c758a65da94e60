//! What changes while a mechanism is moved: the answer to one pose after another.

use hyperstat_assembly::{Geometry, JointId, ModalOptions, ModalPlan, Solution};
use hyperstat_joints::Dof;
use hyperstat_mechanisms::{Drive, Placing, PoseError, Target};
use serde::Serialize;

use super::loaded::Subject;
use super::refused::{Refusal, Refused};
use super::request::PoseAsked;
use crate::answer::{Asked, BudgetReport, MeasuresReport, Rows, rows};
use crate::entries::Entries;
use crate::error::StudyError;
use crate::scene::Layout;
use crate::schema::COORDINATES;
use crate::study::Study;
use crate::sweep::{Failure, placing};

/// Natural frequencies that are told where nobody says how many.
const FREQUENCIES: usize = 3;

/// What is found at a pose. Field names are those of the JSON.
#[derive(Debug, Default, Serialize)]
pub struct Frame {
    /// The word for the outcome, as in tables.
    pub status: &'static str,
    /// Why it is not `ok`.
    pub problem: Option<Refusal>,
    /// The whole pose of the output, where it is reached.
    pub pose: Option<[f64; 6]>,
    /// Values of the drives, where they are known.
    pub drives: Option<Entries<f64>>,
    /// Stiffness of the output.
    pub stiffness: Option<Rows>,
    /// Its displacement.
    pub displacement: Option<[f64; 6]>,
    /// Length of its translation \[m\].
    pub deflection: Option<f64>,
    /// Angle of its rotation \[rad\].
    pub rotation: Option<f64>,
    /// Principal stiffnesses and compliances.
    pub principal: Option<MeasuresReport>,
    /// The largest stress.
    pub stress: Option<Stressed>,
    /// Natural frequencies \[Hz\]; none without mass.
    pub frequencies: Vec<f64>,
    /// Where the deflection comes from.
    pub budget: Option<BudgetReport>,
    /// Where the numbers of the scene are; none where the pose is not reached.
    pub layout: Option<Layout>,
}

/// The largest equivalent stress.
#[derive(Debug, Serialize)]
pub struct Stressed {
    /// The body.
    pub body: String,
    /// \[Pa\]
    pub value: f64,
    /// That over the yield strength, where the material has one.
    pub utilisation: Option<f64>,
}

/// Where a pose is.
#[derive(Debug, Default, Serialize)]
pub struct Placed {
    /// The word for the outcome, as in tables.
    pub status: &'static str,
    /// Why it is not `ok`.
    pub problem: Option<Refusal>,
    /// The whole pose of the output.
    pub pose: Option<[f64; 6]>,
    /// Values of the drives, where they are known.
    pub drives: Option<Entries<f64>>,
}

/// A mechanism that is moved, and what is kept from pose to pose.
#[derive(Debug)]
pub(super) struct Moving {
    /// In the pose that was asked last, whatever its number says.
    study: Study,
    geometry: Geometry,
    placing: Placing,
    modal: Option<ModalPlan>,
    /// How many frequencies that is for.
    count: Option<usize>,
}

impl Moving {
    fn new(subject: &Subject) -> Result<Self, Refused> {
        let study = Study::of_design(&subject.job, &subject.design)?;
        let mut placing = placing();
        placing.keep_drives();
        Ok(Self {
            geometry: study.model().geometry().clone(),
            study,
            placing,
            modal: None,
            count: None,
        })
    }

    /// Makes ready for so many natural frequencies, where all that moves has mass.
    fn count(&mut self, count: usize) {
        if self.count == Some(count) {
            return;
        }
        self.count = Some(count);
        let options = self.study.modal_options(Some(count), None);
        let options = options.unwrap_or_else(|| ModalOptions::lowest(count));
        self.modal = match count {
            0 => None,
            _ => self.study.modal_plan(&options),
        };
    }
}

impl Subject {
    /// Brings the mechanism to a pose; returns the output's whole pose.
    fn bring(&mut self, pose: Option<&PoseAsked>) -> Result<Result<[f64; 6], PoseError>, Refused> {
        let mut moving = match self.moving.take() {
            Some(moving) => moving,
            None => Moving::new(self)?,
        };
        let (geometry, placing) = (&mut moving.geometry, &mut moving.placing);
        let own = || self.study.job().map_or(0, |(_, pose)| pose);
        let reached = match pose {
            None => self.numbered(own(), geometry, placing),
            Some(PoseAsked::Number(number)) => self.numbered(*number, geometry, placing),
            Some(PoseAsked::At(asked)) => {
                let mut target = [None; 6];
                for (name, value) in self.whole(asked)? {
                    let place = COORDINATES.iter().position(|own| *own == name);
                    target[place.unwrap_or_default()] = Some(value);
                }
                Ok(self
                    .design
                    .bring(&Target::Output(target), geometry, placing))
            }
            Some(PoseAsked::Drives(asked)) => {
                let drives = asked.iter().map(|(name, value)| self.drive(name, *value));
                let drives = drives.collect::<Result<Vec<_>, _>>()?;
                Ok(self
                    .design
                    .bring(&Target::Drives(&drives), geometry, placing))
            }
        };
        self.moving = Some(moving);
        reached
    }

    /// Brings a geometry to a pose of the job.
    fn numbered(
        &self,
        number: usize,
        geometry: &mut Geometry,
        placing: &mut Placing,
    ) -> Result<Result<[f64; 6], PoseError>, Refused> {
        let count = self.job.len();
        if number >= count {
            let (location, job) = (Box::new(self.job.location()), self.job.name.clone());
            return Err(Refused::Study(StudyError::NoSuchPose {
                location,
                job,
                pose: number,
                count,
            }));
        }
        let geometries = std::slice::from_mut(geometry);
        let [placed, ..] = (self.design).place_lanes(number..number + 1, geometries, placing);
        placed.ok_or(Refused::NothingLoaded)
    }

    /// A value for a drive of a file's mechanism.
    fn drive(&self, name: &str, value: f64) -> Result<Drive, Refused> {
        let model = self.study.model();
        let known = self.design.drives();
        let named =
            |(joint, dof): &(JointId, Dof)| format!("{}.{dof}", model.joints()[joint.0].name);
        let Some((joint, direction)) = known.iter().find(|own| named(own) == name) else {
            let all: Vec<_> = known.iter().map(named).collect();
            return Err(Refused::Unknown {
                message: format!("`{name}` is no drive of the mechanism"),
                help: match &*all {
                    [] => "it is moved by coordinates of its output".into(),
                    all => format!("those are {}", all.join(", ")),
                },
            });
        };
        Ok(Drive {
            joint: *joint,
            direction: *direction,
            value,
        })
    }

    /// Where a pose is.
    pub(super) fn place(&mut self, pose: &PoseAsked) -> Result<Placed, Refused> {
        Ok(match self.bring(Some(pose))? {
            Ok(pose) => Placed {
                status: "ok",
                pose: Some(pose),
                drives: self.drive_values(),
                problem: None,
            },
            Err(error) => Placed {
                status: error.status(),
                problem: Some((&Refused::Pose(error)).into()),
                ..Placed::default()
            },
        })
    }

    /// Values of the drives in the pose that the mechanism was brought to.
    fn drive_values(&self) -> Option<Entries<f64>> {
        let moving = self.moving.as_ref()?;
        let values = moving.placing.drives(0)?;
        let model = moving.study.model();
        let names = model.drives();
        let names = names.map(|(joint, dof)| format!("{}.{dof}", model.joints()[joint.0].name));
        Some(names.zip(values.iter().copied()).collect())
    }

    /// What is found at a pose, with the numbers of the scene.
    pub(super) fn frame(
        &mut self,
        pose: Option<&PoseAsked>,
        asked: &Asked,
        count: Option<usize>,
        light: bool,
    ) -> Result<(Frame, Vec<f64>), Refused> {
        let pose = match self.bring(pose)? {
            Ok(pose) => pose,
            Err(error) => {
                let frame = Frame {
                    status: error.status(),
                    problem: Some((&Refused::Pose(error)).into()),
                    ..Frame::default()
                };
                return Ok((frame, Vec::new()));
            }
        };
        let drives = self.drive_values();
        let of_job = self.job.frequencies().map(|options| options.count);
        let count = count.or(of_job).unwrap_or(FREQUENCIES);
        let moving = self.moving.as_mut().ok_or(Refused::NothingLoaded)?;
        moving.study.set_geometry(moving.geometry.clone())?;
        if !light {
            moving.count(count);
        }
        let study = &moving.study;
        let mut frame = Frame {
            status: "ok",
            pose: Some(pose),
            drives,
            ..Frame::default()
        };
        let solution = match study.solve() {
            Ok(solution) => Some(solution),
            Err(error) => {
                frame.refuse(&error);
                None
            }
        };
        let loaded = match &solution {
            Some(solution) => Some(study.under(solution, asked.case.as_deref())?),
            None => None,
        };
        let (layout, numbers) = study.scene_numbers(loaded.as_deref())?;
        frame.layout = Some(layout);
        if let Some((solution, loaded)) = solution.as_ref().zip(loaded.as_deref()) {
            frame.fill(study, solution, loaded)?;
            if frame.problem.is_none() && !light {
                (frame.budget, frame.principal) = study.budget_and_measures(loaded, asked)?;
            }
        }
        let modal = moving.modal.as_ref().filter(|_| !light);
        let found = modal.and_then(|modal| modal.frequencies(&moving.geometry).ok());
        frame.frequencies = found.unwrap_or_default();
        Ok((frame, numbers))
    }
}

impl Frame {
    fn refuse(&mut self, error: &StudyError) {
        self.status = match error {
            StudyError::Unsolvable { source, .. } => Failure::Solve(source.clone()).status(),
            StudyError::FreeOutput { .. } => Failure::Free.status(),
            _ => "failed",
        };
        self.problem = Some(error.into());
    }

    /// Fills in what a solution tells; `loaded` is it, or what a case has of it.
    fn fill(
        &mut self,
        study: &Study,
        solution: &Solution,
        loaded: &Solution,
    ) -> Result<(), StudyError> {
        let displacement = loaded.output.displacement;
        let length = |block: usize| displacement.fixed_rows::<3>(block).norm();
        self.displacement = Some(displacement.into());
        self.deflection = Some(length(0));
        self.rotation = Some(length(3));
        self.stress = worst(study, loaded);
        if let Some(error) = study.free_output(solution) {
            self.refuse(&error);
            return Ok(());
        }
        self.stiffness = solution.output.stiffness.as_ref().map(rows);
        if self.stiffness.is_none() {
            self.status = "rigid";
        }
        Ok(())
    }
}

/// The largest equivalent stress of all bodies.
fn worst(study: &Study, loaded: &Solution) -> Option<Stressed> {
    let model = study.model();
    let bodies = model.bodies().iter().enumerate();
    let found = bodies.filter_map(|(k, body)| {
        let worst = loaded.worst_point(model, hyperstat_assembly::BodyId(k))?;
        Some(Stressed {
            body: body.name.clone(),
            value: worst.von_mises,
            utilisation: worst.utilisation,
        })
    });
    found.max_by(|a, b| a.value.total_cmp(&b.value))
}
