//! The worst points of bodies.

use std::collections::HashSet;

use hyperstat_assembly::larger_first;
use hyperstat_study::{BodyReport, Entries, ROUNDING, WorstReport};

use super::parts::section;
use super::table::Table;

/// The worst point of every body, the worst first; `title` begins its heading.
pub(super) fn write_worst(bodies: &Entries<BodyReport>, title: &str, text: &mut String) {
    write_worst_of(&[("", bodies)], title, usize::MAX, text);
}

/// The worst points of every body over several states, each with its name, the worst first, and no
/// more than `most` of them.
pub(super) fn write_worst_of(
    states: &[(&str, &Entries<BodyReport>)],
    title: &str,
    most: usize,
    text: &mut String,
) {
    let mut worst = Vec::new();
    for (state, bodies) in states {
        for (body, (name, found)) in bodies.iter().enumerate() {
            worst.extend((found.worst.iter()).map(|point| (body, name, *state, point)));
        }
    }
    if worst.is_empty() {
        return;
    }
    let has_limit = |point: &WorstReport| point.utilisation.is_some();
    let limited = worst.iter().all(|(.., point)| has_limit(point));
    let some_limit = worst.iter().any(|(.., point)| has_limit(point));
    let measure = |point: &WorstReport| match point.utilisation {
        Some(utilisation) if limited => utilisation,
        _ => point.von_mises,
    };
    worst.sort_by(|(.., a), (.., b)| larger_first(measure(a), measure(b)));
    // Of each body the state in which it is worst.
    let mut taken = HashSet::new();
    worst.retain(|(body, ..)| taken.insert(*body));
    let left = worst.len().saturating_sub(most);
    worst.truncate(most);
    let names: &[&str] = match states {
        [_] => &["body", "segment"],
        _ => &["body", "case", "segment"],
    };
    let heads = ["at", "y", "z", "normal", "shear", "von Mises", "ε", "γ"];
    let more = some_limit.then_some("utilisation");
    let heads: Vec<_> = (names.iter().copied()).chain(heads).chain(more).collect();
    let mut table = Table::new(names.len(), &heads);
    for (_, name, state, point) in worst {
        let segment = point.segment.join("-");
        let names = match states {
            [_] => vec![name, &segment],
            _ => vec![name, state, &segment],
        };
        table.row(&names, numbers(point, some_limit));
    }
    let left = match left {
        0 => String::new(),
        left => format!("  … and {left} more\n"),
    };
    section(
        text,
        &format!(
            "{title} of every body: place along the segment (0 to 1), point of the section [m], \
             stresses [Pa], normal strain ε, shear strain γ of torsion"
        ),
        format!("{table}{left}"),
    );
}

/// The numbers of its row.
fn numbers(point: &WorstReport, with_utilisation: bool) -> Vec<Option<f64>> {
    let size = point.y.hypot(point.z);
    let in_section = [point.y, point.z].map(|c| if c.abs() < ROUNDING * size { 0.0 } else { c });
    let told = [
        point.at,
        in_section[0],
        in_section[1],
        point.normal,
        point.shear,
        point.von_mises,
        point.strain.normal,
        point.strain.shear,
    ];
    // Of a material without a limit there is none.
    let utilisation = with_utilisation.then_some(point.utilisation);
    told.map(Some).into_iter().chain(utilisation).collect()
}
