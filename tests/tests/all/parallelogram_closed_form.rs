//! Parallelogram of two elastic rods and four revolute joints with a rigid coupler: closed form.
//!
//! Two equal rods of length L along x, spaced w in y, joint axes along z, at the coupler's centre
//! (x = L, between the rods). A rod is pinned in the plane, so there it only stretches, and
//! clamped out of it, where it bends (I about the in-plane axis y) and twists (GJ). Each rod's end
//! thus has the stiffness EA/L along x and
//!
//! ```text
//!  z: 12EI/L³   z,φy: 6EI/L²   φy: 4EI/L   φx: GJ/L      nothing along y and about z
//! ```
//!
//! and the coupler, with the ends at y = ±w/2 (`δx = ∓φz w/2`, `δz = ±φx w/2`):
//!
//! ```text
//!  Kxx = 2EA/L    Kzz = 24EI/L³    Kz,ry = 12EI/L²    Kry = 8EI/L
//!  Krx = 2GJ/L + 6EIw²/L³          Krz = EAw²/(2L)    all others 0: x,rz  z,rx  rx,ry cancel
//! ```
//!
//! Kyy = 0: the coupler moves freely along y. One motion, and over-constrained by three:
//! 4 bodies with the ground, 4 hinges, 6·3 − 4·5 = −2 = 1 − 3.
//!
//! The rods' bending in the plane (I about z) must not matter and is chosen at random.

use std::path::Path;

use hyperstat_assembly::{Model, Solution, solve};
use hyperstat_joints::{Revolute, frame_from_axis};
use hyperstat_mechanisms::{Disk, Registry, mechanism_from_str};
use hyperstat_tests::build::{connection, general, material, node};
use hyperstat_tests::{moved, stiffness, turned, turned_matrix};
use nalgebra::{Matrix6, Point3, Rotation3, Vector3, Vector6};
use proptest::prelude::*;

/// Sizes and stiffnesses; SI units.
#[derive(Debug, Clone, Copy)]
struct Parallelogram {
    length: f64,
    spacing: f64,
    young: f64,
    shear: f64,
    area: f64,
    /// Second moment about the in-plane axis y: bending out of the plane.
    out_of_plane: f64,
    /// Second moment about z: bending in the plane, which the hinges never ask for.
    in_plane: f64,
    torsion: f64,
}

impl Parallelogram {
    /// Coupler's centre at the origin.
    fn model(&self) -> Model {
        let mut model = Model::new("parallelogram");
        let steel = material(self.young, self.shear);
        let section = general(
            self.area,
            self.out_of_plane,
            self.in_plane,
            self.torsion,
            None,
        );
        let half = self.spacing / 2.0;
        let points = [
            ("P", Point3::origin()),
            ("C1", Point3::new(0.0, -half, 0.0)),
            ("C2", Point3::new(0.0, half, 0.0)),
        ];
        model.add_rigid("coupler", &points).expect("a coupler");
        let hinge_axes = frame_from_axis(Some(&Vector3::z()), None).expect("an axis");
        for (rod, at, y) in [("rod1", "C1", -half), ("rod2", "C2", half)] {
            let ends = [
                ("base", Point3::new(-self.length, y, 0.0)),
                (at, Point3::new(0.0, y, 0.0)),
            ];
            model
                .add_beam(rod, &ends, &steel, &section, Some(Vector3::y()), 1)
                .expect("a rod");
            let base = [None, Some(node(&model, rod, "base"))];
            let wrist = [
                Some(node(&model, rod, at)),
                Some(node(&model, "coupler", at)),
            ];
            for (end, between) in [("base", base), ("wrist", wrist)] {
                let hinge = connection(&format!("{end} of {rod}"), between, Revolute);
                model.add_joint(hinge, hinge_axes).expect("a joint");
            }
        }
        model.set_output(node(&model, "coupler", "P"));
        model
    }

