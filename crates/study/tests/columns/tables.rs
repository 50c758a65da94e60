//! Rows without a result, tables read back, messages, maps and summaries of columns on request.

use super::*;

#[test]
fn rows_without_a_result_are_empty_and_tables_read_back() {
    let text = begin("Delta").expect("a kind");
    let text = text.replace("z: (0.45, 0.55, 2)", "z: (0.45, 5.0, 2)");
    let mut job = loaded(job(&text));
    let all = "[Drives, DriveForces, Wrench(\"B1\"), Stress, Mass, Measures, Frequencies(count: 2), Budget]";
    job.set("columns", all).expect("columns");
    let columns = Columns::of(&job);
    let names: Vec<String> = table::columns(&columns).collect();
    let sweep = Sweep::new(&job, Way::Lanes).expect("a topology");
    let threads = Threads::new(2).expect("threads");
    let read = |format: TableFormat| {
        let mut writer = TableWriter::new(Vec::new(), format, &columns).expect("a table");
        let append = |chunk: &mut Chunk| writer.append(chunk);
        sweep
            .run(&threads, 0..sweep.len(), |_| {}, append)
            .expect("rows");
        let bytes = writer.finish().expect("a table");
        let path = format!("delta.{}", format.extension());
        (
            TableReader::of(Path::new(&path), bytes.clone()).expect("a table"),
            bytes,
        )
    };
    let (csv, _) = read(TableFormat::Csv);
    let (parquet, bytes) = read(TableFormat::Parquet);
    assert_eq!(csv.names(), &*names);
    assert_eq!(parquet.names(), &*names);
    let numeric = table::numeric(&columns);
    assert_eq!(
        names.len() - numeric.len(),
        1 + 3,
        "the status and three places of stresses"
    );
    let places: Vec<usize> = numeric
        .iter()
        .map(|name| csv.find(name).expect("a column"))
        .collect();
    let numbers = csv.read(&places).expect("numbers");
    assert_eq!(numbers, parquet.read(&places).expect("numbers"));
    assert_eq!(numbers[0].len(), 18);
    let first = numeric
        .iter()
        .position(|name| name == "A1.v.position")
        .expect("a drive");
    for column in &numbers[first..] {
        assert!(column[..9].iter().all(Option::is_some) && column[9..].iter().all(Option::is_none));
    }
    // Units and meanings of every column.
    let reader = SerializedFileReader::new(bytes::Bytes::from(bytes)).expect("a file");
    let described = reader
        .metadata()
        .file_metadata()
        .key_value_metadata()
        .expect("keys");
    let described = |key: &str| -> Value {
        let found = described.iter().find(|own| own.key == key).expect("a key");
        serde_json::from_str(found.value.as_deref().expect("a value")).expect("JSON")
    };
    let (units, meanings) = (described("units"), described("meanings"));
    assert_eq!(units.as_object().expect("an object").len(), names.len());
    for (name, unit) in [
        ("x", "m"),
        ("k14", "N/rad"),
        ("A2.v.position", "rad"),
        ("push.A2.v.force", "N·m"),
        ("turn.B1.fy", "N"),
        ("push.stress", "Pa"),
        ("mass", "kg"),
        ("pure_force_stiffness_min", "N/m"),
        ("push.rotation", "rad"),
        ("f2", "Hz"),
        ("budget.joint A1", ""),
    ] {
        assert_eq!(units[name], unit, "{name}");
        let words = meanings[name].as_str().expect("words");
        assert!(!words.is_empty());
    }
    assert_eq!(
        meanings["push.stress"],
        "largest von Mises stress, case push"
    );
}

