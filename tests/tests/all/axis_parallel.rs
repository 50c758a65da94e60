//! Mechanisms whose links and joint axes are parallel to the global axes, where pivots are exactly
//! zero and minors tie: every joint kind about every axis, free, locked and elastic, against the
//! independent solver; and the same mechanism in all 48 orientations of the cube, mirrored ones too.

use hyperstat_assembly::{Connection, JointStiffness, Model, SolveError, solve};
use hyperstat_elements::{Section, SectionShape};
use hyperstat_joints::{
    Cylindrical, Dof, DofSet, Fixed, Joint, Planar, Prismatic, Revolute, Screw, Spherical,
    Universal, frame_from_axis,
};
use hyperstat_tests::agreement::agrees_with_reference;
use hyperstat_tests::build::{connection, node, steel, weld_to_ground};
use nalgebra::{Matrix3, Matrix6, Point3, Rotation3, Vector3, Vector6};

const KINDS: [&str; 8] = [
    "Fixed",
    "Revolute",
    "Prismatic",
    "Cylindrical",
    "Screw",
    "Universal",
    "Spherical",
    "Planar",
];
const PITCH: f64 = 0.02;

/// How a joint is held besides its kind.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Hold {
    /// As its kind has it.
    Free,
    /// All free directions held.
    Locked,
    /// Springs along some directions, the free ones among them.
    Elastic,
}

/// A rotation of the cube, or one and a mirror; the entries are 0, 1 and −1.
#[derive(Debug, Clone, Copy)]
struct Orientation(Matrix3<f64>);

impl Orientation {
    fn all() -> impl Iterator<Item = Self> {
        let orders = [
            [0, 1, 2],
            [0, 2, 1],
            [1, 0, 2],
            [1, 2, 0],
            [2, 0, 1],
            [2, 1, 0],
        ];
        orders.into_iter().flat_map(|order| {
            (0..8).map(move |signs: usize| {
                Self(Matrix3::from_fn(|row, column| {
                    let sign = if signs & (1 << row) == 0 { 1.0 } else { -1.0 };
                    if order[row] == column { sign } else { 0.0 }
                }))
            })
        })
    }

    /// 1, or −1 of a mirror.
    fn sense(&self) -> f64 {
        self.0.determinant().signum()
    }

    /// The rotation of a joint frame. A mirror turns a right-handed frame into a left-handed one,
    /// whose x is turned back: the springs along it do not tell.
    fn frame(&self, frame: &Rotation3<f64>) -> Rotation3<f64> {
        let back = Matrix3::from_diagonal(&Vector3::new(self.sense(), 1.0, 1.0));
        Rotation3::from_matrix_unchecked(self.0 * frame.matrix() * back)
    }

    /// A displacement or wrench: rotations and moments change their sense in a mirror.
    fn six(&self) -> Matrix6<f64> {
        let mut six = Matrix6::zeros();
        six.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.0);
        six.fixed_view_mut::<3, 3>(3, 3)
            .copy_from(&(self.0 * self.sense()));
        six
    }
}

fn kind(name: &str, sense: f64) -> Box<dyn Joint> {
    match name {
        "Fixed" => Box::new(Fixed),
        "Revolute" => Box::new(Revolute),
        "Prismatic" => Box::new(Prismatic),
        "Cylindrical" => Box::new(Cylindrical),
        "Screw" => Box::new(Screw::new(PITCH * sense).expect("a pitch")),
        "Universal" => Box::new(Universal),
        "Spherical" => Box::new(Spherical),
        _ => Box::new(Planar),
    }
}

fn joint(name: &str, kind_name: &str, hold: Hold, sense: f64) -> Connection {
    let joint = kind(kind_name, sense);
    let (mut locked, mut stiffness) = (DofSet::EMPTY, [None; 6]);
    match hold {
        Hold::Free => {}
        Hold::Locked => locked = joint.free(),
        Hold::Elastic => {
            let soft = joint.free().union(DofSet::new(&[Dof::X, Dof::W]));
            for direction in soft.iter() {
                let k = direction.index();
                stiffness[k] = Some(if k < 3 { 3e6 } else { 2e4 } * (1.0 + k as f64));
            }
        }
    }
    Connection {
        joint,
        locked,
        stiffness: JointStiffness::Directions(stiffness),
        ..connection(name, [None, None], Fixed)
    }
}

