//! Tables of any length: the same rows as CSV, JSON lines, aligned text or Parquet.
//!
//! A [`Sheet`] says which columns there are and in which format; rows are collected into [`Part`]s,
//! on as many threads as there are, and a [`TableWriter`] puts the parts one after the other.

mod decimal;
mod parquet;
mod text;

use std::io::{self, Write};

/// Room for the lines of a part: less than most parts take, so that few of them have to move.
const PART_BYTES: usize = 1 << 17;

/// How a table is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// RFC 4180 with a line of column names, lines ending in LF.
    Csv,
    /// Columns of equal width, for people.
    Aligned,
    /// An object in each line; what is blank is null.
    JsonLines,
    /// Apache Parquet, uncompressed; what is blank is null.
    Parquet,
}

/// What stands in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Text that is seldom longer than this.
    Text(u8),
    /// A number with so many decimals.
    Fixed(u8),
    /// Degrees in `[0, 360)` with so many decimals; what rounds to 360 is written as 0.
    Turn(u8),
    /// A number with as many digits as it takes to read the same `f64` back.
    Exact,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    pub name: &'static str,
    pub kind: Kind,
}

impl Column {
    fn is_text(&self) -> bool {
        matches!(self.kind, Kind::Text(_))
    }
}

/// One value of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cell<'a> {
    Blank,
    /// For a column of text.
    Text(&'a str),
    /// For a column of numbers; finite.
    Number(f64),
    /// A number and the text that it was read from, which is repeated where text is written.
    Written(&'a str, f64),
}

/// The columns of a table and its format.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    pub columns: Vec<Column>,
    pub format: Format,
}

/// Some rows of a table, in its format.
#[derive(Debug, Clone)]
pub enum Part {
    /// Whole lines.
    Lines(Vec<u8>),
    Columns(parquet::Rows),
}

impl Sheet {
    /// No rows yet.
    pub fn part(&self) -> Part {
        match self.format {
            Format::Parquet => Part::Columns(parquet::Rows::new(&self.columns)),
            _ => Part::Lines(Vec::with_capacity(PART_BYTES)),
        }
    }

    /// Adds a row: a cell for each column, in order.
    pub fn add(&self, part: &mut Part, cells: &[Cell]) {
        debug_assert_eq!(cells.len(), self.columns.len());
        match (part, self.format) {
            (Part::Columns(rows), _) => rows.add(cells),
            (Part::Lines(out), Format::JsonLines) => text::json_line(out, &self.columns, cells),
            (Part::Lines(out), Format::Aligned) => text::aligned_line(out, &self.columns, cells),
            (Part::Lines(out), _) => text::csv_line(out, &self.columns, cells),
        }
    }
}

/// Puts the parts of a table one after the other.
pub struct TableWriter<'a, W> {
    out: W,
    parquet: Option<parquet::Writer<'a>>,
}

impl<'a, W: Write> TableWriter<'a, W> {
    /// Writes what stands before the first row.
    pub fn begin(sheet: &'a Sheet, mut out: W) -> io::Result<TableWriter<'a, W>> {
        let columns = &sheet.columns;
        let mut parquet = None;
        match sheet.format {
            Format::Csv => out.write_all(&text::csv_head(columns))?,
            Format::Aligned => out.write_all(&text::aligned_head(columns))?,
            Format::JsonLines => {}
            Format::Parquet => parquet = Some(parquet::Writer::begin(columns, &mut out)?),
        }
        Ok(TableWriter { out, parquet })
    }

    /// Writes parts made by the same sheet; in Parquet they become one row group.
    pub fn put(&mut self, parts: &[Part]) -> io::Result<()> {
        let groups: Vec<&parquet::Rows> = parts
            .iter()
            .filter_map(|part| if let Part::Columns(rows) = part { Some(rows) } else { None })
            .collect();
        if let Some(parquet) = &mut self.parquet {
            parquet.put(&mut self.out, &groups)?;
        }
        for part in parts {
            if let Part::Lines(lines) = part {
                self.out.write_all(lines)?;
            }
        }
        Ok(())
    }

    /// Writes what stands after the last row.
    pub fn end(mut self) -> io::Result<()> {
        if let Some(parquet) = self.parquet {
            parquet.end(&mut self.out)?;
        }
        self.out.flush()
    }
}
