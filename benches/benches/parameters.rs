//! Parameters cost little: a file of expressions beside the same file with the numbers that come out, and
//! designs that vary a parameter beside designs that vary a value.

use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use hyperstat_mechanisms::{MemoryFiles, Registry, batch_from_str, mechanism_from_str};

/// Legs of the machine.
const LEGS: usize = 60;

/// A plate on many legs in a circle, by its parameters or by its numbers; names of both files' values are
/// the same.
fn machine(by_parameters: bool) -> String {
    let (radius, height, diameter) = (0.25_f64, 0.4_f64, 0.02_f64);
    let number = |expression: String, value: f64| match by_parameters {
        true => format!("\"= {expression}\""),
        false => format!("{value:?}"),
    };
    let (mut points, mut bodies, mut joints) = (String::new(), String::new(), String::new());
    for k in 0..LEGS {
        let turn = std::f64::consts::TAU * k as f64 / LEGS as f64;
        let angle = format!("(2 * pi * {k} / {LEGS})");
        let x = number(format!("R * cos{angle}"), radius * turn.cos());
        let y = number(format!("R * sin{angle}"), radius * turn.sin());
        let [u, v] = [turn.cos(), turn.sin()].map(|c| radius / 3.0 * c);
        let u = number(format!("A{k}.x / 3"), u);
        let v = number(format!("A{k}.y / 3"), v);
        let h = number("height".into(), height);
        points += &format!("        \"A{k}\": ({x}, {y}, 0.0), \"B{k}\": ({u}, {v}, {h}),\n");
        bodies += &format!(
            "        \"leg{k}\": Beam(through: [\"A{k}\", \"B{k}\"], section: \"leg\", material: \"steel\"),\n"
        );
        joints += &format!(
            "        \"A{k}\": (at: \"A{k}\", between: (\"ground\", \"leg{k}\"), kind: Fixed),\n        \
             \"B{k}\": (at: \"B{k}\", between: (\"leg{k}\", \"plate\"), kind: Spherical, stiffness: (x: 8e7, y: 8e7, z: 8e7)),\n"
        );
    }
    let names: Vec<String> = (0..LEGS).map(|k| format!("\"B{k}\"")).collect();
    let outer = number("d".into(), diameter);
    let inner = number("d - 2 * wall".into(), diameter - 4e-3);
    let parameters = match by_parameters {
        true => {
            "parameters: { \"R\": \"250 mm\", \"height\": 0.4, \"d\": \"20 mm\", \"wall\": \"2 mm\" },"
        }
        false => "",
    };
    format!(
        "(\n    name: \"legs\", {parameters}\n    \
         materials: {{ \"steel\": (young: 2.1e11, poisson: 0.3) }},\n    \
         sections: {{ \"leg\": Tube(outer: {outer}, inner: {inner}) }},\n    \
         points: {{\n{points}    }},\n    bodies: {{\n{bodies}        \
         \"plate\": Rigid(points: [{}]),\n    }},\n    joints: {{\n{joints}    }},\n    \
         loads: [(on: (\"plate\", \"B0\"), force: (0.0, 0.0, -10.0))],\n    output: (\"plate\", \"B0\"),\n)\n",
        names.join(", ")
    )
}

/// A batch of designs of the machine, which varies a diameter by this path.
fn designs(by_parameters: bool, path: &str) -> hyperstat_mechanisms::Batch {
    let registry = Registry::builtin();
    let batch = format!(
        "(jobs: [(name: \"designs\", mechanism: File(\"machine.ron\"), vary: {{ {path:?}: Range(0.018, 0.022, 101) }})])"
    );
    let files = MemoryFiles::from_iter([("machine.ron", machine(by_parameters))]);
    batch_from_str(&batch, Path::new("batch.ron"), &files, &registry).expect("a batch")
}

/// The least time of a run, of some.
fn least(runs: usize, run: &mut dyn FnMut()) -> f64 {
    let time = |_| {
        let begin = Instant::now();
        run();
        begin.elapsed().as_secs_f64()
    };
    (0..runs).map(time).fold(f64::INFINITY, f64::min)
}

fn parameters(c: &mut Criterion) {
    let registry = Registry::builtin();
    let files = MemoryFiles::new();
    let texts = [false, true].map(machine);
    let load = |text: &str| {
        let path = Path::new("machine.ron");
        black_box(mechanism_from_str(text, path, &files, &registry).expect("a mechanism"));
    };
    let batches = [designs(false, "sections.leg.outer"), designs(true, "d")];
    let make = |k: usize| {
        black_box(batches[k].jobs[0].design(50).expect("a design"));
    };
    let mut group = c.benchmark_group("parameters");
    group
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1));
    group.bench_function("load, numbers", |b| b.iter(|| load(&texts[0])));
    group.bench_function("load, expressions", |b| b.iter(|| load(&texts[1])));
    group.bench_function("design, a value varies", |b| b.iter(|| make(0)));
    group.bench_function("design, a parameter varies", |b| b.iter(|| make(1)));
    group.finish();
    let loads = [0, 1].map(|k| least(200, &mut || load(&texts[k])));
    let designs = [0, 1].map(|k| least(200, &mut || make(k)));
    println!(
        "expressions take {:.2} times what numbers take to load, a varied parameter {:.2} times what a \
         varied value takes",
        loads[1] / loads[0],
        designs[1] / designs[0]
    );
}

criterion_group!(benches, parameters);
criterion_main!(benches);
