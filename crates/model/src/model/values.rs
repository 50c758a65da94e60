//! The values that a model's parts are made of, and names for them.

use hyperstat_joints::Dof;

use crate::model::Model;
use crate::parts::{JointId, JointStiffness, SegmentId, ValuePlace};

impl Model {
    /// All dimensions, constants and stiffnesses of segments and joints, with their places.
    pub fn values(&self) -> Vec<(ValuePlace, f64)> {
        let mut values = Vec::new();
        for (k, own) in self.segments.iter().enumerate() {
            let segment = SegmentId(k);
            let ends = [
                (false, Some(&own.section)),
                (true, own.taper.as_ref().map(|t| &t.to)),
            ];
            for (second, section) in ends {
                let dimensions = section.into_iter().flat_map(|s| s.dimensions());
                values.extend(dimensions.map(|(dimension, value)| {
                    let place = ValuePlace::Dimension {
                        segment,
                        second,
                        dimension,
                    };
                    (place, value)
                }));
            }
            let constants = own.material.constants().into_iter();
            values.extend(
                constants
                    .map(|(constant, value)| (ValuePlace::Constant { segment, constant }, value)),
            );
        }
        for (k, own) in self.joints.iter().enumerate() {
            let JointStiffness::Directions(given) = &own.stiffness else {
                continue;
            };
            let joint = JointId(k);
            values.extend(Dof::ALL.into_iter().filter_map(|direction| {
                let value = given[direction.index()]?;
                Some((ValuePlace::Stiffness { joint, direction }, value))
            }));
        }
        values
    }

    /// Gives a value a name, such as its path in a file. Values of one name are one parameter of
    /// sensitivities; values of different names are not, however equal.
    pub fn name_value(&mut self, place: ValuePlace, name: impl Into<String>) {
        self.value_names.insert(place, name.into());
    }

    /// The name of a value, where it has one.
    pub fn value_name(&self, place: ValuePlace) -> Option<&str> {
        self.value_names.get(&place).map(String::as_str)
    }
}
