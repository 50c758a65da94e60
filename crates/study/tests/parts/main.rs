//! Runs in parts: whatever happens to them, and however they are divided, the same bytes come out.

mod memory;

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use hyperstat_study::parts::{
    Done, Missing, Options, Origin, Part, PartsError, Reading, Share, Work, hashes,
};
use hyperstat_study::sweep::{Sweep, Threads};
use hyperstat_study::{Batch, MemoryFiles, Registry};
use memory::{Fault, Memory};

/// 3 designs of 217 poses, of which some are out of reach: three chunks and a rest.
fn files(poses: &str) -> MemoryFiles {
    let mut table = String::from("x,y,z\n");
    for k in 0..217 {
        let x = -0.4 + 0.8 * f64::from(k * 89 % 217) / 216.0;
        table += &format!("{x},{},0.5\n", 0.001 * f64::from(k));
    }
    // Forces would make many rows take long.
    let columns = match poses.starts_with("Csv") {
        true => "columns: [DriveForces, Stress],",
        false => "",
    };
    let batch = format!(
        r#"(jobs: [(
            name: "map",
            mechanism: Delta(
                base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60, rod_spacing: 0.12,
                arm: (section: Circle(diameter: 0.030), material: (young: 2.1e11, poisson: 0.3)),
                bar: (section: Circle(diameter: 0.020), material: (young: 2.1e11, poisson: 0.3)),
                rod: (section: Circle(diameter: 0.014), material: (young: 2.1e11, poisson: 0.3)),
            ),
            poses: {poses},
            loads: [(on: ("platform", "P"), force: (3.0, 0.0, -30.0))],
            vary: {{ "rod.section.diameter": [0.014, 0.015, 0.016] }},
            {columns}
            figures: [Trajectory(scale: Auto)],
        )])"#
    );
    MemoryFiles::from_iter([("study/batch.ron", batch), ("study/poses.csv", table)])
}

fn options(parquet: bool) -> Options {
    Options {
        parquet,
        summary: true,
        pdf: false,
        one_by_one: false,
    }
}

/// A batch with all that was read for it.
struct Read {
    batch: Batch,
    origin: Origin,
}

impl Read {
    fn new(parquet: bool) -> Self {
        Self::of("Csv(\"poses.csv\")", parquet)
    }

    fn of(poses: &str, parquet: bool) -> Self {
        let reading = Reading::of(&files(poses));
        let path = Path::new("study/batch.ron");
        let batch = hyperstat_mechanisms::load_batch(path, &reading, &Registry::builtin()).unwrap();
        let origin = Origin::new(path, &batch, &reading, options(parquet));
        Self { batch, origin }
    }

    fn sweep(&self) -> Sweep<'_> {
        Sweep::new(&self.batch.jobs[0], self.origin.options().way()).unwrap()
    }

    /// Runs a part, keeping pieces as often as `secured_every` says.
    fn run(
        &self,
        shelf: &Memory,
        part: Part,
        threads: &Threads,
        secured_every: Duration,
    ) -> Result<Done, PartsError> {
        self.run_until(shelf, part, threads, secured_every, &|| false)
    }

    fn run_until(
        &self,
        shelf: &Memory,
        part: Part,
        threads: &Threads,
        secured_every: Duration,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Done, PartsError> {
        let sweep = self.sweep();
        let work = Work {
            shelf,
            origin: &self.origin,
            part,
            threads,
            secured_every,
            stop,
        };
        let found = work.look(&sweep, false)?;
        work.run(&sweep, found, &mut |_| {})
    }

    fn merge(&self, shelf: &Memory, dataset: bool) -> Result<Done, Vec<String>> {
        // From nothing but the folder.
        let told = |error: PartsError| vec![error.to_string()];
        let origin = Origin::read(shelf, &hashes(shelf).map_err(told)?).map_err(told)?;
        assert_eq!(origin, self.origin);
        let batch = origin.batch(&Registry::builtin()).unwrap();
        let sweep = Sweep::new(&batch.jobs[0], origin.options().way()).unwrap();
        let threads = Threads::new(1).unwrap();
        let work = Work {
            shelf,
            origin: &origin,
            part: Part::Whole,
            threads: &threads,
            secured_every: Duration::MAX,
            stop: &|| false,
        };
        let mut found = work.look(&sweep, false).map_err(told)?;
        if dataset {
            found = found.parts_alone();
        }
        let mut missing = Missing::default();
        found.missing(&mut missing);
        match missing.is_empty() {
            true => work.merge(&sweep, found, dataset).map_err(told),
            false => Err(missing.arguments()),
        }
    }

    /// All that is told of a run beside its table.
    fn told(&self, done: &Done) -> String {
        let job = &self.batch.jobs[0];
        let measures = serde_json::to_string(&done.ran.measures(job)).unwrap();
        let (warnings, summary) = (done.ran.warnings(job), &done.ran.summary);
        format!(
            "{measures}\n{warnings:?}\n{summary:?}\n{:?}",
            done.ran.trajectory
        )
    }
}

