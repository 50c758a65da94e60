//! Measures of stiffnesses that are known in closed form, and what does not depend on the frame.

use nalgebra::{Rotation3, Unit};

use crate::answer::measures::*;

/// A spring of stiffness k along a screw.
fn screw_spring(k: f64, point: [f64; 3], direction: Vector3<f64>, pitch: f64) -> Matrix6<f64> {
    let e = direction.normalize();
    let wrench = join(&e, &(Vector3::from(point).cross(&e) + e * pitch));
    wrench * wrench.transpose() * k
}

/// The twist at the reference for the same twist at `arm` from it, and its transpose for wrenches.
fn shift(arm: &Vector3<f64>) -> Matrix6<f64> {
    let mut out = Matrix6::identity();
    out.fixed_view_mut::<3, 3>(0, 3)
        .copy_from(&arm.cross_matrix());
    out
}

fn turn(rotation: &Rotation3<f64>) -> Matrix6<f64> {
    let mut out = Matrix6::zeros();
    for k in [0, 3] {
        out.fixed_view_mut::<3, 3>(k, k)
            .copy_from(rotation.matrix());
    }
    out
}

fn measures(stiffness: &Matrix6<f64>, reference: Point3<f64>) -> Measures {
    let compliance = stiffness.try_inverse().unwrap();
    Measures::new(stiffness, &compliance, &reference, None).unwrap()
}

fn near(found: f64, expected: f64) -> bool {
    (found - expected).abs() <= 1e-11 * expected.abs()
}

/// Springs along x, y and z with torsion springs, all at one point: what the matrix is there.
fn block_diagonal_at(centre: Vector3<f64>) -> Matrix6<f64> {
    let own = Matrix6::from_diagonal(&Vector6::new(4e6, 2e6, 1e6, 300.0, 500.0, 900.0));
    // The twist at the centre from the one at the origin: u + φ × c = u − [c] φ.
    let to_centre = shift(&-centre);
    to_centre.transpose() * own * to_centre
}

#[test]
fn a_body_on_springs_at_a_point_has_its_centres_there() {
    let centre = Vector3::new(0.3, -0.2, 0.7);
    let found = measures(&block_diagonal_at(centre), Point3::origin());
    assert!((found.centre_of_stiffness.coords - centre).amax() < 1e-12);
    assert!((found.centre_of_compliance.coords - centre).amax() < 1e-12);
    // What does not depend on the reference point.
    let expected = [1e6, 2e6, 4e6];
    for (value, expected) in found.translational_stiffnesses.values.iter().zip(expected) {
        assert!(near(*value, expected), "{value}");
    }
    let expected = [1.0 / 900.0, 1.0 / 500.0, 1.0 / 300.0];
    for (value, expected) in found.rotational_compliances.values.iter().zip(expected) {
        assert!(near(*value, expected), "{value}");
    }
    assert!((found.rotational_compliances.directions[2] - Vector3::x()).amax() < 1e-10);
    // Seen from the centre itself the compliances are the springs' own.
    let there = measures(&block_diagonal_at(Vector3::zeros()), Point3::from(centre));
    assert_eq!(there.centre_of_stiffness.coords, centre);
    assert!(near(there.translational_compliances.values[2], 1e-6));
    assert!(near(
        there.force_work,
        (1.0 / 4e6 + 1.0 / 2e6 + 1.0 / 1e6) / 3.0
    ));
    let length = (there.force_work / there.moment_work).sqrt();
    assert!(near(there.characteristic_length, length));
    let scaled = [300.0, 500.0, 900.0].map(|k| k / (length * length));
    let all = [4e6, 2e6, 1e6].into_iter().chain(scaled);
    let (low, high) = all.fold((f64::MAX, 0.0_f64), |(l, h), k| (l.min(k), h.max(k)));
    assert!(near(there.condition, high / low));
}

/// Springs along x and about x at the origin: K e = λ Δ e has λ = ±√(k κ), pitches ±√(κ/k), each
/// with half of the stiffness.
#[test]
fn eigenscrews_of_springs_along_the_axes() {
    let k = [4e6, 2e6, 1e6];
    let turning = [300.0, 500.0, 900.0];
    let found = measures(&block_diagonal_at(Vector3::zeros()), Point3::origin());
    for axis in 0..3 {
        let expected = f64::sqrt(k[axis] * turning[axis]);
        for sign in [1.0, -1.0] {
            let screw = found
                .eigenscrews
                .iter()
                .find(|s| s.direction[axis] > 0.999 && s.pitch * sign > 0.0)
                .unwrap();
            assert!(near(screw.eigenvalue, sign * expected), "{screw:?}");
            assert!(near(screw.stiffness, k[axis] / 2.0), "{screw:?}");
            assert!(near(screw.pitch, sign * (turning[axis] / k[axis]).sqrt()));
            assert!(screw.point.coords.norm() < 1e-12);
        }
    }
}

