//! A mechanism made ready, and the shortest ways through.

use std::sync::OnceLock;

use hyperstat_model::{Geometry, LANES, ModalOptions, Model};
use nalgebra::Vector6;

use crate::answer::forces::Forces;
use crate::answer::pose_result::PoseResult;
use crate::answer::solution::Solution;
use crate::configuration::{Configuration, Kept, Planned, planned};
use crate::error::SolveError;
use crate::kinematics::Kinematics;
use crate::kinematics::redundancy::Redundancy;
use crate::lanes::forces::Virtual;
use crate::lanes::single::Single;
use crate::lanes::{Beside, Lanes};
use crate::modal::{ModalPlan, Modes};
use crate::plan::Plan;
use crate::plan::workspace::Workspace;
use crate::response::budget::Carried;
use crate::response::gives::Gives;
use crate::response::slopes::{Probe, Slopes};

/// A mechanism made ready: a model, and with it what is worked out once for its topology and for its
/// own configuration, each when it is first asked for.
///
/// ```
/// # use hyperstat_assembly::{Connection, JointStiffness, Model};
/// # use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
/// # use hyperstat_joints::{DofSet, Fixed};
/// # use nalgebra::{Point3, Rotation3, Vector6};
/// # fn cantilever() -> Result<Model, Box<dyn std::error::Error>> {
/// #     let steel = Material::new(2.1e11, Elasticity::Poisson(0.3), None)?;
/// #     let rod = Section::new(SectionShape::Circle { diameter: 0.02 }, None, None)?;
/// #     let mut model = Model::new("cantilever");
/// #     let points = [("root", Point3::origin()), ("tip", Point3::new(0.5, 0.0, 0.0))];
/// #     model.add_beam("beam", &points, &steel, &rod, None, 1)?;
/// #     let wall = Connection {
/// #         name: "wall".into(),
/// #         between: [None, model.node("beam", "root")],
/// #         joint: Box::new(Fixed),
/// #         locked: DofSet::EMPTY,
/// #         stiffness: JointStiffness::default(),
/// #     };
/// #     model.add_joint(wall, Rotation3::identity())?;
/// #     let tip = model.node("beam", "tip").ok_or("no tip")?;
/// #     model.add_load(tip, Vector6::new(0.0, 0.0, -100.0, 0.0, 0.0, 0.0))?;
/// #     model.set_output(tip);
/// #     Ok(model)
/// # }
/// use hyperstat_assembly::Prepared;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let prepared = Prepared::new(cantilever()?);
/// let here = prepared.here();
/// assert_eq!(here.kinematics()?.mobility, 0);
/// let solution = here.solve()?;
/// // The factorization of the solve serves the unit loads too.
/// let sensitivities = here.influence()?.sensitivities(&solution)?;
/// let along = Vector6::new(0.0, 0.0, 1.0, 0.0, 0.0, 0.0);
/// let sag = &solution.output.displacement;
/// // 1 % more diameter makes it sag 4 % less: the sag is as d⁻⁴.
/// let diameter = sensitivities[0].relative(sag, &along).ok_or("no sag")?;
/// assert!((diameter + 4.0).abs() < 1e-12);
///
/// // Poses of a sweep share the buffers of a thread.
/// let mut workspace = prepared.workspace()?;
/// let mut longer = prepared.model().geometry().clone();
/// longer.positions[1].x = 1.0;
/// let pose = prepared.sweep(&longer, &mut workspace)?;
/// let longer = pose.displacement.ok_or("it is held")?;
/// assert!((longer[2] / sag[2] - 8.0).abs() < 1e-9);
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Prepared {
    model: Model,
    plan: Planned,
    here: Kept,
    /// What budgets of poses are made of, once one is asked for.
    gives: OnceLock<Result<Gives, SolveError>>,
}

/// A pose's result, and derivatives by parameters where they are found.
pub type PoseSlopes = (PoseResult, Option<Vec<f64>>);

impl Prepared {
    /// A model to be made ready.
    pub fn new(model: Model) -> Self {
        Self {
            model,
            plan: Planned::new(),
            here: Kept::default(),
            gives: OnceLock::new(),
        }
    }

