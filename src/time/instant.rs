//! One instant, read on every clock.

use std::fmt;

use crate::time::calendar::{CivilDateTime, is_supported_mjd};
use crate::time::clock::{JulianDate, Tai, Tdb, Tt, Ut1, Utc};
use crate::time::delta_t::{TT_MINUS_TAI_S, delta_t_s, tt_from_ut1, utc_end_mjd};
use crate::time::error::TimeError;
use crate::time::leap_seconds::{
    self, MJD_ZERO_JD, UTC_START_MJD, split_at_midnight, tai_from_utc, utc_from_tai,
};
use crate::time::tdb::tdb_from_tt;
use crate::units::DAY_S;

/// More than Delta-T ever is: 1.3 days at -4000.
const MAX_DELTA_T_DAYS: f64 = 2.0;

/// One instant, read on every clock that somebody here asks for.
///
/// Its civil year lies in -4000 to 4000. See [`crate::time`] for what UTC means when.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instant {
    /// What people call it. On a day with a leap second one day of this date is 86401 s.
    pub utc: JulianDate<Utc>,
    /// What turns the Earth.
    pub ut1: JulianDate<Ut1>,
    /// What drives precession and nutation.
    pub tt: JulianDate<Tt>,
    /// What drives the Sun, the Moon and the planets.
    pub tdb: JulianDate<Tdb>,
}

impl Instant {
    /// From a Julian date in UTC, stretched over a day that has a leap second.
    pub fn from_utc(utc: JulianDate<Utc>) -> Result<Instant, TimeError> {
        check(utc)?;
        let (mjd, fraction) = split_at_midnight(utc);
        if !is_utc_kept(mjd) {
            let ut1 = utc.read_on(0.0);
            let tt = tt_from_ut1(ut1);
            return Ok(Instant { utc, ut1, tt, tdb: tdb_from_tt(tt) });
        }
        let tai = tai_from_utc(mjd, fraction * leap_seconds::day_length_s(mjd));
        let tt = tai.read_on(TT_MINUS_TAI_S);
        Ok(Instant { utc, ut1: tt.read_on(-delta_t_s(tt)), tt, tdb: tdb_from_tt(tt) })
    }

    /// From a civil date and time in UTC. Second 60 is accepted in a leap second alone.
    pub fn from_civil_utc(civil: &CivilDateTime) -> Result<Instant, TimeError> {
        civil.check()?;
        let mjd = civil.mjd();
        let day_length_s = leap_seconds::day_length_s(mjd);
        let is_in_leap_second = civil.second_of_day() >= DAY_S && day_length_s > DAY_S;
        if civil.second >= 60.0 && !is_in_leap_second {
            return Err(TimeError::NoLeapSecond(civil.to_string()));
        }
        let day_length_s = if is_utc_kept(mjd) { day_length_s } else { DAY_S };
        let midnight = MJD_ZERO_JD + mjd as f64;
        Instant::from_utc(JulianDate::from_parts(midnight, civil.second_of_day() / day_length_s))
    }

    /// From Terrestrial Time, with Delta-T from [`crate::time::delta_t`].
    pub fn from_tt(tt: JulianDate<Tt>) -> Result<Instant, TimeError> {
        Instant::from_tt_ut1(tt, tt.read_on(-delta_t_s(tt)))
    }

    /// From Terrestrial Time and the UT1 that somebody else gives for it, as reference tables do.
    pub fn from_tt_ut1(tt: JulianDate<Tt>, ut1: JulianDate<Ut1>) -> Result<Instant, TimeError> {
        check(ut1)?;
        // NaN is not near.
        let is_near = (tt.jd() - ut1.jd()).abs() < MAX_DELTA_T_DAYS;
        if !is_near {
            return Err(TimeError::JulianDate(tt.jd()));
        }
        let utc = utc_from_tt(tt).unwrap_or(ut1.read_on(0.0));
        Ok(Instant { utc, ut1, tt, tdb: tdb_from_tt(tt) })
    }

    /// The instant after so many seconds of the SI have passed.
    ///
    /// An instant that was given its own UT1 keeps what that differs from our Delta-T.
    pub fn plus_seconds(&self, seconds: f64) -> Result<Instant, TimeError> {
        let tt = self.tt.plus_seconds(seconds);
        let own_s = self.delta_t_s() - delta_t_s(self.tt);
        Instant::from_tt_ut1(tt, tt.read_on(-(delta_t_s(tt) + own_s)))
    }

    /// TT - UT1 in seconds.
    pub fn delta_t_s(&self) -> f64 {
        let days = (self.tt.day() - self.ut1.day()) + (self.tt.fraction() - self.ut1.fraction());
        days * DAY_S
    }

