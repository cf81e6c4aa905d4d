//! Delta-T = TT - UT1: how far the turning Earth lags behind uniform time.
//!
//! **What it gives.** One continuous curve over TT, from -4000 to 4000, in five pieces:
//!
//! - 1972 to the end of the IERS table: measured, then predicted, UT1 - UTC, interpolated linearly
//!   in UT1 - TAI, which has no leap seconds (`catalogs/time/ut1_utc.csv`).
//! - -720 to 1972: the cubic splines of Stephenson, Morrison & Hohenkerk 2016, table S15, in their
//!   2020 update (`catalogs/time/delta_t.csv`). Its last piece is tilted to meet the IERS in 1972.
//! - before -1520 and after 2800: the long-term parabola of the same paper,
//!   -320 + 32.5 ((year - 1825) / 100)^2 s.
//! - -1520 to -720: the cubic that leaves the parabola and meets the splines, in value and slope.
//! - after the IERS table: the cubic that leaves the prediction for 2027-01-28 with the slope of the
//!   year before it, and meets the parabola in 2800, in value and slope.
//!
//! **How we differ.** The joins are those of the Python library Skyfield 1.55, whose curve is the
//! one that comparison tables are made with: the patches of 800 years, the tilt (there to 1973), and
//! the anchor of 2027-01-28, which stays where it is when the IERS table grows, for the slope of one
//! year moves the curve of 2100 by ten seconds. What the newer table predicts beyond the anchor
//! fades into the curve within ten years of its end.
//!
//! **How sure.** 1 ms where measured (linear interpolation over 5 days costs up to 0.6 ms). The
//! splines are smooth: against the IERS they are low by 0.4 s in 1962, 0.65 s in 1965 and 0.2 s in
//! 1972. See the paper for the past, some seconds in 1650 and minutes in antiquity; beyond both ends
//! of the tables, a guess.

use std::sync::LazyLock;

use crate::time::clock::{J2000, JulianDate, Tt, Ut1};
use crate::time::leap_seconds::{MJD_ZERO_JD, UTC_START_MJD, tai_from_utc, tai_minus_utc_s};
use crate::units::{DAY_S, JULIAN_CENTURY_DAYS};

/// TT - TAI in seconds (IAU 1991 Resolution A4, exact).
pub const TT_MINUS_TAI_S: f64 = 32.184;

const JULIAN_YEAR_DAYS: f64 = JULIAN_CENTURY_DAYS / 100.0;

/// Where the parabola gives way in the past, and takes over in the future, Julian years.
const PARABOLA_UNTIL: f64 = -1520.0;
const PARABOLA_FROM: f64 = 2800.0;

/// The anchor of the future: the IERS prediction for 2027-01-28 0h UTC with which the table of
/// Skyfield 1.55 ends. The year from its Julian date in TT; Delta-T, and its slope over a year before.
const ANCHOR: Point = Point {
    year: 2000.0 + (2_461_428.500_800_741 - J2000) / JULIAN_YEAR_DAYS,
    delta_t_s: 69.090_304_9,
    slope_s_per_year: -0.021_091_827_945,
};

/// How long the IERS table's last word fades into the curve.
const FADE_YEARS: f64 = 10.0;

/// A point that a patch must pass, and its slope there.
#[derive(Debug, Clone, Copy)]
struct Point {
    year: f64,
    delta_t_s: f64,
    slope_s_per_year: f64,
}

/// a0 + a1 u + a2 u^2 + a3 u^3 seconds, with u from 0 to 1 between two years.
#[derive(Debug, Clone, Copy)]
struct Cubic {
    year_lo: f64,
    year_hi: f64,
    a: [f64; 4],
}

