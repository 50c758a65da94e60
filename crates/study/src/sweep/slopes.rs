//! Derivatives of a quantity of the output beside it, in the poses of a sweep.

use hyperstat_assembly::{
    Beside, LANES, Lanes, Model, Parameter, PoseResult, Prepared, Slopes, SolveError,
};
use hyperstat_mechanisms::{Design, Job};

use super::record::Cell;
use crate::gradient::Quantity;
use crate::measures::Pose;

/// What is differentiated, and by what.
#[derive(Debug, Clone)]
pub(crate) struct Sought {
    pub(crate) quantity: Quantity,
    /// The case by its number.
    pub(crate) case: Option<usize>,
    pub(crate) parameters: Vec<Parameter>,
}

/// The same for a design.
#[derive(Debug)]
pub(super) struct Slope {
    quantity: Quantity,
    /// Its state: 0 that of the loads, then the cases.
    state: usize,
    slopes: Slopes,
}

/// What lanes find of a pose.
type FoundThere = Option<Result<PoseResult, SolveError>>;

impl Sought {
    /// Adds to the model of a job's design what the derivatives are found from, and the names by which its
    /// values are told apart.
    pub(super) fn prepare(
        &self,
        job: &Job,
        design: &Design,
        model: &mut Model,
    ) -> Result<(), SolveError> {
        job.name_values(design, model);
        match self.quantity.is_of_loads() {
            true => Slopes::add_cases(model, &self.parameters),
            false => Ok(()),
        }
    }
}

impl Slope {
    /// Of a model that is prepared for it; `None` where the lanes do not find it.
    pub(super) fn of(sought: &Sought, model: &Model) -> Result<Option<Self>, SolveError> {
        let of_loads = sought.quantity.is_of_loads();
        let slopes = Slopes::new(model, &sought.parameters, of_loads)?;
        Ok(slopes.map(|slopes| Self {
            quantity: sought.quantity,
            state: sought.case.map_or(0, |case| case + 1),
            slopes,
        }))
    }

    /// What lanes have to find beside the output.
    pub(super) fn beside(&self) -> Beside {
        match self.quantity.is_of_loads() {
            true => Beside::Forces,
            false => Beside::Wrenches,
        }
    }

    /// The poses with their derivatives, where these are found.
    pub(super) fn sweep(
        &self,
        prepared: &Prepared,
        lanes: &mut Lanes,
        filled: [bool; LANES],
    ) -> ([FoundThere; LANES], [Option<Vec<f64>>; LANES]) {
        let mut probe = |result: &PoseResult| {
            let pose = Pose::new(result.stiffness.as_ref()?);
            let displacement = match self.state {
                0 => result.displacement.as_ref(),
                case => result.cases.get(case - 1),
            };
            self.quantity.probe(&pose, displacement?)
        };
        let by = (&self.slopes, self.state);
        let mut slopes = [const { None }; LANES];
        let mut own = slopes.iter_mut();
        let found = prepared.sweep_slopes(lanes, filled, by, &mut probe);
        let found = found.map(|found| {
            let own = own.next();
            found.map(|found| {
                let (result, slopes) = found?;
                if let Some(own) = own {
                    *own = slopes;
                }
                Ok(result)
            })
        });
        (found, slopes)
    }
}

/// The cells of a pose's derivatives: so many, empty where they are not found.
pub(super) fn cells(slopes: Option<Vec<f64>>, count: usize) -> Vec<Cell> {
    let mut cells: Vec<Cell> = slopes.into_iter().flatten().map(Cell::Number).collect();
    cells.resize(count, Cell::Empty);
    cells
}
