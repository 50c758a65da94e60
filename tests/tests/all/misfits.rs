//! Misfits and preloads of joints over the reference mechanisms and random ones, against the
//! independent solver; reciprocity; a statically determinate mechanism against its rigid
//! kinematics.

use std::path::Path;

use hyperstat_assembly::{
    JointId, LANES, LoadSet, Model, NodeId, PoseResult, Prepared, Solution, SolveError, solve,
};
use hyperstat_joints::Dof;
use hyperstat_mechanisms::{Disk, Registry, load_mechanism, mechanism_from_str};
use hyperstat_reference::ReferenceError;
use hyperstat_tests::agreement::agrees_with_reference;
use hyperstat_tests::prebuilt::{legs, links};
use hyperstat_tests::random::check_random_mechanisms;
use hyperstat_tests::{reference_folder, vector_differences};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use proptest::prelude::*;

/// Both solvers refine to rounding; what is left is the conditioning of the mechanisms, 1e3 at most
/// beside that.
const AGREEMENT: f64 = 1e-11;
/// Displacements (m, rad) and wrenches (N, N·m) that are smaller are measured by these: misfits are
/// some 1e-4 m, and a part that held one back would push with 1e3 N or more.
const FLOORS: [f64; 2] = [1e-5, 1.0];

/// A reference mechanism without its loads.
fn unloaded(name: &str) -> Model {
    let path = reference_folder().join(format!("{name}.ron"));
    let mechanism = load_mechanism(&path, &Disk, &Registry::builtin()).expect("a valid file");
    let mut model = mechanism.model;
    model.clear_loads();
    model
}

/// Random numbers, the same in every run (xorshift64).
struct Random(u64);

impl Random {
    /// Between −1 and 1.
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self, size: f64) -> Vector6<f64> {
        Vector6::from_fn(|_, _| size * self.unit())
    }
}

/// Gives a joint those of `values` that it can have.
fn set_misfit(model: &mut Model, joint: JointId, values: &Vector6<f64>) {
    let mut taken = Vector6::zeros();
    for k in 0..6 {
        let mut more = taken;
        more[k] = values[k];
        if model.set_misfit(joint, &more).is_ok() {
            taken = more;
        }
    }
}

/// Gives a joint preloads along its elastic directions.
fn set_preload(model: &mut Model, joint: JointId, values: &Vector6<f64>) {
    let mut taken = Vector6::zeros();
    for k in 0..6 {
        let unit = Vector6::ith(k, 1e-300);
        let is_held = model.clone().set_misfit(joint, &unit).is_ok();
        let mut more = taken;
        more[k] = values[k];
        if is_held && model.set_preload(joint, &more).is_ok() {
            taken = more;
        }
    }
}

/// Misfits of all joints that any loop can take: the differences of random small displacements of
/// the bodies, rigid ones moving as one.
fn fitting(model: &Model, random: &mut Random) -> Vec<Vector6<f64>> {
    let geometry = model.geometry();
    let twists: Vec<_> = model.bodies().iter().map(|_| random.vector(1e-4)).collect();
    let displacement = |node: Option<NodeId>| {
        let Some(node) = node else {
            return Vector6::zeros();
        };
        let body = model.nodes()[node.0].body;
        let first = model.bodies()[body.0].nodes[0];
        let mut twist = twists[body.0];
        let turn: Vector3<f64> = twist.fixed_rows::<3>(3).into();
        let arm = geometry.positions[node.0] - geometry.positions[first.0];
        let mut linear = twist.fixed_rows_mut::<3>(0);
        linear += turn.cross(&arm);
        twist
    };
    let joints = model.joints().iter().zip(&geometry.frames);
    joints
        .map(|(joint, frame)| {
            let apart = displacement(joint.between[1]) - displacement(joint.between[0]);
            let mut local = Vector6::zeros();
            for part in [0, 3] {
                let turned = frame.inverse() * apart.fixed_rows::<3>(part).into_owned();
                local.fixed_rows_mut::<3>(part).copy_from(&turned);
            }
            joint.joint.basis().try_inverse().expect("a basis") * local
        })
        .collect()
}

