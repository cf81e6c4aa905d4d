//! Long work in order, on all cores, without holding much of it: while a batch is reckoned, the one
//! before it is written and the one after it is read.

use std::io::{self, Write};

use rayon::prelude::*;

use crate::cli::error::CliError;
use crate::export::table::{Part, Sheet, TableWriter};

/// Blocks of work for each thread in a batch: enough that none waits long for the others.
const BLOCKS_PER_THREAD: usize = 32;

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::table::{Cell, Column, Format, Kind};

    fn sheet() -> Sheet {
        let columns = vec![Column { name: "number", kind: Kind::Exact }];
        Sheet { columns, format: Format::Csv }
    }

    /// A table of the numbers below `end`, of which `bad` are refused.
    fn table(end: usize, bad: &[usize], out: &mut Vec<u8>) -> Result<(), Stopped> {
        let sheet = sheet();
        let mut numbers = 0..end;
        run(
            &sheet,
            out,
            || Ok(numbers.next()),
            |number| {
                if bad.contains(&number) {
                    return Err(CliError::Usage(number.to_string()));
                }
                let mut part = sheet.part();
                sheet.add(&mut part, &[Cell::Number(number as f64)]);
                Ok(part)
            },
        )
    }

    #[test]
    fn blocks_come_out_in_the_order_in_which_they_went_in() {
        for end in [0, 1, 7, 1000] {
            let mut out = Vec::new();
            table(end, &[], &mut out).unwrap();
            let expected: String = (0..end).map(|number| format!("{number}\n")).collect();
            assert_eq!(String::from_utf8(out).unwrap(), format!("number\n{expected}"));
        }
    }

    #[test]
    fn the_first_error_is_told_and_early_ones_write_nothing() {
        let mut out = Vec::new();
        let Err(Stopped::Refused(error)) = table(1000, &[5, 3, 900], &mut out) else {
            panic!("not refused");
        };
        assert_eq!(error.message().unwrap(), "3");
        assert!(out.is_empty());
    }

    #[test]
    fn an_output_that_takes_nothing_stops_the_work() {
        struct Full;
        impl Write for Full {
            fn write(&mut self, _: &[u8]) -> io::Result<usize> {
                Err(io::ErrorKind::BrokenPipe.into())
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        let sheet = sheet();
        let mut blocks = 0;
        let endless = || {
            blocks += 1;
            Ok(Some(()))
        };
        let stopped = run(&sheet, &mut Full, endless, |()| Ok(sheet.part()));
        assert!(matches!(stopped, Err(Stopped::Unwritten(error))
            if error.kind() == io::ErrorKind::BrokenPipe));
        assert!(blocks < 1000, "{blocks}");
    }
}
