//! Answers that are worked out beforehand, for pages without the core.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use hyperstat_mechanisms::Registry;
use serde_json::{Value, json};

use super::View;
use crate::error::StudyError;
use crate::session::Session;
use crate::study::Study;

/// Most poses of a job that a page holds.
const MOST_POSES: usize = 41;

/// Values of each coordinate, where a mechanism is moved by one, two or more of them: the first three are.
const GRIDS: [&[usize]; 3] = [&[21], &[7, 7], &[5, 5, 3]];

/// Values of a map over one coordinate, and over each of two.
const MAPS: [usize; 2] = [101, 25];

/// Quantities that maps are of.
const MAPPED: [&str; 3] = ["deflection", "pure_force_stiffness_min", "softest_moment"];

/// Natural frequencies that are shown.
const MODES: usize = 6;

/// Answers with their requests.
struct Recorder {
    session: Session,
    answers: Vec<Value>,
}

impl Recorder {
    /// Asks, and keeps the answer; `None` where there is none.
    fn ask(&mut self, request: Value) -> Option<Value> {
        let answer = self.session.ask(&request.to_string());
        let value: Value = serde_json::from_str(&answer.json).ok()?;
        if value.get("error").is_some() {
            return None;
        }
        let mut own = json!({ "request": request, "value": value });
        if !answer.numbers.is_empty() {
            // What is drawn needs no more digits; stiffness and all that is told is in the object.
            let numbers = answer.numbers.iter();
            let bytes: Vec<u8> = numbers.flat_map(|n| (*n as f32).to_le_bytes()).collect();
            own["numbers"] = STANDARD.encode(bytes).into();
        }
        self.answers.push(own);
        Some(value)
    }
}

impl View {
    /// What a page without the core holds.
    pub(super) fn recorded(&self, registry: &Registry) -> Result<Value, StudyError> {
        let mut data = self.data();
        let mut recorder = Recorder {
            session: Session::new(registry.clone()),
            answers: Vec::new(),
        };
        let Some(loaded) = recorder.ask(data["load"].clone()) else {
            return Err(self.refused(registry));
        };
        for ask in ["values", "measures"] {
            recorder.ask(json!({ "ask": ask }));
        }
        let cases = loaded["cases"].as_array().cloned().unwrap_or_default();
        recorder.ask(json!({ "ask": "solve" }));
        for case in std::iter::once(None).chain(cases.iter().map(Some)) {
            let of_case = |mut request: Value| {
                if let Some(case) = case {
                    request["case"] = case.clone();
                }
                request
            };
            recorder.ask(of_case(json!({ "ask": "scene" })));
            recorder.ask(of_case(json!({ "ask": "frame" })));
            recorder.ask(of_case(json!({ "ask": "solve", "why": true })));
        }
        recorder.ask(json!({ "ask": "modes", "count": MODES }));
        let poses = poses(&loaded);
        for pose in &poses {
            recorder.ask(json!({ "ask": "frame", "pose": pose["pose"] }));
        }
        let maps: Vec<Value> = maps(&loaded);
        let is_there = |request: &Value| recorder.ask(request.clone()).is_some();
        data["maps"] = maps.into_iter().filter(is_there).collect();
        data["poses"] = poses.into();
        data["answers"] = recorder.answers.into();
        Ok(data)
    }

    /// Why the text is no mechanism.
    fn refused(&self, registry: &Registry) -> StudyError {
        let files: hyperstat_mechanisms::MemoryFiles = self.files.iter().map(own).collect();
        let path = self.main.as_ref();
        match Study::open(path, &self.selection, &files, registry) {
            Err(error) => error,
            // What can be opened can be loaded.
            Ok(study) => study.unsolvable(hyperstat_assembly::SolveError::Singular),
        }
    }
}

fn own<'a>((name, text): (&'a String, &'a String)) -> (&'a str, &'a str) {
    (name, text)
}

/// The poses of a job, evenly chosen where there are many; else those of a grid about the configuration.
fn poses(loaded: &Value) -> Vec<Value> {
    let jobs = loaded["jobs"].as_array();
    let job = jobs.and_then(|jobs| jobs.iter().find(|own| own["name"] == loaded["job"]));
    let count = job.and_then(|job| job["poses"].as_u64()).unwrap_or(0) as usize;
    if count > 1 {
        let shown = count.min(MOST_POSES);
        let number = |k: usize| (k * (count - 1) + (shown - 1) / 2) / (shown - 1);
        let pose =
            |number| json!({ "label": format!("pose {number}"), "pose": { "number": number } });
        return (0..shown).map(number).map(pose).collect();
    }
    let coordinates = loaded["coordinates"]
        .as_array()
        .cloned()
        .unwrap_or_default();
    let Some(counts) = coordinates.len().min(3).checked_sub(1).map(|k| GRIDS[k]) else {
        return Vec::new();
    };
    let total: usize = counts.iter().product();
    let grid = (0..total).map(|row| {
        let mut rest = row;
        let mut at = json!({});
        let mut label = Vec::new();
        for (coordinate, count) in coordinates.iter().zip(counts) {
            let value = between(coordinate, rest % count, *count);
            rest /= count;
            let name = coordinate["name"].as_str().unwrap_or_default();
            at[name] = value.into();
            label.push(format!("{name} = {}", crate::number::number(value)));
        }
        for coordinate in &coordinates[counts.len()..] {
            at[coordinate["name"].as_str().unwrap_or_default()] = coordinate["value"].clone();
        }
        json!({ "label": label.join(", "), "pose": { "at": at } })
    });
    grid.collect()
}

/// A value between the ends of a coordinate's range.
fn between(coordinate: &Value, place: usize, count: usize) -> f64 {
    let end = |name: &str| coordinate[name].as_f64().unwrap_or(0.0);
    let (from, to) = (end("from"), end("to"));
    from + (to - from) * place as f64 / (count - 1) as f64
}

/// Maps over the coordinate that the mechanism is moved by, or over every two of the first three.
fn maps(loaded: &Value) -> Vec<Value> {
    let coordinates = loaded["coordinates"]
        .as_array()
        .cloned()
        .unwrap_or_default();
    let own: Vec<&Value> = coordinates.iter().take(3).collect();
    let planes: Vec<Vec<&Value>> = match *own {
        [] => Vec::new(),
        [only] => vec![vec![only]],
        [first, second] => vec![vec![first, second]],
        [first, second, third, ..] => {
            vec![vec![first, second], vec![first, third], vec![second, third]]
        }
    };
    let mut maps = Vec::new();
    for plane in planes {
        let count = MAPS[plane.len() - 1];
        let axis = |own: &&Value| json!({ "name": own["name"], "first": own["from"], "last": own["to"], "count": count });
        let axes: Vec<Value> = plane.iter().map(axis).collect();
        let mut fixed = json!({});
        for other in coordinates.iter().filter(|own| !plane.contains(own)) {
            fixed[other["name"].as_str().unwrap_or_default()] = other["value"].clone();
        }
        for measure in MAPPED {
            let map = json!({ "ask": "sweep", "axes": axes, "fixed": fixed, "measure": measure });
            maps.push(map);
        }
    }
    maps
}