/// Compares with the independent solver; joints of idle bodies and their displacements apart.
fn compare(name: &str, model: &Model) -> Solution {
    let found = solve(model).unwrap_or_else(|error| panic!("{name}: {error}"));
    let expected = hyperstat_reference::solve(model).unwrap_or_else(|e| panic!("{name}: {e}"));
    let idle: Vec<_> = found.idle.iter().flat_map(|m| &m.twists).collect();
    let moves = |node: &usize| idle.iter().any(|(b, _)| *b == model.nodes()[*node].body);
    let nodes: Vec<usize> = (0..model.nodes().len()).filter(|n| !moves(n)).collect();
    let pairs = nodes
        .iter()
        .map(|&n| (&found.displacements[n], &expected.displacements[n]));
    let [linear, angular] = vector_differences(pairs, [FLOORS[0]; 2]);
    let wrenches = found.joint_wrenches.iter().zip(&expected.joint_wrenches);
    let known = wrenches.map(|(a, b)| {
        assert_eq!(a.is_some(), b.is_some(), "{name}");
        a.as_ref().zip(b.as_ref())
    });
    let known: Vec<_> = known.flatten().collect();
    let [forces, moments] = vector_differences(known, [FLOORS[1]; 2]);
    let worst = linear.max(angular).max(forces).max(moments);
    assert!(
        worst < AGREEMENT,
        "{name}: displacements {linear:e} {angular:e}, wrenches {forces:e} {moments:e}"
    );
    assert!(found.warnings.is_empty(), "{name}: {:?}", found.warnings);
    let output = expected.displacement.unwrap_or(found.output.displacement);
    let [linear, angular] =
        vector_differences([(&found.output.displacement, &output)], [FLOORS[0]; 2]);
    assert!(linear.max(angular) < AGREEMENT, "{name}: output");
    found
}

const MECHANISMS: [&str; 14] = [
    "delta_ball_jointed_rods",
    "delta_elastic_joints",
    "delta_refined",
    "delta_rigid_joints",
    "every_joint",
    "flexible_parallelogram",
    "hexapod_elastic_drives",
    "hexapod_locked",
    "rigid_bodies_on_bushings",
    "rigid_parallelogram",
    "single_freedom_elastic",
    "single_freedom_rigid",
    "three_rps",
    "tricept",
];

#[test]
fn misfits_that_fit_agree_with_the_independent_solver() {
    for (k, name) in MECHANISMS.into_iter().enumerate() {
        let mut random = Random(0x9e37_79b9_7f4a_7c15 + k as u64);
        let mut model = unloaded(name);
        for (k, misfit) in fitting(&model, &mut random).iter().enumerate() {
            set_misfit(&mut model, JointId(k), misfit);
        }
        compare(name, &model);
        for k in 0..model.joints().len() {
            set_preload(&mut model, JointId(k), &random.vector(10.0));
        }
        compare(name, &model);
    }
}

/// Both solvers take the same misfits of any size and direction, and refuse the same.
#[test]
fn any_misfits_agree_or_are_refused_by_both() {
    let mut refused = Vec::new();
    for (k, name) in MECHANISMS.into_iter().enumerate() {
        let mut random = Random(0xd1b5_4a32_d192_ed03 + k as u64);
        let mut model = unloaded(name);
        for k in 0..model.joints().len() {
            set_misfit(&mut model, JointId(k), &random.vector(1e-4));
            set_preload(&mut model, JointId(k), &random.vector(10.0));
        }
        match (solve(&model), hyperstat_reference::solve(&model)) {
            (Err(SolveError::Misfit { .. }), Err(ReferenceError::Misfit { .. })) => {
                refused.push(name);
            }
            (Ok(_), Ok(_)) => {
                compare(name, &model);
            }
            (found, expected) => panic!(
                "{name}: {:?} and {:?}",
                found.map(|_| ()),
                expected.map(|_| ())
            ),
        }
    }
    assert!(refused.contains(&"rigid_parallelogram"), "{refused:?}");
    assert!(refused.len() < MECHANISMS.len() / 2, "{refused:?}");
}

