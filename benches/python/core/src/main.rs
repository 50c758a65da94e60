//! The same sweep and single poses as `benches/python/sweep.py`, from Rust: for every line `sweep` or `at` of its
//! input it prints the seconds that one took, of the clock and of the processor.

use std::error::Error;
use std::io::{BufRead, stdin};
use std::path::Path;
use std::time::Instant;

use hyperstat_study::sweep::{Chunk, Sweep, Threads, Way};
use hyperstat_study::{Disk, Input, JobPoses, Registry, Selection, Study, Target, load};

/// Single poses that are measured together.
const SINGLE: usize = 2000;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut argument = || arguments.next().ok_or("core FILE JOB COUNT");
    let (path, name) = (argument()?, argument()?);
    let count: usize = argument()?.parse()?;
    let path = Path::new(&path);
    let Input::Batch(batch) = load(path, &Disk, &Registry::builtin())? else {
        return Err("a batch is needed".into());
    };
    let selection = Selection {
        job: Some(name),
        ..Selection::default()
    };
    let mut job = selection.job_of(batch, path)?;
    let rows: Vec<f64> = (0..count).flat_map(pose).collect();
    let columns = ["x", "y", "z"].map(String::from).to_vec();
    job.set_poses(JobPoses::Table { columns, rows })?;
    let threads = Threads::new(1)?;
    let mut poser = Study::of_job(job.clone(), 0, 0)?.poser()?;
    for line in stdin().lock().lines() {
        let (begun, used) = (Instant::now(), processor());
        let mut sum = 0.0;
        match line?.trim() {
            // From the job to the results, as a call from Python has it.
            "sweep" => {
                let sweep = Sweep::new(&job, Way::Lanes)?;
                let keep = |chunk: &mut Chunk| {
                    for record in &chunk.records {
                        sum += record
                            .result
                            .as_ref()
                            .map_or(f64::NAN, |own| own.stiffness[(0, 0)]);
                    }
                    Ok::<(), Box<dyn Error>>(())
                };
                sweep.run(&threads, 0..job.len(), |_| (), keep)?;
            }
            _ => {
                for k in 0..SINGLE {
                    let [x, y, z] = pose(k);
                    let asked = [Some(x), Some(y), Some(z), None, None, None];
                    let record = poser.at(&Target::Output(asked));
                    sum += record.result.map_or(f64::NAN, |own| own.stiffness[(0, 0)]);
                }
            }
        }
        println!(
            "{} {} {sum}",
            begun.elapsed().as_secs_f64(),
            processor() - used
        );
    }
    Ok(())
}

/// The poses: `sweep.py` has the same.
fn pose(k: usize) -> [f64; 3] {
    let share = |k: usize, of: usize| (k % of) as f64 / (of - 1) as f64;
    [
        -0.15 + 0.3 * share(k, 50),
        -0.15 + 0.3 * share(k / 50, 50),
        0.45 + 0.1 * share(k / 2500, 40),
    ]
}

/// Seconds of the processor that this process has used; 0 where the system does not tell.
fn processor() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let ticks = stat.rsplit(')').next().unwrap_or_default();
    let ticks = ticks.split_whitespace().skip(11).take(2);
    ticks.filter_map(|own| own.parse::<f64>().ok()).sum::<f64>() / 100.0
}
