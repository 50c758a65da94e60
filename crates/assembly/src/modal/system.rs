//! Stiffness and mass over the independent displacement coordinates of one configuration.

use std::ops::Range;

use nalgebra::DVector;

use super::lanczos::BLOCK;
use super::mass::{MassPlan, Masses};
use crate::error::SolveError;
use crate::kinematics::motion::{Motion, node_twist};
use crate::plan::Plan;
use crate::plan::blocks::{dot, multiply, subtract};
use crate::plan::elements::ElementPlan;
use crate::plan::sparse::Factor;
use crate::plan::workspace::Workspace;
use crate::pose::restraint::{Restraint, largest_minor, scaled};
use crate::posture::Posture;
use crate::rank::dense::RANK_TOLERANCE;
use crate::room;
use crate::room::MOST_NUMBERS;

/// Refinement steps of a solve at the most.
const MOST_REFINEMENTS: usize = 4;
/// A correction below this part of the solution is the last.
const ROUNDING: f64 = 1e-14;
/// Vectors of unit mass that a step of refinement changes by no more than this have eigenvalues to its
/// square over the distance of the next, relative: to rounding where those are a thousandth apart.
const SETTLED: f64 = 3e-8;
/// The energy of these changes over that of the vectors, at the most: it is what the eigenvalues are off by.
const STRAINED: f64 = 1e-11;
/// A motion has no mass whose kinetic energy is below this part of what it were with all mass at
/// its largest displacement.
const MASSLESS: f64 = 1e-20;

/// A mode over the coordinates, of unit modal mass.
pub(super) struct Mode {
    /// ω² \[rad²/s²\].
    pub eigenvalue: f64,
    pub vector: Vec<f64>,
    /// ‖ω² K⁻¹ M φ − φ‖ in the mass.
    pub residual: f64,
}

impl Mode {
    /// A motion without energy.
    pub fn at_rest(vector: &[f64]) -> Self {
        Self {
            eigenvalue: 0.0,
            vector: vector.to_vec(),
            residual: 0.0,
        }
    }
}

/// Part of them by which ω² may differ whose modes are turned among each other.
pub(super) const EQUAL: f64 = 1e-9;

/// Modes, lowest first, in groups of eigenvalues that differ by no more than a part of them.
pub(super) fn equal(modes: &[Mode], part: f64) -> Vec<Range<usize>> {
    let mut groups: Vec<Range<usize>> = Vec::new();
    for (k, mode) in modes.iter().enumerate() {
        let before = k.checked_sub(1).map(|before| modes[before].eigenvalue);
        let same = before.is_some_and(|v| mode.eigenvalue - v <= part * mode.eigenvalue);
        match groups.last_mut() {
            Some(group) if same => group.end = k + 1,
            _ => groups.push(k..k + 1),
        }
    }
    groups
}

/// The pair of matrices, factored.
pub(super) struct System<'a> {
    plan: &'a Plan,
    workspace: &'a Workspace,
    masses: &'a MassPlan,
    elements: &'a Masses,
    stiffness: Vec<f64>,
    mass: Vec<f64>,
    factor: Factor,
    /// Coordinates held so that motions without energy are none.
    pins: Vec<usize>,
    /// Those of motions that have no mass either.
    massless_pins: Vec<usize>,
    /// Motions without energy, orthonormal in the mass, and mass times each: first the idle ones,
    /// then those that move the output.
    free: Vec<(Vec<f64>, Vec<f64>)>,
    /// How many of them are idle.
    pub idle: usize,
}