/// As many poses, of which nothing is asked that takes long.
const PLAIN: &str = "Grid(x: (-0.4, 0.4, 31), y: (0.0, 0.2, 7), z: (0.5, 0.5, 1))";

const AT_ONCE: Duration = Duration::MAX;
const EVERY_CHUNK: Duration = Duration::ZERO;

fn table(parquet: bool) -> &'static str {
    if parquet { "map.parquet" } else { "map.csv" }
}

fn shard(index: usize, count: usize) -> Part {
    Part::Share(Share::new(index, count).unwrap())
}

#[test]
fn a_run_at_once_and_one_in_pieces_leave_the_same() {
    let threads = Threads::new(2).unwrap();
    for parquet in [false, true] {
        let (read, shelf) = (Read::new(parquet), Memory::default());
        let done = read.run(&shelf, Part::Whole, &threads, AT_ONCE).unwrap();
        assert_eq!((done.done, done.computed), (651, 651));
        let names = shelf.names_of_all();
        assert_eq!(names.len(), 3, "{names:?}");
        let in_pieces = Memory::default();
        let pieces = read
            .run(&in_pieces, Part::Whole, &threads, EVERY_CHUNK)
            .unwrap();
        assert_eq!(read.told(&pieces), read.told(&done));
        assert_eq!(in_pieces.read(table(parquet)), shelf.read(table(parquet)));
        assert_eq!(in_pieces.names_of_all(), names);
        // That it is done is kept: it is not repeated, and ends as before.
        for (shelf, every) in [(&shelf, AT_ONCE), (&in_pieces, EVERY_CHUNK)] {
            let again = read.run(shelf, Part::Whole, &threads, every).unwrap();
            assert_eq!((again.computed, again.done), (0, 651));
            assert_eq!(read.told(&again), read.told(&done));
            assert_eq!(shelf.names_of_all(), names);
        }
        // A table that was changed is found out.
        in_pieces.files().get_mut(table(parquet)).unwrap()[1000] ^= 1;
        let again = read
            .run(&in_pieces, Part::Whole, &threads, AT_ONCE)
            .unwrap();
        assert_eq!(again.computed, 651);
        assert_eq!(in_pieces.read(table(parquet)), shelf.read(table(parquet)));
        assert_eq!(in_pieces.names_of_all(), names);
    }
}

#[test]
fn shards_in_any_order_are_the_whole() {
    let read = Read::of(PLAIN, false);
    let whole = Memory::default();
    let expected = read
        .run(&whole, Part::Whole, &Threads::new(3).unwrap(), AT_ONCE)
        .unwrap();
    for parquet in [false, true] {
        let read = Read::of(PLAIN, parquet);
        let undivided = Memory::default();
        let threads = [Threads::new(1).unwrap(), Threads::new(2).unwrap()];
        read.run(&undivided, Part::Whole, &threads[1], AT_ONCE)
            .unwrap();
        for (count, order) in [
            (1, vec![0]),
            (2, vec![1, 0]),
            (5, vec![3, 0, 4, 0, 2, 1, 3]),
            (97, (0..97).rev().collect()),
        ] {
            let shelf = Memory::default();
            for (turn, index) in order.into_iter().enumerate() {
                let secured = if turn % 2 == 0 { AT_ONCE } else { EVERY_CHUNK };
                read.run(&shelf, shard(index, count), &threads[turn % 2], secured)
                    .unwrap();
            }
            let merged = read.merge(&shelf, false).unwrap();
            assert_eq!(read.told(&merged), read.told(&expected), "{count}");
            assert_eq!(
                shelf.read(table(parquet)),
                undivided.read(table(parquet)),
                "{count}"
            );
            // Twice is no more than once, and a run finds nothing to compute.
            read.merge(&shelf, false).unwrap();
            let again = read.run(&shelf, Part::Whole, &threads[0], AT_ONCE).unwrap();
            assert_eq!(again.computed, 0);
            assert_eq!(shelf.read(table(parquet)), undivided.read(table(parquet)));
        }
    }
}

