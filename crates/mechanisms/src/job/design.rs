//! One design of a job: its mechanism with one choice of the varied values.

use std::ops::Range;
use std::sync::Arc;

use hyperstat_model::{Geometry, Model};

use super::poses::Poses;
use super::subject::{Checked, Recipe, Subject};
use super::value::{Value, Varied};
use super::vary::Variation;
use crate::error::LoadError;
use crate::file::mechanism::Mechanism;
use crate::prebuilt::PoseError;
use crate::text::fragment::Fragment;
use crate::text::overlay::{Known, Overlay};
use crate::text::source::Place;

/// One design of a job, in all of the job's poses; made by [`Job::design`](crate::Job::design).
#[derive(Debug, Clone)]
pub struct Design {
    pub(crate) number: usize,
    pub(crate) values: Vec<Value>,
    pub(crate) subject: Arc<Subject>,
    pub(crate) poses: Arc<Poses>,
}

impl Design {
    /// Its number in the job, from 0.
    pub fn number(&self) -> usize {
        self.number
    }

    /// The varied values, in the order of [`Job::varied`](crate::Job::varied).
    pub fn values(&self) -> &[Value] {
        &self.values
    }

    /// Number of poses, at least 1; the same in every design.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.poses.len()
    }

    /// The model with the job's loads, in pose 0 or, where that cannot be reached, in another pose
    /// that can, which need not be one of the job's.
    ///
    /// # Errors
    /// Why pose 0 cannot be reached, where no other pose was found.
    pub fn model(&self) -> Result<Model, PoseError> {
        self.subject.model()
    }

    /// Brings `geometry`, which belongs to a model of [`Design::model`], to `pose` (from 0);
    /// returns the output's whole pose x y z \[m\] and rotation vector rx ry rz \[rad\] from its
    /// home orientation.
    ///
    /// # Errors
    /// The pose cannot be reached; `geometry` is then as it was.
    ///
    /// # Panics
    /// If `pose` is not below [`Design::len`].
    pub fn place(&self, pose: usize, geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        self.subject.place(&self.poses, pose, geometry)
    }

    /// The mechanism, where it comes from a file; its loads are the job's.
    pub fn mechanism(&self) -> Option<&Mechanism> {
        self.subject.mechanism()
    }
}

/// The designs of a job, of which each is made when it is asked for.
#[derive(Debug)]
pub(crate) struct Designs {
    variation: Variation,
    varied: Vec<Varied>,
    /// The mechanism's text, taken apart.
    known: Known,
}

/// Designs that are tried before a job runs: all, if they are no more, else the first and so many
/// values of every path, each with the first values of the others.
const TRIED: usize = 10_000;

impl Designs {
    /// `known` is what was learnt from reading the mechanism as it is written.
    pub(crate) fn new(variation: Variation, known: Known) -> Self {
        Self {
            varied: variation.varied(),
            variation,
            known,
        }
    }

    /// The first design that can be, and its number; `written` is the mechanism as it is written.
    ///
    /// # Errors
    /// What cannot be read in any of the designs that are tried; the error of design 0, where none of
    /// them can be.
    pub(crate) fn first(
        &self,
        recipe: &Recipe,
        poses: &Poses,
        written: &Subject,
    ) -> Result<(usize, Subject), LoadError> {
        let samples = self.variation.samples(TRIED);
        for number in &samples {
            match self.read(*number, recipe) {
                Err(error) if error.is_unreadable() => return Err(error),
                _ => {}
            }
        }
        let load = |number| {
            let subject = self.load(number, recipe, poses, written)?;
            Ok((number, subject))
        };
        let mut others = (1..self.len().min(TRIED)).chain(samples);
        load(0).or_else(|error| others.find_map(|number| load(number).ok()).ok_or(error))
    }

    /// Number of designs.
    pub(crate) fn len(&self) -> usize {
        self.variation.len()
    }

    /// What varies, in the order of the file.
    pub(crate) fn varied(&self) -> &[Varied] {
        &self.varied
    }

    /// The varied values of a design.
    pub(crate) fn values(&self, number: usize) -> Vec<Value> {
        let places = self.variation.design(number);
        places.iter().map(Value::at).collect()
    }

    /// What stands in for which bytes of the mechanism's text in a design.
    pub(crate) fn replaced(&self, number: usize) -> Vec<(Range<usize>, Place)> {
        let values = self.variation.design(number);
        self.variation.spans().zip(values).collect()
    }

    /// Makes a design of a job with these poses; `similar` is another one.
    pub(crate) fn load(
        &self,
        number: usize,
        recipe: &Recipe,
        poses: &Poses,
        similar: &Subject,
    ) -> Result<Subject, LoadError> {
        let checked = self.read(number, recipe)?;
        let subject = recipe.load(checked, poses, Some(similar));
        subject.map_err(|error| self.refused(number, recipe, error))
    }

    fn read(&self, number: usize, recipe: &Recipe) -> Result<Checked, LoadError> {
        let values = self.variation.design(number);
        let checked = self.read_with(&values, |_| true, recipe);
        checked.map_err(|error| self.refused(number, recipe, error))
    }

    /// Reads the mechanism with those of the varied values, by their number, that are `taken`.
    fn read_with(
        &self,
        values: &[Place],
        taken: impl Fn(usize) -> bool,
        recipe: &Recipe,
    ) -> Result<Checked, LoadError> {
        let spans = self.variation.spans().zip(values).enumerate();
        let spans = spans.filter(|(k, _)| taken(*k));
        let replaced = spans.map(|(_, (span, value))| (span, Fragment::at(value)));
        let overlay = Overlay::new(replaced.collect(), &self.known);
        recipe.read(recipe.root().under(&overlay))
    }

    /// The loader's error about a design, at the value that is to blame: the one at which it
    /// stands; else one that is wrong among the values as they are written; else all of them.
    fn refused(&self, number: usize, recipe: &Recipe, error: LoadError) -> LoadError {
        let LoadError::At {
            location,
            message,
            help,
            unreadable,
        } = error
        else {
            return error;
        };
        if self.variation.holds(&location) {
            let message = format!("design {number}: {message}");
            return LoadError::At {
                location,
                message,
                help,
                unreadable,
            };
        }
        let values = self.variation.design(number);
        let alone = |k: &usize| {
            self.read_with(&values, |other| other == *k, recipe)
                .is_err()
        };
        let blamed = (0..values.len()).find(alone);
        let place = blamed.map_or(&self.variation.place, |k| &values[k]);
        let values = values.iter().zip(&self.varied).enumerate();
        let values = values.filter(|(k, _)| blamed.is_none_or(|blamed| blamed == *k));
        let words =
            values.map(|(_, (value, varied))| format!("`{}` = {}", varied.path, Value::at(value)));
        let words: Vec<String> = words.collect();
        LoadError::At {
            message: format!(
                "design {number}, {}: {message} ({location})",
                words.join(", ")
            ),
            location: Box::new(place.location()),
            help,
            unreadable,
        }
    }
}
