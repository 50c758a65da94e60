//! Forces on the ends of segments, and their largest stresses.

use hyperstat_study::SegmentReport;

use super::parts::{Rounding, WRENCH, heads};
use super::table::Table;

/// The forces on the ends of segments and their largest stresses as tables.
pub(super) fn segment_tables(segments: &[SegmentReport]) -> (Table, Table) {
    let mut forces = Table::new(3, &heads(&["body", "segment", "at"], WRENCH));
    let mut stresses = Table::new(2, &["body", "segment", "normal", "shear", "von Mises"]);
    let rounding = Rounding::of(segments.iter().flat_map(|segment| &segment.end_forces));
    for segment in segments {
        let name = segment.points.join("-");
        for (point, wrench) in segment.points.iter().zip(segment.end_forces) {
            forces.row(&[&segment.body, &name, point], rounding.shown(&wrench));
        }
        match &segment.stress {
            Some(stress) => stresses.row(
                &[&segment.body, &name],
                [stress.normal, stress.shear, stress.von_mises],
            ),
            None => stresses.remark(&[&segment.body, &name], "not found for this section"),
        }
    }
    (forces, stresses)
}