#[test]
fn misfits_of_random_mechanisms_agree_with_the_independent_solver() {
    check_random_mechanisms(any::<u64>(), |model, seed| {
        let mut random = Random(seed | 1);
        let mut model = model.clone();
        let fitting = fitting(&model, &mut random);
        for (k, misfit) in fitting.iter().enumerate() {
            set_misfit(&mut model, JointId(k), misfit);
            set_preload(&mut model, JointId(k), &random.vector(5.0));
        }
        agrees_with_reference(&model)
    });
}

/// Misfits of single joints of every prebuilt mechanism, without loads: where nothing holds them back
/// all forces are zero, and agree.
#[test]
fn misfits_of_prebuilt_mechanisms_agree_with_the_independent_solver() {
    let mut agreed = 0;
    for (k, case) in legs::cases().iter().chain(&links::cases()).enumerate() {
        let mut random = Random(0x2545_f491_4f6c_dd1d + k as u64);
        let plain = case.mechanism.model(&case.poses[1]).expect("in reach");
        let name = case.what(&case.poses[1]);
        for joint in (0..plain.joints().len()).step_by(3) {
            let mut model = plain.clone();
            model.clear_loads();
            set_misfit(&mut model, JointId(joint), &random.vector(1e-4));
            let result = agrees_with_reference(&model);
            agreed += u32::from(result.unwrap_or_else(|error| panic!("{name}: {error}")));
        }
    }
    assert!(agreed > 50, "{agreed}");
}

/// Maxwell–Betti: what a unit misfit does to the output along e is the force along it that e on the
/// output causes, reversed. Over all joints and directions of the delta, and by `misfit_effects`.
#[test]
fn a_misfit_does_what_the_joints_force_under_a_unit_load_says() {
    let misfit = 1e-4;
    for name in ["delta_rigid_joints", "delta_elastic_joints"] {
        let model = unloaded(name);
        let output = model.output().expect("an output");
        let units = [0, 1, 2, 3, 4, 5].map(|k| LoadSet::on(output, Vector6::ith(k, 1.0)));
        let prepared = Prepared::new(model.clone());
        let responses = prepared.here().respond(&units).expect("responses");
        let influence = prepared.here().influence().expect("unit states");
        let effects: Vec<_> = (0..6)
            .map(|k| influence.misfit_effects(&Vector6::ith(k, 1.0)))
            .collect();
        let mut seen = 0;
        for k in 0..model.joints().len() {
            for dof in Dof::ALL {
                let mut own = model.clone();
                let unit = Vector6::ith(dof.index(), misfit);
                if own.set_misfit(JointId(k), &unit).is_err() {
                    continue;
                }
                let moved = solve(&own).expect("a solution").output.displacement / misfit;
                for along in 0..6 {
                    let wrench = responses[along].joint_wrenches[k].expect("determined");
                    // Rounding of the largest effect: a delta's angles reach 1/(0.06 m).
                    let difference = (moved[along] + wrench[dof.index()]).abs();
                    assert!(
                        difference < 1e-10 * moved.amax().max(1.0),
                        "{name}, joint {k}, {dof}, along {along}: {moved} {wrench}"
                    );
                    let effect = effects[along]
                        .iter()
                        .find(|e| e.joint == JointId(k) && e.direction == dof);
                    let effect = effect.and_then(|e| e.per_unit).expect("an effect");
                    assert!((effect + wrench[dof.index()]).abs() < 1e-10 * wrench.amax().max(1.0));
                    seen += 1;
                }
            }
        }
        let held = effects[0].len();
        assert_eq!(seen, 6 * held, "{name}");
        assert!(held > 5 * model.joints().len(), "{name}");
    }
}

