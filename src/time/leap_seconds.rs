//! UTC and TAI: where the leap seconds stand.
//!
//! The table is the IERS list of TAI - UTC from 1972-01-01 (`catalogs/time/leap_seconds.dat`).
//! Its last entry holds until the IERS announces another step.

use std::sync::LazyLock;

use crate::time::clock::{JulianDate, Tai};
use crate::units::DAY_S;

/// First day of UTC with whole leap seconds, 1972-01-01, modified Julian date.
pub const UTC_START_MJD: i64 = 41_317;

/// Julian date of the modified Julian date zero.
pub const MJD_ZERO_JD: f64 = 2_400_000.5;

/// The day from which an offset holds.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Step {
    mjd: i64,
    tai_minus_utc_s: f64,
}

static STEPS: LazyLock<Vec<Step>> = LazyLock::new(|| {
    parse(include_str!("../../catalogs/time/leap_seconds.dat"))
        .expect("the embedded leap second table is well formed (a test reads it)")
});

/// Rows of MJD, day, month, year, TAI - UTC; `None` for a row that is not.
fn parse(table: &str) -> Option<Vec<Step>> {
    let rows =
        table.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    rows.map(|row| {
        let mut fields = row.split_whitespace();
        let mjd: f64 = fields.next()?.parse().ok()?;
        Some(Step { mjd: mjd as i64, tai_minus_utc_s: fields.nth(3)?.parse().ok()? })
    })
    .collect()
}

/// TAI - UTC in seconds on a day of UTC; before 1972 the first offset, 10 s, is continued.
pub fn tai_minus_utc_s(mjd: i64) -> f64 {
    let after = STEPS.partition_point(|step| step.mjd <= mjd);
    STEPS[after.saturating_sub(1)].tai_minus_utc_s
}

/// Length of a day of UTC in seconds: 86400, or 86401 if it ends with a leap second.
pub fn day_length_s(mjd: i64) -> f64 {
    let growth_s = tai_minus_utc_s(mjd + 1) - tai_minus_utc_s(mjd);
    DAY_S + growth_s
}

/// TAI from a day of UTC and the seconds since its midnight, leap second included.
pub fn tai_from_utc(mjd: i64, second_of_day: f64) -> JulianDate<Tai> {
    JulianDate::from_parts(MJD_ZERO_JD + mjd as f64, second_of_day / DAY_S)
        .plus_seconds(tai_minus_utc_s(mjd))
}

/// The day of UTC and the seconds since its midnight, in `[0, 86401)`; from 1972 on.
pub fn utc_from_tai(tai: JulianDate<Tai>) -> (i64, f64) {
    let step_begins = |step: &Step| tai_from_utc(step.mjd, 0.0) <= tai;
    let after = STEPS.partition_point(step_begins);
    let offset_s = STEPS[after.saturating_sub(1)].tai_minus_utc_s;
    let (mjd, fraction) = split_at_midnight(tai.plus_seconds(-offset_s));
    match STEPS.get(after) {
        // The old offset reads past midnight already: the day before has not ended, 23:59:60.
        Some(next) if mjd >= next.mjd => (mjd - 1, DAY_S + fraction * DAY_S),
        _ => (mjd, fraction * DAY_S),
    }
}

/// The modified Julian date of a day and the part of it that has passed, in `[0, 1)`.
pub fn split_at_midnight<C>(jd: JulianDate<C>) -> (i64, f64) {
    // The day part names a noon; midnight lies half a day before it.
    let mjd = (jd.day() - (MJD_ZERO_JD + 0.5)) as i64;
    let fraction = jd.fraction() + 0.5;
    if fraction >= 1.0 { (mjd + 1, fraction - 1.0) } else { (mjd, fraction) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_knows_its_ends_and_its_steps() {
        assert_eq!(STEPS.len(), 28);
        assert_eq!(tai_minus_utc_s(UTC_START_MJD), 10.0);
        assert_eq!(tai_minus_utc_s(57_753), 36.0);
        assert_eq!(tai_minus_utc_s(57_754), 37.0);
        assert_eq!(tai_minus_utc_s(99_999), 37.0);
        assert_eq!(day_length_s(57_753), 86_401.0);
        assert_eq!(day_length_s(57_754), 86_400.0);
        assert_eq!(STEPS.iter().filter(|s| day_length_s(s.mjd - 1) == 86_401.0).count(), 27);
    }

    #[test]
    fn a_broken_row_is_noticed() {
        assert_eq!(parse("41317.0 1 1 1972 ten"), None);
        assert_eq!(parse("41317.0 1 1"), None);
    }

    #[test]
    fn tai_ticks_through_the_leap_second() {
        // One second apart in TAI, these are the labels of 2016-12-31 and after.
        let labels = [(57_753, 86_399.25), (57_753, 86_400.25), (57_754, 0.25)];
        for pair in labels.windows(2) {
            let elapsed = tai_from_utc(pair[1].0, pair[1].1) - tai_from_utc(pair[0].0, pair[0].1);
            assert!((elapsed * DAY_S - 1.0).abs() < 1e-10);
        }
        for (mjd, second) in labels {
            let (found_mjd, found_second) = utc_from_tai(tai_from_utc(mjd, second));
            assert_eq!(found_mjd, mjd);
            assert!((found_second - second).abs() < 1e-10);
        }
    }
}
