//! Civil dates and the days they number.
//!
//! Gregorian from 1582-10-15, Julian before; years are astronomical, 0 is 1 BCE. A Julian day number
//! counts days from noon of -4712-01-01 (Julian calendar); both directions are exact in integers.
//! The year is counted from March, so that the leap day is the last of its year and the lengths of
//! the months follow one line, floor((153 m + 2) / 5).

use std::fmt;
use std::ops::RangeInclusive;

use crate::time::clock::JulianDate;
use crate::time::error::TimeError;
use crate::time::leap_seconds::{self, MJD_ZERO_JD, split_at_midnight};
use crate::units::DAY_S;

/// The astronomical years for which instants are made.
pub const YEARS: RangeInclusive<i32> = -4000..=4000;

/// Julian day number of 1582-10-15, the first Gregorian day.
const GREGORIAN_START_JDN: i64 = 2_299_161;
/// Julian day number of 0000-03-01 in the Julian calendar.
const JULIAN_MARCH_ZERO_JDN: i64 = 1_721_118;
/// Julian day number of 0000-03-01 in the Gregorian calendar.
const GREGORIAN_MARCH_ZERO_JDN: i64 = 1_721_120;
/// Julian day number of the day whose modified Julian date is zero.
const MJD_ZERO_JDN: i64 = 2_400_001;

/// A date of the civil calendar and a time of day, on no particular clock.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CivilDateTime {
    /// Astronomical: 0 is 1 BCE.
    pub year: i32,
    /// 1 to 12.
    pub month: u8,
    /// From 1.
    pub day: u8,
    /// 0 to 23.
    pub hour: u8,
    /// 0 to 59.
    pub minute: u8,
    /// In `[0, 60)`, in a leap second `[60, 61)`.
    pub second: f64,
}

impl CivilDateTime {
    /// A date and time that exist in the calendar, of a year from -4000 to 4000.
    ///
    /// Second 60 passes on the days next to a leap second only, since the offset from UTC is not
    /// known here; that it really is the leap second is checked where the offset is known.
    pub fn new(
        year: i32,
        month: u8,
        day: u8,
        hour: u8,
        minute: u8,
        second: f64,
    ) -> Result<CivilDateTime, TimeError> {
        let civil = CivilDateTime { year, month, day, hour, minute, second };
        civil.check()?;
        Ok(civil)
    }

    /// What [`CivilDateTime::new`] asks, asked again: the fields are open to all.
    pub fn check(&self) -> Result<(), TimeError> {
        let CivilDateTime { year, month, day, hour, minute, second } = *self;
        if !YEARS.contains(&year) {
            return Err(TimeError::Year(year.into()));
        }
        let in_range = |field, value: u8, low: u8, high: u8| {
            if (low..=high).contains(&value) {
                return Ok(());
            }
            let (value, low, high) = (value.into(), low.into(), high.into());
            Err(TimeError::Field { field, value, low, high })
        };
        in_range("month", month, 1, 12)?;
        in_range("day", day, 1, 31)?;
        in_range("hour", hour, 0, 23)?;
        in_range("minute", minute, 0, 59)?;
        if !(0.0..61.0).contains(&second) {
            return Err(TimeError::Second(second));
        }
        if (year, month) == (1582, 10) && (5..=14).contains(&day) {
            return Err(TimeError::CalendarGap(day));
        }
        let days = days_in_month(year, month);
        if day > days {
            return Err(TimeError::Day { year, month, day, days });
        }
        let mjd = self.mjd();
        let is_near_leap = (mjd - 1..=mjd + 1).any(|mjd| leap_seconds::day_length_s(mjd) > DAY_S);
        if second >= 60.0 && !is_near_leap {
            return Err(TimeError::NoLeapSecond(self.to_string()));
        }
        Ok(())
    }

    /// Midnight at the beginning of a date.
    pub fn midnight(year: i32, month: u8, day: u8) -> Result<CivilDateTime, TimeError> {
        CivilDateTime::new(year, month, day, 0, 0, 0.0)
    }

