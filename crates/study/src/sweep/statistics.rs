//! What the stiffness is over a workspace, smallest, mean, percentiles, and where.

use std::collections::HashMap;
use std::sync::LazyLock;

use hyperstat_mechanisms::Job;
use serde::{Deserialize, Serialize};

use super::exact::ExactSum;
use super::record::{Cell, Found, Record};
use crate::entries::Entries;
use crate::measures::{self, Measure, Pose};
use crate::schema::{COORDINATES, Columns, holds_words, unit};

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

/// Statistics of the measures over the poses of a job; its memory does not grow with their number. Those of
/// parts of the rows merge to those of the whole, to the last bit.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Statistics {
    count: u64,
    of: [Spread; COUNT],
    asked: Vec<Asked>,
}

/// A column of numbers on request.
#[derive(Debug, Serialize, Deserialize)]
struct Asked {
    name: String,
    /// Its place among the further columns.
    place: usize,
    count: u64,
    of: Spread,
}

/// The values of one measure.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Spread {
    least: Option<Extreme>,
    most: Option<Extreme>,
    sum: ExactSum,
    /// Counts of values by [`bin`].
    #[serde(with = "bins")]
    counts: HashMap<i64, u64>,
}

/// Counts by bins as a list, in order.
mod bins {
    use std::collections::HashMap;

    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(super) fn serialize<S: Serializer>(
        counts: &HashMap<i64, u64>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let mut bins: Vec<_> = counts.iter().collect();
        bins.sort_unstable();
        bins.serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<HashMap<i64, u64>, D::Error> {
        let bins: Vec<(i64, u64)> = Vec::deserialize(deserializer)?;
        Ok(bins.into_iter().collect())
    }
}

/// The bin of a value: its logarithm over the resolution, the larger the larger the value; 0 is that of
/// zero.
fn bin(value: f64) -> i64 {
    let size = (value.abs().ln() / RESOLUTION).floor();
    match value {
        0.0 => 0,
        _ if value > 0.0 => MIDDLE + size as i64,
        _ => -(MIDDLE + size as i64),
    }
}

/// The value in the middle of a bin.
fn middle(bin: i64) -> f64 {
    let size = (((bin.abs() - MIDDLE) as f64 + 0.5) * RESOLUTION).exp();
    match bin {
        0 => 0.0,
        bin if bin > 0 => size,
        _ => -size,
    }
}

/// Bin of 1, above the size of any other's distance from it.
const MIDDLE: i64 = 1_000_000;

/// A value and where it is.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Extreme {
    /// The value.
    pub value: f64,
    /// Row of the table, from 0.
    pub row: usize,
    /// Pose of the output.
    pub at: [Option<f64>; 6],
    /// The coordinates that the job's poses give there, where these are known: of the output, or of drives.
    #[serde(skip_serializing_if = "Entries::is_empty", skip_deserializing)]
    pub commanded: Entries<f64>,
}

impl Statistics {
    /// Those of a job, of which no row is added yet, of its columns on request, too.
    pub fn of(job: &Job) -> Self {
        let columns = Columns::of(job);
        let first = columns.further.len() - columns.asked;
        let asked = columns.further.into_iter().enumerate().skip(first);
        // What is measured of every job is told once.
        let asked = asked.filter(|(_, name)| !holds_words(name) && !MEASURED.contains(&&**name));
        let asked = asked.map(|(place, name)| Asked {
            name,
            place,
            count: 0,
            of: Spread::default(),
        });
        Self {
            asked: asked.collect(),
            ..Self::default()
        }
    }

    /// Adds what stands in the columns on request of a row.
    pub fn add_asked(&mut self, row: usize, record: &Record) {
        let Some((_, further)) = record.known() else {
            return;
        };
        for asked in &mut self.asked {
            let number = further.get(asked.place).and_then(Cell::number);
            if let Some(value) = number.filter(|value| value.is_finite()) {
                asked.count += 1;
                asked.of.add(Extreme::new(value, row, &record.pose));
            }
        }
    }

    /// Adds the pose of a row.
    pub fn add(&mut self, row: usize, at: &[Option<f64>; 6], values: &Values) {
        // No measure is a number that is not finite.
        if !values.iter().all(|value| value.is_finite()) {
            return;
        }
        self.count += 1;
        for (spread, value) in self.of.iter_mut().zip(values) {
            spread.add(Extreme::new(*value, row, at));
        }
    }