    /// What a clock in UTC shows, to the nanosecond.
    pub fn utc_civil(&self) -> CivilDateTime {
        let (mjd, fraction) = split_at_midnight(self.utc);
        let day_length_s = if is_utc_kept(mjd) { leap_seconds::day_length_s(mjd) } else { DAY_S };
        CivilDateTime::from_day(mjd, fraction * day_length_s, day_length_s)
    }
}

/// ISO 8601 in UTC: `2026-08-13T04:30:00Z`.
impl fmt::Display for Instant {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}Z", self.utc_civil())
    }
}

/// Whether civil time on this day is UTC; otherwise it is UT1.
fn is_utc_kept(mjd: i64) -> bool {
    (UTC_START_MJD..utc_end_mjd()).contains(&mjd)
}

/// UTC from TT, in the years in which it is kept.
fn utc_from_tt(tt: JulianDate<Tt>) -> Option<JulianDate<Utc>> {
    let tai: JulianDate<Tai> = tt.read_on(-TT_MINUS_TAI_S);
    let (mjd, second_of_day) = utc_from_tai(tai);
    let fraction = second_of_day / leap_seconds::day_length_s(mjd);
    is_utc_kept(mjd).then(|| JulianDate::from_parts(MJD_ZERO_JD + mjd as f64, fraction))
}

