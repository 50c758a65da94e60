//! Parts that are all there, joined to one table.

use std::collections::HashSet;
use std::ops::Range;

use super::super::error::PartsError;
use super::super::manifest::{Manifest, Table, folder, rows_of, stem};
use super::super::origin::Origin;
use super::super::part::Part;
use super::super::pieces::remove;
use super::Work;
use crate::ran::Ran;
use crate::sweep::Sweep;

impl Work<'_> {
    /// Joins parts of all rows that are asked for to their table, where they are not that yet, says of it how they
    /// came out, and removes the pieces.
    pub(super) fn complete(
        &self,
        sweep: &Sweep<'_>,
        parts: &[Manifest],
        rows: &Range<usize>,
    ) -> Result<(), PartsError> {
        let name = self.table_name(sweep);
        // Somebody may have lost it.
        let record = |table| {
            self.write_origin()?;
            let all = self.joined(sweep, parts, rows, table);
            all.write(self.shelf).map_err(PartsError::write(&name))
        };
        match parts {
            // No rows are asked for.
            [] => return Ok(()),
            [all] if all.table.name == name => match all.piece {
                // What was a piece of something else is what is asked for here.
                true => record(all.table.clone())?,
                false => self.write_origin()?,
            },
            _ => record(self.join(sweep, parts, rows)?)?,
        }
        self.tidy(sweep, rows)
    }

    /// Writes what was read for parts, where it is not yet.
    pub(super) fn write_origin(&self) -> Result<(), PartsError> {
        let written = self.origin.write(self.shelf);
        written.map_err(PartsError::write(&self.origin.name()))
    }

    /// Joins parts of all rows that are asked for to their table.
    pub(super) fn join(
        &self,
        sweep: &Sweep<'_>,
        parts: &[Manifest],
        rows: &Range<usize>,
    ) -> Result<Table, PartsError> {
        let name = self.table_name(sweep);
        let cannot_write = PartsError::write(&name);
        let table = self.begin_table(sweep, rows.start);
        let mut table = table.map_err(&cannot_write)?;
        for part in parts {
            if (self.stop)() {
                return Err(PartsError::Stopped);
            }
            let content = self.shelf.open(&part.table.name);
            let content = content.map_err(PartsError::read(&part.table.name))?;
            table.join(&content).map_err(&cannot_write)?;
        }
        let file = table.finish().map_err(&cannot_write)?;
        file.keep(&name).map_err(&cannot_write)
    }

    /// What is said of parts that are joined.
    fn joined(
        &self,
        sweep: &Sweep<'_>,
        parts: &[Manifest],
        rows: &Range<usize>,
        table: Table,
    ) -> Manifest {
        let mut ran = Ran::from_row(sweep.job(), rows.start, self.origin.options().summary);
        for part in parts {
            ran.add(&part.found);
        }
        self.manifest(sweep, rows.clone(), table, ran, false)
    }

    /// Removes pieces whose rows are joined, files that nobody can use, and what is said of a table that the one of
    /// all rows has replaced.
    fn tidy(&self, sweep: &Sweep<'_>, rows: &Range<usize>) -> Result<(), PartsError> {
        let folder = folder(&sweep.job().name);
        let name = self.table_name(sweep);
        let mut names = self
            .shelf
            .names(&folder)
            .map_err(PartsError::read(&folder))?;
        names.sort_unstable();
        let is_whole = self.part == Part::Whole;
        let within = |own: &Range<usize>| rows.start <= own.start && own.end <= rows.end;
        let (manifests, tables): (Vec<_>, Vec<_>) =
            names.iter().partition(|name| name.starts_with('_'));
        // Manifests first: a table without one is none.
        let mut kept = Vec::new();
        for manifest in manifests {
            let Some(own) = rows_of(manifest).filter(|own| is_whole || within(own)) else {
                continue;
            };
            let manifest = format!("{folder}/{manifest}");
            let read = Manifest::read(self.shelf, &manifest);
            let stays = match &read {
                Ok(read) if read.is_result() => !is_whole || read.run == self.origin.hash(),
                // Rows that this run has not are not its own to remove.
                _ if !within(&own) => true,
                Ok(read) => read.run == self.origin.hash() && !read.piece,
                Err(_) => false,
            };
            if !stays {
                remove(self.shelf, &manifest)?;
            } else if !read.is_ok_and(|read| read.is_result()) {
                kept.push(stem(&own));
            }
        }
        for table in tables {
            let full = format!("{folder}/{table}");
            let Some(own) = rows_of(table).filter(within) else {
                continue;
            };
            if full != name && !kept.contains(&stem(&own)) {
                remove(self.shelf, &full)?;
            }
        }
        self.shelf.remove_folder(&folder);
        self.forget()
    }

    /// Removes what was read for runs of which nothing is left.
    fn forget(&self) -> Result<(), PartsError> {
        let read = PartsError::read("parts");
        let names = self.shelf.names("parts").map_err(read)?;
        let (origins, jobs): (Vec<_>, Vec<_>) =
            names.iter().partition(|name| Origin::is_name(name));
        let mut used = HashSet::new();
        if !jobs.is_empty() {
            if Origin::is_alone(self.shelf, self.origin.hash())? {
                return Ok(());
            }
            used.insert(self.origin.name());
        }
        for job in jobs {
            let folder = folder(job);
            let names = self.shelf.names(&folder);
            for name in names.map_err(PartsError::read(&folder))? {
                if !name.starts_with('_') || rows_of(&name).is_none() {
                    continue;
                }
                match Manifest::read(self.shelf, &format!("{folder}/{name}")) {
                    Ok(manifest) => used.insert(Origin::name_of(&manifest.run)),
                    // It may be of any of them.
                    Err(_) => return Ok(()),
                };
            }
        }
        for origin in origins {
            let name = format!("parts/{origin}");
            if !used.contains(&name) {
                remove(self.shelf, &name)?;
            }
        }
        self.shelf.remove_folder("parts");
        Ok(())
    }
}