    /// Another design of this mechanism: other dimensions, sections, materials, stiffnesses and loads.
    /// Where its topology is the same, and so is every joint's part in it, all that depends on it alone
    /// is shared; elsewhere, and where loops of rigid bodies are eliminated, it is what
    /// [`Prepared::new`] makes ready. Either way the results are those of [`Prepared::new`].
    ///
    /// # Errors
    /// Of either as [`Configuration::solve`], but for what acts.
    pub fn for_design(&self, model: Model) -> Result<Self, SolveError> {
        let plan = self.plan()?.for_design(&model)?;
        Ok(Self {
            model,
            plan: Planned::from(Ok(plan)),
            here: Kept::default(),
            gives: OnceLock::new(),
        })
    }

    /// The model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The model, to be changed: whatever was worked out for it is forgotten.
    pub fn model_mut(&mut self) -> &mut Model {
        (self.plan, self.here) = (Planned::new(), Kept::default());
        self.gives = OnceLock::new();
        &mut self.model
    }

    /// The model alone.
    pub fn into_model(self) -> Model {
        self.model
    }

    /// Number of independent displacement coordinates, after loop elimination.
    ///
    /// # Errors
    /// What there is no plan for: as [`Configuration::solve`], but for what acts.
    pub fn unknowns(&self) -> Result<usize, SolveError> {
        Ok(self.plan()?.unknowns())
    }

