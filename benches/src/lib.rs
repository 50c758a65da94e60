//! Shared parts of the benches: the paper's delta, its load, its trajectory.

use hyperstat_assembly::Model;
use hyperstat_mechanisms::prebuilt::{Delta, Prebuilt};
use nalgebra::Vector6;

/// Position of the platform where one pose is measured \[m\].
pub const POSE: [f64; 3] = [-0.2, -0.2, 0.5];

/// The delta with rigid and with elastic joints (1e8 N/m and 1e5 N·m/rad), each with its name.
pub fn deltas() -> [(&'static str, Delta); 2] {
    let elastic = Delta {
        joint_stiffness: [Some(1e8), Some(1e8), Some(1e8), Some(1e5), None, Some(1e5)],
        ..Delta::paper()
    };
    [
        ("rigid joints", Delta::paper()),
        ("elastic joints", elastic),
    ]
}

/// The delta's model at `pose` under the paper's load (§4.1).
///
/// # Panics
/// Where the pose is out of reach.
pub fn loaded_model(delta: &Delta, pose: &[f64; 3]) -> Model {
    let mut model = delta.model(pose).expect("a pose within reach");
    let output = model.output().expect("the delta has an output");
    model
        .add_load(output, Vector6::new(-20.0, 10.0, 100.0, 5.0, 5.0, 8.0))
        .expect("a finite load");
    model
}

/// The paper's trajectory (Eq. 65) at the instants t = 0, 0.1, … 6: positions of the platform
/// \[m\].
pub fn trajectory() -> Vec<[f64; 3]> {
    let at = |t: f64| match t {
        t if t < 2.0 => [-0.2, -0.2, 0.45 + 0.05 * t],
        t if t < 4.0 => [-0.2 + 0.2 * (t - 2.0), -0.2, 0.55],
        t => [0.2, -0.2, 0.55 - 0.05 * (t - 4.0)],
    };
    (0..=60).map(|k| at(f64::from(k) / 10.0)).collect()
}