    fn closed_form(&self) -> Matrix6<f64> {
        let (l, w) = (self.length, self.spacing);
        let (ea, ei) = (self.young * self.area, self.young * self.out_of_plane);
        let gj = self.shear * self.torsion;
        let mut k = Matrix6::zeros();
        k[(0, 0)] = 2.0 * ea / l;
        k[(2, 2)] = 24.0 * ei / l.powi(3);
        k[(2, 4)] = 12.0 * ei / l.powi(2);
        k[(4, 2)] = k[(2, 4)];
        k[(4, 4)] = 8.0 * ei / l;
        k[(3, 3)] = 2.0 * gj / l + 6.0 * ei * w.powi(2) / l.powi(3);
        k[(5, 5)] = ea * w.powi(2) / (2.0 * l);
        k
    }

    /// Largest difference from the closed form where the mechanism is turned by `rotation`: of the
    /// named entries relative to themselves, of all relative to the largest of their kind.
    fn differences(&self, found: &Matrix6<f64>, rotation: &Rotation3<f64>) -> [f64; 2] {
        let expected = self.closed_form();
        let found = turned_matrix(&rotation.inverse(), found);
        let level = expected.diagonal();
        let scale = [
            level.fixed_rows::<3>(0).max(),
            level.fixed_rows::<3>(3).max(),
        ];
        let (mut named, mut all) = (0.0_f64, 0.0_f64);
        for r in 0..6 {
            for c in 0..6 {
                let off = (found[(r, c)] - expected[(r, c)]).abs();
                all = all.max(off / (scale[r / 3] * scale[c / 3]).sqrt());
                if expected[(r, c)] != 0.0 {
                    named = named.max(off / expected[(r, c)]);
                }
            }
        }
        [named, all]
    }
}

/// The free motion along y is a result, and is named; nothing else is free, held or idle.
fn check_freedom(solution: &Solution, rotation: &Rotation3<f64>) -> Result<(), TestCaseError> {
    prop_assert_eq!(solution.mobility, 1);
    prop_assert_eq!(solution.overconstraint, 3);
    prop_assert!(solution.idle.is_empty());
    prop_assert!(solution.output.compliance.is_none());
    prop_assert!(solution.output.rigid_directions.is_empty());
    prop_assert_eq!(solution.output.free_motions.len(), 1);
    let motion = solution.output.free_motions[0];
    let along_y = turned(rotation, &Vector6::y());
    let off = (motion.normalize() - along_y * motion.dot(&along_y).signum()).norm();
    prop_assert!(off < 1e-12, "{motion}");
    Ok(())
}

fn parallelograms() -> impl Strategy<Value = Parallelogram> {
    let exponent = |low: f64, high: f64| (low..high).prop_map(|e: f64| 10.0_f64.powf(e));
    (
        (exponent(-2.0, 1.0), exponent(-1.0, 0.5)),
        (exponent(9.0, 12.0), 0.3..0.6),
        (exponent(-1.8, -1.0), 0.1..1.0, 0.1..1.0, 0.1..2.0),
    )
        .prop_map(
            |((length, slenderness), (young, shear), (radius, iy, iz, torsion))| {
                let side = length * radius;
                Parallelogram {
                    length,
                    spacing: length * slenderness,
                    young,
                    shear: young * shear,
                    area: side.powi(2),
                    out_of_plane: iy * side.powi(4),
                    in_plane: iz * side.powi(4),
                    torsion: torsion * side.powi(4),
                }
            },
        )
}

