//! Parameters, expressions and units: a file with them is the same mechanism as with the numbers that
//! come out, bit for bit, and another value of a parameter reaches all that depends on it.

use std::f64::consts::PI;
use std::path::Path;

use hyperstat_mechanisms::{
    Batch, Disk, LoadError, Mechanism, Registry, Value, batch_from_str, mechanism_from_str,
};

/// A machine of two limbs, with a place for its parameters and for every kind of number.
fn file(fields: &[(&str, &str)]) -> String {
    let mut text = r#"(
    name: "limbs", PARAMETERS
    materials: { "steel": (young: YOUNG, poisson: 0.3, density: DENSITY, expansion: EXPANSION) },
    sections: { "rod": Circle(diameter: ROD), "arm": Tube(outer: OUTER, inner: INNER) },
    points: { "A": (RADIUS, 0.0, 0.0), "B": (ELBOW, 0.3), "M": MIDDLE, "C": (0.0, 0.0, 0.3) },
    bodies: {
        "arm": Beam(through: ["A", "M", "B"], section: "arm", material: "steel", elements: COUNT, temperature: HEAT),
        "rod": Beam(through: ["B", "C"], section: "rod", material: "steel"),
        "tool": Rigid(points: ["C"]),
    },
    joints: {
        "foot": (at: "A", between: ("ground", "arm"), kind: Fixed, stiffness: (x: SPRING, v: TURN)),
        "elbow": (at: "B", between: ("arm", "rod"), kind: Screw(axis: AXIS, pitch: PITCH), locked: true),
        "tip": (at: "C", between: ("rod", "tool"), kind: Fixed),
    },
    loads: [(on: ("tool", "C"), force: (FORCE, 0.0, 0.0), moment: (MOMENT, 0.0, 0.0))],
    gravity: (0.0, 0.0, -9.81),
    masses: [(on: ("tool", "C"), mass: MASS)],
    output: ("tool", "C"),
)"#
    .to_owned();
    for (name, value) in fields {
        text = text.replace(name, value);
    }
    text
}

/// The numbers that come out.
const NUMBERS: [(&str, &str); 19] = [
    ("PARAMETERS", ""),
    ("YOUNG", "2.1e11"),
    ("DENSITY", "7850.0"),
    ("EXPANSION", "12e-6"),
    ("ROD", "0.014"),
    ("OUTER", "0.03"),
    ("INNER", "0.024"),
    ("RADIUS", "0.25"),
    ("ELBOW", "-0.12499999999999994, 0.21650635094610968"),
    ("MIDDLE", "(0.06250000000000003, 0.10825317547305484, 0.15)"),
    ("COUNT", "2"),
    ("HEAT", "20.0"),
    ("SPRING", "35e6"),
    ("TURN", "1e5"),
    ("AXIS", "(-0.12499999999999994, 0.21650635094610968, 0.0)"),
    ("PITCH", "0.0007957747154594768"),
    ("FORCE", "1200.0"),
    ("MOMENT", "0.3"),
    ("MASS", "2.5"),
];

fn read(text: &str) -> Result<Mechanism, LoadError> {
    mechanism_from_str(text, Path::new("f.ron"), &Disk, &Registry::builtin())
}

/// All that a mechanism is.
fn parts(mechanism: &Mechanism) -> String {
    let model = &mechanism.model;
    format!(
        "{:?} {:?} {:?} {:?} {:?}",
        model.segments(),
        model.joints(),
        model.geometry(),
        model.loads(),
        model.masses(),
    )
}

fn with(pairs: &[(&str, &str)]) -> String {
    let mut fields = pairs.to_vec();
    fields.extend(NUMBERS);
    file(&fields)
}

const PARAMETERS: &str = r#"parameters: {
        "turn": "= 2 * third", "third": "60 deg", "R": 0.25, "d": "14 mm", "n": 2, "tool": "2.5 kg", "half": "= R / 2",
    },"#;

const EXPRESSIONS: [(&str, &str); 9] = [
    ("PARAMETERS", PARAMETERS),
    ("ROD", "\"= d\""),
    ("RADIUS", "\"=R\""),
    ("ELBOW", "\"= R * cos(turn)\", \"= R * sin(turn)\""),
    ("MIDDLE", "\"= midpoint(A, B)\""),
    ("COUNT", "\"= n\""),
    ("AXIS", "(\"= B.x\", \"= B.y\", \"= C.z - M.z - M.z\")"),
    ("MASS", "\"= tool\""),
    ("FORCE", "\"= 4800 * R\""),
];

