//! Why a model has no mechanism file.

use thiserror::Error;

/// A model that no mechanism file describes.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The model has no output.
    #[error("the model has no output")]
    NoOutput,
    /// Bodies that place a point of one name differently.
    #[error("point `{point}` of body `{body}` is elsewhere than that of another body")]
    TwoPlaces {
        /// Name of the point.
        point: String,
        /// The second body.
        body: String,
    },
    /// A body whose stiffness stands in a file of its own.
    #[error("the stiffness of body `{body}` stands in a file of its own, not in a mechanism file")]
    Flexible {
        /// Name of the body.
        body: String,
    },
    /// A load in axes that turn with a body of which nothing says how it lies.
    #[error(transparent)]
    Axes(#[from] hyperstat_model::NoBodyFrame),
    /// A joint between two points of different names.
    #[error("joint `{joint}` joins point `{first}` to point `{second}`")]
    TwoPoints {
        /// Name of the joint.
        joint: String,
        /// Name of the first body's point.
        first: String,
        /// Name of the second body's point.
        second: String,
    },
    /// A joint of a kind that the registry has no writer for.
    #[error("joint `{joint}`: nothing says how a `{kind}` is written")]
    UnknownKind {
        /// Name of the joint.
        joint: String,
        /// Its kind.
        kind: String,
    },
    /// A load that turns with a body which is neither the one that it is on nor that of the output.
    #[error(
        "a load on body `{on}` turns with body `{body}`: a file names the body itself or that of the output"
    )]
    TurnsWith {
        /// What it is on.
        on: String,
        /// What it turns with.
        body: String,
    },
}
