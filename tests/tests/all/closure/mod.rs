//! Poses by loop closure against the closed forms of the prebuilt mechanisms, and jobs that move a
//! mechanism of a file.

mod drives;
mod jobs;
mod lanes;
mod mechanisms;
mod prebuilt;
mod sliding;
