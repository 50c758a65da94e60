//! Parts that are all there, joined to one table.

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
    /// Joins parts of all rows that are asked for to their table, where they are not that yet, and removes the
    /// pieces. `computed` says whether any of them is new.
    pub(super) fn complete(
        &self,
        sweep: &Sweep<'_>,
        parts: &[Manifest],
        rows: &Range<usize>,
        computed: bool,
    ) -> Result<(), PartsError> {
        let name = self.table_name(sweep);
        let is_whole = self.part == Part::Whole;
        let has_pieces = parts.iter().any(|part| part.piece);
        // Of a table that was written at once nothing else is said.
        let mut recorded = !is_whole;
        match parts {
            // No rows are asked for.
            [] => return Ok(()),
            [all] if all.table.name == name => {
                recorded |= !computed;
                if recorded {
                    // Somebody may have lost it.
                    self.write_origin()?;
                }
                if all.piece {
                    // What was a piece of something else is what is asked for here.
                    let again = self.joined(sweep, parts, rows, all.table.clone());
                    again.write(self.shelf).map_err(PartsError::write(&name))?;
                }
            }
            _ => {
                let table = self.join(sweep, parts, rows)?;
                // That a run took long enough to have pieces is kept: it is not repeated in vain.
                if !is_whole || has_pieces {
                    self.write_origin()?;
                    let joined = self.joined(sweep, parts, rows, table);
                    joined.write(self.shelf).map_err(PartsError::write(&name))?;
                    recorded = true;
                }
            }
        }
        self.tidy(sweep, rows, recorded)
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

    /// Removes pieces whose rows are joined, and files that nobody can use; what is said of the job's whole
    /// table where it is not `recorded`.
    fn tidy(
        &self,
        sweep: &Sweep<'_>,
        rows: &Range<usize>,
        recorded: bool,
    ) -> Result<(), PartsError> {
        let folder = folder(&sweep.job().name);
        let name = self.table_name(sweep);
        let mut names = self
            .shelf
            .names(&folder)
            .map_err(PartsError::read(&folder))?;
        names.sort_unstable();
        let within =
            |name: &str| rows_of(name).filter(|own| rows.start <= own.start && own.end <= rows.end);
        let (manifests, tables): (Vec<_>, Vec<_>) =
            names.iter().partition(|name| name.starts_with('_'));
        // Manifests first: a table without one is none.
        let mut kept = Vec::new();
        for manifest in manifests {
            let Some(own) = within(manifest) else {
                continue;
            };
            let manifest = format!("{folder}/{manifest}");
            let stays = Manifest::read(self.shelf, &manifest).is_ok_and(|read| {
                let is_own = read.run == self.origin.hash() && !read.piece;
                let stays = match read.is_result() {
                    true => recorded,
                    false => is_own,
                };
                kept.extend((stays && !read.is_result()).then(|| stem(&own)));
                stays
            });
            if !stays {
                remove(self.shelf, &manifest)?;
            }
        }
        for table in tables {
            let full = format!("{folder}/{table}");
            let Some(own) = within(table) else { continue };
            if full != name && !kept.contains(&stem(&own)) {
                remove(self.shelf, &full)?;
            }
        }
        self.shelf.remove_folder(&folder);
        self.forget()
    }

    /// Removes what was read for parts, where there are none any more.
    fn forget(&self) -> Result<(), PartsError> {
        let names = self
            .shelf
            .names("parts")
            .map_err(PartsError::read("parts"))?;
        if names.iter().all(|name| Origin::is_name(name)) {
            for name in names {
                remove(self.shelf, &format!("parts/{name}"))?;
            }
        }
        self.shelf.remove_folder("parts");
        Ok(())
    }
}
