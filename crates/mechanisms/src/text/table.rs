//! A named map of a mechanism file, in the order of the file.

use std::collections::HashMap;

use super::fragment::{Entry, Fragment};
use crate::error::LoadError;
use crate::text::names;

/// Values by name, such as the materials.
#[derive(Debug)]
pub(crate) struct Table<T> {
    /// What one value is, in words; one `s` makes the plural.
    what: &'static str,
    names: Vec<String>,
    values: HashMap<String, T>,
}

impl<T> Table<T> {
    /// Reads a map, each entry by `read`, which also gets a name for errors, such as
    /// "material `steel`". No map is an empty table.
    pub(crate) fn read<'a>(
        map: Option<Fragment<'a>>,
        what: &'static str,
        read: impl Fn(&Entry<'a>, &str) -> Result<T, LoadError>,
    ) -> Result<Self, LoadError> {
        let mut table = Self {
            what,
            names: Vec::new(),
            values: HashMap::new(),
        };
        for entry in map.map(Fragment::map).transpose()?.unwrap_or_default() {
            let value = read(&entry, &format!("{what} `{}`", entry.name))?;
            table.names.push(entry.name.clone());
            table.values.insert(entry.name, value);
        }
        Ok(table)
    }

    /// Names in the order of the file.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.names.iter().map(String::as_str)
    }

    /// The value that a name in the file refers to.
    pub(crate) fn find(&self, name: Fragment<'_>) -> Result<&T, LoadError> {
        let text = name.string()?;
        self.values.get(&text).ok_or_else(|| {
            let known = self.names.iter().map(String::as_str);
            name.error(format!("unknown {} `{text}`", self.what))
                .unreadable()
                .with_help(names::help(&text, &format!("{}s", self.what), known))
        })
    }
}