    /// Adds those of other rows of the same job, in any order: of equal extremes the first row's stays.
    pub fn merge(&mut self, other: &Self) {
        self.count += other.count;
        for (spread, other) in self.of.iter_mut().zip(&other.of) {
            spread.merge(other);
        }
        for (own, other) in self.asked.iter_mut().zip(&other.asked) {
            own.count += other.count;
            own.of.merge(&other.of);
        }
    }

    /// The statistics as they are reported: of what is measured of every job, then of the columns on request
    /// that have a number in some row; `None` of no pose.
    pub fn report(&self) -> Option<Vec<MeasureReport>> {
        let measured = measured().iter().zip(&self.of);
        let measured = measured.map(|(measure, spread)| {
            let words = measure.short.into();
            spread.report(measure.name, words, measure.unit, self.count)
        });
        let mut all: Vec<MeasureReport> = measured.collect::<Option<_>>()?;
        all.extend(self.asked.iter().filter_map(|asked| {
            let name = &asked.name;
            asked.of.report(name, name.clone(), unit(name), asked.count)
        }));
        Some(all)
    }

    /// The same, with the coordinates that the poses of the job give.
    pub fn report_of(&self, job: &Job) -> Option<Vec<MeasureReport>> {
        let names: Vec<String> = job.commanded().into_iter().map(|c| c.name).collect();
        let mut all = self.report()?;
        for extreme in all.iter_mut().flat_map(|own| [&mut own.min, &mut own.max]) {
            let drives = job.drive_values(extreme.row % job.len());
            let value = |name: &String| match COORDINATES.iter().position(|own| own == name) {
                Some(place) => extreme.at[place],
                None => {
                    let place = job.drives().iter().position(|own| own == name)?;
                    drives.get(place).copied()
                }
            };
            let known = names
                .iter()
                .filter_map(|name| Some((name.clone(), value(name)?)));
            extreme.commanded = known.collect();
        }
        Some(all)
    }
}

impl Extreme {
    fn new(value: f64, row: usize, at: &[Option<f64>; 6]) -> Self {
        Self {
            value,
            row,
            at: *at,
            commanded: Entries(Vec::new()),
        }
    }
}

impl Spread {
    fn add(&mut self, found: Extreme) {
        self.sum.add(found.value);
        *self.counts.entry(bin(found.value)).or_default() += 1;
        let least = self.least.as_ref();
        let most = self.most.as_ref();
        let is_least = least.is_none_or(|least| found.value < least.value);
        let is_most = most.is_none_or(|most| found.value > most.value);
        if is_most && is_least {
            self.most = Some(found.clone());
            self.least = Some(found);
        } else if is_most {
            self.most = Some(found);
        } else if is_least {
            self.least = Some(found);
        }
    }

    /// What is told of so many values; `None` of none.
    fn report(
        &self,
        name: &str,
        words: String,
        unit: &'static str,
        count: u64,
    ) -> Option<MeasureReport> {
        Some(MeasureReport {
            measure: name.into(),
            words,
            unit,
            poses: count,
            min: self.least.clone()?,
            mean: self.sum.value() / count as f64,
            percentiles: PERCENTILES.map(|p| Percentile {
                percent: p,
                value: self.percentile(p, count),
            }),
            max: self.most.clone()?,
        })
    }

    fn merge(&mut self, other: &Self) {
        let earlier =
            |own: &Extreme, found: &Extreme| found.value == own.value && found.row < own.row;
        if let Some(found) = &other.least
            && (self.least.as_ref())
                .is_none_or(|own| found.value < own.value || earlier(own, found))
        {
            self.least = Some(found.clone());
        }
        if let Some(found) = &other.most
            && (self.most.as_ref()).is_none_or(|own| found.value > own.value || earlier(own, found))
        {
            self.most = Some(found.clone());
        }
        self.sum.merge(&other.sum);
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
                let middle = middle(*bin);
                let bounds = self.least.as_ref().zip(self.most.as_ref());
                return match bounds {
                    // Zero is exact.
                    Some((least, most)) if *bin != 0 => middle.clamp(least.value, most.value),
                    _ => middle,
                };
            }
        }
        0.0
    }
}

/// What is told of one measure. Field names are those of the JSON file.
#[derive(Debug, Serialize)]
pub struct MeasureReport {
    /// Name of the measure, or of the column on request.
    pub measure: String,
    /// The same in words.
    #[serde(skip)]
    pub words: String,
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
