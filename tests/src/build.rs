//! Short ways to build models by hand, and to compare numbers with printed ones.

use hyperstat_assembly::{Connection, JointStiffness, Member, Model, NodeId};
use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
use hyperstat_joints::{DofSet, Fixed, Joint};
use nalgebra::{Rotation3, Vector6};

/// A material of this Young's and shear modulus.
///
/// # Panics
/// Where one is out of its range.
pub fn material(young: f64, shear: f64) -> Material {
    Material::new(young, Elasticity::Shear(shear), None).expect("a material")
}

/// Steel of 210 GPa.
///
/// # Panics
/// Never.
pub fn steel() -> Material {
    Material::new(2.1e11, Elasticity::Poisson(0.3), None).expect("a material")
}

/// A solid round section.
///
/// # Panics
/// Where the diameter is out of its range.
pub fn circle(diameter: f64) -> Section {
    Section::new(SectionShape::Circle { diameter }, None, None).expect("a section")
}

/// A section by its properties; `shear_area` along both of its axes.
///
/// # Panics
/// Where one is out of its range.
pub fn general(area: f64, iy: f64, iz: f64, torsion: f64, shear_area: Option<f64>) -> Section {
    let shape = SectionShape::General {
        area,
        iy,
        iz,
        torsion,
        y_max: None,
        z_max: None,
        torsion_modulus: None,
    };
    Section::new(shape, shear_area, shear_area).expect("a section")
}

/// A prismatic member of one element between the points `ends` of its body, upright.
pub fn member(ends: [usize; 2], material: &Material, section: &Section) -> Member {
    Member {
        ends,
        material: material.clone(),
        section: section.clone(),
        taper: None,
        y_axis: None,
        elements: 1,
    }
}

/// The node of `body` at `point`.
///
/// # Panics
/// Where there is none.
pub fn node(model: &Model, body: &str, point: &str) -> NodeId {
    model
        .node(body, point)
        .unwrap_or_else(|| panic!("no node {body}.{point}"))
}

/// A joint that is neither locked nor elastic.
pub fn connection(
    name: &str,
    between: [Option<NodeId>; 2],
    joint: impl Joint + 'static,
) -> Connection {
    Connection {
        name: name.into(),
        between,
        joint: Box::new(joint),
        locked: DofSet::EMPTY,
        stiffness: JointStiffness::default(),
    }
}

/// Welds `body` to the ground at `point`; the joint's frame is global, its name `point`.
///
/// # Panics
/// Where there is no such node, or a joint of this name.
pub fn weld_to_ground(model: &mut Model, body: &str, point: &str) {
    let between = [None, Some(node(model, body, point))];
    let weld = connection(point, between, Fixed);
    model
        .add_joint(weld, Rotation3::identity())
        .expect("a joint");
}

/// Whether `found` is `printed` to every printed digit: off by half a unit of the last at most.
///
/// # Panics
/// Where `printed` is no number.
pub fn has_printed_digits(found: f64, printed: &str) -> bool {
    let (value, last) = printed_number(printed);
    (found - value).abs() <= 0.5 * last * (1.0 + 1e-9)
}

/// A printed number and a unit of its last digit.
fn printed_number(printed: &str) -> (f64, f64) {
    let value: f64 = printed.parse().expect("a printed number");
    let (digits, exponent) = printed.split_once('e').unwrap_or((printed, "0"));
    let exponent: i32 = exponent.parse().expect("an exponent");
    let decimals = digits.split_once('.').map_or(0, |(_, d)| d.len() as i32);
    (value, 10.0_f64.powi(exponent - decimals))
}

/// Asserts that every number is the printed one, to every printed digit.
///
/// # Panics
/// Where one is not.
pub fn assert_printed(what: &str, found: &[f64], printed: &[&str]) {
    assert_eq!(found.len(), printed.len(), "{what}");
    for (k, (found, printed)) in found.iter().zip(printed).enumerate() {
        assert!(
            has_printed_digits(*found, printed),
            "{what}, number {k}: {found:e}, printed {printed}"
        );
    }
}

/// Asserts that a wrench or displacement is the printed one of a program that keeps its input in
/// single precision, as Frame3DD keeps sections, moduli, densities and loads: two numbers of it,
/// each rounded to 2⁻²⁴, make 2⁻²³ of the largest of its kind; the last printed digit is rounded.
///
/// # Panics
/// Where it is not.
pub fn assert_printed_in_single(what: &str, found: &Vector6<f64>, printed: &[&str; 6]) {
    let printed = printed.map(printed_number);
    for (k, (value, last)) in printed.iter().enumerate() {
        let kind = printed[3 * (k / 3)..][..3].iter();
        let largest = kind.fold(0.0, |largest: f64, (value, _)| largest.max(value.abs()));
        let tolerance = 0.5 * last + f64::from(f32::EPSILON) * largest;
        assert!(
            (found[k] - value).abs() <= tolerance,
            "{what}, number {k}: {:e}, printed {value}",
            found[k]
        );
    }
}