const UNITS: [(&str, &str); 11] = [
    ("YOUNG", "\"210 GPa\""),
    ("DENSITY", "\"7.85 g/cm^3\""),
    ("EXPANSION", "\"12e-6 1/K\""),
    ("ROD", "\"14 mm\""),
    ("OUTER", "\"3 cm\""),
    ("HEAT", "\"20 K\""),
    ("SPRING", "\"35 N/um\""),
    ("TURN", "\"1e5 N*m/rad\""),
    ("FORCE", "\"1.2 kN\""),
    ("MOMENT", "\"300 N*mm\""),
    ("PITCH", "\"5 mm/rev\""),
];

#[test]
fn expressions_are_the_numbers_that_come_out() {
    let mechanism = read(&with(&EXPRESSIONS)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(parts(&mechanism), parts(&read(&with(&[])).unwrap()));
}

#[test]
fn units_are_the_numbers_that_come_out() {
    let mechanism = read(&with(&UNITS)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(parts(&mechanism), parts(&read(&with(&[])).unwrap()));
}

#[test]
fn another_value_of_a_parameter_reaches_all_that_depends_on_it() {
    let mechanism = read(&with(&EXPRESSIONS)).unwrap();
    let written = with(&EXPRESSIONS).replace("\"R\": 0.25", "\"R\": 0.4");
    let expected = parts(&read(&written).unwrap());
    for path in ["R", "parameters.R"] {
        let changed = mechanism.with_values(&[(path, 0.4)]).unwrap();
        assert_eq!(parts(&changed), expected, "{path}");
    }
    let texts = [("parameters.R", "400 mm"), ("R", "= 2 * 0.2"), ("R", "0.4")];
    for (path, text) in texts {
        let changed = mechanism.with_values(&[(path, text)]).unwrap();
        assert_eq!(parts(&changed), expected, "{text}");
    }
    // A value in the place of an expression, and back.
    let changed = mechanism
        .with_values(&[("sections.rod.diameter", 0.02)])
        .unwrap();
    assert_ne!(parts(&changed), parts(&mechanism));
    let back = changed
        .with_values(&[("sections.rod.diameter", "= d")])
        .unwrap();
    assert_eq!(parts(&back), parts(&mechanism));
    // What is wrong is told at the parameter.
    let error = mechanism.with_values(&[("d", -0.01)]).unwrap_err();
    assert_eq!(error.location().unwrap().to_string(), "d");
    assert!(
        error
            .message()
            .starts_with("`d` = -0.01: `diameter` of section `rod` cannot be")
    );
}

#[test]
fn arithmetic_is_that_of_rust() {
    let value = |expression: &str| {
        let text = with(&[
            (
                "PARAMETERS",
                "parameters: { \"a\": 0.3, \"b\": 2, \"angle\": \"30 deg\" },",
            ),
            ("FORCE", &format!("\"={expression}\"")),
        ]);
        let mechanism = read(&text).unwrap_or_else(|error| panic!("{expression}: {error}"));
        mechanism.model.loads()[0].wrench[0]
    };
    let (a, b, angle) = (0.3_f64, 2.0_f64, 30.0 * (PI / 180.0));
    let cases: [(&str, f64); 24] = [
        ("1 + 2 * 3 - 4 / 8", 6.5),
        ("(1 + 2) * 3", 9.0),
        ("-2 ^ 2", -4.0),
        ("2 ^ -1", 0.5),
        ("2 ^ 3 ^ 2", 512.0),
        ("-(a) - -b", -a + b),
        ("8 / 4 / 2", 1.0),
        ("1e3 + 2.5E-1 + .5", 1000.75),
        (
            "sin(angle) + cos(angle) * tan(angle)",
            angle.sin() + angle.cos() * angle.tan(),
        ),
        (
            "asin(a) + acos(a) + atan(a)",
            a.asin() + a.acos() + a.atan(),
        ),
        ("atan2(a, -b)", a.atan2(-b)),
        (
            "hypot(a, b) - sqrt(a * a + b * b)",
            a.hypot(b) - (a * a + b * b).sqrt(),
        ),
        ("min(b, a, 1) + max(1, b)", 2.3),
        ("abs(-a) + exp(a) + ln(b)", a + a.exp() + b.ln()),
        (
            "sinh(a) + cosh(a) + tanh(a)",
            a.sinh() + a.cosh() + a.tanh(),
        ),
        ("log10(1000) + cbrt(27)", 6.0),
        ("floor(2.7) + ceil(2.2) + round(2.5)", 8.0),
        ("pow(b, 10)", 1024.0),
        ("pi / 2", PI / 2.0),
        ("distance(A, C) - hypot(0.25, 0.3)", 0.0),
        ("midpoint(A, C).z", 0.15),
        ("(A + 0.5 * (C - A)).x", 0.125),
        ("'C'.z * 2 × 1 ÷ 1", 0.6),
        ("B.y", 0.21650635094610968),
    ];
    for (expression, expected) in cases {
        assert_eq!(value(expression), expected, "{expression}");
    }
}

#[test]
fn what_is_no_expression_is_a_text_as_before() {
    let text = with(&[]).replace("\"limbs\"", "\"= no (expression\"");
    assert_eq!(read(&text).unwrap().model.name, "= no (expression");
}

fn delta(parameters: &str, radius: &str, rest: &str) -> Result<Batch, LoadError> {
    let text = format!(
        "({parameters} jobs: [(name: \"d\", mechanism: Delta(
            base_radius: {radius}, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60, rod_spacing: 0.12,
            arm: (section: Circle(diameter: 0.030), material: (young: 2.1e11, poisson: 0.3)),
            bar: (section: Circle(diameter: 0.020), material: (young: 2.1e11, poisson: 0.3)),
            rod: (section: Circle(diameter: 0.014), material: (young: 2.1e11, poisson: 0.3)),
        ), {rest})])"
    );
    batch_from_str(&text, Path::new("f.ron"), &Disk, &Registry::builtin())
}

