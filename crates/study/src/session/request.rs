//! What is asked.

use std::collections::BTreeMap;

use hyperstat_mechanisms::{Along, Value};
use serde::Deserialize;

/// What is asked of a session, by its field `ask`.
#[derive(Debug, Deserialize)]
#[serde(tag = "ask", rename_all = "lowercase")]
pub enum Request {
    /// Reads a file among others.
    Load(Load),
    /// The mechanism that was loaded with other values at some paths.
    Set {
        /// Paths, as `vary` names them, with numbers \[SI\] or texts.
        values: Vec<(String, ValueAsked)>,
    },
    /// The values that can be set.
    Values,
    /// The object of `solve --format json`.
    Solve {
        /// At this pose.
        #[serde(default)]
        pose: Option<PoseAsked>,
        /// So many natural frequencies.
        #[serde(default)]
        modes: Option<usize>,
        /// What is soft, and why.
        #[serde(default)]
        why: bool,
        /// Of this case.
        #[serde(default)]
        case: Option<String>,
        /// Along this direction.
        #[serde(default)]
        along: AlongAsked,
        /// With the independent solver's.
        #[serde(default)]
        verify: bool,
    },
    /// All that is drawn.
    Scene {
        /// At this pose.
        #[serde(default)]
        pose: Option<PoseAsked>,
        /// Displaced under this case.
        #[serde(default)]
        case: Option<String>,
    },
    /// What changes while the mechanism is moved.
    Frame {
        /// At this pose.
        #[serde(default)]
        pose: Option<PoseAsked>,
        /// Under this case.
        #[serde(default)]
        case: Option<String>,
        /// Budget along this direction.
        #[serde(default)]
        along: AlongAsked,
        /// So many natural frequencies; else those of the job, else three.
        #[serde(default)]
        modes: Option<usize>,
        /// Without natural frequencies and budget, which take longest.
        #[serde(default)]
        light: bool,
    },
    /// Inverse kinematics or loop closure alone.
    Place {
        /// To this pose.
        pose: PoseAsked,
    },
    /// Natural frequencies with their shapes.
    Modes {
        /// At this pose.
        #[serde(default)]
        pose: Option<PoseAsked>,
        /// So many.
        count: usize,
    },
    /// A quantity over one or two coordinates.
    Sweep(SweepAsked),
    /// The measures there are.
    Measures,
    /// The JSON Schema of files.
    Schema,
    /// Files to begin with.
    Beginnings,
    /// A text in even lines.
    Format {
        /// The text.
        text: String,
        /// Name of its file.
        #[serde(default)]
        name: Option<String>,
    },
    /// The mechanism as a file.
    Write {
        /// At this pose.
        #[serde(default)]
        pose: Option<PoseAsked>,
        /// In JSON, not RON.
        #[serde(default)]
        json: bool,
    },
}

/// What is loaded.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Texts of files by their names.
    pub files: BTreeMap<String, String>,
    /// Name of the file that is read.
    pub main: String,
    /// Job of a batch.
    #[serde(default)]
    pub job: Option<String>,
    /// Design of the job.
    #[serde(default)]
    pub design: Option<usize>,
    /// Pose of the job.
    #[serde(default)]
    pub pose: Option<usize>,
}

/// A pose.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PoseAsked {
    /// Of the job, by its number.
    Number(usize),
    /// Coordinates of the output \[m, rad\].
    At(BTreeMap<String, f64>),
    /// Values of drives \[m, rad\], `joint.direction`.
    Drives(BTreeMap<String, f64>),
}

/// A value that is set.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
pub enum ValueAsked {
    /// A number \[SI\].
    Number(f64),
    /// A text, as it would stand in the file.
    Text(String),
}

/// A direction.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(untagged)]
pub enum AlongAsked {
    /// That of the displacement.
    #[default]
    Displacement,
    /// By its name.
    Named(Named),
    /// A unit wrench.
    Wrench([f64; 6]),
}

/// The name of the direction that has one.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Named {
    /// That of the displacement.
    Displacement,
}

/// A quantity over a part of the workspace.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SweepAsked {
    /// One coordinate or two, of which the first runs fastest.
    pub axes: Vec<Axis>,
    /// What the others are; those that a prebuilt mechanism needs besides are as in the pose that was loaded.
    #[serde(default)]
    pub fixed: BTreeMap<String, f64>,
    /// Name of a measure, or of a column of stiffness or displacement.
    pub measure: String,
    /// Under this case.
    #[serde(default)]
    pub case: Option<String>,
    /// First row and the one after the last; else all.
    #[serde(default)]
    pub rows: Option<[usize; 2]>,
}

/// Evenly spaced values of a coordinate.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// `x` to `rz`.
    pub name: String,
    /// First value \[m, rad\].
    pub first: f64,
    /// Last value.
    pub last: f64,
    /// How many.
    pub count: usize,
}

impl Axis {
    /// The value at a place, both ends exact.
    pub(super) fn value(&self, place: usize) -> f64 {
        if place + 1 == self.count {
            return self.last;
        }
        let share = place as f64 / (self.count - 1) as f64;
        self.first + share * (self.last - self.first)
    }
}

impl From<AlongAsked> for Along {
    fn from(asked: AlongAsked) -> Self {
        match asked {
            AlongAsked::Displacement | AlongAsked::Named(Named::Displacement) => Self::Displacement,
            AlongAsked::Wrench(wrench) => Self::Wrench(wrench),
        }
    }
}

impl From<ValueAsked> for Value {
    fn from(asked: ValueAsked) -> Self {
        match asked {
            ValueAsked::Number(number) => Self::Number(number),
            ValueAsked::Text(text) => Self::Text(text),
        }
    }
}