#[test]
fn shards_at_once_do_each_other_no_harm() {
    let read = Read::new(false);
    let undivided = Memory::default();
    let threads = Threads::new(1).unwrap();
    read.run(&undivided, Part::Whole, &threads, AT_ONCE)
        .unwrap();
    let shelf = Memory::default();
    std::thread::scope(|scope| {
        for index in [0, 0, 0, 1, 1, 2] {
            let (read, shelf) = (&read, &shelf);
            scope.spawn(move || {
                let threads = Threads::new(1).unwrap();
                read.run(shelf, shard(index, 3), &threads, EVERY_CHUNK)
                    .unwrap();
            });
        }
    });
    // What one took from the other is computed again.
    for index in 0..3 {
        read.run(&shelf, shard(index, 3), &threads, EVERY_CHUNK)
            .unwrap();
    }
    read.merge(&shelf, false).unwrap();
    assert_eq!(shelf.read("map.csv"), undivided.read("map.csv"));
}

#[test]
fn rows_and_shards_and_pieces_mix() {
    let read = Read::new(true);
    let threads = Threads::new(2).unwrap();
    let undivided = Memory::default();
    read.run(&undivided, Part::Whole, &threads, AT_ONCE)
        .unwrap();
    let shelf = Memory::default();
    read.run(&shelf, Part::Rows(100..300), &threads, AT_ONCE)
        .unwrap();
    read.run(&shelf, Part::Rows(150..200), &threads, AT_ONCE)
        .unwrap();
    assert_eq!(
        read.merge(&shelf, false).unwrap_err(),
        ["--rows 0..100", "--rows 300..651"]
    );
    read.run(&shelf, shard(3, 4), &threads, AT_ONCE).unwrap();
    assert_eq!(
        read.merge(&shelf, false).unwrap_err(),
        ["--shard 0/4", "--shard 1/4", "--shard 2/4"]
    );
    // A run of all rows takes what is there.
    let done = read.run(&shelf, Part::Whole, &threads, AT_ONCE).unwrap();
    assert!(done.computed < 651 - 200 - 100, "{}", done.computed);
    assert_eq!(shelf.read("map.parquet"), undivided.read("map.parquet"));
}

#[test]
fn a_run_that_is_stopped_goes_on() {
    let read = Read::new(false);
    let threads = Threads::new(2).unwrap();
    let undivided = Memory::default();
    let expected = read
        .run(&undivided, Part::Whole, &threads, AT_ONCE)
        .unwrap();
    for asked in [0, 1, 5, 20, 40, 60, 80] {
        let shelf = Memory::default();
        let left = AtomicUsize::new(asked);
        let stop = || {
            left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| {
                left.checked_sub(1)
            })
            .is_err()
        };
        let stopped = read
            .run_until(&shelf, Part::Whole, &threads, AT_ONCE, &stop)
            .unwrap();
        assert!(stopped.is_stopped() && stopped.done == stopped.computed);
        let again = read.run(&shelf, Part::Whole, &threads, AT_ONCE).unwrap();
        assert_eq!(again.computed, 651 - stopped.done);
        assert_eq!(shelf.read("map.csv"), undivided.read("map.csv"));
        assert_eq!(read.told(&again), read.told(&expected));
        assert!(
            !shelf
                .names_of_all()
                .iter()
                .any(|name| name.ends_with(".csv") && name != "map.csv")
        );
    }
}

