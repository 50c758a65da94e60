//! The values of a mechanism that can be set.

use hyperstat_assembly::{JointId, Model, ValuePlace};
use hyperstat_joints::Dof;
use hyperstat_mechanisms::unit_of;
use serde::Serialize;

use super::loaded::Subject;
use crate::study::Study;

/// A value that can be set. Field names are those of the JSON.
#[derive(Debug, Serialize)]
pub struct ValueInfo {
    /// Its path, as `vary` takes it.
    pub path: String,
    /// \[SI\]
    pub value: f64,
    /// Its unit; empty of a pure number, and where it is not known.
    pub unit: String,
    /// `parameter`, `section`, `material`, `stiffness`, `mass` or `placing`.
    pub group: &'static str,
    /// What has it, as a budget names it: bodies by their names, joints as `joint NAME`; none where that is not
    /// known, as of parameters.
    pub parts: Vec<String>,
}

impl ValueInfo {
    fn new(path: String, value: f64, group: &'static str) -> Self {
        Self {
            unit: unit_of(&path),
            path,
            value,
            group,
            parts: Vec::new(),
        }
    }

    fn add(&mut self, part: String) {
        if !self.parts.contains(&part) {
            self.parts.push(part);
        }
    }
}

impl Subject {
    /// The values that can be set, each path once: parameters first, then what sections, materials, joints and
    /// masses have, then what says where parts stand and how long they are.
    pub(super) fn values(&mut self) -> Vec<ValueInfo> {
        self.study.name_values();
        let study = &self.study;
        let parameters = study.dependences().into_iter();
        let mut all: Vec<ValueInfo> = parameters
            .map(|own| ValueInfo::new(own.path, own.value, "parameter"))
            .collect();
        let model = study.model();
        let masses = model.masses().iter().enumerate();
        let masses = masses.map(|(mass, own)| (ValuePlace::Mass { mass }, own.mass.mass()));
        for (place, value) in model.values().into_iter().chain(masses) {
            let name = model.value_name(place).map(Into::into);
            let Some(path) = name.or_else(|| shared(study, place, value)) else {
                continue;
            };
            let known = all.iter().position(|own| own.path == path);
            let known = known.unwrap_or_else(|| {
                all.push(ValueInfo::new(path, value, group(place)));
                all.len() - 1
            });
            all[known].add(part(model, place));
        }
        for (path, value) in study.placing() {
            if !all.iter().any(|own| own.path == path) {
                all.push(ValueInfo::new(path, value, "placing"));
            }
        }
        all
    }
}

fn group(place: ValuePlace) -> &'static str {
    match place {
        ValuePlace::Dimension { .. } => "section",
        ValuePlace::Constant { .. } => "material",
        ValuePlace::Stiffness { .. } => "stiffness",
        ValuePlace::Mass { .. } => "mass",
    }
}

/// What has the value at a place.
fn part(model: &Model, place: ValuePlace) -> String {
    let body = match place {
        ValuePlace::Dimension { segment, .. } | ValuePlace::Constant { segment, .. } => {
            model.segments()[segment.0].body
        }
        ValuePlace::Mass { mass } => model.nodes()[model.masses()[mass].node.0].body,
        ValuePlace::Stiffness { joint, .. } => {
            return format!("joint {}", model.joints()[joint.0].name);
        }
    };
    model.bodies()[body.0].name.clone()
}

/// The path that takes a stiffness which several joints of one kind have alike, of all of them.
fn shared(study: &Study, place: ValuePlace, value: f64) -> Option<String> {
    let ValuePlace::Stiffness { joint, direction } = place else {
        return None;
    };
    let model = study.model();
    let kind = |joint: JointId| model.joints()[joint.0].joint.kind();
    let has = |own: JointId, dof: Dof, of: f64| {
        dof == direction && of == value && kind(own) == kind(joint)
    };
    let alike = model.values().into_iter();
    let alike = alike.filter_map(|(place, of)| match place {
        ValuePlace::Stiffness { joint, direction } => has(joint, direction, of).then_some(joint),
        _ => None,
    });
    study
        .file()?
        .stiffness_path(&alike.collect::<Vec<_>>(), direction)
}
