//! Figures of all kinds, drawn, captioned and written in one way: for `hyperstat plot` and for the
//! `figures` of a job.

mod budget;
mod coordinates;
mod deformed;
mod drawing;
mod form;
mod job;
mod labels;
mod lines;
mod map;
mod notes;
mod of_study;
mod plane;
mod pose;
mod quantity;
mod rows;
mod second;
mod solved;
mod tables;
mod trajectory;

pub use budget::{budget, compared, in_words};
pub use deformed::{compare, deformed, mode};
pub use drawing::Drawing;
pub use form::Form;
pub use job::{check, draw, names};
pub use labels::Labels;
pub use lines::{Lines, figure as lines};
pub use map::{Map, figure as map};
pub use notes::viewpoint;
pub use of_study::Look;
pub use pose::{of_job as pose_of_job, of_table as pose_of_table};
pub use quantity::{Drawn, instead_of};
pub use rows::{Choice, first_design};
pub use solved::Solved;
pub use tables::{NamedTable, beside, ratio};
#[cfg(feature = "parts")]
pub(crate) use trajectory::Path;
pub use trajectory::{Trajectory, of_table as trajectory};
