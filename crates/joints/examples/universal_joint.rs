//! N of a universal joint, body to body and body to ground, beside Eq. 17 of the paper.
//!
//! `cargo run -p hyperstat-joints --example universal_joint`

use hyperstat_joints::{Joint, JointError, Universal, frame_from_axes};
use nalgebra::Vector3;

fn main() -> Result<(), JointError> {
    // The first axis is fixed in body i, the second in body j.
    let a = Vector3::new(1.0, 0.0, 0.2);
    let b = Vector3::new(0.0, 1.0, -0.5);
    let frame = frame_from_axes(&a, &b)?;
    let mapping = Universal.mapping(&frame, Universal.free())?;

    // IDCs are components of u_i along the global axes: u v w are φx φy φz.
    println!("IDCs of body i: {}\n", mapping.idcs());
    println!(
        "Body to body, u_i = N [u_i at the IDCs; u_j]:{:.4}",
        mapping.matrix()
    );
    println!(
        "Body to ground, u_i = N [u_i at the IDCs]:{:.4}",
        mapping.ground_matrix()
    );

    // Eq. 17: φ_iz = a_x φ_ix + a_y φ_iy + … from the entries of the frame's rotation matrix.
    let r = frame.matrix();
    let minor = r[(0, 0)] * r[(1, 1)] - r[(0, 1)] * r[(1, 0)];
    let a_x = (r[(2, 0)] * r[(1, 1)] - r[(2, 1)] * r[(1, 0)]) / minor;
    let a_y = (r[(0, 0)] * r[(2, 1)] - r[(0, 1)] * r[(2, 0)]) / minor;
    println!("Eq. 17: φ_iz = {a_x:.4} φ_ix + {a_y:.4} φ_iy + …");
    assert!((mapping.column(0)[5] - a_x).abs() < 1e-15);
    assert!((mapping.column(1)[5] - a_y).abs() < 1e-15);
    Ok(())
}
