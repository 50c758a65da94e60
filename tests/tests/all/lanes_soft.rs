//! Poses in SIMD lanes beside joints of any stiffness, from next to free to next to rigid: what the
//! lanes answer is what a sweep finds; what they cannot vouch for goes one by one.

use hyperstat_assembly::{LANES, PoseResult, Prepared, SolveError};
use hyperstat_mechanisms::prebuilt::{
    Delta, Exechon, Hexapod, LinearDelta, Orthoglide, PlanarThreeRrr, Prebuilt, SphericalThreeRrr,
    ThreePrs, ThreeRps, Tricept, Tripteron,
};
use hyperstat_tests::prebuilt::{Case, legs, links, loaded};
use hyperstat_tests::runner::check_all;
use hyperstat_tests::stiffness_difference;
use nalgebra::Vector6;
use proptest::prelude::Strategy;

/// Lanes against one by one: relative to √(K_ii K_jj), and of displacements with their components
/// times √K_ii to the largest.
const AGREEMENT: f64 = 1e-11;

/// A prebuilt mechanism with these joints and drives.
macro_rules! with_joints {
    ($stiffness:ident, $drive:ident, $($kind:ident: $plain:expr),*) => {
        [$(Box::new($kind {
            joint_stiffness: $stiffness,
            drive_stiffness: $drive,
            ..$plain
        }) as Box<dyn Prebuilt>),*]
    };
}

fn mechanisms(stiffness: [Option<f64>; 6], drive: Option<f64>) -> [Box<dyn Prebuilt>; 11] {
    with_joints!(
        stiffness, drive,
        Hexapod: legs::hexapod(),
        LinearDelta: legs::linear_delta(),
        Tricept: legs::tricept(),
        ThreeRps: legs::three_rps(),
        ThreePrs: legs::three_prs(),
        PlanarThreeRrr: links::planar(),
        SphericalThreeRrr: links::spherical(),
        Tripteron: links::tripteron(),
        Orthoglide: links::orthoglide(),
        Exechon: links::exechon(),
        Delta: Delta::paper()
    )
}

/// A mechanism with poses in its reach.
fn in_reach(mechanism: Box<dyn Prebuilt>) -> Case {
    let cases = legs::cases().into_iter().chain(links::cases());
    let like = cases
        .into_iter()
        .find(|case| case.mechanism.kind() == mechanism.kind());
    match like {
        Some(like) => Case { mechanism, ..like },
        // The delta.
        None => Case {
            mechanism,
            poses: vec![vec![0.0, 0.0, 0.5]],
            middle: vec![0.0, 0.0, 0.5],
            span: vec![0.2, 0.2, 0.1],
            counts: [0; 3],
        },
    }
}

/// The errors of a pose's stiffness and displacement.
fn errors(found: &PoseResult, one: &PoseResult) -> Option<[f64; 2]> {
    let (k, u) = (one.stiffness?, one.displacement?);
    let weights = k.diagonal().map(f64::sqrt);
    let weighed = |u: Vector6<f64>| u.component_mul(&weights).amax();
    let moved = weighed(found.displacement? - u) / weighed(u);
    Some([stiffness_difference(&found.stiffness?, &k), moved])
}

/// A kind, stiffnesses of its joints and drives, and poses, all between −1 and 1 or as powers of ten.
type Draw = (usize, [Option<f64>; 6], Option<f64>, [[f64; 6]; LANES]);

fn draws() -> impl Strategy<Value = Draw> {
    let magnitude = || proptest::option::weighted(0.85, -3.0..15.0_f64);
    (
        0..11_usize,
        proptest::array::uniform6(magnitude()),
        proptest::option::of(-3.0..15.0_f64),
        proptest::array::uniform8(proptest::array::uniform6(-1.0..1.0_f64)),
    )
}

