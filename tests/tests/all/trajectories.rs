//! The paper's trajectory (Eq. 65) by the prebuilt delta and one plan, against the reference.

use hyperstat_assembly::{Prepared, solve};
use hyperstat_mechanisms::prebuilt::{Delta, Prebuilt};
use hyperstat_tests::{reference_text, stiffness, stiffness_difference, vector_differences};
use nalgebra::{Matrix6, Vector6};

/// A sweep takes one refinement step, a solve as many as help.
const AGREEMENT: f64 = 1e-12;

/// The same, with the rounding of the inverse of the printed stiffness, whose condition with lengths in
/// metres is some 1e3.
const ENERGY: f64 = 1e-11;

struct Row {
    pose: [f64; 3],
    displacement: Vector6<f64>,
    stiffness: Matrix6<f64>,
}

fn rows(file: &str) -> Vec<Row> {
    let text = reference_text(file);
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let records = reader.deserialize::<Vec<f64>>();
    records
        .map(|record| {
            let v = record.expect("numbers");
            let mut stiffness = Matrix6::zeros();
            let pairs = (0..6).flat_map(|r| (r..6).map(move |c| (r, c)));
            for ((r, c), value) in pairs.zip(&v[10..]) {
                stiffness[(r, c)] = *value;
                stiffness[(c, r)] = *value;
            }
            Row {
                pose: [v[1], v[2], v[3]],
                displacement: Vector6::from_column_slice(&v[4..10]),
                stiffness,
            }
        })
        .collect()
}

fn compare(delta: &Delta, file: &str) {
    let rows = rows(file);
    assert_eq!(rows.len(), 61);
    let mut model = delta.model(&rows[0].pose).expect("a reachable pose");
    let output = model.output().expect("an output");
    model
        .add_load(output, Vector6::new(-20.0, 10.0, 100.0, 5.0, 5.0, 8.0))
        .expect("a finite load");
    let prepared = Prepared::new(model.clone());
    assert_eq!(prepared.unknowns().expect("a plan"), 114);
    let mut workspace = prepared.workspace().expect("a plan");
    let mut geometry = model.geometry().clone();
    for row in &rows {
        delta
            .place(&row.pose, &mut geometry)
            .expect("a reachable pose");
        let swept = prepared.sweep(&geometry, &mut workspace).expect("a result");
        let k = swept.stiffness.expect("a stiffness");
        assert!(
            stiffness_difference(&k, &row.stiffness) < AGREEMENT,
            "{:?}",
            row.pose
        );
        let u = swept.displacement.expect("a displacement");
        let found = vector_differences([(&u, &row.displacement)], [0.0; 2]);
        assert!(
            found.iter().all(|d| *d < AGREEMENT),
            "{:?} {found:?}",
            row.pose
        );

        model
            .set_geometry(geometry.clone())
            .expect("a geometry of this model");
        // By a plan made there, and by that of the first pose.
        let there = prepared.at(&geometry).expect("a geometry of this model");
        for solution in [solve(&model), there.solve()] {
            let solution = solution.expect("a solution");
            assert!(stiffness_difference(&stiffness(&solution), &row.stiffness) < AGREEMENT);
            let pair = (&solution.output.displacement, &row.displacement);
            let found = vector_differences([pair], [0.0; 2]);
            assert!(
                found.iter().all(|d| *d < AGREEMENT),
                "{:?} {found:?}",
                row.pose
            );
        }
        // The strain energy of every unit state is half the reference's compliance along it.
        let influence = there.influence().expect("a held output");
        let compliance = row.stiffness.try_inverse().expect("a regular matrix");
        for k in 0..6 {
            let budget = influence.compliance_budget(&compliance, &Vector6::ith(k, 1.0));
            let apart = budget.rest.abs() / budget.total;
            assert!(apart < ENERGY, "{:?} {k}: {apart}", row.pose);
        }
    }
}

#[test]
fn rigid_joints() {
    compare(&Delta::paper(), "delta_trajectory_rigid.csv");
}

#[test]
fn elastic_joints() {
    let delta = Delta {
        joint_stiffness: [Some(1e8), Some(1e8), Some(1e8), Some(1e5), None, Some(1e5)],
        ..Delta::paper()
    };
    compare(&delta, "delta_trajectory_elastic.csv");
}
