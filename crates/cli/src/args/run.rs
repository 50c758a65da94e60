//! The options of `run` and `merge`.

use std::ops::Range;
use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, ValueEnum};
use hyperstat_study::parts::{Options, Share};
use hyperstat_study::table;

pub(super) const RUN_HELP: &str = concat!(
    "\
Writes DIR/<job>.csv, one row a pose in the order of the poses, with the columns
  pose,x,y,z,rx,ry,rz,status,dx,dy,dz,drx,dry,drz,k11,k12,...,k16,k22,...,k66
(pose of the output, its displacement, upper triangle of its stiffness), and the job's figures as
DIR/<job>-<figure>.svg and .png. `status` is `ok`, or says why there is no result:
  design         the varied values make no mechanism
  unreachable    the mechanism cannot take this pose
  singular       a part of the mechanism could take any of many places in this pose
  branch         a mechanism of a file reaches it in another assembly mode only
  unrestrained   something moves freely there, or a load works on a free motion
  rigid          the output is rigidly held in some direction: it has no finite stiffness; its
                 displacement stands in the row
  failed         the numbers could not be found
What is not known is empty, a coordinate that was not asked for too. Where the poses are values of
drives, they stand in columns after k66, named as in their table (A1.v).
A job that varies has the poses of each design in turn, and columns after k66: design, from 0, and
one for every path that varies, with its value. A job with `modes: N` has its natural frequencies
in columns f1, f2, ... [Hz] after k66.
A pose or a design without a result does not end the run; the exit status is then 1. Nor does a
closed standard output.
A file is put in place when it is complete, never half written. Nothing that was read is written to.
A run of more than 1e9 rows, or of more than 90 % of the free disk, asks first; where nobody can be
asked it needs --yes.

A run that is interrupted, by Ctrl-C, a signal, a power cut or a full disk, goes on where it was when the
same command is given again, and ends with the same bytes: what is done is kept every minute (--secure)
in DIR/parts. Where all is done already it says so, and nothing is computed. After a change of what is read, or of an
option that changes a byte, it says so and stops: --fresh begins anew.
With --shard 2/10 it is the third of ten parts of every job's rows, which `hyperstat merge DIR` joins.

With --format parquet the table is DIR/<job>.parquet: the same columns and the same numbers, null
where a pose has no result.

Examples:
  hyperstat run paper.ron --out results
  hyperstat run map.ron --out results --format parquet --threads 4
  hyperstat run map.ron --out results --summary
  hyperstat run map.ron --out results --dry-run
                                             How long it takes, how large it gets, how many shards
  hyperstat run map.ron --out results --shard 2/10
  hyperstat run map.ron --out results --shard auto
                                             In a job array of Slurm

A batch file, for the mechanism file of `hyperstat solve --help`:

",
    include_str!("../../help/batch.ron")
);

/// `hyperstat run`
#[derive(Debug, Args)]
pub(crate) struct Run {
    /// Batch file (RON or JSON)
    #[arg(value_name = "BATCH.ron")]
    pub(crate) file: PathBuf,
    /// Folder for the results; made where it is missing
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Form of the tables
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableFormat,
    /// Number of threads that solve, at most 8 a core; 0 is one a core. The results are the same with
    /// any number
    #[arg(
        long,
        value_name = "N",
        allow_negative_numbers = true,
        default_value_t = 0
    )]
    pub(crate) threads: usize,
    /// Write DIR/<job>-summary.json too, and print it: least, mean, percentiles, most of deflection
    /// and stiffness measures over all poses, and where
    #[arg(long)]
    pub(crate) summary: bool,
    /// Write the figures as PDF, too
    #[arg(long)]
    pub(crate) pdf: bool,
    /// Run without a question, however many rows and bytes it makes
    #[arg(long)]
    pub(crate) yes: bool,
    /// Solve every pose by itself with the method of the paper, refined, not eight at a time in SIMD
    /// lanes: the same to 1e-11, and slower
    #[arg(long)]
    pub(crate) one_by_one: bool,
    /// Compute a part of every job's rows into DIR/parts, the I-th of N (from 0), for `hyperstat merge`; `auto`
    /// takes the task of a Slurm job array
    #[arg(long, value_name = "I/N", value_parser = shard, allow_hyphen_values = true)]
    pub(crate) shard: Option<Shard>,
    /// The same of these rows of every job, from A to before B
    #[arg(long, value_name = "A..B", value_parser = rows, conflicts_with = "shard", allow_hyphen_values = true)]
    pub(crate) rows: Option<Range<usize>>,
    /// Begin anew: remove what is kept of these rows, of this run or another
    #[arg(long)]
    pub(crate) fresh: bool,
    /// Keep what is done every so many seconds
    #[arg(long, value_name = "SECONDS", value_parser = seconds, default_value = "60", allow_hyphen_values = true)]
    pub(crate) secure: Duration,
    /// Say how many rows it has, how long it takes and how large it gets, by solving some rows; write nothing
    #[arg(long)]
    pub(crate) dry_run: bool,
}

