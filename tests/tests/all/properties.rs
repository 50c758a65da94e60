//! Properties of the whole model over random deltas: any size, pose, orientation and stiffness.

use hyperstat_assembly::{Connection, Model, Solution, solve};
use hyperstat_elements::{Beam, Section, SectionShape};
use hyperstat_joints::{Dof, DofSet, Joint, JointError, Mapping};
use hyperstat_mechanisms::prebuilt::{Delta, Elbow, Link, Prebuilt, RodEnds};
use hyperstat_tests::{moved, rebuilt, stiffness, stiffness_difference, turned, turned_matrix};
use nalgebra::{Matrix6, Rotation3, SymmetricEigen, Vector3, Vector6};
use proptest::prelude::*;

fn circle(diameter: f64) -> Section {
    Section::new(SectionShape::Circle { diameter }, None, None).expect("a section")
}

/// A delta and a pose that it reaches.
fn deltas() -> impl Strategy<Value = (Delta, [f64; 3])> {
    let sizes = (0.15..0.35, 0.03..0.1, 0.25..0.4, 0.55..0.8, 0.05..0.2);
    let diameters = (0.01..0.05, 0.01..0.04, 0.005..0.03);
    let pose = (-0.15..0.15, -0.15..0.15, 0.4..0.6);
    let soft = proptest::option::of((6.0..11.0, 3.0..8.0));
    (sizes, diameters, pose, soft, any::<bool>()).prop_filter_map(
        "reachable",
        |(sizes, diameters, pose, soft, balls)| {
            let paper = Delta::paper();
            let link = |d: f64, old: &Link| Link {
                section: circle(d),
                material: old.material.clone(),
            };
            let elastic = |(linear, angular): (f64, f64)| {
                let (k, c) = (Some(10.0_f64.powf(linear)), Some(10.0_f64.powf(angular)));
                [k, k, k, c, None, c]
            };
            let delta = Delta {
                base_radius: sizes.0,
                platform_radius: sizes.1,
                arm_length: sizes.2,
                rod_length: sizes.3,
                rod_spacing: sizes.4,
                elbow: Elbow::Out,
                rod_ends: if balls && soft.is_none() {
                    RodEnds::Spherical
                } else {
                    RodEnds::Revolute
                },
                arm: link(diameters.0, &paper.arm),
                bar: link(diameters.1, &paper.bar),
                rod: link(diameters.2, &paper.rod),
                joint_stiffness: soft.map_or([None; 6], elastic),
                ..paper
            };
            let pose = [pose.0, pose.1, pose.2];
            delta.model(&pose).ok().map(|_| (delta, pose))
        },
    )
}

fn wrenches() -> impl Strategy<Value = Vector6<f64>> {
    let each = || -100.0..100.0;
    (each(), each(), each(), each(), each(), each())
        .prop_map(|(a, b, c, d, e, f)| Vector6::new(a, b, c, d / 10.0, e / 10.0, f / 10.0))
}

fn rotations() -> impl Strategy<Value = Rotation3<f64>> {
    (-3.0..3.0, -3.0..3.0, -3.0..3.0)
        .prop_map(|(a, b, c)| Rotation3::from_scaled_axis(Vector3::new(a, b, c)))
}

fn loaded(delta: &Delta, pose: &[f64; 3], wrench: Vector6<f64>) -> Model {
    let mut model = delta.model(pose).expect("reachable");
    let output = model.output().expect("an output");
    model.add_load(output, wrench).expect("finite");
    model
}

fn solved(model: &Model) -> Solution {
    solve(model).expect("a solution")
}

/// The same joint with every possible other choice of IDCs: the `rank`-th best minor.
#[derive(Debug, Clone)]
struct Rechosen {
    joint: Box<dyn Joint>,
    skip: usize,
}

