//! Long work in order, on all cores, without holding much of it: while a batch is reckoned, the one
//! before it is written and the one after it is read.

use std::io::{self, Write};

use rayon::prelude::*;

use crate::export::table::{Part, Sheet, TableWriter};

use super::super::error::CliError;

/// Blocks of work for each thread in a batch: enough that none waits long for the others.
const BLOCKS_PER_THREAD: usize = 8;

/// Why a table was not finished.
#[derive(Debug)]
pub enum Stopped {
    /// It could not be made.
    Refused(CliError),
    /// It could not be written.
    Unwritten(io::Error),
}

impl From<CliError> for Stopped {
    fn from(error: CliError) -> Stopped {
        Stopped::Refused(error)
    }
}

impl From<io::Error> for Stopped {
    fn from(error: io::Error) -> Stopped {
        Stopped::Unwritten(error)
    }
}

/// Makes a table of the blocks that `next` gives, until it gives none.
///
/// The parts are written in the order of the blocks. Of several errors the first in this order is
/// told; nothing of its batch is written.
pub fn run<B: Send>(
    sheet: &Sheet,
    out: &mut dyn Write,
    mut next: impl FnMut() -> Result<Option<B>, CliError>,
    work: impl Fn(B) -> Result<Part, CliError> + Sync,
) -> Result<(), Stopped> {
    let size = BLOCKS_PER_THREAD * rayon::current_num_threads();
    let mut read = || -> Result<Vec<B>, CliError> {
        let mut batch = Vec::with_capacity(size);
        while batch.len() < size {
            match next()? {
                Some(block) => batch.push(block),
                None => break,
            }
        }
        Ok(batch)
    };
    let reckon = |batch: Vec<B>| -> Vec<Result<Part, CliError>> {
        batch.into_par_iter().map(&work).collect()
    };
    // The first batch is reckoned before anything is written: small tables are whole or not there.
    let mut parts = whole(reckon(read()?))?;
    let mut batch = read()?;
    let mut writer = TableWriter::begin(sheet, out)?;
    while !batch.is_empty() {
        let mut reckoned = Vec::new();
        let meanwhile = rayon::in_place_scope(|scope| -> Result<Vec<B>, Stopped> {
            scope.spawn(|_| reckoned = reckon(std::mem::take(&mut batch)));
            writer.put(&parts)?;
            Ok(read()?)
        });
        batch = meanwhile?;
        parts = whole(reckoned)?;
    }
    writer.put(&parts)?;
    Ok(writer.end()?)
}

fn whole(results: Vec<Result<Part, CliError>>) -> Result<Vec<Part>, CliError> {
    results.into_iter().collect()
}
