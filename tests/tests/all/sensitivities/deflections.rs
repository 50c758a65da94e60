//! Derivatives of deflections under weight, temperature and loads along beams.

use hyperstat_assembly::{Parameter, Prepared, solve};
use hyperstat_tests::reference_text;
use nalgebra::Vector6;

use super::{console, label, larger, near, read, slope, value};

/// Relative derivatives of the output's displacement along a component, by name.
fn of_deflection(text: &str, component: usize) -> impl Fn(&str) -> f64 + use<> {
    let model = read(text);
    let solution = solve(&model).expect("a solution");
    let prepared = Prepared::new(model.clone());
    let influence = prepared.here().influence().expect("a held output");
    let found = influence.sensitivities(&solution).expect("derivatives");
    let along = Vector6::ith(component, 1.0);
    move |name| {
        let parameter = found.iter().find(|s| label(&s.parameter) == name);
        let parameter = parameter.unwrap_or_else(|| panic!("no {name}"));
        parameter
            .relative(&solution.output.displacement, &along)
            .unwrap()
    }
}

/// A console under its own weight sags by ρ A g L⁴/8EI, under a load along it by q L⁴/8EI, under a
/// mass at its tip by m g L³/3EI; heated it is α ΔT L longer.
#[test]
fn deflections_of_a_console() {
    let of = |more: &str| console("Circle(diameter: 0.02)", 1, more);
    let heavy = of_deflection(&of("gravity: (0.0, 0.0, -9.81),"), 2);
    near(heavy("diameter"), -2.0, "weight");
    near(heavy("density"), 1.0, "weight");
    near(heavy("young"), -1.0, "weight");
    let loaded = of_deflection(
        &of("loads: [(on: \"bar\", per_length: (0.0, 0.0, -80.0))],"),
        2,
    );
    near(loaded("diameter"), -4.0, "load");
    near(loaded("young"), -1.0, "load");
    let tip = "gravity: (0.0, 0.0, -9.81), masses: [(on: (\"bar\", \"B\"), mass: 2.0)],";
    let tip = of_deflection(&of(tip).replace("density: 7850.0", "density: 0.0"), 2);
    near(tip("diameter"), -4.0, "mass");
    near(tip("mass"), 1.0, "mass");
    let heated = of_deflection(&of(""), 0);
    near(heated("expansion"), 1.0, "temperature");
    near(heated("diameter"), 0.0, "temperature");
}

/// A cone of d₁ at the wall and d₂ at the tip bends by 64 F L³/(3π E d₁³ d₂), however many segments
/// it runs over: its diameters are one parameter each.
#[test]
fn a_taper_over_several_segments() {
    for (points, through) in [
        ("", ""),
        ("\"M\": (0.25, 0.0, 0.0), ", "\"M\", "),
        (
            "\"M\": (0.1, 0.0, 0.0), \"N\": (0.4, 0.0, 0.0), ",
            "\"M\", \"N\", ",
        ),
    ] {
        let text = console(
            "Tapered(from: Circle(diameter: 0.02), to: Circle(diameter: 0.01))",
            1,
            "loads: [(on: (\"bar\", \"B\"), force: (0.0, 0.0, -10.0))],",
        );
        let text = text
            .replace("points: {", &format!("points: {{{points}"))
            .replace("[\"A\", ", &format!("[\"A\", {through}"));
        let found = of_deflection(&text, 2);
        near(found("diameter"), -3.0, through);
        near(found("diameter to"), -1.0, through);
        near(found("young"), -1.0, through);
    }
}