impl Joint for Rechosen {
    fn kind(&self) -> &str {
        self.joint.kind()
    }
    fn free(&self) -> DofSet {
        self.joint.free()
    }
    fn basis(&self) -> Matrix6<f64> {
        self.joint.basis()
    }
    fn mapping(&self, frame: &Rotation3<f64>, moving: DofSet) -> Result<Mapping, JointError> {
        let best = self.joint.mapping(frame, moving)?;
        let rotations = best.idcs().iter().filter(|d| d.index() > 2).count();
        let mut left = self.skip;
        for bits in 0..64u8 {
            let set: DofSet = Dof::ALL
                .into_iter()
                .filter(|d| bits & (1 << d.index()) != 0)
                .collect();
            let turning = set.iter().filter(|d| d.index() > 2).count();
            if set.len() != best.len() || turning != rotations {
                continue;
            }
            // u_i = S q + …: with other rows chosen, N = S S_f⁻¹ on them.
            let s = best.ground_matrix();
            let chosen = nalgebra::DMatrix::from_fn(set.len(), set.len(), |r, c| {
                s[(set.iter().nth(r).expect("within").index(), c)]
            });
            let Some(inverse) = chosen.clone().try_inverse() else {
                continue;
            };
            if inverse.amax() > 20.0 {
                continue;
            }
            if left > 0 {
                left -= 1;
                continue;
            }
            let n_i = nalgebra::DMatrix::from_fn(6, set.len(), |r, c| s[(r, c)]) * inverse;
            let columns: Vec<Vector6<f64>> = (0..set.len())
                .map(|c| Vector6::from_fn(|r, _| n_i[(r, c)]))
                .collect();
            let mut n_j = Matrix6::identity();
            for (column, dof) in columns.iter().zip(set.iter()) {
                let mut target = n_j.column_mut(dof.index());
                target -= column;
            }
            return Mapping::new(set, &columns, n_j);
        }
        Ok(best)
    }
    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(self.clone())
    }
}

