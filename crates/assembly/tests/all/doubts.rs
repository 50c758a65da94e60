//! What is accepted, but can hardly be meant, is told once, and what is right is not.

use hyperstat_assembly::{Doubt, LoadCase, LoadSet, Model};
use hyperstat_elements::{Elasticity, Material, RigidMass, Section, SectionShape};
use nalgebra::{Point3, Vector3, Vector6};

fn general(iy: f64, iz: f64, torsion: f64, shear: Option<f64>) -> Section {
    let shape = SectionShape::General {
        area: 1e-4,
        iy,
        iz,
        torsion,
        y_max: None,
        z_max: None,
        torsion_modulus: None,
    };
    Section::new(shape, shear, None).expect("a section")
}

/// Two beams of a section, and a rigid body.
fn model(section: &Section) -> Model {
    let steel = Material::new(2.1e11, Elasticity::Poisson(0.3), Some(7850.0)).expect("steel");
    let mut model = Model::new("doubtful");
    let points = [
        ("A", Point3::origin()),
        ("B", Point3::new(1.0, 0.0, 0.0)),
        ("C", Point3::new(1.0, 1.0, 0.0)),
    ];
    for name in ["first", "second"] {
        model
            .add_beam(name, &points, &steel, section, None, 1)
            .expect("a beam");
    }
    model.add_rigid("plate", &points).expect("a body");
    model
}

#[test]
fn sections_that_cannot_be_are_told_once_with_their_bodies() {
    let bodies = || vec!["first".to_string(), "second".into()];
    let torsion = model(&general(1e-9, 2e-9, 4e-9, None)).doubts();
    let [
        Doubt::Torsion {
            bodies: found,
            torsion,
            polar,
        },
    ] = &torsion[..]
    else {
        panic!("{torsion:?}");
    };
    assert_eq!((found, *torsion), (&bodies(), 4e-9));
    assert!((polar - 3e-9).abs() < 1e-20);
    let shear = model(&general(1e-9, 2e-9, 3e-9, Some(1.2e-4))).doubts();
    let expected = Doubt::ShearArea {
        bodies: bodies(),
        field: "shear_y",
        shear: 1.2e-4,
        area: 1e-4,
    };
    assert_eq!(shear, [expected]);
    let words = shear[0].to_string();
    assert!(
        words.contains("`shear_y` of bodies `first`, `second`"),
        "{words}"
    );
    // A circle's torsion constant is the sum, here typed to three digits.
    let circle = general(1.886e-9, 1.886e-9, 3.78e-9, Some(1e-4));
    assert_eq!(model(&circle).doubts(), []);
    let shapes = [
        SectionShape::Circle { diameter: 0.01 },
        SectionShape::Rectangle {
            width: 0.02,
            height: 0.02,
        },
        SectionShape::Tube {
            outer: 0.02,
            inner: 0.019,
        },
    ];
    for shape in shapes {
        let section = Section::new(shape, None, None).expect("a section");
        assert_eq!(model(&section).doubts(), []);
    }
}

#[test]
fn inertia_that_no_body_has_is_told() {
    let section = general(1e-9, 2e-9, 1e-9, None);
    let with = |moments: [f64; 3]| {
        let mut model = model(&section);
        let mass = RigidMass::with_moments(1.0, moments).expect("an inertia");
        model.add_mass(model.node("plate", "A").expect("a node"), mass);
        model.doubts()
    };
    let found = with([1.0, 5.0, 1.0]);
    let [Doubt::Inertia { node, moments }] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!((node.as_str(), moments[2]), ("plate.A", 5.0));
    // A thin plate reaches the bound; a point, a rod and a sphere lie within it; a plane model gives
    // one moment alone.
    for right in [
        [1.0, 1.0, 2.0],
        [0.0; 3],
        [0.0, 1.0, 1.0],
        [2.0; 3],
        [0.0, 0.0, 3.0],
    ] {
        assert_eq!(with(right), [], "{right:?}");
    }
    // The same turned by 45° about z: principal moments 1, 1 and 5 again.
    let mut turned = model(&section);
    let mass = RigidMass::with_inertia(1.0, [3.0, 3.0, 1.0, 2.0, 0.0, 0.0]).expect("an inertia");
    turned.add_mass(turned.node("plate", "A").expect("a node"), mass);
    assert!(matches!(turned.doubts()[..], [Doubt::Inertia { .. }]));
}

#[test]
fn gravity_on_what_has_no_mass_is_told() {
    let mut model = model(&general(1e-9, 2e-9, 1e-9, None));
    assert_eq!(model.doubts(), []);
    model
        .set_gravity(Vector3::new(0.0, 0.0, -9.81))
        .expect("gravity");
    let bodies = vec!["plate".to_string()];
    let weightless = Doubt::Weightless { bodies };
    assert_eq!(model.doubts(), std::slice::from_ref(&weightless));
    let words = weightless.to_string();
    assert!(
        words.contains("body `plate` has no mass: give it `masses`"),
        "{words}"
    );
    for mass in [2.0, 0.0] {
        let mut held = model.clone();
        let on = held.node("plate", "B").expect("a node");
        held.add_mass(on, RigidMass::point(mass).expect("a mass"));
        assert_eq!(held.doubts(), [], "{mass} kg");
    }
}

#[test]
fn loads_that_are_none_are_told_by_case() {
    let mut model = model(&general(1e-9, 2e-9, 1e-9, None));
    let on = model.node("plate", "B").expect("a node");
    for wrench in [Vector6::zeros(), Vector6::zeros(), Vector6::ith(3, 1.0)] {
        model.add_load(on, wrench).expect("a load");
    }
    let case = LoadCase {
        name: "push".into(),
        loads: LoadSet::on(on, Vector6::zeros()),
    };
    model.add_case(case).expect("a case");
    let told: Vec<_> = model.doubts().iter().map(ToString::to_string).collect();
    let expected = [
        "the load on `plate.B` has neither force nor moment",
        "the load on `plate.B` in case `push` has neither force nor moment",
    ];
    assert_eq!(told, expected);
}
