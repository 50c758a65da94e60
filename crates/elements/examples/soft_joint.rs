//! What joints do to a rod: its softest and stiffest translation for joints from rigid to soft.
//!
//! `cargo run -p hyperstat-elements --example soft_joint`

use hyperstat_elements::subassembly::{
    ElasticJoint, JointFactor, absorb_joints, absorption_workspace,
};
use hyperstat_elements::{Beam, Elasticity, ElementError, Material, Section, SectionShape};
use nalgebra::{Matrix6, Rotation3, Vector6};

fn main() -> Result<(), ElementError> {
    let steel = Material::new(2.1e11, Elasticity::Poisson(0.3), None)?;
    let rod = Section::new(SectionShape::Circle { diameter: 0.014 }, None, None)?;
    let beam = Beam::new(&steel, &rod, 0.6)?;
    let arms = [beam.span()];
    let mut workspace = vec![0.0; absorption_workspace(1, 2)];

    println!("   joint [N/m]   along the rod   across it [N/m]");
    for exponent in [18, 12, 9, 8, 7, 6, 3, 0, -3] {
        let k = 10f64.powi(exponent);
        let joint = ElasticJoint {
            compliance: Matrix6::from_diagonal(&Vector6::new(1.0, 1.0, 1.0, 0.0, 0.0, 0.0)) / k,
            frame: Rotation3::identity(),
        };
        let joints = [0, 1].map(|node| JointFactor {
            node,
            factor: joint.factor(),
        });
        let mut stiffness = beam.cantilever_stiffness();
        absorb_joints(&joints, &arms, stiffness.as_mut_slice(), &mut workspace)?;
        println!(
            "{k:>14.0e} {:>15.6e} {:>17.6e}",
            stiffness[(0, 0)],
            stiffness[(2, 2)]
        );
    }
    Ok(())
}
