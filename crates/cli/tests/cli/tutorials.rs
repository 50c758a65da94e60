//! The tutorials and the worked examples of the book, followed to the letter: their files saved,
//! their commands run, and their outputs found.

use std::path::{Path, PathBuf};

use crate::support::Bench;

/// A tutorial as it is followed.
struct Reader {
    bench: Bench,
    page: String,
    /// Name of the file that was last told to be saved.
    file: Option<String>,
    /// What the last commands said.
    said: String,
    /// Whether no block has shown it yet: the first one must.
    new: bool,
    /// Blocks of output that were found.
    shown: usize,
}

impl Reader {
    fn new(page: &str) -> Self {
        Self {
            bench: with_examples(&format!("book-{}", page.replace('/', "-"))),
            page: page.into(),
            file: None,
            said: String::new(),
            new: false,
            shown: 0,
        }
    }

    /// A line of prose: one that says `Save this as` names a file.
    fn prose(&mut self, line: &str) {
        if let Some(rest) = line.split("Save this as `").nth(1) {
            self.file = rest.split('`').next().map(String::from);
        }
    }

    fn block(&mut self, info: &str, text: &str) {
        match info {
            "ron" => {
                if let Some(name) = self.file.take() {
                    self.bench.file(&name, text);
                }
            }
            "sh" => {
                self.said.clear();
                self.new = true;
                for command in text.lines() {
                    let words: Vec<&str> = command.split_whitespace().collect();
                    let [program, arguments @ ..] = &*words else {
                        continue;
                    };
                    assert_eq!(*program, "hyperstat", "{}: {command}", self.page);
                    let outcome = self.bench.hyperstat(arguments);
                    assert!(outcome.status() < 2, "{command}:\n{}", outcome.err());
                    self.said += outcome.out();
                }
            }
            "text" => {
                let said = &self.said;
                let mut lines = said.lines().map(str::trim_end);
                // A later block may be no output at all: a calculation by hand.
                let first = text.lines().next().unwrap_or_default();
                if !self.new && !lines.clone().any(|line| line == first) {
                    return;
                }
                self.new = false;
                for line in text.lines().map(str::trim_end) {
                    let found = line.trim() == "…" || line.is_empty() || lines.any(|l| l == line);
                    assert!(
                        found,
                        "{}: `{line}` is not, or not there, in\n{said}",
                        self.page
                    );
                }
                self.shown += 1;
            }
            _ => {}
        }
    }
}

/// The root of the repository.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A folder with the files of `examples/`.
fn with_examples(name: &str) -> Bench {
    let bench = Bench::new(name);
    std::fs::create_dir(bench.path("examples")).unwrap();
    for entry in std::fs::read_dir(root().join("examples")).unwrap() {
        let entry = entry.unwrap();
        if entry.file_type().unwrap().is_file() {
            let name = entry.file_name().into_string().unwrap();
            std::fs::copy(entry.path(), bench.path(&format!("examples/{name}"))).unwrap();
        }
    }
    bench
}

/// Follows a page, and gives the folder it was followed in and how many outputs it shows.
fn follow(page: &str) -> (Bench, usize) {
    let path = root().join(format!("docs/src/{page}.md"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut reader = Reader::new(page);
    let mut block: Option<(String, String)> = None;
    for line in text.lines() {
        match (&mut block, line.strip_prefix("```")) {
            (None, Some(info)) => block = Some((info.into(), String::new())),
            (None, None) => reader.prose(line),
            (Some(_), Some(_)) => {
                if let Some((info, text)) = block.take() {
                    reader.block(&info, &text);
                }
            }
            (Some((_, text)), None) => {
                text.push_str(line);
                text.push('\n');
            }
        }
    }
    (reader.bench, reader.shown)
}

#[test]
fn my_first_mechanism() {
    let (_, shown) = follow("tutorials/first-mechanism");
    assert_eq!(shown, 2);
}

#[test]
fn a_stiffness_map_of_a_delta() {
    let (bench, shown) = follow("tutorials/stiffness-map");
    assert_eq!(shown, 2);
    let names = bench.results("out");
    for name in ["delta-map.csv", "delta-map-map.svg", "delta-map-map.png"] {
        assert!(names.iter().any(|n| n == name), "{name} in {names:?}");
    }
}

#[test]
fn what_should_i_make_thicker() {
    let (_, shown) = follow("tutorials/what-to-make-thicker");
    assert_eq!(shown, 3);
}

#[test]
fn a_machine_of_your_own() {
    let (bench, shown) = follow("tutorials/own-machine");
    assert_eq!(shown, 4);
    let file = bench.read("head.ron");
    assert!(file.lines().count() < 60);
    assert_eq!(file, bench.read("examples/head.ron"));
    assert!(bench.read("head.html").contains("Natural frequencies"));
    assert!(bench.path("out/head-map.svg").exists());
}

/// Pages with worked examples, and how many outputs they show.
#[test]
fn worked_examples() {
    for (page, outputs) in [
        ("theory/budget", 1),
        ("theory/closure", 1),
        ("theory/frequencies", 2),
        ("theory/measures", 2),
        ("theory/states", 2),
        ("theory/subassembly", 1),
    ] {
        let (_, shown) = follow(page);
        assert_eq!(shown, outputs, "{page}");
    }
}
