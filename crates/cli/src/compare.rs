//! `hyperstat compare`: what differs between two mechanisms, two designs or poses of one, or two tables.

use std::path::Path;

use hyperstat_mechanisms::{Disk, Registry};
use hyperstat_study::disk;
use hyperstat_study::figure::{self, Drawing, Form};
use hyperstat_study::table::TableReader;
use hyperstat_study::{Comparison, Input, PlotError, Study, StudyError, compare_tables};

use crate::args::{Compare, Format};
use crate::error::CliError;
use crate::json::json;
use crate::{plot, text};

/// The report, and the files that are drawn.
pub(crate) fn run(args: &Compare, registry: &Registry) -> Result<String, CliError> {
    let file = &args.input.file;
    let (other, selection) = args
        .with()
        .ok_or_else(|| CliError::NothingToCompare { path: file.clone() })?;
    match [file, &other].map(|path| plot::is_table(path)) {
        [true, true] => of_tables(args, &other),
        [false, false] => {
            let first = Study::open(file, &args.input.selection(), &Disk, registry)?;
            let loaded = hyperstat_mechanisms::load(&other, &Disk, registry)?;
            let selection = match &loaded {
                // What chooses of the first has nothing to choose from here.
                Input::Mechanism(_) => args.chosen_with(),
                _ => selection,
            };
            let second = Study::of(loaded, &other, &selection).map_err(of_other)?;
            of_studies(args, [&first, &second])
        }
        [first, _] => Err(CliError::Unlike {
            table: if first { file.clone() } else { other.clone() },
            other: if first { other } else { file.clone() },
        }),
    }
}

/// Why the other cannot be chosen: of a mechanism file by the option that chooses of the other.
fn of_other(error: StudyError) -> CliError {
    match error {
        StudyError::NotABatch { what, path } => CliError::NoChoice {
            path,
            option: match what {
                "job" => "--with-job",
                "design" => "--with-design",
                _ => "--with-pose",
            },
            what: "a mechanism file",
        },
        error => error.into(),
    }
}

fn of_tables(args: &Compare, other: &Path) -> Result<String, CliError> {
    if let Some(option) = args.of_mechanisms() {
        let path = args.input.file.clone();
        return Err(match option {
            "--case" | "--modes" | "--along" | "--out" => CliError::NoMechanism { path, option },
            _ => CliError::NoChoice {
                path,
                option,
                what: "a table",
            },
        });
    }
    let [first, second] = [
        TableReader::open(&args.input.file)?,
        TableReader::open(other)?,
    ];
    let found = compare_tables([&first, &second])?;
    match args.format {
        Format::Text => Ok(text::compared_tables(&found)),
        Format::Json => json(&found),
    }
}

fn of_studies(args: &Compare, studies: [&Study; 2]) -> Result<String, CliError> {
    let drawn = args.out.as_deref();
    let drawn = drawn.map(|out| (plot::named(out, "compare"), plot::forms_of(out)));
    let files = drawn.as_ref().map(|(stem, forms)| Form::files(stem, forms));
    let read: Vec<_> = studies
        .iter()
        .flat_map(|study| study.files())
        .cloned()
        .collect();
    disk::refuse(files.iter().flatten().map(|path| &**path), &read)?;
    let found = Comparison::new(studies, &args.dwelling.focus())?;
    if let Some((stem, forms)) = &drawn {
        let no_shares = || PlotError::NoShares {
            path: args.input.file.clone(),
        };
        let budget = found.results.budget.as_ref().ok_or_else(no_shares)?;
        let title = found.names.join(" and ");
        let bars = figure::compared(budget, &found.names, title).ok_or_else(no_shares)?;
        disk::write_figure(&Drawing::Budget(bars), stem, forms)?;
    }
    match args.format {
        Format::Text => Ok(text::compared(&found)),
        Format::Json => json(&found),
    }
}
