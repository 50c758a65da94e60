//! The figure of a compliance budget: where a deflection comes from, as bars.

use hyperstat_figures::{Bar, BarFigure, BarGroup, Quantity};

use crate::answer::{BudgetReport, Sum};
use crate::compare::{BudgetComparison, Pair};

/// Most bars of a group.
const MOST_BARS: usize = 15;

/// A part below this share of the whole is 0.0 % where it is drawn.
const NO_SHARE: f64 = 5e-4;

/// The budget of the node `output`, as bars. Nothing where the whole is zero: it has no shares.
pub fn budget(budget: &BudgetReport, output: &str, title: String) -> Option<BarFigure> {
    if budget.total == 0.0 {
        return None;
    }
    let (name, unit) = budget.quantity();
    let groups = [
        ("By deformation", &budget.by_deformation),
        ("By body and joint", &budget.by_part),
    ];
    let groups = groups.map(|(name, sums)| BarGroup {
        name: name.into(),
        bars: bars(sums, budget),
    });
    Some(BarFigure {
        title,
        subtitle: format!(
            "Where the {name} of {output} {} comes from.",
            in_words(&budget.along)
        ),
        quantity: Quantity::new(name, unit),
        total: budget.total,
        groups: groups.into(),
    })
}

/// Two budgets as bars on one scale, the same parts in the same order, those that differ most from above;
/// 100 % is the whole of the first. Nothing where that is zero.
pub fn compared(
    budgets: &BudgetComparison,
    names: &[String; 2],
    title: String,
) -> Option<BarFigure> {
    let total = budgets.total.values[0].filter(|total| *total != 0.0)?;
    let value = |pair: &Pair, k: usize| pair.values[k].unwrap_or(0.0);
    let shows = |pair: &&Pair| {
        [0, 1]
            .iter()
            .any(|k| value(pair, *k).abs() >= NO_SHARE * total.abs())
    };
    let parts: Vec<&Pair> = budgets.by_part.iter().filter(shows).collect();
    let told = match parts.len() {
        count if count > MOST_BARS => MOST_BARS - 1,
        count => count,
    };
    let groups = [0, 1].map(|k| {
        let named = parts[..told].iter().map(|pair| Bar {
            name: pair.name.clone(),
            value: value(pair, k),
        });
        let others = &parts[told..];
        let others = (!others.is_empty()).then(|| Bar {
            name: format!("{} others", others.len()),
            value: others.iter().map(|pair| value(pair, k)).sum(),
        });
        BarGroup {
            name: names[k].clone(),
            bars: named.chain(others).collect(),
        }
    });
    let Pair { name, unit, .. } = &budgets.total;
    Some(BarFigure {
        title,
        subtitle: format!("Where the {name} {} comes from.", in_words(&budgets.along)),
        quantity: Quantity::new(name, unit),
        total,
        groups: groups.into(),
    })
}

/// The parts by size, and what is left. The least are one bar: those beyond [`MOST_BARS`], and those
/// whose share does not show.
fn bars(sums: &[Sum], budget: &BudgetReport) -> Vec<Bar> {
    let shows = |part: f64| part.abs() >= NO_SHARE * budget.total.abs();
    let mut sums: Vec<&Sum> = sums.iter().collect();
    sums.sort_by(|a, b| b.displacement.abs().total_cmp(&a.displacement.abs()));
    let told = match sums
        .iter()
        .take_while(|sum| shows(sum.displacement))
        .count()
    {
        count if count > MOST_BARS => MOST_BARS - 1,
        count => count,
    };
    let named = sums[..told].iter().map(|sum| Bar {
        name: sum.name.clone(),
        value: sum.displacement,
    });
    let mut bars: Vec<Bar> = named.collect();
    let others = &sums[told..];
    let rest = [
        (
            format!("{} others", others.len()),
            others.iter().map(|sum| sum.displacement).sum(),
        ),
        ("no elastic part".into(), budget.rest),
    ];
    let rest = rest.into_iter().filter(|(_, value)| shows(*value));
    bars.extend(rest.map(|(name, value)| Bar { name, value }));
    bars
}

/// A unit wrench in words: `along z`, `about x`, `along (0, 0.6, −0.8)`.
pub fn in_words(along: &[f64; 6]) -> String {
    let turns = along[..3].iter().all(|component| *component == 0.0);
    let (word, components) = match turns {
        true => ("about", &along[3..]),
        false => ("along", &along[..3]),
    };
    let axes = components.iter().zip(["x", "y", "z"]);
    let alone = axes.clone().find(|(component, _)| **component == 1.0);
    if let Some((_, axis)) = alone {
        return format!("{word} {axis}");
    }
    let rounded = components.iter().map(|component| {
        let rounded = (component * 1e3).round() / 1e3 + 0.0;
        rounded.to_string().replace('-', "−")
    });
    format!("{word} ({})", rounded.collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use super::{bars, in_words};
    use crate::answer::{BudgetReport, Sum};

    /// A budget along a wrench with these parts.
    fn budget(along: [f64; 6], parts: &[f64]) -> BudgetReport {
        let sums = || parts.iter().enumerate();
        let sum = |(k, part): (usize, &f64)| Sum {
            name: format!("part{k}"),
            displacement: *part,
            share: None,
        };
        BudgetReport {
            of: "displacement".into(),
            case: None,
            along,
            total: 1.0,
            parts: Vec::new(),
            by_deformation: Vec::new(),
            by_part: sums().map(sum).collect(),
            rest: 1.0 - parts.iter().sum::<f64>(),
        }
    }

    #[test]
    fn directions_in_words() {
        for (along, words) in [
            ([0.0, 0.0, 1.0, 0.0, 0.0, 0.0], "along z"),
            ([0.0, 0.0, 0.0, 1.0, 0.0, 0.0], "about x"),
            ([0.0, 0.6, -0.8, 0.0, 0.0, 0.0], "along (0, 0.6, −0.8)"),
        ] {
            assert_eq!(in_words(&along), words);
        }
    }

    #[test]
    fn many_parts_end_in_one_bar_and_a_rest_is_shown() {
        let along = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let few = budget(along, &[0.3, -0.5, 1.2, 1e-17]);
        let names: Vec<_> = bars(&few.by_part, &few)
            .into_iter()
            .map(|bar| bar.name)
            .collect();
        assert_eq!(names, ["part2", "part1", "part0"]);
        let many = budget(along, &[0.04; 20]);
        let found = bars(&many.by_part, &many);
        assert_eq!(found.len(), 16);
        assert_eq!(
            (&*found[14].name, &*found[15].name),
            ("6 others", "no elastic part")
        );
        let sum: f64 = found.iter().map(|bar| bar.value).sum();
        assert!((sum - 1.0).abs() < 1e-12);
    }
}
