//! What the stiffness is over a workspace, smallest, mean, percentiles, and where.

use std::collections::HashMap;
use std::sync::LazyLock;

use serde::Serialize;

use super::record::{Found, Record};
use crate::measures::{self, Measure, Pose};

/// Neighbouring values that a percentile does not tell apart: their logarithms differ by less.
const RESOLUTION: f64 = 1e-3;
/// Percentiles that are told, in percent.
const PERCENTILES: [f64; 3] = [5.0, 50.0, 95.0];

/// What is measured at every pose.
const MEASURED: [&str; COUNT] = [
    "deflection",
    "compliance_x",
    "compliance_y",
    "compliance_z",
    "softest_force",
    "softest_moment",
    "pure_force_stiffness_min",
    "pure_translation_stiffness_min",
    "pure_translation_stiffness_max",
    "virtual_work_index",
];
const COUNT: usize = 10;

/// The measures of these names, looked up once: every pose asks for them.
fn measured() -> &'static [&'static Measure] {
    static FOUND: LazyLock<Vec<&Measure>> = LazyLock::new(|| {
        MEASURED
            .iter()
            .filter_map(|name| measures::named(name))
            .collect()
    });
    &FOUND
}

/// The measures of one pose.
pub type Values = [f64; COUNT];

/// The measures at a pose; `None` where it has no result, or no compliance to speak of.
pub fn measure(record: &Record) -> Option<Values> {
    let Found {
        stiffness,
        displacement,
        ..
    } = record.result.as_ref().ok()?;
    let pose = Pose::new(stiffness);
    let mut values = [0.0; COUNT];
    for (value, measure) in values.iter_mut().zip(measured()) {
        *value = pose.measure(measure.rule, displacement)?;
    }
    Some(values)
}

/// Statistics of the measures over the poses of a job; its memory does not grow with their number.
#[derive(Debug, Default)]
pub struct Statistics {
    count: u64,
    of: [Spread; COUNT],
}

/// The values of one measure.
#[derive(Debug, Default)]
struct Spread {
    least: Option<Extreme>,
    most: Option<Extreme>,
    sum: f64,
    /// Counts of values by their logarithm over the resolution; `i32::MIN` is zero.
    counts: HashMap<i32, u64>,
}

/// A value and where it is.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Extreme {
    /// The value.
    pub value: f64,
    /// Row of the table, from 0.
    pub row: usize,
    /// Pose of the output.
    pub at: [Option<f64>; 6],
}

impl Statistics {
    /// Adds the pose of a row.
    pub fn add(&mut self, row: usize, at: &[Option<f64>; 6], values: &Values) {
        // No measure is a number that is not finite.
        if !values.iter().all(|value| value.is_finite()) {
            return;
        }
        self.count += 1;
        for (spread, value) in self.of.iter_mut().zip(values) {
            spread.add(Extreme {
                value: *value,
                row,
                at: *at,
            });
        }
    }

    /// Adds those of other rows of the same job, in any order: of equal extremes the first row's stays.
    pub fn merge(&mut self, other: &Self) {
        self.count += other.count;
        for (spread, other) in self.of.iter_mut().zip(&other.of) {
            spread.merge(other);
        }
    }

    /// The statistics as they are reported; `None` of no pose.
    pub fn report(&self) -> Option<Vec<MeasureReport>> {
        measured()
            .iter()
            .zip(&self.of)
            .map(|(measure, spread)| {
                Some(MeasureReport {
                    measure: measure.name,
                    words: measure.short,
                    unit: measure.unit,
                    poses: self.count,
                    min: spread.least?,
                    mean: spread.sum / self.count as f64,
                    percentiles: PERCENTILES.map(|p| Percentile {
                        percent: p,
                        value: spread.percentile(p, self.count),
                    }),
                    max: spread.most?,
                })
            })
            .collect()
    }
}

impl Spread {
    fn add(&mut self, found: Extreme) {
        if self.least.is_none_or(|least| found.value < least.value) {
            self.least = Some(found);
        }
        if self.most.is_none_or(|most| found.value > most.value) {
            self.most = Some(found);
        }
        self.sum += found.value;
        let bin = if found.value > 0.0 {
            (found.value.ln() / RESOLUTION).floor() as i32
        } else {
            i32::MIN
        };
        *self.counts.entry(bin).or_default() += 1;
    }

