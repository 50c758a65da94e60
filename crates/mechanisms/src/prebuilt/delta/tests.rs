//! Tests of the delta: against the written-out mechanisms, loops and symmetry over random sizes
//! and poses, and every pose and parameter that is refused.

use hyperstat_joints::Dof;
use hyperstat_model::{Geometry, JointStiffness, LANES, Model};
use nalgebra::{Point3, Rotation3, Vector3};
use proptest::prelude::*;

use super::limb::Limb;
use super::topology::{JointRole, Link, Point};
use crate::prebuilt::delta::{Delta, Elbow, RodEnds};
use crate::prebuilt::wide::Wide;
use crate::prebuilt::written_out::WrittenOut;
use crate::prebuilt::{PoseError, Prebuilt};

const JOINT_STIFFNESS: [Option<f64>; 6] =
    [Some(1e8), Some(1e8), Some(1e8), Some(1e5), None, Some(1e5)];

/// Deltas of all sizes, with rods longer than their arms.
fn deltas() -> impl Strategy<Value = Delta> {
    let sizes = (0.0..0.5, 0.0..0.3, 0.1..1.0, 1.05..4.0, 0.01..0.3);
    (sizes, any::<bool>(), any::<bool>()).prop_map(|(sizes, out, revolute)| {
        let (base_radius, platform_radius, arm_length, rod_to_arm, rod_spacing) = sizes;
        Delta {
            base_radius,
            platform_radius,
            arm_length,
            rod_length: rod_to_arm * arm_length,
            rod_spacing,
            elbow: if out { Elbow::Out } else { Elbow::In },
            rod_ends: if revolute {
                RodEnds::Revolute
            } else {
                RodEnds::Spherical
            },
            ..Delta::paper()
        }
    })
}

/// A delta and a pose that it reaches, above or below its base.
fn deltas_in_reach() -> impl Strategy<Value = (Delta, [f64; 3])> {
    let pose = prop::array::uniform3(-1.0..1.0);
    (deltas(), pose).prop_filter_map("out of reach", |(delta, [x, y, z])| {
        let reach = delta.arm_length + delta.rod_length;
        let pose = [0.6 * x * reach, 0.6 * y * reach, z * reach];
        limbs(&delta, pose).is_ok().then_some((delta, pose))
    })
}

fn limbs(delta: &Delta, pose: [f64; 3]) -> Result<[Limb<1>; 3], PoseError> {
    let limbs = [0, 1, 2].map(|index| Limb::new(delta, index, &pose.map(Wide::of)));
    match limbs.iter().find_map(|limb| limb.fault(delta, 0)) {
        None => Ok(limbs),
        Some(fault) => Err(fault),
    }
}

/// The first limb, which reaches there.
fn reached(delta: &Delta, centre: [f64; 3]) -> Limb<1> {
    let limb = Limb::new(delta, 0, &centre.map(Wide::of));
    assert_eq!(limb.fault(delta, 0), None);
    limb
}

/// Size of a delta, to which rounding is relative.
fn size(delta: &Delta) -> f64 {
    delta.base_radius + delta.platform_radius + delta.arm_length + delta.rod_length
}

fn turn(angle_in_turns: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Vector3::z_axis(), std::f64::consts::TAU * angle_in_turns)
}

fn refused(delta: &Delta, pose: [f64; 3]) -> String {
    let error = delta.model(&pose).expect_err("the pose is to be refused");
    error.to_string()
}

#[test]
fn models_are_the_written_out_mechanisms() {
    let elastic = Delta {
        joint_stiffness: JOINT_STIFFNESS,
        ..Delta::paper()
    };
    let refined = Delta {
        elements: 4,
        ..Delta::paper()
    };
    let ball_jointed = Delta {
        rod_ends: RodEnds::Spherical,
        ..Delta::paper()
    };
    for (file, delta) in [
        ("delta_rigid_joints", Delta::paper()),
        ("delta_elastic_joints", elastic),
        ("delta_refined", refined),
        ("delta_ball_jointed_rods", ball_jointed),
    ] {
        let file = WrittenOut::read(file);
        let model = delta.model(&file.pose("P")).expect("a pose in reach");
        file.assert_same(&model);
    }
}

