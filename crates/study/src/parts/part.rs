//! Which rows of every job a run is asked for.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// Rows of every job that a run is asked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Part {
    /// All of them.
    Whole,
    /// One of so many shares.
    Share(Share),
    /// From one row to before another, of the jobs that have them.
    Rows(Range<usize>),
}

impl Part {
    /// Its rows of a job of so many.
    pub fn rows(&self, of: usize) -> Range<usize> {
        match self {
            Self::Whole => 0..of,
            Self::Share(share) => share.rows(of),
            Self::Rows(rows) => rows.start.min(of)..rows.end.min(of),
        }
    }

    /// The share, where it is one.
    pub(super) fn share(&self) -> Option<Share> {
        match self {
            Self::Share(share) => Some(*share),
            _ => None,
        }
    }
}

/// One of so many shares of a job's rows, from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Share {
    index: usize,
    count: usize,
}

/// Shares begin at a multiple of a power of two that is at most this part of a share,
const GRAIN: usize = 16;
/// and at most so many rows: those of a group of Parquet, so that no part has groups that are small.
const LARGEST_GRAIN: usize = 1 << 16;

impl Share {
    /// Share `index` of `count`, from 0.
    ///
    /// # Errors
    /// What would be right, where there is no such share.
    pub fn new(index: usize, count: usize) -> Result<Self, String> {
        match count.checked_sub(1) {
            None => Err("a run has at least one shard: `0/1` is all of it".into()),
            Some(last) if index > last => Err(format!(
                "shards are counted from 0: the last of {count} is `{last}/{count}`"
            )),
            Some(_) => Ok(Self { index, count }),
        }
    }

    /// Its number, from 0.
    pub fn index(self) -> usize {
        self.index
    }

    /// How many there are.
    pub fn count(self) -> usize {
        self.count
    }

    /// Its rows of a job of so many, which follow from these numbers alone.
    pub fn rows(self, of: usize) -> Range<usize> {
        let most = (of / self.count / GRAIN).min(LARGEST_GRAIN);
        let grain = most.checked_ilog2().map_or(1, |power| 1 << power);
        let bound = |index: usize| match index == self.count {
            true => of,
            false => {
                let row = of as u128 * index as u128 / self.count as u128;
                row as usize / grain * grain
            }
        };
        bound(self.index)..bound(self.index + 1)
    }

    /// The share that a task of one of Slurm's job arrays has, by the variables that Slurm sets.
    ///
    /// # Errors
    /// What is missing or wrong, and what would be right.
    pub fn of_slurm(variable: impl Fn(&str) -> Option<String>) -> Result<Self, String> {
        let number = |name: &str| {
            let name = format!("SLURM_ARRAY_TASK_{name}");
            let text = variable(&name).ok_or(format!(
                "{name} is not set: `auto` is for tasks of a job array (`sbatch --array=0-9`); elsewhere \
                 give `0/10`"
            ))?;
            let number = text.trim().parse::<usize>();
            number.map_err(|_| format!("{name} is `{text}`, which is no whole number"))
        };
        let (id, first, last) = (number("ID")?, number("MIN")?, number("MAX")?);
        let (step, count) = (number("STEP")?, number("COUNT")?);
        let one = match count {
            1 => "one task".into(),
            count => format!("{count} tasks"),
        };
        let irregular = format!(
            "an array of {one} from {first} to {last} in steps of {step} is not all of one range, such as \
             `--array=0-9`: tasks of an earlier array are run again by their shards, `--shard {id}/10` \
             where it had ten"
        );
        let is_range = step > 0
            && last.checked_sub(first).map(|span| span / step + 1) == Some(count)
            // One task alone of a larger array is not all of it.
            && (count > 1 || first <= 1);
        let place = id
            .checked_sub(first)
            .filter(|from| is_range && from % step == 0);
        let place = place.ok_or(irregular.clone())?;
        Self::new(place / step, count).map_err(|_| irregular)
    }
}

impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

