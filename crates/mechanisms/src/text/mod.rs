//! Text of files: reading it, places in it, names and paths, tables.

pub(crate) mod as_json;
pub(crate) mod brackets;
pub(crate) mod columns;
pub(crate) mod csv;
#[cfg(feature = "fs")]
pub(crate) mod disk;
pub(crate) mod fields;
pub mod files;
pub(crate) mod fragment;
pub(crate) mod json;
pub(crate) mod json_syntax;
pub(crate) mod named;
pub(crate) mod names;
pub(crate) mod paths;
pub(crate) mod raw;
pub(crate) mod replace;
pub(crate) mod slips;
pub(crate) mod source;
pub(crate) mod syntax;
pub(crate) mod table;
pub(crate) mod tree;
pub(crate) mod value;
pub(crate) mod values;
