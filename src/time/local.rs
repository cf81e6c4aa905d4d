//! Civil time in time zones: the one place where chrono and its time zone tables are used.
//!
//! chrono counts in the proleptic Gregorian calendar; days are handed over by number, so that the
//! Julian dates before 1582 mean the right day. Before standard time a zone keeps the local mean
//! time of its city. The tables' daylight saving rules end with the year 2099.

use std::fmt;

use chrono::{
    DateTime, Datelike, MappedLocalTime, NaiveDate, NaiveDateTime, NaiveTime, Offset, TimeZone,
};
use chrono_tz::{OffsetName, Tz};

use crate::time::calendar::{CivilDateTime, is_supported_mjd};
use crate::time::error::TimeError;
use crate::time::instant::Instant;
use crate::time::written::Written;
use crate::units::DAY_S;

/// chrono's number of the day whose modified Julian date is zero: days from 0000-12-31.
const MJD_ZERO_DAYS_FROM_CE: i64 = 678_576;
/// Modified Julian date of 1970-01-01.
const UNIX_EPOCH_MJD: i64 = 40_587;

/// What the clocks of a time zone show.
#[derive(Debug, Clone, PartialEq)]
pub struct LocalTime {
    pub civil: CivilDateTime,
    /// Local time less UTC, seconds.
    pub offset_s: i32,
    /// What the zone calls this time: `MST`, `CEST`, `LMT`, or the offset where it has no name.
    pub abbreviation: String,
}

/// ISO 8601: `2026-08-12T21:30:00-07:00`.
impl fmt::Display for LocalTime {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}{}", self.civil, IsoOffset(self.offset_s))
    }
}

/// As typed, in ISO 8601; without an offset where none was given.
impl fmt::Display for Written {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.offset_s {
            None => self.civil.fmt(f),
            Some(0) => write!(f, "{}Z", self.civil),
            Some(offset_s) => write!(f, "{}{}", self.civil, IsoOffset(offset_s)),
        }
    }
}

struct IsoOffset(i32);

impl fmt::Display for IsoOffset {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (sign, s) = (if self.0 < 0 { '-' } else { '+' }, self.0.abs());
        write!(f, "{sign}{:02}:{:02}", s / 3600, s / 60 % 60)?;
        if s % 60 == 0 { Ok(()) } else { write!(f, ":{:02}", s % 60) }
    }
}

/// The instant of a written date and time.
///
/// Its own offset from UTC comes first, then the time zone, then UTC. A time that clocks showed
/// twice, when daylight saving ended, is taken as the first; one that they jumped over is refused.
pub fn to_instant(written: &Written, zone: Option<Tz>) -> Result<Instant, TimeError> {
    written.civil.check()?;
    let offset_s = match (written.offset_s, zone) {
        (Some(offset_s), _) => offset_s,
        (None, Some(zone)) => offset_in_zone_s(&written.civil, zone)?,
        (None, None) => 0,
    };
    Instant::from_civil_utc(&shifted(&written.civil, -offset_s))
}

impl Instant {
    /// From chrono, whose leap seconds are honoured where they are real.
    pub fn from_chrono(utc: DateTime<chrono::Utc>) -> Result<Instant, TimeError> {
        let mjd = UNIX_EPOCH_MJD + utc.timestamp().div_euclid(DAY_S as i64);
        let second_of_day = utc.timestamp().rem_euclid(DAY_S as i64);
        // chrono counts nanoseconds past 10^9 in a leap second.
        let nanosecond = f64::from(utc.timestamp_subsec_nanos());
        if !is_supported_mjd(mjd) {
            return Err(TimeError::Year(utc.year().into()));
        }
        let mut civil = CivilDateTime::from_day(mjd, second_of_day as f64, DAY_S);
        civil.second += nanosecond / 1e9;
        Instant::from_civil_utc(&civil)
    }

    /// What the clocks of a time zone show.
    pub fn to_local(&self, zone: Tz) -> LocalTime {
        let utc = self.utc_civil();
        let offset = zone.offset_from_utc_datetime(&naive(&utc));
        let offset_s = offset.fix().local_minus_utc();
        let abbreviation = match offset.abbreviation() {
            Some(name) => name.to_string(),
            None => IsoOffset(offset_s).to_string(),
        };
        LocalTime { civil: shifted(&utc, offset_s), offset_s, abbreviation }
    }
}

/// Local time less UTC in seconds, for a local date and time.
fn offset_in_zone_s(civil: &CivilDateTime, zone: Tz) -> Result<i32, TimeError> {
    let offset = match zone.offset_from_local_datetime(&naive(civil)) {
        MappedLocalTime::Single(offset) | MappedLocalTime::Ambiguous(offset, _) => offset,
        MappedLocalTime::None => {
            let zone = zone.name().to_string();
            return Err(TimeError::Skipped { local: civil.to_string(), zone });
        }
    };
    Ok(offset.fix().local_minus_utc())
}

/// The same day and time for chrono, to the second. A leap second counts as the one before it.
fn naive(civil: &CivilDateTime) -> NaiveDateTime {
    let day = i32::try_from(civil.mjd() + MJD_ZERO_DAYS_FROM_CE).ok();
    let date = day.and_then(NaiveDate::from_num_days_from_ce_opt).unwrap_or_default();
    let second = civil.second_of_day().min(DAY_S - 1.0) as u32;
    let time = NaiveTime::from_num_seconds_from_midnight_opt(second, 0).unwrap_or_default();
    NaiveDateTime::new(date, time)
}

