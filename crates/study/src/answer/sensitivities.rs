//! What 1 % more of every parameter would change: of the deflection, and of natural frequencies.

use hyperstat_assembly::{
    FrequencySensitivity, Influence, ModalOptions, ModalSensitivities, Parameter, Sensitivity,
    Solution, SolveError, larger_first,
};
use serde::Serialize;

use super::{Rows, by_parameter, numbers, parameters, rows};
use crate::study::Study;

/// How the output answers to a parameter. Field names are those of the JSON output.
#[derive(Debug, Serialize)]
pub struct SensitivityReport {
    /// Its path, as `vary` takes it, or words.
    pub parameter: String,
    /// Of a stiffness that several joints have alike, told in words, the path that `vary` takes for all of
    /// them; not there where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path: Option<String>,
    /// Whether its derivatives are differences of the whole answer, not exact.
    #[serde(skip_serializing_if = "is_false")]
    pub by_differences: bool,
    /// Its value, SI.
    pub value: f64,
    /// Relative change of the budget's total per relative change of the parameter.
    pub relative: Option<f64>,
    /// Derivative of the output's displacement; `null` where there is none.
    pub displacement: Option<[f64; 6]>,
    /// Derivative of the output's compliance.
    pub compliance: Rows,
    /// Derivative of the output's stiffness, where it has one.
    pub stiffness: Option<Rows>,
    /// The parameters of the model that it is the sum of, with their weights; none by differences.
    #[serde(skip)]
    pub(crate) parts: Vec<(Parameter, f64)>,
}

/// How frequencies that are equal, mostly one, answer to the parameters.
#[derive(Debug, Serialize)]
pub struct FrequencyReport {
    /// Their numbers, from 1.
    pub modes: Vec<usize>,
    /// \[Hz\]
    pub frequency: f64,
    /// Of every parameter, the largest first.
    pub sensitivities: Vec<FrequencySensitivityReport>,
}

/// How equal frequencies answer to a parameter; of each of them, ascending.
#[derive(Debug, Serialize)]
pub struct FrequencySensitivityReport {
    /// Its path, as `vary` takes it, or words.
    pub parameter: String,
    /// Of a stiffness that several joints have alike, told in words, the path that `vary` takes for all of
    /// them; not there where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path: Option<String>,
    /// Whether its derivatives are differences of the whole answer, not exact.
    #[serde(skip_serializing_if = "is_false")]
    pub by_differences: bool,
    /// Its value, SI.
    pub value: f64,
    /// Relative change of each frequency per relative change of the parameter.
    pub relative: Option<Vec<f64>>,
    /// Derivatives \[Hz over the parameter's unit\].
    pub derivative: Vec<f64>,
}

impl SensitivityReport {
    /// Sensitivities of a solution, largest first by `relative`: with those by lengths, coordinates and axes,
    /// which take four solutions each, where these are asked for.
    pub(crate) fn all(
        study: &Study,
        influence: &Influence<'_>,
        solution: &Solution,
        (case, lengths): (Option<&str>, bool),
        relative: impl Fn(&Sensitivity) -> Option<f64>,
    ) -> Result<Vec<Self>, SolveError> {
        let mut found = influence.sensitivities(solution)?;
        let known = found.len();
        let mut parameters = by_parameter::of_output(study, &found, case);
        if lengths {
            parameters.extend(by_parameter::of_lengths(study, case));
        }
        let mut parts: Vec<_> = (0..known).map(|own| Some(vec![(own, 1.0)])).collect();
        for own in parameters {
            parts.push(own.parts);
            found.push(own.sensitivity);
        }
        let named = found.iter().map(|s| (s.name.as_deref(), &s.parameter));
        let names = parameters::names(study.model(), named);
        let parameter = |(own, weight): &(usize, f64)| (found[*own].parameter.clone(), *weight);
        let mut all: Vec<Self> = (found.iter().zip(names).zip(parts))
            .map(|((s, name), parts)| Self {
                parameter: name,
                path: parameters::path(study, s.name.as_deref(), &s.parameter),
                by_differences: parts.is_none(),
                parts: parts.iter().flatten().map(parameter).collect(),
                value: s.value,
                relative: relative(s),
                displacement: s.displacement.as_ref().map(numbers),
                compliance: rows(&s.compliance),
                stiffness: s.stiffness.as_ref().map(rows),
            })
            .collect();
        let size = |s: &Self| s.relative.unwrap_or(0.0).abs();
        all.sort_by(|a, b| larger_first(size(a), size(b)));
        Ok(all)
    }

    /// What the user should know about a parameter that has no derivative.
    pub(super) fn remark(&self) -> Option<String> {
        self.displacement.is_none().then(|| {
            format!(
                "sensitivities: with more of `{}` the weight would not be in balance on an idle \
                 motion, so that it has no derivative",
                self.parameter
            )
        })
    }
}

impl FrequencyReport {
    /// Those of a model, one a group of equal frequencies.
    pub fn all(study: &Study, found: &ModalSensitivities, options: &ModalOptions) -> Vec<Self> {
        let parameters = by_parameter::of_frequencies(study, found, options);
        let (own, differences): (Vec<_>, Vec<_>) = parameters.into_iter().unzip();
        let by_differences: Vec<bool> = std::iter::repeat_n(false, found.parameters.len())
            .chain(differences)
            .collect();
        let named = found.parameters.iter().chain(&own);
        let named = named.map(|s| (s.name.as_deref(), &s.parameter));
        let names = parameters::names(study.model(), named);
        let group = |group: &std::ops::Range<usize>| {
            let report = |(place, (s, name)): (usize, (&FrequencySensitivity, &String))| {
                FrequencySensitivityReport {
                    parameter: name.clone(),
                    path: parameters::path(study, s.name.as_deref(), &s.parameter),
                    by_differences: by_differences[place],
                    value: s.value,
                    relative: (group.clone())
                        .map(|place| s.relative(&found.frequencies, place))
                        .collect(),
                    derivative: s.derivatives[group.clone()].to_vec(),
                }
            };
            let all = found.parameters.iter().chain(&own).zip(&names).enumerate();
            let mut sensitivities: Vec<_> = all.map(report).collect();
            sensitivities.sort_by(|a, b| larger_first(a.size(), b.size()));
            Self {
                modes: group.clone().map(|place| place + 1).collect(),
                frequency: found.frequencies[group.start],
                sensitivities,
            }
        };
        found.groups.iter().map(group).collect()
    }
}

impl FrequencySensitivityReport {
    fn size(&self) -> f64 {
        largest(self.relative.as_deref().unwrap_or_default())
    }
}

// serde asks with a reference.
#[allow(clippy::trivially_copy_pass_by_ref)]
fn is_false(flag: &bool) -> bool {
    !flag
}

/// Largest size of some numbers.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size, value| value.abs().max(size))
}
