//! Reading the dates and times that people type.

use std::time::{SystemTime, UNIX_EPOCH};

use crate::time::calendar::CivilDateTime;
use crate::time::error::TimeError;
use crate::units::DAY_S;

/// Modified Julian date of 1970-01-01.
const UNIX_EPOCH_MJD: i64 = 40_587;

/// The widest offset from UTC that is read, seconds: Manila kept -15:56 until 1844.
const MAX_OFFSET_S: i32 = 18 * 3600;

/// A date and time as written, with its offset from UTC if one was given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Written {
    pub civil: CivilDateTime,
    /// Local time less UTC, seconds.
    pub offset_s: Option<i32>,
}

/// Reads a date and time: `2026-08-12T21:30-07:00`, `2026-08-12 21:30:15.5Z`, `-0584-05-28T14:00Z`.
///
/// A date alone means its first midnight. An offset is `Z`, `UTC`, or hours and minutes with a sign
/// (`-07:00`, `+0530`, `-07`). Years are astronomical. `now` is what the system clock says, in UTC.
pub fn parse(text: &str) -> Result<Written, TimeError> {
    // A typographic minus is as good as a hyphen.
    let plain = text.trim().replace('\u{2212}', "-");
    if plain.eq_ignore_ascii_case("now") {
        return Ok(now());
    }
    let syntax = || TimeError::Syntax(text.trim().to_string());
    let (date, time) = match plain.split_once(|c: char| matches!(c, 'T' | 't') || c.is_whitespace())
    {
        Some((date, time)) => (date, Some(time.trim())),
        None => (plain.as_str(), None),
    };
    let (year, month, day) = read_date(date).ok_or_else(syntax)?;
    let Some(time) = time else {
        return Ok(Written { civil: CivilDateTime::midnight(year, month, day)?, offset_s: None });
    };
    let clock_length = time
        .find(|c: char| !c.is_ascii_digit() && !matches!(c, ':' | '.' | ','))
        .unwrap_or(time.len());
    let (clock, offset) = time.split_at(clock_length);
    let (hour, minute, second) = read_clock(clock).ok_or_else(syntax)?;
    let civil = CivilDateTime::new(year, month, day, hour, minute, second)?;
    let offset_s = match offset.trim() {
        "" => None,
        offset => Some(read_offset_s(offset).ok_or_else(syntax)?),
    };
    if offset_s.is_some_and(|s| s.abs() > MAX_OFFSET_S) {
        return Err(TimeError::Offset(offset.trim().to_string()));
    }
    Ok(Written { civil, offset_s })
}

/// The system clock, in UTC. Such clocks hide leap seconds.
fn now() -> Written {
    let since_1970_s = match SystemTime::now().duration_since(UNIX_EPOCH) {
        Ok(after) => after.as_secs_f64(),
        Err(before) => -before.duration().as_secs_f64(),
    };
    let days = (since_1970_s / DAY_S).floor();
    let second_of_day = since_1970_s - days * DAY_S;
    let civil = CivilDateTime::from_day(UNIX_EPOCH_MJD + days as i64, second_of_day, DAY_S);
    Written { civil, offset_s: Some(0) }
}

/// `2026-08-12`, `-0584-05-28`, `+2026-08-12`.
fn read_date(date: &str) -> Option<(i32, u8, u8)> {
    let (sign, unsigned) = match date.strip_prefix('-') {
        Some(rest) => (-1, rest),
        None => (1, date.strip_prefix('+').unwrap_or(date)),
    };
    let mut fields = unsigned.split('-');
    let year = sign * i32::try_from(digits(fields.next()?, 6)?).ok()?;
    let (month, day) = (digits(fields.next()?, 2)?, digits(fields.next()?, 2)?);
    let is_over = fields.next().is_none();
    is_over.then_some((year, month as u8, day as u8))
}

/// `21:30`, `21:30:15`, `21:30:15.5`.
fn read_clock(clock: &str) -> Option<(u8, u8, f64)> {
    let mut fields = clock.split(':');
    let (hour, minute) = (digits(fields.next()?, 2)?, digits(fields.next()?, 2)?);
    let second = match fields.next() {
        None => 0.0,
        Some(second) => {
            let second = second.replace(',', ".");
            // The whole seconds must be digits, which keeps out what a float may look like.
            digits(second.split('.').next()?, 2)?;
            second.parse().ok()?
        }
    };
    let is_over = fields.next().is_none();
    is_over.then_some((hour as u8, minute as u8, second))
}

