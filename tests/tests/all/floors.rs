//! The house stands on its floors: within a crate no folder imports one that stands above it in the
//! order of the book's page *Architecture*, and no circle of files is larger than three.
//!
//! Imports are read from the sources: `use` and paths that begin with `crate`, `super` or a module
//! of their own. A name that a module hands on (`pub use`) counts as of the file where it is defined.
//! Tests are no rooms.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use syn::visit::{self, Visit};

/// The largest circle of files.
const CIRCLE: usize = 3;

type Module = Vec<String>;

/// A crate's sources.
struct House {
    files: BTreeMap<Module, syn::File>,
    /// Names that a module hands on, and where each comes from.
    handed_on: BTreeMap<(Module, String), (Module, String)>,
}

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Whether something stands in the sources for tests only.
fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("cfg")
            && attribute.parse_args::<syn::Meta>().is_ok_and(needs_test)
    })
}

/// Whether a condition holds in tests only: `test`, `all(test, unix)`.
fn needs_test(condition: syn::Meta) -> bool {
    match condition {
        syn::Meta::Path(path) => path.is_ident("test"),
        syn::Meta::List(list) if list.path.is_ident("all") => {
            type Conditions = syn::punctuated::Punctuated<syn::Meta, syn::Token![,]>;
            let all = list.parse_args_with(Conditions::parse_terminated);
            all.is_ok_and(|all| all.into_iter().any(needs_test))
        }
        _ => false,
    }
}

impl House {
    fn read(source: &Path) -> Self {
        let mut files = BTreeMap::new();
        read_module(source, Vec::new(), &source.join("lib.rs"), &mut files);
        let mut house = Self {
            files,
            handed_on: BTreeMap::new(),
        };
        let mut handed_on = BTreeMap::new();
        for (module, file) in &house.files {
            for item in &file.items {
                let syn::Item::Use(item) = item else { continue };
                if matches!(item.vis, syn::Visibility::Inherited) {
                    continue;
                }
                for (path, name) in leaves(&item.tree) {
                    if let Some((from, of)) = house.resolve(module, &path) {
                        handed_on.insert((module.clone(), name), (from, of));
                    }
                }
            }
        }
        house.handed_on = handed_on;
        house
    }

    /// Module and name that a path of `here` leads to, where it stays in the crate.
    fn resolve(&self, here: &Module, path: &[String]) -> Option<(Module, String)> {
        let mut at;
        let rest = match path.first()?.as_str() {
            "crate" => {
                at = Vec::new();
                &path[1..]
            }
            "super" => {
                at = here.clone();
                let up = path.iter().take_while(|step| *step == "super").count();
                at.truncate(at.len().checked_sub(up)?);
                &path[up..]
            }
            "self" => {
                at = here.clone();
                &path[1..]
            }
            first => {
                at = here.clone();
                let mut child = here.clone();
                child.push(first.to_owned());
                if !self.files.contains_key(&child) {
                    return None;
                }
                path
            }
        };
        let mut rest = rest.iter();
        let mut name = String::new();
        for step in rest.by_ref() {
            let mut inner = at.clone();
            inner.push(step.clone());
            if !self.files.contains_key(&inner) {
                name.clone_from(step);
                break;
            }
            at = inner;
        }
        let mut found = (at, name);
        while let Some(from) = self.handed_on.get(&found) {
            found = from.clone();
        }
        Some(found)
    }

    /// The files that each file imports.
    fn imports(&self) -> BTreeMap<&Module, BTreeSet<Module>> {
        let of = |(module, file): (&'_ Module, &syn::File)| {
            let mut paths = Paths::default();
            paths.visit_file(file);
            let modules = paths.found.iter();
            let modules = modules.filter_map(|path| self.resolve(module, path));
            // What is named by itself and defined in the same file is no import.
            modules
                .map(|(to, _)| to)
                .filter(|to| to != module)
                .collect::<BTreeSet<_>>()
        };
        let files = self.files.iter();
        files
            .map(|(module, file)| (module, of((module, file))))
            .collect()
    }
}

