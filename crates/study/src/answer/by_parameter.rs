//! What the parameters of a mechanism change: by the values that its expressions give, whose
//! derivatives are known; where they reach points, axes or loads, by differences of the whole answer.

use std::collections::HashMap;

use hyperstat_assembly::{
    Floor, FrequencySensitivity, ModalOptions, ModalSensitivities, Model, Parameter, Sensitivity,
};
use hyperstat_mechanisms::Dependence;
use nalgebra::{Matrix6, Vector6};

use super::parameters::letter;
use crate::steps::{STEPS, step_of};
use crate::study::Study;

/// Step of differences of frequencies, relative to the value: their error is about its square, and that of
/// rounding divided by it.
const STEP: f64 = 1e-4;

/// Lengths and coordinates that are looked at: each takes four solutions.
const MOST_LENGTHS: usize = 150;

/// How the output answers to a parameter.
pub(super) struct ByParameter {
    pub(super) sensitivity: Sensitivity,
    /// The parameters of the model that it is the sum of, by number, with their weights; `None` where it is
    /// by differences.
    pub(super) parts: Option<Vec<(usize, f64)>>,
}

/// How the output answers to all parameters that change anything, from how it answers to the values of
/// the model.
pub(super) fn of_output(
    study: &Study,
    found: &[Sensitivity],
    case: Option<&str>,
) -> Vec<ByParameter> {
    let model = study.model();
    let paths: Vec<_> = (found.iter())
        .map(|s| paths(model, s.name.as_deref(), &s.parameter))
        .collect();
    let of = |dependence: Dependence| {
        let weights = weights(&dependence, &paths);
        let sensitivity = match &weights {
            Some(weights) => summed(&dependence, found, weights),
            None if dependence.slopes.is_empty() => return None,
            None => differences(study, &dependence.path, dependence.value, case)?,
        };
        Some(ByParameter {
            sensitivity,
            parts: weights,
        })
    };
    study.dependences().into_iter().filter_map(of).collect()
}

/// How the output answers to the lengths, coordinates and axes that are written as numbers, in the same pose
/// of the output; none where there are too many of them.
pub(super) fn of_lengths(study: &Study, case: Option<&str>) -> Vec<ByParameter> {
    let placing = study.placing();
    if placing.len() > MOST_LENGTHS {
        return Vec::new();
    }
    let of = |(path, value): (String, f64)| {
        let sensitivity = differences(study, &path, value, case)?;
        let moved = sensitivity.displacement.map_or(0.0, |own| own.amax());
        let changes = sensitivity.compliance.amax() != 0.0 || moved != 0.0;
        changes.then_some(ByParameter {
            sensitivity,
            parts: None,
        })
    };
    placing.into_iter().filter_map(of).collect()
}

/// How natural frequencies answer to all parameters that change anything, each with whether that is by
/// differences.
pub(super) fn of_frequencies(
    study: &Study,
    found: &ModalSensitivities,
    options: &ModalOptions,
) -> Vec<(FrequencySensitivity, bool)> {
    let model = study.model();
    let known = &found.parameters;
    let paths: Vec<_> = (known.iter())
        .map(|s| paths(model, s.name.as_deref(), &s.parameter))
        .collect();
    let of = |dependence: Dependence| {
        // Derivatives of frequencies that are equal do not add up.
        let weights = weights(&dependence, &paths);
        let distinct = found.groups.iter().all(|group| group.len() == 1);
        let weights = weights.filter(|weights| distinct || weights.len() == 1);
        let by_differences = weights.is_none();
        let derivatives = match weights {
            Some(weights) => (0..found.frequencies.len())
                .map(|place| {
                    weights
                        .iter()
                        .map(|(k, w)| known[*k].derivatives[place] * w)
                        .sum()
                })
                .collect(),
            None => of_frequency(study, &dependence, found, options)?,
        };
        let sensitivity = FrequencySensitivity::new(
            PART_OF_NOTHING,
            dependence.path,
            dependence.value,
            in_groups(derivatives, found),
        );
        Some((sensitivity, by_differences))
    };
    study.dependences().into_iter().filter_map(of).collect()
}

/// A parameter that is none of a part of the model alone.
const PART_OF_NOTHING: Parameter = Parameter::Joint {
    direction: None,
    joints: Vec::new(),
};

/// Paths of the values that a parameter of the model stands for; none where they are not known.
fn paths(model: &Model, name: Option<&str>, parameter: &Parameter) -> Vec<String> {
    match (name, parameter) {
        (Some(name), _) => vec![name.into()],
        (
            None,
            Parameter::Joint {
                direction: Some(direction),
                joints,
            },
        ) => (joints.iter())
            .map(|joint| {
                let name = &model.joints()[joint.0].name;
                format!("joints.{name}.stiffness.{}", letter(*direction))
            })
            .collect(),
        _ => Vec::new(),
    }
}

