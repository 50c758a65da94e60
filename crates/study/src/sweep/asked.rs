//! What a job's `columns` ask for, found at one pose.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::Arc;

use hyperstat_assembly::{
    Beside, BodyId, Budget, Carried, Configuration, Geometry, JointId, Model, MovingMass,
    PartSource, Prepared, SegmentForces, Solution, SolveError, worst_von_mises,
};
use hyperstat_elements::Taper;
use hyperstat_joints::Dof;
use hyperstat_mechanisms::Job;
use nalgebra::{Matrix6, Vector6};

use super::record::Cell;
use crate::answer::{segment_names, shares};
use crate::measures::{MEASURES, Pose};
use crate::schema::{DEFORMATIONS, Group, Worst, drives};

/// The columns on request of a design.
#[derive(Debug)]
pub(super) struct Asked {
    groups: Vec<Group>,
    /// Number of cases.
    cases: usize,
    /// Names of the segments.
    segments: Vec<Arc<str>>,
    /// Their sections; of one that has none along it, nothing is asked.
    sections: Vec<Option<Taper>>,
    /// Of the parts whose shares are asked for: their columns.
    parts: HashMap<PartSource, usize>,
    /// Names of the drives of this design, and which they are.
    drives: Vec<(String, (JointId, Dof))>,
    /// Where it is asked for.
    mass: Option<MovingMass>,
}

/// What is known of a pose.
pub(super) struct Found<'f> {
    /// The design.
    pub(super) prepared: &'f Prepared,
    pub(super) geometry: &'f Geometry,
    /// Stiffness of the output, where it has one.
    pub(super) stiffness: Option<&'f Matrix6<f64>>,
    /// Displacement of the output under the loads, then in every case.
    pub(super) displacements: &'f [Vector6<f64>],
    /// Values of the drives, where they are known.
    pub(super) drives: Option<&'f [f64]>,
    /// Natural frequencies.
    pub(super) frequencies: &'f [Cell],
    /// What joints and segments carry and the budgets under the loads, then in every case, where they are
    /// known.
    pub(super) carried: Option<&'f Carried>,
}

/// Wrenches in joints and forces of segments.
type OfState<'s> = (&'s [Option<Vector6<f64>>], &'s [SegmentForces]);

impl Asked {
    /// Those of a job; `None` where it asks for none.
    pub(super) fn of(job: &Job, model: &Model) -> Result<Option<Self>, SolveError> {
        let groups = Group::all(job);
        if groups.is_empty() {
            return Ok(None);
        }
        let asks = groups.contains(&Group::Mass);
        let mass = asks.then(|| MovingMass::new(model)).transpose()?;
        let sections = model.segments().iter();
        Ok(Some(Self {
            cases: job.cases().len(),
            sections: sections.map(|own| own.sections_along().ok()).collect(),
            parts: columns_of_parts(&groups, model),
            segments: segment_names(model).into_iter().map(Arc::from).collect(),
            drives: drives(model).into_iter().zip(model.drives()).collect(),
            mass,
            groups,
        }))
    }

    /// What lanes have to find beside the output.
    pub(super) fn beside(&self) -> Beside {
        let of = |group: &Group| match group {
            Group::Budget(_) => Beside::Budgets,
            group if group.is_solved() => Beside::Forces,
            _ => Beside::Nothing,
        };
        self.groups.iter().map(of).max().unwrap_or_default()
    }

    /// Whether values of drives are asked for.
    pub(super) fn needs_drives(&self) -> bool {
        let asks = |group: &Group| matches!(group, Group::Drives(_));
        self.groups.iter().any(asks)
    }

    /// Adds what stands in the columns.
    ///
    /// # Errors
    /// As [`Configuration::solve`].
    pub(super) fn add(&self, found: &Found<'_>, cells: &mut Vec<Cell>) -> Result<(), SolveError> {
        let here;
        let solution;
        let (states, solved): (Vec<OfState<'_>>, _) = match found.carried {
            Some(carried) => {
                let own = carried
                    .forces
                    .iter()
                    .map(|own| (&*own.joint_wrenches, &*own.segments));
                (own.collect(), None)
            }
            None if self.beside() == Beside::Budgets => {
                here = found.prepared.at(found.geometry)?;
                solution = here.solve()?;
                let cases = solution.cases.iter().map(|case| &case.state);
                let cases = cases.map(|own| (&*own.joint_wrenches, &*own.segments));
                let of_loads = (&*solution.joint_wrenches, &*solution.segments);
                let states = std::iter::once(of_loads).chain(cases);
                (states.collect(), Some((&here, &solution)))
            }
            None => (Vec::new(), None),
        };
        for group in &self.groups {
            match group {
                Group::Drives(names) => {
                    let value = |name: &String| {
                        let place = self.drive(name)?;
                        found.drives?.get(place).copied()
                    };
                    cells.extend(names.iter().map(value).map(Cell::from));
                }
                Group::Mass => {
                    let mass = self.mass.as_ref();
                    cells.push(mass.map(|mass| mass.at(found.geometry)).into());
                }
                Group::Measures => add_measures(found, cells),
                Group::Frequencies(0) => {}
                Group::Frequencies(_) => cells.extend_from_slice(found.frequencies),
                Group::Budget(parts) => {
                    let budgets = match (found.carried, solved) {
                        (Some(carried), _) => Cow::Borrowed(&carried.budgets),
                        (None, Some((here, solution))) => Cow::Owned(budgets(here, solution)?),
                        (None, None) => continue,
                    };
                    self.add_shares(parts.len(), &budgets, cells);
                }
                _ => self.add_forces(group, found.prepared.model(), &states, cells),
            }
        }
        Ok(())
    }