    /// Modified Julian date of the day.
    pub fn mjd(&self) -> i64 {
        julian_day_number(self.year, self.month, self.day) - MJD_ZERO_JDN
    }

    /// Seconds since the last midnight.
    pub fn second_of_day(&self) -> f64 {
        f64::from(self.hour) * 3600.0 + f64::from(self.minute) * 60.0 + self.second
    }

    /// The Julian date on a clock whose days all have 86400 s.
    pub fn julian_date<C>(&self) -> JulianDate<C> {
        JulianDate::from_parts(MJD_ZERO_JD + self.mjd() as f64, self.second_of_day() / DAY_S)
    }

    /// What such a clock reads, to the nanosecond, in the years -4000 to 4000.
    pub fn from_julian_date<C>(jd: JulianDate<C>) -> Result<CivilDateTime, TimeError> {
        let (mjd, fraction) = split_at_midnight(jd);
        if !is_supported_mjd(mjd) {
            return Err(TimeError::JulianDate(jd.jd()));
        }
        Ok(CivilDateTime::from_day(mjd, fraction * DAY_S, DAY_S))
    }

    /// From a day and the seconds since its midnight, rounded to the nanosecond so that noise in
    /// the last digit does not show 29.999999 for 30. A day of `day_length_s` may end in second 60.
    pub(super) fn from_day(mjd: i64, second_of_day: f64, day_length_s: f64) -> CivilDateTime {
        let second_of_day = (second_of_day * 1e9).round() / 1e9;
        if second_of_day >= day_length_s {
            return CivilDateTime::from_day(mjd + 1, 0.0, DAY_S);
        }
        let (year, month, day) = date_from_julian_day_number(mjd + MJD_ZERO_JDN);
        let whole = second_of_day as i64;
        // The leap second belongs to the last minute of its day.
        let minute_of_day = (whole / 60).min(24 * 60 - 1);
        let second = ((second_of_day - (minute_of_day * 60) as f64) * 1e9).round() / 1e9;
        let (hour, minute) = ((minute_of_day / 60) as u8, (minute_of_day % 60) as u8);
        CivilDateTime { year, month, day, hour, minute, second }
    }
}

/// ISO 8601 without an offset: `2026-08-13T04:30:00`, `-0584-05-28T14:00:00`; with up to three
/// digits after the second where it is not whole.
impl fmt::Display for CivilDateTime {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let milliseconds = (self.second * 1000.0).round().min(60_999.0) as u64;
        let is_full_minute = milliseconds >= 60_000 && self.second < 60.0;
        if is_full_minute {
            let day_length_s = leap_seconds::day_length_s(self.mjd());
            let second_of_day = self.second_of_day().round();
            return CivilDateTime::from_day(self.mjd(), second_of_day, day_length_s).fmt(f);
        }
        // A negative year takes five places with its sign.
        let places = if self.year < 0 { 5 } else { 4 };
        write!(f, "{:0places$}-{:02}-{:02}", self.year, self.month, self.day)?;
        write!(f, "T{:02}:{:02}:{:02}", self.hour, self.minute, milliseconds / 1000)?;
        let fraction = format!("{:03}", milliseconds % 1000);
        let fraction = fraction.trim_end_matches('0');
        if fraction.is_empty() { Ok(()) } else { write!(f, ".{fraction}") }
    }
}

/// Days in a month of the civil calendar; 31 in October 1582, ten of which are missing.
pub fn days_in_month(year: i32, month: u8) -> u8 {
    let is_leap = if year > 1582 {
        year % 4 == 0 && (year % 100 != 0 || year % 400 == 0)
    } else {
        year % 4 == 0
    };
    match month {
        2 if is_leap => 29,
        2 => 28,
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    }
}

