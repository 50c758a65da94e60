//! Rows that no part has, as what is to be run again.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::part::Share;

/// What is to be run again, job by job.
#[derive(Debug, Default)]
pub struct Missing {
    /// Numbers of rows of the jobs, and the rows that are missing.
    jobs: Vec<(usize, Vec<Range<usize>>)>,
    /// How many parts are of so many shares.
    counts: BTreeMap<usize, usize>,
}

impl Missing {
    /// Adds a job of so many rows, of which these are missing, and the shares that its parts are.
    pub fn add(
        &mut self,
        of: usize,
        rows: Vec<Range<usize>>,
        shares: impl IntoIterator<Item = Share>,
    ) {
        self.jobs.push((of, rows));
        for share in shares {
            *self.counts.entry(share.count()).or_default() += 1;
        }
    }

    /// Whether nothing is missing.
    pub fn is_empty(&self) -> bool {
        self.jobs.iter().all(|(_, rows)| rows.is_empty())
    }

    /// How many rows are missing.
    pub fn rows(&self) -> usize {
        let rows = self.jobs.iter().flat_map(|(_, rows)| rows);
        rows.map(|rows| rows.len()).sum()
    }

    /// What to run again: shares where most of the parts are some, such as `--shard 3/10`, else rows, such as
    /// `--rows 1000..2000`.
    pub fn arguments(&self) -> Vec<String> {
        let most = self.counts.iter().max_by_key(|(_, parts)| **parts);
        let Some((&count, _)) = most else {
            let rows = self.jobs.iter().flat_map(|(_, rows)| rows);
            let rows: BTreeSet<(usize, usize)> = rows.map(|rows| (rows.start, rows.end)).collect();
            let rows = rows.into_iter();
            return rows
                .map(|(start, end)| format!("--rows {start}..{end}"))
                .collect();
        };
        let is_missing = |share: &Share| {
            self.jobs.iter().any(|(of, missing)| {
                let own = share.rows(*of);
                let mut missing = missing.iter();
                missing.any(|rows| rows.start < own.end && own.start < rows.end)
            })
        };
        let shares = (0..count).filter_map(|index| Share::new(index, count).ok());
        let shares = shares.filter(is_missing);
        shares.map(|share| format!("--shard {share}")).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{Missing, Share};

    #[test]
    fn what_is_missing_is_told_as_arguments() {
        let shares = |all: &[&str]| {
            all.iter()
                .map(|text| text.parse::<Share>().unwrap())
                .collect::<Vec<_>>()
        };
        let mut missing = Missing::default();
        missing.add(100, vec![], shares(&["0/4", "1/4", "2/4", "3/4"]));
        assert!(missing.is_empty() && missing.arguments().is_empty());
        missing.add(
            1000,
            vec![248..496, 900..901],
            shares(&["0/4", "2/4", "0/7"]),
        );
        assert_eq!(missing.arguments(), ["--shard 1/4", "--shard 3/4"]);
        assert_eq!(missing.rows(), 249);
        let mut missing = Missing::default();
        missing.add(100, vec![10..20, 90..100], []);
        missing.add(100, vec![10..20, 90..100], []);
        assert_eq!(missing.arguments(), ["--rows 10..20", "--rows 90..100"]);
    }
}
