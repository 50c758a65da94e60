//! Names of the values of a prebuilt mechanism: their paths in the job.

use std::collections::HashMap;

use hyperstat_model::Model;

use super::subject::Subject;
use crate::file::value_names::numbers;
use crate::text::scope::Scope;
use crate::text::tree::{Node, Steps};

/// Names values of the model of a prebuilt mechanism, which is the subject's and written as `tree`, by
/// their paths: those that are the number that is written there.
pub(crate) fn of_prebuilt(tree: &Node, varied: &[Steps], subject: &Subject, model: &mut Model) {
    let values = Scope::tree(tree).map_or_else(|_| Vec::new(), |tree| tree.numbers());
    let values: HashMap<String, Option<f64>> = (values.into_iter())
        .map(|number| (number.path, number.value))
        .collect();
    let written: HashMap<String, f64> = (numbers(tree, varied).into_iter())
        .filter_map(|number| Some((values.get(&number.path).copied()??, number.path)))
        .map(|(value, path)| (path, value))
        .collect();
    let values: HashMap<_, f64> = model.values().into_iter().collect();
    for (place, path) in subject.origins() {
        let number = written.get(&path);
        if number.is_some() && number == values.get(&place) {
            model.name_value(place, path);
        }
    }
}
