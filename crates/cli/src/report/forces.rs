//! Forces along segments and the worst point of every body.

use std::collections::HashSet;

use hyperstat_assembly::{
    BodyId, Model, SegmentForces, SegmentId, WorstPoint, larger_first, section_wrench, stations,
};
use serde::Serialize;

use super::{Entries, ROUNDING, Table, numbers, section};

/// Forces on a section of a segment.
#[derive(Debug, Serialize)]
pub(crate) struct SectionForces {
    /// Place along the segment, 0 at its first node and 1 at its second.
    at: f64,
    /// N Vy Vz T My Mz, element frame.
    wrench: [f64; 6],
}

/// What is found of a body.
#[derive(Debug, Serialize)]
pub(crate) struct BodyReport {
    /// The point with the largest stress; none of a body without beams.
    worst: Option<WorstReport>,
}

/// A point of a body and its stresses.
#[derive(Debug, Serialize)]
struct WorstReport {
    /// Names of the points at the segment's first and second node.
    segment: [String; 2],
    /// Place along the segment, 0 to 1.
    at: f64,
    /// The point of the section, element frame [m].
    y: f64,
    z: f64,
    normal: f64,
    shear: f64,
    von_mises: f64,
    utilisation: Option<f64>,
    strain: StrainReport,
}

/// Strains at a point of a section (Eq. 46), those of temperature included.
#[derive(Debug, Serialize)]
struct StrainReport {
    /// At the point, positive in tension.
    normal: f64,
    /// The largest of torsion in the section.
    shear: f64,
    /// ε γ_y γ_z κ_x κ_y κ_z of the section, element frame [–, 1/m].
    section: [f64; 6],
}

/// Section forces of a segment at the places where they are told.
pub(super) fn section_forces(
    model: &Model,
    segment: SegmentId,
    forces: &SegmentForces,
) -> Vec<SectionForces> {
    let stations = stations(forces).into_iter();
    let at = |at: f64| {
        let wrench = section_wrench(model, segment, forces, at)?;
        let wrench = numbers(&wrench);
        Some(SectionForces { at, wrench })
    };
    stations.filter_map(at).collect()
}

/// What is found of every body, by its worst point.
pub(super) fn bodies(
    model: &Model,
    worst_point: impl Fn(BodyId) -> Option<WorstPoint>,
) -> Entries<BodyReport> {
    let bodies = model.bodies().iter().enumerate();
    bodies
        .map(|(k, body)| {
            let worst = worst_point(BodyId(k)).map(|found| {
                let ends = model.segments()[found.segment.0].ends;
                WorstReport {
                    segment: ends.map(|node| model.nodes()[node.0].point.clone()),
                    at: found.xi,
                    y: found.point[0],
                    z: found.point[1],
                    normal: found.normal,
                    shear: found.shear,
                    von_mises: found.von_mises,
                    utilisation: found.utilisation,
                    strain: StrainReport {
                        normal: found.normal_strain,
                        shear: found.shear_strain,
                        section: found.section_strain.into(),
                    },
                }
            });
            (body.name.clone(), BodyReport { worst })
        })
        .collect()
}

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
        table.row(&names, point.numbers(some_limit));
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

impl WorstReport {
    /// The numbers of its row.
    fn numbers(&self, with_utilisation: bool) -> Vec<Option<f64>> {
        let size = self.y.hypot(self.z);
        let in_section = [self.y, self.z].map(|c| if c.abs() < ROUNDING * size { 0.0 } else { c });
        let told = [
            self.at,
            in_section[0],
            in_section[1],
            self.normal,
            self.shear,
            self.von_mises,
            self.strain.normal,
            self.strain.shear,
        ];
        // Of a material without a limit there is none.
        let utilisation = with_utilisation.then_some(self.utilisation);
        told.map(Some).into_iter().chain(utilisation).collect()
    }
}