impl Cubic {
    fn at(&self, year: f64) -> f64 {
        let u = (year - self.year_lo) / (self.year_hi - self.year_lo);
        self.a.iter().rev().fold(0.0, |sum, a| sum * u + a)
    }
    fn start(&self) -> Point {
        let slope_s_per_year = self.a[1] / (self.year_hi - self.year_lo);
        Point { year: self.year_lo, delta_t_s: self.a[0], slope_s_per_year }
    }
    /// The Hermite cubic between two points.
    fn between(from: Point, to: Point) -> Cubic {
        let width = to.year - from.year;
        let (slope_0, slope_1) = (from.slope_s_per_year * width, to.slope_s_per_year * width);
        let rise = to.delta_t_s - from.delta_t_s;
        let a = [
            from.delta_t_s,
            slope_0,
            3.0 * rise - 2.0 * slope_0 - slope_1,
            slope_0 + slope_1 - 2.0 * rise,
        ];
        Cubic { year_lo: from.year, year_hi: to.year, a }
    }
}

/// Stephenson, Morrison & Hohenkerk 2016, section 5.
fn parabola(year: f64) -> Point {
    let centuries = (year - 1825.0) / 100.0;
    Point {
        year,
        delta_t_s: -320.0 + 32.5 * centuries * centuries,
        slope_s_per_year: 2.0 * 32.5 * centuries / 100.0,
    }
}

/// The IERS table: Delta-T at days of TT counted from J2000.
struct Measured {
    days: Vec<f64>,
    delta_t_s: Vec<f64>,
    end_mjd: i64,
}

impl Measured {
    fn at(&self, days: f64) -> f64 {
        let after = self.days.partition_point(|&day| day <= days);
        let i = after.clamp(1, self.days.len() - 1) - 1;
        let u = (days - self.days[i]) / (self.days[i + 1] - self.days[i]);
        self.delta_t_s[i] + u * (self.delta_t_s[i + 1] - self.delta_t_s[i])
    }
}

struct Curve {
    measured: Measured,
    /// -1520 to 1972, in order.
    past: Vec<Cubic>,
    future: Cubic,
    /// 1972-01-01 and the end of the IERS table, days of TT from J2000.
    start_days: f64,
    end_days: f64,
    /// What the IERS table says at its end beyond the future curve.
    end_excess_s: f64,
}

static CURVE: LazyLock<Curve> = LazyLock::new(|| {
    let splines = include_str!("../../catalogs/time/delta_t.csv");
    let measured = include_str!("../../catalogs/time/ut1_utc.csv");
    Curve::join(splines, measured)
        .expect("the embedded Delta-T tables are well formed (a test reads them)")
});

/// The numbers of a table's rows; its comments and its header are passed over.
fn rows(table: &str) -> impl Iterator<Item = Option<Vec<f64>>> + '_ {
    let is_row = |line: &&str| line.starts_with(|c: char| c == '-' || c.is_ascii_digit());
    table.lines().filter(is_row).map(|row| row.split(',').map(|field| field.parse().ok()).collect())
}

fn read_splines(table: &str) -> Option<Vec<Cubic>> {
    rows(table)
        .map(|row| match row?[..] {
            [year_lo, year_hi, a0, a1, a2, a3] => {
                Some(Cubic { year_lo, year_hi, a: [a0, a1, a2, a3] })
            }
            _ => None,
        })
        .collect()
}

fn read_measured(table: &str) -> Option<Measured> {
    let mut nodes = Vec::new();
    for row in rows(table) {
        let row = row?;
        let (mjd, ut1_minus_utc_s) = (*row.first()? as i64, *row.get(1)?);
        // The row before 1972-01-01 refers to the old UTC.
        let offset_s =
            if mjd < UTC_START_MJD { old_tai_minus_utc_s(mjd) } else { tai_minus_utc_s(mjd) };
        nodes.push((mjd, offset_s, TT_MINUS_TAI_S + offset_s - ut1_minus_utc_s));
    }
    // The last row of the old UTC is kept, to reach back to 1972-01-01 itself.
    let first = nodes.iter().position(|node| node.0 >= UTC_START_MJD)?.checked_sub(1)?;
    let nodes = &nodes[first..];
    let tt_days = |&(mjd, offset_s, _): &(i64, f64, f64)| {
        JulianDate::<Tt>::from_parts(MJD_ZERO_JD + mjd as f64, (offset_s + TT_MINUS_TAI_S) / DAY_S)
            .days_since_j2000()
    };
    Some(Measured {
        days: nodes.iter().map(tt_days).collect(),
        delta_t_s: nodes.iter().map(|node| node.2).collect(),
        end_mjd: nodes.last()?.0,
    })
}

