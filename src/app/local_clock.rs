//! What clocks on the wall show at a place, and back: dates and times as the window has them.

use chrono_tz::Tz;

use crate::scene::ScenePlace;
use crate::time::calendar::{YEARS, date_from_julian_day_number, julian_day_number};
use crate::time::{self, CivilDateTime, Instant, TimeError, Written, days_in_month};

/// The last Julian day of the calendar, and the first Gregorian one.
const GAP: [(i32, u8, u8); 2] = [(1582, 10, 4), (1582, 10, 15)];
const MONTHS: [&str; 12] = [
    "January",
    "February",
    "March",
    "April",
    "May",
    "June",
    "July",
    "August",
    "September",
    "October",
    "November",
    "December",
];

/// A clock: of a time zone, or of UTC.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalClock {
    zone: Option<Tz>,
}

/// What it shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    pub civil: CivilDateTime,
    /// Local time less UTC, seconds.
    pub offset_s: i32,
    /// Of the zone: `MST`; `UTC` of UTC.
    pub abbreviation: String,
}

impl LocalClock {
    pub const UTC: LocalClock = LocalClock { zone: None };

    /// The clock of a place; UTC where its zone is not known.
    pub fn of(place: &ScenePlace) -> LocalClock {
        LocalClock { zone: place.time_zone.as_deref().and_then(|name| name.parse().ok()) }
    }

    pub fn read(&self, instant: &Instant) -> Reading {
        match self.zone {
            Some(zone) => {
                let local = instant.to_local(zone);
                let (offset_s, abbreviation) = (local.offset_s, local.abbreviation);
                Reading { civil: local.civil, offset_s, abbreviation }
            }
            None => {
                Reading { civil: instant.utc_civil(), offset_s: 0, abbreviation: "UTC".to_owned() }
            }
        }
    }

    /// The instant at which it shows a date and time.
    pub fn instant(&self, civil: CivilDateTime) -> Result<Instant, TimeError> {
        self.instant_of(&Written { civil, offset_s: None })
    }

    /// The same of what was written, by its own offset where it has one.
    pub fn instant_of(&self, written: &Written) -> Result<Instant, TimeError> {
        time::to_instant(written, self.zone)
    }
}

impl Reading {
    /// `2026-08-12 21:30:05`, `-0584-05-28 14:00:00 (585 BC)`.
    pub fn in_words(&self) -> String {
        let whole = CivilDateTime { second: self.civil.second.floor(), ..self.civil };
        let plain = whole.to_string().replace('T', " ");
        match before_christ(self.civil.year) {
            Some(era) => format!("{plain} ({era})"),
            None => plain,
        }
    }
}

/// A year before the first of the era as historians count it: 0 is `1 BC`.
pub fn before_christ(year: i32) -> Option<String> {
    (year <= 0).then(|| format!("{} BC", 1 - year))
}

/// A year as people write it: `2026`, `-584`, `585 BC`, `585 BCE`.
pub fn read_year(text: &str) -> Result<i32, String> {
    let plain = text.trim().replace('\u{2212}', "-").to_uppercase();
    let is_before = plain.ends_with("BC") || plain.ends_with("BCE");
    let number = plain.trim_end_matches("BCE").trim_end_matches("BC").trim();
    let nonsense = || format!("'{}' is no year; write 2026, -584 or 585 BC", text.trim());
    let number: i32 = number.parse().map_err(|_| nonsense())?;
    let year = match is_before {
        true if number < 1 => return Err(nonsense()),
        true => 1 - number,
        false => number,
    };
    match YEARS.contains(&year) {
        true => Ok(year),
        false => Err(TimeError::Year(year.into()).to_string()),
    }
}

/// `+02:00`, `-07:26:36`.
pub fn signed_offset(offset_s: i32) -> String {
    let (sign, s) = (if offset_s < 0 { '-' } else { '+' }, offset_s.abs());
    let seconds = if s % 60 == 0 { String::new() } else { format!(":{:02}", s % 60) };
    format!("{sign}{:02}:{:02}{seconds}", s / 3600, s / 60 % 60)
}