#[test]
fn drives_are_locked_or_elastic_and_spherical_rod_ends_rigid() {
    let delta = Delta {
        rod_ends: RodEnds::Spherical,
        joint_stiffness: JOINT_STIFFNESS,
        drive_stiffness: Some(2e4),
        ..Delta::paper()
    };
    let model = delta.model(&[0.0, 0.0, 0.5]).expect("a pose in reach");
    let mut drive = JOINT_STIFFNESS;
    drive[Dof::V.index()] = Some(2e4);
    let mut kinds = Vec::new();
    for joint in model.joints() {
        let stiffness = match joint.name.as_bytes() {
            [b'A', _] => drive,
            [b'B' | b'C', _] => JOINT_STIFFNESS,
            _ => [None; 6],
        };
        assert_eq!(
            joint.stiffness,
            JointStiffness::Directions(stiffness),
            "{}",
            joint.name
        );
        kinds.push((joint.joint.kind(), joint.locked.contains(Dof::V)));
    }
    let count = |kind, locked| kinds.iter().filter(|&&k| k == (kind, locked)).count();
    assert_eq!(count("Revolute", true), 3);
    assert_eq!(count("Revolute", false), 6);
    assert_eq!(count("Spherical", false), 12);
}

proptest! {
    #[test]
    fn loops_close((delta, pose) in deltas_in_reach()) {
        let rounding = 1e-14 * size(&delta);
        for limb in limbs(&delta, pose)? {
            let point = |point| limb.at(0).point(point);
            let arm = point(Point::B) - point(Point::A);
            let rod = point(Point::C) - point(Point::B);
            let bar = point(Point::Bb) - point(Point::Ba);
            prop_assert!((arm.norm() - delta.arm_length).abs() < rounding);
            prop_assert!((rod.norm() - delta.rod_length).abs() < rounding);
            prop_assert!((bar.norm() - delta.rod_spacing).abs() < rounding);
            for parallel in [
                point(Point::Ca) - point(Point::Ba),
                point(Point::Cb) - point(Point::Bb),
            ] {
                prop_assert!((parallel - rod).norm() < rounding);
            }
            prop_assert!((point(Point::Cb) - point(Point::Ca) - bar).norm() < rounding);

            // Every axis is a unit vector, and normal to what turns about it.
            let (axis, across) = (limb.at(0).y_axis(Link::Arm), limb.at(0).y_axis(Link::Rod));
            prop_assert!((axis.norm() - 1.0).abs() < 1e-15);
            prop_assert!((across.norm() - 1.0).abs() < 1e-15);
            prop_assert!((bar - axis * delta.rod_spacing).norm() < rounding);
            prop_assert!(axis.dot(&arm).abs() < rounding);
            prop_assert!(across.dot(&bar).abs() < rounding);
            // The axis follows the rods in the limb's plane, whose length there may be small.
            let in_plane = (rod - axis * axis.dot(&rod)).norm();
            prop_assert!(across.dot(&rod).abs() < rounding * delta.rod_length / in_plane);
        }
    }

    #[test]
    fn elbow_choices_are_mirrored_about_the_line_from_shoulder_to_wrist(
        (delta, pose) in deltas_in_reach()
    ) {
        let out = limbs(&Delta { elbow: Elbow::Out, ..delta.clone() }, pose)?;
        let other = limbs(&Delta { elbow: Elbow::In, ..delta.clone() }, pose)?;
        for (k, (out, other)) in out.iter().zip(&other).enumerate() {
            let outward = turn(k as f64 / 3.0) * Vector3::y();
            let [a, c] = [Point::A, Point::C].map(|point| out.at(0).point(point));
            let apart = out.at(0).point(Point::B) - other.at(0).point(Point::B);
            prop_assert!(outward.dot(&apart) >= -1e-14 * size(&delta));
            let axis = out.at(0).y_axis(Link::Arm);
            let line = (c - a) - axis * axis.dot(&(c - a));
            prop_assert!(apart.dot(&line).abs() < 1e-13 * size(&delta).powi(2));
        }
    }

    #[test]
    fn a_pose_turned_by_a_third_turns_the_limbs((delta, pose) in deltas_in_reach()) {
        let third = turn(1.0 / 3.0);
        let turned = limbs(&delta, (third * Point3::from(pose)).into())?;
        let limbs = limbs(&delta, pose)?;
        for k in 0..3 {
            let (limb, next) = (&limbs[k], &turned[(k + 1) % 3]);
            // Rounding of the pose grows where the elbow is near stretched or folded, or the
            // rods near the joint axes.
            let [a, b, c] = [Point::A, Point::B, Point::C].map(|point| limb.at(0).point(point));
            let axis = limb.at(0).y_axis(Link::Arm);
            let in_plane = |v: Vector3<f64>| v - axis * axis.dot(&v);
            let (arm, rod) = (b - a, in_plane(c - b));
            let sharpness = arm.cross(&rod).norm() / size(&delta).powi(2);
            let lean = rod.norm() / delta.rod_length;
            prop_assume!(sharpness > 1e-3 && lean > 1e-2);
            let rounding = 1e-11 * size(&delta);
            for point in [Point::A, Point::B, Point::Ba, Point::Bb, Point::C, Point::Ca, Point::Cb] {
                let off = next.at(0).point(point) - third * limb.at(0).point(point);
                prop_assert!(off.norm() < rounding, "{point:?} is {off:?} off");
            }
            for role in [JointRole::Drive, JointRole::Elbow, JointRole::RodEnd, JointRole::Wrist] {
                if role == JointRole::RodEnd && delta.rod_ends == RodEnds::Spherical {
                    continue;
                }
                let off = (third * limb.at(0).frame(role)).matrix() - next.at(0).frame(role).matrix();
                prop_assert!(off.norm() < 1e-11, "{role:?} is {off:?} off");
            }
        }
    }

    #[test]
    fn place_gives_the_geometry_of_model(
        (delta, first) in deltas_in_reach(),
        second in prop::array::uniform3(-0.3..0.3),
    ) {
        let mut geometry = delta.model(&first)?.geometry().clone();
        match delta.model(&second) {
            Ok(model) => {
                let pose = delta.place(&second, &mut geometry)?;
                prop_assert_eq!(&geometry, model.geometry());
                prop_assert_eq!(pose, [second[0], second[1], second[2], 0.0, 0.0, 0.0]);
            }
            Err(error) => {
                let before = geometry.clone();
                prop_assert_eq!(delta.place(&second, &mut geometry), Err(error));
                prop_assert_eq!(geometry, before);
            }
        }
    }

    #[test]
    fn poses_side_by_side_are_those_of_each_by_itself(
        (delta, first) in deltas_in_reach(),
        others in prop::collection::vec(prop::array::uniform3(-1.5..1.5), 0..LANES),
    ) {
        let home = delta.model(&first)?.geometry().clone();
        let size = size(&delta);
        let mut poses = vec![[first[0], first[1], first[2], 0.0, 0.0, 0.0]];
        poses.extend(others.iter().map(|[x, y, z]| [x * size, y * size, z * size, 0.0, 0.0, 0.0]));
        // One that is none, beside the others.
        poses[others.len() / 2][1] *= if others.len() == 3 { f64::NAN } else { 1.0 };
        let mut geometries = vec![home.clone(); poses.len()];
        let placed = delta.place_lanes(&poses, &mut geometries);
        prop_assert_eq!(placed.iter().flatten().count(), poses.len());
        for ((pose, placed), together) in poses.iter().zip(placed).zip(&geometries) {
            let mut alone = home.clone();
            let own = delta.place(&pose[..3], &mut alone);
            match (own, placed.expect("a pose")) {
                (Ok(own), Ok(placed)) => prop_assert_eq!(own.map(f64::to_bits), placed.map(f64::to_bits)),
                (own, placed) => prop_assert_eq!(format!("{own:?}"), format!("{placed:?}")),
            }
            prop_assert_eq!(bits(together), bits(&alone));
        }
    }
}