/// Refuses what is no date of the years -4000 to 4000, NaN among them.
fn check<C>(jd: JulianDate<C>) -> Result<(), TimeError> {
    // Far beyond the range, so that the day is safe to cast.
    if !(jd.jd().abs() < 1e9 && is_supported_mjd(split_at_midnight(jd).0)) {
        return Err(TimeError::JulianDate(jd.jd()));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::time::calendar::date_from_julian_day_number;

    fn utc(year: i32, month: u8, day: u8, hour: u8, minute: u8, second: f64) -> Instant {
        let civil = CivilDateTime::new(year, month, day, hour, minute, second).unwrap();
        Instant::from_civil_utc(&civil).unwrap()
    }

    #[test]
    fn a_second_of_2016_is_a_leap_second() {
        let before = utc(2016, 12, 31, 23, 59, 59.5);
        let labels = [
            (1.0, "2016-12-31T23:59:60.5Z"),
            (2.0, "2017-01-01T00:00:00.5Z"),
            (-43_200.0, "2016-12-31T11:59:59.5Z"),
            (86_401.0, "2017-01-01T23:59:59.5Z"),
        ];
        for (seconds, label) in labels {
            assert_eq!(before.plus_seconds(seconds).unwrap().to_string(), label);
        }
        let within = utc(2016, 12, 31, 23, 59, 60.5);
        assert_eq!(within.utc_civil().second, 60.5);
        assert!(((within.tt - before.tt) * DAY_S - 1.0).abs() < 1e-9);
        // Both clocks of the Earth tick through it.
        assert!(((within.ut1 - before.ut1) * DAY_S - 1.0).abs() < 1e-6);
    }

    #[test]
    fn civil_times_that_never_were_are_refused() {
        // The day is right, the minute is not; the day after; a year without.
        for (year, month, day, hour) in [(2016, 12, 31, 22), (2017, 1, 1, 23), (2015, 12, 31, 23)] {
            let civil = CivilDateTime { year, month, day, hour, minute: 59, second: 60.0 };
            let refused = Instant::from_civil_utc(&civil);
            assert!(matches!(refused, Err(TimeError::NoLeapSecond(_))), "{refused:?}");
        }
        let civil =
            CivilDateTime { year: 2026, month: 13, day: 1, hour: 0, minute: 0, second: 0.0 };
        assert!(matches!(Instant::from_civil_utc(&civil), Err(TimeError::Field { .. })));
    }

    #[test]
    fn clocks_differ_as_they_should() {
        // 2000-01-01 12:00:00 UTC: TT - UTC = 32 + 32.184 s; UT1 - UTC = 0.3554 s (IERS C04).
        let instant = utc(2000, 1, 1, 12, 0, 0.0);
        assert!((instant.tt.days_since_j2000() * DAY_S - 64.184).abs() < 1e-9);
        assert!((instant.ut1.days_since_j2000() * DAY_S - 0.3554).abs() < 1e-3);
        assert!((instant.delta_t_s() - 63.8286).abs() < 1e-3);
        // Before 1972 what people write is UT1.
        let instant = utc(1900, 1, 1, 0, 0, 0.0);
        assert_eq!(instant.ut1.jd(), 2_415_020.5);
        assert!((instant.delta_t_s() + 2.0).abs() < 0.2);
    }

    #[test]
    fn tt_gives_the_utc_of_the_reference_table() {
        let table = include_str!("../../tests/truth/delta_t_rows.csv");
        let mut rows = 0;
        for line in table.lines() {
            let fields: Vec<&str> = line.split(',').collect();
            let [tt_1, tt_2, .., iso] = fields[..] else { continue };
            let (Ok(tt_1), Ok(tt_2), false) = (tt_1.parse(), tt_2.parse(), iso.is_empty()) else {
                continue;
            };
            let civil = Instant::from_tt(JulianDate::from_parts(tt_1, tt_2)).unwrap().utc_civil();
            assert_eq!(civil.to_string()[..17], iso[..17]);
            // TT is tabulated to 86 microseconds.
            assert!(
                (civil.second - iso[17..].parse::<f64>().unwrap()).abs() < 1e-4,
                "{civil} {iso}"
            );
            rows += 1;
        }
        assert_eq!(rows, 19);
    }

    #[test]
    fn a_given_ut1_is_kept() {
        let tt = JulianDate::<Tt>::from_parts(2_305_447.5, 0.25);
        let ut1 = tt.read_on::<Ut1>(-100.0);
        let given = Instant::from_tt_ut1(tt, ut1).unwrap();
        assert!((given.delta_t_s() - 100.0).abs() < 1e-9);
        let later = given.plus_seconds(1e6).unwrap();
        let ours_s = delta_t_s(later.tt) - delta_t_s(tt);
        assert!((later.delta_t_s() - 100.0 - ours_s).abs() < 1e-9);
    }

    #[test]
    fn the_years_end_somewhere() {
        let first = utc(-4000, 1, 1, 0, 0, 0.0);
        let last = utc(4000, 12, 31, 23, 59, 59.0);
        assert_eq!(first.to_string(), "-4000-01-01T00:00:00Z");
        assert_eq!(last.plus_seconds(0.5).unwrap().to_string(), "4000-12-31T23:59:59.5Z");
        assert!(first.plus_seconds(-1.0).is_err());
        assert!(last.plus_seconds(2.0).is_err());
        assert!(last.plus_seconds(f64::NAN).is_err());
        assert!(last.plus_seconds(f64::INFINITY).is_err());
        for jd in [f64::NAN, f64::NEG_INFINITY, 1e300, 0.0, 260_057.0, 3_183_000.0] {
            assert!(Instant::from_utc(JulianDate::from_jd(jd)).is_err(), "{jd}");
            assert!(Instant::from_tt(JulianDate::from_jd(jd)).is_err(), "{jd}");
            let ut1 = JulianDate::from_jd(jd);
            assert!(Instant::from_tt_ut1(JulianDate::from_jd(jd), ut1).is_err(), "{jd}");
        }
        let (tt, ut1) = (JulianDate::from_jd(2_451_545.0), JulianDate::from_jd(2_451_555.0));
        assert!(Instant::from_tt_ut1(tt, ut1).is_err());
    }

    #[test]
    fn civil_time_steps_by_less_than_a_second_where_utc_begins_and_ends() {
        for mjd in [UTC_START_MJD, utc_end_mjd()] {
            let (year, month, day) = date_from_julian_day_number(mjd + 2_400_001);
            let instant = utc(year, month, day, 0, 0, 0.0);
            let (before, after) =
                (instant.plus_seconds(-10.0).unwrap(), instant.plus_seconds(10.0).unwrap());
            assert!(((after.utc - before.utc) * DAY_S - 20.0).abs() < 0.25);
            assert!(((after.ut1 - before.ut1) * DAY_S - 20.0).abs() < 1e-3);
        }
    }

    proptest! {
        #[test]
        fn tt_and_utc_are_inverse(day in 260_059_i64..3_182_390, fraction in -0.5..0.5) {
            let instant = Instant::from_utc(JulianDate::from_parts(day as f64, fraction)).unwrap();
            let back = Instant::from_tt(instant.tt).unwrap();
            // Where UTC ends the civil clock steps back: the same reading comes twice.
            let is_end = (instant.utc.jd() - (MJD_ZERO_JD + utc_end_mjd() as f64)).abs() < 1e-4;
            let is_start = (instant.utc.jd() - (MJD_ZERO_JD + UTC_START_MJD as f64)).abs() < 1e-4;
            prop_assume!(!is_end && !is_start);
            prop_assert!(((back.utc - instant.utc) * DAY_S).abs() < 1e-8);
            prop_assert!(((back.ut1 - instant.ut1) * DAY_S).abs() < 1e-8);
            let again = Instant::from_civil_utc(&instant.utc_civil()).unwrap();
            prop_assert!(((again.tt - instant.tt) * DAY_S).abs() < 2e-9);
        }

        #[test]
        fn seconds_add_up(day in 300_000_i64..3_100_000, first in -1e9..1e9, second in -1e9..1e9) {
            let start = Instant::from_utc(JulianDate::from_parts(day as f64, 0.1)).unwrap();
            let end = start.plus_seconds(first).unwrap().plus_seconds(second).unwrap();
            prop_assert!(((end.tt - start.tt) * DAY_S - (first + second)).abs() < 1e-5);
        }
    }
}
