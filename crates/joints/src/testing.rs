//! A conformance test that every joint can be run through, a user's own as the built-in ones.
//!
//! ```
//! use hyperstat_joints::{Universal, testing::assert_conforms};
//!
//! assert_conforms(&Universal);
//! ```

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use nalgebra::{Dyn, Matrix6, OMatrix, Rotation3, U3, Unit, Vector3, Vector6};

use crate::dof::{Dof, DofSet};
use crate::joint::Joint;
use crate::mapping::Mapping;

/// Relative error allowed where N must give back a displacement.
const ROUNDING: f64 = 1e-11;
/// What a tie between two minors may add to an entry that is 1 at most.
const TIE: f64 = 1e-8;

/// Checks `joint` against everything that [`Joint`] promises, in all of [`frames`].
///
/// In every frame, and for each of the 64 sets of directions that locks and elastic directions
/// can leave moving:
///
/// * there are as many IDCs as moving directions, and as many rotations among them as the
///   motions have independent rotations;
/// * the rows of N at the IDCs are the identity's;
/// * N gives back every displacement `u_i = u_j + S q`, S being the moving columns of
///   [`Joint::basis`] in global axes: body to body, and body to ground where `u_j = 0`; with
///   `q = 0` the bodies move as one;
/// * the entries of N are finite and bounded: at most 1 between rotations and between
///   translations, at most 3 times the largest travel per angle from rotations to translations;
/// * asked twice, the joint says the same.
///
/// Further: the basis is finite and invertible, the compliance, where there is one, is symmetric
/// positive semidefinite, and the clone is the same joint.
///
/// # Panics
/// Where the joint breaks a rule, with the rule, the frame and the moving directions.
pub fn assert_conforms(joint: &dyn Joint) {
    assert!(!joint.kind().is_empty(), "the kind needs a name");
    assert_basis(joint);
    assert_compliance(joint);
    assert_conforms_in(joint, &frames());
}

/// Checks the mappings and the clone of `joint` in frames of your own: the list of
/// [`assert_conforms`].
///
/// # Panics
/// Where the joint breaks a rule, with the rule, the frame and the moving directions.
pub fn assert_conforms_in(joint: &dyn Joint, frames: &[Rotation3<f64>]) {
    let clone = joint.clone_box();
    assert!(
        clone.kind() == joint.kind()
            && clone.free() == joint.free()
            && clone.basis() == joint.basis()
            && clone.compliance() == joint.compliance(),
        "{}: the clone is another joint",
        joint.kind()
    );
    for bits in 0..64_u8 {
        let moving: DofSet = Dof::ALL
            .into_iter()
            .filter(|dof| bits & (1 << dof.index()) != 0)
            .collect();
        let motions = RelativeMotions::of(joint, moving);
        for frame in frames {
            let place = || format!("{}, moving {moving}, frame {frame}", joint.kind());
            let mapping = joint
                .mapping(frame, moving)
                .unwrap_or_else(|error| panic!("{error}: {}", place()));
            for other in [joint.mapping(frame, moving), clone.mapping(frame, moving)] {
                let same = other.is_ok_and(|other| other == mapping);
                assert!(same, "asked twice, N differs: {}", place());
            }
            if let Err(broken) = check(&mapping, &motions, frame) {
                panic!("{broken}: {}", place());
            }
        }
    }
}

/// The joint frames that [`assert_conforms`] tries: all axis-parallel ones, these turned by
/// 1e-3 … 1e-16 rad, ones in which two or three minors tie, and a hundred spread over all
/// orientations. The same at every call.
pub fn frames() -> Vec<Rotation3<f64>> {
    let mut special = axis_parallel_frames();
    for axis in [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()] {
        special.push(Rotation3::from_axis_angle(&axis, FRAC_PI_4));
        special.push(Rotation3::from_axis_angle(&axis, -FRAC_PI_4));
    }
    // Each axis of the frame along the diagonal of space in turn.
    let diagonal = Vector3::new(1.0, 1.0, 1.0);
    for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
        special.extend(Rotation3::rotation_between(&axis, &diagonal));
    }
    let about = [
        Vector3::x_axis(),
        Vector3::y_axis(),
        Vector3::z_axis(),
        Unit::new_normalize(Vector3::new(0.36, -0.8, 0.48)),
        Unit::new_normalize(Vector3::new(1.0, 1.0, 1.0)),
    ];
    let mut frames = special.clone();
    for (k, frame) in special.iter().enumerate() {
        for exponent in 3..=16 {
            let turn = k + exponent as usize;
            let sign = if turn.is_multiple_of(2) { 1.0 } else { -1.0 };
            let angle = sign * 10.0_f64.powi(-exponent);
            let axis = &about[turn % about.len()];
            frames.push(Rotation3::from_axis_angle(axis, angle) * frame);
        }
    }
    frames.extend((1..=100).map(|k| {
        let [a, b, c] = spread(k);
        Rotation3::from_euler_angles(TAU * a, TAU * b, TAU * c)
    }));
    frames
}