/// All numbers of a geometry, to the bit.
fn bits(geometry: &Geometry) -> Vec<u64> {
    let points = geometry.positions.iter().flat_map(|p| p.coords.data.0[0]);
    let axes = geometry.y_axes.iter().flatten().flat_map(|y| y.data.0[0]);
    let frames = geometry
        .frames
        .iter()
        .flat_map(|f| f.matrix().data.0.concat());
    points.chain(axes).chain(frames).map(f64::to_bits).collect()
}

#[test]
fn parameters_out_of_range_are_refused_in_every_pose_side_by_side() {
    let mut geometries = vec![
        Delta::paper()
            .model(&[0.0, 0.0, 0.5])
            .expect("in reach")
            .geometry()
            .clone();
        2
    ];
    let delta = Delta {
        arm_length: -1.0,
        ..Delta::paper()
    };
    let poses = [[0.0, 0.0, 0.5, 0.0, 0.0, 0.0]; 2];
    let error = delta
        .place(&poses[0][..3], &mut geometries[0])
        .expect_err("a negative length");
    let placed = delta.place_lanes(&poses, &mut geometries);
    for placed in &placed[..2] {
        assert_eq!(placed.as_ref(), Some(&Err(error.clone())));
    }
    assert!(placed[2..].iter().all(Option::is_none));
}