pub fn month_name(month: u8) -> &'static str {
    MONTHS.get(usize::from(month).wrapping_sub(1)).copied().unwrap_or("")
}

/// The days that a month has, without those that the calendar left out.
pub fn days_of(year: i32, month: u8) -> impl Iterator<Item = u8> {
    let is_there = move |day: &u8| {
        let date = (year, month, *day);
        date <= GAP[0] || date >= GAP[1]
    };
    (1..=days_in_month(year, month)).filter(is_there)
}

/// 0 on a Monday, 6 on a Sunday.
pub fn weekday(year: i32, month: u8, day: u8) -> usize {
    // Julian day 0 began on a Monday.
    julian_day_number(year, month, day).rem_euclid(7) as usize
}

/// A date whose day there is: the last of the month, or an end of the gap.
fn nearest_day(civil: CivilDateTime, is_forward: bool) -> CivilDateTime {
    let day = civil.day.min(days_in_month(civil.year, civil.month));
    let date = (civil.year, civil.month, day);
    let (_, _, day) =
        if GAP[0] < date && date < GAP[1] { GAP[usize::from(is_forward)] } else { date };
    CivilDateTime { day, ..civil }
}

/// The same day and time of another month and year; the nearest day where there is none.
pub fn with_month(civil: CivilDateTime, year: i32, month: u8) -> CivilDateTime {
    let is_forward = (year, month) >= (civil.year, civil.month);
    nearest_day(CivilDateTime { year, month, ..civil }, is_forward)
}

/// So many months later.
pub fn plus_months(civil: CivilDateTime, months: i32) -> CivilDateTime {
    let count = civil.year * 12 + i32::from(civil.month) - 1 + months;
    with_month(civil, count.div_euclid(12), (count.rem_euclid(12) + 1) as u8)
}

/// So many days later, at the same time of the day.
pub fn plus_days(civil: CivilDateTime, days: i32) -> CivilDateTime {
    let number = julian_day_number(civil.year, civil.month, civil.day) + i64::from(days);
    let (year, month, day) = date_from_julian_day_number(number);
    CivilDateTime { year, month, day, ..civil }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn years_are_read_as_people_write_them() {
        for (text, year) in [("2026", 2026), ("-584", -584), ("585 BC", -584), ("1 bce", 0)] {
            assert_eq!(read_year(text), Ok(year), "{text}");
        }
        for text in ["", "soon", "4001", "-4001", "0 BC", "-5 BC", "5000 BC", "20.5"] {
            assert!(read_year(text).is_err(), "{text}");
        }
        assert_eq!(before_christ(0).as_deref(), Some("1 BC"));
        assert_eq!(before_christ(1), None);
    }

    #[test]
    fn months_and_days_keep_to_the_calendar() {
        let date = |year, month, day| CivilDateTime::midnight(year, month, day).unwrap();
        assert_eq!(plus_months(date(2026, 1, 31), 1), date(2026, 2, 28));
        assert_eq!(plus_months(date(2026, 1, 31), -1), date(2025, 12, 31));
        assert_eq!(plus_months(date(1582, 9, 10), 1), date(1582, 10, 15));
        assert_eq!(plus_months(date(1582, 11, 10), -1), date(1582, 10, 4));
        assert_eq!(plus_days(date(1582, 10, 4), 1), date(1582, 10, 15));
        assert_eq!(plus_days(date(0, 3, 1), -1), date(0, 2, 29));
        assert_eq!(days_of(1582, 10).count(), 21);
        // 2026-08-12 is a Wednesday, as is 2000-01-05; 1582-10-04 was a Thursday, the 15th a Friday.
        assert_eq!([weekday(2026, 8, 12), weekday(2000, 1, 5)], [2, 2]);
        assert_eq!([weekday(1582, 10, 4), weekday(1582, 10, 15)], [3, 4]);
    }
}
