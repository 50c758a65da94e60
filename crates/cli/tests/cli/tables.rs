//! The tables of `hyperstat run`: CSV and Parquet hold the same doubles, and the number of threads
//! changes no byte. The reader is that of the library that writes them; `tests/read-back` reads such
//! files with Arrow's.

use std::fs::{self, File};

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use crate::support::{Bench, delta_batch};

/// Poses of the delta of which about a third are out of reach, here and there.
const MIXED: &str = "Grid(x: (-0.6, 0.6, 37), y: (-0.5, 0.5, 9), z: (0.3, 0.7, 5))";
const ROWS: usize = 37 * 9 * 5;

#[test]
fn the_number_of_threads_changes_no_byte() {
    let bench = Bench::new("tables-threads");
    bench.file("mixed.ron", &delta_batch("mixed", MIXED, ""));
    for format in ["csv", "parquet"] {
        let mut expected = Vec::new();
        for threads in ["1", "2", "3", "7", "0"] {
            let out = format!("{format}-{threads}");
            let arguments = [
                "run",
                "mixed.ron",
                "--out",
                &out,
                "--format",
                format,
                "--threads",
                threads,
            ];
            let outcome = bench.hyperstat(&arguments).ends_with(1);
            assert!(outcome.out().contains("unreachable"), "{}", outcome.out());
            let name = format!("mixed.{format}");
            assert_eq!(bench.results(&out), [name.as_str()]);
            let content = fs::read(bench.path(&out).join(name)).unwrap();
            if threads == "1" {
                expected = content;
            } else {
                assert!(content == expected, "{format}, {threads} threads");
            }
        }
        assert!(expected.len() > 100 * ROWS);
    }
}

#[test]
fn a_pose_is_the_same_alone_and_among_others() {
    let bench = Bench::new("tables-alone");
    bench.file("mixed.ron", &delta_batch("mixed", MIXED, ""));
    let run = |file: &str| {
        let arguments = ["run", file, "--out", "out"];
        assert!(bench.hyperstat(&arguments).status() < 2);
    };
    run("mixed.ron");
    let table = bench.read("out/mixed.csv");
    let lines: Vec<&str> = table.lines().skip(1).collect();
    assert_eq!(lines.len(), ROWS);
    // Neighbours on the edge of the reachable, at every place among them.
    let mut without = 0;
    for (row, line) in lines.iter().enumerate().skip(784).take(36).step_by(3) {
        let (number, rest) = line.split_once(',').unwrap();
        assert_eq!(number, row.to_string());
        let cells: Vec<&str> = rest.split(',').collect();
        without += usize::from(cells[6] != "ok");
        let pose = format!("List([({}, {}, {})])", cells[0], cells[1], cells[2]);
        bench.file("alone.ron", &delta_batch("alone", &pose, ""));
        run("alone.ron");
        let alone = bench.read("out/alone.csv");
        assert_eq!(alone.lines().nth(1), Some(format!("0,{rest}").as_str()));
    }
    assert!((1..12).contains(&without), "{without}");
}

#[test]
fn parquet_holds_the_doubles_of_the_csv() {
    let bench = Bench::new("tables-parquet");
    bench.file("mixed.ron", &delta_batch("mixed", MIXED, ""));
    for format in ["csv", "parquet"] {
        let arguments = ["run", "mixed.ron", "--out", "out", "--format", format];
        bench.hyperstat(&arguments).ends_with(1);
    }
    assert_eq!(bench.results("out"), ["mixed.csv", "mixed.parquet"]);
    let nulls = same_cells(&bench, "out/mixed", ROWS);
    let csv = bench.read("out/mixed.csv");
    let unreachable = csv.matches("unreachable").count();
    assert!(unreachable > ROWS / 10 && unreachable < ROWS / 2);
    assert_eq!(nulls, 27 * unreachable);
}

