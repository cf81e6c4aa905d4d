//! An almanac for calendars: iCalendar, RFC 5545.
//!
//! Times are in UTC, dates in the Gregorian calendar, carried on before 1582 as the format asks. Lines
//! end in CRLF and are folded at 75 octets. An identifier holds what happens, to whom, when and where,
//! so that an almanac that is read again replaces its events and does not double them.

use std::io::{self, Write};

use crate::almanac::Event;
use crate::time::Instant;

use super::sheet::{Heading, Sheet, to_the_second};
use super::{CliError, table};

/// The longest line without its end, octets (RFC 5545, section 3.1).
const LINE_OCTETS: usize = 75;
/// Modified Julian date of 0000-03-01 in the Gregorian calendar.
const MARCH_ZERO_MJD: i64 = -678_881;

/// One `VEVENT` for each event.
pub struct Ics {
    /// When the file is made.
    stamp: String,
}

impl Ics {
    /// # Errors
    ///
    /// Years that the format cannot write.
    pub fn new(heading: &Heading, now: Instant) -> Result<Ics, CliError> {
        for instant in [&heading.from, &heading.to] {
            let (year, _, _) = gregorian(instant.utc_civil().mjd());
            if !(1..=9999).contains(&year) {
                return Err(CliError::Usage(format!(
                    "--format ics: year {year} is outside 1 to 9999, which calendars can write; choose csv or json"
                )));
            }
        }
        Ok(Ics { stamp: date_time(&now) })
    }
}

impl Sheet for Ics {
    fn begin(&mut self, heading: &Heading, out: &mut dyn Write) -> io::Result<()> {
        let version = env!("CARGO_PKG_VERSION");
        line(out, "BEGIN:VCALENDAR")?;
        line(out, "VERSION:2.0")?;
        line(out, &format!("PRODID:-//Nocturne//nocturne {version}//EN"))?;
        line(out, "CALSCALE:GREGORIAN")?;
        let whose = heading.place_name().map_or_else(String::new, |name| format!(" of {name}"));
        line(out, &format!("X-WR-CALNAME:{}", escaped(&format!("Sky{whose}"))))?;
        let lines: Vec<&str> = heading.notes().collect();
        line(out, &format!("X-WR-CALDESC:{}", escaped(&lines.join("\n"))))
    }

    fn event(&mut self, heading: &Heading, event: &Event, out: &mut dyn Write) -> io::Result<()> {
        let what = &event.what;
        let start = date_time(&event.instant);
        let whom: Vec<String> =
            what.targets().iter().map(|target| target.name().replace(' ', "-")).collect();
        let place = heading.place.as_ref().filter(|_| what.class().is_local());
        let at = place.map(|place| (place.latitude.deg(), place.longitude.deg()));
        let where_ = at.map_or_else(String::new, |(lat, lon)| format!("-{lat:+.4}{lon:+.4}"));
        let uid = format!("{}-{}-{start}{where_}@nocturne", what.code(), whom.join("-"));
        line(out, "BEGIN:VEVENT")?;
        line(out, &format!("UID:{}", escaped(&uid)))?;
        line(out, &format!("DTSTAMP:{}", self.stamp))?;
        line(out, &format!("DTSTART:{start}"))?;
        if let Some(end) = what.end() {
            line(out, &format!("DTEND:{}", date_time(end)))?;
        }
        line(out, &format!("SUMMARY:{}", escaped(&what.to_string())))?;
        let details = table::details(heading, event);
        if !details.is_empty() {
            line(out, &format!("DESCRIPTION:{}", escaped(&details)))?;
        }
        if let Some((lat, lon)) = at {
            let name = heading.place_name().unwrap_or_default();
            line(out, &format!("LOCATION:{}", escaped(&name)))?;
            line(out, &format!("GEO:{lat:.6};{lon:.6}"))?;
        }
        line(out, &format!("CATEGORIES:{}", escaped(what.class().name())))?;
        // The sky asks nobody's time.
        line(out, "TRANSP:TRANSPARENT")?;
        line(out, "END:VEVENT")
    }

