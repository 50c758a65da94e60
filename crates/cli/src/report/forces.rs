//! Forces along segments and the worst point of every body.

use hyperstat_assembly::{
    BodyId, Model, SegmentForces, SegmentId, WorstPoint, section_wrench, stations,
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
                }
            });
            (body.name.clone(), BodyReport { worst })
        })
        .collect()
}

/// The worst points as a table, the worst first; `title` begins its heading.
pub(super) fn write_worst(bodies: &Entries<BodyReport>, title: &str, text: &mut String) {
    let named = bodies.0.iter();
    let mut worst: Vec<_> = named
        .filter_map(|(name, body)| Some((name, body.worst.as_ref()?)))
        .collect();
    if worst.is_empty() {
        return;
    }
    let limited = worst.iter().all(|(_, point)| point.utilisation.is_some());
    let measure = |point: &WorstReport| match point.utilisation {
        Some(utilisation) if limited => utilisation,
        _ => point.von_mises,
    };
    worst.sort_by(|(_, a), (_, b)| measure(b).total_cmp(&measure(a)));
    let heads = [
        "body",
        "segment",
        "at",
        "y",
        "z",
        "normal",
        "shear",
        "von Mises",
    ];
    let some_limit = worst.iter().any(|(_, point)| point.utilisation.is_some());
    let more = some_limit.then_some("utilisation");
    let heads: Vec<_> = heads.into_iter().chain(more).collect();
    let mut table = Table::new(2, &heads);
    for (name, point) in worst {
        let segment = point.segment.join("-");
        let size = point.y.hypot(point.z);
        let in_section =
            [point.y, point.z].map(|c| if c.abs() < ROUNDING * size { 0.0 } else { c });
        let mut row = vec![
            point.at,
            in_section[0],
            in_section[1],
            point.normal,
            point.shear,
            point.von_mises,
        ];
        if some_limit {
            row.push(point.utilisation.unwrap_or(f64::NAN));
        }
        table.row(&[name, &segment], row);
    }
    section(
        text,
        &format!(
            "{title} of every body: place along the segment (0 to 1), point of the section [m], \
             stresses [Pa]"
        ),
        table,
    );
}
