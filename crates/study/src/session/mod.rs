//! A session of a program that shows a mechanism and asks as its user moves: requests and answers as JSON, with
//! arrays of numbers beside them. One mechanism is loaded at a time, and what was worked out of it is kept.

mod answer;
mod drawn;
mod frame;
mod loaded;
mod map;
mod refused;
mod request;
mod values;

use hyperstat_mechanisms::{Registry, begin, beginnings, format, schema};
use serde_json::json;

pub use answer::Answer;
pub use frame::{Frame, Placed, Stressed};
pub use loaded::{JobInfo, Loaded, Movable};
pub use map::Mapped;
pub use refused::Refusal;
pub use request::{Axis, PoseAsked, Request};
pub use values::ValueInfo;

use crate::answer::Asked;
use crate::ask::Question;
use crate::measures::Measure;
use loaded::Subject;
use refused::Refused;

/// What a program that shows a mechanism holds.
#[derive(Debug)]
pub struct Session {
    registry: Registry,
    loaded: Option<Subject>,
    /// The same with other values, where some are set.
    changed: Option<Subject>,
}

impl Default for Session {
    fn default() -> Self {
        Self::new(Registry::builtin())
    }
}

impl Session {
    /// With nothing loaded yet, for mechanisms of these kinds.
    pub fn new(registry: Registry) -> Self {
        Self {
            registry,
            loaded: None,
            changed: None,
        }
    }

    /// Answers a request that is written as JSON. What is wrong is an answer too: `{"error": {"code": …,
    /// "message": …, …}}`.
    pub fn ask(&mut self, request: &str) -> Answer {
        let read = serde_json::from_str(request).map_err(Refused::from);
        match read.and_then(|request| self.answer(request)) {
            Ok(answer) => answer,
            Err(refused) => {
                Answer::of(&json!({ "error": Refusal::from(&refused) })).unwrap_or_default()
            }
        }
    }

    fn answer(&mut self, request: Request) -> Result<Answer, Refused> {
        match request {
            Request::Load(given) => {
                let subject = Subject::load(given, &self.registry)?;
                let answer = Answer::of(&subject.loaded()?)?;
                (self.loaded, self.changed) = (Some(subject), None);
                Ok(answer)
            }
            Request::Set { values } => {
                let loaded = self.loaded.as_ref().ok_or(Refused::NothingLoaded)?;
                let changed = match &*values {
                    [] => None,
                    values => Some(loaded.with_values(values)?),
                };
                let answer = Answer::of(&changed.as_ref().unwrap_or(loaded).loaded()?)?;
                self.changed = changed;
                Ok(answer)
            }
            Request::Values => Answer::of(&self.subject()?.values()),
            Request::Solve {
                pose,
                modes,
                why,
                case,
                along,
                verify,
            } => {
                let asked = why.then(|| Asked {
                    case,
                    along: along.into(),
                });
                let question = Question {
                    modes,
                    verify,
                    why: asked,
                    ..Question::default()
                };
                let subject = self.subject()?;
                let report = subject.at(pose.as_ref(), |study| {
                    let answered = study.answer(&question)?;
                    match study.free_output(&answered.solution) {
                        Some(error) => Err(error),
                        None => Ok(answered.report),
                    }
                })?;
                Answer::of(&report)
            }
            Request::Scene { pose, case } => self.subject()?.scene(pose.as_ref(), case.as_deref()),
            Request::Frame {
                pose,
                case,
                along,
                modes,
                light,
            } => {
                let asked = Asked {
                    case,
                    along: along.into(),
                };
                let subject = self.subject()?;
                let (frame, numbers) = subject.frame(pose.as_ref(), &asked, modes, light)?;
                Answer::with(&frame, numbers)
            }
            Request::Place { pose } => Answer::of(&self.subject()?.place(&pose)?),
            Request::Modes { pose, count } => self.subject()?.modes(pose.as_ref(), count),
            Request::Sweep(asked) => {
                let (mapped, numbers) = self.subject()?.sweep(asked)?;
                Answer::with(&mapped, numbers)
            }
            Request::Measures => {
                let own = |own: &Measure| json!({ "name": own.name, "words": own.words, "unit": own.unit });
                Answer::of(&Measure::all().iter().map(own).collect::<Vec<_>>())
            }
            Request::Schema => Ok(Answer {
                json: schema(&self.registry),
                numbers: Vec::new(),
            }),
            Request::Beginnings => {
                let text = |name: String| json!({ "text": begin(&name).ok(), "name": name });
                Answer::of(&beginnings().into_iter().map(text).collect::<Vec<_>>())
            }
            Request::Format { text, name } => {
                let name = name.as_deref().unwrap_or("mechanism.ron");
                Answer::of(&json!({ "text": format(&text, name.as_ref())? }))
            }
            Request::Write { pose, json } => {
                let registry = self.registry.clone();
                let text = self.subject()?.at(pose.as_ref(), |study| match json {
                    true => study.mechanism_file_json(&registry),
                    false => study.mechanism_file(&registry),
                })?;
                Answer::of(&json!({ "text": text }))
            }
        }
    }

    fn subject(&mut self) -> Result<&mut Subject, Refused> {
        let subject = self.changed.as_mut().or(self.loaded.as_mut());
        subject.ok_or(Refused::NothingLoaded)
    }
}
