//! What the parameters of a prebuilt mechanism of one's own may be: the same parts as those of the built-in
//! ones.

use hyperstat_elements::{Material, Section};

use crate::error::LoadError;
use crate::file::registry::Arguments;
use crate::parameters;
use crate::prebuilt::{Link, ParameterError};
use crate::text::dimension::Dimension;
use crate::text::fragment::Fragment;

impl Arguments<'_> {
    /// A number, SI, with any unit or none, if it is given.
    ///
    /// # Errors
    /// It is not a number or not finite.
    pub fn optional_number(&self, name: &str) -> Result<Option<f64>, LoadError> {
        let value = self.fields().get(name);
        value.map(Fragment::number).transpose()
    }

    /// A link `(section: …, material: …)` that must be given.
    ///
    /// # Errors
    /// It is missing; what is wrong with its section or material.
    pub fn link(&self, name: &str) -> Result<Link, LoadError> {
        parameters::link(self.fields(), name)
    }

    /// A section, such as `Circle(diameter: 0.014)`, that must be given.
    ///
    /// # Errors
    /// It is missing; what is wrong with it.
    pub fn section(&self, name: &str) -> Result<Section, LoadError> {
        parameters::section(self.fields().required(name)?)
    }

    /// A material, such as `(young: 2.1e11, poisson: 0.3)`, that must be given.
    ///
    /// # Errors
    /// It is missing; what is wrong with it.
    pub fn material(&self, name: &str) -> Result<Material, LoadError> {
        parameters::material(self.fields().required(name)?)
    }

    /// The stiffness of passive joints that turn about v, `joint_stiffness: (x: 1e8, …)` \[N/m, N·m/rad\]:
    /// `None` is rigid.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn joint_stiffness(&self) -> Result<[Option<f64>; 6], LoadError> {
        parameters::joint_stiffness(self.fields())
    }

    /// The stiffness of drives, `drive_stiffness` \[N/m, N·m/rad\]: `None` is rigid.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn drive_stiffness(&self) -> Result<Option<f64>, LoadError> {
        let of = [Dimension::STIFFNESS, Dimension::ROTATIONAL_STIFFNESS];
        parameters::drive_stiffness(self.fields(), &of)
    }

    /// The number of beam elements a link is divided into, `elements`: 1 where it is not given.
    ///
    /// # Errors
    /// It is no whole number from 1 to 1 000 000.
    pub fn elements(&self) -> Result<usize, LoadError> {
        parameters::elements(self.fields())
    }

    /// A parameter that the mechanism refuses, as an error at its place.
    pub fn refused(&self, error: &ParameterError) -> LoadError {
        parameters::refused(self.fields(), error)
    }
}