/// Every write, every name that is given and every file that is removed fails once; the run that follows ends
/// with the same files.
#[test]
fn whatever_fails_the_next_run_leaves_the_same_bytes() {
    let threads = Threads::new(1).unwrap();
    for (parquet, part) in [
        (false, Part::Whole),
        (true, Part::Whole),
        (false, shard(1, 2)),
        (true, shard(1, 2)),
    ] {
        let read = Read::of(PLAIN, parquet);
        let sound = Memory::default();
        let expected = read
            .run(&sound, part.clone(), &threads, EVERY_CHUNK)
            .unwrap();
        let steps = sound.steps();
        assert!(steps > 20, "{steps}");
        for fault in [Fault::Once, Fault::Dead] {
            for step in 0..steps {
                let failing = Memory::default().failing_at(step, fault);
                let ended = read.run(&failing, part.clone(), &threads, EVERY_CHUNK);
                if let Err(error) = &ended {
                    let message = error.to_string();
                    assert!(message.contains("cannot "), "{message}");
                }
                let next = failing.sound();
                let done = read
                    .run(&next, part.clone(), &threads, EVERY_CHUNK)
                    .unwrap();
                assert_eq!(read.told(&done), read.told(&expected), "{fault:?} {step}");
                let (own, other) = (next.files().clone(), sound.files().clone());
                let names = |of: &std::collections::BTreeMap<String, Vec<u8>>| {
                    of.keys().cloned().collect::<Vec<_>>()
                };
                assert_eq!(names(&own), names(&other), "{fault:?} {step}");
                assert!(own == other, "{fault:?} {step} {part:?}");
            }
        }
    }
}

#[test]
fn what_is_lost_cut_or_flipped_is_told() {
    let read = Read::new(true);
    let threads = Threads::new(2).unwrap();
    let shelf = Memory::default();
    for index in 0..4 {
        read.run(&shelf, shard(index, 4), &threads, AT_ONCE)
            .unwrap();
    }
    let merged = read.merge(&shelf, false).unwrap();
    let whole = shelf.read("map.parquet");
    let second = Share::new(1, 4).unwrap().rows(651);
    let stem = format!("{:012}-{:012}", second.start, second.end);
    let names = [
        format!("parts/map/{stem}.parquet"),
        format!("parts/map/_{stem}.json"),
    ];
    for name in &names {
        let content = shelf.read(name);
        let mut spoilt = vec![None, Some(Vec::new())];
        for at in (0..content.len()).step_by(content.len() / 37) {
            spoilt.push(Some(content[..at].to_vec()));
            let mut flipped = content.clone();
            flipped[at] ^= 1 << (at % 8);
            spoilt.push(Some(flipped));
        }
        for other in spoilt {
            let broken = shelf.sound();
            broken.files().remove("map.parquet");
            match other {
                Some(other) => broken.files().insert(name.clone(), other),
                None => broken.files().remove(name),
            };
            assert_eq!(read.merge(&broken, false).unwrap_err(), ["--shard 1/4"]);
            assert!(!broken.files().contains_key("map.parquet"));
            read.run(&broken, shard(1, 4), &threads, AT_ONCE).unwrap();
            let again = read.merge(&broken, false).unwrap();
            assert_eq!(read.told(&again), read.told(&merged));
            assert_eq!(broken.read("map.parquet"), whole);
        }
    }
    // What was read is checked, too, and written again by any part.
    let origin = shelf
        .names_of_all()
        .into_iter()
        .find(|name| name.contains("_run-"))
        .unwrap();
    for (bit, is_done) in [(0, false), (100, false), (0, true), (100, true)] {
        let broken = shelf.sound();
        broken.files().get_mut(&origin).unwrap()[bit] ^= 4;
        let told = read.merge(&broken, false).unwrap_err();
        assert!(told[0].contains("cannot be used"), "{told:?}");
        if !is_done {
            broken.files().remove(&names[0]);
        }
        read.run(&broken, shard(1, 4), &threads, AT_ONCE).unwrap();
        read.merge(&broken, false).unwrap();
    }
}

