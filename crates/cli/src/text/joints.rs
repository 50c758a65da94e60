//! Wrenches of joints.

use hyperstat_study::{Entries, JointReport};

use super::parts::Rounding;
use super::table::Table;

/// The wrenches of joints as a table.
pub(super) fn joint_table(joints: &Entries<JointReport>, heads: Vec<&str>) -> Table {
    let mut table = Table::new(1, &heads);
    let rounding = Rounding::of(joints.iter().filter_map(|(_, joint)| joint.wrench.as_ref()));
    for (name, joint) in joints.iter() {
        match joint.wrench {
            Some(wrench) => table.row(&[name], rounding.shown(&wrench)),
            None => table.remark(&[name], "not determined by statics"),
        }
    }
    table
}
