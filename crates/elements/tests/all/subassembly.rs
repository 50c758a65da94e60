//! The four forms of the subassembly stiffness against each other and against 32 digits.

use crate::support;

use hyperstat_elements::subassembly::{
    ChainSegment, ElasticJoint, JointFactor, StiffSegment, absorb_joints, absorption_workspace,
    add_joint_compliance, chain_flexibility, chain_stiffness, deformation_operator,
    invert_flexibility, relative_displacements, softened_stiffness, two_node_stiffness,
    unheld_stiffness,
};
use hyperstat_elements::{Beam, Section, SectionShape, transport};
use nalgebra::{DMatrix, DVector, Matrix6, Rotation3, Vector3, Vector6};
use proptest::prelude::*;

use support::oracle::{self, scaled_error};
use support::random::{self, Link};

fn arms(links: &[Link]) -> Vec<Vector3<f64>> {
    let step = |at: &mut Vector3<f64>, link: &Link| {
        *at += link.span();
        Some(*at)
    };
    links.iter().scan(Vector3::zeros(), step).collect()
}

/// Flexibility of the chain with its joints, node 0 held.
fn summed_flexibility(links: &[Link], joints: &[ElasticJoint]) -> DMatrix<f64> {
    let segment = |link: &Link| ChainSegment {
        compliance: link.compliance(),
        span: link.span(),
    };
    let segments: Vec<_> = links.iter().map(segment).collect();
    let size = 6 * links.len();
    let mut out = vec![f64::NAN; size * size];
    chain_flexibility(&segments, &mut out);
    for (node, joint) in joints.iter().enumerate() {
        add_joint_compliance(node, &joint.turned_compliance(), &arms(links), &mut out);
    }
    DMatrix::from_vec(size, size, out)
}

fn by_flexibility(links: &[Link], joints: &[ElasticJoint]) -> DMatrix<f64> {
    let mut out = summed_flexibility(links, joints);
    invert_flexibility(out.nrows(), out.as_mut_slice()).unwrap();
    out
}

fn by_absorption(links: &[Link], joints: &[ElasticJoint]) -> DMatrix<f64> {
    let segment = |link: &Link| StiffSegment {
        stiffness: link.stiffness(),
        span: link.span(),
    };
    let segments: Vec<_> = links.iter().map(segment).collect();
    let size = 6 * links.len();
    let mut out = vec![f64::NAN; size * size];
    chain_stiffness(&segments, &mut out);
    let factors: Vec<_> = (0..)
        .zip(joints)
        .map(|(node, joint)| JointFactor {
            node,
            factor: joint.factor(),
        })
        .collect();
    let mut workspace = vec![f64::NAN; absorption_workspace(links.len(), joints.len())];
    absorb_joints(&factors, &arms(links), &mut out, &mut workspace).unwrap();
    DMatrix::from_vec(size, size, out)
}

/// Over all nodes, from the stiffness with node 0 held.
fn unheld(held: &DMatrix<f64>, links: &[Link]) -> DMatrix<f64> {
    let size = held.nrows() + 6;
    let mut out = vec![f64::NAN; size * size];
    unheld_stiffness(held.as_slice(), &arms(links), &mut out);
    DMatrix::from_vec(size, size, out)
}

/// A beam as a link, in its element frame.
fn along_x(beam: &Beam) -> Link {
    Link {
        beam: *beam,
        frame: Rotation3::identity(),
    }
}

