//! Beams against closed forms and against each other.

use crate::support;

use hyperstat_elements::stress::{normal_stress, section_stress};
use hyperstat_elements::{
    Beam, Section, SectionShape, element_frame, rotate_matrix6, rotate_matrix12, rotate_vector6,
    transport,
};
use nalgebra::{DMatrix, Matrix6, Rotation3, Vector3, Vector6};
use proptest::prelude::*;

use support::oracle::scaled_error;
use support::random;

fn dynamic(matrix: &Matrix6<f64>) -> DMatrix<f64> {
    DMatrix::from_column_slice(6, 6, matrix.as_slice())
}

fn close(a: &Vector6<f64>, b: &Vector6<f64>, tolerance: f64) -> bool {
    (a - b).amax() <= tolerance
}

proptest! {
    #[test]
    fn stiffness_is_the_inverse_of_the_compliance(beam in random::beam()) {
        let product = dynamic(&(beam.cantilever_stiffness() * beam.cantilever_compliance()));
        // Scaled to unit diagonals, so that the unit of length does not count.
        let c = beam.cantilever_compliance().diagonal().map(f64::sqrt);
        for i in 0..6 {
            for j in 0..6 {
                let expected = f64::from(u8::from(i == j));
                let error = (product[(i, j)] - expected) * c[i] / c[j];
                // K C scales as C's columns: 1e-13 covers a condition of some hundreds.
                prop_assert!(error.abs() < 1e-12, "{i} {j}: {error:e}");
            }
        }
    }

    #[test]
    fn both_nodes_follow_from_the_cantilever_by_equilibrium(beam in random::beam()) {
        let k = beam.stiffness();
        prop_assert_eq!(k, k.transpose());
        let k22 = beam.cantilever_stiffness();
        let d12 = -transport(&beam.span()).transpose();
        let blocks = [((0, 0), d12 * k22 * d12.transpose()), ((0, 6), d12 * k22), ((6, 6), k22)];
        for (at, expected) in blocks {
            let block = k.fixed_view::<6, 6>(at.0, at.1).into_owned();
            for (row, column) in (0..36).map(|e| (e / 6, e % 6)) {
                let error = (block[(row, column)] - expected[(row, column)]).abs();
                let scale = f64::sqrt(
                    k[(row + at.0, row + at.0)] * k[(column + at.1, column + at.1)],
                );
                prop_assert!(error <= 1e-12 * scale, "{at:?} {row} {column}: {error:e}");
            }
        }
    }

    #[test]
    fn rigid_motion_of_a_beam_gives_no_force_and_no_strain(
        beam in random::beam(),
        motion in random::displacement(),
        xi in 0.0..=1.0,
    ) {
        let second = transport(&beam.span()) * motion;
        for wrench in beam.end_wrenches(&motion, &second) {
            let scale = beam.cantilever_stiffness().abs() * motion.abs();
            prop_assert!(wrench.amax() <= 1e-14 * scale.amax());
        }
        let along = beam.displacement(xi, &motion, &second);
        let expected = transport(&(beam.span() * xi)) * motion;
        prop_assert!(close(&along, &expected, 1e-14));
    }

    #[test]
    fn elastic_curve_meets_both_nodes(
        beam in random::beam(),
        u1 in random::displacement(),
        u2 in random::displacement(),
    ) {
        prop_assert!(close(&beam.displacement(0.0, &u1, &u2), &u1, 0.0));
        prop_assert!(close(&beam.displacement(1.0, &u1, &u2), &u2, 1e-14));
    }

    /// A node anywhere on the curve leaves the curve and its wrenches as they are.
    #[test]
    fn elastic_curve_is_in_equilibrium_at_every_point(
        beam in random::beam(),
        u1 in random::displacement(),
        u2 in random::displacement(),
        cut in 0.2..0.8,
    ) {
        let part = |fraction: f64| beam.with_length(beam.length() * fraction).unwrap();
        let middle = beam.displacement(cut, &u1, &u2);
        let [start, end] = beam.end_wrenches(&u1, &u2);
        let (first, second) = (part(cut), part(1.0 - cut));
        let [a, b] = first.end_wrenches(&u1, &middle);
        let [c, d] = second.end_wrenches(&middle, &u2);
        let scale = second.stiffness().amax().max(first.stiffness().amax());
        prop_assert!((b + c).amax() <= 1e-13 * scale);
        prop_assert!(close(&a, &start, 1e-13 * scale));
        prop_assert!(close(&d, &end, 1e-13 * scale));
        prop_assert!(close(&beam.section_wrench(cut, &end), &b, 1e-13 * scale));
    }

    /// Eq. 46: the strains are the derivatives of the elastic curve, here by differences that are
    /// exact for cubics.
    #[test]
    fn strains_are_the_derivatives_of_the_elastic_curve(
        beam in random::beam(),
        u1 in random::displacement(),
        u2 in random::displacement(),
        xi in 0.25..0.75,
    ) {
        let step = 0.125;
        let at = |x: f64| beam.displacement(x, &u1, &u2);
        let (near, far) = (at(xi + step) - at(xi - step), at(xi + 2.0 * step) - at(xi - 2.0 * step));
        let slope = (near * 8.0 - far) / (12.0 * step * beam.length());
        let here = at(xi);
        let strain = beam.strain(xi, &u1, &u2);
        let shear_y = slope[1] - here[5];
        let shear_z = slope[2] + here[4];
        let pairs = [
            (strain.axial, slope[0]),
            (strain.shear_y, shear_y),
            (strain.shear_z, shear_z),
            (strain.twist, slope[3]),
            (strain.curvature_y, slope[4]),
            (strain.curvature_z, slope[5]),
        ];
        let size = 1.0 / beam.length().powi(2);
        for (component, (exact, difference)) in pairs.iter().enumerate() {
            prop_assert!((exact - difference).abs() < 1e-11 * size, "{component}: {pairs:?}");
        }
    }

    #[test]
    fn rotation_keeps_energy(
        beam in random::beam(),
        frame in random::rotation(),
        u1 in random::displacement(),
        u2 in random::displacement(),
    ) {
        let local = beam.stiffness();
        let global = rotate_matrix12(&local, &frame);
        let stack = |a: &Vector6<f64>, b: &Vector6<f64>| {
            nalgebra::SVector::<f64, 12>::from_fn(|i, _| if i < 6 { a[i] } else { b[i - 6] })
        };
        let u = stack(&u1, &u2);
        let turned = stack(&rotate_vector6(&u1, &frame), &rotate_vector6(&u2, &frame));
        let error = (turned.dot(&(global * turned)) - u.dot(&(local * u))).abs();
        prop_assert!(error <= 1e-13 * local.amax() * 12.0);
        let block = rotate_matrix6(&beam.cantilever_stiffness(), &frame);
        prop_assert_eq!(global.fixed_view::<6, 6>(6, 6).into_owned(), block);
    }

    #[test]
    fn transport_of_wrenches_keeps_power(
        r in random::direction(),
        twist in random::displacement(),
        wrench in random::displacement(),
    ) {
        let there = wrench.dot(&(transport(&r) * twist));
        let here = (transport(&r).transpose() * wrench).dot(&twist);
        prop_assert!((there - here).abs() < 1e-14);
    }

    #[test]
    fn element_frames_are_right_handed_and_as_asked(
        span in random::direction(),
        across in random::direction(),
    ) {
        prop_assume!(span.normalize().cross(&across.normalize()).norm() > 1e-3);
        for given in [Some(&across), None] {
            let frame = element_frame(&span, given).unwrap();
            let m = frame.matrix();
            prop_assert!((m.transpose() * m - nalgebra::Matrix3::identity()).amax() < 1e-15);
            prop_assert!((m.determinant() - 1.0).abs() < 1e-15);
            prop_assert!((m.column(0) - span.normalize()).amax() < 1e-15);
        }
        let y = element_frame(&span, Some(&across)).unwrap() * Vector3::y();
        prop_assert!(y.dot(&across) > 0.0);
        prop_assert!(y.dot(&span.cross(&across)).abs() < 1e-12);
    }
}

