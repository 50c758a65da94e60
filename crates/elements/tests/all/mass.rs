//! Mass matrices of beams: published closed forms, motions of the whole beam, statics.

use crate::support;

use hyperstat_elements::{
    Beam, Elasticity, LineMass, MassShape, Material, Matrix12, RigidMass, RotaryInertia, Section,
    SectionShape, StraightBeam, Taper, TaperedBeam, rotate_matrix12, transport,
};
use nalgebra::{Matrix3, Matrix6, SMatrix, Vector3};
use proptest::prelude::*;

use MassShape::{Cubic, Exact};
use RotaryInertia::{Included, Left};
use support::random::{self, circle, rectangle, steel};

const DENSITY: f64 = 7850.0;

fn line(section: &Section) -> LineMass {
    LineMass::new(DENSITY, Taper::constant(section.clone())).unwrap()
}

/// Largest |ΔM_ij| / √(M_ii M_jj).
fn difference(found: &Matrix12, expected: &Matrix12) -> f64 {
    let off = |i: usize, j: usize| {
        let scale = (expected[(i, i)] * expected[(j, j)]).sqrt();
        (found[(i, j)] - expected[(i, j)]).abs() / scale
    };
    (0..144).map(|e| off(e / 12, e % 12)).fold(0.0, f64::max)
}

/// Przemieniecki, Theory of Matrix Structural Analysis (1968), Eq. 11.29: the consistent mass
/// matrix of a beam with shear deformation (Φ = 12 EI / G A_s L²) and rotary inertia (r² = I/A),
/// as a part of ρ A L; rows and columns v1 θ1 v2 θ2. Its first terms are the motion of the centre
/// line, those with r the turning of the sections.
fn przemieniecki(l: f64, phi: f64, r: f64) -> [[f64; 4]; 4] {
    let (p2, q, d) = (phi * phi, (r / l).powi(2), (1.0 + phi).powi(2));
    let vv = 13.0 / 35.0 + 7.0 / 10.0 * phi + p2 / 3.0 + 6.0 / 5.0 * q;
    let vt = (11.0 / 210.0 + 11.0 / 120.0 * phi + p2 / 24.0 + (0.1 - phi / 2.0) * q) * l;
    let vv_far = 9.0 / 70.0 + 3.0 / 10.0 * phi + p2 / 6.0 - 6.0 / 5.0 * q;
    let vt_far = (13.0 / 420.0 + 3.0 / 40.0 * phi + p2 / 24.0 - (0.1 - phi / 2.0) * q) * l;
    let tt =
        (1.0 / 105.0 + phi / 60.0 + p2 / 120.0 + (2.0 / 15.0 + phi / 6.0 + p2 / 3.0) * q) * l * l;
    let tt_far =
        -(1.0 / 140.0 + phi / 60.0 + p2 / 120.0 + (1.0 / 30.0 + phi / 6.0 - p2 / 6.0) * q) * l * l;
    let rows = [
        [vv, vt, vv_far, -vt_far],
        [vt, tt, vt_far, tt_far],
        [vv_far, vt_far, vv, -vt],
        [-vt_far, tt_far, -vt, tt],
    ];
    rows.map(|row| row.map(|entry| entry / d))
}

/// The 12×12 matrix of a prismatic beam from Przemieniecki's planes (Φ of the centre line's motion,
/// Φ of the sections' turning, and r, of bending along y and along z; r = 0 leaves rotary inertia
/// out) and linear tension and torsion.
fn published(section: &Section, l: f64, planes: [(f64, f64, f64); 2]) -> Matrix12 {
    let mass = DENSITY * section.area() * l;
    let polar = DENSITY * (section.iy() + section.iz()) * l;
    let mut m = Matrix12::zeros();
    for (row, whole) in [(0, mass), (3, polar)] {
        m[(row, row)] = whole / 3.0;
        m[(row + 6, row + 6)] = whole / 3.0;
        m[(row, row + 6)] = whole / 6.0;
        m[(row + 6, row)] = whole / 6.0;
    }
    let places = [([1, 5, 7, 11], 1.0), ([2, 4, 8, 10], -1.0)];
    for ((phi, turned, r), (rows, sign)) in planes.into_iter().zip(places) {
        let moved = przemieniecki(l, phi, 0.0);
        let (with, without) = (przemieniecki(l, turned, r), przemieniecki(l, turned, 0.0));
        let entry = |i: usize, j: usize| moved[i][j] + (with[i][j] - without[i][j]);
        // A slope of deflection along z is a turn of −φy.
        let signs = [1.0, sign, 1.0, sign];
        for i in 0..4 {
            for j in 0..4 {
                m[(rows[i], rows[j])] = mass * entry(i, j) * signs[i] * signs[j];
            }
        }
    }
    m
}