impl<'a> System<'a> {
    /// Assembles and factors; the workspace has been evaluated.
    pub fn new(
        plan: &'a Plan,
        workspace: &'a Workspace,
        masses: &'a MassPlan,
        elements: &'a Masses,
        restraint: Option<(&Restraint, &Posture<'_>)>,
    ) -> Result<Self, SolveError> {
        let mut system = Self {
            plan,
            workspace,
            masses,
            elements,
            stiffness: masses.stiffness(plan, workspace),
            mass: masses.mass(elements),
            factor: masses.pattern.factor_buffers(BLOCK),
            pins: Vec::new(),
            massless_pins: Vec::new(),
            free: Vec::new(),
            idle: 0,
        };
        if let Some((restraint, at)) = restraint {
            let motions = restraint.idle.len() + restraint.moving.len();
            let numbers = room::matrix(motions, elements.size);
            room::check("its motions without energy", numbers, MOST_NUMBERS)?;
            system.release(restraint, at);
        }
        let mut held = system.stiffness.clone();
        for &pin in &system.pins {
            let scale = masses.pattern.diagonal(pin, &held);
            let scale = if scale > 0.0 { scale } else { 1.0 };
            masses.pattern.pin(pin, scale, &mut held);
        }
        let factored = masses.pattern.factorize(&held, &mut system.factor);
        factored.map_err(|_| SolveError::Singular)?;
        Ok(system)
    }

    /// Takes in the motions without energy.
    fn release(&mut self, restraint: &Restraint, at: &Posture<'_>) {
        let Posture {
            model,
            geometry,
            size,
            ..
        } = *at;
        let coordinates = |motion: &Motion, over: f64| -> Vec<f64> {
            let identities = self.workspace.identities.iter();
            identities
                .map(|(node, dof)| {
                    scaled(&node_twist(motion, model, geometry, node.0), over)[dof.index()]
                })
                .collect()
        };
        let motions = || restraint.idle.iter().chain(&restraint.moving);
        let over_size = |motion| DVector::from_vec(coordinates(motion, size));
        let pins = largest_minor(motions().map(over_size).collect(), RANK_TOLERANCE);
        let mut massless = Vec::new();
        let mut free: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
        let mut idle = 0;
        for (k, motion) in motions().enumerate() {
            let mut vector = coordinates(motion, 1.0);
            vector.resize(self.size(), 0.0);
            for _ in 0..2 {
                for (own, mass_own) in &free {
                    let share = dot(mass_own, &vector);
                    subtract(&mut vector, share, own);
                }
            }
            let mut mass_vector = self.mass_times(&vector);
            let energy = dot(&vector, &mass_vector);
            if energy <= MASSLESS * self.elements.total * size * size {
                let identities = self.workspace.identities.iter();
                let unit = identities.map(|(_, dof)| if dof.is_rotation() { 1.0 } else { size });
                let column = vector.iter().zip(unit).map(|(value, unit)| value / unit);
                massless.push(DVector::from_iterator(self.plan.unknowns, column));
                continue;
            }
            let length = energy.sqrt();
            for value in vector.iter_mut().chain(&mut mass_vector) {
                *value /= length;
            }
            free.push((vector, mass_vector));
            if k < restraint.idle.len() {
                idle += 1;
            }
        }
        self.massless_pins = largest_minor(massless, RANK_TOLERANCE);
        (self.pins, self.free, self.idle) = (pins, free, idle);
    }

    /// Number of coordinates.
    pub fn size(&self) -> usize {
        self.elements.size
    }

    /// Calls `take` with every inner shape's coordinate, its ω², the coordinates that its mass couples
    /// it to, and that mass.
    fn each_inner(&self, mut take: impl FnMut(usize, f64, &[usize], &[f64])) {
        for (inner, columns, _) in self.masses.inner(self.elements) {
            for (k, (square, coupling)) in inner.each(columns.len()).enumerate() {
                take(inner.start + k, square, columns, coupling);
            }
        }
    }

    /// Motions of the output without energy, of unit modal mass.
    pub fn moving(&self) -> impl Iterator<Item = &[f64]> {
        self.free[self.idle..].iter().map(|(vector, _)| &vector[..])
    }

    /// M x.
    pub fn mass_times(&self, x: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; x.len()];
        let nodes = self.plan.unknowns;
        (self.masses.pattern).add_product(&self.mass, &x[..nodes], &mut out[..nodes]);
        self.each_inner(|own, _, columns, coupling| {
            out[own] += x[own];
            for (column, mass) in columns.iter().zip(coupling) {
                out[own] += mass * x[*column];
                out[*column] += mass * x[own];
            }
        });
        out
    }

    /// √(xᵀ M x).
    pub fn length(&self, x: &[f64]) -> f64 {
        dot(x, &self.mass_times(x)).max(0.0).sqrt()
    }

    /// Whether there are motions without energy.
    pub fn has_free(&self) -> bool {
        !self.free.is_empty()
    }