#[test]
fn runs_are_not_mixed() {
    let (read, other) = (Read::new(false), Read::new(true));
    let threads = Threads::new(1).unwrap();
    let shelf = Memory::default();
    read.run(&shelf, shard(0, 2), &threads, AT_ONCE).unwrap();
    let refused = other
        .run(&shelf, shard(1, 2), &threads, AT_ONCE)
        .unwrap_err();
    let message = format!("{refused}; {}", refused.help().unwrap());
    assert!(
        message.contains("it was without `--format parquet`"),
        "{message}"
    );
    assert!(message.contains("--fresh"), "{message}");
    let moved = Read::of("List([(0.0, 0.0, 0.5), (0.1, 0.0, 0.5)])", false);
    let refused = moved
        .run(&shelf, Part::Whole, &threads, AT_ONCE)
        .unwrap_err();
    let message = refused.to_string();
    assert!(
        message.contains("batch.ron was another then, it read poses.csv"),
        "{message}"
    );
    // One that another version began is not gone on with.
    let text =
        String::from_utf8(shelf.read(&format!("parts/_run-{}.json", &read.origin.hash()[..16])));
    let text = text.unwrap();
    let (version, rest) = text.split_once(",\"options\"").unwrap();
    assert!(
        version.starts_with(concat!("{\"hyperstat\":\"", env!("CARGO_PKG_VERSION"), "+")),
        "{version}"
    );
    let older = format!("{{\"hyperstat\":\"0.0.9\",\"options\"{rest}");
    let hash = blake3::hash(older.as_bytes()).to_hex().to_string();
    let old = Memory::default();
    let name = format!("parts/_run-{}.json", &hash[..16]);
    old.files().insert(name, older.into_bytes());
    let refused = Origin::read(&old, &hash).unwrap_err();
    let message = format!("{refused}; {}", refused.help().unwrap());
    assert!(
        message.contains("are of hyperstat 0.0.9")
            && message.contains("go on with hyperstat 0.0.9"),
        "{message}"
    );
    // Two that somebody has put into one folder.
    let second = Memory::default();
    other.run(&second, shard(1, 2), &threads, AT_ONCE).unwrap();
    shelf.files().extend(second.files().clone());
    let told = read.merge(&shelf, false).unwrap_err();
    assert!(told[0].contains("different runs"), "{told:?}");
    assert!(matches!(
        hashes(&Memory::default()),
        Err(PartsError::Nothing)
    ));
}

#[test]
fn a_dataset_has_every_row_once() {
    let read = Read::new(true);
    let threads = Threads::new(2).unwrap();
    let shelf = Memory::default();
    for index in 0..3 {
        read.run(&shelf, shard(index, 3), &threads, EVERY_CHUNK)
            .unwrap();
    }
    let before = shelf.names_of_all();
    let merged = read.merge(&shelf, true).unwrap();
    assert_eq!(shelf.names_of_all(), before);
    let undivided = read
        .run(&Memory::default(), Part::Whole, &threads, AT_ONCE)
        .unwrap();
    assert_eq!(read.told(&merged), read.told(&undivided));
    read.run(&shelf, Part::Rows(10..20), &threads, AT_ONCE)
        .unwrap();
    let told = read.merge(&shelf, true).unwrap_err();
    assert!(
        told[0].contains("000000000010-000000000020.parquet has rows"),
        "{told:?}"
    );
}

/// Groups of the whole table, wherever parts begin.
#[test]
fn large_tables_of_parquet_join_to_the_same_bytes() {
    let read = Read::of(
        "Grid(x: (-0.3, 0.3, 250), y: (-0.3, 0.3, 200), z: (0.5, 0.5, 1))",
        true,
    );
    let threads = Threads::new(0).unwrap();
    let undivided = Memory::default();
    read.run(&undivided, Part::Whole, &threads, AT_ONCE)
        .unwrap();
    for parts in [
        vec![0..65_536, 65_536..131_072, 131_072..150_000],
        vec![0..70_000, 70_000..150_000],
    ] {
        let shelf = Memory::default();
        for rows in parts {
            read.run(&shelf, Part::Rows(rows), &threads, AT_ONCE)
                .unwrap();
        }
        read.merge(&shelf, false).unwrap();
        assert!(shelf.read("map.parquet") == undivided.read("map.parquet"));
    }
}