/// The lengths of a hexapod's six legs determine the platform: with legs too long by δ along n it
/// moves by the twist of `n · (v + ω × r) = δ`, and nothing bears force.
#[test]
fn a_hexapod_with_wrong_legs_moves_by_its_jacobian_without_force() {
    let mut model = unloaded("hexapod_locked");
    let output = model.output().expect("an output");
    let centre = model.geometry().positions[output.0];
    let mut jacobian = Matrix6::zeros();
    let mut errors = Vector6::zeros();
    for leg in 1..=6 {
        let named = |joint: &hyperstat_assembly::Connection| joint.name == format!("P{leg}");
        let drive = model.joints().iter().position(named).expect("a drive");
        let error = 1e-4 * (f64::from(leg) - 2.3);
        // y of the drive points along the leg, from its first body, below, to its second.
        let misfit = Vector6::ith(1, error);
        model.set_misfit(JointId(drive), &misfit).expect("a misfit");
        let axis = model.geometry().frames[drive]
            .matrix()
            .column(1)
            .into_owned();
        let end = model
            .node(&format!("pis{leg}"), &format!("a{leg}"))
            .expect("a node");
        let arm = model.geometry().positions[end.0] - centre;
        let row = leg as usize - 1;
        jacobian
            .fixed_view_mut::<1, 3>(row, 0)
            .copy_from(&axis.transpose());
        let turn = arm.cross(&axis).transpose();
        jacobian.fixed_view_mut::<1, 3>(row, 3).copy_from(&turn);
        errors[row] = error;
    }
    let expected = jacobian.try_inverse().expect("regular") * errors;
    let found = compare("hexapod_locked", &model);
    let [linear, angular] =
        vector_differences([(&found.output.displacement, &expected)], [FLOORS[0]; 2]);
    assert!(linear.max(angular) < 1e-10, "{linear:e} {angular:e}");
    // A leg's force would be some 1e8 N/m times 1e-4 m; of that, rounding.
    for wrench in found.joint_wrenches.iter().flatten() {
        assert!(wrench.amax() < 1e-13 * 1e8, "{wrench}");
    }
}

/// With both rods of a limb too long by δ the parallelogram stays one, so that nothing bears force;
/// the platform, which cannot turn, follows the rods: `n₁ · v = δ`, `n₂ · v = n₃ · v = 0`.
#[test]
fn a_delta_with_two_equally_long_rods_moves_by_its_kinematics_without_force() {
    for name in ["delta_rigid_joints", "delta_elastic_joints"] {
        let mut model = unloaded(name);
        let excess = 1e-4;
        let mut rods = Matrix3::zeros();
        for limb in 1..=3 {
            let node = |body: &str, point: &str| {
                let node = model.node(&format!("{body}{limb}"), &format!("{point}{limb}"));
                model.geometry().positions[node.expect("a node").0]
            };
            let along = (node("roda", "Ca") - node("roda", "Ba")).normalize();
            rods.set_row(limb - 1, &along.transpose());
        }
        for rod in ["Ba1", "Bb1"] {
            let at = model.joints().iter().position(|joint| joint.name == rod);
            let joint = JointId(at.expect("a joint"));
            // x runs along the rods, the rod is the second body.
            let misfit = Vector6::ith(0, excess);
            model.set_misfit(joint, &misfit).expect("a misfit");
        }
        let expected = rods.try_inverse().expect("regular") * Vector3::new(excess, 0.0, 0.0);
        let solution = compare(name, &model);
        let found = solution.output.displacement;
        // Rounding of coordinates of 0.6 m, beside 1e-4 m.
        let difference = (found.fixed_rows::<3>(0) - expected).amax();
        assert!(difference < 1e-11 * expected.amax(), "{found} {expected}");
        assert!(found.fixed_rows::<3>(3).amax() < 1e-11 * expected.amax());
        for wrench in solution.joint_wrenches.iter().flatten() {
            // Held back, the rods would push with some 5e3 N.
            assert!(wrench.amax() < 1e-9 * 5e3, "{wrench}");
        }
    }
}

