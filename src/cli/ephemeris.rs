//! `nocturne ephemeris`: tables of where bodies and stars are seen, by span and step or for rows
//! that somebody else wrote.

mod names;
mod reckon;
pub(super) mod rows;
mod sheet;
mod span;
mod stream;

use std::fs::File;
use std::io::{self, IsTerminal, Read, Write};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use crate::catalog::Catalogs;
use crate::ephemeris::Ephemeris;
use crate::export::OutputFile;
use crate::export::table::{Format, Sheet};
use crate::units::Angle;

use super::WhereArgs;
use super::error::CliError;
use super::progress::Progress;

use names::Names;
use reckon::{Promise, Reckoner};
use rows::RowBlocks;
use sheet::{Asked, Layout};
use span::Span;
use stream::Stopped;

/// Bytes of the file of rows that one task reads.
const ROWS_BLOCK_BYTES: usize = 64 << 10;

#[derive(Debug, Args)]
pub struct EphemerisArgs {
    /// Bodies and stars, with commas between them: Mars,Moon,Sirius,"HR 7001"; all is the Sun to Pluto
    #[arg(long, value_name = "NAMES", conflicts_with = "rows", required_unless_present = "rows")]
    body: Option<String>,
    /// First instant; without an offset by the clocks of the place, else in UTC
    #[arg(long, value_name = "TIME", default_value = "now", allow_hyphen_values = true)]
    from: String,
    /// Last instant; without it there is one row for each body
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    to: Option<String>,
    /// From row to row, by civil time in UTC: 1d, 6h, 10m, 30s
    #[arg(long, value_name = "STEP", default_value = "1d", allow_hyphen_values = true)]
    step: String,
    #[command(flatten)]
    location: WhereArgs,
    /// A row of the table for each row of a CSV file with the columns body, jd_tt_1, jd_tt_2,
    /// jd_ut1_1, jd_ut1_2 (the two may be missing), lon_deg_E, lat_deg_N, height_m; - for standard
    /// input
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with_all = ["from", "to", "step", "place", "lat", "lon", "height"]
    )]
    rows: Option<PathBuf>,
    /// How good each direction must be; without it, the best there is
    #[arg(long, value_name = "ARCSEC", allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// How the table is written; without it as the name of the output ends, else a table on a
    /// terminal and CSV elsewhere
    #[arg(long, value_enum)]
    format: Option<FormatArg>,
    /// File to write, such as places.csv, .jsonl or .parquet; - or nothing for standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Say nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum FormatArg {
    Csv,
    /// Columns of equal width, without the Julian dates
    Table,
    /// One JSON object a line
    Jsonl,
    Parquet,
}

impl From<FormatArg> for Format {
    fn from(arg: FormatArg) -> Format {
        match arg {
            FormatArg::Csv => Format::Csv,
            FormatArg::Table => Format::Aligned,
            FormatArg::Jsonl => Format::JsonLines,
            FormatArg::Parquet => Format::Parquet,
        }
    }
}

pub fn run(
    args: &EphemerisArgs,
    catalogs: &Catalogs,
    out: &mut impl Write,
) -> Result<(), CliError> {
    let promise = promise(args.tolerance)?;
    let output = args.output.as_deref().filter(|path| *path != Path::new("-"));
    let format = format(args.format, output)?;
    let names = Names::read(catalogs)?;
    let ephemeris = Ephemeris::load(catalogs, promise.tolerance())?;
    let table = Table { names: &names, ephemeris: &ephemeris, promise, quiet: args.quiet };
    match &args.rows {
        Some(path) => {
            let source = Source::open(path)?;
            written(output, out, |out| table.of_rows(source, format, out))
        }
        None => {
            let place = args.location.find(catalogs)?;
            if place.is_none() && args.location.height.is_some() {
                let message = "--height asks for a place: give --place NAME, or --lat and --lon";
                return Err(CliError::Usage(message.to_owned()));
            }
            let bodies = args.body.as_deref().unwrap_or_default();
            let span = Span::read(
                names.list(bodies)?,
                &args.from,
                args.to.as_deref(),
                &args.step,
                place.as_ref(),
            )?;
            written(output, out, |out| table.of_span(&span, format, out))
        }
    }
}

fn promise(tolerance_arcsec: Option<f64>) -> Result<Promise, CliError> {
    match tolerance_arcsec {
        None => Ok(Promise::TheBest),
        Some(arcsec) if arcsec > 0.0 && arcsec <= 648_000.0 => {
            Ok(Promise::Within(Angle::from_arcsec(arcsec)))
        }
        Some(arcsec) => Err(CliError::Usage(format!(
            "--tolerance {arcsec} is outside 0 to 648000 (excluding 0); give arcseconds"
        ))),
    }
}