fn models(batch: &Batch) -> Vec<String> {
    let job = &batch.jobs[0];
    let model = |number| {
        let model = job.design(number).unwrap().model().unwrap();
        let (segments, geometry) = (model.segments(), model.geometry());
        format!("{segments:?} {geometry:?} {:?}", model.loads())
    };
    (0..job.designs()).map(model).collect()
}

#[test]
fn jobs_have_parameters_too() {
    let rest = |height: &str, force: &str| {
        format!(
            "poses: List([(0, 0, {height})]), loads: [(on: (\"platform\", \"P\"), force: (0, 0, {force}))]"
        )
    };
    let expected = models(&delta("", "0.25", &rest("0.5", "-30.0")).unwrap());
    let given = "parameters: { \"R\": \"250 mm\", \"F\": 30 },";
    let own = "parameters: { \"R\": 0.25 },";
    let batch = delta(given, "\"= R\"", &rest("\"= 2 * R\"", "\"= -F\""));
    assert_eq!(models(&batch.unwrap()), expected);
    // The job's own take the place of the batch's.
    let given = "parameters: { \"R\": 0.3, \"F\": 30 },";
    let batch = delta(
        given,
        "\"= R\"",
        &format!("{own} {}", rest("\"500 mm\"", "\"= -F\"")),
    );
    assert_eq!(models(&batch.unwrap()), expected);
}

#[test]
fn a_parameter_varies_as_a_value_does() {
    let rest = "poses: List([(0, 0, 0.5)]), loads: [(on: (\"platform\", \"P\"), force: (0, 0, LOAD))], vary: VARY";
    let by_value = rest
        .replace("LOAD", "-75.0")
        .replace("VARY", "{ \"base_radius\": [0.25, 0.3], \"loads\": [1] }");
    assert!(delta("", "0.25", &by_value).is_err());
    let plain = |radius: &str, load: &str| {
        models(
            &delta(
                "",
                radius,
                &rest.replace("LOAD", load).replace(", vary: VARY", ""),
            )
            .unwrap(),
        )
    };
    let expected = [plain("0.25", "-75.0"), plain("0.3", "-90.0")].concat();
    for path in ["R", "parameters.R"] {
        let varied = rest
            .replace("LOAD", "\"= -300 * R\"")
            .replace("VARY", &format!("{{ {path:?}: [0.25, \"300 mm\"] }}"));
        let batch = delta("parameters: { \"R\": 1 },", "\"= R\"", &varied).unwrap();
        assert_eq!(models(&batch), expected, "{path}");
        assert_eq!(batch.jobs[0].values(1), [Value::Number(0.3)]);
        assert!(batch.jobs[0].varied()[0].numeric);
    }
    let varied = rest
        .replace("LOAD", "\"= -300 * R\"")
        .replace("VARY", "{ \"R\": Range(\"25 cm\", 0.3, 2) }");
    let batch = delta("parameters: { \"R\": 1 },", "\"= R\"", &varied).unwrap();
    assert_eq!(models(&batch), expected);
}

