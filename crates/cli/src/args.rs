//! The command line: its commands, their options, and the help a stranger can work from.

mod compare;
mod files;
mod input;
mod plot;
mod report;
mod run;
mod view;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use hyperstat_assembly::BeamMass;
use hyperstat_mechanisms::Along;

use compare::COMPARE_HELP;
pub(crate) use compare::Compare;
use files::{ADJUST_HELP, COMPLETIONS_HELP, EXPORT_HELP, FMT_HELP, NEW_HELP, SCHEMA_HELP};
pub(crate) use files::{Adjust, Completions, Export, FileFormat, Fmt, New, Shell};
use input::along;
pub(crate) use input::{Format, Input};
pub(crate) use plot::{Plot, Pose, Scale};
use report::REPORT_HELP;
pub(crate) use report::Report;
use run::{MERGE_HELP, RUN_HELP};
pub(crate) use run::{Merge, Run, Shard};
use view::VIEW_HELP;
pub(crate) use view::View;

/// How stiff a parallel robot is: the 6×6 stiffness of a mechanism's output, and all
/// displacements, wrenches and stresses, from a text file.
#[derive(Debug, Parser)]
#[command(name = "hyperstat", version, about, long_about = None, after_help = AFTER_HELP)]
#[command(subcommand_required = true, arg_required_else_help = true)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const AFTER_HELP: &str = "\
Examples:
  hyperstat check portal.ron                 Does the file hold a mechanism that can be solved?
  hyperstat solve portal.ron                 Solve it, print a report
  hyperstat solve portal.ron --format json   The same, for a program to read
  hyperstat run paper.ron --out results      Run every job of a batch file
  hyperstat solve paper.ron --job delta --pose 12
                                             One pose of a batch, in full
  hyperstat plot results/map.csv --map k33   A stiffness over the workspace, as SVG and PNG
  hyperstat compare a.ron b.ron              What differs, and what that changes
  hyperstat report portal.ron --out portal.html
                                             All of it on a page, for an appendix
  hyperstat view portal.ron                  A page to look at, and to drag
  hyperstat export paper.ron --job delta > delta.ron
                                             A mechanism of a batch written out, to edit
  hyperstat new delta > robot.ron            A file to begin with

`hyperstat solve --help` shows a mechanism file, `hyperstat run --help` a batch file.

Units are SI throughout (m, N, rad, kg, s). Vectors are in the global frame, linear part first.

Exit status:
  0  done
  1  a run finished in which some pose has no result; `fmt --check` found a file to change
  2  the input cannot be used, or a figure not be drawn as it was asked for
  3  an output could not be written
130  a run was interrupted; the same command goes on
 70  a bug in hyperstat: please report it";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Solve one mechanism: stiffness, displacement and worst points, or all that was found
    #[command(after_help = SOLVE_HELP)]
    Solve(Solve),
    /// Run every job of a batch file: one table a job, CSV or Parquet, and its figures
    #[command(after_help = RUN_HELP)]
    Run(Run),
    /// Join the parts that `run --shard` wrote to the tables, summaries and figures of the undivided run
    #[command(after_help = MERGE_HELP)]
    Merge(Merge),
    /// Say what is wrong with a file; count mobility, over-constraint and idle motions
    #[command(after_help = CHECK_HELP)]
    Check(Check),
    /// Draw maps, lines, trajectories, deformed shapes, modes and budgets, as SVG, PNG and PDF
    #[command(after_help = PLOT_HELP)]
    Plot(Box<Plot>),
    /// Write a report of a mechanism or a batch as one HTML page: drawings, tables, figures, definitions
    #[command(after_help = REPORT_HELP)]
    Report(Box<Report>),
    /// Write a page to look at: the mechanism in space, to drag and ask in any browser, offline
    #[command(after_help = VIEW_HELP)]
    View(View),
    /// Say what differs between two mechanisms, designs or tables, in what is written and what is found
    #[command(after_help = COMPARE_HELP)]
    Compare(Box<Compare>),
    /// Write a mechanism at one pose of a batch as a mechanism file to edit
    #[command(after_help = EXPORT_HELP)]
    Export(Export),
    /// Print a commented file to begin with: a small mechanism, or a job of a prebuilt one
    #[command(after_help = NEW_HELP)]
    New(New),
    /// Put the lines of files in order, in place, with their comments
    #[command(after_help = FMT_HELP)]
    Fmt(Fmt),
    /// Move rounded coordinates of a mechanism file so that it has the freedoms which these miss
    #[command(after_help = ADJUST_HELP)]
    Adjust(Adjust),
    /// Print the JSON Schema of files, for editors
    #[command(after_help = SCHEMA_HELP)]
    Schema,
    /// Print what makes a shell complete commands and options
    #[command(after_help = COMPLETIONS_HELP)]
    Completions(Completions),
}