#[test]
fn prismatic_beams_of_przemieniecki() {
    for (shear, length) in [(None, 0.7), (Some(5.0 / 6.0), 0.7), (Some(0.4), 0.06)] {
        let section = rectangle(0.02, 0.05, shear);
        let beam = Beam::new(&steel(), &section, length).unwrap();
        let (ry, rz) = (
            (section.iy() / section.area()).sqrt(),
            (section.iz() / section.area()).sqrt(),
        );
        let flexibility = |inertia: f64, area: Option<f64>| {
            let shear = steel().shear();
            area.map_or(0.0, |area| {
                12.0 * steel().young() * inertia / (shear * area * length * length)
            })
        };
        let phi_y = flexibility(section.iz(), section.shear_y());
        let phi_z = flexibility(section.iy(), section.shear_z());
        for (shape, rotary, planes) in [
            (Exact, Included, [(phi_y, phi_y, rz), (phi_z, phi_z, ry)]),
            (Exact, Left, [(phi_y, phi_y, 0.0), (phi_z, phi_z, 0.0)]),
            // Sections with shear areas do not turn with the slope.
            (Cubic, Included, [(0.0, phi_y, rz), (0.0, phi_z, ry)]),
            (Cubic, Left, [(0.0, 0.0, 0.0), (0.0, 0.0, 0.0)]),
        ] {
            let found = line(&section).consistent(&beam, shape, rotary);
            assert_eq!(found, found.transpose());
            let error = difference(&found, &published(&section, length, planes));
            assert!(error < 1e-14, "{shape:?} {rotary:?}: {error:e}");
        }
    }
}

#[test]
fn lumped_mass_is_half_at_each_node() {
    let mass = LineMass::new(DENSITY, Taper::new(circle(0.02), circle(0.05)).unwrap()).unwrap();
    let lumped = mass.lumped(0.6);
    // A frustum: π L (d1² + d1 d2 + d2²)/12.
    let volume =
        std::f64::consts::PI * 0.6 * (0.02f64.powi(2) + 0.02 * 0.05 + 0.05f64.powi(2)) / 12.0;
    let half = DENSITY * volume / 2.0;
    for row in 0..12 {
        let expected = if row % 6 < 3 { half } else { 0.0 };
        assert!((lumped[(row, row)] - expected).abs() < 1e-14 * half);
    }
    assert_eq!(
        lumped - Matrix12::from_diagonal(&lumped.diagonal()),
        Matrix12::zeros()
    );
}

/// A rigid motion of the beam, from that of its node 1.
fn whole_motion(length: f64) -> SMatrix<f64, 12, 6> {
    let mut out = SMatrix::<f64, 12, 6>::zeros();
    out.fixed_view_mut::<6, 6>(0, 0)
        .copy_from(&Matrix6::identity());
    let carry = transport(&Vector3::new(length, 0.0, 0.0));
    out.fixed_view_mut::<6, 6>(6, 0).copy_from(&carry);
    out
}