#[test]
fn elbow_at_the_height_of_the_base_follows_from_above() {
    // C1 stands outside A1 and beside it: both elbows are equally far out.
    let delta = Delta {
        base_radius: 0.1,
        platform_radius: 0.6,
        ..Delta::paper()
    };
    for elbow in [Elbow::Out, Elbow::In] {
        let delta = Delta {
            elbow,
            ..delta.clone()
        };
        let b = |z| {
            let limb = reached(&delta, [0.0, 0.0, z]);
            limb.at(0).point(Point::B)
        };
        let level = b(0.0);
        assert!((level - b(1e-9)).norm() < 1e-8, "{elbow:?}");
        assert!((level - b(-0.0)).norm() == 0.0, "{elbow:?}");
        assert!((level - b(-1e-9)).norm() > 0.1, "{elbow:?}");
    }
}

#[test]
fn limbs_reach_to_their_edge_and_no_farther() {
    // Straight up: every wrist is 0.19 m inside its shoulder, arm and rods reach 0.9 m at most
    // and 0.3 m at least.
    let delta = Delta::paper();
    let height = |reach: f64| (reach * reach - 0.19 * 0.19).sqrt();
    for (reach, outside) in [(0.9, 1.0), (0.3, -1.0)] {
        for rounding in [-1e-13, 0.0, 1e-13] {
            let z = height(reach * (1.0 + rounding));
            for limb in limbs(&delta, [0.0, 0.0, z]).expect("on the edge") {
                let [a, b, c] = [Point::A, Point::B, Point::C].map(|point| limb.at(0).point(point));
                assert!(((b - a).norm() - 0.3).abs() < 1e-12);
                assert!(((c - b).norm() - 0.6).abs() < 1e-12);
                // The elbow's height over the line is at most the root of the gap.
                let height = (b - a).cross(&(c - a)).norm() / (c - a).norm();
                assert!(height < 1e-6, "{height}");
            }
        }
        let z = height(reach * (1.0 + outside * 1e-11));
        let error = delta.model(&[0.0, 0.0, z]).map(|_| ());
        assert!(
            matches!(error, Err(PoseError::Unreachable { .. })),
            "{error:?}"
        );
    }
}

#[test]
fn a_pose_out_of_reach_names_limb_reason_and_lengths() {
    let delta = Delta::paper();
    assert_eq!(
        refused(&delta, [0.0, -0.62, 0.5]),
        "out of reach: limb 1: point C1 is too far from A1: 0.951893 m across the joint axes, \
         where arm and rods reach 0.900000 m"
    );
    let turned = turn(1.0 / 3.0) * Point3::new(0.0, -0.62, 0.5);
    assert_eq!(
        refused(&delta, turned.into()),
        "out of reach: limb 2: point C2 is too far from A2: 0.951893 m across the joint axes, \
         where arm and rods reach 0.900000 m"
    );
    assert_eq!(
        refused(&delta, [0.0, 0.19, 0.1]),
        "out of reach: limb 1: point C1 is too close to A1: 0.100000 m across the joint axes, \
         where arm and rods reach no nearer than 0.300000 m"
    );
    assert_eq!(
        refused(&delta, [0.6, 0.19, 0.301]),
        "out of reach: limb 1: point C1 is too far from A1: 0.301000 m across the joint axes, \
         where arm and rods reach 0.300000 m"
    );
    assert_eq!(
        refused(&delta, [-0.7, 0.0, 0.5]),
        "out of reach: limb 1: point C1 lies 0.700000 m along the joint axes from A1, too far \
         for rods of 0.600000 m"
    );
}

