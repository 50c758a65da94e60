//! What stands where a joint slides, and what turns with its body, by the stiffness that it has
//! there: a carriage on a rail against Euler–Bernoulli's beam clamped at both ends, a crank given by
//! its stiffness against the same crank as a beam; and a joint past which neither body can slide.

use hyperstat_assembly::{Geometry, Model, Prepared};
use hyperstat_closure::{ClosureError, LoopClosure, Target};
use hyperstat_elements::{Beam, Elasticity, Material, Section, SectionShape};
use hyperstat_joints::{Dof, Revolute, frame_from_axis, rigid_motion};
use hyperstat_mechanisms::{Disk, Registry, mechanism_from_str};
use nalgebra::{DMatrix, Matrix6, Point3, Vector3};

const YOUNG: f64 = 2.1e11;
const POISSON: f64 = 0.3;
const DIAMETER: f64 = 0.02;

fn model(text: &str) -> Model {
    let read = mechanism_from_str(text, "test.ron".as_ref(), &Disk, &Registry::builtin());
    read.expect("a mechanism").model
}

fn moved(model: &Model, target: &Target<'_>) -> Result<Geometry, ClosureError> {
    let closure = LoopClosure::new(model)?;
    let reached = closure.reach(&closure.home(), target)?;
    let mut geometry = model.geometry().clone();
    closure.write(&reached, &mut geometry)?;
    Ok(geometry)
}

fn stiffness(model: &Model, geometry: &Geometry) -> Matrix6<f64> {
    let prepared = Prepared::new(model.clone());
    let found = prepared.sweep(geometry, &mut prepared.workspace().expect("a plan"));
    found.expect("a result").stiffness.expect("a stiffness")
}

fn assert_close(found: &Matrix6<f64>, wanted: &Matrix6<f64>) {
    for r in 0..6 {
        for c in 0..6 {
            let scale = (wanted[(r, r)] * wanted[(c, c)]).sqrt();
            let off = (found[(r, c)] - wanted[(r, c)]).abs();
            assert!(off <= 1e-10 * scale, "k{r}{c}: {found}{wanted}");
        }
    }
}

/// Two beams from the carriage to the walls, a and b long: EA (1/a + 1/b) along,
/// 12 EI (1/a³ + 1/b³) across, 4 EI (1/a + 1/b) in bending, and 6 EI (1/a² − 1/b²) between.
#[test]
fn a_carriage_on_a_rail_is_as_stiff_as_the_rail_is_there() {
    let rail = model(
        r#"(name: "rail",
            materials: { "steel": (young: 2.1e11, poisson: 0.3) },
            sections: { "bar": Circle(diameter: 0.02) },
            points: { "L": (0.0, 0.0, 0.0), "S": (0.3, 0.0, 0.0), "R": (1.0, 0.0, 0.0) },
            bodies: { "rail": Beam(through: ["L", "S", "R"], section: "bar", material: "steel"),
                      "carriage": Rigid(points: ["S"]) },
            joints: { "left": (at: "L", between: ("ground", "rail"), kind: Fixed),
                      "right": (at: "R", between: ("rail", "ground"), kind: Fixed),
                      "slide": (at: "S", between: ("rail", "carriage"),
                                kind: Prismatic(axis: (1.0, 0.0, 0.0)), locked: true) },
            output: ("carriage", "S"))"#,
    );
    let area = std::f64::consts::PI * DIAMETER.powi(2) / 4.0;
    let bending = YOUNG * std::f64::consts::PI * DIAMETER.powi(4) / 64.0;
    let torsion = bending * 2.0 / (2.0 * (1.0 + POISSON));
    for a in [0.05, 0.3, 0.5, 0.77] {
        let target = Target::Output([Some(a), None, None, None, None, None]);
        let found = stiffness(&rail, &moved(&rail, &target).expect("on the rail"));
        let b = 1.0 - a;
        let both = 1.0 / a + 1.0 / b;
        let across = 12.0 * bending * (a.powi(-3) + b.powi(-3));
        let coupling = 6.0 * bending * (b.powi(-2) - a.powi(-2));
        let turning = 4.0 * bending * both;
        let (along, twisting) = (YOUNG * area * both, torsion * both);
        let mut wanted =
            Matrix6::from_diagonal(&[along, across, across, twisting, turning, turning].into());
        for (r, c, k) in [(1, 5, coupling), (2, 4, -coupling)] {
            wanted[(r, c)] = k;
            wanted[(c, r)] = k;
        }
        assert_close(&found, &wanted);
    }
}

