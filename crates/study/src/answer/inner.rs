//! Displacements of the nodes inside segments, by name.

use std::collections::HashMap;

use hyperstat_assembly::{Model, SegmentId, Solution, SolveError};
use nalgebra::Vector6;

use super::numbers;
use crate::entries::Entries;

/// Displacements of the nodes between the elements of all segments, in the order of the bodies'
/// segments. Node k of 1 to n − 1 of the segment from A to B is `body.A-B.k`, counted from A.
pub fn inner_displacements(
    model: &Model,
    solution: &Solution,
) -> Result<Entries<[f64; 6]>, SolveError> {
    inner_displacements_of(model, |segment| {
        solution.inner_displacements(model, segment)
    })
}

/// The same of a state whose displacements inside a segment `find` gives.
pub(super) fn inner_displacements_of(
    model: &Model,
    find: impl Fn(SegmentId) -> Result<Vec<Vector6<f64>>, SolveError>,
) -> Result<Entries<[f64; 6]>, SolveError> {
    let mut entries = Vec::new();
    for (k, name) in segment_names(model).into_iter().enumerate() {
        let found = find(SegmentId(k))?;
        let named = found.iter().enumerate();
        entries.extend(named.map(|(k, u)| (format!("{name}.{}", k + 1), numbers(u))));
    }
    Ok(Entries(entries))
}

/// Names of all segments: `body.A-B`.
pub fn segment_names(model: &Model) -> Vec<String> {
    let mut names = Vec::with_capacity(model.segments().len());
    let mut taken = HashMap::new();
    for segment in model.segments() {
        let body = &model.bodies()[segment.body.0].name;
        let [from, to] = segment.ends.map(|node| &model.nodes()[node.0].point);
        let mut name = format!("{body}.{from}-{to}");
        // Points whose names hold a `-` may give two segments one name (`A-B` to `C` and `A` to
        // `B-C`), as may two members of a model that is not from a file between the same points.
        let count = taken.entry(name.clone()).and_modify(|n| *n += 1);
        let count = *count.or_insert(1);
        if count > 1 {
            name += &format!("#{count}");
        }
        names.push(name);
    }
    names
}

#[cfg(test)]
mod tests {
    use hyperstat_assembly::{Connection, JointStiffness, Member, Model, solve};
    use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
    use hyperstat_joints::{DofSet, Fixed};
    use nalgebra::{Point3, Rotation3};

    use super::inner_displacements;

    #[test]
    fn segments_of_one_name_are_told_apart() {
        let mut model = Model::new("names");
        let material = Material::new(2.1e11, Elasticity::Poisson(0.3), None).unwrap();
        let section = Section::new(SectionShape::Circle { diameter: 0.01 }, None, None).unwrap();
        let names = ["A", "A-B", "B-C", "C"];
        let points: Vec<_> = (names.iter().enumerate())
            .map(|(k, name)| (*name, Point3::new(k as f64, 0.0, 0.0)))
            .collect();
        let members = [[0, 2], [1, 3], [0, 1]].map(|ends| Member {
            ends,
            material: material.clone(),
            section: section.clone(),
            taper: None,
            y_axis: None,
            elements: 3 - ends[0],
        });
        model.add_elastic("frame", &points, &members).unwrap();
        let weld = Connection {
            name: "weld".into(),
            between: [None, model.node("frame", "A")],
            joint: Box::new(Fixed),
            locked: DofSet::EMPTY,
            stiffness: JointStiffness::default(),
        };
        model.add_joint(weld, Rotation3::identity()).unwrap();
        model.set_output(model.node("frame", "C").unwrap());
        let found = inner_displacements(&model, &solve(&model).unwrap()).unwrap();
        let names: Vec<_> = found.0.iter().map(|(name, _)| name.as_str()).collect();
        let expected = ["A-B-C.1", "A-B-C.2", "A-B-C#2.1", "A-A-B.1", "A-A-B.2"];
        assert_eq!(names, expected.map(|name| format!("frame.{name}")));
    }
}
