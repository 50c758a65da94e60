//! The documentation against the repository: links lead somewhere, examples are read by the real
//! loader, and what is quoted twice is the same.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Component, Path, PathBuf};

use hyperstat_mechanisms::{Input, Registry};

/// A Markdown file: its text, with code apart from prose.
struct Page {
    path: PathBuf,
    /// Lines outside code blocks, inline code removed.
    prose: Vec<String>,
    headings: Vec<String>,
    blocks: Vec<Block>,
}

/// A fenced code block.
struct Block {
    /// What stands behind the opening fence.
    info: String,
    /// Line of the opening fence, from 1.
    line: usize,
    /// The line of prose before it.
    before: String,
    text: String,
}

fn root() -> PathBuf {
    normal(&Path::new(env!("CARGO_MANIFEST_DIR")).join(".."))
}

/// `a/b/../c` as `a/c`, without asking the file system.
fn normal(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                out.pop();
            }
            Component::CurDir => {}
            other => out.push(other),
        }
    }
    out
}

impl Page {
    fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let mut page = Self {
            path: path.to_owned(),
            prose: Vec::new(),
            headings: Vec::new(),
            blocks: Vec::new(),
        };
        let mut open: Option<Block> = None;
        let mut before = String::new();
        for (k, line) in text.lines().enumerate() {
            let fence = line.trim_start().strip_prefix("```");
            match (&mut open, fence) {
                (None, Some(info)) => {
                    open = Some(Block {
                        info: info.trim().to_owned(),
                        line: k + 1,
                        before: std::mem::take(&mut before),
                        text: String::new(),
                    });
                }
                (None, None) => {
                    if !line.trim().is_empty() {
                        before = line.to_owned();
                    }
                    page.prose.push(without_code(line));
                    if line.starts_with('#') {
                        page.headings.push(line.to_owned());
                    }
                }
                (Some(_), Some(_)) => page.blocks.extend(open.take()),
                (Some(block), None) => {
                    block.text += line;
                    block.text += "\n";
                }
            }
        }
        assert!(
            open.is_none(),
            "{}: a code block is not closed",
            path.display()
        );
        page
    }

    /// Targets of all links and pictures.
    fn links(&self) -> Vec<&str> {
        let targets = self.prose.iter().flat_map(|line| line.split("](").skip(1));
        targets
            .filter_map(|rest| rest.split_once(')').map(|(target, _)| target))
            .collect()
    }

    /// Anchors of all headings, as Markdown viewers make them.
    fn anchors(&self) -> BTreeSet<String> {
        let anchor = |heading: &String| {
            let title = heading.trim_start_matches('#').trim().to_lowercase();
            let kept = title
                .chars()
                .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
            kept.map(|c| if c == ' ' { '-' } else { c }).collect()
        };
        self.headings.iter().map(anchor).collect()
    }

    fn place(&self, block: &Block) -> String {
        format!("{}:{}", self.path.display(), block.line)
    }
}

/// A line without its inline code, in which brackets mean nothing.
fn without_code(line: &str) -> String {
    let prose = line.split('`').step_by(2);
    prose.collect::<Vec<_>>().join("code")
}

