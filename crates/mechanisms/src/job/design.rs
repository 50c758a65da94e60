//! One design of a job: its mechanism with one choice of the varied values.

use std::ops::Range;
use std::sync::Arc;

use hyperstat_closure::Target;
use hyperstat_joints::Dof;
use hyperstat_model::{Geometry, JointId, LANES, Model};

use super::mover::Placing;
use super::poses::Poses;
use super::subject::{Checked, Recipe, Subject};
use super::vary::{Variation, Varied};
use crate::error::LoadError;
use crate::file::mechanism::Mechanism;
use crate::prebuilt::PoseError;
use crate::text::replace::Changed;
use crate::text::tree::{Node, Steps};
use crate::text::value::Value;

/// One design of a job, in all of the job's poses; made by [`Job::design`](crate::Job::design).
#[derive(Debug, Clone)]
pub struct Design {
    pub(crate) number: usize,
    pub(crate) values: Vec<Value>,
    pub(crate) subject: Arc<Subject>,
    pub(crate) poses: Arc<Poses>,
}

impl Mechanism {
    /// The mechanism as the only design of a job in its own configuration.
    pub fn design(&self) -> Design {
        Design {
            number: 0,
            values: Vec::new(),
            subject: Arc::new(Subject::of(Box::new(self.clone()))),
            poses: Arc::new(Poses::Own),
        }
    }
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

    /// Brings geometries, each as that of [`Design::place`], to these poses (from 0), the first of
    /// them to the first pose: at most [`LANES`] together, which is faster than one by one. What is
    /// found at a pose does not depend on the others; `placing` is kept from call to call.
    ///
    /// # Panics
    /// If a pose is not below [`Design::len`], or if there are more poses than geometries or [`LANES`].
    pub fn place_lanes(
        &self,
        poses: Range<usize>,
        geometries: &mut [Geometry],
        placing: &mut Placing,
    ) -> [Option<Result<[f64; 6], PoseError>>; LANES] {
        self.subject
            .place_lanes(&self.poses, poses, geometries, placing)
    }

    /// Brings `geometry`, as that of [`Design::place`], to a target that need be no pose of the job; returns
    /// the output's whole pose. A prebuilt mechanism is asked for all coordinates of the output that it
    /// takes, and for no others but zeros. `placing` is kept from call to call.
    ///
    /// # Errors
    /// The target cannot be reached, or is not one of this mechanism; `geometry` is then as it was.
    pub fn bring(
        &self,
        target: &Target<'_>,
        geometry: &mut Geometry,
        placing: &mut Placing,
    ) -> Result<[f64; 6], PoseError> {
        self.subject.bring(target, geometry, placing)
    }

    /// Which coordinates of the output (x y z, rx ry rz) it is brought to its poses by: those that a prebuilt
    /// mechanism takes; of one of a file independent ones, none where it cannot be moved.
    pub fn coordinates(&self) -> [bool; 6] {
        self.subject.independent()
    }

    /// The drives that it is brought to its poses by, by joints and directions; none of a prebuilt mechanism,
    /// and of one that cannot be moved.
    pub fn drives(&self) -> Vec<(JointId, Dof)> {
        self.subject.driven()
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
}

/// Designs that are tried before a job runs: all, if they are no more, else the first and so many
/// values of every path, each with the first values of the others.
const TRIED: usize = 10_000;

impl Designs {
    pub(crate) fn new(variation: Variation) -> Self {
        Self {
            varied: variation.varied(),
            variation,
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
        places.iter().map(|own| Value::of(&own.value)).collect()
    }

    /// The ways to what varies of the mechanism, in its tree.
    pub(crate) fn steps(&self) -> Vec<Steps> {
        let places = self.variation.places();
        places.filter_map(Recipe::in_mechanism).collect()
    }

    /// The tree of all that may vary, in a design.
    pub(crate) fn whole(&self, number: usize) -> Node {
        self.changed(number).tree()
    }

    /// The mechanism's tree in a design.
    pub(crate) fn tree(&self, number: usize, recipe: &Recipe) -> Node {
        recipe.root_of(&self.changed(number).tree())
    }

    fn changed(&self, number: usize) -> Changed<'_> {
        self.changed_of(self.variation.whole(), number)
    }

    fn changed_of<'v>(&'v self, root: &'v Node, number: usize) -> Changed<'v> {
        Changed {
            root,
            values: self.variation.design(number),
            whole: self.variation.place.clone(),
        }
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
        let trees = [self.variation.whole(), self.variation.settled()];
        let [whole, settled] = trees.map(|tree| self.changed_of(tree, number).tree());
        let checked = recipe.read_whole(&whole, &settled);
        checked.map_err(|error| self.refused(number, recipe, error))
    }

    /// The loader's error about a design, at the value that is to blame.
    fn refused(&self, number: usize, recipe: &Recipe, error: LoadError) -> LoadError {
        self.changed(number).refused(
            error,
            &format!("design {number}"),
            |location| self.variation.holds(location),
            |whole| recipe.read_whole(whole, whole).is_ok(),
        )
    }
}