/// The parameters of the model, by their number, that a parameter of the file changes, each with how much;
/// `None` where it changes anything else, or some of what they stand for only.
fn weights(dependence: &Dependence, paths: &[Vec<String>]) -> Option<Vec<(usize, f64)>> {
    let slopes: HashMap<&str, f64> = (dependence.slopes.iter())
        .map(|(path, slope)| (path.as_str(), *slope))
        .collect();
    if slopes.len() != dependence.slopes.len() || !slopes.values().all(|slope| slope.is_finite()) {
        return None;
    }
    let mut weights = Vec::new();
    let mut reached = 0;
    for (k, paths) in paths.iter().enumerate() {
        let mut own = paths.iter().map(|path| slopes.get(path.as_str()).copied());
        let Some(first) = own.next() else {
            continue;
        };
        if own.any(|slope| slope != first) {
            return None;
        }
        if let Some(first) = first {
            reached += paths.len();
            weights.push((k, first));
        }
    }
    (reached == slopes.len()).then_some(weights)
}

/// The chain rule.
fn summed(dependence: &Dependence, found: &[Sensitivity], weights: &[(usize, f64)]) -> Sensitivity {
    let parts = || weights.iter().map(|(k, weight)| (&found[*k], *weight));
    let stiffness = found.first().is_some_and(|s| s.stiffness.is_some());
    Sensitivity {
        parameter: PART_OF_NOTHING,
        name: Some(dependence.path.clone()),
        value: dependence.value,
        compliance: parts().map(|(s, weight)| s.compliance * weight).sum(),
        stiffness: (stiffness
            .then(|| parts().map(|(s, weight)| Some(s.stiffness? * weight)).sum()))
        .flatten(),
        displacement: parts()
            .map(|(s, weight)| Some(s.displacement? * weight))
            .sum(),
    }
}

/// The studies with a little more and a little less of a parameter, and how much between the two.
fn beside(study: &Study, dependence: &Dependence) -> Option<([Study; 2], f64)> {
    let value = dependence.value;
    let step = if value == 0.0 {
        STEP
    } else {
        STEP * value.abs()
    };
    let [more, less] = [value + step, value - step];
    let with = |value: f64| study.with_values(&[(dependence.path.as_str(), value)]).ok();
    Some(([with(more)?, with(less)?], more - less))
}

/// Differences of the whole answer by four designs; `None` where there is none beside it.
fn differences(study: &Study, path: &str, value: f64, case: Option<&str>) -> Option<Sensitivity> {
    let size = Floor::of(study.model()).map_or(1.0, |floor| floor.size);
    let step = step_of(value, size);
    let mut sums = (Matrix6::zeros(), Some(Matrix6::zeros()), Vector6::zeros());
    for (k, weight) in STEPS {
        let beside = study.with_values(&[(path, value + k * step)]).ok()?;
        let solution = beside.solve().ok()?;
        let output = &beside.under(&solution, case).ok()?.output;
        let weight = weight / (12.0 * step);
        sums.0 += output.compliance? * weight;
        sums.1 = sums
            .1
            .zip(output.stiffness)
            .map(|(sum, own)| sum + own * weight);
        sums.2 += output.displacement * weight;
    }
    Some(Sensitivity {
        parameter: PART_OF_NOTHING,
        name: Some(path.into()),
        value,
        compliance: sums.0,
        stiffness: sums.1,
        displacement: Some(sums.2),
    })
}

/// Differences of natural frequencies, those that are equal here by what they become on either side.
fn of_frequency(
    study: &Study,
    dependence: &Dependence,
    found: &ModalSensitivities,
    options: &ModalOptions,
) -> Option<Vec<f64>> {
    if dependence.slopes.is_empty() {
        return None;
    }
    let (studies, between) = beside(study, dependence)?;
    let mut sides = Vec::with_capacity(2);
    for (study, sign) in studies.iter().zip([1.0, -1.0]) {
        let options = ModalOptions {
            count: found.frequencies.len(),
            ..options.clone()
        };
        let modal = study.prepared.modal(&options).ok()?;
        let modes = modal.modes(study.model().geometry()).ok()?.modes;
        let pairs = modes.iter().zip(&found.frequencies);
        let slopes: Vec<f64> = pairs
            .map(|(mode, here)| sign * (mode.frequency - here) / (0.5 * between))
            .collect();
        if slopes.len() != found.frequencies.len() {
            return None;
        }
        sides.push(in_groups(slopes, found));
    }
    let pairs = sides[0].iter().zip(&sides[1]);
    Some(pairs.map(|(more, less)| 0.5 * (more + less)).collect())
}

/// Derivatives with those of equal frequencies ascending.
fn in_groups(mut derivatives: Vec<f64>, found: &ModalSensitivities) -> Vec<f64> {
    for group in &found.groups {
        if let Some(own) = derivatives.get_mut(group.clone()) {
            own.sort_by(f64::total_cmp);
        }
    }
    derivatives
}
