//! A case study as tables in Markdown.

use std::fmt::Write;
use std::time::Duration;

use crate::measure::{Case, Errors, Row};
use crate::number::{milliseconds, power_of_ten, scientific};

const HEAD: &str = "\
| joint stiffness | springs in the matrix, free 0 | … free 10⁻⁷ | multipliers, free 10⁻⁷ \
| springs in the matrix, for rigid joints | multipliers, for rigid joints | this method, same springs |
|---|---|---|---|---|---|---|
";

/// Heading, numbers of equations and times, and one line a joint stiffness.
pub fn markdown(case: &Case) -> String {
    let mut out = format!("### {}\n\n", case.name);
    times(&mut out, case)
        .and_then(|()| write!(out, "\n{HEAD}"))
        .expect("a String takes everything");
    for row in &case.rows {
        line(&mut out, row).expect("a String takes everything");
    }
    out
}

/// The shortest times over all joint stiffnesses, on which they do not depend.
fn times(out: &mut String, case: &Case) -> std::fmt::Result {
    let shortest =
        |time: fn(&Row) -> Duration| case.rows.iter().map(time).min().unwrap_or_default();
    let pose = shortest(|row| row.pose_time);
    writeln!(
        out,
        "| | equations | time (ms) | over a pose one by one |\n|---|---|---|---|"
    )?;
    let lines = [
        (
            "traditional, springs in the matrix",
            case.equations,
            shortest(|row| row.traditional_time),
        ),
        (
            "traditional, multipliers for the joints too",
            case.lagrange_equations,
            shortest(|row| row.lagrange_time),
        ),
        (
            "this method, `solve`: with the plan, diagnosis, all displacements and wrenches",
            case.unknowns,
            shortest(|row| row.solve_time),
        ),
        ("this method, a pose one by one", case.unknowns, pose),
    ];
    for (name, equations, time) in lines {
        let ratio = time.as_secs_f64() / pose.as_secs_f64();
        writeln!(
            out,
            "| {name} | {equations} | {} | {ratio:.1} |",
            milliseconds(time)
        )?;
    }
    Ok(())
}

fn line(out: &mut String, row: &Row) -> std::fmt::Result {
    let error = |errors: Option<Errors>, which: fn(Errors) -> f64| {
        errors.map_or_else(|| "no result".into(), |e| scientific(which(e)))
    };
    writeln!(
        out,
        "| {} | {} | {} | {} | {} | {} | {} |",
        power_of_ten(row.exponent),
        error(row.traditional, |e| e.same_springs),
        error(row.traditional_not_free, |e| e.same_springs),
        error(row.lagrange, |e| e.same_springs),
        error(row.traditional, |e| e.rigid_joints),
        error(row.lagrange, |e| e.rigid_joints),
        scientific(row.ours),
    )
}