const SOLVE_HELP: &str = concat!(
    "\
The report holds the mechanism's mobility and over-constraint, warnings, what acts, the output's
displacement, in every case too, its stiffness, and the worst points of the bodies (Circle, Tube and
Rectangle sections, and General ones with y_max, z_max and torsion_modulus).
With --full, and always with --format json, also the output's compliance, the displacement of every
node, the wrench in every joint (on the second body of `between`, at the joint, in the joint frame),
and for every beam segment the forces at its ends (element frame) and its largest stresses.

Examples:
  hyperstat solve portal.ron
  hyperstat solve portal.ron --full          Displacements, wrenches and forces of every part too
  hyperstat solve portal.ron --format json > portal.json
  hyperstat solve portal.ron --verify
  hyperstat solve portal.ron --all-nodes     The nodes inside segments of `elements: n` too
  hyperstat solve portal.ron --modes 6       Natural frequencies and modes too
  hyperstat solve portal.ron --vtu portal.vtu
                                             For ParaView
  hyperstat solve portal.ron --why           What is soft, and which dimension should grow
  hyperstat solve portal.ron --why --along z
  hyperstat solve portal.ron --why --case push
                                             The same under the loads of a case
  hyperstat solve portal.ron --why --modes 3
                                             What changes the frequencies, too
  hyperstat solve paper.ron --job delta --pose 12

A mechanism file, a round bar held at one end:

",
    include_str!("../help/cantilever.ron")
);

const CHECK_HELP: &str = "\
Ends with 2 exactly when `hyperstat solve` would.

Examples:
  hyperstat check portal.ron
  hyperstat check paper.ron --job delta --pose 12";

const PLOT_HELP: &str = "\
Of a table of `run`: --map, --lines, --trajectory. Any column of numbers can be drawn, and what is
found from others:
  deflection, rotation                     length of the output's displacement, angle of its rotation
  pure_force_stiffness_min, …_max          principal stiffness against a force, rotations free
  pure_force_stiffness_x, …_y, …_z         stiffness against a force along an axis alone
  pure_moment_stiffness_min, …_max, …_x …  the same against a moment, translations free
  pure_translation_stiffness_min, …_max    principal stiffness against a translation, rotations held
  pure_rotation_stiffness_min, …_max       the same against a rotation, translations held
A column of a load case is written with the case's name: push.dz, push.deflection.
Poses on a grid become a heat map with contours, others coloured dots; poses without a result stay
white and are marked. Lines over what varies: a curve for each value of what else varies.

Of a mechanism file, or of a job of a batch file: --deformed, --mode, --budget. It is solved as by
`solve`. What `solve --why --format json` printed does for --budget too.

Standard output gets the names of the files, and a caption.

