//! Files in even lines: comments stay, values stay, and what is in order stays as it is.

use std::path::PathBuf;

use super::*;
use crate::text::tree::{Content, Node};

/// What a tree says, without the places.
fn said(text: &str) -> String {
    let source = Source::new(Path::new("f.ron"), text, &MemoryFiles::new());
    let tree = Node::of(Fragment::of_file(&source).unwrap());
    let mut words = String::new();
    tell(&tree, &mut words);
    words
}

fn tell(node: &Node, words: &mut String) {
    let all = |items: &[Node], words: &mut String| items.iter().for_each(|item| tell(item, words));
    *words += "<";
    match &node.content {
        Content::Tuple(items) => all(items, words),
        Content::List(items) => {
            *words += "list ";
            all(items, words);
        }
        Content::Map(named) | Content::Fields(named) => {
            for own in named.iter() {
                *words += &own.name;
                tell(&own.value, words);
            }
        }
        Content::Kind(_, inner) => {
            let text = node.text();
            *words += text.split(['(', ':']).next().unwrap_or("").trim();
            inner.iter().for_each(|inner| tell(inner, words));
        }
        // A mistake: as it is written, but for its lines.
        _ => words.extend(
            node.text()
                .chars()
                .filter(|c| !(c.is_whitespace() || *c == ',')),
        ),
    }
    *words += ">";
}

/// All files of the repository whose grammar is right.
fn files() -> Vec<(PathBuf, String)> {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let folders = [
        "examples",
        "examples/own-joints",
        "tests/reference",
        "crates/mechanisms/tests/broken",
        "crates/cli/help",
    ];
    let files = folders.iter().flat_map(|folder| {
        let entries = repository.join(folder).read_dir().unwrap();
        entries.map(|entry| entry.unwrap().path())
    });
    let files = files.filter(|path| path.extension().is_some_and(|e| e == "ron" || e == "json"));
    let read = files.filter_map(|path| Some((path.clone(), std::fs::read_to_string(path).ok()?)));
    read.filter(|(path, text)| format(text, path).is_ok())
        .collect()
}

#[test]
fn a_file_says_the_same_and_is_even_after_the_first_time() {
    let files = files();
    assert!(files.len() > 200, "{}", files.len());
    for (path, text) in files {
        let once = format(&text, &path).unwrap();
        let path = path.display();
        assert!(same(&text, &once), "{path}\n{once}");
        assert_eq!(said(&once), said(&text), "{path}\n{once}");
        assert_eq!(format(&once, Path::new("f")).unwrap(), once, "{path}");
        // Words go into the width as far as there is a bracket to break.
        let json =
            crate::text::as_json::as_json(&Source::new(Path::new("f"), &text, &MemoryFiles::new()));
        let even = laid_out(&json, true);
        assert_eq!(laid_out(&even, true), even, "{path}");
        assert!(same(&even, &json), "{path}\n{even}");
    }
}

#[test]
fn comments_stay_with_what_they_are_about() {
    let text = r#"#![enable(implicit_some)]
// Head.

// About the file.
( // behind the bracket
name:"x",/* one */ materials : { "m": (young: 2.1e11,// Pa
poisson:0.3) },


  // Two points.
  // Of three.

  points: {"A":(0.0,0.0,0.0), "B": (1.0, 0.0, 0.0) /* m */,
  "C": (2.0, 0.0, 0.0),}, joints /* odd */ : {},
  loads: [
    // none
  ]
  // tail
)
// End.
"#;
    let even = r#"#![enable(implicit_some)]
// Head.

// About the file.
( // behind the bracket
    name: "x",
    /* one */
    materials: {
        "m": (
            young: 2.1e11, // Pa
            poisson: 0.3,
        ),
    },

    // Two points.
    // Of three.

    points: {
        "A": (0.0, 0.0, 0.0), "B": (1.0, 0.0, 0.0), /* m */
        "C": (2.0, 0.0, 0.0),
    },
    /* odd */
    joints: {},
    loads: [
        // none
    ],
    // tail
)
// End.
"#;
    let found = format(text, Path::new("f.ron")).unwrap();
    assert_eq!(found, even, "\n{found}");
    assert_eq!(format(even, Path::new("f.ron")).unwrap(), even);
}

#[test]
fn long_lines_are_broken_at_brackets() {
    let text = r#"(name: "a", bodies: {"b": Beam(through: ["A", "B", "C", "D", "E", "F", "G"], section: "a section with a long name", material: "steel", y_axis: (1.0, 0.0, 0.0))}, poses: List([(0.1, 0.2, 0.3)]))"#;
    let even = r#"(
    name: "a",
    bodies: {
        "b": Beam(
            through: ["A", "B", "C", "D", "E", "F", "G"], section: "a section with a long name",
            material: "steel", y_axis: (1.0, 0.0, 0.0),
        ),
    },
    poses: List([(0.1, 0.2, 0.3)]),
)
"#;
    let found = format(text, Path::new("f.ron")).unwrap();
    assert_eq!(found, even, "\n{found}");
    let json = r#"{"bodies": {"b": {"Beam": {"through": ["A", "B"], "section": "a section with a long name", "material": "steel", "y_axis": [1.0, 0.0, 0.0]}}}}"#;
    let even = r#"{
    "bodies": {
        "b": { "Beam": {
            "through": ["A", "B"],
            "section": "a section with a long name",
            "material": "steel",
            "y_axis": [1.0, 0.0, 0.0]
        } }
    }
}
"#;
    let found = format(json, Path::new("f.json")).unwrap();
    assert_eq!(found, even, "\n{found}");
    assert_eq!(format(even, Path::new("f.json")).unwrap(), even);
}

#[test]
fn a_wrong_grammar_is_told() {
    let error = format("(a: 1", Path::new("f.ron")).unwrap_err();
    assert_eq!(
        error.to_string(),
        "f.ron:1:6: expected `,` or a closing bracket before this"
    );
}
