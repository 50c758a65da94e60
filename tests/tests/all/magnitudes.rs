//! Orders of magnitude against the independent solver: links from 1 mm to 100 m, sections from hair
//! to tower, joint stiffness from 1e-3 to 1e18 (N/m, N·m/rad).

use std::ops::Range;

use hyperstat_assembly::{Connection, JointStiffness, Model, SolveError, Warning, solve};
use hyperstat_joints::{
    Fixed, Prismatic, Revolute, Spherical, Universal, frame_from_axes, frame_from_axis,
};
use hyperstat_mechanisms::prebuilt::{Delta, Link, Prebuilt};
use hyperstat_tests::build::{circle, connection, node, steel};
use hyperstat_tests::runner::check_all;
use hyperstat_tests::{stiffness, stiffness_difference};
use nalgebra::{Point3, Rotation3, Vector3};
use proptest::prelude::*;

/// Agreement of K_o, as a share of its scale √(K_ii K_jj).
const AGREEMENT: f64 = 1e-8;
/// Where a warning says how far results may be off, the independent solver loses digits too, in another
/// way and without a word.
const WITHIN_FIGURE: f64 = 100.0;
/// Cases of every test.
const CASES: u32 = 100;

/// 10 to a power between these.
pub(super) fn magnitude(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low..high).prop_map(|exponent| 10.0_f64.powf(exponent))
}

/// Six numbers of this range, each of its own.
pub(super) fn magnitudes(low: f64, high: f64) -> impl Strategy<Value = [f64; 6]> {
    proptest::array::uniform6(low..high).prop_map(|e| e.map(|e| 10.0_f64.powf(e)))
}

/// Six numbers of this range, within three orders of each other: the directions of one joint.
pub(super) fn neighbours(low: f64, high: f64) -> impl Strategy<Value = [f64; 6]> {
    let apart = proptest::array::uniform6(-1.5..1.5_f64);
    (low..high, apart).prop_map(move |(middle, apart)| {
        apart.map(|apart| 10.0_f64.powf((middle + apart).clamp(low, high)))
    })
}

pub(super) fn frame(axis: &Vector3<f64>) -> Rotation3<f64> {
    frame_from_axis(Some(axis), None).expect("an axis")
}

fn elastic(connection: Connection, values: [Option<f64>; 6]) -> Connection {
    Connection {
        stiffness: JointStiffness::Directions(values),
        ..connection
    }
}

/// The largest difference of K_o from the independent solver's, and the figure of our warning
/// where digits are lost; `None` where the independent solver finds no digits either.
fn difference(model: &Model) -> Option<Result<(f64, Option<f64>), SolveError>> {
    let theirs = hyperstat_reference::solve(model).ok()?;
    let expected = theirs.stiffness.expect("an output that can move");
    Some(solve(model).map(|ours| {
        let lost = ours.warnings.iter().find_map(|w| match w {
            Warning::LostDigits { error } => Some(*error),
            _ => None,
        });
        (stiffness_difference(&stiffness(&ours), &expected), lost)
    }))
}

/// K_o agrees; `Ok(false)` where there is nothing to compare with.
fn agrees(model: &Model) -> Result<bool, TestCaseError> {
    match difference(model) {
        None => Ok(false),
        Some(Ok((difference, _))) => {
            prop_assert!(difference < AGREEMENT, "K_o {difference:e}");
            Ok(true)
        }
        Some(Err(error)) => Err(TestCaseError::fail(format!("only we refuse: {error}"))),
    }
}

/// K_o agrees, or a warning says how far it may be off; `Ok(false)` where there is nothing to
/// compare with or doubles do not carry the numbers, which must be an error.
fn agrees_or_warns(model: &Model) -> Result<bool, TestCaseError> {
    match difference(model) {
        None | Some(Err(SolveError::Singular)) => Ok(false),
        Some(Ok((difference, lost))) => {
            let told = lost.is_some_and(|figure| difference < WITHIN_FIGURE * figure);
            prop_assert!(
                difference < AGREEMENT || told,
                "K_o {difference:e}, warned of {lost:?}"
            );
            Ok(true)
        }
        Some(Err(error)) => Err(TestCaseError::fail(format!("only we refuse: {error}"))),
    }
}

