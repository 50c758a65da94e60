//! Tables that a mechanism takes from other files of its folder: `include: ["steel.ron"]`.

use std::path::{Component, Path, PathBuf};

use crate::error::LoadError;
use crate::file::groups::mounts;
use crate::terms::mechanism::INCLUDED;
use crate::text::fields::Fields;
use crate::text::fragment::{Entry, Fragment};
use crate::text::named::read_named;
use crate::text::tree::{Named, Node};

/// The tables that an included file may have, beside an `include` of its own.
const TABLES: [&str; 4] = ["parameters", "materials", "sections", "groups"];

/// The tree of a mechanism, with the tables of the files that it includes and the mechanisms that it mounts.
pub(crate) fn mechanism(value: Fragment<'_>) -> Result<Node, LoadError> {
    read(value, &mut vec![value.place().location().path])
}

/// The same, where these files are being read.
pub(crate) fn read(value: Fragment<'_>, open: &mut Vec<PathBuf>) -> Result<Node, LoadError> {
    mounts::read(included(value)?, open)
}

fn included(value: Fragment<'_>) -> Result<Node, LoadError> {
    let root = Node::of(value);
    let Some(list) = root.get("include") else {
        return Ok(root);
    };
    let own = |table: &str| root.get(table).map_or(&[][..], Node::entries).to_vec();
    let mut included = Included {
        tables: TABLES.map(own),
        open: vec![value.place().location().path],
        done: Vec::new(),
    };
    included.add(Fragment::of_node(list))?;
    let mut tree = root.without_field("include");
    for (name, entries) in TABLES.into_iter().zip(included.tables) {
        if !entries.is_empty() {
            let place = root.get(name).unwrap_or(list);
            tree = tree.with_field(name, place.map_in_place(entries));
        }
    }
    Ok(tree)
}

/// What has been included so far.
struct Included {
    tables: [Vec<Named>; 4],
    /// The files that are being read, each included by the one before it.
    open: Vec<PathBuf>,
    done: Vec<PathBuf>,
}

impl Included {
    /// Adds what the files of a list have; a file that has been read before adds nothing.
    fn add(&mut self, list: Fragment<'_>) -> Result<(), LoadError> {
        for name in list.list("a list of files, such as `[\"steel.ron\"]`")? {
            let path = name.source().relative(&name.string()?);
            // `./steel.ron` is `steel.ron`.
            let path: PathBuf = (path.components())
                .filter(|part| !matches!(part, Component::CurDir))
                .collect();
            let inside =
                |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
            if !Path::new(&name.string()?).components().all(inside) {
                return Err(name
                    .error(
                        "a file that is included lies in the folder of the file that includes it",
                    )
                    .with_help("copy it there, or into a folder below"));
            }
            if self.open.contains(&path) {
                return Err(name
                    .error(format!("{} includes itself", path.display()))
                    .with_help("take what both files need into a third one"));
            }
            if self.done.contains(&path) {
                continue;
            }
            let source = read_named(name)?;
            let node = Node::of(Fragment::of_file(&source)?);
            self.open.push(path.clone());
            self.add_file(&node)?;
            self.open.pop();
            self.done.push(path);
        }
        Ok(())
    }

    /// Adds the tables of a file.
    fn add_file(&mut self, file: &Node) -> Result<(), LoadError> {
        let fields = Fields::read(
            Fragment::of_node(file),
            "a file that is included",
            &INCLUDED.names(),
        )?;
        if let Some(list) = fields.get("include") {
            self.add(list)?;
        }
        for (table, name) in self.tables.iter_mut().zip(TABLES) {
            if let Some(map) = fields.get(name) {
                map.map()?;
            }
            for own in file.get(name).map_or(&[][..], Node::entries) {
                if let Some(first) = table.iter().find(|other| other.name() == own.name()) {
                    let first = Entry::of(first);
                    let at = first.key.place().location();
                    let message = format!("the name \"{}\" is given twice", own.name());
                    return Err((Entry::of(own).key.error(message))
                        .with_help(format!("it stands in {at} already; remove one of the two")));
                }
                table.push(own.clone());
            }
        }
        Ok(())
    }
}
