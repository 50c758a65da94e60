//! Names of what copies of groups have, told from how the groups are written.

use super::fragment::Fragment;
use super::tree::{Content, Node};

/// A part of a copy, by its name in the mechanism.
#[derive(Debug)]
pub(super) struct Copied<'r> {
    pub(super) group: &'r str,
    /// Its name in the group.
    pub(super) part: &'r str,
    /// What the copy's names end with.
    pub(super) ending: String,
}

impl<'r> Copied<'r> {
    /// The part of a copy that has this name among the `points`, `bodies` or `joints` of the mechanism.
    pub(super) fn find(root: &'r Node, section: &str, name: &str) -> Option<Self> {
        let (groups, copies) = (root.get("groups")?, root.get("copies")?);
        groups.entries().iter().find_map(|group| {
            let placed = copies.get(group.name())?;
            let mut parts = group.value().get(section)?.entry_names();
            parts.find_map(|part| {
                let ending = name.strip_prefix(part)?;
                ends_a_copy(placed, ending).then(|| Self {
                    group: group.name(),
                    part,
                    ending: ending.into(),
                })
            })
        })
    }
}

/// Whether the names of one of these copies end so.
fn ends_a_copy(placed: &Node, ending: &str) -> bool {
    match placed.get("names").map(|names| &names.content) {
        Some(Content::List(names)) => {
            let mut names = names.iter().map(Fragment::of_node);
            names.any(|own| own.string().is_ok_and(|own| own == ending))
        }
        _ => !ending.is_empty() && ending.bytes().all(|byte| byte.is_ascii_digit()),
    }
}
