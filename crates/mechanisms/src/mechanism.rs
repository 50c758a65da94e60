//! One mechanism, as a file describes it.

use hyperstat_assembly::{BodyId, JointId, Model};
use hyperstat_elements::{Material, Section};
use nalgebra::Point3;

use crate::bodies::{self, Tables, check_name};
use crate::error::{LoadError, Location};
use crate::fields::Fields;
use crate::fragment::Fragment;
use crate::home::Home;
use crate::loads::Acting;
use crate::registry::Registry;
use crate::source::Place;
use crate::table::Table;
use crate::{joints, loads, materials, nodes};

/// A mechanism read from a file: its model, and the place of every part of it.
#[derive(Debug, Clone)]
pub struct Mechanism {
    /// The model, with its loads and output.
    pub model: Model,
    bodies: Vec<Place>,
    joints: Vec<Place>,
    loads: Vec<Place>,
    output: Place,
    materials: Vec<(String, Material)>,
    sections: Vec<(String, [Section; 2])>,
}

impl Mechanism {
    /// Reads the value of a mechanism file.
    pub(crate) fn read(fragment: Fragment<'_>, registry: &Registry) -> Result<Self, LoadError> {
        let known = [
            "name",
            "materials",
            "sections",
            "points",
            "bodies",
            "joints",
            "loads",
            "cases",
            "gravity",
            "masses",
            "output",
        ];
        let fields = Fields::read(fragment, "the mechanism", &known)?;
        let mut model = Model::new(fields.required("name")?.string()?);
        let tables = Tables {
            materials: Table::read(fields.get("materials"), "material", |entry, owner| {
                materials::material(entry.value, owner)
            })?,
            sections: Table::read(fields.get("sections"), "section", |entry, owner| {
                materials::profile(entry.value, owner)
            })?,
            points: Table::read(Some(fields.required("points")?), "point", |entry, _| {
                check_name(entry, "point")?;
                place(entry.value)
            })?,
        };
        let mut bodies = Vec::new();
        for entry in fields.required("bodies")?.map()? {
            bodies::read(&entry, &tables, &mut model)?;
            bodies.push(entry.key.place());
        }
        let mut joints = Vec::new();
        let point = |at: Fragment<'_>| tables.points.find(at).and_then(|_| at.string());
        for entry in fields.required("joints")?.map()? {
            joints::read(&entry, point, registry, &mut model)?;
            joints.push(entry.key.place());
        }
        let output = fields.required("output")?;
        model.set_output(nodes::on(&model, output, "the output")?);
        let field = |k: usize| fields.get(loads::FIELDS[k]);
        let loads = loads::read(field, &mut model, &Home::Here)?.unwrap_or_default();
        Ok(Self {
            model,
            bodies,
            joints,
            loads,
            output: output.place(),
            materials: (tables.materials.entries())
                .map(|(name, material)| (name.to_owned(), material.clone()))
                .collect(),
            sections: (tables.sections.entries())
                .map(|(name, profile)| (name.to_owned(), profile.ends()))
                .collect(),
        })
    }

    /// Puts what a job says of loads, cases, gravity, masses, misfits and preloads in place of the
    /// mechanism's own.
    pub(crate) fn replace(&mut self, acting: &Acting) -> Result<(), LoadError> {
        if let Some(loads) = acting.read(&mut self.model, &Home::Here)? {
            self.loads = loads;
        }
        Ok(())
    }

    /// The materials by their names in the file.
    pub fn materials(&self) -> &[(String, Material)] {
        &self.materials
    }

    /// The sections by their names in the file: what each is at its two ends.
    pub fn sections(&self) -> &[(String, [Section; 2])] {
        &self.sections
    }

    /// Place of a body's name.
    ///
    /// # Panics
    /// If the body is not one of this mechanism's model.
    pub fn locate_body(&self, body: BodyId) -> Location {
        self.bodies[body.0].location()
    }

    /// Place of a joint's name.
    ///
    /// # Panics
    /// If the joint is not one of this mechanism's model.
    pub fn locate_joint(&self, joint: JointId) -> Location {
        self.joints[joint.0].location()
    }

    /// Place of the value of `output`.
    pub fn locate_output(&self) -> Location {
        self.output.location()
    }

    /// Place of a load, by its index in [`Model::loads`]; in the batch file where a job's loads
    /// replaced the mechanism's own.
    ///
    /// # Panics
    /// If the model has fewer loads.
    pub fn locate_load(&self, load: usize) -> Location {
        self.loads[load].location()
    }
}

/// Largest coordinate of a point (m): with those beyond it, sums of squares and the stiffness of
/// what they span would overflow.
const FARTHEST: f64 = 1e50;

/// Reads the place of a point.
fn place(fragment: Fragment<'_>) -> Result<Point3<f64>, LoadError> {
    let place = fragment.vector()?;
    if place.amax() > FARTHEST {
        return Err(fragment
            .error(format!("no point can be farther than {FARTHEST:?} m"))
            .with_help("give the coordinates in metres"));
    }
    Ok(place.into())
}
