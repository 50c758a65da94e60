//! Files themselves: what begins them, puts them in order and describes them.

pub use hyperstat_mechanisms::{begin, beginnings, format, format_file, schema, to_json};