#[test]
fn what_cannot_be_asked_for_is_told_with_what_would_be_right() {
    let refused = |job: &Job, columns: &str| {
        let error = job.clone().set("columns", columns).expect_err("an error");
        format!("{error}; {}", error.help().unwrap_or_default())
    };
    let delta = job(&begin("Delta").expect("a kind"));
    for (columns, told) in [
        (
            "[Wrench(\"D1\")]",
            "columns:1:9: the mechanism has no joint `D1`; the joints are",
        ),
        ("[Wrench(\"Ba11\")]", "did you mean `"),
        (
            "[Wrench]",
            "expected the name of a joint, `Wrench(\"B1\")`, found `Wrench`",
        ),
        (
            "[DriveForce]",
            "columns:1:2: unknown columns `DriveForce`; did you mean `DriveForces`?",
        ),
        (
            "[Mass, Stress, Mass]",
            "columns:1:16: the columns `Mass` are asked for twice; it stands in line 1",
        ),
        (
            "[Utilisation]",
            "no material of the mechanism has a yield strength; give the materials a `yield`",
        ),
        (
            "[Frequencies(count: 0)]",
            "expected a number of natural frequencies",
        ),
        (
            "[Frequencies(number: 3)]",
            "unknown field `number` of `Frequencies`",
        ),
        ("Stress", "expected a list of columns"),
    ] {
        let found = refused(&delta, columns);
        assert!(found.contains(told), "{columns}: {found}");
    }
    let mut with_modes = delta.clone();
    with_modes.set("modes", "3").expect("modes");
    assert!(refused(&with_modes, "[Frequencies(count: 2)]").contains("leave the number out here"));
    with_modes
        .set("columns", "[Frequencies, Mass]")
        .expect("columns");
    let further = Columns::of(&with_modes).further;
    assert_eq!(further, ["f1", "f2", "f3", "mass"]);
    // Without densities there is no mass, and the body is named.
    let text = begin("Delta")
        .expect("a kind")
        .replace(", density: 7850.0", "");
    let mut bare = job(&text);
    bare.set("columns", "[Mass]").expect("columns");
    let error = Sweep::new(&bare, Way::Lanes).expect_err("no density");
    assert_eq!(error.code(), "no-mass");
    // A name that is there already.
    let mut clash = job(&begin("Delta").expect("a kind"));
    clash
        .set("parameters", "{ \"stress\": 0.25 }")
        .expect_err("it is not used");
    let text = begin("Delta")
        .expect("a kind")
        .replace("base_radius: 0.25", "base_radius: \"= stress\"");
    let text = text.replacen(
        "name: \"delta\"",
        "name: \"delta\", parameters: { \"stress\": 0.25 }",
        1,
    );
    clash = job(&text);
    clash
        .set("vary", "{ \"stress\": [0.24, 0.25] }")
        .expect("a parameter");
    clash.set("columns", "[Mass, Stress]").expect("columns");
    let error = Sweep::new(&clash, Way::Lanes).expect_err("two columns");
    assert_eq!(
        error.to_string(),
        "the table would have two columns `stress`"
    );
    assert_eq!(error.location().expect("a place").column, 8);
    clash
        .set("vary", "{ \"parameters.stress\": [0.24, 0.25] }")
        .expect("a parameter");
    Sweep::new(&clash, Way::Lanes).expect("other names");
}

#[test]
fn maps_take_columns_on_request() {
    let mut job = prebuilt("Delta");
    let map = "[Map(value: \"stress\", plane: z(0.45))]";
    job.set("figures", map).expect("a figure");
    let check = |job: &Job| figure::check(job, &table::numeric(&Columns::of(job)));
    let error = check(&job).expect_err("no such column");
    let help = error.help().expect("a help");
    assert_eq!(help, "it needs `columns: [Stress]` in the job");
    job.set("columns", "[Stress]").expect("columns");
    check(&job).expect("a column");
}

