//! The `hyperstat` binary: the command line with the built-in kinds of joints.

use std::process::ExitCode;

use hyperstat_mechanisms::Registry;

fn main() -> ExitCode {
    hyperstat_cli::run(std::env::args_os(), &Registry::builtin())
}