#[test]
fn parquet_holds_the_designs_and_what_varies() {
    let bench = Bench::new("tables-designs");
    let poses = "List([(0.0, 0.0, 0.45), (0.05, -0.02, 0.5), (0.0, 0.0, 5.0)])";
    let vary =
        r#"vary: { "rod.section.diameter": Range(0.01, 0.02, 70), "arm_length": [0.3, 0.31] }"#;
    bench.file("d.ron", &delta_batch("d", poses, vary));
    for format in ["csv", "parquet"] {
        let arguments = ["run", "d.ron", "--out", "out", "--format", format];
        bench.hyperstat(&arguments).ends_with(1);
    }
    let csv = bench.read("out/d.csv");
    let header = csv.lines().next().unwrap();
    assert!(header.contains(",k66,design,rod.section.diameter,arm_length"));
    let nulls = same_cells(&bench, "out/d", 3 * 140);
    assert_eq!(nulls, 27 * 140);
}

/// A pose of drives that is not reached has no coordinates: null. Its drives have columns of their own.
#[test]
fn parquet_holds_null_where_nothing_is_known() {
    let bench = Bench::new("tables-unknown");
    let examples = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    fs::copy(examples.join("five_bar.ron"), bench.path("five_bar.ron")).unwrap();
    bench.file("drives.csv", "A1.v,A2.v\n0,0\n-3.0,3.0\n0.1236,0.0147\n");
    bench.file(
        "d.ron",
        r#"(jobs: [(name: "d", mechanism: File("five_bar.ron"), poses: Drives(Csv("drives.csv")),
            vary: { "sections.rod.outer": [0.025, 0.026] })])"#,
    );
    for format in ["csv", "parquet"] {
        let arguments = ["run", "d.ron", "--out", "out", "--format", format];
        bench.hyperstat(&arguments).ends_with(1);
    }
    let header = bench.read("out/d.csv");
    let header = header.lines().next().unwrap();
    assert!(
        header.ends_with(",k66,A1.v,A2.v,design,sections.rod.outer"),
        "{header}"
    );
    // Six coordinates and what would have been found, of one pose of both designs.
    assert_eq!(same_cells(&bench, "out/d", 6), 2 * (6 + 27));
}

/// Compares a Parquet file with the CSV file beside it, cell by cell; returns the number of nulls.
fn same_cells(bench: &Bench, path: &str, count: usize) -> usize {
    let csv = bench.read(&format!("{path}.csv"));
    let mut lines = csv.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), count);

    let file = File::open(bench.path(&format!("{path}.parquet"))).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let schema = reader.metadata().file_metadata().schema_descr_ptr();
    let fields: Vec<&str> = schema.columns().iter().map(|c| c.name()).collect();
    assert_eq!(fields, names);
    let mut columns = vec![Vec::new(); names.len()];
    for row in reader.get_row_iter(None).unwrap() {
        for (column, (_, field)) in columns.iter_mut().zip(row.unwrap().get_column_iter()) {
            column.push(Cell::of(field));
        }
    }
    let mut nulls = 0;
    for (place, name) in names.iter().enumerate() {
        assert_eq!(columns[place].len(), count, "{name}");
        for (row, cell) in rows.iter().zip(&columns[place]) {
            let expected = match row[place] {
                "" => Cell::Null,
                text if *name == "status" => Cell::Text(text.into()),
                text if ["pose", "design"].contains(name) => Cell::Whole(text.parse().unwrap()),
                text => Cell::Double(text.parse::<f64>().unwrap().to_bits()),
            };
            nulls += usize::from(*cell == Cell::Null);
            assert_eq!(*cell, expected, "{name} of pose {}", row[0]);
        }
    }
    nulls
}

/// A value of a table; doubles as their bits.
#[derive(Debug, Clone, PartialEq)]
enum Cell {
    Null,
    Whole(i64),
    Double(u64),
    Text(String),
}

impl Cell {
    fn of(field: &Field) -> Self {
        match field {
            Field::Null => Self::Null,
            Field::Long(number) => Self::Whole(*number),
            Field::Double(number) => Self::Double(number.to_bits()),
            Field::Str(text) => Self::Text(text.clone()),
            other => panic!("{other:?}"),
        }
    }
}