/// A mechanism that nothing holds, its loop pressed by misfits and a preload.
const FLOATING: &str = r#"(
    name: "floating",
    materials: { "steel": (young: 2.0e11, poisson: 0.3) },
    sections: { "flat": Rectangle(width: 0.03, height: 0.05, shear_y: 0.0008) },
    points: { "p4": (0.0, 0.0, -0.28625), "p1": (0.0, 0.0, 0.0), "p2": (0.0, 0.0, 0.33616), "p0": (0.0, 0.0, 0.0) },
    bodies: {
        "frame": Rigid(points: ["p4", "p1", "p0"]),
        "bar": Beam(through: ["p4", "p1", "p2", "p0"], section: "flat", material: "steel"),
    },
    joints: {
        "rigid": (at: "p0", between: ("frame", "bar"), kind: Fixed, misfit: (x: 1.1e-4, y: 3.7e-5, z: 1.4e-5, u: -8.3e-5, v: -2.9e-5, w: 6.1e-5)),
        "soft": (at: "p4", between: ("frame", "bar"), kind: Fixed, stiffness: (x: 1e8, y: 1e8, z: 1e8, u: 1e5, v: 1e5, w: 1e5),
            misfit: (x: 1e-4, y: 6.1e-5, z: 1.4e-5, u: -8.4e-5, v: -2.9e-5, w: 6.1e-5),
            preload: (x: 1.2, y: -0.3, z: -4.5, u: -3.2, v: 1.25, w: -3.3)),
    },
    output: ("frame", "p4"),
)
"#;

/// All six motions of the output are free and its stiffness is rounding: no displacement is found by
/// it, and the forces inside keep their digits.
#[test]
fn a_floating_mechanism_keeps_the_digits_of_its_own_forces() {
    let file = Path::new("floating.ron");
    let mechanism =
        mechanism_from_str(FLOATING, file, &Disk, &Registry::builtin()).expect("a file");
    let found = solve(&mechanism.model).expect("a solution");
    assert!(found.warnings.is_empty(), "{:?}", found.warnings);
    assert_eq!(found.output.free_motions.len(), 6);
    let expected = hyperstat_reference::solve(&mechanism.model).expect("a solution");
    let pairs = found.joint_wrenches.iter().flatten();
    let pairs = pairs.zip(expected.joint_wrenches.iter().flatten());
    let [forces, moments] = vector_differences(pairs, [FLOORS[1]; 2]);
    assert!(forces.max(moments) < AGREEMENT, "{forces:e} {moments:e}");
}

/// Poses with misfits are the same side by side as one by one: they go through the lanes.
#[test]
fn lanes_agree_with_the_numeric_pass_on_misfits() {
    let mut model = unloaded("delta_elastic_joints");
    let misfit = Vector6::ith(0, 1e-4);
    model.set_misfit(JointId(2), &misfit).expect("a misfit");
    let prepared = Prepared::new(model.clone());
    let mut lanes = prepared.lanes().expect("a plan");
    let together = prepared.sweep_lanes(&mut lanes, [true; LANES]);
    let alone = prepared.sweep(model.geometry(), &mut prepared.workspace().expect("a plan"));
    assert_eq!(lanes.one_by_one(), 0);
    let displacement = |result: &PoseResult| result.displacement.expect("a displacement");
    let expected = displacement(alone.as_ref().expect("a result"));
    for result in together {
        let found = displacement(&result.expect("a filled lane").expect("a result"));
        for part in [0, 3] {
            let [found, expected] = [found, expected].map(|u| u.fixed_rows::<3>(part).into_owned());
            assert!((found - expected).amax() <= 1e-11 * expected.amax());
        }
    }
}
