//! Every measure and every column of a table has one definition, and the book says what it is.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use syn::visit::{self, Visit};

/// Columns whose names stand for nothing else.
const COLUMNS: [&str; 7] = ["status", "dx", "dy", "dz", "drx", "dry", "drz"];

/// Texts of a file and first arguments of `measure(…)`, tests apart.
#[derive(Default)]
struct Texts {
    all: Vec<String>,
    measures: Vec<String>,
}

impl<'f> Visit<'f> for Texts {
    fn visit_lit_str(&mut self, text: &'f syn::LitStr) {
        self.all.push(text.value());
    }

    fn visit_expr_call(&mut self, call: &'f syn::ExprCall) {
        if let (syn::Expr::Path(called), Some(syn::Expr::Lit(first))) =
            (&*call.func, call.args.first())
            && called.path.is_ident("measure")
            && let syn::Lit::Str(name) = &first.lit
        {
            self.measures.push(name.value());
        }
        visit::visit_expr_call(self, call);
    }

    fn visit_item_mod(&mut self, item: &'f syn::ItemMod) {
        if item.ident != "tests" {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_attribute(&mut self, _: &'f syn::Attribute) {}
}

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn sources(folder: &Path, found: &mut BTreeMap<PathBuf, Texts>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") && !path.ends_with("tests.rs") {
            let text = fs::read_to_string(&path).expect("a text");
            let parsed = syn::parse_file(&text).expect("Rust");
            let mut texts = Texts::default();
            texts.visit_file(&parsed);
            found.insert(path, texts);
        }
    }
}

fn read() -> BTreeMap<PathBuf, Texts> {
    let mut found = BTreeMap::new();
    for name in ["study", "cli"] {
        sources(
            &repository().join("crates").join(name).join("src"),
            &mut found,
        );
    }
    found
}

#[test]
fn every_column_has_one_definition() {
    let found = read();
    for column in COLUMNS {
        let places: Vec<_> = (found.iter())
            .flat_map(|(path, texts)| texts.all.iter().map(move |text| (path, text)))
            .filter(|(_, text)| *text == column)
            .map(|(path, _)| path.display().to_string())
            .collect();
        let only = matches!(&*places, [one] if one.ends_with("schema.rs"));
        assert!(only, "`{column}` stands in {places:?}");
    }
}

#[test]
fn every_measure_has_one_definition_and_the_book_says_it() {
    let found = read();
    let book = repository().join("docs/src/theory/measures.md");
    let book = fs::read_to_string(book).expect("the page is there");
    let names: Vec<_> = (found.iter())
        .flat_map(|(path, texts)| texts.measures.iter().map(move |name| (path, name)))
        .collect();
    assert!(names.len() > 20, "{names:?}");
    for (place, (path, name)) in names.iter().enumerate() {
        assert!(
            path.ends_with("measures.rs"),
            "`{name}` in {}",
            path.display()
        );
        let again = names[place + 1..].iter().any(|(_, other)| other == name);
        assert!(!again, "`{name}` has two definitions");
        assert!(
            book.contains(&format!("`{name}`")),
            "the book does not define `{name}`"
        );
    }
}
