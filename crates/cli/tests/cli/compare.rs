//! `hyperstat compare` as a user meets it: two designs, two files, two tables, and what goes wrong.

use crate::support::{Bench, assert_near, delta_batch};

/// A bar of steel held at one end, of some diameter.
fn bar(diameter: &str) -> String {
    format!(
        r#"(
    name: "bar",
    materials: {{ "steel": (young: 2.1e11, poisson: 0.3, density: 7850.0) }},
    sections: {{ "rod": Circle(diameter: {diameter}) }},
    points: {{ "A": (0.0, 0.0, 0.0), "B": (0.5, 0.0, 0.0) }},
    bodies: {{ "bar": Beam(through: ["A", "B"], section: "rod", material: "steel") }},
    joints: {{ "wall": (at: "A", between: ("ground", "bar"), kind: Fixed) }},
    loads: [(on: ("bar", "B"), force: (0.0, 0.0, -100.0))],
    output: ("bar", "B"),
)
"#
    )
}

/// A delta whose rods vary, over some poses, of which one is out of reach.
fn study(diameters: &str, third: &str) -> String {
    let poses = format!("List([(0.0, 0.0, 0.5), (0.1, 0.05, 0.55), {third}])");
    let vary = format!("vary: {{ \"rod.section.diameter\": {diameters} }},");
    delta_batch("study", &poses, &vary)
}

const FAR: &str = "(2.0, 0.0, 0.5)";

#[test]
fn two_files_and_their_budgets() {
    let bench = Bench::new("compare-files");
    bench.file("thin.ron", &bar("0.02"));
    bench.file("thick.ron", &bar("\"22 mm\""));
    let told = bench.hyperstat(&["compare", "thin.ron", "thick.ron", "--out", "change"]);
    let text = told.ends_with(0).out().to_string();
    for part in [
        "A  thin.ron\nB  thick.ron\n",
        "bodies bar section.diameter  0.0200000 → 0.0220000",
        "k33 [N/m]",
        "By bodies and joints",
    ] {
        assert!(text.contains(part), "no {part:?} in\n{text}");
    }
    assert!(bench.read("change.svg").contains("thick.ron"));
    assert!(bench.path("change.png").exists());
    let arguments = ["compare", "thin.ron", "thick.ron", "--format", "json"];
    let report = bench.hyperstat(&arguments).ends_with(0).json();
    let stiffness = report["results"]["stiffness"].as_array().unwrap();
    let k33 = stiffness.iter().find(|pair| pair["name"] == "k33").unwrap();
    assert_near(k33["ratio"].as_f64().unwrap(), 1.1_f64.powi(4), 1e-12, 1.0);
    // Nothing of the two files was written to.
    assert_eq!(bench.read("thin.ron"), bar("0.02"));
    let same = bench
        .hyperstat(&["compare", "thin.ron", "thin.ron"])
        .ends_with(0)
        .out()
        .to_string();
    assert!(
        same.contains("Nothing.") && same.contains("The same of both."),
        "{same}"
    );
}

#[test]
fn two_designs_and_two_tables() {
    let bench = Bench::new("compare-designs");
    bench.file("study.ron", &study("[0.014, 0.018]", FAR));
    let told = bench.hyperstat(&["compare", "study.ron", "--with-design", "1"]);
    let text = told.ends_with(0).out().to_string();
    assert!(
        text.contains("rod.section.diameter  0.0140000 → 0.0180000"),
        "{text}"
    );
    assert!(
        text.contains("(6) section.diameter  0.0140000 → 0.0180000"),
        "{text}"
    );
    let first = study("[0.014]", FAR);
    let second = study("[0.018]", "(0.0, 0.1, 0.5)");
    for (name, text) in [("a", first), ("b", second)] {
        bench.file(&format!("{name}.ron"), &text);
        bench.hyperstat(&["run", &format!("{name}.ron"), "--out", name]);
    }
    let tables = ["compare", "a/study.csv", "b/study.csv", "--format", "json"];
    let found = bench.hyperstat(&tables).ends_with(0).json();
    // The third poses are others: rows go by number, and it is said how far they are apart.
    assert_eq!(found["matched"]["by"], "row");
    assert_near(found["matched"]["off"].as_f64().unwrap(), 2.0, 1e-12, 1.0);
    let changed = &found["statuses"].as_array().unwrap()[1];
    assert_eq!(changed["statuses"][0], "unreachable");
    assert_eq!(
        (
            &changed["statuses"][1],
            &changed["rows"],
            &changed["first_row"]
        ),
        (&"ok".into(), &1.into(), &2.into())
    );
    let columns = found["columns"].as_array().unwrap();
    let of = |name: &str| {
        columns
            .iter()
            .find(|column| column["column"] == name)
            .unwrap()
    };
    assert_eq!(
        (&of("k33")["rows"], &of("k33")["one_only"]),
        (&2.into(), &1.into())
    );
    assert!(of("k33")["ratio"]["least"].as_f64().unwrap() > 1.0);
    assert!(
        columns
            .iter()
            .any(|column| column["column"] == "pure_force_stiffness_min")
    );
    // The median of two ratios is halfway between them.
    let ratio = &of("k33")["ratio"];
    let [least, median, most] = ["least", "median", "most"].map(|of| ratio[of].as_f64().unwrap());
    assert!(least < most);
    assert_near(median, 0.5 * (least + most), 1e-12, most);
    // Rows of the same pose, wherever they stand.
    let lines: Vec<String> = bench
        .read("a/study.csv")
        .lines()
        .map(String::from)
        .collect();
    bench.file(
        "turned.csv",
        &[&lines[0], &lines[2], &lines[1]]
            .map(|line| format!("{line}\n"))
            .concat(),
    );
    let found = bench
        .hyperstat(&["compare", "turned.csv", "a/study.csv"])
        .ends_with(0)
        .out()
        .to_string();
    assert!(
        found.contains("2 rows of the same pose are compared."),
        "{found}"
    );
    assert!(found.contains("The same in all rows."), "{found}");
}

