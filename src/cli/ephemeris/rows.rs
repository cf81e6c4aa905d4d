//! Rows that somebody else wrote: a CSV file, read in blocks, and what each row asks for.
//!
//! The columns stand in any order, others are passed over; so are blank lines and those that begin
//! with `#`. A field in double quotes may hold commas (RFC 4180) but no end of a line.

use std::io::Read;

use crate::cli::error::CliError;
use crate::place::Place;
use crate::time::{Instant, JulianDate};

use super::names::{Names, unknown};
use super::sheet::{Asked, KEY_NUMBERS, KEYS};

/// No line of such a file is longer.
const LONGEST_LINE: usize = 1 << 20;
/// TT and UT1 of one instant are never farther apart: Delta-T is 1.3 days at -4000.
const MOST_DELTA_T_DAYS: f64 = 2.0;
/// A mark that some programs put before UTF-8.
pub const BYTE_ORDER_MARK: &str = "\u{feff}";

/// Places in [`KEYS`].
const BODY: usize = 0;
const UT1: [usize; 2] = [3, 4];

/// Where the columns are.
#[derive(Debug, Clone, PartialEq)]
pub struct Header {
    /// For each column of the file its place in [`KEYS`], if it has one.
    slots: Vec<Option<usize>>,
    has_ut1: bool,
}

impl Header {
    fn read(line: &str) -> Result<Header, String> {
        let mut slots = Vec::new();
        for name in fields(line) {
            let name = name?;
            let slot = KEYS.iter().position(|key| *key == name);
            if slot.is_some() && slots.contains(&slot) {
                return Err(format!("the column {name} is there twice; leave one out"));
            }
            slots.push(slot);
        }
        let lacks = |key: &usize| !slots.contains(&Some(*key));
        let has_ut1 = !UT1.iter().all(lacks);
        let missing: Vec<&str> = (0..KEYS.len())
            .filter(|key| lacks(key) && (has_ut1 || !UT1.contains(key)))
            .map(|key| KEYS[key])
            .collect();
        if !missing.is_empty() {
            return Err(format!(
                "no column {} in its head; the first line names the columns {}",
                missing.join(", "),
                KEYS.join(",")
            ));
        }
        Ok(Header { slots, has_ut1 })
    }

    /// The cells of a line in the order of [`KEYS`].
    fn cells<'a>(&self, line: &'a str) -> Result<[&'a str; KEYS.len()], String> {
        let mut cells = [""; KEYS.len()];
        let mut count = 0;
        for field in fields(line) {
            let field = field?;
            if let Some(Some(slot)) = self.slots.get(count) {
                cells[*slot] = field;
            }
            count += 1;
        }
        if count != self.slots.len() {
            return Err(format!("there are {count} fields under {} columns", self.slots.len()));
        }
        Ok(cells)
    }
}

/// The fields of a line, without the blanks around them.
pub fn fields(line: &str) -> impl Iterator<Item = Result<&str, String>> {
    let mut rest = Some(line);
    std::iter::from_fn(move || {
        let text = rest?;
        let quoted = text.trim_ascii_start().strip_prefix('"');
        let (field, after) = match quoted {
            None => match text.bytes().position(|byte| byte == b',') {
                Some(end) => (text[..end].trim_ascii(), Some(&text[end + 1..])),
                None => (text.trim_ascii(), None),
            },
            Some(quoted) => match closing(quoted) {
                Some(split) => split,
                None => {
                    rest = None;
                    return Some(Err("a quoted field is not closed before a comma or the end of \
                                     the line"
                        .to_owned()));
                }
            },
        };
        rest = after;
        Some(Ok(field))
    })
}

/// What stands between quotes, and what after the comma that follows. Two quotes are one, and are left
/// as they are: no field that is used has any.
fn closing(quoted: &str) -> Option<(&str, Option<&str>)> {
    let mut from = 0;
    loop {
        let end = from + quoted[from..].find('"')?;
        let after = &quoted[end + 1..];
        if after.starts_with('"') {
            from = end + 2;
            continue;
        }
        let after = after.trim_ascii_start();
        return match after.strip_prefix(',') {
            Some(next) => Some((quoted[..end].trim_ascii(), Some(next))),
            None => after.is_empty().then_some((quoted[..end].trim_ascii(), None)),
        };
    }
}

