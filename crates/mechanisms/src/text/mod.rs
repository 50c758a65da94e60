//! Text of files: reading it, places in it, names and paths, tables.

pub(crate) mod as_json;
pub(crate) mod brackets;
pub(crate) mod columns;
mod copied;
pub(crate) mod csv;
pub mod dependence;
pub(crate) mod digits;
pub mod dimension;
#[cfg(feature = "fs")]
pub(crate) mod disk;
pub(crate) mod expression;
pub(crate) mod fields;
pub mod files;
pub(crate) mod fragment;
pub(crate) mod json;
pub(crate) mod json_syntax;
pub(crate) mod made;
pub(crate) mod named;
pub(crate) mod names;
mod numbers;
pub(crate) mod paths;
pub(crate) mod quantities;
pub(crate) mod raw;
pub(crate) mod replace;
pub(crate) mod scope;
pub(crate) mod slips;
pub(crate) mod source;
pub(crate) mod syntax;
pub(crate) mod table;
pub(crate) mod tree;
pub(crate) mod units;
pub(crate) mod value;
pub(crate) mod values;
