//! Derivatives of mass matrices and weights against central differences of the matrices themselves,
//! whose own values `mass.rs` compares with published ones.

use hyperstat_elements::{
    Along, Beam, BeamLoad, Elasticity, LineMass, MassShape, Material, Matrix12, RotaryInertia,
    Section, SectionShape, StraightBeam, Taper, TaperedBeam,
};
use nalgebra::{Vector3, Vector6};

const LENGTH: f64 = 0.3;
const DENSITY: f64 = 7850.0;
/// Relative step of the differences; their error is of its square, some 1e-8 of a matrix whose
/// entries go with up to the fourth power.
const STEP: f64 = 1e-4;

fn section(shape: SectionShape) -> Section {
    Section::new(shape, Some(3e-4), Some(2e-4)).unwrap()
}

fn material(young: f64, poisson: f64) -> Material {
    Material::new(young, Elasticity::Poisson(poisson), Some(DENSITY)).unwrap()
}

/// Sections at both ends.
fn tapers() -> Vec<Taper> {
    let tube = |outer: f64, inner: f64| section(SectionShape::Tube { outer, inner });
    let flat = |width: f64, height: f64| section(SectionShape::Rectangle { width, height });
    let general = |area: f64| {
        section(SectionShape::General {
            area,
            iy: 1e-8,
            iz: 2e-8,
            torsion: 2.5e-8,
            y_max: None,
            z_max: None,
            torsion_modulus: None,
        })
    };
    vec![
        Taper::constant(tube(0.03, 0.024)),
        Taper::constant(flat(0.02, 0.04)),
        Taper::constant(general(4e-4)),
        Taper::new(tube(0.04, 0.02), tube(0.03, 0.01)).unwrap(),
        Taper::new(flat(0.02, 0.04), flat(0.03, 0.035)).unwrap(),
        Taper::new(general(4e-4), general(6e-4)).unwrap(),
    ]
}

/// A beam as its stiffness sees it.
fn beam(material: &Material, taper: &Taper) -> Box<dyn StraightBeam> {
    if taper.is_constant() {
        Box::new(Beam::new(material, taper.from(), LENGTH).unwrap())
    } else {
        Box::new(TaperedBeam::new(material, taper, LENGTH).unwrap())
    }
}

/// Largest difference of two matrices, as parts of √(M_ii M_jj) of a third.
fn difference(found: &Matrix12, expected: &Matrix12, scale: &Matrix12) -> f64 {
    let off = |i: usize, j: usize| {
        let scale = (scale[(i, i)] * scale[(j, j)]).sqrt();
        (found[(i, j)] - expected[(i, j)]).abs() / scale.max(f64::MIN_POSITIVE)
    };
    (0..144).map(|e| off(e / 12, e % 12)).fold(0.0, f64::max)
}

fn with(taper: &Taper, second: bool, name: &str, value: f64) -> Taper {
    let change = |end: &Section| end.with_dimension(name, value).unwrap();
    if taper.is_constant() {
        return Taper::constant(change(taper.from()));
    }
    let (from, to) = (taper.from().clone(), taper.to().clone());
    let changed = if second {
        Taper::new(from, change(&to))
    } else {
        Taper::new(change(&from), to)
    };
    changed.unwrap()
}