/// Whole lines of the file.
#[derive(Debug)]
pub struct RowBlock {
    source: std::sync::Arc<str>,
    /// The number of its first line, counted from 1.
    first_line: usize,
    bytes: Vec<u8>,
}

impl RowBlock {
    /// Bytes of the file.
    pub fn size(&self) -> u64 {
        self.bytes.len() as u64
    }

    /// Each row in turn.
    ///
    /// # Errors
    ///
    /// A line that cannot be read, or what is wrong with a row, with the number of its line.
    pub fn for_each_row(
        &self,
        header: &Header,
        names: &Names,
        row: &mut dyn FnMut(&Asked) -> Result<(), String>,
    ) -> Result<(), CliError> {
        let (text, is_whole) = self.text();
        for (line, number) in text.lines().zip(self.first_line..) {
            if is_passed_over(line) {
                continue;
            }
            read(line, header, names, row).map_err(|what| wrong(&self.source, number, &what))?;
        }
        is_whole
    }

    /// The lines before the first that is not UTF-8, and whether that is all of them.
    fn text(&self) -> (&str, Result<(), CliError>) {
        match std::str::from_utf8(&self.bytes) {
            Ok(text) => (text, Ok(())),
            Err(error) => {
                let before = &self.bytes[..error.valid_up_to()];
                let line = self.first_line + count_lines(before);
                let whole = before.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
                let text = std::str::from_utf8(&before[..whole]).unwrap_or_default();
                let what = "is not UTF-8; save the file as UTF-8";
                (text, Err(wrong(&self.source, line, what)))
            }
        }
    }
}

pub fn wrong(source: &str, line: usize, what: &str) -> CliError {
    CliError::Usage(format!("{source}, line {line}: {what}"))
}

pub fn is_passed_over(line: &str) -> bool {
    let line = line.trim_ascii_start();
    line.is_empty() || line.starts_with('#')
}

fn count_lines(bytes: &[u8]) -> usize {
    bytes.iter().filter(|byte| **byte == b'\n').count()
}

/// Hands on what a line asks for.
fn read(
    line: &str,
    header: &Header,
    names: &Names,
    row: &mut dyn FnMut(&Asked) -> Result<(), String>,
) -> Result<(), String> {
    let cells = header.cells(line)?;
    let target = names.find(cells[BODY]).ok_or_else(|| unknown(cells[BODY]))?;
    let has_ut1 = header.has_ut1 && UT1.iter().any(|key| !cells[*key].is_empty());
    let mut written = [""; KEY_NUMBERS];
    let mut numbers = [0.0; KEY_NUMBERS];
    for (index, (name, cell)) in KEYS.iter().zip(cells).enumerate().skip(1) {
        if has_ut1 || !UT1.contains(&index) {
            written[index - 1] = cell;
            numbers[index - 1] = number(name, cell)?;
        }
    }
    let [tt_1, tt_2, ut1_1, ut1_2, longitude_deg, latitude_deg, height_m] = numbers;
    let place =
        Place::new(latitude_deg, longitude_deg, height_m).map_err(|error| error.to_string())?;
    let tt = JulianDate::from_parts(tt_1, tt_2);
    let instant = if has_ut1 {
        let ut1 = JulianDate::from_parts(ut1_1, ut1_2);
        let apart_days = (tt.jd() - ut1.jd()).abs();
        if apart_days > MOST_DELTA_T_DAYS {
            return Err(format!(
                "TT and UT1 are {apart_days} days apart; give both of one instant, or no UT1"
            ));
        }
        Instant::from_tt_ut1(tt, ut1)
    } else {
        Instant::from_tt(tt)
    };
    let instant = instant.map_err(|error| error.to_string())?;
    if !has_ut1 {
        numbers[UT1[0] - 1] = instant.ut1.day();
        numbers[UT1[1] - 1] = instant.ut1.fraction();
    }
    row(&Asked { body: cells[BODY], target, instant, place: &place, numbers, written })
}

pub fn number(column: &str, cell: &str) -> Result<f64, String> {
    match cell.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ if cell.is_empty() => Err(format!("{column} is blank; give a number")),
        _ => Err(format!("{column} '{}' is no number", cell.chars().take(40).collect::<String>())),
    }
}

/// A file of rows, block by block.
pub struct RowBlocks<R> {
    source: std::sync::Arc<str>,
    reader: R,
    header: Header,
    block_bytes: usize,
    next_line: usize,
    /// What was read beyond the last whole line.
    rest: Vec<u8>,
}

