//! Freedoms that a mechanism misses by the rounding of its coordinates.

use hyperstat_assembly::Prepared;
use hyperstat_mechanisms::{Adjustment, Digits, Mechanism};

/// A freedom that is missed by less is counted.
const COUNTED: f64 = 1e-10;

/// What a mechanism of a file misses by rounding, in a sentence; `None` where it misses nothing.
pub fn of_mechanism(mechanism: &Mechanism) -> Option<String> {
    let near = mechanism.nearly_free()?;
    let prepared = Prepared::new(mechanism.model.clone());
    let counted = prepared.here().kinematics().ok()?.mobility;
    Some(in_words(&near, counted))
}

/// Freedoms that are nearly there beside those that are counted, and what took them.
fn in_words(near: &Adjustment, counted: usize) -> String {
    let missed = near.missed.last().copied().unwrap_or(0.0);
    let what = match near.freedoms.saturating_sub(counted) {
        0 if missed <= COUNTED => format!(
            "{} of this configuration alone: along {} its loops open by {:.0e}",
            match near.freedoms {
                1 => "its freedom is one".into(),
                count => format!("its {count} freedoms are those"),
            },
            if near.freedoms == 1 { "it" } else { "them" },
            near.open
        ),
        0 => format!(
            "its {} freedom is met to {missed:.0e} only",
            ordinal(near.freedoms)
        ),
        1 => format!(
            "a {} freedom is missed by {missed:.0e}",
            ordinal(near.freedoms)
        ),
        more => format!(
            "{more} freedoms more, {} in all, are missed by up to {missed:.0e}",
            near.freedoms
        ),
    };
    let help = match near.elsewhere {
        false => "`hyperstat adjust` moves them by the least that it takes",
        true => {
            "write them with more digits; `hyperstat adjust` moves those that stand as numbers in the file itself"
        }
    };
    format!(
        "{what}: coordinates rounded to {}? {help}",
        digits(near.rounded).0
    )
}

/// What numbers were rounded to, in words.
pub(crate) fn rounding(rounded: Digits) -> String {
    let (digits, behind) = digits(rounded);
    digits + behind
}

/// So many digits, and where they stand.
fn digits(rounded: Digits) -> (String, &'static str) {
    let (count, behind) = match rounded {
        Digits::Decimals(count) => (count, " behind the point"),
        Digits::Significant(count) => (count, ""),
        _ => return ("few digits".into(), ""),
    };
    let number = NUMBERS
        .get(count)
        .map_or_else(|| count.to_string(), ToString::to_string);
    let plural = if count == 1 { "" } else { "s" };
    (format!("{number} digit{plural}"), behind)
}

const NUMBERS: [&str; 13] = [
    "no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven",
    "twelve",
];

fn ordinal(count: usize) -> String {
    const ORDINALS: [&str; 13] = [
        "zeroth", "first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth",
        "ninth", "tenth", "eleventh", "twelfth",
    ];
    ORDINALS
        .get(count)
        .map_or_else(|| format!("{count}th"), ToString::to_string)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use hyperstat_mechanisms::{MemoryFiles, Registry, mechanism_from_str};

    use super::of_mechanism;

    /// Three cranks of a parallelogram with its coupler, of which the last is longer: written upright, all
    /// of them move the coupler along x, and nothing moves on.
    const CRANKS: &str = r#"(
        name: "cranks",
        points: {
            "A1": (0.0, 0.0, 0.0), "A2": (0.2142, 0.0, 0.0), "A3": (0.4857, 0.0, 0.0),
            "B1": (0.0, 0.3571, 0.0), "B2": (0.2142, 0.3571, 0.0), "B3": (0.4857, TOP, 0.0),
        },
        bodies: {
            "crank1": Rigid(points: ["A1", "B1"]), "crank2": Rigid(points: ["A2", "B2"]),
            "crank3": Rigid(points: ["A3", "B3"]), "coupler": Rigid(points: ["B1", "B2", "B3"]),
        },
        joints: {
            "A1": (at: "A1", between: ("ground", "crank1"), kind: Revolute(axis: (0, 0, 1)), locked: true),
            "A2": (at: "A2", between: ("ground", "crank2"), kind: Revolute(axis: (0, 0, 1))),
            "A3": (at: "A3", between: ("ground", "crank3"), kind: Revolute(axis: (0, 0, 1))),
            "B1": (at: "B1", between: ("crank1", "coupler"), kind: Revolute(axis: (0, 0, 1))),
            "B2": (at: "B2", between: ("crank2", "coupler"), kind: Revolute(axis: (0, 0, 1))),
            "B3": (at: "B3", between: ("crank3", "coupler"), kind: Revolute(axis: (0, 0, 1))),
        },
        output: ("coupler", "B1"),
    )"#;

    fn told(top: &str) -> Option<String> {
        let text = CRANKS.replace("TOP", top);
        let registry = Registry::builtin();
        let read = mechanism_from_str(&text, Path::new("c.ron"), &MemoryFiles::new(), &registry);
        of_mechanism(&read.unwrap())
    }

    #[test]
    fn a_freedom_of_one_configuration_alone_is_told() {
        assert_eq!(told("0.3571"), None);
        let told = told("0.3572").unwrap();
        let said = "its freedom is one of this configuration alone: along it its loops open by ";
        assert!(told.starts_with(said), "{told}");
        assert!(
            told.contains(": coordinates rounded to four digits? `hyperstat adjust`"),
            "{told}"
        );
    }
}