/// Where a number is least and largest, in the drives of a table of drives; numbers below zero, too.
#[test]
fn summaries_have_the_columns_and_the_coordinates_that_are_commanded() {
    let grid = "Grid(x: (-0.1, 0.1, 2), y: (0.3, 0.4, 2))";
    let mut driven = job(&FIVE_BAR.replace(grid, "Drives(Csv(\"drives.csv\"))"));
    driven
        .set("columns", "[Drives, Measures, Stress]")
        .expect("columns");
    let (_, records) = found(&driven);
    let mut statistics = Statistics::of(&driven);
    for (row, record) in records.iter().enumerate() {
        if let Some(values) = measure(record) {
            statistics.add(row, &record.pose, &values);
        }
        statistics.add_asked(row, record);
    }
    let report = statistics.report_of(&driven).expect("poses");
    let of = |name: &str| {
        let mut all = report.iter().filter(|own| own.measure == name);
        let only = all.next().expect("a measure");
        assert!(all.next().is_none(), "{name} is told twice");
        only
    };
    let position = of("A1.v.position");
    assert_eq!((position.poses, position.unit), (3, "rad"));
    assert_eq!((position.min.row, position.max.row), (2, 1));
    assert_eq!(position.min.commanded.get("A1.v"), Some(&-0.2));
    assert_eq!(position.max.commanded.get("A2.v"), Some(&0.0147));
    let low = position.percentiles[0].value;
    assert!((low / -0.2 - 1.0).abs() < 1e-3, "{low}");
    let names = of("softest_force").max.commanded.iter();
    assert_eq!(
        names.map(|(name, _)| name).collect::<Vec<_>>(),
        ["A1.v", "A2.v"]
    );
    of("deflection");
    assert!(of("stress").max.value >= 0.0);
    assert!(!report.iter().any(|own| own.measure == "stress_at"));
}

/// A parameter that is called as a column of every table is no second column of that name.
#[test]
fn what_varies_has_a_name_of_its_own() {
    for (own, rest, refused) in [
        ("x", "", true),
        ("k33", "", true),
        ("design", "", true),
        ("dz", "", true),
        ("f1", "modes: 1,", true),
        ("f1", "", false),
        ("parameters.x", "", false),
    ] {
        let parameter = own.trim_start_matches("parameters.");
        let text = r#"(jobs: [(
            name: "own",
            parameters: { "NAME": 0.014 },
            mechanism: Delta(
                base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60, rod_spacing: 0.12,
                arm: (section: Circle(diameter: 0.03), material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),
                bar: (section: Circle(diameter: 0.02), material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),
                rod: (section: Circle(diameter: "= NAME"), material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),
            ),
            poses: List([(0.0, 0.0, 0.5)]),
            vary: { "OWN": [0.014, 0.016] },
            REST
        )])"#;
        let text = text
            .replace("NAME", parameter)
            .replace("OWN", own)
            .replace("REST", rest);
        match (Sweep::new(&job(&text), Way::Lanes), refused) {
            (Err(error), true) => {
                assert_eq!(error.code(), "same-column", "{own}: {error}");
                assert!(error.to_string().contains(&format!("`{own}`")), "{error}");
                assert!(error.help().unwrap().contains("parameters.…"));
            }
            (Ok(_), false) => {}
            (found, _) => panic!("{own}: {found:?}"),
        }
    }
}

/// A parameter has the unit that its values are written with, in the table and in what is drawn of it.
#[test]
fn what_varies_has_its_unit() {
    let text = begin("Delta").expect("a kind");
    let text = text.replacen(
        "force: (-20.0, 10.0, 100.0)",
        "force: (0, 0, \"= -push * n\")",
        1,
    );
    let text = text.replacen("base_radius: 0.25", "base_radius: \"= R\"", 1);
    let vary = "name: \"delta\", parameters: { \"R\": \"250 mm\", \"push\": 50, \"n\": 2 },
        vary: { \"R\": [0.25, 0.3], \"push\": [\"1 kN\"], \"n\": [1, 2] },";
    let job = job(&text.replacen("name: \"delta\",", vary, 1));
    let columns = Columns::of(&job);
    let writer = TableWriter::new(Vec::new(), TableFormat::Parquet, &columns).expect("a table");
    let bytes = writer.finish().expect("a table");
    let reader = SerializedFileReader::new(bytes::Bytes::from(bytes)).expect("a file");
    let metadata = reader.metadata().file_metadata();
    let mut notes = metadata.key_value_metadata().expect("keys").iter();
    let units = notes.find(|note| note.key == "units").expect("units");
    let units: Value =
        serde_json::from_str(units.value.as_deref().expect("a value")).expect("JSON");
    assert_eq!([&units["R"], &units["push"], &units["n"]], ["m", "N", ""]);
}
