//! Large mechanisms are diagnosed by sparse elimination, small ones with complete pivoting: many
//! copies of a random mechanism in one model have the counts and motions of one, as many times.

use hyperstat_assembly::{
    BodyId, BodyKind, Connection, Member, Model, Motion, NodeId, Solution, analyse,
    redundant_constraints, solve,
};
use hyperstat_tests::agreement::{nearly_singular, stiffnesses_agree};
use hyperstat_tests::random::check_random_mechanisms;
use nalgebra::{DMatrix, Point3};
use proptest::prelude::*;

/// More bodies or joints than this make a mechanism large.
const SMALL: usize = 40;

/// `count` copies of a model that do not touch; the first has the output.
fn copies(model: &Model, count: usize) -> Model {
    let mut all = Model::new("copies");
    let geometry = model.geometry();
    for copy in 0..count {
        let first = all.nodes().len();
        for body in model.bodies() {
            let name = format!("{}-{copy}", body.name);
            let point = |n: &NodeId| (&*model.nodes()[n.0].point, geometry.positions[n.0]);
            let points: Vec<(&str, Point3<f64>)> = body.nodes.iter().map(point).collect();
            if body.kind == BodyKind::Rigid {
                all.add_rigid(&name, &points).expect("a rigid body");
                continue;
            }
            let place = |node| body.nodes.iter().position(|n| *n == node).expect("a node");
            let member = |id: &hyperstat_assembly::SegmentId| {
                let segment = &model.segments()[id.0];
                Member {
                    ends: segment.ends.map(place),
                    material: segment.material.clone(),
                    section: segment.section.clone(),
                    taper: segment.taper.clone(),
                    y_axis: geometry.y_axes[id.0],
                    elements: segment.elements,
                }
            };
            let members: Vec<Member> = body.segments.iter().map(member).collect();
            all.add_elastic(&name, &points, &members)
                .expect("an elastic body");
        }
        for (joint, frame) in model.joints().iter().zip(&geometry.frames) {
            let own = Connection {
                name: format!("{}-{copy}", joint.name),
                between: joint.between.map(|n| n.map(|n| NodeId(first + n.0))),
                ..joint.clone()
            };
            all.add_joint(own, *frame).expect("a joint");
        }
        for load in model.loads() {
            let node = NodeId(first + load.node.0);
            all.add_load(node, load.wrench).expect("a load");
        }
    }
    all.set_output(model.output().expect("an output"));
    all
}

/// Motions as columns over the bodies of one copy.
fn columns(motions: &[Motion], bodies: usize, copy: usize) -> DMatrix<f64> {
    let mut columns = DMatrix::zeros(6 * bodies, motions.len());
    for (k, motion) in motions.iter().enumerate() {
        for (BodyId(body), twist) in &motion.twists {
            if body / bodies == copy {
                let row = 6 * (body % bodies);
                columns.fixed_view_mut::<6, 1>(row, k).copy_from(twist);
            }
        }
    }
    columns
}

/// Rank of some columns with entries of about 1, by elimination with complete pivoting.
fn rank(columns: &DMatrix<f64>) -> usize {
    let mut left = columns.clone();
    for rank in 0..left.ncols() {
        let (row, column) = left.iamax_full();
        let pivot = left[(row, column)];
        if pivot.abs() < 1e-7 {
            return rank;
        }
        let pivot_row = left.row(row) / pivot;
        let factors = left.column(column).into_owned();
        left -= factors * pivot_row;
    }
    left.ncols()
}

/// Whether a copy of the large mechanism moves as the small one does.
fn same_motions(
    small: &[Motion],
    large: &[Motion],
    bodies: usize,
    count: usize,
) -> Result<(), TestCaseError> {
    prop_assert_eq!(large.len(), count * small.len());
    for copy in [0, count - 1] {
        let own: Vec<Motion> = (large.iter())
            .filter(|m| m.twists.iter().any(|(b, _)| b.0 / bodies == copy))
            .cloned()
            .collect();
        let own = columns(&own, bodies, copy);
        let small = columns(small, bodies, 0);
        let mut both = DMatrix::zeros(6 * bodies, small.ncols() + own.ncols());
        both.columns_mut(0, small.ncols()).copy_from(&small);
        both.columns_mut(small.ncols(), own.ncols()).copy_from(&own);
        prop_assert_eq!(rank(&own), small.ncols());
        prop_assert_eq!(rank(&both), small.ncols());
    }
    Ok(())
}

fn same_solution(small: &Solution, large: &Solution, count: usize) -> Result<(), TestCaseError> {
    prop_assert_eq!(large.mobility, count * small.mobility);
    prop_assert_eq!(large.unknowns >= small.unknowns, true);
    prop_assert_eq!(
        large.output.free_motions.len(),
        small.output.free_motions.len()
    );
    stiffnesses_agree(
        large.output.stiffness.as_ref(),
        small.output.stiffness.as_ref(),
        &small.floor,
    )
}

#[test]
fn many_copies_are_diagnosed_as_one_is() {
    check_random_mechanisms(Just(()), |model, ()| {
        let kinematics = analyse(model).expect("a small model");
        if kinematics.doubtful.is_some() {
            return Ok(false);
        }
        let bodies = model.bodies().len();
        let count = SMALL / bodies.max(model.joints().len()) + 1;
        let large = copies(model, count);
        prop_assert!(large.bodies().len().max(large.joints().len()) > SMALL);
        let found = analyse(&large).expect("a small model");
        prop_assert_eq!(found.mobility, count * kinematics.mobility);
        prop_assert_eq!(found.overconstraint, count * kinematics.overconstraint);
        prop_assert_eq!(found.doubtful, None);
        same_motions(&kinematics.motions, &found.motions, bodies, count)?;
        prop_assert_eq!(redundant_constraints(&large).len(), found.overconstraint);
        match (solve(model), solve(&large)) {
            (Ok(one), Ok(all)) if !nearly_singular(&one) => same_solution(&one, &all, count)?,
            // Copies that nothing holds are refused; the one with the output may be free.
            (Ok(_), Ok(_)) | (_, Err(_)) => {}
            (Err(error), Ok(_)) => return Err(TestCaseError::fail(error.to_string())),
        }
        Ok(true)
    });
}
