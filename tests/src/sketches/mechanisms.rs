//! Mechanisms: a general one closed and open (the paper's Fig. 1), case study 1 (Fig. 5), the delta
//! (Fig. 6) and one of its limbs cut open (Fig. 7).

use hyperstat_assembly::{BodyKind, Model};
use hyperstat_figures::Rgb;
use hyperstat_mechanisms::prebuilt::{Delta, Prebuilt};
use nalgebra::{Point3, Rotation3, Vector3};

use super::canvas::{DASHED, FIRST, INK, RIGID, SECOND, Sketch, WHITE, rgb};

const JOINT: Rgb = WHITE;

/// A mechanism of many limbs, and the same with its loops cut at the joints.
pub fn general() -> String {
    let mut sketch = Sketch::new(
        "A mechanism of bodies and joints",
        [900.0, 400.0],
        -70.0,
        26.0,
    );
    for (k, gap) in [0.0, 0.16].into_iter().enumerate() {
        let middle = 225.0 + 450.0 * k as f64;
        sketch.at([middle, 274.0], 150.0);
        limbs(&mut sketch, gap);
        let words = [
            "(a) closed loops",
            "(b) open loops: every link stands alone",
        ][k];
        sketch.words([middle, 385.0], words, 15.0, INK);
    }
    sketch.svg()
}

/// Three limbs of two links between base and platform, their ends this far from the joints.
fn limbs(sketch: &mut Sketch, gap: f64) {
    let at = |k: usize, radius: f64, height: f64| {
        let angle = (150.0 + 120.0 * k as f64).to_radians();
        Point3::new(radius * angle.cos(), radius * angle.sin(), height)
    };
    let lifted = 1.25 + gap;
    let base: Vec<_> = (0..3).map(|k| at(k, 1.0, -gap)).collect();
    let platform: Vec<_> = (0..3).map(|k| at(k, 0.45, lifted)).collect();
    sketch.polygon(&base, FIRST);
    sketch.polygon(&platform, RIGID);
    for k in 0..3 {
        let joints = [at(k, 1.0, 0.0), at(k, 1.05, 0.65), at(k, 0.45, 1.25)];
        for link in joints.windows(2) {
            let along = (link[1] - link[0]).normalize() * (0.06 + 0.35 * gap);
            sketch.rod(&(link[0] + along), &(link[1] - along), 0.035, SECOND);
        }
        for joint in &joints {
            sketch.knob(joint, 0.05, JOINT);
        }
    }
    sketch.letters(&at(0, 1.15, 0.2), [-30.0, 0.0], "limb 1", INK);
    sketch.letters(&at(2, 1.15, 0.2), [18.0, -34.0], "limb n", INK);
    sketch.letters(
        &Point3::new(0.0, 0.0, lifted),
        [10.0, -34.0],
        "output o",
        INK,
    );
    sketch.letters(&Point3::new(0.0, 0.0, -gap), [0.0, 10.0], "base", INK);
}

/// Two beams, a rigid body between them, and the elastic joints B and C.
pub fn single_freedom() -> String {
    let mut sketch = Sketch::new("The single-freedom structure", [900.0, 190.0], -90.0, 0.0);
    sketch.at([450.0, 90.0], 100.0);
    let p = |x: f64| Point3::new(x, 0.0, 0.0);
    for (side, [outer, inner]) in [(-1.0, ["A", "B"]), (1.0, ["D", "C"])] {
        sketch.ground(&p(3.8 * side), [0.0, -side], 90.0);
        sketch.rod(&p(3.8 * side), &p(1.6 * side), 0.1, FIRST);
        sketch.spring(&p(1.6 * side), &p(0.8 * side), 13.0);
        sketch.words_at(&p(3.6 * side), [0.0, -24.0], outer);
        sketch.words_at(&p(1.2 * side), [0.0, -24.0], inner);
    }
    sketch.cuboid(&p(0.0), &Rotation3::identity(), [0.8, 0.2, 0.25], RIGID);
    sketch.words_at(&p(-2.7), [0.0, 34.0], "beam AB: k₁");
    sketch.words_at(&p(2.7), [0.0, 34.0], "beam CD: k₂");
    sketch.words_at(&p(-1.2), [0.0, 34.0], "k_J1");
    sketch.words_at(&p(1.2), [0.0, 34.0], "k_J2");
    sketch.words_at(
        &p(0.0),
        [0.0, 62.0],
        "rigid body BC, output O at its middle",
    );
    sketch.arrow(&p(0.0), &p(0.65), rgb(0xd55e00));
    sketch.words_at(&p(0.35), [0.0, -8.0], "f, Δ_ox");
    sketch.svg()
}

/// Where the limbs are drawn from.
const VIEW: [f64; 2] = [48.0, 20.0];