proptest! {
    #[test]
    fn paper_form_and_running_forms_agree(
        beam in random::beam(),
        first in random::joint(6.0, true),
        second in random::joint(6.0, true),
    ) {
        let paper = two_node_stiffness(&beam, &first, &second).unwrap();
        let paper = DMatrix::from_column_slice(12, 12, paper.as_slice());
        let links = [along_x(&beam)];
        let joints = [first, second];
        let summed = unheld(&by_flexibility(&links, &joints), &links);
        let absorbed = unheld(&by_absorption(&links, &joints), &links);
        prop_assert!(scaled_error(&summed, &paper) < 1e-10);
        prop_assert!(scaled_error(&absorbed, &paper) < 1e-10);
    }

    #[test]
    fn general_form_and_running_forms_agree(
        (links, joints) in random::jointed_chain(6.0, true),
    ) {
        let body = unheld(&by_absorption(&links, &[]), &links);
        let compliances: Vec<_> = joints.iter().map(ElasticJoint::turned_compliance).collect();
        let general = softened_stiffness(&body, &compliances).unwrap();
        let size = 6 * links.len();
        let general = general.view((6, 6), (size, size)).into_owned();
        prop_assert!(scaled_error(&by_absorption(&links, &joints), &general) < 1e-10);
        // A chain of slender and stout links has a flexibility with a condition of up to 1e9.
        prop_assert!(scaled_error(&by_flexibility(&links, &joints), &general) < 1e-6);
    }

    #[test]
    fn absorption_is_right_for_soft_joints_in_any_frame(
        (links, joints) in random::jointed_chain(0.0, true),
    ) {
        let stiffness = oracle::stiffness(&links, &joints);
        prop_assert!(scaled_error(&by_absorption(&links, &joints), &stiffness) < 1e-9);
    }

    /// Down to 1e-3 N/m and 1e-5 N·m/rad, up to 1e-14 of the links' stiffness.
    #[test]
    fn absorption_is_right_for_very_soft_joints_in_any_frame(
        (links, joints) in random::jointed_chain(-3.0, true),
    ) {
        let stiffness = oracle::stiffness(&links, &joints);
        prop_assert!(scaled_error(&by_absorption(&links, &joints), &stiffness) < 1e-8);
    }

    #[test]
    fn absorption_does_not_depend_on_the_order_of_joints(
        (links, joints) in random::jointed_chain(4.0, true),
    ) {
        let forward = by_absorption(&links, &joints);
        let mut one_by_one = by_absorption(&links, &[]);
        let mut workspace = vec![f64::NAN; absorption_workspace(links.len(), 1)];
        for (node, joint) in joints.iter().enumerate().rev() {
            let joint = [JointFactor { node, factor: joint.factor() }];
            absorb_joints(&joint, &arms(&links), one_by_one.as_mut_slice(), &mut workspace).unwrap();
        }
        prop_assert!(scaled_error(&one_by_one, &forward) < 1e-9);
    }

    #[test]
    fn flexibility_is_right_for_joints_of_any_softness_in_any_frame(
        (links, joints) in random::jointed_chain(-3.0, true),
    ) {
        let flexibility = oracle::flexibility(&links, &joints);
        let summed = summed_flexibility(&links, &joints);
        prop_assert!((&summed - &flexibility).amax() <= 1e-14 * flexibility.amax());
    }

    #[test]
    fn rigid_motion_gives_no_force(
        (links, joints) in random::jointed_chain(4.0, true),
        motion in random::displacement(),
    ) {
        let k = unheld(&by_absorption(&links, &joints), &links);
        let mut u = DVector::zeros(k.nrows());
        u.fixed_rows_mut::<6>(0).copy_from(&motion);
        for (r, arm) in arms(&links).iter().enumerate() {
            u.fixed_rows_mut::<6>(6 * r + 6).copy_from(&(transport(arm) * motion));
        }
        let force = &k * &u;
        // A force of node 0 is formed from those of the other nodes, with their rounding.
        let mut size = k.abs() * u.abs();
        for (r, arm) in arms(&links).iter().enumerate() {
            let carried = transport(arm).transpose().abs() * size.fixed_rows::<6>(6 * r + 6);
            let mut first = size.fixed_rows_mut::<6>(0);
            first += carried;
        }
        for row in 0..force.len() {
            prop_assert!(force[row].abs() <= 1e-14 * size[row], "{} of {}", force[row], size[row]);
        }
    }

    #[test]
    fn deformation_operator_is_the_relative_displacement(
        links in random::chain(),
        seed in proptest::collection::vec(random::displacement(), 4),
    ) {
        let arms = arms(&links);
        let u = &seed[..arms.len() + 1];
        let mut relative = vec![Vector6::zeros(); arms.len()];
        relative_displacements(u, &arms, &mut relative);
        let (rows, columns) = (6 * arms.len(), 6 * u.len());
        let mut operator = vec![f64::NAN; rows * columns];
        deformation_operator(&arms, &mut operator);
        let flat = DVector::from_iterator(columns, u.iter().flatten().copied());
        let product = DMatrix::from_vec(rows, columns, operator) * flat;
        let flat = DVector::from_iterator(rows, relative.iter().flatten().copied());
        prop_assert!((product - flat).amax() < 1e-14);
    }
}