/// The Julian day number of a date of the civil calendar, valid for any year.
pub fn julian_day_number(year: i32, month: u8, day: u8) -> i64 {
    let is_gregorian = (year, month, day) >= (1582, 10, 15);
    // January and February belong to the year that began in March.
    let year = i64::from(year) - i64::from(month < 3);
    let month_from_march = (i64::from(month) + 9) % 12;
    let day_of_year = (153 * month_from_march + 2) / 5 + i64::from(day) - 1;
    let days = 365 * year + year.div_euclid(4) + day_of_year;
    if is_gregorian {
        days - year.div_euclid(100) + year.div_euclid(400) + GREGORIAN_MARCH_ZERO_JDN
    } else {
        days + JULIAN_MARCH_ZERO_JDN
    }
}

/// Year, month and day of a Julian day number: the inverse of [`julian_day_number`].
pub fn date_from_julian_day_number(jdn: i64) -> (i32, u8, u8) {
    let (century, days) = if jdn >= GREGORIAN_START_JDN {
        let days = jdn - GREGORIAN_MARCH_ZERO_JDN;
        // 146097 days in 400 Gregorian years.
        let century = (4 * days + 3).div_euclid(146_097);
        (century, days - (146_097 * century).div_euclid(4))
    } else {
        (0, jdn - JULIAN_MARCH_ZERO_JDN)
    };
    // 1461 days in four years.
    let year = (4 * days + 3).div_euclid(1461);
    let day_of_year = days - (1461 * year).div_euclid(4);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = (month_from_march + 2) % 12 + 1;
    let year = 100 * century + year + i64::from(month < 3);
    (year as i32, month as u8, day as u8)
}

