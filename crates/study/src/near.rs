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
        0 => format!("its {} freedom is met to {missed:.0e} only", ordinal(near.freedoms)),
        1 => format!("a {} freedom is missed by {missed:.0e}", ordinal(near.freedoms)),
        more => format!(
            "{more} freedoms more, {} in all, are missed by up to {missed:.0e}",
            near.freedoms
        ),
    };
    format!(
        "{what}: coordinates rounded to {}? `hyperstat adjust` moves them by as little as gives the \
         mechanism its freedoms",
        rounding(near.rounded)
    )
}

/// What numbers were rounded to, in words.
pub(crate) fn rounding(digits: Digits) -> String {
    let (count, behind) = match digits {
        Digits::Decimals(count) => (count, " behind the point"),
        Digits::Significant(count) => (count, ""),
        _ => return "few digits".into(),
    };
    let number = NUMBERS.get(count).map_or_else(|| count.to_string(), ToString::to_string);
    let plural = if count == 1 { "" } else { "s" };
    format!("{number} digit{plural}{behind}")
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
    ORDINALS.get(count).map_or_else(|| format!("{count}th"), ToString::to_string)
}
