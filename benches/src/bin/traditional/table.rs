//! A case study as a table in Markdown.

use std::fmt::Write;

use crate::measure::{Case, Errors, Row};
use crate::number::{milliseconds, power_of_ten, scientific};

const HEAD: &str = "\
| joint stiffness | traditional, same springs, free 0 | … free 10⁻⁷ | traditional for rigid joints \
| this method, same springs | traditional (ms) | `solve` (ms) | pose of a sweep (ms) |
|---|---|---|---|---|---|---|---|
";

/// Heading, numbers of equations, and one line a joint stiffness.
pub fn markdown(case: &Case) -> String {
    let mut out = format!(
        "### {}\n\n{} equations by the traditional method, {} by this one.\n\n{HEAD}",
        case.name, case.equations, case.unknowns
    );
    for row in &case.rows {
        line(&mut out, row).expect("a String takes everything");
    }
    out
}

fn line(out: &mut String, row: &Row) -> std::fmt::Result {
    let error = |errors: Option<Errors>, which: fn(Errors) -> f64| {
        errors.map_or_else(|| "no result".into(), |e| scientific(which(e)))
    };
    writeln!(
        out,
        "| {} | {} | {} | {} | {} | {} | {} | {} |",
        power_of_ten(row.exponent),
        error(row.traditional, |e| e.same_springs),
        error(row.traditional_not_free, |e| e.same_springs),
        error(row.traditional, |e| e.rigid_joints),
        scientific(row.ours),
        milliseconds(row.traditional_time),
        milliseconds(row.solve_time),
        milliseconds(row.pose_time),
    )
}
