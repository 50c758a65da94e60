//! What is drawn of what is loaded: scenes and shapes of modes.

use hyperstat_assembly::SolveError;
use serde_json::json;

use super::answer::{Answer, append};
use super::loaded::Subject;
use super::refused::{Refusal, Refused};
use super::request::PoseAsked;
use crate::answer::ModesReport;
use crate::entries::Entries;
use crate::schema::STATUS;

impl Subject {
    /// All that is drawn.
    pub(super) fn scene(
        &mut self,
        pose: Option<&PoseAsked>,
        case: Option<&str>,
    ) -> Result<Answer, Refused> {
        self.at(pose, |study| {
            let solved = study.solve();
            let (scene, numbers) = study.scene(solved.as_ref().ok(), case)?;
            let free = solved.as_ref().ok().and_then(|own| study.free_output(own));
            let problem = solved.as_ref().err().or(free.as_ref()).map(Refusal::from);
            let status = problem.as_ref().map_or("ok", |own| match &*own.code {
                "unrestrained" | "free-output" => "unrestrained",
                _ => "failed",
            });
            let mut value = json!(scene);
            value[STATUS] = json!(status);
            value["problem"] = json!(problem);
            Ok((value, numbers))
        })
        .and_then(|(value, numbers)| Answer::with(&value, numbers))
    }

    /// Natural frequencies with their shapes.
    pub(super) fn modes(
        &mut self,
        pose: Option<&PoseAsked>,
        count: usize,
    ) -> Result<Answer, Refused> {
        self.at(pose, |study| {
            let Some(options) = study.modal_options(Some(count), None) else {
                return Err(study.unsolvable(SolveError::NoMass));
            };
            let found = study.modes(&options)?;
            let model = study.model();
            let mut numbers = Vec::new();
            let mut modes = Vec::new();
            for mode in &found.modes {
                let bodies = model.bodies().iter().zip(&mode.kinetic);
                let shares = bodies.map(|(body, share)| (body.name.clone(), *share));
                let shape = append(&mut numbers, study.mode_shape(mode)?);
                modes.push(json!({
                    "frequency": mode.frequency,
                    "effective_mass": mode.effective_mass,
                    "kinetic_energy": shares.collect::<Entries<f64>>(),
                    "shape": shape,
                }));
            }
            let report = ModesReport::new(model, &found, &options, false);
            let told = json!({ "modes": modes, "mass": report.mass, "remarks": report.remarks });
            Ok((told, numbers))
        })
        .and_then(|(value, numbers)| Answer::with(&value, numbers))
    }
}