    fn end(&mut self, _: &Heading, out: &mut dyn Write) -> io::Result<()> {
        line(out, "END:VCALENDAR")
    }
}

/// `20260118T143105Z`.
fn date_time(instant: &Instant) -> String {
    let civil = to_the_second(instant).utc_civil();
    let (year, month, day) = gregorian(civil.mjd());
    let (hour, minute, second) = (civil.hour, civil.minute, civil.second.round());
    format!("{year:04}{month:02}{day:02}T{hour:02}{minute:02}{second:02}Z")
}

/// Year, month and day of the Gregorian calendar, also before there was one.
fn gregorian(mjd: i64) -> (i64, i64, i64) {
    let days = mjd - MARCH_ZERO_MJD;
    // 146097 days in four centuries, 1461 in four years; the leap day is the last of its year.
    let century = (4 * days + 3).div_euclid(146_097);
    let in_century = days - (146_097 * century).div_euclid(4);
    let year = (4 * in_century + 3) / 1461;
    let in_year = in_century - 1461 * year / 4;
    let month_from_march = (5 * in_year + 2) / 153;
    let day = in_year - (153 * month_from_march + 2) / 5 + 1;
    let month = (month_from_march + 2) % 12 + 1;
    (100 * century + year + i64::from(month < 3), month, day)
}

/// Text as a value (RFC 5545, section 3.3.11).
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' | ';' | ',' => escaped.extend(['\\', c]),
            '\n' => escaped.push_str("\\n"),
            c if c.is_control() => {}
            c => escaped.push(c),
        }
    }
    escaped
}

/// Writes a line, folded between characters.
fn line(out: &mut dyn Write, text: &str) -> io::Result<()> {
    let (mut rest, mut room) = (text, LINE_OCTETS);
    while rest.len() > room {
        let cut = (1..=room).rev().find(|&at| rest.is_char_boundary(at)).unwrap_or(room);
        write!(out, "{}\r\n ", &rest[..cut])?;
        // The blank that begins a folded line counts.
        (rest, room) = (&rest[cut..], LINE_OCTETS - 1);
    }
    write!(out, "{rest}\r\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::time::{parse, to_instant};

    #[test]
    fn dates_are_gregorian_also_where_ours_are_julian() {
        let shown = |text: &str| date_time(&to_instant(&parse(text).unwrap(), None).unwrap());
        assert_eq!(shown("2026-01-18T14:31:05.6Z"), "20260118T143106Z");
        assert_eq!(shown("2026-12-31T23:59:59.7Z"), "20270101T000000Z");
        assert_eq!(shown("1582-10-15T00:00Z"), "15821015T000000Z");
        // Meeus 1998, chapter 7: the Julian calendar was ten days behind.
        assert_eq!(shown("1582-10-04T12:00Z"), "15821014T120000Z");
        assert_eq!(shown("1500-02-29T00:00Z"), "15000310T000000Z");
        // In the third century both agreed.
        assert_eq!(shown("0250-06-01T00:00Z"), "02500601T000000Z");
    }

    #[test]
    fn lines_are_folded_between_characters_and_unfold_to_themselves() {
        for text in ["short".to_owned(), "°".repeat(200), format!("x{}", "°".repeat(200))] {
            let mut out = Vec::new();
            line(&mut out, &text).unwrap();
            let folded = String::from_utf8(out).unwrap();
            assert!(folded.split("\r\n").all(|line| line.len() <= LINE_OCTETS));
            assert_eq!(folded.replace("\r\n ", ""), text + "\r\n");
        }
    }

    #[test]
    fn what_has_a_meaning_in_the_format_is_escaped() {
        assert_eq!(escaped("a,b;c\\d\ne\r"), "a\\,b\\;c\\\\d\\ne");
    }
}