/// The 24 frames whose axes are all along global axes, without rounding.
fn axis_parallel_frames() -> Vec<Rotation3<f64>> {
    let about = |axis, turns: u8| {
        let turn = Rotation3::from_axis_angle(&axis, f64::from(turns) * FRAC_PI_2);
        Rotation3::from_matrix_unchecked(turn.matrix().map(f64::round))
    };
    let mut frames = Vec::with_capacity(24);
    for turns in 0..4 {
        let spin = about(Vector3::z_axis(), turns);
        frames.extend((0..4).map(|up| about(Vector3::x_axis(), up) * spin));
        frames.extend([1, 3].map(|up| about(Vector3::y_axis(), up) * spin));
    }
    frames
}

/// The k-th of a sequence of points spread evenly over the unit cube.
fn spread(k: usize) -> [f64; 3] {
    // Powers of the real root of g⁴ = g + 1 (Roberts' generalised golden ratio).
    let g = 1.220_744_084_605_759_5_f64;
    [1, 2, 3].map(|power| (k as f64 * g.powi(-power)).fract())
}

/// The relative motions of a joint in its own frame, as its basis states them.
struct RelativeMotions {
    columns: Vec<Vector6<f64>>,
    /// Rank of the rotations.
    rotations: usize,
    /// Largest travel per angle \[m/rad\].
    travel: f64,
    /// What is rounding in a translation \[m\].
    rounding: f64,
}

impl RelativeMotions {
    fn of(joint: &dyn Joint, moving: DofSet) -> Self {
        let basis = joint.basis();
        let columns: Vec<Vector6<f64>> = moving
            .iter()
            .map(|dof| basis.column(dof.index()).into_owned())
            .collect();
        let part = |row: usize| {
            OMatrix::<f64, U3, Dyn>::from_fn(columns.len(), |k, l| columns[l][row + k])
        };
        let [delta_size, phi_size] = [0, 3].map(|row| basis.fixed_rows::<3>(row).amax());
        let (mut rotations, mut travel) = (0, 0.0);
        if !columns.is_empty() {
            let svd = part(3).svd(true, true);
            let threshold = 1e-9 * phi_size;
            rotations = svd.rank(threshold);
            let inverse = svd.pseudo_inverse(threshold);
            travel = inverse.map_or(0.0, |inverse| (part(0) * inverse).norm());
        }
        Self {
            columns,
            rotations,
            travel,
            rounding: 1e-9 * delta_size,
        }
    }

    /// A combination of the motions, none of them larger than 1.
    fn combination(&self, sample: usize) -> Vector6<f64> {
        let motion = |(k, column): (usize, &Vector6<f64>)| {
            let [size, ..] = spread(7 * sample + k + 1);
            column * ((2.0 * size - 1.0) / column.norm())
        };
        self.columns.iter().enumerate().map(motion).sum()
    }
}