impl FromStr for Share {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(index, count)| {
            let number = |text: &str| text.trim().parse().ok();
            Some((number(index)?, number(count)?))
        });
        let (index, count) = numbers.ok_or("give a shard and their number, such as `0/4`")?;
        Self::new(index, count)
    }
}

impl From<Share> for String {
    fn from(share: Share) -> Self {
        share.to_string()
    }
}

impl TryFrom<String> for Share {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

#[cfg(test)]
mod tests {
    use super::Share;

    #[test]
    fn shares_are_all_rows_once() {
        for of in [0, 1, 2, 7, 100, 12_345, 1_000_000, 1 << 40] {
            for count in [1, 2, 3, 10, 97] {
                let mut next = 0;
                for index in 0..count {
                    let rows = Share::new(index, count).unwrap().rows(of);
                    assert_eq!(rows.start, next);
                    assert!(rows.start <= rows.end);
                    let even = of as f64 / count as f64;
                    assert!(
                        (rows.len() as f64 - even).abs() <= 1.0 + even / 8.0,
                        "{of} {count}"
                    );
                    next = rows.end;
                }
                assert_eq!(next, of);
            }
        }
        assert_eq!(
            Share::new(1, 4).unwrap().rows(10_000_000),
            2_490_368..4_980_736
        );
    }

    #[test]
    fn wrong_shares_are_told_what_would_be_right() {
        for (text, told) in [
            ("5/4", "the last of 4 is `3/4`"),
            ("4/4", "the last of 4 is `3/4`"),
            ("0/0", "`0/1` is all of it"),
            ("1", "such as `0/4`"),
            ("-1/4", "such as `0/4`"),
            ("a/b", "such as `0/4`"),
        ] {
            let error = text.parse::<Share>().unwrap_err();
            assert!(error.contains(told), "{text}: {error}");
        }
        assert_eq!("3/4".parse::<Share>().unwrap().to_string(), "3/4");
    }

    #[test]
    fn slurms_variables_are_a_share() {
        let of = |variables: [&str; 5]| {
            let names = ["ID", "MIN", "MAX", "STEP", "COUNT"];
            Share::of_slurm(|name| {
                let place = names
                    .iter()
                    .position(|end| name.ends_with(&format!("_{end}")));
                let text = variables[place.unwrap()];
                (!text.is_empty()).then(|| text.to_string())
            })
        };
        let share = |variables| of(variables).unwrap().to_string();
        assert_eq!(share(["3", "0", "9", "1", "10"]), "3/10");
        assert_eq!(share(["7", "1", "9", "2", "5"]), "3/5");
        assert_eq!(share(["0", "0", "0", "1", "1"]), "0/1");
        assert_eq!(share(["1", "1", "1", "1", "1"]), "0/1");
        let again = "tasks of an earlier array are run again by their shards, `--shard 3/10`";
        for (variables, told) in [
            (["", "0", "9", "1", "10"], "SLURM_ARRAY_TASK_ID is not set"),
            (["3", "0", "", "1", "10"], "SLURM_ARRAY_TASK_MAX is not set"),
            (
                ["3", "0", "9", "1", "ten"],
                "`ten`, which is no whole number",
            ),
            (["4", "1", "9", "2", "5"], "such as `--array=0-9`"),
            (["30", "0", "9", "1", "10"], "such as `--array=0-9`"),
            (["3", "0", "9", "0", "10"], "such as `--array=0-9`"),
            // `--array=3,7`, `--array=3-5,7` and `--array=3`.
            (["3", "3", "7", "1", "2"], again),
            (["3", "3", "7", "1", "4"], "an array of 4 tasks from 3 to 7"),
            (
                ["3", "3", "3", "1", "1"],
                "an array of one task from 3 to 3",
            ),
            (["3", "7", "3", "1", "1"], "such as `--array=0-9`"),
        ] {
            let error = of(variables).unwrap_err();
            assert!(error.contains(told), "{variables:?}: {error}");
        }
    }
}