/// The delta of case study 2.
pub fn delta() -> String {
    let model = Delta::paper().model(&[0.0, 0.0, 0.5]);
    let model = model.expect("a pose within reach");
    let mut sketch = Sketch::new("The delta", [760.0, 620.0], VIEW[0], VIEW[1]);
    sketch.at([380.0, 440.0], 620.0);
    let at = |name: &str| position(&model, name);
    let base = ["A1", "A2", "A3"].map(at);
    sketch.line(&[base[0], base[1], base[2], base[0]], DASHED);
    sketch.polygon(&["C1", "C2", "C3"].map(at), RIGID);
    links(&mut sketch, &model, |_| Vector3::zeros());
    let radius = 0.009;
    for limb in 1..=3 {
        for name in ["A", "B", "Ba", "Bb", "C", "Ca", "Cb"] {
            sketch.knob(&at(&format!("{name}{limb}")), radius, JOINT);
        }
    }
    for (name, by) in [
        ("A1", [4.0, 22.0]),
        ("B1", [8.0, 22.0]),
        ("Ba1", [24.0, -4.0]),
        ("Bb1", [-12.0, 22.0]),
        ("C1", [16.0, 26.0]),
        ("A2", [22.0, 2.0]),
        ("B2", [0.0, -14.0]),
        ("A3", [4.0, 24.0]),
        ("B3", [-26.0, 12.0]),
    ] {
        sketch.letters(&at(name), by, name, INK);
    }
    sketch.letters(&at("P"), [-2.0, -24.0], "P", INK);
    sketch.knob(&at("P"), 0.006, INK);
    sketch.frame(&Point3::origin(), &Rotation3::identity(), 0.13);
    sketch.letters(&Point3::origin(), [0.0, 20.0], "O", INK);
    sketch.svg()
}

/// Limb 1 and the platform, cut at the joints.
pub fn delta_open() -> String {
    let model = Delta::paper().model(&[0.0, 0.0, 0.5]);
    let model = model.expect("a pose within reach");
    let mut sketch = Sketch::new("The delta, its loops cut open", [900.0, 620.0], 20.0, 16.0);
    sketch.at([380.0, 500.0], 700.0);
    let at = |name: &str| position(&model, name);
    let (b, c) = (at("B1"), at("C1"));
    let along = (c - b).normalize();
    let across = (at("Bb1") - at("Ba1")).normalize();
    // How far each link is drawn from its place.
    let apart = |body: &str| match body {
        "arm1" => (at("A1") - b).normalize() * 0.06,
        "elbow1" => Vector3::zeros(),
        "roda1" => along * 0.06 - across * 0.07,
        "rodb1" => along * 0.06 + across * 0.07,
        "wrist1" => along * 0.12,
        _ => Vector3::new(0.0, -0.12, 0.16),
    };
    let shifted = ["C1", "C2", "C3"].map(|name| at(name) + apart("platform"));
    sketch.polygon(&shifted, RIGID);
    let first_limb = |body: &str| body.ends_with('1').then(|| apart(body));
    links_of(&mut sketch, &model, first_limb);
    // Each joint belongs to the element that takes its elasticity; the other side is a bare node.
    let joints = [
        ("A1", "arm1", None),
        ("B1", "elbow1", Some("arm1")),
        ("Ba1", "roda1", Some("elbow1")),
        ("Bb1", "rodb1", Some("elbow1")),
        ("Ca1", "roda1", Some("wrist1")),
        ("Cb1", "rodb1", Some("wrist1")),
        ("C1", "wrist1", Some("platform")),
    ];
    for (point, own, other) in joints {
        let joint = at(point) + apart(own);
        sketch.knob(&joint, 0.011, JOINT);
        if let Some(other) = other {
            let node = at(point) + apart(other);
            sketch.line(&[joint, node], DASHED);
            sketch.knob(&node, 0.005, INK);
        }
    }
    let middle = |a: &str, b: &str, body: &str| at(a) + (at(b) - at(a)) / 2.0 + apart(body);
    for (place, by, words) in [
        (
            middle("A1", "B1", "arm1"),
            [-40.0, 56.0],
            "arm1 with the joint A1",
        ),
        (
            middle("B1", "B1", "elbow1"),
            [96.0, 34.0],
            "elbow1 with the joint B1",
        ),
        (
            middle("Ba1", "Ca1", "roda1"),
            [-180.0, 26.0],
            "roda1 with Ba1 and Ca1",
        ),
        (
            middle("Bb1", "Cb1", "rodb1"),
            [176.0, -20.0],
            "rodb1 with Bb1 and Cb1",
        ),
        (
            middle("C1", "C1", "wrist1"),
            [-130.0, 8.0],
            "wrist1 with the joint C1",
        ),
        (shifted[0], [-100.0, -30.0], "platform, rigid"),
    ] {
        sketch.letters(&place, by, words, INK);
    }
    sketch.svg()
}

/// The place of a named point.
fn position(model: &Model, point: &str) -> Point3<f64> {
    let nodes = model.nodes().iter();
    let node = nodes.enumerate().find(|(_, node)| node.point == point);
    let (k, _) = node.expect("a point of the delta");
    model.geometry().positions[k]
}

fn links(sketch: &mut Sketch, model: &Model, apart: impl Fn(&str) -> Vector3<f64>) {
    links_of(sketch, model, |body| Some(apart(body)));
}

/// The beams of a model, each so far from its place; those without are left out.
fn links_of(sketch: &mut Sketch, model: &Model, apart: impl Fn(&str) -> Option<Vector3<f64>>) {
    for segment in model.segments() {
        let body = &model.bodies()[segment.body.0];
        if body.kind != BodyKind::Elastic {
            continue;
        }
        let Some(apart) = apart(&body.name) else {
            continue;
        };
        let [a, b] = segment
            .ends
            .map(|node| model.geometry().positions[node.0] + apart);
        let half = segment.section.y_max().unwrap_or(0.01) * 0.8;
        let fill = if body.name.starts_with("arm") {
            FIRST
        } else {
            SECOND
        };
        sketch.rod(&a, &b, half, fill);
    }
}
