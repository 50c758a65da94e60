//! `hyperstat view` as a user meets it: a page that stands by itself, and what was read stays.

use serde_json::Value;

use crate::support::{Bench, delta_batch};

/// What stands in an element of a page.
fn data(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"hyperstat-data\">").unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn a_page_holds_text_and_results() {
    let bench = Bench::new("view");
    bench.file(
        "grid.ron",
        &delta_batch(
            "grid",
            "Grid(x: (-0.1, 0.1, 3), y: (0, 0, 1), z: (0.5, 0.5, 1))",
            "",
        ),
    );
    let told = bench.hyperstat(&["view", "grid.ron"]).ends_with(0);
    assert!(told.out().starts_with("grid.html"), "{}", told.out());
    let data = data(&bench.read("grid.html"));
    assert_eq!(data["load"]["pose"], 0);
    assert_eq!(data["load"]["job"], "grid");
    let solved = bench
        .hyperstat(&["solve", "grid.ron", "--format", "json"])
        .ends_with(0)
        .json();
    let answers = data["answers"].as_array().unwrap();
    // A program with the core in it writes none.
    if let Some(own) = answers
        .iter()
        .find(|own| own["request"] == serde_json::json!({ "ask": "solve" }))
    {
        assert_eq!(own["value"], solved);
        assert_eq!(data["poses"].as_array().unwrap().len(), 3);
        assert!(
            told.out().contains("worked out beforehand"),
            "{}",
            told.out()
        );
    }
    let again = bench.read("grid.html");
    bench
        .hyperstat(&["view", "grid.ron", "--pose", "0", "--out", "again.html"])
        .ends_with(0);
    assert_eq!(
        bench.read("again.html"),
        again,
        "the same file makes the same page"
    );
}

#[test]
fn what_was_read_stays_and_mistakes_have_their_place() {
    let bench = Bench::new("view-refused");
    let text = delta_batch("grid", "List([(9.0, 0.0, 0.5), (0.0, 0.0, 0.5)])", "");
    bench.file("grid.ron", &text);
    bench
        .hyperstat(&["view", "grid.ron", "--out", "grid.ron"])
        .ends_with(2)
        .says(&["grid.ron"]);
    assert_eq!(bench.read("grid.ron"), text);
    // The first pose is out of reach: the second is shown, but not where the first is asked for.
    bench.hyperstat(&["view", "grid.ron"]).ends_with(0);
    assert_eq!(data(&bench.read("grid.html"))["load"]["pose"], 1);
    bench
        .hyperstat(&["view", "grid.ron", "--pose", "0"])
        .ends_with(2)
        .says(&["pose 0"]);
    bench
        .hyperstat(&["view", "grid.ron", "--job", "map"])
        .ends_with(2)
        .says(&["holds no job `map`", "grid"]);
    bench.file("wrong.ron", &text.replace("jobs", "jops"));
    bench
        .hyperstat(&["view", "wrong.ron"])
        .ends_with(2)
        .says(&["wrong.ron:2:5", "unknown field `jops`"]);
    bench
        .hyperstat(&["view", "none.ron"])
        .ends_with(2)
        .says(&["none.ron"]);
}