    /// The model's own configuration. What is found of it stays with the mechanism.
    pub fn here(&self) -> Configuration<'_> {
        Configuration::new(&self.model, &self.plan, &self.here)
    }

    /// Another configuration.
    ///
    /// # Errors
    /// A geometry that is not one of this model, or takes a joint apart.
    pub fn at<'a>(&'a self, geometry: &'a Geometry) -> Result<Configuration<'a>, SolveError> {
        self.model
            .check_geometry(geometry, self.model.one_point())?;
        Ok(self.here().moved(geometry))
    }

    /// Buffers for one thread's poses of a sweep.
    ///
    /// # Errors
    /// As [`Prepared::unknowns`].
    pub fn workspace(&self) -> Result<Workspace, SolveError> {
        Ok(self.plan()?.workspace())
    }

    /// Output stiffness and displacement at one pose of a sweep; `workspace` is one of this mechanism.
    ///
    /// # Errors
    /// As [`Configuration::solve`]; a geometry or buffers that are not of this mechanism.
    pub fn sweep(
        &self,
        geometry: &Geometry,
        workspace: &mut Workspace,
    ) -> Result<PoseResult, SolveError> {
        self.plan()?.sweep(&self.model, geometry, workspace)
    }

    /// Poses and buffers for one thread; the poses are in the model's configuration.
    ///
    /// # Errors
    /// As [`Prepared::unknowns`].
    pub fn lanes(&self) -> Result<Lanes, SolveError> {
        self.lanes_beside(Beside::Nothing)
    }

    /// The same where more is to be found at every pose: [`Prepared::forces`], [`Prepared::budgets`].
    ///
    /// # Errors
    /// As [`Prepared::unknowns`].
    pub fn lanes_beside(&self, beside: Beside) -> Result<Lanes, SolveError> {
        Ok(self.plan()?.lanes(&self.model, beside))
    }

    /// The same for poses that all go through [`Prepared::sweep`], one by one.
    ///
    /// # Errors
    /// As [`Prepared::unknowns`].
    pub fn lanes_one_by_one(&self) -> Result<Lanes, SolveError> {
        Ok(self.plan()?.lanes_one_by_one(&self.model))
    }

    /// Output stiffness and displacement at the poses that [`Lanes::geometry_mut`] was brought to,
    /// where `filled` says so: what [`Prepared::sweep`] finds, to 1e-11 of the stiffness's scale
    /// (`√(K_ii K_jj)`) and of the largest component of the displacement, its components times
    /// `√K_ii`. `lanes` are of this mechanism; the nodes of a joint stay at one point; anything else
    /// is an error.
    pub fn sweep_lanes(
        &self,
        lanes: &mut Lanes,
        filled: [bool; LANES],
    ) -> [Option<Result<PoseResult, SolveError>>; LANES] {
        match self.plan() {
            Ok(plan) => plan.sweep_lanes(&self.model, lanes, filled),
            Err(error) => filled.map(|filled| filled.then(|| Err(error.clone()))),
        }
    }

    /// What [`Prepared::sweep_lanes`] finds, with the derivatives by some parameters of what `probe` asks of each
    /// pose, in one of the model's states (0: its own loads, then its cases). `None` in their place where
    /// nothing is asked, and where the lanes do not find them: then [`Configuration::influence`] does. In
    /// lanes that were made for [`Beside::Wrenches`], where no probe is one of the displacement, or
    /// [`Beside::Forces`].
    ///
    /// # Errors
    /// Of a pose: as [`Prepared::sweep_lanes`]; a section that cannot be formed, which no model has.
    pub fn sweep_slopes(
        &self,
        lanes: &mut Lanes,
        filled: [bool; LANES],
        (slopes, state): (&Slopes, usize),
        probe: &mut dyn FnMut(&PoseResult) -> Option<Probe>,
    ) -> [Option<Result<PoseSlopes, SolveError>>; LANES] {
        let plan = match self.plan() {
            Ok(plan) => plan,
            Err(error) => return filled.map(|filled| filled.then(|| Err(error.clone()))),
        };
        let mut probes = [const { None }; LANES];
        let mut ask = |pose: usize, result: &PoseResult, _: &[Forces]| {
            let own: &Option<Probe> = probes[pose].insert(probe(result));
            own.as_ref().map(Probe::states).unwrap_or_default()
        };
        let model = &self.model;
        let results = plan.sweep_lanes_asking(model, lanes, filled, Some((state, &mut ask)));
        let mut pose = 0;
        results.map(|result| {
            pose += 1;
            let of_pose = |result: PoseResult| {
                let found = lanes.found(plan, model, pose - 1)?;
                let slopes = match (found, probes[pose - 1].take().flatten()) {
                    (Some((states, units, geometry)), Some(probe)) => {
                        let units: Vec<&Forces> = units.iter().map(|own| &own.forces).collect();
                        let seen = (&result, states.first());
                        let own = slopes.of(model, geometry, &probe, &units, seen)?;
                        Some(own)
                    }
                    _ => None,
                };
                Ok((result, slopes))
            };
            result.map(|result| result.and_then(of_pose))
        })
    }

    /// A pose and buffers for one thread whose poses come one at a time, as those of a program do that
    /// moves the mechanism; the pose is in the model's configuration.
    ///
    /// # Errors
    /// As [`Prepared::unknowns`].
    pub fn single(&self) -> Result<Single, SolveError> {
        self.single_beside(Beside::Nothing)
    }

    /// The same where more is to be found at every pose, which allocates.
    ///
    /// # Errors
    /// As [`Prepared::unknowns`].
    pub fn single_beside(&self, beside: Beside) -> Result<Single, SolveError> {
        Ok(self.plan()?.single(&self.model, beside))
    }

    /// Output stiffness and displacement at the pose that [`Single::geometry_mut`] was brought to: what
    /// [`Prepared::sweep_lanes`] finds there, to the last bit. `single` is of this mechanism. Nothing is
    /// allocated where the lanes take the mechanism and vouch for the pose.
    ///
    /// # Errors
    /// As [`Prepared::sweep`].
    pub fn sweep_single(&self, single: &mut Single) -> Result<PoseResult, SolveError> {
        self.plan()?.sweep_single(&self.model, single)
    }

    /// What joints and segments carry under the model's loads, and then under those of each of its cases, at
    /// a pose of [`Lanes::geometry_mut`] that was swept: what [`Configuration::solve`] finds there. In lanes
    /// that were made for it ([`Prepared::lanes_beside`]) it is found beside the stiffness, as long as
    /// the mechanism is made of beams, rigid bodies and elastic joints without loops of rigid bodies, and
    /// the numbers are in balance, to 1e-10 of the largest force; else, in others, and where they were taken
    /// already, by the numeric pass and its recovery. `lanes` are of this mechanism.
    ///
    /// # Errors
    /// As [`Configuration::solve`].
    ///
    /// # Panics
    /// If `pose` is not below [`LANES`].
    pub fn forces(&self, lanes: &mut Lanes, pose: usize) -> Result<Vec<Forces>, SolveError> {
        let plan = self.plan()?;
        match lanes.forces(plan, &self.model, pose)? {
            Some(forces) => Ok(forces),
            None => self.at(lanes.geometry_mut(pose))?.forces(),
        }
    }

    /// The budgets of every state at a pose of [`Lanes::geometry_mut`] that was swept, along the way that each
    /// moves the output; where it does not, that of the compliance along the softest force; with what joints
    /// and segments carry. `found` is what [`Prepared::sweep_lanes`] gave there. `None` where the lanes were
    /// not made for it, do not have it, or gave it already: then [`Configuration::influence`] has.
    ///
    /// # Errors
    /// As [`Configuration::influence`].
    ///
    /// # Panics
    /// If `pose` is not below [`LANES`].
    pub fn budgets(
        &self,
        lanes: &mut Lanes,
        pose: usize,
        found: &PoseResult,
    ) -> Result<Option<Carried>, SolveError> {
        let kept = lanes.found(self.plan()?, &self.model, pose)?;
        let Some((forces, virtuals, geometry)) = kept else {
            return Ok(None);
        };
        let gives = match self.gives.get_or_init(|| Gives::of(&self.model)) {
            Ok(gives) => gives,
            Err(error) => return Err(error.clone()),
        };
        let at = (&self.model, geometry);
        let displacements = found.displacement.iter().chain(&found.cases);
        let states = displacements.zip(&forces).zip(&virtuals);
        let budget = |(state, own): ((&Vector6<f64>, &Forces), &Virtual)| {
            let under_it = (&own.wrench, &own.forces);
            let (displacement, forces) = state;
            match forces.floor.cleared(displacement) == Vector6::zeros() {
                false => gives.budget(at, state, under_it),
                true => gives.compliance_budget(at, &own.displacement, under_it),
            }
        };
        let budgets = states.map(budget).collect::<Result<_, _>>()?;
        Ok(Some(Carried { forces, budgets }))
    }

    /// The mechanism made ready for natural frequencies.
    ///
    /// # Errors
    /// As [`ModalPlan::new`].
    pub fn modal(&self, options: &ModalOptions) -> Result<ModalPlan, SolveError> {
        ModalPlan::new(&self.model, options)
    }

    fn plan(&self) -> Result<&Plan, SolveError> {
        planned(&self.plan, &self.model, &self.here)
    }
}