/// Mass, first and second moments of a truncated cone about its first end, by elementary
/// integrals of its discs, against a beam of one element: motions of the whole body have no
/// error of the shapes.
#[test]
fn whole_cone_moves_as_a_rigid_body() {
    let (d1, d2, l) = (0.06_f64, 0.02_f64, 0.4_f64);
    let taper = Taper::new(circle(d1), circle(d2)).unwrap();
    let beam = TaperedBeam::new(&steel(), &taper, l).unwrap();
    let mass = LineMass::new(DENSITY, taper).unwrap();
    // ∫ ξ^a (d1 + (d2 − d1) ξ)^b dξ by the binomial theorem.
    let integral = |a: i32, b: i32| -> f64 {
        let binomial = |k: i32| (0..k).fold(1.0, |c, i| c * f64::from(b - i) / f64::from(i + 1));
        (0..=b)
            .map(|k| binomial(k) * d1.powi(b - k) * (d2 - d1).powi(k) / f64::from(a + k + 1))
            .sum()
    };
    let per_area = DENSITY * std::f64::consts::PI / 4.0 * l;
    let total = per_area * integral(0, 2);
    let first = per_area * l * integral(1, 2);
    let second = per_area * l * l * integral(2, 2);
    let about_diameter = per_area / 16.0 * integral(0, 4);
    let centre = first / total;
    let inertia = Matrix3::from_diagonal(&Vector3::new(
        2.0 * about_diameter,
        about_diameter + second - total * centre * centre,
        about_diameter + second - total * centre * centre,
    ));
    let entries = [
        inertia[(0, 0)],
        inertia[(1, 1)],
        inertia[(2, 2)],
        0.0,
        0.0,
        0.0,
    ];
    let rigid = RigidMass::with_inertia(total, entries).unwrap();
    let expected = rigid.about(&Vector3::new(centre, 0.0, 0.0));
    let motion = whole_motion(l);
    for shape in [Cubic, Exact] {
        let found = motion.transpose() * mass.consistent(&beam, shape, Included) * motion;
        assert!(
            (found - expected).amax() < 1e-14 * total,
            "{found} {expected}"
        );
    }
    assert!((mass.total(l) / total - 1.0).abs() < 1e-14);
}

#[test]
fn densities_out_of_range_are_refused() {
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let error = LineMass::new(bad, Taper::constant(circle(0.01))).unwrap_err();
        assert!(error.to_string().starts_with("`density` is"), "{error}");
    }
    assert!(LineMass::new(0.0, Taper::constant(circle(0.01))).is_ok());
}

/// Composite Gauss rule of three points, independent of the crate's own rule and intervals.
fn integrated(beam: &TaperedBeam, mass_at: impl Fn(f64) -> [f64; 6], pieces: usize) -> Matrix12 {
    let mut sum = Matrix12::zeros();
    let step = 1.0 / pieces as f64;
    let whole = transport(&beam.span());
    for k in 0..pieces {
        for (node, weight) in [
            (-0.6f64.sqrt(), 5.0 / 18.0),
            (0.0, 8.0 / 18.0),
            (0.6f64.sqrt(), 5.0 / 18.0),
        ] {
            let xi = step * (k as f64 + 0.5 + node / 2.0);
            let second = StraightBeam::shape(beam, xi);
            let first = transport(&(beam.span() * xi)) - second * whole;
            let mut n = SMatrix::<f64, 6, 12>::zeros();
            n.fixed_view_mut::<6, 6>(0, 0).copy_from(&first);
            n.fixed_view_mut::<6, 6>(0, 6).copy_from(&second);
            let mass = Matrix6::from_diagonal(&mass_at(xi).into());
            sum += n.transpose() * mass * n * (weight * step * beam.length());
        }
    }
    sum
}