    /// Takes the motions without energy out of a vector.
    pub fn remove_free(&self, vector: &mut [f64]) {
        for (own, mass_own) in &self.free {
            let share = dot(mass_own, vector);
            subtract(vector, share, own);
        }
    }

    /// K⁻¹ times vectors of forces, without what works on motions without energy; `refined` by
    /// residuals formed in the elements' deformations.
    pub fn solve(
        &mut self,
        forces: &[Vec<f64>],
        refined: bool,
    ) -> Result<Vec<Vec<f64>>, SolveError> {
        let mut solutions = Vec::with_capacity(forces.len());
        for block in forces.chunks(BLOCK) {
            let mut block = block.to_vec();
            for force in &mut block {
                for (own, mass_own) in &self.free {
                    let share = dot(own, force);
                    subtract(force, share, mass_own);
                }
            }
            let nodes = self.plan.unknowns;
            let right_side: Vec<&[f64]> = block.iter().map(|force| &force[..nodes]).collect();
            let mut moved = self.solve_block(block.len(), &right_side.concat(), refined)?;
            for (moved, force) in moved.iter_mut().zip(&block) {
                moved.extend_from_slice(&force[nodes..]);
                self.each_inner(|own, square, _, _| moved[own] /= square);
            }
            solutions.append(&mut moved);
        }
        Ok(solutions)
    }

    fn solve_block(
        &mut self,
        columns: usize,
        forces: &[f64],
        refined: bool,
    ) -> Result<Vec<Vec<f64>>, SolveError> {
        let n = self.plan.unknowns;
        if n == 0 {
            return Ok(vec![Vec::new(); columns]);
        }
        let mut whole = vec![0.0; forces.len()];
        let mut rest = forces.to_vec();
        let mut last = f64::INFINITY;
        for _ in 0..=MOST_REFINEMENTS {
            for column in rest.chunks_exact_mut(n) {
                for pin in &self.pins {
                    column[*pin] = 0.0;
                }
            }
            self.masses.pattern.solve(&mut self.factor, &mut rest);
            if !refined {
                whole.copy_from_slice(&rest);
                break;
            }
            let mut change = 0.0_f64;
            for (column, step) in whole.chunks_exact_mut(n).zip(rest.chunks_exact(n)) {
                subtract(column, -1.0, step);
                let weighted = |x: &[f64]| -> f64 {
                    let weight = |k| self.masses.pattern.diagonal(k, &self.stiffness);
                    x.iter().enumerate().map(|(k, x)| weight(k) * x * x).sum()
                };
                let (moved, all) = (weighted(step), weighted(column));
                if all > 0.0 {
                    change = change.max((moved / all).sqrt());
                }
            }
            let settled = change < ROUNDING || change > 0.5 * last;
            last = change;
            if settled {
                break;
            }
            rest.copy_from_slice(forces);
            for (rest, column) in rest.chunks_exact_mut(n).zip(whole.chunks_exact(n)) {
                each_deformation(
                    self.plan,
                    self.workspace,
                    column,
                    |_, operator, _, force| {
                        operator.subtract_forces(force, rest);
                    },
                );
            }
        }
        if whole.iter().all(|value| value.is_finite()) {
            Ok(whole.chunks_exact(n).map(<[f64]>::to_vec).collect())
        } else {
            Err(SolveError::Overflow)
        }
    }

    /// xᵀ K x, by the elements' deformations.
    fn energy(&self, x: &[f64]) -> f64 {
        let mut energy = 0.0;
        each_deformation(self.plan, self.workspace, x, |_, _, deformation, force| {
            energy += dot(deformation, force);
        });
        self.each_inner(|own, square, _, _| energy += square * x[own] * x[own]);
        energy
    }