fn check(
    mapping: &Mapping,
    motions: &RelativeMotions,
    frame: &Rotation3<f64>,
) -> Result<(), String> {
    let idcs = mapping.idcs();
    if idcs.len() != motions.columns.len() {
        return Err(format!("{} IDCs, not one a moving direction", idcs.len()));
    }
    let rotations = idcs.iter().filter(|dof| dof.is_rotation()).count();
    if rotations != motions.rotations {
        let rank = motions.rotations;
        return Err(format!("{rotations} rotations among the IDCs, not {rank}"));
    }
    check_rows_and_entries(mapping, motions)?;

    let tolerance = ROUNDING * (1.0 + motions.travel);
    for sample in 0..4 {
        let relative = turned(&motions.combination(sample), frame);
        let [a, b, c] = spread(2 * sample + 1);
        let [d, e, f] = spread(2 * sample + 2);
        let u_j = Vector6::new(a, b, c, d, e, f) * 2.0 - Vector6::repeat(1.0);
        let ground = Vector6::zeros();
        for (case, u_i, u_j) in [
            ("body to body", u_j + relative, u_j),
            ("body to ground", relative, ground),
            ("bodies that move as one", u_j, u_j),
        ] {
            let error = (evaluate(mapping, &u_i, &u_j) - u_i).amax();
            if error > tolerance {
                return Err(format!("N misses u_i by {error:e} ({case})"));
            }
        }
    }
    Ok(())
}

/// A displacement given in the axes of `frame`, in global axes.
fn turned(u: &Vector6<f64>, frame: &Rotation3<f64>) -> Vector6<f64> {
    let delta = frame * u.fixed_rows::<3>(0);
    let phi = frame * u.fixed_rows::<3>(3);
    Vector6::from_iterator(delta.iter().chain(phi.iter()).copied())
}

/// `N [u_i at the IDCs; u_j]`
fn evaluate(mapping: &Mapping, u_i: &Vector6<f64>, u_j: &Vector6<f64>) -> Vector6<f64> {
    let idcs = mapping.idcs();
    let own: Vector6<f64> = idcs
        .iter()
        .zip(mapping.n_i())
        .map(|(idc, column)| column * u_i[idc.index()])
        .sum();
    own + mapping.n_j() * u_j
}

fn check_rows_and_entries(mapping: &Mapping, motions: &RelativeMotions) -> Result<(), String> {
    let n = mapping.matrix();
    if mapping.ground_matrix() != n.columns(0, mapping.len()) {
        return Err("body to ground is not the first columns of N".into());
    }
    for (k, idc) in mapping.idcs().iter().enumerate() {
        let exact = |l: usize| if k == l { 1.0 } else { 0.0 };
        if (0..n.ncols()).any(|l| n[(idc.index(), l)] != exact(l)) {
            return Err(format!(
                "the row of N at its IDC {idc} is not the identity's"
            ));
        }
    }
    let from: Vec<Dof> = mapping.idcs().iter().chain(Dof::ALL).collect();
    for (l, from) in from.into_iter().enumerate() {
        for to in Dof::ALL {
            let bound = match (from.is_rotation(), to.is_rotation()) {
                (true, false) => 3.0 * motions.travel * (1.0 + TIE) + motions.rounding,
                (false, true) => 0.0,
                _ => 1.0 + TIE,
            };
            let entry = n[(to.index(), l)];
            if entry.abs() > bound {
                return Err(format!("N at ({to}, {from}) is {entry}, above {bound}"));
            }
        }
    }
    Ok(())
}

fn assert_basis(joint: &dyn Joint) {
    let kind = joint.kind();
    let basis = joint.basis();
    let finite = basis.iter().all(|entry| entry.is_finite());
    assert!(finite, "{kind}: the basis is not finite: {basis}");
    let inverse = basis.try_inverse();
    let error = inverse.map(|inverse| (basis * inverse - Matrix6::identity()).amax());
    assert!(
        error.is_some_and(|error| error < 1e-6),
        "{kind}: the basis is not invertible: {basis}"
    );
}

fn assert_compliance(joint: &dyn Joint) {
    let kind = joint.kind();
    let Some(compliance) = joint.compliance() else {
        return;
    };
    let finite = compliance.iter().all(|entry| entry.is_finite());
    assert!(finite, "{kind}: the compliance is not finite: {compliance}");
    // Scaled to a unit diagonal, because the units differ from entry to entry.
    let scale = compliance.diagonal().map(|entry| entry.abs().sqrt());
    let scaled = Matrix6::from_fn(|k, l| {
        let size = scale[k] * scale[l];
        let entry = compliance[(k, l)];
        if size == 0.0 { entry } else { entry / size }
    });
    assert!(
        (scaled - scaled.transpose()).amax() < 1e-9,
        "{kind}: the compliance is not symmetric: {compliance}"
    );
    assert!(
        scaled.symmetric_eigenvalues().min() > -1e-9,
        "{kind}: the compliance is not positive semidefinite: {compliance}"
    );
}
