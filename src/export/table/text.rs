//! Lines of text: CSV, JSON lines, aligned columns.

use std::io::Write;

use super::decimal::{write_fixed, write_turn};
use super::{Cell, Column, Kind};

/// The line of column names.
pub fn csv_head(columns: &[Column]) -> Vec<u8> {
    let names: Vec<&str> = columns.iter().map(|column| column.name).collect();
    format!("{}\n", names.join(",")).into_bytes()
}

pub fn csv_line(out: &mut Vec<u8>, columns: &[Column], cells: &[Cell]) {
    for (column, cell) in columns.iter().zip(cells) {
        match *cell {
            Cell::Blank => {}
            Cell::Text(text) | Cell::Written(text, _) => csv_text(out, text),
            Cell::Number(value) => number(out, column.kind, value),
        }
        out.push(b',');
    }
    end_line(out);
}

/// Quotes where they are needed.
fn csv_text(out: &mut Vec<u8>, text: &str) {
    if text.contains([',', '"', '\n', '\r']) {
        out.push(b'"');
        out.extend_from_slice(text.replace('"', "\"\"").as_bytes());
        out.push(b'"');
    } else {
        out.extend_from_slice(text.as_bytes());
    }
}

pub fn json_line(out: &mut Vec<u8>, columns: &[Column], cells: &[Cell]) {
    out.push(b'{');
    for (column, cell) in columns.iter().zip(cells) {
        // Names of columns hold nothing that JSON would have escaped.
        out.push(b'"');
        out.extend_from_slice(column.name.as_bytes());
        out.extend_from_slice(b"\":");
        match *cell {
            Cell::Blank => out.extend_from_slice(b"null"),
            Cell::Text(text) => json_text(out, text),
            Cell::Number(value) => number(out, column.kind, value),
            Cell::Written(text, _) if is_json_number(text) => {
                out.extend_from_slice(text.as_bytes());
            }
            Cell::Written(_, value) => number(out, Kind::Exact, value),
        }
        out.push(b',');
    }
    out.pop();
    out.extend_from_slice(b"}\n");
}

/// Whether JSON has this for a number: people write ".5", "+1" and "007" too.
fn is_json_number(text: &str) -> bool {
    let digits = text.strip_prefix('-').unwrap_or(text);
    let (whole, part) = digits.split_once('.').unwrap_or((digits, "0"));
    let is_digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    is_digits(whole) && is_digits(part) && (whole.len() == 1 || !whole.starts_with('0'))
}

fn json_text(out: &mut Vec<u8>, text: &str) {
    serde_json::to_writer(out, text).expect("memory takes all that is written");
}

/// The names over their columns.
pub fn aligned_head(columns: &[Column]) -> Vec<u8> {
    let mut out = Vec::new();
    for column in columns {
        pad(&mut out, column, column.name);
    }
    trim_line(&mut out);
    out
}

pub fn aligned_line(out: &mut Vec<u8>, columns: &[Column], cells: &[Cell]) {
    let mut digits = Vec::new();
    for (column, cell) in columns.iter().zip(cells) {
        let text = match *cell {
            Cell::Blank => "",
            Cell::Text(text) | Cell::Written(text, _) => text,
            Cell::Number(value) => {
                digits.clear();
                number(&mut digits, column.kind, value);
                std::str::from_utf8(&digits).expect("digits are ASCII")
            }
        };
        pad(out, column, text);
    }
    trim_line(out);
}

/// Numbers to the right, text to the left, and two blanks.
fn pad(out: &mut Vec<u8>, column: &Column, text: &str) {
    let widest = match column.kind {
        Kind::Text(width) => usize::from(width),
        // Sign, three digits, the point.
        Kind::Turn(decimals) => 5 + usize::from(decimals),
        // As far as Pluto in kilometres.
        Kind::Fixed(decimals) if decimals < 9 => 11 + usize::from(decimals),
        Kind::Fixed(decimals) => 5 + usize::from(decimals),
        Kind::Exact => 10,
    };
    let width = widest.max(column.name.len());
    let padded = match column.kind {
        Kind::Text(_) => write!(out, "{text:width$}  "),
        _ => write!(out, "{text:>width$}  "),
    };
    padded.expect("memory takes all that is written");
}

/// Takes the blanks at the end of a line away.
fn trim_line(out: &mut Vec<u8>) {
    while out.last() == Some(&b' ') {
        out.pop();
    }
    out.push(b'\n');
}

/// Puts the end of the line in the place of the last comma.
fn end_line(out: &mut Vec<u8>) {
    out.pop();
    out.push(b'\n');
}

fn number(out: &mut Vec<u8>, kind: Kind, value: f64) {
    match kind {
        Kind::Fixed(decimals) => write_fixed(out, value, decimals),
        Kind::Turn(decimals) => write_turn(out, value, decimals),
        Kind::Exact | Kind::Text(_) => {
            write!(out, "{value}").expect("memory takes all that is written");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: [Column; 4] = [
        Column { name: "body", kind: Kind::Text(10) },
        Column { name: "jd", kind: Kind::Exact },
        Column { name: "ra_deg", kind: Kind::Turn(9) },
        Column { name: "dist_km", kind: Kind::Fixed(4) },
    ];

    fn line(write: fn(&mut Vec<u8>, &[Column], &[Cell]), cells: [Cell; 4]) -> String {
        let mut out = Vec::new();
        write(&mut out, &COLUMNS, &cells);
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn a_row_is_written_in_every_way() {
        let cells =
            [Cell::Text("Mars"), Cell::Written("+.50", 0.5), Cell::Number(7.25), Cell::Blank];
        assert_eq!(line(csv_line, cells), "Mars,+.50,7.250000000,\n");
        assert_eq!(
            line(json_line, cells),
            "{\"body\":\"Mars\",\"jd\":0.5,\"ra_deg\":7.250000000,\"dist_km\":null}\n"
        );
        assert_eq!(line(aligned_line, cells), "Mars              +.50     7.250000000\n");
        assert_eq!(csv_head(&COLUMNS), b"body,jd,ra_deg,dist_km\n");
        let head = String::from_utf8(aligned_head(&COLUMNS)).unwrap();
        assert_eq!(head, "body                jd          ra_deg          dist_km\n");
    }

    #[test]
    fn numbers_are_repeated_where_json_has_them() {
        for number in ["0", "-0.5", "10.25", "2451545"] {
            assert!(is_json_number(number), "{number}");
        }
        for other in ["", "-", ".5", "5.", "+1", "007", "1e5", "0x1", "1.2.3", "NaN", "--1"] {
            assert!(!is_json_number(other), "{other}");
        }
    }

    #[test]
    fn text_that_would_break_a_line_is_quoted() {
        let text = "a \"b\", c";
        let cells = [Cell::Text(text), Cell::Number(0.1), Cell::Blank, Cell::Blank];
        assert_eq!(line(csv_line, cells), "\"a \"\"b\"\", c\",0.1,,\n");
        let json = line(json_line, cells);
        let value: serde_json::Value = serde_json::from_str(&json).unwrap();
        assert_eq!((value["body"].as_str(), value["jd"].as_f64()), (Some(text), Some(0.1)));
    }
}