/// The format asked for, else that of the name of the output, else that of where it goes.
fn format(asked: Option<FormatArg>, output: Option<&Path>) -> Result<Format, CliError> {
    let to_terminal = output.is_none() && io::stdout().is_terminal();
    let format = match (asked, output) {
        (Some(asked), _) => asked.into(),
        (None, None) if to_terminal => Format::Aligned,
        (None, None) => Format::Csv,
        (None, Some(path)) => {
            let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
            match extension.to_ascii_lowercase().as_str() {
                "csv" => Format::Csv,
                "txt" => Format::Aligned,
                "jsonl" | "ndjson" => Format::JsonLines,
                "parquet" => Format::Parquet,
                _ => {
                    return Err(CliError::Usage(format!(
                        "--output {}: the name must end in .csv, .txt, .jsonl or .parquet, or give \
                         --format",
                        path.display()
                    )));
                }
            }
        }
    };
    if format == Format::Parquet && to_terminal {
        let message = "Parquet is not for a terminal; give --output FILE, or another --format";
        return Err(CliError::Usage(message.to_owned()));
    }
    Ok(format)
}

/// Has a table written to a file, whole or not at all, or else to standard output.
fn written(
    output: Option<&Path>,
    stdout: &mut impl Write,
    write: impl FnOnce(&mut dyn Write) -> Result<(), Stopped>,
) -> Result<(), CliError> {
    let Some(path) = output else {
        return write(stdout).map_err(|stopped| match stopped {
            Stopped::Refused(error) => error,
            Stopped::Unwritten(error) => error.into(),
        });
    };
    let file = OutputFile::create(path)?;
    let mut refused = None;
    let result = file.write(|out| {
        write(out).map_err(|stopped| match stopped {
            Stopped::Refused(error) => {
                refused = Some(error);
                io::Error::other("the table is not whole")
            }
            Stopped::Unwritten(error) => error,
        })
    });
    match refused {
        Some(error) => Err(error),
        None => Ok(result?),
    }
}

/// A file of rows, or standard input.
pub(super) struct Source {
    pub name: String,
    pub reader: Box<dyn Read>,
    /// Of a file, for the progress.
    pub(super) bytes: Option<u64>,
}

impl Source {
    pub fn open(path: &Path) -> Result<Source, CliError> {
        if path == Path::new("-") {
            let name = "standard input".to_owned();
            return Ok(Source { name, reader: Box::new(io::stdin()), bytes: None });
        }
        let unreadable = |error: io::Error| {
            CliError::Failure(format!(
                "cannot read {}: {error}; give --rows another file",
                path.display()
            ))
        };
        let file = File::open(path).map_err(unreadable)?;
        let known = file.metadata().map_err(unreadable)?;
        if known.is_dir() {
            return Err(unreadable(io::ErrorKind::IsADirectory.into()));
        }
        let bytes = known.is_file().then_some(known.len());
        Ok(Source { name: path.display().to_string(), reader: Box::new(file), bytes })
    }
}

/// What every table is made with.
struct Table<'a> {
    names: &'a Names,
    ephemeris: &'a Ephemeris,
    promise: Promise,
    quiet: bool,
}

impl Table<'_> {
    fn of_rows(&self, source: Source, format: Format, out: &mut dyn Write) -> Result<(), Stopped> {
        let mut blocks = RowBlocks::open(source.name, source.reader, ROWS_BLOCK_BYTES)?;
        let header = blocks.header().clone();
        let is_quiet = self.quiet || source.bytes.is_none();
        let progress = Progress::counting(is_quiet, source.bytes.unwrap_or(0), "bytes");
        self.of(
            Layout::of_rows(format),
            format,
            out,
            &progress,
            || blocks.next(),
            |block, row| {
                block.for_each_row(&header, self.names, row)?;
                Ok(block.size())
            },
        )
    }

    fn of_span(&self, span: &Span, format: Format, out: &mut dyn Write) -> Result<(), Stopped> {
        let layout = Layout::of_span(format, span.has_place(), span.has_moon());
        let mut blocks = span.blocks();
        let progress = Progress::counting(self.quiet, span.instants, "instants");
        self.of(
            layout,
            format,
            out,
            &progress,
            || Ok(blocks.next()),
            |instants, row| {
                span.for_each_row(instants, row)?;
                Ok(instants.end - instants.start)
            },
        )
    }

    /// A table of the blocks that `next` gives; `each` hands on their rows, and says how much of the
    /// whole a block is.
    fn of<B: Send>(
        &self,
        layout: Layout,
        format: Format,
        out: &mut dyn Write,
        progress: &Progress,
        next: impl FnMut() -> Result<Option<B>, CliError>,
        each: impl Fn(&B, &mut dyn FnMut(&Asked) -> Result<(), String>) -> Result<u64, CliError> + Sync,
    ) -> Result<(), Stopped> {
        let sheet = Sheet { columns: layout.columns(), format };
        let result = stream::run(&sheet, out, next, |block| {
            let mut part = sheet.part();
            let mut reckoner = Reckoner::new(self.ephemeris, self.promise);
            let size = each(&block, &mut |asked| {
                let figures = reckoner.figures(asked)?;
                layout.add(&sheet, &mut part, asked, &figures);
                Ok(())
            })?;
            progress.advance(size);
            Ok(part)
        });
        progress.finish();
        result
    }
}
