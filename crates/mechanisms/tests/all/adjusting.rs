//! Mechanisms whose coordinates are rounded, and adjusted: every over-constrained prebuilt one.

use std::path::Path;

use hyperstat_mechanisms::{MemoryFiles, Registry, begin, beginnings, mechanism_from_str, write};

/// A prebuilt mechanism at the first pose of the job that one begins with, as a file.
fn exported(kind: &str) -> String {
    let text = begin(kind).unwrap();
    let registry = Registry::builtin();
    let path = Path::new("begin.ron");
    let batch =
        hyperstat_mechanisms::batch_from_str(&text, path, &MemoryFiles::new(), &registry).unwrap();
    let job = &batch.jobs[0];
    let mut model = job.model().unwrap();
    let mut geometry = model.geometry().clone();
    job.place(0, &mut geometry).unwrap();
    model.set_geometry(geometry).unwrap();
    write(&model, &registry).unwrap()
}

/// The same with all numbers rounded to so many decimals, those of lengths, stiffnesses and so on, too.
fn rounded(text: &str, decimals: usize) -> String {
    let mut out = String::new();
    let mut number = String::new();
    for c in text.chars().chain(['\n']) {
        let inside = !number.is_empty() && (c.is_ascii_digit() || ".e-+".contains(c));
        let begins = number.is_empty()
            && (c.is_ascii_digit() || c == '-')
            && !out.ends_with(|c: char| c.is_alphanumeric() || c == '_');
        if inside || begins {
            number.push(c);
            continue;
        }
        if let Ok(value) = number.parse::<f64>()
            && number.contains('.')
        {
            let short = format!("{value:.decimals$}").parse::<f64>().unwrap();
            out += &format!("{short:?}");
        } else {
            out += &number;
        }
        number.clear();
        out.push(c);
    }
    out
}

#[test]
fn trial() {
    let registry = Registry::builtin();
    let only = std::env::var("ONLY").ok();
    for kind in beginnings() {
        if kind == "mechanism" || only.as_ref().is_some_and(|only| *only != kind) {
            continue;
        }
        let text = exported(&kind);
        for decimals in [3, 4, 5, 6, 7, 17] {
            let text = rounded(&text, decimals);
            let read = |text: &str| {
                mechanism_from_str(text, Path::new("r.ron"), &MemoryFiles::new(), &registry).unwrap()
            };
            let start = std::time::Instant::now();
            let mechanism = read(&text);
            let reading = start.elapsed();
            let found = mechanism.adjusted();
            let time = start.elapsed();
            match found {
                Err(error) => println!("{kind} {decimals}: {error:?} {time:?} {reading:?}"),
                Ok(found) => {
                    let most = found.moved.iter().map(|m| m.roundings).fold(0.0, f64::max);
                    let missed: Vec<_> = found.missed.iter().map(|m| format!("{m:.1e}")).collect();
                    println!(
                        "{kind} {decimals}: {} freedoms, missed {}, {:?}, misfit {:.1e}, {} moved, most {most:.2}, {time:?}, again {:?}",
                        found.freedoms, missed.join(" "), found.rounded, found.misfit, found.moved.len(),
                        read(&found.text).adjusted().err()
                    );
                }
            }
            if decimals > 3 { continue; }
            println!("   near: {:?}", mechanism.nearly_free().map(|f| (f.freedoms, f.missed)));
        }
    }
}