/// The paper's delta, `scale` times as large, its sections in proportion to their links.
fn delta(scale: f64, slenderness: [f64; 3], joints: Option<[f64; 6]>) -> Model {
    let paper = Delta::paper();
    let link = |length: f64, ratio: f64| Link {
        section: circle(length * ratio),
        material: steel(),
    };
    let delta = Delta {
        base_radius: scale * paper.base_radius,
        platform_radius: scale * paper.platform_radius,
        arm_length: scale * paper.arm_length,
        rod_length: scale * paper.rod_length,
        rod_spacing: scale * paper.rod_spacing,
        arm: link(scale * paper.arm_length, slenderness[0]),
        bar: link(scale * paper.rod_spacing, slenderness[1]),
        rod: link(scale * paper.rod_length, slenderness[2]),
        joint_stiffness: joints.map_or([None; 6], |[x, y, z, u, _, w]| {
            [Some(x), Some(y), Some(z), Some(u), None, Some(w)]
        }),
        drive_stiffness: joints.map(|k| k[4]),
        ..paper
    };
    delta
        .model(&[0.05 * scale, -0.08 * scale, 0.5 * scale])
        .expect("reachable")
}

/// A hexapod (6-UPS) of this size, with `drives` along its legs.
fn hexapod(size: f64, slenderness: f64, drives: [f64; 6]) -> Model {
    let mut model = Model::new("hexapod");
    let (section, steel) = (circle(size * slenderness), steel());
    let tilt = Rotation3::from_scaled_axis(Vector3::new(0.1, -0.2, 0.15));
    let on_circle = |radius: f64, degrees: f64| {
        let angle = degrees.to_radians();
        size * radius * Vector3::new(angle.cos(), angle.sin(), 0.0)
    };
    let centre = Point3::new(0.05, -0.03, 0.9) * size;
    let base = [-20.0, 20.0, 100.0, 140.0, 220.0, 260.0].map(|a| Point3::from(on_circle(0.6, a)));
    let top = [-45.0, 45.0, 75.0, 165.0, 195.0, 285.0].map(|a| centre + tilt * on_circle(0.3, a));
    let names = ["1", "2", "3", "4", "5", "6"];
    let mut platform = vec![("P", centre)];
    platform.extend(names.into_iter().zip(top));
    model.add_rigid("platform", &platform).expect("a platform");
    for (k, leg) in names.into_iter().enumerate() {
        let axis = top[k] - base[k];
        let middle = base[k] + 0.55 * axis;
        let (lower, upper) = (format!("lower{leg}"), format!("upper{leg}"));
        for (name, ends) in [
            (&lower, [("base", base[k]), ("drive", middle)]),
            (&upper, [("drive", middle), (leg, top[k])]),
        ] {
            model
                .add_beam(name, &ends, &steel, &section, None, 1)
                .expect("a beam");
        }
        let across = axis.cross(&Vector3::x());
        let foot = connection(
            &format!("foot{leg}"),
            [None, Some(node(&model, &lower, "base"))],
            Universal,
        );
        let frame_of_foot = frame_from_axes(&Vector3::x(), &across).expect("two axes");
        model.add_joint(foot, frame_of_foot).expect("a joint");
        let ends = [node(&model, &lower, "drive"), node(&model, &upper, "drive")].map(Some);
        let mut along = [None; 6];
        along[1] = Some(drives[k]);
        let drive = elastic(connection(&format!("drive{leg}"), ends, Prismatic), along);
        model.add_joint(drive, frame(&axis)).expect("a joint");
        let ends = [node(&model, &upper, leg), node(&model, "platform", leg)].map(Some);
        let ball = connection(&format!("ball{leg}"), ends, Spherical);
        model
            .add_joint(ball, Rotation3::identity())
            .expect("a joint");
    }
    model.set_output(node(&model, "platform", "P"));
    model
}

/// A link of a chain and the elastic joint at its root.
#[derive(Debug, Clone)]
struct ChainLink {
    length: f64,
    direction: [f64; 3],
    slenderness: f64,
    joint: [f64; 6],
    /// A revolute joint, elastic about its axis too, or a bushing.
    hinge: bool,
}

fn chain(links: &[ChainLink]) -> Model {
    let mut model = Model::new("chain");
    let (mut at, mut last) = (Point3::origin(), None);
    for (k, link) in links.iter().enumerate() {
        let direction = Vector3::from(link.direction).normalize();
        let end = at + direction * link.length;
        let section = circle(link.length * link.slenderness);
        let (name, root, tip) = (format!("link{k}"), format!("p{k}"), format!("p{}", k + 1));
        let points = [(root.as_str(), at), (tip.as_str(), end)];
        model
            .add_beam(&name, &points, &steel(), &section, None, 1)
            .expect("a beam");
        let between = [last, Some(node(&model, &name, &root))];
        let joint = if link.hinge {
            connection(&root, between, Revolute)
        } else {
            connection(&root, between, Fixed)
        };
        let joint = elastic(joint, link.joint.map(Some));
        model
            .add_joint(joint, frame(&Vector3::new(0.3, -0.5, 0.8)))
            .expect("a joint");
        (at, last) = (end, Some(node(&model, &name, &tip)));
    }
    model.set_output(last.expect("a link"));
    model
}