/// Screws that are reciprocal in pairs are their own eigenscrews: pitches h and −h on one axis do
/// not work on each other.
#[test]
fn reciprocal_screw_springs_are_found_again() {
    let axis = Unit::new_normalize(Vector3::new(1.0, 2.0, -1.0));
    let frame = Rotation3::rotation_between(&Vector3::x(), &axis).unwrap();
    let at = [0.1, 0.25, -0.3];
    let mut stiffness = Matrix6::zeros();
    let mut springs = Vec::new();
    for (k, (column, pitch)) in [
        (0, 0.1),
        (0, -0.1),
        (1, 0.02),
        (1, -0.02),
        (2, 0.5),
        (2, -0.5),
    ]
    .into_iter()
    .enumerate()
    {
        let direction = frame.matrix().column(column).into_owned();
        let size = 1e6 * (k + 1) as f64;
        springs.push((size, direction, pitch));
        stiffness += screw_spring(size, at, direction, pitch);
    }
    let found = measures(&stiffness, Point3::origin());
    for (size, direction, pitch) in springs {
        let screw = found
            .eigenscrews
            .iter()
            .find(|s| s.direction.dot(&direction).abs() > 0.999 && s.pitch * pitch > 0.0)
            .unwrap();
        assert!(near(screw.stiffness, size), "{screw:?} {size}");
        assert!(near(screw.pitch, pitch), "{screw:?} {pitch}");
        let off = (screw.point - Point3::from(at)).cross(&direction);
        assert!(off.norm() < 1e-12, "{screw:?}");
    }
}

fn coupled() -> Matrix6<f64> {
    let directions = [
        ([0.2, 0.0, 0.1], Vector3::new(1.0, 0.2, 0.3), 0.05),
        ([0.0, 0.3, 0.0], Vector3::new(-0.4, 1.0, 0.1), -0.1),
        ([0.1, 0.1, 0.4], Vector3::new(0.2, -0.6, 1.0), 0.0),
        ([-0.3, 0.2, 0.0], Vector3::new(1.0, 1.0, 1.0), 0.2),
        ([0.4, -0.1, 0.2], Vector3::new(0.0, 1.0, -1.0), -0.03),
        ([0.0, 0.0, -0.5], Vector3::new(1.0, 0.0, 0.5), 0.3),
    ];
    let springs = directions.into_iter().zip([1e6, 3e6, 5e5, 2e6, 8e6, 1e6]);
    springs
        .map(|((point, direction, pitch), k)| screw_spring(k, point, direction, pitch))
        .sum()
}

#[test]
fn eigenscrews_make_up_the_stiffness() {
    let reference = Point3::new(0.2, -1.0, 0.4);
    let stiffness = coupled();
    let found = measures(&stiffness, reference);
    let sum: Matrix6<f64> = (found.eigenscrews.iter())
        .map(|s| {
            let wrench = s.unit_wrench(&reference);
            wrench * wrench.transpose() * s.stiffness
        })
        .sum();
    assert!((sum - stiffness).amax() < 1e-9 * stiffness.amax());
    for screw in &found.eigenscrews {
        assert!((2.0 * screw.pitch * screw.stiffness / screw.eigenvalue - 1.0).abs() < 1e-9);
    }
    // Σ λ = tr(Δ K).
    let trace: f64 = (0..6).map(|k| stiffness[((k + 3) % 6, k)]).sum();
    let total: f64 = found.eigenscrews.iter().map(|s| s.eigenvalue).sum();
    let size = found.eigenscrews[0].eigenvalue;
    assert!((total - trace).abs() < 1e-10 * size);
    let signs = found.eigenscrews.iter().map(|s| s.pitch.signum());
    assert_eq!(signs.collect::<Vec<_>>(), [1.0, 1.0, 1.0, -1.0, -1.0, -1.0]);
}

/// Another reference point and other axes change nothing of what belongs to the mechanism.
#[test]
fn measures_do_not_depend_on_reference_and_axes() {
    let stiffness = coupled();
    let here = measures(&stiffness, Point3::origin());
    let rotation = Rotation3::from_euler_angles(0.4, -1.2, 2.2);
    let arm = Vector3::new(0.3, 0.5, -0.2);
    // At the new reference, then in turned axes: points p become R p.
    let moved = shift(&arm).transpose() * stiffness * shift(&arm);
    let turned = turn(&rotation) * moved * turn(&rotation).transpose();
    let there = measures(&turned, Point3::from(rotation * arm));
    for (a, b) in here.eigenscrews.iter().zip(&there.eigenscrews) {
        assert!((a.eigenvalue / b.eigenvalue - 1.0).abs() < 1e-9);
        assert!((a.stiffness / b.stiffness - 1.0).abs() < 1e-9);
        assert!((a.pitch / b.pitch - 1.0).abs() < 1e-9);
        let direction = rotation * a.direction;
        assert!(direction.dot(&b.direction).abs() > 1.0 - 1e-12);
        let off = (rotation * a.point - b.point).cross(&b.direction);
        assert!(off.norm() < 1e-9);
    }
    for (a, b) in [
        (here.centre_of_stiffness, there.centre_of_stiffness),
        (here.centre_of_compliance, there.centre_of_compliance),
    ] {
        assert!((rotation * a - b).norm() < 1e-10);
    }
    let same = [
        (
            here.translational_stiffnesses,
            there.translational_stiffnesses,
        ),
        (here.rotational_compliances, there.rotational_compliances),
    ];
    for (a, b) in same {
        for (a, b) in a.values.iter().zip(b.values) {
            assert!((a / b - 1.0).abs() < 1e-10);
        }
    }
}

#[test]
fn compliance_along_a_direction() {
    let compliance = coupled().try_inverse().unwrap();
    let along = compliance_along(&compliance, &Vector6::ith(1, 1.0));
    assert_eq!(along, compliance[(1, 1)]);
    let singular = Matrix6::from_diagonal(&Vector6::new(1.0, 1.0, 1.0, 1.0, 1.0, 0.0));
    assert!(Measures::new(&singular, &singular, &Point3::origin(), Some(1.0)).is_none());
}
