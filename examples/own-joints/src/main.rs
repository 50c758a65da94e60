//! The `hyperstat` command line with two more kinds of joints, and one more prebuilt mechanism.

use std::process::ExitCode;

use hyperstat_mechanisms::Registry;
use own_joints::{CrossSpring, FiveBar, OffsetUniversal};

fn main() -> ExitCode {
    let mut registry = Registry::builtin();
    registry.register("CrossSpring", CrossSpring::ARGUMENTS, CrossSpring::read);
    registry.register(
        "OffsetUniversal",
        OffsetUniversal::ARGUMENTS,
        OffsetUniversal::read,
    );
    registry.register_prebuilt("FiveBar", FiveBar::PARAMETERS, FiveBar::read);
    hyperstat_cli::run(std::env::args_os(), &registry)
}