/// A loop of two bent beams along the axes and a rigid body between them, in this orientation:
///
/// ground – `first` – A: 3 links along x, y, z – `second` – coupler – `first` – B: 2 links – ground
///
/// Both joints of the first kind stand along `axis`, the one of the second kind along the next.
fn closed_loop(kinds: [&str; 2], hold: Hold, axis: usize, orientation: &Orientation) -> Model {
    let turn = |x, y, z| Point3::from(orientation.0 * Vector3::new(x, y, z));
    let shape = SectionShape::Circle { diameter: 0.02 };
    let section = Section::new(shape, Some(2e-4), Some(2e-4)).expect("a section");
    let mut model = Model::new("loop");
    let first = [
        ("a", turn(0.0, 0.0, 0.0)),
        ("b", turn(0.4, 0.0, 0.0)),
        ("c", turn(0.4, 0.3, 0.0)),
        ("d", turn(0.4, 0.3, 0.2)),
    ];
    let coupler = [
        ("d", turn(0.4, 0.3, 0.2)),
        ("e", turn(0.4, 0.5, 0.2)),
        ("P", turn(0.1, 0.5, 0.2)),
    ];
    let second = [
        ("e", turn(0.4, 0.5, 0.2)),
        ("f", turn(0.4, 0.5, 0.0)),
        ("g", turn(0.0, 0.5, 0.0)),
    ];
    let steel = steel();
    model
        .add_beam("A", &first, &steel, &section, None, 1)
        .expect("a beam");
    model.add_rigid("coupler", &coupler).expect("a body");
    model
        .add_beam("B", &second, &steel, &section, None, 2)
        .expect("a beam");
    weld_to_ground(&mut model, "B", "g");
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    for (name, kind, ends, axis) in [
        ("foot", kinds[0], [None, Some(("A", "a"))], axis),
        (
            "elbow",
            kinds[1],
            [Some(("A", "d")), Some(("coupler", "d"))],
            axis + 1,
        ),
        (
            "wrist",
            kinds[0],
            [Some(("coupler", "e")), Some(("B", "e"))],
            axis,
        ),
    ] {
        let frame = frame_from_axis(Some(&axes[axis % 3]), None).expect("an axis");
        let mut joint = joint(name, kind, hold, orientation.sense());
        joint.between = ends.map(|end| end.map(|(body, point)| node(&model, body, point)));
        model
            .add_joint(joint, orientation.frame(&frame))
            .expect("a joint");
    }
    let output = node(&model, "coupler", "P");
    let load = orientation.six() * Vector6::new(10.0, -20.0, 30.0, 2.0, 3.0, -1.0);
    model.add_load(output, load).expect("a load");
    model.set_output(output);
    model
}

/// Every pair of kinds, hold and axis.
fn all_loops() -> impl Iterator<Item = ([&'static str; 2], Hold, usize)> {
    let holds = [Hold::Free, Hold::Locked, Hold::Elastic];
    KINDS.into_iter().flat_map(move |first| {
        KINDS.into_iter().flat_map(move |second| {
            holds
                .into_iter()
                .flat_map(move |hold| (0..3).map(move |axis| ([first, second], hold, axis)))
        })
    })
}

#[test]
fn every_pair_of_kinds_agrees_with_the_independent_solver() {
    let identity = Orientation(Matrix3::identity());
    let mut solved = 0;
    for (kinds, hold, axis) in all_loops() {
        let mut model = closed_loop(kinds, hold, axis, &identity);
        let held = match solve(&model) {
            Err(SolveError::LoadOnFreeMotion { .. }) => {
                model.clear_loads();
                false
            }
            _ => true,
        };
        let agreed = agrees_with_reference(&model)
            .unwrap_or_else(|e| panic!("{kinds:?} {hold:?} {axis}: {e}"));
        assert!(agreed, "{kinds:?} {hold:?} {axis}: not solved");
        solved += usize::from(held);
    }
    assert!(solved > 400, "loads carried by {solved} of 576");
}

#[test]
fn every_orientation_of_the_cube_is_the_same() {
    let identity = Orientation(Matrix3::identity());
    assert_eq!(Orientation::all().count(), 48);
    for (kinds, hold, axis) in all_loops().filter(|(_, _, axis)| *axis == 0) {
        let home = solve(&closed_loop(kinds, hold, axis, &identity));
        for orientation in Orientation::all() {
            let turned = solve(&closed_loop(kinds, hold, axis, &orientation));
            let what = format!("{kinds:?} {hold:?} {:?}", orientation.0);
            let (home, turned) = match (&home, turned) {
                (Ok(home), Ok(turned)) => (home, turned),
                (Err(home), Err(turned)) => {
                    let kind = std::mem::discriminant;
                    assert_eq!(kind(home), kind(&turned), "{what}: {home} / {turned}");
                    continue;
                }
                (home, turned) => panic!("{what}: {:?} {:?}", home.as_ref().err(), turned.err()),
            };
            assert_eq!(home.mobility, turned.mobility, "{what}");
            assert_eq!(home.overconstraint, turned.overconstraint, "{what}");
            assert_eq!(home.unknowns, turned.unknowns, "{what}");
            assert_eq!(home.idle.len(), turned.idle.len(), "{what}");
            let (one, two) = (&home.output, &turned.output);
            assert_eq!(one.free_motions.len(), two.free_motions.len(), "{what}");
            let six = orientation.six();
            for (name, one, two) in [
                ("stiffness", one.stiffness, two.stiffness),
                ("compliance", one.compliance, two.compliance),
            ] {
                assert_eq!(one.is_some(), two.is_some(), "{what}: {name}");
                let (Some(one), Some(two)) = (one, two) else {
                    continue;
                };
                let back = six.transpose() * two * six;
                let off = scaled_difference(&back, &one);
                assert!(off < 1e-10, "{what}: {name} off by {off:e}");
            }
        }
    }
}

/// Largest difference by the largest entries of their kinds.
fn scaled_difference(found: &Matrix6<f64>, expected: &Matrix6<f64>) -> f64 {
    let level = expected.diagonal();
    let scale = [
        level.fixed_rows::<3>(0).max(),
        level.fixed_rows::<3>(3).max(),
    ];
    let off = |r: usize, c: usize| {
        (found[(r, c)] - expected[(r, c)]).abs() / (scale[r / 3] * scale[c / 3]).sqrt()
    };
    (0..36).map(|k| off(k / 6, k % 6)).fold(0.0, f64::max)
}