/// TAI - UTC in seconds from 1968-02-01 to 1972-01-01 (USNO, tai-utc.dat).
fn old_tai_minus_utc_s(mjd: i64) -> f64 {
    4.213_17 + (mjd as f64 - 39_126.0) * 0.002_592
}

impl Curve {
    fn join(splines: &str, measured: &str) -> Option<Curve> {
        let measured = read_measured(measured)?;
        let start_days = utc_start_tt().days_since_j2000();
        let start_year = julian_year(start_days);

        let mut past = read_splines(splines)?;
        past.retain(|piece| piece.year_lo < start_year);
        // Tilt the last piece about its beginning, so that it ends on the measured value.
        let last = past.last_mut()?;
        let gap_s = measured.at(start_days) - last.at(start_year);
        last.a[1] += gap_s * (last.year_hi - last.year_lo) / (start_year - last.year_lo);
        let patch = Cubic::between(parabola(PARABOLA_UNTIL), past.first()?.start());
        past.insert(0, patch);

        let future = Cubic::between(ANCHOR, parabola(PARABOLA_FROM));
        let end_days = *measured.days.last()?;
        let end_excess_s = measured.at(end_days) - future.at(julian_year(end_days));
        Some(Curve { measured, past, future, start_days, end_days, end_excess_s })
    }

    fn at(&self, days: f64) -> f64 {
        let year = julian_year(days);
        if !(PARABOLA_UNTIL..PARABOLA_FROM).contains(&year) {
            parabola(year).delta_t_s
        } else if days < self.start_days {
            let piece = self.past.partition_point(|piece| piece.year_hi <= year);
            self.past[piece.min(self.past.len() - 1)].at(year)
        } else if days <= self.end_days {
            self.measured.at(days)
        } else {
            let years_after = (days - self.end_days) / JULIAN_YEAR_DAYS;
            let fade = (1.0 - years_after / FADE_YEARS).max(0.0);
            self.future.at(year) + fade * self.end_excess_s
        }
    }
}

/// The year of the curve, of 365.25 days and 2000.0 at J2000.
fn julian_year(days_since_j2000: f64) -> f64 {
    2000.0 + days_since_j2000 / JULIAN_YEAR_DAYS
}

/// 1972-01-01 0h UTC.
fn utc_start_tt() -> JulianDate<Tt> {
    tai_from_utc(UTC_START_MJD, 0.0).read_on(TT_MINUS_TAI_S)
}

/// TT - UT1 in seconds; for the years -4000 to 4000.
pub fn delta_t_s(tt: JulianDate<Tt>) -> f64 {
    CURVE.at(tt.days_since_j2000())
}

/// TT from UT1: the inverse of subtracting [`delta_t_s`].
pub fn tt_from_ut1(ut1: JulianDate<Ut1>) -> JulianDate<Tt> {
    // Delta-T changes by less than 2e-6 of the time that passes: each round gains five digits.
    let mut delta_t_s = 0.0;
    for _ in 0..4 {
        delta_t_s = self::delta_t_s(ut1.read_on(delta_t_s));
    }
    ut1.read_on(delta_t_s)
}