fn round_bar(diameter: f64, length: f64) -> (Section, Beam) {
    let section = Section::new(SectionShape::Circle { diameter }, None, None).unwrap();
    let beam = Beam::new(&random::steel(), &section, length).unwrap();
    (section, beam)
}

/// Textbook cantilever: w = F L³/3EI, φ = F L²/2EI, θ = T L/GJ, σ = F L c/I, τ = T r/J.
#[test]
fn cantilever_with_tip_force_and_torque() {
    let (d, l, force, torque) = (0.02, 0.5, 150.0, 12.0);
    let (section, beam) = round_bar(d, l);
    let i = std::f64::consts::PI * d.powi(4) / 64.0;
    let (e, g) = (2.1e11, 2.1e11 / 2.6);
    let tip = Vector6::new(0.0, 0.0, -force, torque, 0.0, 0.0);
    let u = beam.cantilever_compliance() * tip;
    let expected = Vector6::new(
        0.0,
        0.0,
        -force * l.powi(3) / (3.0 * e * i),
        torque * l / (g * 2.0 * i),
        force * l * l / (2.0 * e * i),
        0.0,
    );
    assert!(close(&u, &expected, 1e-15 * expected.amax()));

    let [support, end] = beam.end_wrenches(&Vector6::zeros(), &u);
    let at_support = Vector6::new(0.0, 0.0, force, -torque, -force * l, 0.0);
    assert!(close(&support, &at_support, 1e-10));
    let root = beam.section_wrench(0.0, &end);
    assert!(close(&root, &-at_support, 1e-10));
    let stress = section_stress(&section, &root).unwrap();
    let sigma = force * l * (d / 2.0) / i;
    let tau = torque * (d / 2.0) / (2.0 * i);
    assert!((stress.normal / sigma - 1.0).abs() < 1e-12);
    assert!((stress.shear / tau - 1.0).abs() < 1e-12);
    assert!((stress.von_mises / (sigma * sigma + 3.0 * tau * tau).sqrt() - 1.0).abs() < 1e-12);
    // Pushed down, the upper side is in tension.
    assert!((normal_stress(&section, &root, 0.0, d / 2.0) / sigma - 1.0).abs() < 1e-12);

    // The curve F x² (3L − x)/6EI.
    for xi in [0.1, 0.37, 0.5, 0.9] {
        let x = xi * l;
        let expected = -force * x * x * (3.0 * l - x) / (6.0 * e * i);
        let w = beam.displacement(xi, &Vector6::zeros(), &u)[2];
        assert!((w / expected - 1.0).abs() < 1e-13, "{xi}: {w} {expected}");
    }
}

