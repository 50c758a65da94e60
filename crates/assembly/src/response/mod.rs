//! How the answer follows from its parts: influence, budget, sensitivities.

pub(crate) mod budget;
pub(crate) mod gives;
pub(crate) mod influence;
pub(crate) mod load_change;
pub(crate) mod parameters;
pub(crate) mod sensitivity;
pub(crate) mod slopes;