/// A civil time moved by an offset; second 60 stays second 60, for offsets of whole minutes.
fn shifted(civil: &CivilDateTime, offset_s: i32) -> CivilDateTime {
    let leap_s = if civil.second >= 60.0 { 1.0 } else { 0.0 };
    let second = civil.second_of_day() - leap_s + f64::from(offset_s);
    let days = (second / DAY_S).floor();
    let mut moved =
        CivilDateTime::from_day(civil.mjd() + days as i64, second - days * DAY_S, DAY_S);
    moved.second += leap_s;
    moved
}

#[cfg(test)]
mod tests {
    use chrono_tz::{America, Asia, Europe};

    use super::*;
    use crate::time::written::parse;

    fn utc_of(text: &str, zone: Option<Tz>) -> String {
        to_instant(&parse(text).unwrap(), zone).unwrap().to_string()
    }

    #[test]
    fn an_offset_beats_the_zone_and_the_zone_beats_utc() {
        assert_eq!(utc_of("2026-08-12T21:30", None), "2026-08-12T21:30:00Z");
        assert_eq!(utc_of("2026-08-12T21:30", Some(America::Phoenix)), "2026-08-13T04:30:00Z");
        assert_eq!(utc_of("2026-08-12T21:30-07:00", Some(Asia::Tokyo)), "2026-08-13T04:30:00Z");
        assert_eq!(utc_of("2026-01-01T00:30+05:45", None), "2025-12-31T18:45:00Z");
        assert_eq!(
            utc_of("2016-12-31T16:59:60.5", Some(America::Phoenix)),
            "2016-12-31T23:59:60.5Z"
        );
    }

    #[test]
    fn daylight_saving_skips_an_hour_and_doubles_another() {
        let zone = Some(America::Denver);
        let skipped = to_instant(&parse("2026-03-08T02:30").unwrap(), zone).unwrap_err();
        assert_eq!(
            skipped.to_string(),
            "clocks in America/Denver jumped over 2026-03-08T02:30:00; write a time before \
             or after the jump, or give its offset from UTC"
        );
        // The first 01:30 is still daylight saving time, UTC - 6 h.
        assert_eq!(utc_of("2026-11-01T01:30", zone), "2026-11-01T07:30:00Z");
    }

    #[test]
    fn local_time_is_what_the_wall_shows() {
        let local = |text: &str, zone: Tz| {
            let local = to_instant(&parse(text).unwrap(), None).unwrap().to_local(zone);
            format!("{local} {}", local.abbreviation)
        };
        let cases = [
            ("2026-08-13T04:30Z", America::Phoenix, "2026-08-12T21:30:00-07:00 MST"),
            ("2026-06-30T22:15Z", Europe::Berlin, "2026-07-01T00:15:00+02:00 CEST"),
            ("2016-12-31T23:59:60.5Z", Asia::Kolkata, "2017-01-01T05:29:60.5+05:30 IST"),
            // Local mean time of Berlin, 53 min 28 s before Greenwich, before 1893.
            ("1850-01-01T00:00Z", Europe::Berlin, "1850-01-01T00:53:28+00:53:28 LMT"),
            ("-0584-05-28T14:00Z", Europe::Istanbul, "-0584-05-28T15:55:52+01:55:52 LMT"),
            ("1582-10-15T00:10Z", America::New_York, "1582-10-04T19:13:58-04:56:02 LMT"),
        ];
        for (utc, zone, shown) in cases {
            assert_eq!(local(utc, zone), shown);
        }
    }

    #[test]
    fn local_and_universal_are_inverse() {
        for zone in [America::Denver, Asia::Kathmandu, Europe::Paris] {
            for text in [
                "-3999-02-03T04:05:06.125Z",
                "1582-10-04T23:50Z",
                "1960-07-01T12:00Z",
                "2026-03-29T01:30Z",
            ] {
                let instant = to_instant(&parse(text).unwrap(), None).unwrap();
                let civil = instant.to_local(zone).civil;
                let back = to_instant(&Written { civil, offset_s: None }, Some(zone)).unwrap();
                assert!(((back.tt - instant.tt) * DAY_S).abs() < 1e-8, "{text} {zone}");
            }
        }
    }

    #[test]
    fn chrono_is_understood_leap_seconds_included() {
        let utc =
            |secs, nanos| Instant::from_chrono(DateTime::from_timestamp(secs, nanos).unwrap());
        assert_eq!(utc(0, 0).unwrap().to_string(), "1970-01-01T00:00:00Z");
        assert_eq!(utc(-1, 250_000_000).unwrap().to_string(), "1969-12-31T23:59:59.25Z");
        assert_eq!(
            utc(1_483_228_799, 1_500_000_000).unwrap().to_string(),
            "2016-12-31T23:59:60.5Z"
        );
        assert!(matches!(utc(1_483_228_859, 1_500_000_000), Err(TimeError::NoLeapSecond(_))));
        assert!(matches!(utc(100_000_000_000, 0), Err(TimeError::Year(5138))));
    }
}
