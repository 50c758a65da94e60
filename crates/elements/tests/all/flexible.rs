//! Flexible bodies: what their stiffness must be, and what is said where it is not.

use hyperstat_elements::{
    Beam, Elasticity, ElementError, FlexibleBody, Material, Matrix12, Section, SectionShape,
};
use nalgebra::{DMatrix, Point3};

const POSITIONS: [Point3<f64>; 2] = [Point3::new(0.3, 0.1, 0.0), Point3::new(0.8, 0.1, 0.0)];

fn beam() -> Matrix12 {
    let material = Material::new(2.1e11, Elasticity::Poisson(0.3), None).unwrap();
    let section = Section::new(SectionShape::Circle { diameter: 0.02 }, None, None).unwrap();
    Beam::new(&material, &section, 0.5).unwrap().stiffness()
}

fn body(matrix: &Matrix12) -> Result<FlexibleBody, ElementError> {
    FlexibleBody::new(
        &POSITIONS,
        &DMatrix::from_column_slice(12, 12, matrix.as_slice()),
    )
}

#[test]
fn a_beams_stiffness_makes_a_flexible_body() {
    let body = body(&beam()).unwrap();
    assert_eq!(body.nodes(), 2);
    let far = beam().fixed_view::<6, 6>(6, 6).into_owned();
    assert_eq!(body.held_stiffness().as_slice(), far.as_slice());
    assert_eq!(body.node_stiffness(1), far);
}

#[test]
fn seven_printed_digits_are_enough() {
    let printed = beam().map(|v| format!("{v:.6e}").parse::<f64>().unwrap());
    assert!(body(&printed).is_ok());
}

#[test]
fn mistakes_are_told_apart() {
    let mut k = beam();
    k[(3, 9)] = f64::NAN;
    let error = body(&k).unwrap_err();
    assert_eq!(error, ElementError::NotFiniteEntry { row: 3, column: 9 });

    let mut k = beam();
    k[(1, 5)] *= 1.001;
    let error = body(&k).unwrap_err();
    assert!(
        matches!(
            error,
            ElementError::NotSymmetric {
                row: 5,
                column: 1,
                ..
            }
        ),
        "{error}"
    );

    // Grounded at one place: a spring to the ground resists a translation.
    let mut k = beam();
    k[(7, 7)] *= 1.01;
    let error = body(&k).unwrap_err();
    let motion = "a translation along y";
    assert!(
        matches!(error, ElementError::ResistsRigidMotion { motion: m, .. } if m == motion),
        "{error}"
    );

    // Translations are right, but the beam is as long as in another unit.
    let positions = POSITIONS.map(|p| p * 1000.0);
    let k = DMatrix::from_column_slice(12, 12, beam().as_slice());
    let error = FlexibleBody::new(&positions, &k).unwrap_err();
    assert!(
        matches!(error, ElementError::ResistsRigidMotion { motion, .. } if motion.contains("rotation"))
    );

    let error = body(&-beam()).unwrap_err();
    assert!(
        matches!(error, ElementError::NegativeEnergy { .. }),
        "{error}"
    );

    // Without torsion node 2 spins freely.
    let mut k = beam();
    for (row, column) in [(3, 3), (3, 9), (9, 3), (9, 9)] {
        k[(row, column)] = 0.0;
    }
    assert_eq!(
        body(&k).unwrap_err(),
        ElementError::MoreThanSixFreeMotions { found: 7 }
    );
    let error = body(&Matrix12::zeros()).unwrap_err();
    assert_eq!(error, ElementError::MoreThanSixFreeMotions { found: 12 });

    let error = FlexibleBody::new(&POSITIONS, &DMatrix::zeros(12, 6)).unwrap_err();
    let size = ElementError::StiffnessSize {
        rows: 12,
        columns: 6,
        nodes: 2,
        wanted: 12,
    };
    assert_eq!(error, size);
    let error = FlexibleBody::new(&POSITIONS[..1], &DMatrix::zeros(6, 6)).unwrap_err();
    assert_eq!(error, ElementError::TooFewNodes);
}
