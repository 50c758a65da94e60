//! The cases of a mechanism.

use hyperstat_study::CaseReport;

use super::forces::write_worst;
use super::joints::joint_table;
use super::parts::{WRENCH, displacement_table, heads, output_table, section};
use super::segments::segment_tables;

/// The case as tables.
pub(super) fn write(case: &CaseReport, name: &str, text: &mut String) {
    let title = |what: &str| format!("Case `{name}`: {what}");
    let table = output_table(&case.output.displacement, &case.displacements);
    section(text, &title("displacement of the output [m, rad]"), table);
    let table = displacement_table(&case.displacements);
    section(text, &title("displacements of the nodes [m, rad]"), table);
    if !case.joints.is_empty() {
        let table = joint_table(&case.joints, heads(&["joint"], WRENCH));
        let heading =
            "joint wrenches, on the second body, at the joint, in the joint frame [N, N·m]";
        section(text, &title(heading), table);
    }
    if !case.segments.is_empty() {
        let (forces, stresses) = segment_tables(&case.segments);
        section(
            text,
            &title("forces on the ends of segments, in the element frame [N, N·m]"),
            forces,
        );
        section(text, &title("largest stresses of segments [Pa]"), stresses);
    }
    write_worst(&case.bodies, &title("worst point"), text);
}