/// `Z`, `UTC`, `GMT`, `-07:00`, `-0700`, `-07`, and `-07:26:36` of the local mean times.
fn read_offset_s(offset: &str) -> Option<i32> {
    if ["z", "utc", "gmt"].iter().any(|name| offset.eq_ignore_ascii_case(name)) {
        return Some(0);
    }
    let (sign, unsigned) = match offset.strip_prefix('-') {
        Some(rest) => (-1, rest),
        None => (1, offset.strip_prefix('+')?),
    };
    let is_compact = unsigned.len() == 4 && digits(unsigned, 4).is_some();
    let fields: Vec<&str> = if is_compact {
        vec![&unsigned[..2], &unsigned[2..]]
    } else {
        unsigned.split(':').collect()
    };
    let fields: Vec<i32> =
        fields.iter().map(|field| Some(digits(field, 2)? as i32)).collect::<Option<_>>()?;
    let is_sexagesimal = fields.iter().skip(1).all(|&field| field < 60);
    if fields.len() > 3 || !is_sexagesimal {
        return None;
    }
    Some(sign * fields.iter().zip([3600, 60, 1]).map(|(field, unit)| field * unit).sum::<i32>())
}

/// A whole number of one to `most` decimal digits and nothing else.
fn digits(text: &str, most: usize) -> Option<u32> {
    let is_number = (1..=most).contains(&text.len()) && text.bytes().all(|b| b.is_ascii_digit());
    is_number.then(|| text.parse().ok())?
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_people_type_is_read() {
        let cases = [
            ("2026-08-12T21:30-07:00", "2026-08-12T21:30:00-07:00"),
            ("2026-08-12 21:30:15.5Z", "2026-08-12T21:30:15.5Z"),
            ("  2026-08-12  ", "2026-08-12T00:00:00"),
            ("2026-8-2 9:05", "2026-08-02T09:05:00"),
            ("-0584-05-28T14:00Z", "-0584-05-28T14:00:00Z"),
            ("\u{2212}584-05-28t14:00z", "-0584-05-28T14:00:00Z"),
            ("2026-08-12 21:30:15,25 UTC", "2026-08-12T21:30:15.25Z"),
            ("+2026-08-12T21:30+0545", "2026-08-12T21:30:00+05:45"),
            ("2026-08-12 21:30 -07", "2026-08-12T21:30:00-07:00"),
            ("1880-01-01T12:00-07:26:36", "1880-01-01T12:00:00-07:26:36"),
            ("2016-12-31T16:59:60-07:00", "2016-12-31T16:59:60-07:00"),
        ];
        for (text, shown) in cases {
            assert_eq!(parse(text).unwrap().to_string(), shown, "{text}");
            assert_eq!(parse(shown).unwrap(), parse(text).unwrap());
        }
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        let nonsense = [
            "",
            "T",
            "tomorrow",
            "2026",
            "2026-08",
            "2026-08-12T",
            "2026-08-12T21",
            "2026-08-12Z",
            "2026-08-12T21:30:inf",
            "2026-08-12T21:30:1e1",
            "2026-08-12T21:30:15.5.5",
            "2026-08-12T21:30+",
            "2026-08-12T21:30+7:60",
            "2026-08-12T21:30X",
            "2026-08-12-01",
            "2026-08-12T21:30:00:00",
            "--2026-08-12",
            "2026-08-12T-1:30",
            "2026-08-1é",
            "2026-08-12T21:30é",
            "12/08/2026",
            "2026-08-12T21:30+1:2:3:4",
            "9999999-01-01",
        ];
        for text in nonsense {
            assert_eq!(parse(text), Err(TimeError::Syntax(text.to_string())), "{text}");
        }
        assert!(matches!(parse("2026-08-12T21:30+19:00"), Err(TimeError::Offset(_))));
        assert!(matches!(parse("2026-02-30"), Err(TimeError::Day { .. })));
        assert!(matches!(parse("2026-08-12T25:00"), Err(TimeError::Field { value: 25, .. })));
        assert!(matches!(parse("1582-10-05"), Err(TimeError::CalendarGap(5))));
        assert!(matches!(parse("-5000-01-01"), Err(TimeError::Year(-5000))));
    }

    #[test]
    fn now_is_between_before_and_after() {
        let seconds = |written: Written| {
            written.civil.mjd() as f64 * DAY_S + written.civil.second_of_day()
                - UNIX_EPOCH_MJD as f64 * DAY_S
        };
        let clock = || SystemTime::now().duration_since(UNIX_EPOCH).unwrap().as_secs_f64();
        let (before, now, after) = (clock(), parse("now").unwrap(), clock());
        assert_eq!(now.offset_s, Some(0));
        // A clock counted from 1858 in one float is good to a microsecond.
        assert!(before - 1e-5 <= seconds(now) && seconds(now) <= after + 1e-5);
    }
}