/// Reads a module's file and those of its modules, tests apart.
fn read_module(
    folder: &Path,
    module: Module,
    file: &Path,
    files: &mut BTreeMap<Module, syn::File>,
) {
    let text = fs::read_to_string(file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let parsed = syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    for item in &parsed.items {
        let syn::Item::Mod(item) = item else { continue };
        if item.content.is_some() || is_test(&item.attrs) {
            continue;
        }
        let name = item.ident.to_string();
        let mut inner = module.clone();
        inner.push(name.clone());
        let below = folder.join(&name);
        let single = folder.join(format!("{name}.rs"));
        let path = if single.exists() {
            single
        } else {
            below.join("mod.rs")
        };
        read_module(&below, inner, &path, files);
    }
    files.insert(module, parsed);
}

/// The paths that a `use` brings in, each with the name that it has then.
fn leaves(tree: &syn::UseTree) -> Vec<(Vec<String>, String)> {
    match tree {
        syn::UseTree::Path(path) => {
            let below = leaves(&path.tree);
            let first = path.ident.to_string();
            let longer = |(mut rest, name): (Vec<String>, String)| {
                rest.insert(0, first.clone());
                (rest, name)
            };
            below.into_iter().map(longer).collect()
        }
        syn::UseTree::Name(name) if name.ident == "self" => vec![(Vec::new(), String::new())],
        syn::UseTree::Name(name) => vec![(vec![name.ident.to_string()], name.ident.to_string())],
        syn::UseTree::Rename(name) => vec![(vec![name.ident.to_string()], name.rename.to_string())],
        syn::UseTree::Glob(_) => vec![(Vec::new(), String::new())],
        syn::UseTree::Group(group) => group.items.iter().flat_map(leaves).collect(),
    }
}

/// Collects the paths of a file, tests apart.
#[derive(Default)]
struct Paths {
    found: Vec<Vec<String>>,
}

impl<'f> Visit<'f> for Paths {
    fn visit_item_use(&mut self, item: &'f syn::ItemUse) {
        // What is only handed on is not used here.
        let own = matches!(item.vis, syn::Visibility::Inherited);
        if own && !is_test(&item.attrs) {
            self.found
                .extend(leaves(&item.tree).into_iter().map(|leaf| leaf.0));
        }
    }

    fn visit_item_mod(&mut self, item: &'f syn::ItemMod) {
        if !is_test(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_path(&mut self, path: &'f syn::Path) {
        let steps: Vec<_> = path.segments.iter().map(|s| s.ident.to_string()).collect();
        if steps.len() > 1 && matches!(steps[0].as_str(), "crate" | "super") {
            self.found.push(steps);
        }
        visit::visit_path(self, path);
    }
}

/// The crates of the architecture page and their folders from the lowest up.
fn floors() -> Vec<(String, Vec<String>)> {
    let page = repository().join("docs/src/architecture.md");
    let page = fs::read_to_string(page).expect("the page is there");
    let section = page
        .split("\n## Floors\n")
        .nth(1)
        .expect("a section *Floors*");
    let mut paragraphs = section.split("\n\n");
    let table = paragraphs.find(|paragraph| paragraph.starts_with("| crate |"));
    let rows = table
        .expect("a table of crates")
        .lines()
        .filter(|line| line.starts_with("| `"));
    rows.map(|row| {
        let mut cells = row.split('|').skip(1);
        let name = cells.next().unwrap_or_default().trim().trim_matches('`');
        let folders = cells.next().unwrap_or_default().split(',');
        let folders = folders.map(|folder| folder.trim().trim_matches('`').to_owned());
        (name.to_owned(), folders.collect())
    })
    .collect()
}

fn shown(module: &Module) -> String {
    format!("crate::{}", module.join("::"))
}

#[test]
fn no_folder_imports_one_above_it() {
    let floors = floors();
    assert!(
        floors.len() >= 8,
        "the page has the floors of {} crates",
        floors.len()
    );
    let mut wrong = Vec::new();
    for (name, folders) in floors.into_iter().filter(|(_, folders)| folders.len() > 1) {
        let house = House::read(&repository().join("crates").join(&name).join("src"));
        let floor = |module: &Module| {
            let folder = module.first()?;
            let at = folders.iter().position(|known| known == folder);
            assert!(
                at.is_some(),
                "{name}: `{folder}` has no floor in the architecture page"
            );
            at
        };
        for (from, imports) in house.imports() {
            for to in imports {
                // The root hands on what stands below, and stands above all.
                let (Some(own), other) = (floor(from), floor(&to)) else {
                    continue;
                };
                if other.is_none_or(|other| other > own) {
                    wrong.push(format!("{name}: {} imports {}", shown(from), shown(&to)));
                }
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "arrows that run back up:\n{}",
        wrong.join("\n")
    );
}

#[test]
fn no_circle_of_files_is_larger_than_three() {
    let mut large = Vec::new();
    for (name, _) in floors() {
        let house = House::read(&repository().join("crates").join(&name).join("src"));
        let imports = house.imports();
        let reached = |from: &Module| {
            let mut found = BTreeSet::new();
            let mut open = vec![from.clone()];
            while let Some(next) = open.pop() {
                for to in imports.get(&next).into_iter().flatten() {
                    if found.insert(to.clone()) {
                        open.push(to.clone());
                    }
                }
            }
            found
        };
        let all: BTreeMap<_, _> = imports.keys().map(|m| ((*m).clone(), reached(m))).collect();
        let mut seen = BTreeSet::new();
        for (module, reached) in &all {
            let circle: BTreeSet<_> = reached
                .iter()
                .filter(|other| all.get(*other).is_some_and(|back| back.contains(module)))
                .map(shown)
                .collect();
            if circle.len() > CIRCLE && seen.insert(circle.clone()) {
                let files: Vec<_> = circle.into_iter().collect();
                large.push(format!(
                    "{name}: {} files: {}",
                    files.len(),
                    files.join(", ")
                ));
            }
        }
    }
    assert!(large.is_empty(), "circles of files:\n{}", large.join("\n"));
}

#[test]
fn the_reader_finds_what_it_must() {
    let folder = std::env::temp_dir().join(format!("hyperstat-floors-{}", std::process::id()));
    let write = |name: &str, text: &str| {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        fs::write(path, text).expect("written");
    };
    write(
        "lib.rs",
        "mod low;\nmod high;\npub use low::Thing;\n#[cfg(test)]\nmod tests;\n",
    );
    write("low/mod.rs", "pub mod deep;\npub struct Thing;\n");
    write(
        "low/deep.rs",
        "use crate::high::{self, top as summit};\nfn f() { super::g(); }\n",
    );
    write(
        "high.rs",
        "use crate::Thing;\n#[cfg(test)]\nmod tests { use crate::low::deep; }\n",
    );
    let house = House::read(&folder);
    let imports = house.imports();
    let of = |module: &[&str]| {
        let module: Module = module.iter().map(|m| (*m).to_owned()).collect();
        imports[&module].iter().map(shown).collect::<Vec<_>>()
    };
    assert_eq!(of(&["low", "deep"]), ["crate::high", "crate::low"]);
    assert_eq!(of(&["high"]), ["crate::low"]);
    assert_eq!(of(&["low"]), Vec::<String>::new());
    let _ = fs::remove_dir_all(&folder);
}
