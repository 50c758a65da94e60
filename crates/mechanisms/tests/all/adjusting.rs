//! Mechanisms whose coordinates are rounded, and adjusted: every over-constrained prebuilt one.

use std::path::Path;

use hyperstat_mechanisms::{MemoryFiles, Registry, begin, beginnings, mechanism_from_str, write};

/// A prebuilt mechanism at the first pose of the job that one begins with, as a file.
fn exported(kind: &str, pose: usize) -> Option<String> {
    let text = begin(kind).unwrap();
    let registry = Registry::builtin();
    let path = Path::new("begin.ron");
    let batch =
        hyperstat_mechanisms::batch_from_str(&text, path, &MemoryFiles::new(), &registry).unwrap();
    let job = &batch.jobs[0];
    if pose >= job.len() { return None; }
    let mut model = job.model().unwrap();
    let mut geometry = model.geometry().clone();
    job.place(pose, &mut geometry).ok()?;
    model.set_geometry(geometry).unwrap();
    if pose >= job.len() { return None; }
    Some(write(&model, &registry).unwrap())
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
        for pose in [0, 1, 3] {
        let Some(text) = exported(&kind, pose) else {continue};
        one(&format!("{kind} {pose}"), &text);
        }
    }
    for file in std::fs::read_dir("examples").unwrap() {
        let path = file.unwrap().path();
        if only.as_ref().is_some_and(|only| !path.to_string_lossy().contains(only)) {
            continue;
        }
        let Ok(text) = std::fs::read_to_string(&path) else {continue};
        if mechanism_from_str(&text, &path, &hyperstat_mechanisms::Disk, &registry).is_ok() {
        one(&path.to_string_lossy(), &text);
        }
    }
}
fn one(kind: &str, text: &str) {
    let registry = Registry::builtin();
        for decimals in [3, 4, 5, 6, 7, 17] {
            let text = rounded(&text, decimals);
            let Ok(mechanism) = mechanism_from_str(&text, Path::new("r.ron"), &MemoryFiles::new(), &registry) else { continue; };
            let start = std::time::Instant::now();
            let near = mechanism.nearly_free();
            let near_time = start.elapsed();
            let start = std::time::Instant::now();
            let found = mechanism.adjusted();
            let time = start.elapsed();
            let near = near.map(|f| f.missed.last().copied());
            match found {
                Err(error) => println!("{kind} {decimals}: {error:?} {time:?} near {near:?} {near_time:?}"),
                Ok(found) => {
                    let again = mechanism_from_str(&found.text, Path::new("r.ron"), &MemoryFiles::new(), &registry).unwrap();
                    let most = found.moved.iter().map(|m| m.roundings).fold(0.0, f64::max);
                    let missed: Vec<_> = found.missed.iter().map(|m| format!("{m:.0e}")).collect();
                    println!(
                        "{kind} {decimals}: {} freedoms, missed {}, {:?}, misfit {:.1e}, {} moved, most {most:.2}, {time:?}, again {:?} near {near:?} {near_time:?}",
                        found.freedoms, missed.join(" "), found.rounded, found.misfit, found.moved.len(),
                        again.adjusted().err()
                    );
                }
            }
        }
}