/// The first day, a modified Julian date, on which civil time is no longer UTC but UT1.
pub fn utc_end_mjd() -> i64 {
    CURVE.measured.end_mjd
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(year: f64) -> f64 {
        CURVE.at((year - 2000.0) * JULIAN_YEAR_DAYS)
    }

    fn numbers(table: &str) -> Vec<Vec<f64>> {
        let is_row = |line: &&str| line.starts_with(|c: char| c == '-' || c.is_ascii_digit());
        let row = |row: &str| row.split(',').take(4).map(|field| field.parse().unwrap()).collect();
        table.lines().filter(is_row).map(row).collect()
    }

    #[test]
    fn it_passes_the_values_everyone_quotes() {
        for (year, delta_t_s) in [(1600.0, 109.1), (1900.0, -2.0), (2000.0, 63.83)] {
            assert!((at(year) - delta_t_s).abs() < 0.05, "{year}: {}", at(year));
        }
        assert_eq!(at(-3000.0), -320.0 + 32.5 * 48.25 * 48.25);
    }

    #[test]
    fn its_pieces_meet() {
        let end = julian_year(CURVE.end_days);
        for year in [PARABOLA_UNTIL, -720.0, julian_year(CURVE.start_days), end, PARABOLA_FROM] {
            let step_s = at(year + 1e-6) - at(year - 1e-6);
            assert!(step_s.abs() < 1e-3, "{year}: {step_s} s");
        }
        // The published coefficients are rounded: so are the joins within the splines.
        for pair in CURVE.past.windows(2) {
            let step_s = pair[1].at(pair[1].year_lo) - pair[0].at(pair[0].year_hi);
            assert!(step_s.abs() < 0.002, "{}: {step_s} s", pair[1].year_lo);
        }
        // Nor does the fade end in a step.
        assert!((at(end + FADE_YEARS + 1e-6) - at(end + FADE_YEARS - 1e-6)).abs() < 1e-6);
    }

    #[test]
    fn it_follows_the_iers_through_leap_seconds() {
        // Rows of the table either side of 2017-01-01: MJD, TAI - UTC, UT1 - UTC.
        let rows = [(57_750, 36.0, -0.405_29), (57_755, 37.0, 0.590_22)];
        for (mjd, offset_s, ut1_minus_utc_s) in rows {
            let tt = tai_from_utc(mjd, 0.0).read_on(TT_MINUS_TAI_S);
            assert!((delta_t_s(tt) - (TT_MINUS_TAI_S + offset_s - ut1_minus_utc_s)).abs() < 1e-9);
        }
        // In between it does not jump: Delta-T grew by 4.49 ms in these five days.
        let before = delta_t_s(tai_from_utc(57_753, 86_400.0).read_on(TT_MINUS_TAI_S));
        let after = delta_t_s(tai_from_utc(57_754, 0.5).read_on(TT_MINUS_TAI_S));
        assert!((after - before).abs() < 1e-4);
    }

    #[test]
    fn it_is_the_curve_that_comparison_tables_are_made_with() {
        let rows = numbers(include_str!("../../tests/truth/delta_t_curve.csv"));
        assert_eq!(rows.len(), 195);
        let end = julian_year(CURVE.end_days);
        for row in rows {
            let (year, error_s) = (row[0], (at(row[0]) - row[1]).abs());
            // Newer predictions than those of the comparison fade out by the end of 2037.
            let bound_s = if (2026.0..end + FADE_YEARS).contains(&year) { 0.4 } else { 0.1 };
            assert!(error_s < bound_s, "{year}: {error_s} s");
        }
    }

    #[test]
    fn tt_gives_the_ut1_of_the_reference_table() {
        let rows = numbers(include_str!("../../tests/truth/delta_t_rows.csv"));
        assert_eq!(rows.len(), 30);
        for row in rows {
            let tt = JulianDate::<Tt>::from_parts(row[0], row[1]);
            let theirs_s = ((row[0] - row[2]) + (row[1] - row[3])) * DAY_S;
            let error_s = (delta_t_s(tt) - theirs_s).abs();
            // TT is tabulated to 86 microseconds. The IERS table is interpolated over five days.
            let is_measured = (2_441_684.5..2_461_000.0).contains(&tt.jd());
            let bound_s = if is_measured { 0.002 } else { 0.1 };
            assert!(error_s < bound_s, "JD {}: {error_s} s", tt.jd());
        }
    }

    #[test]
    fn tt_from_ut1_undoes_delta_t() {
        for jd in [260_100.5, 1_000_000.25, 1_721_060.0, 2_299_160.5, 2_441_317.5, 3_182_000.0] {
            let ut1 = JulianDate::<Ut1>::from_jd(jd);
            let tt = tt_from_ut1(ut1);
            let back: JulianDate<Ut1> = tt.read_on(-delta_t_s(tt));
            assert!(((back - ut1) * DAY_S).abs() < 1e-9, "{jd}");
        }
    }

    #[test]
    fn broken_tables_are_noticed() {
        assert!(read_splines("1,2,3,4,5").is_none());
        assert!(read_splines("1,2,3,4,5,x").is_none());
        assert!(read_measured("41315,abc").is_none());
    }
}
