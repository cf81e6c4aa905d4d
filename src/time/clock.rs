//! Clocks, each its own type, and Julian dates that know which clock they were read on.

use std::fmt;
use std::marker::PhantomData;
use std::ops::Sub;

use crate::units::{DAY_S, JULIAN_CENTURY_DAYS};

/// Coordinated Universal Time: what people read and write.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Utc {}
/// Universal Time: the rotation angle of the Earth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ut1 {}
/// International Atomic Time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tai {}
/// Terrestrial Time: TAI + 32.184 s; drives precession and nutation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tt {}
/// Barycentric Dynamical Time: drives the theories of planets; within 2 ms of TT.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tdb {}

/// Julian date of the epoch J2000.0.
pub const J2000: f64 = 2_451_545.0;

/// A Julian date on the clock `C`, in two parts so that a nanosecond survives over millennia.
///
/// The day part is a whole number of days, the fraction lies in `[-0.5, 0.5]`.
pub struct JulianDate<C> {
    day: f64,
    fraction: f64,
    clock: PhantomData<C>,
}

impl<C> Clone for JulianDate<C> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<C> Copy for JulianDate<C> {}
impl<C> PartialEq for JulianDate<C> {
    fn eq(&self, other: &Self) -> bool {
        *self - *other == 0.0
    }
}
impl<C> PartialOrd for JulianDate<C> {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        (*self - *other).partial_cmp(&0.0)
    }
}
impl<C> fmt::Debug for JulianDate<C> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "JD {} {:+.12}", self.day, self.fraction)
    }
}

/// As [`f64::round`] below 2^63, at a tenth of its cost: most processors are not asked for the
/// instruction. What is larger, or no number, leaves its trace in the rest.
fn nearest(x: f64) -> f64 {
    let whole = x as i64 as f64;
    let rest = x - whole;
    if rest >= 0.5 {
        whole + 1.0
    } else if rest <= -0.5 {
        whole - 1.0
    } else {
        whole
    }
}

impl<C> JulianDate<C> {
    /// From two parts whose sum is the Julian date; no digit is lost, whichever way it was split.
    pub fn from_parts(a: f64, b: f64) -> Self {
        let (day_a, day_b) = (nearest(a), nearest(b));
        let rest = (a - day_a) + (b - day_b);
        let day_rest = nearest(rest);
        JulianDate { day: day_a + day_b + day_rest, fraction: rest - day_rest, clock: PhantomData }
    }
    /// From a single number: good to about 40 microseconds near J2000.
    pub fn from_jd(jd: f64) -> Self {
        Self::from_parts(jd, 0.0)
    }
    /// The whole days.
    pub fn day(self) -> f64 {
        self.day
    }
    /// What is left over, in `[-0.5, 0.5]` days.
    pub fn fraction(self) -> f64 {
        self.fraction
    }
    /// The sum of both parts: good to about 40 microseconds near J2000.
    pub fn jd(self) -> f64 {
        self.day + self.fraction
    }
    pub fn days_since_j2000(self) -> f64 {
        (self.day - J2000) + self.fraction
    }
    pub fn centuries_since_j2000(self) -> f64 {
        self.days_since_j2000() / JULIAN_CENTURY_DAYS
    }
    pub fn plus_days(self, days: f64) -> Self {
        let whole = nearest(days);
        Self::from_parts(self.day + whole, self.fraction + (days - whole))
    }
    pub fn plus_seconds(self, seconds: f64) -> Self {
        self.plus_days(seconds / DAY_S)
    }
    /// The same reading on another clock, `seconds` later: how one clock is made from another.
    pub fn read_on<D>(self, seconds: f64) -> JulianDate<D> {
        let moved = self.plus_seconds(seconds);
        JulianDate { day: moved.day, fraction: moved.fraction, clock: PhantomData }
    }
}

/// Days from `other` to `self`, on their common clock.
impl<C> Sub for JulianDate<C> {
    type Output = f64;
    fn sub(self, other: Self) -> f64 {
        (self.day - other.day) + (self.fraction - other.fraction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_whole_number_is_that_of_round() {
        for x in
            [0.0, -0.2, 0.5, -0.5, 0.499_999_999_999_999_94, 1.5, -2.5, 2_451_544.5, 1e15, -7.7]
        {
            assert_eq!(nearest(x), x.round(), "{x}");
        }
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
            let jd = JulianDate::<Tt>::from_parts(x, 0.25).jd();
            assert!(jd == x || jd.is_nan(), "{x}: {jd}");
        }
    }
}
