//! What the tests of subassemblies share: an oracle with about 32 digits, and random input.

#![allow(dead_code, reason = "each test binary uses a part")]

pub mod double_double;
pub mod oracle;
pub mod random;