/// All Markdown files under a folder.
fn markdown(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry
            .expect("an entry of a folder that was just opened")
            .path();
        if path.is_dir() {
            found.extend(markdown(&path));
        } else if path.extension().is_some_and(|e| e == "md") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The book, and the pages at the root.
fn pages() -> Vec<Page> {
    let root = root();
    let mut paths = markdown(&root.join("docs/src"));
    paths.extend(["README.md", "CONTRIBUTING.md", "CHANGELOG.md"].map(|name| root.join(name)));
    paths.extend(markdown(&root.join("crates")));
    paths.iter().map(|path| Page::read(path)).collect()
}

/// Where a relative link leads, and its anchor; `None` for a link out of the repository.
fn target(page: &Path, link: &str) -> Option<(PathBuf, Option<String>)> {
    if link.contains("://") {
        return None;
    }
    let (file, anchor) = match link.split_once('#') {
        Some((file, anchor)) => (file, Some(anchor.to_owned())),
        None => (link, None),
    };
    let path = if file.is_empty() {
        page.to_owned()
    } else {
        normal(&page.parent().unwrap_or(page).join(file))
    };
    Some((path, anchor))
}

#[test]
fn every_link_leads_somewhere() {
    let mut broken = Vec::new();
    let mut followed = 0;
    for page in pages() {
        for link in page.links() {
            let Some((path, anchor)) = target(&page.path, link) else {
                continue;
            };
            followed += 1;
            let found = path.exists()
                && anchor.is_none_or(|anchor| Page::read(&path).anchors().contains(&anchor));
            if !found {
                broken.push(format!("{}: {link}", page.path.display()));
            }
        }
    }
    assert!(followed > 50, "only {followed} links were found");
    assert!(broken.is_empty(), "broken links:\n{}", broken.join("\n"));
}

#[test]
fn the_summary_names_every_page_once() {
    let folder = root().join("docs/src");
    let summary = folder.join("SUMMARY.md");
    let mut named: Vec<PathBuf> = Page::read(&summary)
        .links()
        .iter()
        .filter_map(|link| target(&summary, link))
        .map(|(path, _)| path)
        .collect();
    named.sort();
    let mut pages = markdown(&folder);
    pages.retain(|page| *page != summary);
    assert_eq!(named, pages);
}

#[test]
fn every_ron_block_is_read_by_the_loader() {
    let registry = Registry::builtin();
    let mut read = 0;
    for page in pages() {
        for block in page.blocks.iter().filter(|b| b.info == "ron") {
            // Files that a block names are found beside the examples.
            let path = root().join("examples/block.ron");
            let place = page.place(block);
            let input = hyperstat_mechanisms::load_str(
                &block.text,
                &path,
                &hyperstat_mechanisms::Disk,
                &registry,
            )
            .unwrap_or_else(|error| panic!("{place}: {error}"));
            if let Input::Mechanism(mechanism) = &input {
                hyperstat_assembly::solve(&mechanism.model)
                    .unwrap_or_else(|error| panic!("{place}: {error}"));
            }
            if let Input::Batch(batch) = &input {
                for job in &batch.jobs {
                    job.model()
                        .unwrap_or_else(|error| panic!("{place}: {}: {error}", job.name));
                }
            }
            read += 1;
        }
    }
    assert!(read >= 4, "only {read} blocks were found");
}

#[test]
fn the_first_mechanism_is_the_same_everywhere() {
    let root = root();
    let example = fs::read_to_string(root.join("examples/portal.ron")).expect("the example");
    let example: String = example
        .lines()
        .filter(|line| !line.starts_with("//"))
        .map(|line| format!("{line}\n"))
        .collect();
    for name in ["README.md", "docs/src/tutorials/first-mechanism.md"] {
        let page = Page::read(&root.join(name));
        let block = page.blocks.iter().find(|b| b.info == "ron");
        let block = block.unwrap_or_else(|| panic!("{name} has no RON block"));
        assert_eq!(block.text, example, "{}", page.place(block));
    }
}

/// A block after a line that is a file's name, such as "`examples/own-joints/lever.ron`:", is that file.
/// Nothing is left to a program that puts files together: the pages are read as they are.
#[test]
fn quoted_files_are_the_files() {
    let root = root();
    // A path to a file; a folder stands before other blocks too.
    let is_file = |name: &str| name.contains('/') && !name.contains('`') && !name.ends_with('/');
    let mut quoted = 0;
    for page in pages() {
        for block in &page.blocks {
            let place = page.place(block);
            assert!(!block.text.contains("{{#"), "{place}: an instruction");
            let named = block.before.strip_prefix('`');
            let named = named.and_then(|rest| rest.strip_suffix("`:"));
            let Some(file) = named.filter(|name| is_file(name)) else {
                continue;
            };
            let text = fs::read_to_string(root.join(file));
            let text = text.unwrap_or_else(|error| panic!("{place}: {file}: {error}"));
            assert_eq!(block.text, text, "{place} is not {file}");
            quoted += 1;
        }
    }
    assert!(quoted >= 4, "only {quoted} files were found");
}

/// The built book holds `docs/src` and nothing else: a picture outside is not there.
#[test]
fn every_picture_of_the_book_lies_inside_it() {
    let book = root().join("docs/src");
    let mut pictures = 0;
    for path in markdown(&book) {
        let page = Page::read(&path);
        for link in page.links() {
            let Some((target, _)) = target(&page.path, link) else {
                continue;
            };
            if target.extension().is_some_and(|e| e == "md") {
                continue;
            }
            assert!(
                target.starts_with(&book) && target.is_file(),
                "{}: {link}",
                path.display()
            );
            pictures += 1;
        }
    }
    assert!(pictures >= 10, "only {pictures} pictures were found");
}

/// The sketches are what the program draws: `cargo run -p hyperstat-tests --example sketches`.
#[test]
fn the_sketches_are_drawn_from_the_source() {
    for (name, document) in hyperstat_tests::sketches::sketches() {
        let path = root().join("docs/src/images").join(name);
        let file = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(file == document, "{name} is not what the source draws");
    }
}

/// The tutorial's check by hand: the output turns by L/(E I) under a unit moment.
#[test]
fn the_first_mechanism_is_what_the_tutorial_says() {
    let path = root().join("examples/portal.ron");
    let mechanism = hyperstat_mechanisms::load_mechanism(
        &path,
        &hyperstat_mechanisms::Disk,
        &Registry::builtin(),
    )
    .unwrap_or_else(|error| panic!("{error}"));
    let solution = hyperstat_assembly::solve(&mechanism.model).expect("it is held");
    assert_eq!((solution.mobility, solution.overconstraint), (1, 0));
    let compliance = solution.output.compliance.expect("it has no free motion");
    let (length, inertia) = (
        0.3_f64.hypot(0.2),
        std::f64::consts::PI * 0.014_f64.powi(4) / 64.0,
    );
    let by_hand = length / (2.1e11 * inertia);
    // What `solve` promises after its refinement step.
    assert!((compliance[(3, 3)] / by_hand - 1.0).abs() < 1e-12);
}