#[test]
fn rigid_joints_change_no_bit() {
    let beam = Beam::new(
        &random::steel(),
        &Section::new(SectionShape::Circle { diameter: 0.014 }, None, None).unwrap(),
        0.6,
    )
    .unwrap();
    let links = [along_x(&beam), along_x(&beam)];
    let rigid = [const { None::<ElasticJoint> }; 3].map(|_| ElasticJoint::rigid());
    let body = by_flexibility(&links, &[]);
    assert_eq!(by_flexibility(&links, &rigid), body);
    assert_eq!(by_absorption(&links, &rigid), by_absorption(&links, &[]));
    let all = unheld(&body, &links);
    assert_eq!(
        softened_stiffness(&all, &[Matrix6::zeros(); 3]).unwrap(),
        all
    );
    let paper = two_node_stiffness(&beam, &rigid[0], &rigid[1]).unwrap();
    let own = DMatrix::from_column_slice(12, 12, beam.stiffness().as_slice());
    let paper = DMatrix::from_column_slice(12, 12, paper.as_slice());
    assert!(scaled_error(&paper, &own) < 1e-14);
}

#[test]
fn joints_along_the_axes_keep_all_digits_at_any_softness() {
    let section = Section::new(SectionShape::Circle { diameter: 0.02 }, None, None).unwrap();
    let beam = Beam::new(&random::steel(), &section, 0.3).unwrap();
    let links = [along_x(&beam)];
    for exponent in -3..=18 {
        let soft = ElasticJoint {
            compliance: Matrix6::from_diagonal_element(10f64.powi(-exponent)),
            frame: Rotation3::identity(),
        };
        let joints = [soft.clone(), soft];
        let stiffness = oracle::stiffness(&links, &joints);
        let summed = scaled_error(&by_flexibility(&links, &joints), &stiffness);
        let absorbed = scaled_error(&by_absorption(&links, &joints), &stiffness);
        assert!(summed < 1e-10, "k = 1e{exponent}: {summed:e}");
        assert!(absorbed < 1e-10, "k = 1e{exponent}: {absorbed:e}");
    }
}

/// A soft direction across the axes of the chain, where the flexibility keeps seven digits.
#[test]
fn tilted_soft_joint_leaves_the_stiff_directions_as_they_are() {
    let section = Section::new(SectionShape::Circle { diameter: 0.02 }, None, None).unwrap();
    let beam = Beam::new(&random::steel(), &section, 0.3).unwrap();
    let links = [Link {
        beam,
        frame: Rotation3::from_euler_angles(0.4, -0.7, 1.1),
    }];
    let soft = ElasticJoint {
        compliance: Matrix6::from_diagonal(&Vector6::new(0.0, 1e3, 0.0, 0.0, 0.0, 0.0)),
        frame: Rotation3::from_euler_angles(-0.3, 0.9, 0.2),
    };
    for joints in [
        [soft.clone(), ElasticJoint::rigid()],
        [ElasticJoint::rigid(), soft.clone()],
        [soft.clone(), soft],
    ] {
        let stiffness = oracle::stiffness(&links, &joints);
        assert!(scaled_error(&by_absorption(&links, &joints), &stiffness) < 1e-12);
    }
}

