//! Segments divided into elements: nothing changes, and the nodes inside are where they should be.

use hyperstat_assembly::{Member, Model, SegmentId, Solution, Tapering, solve};
use hyperstat_elements::{Section, SectionShape};
use hyperstat_joints::{Fixed, Universal};
use hyperstat_mechanisms::prebuilt::{Delta, Prebuilt};
use hyperstat_tests::build::{circle, connection, member, node, steel, weld_to_ground};
use hyperstat_tests::{stiffness, stiffness_difference, vector_differences};
use nalgebra::{Point3, Rotation3, Vector3, Vector6};

/// What is asked for; all comparisons are far better.
const AGREEMENT: f64 = 1e-9;
const LOAD: [f64; 6] = [-20.0, 10.0, 100.0, 5.0, 5.0, 8.0];

/// The paper's delta with elastic joints, loaded, at a pose off its axis.
fn delta(elements: usize) -> Model {
    let delta = Delta {
        joint_stiffness: [Some(1e8), Some(1e8), Some(1e8), Some(1e5), None, Some(1e5)],
        elements,
        ..Delta::paper()
    };
    let mut model = delta.model(&[0.05, -0.08, 0.5]).expect("a reachable pose");
    let output = model.output().expect("an output");
    model.add_load(output, LOAD.into()).expect("a finite load");
    model
}

fn inner(solution: &Solution, model: &Model, segment: usize) -> Vec<Vector6<f64>> {
    solution
        .inner_displacements(model, SegmentId(segment))
        .expect("displacements")
}

fn assert_agree<'a>(
    pairs: impl IntoIterator<Item = (&'a Vector6<f64>, &'a Vector6<f64>)>,
    what: &str,
) {
    let differences = vector_differences(pairs, [0.0; 2]);
    assert!(
        differences.iter().all(|d| *d < AGREEMENT),
        "{what}: {differences:?}"
    );
}

#[test]
fn a_thousand_elements_in_every_segment_of_the_delta_change_nothing() {
    let [one, two, many] = [1, 2, 1000].map(delta);
    let [whole, halves, fine] = [&one, &two, &many].map(|m| solve(m).expect("a solution"));
    assert_eq!(fine.unknowns, whole.unknowns);
    let difference = stiffness_difference(&stiffness(&fine), &stiffness(&whole));
    assert!(difference < AGREEMENT, "{difference}");
    assert_agree(fine.displacements.iter().zip(&whole.displacements), "nodes");
    for k in 0..many.segments().len() {
        assert!(inner(&whole, &one, k).is_empty());
        let (fine, halves) = (inner(&fine, &many, k), inner(&halves, &two, k));
        assert_eq!((fine.len(), halves.len()), (999, 1));
        assert_agree([(&fine[499], &halves[0])], "middles");
    }
}

/// Node by node along every segment of the delta, by the deformation of one piece after the other
/// under the segment's end force: textbook formulas, nothing of the beam elements.
#[test]
fn inner_nodes_follow_a_chain_of_small_pieces() {
    let model = delta(1000);
    let solution = solve(&model).expect("a solution");
    for (k, segment) in model.segments().iter().enumerate() {
        let (young, shear) = (segment.material.young(), segment.material.shear());
        let s = &segment.section;
        let forces = &solution.segments[k];
        let frame = forces.frame;
        let piece = forces.length / segment.elements as f64;
        let [first, last] = segment.ends.map(|n| solution.displacements[n.0]);
        let mut u = local(&frame, &first);
        let end = forces.ends[1];
        let mut found = inner(&solution, &model, k);
        found.push(last);
        let mut chain = Vec::new();
        for (step, _) in found.iter().enumerate() {
            // Force and moment on the far end of this piece.
            let arm = forces.length - (step + 1) as f64 * piece;
            let (n, vy, vz) = (end[0], end[1], end[2]);
            let (t, my, mz) = (end[3], end[4] - arm * vz, end[5] + arm * vy);
            let h = piece;
            let (ey, ez) = (young * s.iy(), young * s.iz());
            let strained = Vector6::new(
                n * h / (young * s.area()),
                vy * h.powi(3) / (3.0 * ez) + mz * h * h / (2.0 * ez),
                vz * h.powi(3) / (3.0 * ey) - my * h * h / (2.0 * ey),
                t * h / (shear * s.torsion()),
                my * h / ey - vz * h * h / (2.0 * ey),
                mz * h / ez + vy * h * h / (2.0 * ez),
            );
            u[1] += h * u[5];
            u[2] -= h * u[4];
            u += strained;
            chain.push(local(&frame.inverse(), &u));
        }
        assert_agree(found.iter().zip(&chain), &format!("segment {k}"));
    }
}

/// A vector of two parts in the axes of `frame`.
fn local(frame: &Rotation3<f64>, v: &Vector6<f64>) -> Vector6<f64> {
    hyperstat_tests::turned(&frame.inverse(), v)
}

fn rectangle(width: f64, height: f64) -> Section {
    let shape = SectionShape::Rectangle { width, height };
    Section::new(shape, Some(0.8 * width * height), None).expect("a section")
}

