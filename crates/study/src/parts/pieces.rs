//! The pieces of a job that are there.

use std::ops::Range;

use super::error::PartsError;
use super::manifest::{Manifest, folder, rows_of, stem};
use super::origin::Origin;
use super::shelf::Shelf;

/// The pieces of a job that are there.
#[derive(Debug, Default)]
pub(super) struct Pieces {
    /// Those of the run, whole, of rows that were asked for.
    pub(super) whole: Vec<Manifest>,
    /// Those of other runs.
    pub(super) others: Vec<Manifest>,
    /// Names of files that cannot be used, and why.
    pub(super) broken: Vec<(String, String)>,
    /// Names of tables that no manifest is of.
    pub(super) stray: Vec<String>,
}

impl Pieces {
    /// Looks for those of a job, of the run of this hash, and checks those within these rows.
    pub(super) fn look(
        shelf: &dyn Shelf,
        job: &str,
        run: &str,
        rows: &Range<usize>,
    ) -> Result<Self, PartsError> {
        let folder = folder(job);
        let mut names = shelf.names(&folder).map_err(PartsError::read(&folder))?;
        names.sort_unstable();
        let mut found = Self::default();
        // Of many parts only those are read that matter, where no other run was begun beside them.
        let is_alone = Origin::is_alone(shelf, run)?;
        for name in names.iter().filter(|name| name.starts_with('_')) {
            let Some(own) = rows_of(name) else { continue };
            if is_alone && !is_within(&own, rows) {
                continue;
            }
            let name = format!("{folder}/{name}");
            let manifest = match Manifest::read(shelf, &name) {
                Ok(manifest) => manifest,
                // A table without a manifest is of no use.
                Err(why) => {
                    if is_within(&own, rows) {
                        found.broken.push((name, why));
                    }
                    continue;
                }
            };
            if manifest.run != run {
                found.others.push(manifest);
            } else if is_within(&own, rows) {
                match manifest.table.check(shelf) {
                    Ok(()) => found.whole.push(manifest),
                    Err(why) => found.broken.push((manifest.table.name.clone(), why)),
                }
            }
        }
        let is_stray = |name: &&String| {
            let rows_of_it = rows_of(name).filter(|own| is_within(own, rows));
            rows_of_it.is_some_and(|own| {
                let manifest = format!("_{}.json", stem(&own));
                !name.starts_with('_') && !names.contains(&manifest)
            })
        };
        let stray = names.iter().filter(is_stray);
        found.stray = stray.map(|name| format!("{folder}/{name}")).collect();
        Ok(found)
    }

    /// The error of parts of another run, where there are some; a finished result is none.
    pub(super) fn refuse_others(
        &self,
        shelf: &dyn Shelf,
        job: &str,
        origin: &Origin,
    ) -> Result<(), PartsError> {
        let Some(other) = self.others.iter().find(|other| !other.is_result()) else {
            return Ok(());
        };
        let then = Origin::known(shelf, &other.run);
        Err(PartsError::Other {
            folder: folder(job),
            difference: then.map_or_else(|_| String::new(), |then| origin.difference(&then)),
        })
    }
}

/// Whether rows are all among others.
fn is_within(rows: &Range<usize>, of: &Range<usize>) -> bool {
    of.start <= rows.start && rows.end <= of.end
}

/// Removes what a job has in `parts` of these rows, of whatever run.
pub(super) fn clear(shelf: &dyn Shelf, job: &str, rows: &Range<usize>) -> Result<(), PartsError> {
    let folder = folder(job);
    let mut names = shelf.names(&folder).map_err(PartsError::read(&folder))?;
    // Manifests first: a table without one is none.
    names.sort_unstable_by_key(|name| !name.starts_with('_'));
    for name in names {
        let overlaps = |own: &Range<usize>| own.start < rows.end && rows.start < own.end;
        if rows_of(&name).as_ref().is_some_and(overlaps) {
            remove(shelf, &format!("{folder}/{name}"))?;
        }
    }
    Ok(())
}

/// Removes a file.
pub(super) fn remove(shelf: &dyn Shelf, name: &str) -> Result<(), PartsError> {
    shelf.remove(name).map_err(PartsError::write(name))
}

/// The one run that all parts in a folder of results are of: its hash. Manifests that cannot be read are left
/// to those who need them.
///
/// # Errors
/// There are no parts, or of different runs.
pub fn hashes(shelf: &dyn Shelf) -> Result<String, PartsError> {
    let mut first: Option<Manifest> = None;
    let mut jobs = shelf.names("parts").map_err(PartsError::read("parts"))?;
    jobs.sort_unstable();
    for job in jobs {
        let folder = folder(&job);
        if Origin::is_name(&job) {
            continue;
        }
        let mut names = shelf.names(&folder).map_err(PartsError::read(&folder))?;
        names.sort_unstable();
        let is_manifest = |name: &&String| name.starts_with('_') && rows_of(name).is_some();
        for name in names.iter().filter(is_manifest) {
            let name = format!("{folder}/{name}");
            let Ok(manifest) = Manifest::read(shelf, &name) else {
                continue;
            };
            match &first {
                _ if manifest.is_result() => {}
                Some(first) if first.run != manifest.run => {
                    let origins = [first, &manifest].map(|of| Origin::known(shelf, &of.run));
                    let difference = match &origins {
                        [Ok(first), Ok(second)] => first.difference(second),
                        _ => String::new(),
                    };
                    return Err(PartsError::Several {
                        first: first.name(),
                        second: name,
                        difference,
                    });
                }
                Some(_) => {}
                None => first = Some(manifest),
            }
        }
    }
    first.map(|first| first.run).ok_or(PartsError::Nothing)
}