/// Translations soft in every direction: the whole of the force goes through the soft joint.
#[test]
fn soft_mount_keeps_its_stiffness() {
    let section = Section::new(SectionShape::Circle { diameter: 0.02 }, None, None).unwrap();
    let beam = Beam::new(&random::steel(), &section, 0.3).unwrap();
    let links = [Link {
        beam,
        frame: Rotation3::from_euler_angles(0.4, -0.7, 1.1),
    }];
    let mount = ElasticJoint {
        compliance: Matrix6::from_diagonal(&Vector6::new(1e3, 1e3, 1e3, 0.0, 0.0, 0.0)),
        frame: Rotation3::identity(),
    };
    let joints = [mount, ElasticJoint::rigid()];
    let stiffness = oracle::stiffness(&links, &joints);
    assert!(scaled_error(&by_absorption(&links, &joints), &stiffness) < 1e-10);
    assert!(scaled_error(&by_flexibility(&links, &joints), &stiffness) < 1e-10);
    let compliance = by_absorption(&links, &joints).try_inverse().unwrap();
    assert!(scaled_error(&compliance, &oracle::flexibility(&links, &joints)) < 1e-10);
}

/// The delta's cross link B1–B–B2: three nodes, an elastic joint at each, the middle one too.
#[test]
fn cross_link_with_a_joint_at_every_node() {
    let section = Section::new(SectionShape::Circle { diameter: 0.02 }, None, None).unwrap();
    let half = Beam::new(&random::steel(), &section, 0.06).unwrap();
    let links = [along_x(&half), along_x(&half)];
    let joint = |angle: f64| ElasticJoint {
        compliance: Matrix6::from_diagonal(&Vector6::new(1e-8, 1e-8, 1e-8, 1e-5, 1e-7, 1e-5)),
        frame: Rotation3::new(Vector3::new(0.3, angle, -0.2)),
    };
    let joints = [joint(0.5), joint(-1.2), joint(2.0)];
    let stiffness = oracle::stiffness(&links, &joints);
    assert!(scaled_error(&by_flexibility(&links, &joints), &stiffness) < 1e-12);
    assert!(scaled_error(&by_absorption(&links, &joints), &stiffness) < 1e-12);

    // By its parts: the body's own 18×18 from two 12×12, and a spring element at each node.
    let mut all = DMatrix::zeros(36, 36);
    for first in [0, 6] {
        let mut view = all.view_mut((first, first), (12, 12));
        view += half.stiffness();
    }
    for (node, joint) in joints.iter().enumerate() {
        let k = joint.turned_compliance().try_inverse().unwrap();
        for (row, column, sign) in [(0, 0, 1.0), (0, 18, -1.0), (18, 0, -1.0), (18, 18, 1.0)] {
            let mut view = all.view_mut((row + 6 * node, column + 6 * node), (6, 6));
            view += k * sign;
        }
    }
    let inner = all.view((0, 0), (18, 18)).into_owned();
    let coupling = all.view((0, 18), (18, 18)).into_owned();
    let outer = all.view((18, 18), (18, 18)).into_owned();
    let condensed = outer - coupling.transpose() * inner.lu().solve(&coupling).unwrap();
    let ours = unheld(&by_absorption(&links, &joints), &links);
    assert!(scaled_error(&ours, &condensed) < 1e-11);
}