Examples:
  hyperstat plot out/delta-map.csv --map k33 --plane z=0.5 --out map
  hyperstat plot out/delta-map.csv --map pure_force_stiffness_min
                                             Every plane, side by side
  hyperstat plot out/delta-map.csv --map deflection --limits 1e-4,1e-3 --scale log
  hyperstat plot out/a.csv --map k33 --mark least --beside out/b.csv
                                             Two tables in one set of colours; --ratio: one over the other
  hyperstat plot out/path.csv --lines dx,dy,dz,drx
  hyperstat plot out/path.csv --lines deflection --over x
  hyperstat plot out/designs.csv --lines pure_force_stiffness_min --over rod.section.diameter --pose 3
  hyperstat plot out/path.csv --trajectory
  hyperstat plot portal.ron --deformed --scale 200
  hyperstat plot portal.ron --deformed --view front --show names,loads
  hyperstat plot paper.ron --job delta --pose 12 --mode 1
  hyperstat plot paper.ron --job delta --pose x=0.1,y=0,z=0.5 --deformed
  hyperstat plot portal.ron --mode 1 --animate
  hyperstat plot portal.ron --budget --along z";

/// `hyperstat solve`
#[derive(Debug, Args)]
pub(crate) struct Solve {
    #[command(flatten)]
    pub(crate) input: Input,
    /// Solve a second time with the independent dense solver; report the largest differences
    #[arg(long)]
    pub(crate) verify: bool,
    /// Take an output that moves freely as a result (semidefinite stiffness), not as an error
    #[arg(long)]
    pub(crate) allow_free: bool,
    /// Print everything: compliance, displacements of all nodes, joint wrenches, forces and stresses
    /// of all segments, of every case too
    #[arg(long)]
    pub(crate) full: bool,
    /// As --full, with the displacements of the nodes between a segment's elements, as `body.A-B.k`
    #[arg(long)]
    pub(crate) all_nodes: bool,
    /// Find the N lowest natural frequencies and their modes [default: a job's `modes`]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u16).range(1..=1000))]
    modes: Option<u16>,
    /// Write the deformed mechanism as a VTU file too, for ParaView: displacements, section forces,
    /// stresses, and modes where there are some
    #[arg(long, value_name = "FILE.vtu")]
    pub(crate) vtu: Option<PathBuf>,
    /// Masses of beams for natural frequencies: Exact, of the beams themselves at any number of
    /// elements; Consistent, moved by the elements' static shapes; Lumped, half of every element's at
    /// each of its ends, in translation only [default: a job's, or Exact]
    #[arg(long, value_name = "MASS", value_enum, ignore_case = true)]
    mass: Option<Mass>,
    /// Short for --mass Lumped
    #[arg(long, conflicts_with = "mass")]
    lumped: bool,
    /// Say what is soft and why: the share of every part in the deflection, what more of every
    /// dimension would change (of natural frequencies too, where there are some), stiffness measures
    #[arg(long)]
    pub(crate) why: bool,
    /// Direction that `--why` is asked about: `displacement` (of the output under the loads), `x`,
    /// `y`, `z`, a rotation `rx`, `ry`, `rz`, or three numbers `a,b,c`
    #[arg(
        long,
        value_name = "DIRECTION",
        requires = "why",
        value_parser = along,
        default_value = "displacement",
        allow_hyphen_values = true
    )]
    pub(crate) along: Along,
    /// Case of the mechanism or the job that `--why` is asked about [default: the loads of no case]
    #[arg(long, value_name = "NAME", requires = "why")]
    pub(crate) case: Option<String>,
    /// Form of the report on standard output
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

impl Solve {
    /// Number of natural frequencies that are asked for.
    pub(crate) fn modes(&self) -> Option<usize> {
        self.modes.map(usize::from)
    }

    /// Masses of beams that are asked for.
    pub(crate) fn mass(&self) -> Option<BeamMass> {
        match self.mass {
            Some(Mass::Exact) => Some(BeamMass::Exact),
            Some(Mass::Consistent) => Some(BeamMass::Consistent),
            Some(Mass::Lumped) => Some(BeamMass::Lumped),
            None => self.lumped.then_some(BeamMass::Lumped),
        }
    }
}

/// Masses of beams, named as in files.
#[derive(Debug, Clone, Copy, ValueEnum)]
#[value(rename_all = "PascalCase")]
enum Mass {
    Exact,
    Consistent,
    Lumped,
}

/// `hyperstat check`
#[derive(Debug, Args)]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) input: Input,
    /// Form of the report on standard output
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::Cli;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
