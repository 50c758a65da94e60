//! Maps of two tables: beside each other in the same colours, and the ratio of one to the other.

use hyperstat_figures::{ColorScale, MapFigure, MapPanel, Quantity, Samples};

use super::map::{Map, Part};
use crate::plot_error::PlotError;
use crate::table::TableReader;

/// How far two places may be apart to be the same, over the range of all.
const SAME: f64 = 1e-6;

/// A table by the name that it has in a figure of several.
#[derive(Debug, Clone, Copy)]
pub struct NamedTable<'t> {
    /// What it is called.
    pub name: &'t str,
    /// The table.
    pub table: &'t TableReader,
    /// The design of it, in place of the map's.
    pub design: Option<usize>,
}

/// The same map of two tables: plane by plane beside each other, to one scale and in one set of
/// colours. Axes that the map leaves open are those of the first.
///
/// # Errors
/// As of a map of either, and tables of other planes.
pub fn beside(tables: [NamedTable<'_>; 2], map: &Map) -> Result<MapFigure, PlotError> {
    let parts = parts(tables, map)?;
    let subtitles = parts.each_ref().map(|part| part.subtitle(""));
    let subtitle = match subtitles[0] == subtitles[1] {
        true => subtitles[0].clone(),
        false => {
            let [first, second] = [0, 1].map(|k| format!("{}: {}", tables[k].name, subtitles[k]));
            format!("{first} {second}")
        }
    };
    let title = format!("{} and {}", tables[0].name, tables[1].name);
    let [first, second] = parts;
    let named = |NamedTable { name, .. }: NamedTable<'_>, panel: MapPanel| MapPanel {
        name: match &*panel.name {
            "" => name.into(),
            plane => format!("{name}, {plane}"),
        },
        ..panel
    };
    let others = second.panels.clone().into_iter();
    let pairs = first.panels.clone().into_iter().zip(others);
    let panels = pairs.flat_map(|(a, b)| [named(tables[0], a), named(tables[1], b)]);
    let panels = panels.collect();
    Ok(MapFigure {
        subtitle,
        panels,
        columns: Some(2),
        ..map.figure(first, || title)
    })
}