#[test]
fn a_pose_without_a_configuration_of_its_own_is_singular() {
    // Rods along the joint axes, the wrist beside an elbow in reach.
    assert_eq!(
        refused(&Delta::paper(), [0.6, 0.19, 0.3]),
        "singular pose: limb 1: the rods lie along the joint axes, so the parallelogram has no \
         plane"
    );
    // Wrist on the shoulder, with an arm as long as the rods.
    let even = Delta {
        arm_length: 0.6,
        ..Delta::paper()
    };
    assert_eq!(
        refused(&even, [0.0, 0.19, 0.0]),
        "singular pose: limb 1: point C1 lies on the axis of A1, so the arm may have any angle"
    );
}

#[test]
fn rods_nearly_along_the_joint_axes_keep_their_digits() {
    let delta = Delta::paper();
    for lean in [1e-3, 1e-6, 1e-9, 4e-12] {
        let side = 0.6 * (1.0 - lean);
        // The wrist as far from the shoulder as the arm is long: the elbow is near the wrist.
        let limb = reached(&delta, [side, 0.25 - 0.06, 0.3]);
        let [a, b, c] = [Point::A, Point::B, Point::C].map(|point| limb.at(0).point(point));
        assert!(((b - a).norm() - 0.3).abs() < 1e-15);
        assert!(((c - b).norm() - 0.6).abs() < 1e-15);
        let across = limb.at(0).y_axis(Link::Rod);
        assert!((across.norm() - 1.0).abs() < 1e-15);
        assert!(across.dot(&(c - b)).abs() < 1e-15, "{lean}");
    }
}

#[test]
fn coordinates_that_are_no_pose_are_refused() {
    let delta = Delta::paper();
    for found in [0, 2, 6] {
        assert_eq!(
            delta.model(&vec![0.1; found]).map(|_| ()),
            Err(PoseError::Coordinates {
                kind: "Delta".into(),
                expected: 3,
                found,
            })
        );
    }
    let error = refused(&delta, [0.0, f64::INFINITY, 0.5]);
    assert_eq!(error, "pose coordinate 1 is inf, not a finite number");
}

#[test]
fn a_geometry_of_another_model_is_refused() {
    let mut foreign: Geometry = Model::new("another").geometry().clone();
    assert_eq!(
        Delta::paper().place(&[0.0, 0.0, 0.5], &mut foreign),
        Err(PoseError::ForeignGeometry {
            expected: [40, 21, 21],
            found: [0, 0, 0],
        })
    );
}

#[test]
fn parameters_out_of_range_are_named() {
    type Spoil = fn(&mut Delta);
    let cases: [(&str, Spoil); 16] = [
        ("base_radius", |d| d.base_radius = -0.1),
        ("base_radius", |d| d.base_radius = f64::NAN),
        ("platform_radius", |d| d.platform_radius = -1e-9),
        ("platform_radius", |d| d.platform_radius = f64::INFINITY),
        ("arm_length", |d| d.arm_length = 0.0),
        ("arm_length", |d| d.arm_length = f64::NAN),
        ("rod_length", |d| d.rod_length = -0.6),
        ("rod_length", |d| d.rod_length = f64::INFINITY),
        ("rod_spacing", |d| d.rod_spacing = 0.0),
        ("joint_stiffness", |d| d.joint_stiffness[0] = Some(-1.0)),
        ("joint_stiffness", |d| {
            d.joint_stiffness[5] = Some(f64::INFINITY)
        }),
        ("joint_stiffness", |d| d.joint_stiffness[4] = Some(1e3)),
        ("drive_stiffness", |d| d.drive_stiffness = Some(-1e5)),
        ("drive_stiffness", |d| d.drive_stiffness = Some(f64::NAN)),
        ("elements", |d| d.elements = 0),
        ("elements", |d| d.elements = 1_000_001),
    ];
    assert_eq!(Delta::paper().check(), Ok(()));
    for (field, spoil) in cases {
        let mut delta = Delta::paper();
        spoil(&mut delta);
        let error = delta.check().expect_err(field);
        assert_eq!(error.field, field);
        assert_eq!(
            delta.model(&[0.0, 0.0, 0.5]).map(|_| ()),
            Err(PoseError::Parameter(error))
        );
    }
}