impl Run {
    /// What changes bytes of the results.
    pub(crate) fn options(&self) -> Options {
        Options {
            parquet: self.format == TableFormat::Parquet,
            summary: self.summary,
            pdf: self.pdf,
            one_by_one: self.one_by_one,
        }
    }
}

/// A shard that is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shard {
    /// That of a task of a job array.
    Auto,
    /// This one.
    Of(Share),
}

fn shard(text: &str) -> Result<Shard, String> {
    match text {
        "auto" => Ok(Shard::Auto),
        text => text.parse().map(Shard::Of),
    }
}

fn rows(text: &str) -> Result<Range<usize>, String> {
    let numbers = text.split_once("..").and_then(|(start, end)| {
        let number = |text: &str| text.trim().parse::<usize>().ok();
        Some((number(start)?, number(end)?))
    });
    match numbers.ok_or("give the first row and that after the last, such as `0..1000`")? {
        (start, end) if start == end => Err(format!(
            "there is no row in it: `{start}..{}` is row {start} alone",
            start.saturating_add(1)
        )),
        (start, end) if start > end => Err(format!(
            "it ends before it begins: did you mean `{end}..{start}`?"
        )),
        (start, end) => Ok(start..end),
    }
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text
        .parse()
        .ok()
        .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    seconds.ok_or("give a number of seconds that is not negative, such as `60`".into())
}

/// `hyperstat merge`
#[derive(Debug, Args)]
pub(crate) struct Merge {
    /// Folder of the results: the `--out` of the runs
    #[arg(value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Leave the parts as they are, Parquet files that are one dataset, and write no tables
    #[arg(long)]
    pub(crate) dataset: bool,
    /// Number of threads that draw figures, at most 8 a core; 0 is one a core
    #[arg(
        long,
        value_name = "N",
        allow_negative_numbers = true,
        default_value_t = 0
    )]
    pub(crate) threads: usize,
}

pub(super) const MERGE_HELP: &str = "\
Needs nothing but DIR: the parts hold the text of all that was read for them. Every part is checked: one
that is not whole, or of which a bit has changed, counts as missing. What is missing is printed on
standard output as arguments of `hyperstat run`, one a line, and the exit status is then 2.
The tables, summaries and figures are those of `hyperstat run BATCH --out DIR`, byte for byte. The parts
stay; DIR/parts may be removed afterwards.
With --dataset, of parts in Parquet, DIR/parts/<job> is read as one table by DuckDB, Polars and pyarrow;
summaries are written, figures are not.

Examples:
  hyperstat merge results
  hyperstat merge results --dataset
  hyperstat merge results | xargs -L 1 hyperstat run map.ron --out results
                                             Compute what is missing";

/// Form of a job's table.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum TableFormat {
    /// Comma-separated values, numbers that read back to the same double
    #[default]
    Csv,
    /// Apache Parquet: binary columns, smaller and faster
    Parquet,
}

impl From<TableFormat> for table::TableFormat {
    fn from(format: TableFormat) -> Self {
        match format {
            TableFormat::Csv => Self::Csv,
            TableFormat::Parquet => Self::Parquet,
        }
    }
}
