//! What is measured of the output with its derivatives by values of the mechanism, named by their paths.

use hyperstat_assembly::Probe;
use hyperstat_mechanisms::nearest;
use nalgebra::{Matrix6, Vector6};

use crate::answer::SensitivityReport;
use crate::error::StudyError;
use crate::measures::{Measure, Pose};
use crate::schema::{DISPLACEMENT, entry};
use crate::study::Study;

/// What is measured: a measure, or a column of stiffness or displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// A measure.
    Measure(&'static Measure),
    /// An entry of the stiffness, row and column from 0: `k11` to `k66`.
    Stiffness(usize, usize),
    /// A component of the displacement, from 0: `dx` to `drz`.
    Displacement(usize),
}

impl Quantity {
    /// The quantity of this name.
    pub fn named(name: &str) -> Option<Self> {
        let measure = Measure::named(name).map(Self::Measure);
        let stiffness = || entry(name).map(|[row, column]| Self::Stiffness(row - 1, column - 1));
        let displacement = || {
            let place = DISPLACEMENT.iter().position(|own| *own == name);
            place.map(Self::Displacement)
        };
        measure.or_else(stiffness).or_else(displacement)
    }

    pub(crate) fn value(self, pose: &Pose, displacement: &Vector6<f64>) -> Option<f64> {
        match self {
            Self::Measure(measure) => pose.measure(measure.rule, displacement),
            Self::Stiffness(row, column) => Some(pose.stiffness()[(row, column)]),
            Self::Displacement(place) => Some(displacement[place]),
        }
    }

    /// What its derivative is of; `None` where it has none.
    pub(crate) fn probe(self, pose: &Pose, displacement: &Vector6<f64>) -> Option<Probe> {
        match self {
            Self::Measure(measure) => pose.probe(measure.rule, displacement),
            Self::Stiffness(row, column) => Some(of_entry(pose.stiffness(), row, column)),
            Self::Displacement(place) => Some(Probe {
                wrenches: Vec::new(),
                along: Some(Vector6::ith(place, 1.0)),
            }),
        }
    }

    /// Whether it is of the displacement.
    pub(crate) fn is_of_loads(self) -> bool {
        match self {
            Self::Measure(measure) => measure.rule.is_of_loads(),
            Self::Stiffness(..) => false,
            Self::Displacement(_) => true,
        }
    }
}

/// ∂K_rc = −(K e_r)ᵀ (∂C) K e_c, of which what is apart is a difference of two squares.
fn of_entry(stiffness: &Matrix6<f64>, row: usize, column: usize) -> Probe {
    let force = |place: usize| stiffness.column(place).into_owned();
    let wrenches = if row == column {
        vec![(-1.0, force(row))]
    } else {
        let scale = (stiffness[(column, column)] / stiffness[(row, row)]).sqrt();
        let [first, second] = [force(row) * scale, force(column)];
        let weight = 0.25 / scale;
        vec![(-weight, first + second), (weight, first - second)]
    };
    Probe {
        wrenches,
        along: None,
    }
}

impl Study {
    /// How the output, under the loads or those of a case, answers to every parameter of the mechanism, by
    /// its path as `vary` takes it.
    ///
    /// # Errors
    /// It has no solution, or moves freely; there is no such case.
    pub fn sensitivities(
        &mut self,
        case: Option<&str>,
    ) -> Result<Vec<SensitivityReport>, StudyError> {
        self.sensitivities_by((case, true))
    }

    /// The same without those by lengths, coordinates and axes.
    pub(crate) fn exact_sensitivities(
        &mut self,
        case: Option<&str>,
    ) -> Result<Vec<SensitivityReport>, StudyError> {
        self.sensitivities_by((case, false))
    }

    fn sensitivities_by(
        &mut self,
        (case, lengths): (Option<&str>, bool),
    ) -> Result<Vec<SensitivityReport>, StudyError> {
        self.name_values();
        let solution = self.solve_held()?;
        let loaded = self.under(&solution, case)?;
        let here = self.here();
        let found = here.influence().and_then(|influence| {
            SensitivityReport::all(self, &influence, &loaded, (case, lengths), |_| None)
        });
        found.map_err(|error| self.unsolvable(error))
    }