/// The map of the ratio of the second table's values to the first's at the same poses, in colours
/// that part at 1; no value where either has none or the first is zero. The map's limits are of the
/// ratio, its scale is left aside.
///
/// # Errors
/// As of a map of either, tables of other planes or poses, and values of opposite signs, which have
/// no ratio above zero.
pub fn ratio(tables: [NamedTable<'_>; 2], map: &Map) -> Result<MapFigure, PlotError> {
    let [first, second] = parts(tables, map)?;
    let over = format!("{} over {}", tables[1].name, tables[0].name);
    let mut panels = Vec::new();
    for (a, b) in first.panels.iter().zip(&second.panels) {
        panels.push(MapPanel {
            name: a.name.clone(),
            axes: a.axes.clone(),
            samples: divided(&a.samples, &b.samples, &|| other_poses(tables, &a.name))?,
        });
    }
    let found = panels.iter().flat_map(|panel| panel.samples.values());
    let found: Vec<f64> = found.copied().flatten().collect();
    let has_both = |(a, b): (&MapPanel, &MapPanel)| {
        let mut values = a.samples.values().iter().zip(b.samples.values());
        values.any(|(a, b)| a.is_some() && b.is_some())
    };
    if found.is_empty() && first.panels.iter().zip(&second.panels).any(has_both) {
        return Err(PlotError::NoRatio {
            value: map.value.clone(),
        });
    }
    if found.is_empty() {
        return Err(PlotError::Nothing {
            path: tables[1].table.path().into(),
        });
    }
    if found.iter().any(|ratio| *ratio <= 0.0) {
        return Err(PlotError::NoRatio {
            value: map.value.clone(),
        });
    }
    let subtitle = first.subtitle(&format!(", {over}"));
    let title = map.value.clone();
    Ok(MapFigure {
        subtitle,
        quantity: Quantity::new("ratio", ""),
        scale: ColorScale::Ratio,
        panels,
        ..map.figure(first, || format!("{title}: {over}"))
    })
}

/// What the map shows of both, of the same planes and along the same axes.
fn parts(tables: [NamedTable<'_>; 2], map: &Map) -> Result<[Part; 2], PlotError> {
    let read = |NamedTable { table, design, .. }: NamedTable<'_>, map: &Map| {
        let mut map = map.clone();
        map.choice.design = design.or(map.choice.design);
        let mut part = Part::read(table, &map)?;
        // Its name says which design it is of.
        if let Some(design) = design {
            part.over
                .retain(|words| *words != format!("design {design}"));
        }
        Ok::<_, PlotError>(part)
    };
    let first = read(tables[0], map)?;
    let map = Map {
        axes: first.along.clone().or_else(|| map.axes.clone()),
        ..map.clone()
    };
    let second = read(tables[1], &map)?;
    // Those that are drawn, and the one that is held, be it chosen or the only one.
    let planes = |part: &Part| -> Vec<String> {
        let drawn = part.panels.iter().map(|panel| panel.name.clone());
        drawn.chain(part.held.iter().cloned()).collect()
    };
    let [planes, others] = [planes(&first), planes(&second)];
    if planes == others {
        return Ok([first, second]);
    }
    let common = planes.into_iter().find(|plane| others.contains(plane));
    Err(PlotError::OtherPlanes {
        paths: tables.map(|named| named.table.path().into()),
        common: common.filter(|plane| !plane.is_empty()),
    })
}

/// Values over those at the same places.
fn divided(
    of: &Samples,
    by: &Samples,
    other_poses: &dyn Fn() -> PlotError,
) -> Result<Samples, PlotError> {
    let ratio = |(a, b): (&Option<f64>, &Option<f64>)| {
        let ratio = (*b)? / (*a)?;
        ratio.is_finite().then_some(ratio)
    };
    let values = of.values().iter().zip(by.values()).map(ratio).collect();
    match (of, by) {
        (Samples::Grid { x, y, .. }, Samples::Grid { x: u, y: v, .. })
            if same(x, u) && same(y, v) =>
        {
            let (x, y) = (x.clone(), y.clone());
            Ok(Samples::Grid { x, y, values })
        }
        (Samples::Points { at, .. }, Samples::Points { at: others, .. }) => {
            let along = |at: &[[f64; 2]], k: usize| at.iter().map(|at| at[k]).collect::<Vec<_>>();
            let alike = (0..2).all(|k| same(&along(at, k), &along(others, k)));
            let at = at.clone();
            alike
                .then_some(Samples::Points { at, values })
                .ok_or_else(other_poses)
        }
        _ => Err(other_poses()),
    }
}

/// Whether places are the same but for rounding.
fn same(a: &[f64], b: &[f64]) -> bool {
    let least = a.iter().copied().fold(f64::INFINITY, f64::min);
    let most = a.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let apart = SAME * (most - least).max(least.abs().max(most.abs()) * SAME);
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= apart)
}

fn other_poses(tables: [NamedTable<'_>; 2], plane: &str) -> PlotError {
    PlotError::OtherPoses {
        paths: tables.map(|named| named.table.path().into()),
        plane: plane.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::{divided, same};
    use crate::plot_error::PlotError;
    use hyperstat_figures::Samples;

    #[test]
    fn ratios_are_of_values_at_the_same_places() {
        let grid = |x: [f64; 2], values: [Option<f64>; 4]| Samples::Grid {
            x: x.to_vec(),
            y: vec![0.0, 1.0],
            values: values.to_vec(),
        };
        let refused = || PlotError::NoRatio {
            value: "k33".into(),
        };
        let a = grid([0.0, 0.1], [Some(2.0), Some(4.0), None, Some(0.0)]);
        let b = grid(
            [0.0, 0.1 + 1e-12],
            [Some(1.0), Some(10.0), Some(1.0), Some(1.0)],
        );
        let ratio = divided(&a, &b, &refused).unwrap();
        assert_eq!(ratio.values(), [Some(0.5), Some(2.5), None, None]);
        let other = grid([0.0, 0.2], [Some(1.0); 4]);
        assert!(divided(&a, &other, &refused).is_err());
        let dots = Samples::Points {
            at: vec![[0.0; 2]; 4],
            values: vec![Some(1.0); 4],
        };
        assert!(divided(&a, &dots, &refused).is_err());
        assert!(same(&[0.0, 1.0], &[0.0, 1.0 + 1e-9]) && !same(&[0.0], &[0.0, 1.0]));
    }
}