/// Derivatives of the expressions, beside differences of their values.
#[test]
fn what_depends_on_a_parameter_is_known_with_its_derivative() {
    let expressions = [
        "a",
        "2 * a - 3 / a",
        "-a ^ 3 + b ^ a",
        "sin(a) * cos(2 * a) / tan(a + 1)",
        "asin(a) - acos(a / 2) + atan(3 * a)",
        "sinh(a) + cosh(a) * tanh(a)",
        "sqrt(a) + cbrt(a) + exp(-a) * ln(a) + log10(a)",
        "abs(a - 2) + pow(a, b) + pow(b, a)",
        "atan2(a, 1 - a) + hypot(a, b)",
        "min(a, b, 9) * max(a, 0.1)",
        "distance(A, P) * P.y + midpoint(P, A).x",
        "c * c",
    ];
    let value = |mechanism: &Mechanism| mechanism.model.loads()[0].wrench[0];
    for expression in expressions {
        let text = with(&[
            (
                "PARAMETERS",
                "parameters: { \"a\": 0.4, \"b\": 2.5, \"c\": \"= a * b\" },",
            ),
            ("FORCE", &format!("\"= {expression}\"")),
        ]);
        // A point that no body runs through.
        let text = text.replace(
            "points: {",
            "points: { \"P\": (\"= a * a\", \"= 1 / a\", \"10 mm\"),",
        );
        let mechanism = read(&text).unwrap_or_else(|error| panic!("{expression}: {error}"));
        let dependences = mechanism.dependences();
        let names: Vec<&str> = dependences.iter().map(|own| own.path.as_str()).collect();
        assert_eq!(names, ["parameters.a", "parameters.b", "parameters.c"]);
        for own in dependences {
            let step = 1e-5 * own.value;
            let beside = [own.value + step, own.value - step];
            let [more, less] =
                beside.map(|at| value(&mechanism.with_values(&[(&own.path, at)]).unwrap()));
            let expected = (more - less) / (beside[0] - beside[1]);
            let mut found = own
                .slopes
                .iter()
                .filter(|(path, _)| path == "loads.0.force.0");
            let found = found.next().map_or(0.0, |(_, slope)| *slope);
            // Of the step, by its square, and of rounding.
            let precision = 1e-8 * (1.0 + expected.abs());
            assert!(
                (found - expected).abs() < precision,
                "{expression}, {}: {found} {expected}",
                own.path
            );
        }
    }
    // What an expression of a whole point reaches.
    let mechanism = read(&with(&EXPRESSIONS)).unwrap();
    let radius = mechanism
        .dependences()
        .into_iter()
        .find(|own| own.path == "parameters.R")
        .unwrap();
    let paths: Vec<&str> = radius
        .slopes
        .iter()
        .map(|(path, _)| path.as_str())
        .collect();
    let expected = [
        "points.A.0",
        "points.B.0",
        "points.B.1",
        "points.M",
        "joints.elbow.kind.axis.0",
        "joints.elbow.kind.axis.1",
        "loads.0.force.0",
    ];
    assert_eq!(paths, expected);
}

/// The example by its parameters: a plate that can rise and tilt.
#[test]
fn the_tripod_is_what_it_says() {
    let path = Path::new("../../examples/tripod.ron");
    let tripod = hyperstat_mechanisms::load_mechanism(path, &Disk, &Registry::builtin()).unwrap();
    assert!(tripod.unused_points().is_empty());
    let prepared = hyperstat_assembly::Prepared::new(tripod.model.clone());
    let here = prepared.here();
    let kinematics = here.kinematics().unwrap();
    assert_eq!((kinematics.mobility, kinematics.overconstraint), (3, 0));
    assert!(here.solve().unwrap().output.stiffness.is_some());
    // Larger, it is the same kind of machine.
    let larger = tripod
        .with_values(&[("R", "300 mm"), ("height", "450 mm")])
        .unwrap();
    let prepared = hyperstat_assembly::Prepared::new(larger.model.clone());
    let here = prepared.here();
    let kinematics = here.kinematics().unwrap();
    assert_eq!((kinematics.mobility, kinematics.overconstraint), (3, 0));
}

#[test]
fn the_batch_of_the_book_has_parameters() {
    let text = std::fs::read_to_string("../../docs/src/batch-files.md").unwrap();
    let start = text.find("```ron\n(\n    parameters:").unwrap() + "```ron\n".len();
    let block = &text[start..start + text[start..].find("```").unwrap()];
    let path = Path::new("f.ron");
    let batch = batch_from_str(block, path, &Disk, &Registry::builtin()).unwrap();
    let job = &batch.jobs[0];
    assert_eq!((job.designs(), job.len()), (2, 15));
    // The job's own, in place of the batch's, by the radius as it is written.
    assert_eq!(
        job.target(0),
        [
            Some(-0.2),
            Some(0.0),
            Some(0.5),
            Some(0.0),
            Some(0.0),
            Some(0.0)
        ]
    );
}
