//! Every reference mechanism in millimetres and in kilometres, force and time in N and s: nothing
//! depends on the unit of length. The unit of mass is N s² over that of length.

use hyperstat_assembly::{
    ModalOptions, ModalPlan, ModalSensitivities, Prepared, Sensitivity, Solution, solve,
};
use hyperstat_elements::{MassShape, RotaryInertia};
use hyperstat_mechanisms::{Disk, Registry, mechanism_from_str};
use hyperstat_tests::{reference_folder, reference_text};
use nalgebra::Matrix6;

/// Numbers are scaled with rounding, and results are good to some 1e-11 of their kind.
const AGREEMENT: f64 = 1e-9;

/// Power of the unit of length that a field's numbers have.
fn power(field: &str, places: bool) -> i32 {
    match field {
        "density" => -4,
        "young" => -2,
        "x" | "y" | "z" | "mass" => -1,
        "diameter" | "outer" | "inner" | "width" | "height" | "pitch" => 1,
        "u" | "v" | "w" | "moment" | "gravity" | "inertia" => 1,
        "shear_y" | "shear_z" => 2,
        _ => i32::from(places),
    }
}

/// A mechanism file with so many units of length a metre.
fn scaled(text: &str, scale: f64) -> String {
    let mut out = String::new();
    let (mut field, mut word, mut places) = (String::new(), String::new(), false);
    let mut quoted = false;
    let end = |word: &mut String, field: &str, places: bool, out: &mut String| {
        let power = power(field, places);
        match word.parse::<f64>() {
            Ok(number) if power != 0 => out.push_str(&format!("{:?}", number * scale.powi(power))),
            _ => out.push_str(word),
        }
        word.clear();
    };
    for c in text.chars() {
        if c == '"' {
            quoted = !quoted;
        }
        if !quoted && (c.is_ascii_alphanumeric() || "_.-+".contains(c)) {
            word.push(c);
            continue;
        }
        if c == ':' && !quoted && !word.is_empty() {
            field.clone_from(&word);
            places = field == "points";
        }
        places &= c != '}';
        end(&mut word, &field, places, &mut out);
        out.push(c);
    }
    out
}

/// What is known of a mechanism.
struct Results {
    solution: Solution,
    counts: [usize; 4],
    sensitivities: Vec<Sensitivity>,
    frequencies: ModalSensitivities,
}

fn results(text: &str) -> Results {
    let read = mechanism_from_str(text, &reference_folder(), &Disk, &Registry::builtin());
    let mechanism = read.unwrap_or_else(|error| panic!("{error}\n{text}"));
    let mut model = mechanism.model.clone();
    mechanism.name_values(&mut model);
    let solution = solve(&model).expect("a solution");
    let prepared = Prepared::new(model.clone());
    let influence = prepared.here().influence().expect("a held output");
    let options = ModalOptions {
        shape: MassShape::Exact,
        rotary_inertia: RotaryInertia::Included,
        ..ModalOptions::lowest(6)
    };
    let plan = ModalPlan::new(&model, &options).expect("masses");
    let frequencies = plan.sensitivities(model.geometry()).expect("frequencies");
    Results {
        counts: [
            solution.unknowns,
            solution.mobility,
            solution.overconstraint,
            solution.idle.len(),
        ],
        sensitivities: influence.sensitivities(&solution).expect("derivatives"),
        solution,
        frequencies,
    }
}

/// Numbers, each with the power of the unit of length that it has and what its kind is small
/// against, by number.
type Numbers = Vec<(f64, i32, usize)>;

/// Displacements, wrenches or matrices of 6, translations and rotations apart; `units` are the
/// powers of the two.
fn vectors<'a>(all: impl Iterator<Item = &'a [f64]>, units: [i32; 2], kind: usize) -> Numbers {
    let component = |(k, value): (usize, &f64)| {
        let turns = usize::from(k % 6 >= 3);
        (*value, units[turns], 2 * kind + turns)
    };
    all.flat_map(|v| v.iter().enumerate().map(component).collect::<Vec<_>>())
        .collect()
}

fn matrix(m: &Matrix6<f64>, units: [i32; 3], kind: usize) -> Numbers {
    let entry = |k: usize| {
        let turns = usize::from(k % 6 >= 3) + usize::from(k / 6 >= 3);
        (m[(k % 6, k / 6)], units[turns], 3 * kind + turns)
    };
    (0..36).map(entry).collect()
}

