//! Derivatives of natural frequencies, and of deflections under weight, temperature and loads along
//! beams: closed forms, and central differences of whole solves.

mod any_topology;
mod deflections;
mod frequencies;
mod names;

use hyperstat_assembly::{Model, Parameter};
use hyperstat_mechanisms::{Disk, Registry, mechanism_from_str};
use hyperstat_tests::reference_folder;

fn read(text: &str) -> Model {
    let read = mechanism_from_str(text, &reference_folder(), &Disk, &Registry::builtin());
    read.unwrap_or_else(|error| panic!("{error}")).model
}

/// What a parameter is called in a file, short.
fn label(parameter: &Parameter) -> String {
    match parameter {
        Parameter::Section {
            dimension, second, ..
        } => format!("{dimension}{}", if *second { " to" } else { "" }),
        Parameter::Material { constant, .. } => (*constant).into(),
        Parameter::Joint { direction, .. } => {
            direction.map_or("stiffness".into(), |dof| format!("{dof:?}").to_lowercase())
        }
        Parameter::Mass { inertia: false, .. } => "mass".into(),
        Parameter::Mass { inertia: true, .. } => "inertia".into(),
    }
}

/// The derivative at 0 of a function of the relative change of a parameter: central differences at
/// two steps, without what both have of the third derivative.
fn slope<const N: usize>(of: impl Fn(f64) -> [f64; N]) -> [f64; N] {
    let at = |step: f64| {
        let (high, low) = (of(step), of(-step));
        std::array::from_fn::<f64, N, _>(|k| (high[k] - low[k]) / (2.0 * step))
    };
    let (near, far) = (at(2e-4), at(4e-4));
    std::array::from_fn(|k| (near[k] * 4.0 - far[k]) / 3.0)
}

/// `text` with a value, written as `written`, made larger by a part of it.
fn larger(text: &str, written: &str, part: f64) -> Model {
    let digits = written.trim_end_matches(|c: char| !c.is_ascii_digit());
    let start = digits.rfind(' ').expect("a space before the value") + 1;
    let value: f64 = digits[start..].parse().expect("a number");
    assert!(text.contains(written), "{written}");
    let new = format!("{}{:?}", &written[..start], value * (1.0 + part));
    read(&text.replace(&written[..digits.len()], &new))
}

fn value(written: &str) -> f64 {
    let digits = written.trim_end_matches(|c: char| !c.is_ascii_digit());
    digits[digits.rfind(' ').unwrap() + 1..].parse().unwrap()
}

/// A round console of steel with what a test adds.
fn console(section: &str, elements: usize, more: &str) -> String {
    format!(
        "(name: \"console\",
          materials: {{\"steel\": (young: 210000000000.0, poisson: 0.3, density: 7850.0, expansion: 1.2e-5)}},
          sections: {{\"bar\": {section}}},
          points: {{\"A\": (0.0, 0.0, 0.0), \"B\": (0.5, 0.0, 0.0)}},
          bodies: {{\"bar\": Beam(through: [\"A\", \"B\"], section: \"bar\", material: \"steel\",
                               elements: {elements}, temperature: 30.0)}},
          joints: {{\"wall\": (at: \"A\", between: (\"ground\", \"bar\"), kind: Fixed)}},
          {more}
          output: (\"bar\", \"B\"))"
    )
}

fn near(found: f64, expected: f64, what: &str) {
    assert!(
        (found - expected).abs() < 1e-9,
        "{what}: {found} {expected}"
    );
}