fn rotations() -> impl Strategy<Value = Rotation3<f64>> {
    let quarter = || (0..4).prop_map(|k| f64::from(k) * std::f64::consts::FRAC_PI_2);
    prop_oneof![
        [quarter(), quarter(), quarter()]
            .prop_map(|[a, b, c]| Rotation3::from_euler_angles(a, b, c)),
        [-3.0..3.0, -3.0..3.0, -3.0..3.0].prop_map(|v| Rotation3::from_scaled_axis(v.into())),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    /// Axes as derived above: every entry to rounding.
    #[test]
    fn in_its_own_axes(parallelogram in parallelograms()) {
        let solution = solve(&parallelogram.model()).expect("a free output is a result");
        check_freedom(&solution, &Rotation3::identity())?;
        let k = stiffness(&solution);
        let [named, all] = parallelogram.differences(&k, &Rotation3::identity());
        prop_assert!(named < 1e-12 && all < 1e-12, "{named:e} {all:e}\n{k}");
    }

    /// Turned and moved: the largest entries' rounding stands in the small ones.
    #[test]
    fn in_any_orientation(
        parallelogram in parallelograms(),
        rotation in rotations(),
        shift in [-1.0..1.0, -1.0..1.0, -1.0..1.0],
    ) {
        let model = moved(&parallelogram.model(), &rotation, &shift.into());
        let solution = solve(&model).expect("a free output is a result");
        check_freedom(&solution, &rotation)?;
        let [named, all] = parallelogram.differences(&stiffness(&solution), &rotation);
        prop_assert!(named < 1e-8 && all < 1e-12, "{named:e} {all:e}");
    }

    /// A load that does not work on the free motion is carried; one that does is an error.
    #[test]
    fn loads(
        parallelogram in parallelograms(),
        rotation in rotations(),
        wrench in proptest::array::uniform6(-10.0..10.0),
    ) {
        let mut model = moved(&parallelogram.model(), &rotation, &Vector3::zeros());
        let output = model.output().expect("an output");
        let mut held = Vector6::from(wrench);
        held.y = 0.0;
        model.add_load(output, turned(&rotation, &held)).expect("a load");
        let solution = solve(&model).expect("the load is carried");
        let found = turned(&rotation.inverse(), &solution.output.displacement);
        let force = parallelogram.closed_form() * found;
        for k in [0, 2, 3, 4, 5] {
            let scale = if k < 3 { 10.0 } else { 10.0 * parallelogram.length.max(1.0) };
            prop_assert!((force[k] - held[k]).abs() < 1e-7 * scale, "{k}: {force} {held}");
        }
        let along = turned(&rotation, &Vector6::y());
        model.add_load(output, along).expect("a load");
        let error = solve(&model).expect_err("nothing carries the load").to_string();
        prop_assert!(error.contains("coupler.P"), "{error}");
    }
}

/// The real loader's reading of the same mechanism, at one size.
#[test]
fn from_a_file() {
    let text = r#"(
    name: "parallelogram",
    materials: { "steel": (young: 2.0e11, shear: 8.0e10) },
    sections: { "rod": General(area: 4e-4, iy: 1e-8, iz: 2e-8, torsion: 2.5e-8) },
    points: {
        "A1": (-0.5, -0.1, 0.0), "B1": (0.0, -0.1, 0.0),
        "A2": (-0.5, 0.1, 0.0), "B2": (0.0, 0.1, 0.0),
        "P": (0.0, 0.0, 0.0),
    },
    bodies: {
        "rod1": Beam(through: ["A1", "B1"], section: "rod", material: "steel", y_axis: (0.0, 1.0, 0.0)),
        "rod2": Beam(through: ["A2", "B2"], section: "rod", material: "steel", y_axis: (0.0, 1.0, 0.0)),
        "coupler": Rigid(points: ["B1", "B2", "P"]),
    },
    joints: {
        "a1": (at: "A1", between: ("ground", "rod1"), kind: Revolute(axis: (0.0, 0.0, 1.0))),
        "a2": (at: "A2", between: ("rod2", "ground"), kind: Revolute(axis: (0.0, 0.0, 2.0))),
        "b1": (at: "B1", between: ("rod1", "coupler"), kind: Revolute(axis: (0.0, 0.0, -1.0))),
        "b2": (at: "B2", between: ("coupler", "rod2"), kind: Revolute(axis: (0.0, 0.0, 1.0))),
    },
    output: ("coupler", "P"),
)"#;
    let path = Path::new("parallelogram.ron");
    let mechanism =
        mechanism_from_str(text, path, &Disk, &Registry::builtin()).expect("a mechanism");
    let solution = solve(&mechanism.model).expect("a free output is a result");
    check_freedom(&solution, &Rotation3::identity()).expect("free along y");
    let same = Parallelogram {
        length: 0.5,
        spacing: 0.2,
        young: 2.0e11,
        shear: 8.0e10,
        area: 4e-4,
        out_of_plane: 1e-8,
        in_plane: 2e-8,
        torsion: 2.5e-8,
    };
    let k = stiffness(&solution);
    let [named, all] = same.differences(&k, &Rotation3::identity());
    assert!(named < 1e-12 && all < 1e-12, "{named:e} {all:e}\n{k}");
}