    /// A quantity of the output, under the loads or those of a case, and its derivatives \[SI\] by the values
    /// at these paths; NaN of a quantity that it does not have, as of an output that is held rigidly.
    ///
    /// Where principal values coincide, the derivative of each is one of several directional ones.
    ///
    /// # Errors
    /// As [`Study::sensitivities`]; a path by which there is no derivative.
    pub fn value_and_gradient(
        &mut self,
        quantity: Quantity,
        paths: &[String],
        case: Option<&str>,
    ) -> Result<(f64, Vec<f64>), StudyError> {
        let found = self.exact_sensitivities(case)?;
        let solution = self.solve_held()?;
        let loaded = self.under(&solution, case)?;
        let displacement = loaded.output.displacement;
        let pose = solution.output.stiffness.as_ref().map(Pose::new);
        let probe = pose.as_ref();
        let probe = probe.and_then(|pose| quantity.probe(pose, &displacement));
        let mut gradient = Vec::with_capacity(paths.len());
        for path in paths {
            let own = by_path(&found, path)?;
            let slope = probe.as_ref().map(|probe| {
                let compliance = Matrix6::from_fn(|r, c| own.compliance[r][c]);
                let moved = own.displacement.map_or([f64::NAN; 6], |u| u);
                probe.along(&compliance, &Vector6::from(moved))
            });
            gradient.push(slope.unwrap_or(f64::NAN));
        }
        let value = pose.and_then(|pose| quantity.value(&pose, &displacement));
        Ok((value.unwrap_or(f64::NAN), gradient))
    }
}

/// What answers to the value at a path.
fn by_path<'s>(
    found: &'s [SensitivityReport],
    path: &str,
) -> Result<&'s SensitivityReport, StudyError> {
    let own = found.iter().find(|own| is_named(own, path));
    own.ok_or_else(|| no_derivative(found, path))
}

/// Whether it is of the value at a path, which may name a parameter with and without its map, and several
/// joints as one.
pub(crate) fn is_named(own: &SensitivityReport, path: &str) -> bool {
    let alone = |path: &str| path.strip_prefix("parameters.").unwrap_or(path).to_owned();
    alone(&own.parameter) == alone(path) || own.path.as_deref() == Some(path)
}

/// The error of a path by which there is no derivative, beside those by which there are some.
pub(crate) fn no_derivative(found: &[SensitivityReport], path: &str) -> StudyError {
    let known: Vec<&str> = found.iter().map(|own| own.parameter.as_str()).collect();
    StudyError::NoDerivative {
        path: path.into(),
        nearest: nearest(path, &known).map(Into::into),
        known: known.into_iter().map(Into::into).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measures::MEASURES;

    /// Differences with one extrapolation: of the fourth order in the step.
    fn difference(of: impl Fn(f64) -> f64) -> f64 {
        let central = |h: f64| (of(h) - of(-h)) / (2.0 * h);
        (4.0 * central(5e-4) - central(1e-3)) / 3.0
    }

    #[test]
    fn slopes_are_those_of_the_measures() {
        let stiffness = |h: f64| {
            let mut k = Matrix6::from_diagonal(&Vector6::new(3e6, 2e6, 1e6, 4e4, 3e4, 2e4));
            let coupling = [
                (0, 1, 2e5),
                (0, 4, 3e4),
                (1, 3, -2e4),
                (2, 5, 1e4),
                (3, 5, 2e3),
            ];
            for (r, c, value) in coupling {
                k[(r, c)] = value * (1.0 + 0.7 * h);
                k[(c, r)] = k[(r, c)];
            }
            for d in 0..6 {
                k[(d, d)] *= 1.0 + 0.1 * (1.0 + d as f64) * h;
            }
            k
        };
        let displacement =
            |h: f64| Vector6::new(1e-4, -2e-4, 3e-4, 1e-3, 2e-3, -1e-3) * (1.0 + 0.3 * h);
        let pose = Pose::new(&stiffness(0.0));
        let change = (
            stiffness(1.0) - stiffness(0.0),
            displacement(1.0) - displacement(0.0),
        );
        let mut names: Vec<&str> = MEASURES.iter().map(|own| own.name).collect();
        names.extend(["k15", "k66", "dz", "drx"]);
        for name in names {
            let quantity = Quantity::named(name).unwrap();
            let probe = quantity.probe(&pose, &displacement(0.0)).unwrap();
            let compliance = pose.compliance().unwrap();
            let slope = probe.along(&-(compliance * change.0 * compliance), &change.1);
            let expected = difference(|h| {
                quantity
                    .value(&Pose::new(&stiffness(h)), &displacement(h))
                    .unwrap()
            });
            // Rounding over the step: some 1e-16 / 1e-3 of the value.
            let value = quantity.value(&pose, &displacement(0.0)).unwrap();
            let scale = expected.abs().max(1e-2 * value.abs());
            assert!(
                (slope - expected).abs() < 1e-10 * scale,
                "{name}: {slope} {expected}"
            );
        }
        assert_eq!(Quantity::named("k77"), None);
    }
}