/// Whether the day lies in the years for which instants are made.
pub(super) fn is_supported_mjd(mjd: i64) -> bool {
    let first = julian_day_number(*YEARS.start(), 1, 1) - MJD_ZERO_JDN;
    let after_last = julian_day_number(*YEARS.end() + 1, 1, 1) - MJD_ZERO_JDN;
    (first..after_last).contains(&mjd)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::time::clock::Ut1;

    #[test]
    fn julian_dates_of_known_days() {
        // Meeus 1998, Astronomical Algorithms, chapter 7: the Julian date at noon of each day.
        let days = [
            (2000, 1, 1, 2_451_545),
            (1999, 1, 1, 2_451_180),
            (1987, 1, 27, 2_446_823),
            (1987, 6, 19, 2_446_966),
            (1988, 1, 27, 2_447_188),
            (1988, 6, 19, 2_447_332),
            (1900, 1, 1, 2_415_021),
            (1600, 1, 1, 2_305_448),
            (1600, 12, 31, 2_305_813),
            (1582, 10, 15, 2_299_161),
            (1582, 10, 4, 2_299_160),
            (837, 4, 10, 2_026_872),
            (333, 1, 27, 1_842_713),
            (-123, 12, 31, 1_676_497),
            (-122, 1, 1, 1_676_498),
            (-1000, 7, 12, 1_356_001),
            (-1000, 2, 29, 1_355_867),
            (-1001, 8, 17, 1_355_671),
            (-4712, 1, 1, 0),
        ];
        for (year, month, day, jdn) in days {
            assert_eq!(julian_day_number(year, month, day), jdn, "{year}-{month}-{day}");
            assert_eq!(date_from_julian_day_number(jdn), (year, month, day));
        }
    }

    #[test]
    fn sputnik_flew_at_its_julian_date() {
        // Meeus 1998, example 7.a: 1957 October 4.81 is JD 2436116.31.
        let civil = CivilDateTime::new(1957, 10, 4, 19, 26, 24.0).unwrap();
        assert!((civil.julian_date::<Ut1>().jd() - 2_436_116.31).abs() < 1e-9);
        let jd = JulianDate::<Ut1>::from_parts(2_436_116.0, 0.31);
        assert_eq!(CivilDateTime::from_julian_date(jd), Ok(civil));
    }

    #[test]
    fn every_month_ends_where_the_next_begins() {
        for year in [-4000, -1, 0, 1, 4, 1500, 1581, 1582, 1583, 1600, 1700, 1900, 2000, 2023, 2024]
        {
            for month in 1..=12 {
                let last = days_in_month(year, month);
                let next = julian_day_number(year, month, last) + 1;
                let (y, m) = if month == 12 { (year + 1, 1) } else { (year, month + 1) };
                assert_eq!(date_from_julian_day_number(next), (y, m, 1));
            }
        }
    }

    #[test]
    fn times_that_never_were_are_refused_in_a_sentence() {
        let says = |result: Result<CivilDateTime, TimeError>, words: &str| {
            let message = result.unwrap_err().to_string();
            assert!(message.contains(words), "{message}");
        };
        says(CivilDateTime::midnight(2023, 2, 29), "2023-02 has 28 days");
        says(CivilDateTime::midnight(2026, 2, 30), "2026-02 has 28 days");
        says(CivilDateTime::midnight(1582, 10, 10), "1582-10-10 never was");
        says(CivilDateTime::midnight(4001, 1, 1), "year 4001 is outside -4000 to 4000");
        says(CivilDateTime::midnight(2026, 13, 1), "month 13 is outside 1 to 12");
        says(CivilDateTime::midnight(2026, 6, 0), "day 0 is outside 1 to 31");
        says(CivilDateTime::new(2026, 6, 1, 25, 0, 0.0), "hour 25 is outside 0 to 23");
        says(CivilDateTime::new(2026, 6, 1, 23, 60, 0.0), "minute 60 is outside 0 to 59");
        says(CivilDateTime::new(2026, 6, 1, 23, 59, f64::NAN), "second NaN is outside");
        says(CivilDateTime::new(2026, 6, 1, 23, 59, -0.1), "second -0.1 is outside");
        says(CivilDateTime::new(2026, 6, 1, 23, 59, 60.0), "no leap second");
        assert!(CivilDateTime::new(2016, 12, 31, 16, 59, 60.5).is_ok());
        assert!(CivilDateTime::midnight(1500, 2, 29).is_ok());
    }

    #[test]
    fn dates_are_shown_in_iso_8601() {
        let shown = |year, second| {
            let civil = CivilDateTime { year, month: 8, day: 13, hour: 4, minute: 59, second };
            civil.to_string()
        };
        assert_eq!(shown(2026, 0.0), "2026-08-13T04:59:00");
        assert_eq!(shown(-584, 7.5), "-0584-08-13T04:59:07.5");
        assert_eq!(shown(33, 7.0426), "0033-08-13T04:59:07.043");
        assert_eq!(shown(2026, 59.999_9), "2026-08-13T05:00:00");
        let eve =
            CivilDateTime { month: 12, day: 31, ..CivilDateTime::midnight(2016, 1, 1).unwrap() };
        let eve = CivilDateTime { hour: 23, minute: 59, ..eve };
        let shown = |second| CivilDateTime { second, ..eve }.to_string();
        assert_eq!(shown(59.999_9), "2016-12-31T23:59:60");
        assert_eq!(shown(60.25), "2016-12-31T23:59:60.25");
        assert_eq!(shown(60.999_9), "2016-12-31T23:59:60.999");
    }

    proptest! {
        #[test]
        fn day_numbers_and_dates_are_inverse(jdn in -2_000_000_i64..4_000_000) {
            let (year, month, day) = date_from_julian_day_number(jdn);
            prop_assert!((1..=12).contains(&month) && (1..=days_in_month(year, month)).contains(&day));
            prop_assert_eq!(julian_day_number(year, month, day), jdn);
        }

        #[test]
        fn civil_times_survive_the_julian_date(
            jdn in 260_059_i64..3_182_395,
            millisecond in 0_u32..86_400_000,
        ) {
            let (year, month, day) = date_from_julian_day_number(jdn);
            let (minute, millisecond) = (millisecond / 60_000, millisecond % 60_000);
            let (hour, minute) = ((minute / 60) as u8, (minute % 60) as u8);
            let second = f64::from(millisecond) / 1000.0;
            let civil = CivilDateTime::new(year, month, day, hour, minute, second).unwrap();
            let back = CivilDateTime::from_julian_date(civil.julian_date::<Ut1>()).unwrap();
            prop_assert!((back.second - civil.second).abs() < 1e-9);
            prop_assert_eq!(CivilDateTime { second, ..back }, civil);
        }
    }
}