impl<R: Read> RowBlocks<R> {
    /// Reads as far as the names of the columns.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, and one whose head lacks a column.
    pub fn open(source: String, reader: R, block_bytes: usize) -> Result<RowBlocks<R>, CliError> {
        let header = Header { slots: Vec::new(), has_ut1: false };
        let (source, rest) = (source.into(), Vec::new());
        let mut blocks = RowBlocks { source, reader, header, block_bytes, next_line: 1, rest };
        while let Some(block) = blocks.next()? {
            let (text, is_whole) = block.text();
            let unmarked = text.strip_prefix(BYTE_ORDER_MARK).filter(|_| block.first_line == 1);
            let text = unmarked.unwrap_or(text);
            let mut lines = text.lines().zip(block.first_line..);
            let Some((line, number)) = lines.find(|(line, _)| !is_passed_over(line)) else {
                is_whole?;
                continue;
            };
            blocks.header =
                Header::read(line).map_err(|what| wrong(&block.source, number, &what))?;
            // What follows the head in this block comes again as the first rows.
            let lines = number + 1 - block.first_line;
            let ends = block.bytes.iter().enumerate().filter(|(_, byte)| **byte == b'\n');
            let after = ends.map(|(at, _)| at + 1).nth(lines - 1).unwrap_or(block.bytes.len());
            blocks.rest.splice(..0, block.bytes[after..].iter().copied());
            blocks.next_line = number + 1;
            return Ok(blocks);
        }
        let what =
            format!("there are no rows; the first line names the columns {}", KEYS.join(","));
        Err(CliError::Usage(format!("{}: {what}", blocks.source)))
    }

    pub fn header(&self) -> &Header {
        &self.header
    }