#[test]
fn section_stands_upright_without_a_y_axis() {
    let z_up = |span: Vector3<f64>| element_frame(&span, None).unwrap() * Vector3::z();
    assert!((z_up(Vector3::new(2.0, 1.0, 0.0)) - Vector3::z()).amax() < 1e-15);
    // Steep beams take global x instead.
    assert!((z_up(Vector3::new(0.0, 0.0, -3.0)) - Vector3::x()).amax() < 1e-15);
    let limit = |c: f64| z_up(Vector3::new((1.0 - c * c).sqrt(), 0.0, c));
    assert!(limit(0.899).z > 0.0 && limit(0.899).x < 0.0);
    assert!(limit(0.901).x > 0.0 && limit(0.901).z < 0.0);
}

#[test]
fn frames_without_a_direction_are_refused() {
    let x = Vector3::x();
    assert!(element_frame(&Vector3::zeros(), None).is_err());
    assert!(element_frame(&Vector3::new(f64::NAN, 0.0, 1.0), None).is_err());
    assert!(element_frame(&x, Some(&Vector3::zeros())).is_err());
    assert!(element_frame(&x, Some(&(x * -3.0))).is_err());
    assert!(element_frame(&x, Some(&Vector3::new(1.0, 1e-7, 0.0))).is_err());
    assert!(element_frame(&x, Some(&Vector3::new(1.0, 1e-5, 0.0))).is_ok());
    // Spans far from 1 m neither overflow nor underflow.
    for size in [1e-200, 1e200] {
        let frame = element_frame(&(Vector3::new(1.0, 2.0, 2.0) * size), None).unwrap();
        assert!(((frame * x) - Vector3::new(1.0, 2.0, 2.0) / 3.0).amax() < 1e-15);
    }
}

/// Shear deformation fades with growing shear area, as 1/A_s.
#[test]
fn timoshenko_tends_to_euler_bernoulli() {
    let shape = SectionShape::Rectangle {
        width: 0.02,
        height: 0.05,
    };
    let beam = |shear: Option<f64>| {
        let section = Section::new(shape, shear, shear).unwrap();
        Beam::new(&random::steel(), &section, 0.1).unwrap()
    };
    let euler = dynamic(&beam(None).cantilever_stiffness());
    let gap = |area: f64| scaled_error(&dynamic(&beam(Some(area)).cantilever_stiffness()), &euler);
    assert!(gap(8e-4) > 0.1);
    for area in [1e2, 1e4, 1e6] {
        assert!((gap(area) / gap(10.0 * area) - 10.0).abs() < 0.01);
    }
    assert!(gap(1e14) < 1e-15);
}

/// Textbook: tip deflection F L³/3EI + F L/(κ G A).
#[test]
fn timoshenko_cantilever() {
    let (b, h, l) = (0.02, 0.05, 0.1);
    let shape = SectionShape::Rectangle {
        width: b,
        height: h,
    };
    let kappa_area = 5.0 / 6.0 * b * h;
    let section = Section::new(shape, None, Some(kappa_area)).unwrap();
    let beam = Beam::new(&random::steel(), &section, l).unwrap();
    let (e, g) = (2.1e11, 2.1e11 / 2.6);
    let c = beam.cantilever_compliance();
    let iy = b * h.powi(3) / 12.0;
    let along_z = l.powi(3) / (3.0 * e * iy) + l / (g * kappa_area);
    assert!((c[(2, 2)] / along_z - 1.0).abs() < 1e-14);
    let iz = h * b.powi(3) / 12.0;
    assert!((c[(1, 1)] / (l.powi(3) / (3.0 * e * iz)) - 1.0).abs() < 1e-14);
}

#[test]
fn beams_outside_double_precision_are_refused() {
    let (section, _) = round_bar(0.02, 1.0);
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-120, 1e120] {
        let error = Beam::new(&random::steel(), &section, length).unwrap_err();
        assert!(error.to_string().starts_with("`length` is"), "{error}");
    }
}

#[test]
fn rotation_of_a_matrix_turns_its_axes() {
    let quarter = Rotation3::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
    let soft_in_x = Matrix6::from_diagonal(&Vector6::new(1.0, 0.0, 0.0, 2.0, 0.0, 0.0));
    let turned = rotate_matrix6(&soft_in_x, &quarter);
    let soft_in_y = Matrix6::from_diagonal(&Vector6::new(0.0, 1.0, 0.0, 0.0, 2.0, 0.0));
    assert!((turned - soft_in_y).amax() < 1e-15);
}