/// Asks something of a model's own configuration, and of nothing else.
fn ask<T>(model: &Model, question: impl FnOnce(Configuration<'_>) -> T) -> T {
    let (plan, found) = (Planned::new(), Kept::default());
    question(Configuration::new(model, &plan, &found))
}

/// Solves a model in its own configuration: the shortest way through. Where more is asked of it,
/// [`Prepared`] does nothing twice.
///
/// # Errors
/// As [`Configuration::solve`].
pub fn solve(model: &Model) -> Result<Solution, SolveError> {
    ask(model, |here| here.solve())
}

/// Mobility, over-constraint and motions without energy of a model as it stands.
///
/// # Errors
/// As [`Configuration::kinematics`].
pub fn analyse(model: &Model) -> Result<Kinematics, SolveError> {
    ask(model, |here| here.kinematics().cloned())
}

/// The redundant constraints of a model as it stands, as [`Configuration::redundant_constraints`].
pub fn redundant_constraints(model: &Model) -> Vec<Redundancy> {
    ask(model, |here| here.redundant_constraints())
}

/// Natural frequencies and modes of a model in its own configuration.
///
/// # Errors
/// As [`Configuration::modes`].
pub fn modes(model: &Model, options: &ModalOptions) -> Result<Modes, SolveError> {
    ask(model, |here| here.modes(options))
}