    /// The next whole lines; none after the last.
    pub fn next(&mut self) -> Result<Option<RowBlock>, CliError> {
        let mut bytes = std::mem::take(&mut self.rest);
        let mut wanted = self.block_bytes;
        loop {
            let room = wanted.saturating_sub(bytes.len()) as u64;
            let read = self.reader.by_ref().take(room).read_to_end(&mut bytes);
            read.map_err(|error| {
                CliError::Failure(format!("cannot read {}: {error}", self.source))
            })?;
            let is_end = bytes.len() < wanted;
            let end = match bytes.iter().rposition(|byte| *byte == b'\n') {
                _ if is_end => bytes.len(),
                Some(last) => last + 1,
                None if bytes.len() < LONGEST_LINE => {
                    wanted = 2 * bytes.len().max(self.block_bytes);
                    continue;
                }
                None => {
                    let what = "is longer than a million bytes: this is no CSV file of rows";
                    return Err(wrong(&self.source, self.next_line, what));
                }
            };
            self.rest = bytes.split_off(end);
            let first_line = self.next_line;
            self.next_line += count_lines(&bytes);
            let source = self.source.clone();
            return Ok((!bytes.is_empty()).then_some(RowBlock { source, first_line, bytes }));
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;

    use proptest::prelude::*;

    use super::*;
    use crate::catalog::Catalogs;

    static NAMES: LazyLock<Names> =
        LazyLock::new(|| Names::read(&Catalogs::locate(None).unwrap()).unwrap());

    /// Body, numbers and UT1 of every row, or what is said of the first that is wrong.
    fn read_all(file: &[u8], block_bytes: usize) -> Result<Vec<String>, String> {
        let mut rows = Vec::new();
        let mut collect = || -> Result<(), CliError> {
            let mut blocks = RowBlocks::open("rows.csv".to_owned(), file, block_bytes)?;
            let header = blocks.header().clone();
            while let Some(block) = blocks.next()? {
                block.for_each_row(&header, &NAMES, &mut |asked| {
                    rows.push(format!("{} {:?}", asked.body, asked.numbers));
                    Ok(())
                })?;
            }
            Ok(())
        };
        let result = collect();
        result.map_err(|error| error.message().unwrap_or_default())?;
        Ok(rows)
    }

    #[test]
    fn fields_are_cut_at_commas_that_are_not_quoted() {
        let cut = |line| fields(line).collect::<Result<Vec<_>, _>>();
        assert_eq!(cut("a,b,,c").unwrap(), ["a", "b", "", "c"]);
        assert_eq!(cut(" a , \"b, \"\"c\"\"\" ,d").unwrap(), ["a", "b, \"\"c\"\"", "d"]);
        assert_eq!(cut("a\"b,c").unwrap(), ["a\"b", "c"]);
        assert_eq!(cut("").unwrap(), [""]);
        assert_eq!(cut("a,").unwrap(), ["a", ""]);
        assert_eq!(cut("\"\",\"\"").unwrap(), ["", ""]);
        for wrong in ["\"a", "a,\"b", "\"a\"b,c", "\"a\"\""] {
            assert!(cut(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_line_without_an_end_is_not_read_for_ever() {
        let message = read_all(&vec![b'x'; 3 << 20], 1 << 16).unwrap_err();
        assert!(message.contains("line 1") && message.contains("longer"), "{message}");
    }

    /// Pieces of files, good and bad.
    fn piece() -> impl Strategy<Value = &'static str> {
        proptest::sample::select(vec![
            "moon",
            "sirius",
            "2451545.5",
            "-0.25",
            "0",
            "90",
            "361",
            ",",
            ",",
            ",",
            ",",
            "\n",
            "\r\n",
            "\"",
            "#",
            " ",
            "NaN",
            "1e400",
            "é",
            "\u{feff}",
            "body",
            "height_m",
            "moon,2451545.5,0.1,2451545.5,0.1,7,50,100\n",
            "mars,2451545.5,0.1,,,7,50,100\n",
        ])
    }

    /// A number as people write numbers.
    fn written(range: std::ops::Range<f64>) -> impl Strategy<Value = String> {
        (range, 0..9usize).prop_map(|(number, places)| format!("{number:.places$}"))
    }

    proptest! {
        #[test]
        fn whatever_the_file_the_size_of_the_blocks_is_no_matter(
            pieces in prop::collection::vec(piece(), 0..60),
            has_head: bool,
            cut in prop::option::of(0..400usize),
            block_bytes in 1..200usize,
        ) {
            let head = if has_head { KEYS.join(",") + "\n" } else { String::new() };
            let mut file = (head + &pieces.concat()).into_bytes();
            // Anywhere, within letters of two bytes too.
            file.truncate(cut.unwrap_or(usize::MAX));
            prop_assert_eq!(read_all(&file, block_bytes), read_all(&file, 1 << 20));
        }

        #[test]
        fn bytes_that_are_no_table_are_refused_in_a_sentence(
            file in prop::collection::vec(any::<u8>(), 0..300),
        ) {
            let message = read_all(&file, 64).unwrap_err();
            prop_assert!(message.starts_with("rows.csv"), "{message}");
        }

        #[test]
        fn rows_are_read_as_they_were_written(
            order in Just((0..KEYS.len() + 2).collect::<Vec<_>>()).prop_shuffle(),
            rows in prop::collection::vec(
                (
                    proptest::sample::select(vec!["Sun", "pluto", "HR 1"]),
                    written(2_400_000.0..2_500_000.0),
                    written(-0.5..0.5),
                    (written(-180.0..360.0), written(-90.0..90.0), written(-400.0..9000.0)),
                    any::<[bool; 3]>(),
                ),
                1..20,
            ),
        ) {
            // Two columns of others among ours.
            let name = |key: &usize| *KEYS.get(*key).unwrap_or(&["note", "utc_iso"][key % 2]);
            let mut file = order.iter().map(name).collect::<Vec<_>>().join(",") + "\n";
            let mut expected = Vec::new();
            for (body, day, fraction, (lon, lat, height), [is_quoted, is_blank, has_comment]) in &rows {
                let cells =
                    [*body, day, fraction, day, fraction, lon, lat, height, "\"a, b\"", "#"];
                let cell = |key: &usize| match (cells[*key], is_quoted) {
                    (cell, true) if *key < KEYS.len() => format!("\"{cell}\""),
                    (cell, _) if *is_blank => format!(" {cell}\t"),
                    (cell, _) => cell.to_owned(),
                };
                if *has_comment {
                    file += "# a comment, with a comma\n\n";
                }
                // A line must not begin like a comment.
                let mut line = order.iter().map(cell).collect::<Vec<_>>().join(",");
                if line.trim_start().starts_with('#') {
                    line.insert(0, '-');
                }
                file += &(line + "\n");
                let numbers: Vec<f64> =
                    cells[1..KEYS.len()].iter().map(|cell| cell.parse().unwrap()).collect();
                expected.push(format!("{body} {numbers:?}"));
            }
            prop_assert_eq!(read_all(file.as_bytes(), 1 << 16), Ok(expected));
        }
    }
}