/// A bent bar of a tapered and a prismatic Timoshenko segment, a stiff bushing and a universal
/// joint at its nodes, each segment of `elements`: divided by name where `divided`.
fn bent_bar(elements: usize, divided: bool) -> Model {
    let corners = [
        Point3::new(0.0, 0.0, 0.0),
        Point3::new(0.5, 0.1, 0.2),
        Point3::new(0.7, 0.6, 0.1),
    ];
    let sides = |share: f64| rectangle(0.06 - 0.03 * share, 0.02 + 0.02 * share);
    let mut model = Model::new("bent bar");
    let mut names = vec!["c0".to_string()];
    let mut places = vec![corners[0]];
    let mut members: Vec<Member> = Vec::new();
    let pieces = if divided { elements } else { 1 };
    for segment in 0..2 {
        for piece in 1..=pieces {
            let share = piece as f64 / pieces as f64;
            places.push(corners[segment] + (corners[segment + 1] - corners[segment]) * share);
            names.push(if piece == pieces {
                format!("c{}", segment + 1)
            } else {
                format!("s{segment}-{piece}")
            });
            let ends = [places.len() - 2, places.len() - 1];
            let mut next = member(ends, &steel(), &rectangle(0.02, 0.05));
            if segment == 0 {
                next.section = sides((piece - 1) as f64 / pieces as f64);
                next.taper = Some(Tapering::whole(sides(share)));
            }
            next.elements = if divided { 1 } else { elements };
            next.y_axis = Some(Vector3::new(0.2, -0.3, 1.0));
            members.push(next);
        }
    }
    let points: Vec<_> = names.iter().map(String::as_str).zip(places).collect();
    model.add_elastic("bar", &points, &members).expect("a bar");
    model
        .add_rigid("plate", &[("c1", corners[1]), ("c2", corners[2])])
        .expect("a plate");
    weld_to_ground(&mut model, "bar", "c0");
    let tip = [
        Some(node(&model, "bar", "c2")),
        Some(node(&model, "plate", "c2")),
    ];
    let mut bushing = connection("bushing", tip, Fixed);
    let stiffness = [1e7, 2e7, 3e7, 1e4, 2e4, 3e4].map(Some);
    bushing.stiffness = hyperstat_assembly::JointStiffness::Directions(stiffness);
    let turned = Rotation3::from_euler_angles(0.3, -0.4, 0.5);
    model.add_joint(bushing, turned).expect("a joint");
    let bend = [
        Some(node(&model, "bar", "c1")),
        Some(node(&model, "plate", "c1")),
    ];
    let hinge = connection("hinge", bend, Universal);
    model.add_joint(hinge, turned).expect("a joint");
    let output = node(&model, "plate", "c2");
    model.set_output(output);
    model.add_load(output, LOAD.into()).expect("a finite load");
    let inside = node(&model, "bar", "c2");
    model.add_load(inside, LOAD.into()).expect("a finite load");
    model
}

#[test]
fn inner_nodes_agree_with_the_independent_solver_of_a_divided_model() {
    for elements in [4, 8] {
        let model = bent_bar(elements, false);
        let solution = solve(&model).expect("a solution");
        let divided = bent_bar(elements, true);
        let reference = hyperstat_reference::solve(&divided).expect("a solution");
        let mut pairs = Vec::new();
        for segment in 0..2 {
            let found = inner(&solution, &model, segment);
            assert_eq!(found.len(), elements - 1);
            for (k, displacement) in found.into_iter().enumerate() {
                let node = node(&divided, "bar", &format!("s{segment}-{}", k + 1));
                pairs.push((displacement, reference.displacements[node.0]));
            }
        }
        assert_agree(pairs.iter().map(|(a, b)| (a, b)), "inner nodes");
        let expected = reference.stiffness.expect("a stiffness");
        let difference = stiffness_difference(&stiffness(&solution), &expected);
        assert!(difference < AGREEMENT, "{difference}");
    }
}

/// A console under a force across it, of as many elements as the format allows.
#[test]
fn a_million_elements_are_nodes_on_one_exact_curve() {
    let (elements, length) = (1_000_000, 2.0);
    let mut model = Model::new("console");
    let points = [
        ("wall", Point3::origin()),
        ("tip", Point3::new(length, 0.0, 0.0)),
    ];
    model
        .add_beam("bar", &points, &steel(), &circle(0.05), None, elements)
        .expect("a bar");
    weld_to_ground(&mut model, "bar", "wall");
    let tip = node(&model, "bar", "tip");
    model.set_output(tip);
    model
        .add_load(tip, Vector6::new(0.0, 0.0, -1e3, 0.0, 0.0, 0.0))
        .expect("a load");
    let solution = solve(&model).expect("a solution");
    let found = inner(&solution, &model, 0);
    assert_eq!(found.len(), elements - 1);
    let bending = steel().young() * circle(0.05).iy();
    let sag = |x: f64| -1e3 * x * x * (3.0 * length - x) / (6.0 * bending);
    for k in [1, 10, 1000, 333_333, 500_000, 999_999] {
        let expected = sag(k as f64 / elements as f64 * length);
        let difference = (found[k - 1][2] - expected).abs() / sag(length).abs();
        assert!(difference < 1e-12, "node {k}: {difference}");
    }
}

/// Turning the model turns the inner nodes' displacements with it.
#[test]
fn inner_displacements_are_in_global_axes() {
    let model = bent_bar(5, false);
    let rotation = Rotation3::from_euler_angles(0.7, -1.1, 2.0);
    let turned = hyperstat_tests::moved(&model, &rotation, &Vector3::new(1.0, -2.0, 3.0));
    let (before, after) = (
        solve(&model).expect("a solution"),
        solve(&turned).expect("a solution"),
    );
    for segment in 0..2 {
        let expected = inner(&before, &model, segment);
        let expected: Vec<_> = (expected.iter())
            .map(|u| hyperstat_tests::turned(&rotation, u))
            .collect();
        let found = inner(&after, &turned, segment);
        assert_agree(found.iter().zip(&expected), "turned");
    }
}