/// What chooses of the first has nothing to choose from where the other is a mechanism; a rotation is about an
/// axis; bars go into a folder by a name of their own.
#[test]
fn a_pose_of_a_job_beside_a_mechanism() {
    let bench = Bench::new("compare-kinds");
    bench.file("bar.ron", &bar("0.02"));
    bench.file("study.ron", &study("[0.014, 0.018]", FAR));
    std::fs::create_dir(bench.path("pictures")).unwrap();
    let told = bench.hyperstat(&[
        "compare",
        "study.ron",
        "bar.ron",
        "--pose",
        "1",
        "--along",
        "ry",
        "--out",
        "pictures",
    ]);
    let told = told.ends_with(0).out().to_string();
    assert!(
        told.contains("A  study, design 0, pose 1\nB  bar.ron\n"),
        "{told}"
    );
    assert!(told.contains("comes from, about y\n"), "{told}");
    assert_eq!(bench.names("pictures"), ["compare.png", "compare.svg"]);
    let wrong = ["compare", "study.ron", "bar.ron", "--with-pose", "1"];
    bench
        .hyperstat(&wrong)
        .ends_with(2)
        .says(&["bar.ron is a mechanism file"]);
}

#[test]
fn what_cannot_be_compared_says_so() {
    let bench = Bench::new("compare-errors");
    bench.file("bar.ron", &bar("0.02"));
    bench.file("study.ron", &study("[0.014, 0.018]", FAR));
    bench.hyperstat(&["run", "study.ron", "--out", "."]);
    let header = bench.read("study.csv").lines().next().map(String::from);
    bench.file("empty.csv", &(header.unwrap() + "\n"));
    for (arguments, parts) in [
        (
            vec!["empty.csv", "study.csv"],
            ["empty.csv has no rows", "run the batch again"],
        ),
        (
            vec!["bar.ron"],
            [
                "nothing is named that bar.ron is to be compared with",
                "give a second file",
            ],
        ),
        (
            vec!["bar.ron", "study.csv"],
            [
                "study.csv is a table, and bar.ron is none",
                "give two tables",
            ],
        ),
        (
            vec!["study.csv", "study.csv", "--along", "z"],
            [
                "`--along` is drawn of a mechanism",
                "give the mechanism file",
            ],
        ),
        (vec!["study.ron", "--with-pose", "9"], ["pose 9", "choose"]),
        (
            vec!["study.ron", "--with-pose", "2"],
            ["pose 2", "choose a pose in reach"],
        ),
        (
            vec!["bar.ron", "study.ron", "--case", "push"],
            ["no case `push`", "leave `--case` out"],
        ),
        (
            vec!["bar.ron", "bar.ron", "--out", "bar.ron.svg/x"],
            ["cannot write", "x.svg"],
        ),
    ] {
        let arguments = [vec!["compare"], arguments].concat();
        let outcome = bench.hyperstat(&arguments);
        let error = outcome.err();
        assert!(
            parts.iter().all(|part| error.contains(part)),
            "{arguments:?}:\n{error}"
        );
        assert!(
            outcome.status() == 2 || parts[0] == "cannot write",
            "{arguments:?}"
        );
    }
}