/// Links of lengths 10^`length` m, their joints' stiffness from `joint`.
fn links(
    length: Range<f64>,
    joint: impl Strategy<Value = [f64; 6]>,
) -> impl Strategy<Value = Vec<ChainLink>> {
    let link = (
        magnitude(length.start, length.end),
        [-1.0..1.0, -1.0..1.0, 0.1..1.0],
        slenderness(),
        joint,
        any::<bool>(),
    );
    let link = link.prop_map(|(length, direction, slenderness, joint, hinge)| ChainLink {
        length,
        direction,
        slenderness,
        joint,
        hinge,
    });
    proptest::collection::vec(link, 1..6)
}

/// Chains of links of about one size, from 1 mm to 100 m.
pub(super) fn chains_of_one_size(
    joint: impl Strategy<Value = [f64; 6]>,
) -> impl Strategy<Value = Model> {
    (magnitude(-2.5, 2.0), links(-0.5..0.0, joint)).prop_map(|(size, mut links)| {
        for link in &mut links {
            link.length *= size;
        }
        chain(&links)
    })
}

/// Chains of links from 1 mm to 100 m, side by side.
pub(super) fn chains_of_any_size(
    joint: impl Strategy<Value = [f64; 6]>,
) -> impl Strategy<Value = Model> {
    links(-3.0..2.0, joint).prop_map(|links| chain(&links))
}

/// Diameter over length.
pub(super) fn slenderness() -> impl Strategy<Value = f64> {
    magnitude(-4.0, -0.7)
}

/// Deltas with links from 1 mm to 100 m.
fn deltas(joints: impl Strategy<Value = Option<[f64; 6]>>) -> impl Strategy<Value = Model> {
    let sections = [slenderness(), slenderness(), slenderness()];
    (magnitude(-2.5, 2.2), sections, joints)
        .prop_map(|(scale, sections, joints)| delta(scale, sections, joints))
}

/// Hexapods from 1 mm to 100 m, each drive of its own stiffness.
pub(super) fn hexapods(low: f64, high: f64) -> impl Strategy<Value = Model> {
    (magnitude(-3.0, 2.0), slenderness(), magnitudes(low, high))
        .prop_map(|(size, slenderness, drives)| hexapod(size, slenderness, drives))
}

#[test]
fn deltas_with_joints_from_1_to_1e18_and_rigid() {
    let joints = proptest::option::weighted(0.8, neighbours(0.0, 18.0));
    let compared = check_all(CASES, deltas(joints), |model| agrees(&model));
    assert!(compared > CASES * 3 / 4, "{compared} compared");
}

#[test]
fn hexapods_with_drives_from_1e_3_to_1e18() {
    let compared = check_all(CASES, hexapods(-3.0, 18.0), |model| agrees(&model));
    assert_eq!(compared, CASES);
}

#[test]
fn chains_with_joints_from_1_to_1e18() {
    let chains = chains_of_one_size(neighbours(0.0, 18.0));
    let compared = check_all(CASES, chains, |model| agrees(&model));
    assert!(compared > CASES * 9 / 10, "{compared} compared");
}

#[test]
fn chains_of_small_and_large_links() {
    let chains = chains_of_any_size(neighbours(0.0, 18.0));
    let compared = check_all(CASES, chains, |model| agrees(&model));
    assert!(compared > CASES / 2, "{compared} compared");
}

#[test]
fn chains_with_joints_from_1e_3() {
    let chains = chains_of_any_size(neighbours(-3.0, 3.0));
    let compared = check_all(CASES, chains, |model| agrees_or_warns(&model));
    assert!(compared > CASES / 2, "{compared} compared");
}

#[test]
fn deltas_with_joints_from_1e_3() {
    let joints = neighbours(-3.0, 3.0).prop_map(Some);
    let compared = check_all(CASES, deltas(joints), |model| agrees_or_warns(&model));
    assert!(compared > CASES * 9 / 10, "{compared} compared");
}

/// A joint of 1 N/m in one direction and of 1e18 N/m in the next, askew to all axes: the stiff
/// directions are absorbed, the soft ones keep coordinates of their own.
#[test]
fn chains_with_joints_of_unlike_directions() {
    let chains = chains_of_one_size(magnitudes(0.0, 18.0));
    let compared = check_all(CASES, chains, |model| agrees(&model));
    assert!(compared > CASES * 9 / 10, "{compared} compared");
}

#[test]
fn deltas_with_joints_of_unlike_directions() {
    let joints = magnitudes(0.0, 18.0).prop_map(Some);
    let compared = check_all(CASES, deltas(joints), |model| agrees(&model));
    assert!(compared > CASES * 3 / 4, "{compared} compared");
}