/// Strain energy of beams, from their end forces, and of elastic joints, from their wrenches.
fn strain_energy(model: &Model, solution: &Solution) -> f64 {
    let mut energy = 0.0;
    for (segment, forces) in model.segments().iter().zip(&solution.segments) {
        let beam = Beam::new(&segment.material, &segment.section, forces.length).expect("a beam");
        let tip = forces.ends[1];
        energy += 0.5 * tip.dot(&(beam.cantilever_compliance() * tip));
    }
    for (joint, wrench) in model.joints().iter().zip(&solution.joint_wrenches) {
        let hyperstat_assembly::JointStiffness::Directions(values) = &joint.stiffness else {
            continue;
        };
        let wrench = wrench.expect("a determined wrench");
        for (k, w) in values.iter().zip(wrench.iter()) {
            energy += k.map_or(0.0, |k| 0.5 * w * w / k);
        }
    }
    energy
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn stiffness_is_symmetric_and_positive_definite((delta, pose) in deltas()) {
        let k = stiffness(&solved(&delta.model(&pose).expect("reachable")));
        prop_assert_eq!(k, k.transpose());
        let scale = k.diagonal().map(f64::sqrt);
        let unit = Matrix6::from_fn(|r, c| k[(r, c)] / (scale[r] * scale[c]));
        prop_assert!(SymmetricEigen::new(unit).eigenvalues.min() > 0.0);
    }

    #[test]
    fn turning_and_moving_the_mechanism_turns_the_stiffness(
        (delta, pose) in deltas(),
        rotation in rotations(),
        shift in (-2.0..2.0, -2.0..2.0, -2.0..2.0),
        wrench in wrenches(),
    ) {
        let model = loaded(&delta, &pose, wrench);
        let there = moved(&model, &rotation, &Vector3::new(shift.0, shift.1, shift.2));
        let (here, there) = (solved(&model), solved(&there));
        let expected = turned_matrix(&rotation, &stiffness(&here));
        // Points 2 m off round at 4e-16 m, against members of 0.05 m and 1e4 times stiffer
        // along than across: 1e-10.
        let difference = stiffness_difference(&stiffness(&there), &expected);
        prop_assert!(difference < 1e-10, "{:e}", difference);
        let u = turned(&rotation, &here.output.displacement);
        let error = (there.output.displacement - u).amax() / u.amax();
        prop_assert!(error < 1e-9, "{:e}", error);
    }

    #[test]
    fn elastic_joints_tend_to_rigid_ones((delta, pose) in deltas()) {
        let with = |k: Option<f64>| {
            let joint_stiffness = [k, k, k, k, None, k];
            let delta = Delta { joint_stiffness, rod_ends: RodEnds::Revolute, ..delta.clone() };
            stiffness(&solved(&delta.model(&pose).expect("reachable")))
        };
        let rigid = with(None);
        let difference = |exponent: i32| {
            stiffness_difference(&with(Some(10.0_f64.powi(exponent))), &rigid)
        };
        // At rate 1/k: k · difference settles to a constant …
        let (at_11, at_12) = (1e11 * difference(11), 1e12 * difference(12));
        prop_assert!((at_11 / at_12 - 1.0).abs() < 0.05, "{} {}", at_11, at_12);
        // … until rounding, and stays there.
        for exponent in [17, 18] {
            let (found, bound) = (difference(exponent), 1.1 * at_12 * 10.0_f64.powi(-exponent));
            prop_assert!(found < bound + 1e-11, "1e{}: {:e}", exponent, found);
        }
    }

    #[test]
    fn the_choice_of_idcs_does_not_matter(
        (delta, pose) in deltas(),
        skips in proptest::collection::vec(0usize..4, 21),
        rotation in rotations(),
    ) {
        let model = moved(&delta.model(&pose).expect("reachable"), &rotation, &Vector3::zeros());
        let other = rebuilt(&model, |k, joint| Connection {
            joint: Box::new(Rechosen { joint: joint.joint.clone(), skip: skips[k] }),
            ..joint.clone()
        });
        let (a, b) = (stiffness(&solved(&model)), stiffness(&solved(&other)));
        let difference = stiffness_difference(&b, &a);
        prop_assert!(difference < 1e-11, "{:e}", difference);
    }

    #[test]
    fn softening_a_part_never_stiffens_the_output(
        (delta, pose) in deltas(),
        part in 0usize..4,
        factor in 0.3..0.95,
    ) {
        let mut softer = delta.clone();
        let thinner = |link: &Link| {
            let SectionShape::Circle { diameter } = *link.section.shape() else {
                unreachable!("made of circles")
            };
            Link { section: circle(diameter * factor), ..link.clone() }
        };
        match part {
            0 => softer.arm = thinner(&delta.arm),
            1 => softer.bar = thinner(&delta.bar),
            2 => softer.rod = thinner(&delta.rod),
            _ => softer.drive_stiffness = Some(1e5),
        }
        let hard = stiffness(&solved(&delta.model(&pose).expect("reachable")));
        let soft = stiffness(&solved(&softer.model(&pose).expect("reachable")));
        let scale = hard.diagonal().map(f64::sqrt);
        let gain = hard - soft;
        let unit = Matrix6::from_fn(|r, c| gain[(r, c)] / (scale[r] * scale[c]));
        let least = SymmetricEigen::new(unit).eigenvalues.min();
        prop_assert!(least > -1e-12, "{:e}", least);
    }

    #[test]
    fn work_of_the_loads_is_strain_energy((delta, pose) in deltas(), wrench in wrenches()) {
        let mut model = loaded(&delta, &pose, wrench);
        // A load inside an absorbed joint and one on a free node as well.
        let node = model.node("wrist1", "C1").expect("a node");
        let force = Vector6::new(3.0, -20.0, 7.0, 0.0, 0.0, 0.0);
        model.add_load(node, force).expect("finite");
        let solution = solved(&model);
        let work: f64 = model
            .loads()
            .iter()
            .map(|l| 0.5 * l.wrench.dot(&solution.displacements[l.node.0]))
            .sum();
        // A load inside an elastic joint leaves it through the joint: its wrench is the joint's.
        let energy = strain_energy(&model, &solution);
        prop_assert!((work - energy).abs() < 1e-10 * energy, "{} {}", work, energy);
    }

    #[test]
    fn reactions_balance_the_loads((delta, pose) in deltas(), wrench in wrenches()) {
        let mut model = loaded(&delta, &pose, wrench);
        for (body, point) in [("arm2", "B2"), ("rodb3", "Cb3"), ("elbow1", "B1")] {
            let node = model.node(body, point).expect("a node");
            let force = Vector6::new(30.0, -20.0, 10.0, 0.0, 0.0, 0.0);
            model.add_load(node, force).expect("finite");
        }
        let solution = solved(&model);
        let geometry = model.geometry();
        let about_origin = |w: &Vector6<f64>, node: usize| {
            let force = Vector3::new(w[0], w[1], w[2]);
            let moment = Vector3::new(w[3], w[4], w[5])
                + geometry.positions[node].coords.cross(&force);
            Vector6::new(force[0], force[1], force[2], moment[0], moment[1], moment[2])
        };
        let mut sum = Vector6::zeros();
        let mut scale = 0.0_f64;
        for load in model.loads() {
            let w = about_origin(&load.wrench, load.node.0);
            scale = scale.max(w.amax());
            sum += w;
        }
        for (k, joint) in model.joints().iter().enumerate() {
            if let [None, Some(node)] = joint.between {
                let local = solution.joint_wrenches[k].expect("determined");
                sum += about_origin(&turned(&geometry.frames[k], &local), node.0);
            }
        }
        prop_assert!(sum.amax() < 1e-11 * scale, "{}", sum);
    }
}