    fn merge(&mut self, other: &Self) {
        let earlier =
            |own: Extreme, found: Extreme| found.value == own.value && found.row < own.row;
        if let Some(found) = other.least
            && self
                .least
                .is_none_or(|own| found.value < own.value || earlier(own, found))
        {
            self.least = Some(found);
        }
        if let Some(found) = other.most
            && self
                .most
                .is_none_or(|own| found.value > own.value || earlier(own, found))
        {
            self.most = Some(found);
        }
        self.sum += other.sum;
        for (bin, count) in &other.counts {
            *self.counts.entry(*bin).or_default() += count;
        }
    }

    /// The value that this part of the poses does not exceed, to the resolution.
    fn percentile(&self, percent: f64, count: u64) -> f64 {
        let wanted = (percent / 100.0 * count as f64).ceil().max(1.0) as u64;
        let mut bins: Vec<_> = self.counts.iter().collect();
        bins.sort_unstable();
        let mut below = 0;
        for (bin, number) in bins {
            below += number;
            if below >= wanted {
                if *bin == i32::MIN {
                    return 0.0;
                }
                let middle = ((f64::from(*bin) + 0.5) * RESOLUTION).exp();
                let bounds = self.least.zip(self.most);
                return bounds.map_or(middle, |(least, most)| {
                    middle.clamp(least.value, most.value)
                });
            }
        }
        0.0
    }
}

/// What is told of one measure. Field names are those of the JSON file.
#[derive(Debug, Serialize)]
pub struct MeasureReport {
    /// Name of the measure.
    pub measure: &'static str,
    /// The same in words.
    #[serde(skip)]
    pub words: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Number of poses that have it.
    pub poses: u64,
    /// The least, and where.
    pub min: Extreme,
    /// Mean over the poses.
    pub mean: f64,
    /// The 5th, 50th and 95th percentile, to 0.1 %.
    pub percentiles: [Percentile; 3],
    /// The largest, and where.
    pub max: Extreme,
}

/// A value that a part of the poses does not exceed.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Percentile {
    /// Of the poses, in percent.
    pub percent: f64,
    /// Is not exceeded by so many.
    pub value: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_of_many_values_are_right_to_the_resolution() {
        let mut statistics = Statistics::default();
        let count = 10_000;
        for row in 0..count {
            // A shuffled 1..=10000, cubed.
            let value = f64::from((row * 7919) % count + 1).powi(3);
            statistics.add(row as usize, &[Some(f64::from(row)); 6], &[value; COUNT]);
        }
        let report = &statistics.report().unwrap()[4];
        assert_eq!((report.min.value, report.max.value), (1.0, 1e12));
        assert_eq!((report.min.row, report.min.at[0]), (0, Some(0.0)));
        for (found, expected) in report.percentiles.iter().zip([500.0_f64, 5000.0, 9500.0]) {
            assert!((found.value / expected.powi(3) - 1.0).abs() < RESOLUTION);
        }
        let n = f64::from(count);
        let mean = n * (n + 1.0) * (n + 1.0) / 4.0;
        assert!((report.mean / mean - 1.0).abs() < 1e-12);
    }

    #[test]
    fn parts_merge_to_the_whole() {
        let values = |row: usize| [f64::from(((row * 37) % 50) as u32); COUNT];
        let mut whole = Statistics::default();
        let mut parts = [(); 3].map(|()| Statistics::default());
        for row in 0..100 {
            whole.add(row, &[Some(row as f64); 6], &values(row));
            parts[row / 40].add(row, &[Some(row as f64); 6], &values(row));
        }
        let mut merged = Statistics::default();
        for part in [2, 0, 1] {
            merged.merge(&parts[part]);
        }
        let json = |found: &Statistics| serde_json::to_string(&found.report().unwrap()).unwrap();
        assert_eq!(json(&merged), json(&whole));
    }

    #[test]
    fn no_load_is_no_deflection() {
        let mut statistics = Statistics::default();
        statistics.add(0, &[Some(0.0); 6], &[0.0; COUNT]);
        let report = statistics.report().unwrap();
        assert_eq!(report[0].percentiles[1].value, 0.0);
        assert!(Statistics::default().report().is_none());
    }
}