/// Errors of the poses that both ways answer; poses that the lanes handed on. `None` where a draw
/// makes no mechanism.
fn compared((number, stiffness, drive, units): Draw) -> Option<(Vec<[f64; 2]>, u64)> {
    let power = |exponent: f64| 10.0_f64.powf(exponent);
    let mut stiffness = stiffness.map(|exponent| exponent.map(power));
    // All these mechanisms' joints turn freely about y.
    stiffness[4] = None;
    let mechanisms = mechanisms(stiffness, drive.map(power));
    let mechanism = mechanisms.into_iter().nth(number)?;
    let case = in_reach(mechanism);
    case.mechanism.model(&case.poses[0]).ok()?;
    let model = loaded(&*case.mechanism, &case.poses[0]);
    let prepared = Prepared::new(model);
    let mut lanes = prepared.lanes().expect("a plan");
    let mut workspace = prepared.workspace().expect("a plan");
    for (lane, unit) in units.iter().enumerate() {
        let placed = case
            .mechanism
            .place(&case.pose(unit), lanes.geometry_mut(lane));
        placed.expect("in reach");
    }
    let poses: [_; LANES] = std::array::from_fn(|lane| lanes.geometry_mut(lane).clone());
    let found = prepared.sweep_lanes(&mut lanes, [true; LANES]);
    let mut both = Vec::new();
    for (found, pose) in found.iter().zip(&poses) {
        if let (Some(Ok(found)), Ok(one)) = (found, prepared.sweep(pose, &mut workspace)) {
            both.extend(errors(found, &one));
        }
    }
    Some((both, lanes.one_by_one()))
}

/// As many draws as the environment's `HYPERSTAT_RANDOM_CASES` says, or 400.
#[test]
fn joints_of_any_stiffness_take_no_digits_in_silence() {
    let cases = std::env::var("HYPERSTAT_RANDOM_CASES").ok();
    let cases = cases.and_then(|text| text.parse().ok()).unwrap_or(400);
    let seen = std::cell::RefCell::new((Vec::new(), 0));
    check_all(cases, draws(), |draw| {
        let Some((errors, handed_on)) = compared(draw) else {
            return Ok(false);
        };
        let mut seen = seen.borrow_mut();
        seen.0.extend(errors);
        seen.1 += handed_on;
        Ok(true)
    });
    let (errors, handed_on) = seen.into_inner();
    let worst = [0, 1].map(|k| errors.iter().map(|e| e[k]).fold(0.0, f64::max));
    println!(
        "{} compared, {handed_on} handed on, errors up to {worst:?}",
        errors.len()
    );
    assert!(worst.iter().all(|error| *error <= AGREEMENT), "{worst:?}");
    // Poses that are handed on prove nothing.
    assert!(
        errors.len() > 2 * cases as usize,
        "{} compared",
        errors.len()
    );
    assert!(2 * handed_on < errors.len() as u64, "{handed_on} handed on");
}

/// Drives that are nothing beside the joints (K along the axes is that of the drives, to 1e-12 at 1e-3
/// N/m, and is nothing but the rounding of the joints' energy below 1e-24): a pose is right, or refused.
#[test]
fn drives_of_next_to_nothing_are_right_or_refused() {
    let stiffness = [Some(1e8), Some(1e9), Some(1e8), Some(1e6), None, Some(1e6)];
    let (mut answered, mut refused) = (0, 0);
    for exponent in 3..40 {
        let drive = 10.0_f64.powi(-exponent);
        let tripteron = Tripteron {
            joint_stiffness: stiffness,
            drive_stiffness: Some(drive),
            ..links::tripteron()
        };
        let model = loaded(&tripteron, &[0.02, 0.01, 0.03]);
        let pose = model.geometry().clone();
        let prepared = Prepared::new(model);
        match prepared.sweep(&pose, &mut prepared.workspace().expect("a plan")) {
            Ok(found) => {
                let stiffness = found.stiffness.expect("a stiffness");
                for k in 0..3 {
                    let off = stiffness[(k, k)] / drive - 1.0;
                    assert!(off.abs() < 0.5, "{drive:e}: {k} is {off:e} off");
                }
                answered += 1;
            }
            Err(SolveError::Singular) => refused += 1,
            Err(other) => panic!("{drive:e}: {other}"),
        }
    }
    assert!(
        answered > 15 && refused > 10,
        "{answered} answered, {refused} refused"
    );
}