#[test]
fn by_dimensions_of_sections() {
    let steel = material(2.1e11, 0.3);
    let gravity = Vector3::new(1.0, -2.0, -9.0);
    for taper in tapers() {
        for second in [false, true] {
            if second && taper.is_constant() {
                continue;
            }
            let end = if second { taper.to() } else { taper.from() };
            for (name, value) in end.dimensions() {
                let change: Along<'_> = &|xi| match taper.is_constant() {
                    true => end.logarithmic_derivative(name),
                    false => taper.logarithmic_derivative(second, name, xi),
                };
                let line = |taper: &Taper| LineMass::new(DENSITY, taper.clone()).unwrap();
                let sides = [1.0 + STEP, 1.0 - STEP];
                let sides = sides.map(|factor| with(&taper, second, name, value * factor));
                let by_difference = |of: &dyn Fn(&Taper) -> Matrix12| {
                    (of(&sides[0]) - of(&sides[1])) / (2.0 * STEP)
                };
                for shape in [MassShape::Cubic, MassShape::Exact] {
                    for rotary in [RotaryInertia::Included, RotaryInertia::Left] {
                        let of = |t: &Taper| line(t).consistent(&*beam(&steel, t), shape, rotary);
                        let own = &*beam(&steel, &taper);
                        let found = line(&taper)
                            .consistent_derivative(own, shape, rotary, change, change)
                            * value;
                        let expected = by_difference(&of);
                        let off = difference(&found, &expected, &of(&taper));
                        assert!(off < 1e-6, "{name} {second} {shape:?} {rotary:?}: {off:e}");
                    }
                }
                let of = |t: &Taper| line(t).lumped(LENGTH);
                let found = line(&taper).lumped_derivative(LENGTH, change) * value;
                let off = (found - by_difference(&of)).amax();
                assert!(off < 1e-7 * of(&taper).amax(), "{name}: {off:e}");

                let found = line(&taper).weight_derivative(&gravity, change) * value;
                let [high, low] = [0, 1].map(|k| line(&sides[k]).weight(&gravity));
                let expected = (high + low * -1.0) * (0.5 / STEP);
                for xi in [0.0, 0.3, 1.0] {
                    let off = (found.intensity(xi) - expected.intensity(xi)).amax();
                    let size = line(&taper).weight(&gravity).intensity(xi).amax();
                    assert!(off < 1e-7 * size, "{name} at {xi}: {off:e}");
                }
            }
        }
    }
}

/// Elastic constants move the shapes of beams that shear: the mass follows.
#[test]
fn by_constants_of_materials() {
    let (young, poisson) = (2.1e11, 0.3);
    let own = material(young, poisson);
    let none: Along<'_> = &|_| Vector6::zeros();
    let rotary = RotaryInertia::Included;
    for (taper, shape) in tapers()
        .into_iter()
        .flat_map(|taper| [MassShape::Exact, MassShape::Cubic].map(|shape| (taper.clone(), shape)))
    {
        let line = LineMass::new(DENSITY, taper.clone()).unwrap();
        let of = |m: &Material| line.consistent(&*beam(m, &taper), shape, rotary);
        let mut changes = Vec::new();
        for (name, value) in [("young", young), ("poisson", poisson)] {
            let changed = |factor: f64| match name {
                "young" => of(&material(young * factor, poisson)),
                _ => of(&material(young, poisson * factor)),
            };
            let expected = (changed(1.0 + STEP) - changed(1.0 - STEP)) / (2.0 * STEP);
            let change: Along<'_> = &|_| own.logarithmic_derivative(name);
            let found =
                line.consistent_derivative(&*beam(&own, &taper), shape, rotary, none, change)
                    * value;
            let off = difference(&found, &expected, &of(&own));
            assert!(off < 1e-7, "{name}: {off:e}");
            changes.push(found.amax() / of(&own).amax());
        }
        // E and G in step leave the shape as it is; ν does not.
        assert!(changes[0] < 1e-12 && changes[1] > 1e-6, "{changes:?}");
        let cubic = line.consistent_derivative(
            &*beam(&own, &taper),
            MassShape::Cubic,
            RotaryInertia::Left,
            none,
            &|_| own.logarithmic_derivative("poisson"),
        );
        assert_eq!(cubic, Matrix12::zeros());
    }
}

/// A beam of density 1 has the derivative of mass and weight by the density.
#[test]
fn mass_is_proportional_to_density() {
    let taper = tapers().swap_remove(3);
    let line = |density: f64| LineMass::new(density, taper.clone()).unwrap();
    let off = (line(1.0).lumped(LENGTH) * DENSITY - line(DENSITY).lumped(LENGTH)).amax();
    assert!(off < 1e-15);
    let weight = |density: f64| -> BeamLoad { line(density).weight(&Vector3::z()) };
    let off = (weight(1.0) * DENSITY).intensity(0.4) - weight(DENSITY).intensity(0.4);
    assert!(off.amax() < 1e-12);
}
