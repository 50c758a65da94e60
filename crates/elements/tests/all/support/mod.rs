//! What the tests of subassemblies share: an oracle with about 32 digits, and random input.

pub mod double_double;
pub mod oracle;
pub mod random;