/// The stated accuracy of tapered beams, on a strong taper whose halves differ by 4⁴ in stiffness.
#[test]
fn tapered_integrals_are_right_to_rounding() {
    for (from, to) in [
        (
            rectangle(0.08, 0.02, Some(0.8)),
            rectangle(0.02, 0.03, Some(0.8)),
        ),
        (circle(0.08), circle(0.02)),
        (circle(0.05), circle(0.0005)),
    ] {
        let taper = Taper::new(from, to).unwrap();
        let beam = TaperedBeam::new(&steel(), &taper, 0.5).unwrap();
        let mass_at = |xi: f64| {
            let section = taper.at(xi);
            let (a, y, z) = (section.area(), section.iy(), section.iz());
            [a, a, a, y + z, y, z].map(|value| DENSITY * value)
        };
        // The rectangle is a square, where its torsion constant has a kink, at 6/7: between two pieces.
        let expected = integrated(&beam, mass_at, 4200);
        let mass = LineMass::new(DENSITY, taper.clone()).unwrap();
        let error = difference(&mass.consistent(&beam, Exact, Included), &expected);
        assert!(error < 1e-13, "{error:e}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn kinetic_energy_is_positive(
        beam in random::tapered_beam(),
        u in proptest::array::uniform12(-1.0..1.0f64),
    ) {
        let mass = LineMass::new(DENSITY, beam.taper().clone()).unwrap();
        let u = SMatrix::<f64, 12, 1>::from(u);
        for shape in [Cubic, Exact] {
            let with = u.dot(&(mass.consistent(&beam, shape, Included) * u));
            let without = u.dot(&(mass.consistent(&beam, shape, Left) * u));
            prop_assert!(with > without && without > 0.0, "{with} {without}");
        }
    }

    /// Every variant has the mass and the centre of mass of the whole beam.
    #[test]
    fn whole_motions_have_the_whole_mass(beam in random::tapered_beam()) {
        let length = beam.length();
        let mass = LineMass::new(DENSITY, beam.taper().clone()).unwrap();
        let motion = whole_motion(length);
        let total = mass.total(length);
        let exact = motion.transpose() * mass.consistent(&beam, Exact, Left) * motion;
        let cubic = motion.transpose() * mass.consistent(&beam, Cubic, Left) * motion;
        let lumped = motion.transpose() * mass.lumped(length) * motion;
        for found in [exact, cubic, lumped] {
            for d in 0..3 {
                prop_assert!((found[(d, d)] / total - 1.0).abs() < 1e-12);
            }
        }
        prop_assert!((exact - cubic).amax() < 1e-12 * total);
        // The weight's moment about node 1 is that of the mass: gravity along z turns about −y.
        let weight = mass.weight(&Vector3::z()).resultant(length);
        prop_assert!((weight[2] / total - 1.0).abs() < 1e-12);
        prop_assert!((weight[4] / exact[(2, 4)] - 1.0).abs() < 1e-12, "{weight} {exact}");
    }

    /// A prismatic beam and a taper without change have one mass matrix; turned, its energy stays.
    #[test]
    fn no_change_of_section_changes_nothing(
        (section, _) in random::section_ends(),
        length in 0.05..1.0,
        frame in random::rotation(),
    ) {
        let prismatic = Beam::new(&steel(), &section, length).unwrap();
        let taper = Taper::constant(section.clone());
        let tapered = TaperedBeam::new(&steel(), &taper, length).unwrap();
        let mass = LineMass::new(DENSITY, taper).unwrap();
        let expected = mass.consistent(&prismatic, Exact, Included);
        let error = difference(&mass.consistent(&tapered, Exact, Included), &expected);
        prop_assert!(error < 1e-12, "{error:e}");
        let turned = rotate_matrix12(&expected, &frame);
        prop_assert!((turned.trace() / expected.trace() - 1.0).abs() < 1e-13);
    }
}

/// A general section of the stated properties, in any consistent units.
#[test]
fn general_sections_have_mass_too() {
    let shape = SectionShape::General {
        area: 36.0,
        iy: 492.0,
        iz: 492.0,
        torsion: 1000.0,
        y_max: None,
        z_max: None,
        torsion_modulus: None,
    };
    let section = Section::new(shape, None, None).unwrap();
    let material = Material::new(2e5, Elasticity::Shear(79300.0), Some(7.85e-9)).unwrap();
    let beam = Beam::new(&material, &section, 1000.0).unwrap();
    let mass = LineMass::new(7.85e-9, Taper::constant(section)).unwrap();
    let m = mass.consistent(&beam, Cubic, Left);
    assert!((m[(3, 3)] / (7.85e-9 * 984.0 * 1000.0 / 3.0) - 1.0).abs() < 1e-14);
}
