//! What `cargo bench` measured last, as Markdown tables: medians, and their ratios to the first of
//! each group, which is this project's way.
//!
//! `cargo run --release -p hyperstat-benches --bin ratios`, from the workspace's folder, after
//! `cargo bench -p hyperstat-benches`.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs};

use serde_json::Value;

/// Benches of a group with their median times \[ns\], in the order in which they ran.
type Groups = BTreeMap<String, Vec<(String, f64)>>;

fn main() -> Result<(), Box<dyn Error>> {
    let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| "target".into(), PathBuf::from);
    for (group, rows) in measured(&target.join("criterion"))? {
        println!("### {group}\n\n| | median | ratio |\n|---|---|---|");
        let first = rows.first().map_or(f64::NAN, |row| row.1);
        for (name, time) in &rows {
            println!(
                "| {name} | {} | {} |",
                duration(*time),
                digits(time / first)
            );
        }
        println!();
    }
    Ok(())
}

/// Reads criterion's own files, one folder a bench.
fn measured(folder: &Path) -> Result<Groups, Box<dyn Error>> {
    let mut found = Vec::new();
    for group in fs::read_dir(folder)? {
        let group = group?.path();
        if !group.is_dir() {
            continue;
        }
        for bench in fs::read_dir(group)? {
            let new = bench?.path().join("new");
            if !new.join("benchmark.json").exists() {
                continue;
            }
            let estimates = new.join("estimates.json");
            let written = fs::metadata(&estimates)?.modified()?;
            let bench = json(&new.join("benchmark.json"))?;
            let median = json(&estimates)?["median"]["point_estimate"].as_f64();
            let text = |key: &str| bench[key].as_str().unwrap_or_default().to_owned();
            let median = median.ok_or("an estimate without a median")?;
            found.push((written, text("group_id"), text("function_id"), median));
        }
    }
    found.sort_by_key(|entry| entry.0);
    let mut groups = Groups::new();
    for (_, group, name, median) in found {
        groups.entry(group).or_default().push((name, median));
    }
    Ok(groups)
}

fn json(path: &Path) -> Result<Value, Box<dyn Error>> {
    Ok(serde_json::from_slice(&fs::read(path)?)?)
}

/// A time in nanoseconds in its natural unit.
fn duration(time: f64) -> String {
    let units = [(1e9, "s"), (1e6, "ms"), (1e3, "µs"), (1.0, "ns")];
    let unit = units.into_iter().find(|(scale, _)| time >= *scale);
    let (scale, unit) = unit.unwrap_or((1.0, "ns"));
    format!("{} {unit}", digits(time / scale))
}

/// Three digits.
fn digits(x: f64) -> String {
    let places = 2 - x.abs().log10().floor().clamp(0.0, 2.0) as usize;
    format!("{x:.places$}")
}