/// A crank of 0.4 m along x, turned by its drive.
fn crank(add: impl Fn(&mut Model, &[(&str, Point3<f64>)])) -> Model {
    let mut model = Model::new("crank");
    let tip = Point3::new(0.4, 0.0, 0.0);
    add(&mut model, &[("O", Point3::origin()), ("T", tip)]);
    let frame = frame_from_axis(Some(&Vector3::z()), None).expect("a frame");
    let drive = hyperstat_assembly::Connection {
        name: "drive".into(),
        between: [None, model.node("crank", "O")],
        joint: Box::new(Revolute),
        locked: hyperstat_joints::DofSet::new(&[Dof::V]),
        stiffness: hyperstat_assembly::JointStiffness::default(),
    };
    model.add_joint(drive, frame).expect("a joint");
    model.set_output(model.node("crank", "T").expect("a node"));
    model
}

/// The stiffness over both ends is Dᵀ k D, D = [−M E].
#[test]
fn a_flexible_body_turns_as_the_beam_does() {
    let material = Material::new(YOUNG, Elasticity::Poisson(POISSON), None).expect("a material");
    let shape = SectionShape::Rectangle {
        width: 0.02,
        height: 0.05,
    };
    let section = Section::new(shape, None, None).expect("a section");
    let y = Some(Vector3::y());
    let beam = crank(|model, points| {
        let added = model.add_beam("crank", points, &material, &section, y, 1);
        added.expect("a beam");
    });
    let flexible = crank(|model, points| {
        let held = Beam::new(&material, &section, 0.4).expect("a beam");
        let mut d = DMatrix::zeros(6, 12);
        let carried = rigid_motion(&(points[1].1 - points[0].1));
        d.view_mut((0, 0), (6, 6)).copy_from(&-carried);
        d.view_mut((0, 6), (6, 6)).copy_from(&Matrix6::identity());
        let stiffness = d.transpose() * held.cantilever_stiffness() * &d;
        let added = model.add_flexible("crank", points, &stiffness);
        added.expect("a flexible body");
    });
    for angle in [-2.0, 0.3, 1.2, 4.0] {
        let [beam, flexible] = [&beam, &flexible].map(|model| {
            let (joint, direction) = LoopClosure::new(model)
                .expect("a linkage")
                .drives()
                .next()
                .expect("a drive");
            let drive = hyperstat_closure::Drive {
                joint,
                direction,
                value: angle,
            };
            let geometry = moved(model, &Target::Drives(&[drive])).expect("an open chain");
            stiffness(model, &geometry)
        });
        assert_close(&flexible, &beam);
        // Not the stiffness at home: the section is higher than wide.
        assert!((beam[(0, 0)] / beam[(1, 1)] - 1.0).abs() > 0.01);
    }
}

#[test]
fn a_joint_that_neither_body_can_slide_past_is_named() {
    let crossed = model(
        r#"(name: "crossed",
            materials: { "steel": (young: 2.1e11, poisson: 0.3) },
            sections: { "bar": Circle(diameter: 0.02) },
            points: { "L": (0.0, 0.0, 0.0), "S": (0.0, 0.2, 0.0), "T": (0.0, 0.5, 0.1) },
            bodies: { "post": Beam(through: ["L", "S"], section: "bar", material: "steel"),
                      "arm": Beam(through: ["S", "T"], section: "bar", material: "steel") },
            joints: { "foot": (at: "L", between: ("ground", "post"), kind: Fixed),
                      "slide": (at: "S", between: ("post", "arm"),
                                kind: Prismatic(axis: (1.0, 0.0, 0.0)), locked: true) },
            output: ("arm", "T"))"#,
    );
    let target = Target::Output([Some(0.1), None, None, None, None, None]);
    let error = moved(&crossed, &target).expect_err("no place for the joint");
    let message = error.to_string();
    assert!(
        message.starts_with("joint `slide` slides by 0.100000 m, but neither `post` nor `arm`"),
        "{message}"
    );
}
