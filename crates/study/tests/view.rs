//! Pages to look at: whole documents that hold the text and what is asked of it, of every example.

use std::fs;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use hyperstat_study::{Disk, Registry, Selection, View};
use serde_json::Value;

/// What stands in an element of a page.
fn element<'p>(page: &'p str, id: &str) -> &'p str {
    let (_, rest) = page.split_once(&format!("id=\"{id}\">")).unwrap();
    rest.split_once("</script>").unwrap().0
}

#[test]
fn every_example_is_a_page() {
    let registry = Registry::builtin();
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    for entry in fs::read_dir(examples).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "ron") {
            continue;
        }
        let mut selection = Selection::default();
        if path.ends_with("paper.ron") {
            let refused = View::of_file(&path, &selection, &Disk, &registry).unwrap_err();
            assert_eq!(refused.code(), "job-not-chosen");
        }
        if let Err(error) = View::of_file(&path, &selection, &Disk, &registry) {
            // Which one is to be said, as of all commands.
            let help = error.help().unwrap();
            let first = help.trim_start_matches("its jobs are ").split(", ").next();
            selection.job = first.map(Into::into);
        }
        let view = View::of_file(&path, &selection, &Disk, &registry).unwrap();
        let page = view.html(&registry).unwrap();
        assert!(!page.contains("/*HYPERSTAT"), "{}", path.display());
        assert!(!page.contains("<title>hyperstat</title>"));
        let data: Value = serde_json::from_str(element(&page, "hyperstat-data")).unwrap();
        let name = path.file_name().unwrap().to_str().unwrap();
        assert_eq!(data["load"]["main"], name);
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(data["load"]["files"][name], text.as_str());
        if View::LIVE {
            assert!(element(&page, "hyperstat-core").len() > 100_000);
            continue;
        }
        let answers = data["answers"].as_array().unwrap();
        for ask in ["load", "scene", "frame", "solve", "values", "measures"] {
            let own = answers.iter().find(|own| own["request"]["ask"] == ask);
            assert!(own.is_some(), "{}: no {ask}", path.display());
        }
        assert_eq!(answers[0]["request"], data["load"]);
        for pose in data["poses"].as_array().unwrap() {
            let is_own = |own: &&Value| {
                own["request"]["ask"] == "frame" && own["request"]["pose"] == pose["pose"]
            };
            assert!(answers.iter().any(|own| is_own(&own)), "{pose}");
        }
        let scene = answers
            .iter()
            .find(|own| own["request"]["ask"] == "scene")
            .unwrap();
        let numbers = STANDARD.decode(scene["numbers"].as_str().unwrap()).unwrap();
        let count = scene["value"]["vertices"].as_u64().unwrap() as usize;
        assert!(numbers.len() >= 4 * 10 * count, "{}", path.display());
    }
}

#[test]
fn a_text_ends_no_element() {
    let text =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/portal.ron"))
            .unwrap();
    let text = format!("// </script><script>alert(1)</script>\n{text}");
    let view = View::of_text("a <b> & c", "portal.ron", text.as_str());
    let page = view.html(&Registry::builtin()).unwrap();
    assert!(page.contains("<title>a &lt;b> &amp; c – hyperstat</title>"));
    let data: Value = serde_json::from_str(element(&page, "hyperstat-data")).unwrap();
    assert_eq!(data["load"]["files"]["portal.ron"], text.as_str());
    let wrong = View::of_text("a", "a.ron", "(");
    if !View::LIVE {
        assert_eq!(
            wrong.html(&Registry::builtin()).unwrap_err().code(),
            "input"
        );
    }
}
