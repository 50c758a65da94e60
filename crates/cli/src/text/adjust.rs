//! The report of `hyperstat adjust`.

use std::fmt::Write as _;

use hyperstat_study::AdjustReport;

use super::parts::section;
use super::table::Table;

/// The report as text.
pub(crate) fn adjust(report: &AdjustReport) -> String {
    let mut text = format!("{}\n\n", report.name);
    let Some(freedoms) = report.freedoms else {
        text += "Nothing is moved: its freedoms are finite as they are.\n";
        return text;
    };
    let missed = report.missed.last().copied().unwrap_or(0.0);
    let rows = [
        ("freedoms", freedoms.to_string()),
        ("missed by", format!("{missed:.1e}")),
        ("loops open by", format!("{:.1e}", report.open)),
        ("beams bent by", format!("{:.1e}", report.bent)),
        ("after the moves", format!("{:.1e}", report.misfit)),
        ("rounded to", report.rounded.clone().unwrap_or_default()),
        (
            "largest move",
            format!("{:.2} roundings", report.most_roundings),
        ),
    ];
    for (name, value) in rows {
        let _ = writeln!(text, "  {name:<15}  {value}");
    }
    let mut table = Table::new(1, &["", "distance", "roundings"]);
    for own in &report.moved {
        table.row(&[&own.path], [own.distance, own.roundings]);
    }
    section(&mut text, "What moves [m; axes: 1]", table);
    text
}