    /// Place of a drive among those of this design.
    fn drive(&self, name: &String) -> Option<usize> {
        self.drives.iter().position(|(own, _)| own == name)
    }

    /// Adds what is found of the forces under the loads, then in every case.
    fn add_forces(
        &self,
        group: &Group,
        model: &Model,
        states: &[OfState<'_>],
        cells: &mut Vec<Cell>,
    ) {
        for (wrenches, segments) in states {
            match group {
                Group::DriveForces(names) => {
                    let force = |name: &String| {
                        let (_, (joint, dof)) = &self.drives[self.drive(name)?];
                        // The work of the wrench on a unit of the direction.
                        let basis = model.joints()[joint.0].joint.basis();
                        Some(basis.column(dof.index()).dot(wrenches[joint.0].as_ref()?))
                    };
                    cells.extend(names.iter().map(force).map(Cell::from));
                }
                Group::Wrench(name) => {
                    let joint = model.joints().iter().position(|joint| joint.name == *name);
                    let wrench = joint.and_then(|joint| wrenches[joint]);
                    cells.extend((0..6).map(|k| Cell::from(wrench.map(|wrench| wrench[k]))));
                }
                Group::Worst(worst) => cells.extend(self.worst(*worst, model, segments)),
                _ => {}
            }
        }
    }

    /// What is largest in the beams, the segment where it is, and where along it.
    fn worst(&self, worst: Worst, model: &Model, forces: &[SegmentForces]) -> [Cell; 3] {
        let mut largest: Option<(f64, usize, f64)> = None;
        for (k, (segment, forces)) in model.segments().iter().zip(forces).enumerate() {
            let sections = self.sections[k].as_ref();
            let Some(peak) = sections.and_then(|own| worst_von_mises(own, forces)) else {
                continue;
            };
            let value = match worst {
                Worst::Stress => Some(peak.value),
                Worst::Utilisation => {
                    let limit = segment.material.yield_strength();
                    limit.map(|limit| peak.value / limit)
                }
            };
            if let Some(value) = value
                && largest.is_none_or(|(most, ..)| value > most)
            {
                largest = Some((value, k, peak.xi));
            }
        }
        match largest {
            Some((value, segment, xi)) => {
                let name = Arc::clone(&self.segments[segment]);
                [value.into(), Cell::Text(name), xi.into()]
            }
            None => Default::default(),
        }
    }

    /// Adds the shares in the deflection under the loads, then in every case; empty where the output moves
    /// freely and there are no `budgets`.
    fn add_shares(&self, parts: usize, budgets: &[Budget], cells: &mut Vec<Cell>) {
        let width = parts + DEFORMATIONS.len();
        for budget in budgets {
            let mut sums = vec![0.0; width];
            for part in &budget.parts {
                if let Some(column) = self.parts.get(&part.source) {
                    sums[*column] += part.displacement;
                }
                let kinds = DEFORMATIONS.iter();
                let kind = kinds
                    .map(|(kind, _)| *kind)
                    .position(|k| k == part.deformation);
                if let Some(kind) = kind {
                    sums[parts + kind] += part.displacement;
                }
            }
            let total = Some(budget.total).filter(|total| *total != 0.0);
            let share = |sum: f64| Cell::from(total.map(|total| sum / total));
            cells.extend(sums.into_iter().map(share));
        }
        let missing = (1 + self.cases).saturating_sub(budgets.len());
        cells.extend(std::iter::repeat_n(Cell::Empty, missing * width));
    }
}

/// Of the parts of a model whose shares are asked for: their columns.
fn columns_of_parts(groups: &[Group], model: &Model) -> HashMap<PartSource, usize> {
    let names = groups.iter().find_map(|group| match group {
        Group::Budget(names) => Some(names),
        _ => None,
    });
    let bodies = model.bodies().iter().enumerate();
    let bodies = bodies.map(|(k, body)| {
        let source = PartSource::Body(BodyId(k));
        (source, format!("body {}", body.name))
    });
    let joints = model.joints().iter().enumerate();
    let joints = joints.map(|(k, joint)| {
        let source = PartSource::Joint(JointId(k));
        (source, format!("joint {}", joint.name))
    });
    let columns: HashMap<&str, usize> = (names.into_iter().flatten().enumerate())
        .map(|(column, name)| (name.as_str(), column))
        .collect();
    let own = bodies.chain(joints);
    own.filter_map(|(source, name)| Some((source, *columns.get(name.as_str())?)))
        .collect()
}

/// The budgets of the deflection under the loads, then in every case; none where the output moves freely.
fn budgets(here: &Configuration<'_>, solution: &Solution) -> Result<Vec<Budget>, SolveError> {
    if solution.output.compliance.is_none() {
        return Ok(Vec::new());
    }
    let influence = here.influence()?;
    let cases = solution.cases.iter();
    let cases = cases.map(|case| solution.of_case(&case.name).map(Cow::Owned));
    let states = std::iter::once(Some(Cow::Borrowed(solution))).chain(cases);
    let found = states.map(|state| shares(here.model(), &influence, &*state?));
    Ok(found.map_while(|budget| budget).collect())
}

/// Adds every measure, then those of every case.
fn add_measures(found: &Found<'_>, cells: &mut Vec<Cell>) {
    let pose = found.stiffness.map(Pose::new);
    for (k, displacement) in found.displacements.iter().enumerate() {
        let asked = MEASURES
            .iter()
            .filter(|measure| k == 0 || measure.rule.is_of_loads());
        cells.extend(asked.map(|measure| {
            let value = match &pose {
                Some(pose) => pose.measure(measure.rule, displacement),
                None => measure.rule.of_displacement(displacement),
            };
            Cell::from(value)
        }));
    }
}