fn statics(results: &Results) -> Vec<Numbers> {
    let solution = &results.solution;
    let output = &solution.output;
    let wrenches = solution.joint_wrenches.iter().flatten();
    let wrenches = wrenches.map(|wrench| wrench.as_slice());
    let idle = results.counts[3] > 0;
    let displacements = solution.displacements.iter().filter(|_| !idle);
    let mut all = vec![
        vectors(displacements.map(|u| u.as_slice()), [1, 0], 0),
        vectors(wrenches, [0, 1], 0),
    ];
    all.extend(output.stiffness.map(|k| matrix(&k, [-1, 0, 1], 0)));
    all.extend(output.compliance.map(|c| matrix(&c, [1, 0, -1], 0)));
    all
}

fn derivatives(results: &Results) -> Vec<Numbers> {
    let (mut moved, mut give) = (Numbers::new(), Numbers::new());
    for sensitivity in &results.sensitivities {
        let u = sensitivity.displacement.expect("in balance") * sensitivity.value;
        moved.extend(vectors([u.as_slice()].into_iter(), [1, 0], 0));
        let change = sensitivity.compliance * sensitivity.value;
        give.extend(matrix(&change, [1, 0, -1], 0));
    }
    vec![moved, give]
}

fn frequencies(results: &Results) -> Vec<Numbers> {
    let found = &results.frequencies;
    let plain = |value: f64| (value, 0, 0);
    let changes = found.parameters.iter().flat_map(|s| {
        let derivatives = s.derivatives.iter();
        derivatives.map(|d| d * s.value).collect::<Vec<_>>()
    });
    vec![
        found.frequencies.iter().copied().map(plain).collect(),
        changes.map(plain).collect(),
    ]
}

fn compare(name: &str, scale: f64, [own, other]: [&Results; 2]) {
    assert_eq!(own.counts, other.counts, "{name}");
    let names =
        |r: &Results| -> Vec<_> { r.sensitivities.iter().map(|s| s.name.clone()).collect() };
    assert_eq!(names(own), names(other), "{name}");
    let all = |r: &Results| [statics(r), derivatives(r), frequencies(r)];
    let kinds = ["statics", "derivatives", "frequencies"].into_iter();
    for (what, (own, other)) in kinds.zip(all(own).into_iter().zip(all(other))) {
        assert_eq!(own.len(), other.len(), "{name}: {what}");
        for (place, (own, other)) in own.iter().zip(&other).enumerate() {
            assert_eq!(own.len(), other.len(), "{name}: {what} {place}");
            let size = |kind: usize| {
                let same = own.iter().filter(|(.., k)| *k == kind);
                same.fold(0.0_f64, |most, (value, ..)| most.max(value.abs()))
            };
            for ((value, power, kind), (found, ..)) in own.iter().zip(other) {
                let off = (found / scale.powi(*power) - value).abs();
                assert!(
                    off <= AGREEMENT * size(*kind),
                    "{name} x {scale}: {what} {place}: {value} {found}"
                );
            }
        }
    }
}

#[test]
fn nothing_depends_on_the_unit_of_length() {
    let mut names: Vec<String> = std::fs::read_dir(reference_folder())
        .expect("the reference mechanisms")
        .map(|entry| {
            entry
                .expect("a file")
                .file_name()
                .into_string()
                .expect("a name")
        })
        .filter(|name| name.ends_with(".ron"))
        .collect();
    names.sort();
    assert!(names.len() >= 14);
    for name in names {
        let text = reference_text(&name);
        let output = text.find("output: ").expect("an output");
        let on = text[output + "output: ".len()..]
            .split_once(')')
            .expect("a node")
            .0;
        // Weight, a mass that turns, and beams that shear.
        let acting = format!(
            "gravity: (1.0, -2.0, -9.5),\n    \
             masses: [(on: {on}), mass: 1.5, inertia: (2e-3, 3e-3, 4e-3))],\n    output: "
        );
        let text = text.replace("output: ", &acting).replace(
            "Circle(diameter: 0.014)",
            "Tapered(from: Tube(outer: 0.014, inner: 0.004, shear_y: 9e-5, shear_z: 8e-5), \
             to: Tube(outer: 0.012, inner: 0.005, shear_y: 6e-5, shear_z: 7e-5))",
        );
        let own = results(&text);
        for scale in [1e3, 1e-3] {
            let other = results(&scaled(&text, scale));
            compare(&name, scale, [&own, &other]);
        }
    }
}
