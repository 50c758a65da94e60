//! What is registered from the beginning.

use crate::file::kinds;
use crate::file::registry::Registry;
use crate::parameters;

impl Registry {
    /// The built-in joint kinds, `Fixed`, `Revolute`, `Prismatic`, `Cylindrical`, `Screw`, `Universal`,
    /// `Spherical` and `Planar`, and the built-in mechanisms of [`prebuilt`](crate::prebuilt).
    pub fn builtin() -> Self {
        let mut registry = Self::empty();
        kinds::register(&mut registry);
        parameters::register(&mut registry);
        registry
    }
}