#[test]
fn splitting_a_beam_leaves_its_stiffness_as_it_is() {
    let section = Section::new(
        SectionShape::Rectangle {
            width: 0.02,
            height: 0.04,
        },
        Some(6e-4),
        None,
    )
    .unwrap();
    let whole = Beam::new(&random::steel(), &section, 0.5).unwrap();
    for parts in [2, 3, 16] {
        let part = Beam::new(&random::steel(), &section, 0.5 / parts as f64).unwrap();
        let links = vec![along_x(&part); parts];
        let size = 6 * parts;
        let flexibility = summed_flexibility(&links, &[]);
        // Loads at the last node only: its block of the flexibility is the condensed one.
        let tip = flexibility.view((size - 6, size - 6), (6, 6)).into_owned();
        let expected = DMatrix::from_column_slice(6, 6, whole.cantilever_compliance().as_slice());
        assert!(scaled_error(&tip, &expected) < 1e-14, "{parts} parts");
        // And by condensing the stiffness.
        let k = by_absorption(&links, &[]);
        let inner = k.view((0, 0), (size - 6, size - 6)).into_owned();
        let coupling = k.view((0, size - 6), (size - 6, 6)).into_owned();
        let last = k.view((size - 6, size - 6), (6, 6)).into_owned();
        let condensed = last - coupling.transpose() * inner.lu().solve(&coupling).unwrap();
        let expected = DMatrix::from_column_slice(6, 6, whole.cantilever_stiffness().as_slice());
        let error = scaled_error(&condensed, &expected);
        assert!(error < 1e-11, "{parts} parts: {error:e}");
    }
}

/// Patch test: constant strain over unevenly spaced nodes leaves inner nodes without force.
#[test]
fn constant_strain_states_pass_the_patch_test() {
    let section = Section::new(
        SectionShape::Rectangle {
            width: 0.02,
            height: 0.03,
        },
        Some(5e-4),
        Some(5e-4),
    )
    .unwrap();
    let lengths = [0.05, 0.21, 0.08];
    let beams = lengths.map(|l| Beam::new(&random::steel(), &section, l).unwrap());
    let links: Vec<_> = beams.iter().map(along_x).collect();
    let k = unheld(&by_absorption(&links, &[]), &links);
    let rigidity = beams[0].section_compliance().map(|c| 1.0 / c);
    let places = [0.0, 0.05, 0.26, 0.34];
    // (component of the section wrench, displacement at x for unit strain)
    type Field = fn(f64) -> Vector6<f64>;
    let states: [(usize, Field); 4] = [
        (0, |x| Vector6::new(x, 0.0, 0.0, 0.0, 0.0, 0.0)),
        (3, |x| Vector6::new(0.0, 0.0, 0.0, x, 0.0, 0.0)),
        (4, |x| Vector6::new(0.0, 0.0, -x * x / 2.0, 0.0, x, 0.0)),
        (5, |x| Vector6::new(0.0, x * x / 2.0, 0.0, 0.0, 0.0, x)),
    ];
    for (component, field) in states {
        let u = DVector::from_iterator(24, places.iter().flat_map(|x| field(*x).data.0[0]));
        let force = &k * u;
        let resultant = rigidity[component];
        let mut expected = DVector::zeros(24);
        expected[component] = -resultant;
        expected[18 + component] = resultant;
        let error = (&force - &expected).amax() / resultant;
        assert!(error < 1e-12, "component {component}: {error:e}");
    }
}

#[test]
fn flexibility_without_inverse_is_refused() {
    let mut singular = vec![1.0, 2.0, 2.0, 4.0];
    let error = invert_flexibility(2, &mut singular).unwrap_err();
    assert!(error.to_string().contains("row 1"), "{error}");
    assert!(invert_flexibility(1, &mut [f64::NAN]).is_err());
    assert!(invert_flexibility(1, &mut [-1.0]).is_err());
    assert!(invert_flexibility(1, &mut [0.0]).is_err());
    let mut nan = vec![f64::NAN; 36];
    let mut workspace = vec![0.0; absorption_workspace(1, 1)];
    let joint = JointFactor {
        node: 0,
        factor: Matrix6::identity(),
    };
    let result = absorb_joints(&[joint], &[Vector3::x()], &mut nan, &mut workspace);
    assert!(result.is_err());
}