    /// Whether modes are eigenvectors so closely that their ω² are good to rounding, whatever solutions
    /// without refinement have lost: their residuals, formed in the elements' deformations, are small
    /// beside the loads that they are of.
    pub fn settled(&mut self, modes: &[Mode]) -> bool {
        let nodes = self.plan.unknowns;
        let rest = modes.iter().map(|mode| {
            let mut rest = self.mass_times(&mode.vector);
            for value in &mut rest {
                *value *= mode.eigenvalue;
            }
            let (x, inertia) = (&mode.vector, &mut rest);
            self.each_inner(|own, square, _, _| inertia[own] -= square * x[own]);
            let inertia = &mut inertia[..nodes];
            each_deformation(self.plan, self.workspace, x, |_, operator, _, force| {
                operator.subtract_forces(force, inertia);
            });
            rest
        });
        let rest: Vec<Vec<f64>> = rest.collect();
        let Ok(moved) = self.solve(&rest, false) else {
            return false;
        };
        let settled = |(moved, mode): (&Vec<f64>, &Mode)| {
            self.length(moved) < SETTLED && self.energy(moved) <= STRAINED * mode.eigenvalue
        };
        moved.iter().zip(modes).all(settled)
    }

    /// The mode of a vector, whose image under K⁻¹ M is given.
    pub fn mode(&self, mut vector: Vec<f64>, image: &[f64]) -> Mode {
        let length = self.length(&vector);
        for value in &mut vector {
            *value /= length;
        }
        let eigenvalue = self.energy(&vector);
        let parts = vector.iter().zip(image);
        let rest: Vec<f64> = parts
            .map(|(own, i)| eigenvalue / length * i - own)
            .collect();
        Mode {
            eigenvalue,
            residual: self.length(&rest),
            vector,
        }
    }

    /// Number of eigenvalues between zero and `limit`, motions without energy apart; `None` where
    /// it cannot be counted. Inner shapes are eliminated first, which counts those whose own ω² is
    /// below (Wittrick and Williams 1971).
    pub fn count_below(&self, limit: f64) -> Option<usize> {
        let mut values = self.stiffness.clone();
        subtract(&mut values, limit, &self.mass);
        let mut held = 0;
        for (inner, columns, places) in self.masses.inner(self.elements) {
            for (square, coupling) in inner.each(columns.len()) {
                held += usize::from(square < limit);
                let weight = limit * limit / (square - limit);
                let mut places = places.iter();
                for (b, mass) in coupling.iter().enumerate() {
                    for (other, place) in coupling[..=b].iter().zip(&mut places) {
                        values[*place] -= weight * mass * other;
                    }
                }
            }
        }
        for &pin in &self.massless_pins {
            let scale = self.masses.pattern.diagonal(pin, &self.stiffness);
            let scale = if scale > 0.0 { scale } else { 1.0 };
            self.masses.pattern.pin(pin, scale, &mut values);
        }
        let counted = self.masses.pattern.negative_eigenvalues(&values)?;
        (counted + held).checked_sub(self.free.len())
    }
}

/// Calls `take` with every element, and its operator, deformation and force under `x`.
pub(super) fn each_deformation(
    plan: &Plan,
    workspace: &Workspace,
    x: &[f64],
    mut take: impl FnMut(&ElementPlan, Operator<'_>, &[f64], &[f64]),
) {
    let mut deformation = Vec::new();
    let mut force = Vec::new();
    for element in &plan.elements {
        let (rows, count) = (element.rows, element.columns.len());
        let start = element.operator_start;
        let operator = Operator {
            rows,
            columns: &element.columns,
            values: &workspace.operators[start..start + rows * count],
        };
        let start = element.stiffness_start;
        let k = &workspace.stiffnesses[start..start + rows * rows];
        deformation.clear();
        deformation.resize(rows, 0.0);
        operator.add_deformation(x, &mut deformation);
        force.resize(rows, 0.0);
        multiply(k, &deformation, rows, &mut force[..rows]);
        take(element, operator, &deformation, &force[..rows]);
    }
}

/// Deformations of an element by its coordinates.
pub(super) struct Operator<'a> {
    rows: usize,
    columns: &'a [usize],
    values: &'a [f64],
}

impl Operator<'_> {
    fn add_deformation(&self, x: &[f64], deformation: &mut [f64]) {
        for (idc, column) in self.columns.iter().zip(self.values.chunks_exact(self.rows)) {
            subtract(deformation, -x[*idc], column);
        }
    }

    fn subtract_forces(&self, force: &[f64], out: &mut [f64]) {
        for (idc, column) in self.columns.iter().zip(self.values.chunks_exact(self.rows)) {
            out[*idc] -= dot(column, force);
        }
    }
}