/// Mechanisms with weight, masses, temperatures, misfits and loads along beams; open, closed,
/// over-constrained, joints absorbed or not. Under the loads of the file and of a case.
#[test]
fn deflections_by_differences() {
    let acting = |text: String, body: &str, heated: &str, loaded: &str| {
        let warm = format!("\"{heated}\": Beam(temperature: 25.0, ");
        let acting = format!(
            "gravity: (1.0, -2.0, -9.5),\n    masses: [(on: {body}, mass: 1.5)],\n    \
             cases: {{\"push\": [(on: {body}, force: (300.0, -200.0, 100.0), moment: (5.0, 8.0, 3.0))]}},\n    \
             output:"
        );
        let line = format!(
            "loads: [(on: \"{loaded}\", per_length: (200.0, 300.0, -400.0), moment_per_length: (5.0, 8.0, 3.0)),"
        );
        text.replace("output:", &acting)
            .replace(&format!("\"{heated}\": Beam("), &warm)
            .replace("loads: [", &line)
            .replacen(" x_axis: (", " misfit: (x: 1e-4), x_axis: (", 1)
            .replace("density: 7850.0)", "density: 7850.0, expansion: 1.2e-05)")
    };
    let mut of_delta = vec![
        ("diameter", "\"arm\": Circle(diameter: 0.03"),
        ("diameter", "\"bar\": Circle(diameter: 0.02"),
        ("diameter", "\"rod\": Circle(diameter: 0.014"),
        ("young", "young: 210000000000.0"),
        ("poisson", "poisson: 0.3"),
        ("density", "density: 7850.0"),
        ("expansion", "expansion: 1.2e-05"),
        ("mass", "mass: 1.5"),
    ];
    let rigid = acting(
        reference_text("delta_rigid_joints.ron"),
        "(\"platform\", \"P\")",
        "roda1",
        "rodb2",
    );
    let elastic = acting(
        reference_text("delta_elastic_joints.ron"),
        "(\"platform\", \"P\")",
        "elbow1",
        "elbow2",
    );
    let chain = acting(
        reference_text("every_joint.ron"),
        "(\"top\", \"T\")",
        "l3",
        "l5",
    )
    .replace("density: 2700.0)", "density: 2700.0, expansion: 2.4e-05)");
    let flat = (
        "Rectangle(width: 0.02, height: 0.035)",
        "Tapered(from: Rectangle(width: 0.02, height: 0.035), to: Rectangle(width: 0.03, height: 0.025))",
    );
    let tapered = chain.replace(flat.0, flat.1);
    let of_chain = vec![
        ("width", "width: 0.02"),
        ("height", "height: 0.035"),
        ("young", "young: 210000000000.0"),
        ("density", "density: 7850.0"),
        ("expansion", "expansion: 1.2e-05"),
        ("mass", "mass: 1.5"),
        ("v", "v: 20000.0"),
        ("u", "u: 50000.0"),
        ("x", "x: 100000000.0"),
    ];
    let mut of_taper = of_chain.clone();
    of_taper.extend([("width to", "width: 0.03"), ("height to", "height: 0.025")]);
    let cases = [
        ("delta", rigid, of_delta.clone()),
        ("delta, elastic", elastic, {
            of_delta.extend([("x", "x: 100000000.0"), ("u", "u: 100000.0")]);
            of_delta
        }),
        ("chain", chain, of_chain),
        ("tapered chain", tapered, of_taper),
    ];
    let mut effective = 0;
    for (mechanism, text, parameters) in cases {
        let model = read(&text);
        let solution = solve(&model).expect("a solution");
        let push = solution.of_case("push").expect("a case");
        let prepared = Prepared::new(model.clone());
        let influence = prepared.here().influence().expect("a held output");
        let found = [&solution, &push].map(|s| influence.sensitivities(s).expect("derivatives"));
        for (name, written) in parameters {
            let expected = slope::<12>(|part| {
                let changed = solve(&larger(&text, written, part)).expect("a solution");
                let [own, push] = [changed.output.displacement, changed.cases[0].state.output];
                std::array::from_fn(|k| if k < 6 { own[k] } else { push[k - 6] })
            });
            let (own, case) = expected.split_at(6);
            for ((state, found), expected) in
                [&solution, &push].into_iter().zip(&found).zip([own, case])
            {
                let expected = Vector6::from_column_slice(expected);
                let mine = found.iter();
                let mine: Vec<_> = mine
                    .filter(|s| label(&s.parameter) == name && s.value == value(written))
                    .collect();
                assert!(!mine.is_empty(), "{mechanism}: {name}");
                let derivative: Vector6<f64> = mine
                    .iter()
                    .map(|s| s.displacement.expect("in balance") * s.value)
                    .sum();
                for part in [0, 3] {
                    let size = state.output.displacement.fixed_rows::<3>(part).amax();
                    let off = (derivative - expected).fixed_rows::<3>(part).amax();
                    assert!(
                        off < 1e-8 * size,
                        "{mechanism}: {written}: {derivative} {expected}"
                    );
                    effective += usize::from(expected.fixed_rows::<3>(part).amax() > 1e-4 * size);
                }
            }
        }
    }
    assert!(effective > 100, "only {effective}");
}

/// A balance beam that nothing holds from turning: with more on one side there is no solution, and
/// no derivative; with more of what it hangs on there is.
#[test]
fn what_would_unbalance_has_no_derivative() {
    let text = console(
        "Circle(diameter: 0.02)",
        1,
        "gravity: (0.0, 0.0, -9.81),
         masses: [(on: (\"balance\", \"L\"), mass: 2.0), (on: (\"balance\", \"R\"), mass: 2.0)],",
    );
    let text = text
        .replace(
            "points: {",
            "points: {\"L\": (0.5, 0.1, 0.0), \"R\": (0.5, -0.1, 0.0), ",
        )
        .replace(
            "bodies: {",
            "bodies: {\"balance\": Rigid(points: [\"L\", \"B\", \"R\"]), ",
        )
        .replace(
            "joints: {",
            "joints: {\"hinge\": (at: \"B\", between: (\"bar\", \"balance\"), \
             kind: Revolute(axis: (1.0, 0.0, 0.0))), ",
        );
    let model = read(&text);
    let solution = solve(&model).expect("a solution");
    assert_eq!(solution.idle.len(), 1);
    let prepared = Prepared::new(model.clone());
    let influence = prepared.here().influence().expect("a held output");
    let found = influence.sensitivities(&solution).expect("derivatives");
    for sensitivity in &found {
        let unbalances = matches!(sensitivity.parameter, Parameter::Mass { .. });
        assert_eq!(
            sensitivity.displacement.is_none(),
            unbalances,
            "{sensitivity:?}"
        );
    }
}
