//! Rows that are not there yet, computed and kept piece by piece.

use std::io::{self, Write};
use std::ops::Range;
use std::time::Instant;

use super::super::error::PartsError;
use super::super::manifest::{FORM, Manifest, Table, folder, stem};
use super::super::part::Part;
use super::super::shelf::Draft;
use super::Work;
use crate::ran::Ran;
use crate::sweep::{Chunk, Columns, Ended, Sweep};
use crate::table::{self, TableWriter};

/// A file that is being written, with its size and hash so far.
pub(super) struct Counted {
    draft: Box<dyn Draft>,
    bytes: u64,
    hasher: blake3::Hasher,
}

impl Counted {
    pub(super) fn new(draft: Box<dyn Draft>) -> Self {
        Self {
            draft,
            bytes: 0,
            hasher: blake3::Hasher::new(),
        }
    }

    /// Gives it its name.
    pub(super) fn keep(self, name: &str) -> io::Result<Table> {
        self.draft.keep(name)?;
        Ok(Table {
            name: name.into(),
            bytes: self.bytes,
            blake3: self.hasher.finalize().to_hex().to_string(),
        })
    }
}

impl Write for Counted {
    fn write(&mut self, content: &[u8]) -> io::Result<usize> {
        let count = self.draft.write(content)?;
        self.bytes += count as u64;
        self.hasher.update(&content[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.draft.flush()
    }
}

/// A piece that is being written.
struct Piece {
    rows: Range<usize>,
    table: TableWriter<Counted>,
    ran: Ran,
}

impl Work<'_> {
    /// Computes rows, and keeps them in pieces; fewer where it is stopped. Where all of them are done before
    /// the first piece is to be kept, they get the name `result`, if there is one.
    pub(super) fn compute(
        &self,
        sweep: &Sweep<'_>,
        rows: Range<usize>,
        result: Option<String>,
        advance: &mut dyn FnMut(usize),
    ) -> Result<Vec<Manifest>, PartsError> {
        let options = self.origin.options();
        let format = options.format();
        let render = |chunk: &mut Chunk| {
            table::render(format, chunk);
            if options.summary {
                Ran::measure(chunk);
            }
        };
        let named = self.table_name(sweep);
        let cannot_write = PartsError::write(&named);
        let mut kept = Vec::new();
        let mut piece = self.begin(sweep, rows.start).map_err(&cannot_write)?;
        let mut since = Instant::now();
        let take = |chunk: &mut Chunk| {
            piece.table.append(chunk).map_err(&cannot_write)?;
            piece.ran.see(chunk);
            piece.rows.end = chunk.rows.end;
            advance(chunk.rows.len());
            if since.elapsed() >= self.secured_every && chunk.rows.end < rows.end {
                let next = self.begin(sweep, chunk.rows.end).map_err(&cannot_write)?;
                let full = std::mem::replace(&mut piece, next);
                kept.push(self.keep(sweep, full, None)?);
                since = Instant::now();
            }
            Ok(())
        };
        let swept = sweep.run_until(self.threads, rows.clone(), &self.stop, render, take);
        match swept {
            Ok(()) | Err(Ended::Stopped) => {}
            Err(Ended::Failed(error)) => return Err(error),
        }
        if !piece.rows.is_empty() {
            let whole = kept.is_empty() && piece.rows == rows;
            let result = result.filter(|_| whole);
            kept.push(self.keep(sweep, piece, result.as_deref())?);
        }
        Ok(kept)
    }

    /// Begins a piece at this row.
    fn begin(&self, sweep: &Sweep<'_>, first: usize) -> io::Result<Piece> {
        let job = sweep.job();
        Ok(Piece {
            rows: first..first,
            table: self.begin_table(sweep, first)?,
            ran: Ran::from_row(job, first, self.origin.options().summary),
        })
    }

    /// Begins a table of the rows from this one on.
    pub(super) fn begin_table(
        &self,
        sweep: &Sweep<'_>,
        first: usize,
    ) -> io::Result<TableWriter<Counted>> {
        let named = self.table_name(sweep);
        let draft = Counted::new(self.shelf.begin(&named)?);
        let notes = [("hyperstat.run", self.origin.hash())];
        let columns = Columns::of(sweep.job());
        TableWriter::from_row(
            draft,
            self.origin.options().format(),
            &columns,
            first,
            &notes,
        )
    }

    /// Keeps a piece, or all rows that are asked for by their name.
    fn keep(
        &self,
        sweep: &Sweep<'_>,
        piece: Piece,
        result: Option<&str>,
    ) -> Result<Manifest, PartsError> {
        let Piece { rows, table, ran } = piece;
        let job = &sweep.job().name;
        let own = || {
            let extension = self.origin.options().format().extension();
            format!("{}/{}.{extension}", folder(job), stem(&rows))
        };
        let name = result.map_or_else(own, String::from);
        let told = match self.part {
            Part::Whole => self.table_name(sweep),
            _ => name.clone(),
        };
        let cannot_write = PartsError::write(&told);
        let file = table.finish().map_err(&cannot_write)?;
        self.write_origin()?;
        let table = file.keep(&name).map_err(&cannot_write)?;
        let manifest = self.manifest(sweep, rows, table, ran, result.is_none());
        manifest.write(self.shelf).map_err(&cannot_write)?;
        Ok(manifest)
    }

    /// What is said of rows.
    pub(super) fn manifest(
        &self,
        sweep: &Sweep<'_>,
        rows: Range<usize>,
        table: Table,
        ran: Ran,
        piece: bool,
    ) -> Manifest {
        let found = ran.keep();
        Manifest {
            form: FORM,
            run: self.origin.hash().into(),
            job: sweep.job().name.clone(),
            rows,
            share: self.part.share(),
            piece,
            statuses: found.statuses(),
            table,
            found,
        }
    }
}
