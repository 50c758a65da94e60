//! Loads of a mechanism file or of a job.

use hyperstat_assembly::Model;
use nalgebra::Vector6;

use crate::error::LoadError;
use crate::fields::Fields;
use crate::fragment::Fragment;
use crate::nodes;
use crate::source::Place;

/// Adds a list of loads to the model; returns where each stands.
pub(crate) fn read(list: Fragment<'_>, model: &mut Model) -> Result<Vec<Place>, LoadError> {
    let mut places = Vec::new();
    for load in list.list("a list of loads, `[(on: …, force: …)]`")? {
        let fields = Fields::read(load, "a load", &["on", "force", "moment"], &[])?;
        let node = nodes::on(model, fields.required("on")?, "a load")?;
        let mut wrench = Vector6::zeros();
        for (name, first) in [("force", 0), ("moment", 3)] {
            if let Some(given) = fields.get(name) {
                wrench
                    .fixed_rows_mut::<3>(first)
                    .copy_from(&given.vector()?);
            }
        }
        model
            .add_load(node, wrench)
            .map_err(|error| load.error(error.to_string()))?;
        places.push(load.place());
    }
    Ok(places)
}
